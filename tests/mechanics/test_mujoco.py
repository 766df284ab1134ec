"""MuJoCo's inverse dynamics agrees: no force is missing on the body, and the hinge torques are ours."""

import dataclasses
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.mujoco_model import inverse_dynamics

TOLERANCE = 1e-6
ROWS = ("x", "z", "body_pitch", "flap_torque", "pitch_torque")

PIGEON = wb.Vehicle(wb.Body(0.276, 3.6e-4), wb.Wing(0.279, 0.112, 0.020, mass_exponent=2.0))
BAT = wb.Vehicle(wb.Body(0.0584, 2.4e-5), wb.Wing(0.30, 0.10, 0.0048, mass_exponent=0.94))
# Nothing left at zero, nothing symmetric.
ODD = wb.Vehicle(
    wb.Body(0.0584, 2.4e-5),
    wb.Wing(0.30, (0.11, 0.13, 0.09, 0.04), 0.0048, 0.94, (0.03, 0.02, 0.01), math.radians(75)),
)
TAILED = dataclasses.replace(ODD, tail=wb.Tail(0.004, 0.12, 2.5, 0.03, height=0.02, incidence=-0.2))
# Vehicle, wingbeat, state at the top of the stroke, strips.
FLIGHTS = {
    "pigeon": (PIGEON, wb.Wingbeat(7.0, 0.0, 0.70, 0.14, 0.26), wb.State(u=10.0, body_pitch=0.1), 10),
    "bat": (
        BAT,
        wb.Wingbeat(9.0, 0.05, 0.75, 0.12, 0.30, twist_ratio=1.6),
        wb.State(body_pitch=0.2, u=6.0, w=-0.5, pitch_rate=1.0),
        10,
    ),
    "odd": (
        ODD,
        wb.Wingbeat(8.0, 0.15, 0.85, 0.20, 0.50, twist_ratio=1.6),
        wb.State(0.3, 1.2, -0.4, 5.0, 1.0, -3.0),
        7,
    ),
    "odd with a tail": (
        TAILED,
        wb.Wingbeat(8.0, 0.15, 0.85, 0.20, 0.50, twist_ratio=1.6),
        wb.State(0.3, 1.2, -0.4, 5.0, 1.0, -3.0),
        7,
    ),
}


def fly(vehicle, wingbeat, state, strips):
    model = wb.FlightModel(vehicle, wb.aero.BladeElement(wb.aero.SuFan(), strips))
    return wb.simulate(model, wingbeat, state, beats=1, samples=32).dataset


def columns(series, *names):
    return np.stack([series[name].values for name in names], axis=-1)


def run_mujoco(vehicle, wingbeat, series, gravity=9.81):
    """Give MuJoCo the recorded motion and strip forces; flap and root pitch swing about their means."""
    hinges = columns(series, "flap", "wing_pitch")
    hinge_acceleration = -((2 * math.pi * wingbeat.frequency) ** 2) * (
        hinges - [wingbeat.flap_mean, wingbeat.pitch_mean]
    )
    body_acceleration = columns(series, "u_rate", "w_rate", "pitch_acceleration")
    return inverse_dynamics(
        vehicle,
        wingbeat.twist_ratio,
        gravity,
        columns(series, "x", "z", "body_pitch", "flap", "wing_pitch"),
        columns(series, "u", "w", "pitch_rate", "flap_rate", "wing_pitch_rate"),
        np.concatenate([body_acceleration, hinge_acceleration], axis=1),
        series["strip_force"].values,
    )


def errors(vehicle, wingbeat, series):
    """Return the worst misses: body rows over their peak air load, hinge torques over their own peaks."""
    found = run_mujoco(vehicle, wingbeat, series)
    hinge_torques = columns(series, "flap_torque", "pitch_torque")
    ours = np.concatenate([np.zeros((len(hinge_torques), 3)), hinge_torques], axis=1)
    loads = columns(series, "force_x", "force_z", "pitching_moment")
    peaks = np.abs(np.concatenate([loads, hinge_torques], axis=1)).max(axis=0)
    worst = np.abs(found.needed - found.air - ours).max(axis=0) / peaks
    return dict(zip(ROWS, worst, strict=True))


@pytest.fixture(scope="module", params=FLIGHTS)
def flight(request):
    return *FLIGHTS[request.param][:2], fly(*FLIGHTS[request.param])


def test_agrees_on_a_flight(flight):
    found = errors(*flight)
    assert all(error <= TOLERANCE for error in found.values()), found


def test_agrees_on_places_and_air_loads(flight):
    vehicle, wingbeat, series = flight
    found = run_mujoco(vehicle, wingbeat, series)
    left = series["strip_position"].values
    np.testing.assert_allclose(found.strip_position[:, 0], left, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.strip_position[:, 1], left * [1.0, -1.0, 1.0], rtol=0, atol=1e-12)
    loads = columns(series, "force_x", "force_z", "pitching_moment")
    peaks = np.abs(loads).max(axis=0)
    np.testing.assert_allclose(found.air[:, :3] / peaks, loads / peaks, rtol=0, atol=TOLERANCE)


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_agrees_on_a_certified_orbit(name):
    rigid = {"wingbeat.span_retraction": 0.0, "wingbeat.fold_amplitude": 0.0}
    species = wb.load_species(name).with_values(rigid)
    orbit = wb.solve_orbit(wb.OrbitProblem(species, speed=10.0), starts=2)
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    found = errors(species.vehicle, orbit.wingbeat, orbit.dataset)
    assert all(error <= TOLERANCE for error in found.values()), found


@pytest.mark.parametrize(
    ("row", "wrong"),
    [
        ("z", {"mass": 0.0049}),
        ("flap_torque", {"mass_exponent": 0.95}),
        ("flap_torque", {"stroke_plane_angle": math.radians(75.1)}),
        ("body_pitch", {"shoulder": (0.0301, 0.02, 0.01)}),
        ("pitch_torque", {"chord": (0.11, 0.13, 0.09, 0.041)}),
    ],
)
def test_sees_a_wing_that_is_slightly_wrong(row, wrong):
    vehicle, wingbeat = FLIGHTS["odd"][:2]
    other = dataclasses.replace(vehicle, wing=dataclasses.replace(vehicle.wing, **wrong))
    assert errors(other, wingbeat, fly(*FLIGHTS["odd"]))[row] > 100 * TOLERANCE


@pytest.mark.parametrize(("row", "wrong"), [("body_pitch", {"arm": 0.1201}), ("x", {"incidence": -0.201})])
def test_sees_a_tail_that_is_slightly_wrong(row, wrong):
    vehicle, wingbeat = FLIGHTS["odd with a tail"][:2]
    other = dataclasses.replace(vehicle, tail=dataclasses.replace(vehicle.tail, **wrong))
    assert errors(other, wingbeat, fly(*FLIGHTS["odd with a tail"]))[row] > 100 * TOLERANCE


def test_sees_a_twist_that_is_slightly_wrong():
    vehicle, wingbeat = FLIGHTS["bat"][:2]
    other = dataclasses.replace(wingbeat, twist_ratio=1.61)
    assert errors(vehicle, other, fly(*FLIGHTS["bat"]))["pitch_torque"] > 100 * TOLERANCE
