"""Blade elements: from the velocity of each strip to its lift and drag.

Su et al. 2023 (doi 10.48550/arXiv.2302.09602): ``dL = 1/2 rho V^2 c dr C_L(alpha)`` normal to the velocity of the
strip, ``dD`` against it. Angle of attack and directions are measured in the plane of chord and normal. V is either
the speed in that plane or the whole airspeed of the segment, including its part along the span; the words of Su et
al. describe the latter.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import atan2, elementwise_jvp, jnp
from wingbeat.aero.closed_forms import damping_couple, rotation_force
from wingbeat.aero.family import at_reynolds, depends_on_reynolds

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles, PerStrip, PerStripBroadcast, Phases, Scalar
    from wingbeat.aero.coefficient_model import Kernel


class StripForces(NamedTuple):
    """Air load of each strip of one wing: the forces [N], and the speed and angle that determine them, as arrays.

    `chordwise` and `normal` are along the two axes in which the speeds were given, of the pitched or the unpitched
    chord.
    """

    chordwise: PerStrip
    normal: PerStrip
    alpha: PerStrip
    speed: PerStrip  # the airspeed V that determines the loads
    lift: PerStrip  # from the coefficients alone
    drag: PerStrip
    couple: PerStrip | None = None  # [N m], leading edge up; None without unsteady loads of turning strips


def strip_forces(
    kernel: Kernel,
    density: Scalar,
    area: PerStrip,
    chord_speed: PerStrip,
    normal_speed: PerStrip,
    pitch: PerStrip,
    span_speed: PerStrip | None = None,
    chord_over_viscosity: PerStrip | None = None,
) -> StripForces:
    """Return the air loads of strips of given areas [m2] moving at given speeds along two axes [m/s].

    The chord is pitched by `pitch` from the first axis towards the second, so ``alpha = pitch - gamma`` where
    ``gamma = atan2(v_n, v_c)`` is the direction of the motion. If a speed along the span is given, V is the
    magnitude of all three components. A strip that moves only along its span has no angle of attack and no load.
    `chord_over_viscosity` [s/m] is used by coefficients that depend on the Reynolds number, ``V c / viscosity``.

    Theory: equations ``angle-of-attack``, ``lift-drag`` and ``strip-force``.
    """
    along_span = () if span_speed is None else (span_speed,)
    which = (kernel, chord_over_viscosity) if depends_on_reynolds(kernel) else (kernel,)
    unit = _unit_forces(which, chord_speed, normal_speed, pitch, *along_span)
    pressure_area = 0.5 * density * area
    forces = {name: pressure_area * getattr(unit, name) for name in ("chordwise", "normal", "lift", "drag")}
    return unit._replace(**forces)


def with_turning(
    forces: StripForces,
    density: Scalar,
    chord: PerStripBroadcast,
    width: Phases,
    turning: PerStrip,
    chord_speed: PerStrip,
    normal_speed: PerStrip,
) -> StripForces:
    """Return the loads with those of a turning chord added: rotational force, and couple against the turning."""
    along, across = rotation_force(density, chord, width, turning, chord_speed, normal_speed)
    return forces._replace(
        chordwise=forces.chordwise + along,
        normal=forces.normal + across,
        couple=damping_couple(density, chord, width, turning, forces.speed),
    )


@elementwise_jvp
def _coefficients(kernel: Kernel, alpha: Angles, *reynolds: Angles) -> tuple[Angles, Angles]:
    return (at_reynolds(kernel, *reynolds) if reynolds else kernel).lift_drag(alpha)


@elementwise_jvp
def _unit_forces(
    which: tuple[Any, ...], chord_speed: PerStrip, normal_speed: PerStrip, pitch: PerStrip, *span_speed: PerStrip
) -> StripForces:
    """Return the loads of strips for which ``density * area / 2`` is one."""
    squared = chord_speed * chord_speed + normal_speed * normal_speed
    # The square root has no derivative at rest; there the loads vanish with the speed.
    moving = squared > 0.0
    speed = jnp.where(moving, jnp.sqrt(jnp.where(moving, squared, 1.0)), 0.0)
    angle = pitch - atan2(normal_speed, chord_speed)
    alpha = angle - 2 * math.pi * jnp.round(angle * (0.5 / math.pi))  # whole turns bring it into [-pi, pi]
    planar, share = speed, speed  # V^2 over the planar speed; times a velocity in the plane, it is a force
    if span_speed:
        whole = squared + span_speed[0] * span_speed[0]
        share = jnp.where(moving, whole / jnp.where(moving, planar, 1.0), 0.0)
        speed = jnp.where(moving, jnp.sqrt(jnp.where(moving, whole, 1.0)), 0.0)
    kernel, *chord_over_viscosity = which
    c_l, c_d = _coefficients(kernel, alpha, *(speed * one for one in chord_over_viscosity))
    lift, drag = share * c_l, share * c_d
    return StripForces(
        chordwise=-lift * normal_speed - drag * chord_speed,
        normal=lift * chord_speed - drag * normal_speed,
        alpha=alpha,
        speed=speed,
        lift=lift * planar,
        drag=drag * planar,
    )
