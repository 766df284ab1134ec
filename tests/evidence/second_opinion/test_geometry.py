"""The lattice's corners are points of the wing that we fly, and its panels move as they do."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.given_motion import PIGEON, given_motion
from tests.helpers.unsteady_flights import all_terms, loads, states_at
from wingbeat._jax.arrays import jnp
from wingbeat.mechanics.wing_points import strip_corners, surface_points
from wingbeat_evidence.second_opinion.lattice import (
    LatticeOptions,
    lattice_of,
    panel_centres,
    panel_velocities,
    sum_of_panels,
)

BEAT = wb.Wingbeat(
    frequency=8.0, flap_mean=0.05, flap_amplitude=0.9, pitch_amplitude=0.3, pitch_mean=0.1, span_retraction=0.3
)
RICH = dataclasses.replace(
    BEAT, twist_ratio=0.4, fold_amplitude=0.5, sweep_amplitude=0.2, stroke_plane_tilt=0.1, downstroke_fraction=0.6
)
PHASE = np.linspace(0.0, 1.0, 9)[:-1]


def test_corners_of_an_untwisted_wing_are_those_of_its_strips():
    motion = given_motion(BEAT, heave=0.01, pitch=0.1)
    model = wb.FlightModel(PIGEON, wb.aero.BladeElement("su-fan", strips=5))
    strips = np.asarray(strip_corners(model, BEAT, motion.state(PHASE), PHASE))
    points = np.asarray(
        surface_points(PIGEON, BEAT, motion.state(PHASE), PHASE, np.linspace(0, 1, 6), np.array([0.0, 1.0]))
    )
    ours = np.stack([points[:, 0, :-1], points[:, 0, 1:], points[:, 1, 1:], points[:, 1, :-1]], axis=2)
    np.testing.assert_allclose(ours, strips, atol=1e-14)


def test_points_at_the_quarter_chord_are_where_the_strips_of_a_rich_beat_have_it():
    model, beat = all_terms("pigeon")  # whose program the tests of unsteady air have
    centres = (np.arange(10) + 0.5) / 10
    state = states_at(PHASE)
    points = np.asarray(surface_points(model.vehicle, beat, state, PHASE, centres, np.array([0.25])))
    np.testing.assert_allclose(
        points[:, 0], np.asarray(loads(model, beat, state, PHASE).strip_position), atol=1e-14
    )


def test_axes_fly_at_the_mean_velocity_so_a_beat_closes():
    motion = given_motion(RICH, heave=0.01, climb=1.0)
    first, again = lattice_of(motion, LatticeOptions(2, 4), np.array([0.25, 1.25]))
    np.testing.assert_allclose(first, again, atol=1e-12)
    state = motion.state(np.array([0.25]))
    whole = np.asarray(
        surface_points(PIGEON, RICH, state, np.array([0.25]), np.linspace(0, 1, 5), np.linspace(0, 1, 3))
    )
    flown = np.array([10.0, 0.0, 1.0]) * 0.25 * motion.period
    np.testing.assert_allclose(first[:, 4::-1], whole[0] - flown, atol=1e-12)


def test_wings_mirror_each_other_and_a_column_across_the_body_joins_them():
    corners = lattice_of(given_motion(RICH), LatticeOptions(4, 4), PHASE)
    assert corners.shape == (8, 5, 10, 3)
    np.testing.assert_allclose(corners, corners[:, :, ::-1] * [1, -1, 1])
    assert (corners[:, :, 4, 1] > 0.005).all()


def test_roots_in_the_plane_of_symmetry_are_joined_there():
    wing = dataclasses.replace(PIGEON.wing, shoulder=(0.0, 0.0, 0.0))
    motion = given_motion(BEAT, vehicle=dataclasses.replace(PIGEON, wing=wing))
    corners = lattice_of(motion, LatticeOptions(4, 4), PHASE)
    assert corners.shape == (8, 5, 9, 3)
    assert (corners[:, :, 4, 1] == 0).all()
    along, down = np.linspace(0, 1, 5), np.linspace(0, 1, 5)
    np.testing.assert_array_equal(corners[:, :, 3::-1], motion.wing(PHASE, along, down)[:, :, 1:])


def test_panels_are_turned_up_about_the_quarter_chord_to_where_the_polar_has_no_lift():
    """Su and Fan's plate has no lift at 0; that of the hand is shifted by 0.1 rad."""
    motion, options = given_motion(RICH, pitch=0.1), LatticeOptions(4, 4)
    hand = wb.aero.FunctionCoefficients(lambda alpha: (jnp.sin(alpha + 0.1), 0.0 * alpha), "shifted")
    aero = wb.aero.BladeElement("su-fan", hand=hand, hand_from=0.6)
    flat, turned = (lattice_of(motion, options, PHASE, one)[:, :, 4::-1] for one in (None, aero))
    np.testing.assert_allclose(turned[:, :, :3], flat[:, :, :3], atol=1e-14)
    before, after = (points[:, 0, 3:] - points[:, -1, 3:] for points in (flat, turned))
    chord = np.linalg.norm(before, axis=-1)
    cosine, across = np.sum(before * after, axis=-1) / chord**2, np.cross(before, after) / chord[..., None] ** 2
    np.testing.assert_allclose(cosine, np.cos(0.1), rtol=1e-9)
    assert (across[..., 1] < 0).all()  # from ahead to above
    quarter = [0.75 * points[:, 0] + 0.25 * points[:, -1] for points in (flat, turned)]
    np.testing.assert_allclose(*quarter, atol=1e-14)


def test_panels_of_a_plate_that_moves_and_turns():
    phase, step = np.arange(16) / 16, 0.01
    omega = 2 * np.pi / (16 * step)
    angle = 0.1 * np.cos(2 * np.pi * phase)
    ahead = np.array([0.0, -0.1])[:, None]
    flat = np.zeros((16, 2, 3, 3))
    flat[..., 0] = ahead * np.cos(angle)[:, None, None]
    flat[..., 1] = np.array([0.5, 0.0, -0.5])
    flat[..., 2] = ahead * np.sin(angle)[:, None, None] + 0.02 * np.sin(2 * np.pi * phase)[:, None, None]
    speed, turning = panel_velocities(flat, step, (3.0, 1.0))
    rate = -0.1 * omega * np.sin(2 * np.pi * phase)
    np.testing.assert_allclose(turning[:, 0, 0, 1], -rate, rtol=1e-6, atol=1e-9)
    up = 1.0 + 0.02 * omega * np.cos(2 * np.pi * phase) - 0.05 * np.cos(angle) * rate
    np.testing.assert_allclose(speed[:, 0, 1, 2], up, rtol=1e-6)
    # A force at the leading edge and its moment: the power is that of the leading edge's velocity.
    force = np.zeros((16, 1, 2, 3))
    force[..., 2] = 2.0
    edge = 0.5 * (flat[:, :1, 1:] + flat[:, :1, :-1])
    loads = sum_of_panels(1, flat, step, (3.0, 1.0), force, np.cross(edge, force))
    np.testing.assert_allclose(loads.power, -4.0 * (1.0 + 0.02 * omega * np.cos(2 * np.pi * phase)), atol=1e-6)
    np.testing.assert_allclose(loads.lift, 4.0)
    assert np.allclose(panel_centres(flat)[:, 0, 0, 1], 0.25)


def test_panels_across_the_body_do_not_count():
    corners = lattice_of(given_motion(BEAT), LatticeOptions(2, 2), PHASE)
    force = np.zeros((8, 2, 5, 3))
    force[:, :, 2, 2] = 7.0
    assert (sum_of_panels(2, corners, 0.01, (10.0, 0.0), force, force).lift == 0).all()


@pytest.mark.parametrize(
    ("options", "rule"),
    [
        ({"chordwise": 0}, "chordwise = 0: must be a whole number from 2 to 40"),
        ({"chordwise": 3}, "chordwise = 3: must be even"),
        ({"spanwise": 1}, "spanwise = 1: must be a whole number from 2 to 80"),
        ({"steps": 33}, "steps = 33: must be even"),
        ({"beats": 1}, "beats = 1: must be a whole number from 2 to 20"),
    ],
)
def test_bad_lattices_are_refused(options, rule):
    with pytest.raises(wb.InvalidInputError, match=rule):
        LatticeOptions(**options)
