"""Motions of strips: what must not change the loads, speeds from positions, wings told apart, and noise."""

import dataclasses

import numpy as np
import pytest

from tests.helpers.strip_cases import both_wings, flapping_case
from wingbeat.aero import BladeElement
from wingbeat.aero.closed_forms import disc_area
from wingbeat_evidence.measured_motion.slopes import smoothed_slopes
from wingbeat_evidence.measured_motion.strip_loads import momentum_inflow, strip_loads
from wingbeat_evidence.measured_motion.strip_motion import semi_span, strip_motion, wing_ranges

ALL_TERMS = BladeElement("su-fan", unsteady="thin-aerofoil", inflow="momentum")
CASE = flapping_case()
ARRAYS = ("position", "chord", "area", "velocity", "rear_velocity")


def loads(case):
    motion = strip_motion(case)
    moving = motion.in_moving_air(case, momentum_inflow(case, ALL_TERMS.induced_factor))
    return strip_loads(case, motion, moving, ALL_TERMS)


def same(found, wanted, share=1e-9):
    for name in ("fx", "fz", "power"):
        one, other = getattr(found, name), getattr(wanted, name)
        np.testing.assert_allclose(one, other, rtol=0, atol=share * np.abs(other).max())


def test_both_wings_are_one_and_its_mirror():
    same(loads(both_wings(CASE)), loads(CASE))


def test_the_place_of_the_origin_and_the_order_of_strips_do_not_matter():
    shifted = dataclasses.replace(CASE, position=CASE.position + np.array([5.0, 0.0, -3.0]))
    same(loads(shifted), loads(CASE))
    back = {name: getattr(CASE, name)[:, ::-1] for name in ARRAYS}
    same(loads(dataclasses.replace(CASE, **back)), loads(CASE))


def test_a_later_clock_does_not_matter():
    same(loads(dataclasses.replace(CASE, times=CASE.times + 12.5)), loads(CASE), 1e-7)


def test_positions_alone_give_the_loads_of_the_velocities():
    found = loads(flapping_case(velocities=False))
    same(found, loads(CASE), 2e-3)


def test_positions_in_a_wind_tunnel_get_the_speed():
    moving = flapping_case(velocities=False)
    advance = CASE.times[:, None, None] * np.array([CASE.speed, 0.0, 0.0])
    held = dataclasses.replace(moving, position=moving.position - advance)
    assert "wind tunnel" in " ".join(strip_motion(held).notes)
    assert "advance with the animal" in " ".join(strip_motion(moving).notes)
    same(loads(held), loads(moving))


def test_given_velocities_are_not_changed_but_doubted_if_they_do_not_advance():
    slow = dataclasses.replace(CASE, velocity=CASE.velocity - np.array([CASE.speed, 0.0, 0.0]))
    (note,) = strip_motion(slow).notes
    assert "through still air?" in note
    np.testing.assert_array_equal(strip_motion(slow).velocity, slow.velocity)


def test_turning_is_that_of_the_chord_with_and_without_rear_velocities():
    given, derived = strip_motion(CASE), strip_motion(dataclasses.replace(CASE, rear_velocity=None))
    np.testing.assert_allclose(derived.turning, given.turning, atol=1e-3 * np.abs(given.turning).max())


def test_wings_are_told_apart():
    """Two wings one after the other, root to tip, are two; left and right in one line are one line for each."""
    behind = dataclasses.replace(
        CASE,
        **{name: np.concatenate([getattr(CASE, name)] * 2, axis=1) for name in ARRAYS},
    )
    motion = strip_motion(behind)
    assert wing_ranges(behind, motion.ahead, motion.width) == [(0, 8), (8, 16)]
    np.testing.assert_allclose(motion.outward[:, :8], motion.outward[:, 8:])
    pair = strip_motion(both_wings(CASE))
    assert (np.median(pair.outward[..., 1], axis=0) > 0).all()
    assert (np.median(pair.normal[..., 2], axis=0) > 0).all()


def test_two_strips_a_wing_are_told_apart_by_their_turning_back():
    small = flapping_case(strips=2)
    twice = {name: np.concatenate([getattr(small, name)] * 2, axis=1) for name in ARRAYS}
    behind = dataclasses.replace(small, **twice)
    motion = strip_motion(behind)
    assert wing_ranges(behind, motion.ahead, motion.width) == [(0, 2), (2, 4)]


def test_momentum_in_hover_is_that_of_the_disc():
    hover = flapping_case(speed=0.0)
    assert semi_span(hover) == pytest.approx(0.3, rel=1e-3)
    forward, up = momentum_inflow(hover, 1.2)
    wanted = np.sqrt(1.2 * hover.weight / (2 * hover.density * disc_area(semi_span(hover))))
    assert (forward, up) == pytest.approx((0.0, -wanted), abs=1e-12)


def test_noise_is_taken_off_before_it_is_differentiated():
    """Frames with a noise of half a percent of the reach give the accelerating force to a tenth of its size."""
    random = np.random.default_rng(3)
    clean = flapping_case(velocities=False)
    noisy = dataclasses.replace(clean, position=clean.position + 1.5e-3 * random.normal(size=clean.position.shape))
    wanted, found = loads(clean).fz, loads(noisy).fz
    step = clean.times[1] - clean.times[0]
    raw = np.gradient(np.gradient(noisy.position[:, -1, 2], step), step)
    true = np.gradient(np.gradient(clean.position[:, -1, 2], step), step)
    assert np.std(found - wanted) < 0.1 * np.std(wanted)
    assert np.std(raw - true) > 0.5 * np.std(true)  # what differences would have made of it


def test_exact_series_pass_the_spline_unchanged():
    t = np.arange(64) / 64
    value = np.sin(2 * np.pi * t) + 0.3 * np.cos(6 * np.pi * t)
    slope = 2 * np.pi * np.cos(2 * np.pi * t) - 1.8 * np.pi * np.sin(6 * np.pi * t)
    smooth, rate = smoothed_slopes(t, value, 1.0, 1.0)
    np.testing.assert_allclose(smooth, value, atol=1e-5)
    np.testing.assert_allclose(rate, slope, atol=2e-3)
    closed = np.append(t, 1.0)  # a frame that repeats the first
    rate_closed = smoothed_slopes(closed, np.append(value, value[0]), 1.0, 1.0)[1]
    np.testing.assert_allclose(rate_closed[:-1], rate, atol=1e-6)
