"""Kinds, times and shares of modes, from maps whose modes are known."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm

from wingbeat.stability.linear_flight import modes_of

ONES = np.ones(4)


def of_rates(rates, frequency=5.0):
    """Return the modes of a flight whose rates are linear and steady."""
    along = np.stack([expm(rates * phase / frequency) for phase in np.linspace(0, 1, 65)])
    return modes_of(along[-1], frequency, along, ONES)


def test_each_kind_has_its_times():
    rates = np.zeros((4, 4))
    rates[0, 0], rates[1, 1] = 2.0, -3.0
    rates[2:, 2:] = [[-0.5, 4.0], [-4.0, -0.5]]
    divergence, oscillation, subsidence = of_rates(rates)
    assert (divergence.kind, oscillation.kind, subsidence.kind) == ("divergence", "oscillation", "subsidence")
    assert divergence.time_to_double == pytest.approx(math.log(2) / 2)
    assert divergence.time_to_half is None
    assert divergence.period is None
    assert divergence.damping is None
    assert subsidence.time_to_half == pytest.approx(math.log(2) / 3)
    assert oscillation.period == pytest.approx(2 * math.pi / 4)
    assert oscillation.damping == pytest.approx(0.5 / math.hypot(0.5, 4))
    assert oscillation.time_to_half == pytest.approx(math.log(2) / 0.5)
    assert divergence.shares == pytest.approx({"body_pitch": 1, "u": 0, "w": 0, "pitch_rate": 0}, abs=1e-12)
    assert oscillation.shares == pytest.approx({"body_pitch": 0, "u": 0, "w": 0.5, "pitch_rate": 0.5}, abs=1e-12)


def test_a_negative_multiplier_is_a_flip_of_two_beats():
    flip, *others = modes_of(np.diag([-1.2, 0.5, 0.4, 0.3]), 8.0, np.ones((3, 1, 1)) * np.eye(4), ONES)
    assert flip.kind == "flip"
    assert flip.period == pytest.approx(2 / 8.0)
    assert flip.time_to_double == pytest.approx(math.log(2) / (8.0 * math.log(1.2)))
    assert flip.damping < 0
    assert {mode.kind for mode in others} == {"subsidence"}


def test_a_multiplier_of_zero_has_no_times_that_are_not_numbers():
    found = modes_of(np.diag([0.5, 0.4, 0.3, 0.0]), 8.0, np.ones((3, 1, 1)) * np.eye(4), ONES)
    assert found[-1].time_to_half == 0.0
    assert found[-1].shares["pitch_rate"] == pytest.approx(1.0)


@given(st.lists(st.floats(-3, 3), min_size=16, max_size=16))
def test_modes_are_those_of_the_map(numbers):
    rates = np.reshape(numbers, (4, 4))
    found = of_rates(rates)
    monodromy = expm(rates / 5.0)
    assert 2 <= len(found) <= 4
    assert abs(found[0].multiplier) == pytest.approx(np.abs(np.linalg.eigvals(monodromy)).max(), rel=1e-6)
    for mode in found:
        assert sum(mode.shares.values()) == pytest.approx(1.0)
        assert np.linalg.norm(mode.disturbance) == pytest.approx(1.0)
        residual = monodromy @ mode.disturbance - mode.multiplier * mode.disturbance
        assert np.abs(residual).max() < 1e-6 * np.abs(monodromy).max()
