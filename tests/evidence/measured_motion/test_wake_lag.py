"""The lag of the wake: Wagner's step, Theodorsen's sine, and what a stalled strip sheds.

Theory: equations ``wake-downwash``, ``shed-downwash`` and ``jones-numbers``.
"""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import wingbeat as wb
from wingbeat.aero.wake import is_stalled, jones_numbers, largest_lift_angles
from wingbeat_evidence.measured_motion.wake import sampled_wake, strip_downwash

# Bessel functions of Theodorsen 1935, and Wagner's function at semi-chords travelled.
THEODORSEN = {0.1: 0.83192 - 0.17230j, 0.28: 0.67525 - 0.18188j, 0.5: 0.59794 - 0.15071j, 1.0: 0.53943 - 0.10027j}
WAGNER = {0.0: 0.5, 1.0: 0.5942, 2.0: 0.6655, 5.0: 0.7938, 10.0: 0.8786, 20.0: 0.9328}
PLATE = wb.aero.SuFan().kernel()


@pytest.mark.parametrize("pieces", [1, 7])
def test_a_step_of_the_downwash_is_wagners(pieces):
    ways = list(WAGNER)
    steps = np.repeat(np.diff(ways) / pieces, pieces)
    downwash = np.ones((len(steps) + 2, 1))
    downwash[0] = 0.0
    lift = 1.0 - sampled_wake(downwash, np.append(0.0, steps)[:, None], False)
    np.testing.assert_allclose(lift[1::pieces, 0], list(WAGNER.values()), atol=2e-4)


@pytest.mark.parametrize(("k", "wanted"), THEODORSEN.items())
def test_a_sine_of_the_downwash_is_theodorsens(k, wanted):
    phase = 2 * math.pi * np.arange(100)[:, None] / 100
    sine = np.cos(phase)
    effective = sine - sampled_wake(sine, np.full((100, 1), 2 * math.pi / k / 100), True)
    found = 2 * np.mean(effective * np.exp(-1j * phase))
    assert found == pytest.approx(wanted, abs=0.02)
    # Jones's form itself: what the steps leave of it.
    exact = 1 - sum(a * 1j * k / (b + 1j * k) for a, b in ((0.165, 0.0455), (0.335, 0.3)))
    assert found == pytest.approx(exact, abs=1e-3)


@settings(max_examples=15, deadline=None, derandomize=True)
@given(st.integers(2, 9), st.integers(0, 9999), st.sampled_from([1e-3, 0.1, 10.0]))
def test_a_motion_that_repeats_is_one_that_has_gone_on_for_long(count, seed, longest):
    random = np.random.default_rng(seed)
    downwash, travelled = random.normal(size=(count, 2)), random.uniform(0, longest, (count, 2))
    beats = math.ceil(30 / (0.0455 * travelled.sum(axis=0).min()))
    if beats * count > 20_000:
        return
    long = sampled_wake(np.tile(downwash, (beats, 1)), np.tile(travelled, (beats, 1))[:-1], False)
    np.testing.assert_allclose(sampled_wake(downwash, travelled, True), long[-count:], atol=1e-9)


@pytest.mark.parametrize("repeats", [True, False])
@pytest.mark.parametrize("way", [0.0, 1e-300, 1e-12, 1e-6, 1e300])
def test_strips_at_rest_and_at_any_speed_have_a_wake_of_numbers(way, repeats):
    downwash = np.array([[1.0, -2.0], [3.0, 0.0], [-1.0, 5.0]])
    wake = sampled_wake(downwash, np.full((3 if repeats else 2, 2), way), repeats)
    assert np.isfinite(wake).all()
    if way > 1:  # the old wake is left behind at once
        np.testing.assert_allclose(wake, 0.0, atol=1e-12)
    else:  # half of what has just changed is not yet felt
        np.testing.assert_allclose(wake - wake[0], 0.5 * (downwash - downwash[0]), atol=1e-5)


def test_half_of_a_step_weight_meets_its_series():
    """Across the length at which the weights of a step change from formula to series."""
    downwash = np.array([[0.0], [1.0], [2.0]])
    wakes = [sampled_wake(downwash, np.full((2, 1), way), False) for way in (3.3332e-3, 3.3334e-3)]
    np.testing.assert_allclose(wakes[0], wakes[1], rtol=0, atol=1e-6)


def test_where_lift_is_largest():
    below, above = largest_lift_angles(PLATE)
    assert (-below, above) == pytest.approx((math.radians(40.2),) * 2, abs=math.radians(0.2))
    alpha = np.radians([-60.0, -30.0, 0.0, 39.0, 42.0, 170.0])
    assert is_stalled(largest_lift_angles(PLATE), alpha).tolist() == [True, False, False, False, True, True]


def test_a_strip_sheds_the_downwash_of_three_quarters_of_its_chord_until_it_stalls():
    alpha, chord, turning = np.radians([-20.0, 0.0, 35.0]), np.full(3, 0.2), np.array([3.0, -2.0, 5.0])
    found = strip_downwash(PLATE, chord, 4 * np.cos(alpha), -4 * np.sin(alpha), turning)
    np.testing.assert_allclose(found, 4 * np.sin(alpha) + 0.1 * turning, rtol=1e-12)


def test_past_its_largest_lift_a_strip_sheds_what_its_lift_does():
    alpha = np.radians([-80.0, -60.0, 60.0, 80.0])
    found = strip_downwash(PLATE, np.ones(4), 4 * np.cos(alpha), -4 * np.sin(alpha), np.zeros(4))
    lift = wb.aero.SuFan().lift(alpha)
    np.testing.assert_allclose(found / found[2], lift / lift[2], rtol=1e-9)
    largest = largest_lift_angles(PLATE)[1]
    near = largest + np.array([-1e-9, 1e-9])
    edges = strip_downwash(PLATE, np.ones(2), 4 * np.cos(near), -4 * np.sin(near), np.zeros(2))
    assert edges[0] == pytest.approx(edges[1], rel=1e-6)


def test_a_strip_at_rest_and_a_polar_without_lift_shed_numbers():
    zero = np.zeros(2)
    np.testing.assert_array_equal(strip_downwash(PLATE, np.ones(2), zero, zero, zero), 0.0)
    bare = wb.aero.TableCoefficients("bare", np.arange(-180.0, 181.0, 30.0), np.zeros(13), np.ones(13)).kernel()
    assert np.isfinite(strip_downwash(bare, np.ones(2), zero, np.array([3.0, -3.0]), zero)).all()


def test_a_wing_of_finite_span_lags_less_and_a_long_one_as_its_section():
    section, six, three = (jones_numbers("jones-finite", ratio) for ratio in (1e9, 6.0, 3.0))
    for one, other in zip(section, jones_numbers("jones-section"), strict=True):
        np.testing.assert_allclose(one, other, atol=1e-6)
    # NACA Report 681, from memory; its summary says that the lift starts only slightly below that of a section. By
    # Jones's own correction, elliptic wings of aspect ratio 6 and 3 end at 0.74 and 0.60 of 2 pi alpha.
    assert (six, three) == (((0.0, 0.361), (0.0455, 0.381)), ((0.0, 0.283), (0.0455, 0.540)))
    starts = [final * (1 - sum(one[0])) for final, one in ((1.0, section), (0.74, six), (0.60, three))]
    np.testing.assert_allclose(starts, [0.5, 0.473, 0.430], atol=1e-3)
    between = jones_numbers("jones-finite", 4.0)
    np.testing.assert_allclose(between[0][1], 0.5 * (0.361 + 0.283), rtol=1e-12)
