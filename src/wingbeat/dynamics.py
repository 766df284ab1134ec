"""The body's accelerations with the wing motion prescribed: force and moment balance in body axes.

The first three rows of Su et al. 2023 (doi 10.48550/arXiv.2302.09602), eq. of motion, summed over mass points:
``sum m r'' = F + M g`` and ``sum m (dr/dpsi) . (r'' - g) = moment``, with
``r'' = p'' + psi'' E b - psi'^2 b + 2 psi' E b' + b''`` in body axes, E turning nose-up by a right angle.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from wingbeat.aero.blade_element import StripForces, strip_forces
from wingbeat.frames import Pair, body_to_world, world_to_body
from wingbeat.jax64 import jnp
from wingbeat.vehicle import Vehicle
from wingbeat.wing_motion import WingMotion, dot, turned


class BodyLoads(NamedTuple):
    """Air loads on the whole vehicle in body axes, both wings and body drag: (forward, up) [N], moment [N m]."""

    force: Pair
    moment: Any


def wing_loads(
    kernel: Any,
    density: Any,
    motion: WingMotion,
    body_velocity: Pair,
    pitch_rate: Any,
    chord: Any,
    at_centre_of_pressure: bool,
) -> tuple[StripForces, BodyLoads]:
    """Return the strips' loads (one wing) and their sum over both wings, body axes.

    The velocity that makes alpha is that of the quarter chord, wherever the force acts.
    """
    chord_speed = dot(body_velocity, motion.chordwise) + pitch_rate * motion.lever_chord + motion.drift_chord
    normal_speed = dot(body_velocity, motion.normal) + pitch_rate * motion.lever_normal + motion.drift_normal
    strips = strip_forces(kernel, density, motion.area, chord_speed, normal_speed)
    along, across = strips.chordwise, strips.normal
    moment = along * motion.lever_chord + across * motion.lever_normal
    if at_centre_of_pressure:
        ahead = pressure_offset(kernel, strips.alpha, chord)
        moment = moment + across * ahead * dot(turned(motion.chordwise), motion.normal)
    force = tuple(
        2.0 * jnp.sum(along * c + across * n, axis=0) for c, n in zip(motion.chordwise, motion.normal, strict=True)
    )
    return strips, BodyLoads((force[0], force[1]), 2.0 * jnp.sum(moment, axis=0))


def pressure_offset(kernel: Any, alpha: Any, chord: Any) -> Any:
    """Return how far the centre of pressure lies ahead of the quarter chord [m]."""
    return chord * (0.25 - kernel.centre_of_pressure(alpha))


def body_drag(drag_area: Any, density: Any, body_velocity: Pair) -> Pair:
    """Return the drag of the body at its centre of mass ``-1/2 rho S |v| v``, (forward, up) [N]."""
    squared = dot(body_velocity, body_velocity)
    moving = squared > 0.0
    speed = jnp.where(moving, jnp.sqrt(jnp.where(moving, squared, 1.0)), 0.0)
    pressure_area = -0.5 * density * drag_area * speed
    return pressure_area * body_velocity[0], pressure_area * body_velocity[1]


def accelerations(
    vehicle: Vehicle, gravity: Any, motion: WingMotion, loads: BodyLoads, body_pitch: Any, pitch_rate: Any
) -> tuple[Any, Any, Any]:
    """Return the body's accelerations (x'', z'') in the world [m/s2] and psi'' [rad/s2].

    The three rows are linear in (a, psi''), a the acceleration in body axes:
    ``M a + psi'' E S = F + M g + psi'^2 S - 2 psi' E S' - S''`` and
    ``(E S) . a + I psi'' = moment + (E S) . g - psi' I' - K``, S the wings' first moment, I the pitch
    inertia of body and wings, K the wings' swirl.
    """
    mass = vehicle.mass
    pull = world_to_body(body_pitch, 0.0, -gravity)
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
    ax, az = body_to_world(body_pitch, forward, up)
    return ax, az, pitch_acceleration
