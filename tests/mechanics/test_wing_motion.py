"""The wing's tables in stroke axes: rates, rigid limits, strips and their masses."""

import dataclasses
import math
from typing import Any, NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import wingbeat as wb
from tests.helpers.programs import compiled
from wingbeat._jax.arrays import jax, jnp
from wingbeat.mechanics.wing_motion import wing_motion
from wingbeat.mechanics.wing_shape import mass_points, shape_at, strips_of, stroke_pitch, to_world, with_time_axes

STRIPS = 8
VEHICLE = wb.Vehicle(
    wb.Body(0.0584, 2.4e-5),
    wb.Wing(0.30, (0.11, 0.13, 0.09, 0.04), 0.0048, 0.94, (0.03, 0.02, 0.01), math.radians(75)),
)
BEAT = wb.Wingbeat(8.0, 0.15, 0.85, 0.20, 0.50, 0.3, 1.6, 0.4, 0.45)
PHASES = np.linspace(0.0, 1.0, 17)
# Central differences of order 8: weight of each step.
ORDER_8 = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}


def times_first(array):
    return jnp.moveaxis(array, -1, 0)


@compiled
def tabulate(vehicle, wingbeat, phase):
    """Return the table with phases as the first axis, then strips."""
    return jax.tree.map(times_first, wing_motion(vehicle, wingbeat, phase, STRIPS))


class Places(NamedTuple):
    """Quarter chords, chordwise and normal vectors in body axes (P, N, 3), and the mass points (P, 2, N, 3)."""

    quarter_chord: Any
    chordwise: Any
    normal: Any
    mass: Any


@compiled
def places(vehicle, wingbeat, phase):
    """Place the wing in body axes."""
    strips = with_time_axes(strips_of(vehicle.wing, STRIPS), phase)
    shape = shape_at(vehicle, wingbeat, strips, phase)

    def in_body(triple):
        ahead, up = to_world(stroke_pitch(vehicle.wing.stroke_plane_angle), triple[0], triple[2])
        return jnp.stack([times_first(v) for v in (ahead, triple[1], up)], axis=-1)

    corners = (shape.ahead, shape.left, shape.above)
    return Places(*map(in_body, (corners, shape.chordwise, shape.normal, mass_points(vehicle.wing, shape, strips))))


def in_stroke_axes(vectors, vehicle):
    """Turn vectors with a last axis of three from body axes into stroke axes."""
    beta = vehicle.wing.stroke_plane_angle
    turn = [[math.sin(beta), 0.0, math.cos(beta)], [0.0, 1.0, 0.0], [-math.cos(beta), 0.0, math.sin(beta)]]
    return np.asarray(vectors) @ np.transpose(turn)


def per_second(function, wingbeat, phase, step=0.01):
    """Differentiate a function of phase by time, by central differences of order 8."""
    h = step * wingbeat.frequency
    total = sum(w * (function(phase + k * h) - function(phase - k * h)) for k, w in ORDER_8.items())
    return total / step


def rate(function, wingbeat, phase):
    return per_second(function, wingbeat, phase, step=2e-4)


def close(found, wanted, tolerance=1e-9):
    np.testing.assert_allclose(found, wanted, rtol=0, atol=tolerance * np.abs(wanted).max())


def points(phase):
    """Return the mass points' places in the plane of symmetry, stroke axes, shape (P, 2, N, 2)."""
    return in_stroke_axes(places(VEHICLE, BEAT, phase).mass, VEHICLE)[..., [0, 2]]


def point_masses(vehicle):
    """Return the mass that each mass point stands for, both wings."""
    return np.asarray(strips_of(vehicle.wing, STRIPS).mass)


def test_strips_of_the_table_are_where_the_wing_is():
    table, shape = tabulate(VEHICLE, BEAT, PHASES), places(VEHICLE, BEAT, PHASES)
    quarter_chord = in_stroke_axes(shape.quarter_chord, VEHICLE)
    close(np.broadcast_to(np.asarray(table.ahead)[:, None], quarter_chord.shape[:2]), quarter_chord[..., 0], 1e-14)
    close(table.above, quarter_chord[..., 2], 1e-14)
    # Unpitched, the normal is the first stroke axis times the span; the pitch turns it back to the chord.
    chordwise, normal = (in_stroke_axes(v, VEHICLE) for v in (shape.chordwise, shape.normal))
    cosine, sine = np.cos(table.pitch), np.sin(table.pitch)
    close(chordwise[..., 0], cosine, 1e-14)
    unpitched = cosine[..., None] * normal + sine[..., None] * chordwise
    close(unpitched[..., 2], table.flap_cosine, 1e-14)
    close(table.area, np.asarray(table.width)[:, None] * strips_of(VEHICLE.wing, STRIPS).chord, 1e-14)


def test_flapping_speed_is_the_quarter_chords_along_the_normal_without_pitch():
    table, shape = tabulate(VEHICLE, BEAT, PHASES), places(VEHICLE, BEAT, PHASES)
    velocity = rate(lambda p: np.asarray(places(VEHICLE, BEAT, p).quarter_chord), BEAT, PHASES)
    cosine, sine = (f(np.asarray(table.pitch))[..., None] for f in (np.cos, np.sin))
    close(table.flapping_speed, np.sum(velocity * (cosine * shape.normal + sine * shape.chordwise), axis=-1))
    # Nothing moves along the chord but what pitch makes of that speed.
    along = np.sum(velocity * shape.chordwise, axis=-1)
    close(np.asarray(table.flapping_speed) * np.sin(table.pitch), along, 1e-8)


def test_moments_and_their_rates_are_those_of_the_mass_points():
    table, mass = tabulate(VEHICLE, BEAT, PHASES), point_masses(VEHICLE)
    place = points(PHASES)
    velocity = rate(points, BEAT, PHASES)
    acceleration = rate(lambda p: rate(points, BEAT, p), BEAT, PHASES)

    def total(values):
        return np.einsum("pkn,n->p", values, mass)

    for i in range(2):
        close(table.first_moment[i], total(place[..., i]), 1e-14)
        close(table.first_moment_rate[i], total(velocity[..., i]))
        close(table.first_moment_acceleration[i], total(acceleration[..., i]), 1e-7)
    close(table.inertia, total(np.sum(place**2, axis=-1)), 1e-14)
    close(table.inertia_rate, total(2 * np.sum(place * velocity, axis=-1)))
    close(
        table.acceleration_moment,
        total(place[..., 0] * acceleration[..., 1] - place[..., 1] * acceleration[..., 0]),
        1e-7,
    )


def test_rates_of_the_table_are_the_derivatives_of_its_values():
    def value(name, phase):
        return np.asarray(getattr(tabulate(VEHICLE, BEAT, phase), name))

    table = tabulate(VEHICLE, BEAT, PHASES)
    for name, rate_name in (
        ("first_moment", "first_moment_rate"),
        ("first_moment_rate", "first_moment_acceleration"),
        ("inertia", "inertia_rate"),
    ):
        found = rate(lambda p, name=name: value(name, p), BEAT, PHASES)
        close(getattr(table, rate_name), found, 1e-8)
        wrong = rate(lambda p, name=name: value(name, p), dataclasses.replace(BEAT, frequency=8.001), PHASES)
        assert np.abs(wrong - np.asarray(getattr(table, rate_name))).max() > 1e-6 * np.abs(found).max()


def test_a_rigid_wing_keeps_its_area_and_hangs_on_its_shoulder():
    rigid = dataclasses.replace(BEAT, span_retraction=0.0, fold_amplitude=0.0, twist_ratio=1.0)
    shape = places(VEHICLE, rigid, PHASES)
    strips = strips_of(VEHICLE.wing, STRIPS)
    reach = np.linalg.norm(np.asarray(shape.quarter_chord) - VEHICLE.wing.shoulder, axis=-1)
    close(reach, np.broadcast_to(0.30 * strips.span_fraction, reach.shape), 1e-14)
    area = np.asarray(tabulate(VEHICLE, rigid, PHASES).area)
    close(area, np.broadcast_to(0.30 / STRIPS * strips.chord, area.shape), 1e-14)
    # One pitch for all strips: all normals are the same.
    close(shape.normal, np.broadcast_to(np.asarray(shape.normal)[:, :1], shape.normal.shape), 1e-14)


def test_the_wrist_has_no_effect_without_a_fold():
    straight = dataclasses.replace(BEAT, fold_amplitude=0.0)
    here, there = (tabulate(VEHICLE, dataclasses.replace(straight, wrist=w), PHASES) for w in (0.2, 0.8))
    for a, b in zip(jax.tree.leaves(here), jax.tree.leaves(there), strict=True):
        close(a, b, 1e-14)


def test_still_wings_have_no_rates():
    still = wb.Wingbeat(8.0, 0.15, 0.0, 0.20, 0.0)
    table = tabulate(VEHICLE, still, PHASES)
    for name in ("flapping_speed", "first_moment_acceleration", "inertia_rate", "acceleration_moment"):
        assert np.abs(np.asarray(getattr(table, name))).max() < 1e-12


def moved_by_a_fold(wrist):
    """Return which strips stand elsewhere at mid-upstroke when the hand folds."""
    folded = dataclasses.replace(BEAT, wrist=wrist)
    straight = dataclasses.replace(folded, fold_amplitude=0.0)
    pair = [places(VEHICLE, beat, np.array([0.75])) for beat in (folded, straight)]
    by_place, by_turn = (
        np.abs(np.asarray(getattr(pair[0], name)) - np.asarray(getattr(pair[1], name)))[0].max(axis=-1) > 1e-9
        for name in ("quarter_chord", "normal")
    )
    assert (by_place == by_turn).all()
    return by_turn.tolist()


@pytest.mark.parametrize(
    ("wrist", "arm"),
    # Strip centres are (i + 1/2)/8: one at the wrist belongs to the arm.
    [(0.0, 0), (0.0625, 1), (0.1, 1), (0.5, 4), (0.5624, 4), (0.5625, 5), (0.5626, 5), (0.9375, 8), (1.0, 8)],
)
def test_a_strip_whose_centre_is_at_or_inside_the_wrist_belongs_to_the_arm(wrist, arm):
    assert moved_by_a_fold(wrist) == [False] * arm + [True] * (STRIPS - arm)


def test_the_hand_hangs_on_the_wrist():
    """At mid-upstroke the hand's strips lie on a line from the wrist, 0.4 rad below the arm."""
    shape = places(VEHICLE, dataclasses.replace(BEAT, span_retraction=0.0), np.array([0.75]))
    place = np.asarray(shape.quarter_chord)[0] - VEHICLE.wing.shoulder
    arm = place[0] / np.linalg.norm(place[0])
    wrist = 0.45 * 0.30 * arm
    hand = place[4:] - wrist
    fraction = (np.arange(4, 8) + 0.5) / 8
    close(np.linalg.norm(hand, axis=-1), 0.30 * (fraction - 0.45), 1e-12)
    close(hand @ arm / np.linalg.norm(hand, axis=-1), np.full(4, math.cos(0.4)), 1e-12)
    beta = VEHICLE.wing.stroke_plane_angle
    assert (hand @ [-math.cos(beta), 0.0, math.sin(beta)] < np.linalg.norm(hand, axis=-1) * arm[2]).all()


def test_span_retraction_shrinks_span_and_strips_but_not_the_chord():
    shape = places(VEHICLE, BEAT, np.array([0.25, 0.75]))
    reach = np.linalg.norm(np.asarray(shape.quarter_chord)[:, 0] - VEHICLE.wing.shoulder, axis=-1)
    assert reach[1] / reach[0] == pytest.approx(0.7, rel=1e-14)
    area = np.asarray(tabulate(VEHICLE, BEAT, np.array([0.25, 0.75])).area)
    close(area[1] / area[0], np.full(STRIPS, 0.7), 1e-14)


def test_twist_applies_to_the_whole_pitch_angle():
    beat = wb.Wingbeat(8.0, 0.0, 0.0, 0.2, 0.0, twist_ratio=1.6)
    shape = places(VEHICLE, beat, np.array([0.0]))
    beta = VEHICLE.wing.stroke_plane_angle
    root_chord = [math.sin(beta), 0.0, math.cos(beta)]
    found = np.arccos(np.asarray(shape.chordwise)[0] @ root_chord)
    fraction = (np.arange(STRIPS) + 0.5) / STRIPS
    close(found, 0.2 * (1 + 0.6 * fraction), 1e-12)


def test_chord_list_is_piecewise_linear_between_equal_stations():
    wing = dataclasses.replace(VEHICLE.wing, chord=(0.1, 0.2, 0.0 + 1e-3))
    cut = strips_of(wing, 10)
    close(cut.chord, np.interp(cut.span_fraction, [0.0, 0.5, 1.0], [0.1, 0.2, 1e-3]), 1e-15)
    assert wing.mean_chord == pytest.approx((0.1 / 2 + 0.2 + 1e-3 / 2) / 2)


def test_a_list_of_equal_chords_is_a_number():
    listed = dataclasses.replace(VEHICLE.wing, chord=(0.1, 0.1, 0.1))
    number = dataclasses.replace(VEHICLE.wing, chord=0.1)
    close(strips_of(listed, 7).chord, strips_of(number, 7).chord, 1e-15)
    assert listed.mean_chord == pytest.approx(number.mean_chord, rel=1e-15)


@settings(derandomize=True, deadline=None, max_examples=50)
@given(st.floats(1e-4, 1.0), st.floats(0.0, 6.0), st.sampled_from([1, 10, 33]))
def test_strip_masses_are_those_of_the_law(mass, exponent, count):
    wing = dataclasses.replace(VEHICLE.wing, mass=mass, mass_exponent=exponent)
    found = np.asarray(strips_of(wing, count).mass)
    assert found.sum() == pytest.approx(mass, rel=1e-13)
    fraction = (np.arange(count) + 0.5) / count
    np.testing.assert_allclose(found / found[0], ((1 - fraction) / (1 - fraction[0])) ** exponent, rtol=1e-11)


def test_mass_points_have_the_moments_of_a_uniform_strip():
    """Mass at mid-chord and second moment c^2/12 about it, along the chord and nowhere else."""
    shape = places(VEHICLE, BEAT, PHASES)
    chord = np.asarray(strips_of(VEHICLE.wing, STRIPS).chord)
    middle = np.asarray(shape.quarter_chord) - 0.25 * chord[:, None] * np.asarray(shape.chordwise)
    pair = np.moveaxis(np.asarray(shape.mass), -3, 0)
    close(pair.mean(axis=0), middle, 1e-14)
    away = pair - middle
    along = np.sum(away * np.asarray(shape.chordwise), axis=-1)
    close(np.mean(along**2, axis=0), np.broadcast_to(chord**2 / 12, along.shape[1:]), 1e-13)
    close(np.sum(away**2, axis=-1), along**2, 1e-12)


def test_strips_that_fill_a_vector_up_bear_no_load_and_no_mass():
    plain, filled = (
        compiled(lambda vehicle, vector=vector: wing_motion(vehicle, BEAT, PHASES, 5, vector))(VEHICLE)
        for vector in (1, 8)
    )
    for name, found in filled._asdict().items():
        leaves = zip(jax.tree.leaves(found), jax.tree.leaves(getattr(plain, name)), strict=True)
        for leaf, of_five in leaves:
            by_strip = of_five.shape[0] == 5 and of_five.ndim == 2
            assert leaf.shape == ((8, *of_five.shape[1:]) if by_strip else of_five.shape)
            np.testing.assert_allclose(leaf[:5] if by_strip else leaf, of_five, rtol=1e-12, atol=1e-15)
    assert (filled.area[5:] == 0.0).all()
    assert np.isfinite(filled.pitch).all()
