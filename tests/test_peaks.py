"""The peak of a sampled path: smooth in the samples, its weights its derivative, and near the true one."""

import numpy as np
import pytest

from wingbeat.orbits.transcription import peak_weights

PHASE = np.linspace(0.0, 1.0, 33)


def path(shift):
    angle = 2 * np.pi * (PHASE + shift)
    return np.cos(angle) + 0.3 * np.sin(2 * angle + 1)


def test_the_peak_hardly_moves_as_samples_slide_along_the_same_curve():
    fine = 2 * np.pi * np.linspace(0, 1, 100_001)
    true = (np.cos(fine) + 0.3 * np.sin(2 * fine + 1)).max()
    shifts = np.linspace(0, 1, 1001)
    peaks = np.array([peak_weights(path(s)) @ path(s) for s in shifts])
    sampled = np.array([path(s).max() for s in shifts])
    assert np.abs(peaks - true).max() < 1e-3 < np.abs(sampled - true).max()
    assert np.abs(np.diff(peaks)).max() < 5e-5


@pytest.mark.parametrize("shift", [0.0, 0.01, 0.013, 0.37, 0.99])
def test_the_weights_are_the_derivative(shift):
    values, step = path(shift), 1e-7
    weights = peak_weights(values)
    assert weights.sum() == pytest.approx(1.0)
    for i in range(1, 32):
        moved = values + step * (np.arange(33) == i)
        assert (peak_weights(moved) @ moved - weights @ values) / step == pytest.approx(weights[i], abs=1e-5)


def test_a_level_path_has_its_level_as_peak():
    level = np.full(33, 0.2)
    assert peak_weights(level) @ level == pytest.approx(0.2)
