"""Many flights at once are the flights that the adaptive integrator flies one by one."""

import math

import numpy as np
import pytest

import wingbeat as wb

GUSTS = [
    wb.winds.CosineGust(w=3.0, duration=0.2),
    wb.winds.CosineGust(u=-2.0, w=-1.0, start=0.07, duration=0.35),
    (0.0, -0.5),
    wb.winds.DrydenTurbulence(airspeed=12.0, level="light", seed=1),
    wb.winds.CosineGust(),
]
SCALES = np.array([1.0, 1.0, 0.1, 1.0, 1.0, 2.0])


def one_by_one(orbit, winds, beats, controller=None):
    """Return states at all tops of the stroke, shape (winds, beats + 1, 6), and the times."""
    flown = [
        wb.simulate(
            orbit.problem.model, orbit.wingbeat, orbit.initial_state, beats, 16, wind=w, controller=controller
        )
        for w in winds
    ]
    return np.stack([one.states[::16] for one in flown]), np.stack([one.time[::16] for one in flown])


@pytest.mark.slow
@pytest.mark.parametrize(("delay", "late"), [(0, 0), (1, 0), (0, 1)])
def test_held_flights_are_those_of_the_adaptive_integrator(cruise, delay, late):
    found = wb.feedback(cruise, delay=delay)
    beats = 6 if late else 30
    states, times = one_by_one(cruise, GUSTS, beats, found.controller(late=late))
    many = wb.simulate_many(cruise, GUSTS, beats, feedback=found, late=late)
    assert many.states.shape == (5, beats + 1, 6)
    assert np.abs((many.states - states) / SCALES).max() < (2e-2 if late else 5e-3)
    assert np.abs(many.time - times).max() < 1e-3
    assert np.abs(many.changes).max() > 0.05
    if not late:
        assert many.survived.all()


@pytest.mark.slow
def test_free_flights_are_those_of_the_adaptive_integrator(cruise):
    states, times = one_by_one(cruise, GUSTS, 4)
    many = wb.simulate_many(cruise, GUSTS, 4)
    assert many.changes.shape == (5, 4, 0)
    assert np.abs((many.states - states) / SCALES).max() < 2e-2  # grows as the flights tumble
    assert np.allclose(many.time, times, rtol=1e-12)


@pytest.mark.slow
def test_more_steps_come_closer(cruise):
    states, _ = one_by_one(cruise, GUSTS, 2)
    away = [
        np.abs((wb.simulate_many(cruise, GUSTS, 2, options=wb.ManyOptions(steps=n)).states - states) / SCALES).max()
        for n in (16, 64)
    ]
    assert away[1] < 0.1 * away[0]


@pytest.mark.slow
def test_flights_do_not_depend_on_their_company(cruise, patient):
    gusts = [wb.winds.CosineGust(w=size, duration=0.2) for size in np.linspace(-3, 3, 11).tolist()]
    together = wb.simulate_many(cruise, gusts, 5, feedback=patient)
    parted = wb.simulate_many(cruise, gusts, 5, feedback=patient, options=wb.ManyOptions(lanes=4))
    assert np.allclose(together.states, parted.states, rtol=0, atol=1e-8)
    assert together.survived.shape == (11,)


def test_noise_is_added_to_what_is_measured(cruise, held):
    still = [(0.0, 0.0)] * 300
    flown = wb.simulate_many(cruise, still, 2, feedback=held, noise={"body_pitch": 0.01}, seed=3)
    first = flown.changes[:, 0, 3]
    assert first.std() == pytest.approx(0.01 * abs(held.gains[3, 1]), rel=0.15)
    again = wb.simulate_many(cruise, still, 2, feedback=held, noise={"body_pitch": 0.01}, seed=3)
    assert np.array_equal(flown.states, again.states)


@pytest.mark.slow
def test_a_flight_is_lost_by_its_pitch_or_its_height(cruise):
    gusts = [wb.winds.CosineGust(), wb.winds.CosineGust(w=3.0, duration=0.2)]
    many = wb.simulate_many(cruise, gusts, 16)
    assert many.survived.tolist() == [True, False]
    assert many.largest_pitch[0] < 0.05
    assert many.largest_pitch[1] > math.radians(60)
    wide = wb.simulate_many(cruise, gusts, 16, options=wb.ManyOptions(tilt=100.0, loss=100.0))
    assert wide.survived.all()
    down = [wb.winds.CosineGust(w=-3.0, duration=0.5)]
    fallen = wb.simulate_many(cruise, down, 12, options=wb.ManyOptions(tilt=100.0, loss=0.1))
    assert fallen.survived.tolist() == [False]
    assert fallen.lowest[0] == pytest.approx(fallen.states[0, :, 1].min() - cruise.initial_state.z)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"winds": []}, "winds = .*: must be a list of at least one wind"),
        ({"winds": 3}, "winds = 3"),
        ({"winds": [(0.0, math.nan)]}, "wind.w = nan: must be finite"),
        ({"winds": [(1.0, 2.0, 3.0)]}, "must be two velocities"),
        ({"winds": [lambda times: (0.0, math.inf)]}, "must return two finite velocities"),
        ({"beats": 0.5}, "beats = 0.5"),
        ({"late": -1}, "late = -1"),
        ({"noise": {"x": 1.0}}, "noise = 'x'"),
    ],
)
def test_bad_input_gets_its_sentence(cruise, asked, said):
    with pytest.raises(wb.InvalidInputError, match=said):
        wb.simulate_many(cruise, **({"winds": [(0.0, 1.0)]} | asked))


def test_feedback_of_another_orbit_is_refused(cruise, pigeon_orbit, held, tmp_path):
    with pytest.raises(wb.InvalidInputError, match="is that of another orbit"):
        wb.simulate_many(pigeon_orbit.orbit, [(0.0, 1.0)], feedback=held)
    cruise.save(tmp_path / "cruise.nc")
    same = wb.load_orbit(tmp_path / "cruise.nc")
    assert wb.simulate_many(same, [(0.0, 0.0)], 1, feedback=held).survived.all()
