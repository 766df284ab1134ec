"""A wing of weighed pieces, elsewhere: MuJoCo and URDF have the mass and inertia of the pieces themselves."""

import dataclasses
from xml.etree import ElementTree

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.weighed_wing import TABLE, TOTAL

pytestmark = pytest.mark.slow

PLAIN = {"wing.mass_exponent": 0.0, "wing.chord": (0.13, 0.12, 0.05), "wing.pitch_axis": 0.15}


def weighed(orbit):
    """Return an orbit whose wing was not solved for."""
    table = {f"wing.{name}": column for name, column in TABLE.items()}
    species = orbit.problem.species.with_values(PLAIN | table)
    return wb.Orbit.of_record(orbit.record(), dataclasses.replace(orbit.problem, species=species), starts=2)


def of_pieces(wing):
    """Mass, centre and inertia about it of the left wing; x is along the chord, y along the span to the left."""
    mass, left = np.array(TABLE["station_masses"]), np.array(TABLE["mass_stations"]) * wing.semi_span
    chord = np.interp(TABLE["mass_stations"], [0, 0.5, 1], wing.chord)
    ahead, gyration = (0.15 - np.array(TABLE["station_axes"])) * chord, np.array(TABLE["station_gyrations"]) * chord
    centre = np.array([mass @ ahead, mass @ left, 0.0]) / mass.sum()
    x, y = ahead - centre[0], left - centre[1]
    about_x, about_y, across = mass @ y**2, mass @ (x**2 + gyration**2), -mass @ (x * y)
    inertia = np.array([[about_x, across, 0], [across, about_y, 0], [0, 0, about_x + about_y]])
    return mass.sum(), centre, inertia


def test_urdf_has_the_inertia_of_the_pieces(rigid_orbit, tmp_path):
    orbit = weighed(rigid_orbit)
    wb.export(orbit, tmp_path / "robot.urdf", samples=16)
    top = ElementTree.fromstring((tmp_path / "robot.urdf").read_bytes())
    (inertial,) = (link.find("inertial") for link in top.iter("link") if link.get("name") == "left_wing")
    mass, centre, inertia = of_pieces(orbit.problem.vehicle.wing)
    assert float(inertial.find("mass").get("value")) == pytest.approx(mass, rel=1e-9)
    place = [float(one) for one in inertial.find("origin").get("xyz").split()]
    np.testing.assert_allclose(place, centre, rtol=0, atol=1e-9 * orbit.problem.vehicle.wing.semi_span)
    found = {name: float(value) for name, value in inertial.find("inertia").attrib.items()}
    wanted = {f"i{'xyz'[i]}{'xyz'[j]}": inertia[i, j] for i in range(3) for j in range(i, 3)}
    for name, value in wanted.items():
        assert found[name] == pytest.approx(value, rel=1e-9, abs=1e-9 * inertia.max()), name


def test_mujoco_has_the_inertia_of_the_pieces(rigid_orbit, tmp_path):
    mujoco = pytest.importorskip("mujoco")
    orbit = weighed(rigid_orbit)
    wb.export(orbit, tmp_path / "robot.xml", samples=16)
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "robot.xml"))
    mass, centre, inertia = of_pieces(orbit.problem.vehicle.wing)
    body = model.body("left_wing")
    assert body.mass[0] == pytest.approx(mass, rel=1e-9)
    np.testing.assert_allclose(body.ipos, centre, rtol=0, atol=1e-9 * orbit.problem.vehicle.wing.semi_span)
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, body.iquat)
    turn = turn.reshape(3, 3)
    found = turn @ np.diag(body.inertia) @ turn.T
    np.testing.assert_allclose(found, inertia, rtol=0, atol=1e-9 * inertia.max())


@pytest.mark.parametrize("suffix", [".xml", ".urdf"])
def test_a_strip_without_a_piece_is_a_part_without_mass(suffix, pigeon_orbit, tmp_path):
    """Strips that slide, one by one, on a wing with fewer pieces than strips."""
    orbit = pigeon_orbit.orbit
    table = {"wing.mass_stations": (0.15, 0.5, 0.85), "wing.station_masses": (0.01, 0.006, 0.004)}
    species = orbit.problem.species.with_values(table | {"wing.mass_exponent": 0.0})
    orbit = wb.Orbit.of_record(orbit.record(), dataclasses.replace(orbit.problem, species=species), starts=2)
    wb.export(orbit, tmp_path / f"robot{suffix}", samples=16)
    top = ElementTree.fromstring((tmp_path / f"robot{suffix}").read_bytes())
    if suffix == ".urdf":
        parts = {link.get("name"): link.find("inertial/mass").get("value") for link in top.iter("link")}
    else:
        parts = {body.get("name"): body.find("inertial").get("mass") for body in top.iter("body")}
    masses = {name: float(mass) for name, mass in parts.items()}
    assert masses["left_strip_1"] == 1e-14
    assert sum(mass for name, mass in masses.items() if name.startswith("left")) == pytest.approx(0.02, rel=1e-9)
    assert TOTAL < 0.02
