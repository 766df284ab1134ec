"""The linear flight from beat to beat against flights by SciPy, the certificate and glides with closed answers."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.linalg import expm

import wingbeat as wb
from tests.helpers.programs import compiled
from tests.helpers.reflight import dop853, refly_many
from wingbeat._jax.arrays import jax
from wingbeat.animal.kinematics import parameter, with_parameters
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.mechanics.flights import state_rates
from wingbeat.mechanics.glide import held_still
from wingbeat.mechanics.state_rates import body_rates
from wingbeat.orbits.flight.certificate import certify, stroke_map
from wingbeat.stability.linear_flight import averaged_jacobian, averaged_modes, modes_of

# Steps of differences of flights by SciPy: (z, body_pitch, u, w, pitch_rate), and of the wingbeat's parameters.
STEPS = np.array([1e-3, 1e-5, 1e-4, 1e-4, 1e-4])
GUSTS = np.array([[1e-4, 0.0], [0.0, 1e-4]])


@pytest.fixture(params=["pigeon_orbit", "bat_orbit"])
def solved(request):
    return request.getfixturevalue(request.param)


def by_differences(solved, changes):
    """Return central differences of the end of a beat by changes of its start, shape (changes, 6)."""
    starts = np.concatenate([solved.start + changes, solved.start - changes])
    ends = refly_many(solved.model, solved.wingbeat, starts)
    return (ends[: len(changes)] - ends[len(changes) :]) / 2


def test_the_map_is_that_of_differences_of_flights_by_scipy(solved):
    found = wb.linearise(solved.orbit, height=True)
    changes = np.zeros((5, 6))
    changes[:, 1:] = np.diag(STEPS)
    differences = (by_differences(solved, changes)[:, 1:] / STEPS[:, None]).T
    assert found.state == ("z", "body_pitch", "u", "w", "pitch_rate")
    assert np.abs(found.A - differences).max() < 1e-4 * np.abs(differences).max()


@compiled
def _rates_in_wind(model, wingbeat, phase, states, winds):
    def one(state, wind):
        moving = state.at[3:5].add(-wind)
        return state_rates(model, wingbeat, phase, moving).at[:2].add(wind)

    return jax.vmap(one)(states, winds) / wingbeat.frequency


def test_a_gust_acts_as_in_flights_through_moving_air_by_scipy(solved):
    found = wb.linearise(solved.orbit, height=True)
    winds = np.concatenate([GUSTS, -GUSTS])
    starts = np.tile(solved.start, (4, 1))

    def rates(phase, y):
        flown = _rates_in_wind(solved.model, solved.wingbeat, np.asarray(phase), y.reshape(4, 6), winds)
        return np.asarray(flown).ravel()

    ends = dop853(rates, (0.0, 1.0), starts.ravel(), rtol=1e-13).reshape(4, 6)
    differences = ((ends[:2] - ends[2:]) / 2e-4)[:, 1:].T
    assert np.abs(found.G - differences).max() < 1e-4 * np.abs(found.G).max()
    alone = wb.linearise(solved.orbit)
    assert np.allclose(alone.G, (np.eye(4) - alone.A)[:, 1:3], rtol=0, atol=1e-15)


@pytest.mark.slow
def test_inputs_act_as_in_flights_of_changed_wingbeats_by_scipy(pigeon_orbit):
    solved = pigeon_orbit
    inputs = dict.fromkeys(("flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude"), 1e-5) | {
        "frequency": 1e-4
    }
    found = wb.linearise(solved.orbit)
    names = (*found.inputs, *found.compensation.names)
    numbers = np.array([parameter(solved.wingbeat, name) for name in names])
    for name, step in inputs.items():
        column = found.inputs.index(name)
        shares = np.concatenate([np.eye(len(found.inputs))[column], found.compensation.shares[:, column]])
        ends = []
        for sign in (1.0, -1.0):
            changed = dict(zip(names, (numbers + sign * step * shares).tolist(), strict=True))
            ends.append(refly_many(solved.model, with_parameters(solved.wingbeat, changed), solved.start[None])[0])
        difference = (ends[0] - ends[1])[2:] / (2 * step)
        assert np.abs(found.B[:, column] - difference).max() < 2e-4 * np.abs(difference).max(), name


def test_a_bat_that_folds_keeps_its_frequency(bat_orbit):
    assert wb.linearise(bat_orbit.orbit).inputs == ("flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude")


def test_the_multipliers_are_those_of_the_certificate(solved):
    found = wb.linearise(solved.orbit)
    certified = np.array([complex(*pair) for pair in solved.orbit.record()["floquet_multipliers"]])
    ours = np.linalg.eigvals(found.A)
    for multiplier in certified:
        assert np.abs(ours - multiplier).min() < 1e-4 * np.abs(certified).max()
    assert found.spectral_radius == pytest.approx(np.abs(certified).max(), rel=1e-4)
    assert found.record()["stable"] is solved.orbit.record()["stable"] is bool(np.abs(certified).max() < 1)


def test_a_pigeon_in_cruise_has_the_known_modes():
    orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0))
    found = wb.linearise(orbit)
    divergence, oscillation, subsidence = found.modes
    assert [mode.kind for mode in found.modes] == ["divergence", "oscillation", "subsidence"]
    assert divergence.multiplier == pytest.approx(1.346, abs=5e-4)
    assert divergence.time_to_double == pytest.approx(0.245, abs=5e-4)
    assert abs(oscillation.multiplier) == pytest.approx(0.901, abs=5e-4)
    assert oscillation.period == pytest.approx(4.55, abs=0.01)
    assert oscillation.damping == pytest.approx(0.58, abs=0.005)
    assert subsidence.multiplier == pytest.approx(0.648, abs=5e-4)


@pytest.mark.parametrize(
    ("animal", "speed", "shoulder", "radius", "averaged"),
    [
        ("pigeon", 12.0, [0.0, 0.035, 0.0112], 0.979, None),
        ("pigeon", 12.0, [0.0056, 0.035, 0.0], 2.106, None),
        ("bat", 5.0, None, 0.971, 1.402),
    ],
)
def test_the_numbers_of_the_page_on_stability(animal, speed, shoulder, radius, averaged):
    species = wb.load_species(animal)
    if shoulder is not None:
        species = species.with_values({"wing.shoulder": shoulder})
    found = wb.linearise(wb.solve_orbit(wb.OrbitProblem(species, speed=speed)))
    assert found.spectral_radius == pytest.approx(radius, abs=6e-4)
    if averaged is not None:
        assert abs(found.averaged_modes[0].multiplier) == pytest.approx(averaged, abs=6e-4)


@pytest.fixture(scope="module")
def glider():
    """A pigeon with a tail of 0.15 of the wing's area at 1.5 chords, in a trimmed glide at 12 m/s."""
    pigeon = wb.load_species("pigeon")
    wing = pigeon.vehicle.wing
    tail = {"area": 0.15 * 2 * wing.semi_span * wing.mean_chord, "arm": 1.5 * wing.mean_chord, "lift_slope": 3.6}
    species = pigeon.with_values({f"tail.{name}": value for name, value in tail.items()})
    polar = wb.glide_polar(species, trim="tail")
    glide = min(polar.glides, key=lambda one: abs(one.speed - 12.0))
    still = dataclasses.replace(
        held_still(species.wingbeat),
        frequency=5.0,
        flap_mean=glide.flap,
        pitch_mean=glide.wing_pitch,
        tail_tilt=glide.tail_tilt,
    )
    velocity = glide.speed * math.cos(glide.glide_angle), -glide.sink
    model = wb.FlightModel(species.vehicle, polar.aero, species.air)
    return model, still, np.array([glide.body_pitch, *velocity, 0.0]), glide


@pytest.mark.slow
def test_still_wings_give_the_exponential_of_the_rates(glider):
    model, still, state, _ = glider
    found = stroke_map(model, still, state, ("flap_mean",), blocks=12)

    def rates(at):
        return body_rates(model, motion_table(model, still, 0.0), at)

    assert np.abs(rates(state)).max() < 1e-9
    jacobian = np.asarray(jax.jacfwd(rates)(state))
    assert np.abs(found.by_state[1:, 1:] - expm(jacobian / still.frequency)).max() < 1e-8
    assert np.allclose(found.transition[-1], found.by_state[1:, 1:], rtol=0, atol=1e-14)


def test_the_phugoid_of_a_glider_is_within_a_tenth_of_lanchesters(glider):
    model, still, state, glide = glider
    found = stroke_map(model, still, state, ("flap_mean",), blocks=12)
    modes = modes_of(found.by_state[1:, 1:], still.frequency, found.transition, np.array([1.0, 12.0, 12.0, 5.0]))
    slow = min((mode for mode in modes if mode.kind == "oscillation"), key=lambda mode: mode.damping)
    assert slow.period == pytest.approx(math.sqrt(2) * math.pi * glide.speed / model.air.gravity, rel=0.1)
    assert slow.shares["pitch_rate"] < min(slow.shares["u"], slow.shares["w"])


def test_a_small_mode_grows_in_flight_as_its_multiplier_says(pigeon_orbit):
    found = wb.linearise(pigeon_orbit.orbit)
    mode = found.modes[0]
    flight = found.mode_flight(0, size=1e-6, beats=2)
    undisturbed = found.mode_flight(0, size=0.0, beats=2)
    apart = (flight.states - undisturbed.states)[:: len(flight.phase) // 2, 2:]
    assert np.allclose(apart[1], mode.multiplier.real * apart[0], rtol=0, atol=2e-3 * np.abs(apart[0]).max())


@pytest.mark.slow
def test_the_averaged_model_is_the_mean_of_the_rates_derivatives(pigeon_orbit):
    model, beat = pigeon_orbit.model, pigeon_orbit.wingbeat
    phase = np.linspace(0.0, 1.0, 9)
    path = certify(model, beat, pigeon_orbit.start[2:]).states[::32, 2:]
    found = averaged_jacobian(model, beat, path)

    def rates(state, at):
        return np.asarray(state_rates(model, beat, at, np.concatenate([np.zeros(2), state])))[2:]

    columns = []
    for step in 1e-6 * np.eye(4):
        moved = [rates(s + step, at) - rates(s - step, at) for s, at in zip(path[:-1], phase[:-1], strict=True)]
        columns.append(np.mean(moved, axis=0) / 2e-6)
    assert np.allclose(found, np.transpose(columns), rtol=1e-5, atol=1e-5 * np.abs(found).max())


def test_with_still_wings_the_averaged_model_is_exact(glider):
    model, still, state, _ = glider
    found = stroke_map(model, still, state, ("flap_mean",), blocks=12)
    scales = np.ones(4)
    modes = averaged_modes(averaged_jacobian(model, still, found.path), still.frequency, 9, scales)
    true = modes_of(found.by_state[1:, 1:], still.frequency, found.transition, scales)
    assert [mode.kind for mode in modes] == [mode.kind for mode in true]
    assert np.allclose([m.multiplier for m in modes], [m.multiplier for m in true], rtol=0, atol=1e-7)


def test_control_takes_the_linear_flight(pigeon_orbit):
    control = pytest.importorskip("control")
    found = wb.linearise(pigeon_orbit.orbit, height=True)
    system = found.to_control()
    assert system.nstates == 5
    assert system.input_labels == [*found.inputs, "gust_u", "gust_w"]
    start = np.array([0.0, 1e-3, 0.0, 0.0, 0.0])
    reached = control.initial_response(system, np.arange(3) * found.dt, start).states[:, -1]
    assert np.allclose(reached, found.A @ found.A @ start, rtol=1e-12, atol=1e-15)


def test_faults_are_named(pigeon_orbit):
    orbit = pigeon_orbit.orbit
    for inputs, rule in (
        (["frequncy"], "did you mean frequency"),
        (["lift"], "is not a parameter of the wingbeat; give a parameter"),
        (5, "must be a list"),
        ([["frequency"]], "must be a list"),
        (["tail_tilt"], "changes nothing, because there is no tail"),
        ("frequency", "must be a list"),
        ([], "must be a list"),
        (["frequency", "frequency"], "has a name twice"),
        (["stroke_plane_tilt"], "makes the stroke plane jump"),
    ):
        with pytest.raises(wb.InvalidInputError, match=rule):
            wb.linearise(orbit, inputs)
    found = wb.linearise(orbit)
    with pytest.raises(wb.InvalidInputError, match="index"):
        found.mode_flight(9)
    with pytest.raises(wb.InvalidInputError, match="size"):
        found.mode_flight(0, size=math.nan)
    heavy = wb.load_species("pigeon").with_values({"body.mass": 3.0})
    lost = wb.solve_orbit(wb.OrbitProblem(heavy, speed=3.0), starts=1)
    with pytest.raises(wb.InvalidInputError, match="is not certified"):
        wb.linearise(lost)
    with pytest.raises(wb.InvalidInputError, match="does not close when this version flies it"):
        wb.linearise(orbit, options=wb.LinearOptions(closure=1e-12))
    with pytest.raises(wb.InvalidInputError, match="LinearOptions"):
        wb.LinearOptions(blocks=0)


def test_a_hovering_hummingbird_is_linearised_like_any_other_orbit():
    orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("annas-hummingbird"), speed=0.0), starts=2)
    assert orbit.status is wb.Status.CONVERGED
    found = wb.linearise(orbit)
    certified = sorted(abs(complex(*pair)) for pair in orbit.record()["floquet_multipliers"])
    assert sorted(np.abs(np.linalg.eigvals(found.A))) == pytest.approx(certified, abs=1e-4)
    start, changes = np.array(orbit.initial_state, dtype=float), np.zeros((4, 6))
    changes[:, 2:] = np.diag(STEPS[1:])
    model, beat = orbit.problem.model, orbit.wingbeat
    ends = refly_many(model, beat, np.concatenate([start + changes, start - changes]))
    differences = ((ends[:4] - ends[4:]) / 2)[:, 2:].T / STEPS[1:]
    assert np.abs(found.A - differences).max() < 1e-4 * np.abs(differences).max()
