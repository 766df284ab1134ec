"""Feedback several times a beat: its maps against flights of segments, bumps without jumps, gusts on a bat."""

import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.animal.kinematics import flap_angle, pitch_angle, with_parameters
from wingbeat.mechanics.flights import fly_through
from wingbeat.stability.real_time import _phases_of

SCALES = np.array([0.2, 0.1, 1.0, 1.0, 2.0])
SEGMENTS = 4


@pytest.fixture(scope="module")
def bat():
    """The paper's bat, whose disturbances are multiplied by 4.3 in each beat."""
    orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("bat"), speed=8.0), starts=2)
    return wb.feedback_in_beat(orbit, SEGMENTS)


def flown(found, j, change, bumps):
    """Return (z, body_pitch, u, w, pitch_rate) at the end of a segment that starts near the orbit."""
    start = wb.State(0.0, *(found.path[j] + change).tolist())
    phases = np.linspace(found.phases[j], found.phases[j + 1], 9)
    states, _ = fly_through(found.orbit.problem.model, found.wingbeat(bumps), start, phases)
    return states[-1, 1:]


@pytest.mark.slow
def test_the_maps_are_those_of_differences_of_flights(bat):
    step, still = 1e-5, np.zeros(2)
    for j in range(SEGMENTS):
        assert np.abs((flown(bat, j, np.zeros(5), still) - bat.path[j + 1]) / SCALES).max() < 1e-3
        by_state = [
            (flown(bat, j, step * one, still) - flown(bat, j, -step * one, still)) / (2 * step) for one in np.eye(5)
        ]
        by_bumps = [
            (flown(bat, j, np.zeros(5), step * one) - flown(bat, j, np.zeros(5), -step * one)) / (2 * step)
            for one in np.eye(2)
        ]
        assert np.abs(bat.A[j] - np.transpose(by_state)).max() < 2e-3 * np.abs(bat.A[j]).max()
        assert np.abs(bat.B[j] - np.transpose(by_bumps)).max() < 2e-3 * np.abs(bat.B[j]).max()


@pytest.mark.slow
def test_the_segments_make_the_map_of_a_beat(bat):
    whole = np.linalg.multi_dot(bat.A[::-1])
    flight = wb.linearise(bat.orbit, height=True)
    assert np.abs(whole - flight.A).max() < 1e-5 * np.abs(flight.A).max()
    assert bat.spectral_radius < 1 < flight.spectral_radius


@pytest.mark.parametrize("downstroke", [0.5, 0.4])
def test_bumps_begin_and_end_without_a_jump(bat, downstroke):
    changed = with_parameters(bat.wingbeat(np.array([0.1, -0.2])), {"downstroke_fraction": downstroke})
    beat = with_parameters(bat.orbit.wingbeat, {"downstroke_fraction": downstroke})
    step, ends = 1e-6, _phases_of(beat, SEGMENTS)
    for law, bump in ((flap_angle, 0.1), (pitch_angle, -0.2)):
        for end in ends:
            apart = [float(law(changed, end + at) - law(beat, end + at)) for at in (-step, 0.0, step)]
            assert abs(apart[1]) < 1e-6
            assert abs(apart[2] - apart[0]) / (2 * step) < 1e-3  # a bump has slopes of up to 2.5
        between = np.linspace(ends[1], ends[2], 101)
        apart = np.asarray(law(changed, between) - law(beat, between))
        assert np.abs(apart).max() == pytest.approx(abs(bump), rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("gust", [2.0, -2.0])
def test_it_holds_the_bat_that_feedback_from_beat_to_beat_does_not(bat, gust):
    assert wb.linearise(bat.orbit).spectral_radius > 4
    wind = wb.winds.CosineGust(w=gust, duration=0.2)
    held = bat.fly(wind, 20)
    assert held.states.shape == (20 * SEGMENTS + 1, 6)
    assert np.abs(held.deviations[:, 1]).max() < math.radians(15)
    assert np.abs(held.deviations[:, 0]).max() < 0.3
    assert np.abs(held.deviations[-1] / SCALES).max() < 0.1
    late = wb.feedback(bat.orbit, delay=1)
    lost = wb.simulate_many(bat.orbit, [wind], 20, feedback=late)
    assert not lost.survived.any()


def test_a_flight_without_wind_stays_on_the_orbit(bat):
    held = bat.fly((0.0, 0.0), 3)
    assert np.abs(held.deviations / SCALES).max() < 1e-2
    assert np.abs(held.bumps).max() < 1e-2
    short = wb.feedback_in_beat(bat.orbit, SEGMENTS, options=wb.FeedbackOptions(reach=0.1))
    pushed = short.fly(wb.winds.CosineGust(w=1.0, duration=0.2), 2)
    assert np.abs(pushed.bumps).max() == pytest.approx(0.1 * math.radians(3))


@pytest.mark.parametrize("segments", [1, 9, 2.5, True])
def test_segments_are_refused_in_words(bat_orbit, segments):
    with pytest.raises(wb.InvalidInputError, match=r"segments = .*: must be a whole number from 2 to 8"):
        wb.feedback_in_beat(bat_orbit.orbit, segments)


def test_bad_flights_are_refused_in_words(bat):
    with pytest.raises(wb.InvalidInputError, match=r"wind\.w = nan"):
        bat.fly((0.0, math.nan))
    with pytest.raises(wb.InvalidInputError, match="beats = 0"):
        bat.fly((0.0, 0.0), 0)
    heavy = wb.load_species("pigeon").with_values({"body.mass": 3.0})
    lost = wb.solve_orbit(wb.OrbitProblem(heavy, speed=3.0), starts=1)
    with pytest.raises(wb.InvalidInputError, match="is not certified"):
        wb.feedback_in_beat(lost)


@pytest.mark.slow
def test_many_flights_are_those_of_the_adaptive_integrator(bat):
    gusts = [wb.winds.CosineGust(u=1.0, w=w, start=0.03, duration=0.2) for w in (2.0, -1.0)]
    many = wb.simulate_many(bat.orbit, [*gusts, wb.winds.CosineGust()], 10, feedback=bat)
    assert many.survived.all()
    assert many.changes.shape == (3, 10 * SEGMENTS, 2)
    assert np.abs(many.changes[2]).max() < 1e-4 < 1e-2 < np.abs(many.changes[:2]).max()
    for i, gust in enumerate(gusts):
        alone = bat.fly(gust, 10)
        assert np.abs((many.states[i] - alone.states[::SEGMENTS])[:, 1:] / SCALES).max() < 5e-3
        assert np.abs(many.changes[i] - alone.bumps).max() < 1e-3
        # The ends of the segments are among the times at which the body pitch is judged.
        assert many.largest_pitch[i] >= np.abs(alone.deviations[:, 1]).max() - 1e-3


@pytest.mark.slow
def test_feedback_within_a_beat_measures_with_noise_and_is_never_late(bat):
    calm = [wb.winds.CosineGust()]
    noisy = wb.simulate_many(bat.orbit, calm, 10, feedback=bat, noise={"body_pitch": 0.01}, seed=1)
    assert noisy.survived.all()
    assert 0.01 < noisy.largest_pitch[0] < 0.3
    with pytest.raises(wb.InvalidInputError, match="late"):
        wb.simulate_many(bat.orbit, calm, 10, feedback=bat, late=1)
