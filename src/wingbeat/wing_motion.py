"""The wing's motion in body axes, which depends on time alone: strips, mass points and their rates.

Everything here is for the left wing; sums over mass points count both wings. Strips are the first axis and times
the last, because XLA on CPU works along the last axis, and strips are few.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from wingbeat.frames import Pair, Triple, span_axis, wing_axes
from wingbeat.jax64 import jax, jnp
from wingbeat.kinematics import Wingbeat, flap_angle, fold_angle, pitch_angle, span_ratio
from wingbeat.vehicle import Vehicle, Wing


class Strips(NamedTuple):
    """What of the strips does not change with time, shape (N,) each, or (N, 1, ..) beside as many axes of time."""

    span_fraction: Any
    chord: Any
    mass: Any


class WingShape(NamedTuple):
    """Where the strips are, body axes: triples (forward, left, up) of arrays of shape (N, ...)."""

    quarter_chord: Triple
    chordwise: Triple
    normal: Triple


class WingMotion(NamedTuple):
    """What the body feels of the wing, with any trailing axes of times.

    In-plane vectors are pairs (forward, up). ``lever_*`` is the speed of a quarter chord per unit
    pitch rate along chord and normal, ``drift_*`` its speed from flapping alone. ``first_moment``
    and ``inertia`` sum mass times place and mass times place squared, ``swirl`` mass times (place
    turned by a right angle) . acceleration, over the mass points of both wings.
    """

    chordwise: Any
    normal: Any
    lever_chord: Any
    lever_normal: Any
    drift_chord: Any
    drift_normal: Any
    area: Any
    first_moment: Any
    first_moment_rate: Any
    first_moment_acceleration: Any
    inertia: Any
    inertia_rate: Any
    swirl: Any


def strips_of(wing: Wing, count: int) -> Strips:
    """Cut a wing into `count` equal strips: span fractions, chords at strip centres [m], strip masses [kg].

    A strip's mass is proportional to ``(1 - s/L)**p``, normalised to the mass of the wing.
    """
    span_fraction = (jnp.arange(count) + 0.5) / count
    stations = jnp.atleast_1d(jnp.asarray(wing.chord, dtype=float))
    if stations.size == 1:
        chord = jnp.broadcast_to(stations, (count,))
    else:
        chord = jnp.interp(span_fraction, jnp.linspace(0.0, 1.0, stations.size), stations)
    share = (1.0 - span_fraction) ** wing.mass_exponent
    return Strips(span_fraction, chord, wing.mass * share / jnp.sum(share))


def beside(strips: Strips, times: Any) -> Strips:
    """Return the strips with an axis of length one for each axis of `times`."""
    return Strips(*(jnp.expand_dims(a, tuple(range(1, 1 + jnp.ndim(times)))) for a in strips))


def twist_factors(wingbeat: Wingbeat, span_fraction: Any) -> Any:
    """Return each strip's wing pitch over that of the root, ``1 + (twist_ratio - 1) s/L``."""
    return 1.0 + (wingbeat.twist_ratio - 1.0) * span_fraction


def wing_shape(
    vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, phase: Any, flap: Any, pitch: Any
) -> WingShape:
    """Place the strips for given flap and root pitch [rad]; span and fold follow the phase.

    Inboard of the wrist a strip follows the flap angle of the arm, outboard that of the hand.
    """
    wing = vehicle.wing
    length = wing.semi_span * span_ratio(wingbeat, phase)
    hand_flap = flap - fold_angle(wingbeat, phase)
    arm = jnp.minimum(strips.span_fraction, wingbeat.wrist)
    hand = jnp.maximum(strips.span_fraction - wingbeat.wrist, 0.0)
    arm_axis = span_axis(flap, wing.stroke_plane_angle)
    hand_axis = span_axis(hand_flap, wing.stroke_plane_angle)
    x, y, z = (
        place + arm * (length * a) + hand * (length * h)
        for place, a, h in zip(wing.shoulder, arm_axis, hand_axis, strict=True)
    )
    of_arm = strips.span_fraction <= wingbeat.wrist
    x_span, y_span, z_span = (jnp.where(of_arm, a, h) for a, h in zip(arm_axis, hand_axis, strict=True))
    strip_pitch = pitch * twist_factors(wingbeat, strips.span_fraction)
    chordwise, normal = wing_axes((x_span, y_span, z_span), strip_pitch, wing.stroke_plane_angle)
    return WingShape((x, y, z), chordwise, normal)


def shape_at(vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, phase: Any) -> WingShape:
    """Place the strips at a phase of the prescribed wingbeat."""
    flap, pitch = flap_angle(wingbeat, phase), pitch_angle(wingbeat, phase)
    return wing_shape(vehicle, wingbeat, strips, phase, flap, pitch)


def mass_points(shape: WingShape, strips: Strips) -> Triple:
    """Return the mass points, body axes, a triple of shape (2, N, ...); each carries half its strip's mass.

    Two points at mid-chord +- c/(2 sqrt 3) have the second moment of a uniform strip.
    """
    offsets = jnp.stack([strips.chord * (-0.25 + half / math.sqrt(3)) for half in (0.5, -0.5)])
    x, y, z = (place + offsets * fore for place, fore in zip(shape.quarter_chord, shape.chordwise, strict=True))
    return x, y, z


def time_rates(function: Any, phase: Any, frequency: Any) -> tuple[Any, Any, Any]:
    """Return a function of phase with its first and second time derivatives, exactly."""
    per_second = frequency * jnp.ones_like(phase)

    def rate(at: Any) -> tuple[Any, Any]:
        return jax.jvp(function, (at,), (per_second,))

    (value, first), (_, second) = jax.jvp(rate, (phase,), (per_second,))
    return value, first, second


def in_plane(vector: Triple) -> Pair:
    """Return the (forward, up) pair of a triple (forward, left, up)."""
    return vector[0], vector[2]


def turned(pair: Pair) -> Pair:
    """Turn an in-plane pair nose-up by a right angle."""
    return -pair[1], pair[0]


def dot(a: tuple[Any, ...], b: tuple[Any, ...]) -> Any:
    """Return the scalar product of two pairs or of two triples."""
    products = [one * other for one, other in zip(a, b, strict=True)]
    return sum(products[1:], products[0])


def wing_motion(vehicle: Vehicle, wingbeat: Wingbeat, phase: Any, count: int) -> WingMotion:
    """Tabulate what body and air see of the wing at the given phases, in one pass."""
    phase = jnp.asarray(phase, dtype=float)
    strips = beside(strips_of(vehicle.wing, count), phase)

    def shape_and_points(at: Any) -> tuple[WingShape, Any]:
        shape = shape_at(vehicle, wingbeat, strips, at)
        return shape, mass_points(shape, strips)

    (shape, points), (shape_rate, velocity), (_, acceleration) = time_rates(
        shape_and_points, phase, wingbeat.frequency
    )

    def total(values: Any) -> Any:
        # Each point carries half its strip's mass, and there are two wings.
        return jnp.sum(strips.mass * values, axis=(0, 1))

    place, speed, push = in_plane(points), in_plane(velocity), in_plane(acceleration)
    chordwise, normal = in_plane(shape.chordwise), in_plane(shape.normal)
    lever = turned(in_plane(shape.quarter_chord))
    length = vehicle.wing.semi_span * span_ratio(wingbeat, phase)
    return WingMotion(
        chordwise=chordwise,
        normal=normal,
        lever_chord=dot(lever, chordwise),
        lever_normal=dot(lever, normal),
        drift_chord=dot(shape_rate.quarter_chord, shape.chordwise),
        drift_normal=dot(shape_rate.quarter_chord, shape.normal),
        area=length / count * strips.chord,
        first_moment=(total(place[0]), total(place[1])),
        first_moment_rate=(total(speed[0]), total(speed[1])),
        first_moment_acceleration=(total(push[0]), total(push[1])),
        inertia=total(dot(place, place)),
        inertia_rate=2.0 * total(dot(place, speed)),
        swirl=total(dot(turned(place), push)),
    )
