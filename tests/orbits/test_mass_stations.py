"""Orbits of a robot whose wings give way, from weighed pieces of spar, skin and joints."""

import functools

import pytest

import wingbeat as wb
from tests.helpers.weighed_wing import TABLE, TOTAL
from wingbeat.orbits.problem.parameters import parameters_of

pytestmark = pytest.mark.slow

SPRING = {"pitch_hinge.stiffness": 1.395, "pitch_hinge.damping": 0.0166, "pitch_hinge.rest_angle": -0.314}


@functools.cache
def orbit():
    # As heavy as the built-in wing, with the skin's centre ahead of its middle: the pieces are made up.
    scale = 0.03379 / TOTAL
    pieces = {f"wing.{name}": column for name, column in TABLE.items()}
    pieces |= {"wing.station_masses": [scale * mass for mass in TABLE["station_masses"]], "wing.mass_exponent": 0.0}
    species = wb.load_species("robofalcon2").with_values(SPRING | pieces)
    aero = wb.aero.BladeElement(wb.aero.SuFan(), 10, "centre-of-pressure")
    free = ("frequency", "flap_mean", "flap_amplitude", "hinge_rest_angle")
    bounds = {"hinge_rest_angle": (-1.0, 1.0)}
    problem = wb.OrbitProblem(
        species, speed=8.0, minimise="mean_positive_power", aero=aero, free=free, bounds=bounds
    )
    found = wb.solve_orbit(problem, starts=1)
    assert found.status is wb.Status.CONVERGED, found.message
    return found


def test_a_robot_of_spar_and_skin_flies_and_closes():
    record = orbit().record()
    assert max(map(abs, record["closure"].values())) <= 1e-6
    assert record["vehicle"]["wing"]["station_axes"] == list(TABLE["station_axes"])
    flown = wb.certify(orbit().problem.model, orbit().wingbeat, orbit().initial_state[2:])
    assert flown.hinge_miss <= 1e-8


def test_the_orbit_comes_back_from_its_file(tmp_path):
    orbit().save(tmp_path / "orbit.nc")
    again = wb.load_orbit(tmp_path / "orbit.nc")
    assert again.problem.vehicle == orbit().problem.vehicle
    assert again.record()["mean_positive_power"] == orbit().record()["mean_positive_power"]


def test_a_table_counts_by_its_mass_alone():
    named = {one.path: one for one in parameters_of(orbit().problem)}
    assert not [path for path in named if "station" in path]
    assert not {"wing.mass_exponent", "wing.mass_axis", "wing.mass_gyration"} & {*named}
    assert "wing.pitch_axis" in named  # silent in the file, so it is drawn by a guess
    heavy = named["wing.mass"].changed(orbit().problem, 0.04).vehicle.wing
    assert sum(heavy.station_masses) == pytest.approx(0.04)
    assert heavy.mass_stations == TABLE["mass_stations"]


def test_the_slope_by_the_mass_is_that_of_scaled_pieces():
    slopes = {one.parameter.path: one for one in wb.sensitivities(orbit()).slopes}
    by_mass, powers = slopes["wing.mass"].parameter, []
    for share in (1.02, 0.98):
        near = wb.solve_orbit(by_mass.changed(orbit().problem, share * by_mass.value), starts=1, start=orbit())
        powers.append(near.record()["mean_positive_power"])
    wanted = (powers[0] - powers[1]) / (0.04 * by_mass.value)
    assert slopes["wing.mass"].objective == pytest.approx(wanted, rel=0.02)


def test_draws_of_the_mass_scale_the_pieces():
    slopes, power = wb.sensitivities(orbit()), "mean_positive_power"
    assert slopes.error_bar(power).due_to["wing.mass"] > 0
    drawn = wb.uncertainty_by_samples(slopes, [power], samples=10, share=0.05)[power]
    assert drawn.certified == 10
