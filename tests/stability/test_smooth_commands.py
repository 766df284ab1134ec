"""Inputs that change by finite amounts leave the wing where it is at the top of the stroke, and as fast."""

import numpy as np
import pytest

import wingbeat as wb
from tests.stability.test_inputs import BEATS, MORE, STOCK, at_top
from wingbeat.animal.kinematics import parameter, with_parameters
from wingbeat.stability.inputs import changed_wingbeat, compensation, parameters_of, smoother

LARGE = {"frequency": 2.0, "span_retraction": 0.1, "twist_ratio": 0.2, "downstroke_fraction": 0.05}


def commands(inputs, seed):
    """Return large random changes."""
    random = np.random.default_rng(seed)
    changes = np.array([LARGE.get(name, 0.2) for name in inputs]) * random.uniform(-1, 1, len(inputs))
    return np.where(np.array(inputs) == "sweep_amplitude", np.abs(changes), changes)  # it is 0 before


@pytest.mark.parametrize("kind", BEATS)
def test_large_changes_keep_the_wing_where_it_is(kind):
    beat = with_parameters(wb.load_species("pigeon").wingbeat, BEATS[kind])
    inputs = (*STOCK, *MORE[kind])
    found = compensation(beat, inputs)
    hold = smoother(beat, inputs, found)
    for seed in range(3):
        changes = commands(inputs, seed)
        changed = changed_wingbeat(beat, hold, inputs, found.names, changes)
        for name, change in zip(inputs, changes, strict=True):
            assert parameter(changed, name) == pytest.approx(parameter(beat, name) + change, abs=1e-14)
        away = np.abs(at_top(changed) - at_top(beat)).max()
        assert away < 1e-7, (kind, seed)  # differences of rates over a step of 1e-6


def test_small_changes_take_the_shares_of_the_linear_flight():
    beat = wb.load_species("pigeon").wingbeat
    found = compensation(beat, STOCK)
    hold = smoother(beat, STOCK, found)
    for column, name in enumerate(STOCK):
        changed = changed_wingbeat(beat, hold, STOCK, found.names, 1e-6 * np.eye(5)[column])
        waves = [(parameter(changed, wave) - parameter(beat, wave)) / 1e-6 for wave in found.names]
        assert np.allclose(waves, found.shares[:, column], rtol=0, atol=1e-5), name


def test_several_flights_are_changed_as_one_is():
    beat = wb.load_species("pigeon").wingbeat
    found = compensation(beat, STOCK)
    hold = smoother(beat, STOCK, found)
    changes = np.stack([commands(STOCK, seed) for seed in range(4)], axis=1)
    together = np.asarray(parameters_of(beat, hold, changes, inputs=STOCK, harmonics=found.names))
    for i in range(4):
        alone = changed_wingbeat(beat, hold, STOCK, found.names, changes[:, i])
        numbers = [parameter(alone, name) for name in (*STOCK, *found.names)]
        assert np.allclose(together[:, i], numbers, rtol=1e-12, atol=1e-14)


def test_inputs_that_need_no_harmonics_have_none():
    beat = with_parameters(wb.load_species("pigeon").wingbeat, {"chord_retraction": 0.2})
    found = compensation(beat, ("chord_retraction",))
    hold = smoother(beat, ("chord_retraction",), found)
    changed = changed_wingbeat(beat, hold, ("chord_retraction",), (), np.array([0.1]))
    assert changed.chord_retraction == pytest.approx(0.3)
    assert with_parameters(changed, {"chord_retraction": 0.2}) == beat
