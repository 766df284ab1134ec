"""Exact derivatives against finite differences of high order, and stability against flights of SciPy."""

import dataclasses
import functools

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.differences import differences, miss
from tests.helpers.programs import compiled
from tests.helpers.reflight import refly_many
from wingbeat._jax.arrays import jax, jnp
from wingbeat.animal.kinematics import unpack
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.mechanics.state_rates import body_rates
from wingbeat.orbits.flight.certificate import certify, floquet_multipliers
from wingbeat.orbits.flight.period import STEPS, flier
from wingbeat.orbits.nlp.newton_kkt import correct
from wingbeat.orbits.nlp.transcription import Transcription

TOLERANCE = 1e-7


def random_states(count):
    low, high = [-1, -2, -3, -8], [1, 12, 3, 8]
    random = np.random.default_rng(3)
    return zip(random.uniform(low, high, (count, 4)), random.uniform(0, 1, count), strict=True)


ODD_BEAT = wb.Wingbeat(8.0, 0.15, 0.85, 0.20, 0.50, 0.3, 1.6, 0.4, 0.45)
# The laws beyond the paper's have a flight of their own in mechanics/test_wingbeats.py.
FREE = tuple(field.name for field in dataclasses.fields(wb.Wingbeat)[:8])
FREE_VALUES = np.array([getattr(ODD_BEAT, name) for name in FREE])


@functools.cache
def odd_flight(airspeed):
    """Return the numbers of a bat with nothing at zero, and its accelerations as a function.

    The function takes the bat's numbers, the free parameters and the pitch state in one vector, a phase, and a
    direction in which the numbers change; it returns the accelerations and their change.
    """
    bat = wb.load_species("bat").with_values(
        {
            "wing.shoulder": [0.02, 0.01, 0.01],
            "wing.stroke_plane_angle_deg": 75.0,
            "body.drag_area": 1e-3,
            "body.crossflow_area": 0.01,
        }
    )
    model = wb.FlightModel(bat.vehicle, wb.aero.BladeElement(wb.aero.SuFan(), airspeed=airspeed))
    leaves, tree = jax.tree.flatten(model)
    ends = np.cumsum([np.size(leaf) for leaf in leaves] + [FREE_VALUES.size])

    @compiled
    def along(numbers, phase, direction):
        def at(numbers):
            *parts, values, state = jnp.split(numbers, ends)
            flown = [part.reshape(np.shape(leaf)) for part, leaf in zip(parts, leaves, strict=True)]
            beat, flying = unpack(FREE, ODD_BEAT, values), jax.tree.unflatten(tree, flown)
            return body_rates(flying, motion_table(flying, beat, phase), state)

        return jax.jvp(at, (numbers,), (direction,))

    return np.concatenate([np.ravel(leaf) for leaf in leaves]).astype(float), along


def miss_of_accelerations(airspeed, state, phase, those_of_the_model):
    """Return the miss of the derivatives by the model's numbers, or by free parameters and pitch state."""
    own, along = odd_flight(airspeed)
    whole = np.concatenate([own, FREE_VALUES, state])
    these = slice(own.size) if those_of_the_model else slice(own.size, None)

    def function(point):
        moved = whole.copy()
        moved[these] = point
        return np.asarray(along(moved, phase, 0.0 * whole)[0])

    point = whole[these]
    scale = np.where(point == 0, 1.0, np.abs(point)) if those_of_the_model else np.ones_like(point)
    exact = np.stack([along(whole, phase, one)[1] for one in np.eye(whole.size)[these]], axis=-1)
    # So small a step that no strip crosses the joins of a blend, where only two derivatives go on.
    return miss(exact * scale, differences(function, point, 3e-5 * scale) * scale)


@pytest.mark.parametrize("airspeed", wb.aero.AIRSPEEDS)
def test_accelerations_by_state_and_wingbeat(airspeed):
    for state, phase in random_states(20):
        assert miss_of_accelerations(airspeed, state, phase, those_of_the_model=False) <= TOLERANCE


@pytest.mark.parametrize("airspeed", wb.aero.AIRSPEEDS)
def test_accelerations_by_every_number_of_vehicle_air_and_coefficients(airspeed):
    for state, phase in random_states(3):
        assert miss_of_accelerations(airspeed, state, phase, those_of_the_model=True) <= TOLERANCE


def unknowns_of(solved):
    free = [getattr(solved.wingbeat, name) for name in solved.problem.free]
    return np.array([*solved.start[2:], *free])


def near(solved):
    """Return the orbit's unknowns and a point near them, off the optimum and its bounds."""
    orbit = unknowns_of(solved)
    return orbit, orbit * np.random.default_rng(4).uniform(0.95, 0.99, orbit.size)


@pytest.mark.parametrize("blocks", [1, 3])
def test_end_and_path_of_a_period(solved, blocks):
    problem = solved.problem
    fly = flier(solved.model, solved.problem.species.wingbeat, problem.free, whole_path=True)
    pitch_alone = flier(solved.model, solved.problem.species.wingbeat, problem.free)
    for point in near(solved):
        found = fly(point[4:], point[:4], blocks)
        np.testing.assert_allclose(pitch_alone(point[4:], point[:4], blocks).path, found.path[:, :1], rtol=1e-12)

        def flown(values):
            period = fly(values[4:], values[:4], blocks)
            return np.concatenate([period.end, period.path.ravel()])

        # So small a step that few strips cross the joins of a blend, where only two derivatives go on.
        wanted = differences(flown, point, 2e-6)
        assert miss(found.end_jacobian, wanted[:6]) <= TOLERANCE
        assert found.path_jacobian.shape == (blocks * STEPS + 1, 4, point.size)
        # Over the largest derivative on the whole path: at phase 0 most of them are zero.
        components = wanted[6:].reshape(-1, 4, point.size).swapaxes(0, 1)
        for one, other in zip(found.path_jacobian.swapaxes(0, 1), components, strict=True):
            assert np.abs(one - other).max() <= TOLERANCE * np.abs(one).max()


def test_closure_margins_and_objective_of_the_programme(solved):
    programme = Transcription(solved.problem)
    point = programme.scaled(near(solved)[1])

    def compare(exact, function, tolerance=TOLERANCE):
        assert miss(exact, differences(function, point, 1e-5)) <= tolerance

    compare(programme.closure_jacobian(point), programme.closure)
    # Where in the beat a wing is nearest to a limit is found by two steps of Newton's method.
    compare(programme.inequalities_jacobian(point), programme.inequalities, 1e-6)
    gradient = programme.objective_gradient(point)
    compare(gradient[None], lambda x: np.array([programme.objective(x)]))


def test_a_closure_that_forgets_the_length_of_the_period_is_seen(bat_orbit):
    """The distance to travel shortens with the frequency; without that column the comparison must fail."""
    programme = Transcription(bat_orbit.problem)
    point = programme.scaled(near(bat_orbit)[1])
    column = 4 + bat_orbit.problem.free.index("frequency")
    wrong = programme.closure_jacobian(point).copy()
    wrong[0, column] *= 1 + 1e-6
    wanted = differences(programme.closure, point, 1e-5)
    assert miss(wrong[:, [column]], wanted[:, [column]]) > TOLERANCE


def reflown_monodromy(solved, step=1e-4):
    """Return the derivative of (body_pitch, u, w, pitch_rate) after a beat by fourth-order differences."""
    unit = np.eye(6)[2:]
    starts = solved.start + step * np.concatenate([unit, -unit, 2 * unit, -2 * unit])
    ends = refly_many(solved.model, solved.wingbeat, starts)[:, 2:].reshape(4, 4, 4)
    return ((8 * (ends[0] - ends[1]) - (ends[2] - ends[3])) / (12 * step)).T


def in_order(multipliers):
    return np.array(sorted(multipliers, key=lambda m: (-round(abs(m), 6), -m.imag)))


def multipliers(solved):
    return np.array([complex(*pair) for pair in solved.orbit.record()["floquet_multipliers"]])


@pytest.mark.slow
def test_floquet_multipliers_agree_with_flights_of_scipy(solved):
    found = in_order(np.linalg.eigvals(reflown_monodromy(solved)))
    np.testing.assert_allclose(in_order(multipliers(solved)), found, rtol=0, atol=1e-5)
    assert solved.orbit.record()["stable"] is bool(np.abs(found).max() < 1)


def test_a_neighbour_of_an_orbit_has_other_multipliers(solved):
    """The comparisons of multipliers here see a change of a thousandth of a radian."""
    other = dataclasses.replace(solved.wingbeat, pitch_amplitude=solved.wingbeat.pitch_amplitude + 1e-3)
    neighbour = floquet_multipliers(solved.model, other, certify(solved.model, other, solved.start[2:]).steps)
    assert np.abs(in_order(neighbour) - in_order(multipliers(solved))).max() > 1e-5


def test_a_flight_that_tumbles_off_has_no_multipliers(solved):
    steps = certify(solved.model, solved.wingbeat, solved.start[2:]).steps
    assert steps.phase[-1] == 1.0
    assert len(steps.phase) > 64  # more than one block of lanes
    short = steps._replace(phase=steps.phase[:-1], states=steps.states[:-1])
    states = steps.states.copy()
    states[5] = np.inf
    for broken in (short, steps._replace(states=states)):
        assert np.isnan(floquet_multipliers(solved.model, solved.wingbeat, broken)).all()


def test_multipliers_do_not_depend_on_the_steps_they_are_found_with(solved):
    """Fixed-step tangents of the same orbit come to the recorded multipliers as their steps get finer."""
    beat, free = solved.wingbeat, solved.problem.free
    values = np.array([getattr(beat, name) for name in free])
    fly, gaps = flier(solved.model, beat, free), []
    for blocks in (4, 32, 128):
        found = fly(values, solved.start[2:], blocks)
        mine = in_order(np.linalg.eigvals(np.asarray(found.end_jacobian)[2:, :4]))
        gaps.append(np.abs(mine - in_order(multipliers(solved))).max())
    assert max(gaps[1:]) <= 1e-5
    assert gaps[1] < gaps[0]


def test_the_number_of_steps_of_the_search_does_not_change_the_orbit(solved):
    """Searched again with finer steps from where it stands, the frequency stays, and so do the multipliers.

    These less exactly: the frequency hardly tells how the wing should be pitched.
    """
    programme = Transcription(solved.problem)
    fly = programme.fly
    programme.fly = lambda values, start, blocks=1: fly(values, start, 4 * blocks)
    scaled, _ = programme.optimise(programme.scaled(unknowns_of(solved)), 60, 1e-6)
    found = correct(programme, scaled)
    assert np.abs(found.residual).max() <= 1e-6
    assert found.wingbeat.frequency == pytest.approx(solved.wingbeat.frequency, rel=1e-7)
    found_multipliers = floquet_multipliers(solved.model, found.wingbeat, found.certificate.steps)
    mine, theirs = in_order(found_multipliers), in_order(multipliers(solved))
    assert np.abs(mine - theirs).max() <= 3e-4 * max(1.0, np.abs(theirs).max())
