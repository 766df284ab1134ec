"""A tail in flight: stability, damping, glides, derivatives, induced flow, orbits."""

import dataclasses
import functools

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.differences import differences
from tests.helpers.differences import miss as of_jacobians
from tests.helpers.models import changed
from tests.helpers.programs import compiled
from tests.helpers.tail_oracle import moment, tail_load
from wingbeat._jax.arrays import jax, jnp, unchecked
from wingbeat.mechanics.flight_model import body_air, motion_table
from wingbeat.mechanics.state_rates import body_rates
from wingbeat.orbits.problem.parameters import parameters_of

PIGEON = wb.load_species("pigeon")
TAILED = PIGEON.with_tail()
TAIL, DENSITY, SPEED = TAILED.vehicle.tail, 1.225, 12.0


def with_tail(tail, vehicle=PIGEON.vehicle):
    return dataclasses.replace(vehicle, tail=tail)


# --- What a tail is for


def pitching_moment(tail, body_pitch=0.0, pitch_rate=0.0):
    """Return the moment on a body without drag that flies level at a pitch [rad] and a pitch rate [rad/s]."""
    velocity = SPEED * np.cos(body_pitch), -SPEED * np.sin(body_pitch)
    return float(body_air(with_tail(tail), DENSITY, velocity, pitch_rate)[1])


@pytest.mark.parametrize("arm", [TAIL.arm, -TAIL.arm])
def test_behind_the_centre_of_mass_it_turns_the_nose_back_and_ahead_of_it_away(arm):
    tail, step = dataclasses.replace(TAIL, arm=arm), 1e-4
    slope = (pitching_moment(tail, step) - pitching_moment(tail, -step)) / (2 * step)
    wanted = -0.5 * DENSITY * SPEED**2 * tail.area * (tail.lift_slope + tail.drag_coefficient) * arm
    assert slope == pytest.approx(wanted, rel=1e-6)
    assert slope * arm < 0


@pytest.mark.parametrize("arm", [TAIL.arm, -TAIL.arm])
def test_it_damps_pitching_on_either_side(arm):
    tail, step = dataclasses.replace(TAIL, arm=arm), 1e-3
    damping = (pitching_moment(tail, 0.0, step) - pitching_moment(tail, 0.0, -step)) / (2 * step)
    wanted = -0.5 * DENSITY * SPEED * tail.area * (tail.lift_slope + tail.drag_coefficient) * arm**2
    assert damping == pytest.approx(wanted, rel=1e-6)


def test_lifting_its_leading_edge_turns_the_nose_down():
    up = dataclasses.replace(TAIL, incidence=0.1)
    assert pitching_moment(up) < 0.0 == pitching_moment(dataclasses.replace(TAIL, height=0.0))


def test_without_a_tail_nothing_is_added_to_a_program():
    leaves = jax.tree_util.tree_leaves
    assert len(leaves(PIGEON.vehicle)) == len(leaves(PIGEON.vehicle.body)) + len(leaves(PIGEON.vehicle.wing))
    assert len(leaves(TAILED.vehicle)) == len(leaves(PIGEON.vehicle)) + 6
    tilted = dataclasses.replace(PIGEON.wingbeat, tail_tilt=0.1)
    assert len(leaves(tilted)) == len(leaves(PIGEON.wingbeat)) + 1
    assert body_air(PIGEON.vehicle, DENSITY, (SPEED, 0.0), 0.0)[1] is None


# --- Glide


@pytest.mark.parametrize("trim", ["tail", "body-pitch"])
def test_a_glide_balances_weight_wings_and_tail(trim):
    """The wings' loads are those of the vehicle without a tail; the tail's come from the plain oracle."""
    glide = wb.glide_polar(TAILED, angles_of_attack=[np.radians(6.0)], trim=trim).glides[0]
    assert glide.trimmed
    assert (glide.tail_tilt != 0) == (trim == "tail")
    velocity = np.array([np.cos(glide.glide_angle), -np.sin(glide.glide_angle)]) * glide.speed
    still = dict.fromkeys(("flap_amplitude", "pitch_amplitude", "span_retraction", "fold_amplitude"), 0.0)
    beat = dataclasses.replace(PIGEON.wingbeat, **still)
    q = np.array([0.0, 0.0, glide.body_pitch, glide.flap, glide.wing_pitch])
    model = wb.FlightModel(PIGEON.vehicle, "su-fan")
    wings = np.asarray(wb.air_forces(model, beat, q, np.array([*velocity, 0, 0, 0]), 0.0).generalised)
    parts = {"tail": vars(TAIL)}, {"tail_tilt": glide.tail_tilt}
    force, place, _ = tail_load(*parts, DENSITY, glide.body_pitch, velocity, 0.0)
    gravity = np.asarray(wb.equations_of_motion(model, beat, q, np.zeros(5), 0.0).gravity_force)
    weight = gravity[1]
    balance = wings[:3] + np.array([*force, moment(force, place)]) - gravity[:3]
    assert np.abs(balance[:2]).max() <= 1e-9 * weight
    assert abs(balance[2]) <= 1e-9 * weight * PIGEON.vehicle.wing.mean_chord
    assert np.hypot(*force) > 1e-3 * weight


def test_without_a_tail_the_trim_tail_says_what_one_would_need():
    glide = wb.glide_polar(PIGEON, angles_of_attack=[np.radians(6.0)], trim="tail").glides[0]
    assert not glide.trimmed
    assert glide.tail_tilt == 0.0 != glide.tail_moment


# --- Flight


def changed_record(record, **fields):
    return unchecked(type(record), vars(record) | fields)


def test_derivatives_by_state_and_numbers_are_those_of_differences():
    model, phase = wb.FlightModel(TAILED.vehicle, "su-fan"), np.array([0.13, 0.4, 0.71])

    def rates(numbers):
        state, (area, arm, slope, drag, height, incidence, tilt) = numbers[:4], numbers[4:]
        tail = changed_record(
            TAIL, area=area, arm=arm, lift_slope=slope, drag_coefficient=drag, height=height, incidence=incidence
        )
        flown = changed(model, vehicle=changed_record(model.vehicle, tail=tail))
        beat = changed_record(TAILED.wingbeat, tail_tilt=tilt)
        pitch_state = jnp.broadcast_to(state[:, None], (4, phase.size))
        return body_rates(flown, motion_table(flown, beat, phase), pitch_state).ravel()

    numbers = np.array([0.3, 8.0, 0.4, 1.5, 0.006, 0.16, 3.0, 0.03, 0.02, -0.1, 0.2])
    steps = np.array([1e-4, 1e-3, 1e-3, 1e-2, 1e-4, 1e-3, 1e-2, 1e-3, 1e-3, 1e-3, 1e-3])
    along = compiled(lambda numbers, direction: jax.jvp(rates, (numbers,), (direction,)))
    exact = np.stack([along(numbers, direction)[1] for direction in np.eye(numbers.size)], axis=-1)
    found = differences(lambda at: np.asarray(along(at, 0.0 * at)[0]), numbers, steps)
    assert of_jacobians(exact, found) <= 1e-7
    assert (np.abs(exact[3:]).max(axis=0) > 0).all()


def test_it_feels_none_of_the_flow_that_the_wings_induce():
    """With inflow a tail adds what it makes of the body's own velocity."""
    q, q_dot = np.array([0, 0, 0.2, 0.3, 0.2]), np.array([8, -1, 2, -20, 5])
    aero = wb.aero.BladeElement("wang", inflow="momentum")
    both = (wb.FlightModel(vehicle, aero, velocity=(8.0, 0.0)) for vehicle in (TAILED.vehicle, PIGEON.vehicle))
    loads = [np.asarray(wb.air_forces(model, PIGEON.wingbeat, q, q_dot, 0.01).generalised) for model in both]
    force, place, _ = tail_load({"tail": vars(TAIL)}, {"tail_tilt": 0.0}, DENSITY, q[2], q_dot[:2], q_dot[2])
    np.testing.assert_allclose((loads[0] - loads[1])[:3], [*force, moment(force, place)], rtol=0, atol=1e-12)
    assert np.abs(force).min() > 1e-2


# --- Orbits


@functools.cache
def orbit(speed, free=False):
    asked = {"free": (*TAILED.free, "tail_tilt"), "bounds": {"tail_tilt": (-0.5, 0.5)}} if free else {}
    return wb.solve_orbit(wb.OrbitProblem(TAILED, speed=speed, **asked), starts=1)


@pytest.mark.slow
@pytest.mark.parametrize("free", [False, True])
@pytest.mark.parametrize("speed", [8.0, 10.0, 12.0])
def test_a_pigeon_with_a_tail_flies_certified(speed, free):
    found = orbit(speed, free)
    assert found.status is wb.Status.CONVERGED, found.message
    record = found.record()
    assert max(map(abs, record["closure"].values())) <= 1e-6
    assert ("tail_tilt" in record["wingbeat"]) == free
    assert record["vehicle"]["tail"] == vars(TAIL)
    if free:
        assert found.wingbeat.frequency <= orbit(speed).wingbeat.frequency * (1 + 1e-6)


@pytest.mark.slow
def test_it_takes_the_divergence_of_the_pigeon_away():
    """Without a tail the largest multiplier at 12 m/s is 1.35."""
    assert max(np.hypot(*m) for m in orbit(12.0).record()["floquet_multipliers"]) < 1.0


@pytest.mark.slow
def test_an_orbit_with_a_tail_is_read_back(tmp_path):
    found = orbit(10.0, free=True)
    found.save(tmp_path / "orbit.nc")
    again = wb.load_orbit(tmp_path / "orbit.nc")
    assert again.problem.vehicle == TAILED.vehicle
    assert again.wingbeat == found.wingbeat
    assert again.problem.free[-1] == "tail_tilt"


def test_its_numbers_are_numbers_of_the_problem():
    problem = wb.OrbitProblem(TAILED.with_values({"wingbeat.tail_tilt_deg": 3.0}), speed=10.0)
    found = {one.path: one for one in parameters_of(problem)}
    assert [path for path in found if path.startswith("tail.")] == [f"tail.{name}" for name in vars(TAIL)]
    assert found["tail.lift_slope"].unit == "1/rad"
    assert found["wingbeat.tail_tilt"].value == pytest.approx(np.radians(3.0))
    assert found["tail.arm"].changed(problem, 0.1).vehicle.tail.arm == 0.1
