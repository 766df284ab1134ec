"""Feedback from beat to beat: its linear loop in whole flights, gusts, delay, noise, and what it refuses."""

import json
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.stability.test_inputs import at_top

SCALES = np.array([0.2, 0.1, 1.0, 1.0, 2.0])


def tops(orbit, beats, **asked):
    """Return deviations of (z, body_pitch, u, w, pitch_rate) from the start at all tops of the stroke."""
    start = asked.pop("start", orbit.initial_state)
    flown = wb.simulate(orbit.problem.model, orbit.wingbeat, start, beats, 16, **asked)
    return (flown.states[::16] - np.array(orbit.initial_state))[:, 1:]


def test_the_loop_without_delay_is_the_riccati_solution_of_the_linear_flight(held, cruise):
    flight = wb.linearise(cruise, height=True)
    weights = np.diag(1 / SCALES**2)
    units = np.array([0.5, *[math.radians(3)] * 4])
    costs = np.diag(1 / units**2)
    A, B, P, K = flight.A, flight.B, held.cost, held.gains
    assert held.inputs == ("frequency", "flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude")
    residual = A.T @ P @ A - P - A.T @ P @ B @ K + weights
    assert np.abs(residual).max() < 1e-8 * np.abs(P).max()
    assert np.allclose((costs + B.T @ P @ B) @ K, B.T @ P @ A, rtol=1e-9)
    loop = np.sort(np.abs(np.linalg.eigvals(A - B @ K)))[::-1]
    assert np.allclose(np.abs(held.multipliers), loop, rtol=1e-9)
    assert held.spectral_radius == pytest.approx(loop[0])
    assert held.spectral_radius < 1 < held.flight.spectral_radius == pytest.approx(1.346, abs=1e-3)
    assert np.allclose(held.upper, 4 * units)
    assert np.allclose(held.lower, -4 * units)


@pytest.mark.parametrize(("delay", "late"), [(0, 0), (1, 0), (0, 1), (2, 0)])
def test_small_deviations_fly_as_the_linear_loop_says(cruise, delay, late):
    found = wb.feedback(cruise, delay=delay)
    ago = ["2 beats ago", "1 beat ago"][2 - delay :]
    assert found.gain_columns == (
        *found.flight.state,
        *(f"{name}, {when}" for when in ago for name in found.inputs),
    )
    A, B = found.flight.A, found.flight.B
    small = 1e-5 * np.array([1.0, -0.5, 2.0, 1.0, 3.0])  # z shifts with the start and is not seen
    flown = tops(
        cruise,
        4,
        start=wb.State(*(np.array(cruise.initial_state) + np.r_[0.0, small])),
        controller=found.controller(late=late),
    )
    still = tops(cruise, 4, controller=found.controller(late=late))
    state, waiting = np.r_[0.0, small[1:]], [np.zeros(B.shape[1])] * (delay + late)
    for beat in range(4):
        known = np.concatenate([state, *waiting[late:]])
        waiting = [*waiting, -found.gains @ known]
        state = A @ state + B @ waiting[0]
        waiting = waiting[1:]
        apart = (flown - still)[beat + 1] - np.r_[small[0], np.zeros(4)]
        assert np.abs((apart - state) / SCALES).max() < 3e-3 * np.abs(small / SCALES).max(), beat


def test_a_climbing_orbit_is_held_on_its_path():
    problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, climb=1.0)
    orbit = wb.solve_orbit(problem, starts=2)
    found = wb.feedback(orbit)
    step = 1e-4
    changes = np.array([step, *[0.0] * 4])
    ends = []
    for sign in (1.0, -1.0):
        beat = found.wingbeat(sign * changes)
        end = wb.simulate(problem.model, beat, orbit.initial_state, 1, 16).states[-1, 1]
        ends.append(end - orbit.initial_state.z - 1.0 / beat.frequency)
    slow = wb.simulate(problem.model, orbit.wingbeat, orbit.initial_state, 1, 16).states[-1, 1]
    assert slow - orbit.initial_state.z == pytest.approx(1.0 / orbit.wingbeat.frequency, abs=1e-6)
    loop = (
        found.flight.A
        - (found.flight.B + np.eye(5)[:, :1] / orbit.wingbeat.frequency**2 * np.eye(5)[0]) @ found.gains
    )
    assert (ends[0] - ends[1]) / (2 * step) == pytest.approx(
        found.flight.B[0, 0] + 1.0 / orbit.wingbeat.frequency**2, rel=1e-3
    )
    assert np.allclose(np.sort(np.abs(np.linalg.eigvals(loop))), np.sort(np.abs(found.multipliers)), rtol=1e-6)
    hold = found.controller()
    gust = wb.winds.CosineGust(w=2.0, duration=0.2)
    flown = wb.simulate(problem.model, orbit.wingbeat, orbit.initial_state, 60, 16, wind=gust, controller=hold)
    above = flown.states[::16, 1] - flown.time[::16]
    assert np.abs(above).max() > 0.02
    assert np.abs(above[-1]) < 0.01


@pytest.mark.parametrize("gust", [3.0, -3.0])
def test_it_saves_the_pigeon_from_gusts_that_tumble_it(cruise, held, patient, gust):
    wind = wb.winds.CosineGust(w=gust, duration=0.2)
    alone = tops(cruise, 30, wind=wind)
    assert np.abs(alone[:, 1]).max() > math.radians(90)
    for found, most, beats in ((held, 12.0, 5), (patient, 18.0, 11)):
        saved = tops(cruise, 30, wind=wind, controller=found.controller())
        assert np.abs(saved[:, 1]).max() < math.radians(most)
        assert np.abs(saved[:, 0]).max() < 0.3
        # Half a scale of attitude and velocities counts as settled; the gust has passed after 1.9 beats.
        assert np.abs(saved[2 + beats :, 1:] / SCALES[1:]).max() < 0.5


def test_gains_for_no_delay_are_unstable_with_one(cruise, held, patient):
    assert np.abs(held.multipliers_if_late(1)[0]) > 1.2
    assert patient.spectral_radius < 1
    gust = wb.winds.CosineGust(w=1.0, duration=0.2)
    late = tops(cruise, 30, wind=gust, controller=held.controller(late=1))
    assert np.abs(late[:, 1]).max() > math.radians(90)
    assert np.abs(tops(cruise, 30, wind=gust, controller=patient.controller())[:, 1]).max() < math.radians(10)


def test_the_wing_does_not_jump_and_inputs_keep_their_limits(cruise):
    held = wb.feedback(cruise, options=wb.FeedbackOptions(reach=1.0))
    hold = held.controller()
    gust = wb.winds.CosineGust(u=-5.0, w=6.0, duration=0.3)
    flown = wb.simulate(
        cruise.problem.model, cruise.wingbeat, cruise.initial_state, 12, 16, wind=gust, controller=hold
    )
    taken = np.array(hold.commands)
    assert taken.shape == (12, 5)
    assert (taken >= held.lower - 1e-15).all()
    assert (taken <= held.upper + 1e-15).all()
    assert (taken == held.upper).any()
    assert (taken == held.lower).any()
    for beat in flown.wingbeats:
        assert np.abs(at_top(beat) - at_top(cruise.wingbeat)).max() < 1e-7


def test_a_controller_forgets_the_flight_before(cruise, patient):
    hold = patient.controller(noise={"body_pitch": 0.01, "z": 0.02}, seed=4)
    gust = wb.winds.CosineGust(w=2.0, duration=0.2)
    first, again = (tops(cruise, 6, wind=gust, controller=hold) for _ in range(2))
    assert np.array_equal(first, again)
    higher = tops(cruise, 6, wind=gust, controller=hold, start=cruise.initial_state._replace(x=5.0, z=7.0))
    assert np.allclose(higher - [7.0, 0, 0, 0, 0], first, rtol=0, atol=1e-7)


def test_noise_has_its_size(cruise, held):
    sizes = {"body_pitch": 0.02, "w": 0.3}
    hold = held.controller(noise=sizes, seed=2)
    start = cruise.initial_state
    first = []
    for seed in range(300):
        hold.seed = seed
        hold(0, start)
        first.append(hold.commands[0])
    spread = np.cov(np.transpose(first))
    by_noise = held.gains[:, [1, 3]] * np.array([0.02, 0.3])
    assert np.allclose(spread, by_noise @ by_noise.T, rtol=0.25, atol=0.05 * np.abs(by_noise @ by_noise.T).max())
    assert hold(0, wb.State(*[math.nan] * 6)) == held.wingbeat(np.zeros(5))  # tumbled


def test_weights_and_limits_are_by_name(cruise, held):
    calm = wb.feedback(
        cruise, ["pitch_mean", "frequency"], weights={"pitch_mean": 1e6}, limits={"pitch_mean": 0.05}
    )
    assert np.abs(calm.gains[0]).max() < 0.1 * np.abs(held.gains[3]).max()
    assert calm.upper.tolist() == [0.05, 2.0]
    assert calm.lower.tolist() == [-0.05, -2.0]
    units = wb.feedback(cruise, options=wb.FeedbackOptions(reach=2.0, angle=0.01))
    assert units.upper.tolist() == [1.0, *[0.02] * 4]


def test_what_reaches_which_mode_is_the_left_eigenvector_times_the_input(held):
    units = np.array([0.5, *[math.radians(3)] * 4])
    A = held.flight.A * SCALES / SCALES[:, None]
    B = held.flight.B * units / SCALES[:, None]
    kinds = [mode.kind for mode in held.controllability]
    assert kinds == ["divergence", "height", "oscillation", "subsidence"]
    for mode in held.controllability:
        pencil = np.hstack([A - mode.multiplier * np.eye(5), B * 0])
        assert np.linalg.matrix_rank(pencil, tol=1e-8) == 4
        for column, name in enumerate(held.inputs):
            left = np.linalg.svd(A - mode.multiplier * np.eye(5))[0][:, -1].conj()
            assert mode.effects[name] == pytest.approx(abs(left @ B[:, column]), rel=1e-5)
    assert set(held.sufficient) == set(held.inputs)
    alone = wb.feedback(held.flight.orbit, ["pitch_mean"])
    assert alone.spectral_radius < 1


def test_a_bats_amplitude_cannot_become_negative(bat_orbit):
    found = wb.feedback(bat_orbit.orbit)
    amplitude = bat_orbit.wingbeat.pitch_amplitude
    i = found.inputs.index("pitch_amplitude")
    assert found.lower[i] == pytest.approx(-min(amplitude, math.radians(12)))
    assert found.upper[i] == pytest.approx(math.radians(12))
    assert found.wingbeat(found.lower).pitch_amplitude == pytest.approx(amplitude + found.lower[i], abs=1e-15)


def test_the_record_is_json(patient):
    record = json.loads(json.dumps(patient.record(), allow_nan=False))
    assert np.shape(record["gains"]) == (5, 10)
    assert record["spectral_radius"] < 1 < record["open_loop"]["spectral_radius"]
    assert record["delay"] == 1
    assert record["controllability"][0]["kind"] == "divergence"
    assert set(record["upper"]) == set(record["inputs"])


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"inputs": ["flaping"]}, "inputs = 'flaping': is not a parameter of the wingbeat"),
        ({"delay": 0.5}, "delay = 0.5: must be a whole number from 0 to 4; commands act in the same beat"),
        ({"delay": -1}, "delay = -1: must be a whole number"),
        ({"delay": True}, "delay = True"),
        ({"weights": {"pich": 2.0}}, "weights = 'pich': names neither a state nor an input.*did you mean"),
        ({"weights": {"z": 0.0}}, "weights.z = 0.0: must be > 0"),
        ({"weights": 2.0}, "weights = 2.0: must be numbers by name"),
        ({"limits": {"pitch_mean": 0.0}}, "limits.pitch_mean = 0.0: must be > 0"),
        ({"limits": {"pitch_mean": -0.1}}, "limits.pitch_mean = -0.1"),
        ({"limits": {"pitch_mean": math.nan}}, "limits.pitch_mean = nan: must be finite"),
        ({"limits": {"sweep": 0.1}}, "limits = 'sweep': is not an input of this feedback"),
        ({"limits": [0.1]}, "must be numbers by name"),
        (
            {"limits": {"pitch_amplitude": 2.0}},
            "lets pitch_amplitude reach .*a wingbeat allows 0 to inf; give at most",
        ),
        ({"limits": {"frequency": 20.0}}, "lets frequency reach"),
        ({"inputs": ["sweep_mean"], "limits": {"sweep_mean": 2.0}}, "leads to no wingbeat"),
    ],
)
def test_bad_input_gets_its_sentence(cruise, asked, said):
    with pytest.raises(wb.InvalidInputError, match=said):
        wb.feedback(cruise, **asked)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"noise": {"x": 0.1}}, "noise = 'x'"),
        ({"noise": {"w": -0.1}}, "noise.w = -0.1: must be >= 0; give a standard deviation"),
        ({"seed": 1.5}, "seed = 1.5"),
        ({"late": 0.5}, "late = 0.5"),
    ],
)
def test_bad_noise_gets_its_sentence(held, asked, said):
    with pytest.raises(wb.InvalidInputError, match=said):
        held.controller(**asked)


def test_an_orbit_that_is_not_certified_is_refused():
    heavy = wb.load_species("pigeon").with_values({"body.mass": 3.0})
    lost = wb.solve_orbit(wb.OrbitProblem(heavy, speed=3.0), starts=1)
    with pytest.raises(wb.InvalidInputError, match="is not certified"):
        wb.feedback(lost)
    with pytest.raises(wb.InvalidInputError, match="is not certified"):
        wb.simulate_many(lost, [(0.0, 1.0)])
