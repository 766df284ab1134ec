"""The body's accelerations with the wing motion prescribed: force and moment balance in stroke axes.

The first three rows of Su et al. 2023 (doi 10.48550/arXiv.2302.09602), eq. of motion, summed over mass points:
``sum m r'' = F + M g`` and ``sum m (dr/dpsi) . (r'' - g) = moment``, with
``r'' = p'' + psi'' E b - psi'^2 b + 2 psi' E b' + b''`` in axes that turn with the body, E turning nose-up by a
right angle.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from wingbeat._jax.config import jnp
from wingbeat._jax.elementary import cos, sin
from wingbeat.aero.blade_element import StripForces, strip_forces
from wingbeat.mechanics.frames import Pair, from_world, to_world
from wingbeat.mechanics.wing_motion import WingMotion, dot, over_strips, turned
from wingbeat.vehicle import Vehicle


class BodyLoads(NamedTuple):
    """Air loads on the whole vehicle in stroke axes, wings and body: (forward, up) [N], nose-up moment [N m]."""

    force: Pair
    moment: Any


def strip_loads(kernel: Any, density: Any, motion: WingMotion, velocity: Pair, pitch_rate: Any) -> StripForces:
    """Return the loads of the strips of one wing; `velocity` is that of the body in stroke axes.

    The velocity that makes alpha is that of the quarter chord, wherever the force acts. Chord and normal are here
    those that the strip has without pitch.
    """
    forward_speed, up_speed = velocity[0] - pitch_rate * motion.above, velocity[1] + pitch_rate * motion.ahead
    normal_speed = up_speed * motion.flap_cosine + motion.flapping_speed
    chord_speed = forward_speed
    if motion.level is not None:
        chord_speed = dot(motion.level, (forward_speed, up_speed)) + motion.sweeping_speed
    span_speed = None
    if motion.span is not None:
        span_speed = dot(motion.span, (forward_speed, up_speed)) + motion.spanning_speed
    return strip_forces(kernel, density, motion.area, chord_speed, normal_speed, motion.pitch, span_speed)


def strip_moments(kernel: Any, motion: WingMotion, strips: StripForces) -> Any:
    """Return the moments about the quarter chords of loads at the centre of pressure, leading edge up [N m]."""
    across = strips.normal * cos(motion.pitch) - strips.chordwise * sin(motion.pitch)
    return pressure_offset(kernel, strips.alpha, motion.area / motion.width) * across


def wing_loads(
    kernel: Any,
    density: Any,
    motion: WingMotion,
    velocity: Pair,
    pitch_rate: Any,
    at_centre_of_pressure: bool,
) -> BodyLoads:
    """Return the sum of the strips' loads over both wings, stroke axes; `velocity` is that of the body there."""
    strips = strip_loads(kernel, density, motion, velocity, pitch_rate)
    forward, up = strips.chordwise, strips.normal * motion.flap_cosine
    across = motion.flap_cosine  # of the span: what of a moment about it is in the plane of symmetry
    if motion.level is not None:
        forward, up = strips.chordwise * motion.level[0], up + strips.chordwise * motion.level[1]
        across = across * motion.level[0]
    moment = motion.ahead * up - motion.above * forward
    if at_centre_of_pressure:
        moment = moment + strip_moments(kernel, motion, strips) * across
    forward, up, moment = (2.0 * over_strips(a) for a in (forward, up, moment))
    return BodyLoads((forward, up), moment)


def pressure_offset(kernel: Any, alpha: Any, chord: Any) -> Any:
    """Return how far the centre of pressure lies ahead of the quarter chord [m]."""
    return chord * (0.25 - kernel.centre_of_pressure(alpha))


def body_drag(drag_area: Any, density: Any, velocity: Pair) -> Pair:
    """Return the drag of the body at its centre of mass ``-1/2 rho S |v| v`` in the axes of `velocity` [N]."""
    squared = dot(velocity, velocity)
    moving = squared > 0.0
    speed = jnp.where(moving, jnp.sqrt(jnp.where(moving, squared, 1.0)), 0.0)
    pressure_area = -0.5 * density * drag_area * speed
    return pressure_area * velocity[0], pressure_area * velocity[1]


def accelerations(
    vehicle: Vehicle, gravity: Any, motion: WingMotion, loads: BodyLoads, attitude: Any, pitch_rate: Any
) -> tuple[Any, Any, Any]:
    """Return the body's accelerations (x'', z'') in the world [m/s2] and psi'' [rad/s2].

    `attitude` is that of the stroke axes. The three rows are linear in (a, psi''), a the acceleration there:
    ``M a + psi'' E S = F + M g + psi'^2 S - 2 psi' E S' - S''`` and
    ``(E S) . a + I psi'' = moment + (E S) . g - psi' I' - K``, S the wings' first moment, I the pitch
    inertia of body and wings, K the wings' swirl.
    """
    mass = vehicle.mass
    pull = from_world(attitude, 0.0, -gravity)
    arm, coriolis = turned(motion.first_moment), turned(motion.first_moment_rate)
    push_forward, push_up = (
        loads.force[i]
        + mass * pull[i]
        + pitch_rate * (pitch_rate * motion.first_moment[i] - 2.0 * coriolis[i])
        - motion.first_moment_acceleration[i]
        for i in range(2)
    )
    turn = loads.moment + dot(arm, pull) - pitch_rate * motion.inertia_rate - motion.swirl
    inertia = vehicle.body.pitch_inertia + motion.inertia
    pitch_acceleration = (turn - dot(arm, (push_forward, push_up)) / mass) / (inertia - dot(arm, arm) / mass)
    forward = (push_forward - pitch_acceleration * arm[0]) / mass
    up = (push_up - pitch_acceleration * arm[1]) / mass
    ax, az = to_world(attitude, forward, up)
    return ax, az, pitch_acceleration
