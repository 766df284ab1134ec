"""Flights through moving air and with a wingbeat that changes from beat to beat."""

import dataclasses
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.programs import compiled
from tests.helpers.reflight import dop853
from wingbeat.mechanics.flights import state_rates


@compiled
def _rates(model, wingbeat, phase, state, wind):
    through_air = state_rates(model, wingbeat, phase, state.at[3:5].add(-wind))
    return through_air.at[:2].add(wind) / wingbeat.frequency


def flown(solved, start=None, **given):
    state = wb.State(*(solved.start if start is None else start))
    return wb.simulate(solved.model, solved.wingbeat, state, **{"beats": 2, "samples": 32, **given})


def test_an_even_wind_is_still_air_that_moves_along(pigeon_orbit):
    wind = np.array([1.5, -0.7])
    blown = flown(pigeon_orbit, pigeon_orbit.start + np.array([0, 0, 0, *wind, 0]), wind=tuple(wind))
    still = flown(pigeon_orbit)
    drifted = still.states.copy()
    drifted[:, :2] += still.time[:, None] * wind
    drifted[:, 3:5] += wind
    assert np.abs(blown.states - drifted).max() < 1e-7  # of two flights at rtol 1e-10
    assert np.allclose(blown.air, wind)
    for name in ("force_x", "force_z", "hinge_power", "alpha"):
        scale = np.abs(still.dataset[name]).max()
        assert np.abs(blown.dataset[name] - still.dataset[name]).max() < 1e-6 * scale, name
    assert float(blown.dataset["air_u"][3]) == 1.5
    assert "air_u" not in still.dataset


def test_a_gust_is_flown_as_scipy_flies_it(pigeon_orbit):
    beat = pigeon_orbit.wingbeat
    gust = wb.winds.CosineGust(u=-1.0, w=2.0, start=0.3 / beat.frequency, duration=1.2 / beat.frequency)

    def rates(phase, state):
        wind = np.array(gust(np.array([phase / beat.frequency])))[:, 0]
        return _rates(pigeon_orbit.model, beat, np.asarray(phase % 1.0), state, wind)

    end = dop853(rates, (0.0, 2.0), pigeon_orbit.start, rtol=1e-10)
    found = flown(pigeon_orbit, wind=gust)
    assert np.abs(found.states[-1] - end).max() < 2e-4  # the cubics' error; the gust moves the end by much more
    assert np.abs(found.states[-1] - flown(pigeon_orbit).states[-1]).max() > 0.1


def test_no_wind_is_still_air(pigeon_orbit):
    assert np.abs(flown(pigeon_orbit, wind=(0.0, 0.0)).states - flown(pigeon_orbit).states).max() < 1e-7


def test_a_controller_changes_the_wingbeat_from_beat_to_beat(pigeon_orbit):
    beat, asked = pigeon_orbit.wingbeat, []
    slower = dataclasses.replace(beat, frequency=0.9 * beat.frequency)

    def controller(count, state):
        asked.append((count, state))
        return beat if count != 1 else slower

    found = flown(pigeon_orbit, beats=3, controller=controller)
    assert [count for count, _ in asked] == [0, 1, 2]
    assert found.wingbeats == (beat, slower, beat)
    first = flown(pigeon_orbit, beats=1)
    second = wb.simulate(pigeon_orbit.model, slower, wb.State(*first.states[-1]), 1, 32)
    assert np.array_equal(found.states[:33], first.states)
    assert np.array_equal(found.states[32:65], second.states)
    assert np.allclose(asked[2][1], second.states[-1])
    assert found.time[-1] == pytest.approx(2 / beat.frequency + 1 / slower.frequency)
    series = found.dataset
    assert series.sizes["phase"] == len(found.phase) == 97
    assert np.array_equal(series["time"], found.time)
    assert np.allclose(series["hinge_power"][33:65], second.dataset["hinge_power"][1:], rtol=1e-9, atol=1e-9)


def test_a_wind_acts_at_the_time_of_controlled_beats(pigeon_orbit):
    beat, times = pigeon_orbit.wingbeat, []

    def wind(at):
        times.append(at)
        return np.zeros_like(at), 0.0 * at

    slower = dataclasses.replace(beat, frequency=0.5 * beat.frequency)
    found = flown(pigeon_orbit, beats=2, wind=wind, controller=lambda count, _: (slower, beat)[count])
    last = times[-2]
    assert last[1] == pytest.approx(1 / slower.frequency)
    assert last[-2] == pytest.approx(1 / slower.frequency + 1 / beat.frequency)
    assert found.air.shape == (65, 2)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"wind": (1.0, math.nan)}, "wind.w = nan"),
        ({"wind": (1.0,)}, "must be two velocities"),
        ({"wind": 3.0}, "must be two velocities or a function"),
        ({"wind": lambda times: times}, "must return two finite velocities"),
        ({"wind": lambda times: (times * np.nan, times)}, "must return two finite velocities"),
        ({"controller": 3}, "must be a function"),
        ({"controller": lambda count, state: {"frequency": 9.0}}, "returned dict after 0 beats"),
    ],
)
def test_faults_are_named(pigeon_orbit, given, said):
    with pytest.raises(wb.InvalidInputError, match=said):
        flown(pigeon_orbit, **given)
