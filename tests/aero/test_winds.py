"""Gusts and turbulence against their definitions and published spectra."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.signal import welch

import wingbeat as wb


def test_a_gust_rises_and_falls_once():
    gust = wb.winds.CosineGust(u=-1.0, w=3.0, start=0.2, duration=0.8)
    u, w = gust(np.linspace(0.0, 1.2, 13))
    assert np.allclose(w, -3.0 * u)
    assert w.max() == pytest.approx(3.0)
    assert (w[:3] == 0).all()
    assert (w[10:] == 0).all()


@pytest.fixture(scope="module")
def turbulence():
    return wb.winds.DrydenTurbulence(airspeed=12.0, level="moderate", altitude=60.0, seed=3)


def test_scales_and_intensities_are_those_of_the_standard(turbulence):
    # By hand, in feet and knots: h = 196.85 ft, 0.177 + 0.000823 h = 0.33901.
    assert turbulence.scales == pytest.approx((196.8504 / 0.3390079**1.2 * 0.3048, 60.0), rel=1e-6)
    assert turbulence.intensities[1] == pytest.approx(3.0 * 0.514444, rel=1e-5)
    assert turbulence.intensities[0] == pytest.approx(3.0 * 0.514444 / 0.3390079**0.4, rel=1e-5)


def spectra(turbulence):
    """Return the two published spectra over frequency [Hz], whose integrals are the variances."""
    (length_u, length_w), (size_u, size_w) = turbulence.scales, turbulence.intensities
    to_number = 2 * math.pi / turbulence.airspeed

    def forward(f):
        return to_number * size_u**2 * 2 * length_u / math.pi / (1 + (length_u * f * to_number) ** 2)

    def upward(f):
        x2 = (length_w * f * to_number) ** 2
        return to_number * size_w**2 * length_w / math.pi * (1 + 3 * x2) / (1 + x2) ** 2

    return forward, upward


def test_turbulence_has_the_published_spectrum(turbulence):
    times = np.arange(0.0, 40_000.0, 0.25)
    for series, size, spectrum in zip(turbulence(times), turbulence.intensities, spectra(turbulence), strict=True):
        assert quad(spectrum, 0, np.inf)[0] == pytest.approx(size**2, rel=1e-3)
        assert series.std() == pytest.approx(size, rel=0.05)
        assert abs(series.mean()) < 0.1 * size
        frequency, density = welch(series, fs=4.0, nperseg=4096)
        for low, high in ((0.01, 0.05), (0.05, 0.2), (0.2, 1.0)):
            band = (frequency >= low) & (frequency < high)
            share = density[band].sum() * frequency[1]
            assert share == pytest.approx(quad(spectrum, low, high)[0], rel=0.12)


def test_a_seed_gives_the_same_air_again(turbulence):
    times = np.linspace(0.0, 5.0, 20)
    again = wb.winds.DrydenTurbulence(12.0, "moderate", 60.0, 3)
    other = wb.winds.DrydenTurbulence(12.0, "moderate", 60.0, 4)
    assert np.array_equal(turbulence(times), again(times))
    assert not np.allclose(turbulence(times), other(times))


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: wb.winds.CosineGust(w=math.nan), "gust.w"),
        (lambda: wb.winds.CosineGust(duration=0.0), "gust.duration"),
        (lambda: wb.winds.DrydenTurbulence(0.0), "turbulence.airspeed"),
        (lambda: wb.winds.DrydenTurbulence(10.0, "calm"), "turbulence.level"),
        (lambda: wb.winds.DrydenTurbulence(10.0, altitude=1000.0), "turbulence.altitude"),
        (lambda: wb.winds.DrydenTurbulence(10.0, seed=-1), "turbulence.seed"),
    ],
)
def test_faults_are_named(make, said):
    with pytest.raises(wb.InvalidInputError, match=said):
        make()


@pytest.mark.parametrize("start", [-0.001, 0.0, 7.3])
def test_waves_at_equal_steps_of_time_are_those_at_any_times(start):
    air = wb.winds.DrydenTurbulence(airspeed=12.0, level="moderate", seed=3)
    times = start + np.arange(3001) / 612.7
    together = np.stack(air(times))
    one_by_one = np.concatenate([np.stack(air(times[i : i + 100])) for i in range(0, 3001, 100)], axis=1)
    assert together.shape == (2, 3001)
    assert np.abs(together - one_by_one).max() < 1e-9
    uneven = times.copy()
    uneven[1500] += 1e-6
    assert np.abs(np.stack(air(uneven)) - together).max() < 1e-4
    assert air(uneven)[1][1500] == pytest.approx(air(uneven[1500:1501])[1][0], abs=1e-12)
