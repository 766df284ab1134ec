"""The peak of a sampled path: smooth in the samples, its derivative exact, and near the true one."""

import numpy as np
import pytest

from wingbeat._jax.arrays import jax
from wingbeat.orbits.flight.beat import PARTS, WeightedSamples, highest, peak_weights, peaks, spread

PEAKS = jax.jit(peaks)
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


def test_the_search_and_what_is_read_off_a_beat_mean_the_same_peak():
    """They did not: at the ends of a path one took it for closed, the other carried it on."""
    random = np.random.default_rng(0)
    angle = 2 * np.pi * PHASE[:, None] * np.arange(1, 5)
    for _ in range(200):
        closed = np.cos(angle + random.uniform(0, 2 * np.pi, 4)) @ random.normal(size=4)
        assert float(PEAKS(closed).max()) == pytest.approx(peak_weights(closed) @ closed, abs=1e-12)


def test_peaks_of_quarters_slide_along_the_curve_and_through_the_ends():
    fine = 2 * np.pi * np.linspace(0, 1, 100_001)
    true = (np.cos(fine) + 0.3 * np.sin(2 * fine + 1)).max()
    found = np.array([PEAKS(path(s)).max() for s in np.linspace(0, 1, 1001)])
    assert np.abs(found - true).max() < 2e-3
    assert np.abs(np.diff(found)).max() < 1e-4


def test_the_peaks_of_several_series_have_their_derivatives():
    series = np.stack([path(0.013), -path(0.4)], axis=1)
    found = jax.jit(jax.jacobian(peaks))(series).reshape(PARTS, 2, -1)
    step = 1e-6
    for i, moved in enumerate(np.eye(series.size).reshape(-1, *series.shape)):
        change = (PEAKS(series + step * moved) - PEAKS(series - step * moved)) / (2 * step)
        assert np.abs(change - found[..., i]).max() < 1e-8


def test_a_peak_is_never_below_the_samples_and_a_level_series_has_its_level():
    assert (peaks(path(0.1)) >= highest(path(0.1))).all()
    assert np.array_equal(peaks(np.full(33, 0.2)), np.full(PARTS, 0.2))


def test_the_largest_spread_is_the_range():
    fine = np.cos(2 * np.pi * np.linspace(0, 1, 257))
    assert spread(fine).shape == (257, PARTS)
    assert float(spread(fine).max()) == pytest.approx(2.0, rel=1e-4)


def test_one_path_and_a_column_of_paths_have_the_same_peaks():
    random = np.random.default_rng(3)
    for _ in range(100):
        two = np.round(random.normal(size=(33, 2)), 1)
        two[-1] = two[0]
        together = WeightedSamples(two).peaks
        assert np.array_equal(together, np.stack([WeightedSamples(one).peaks for one in two.T], axis=1))
