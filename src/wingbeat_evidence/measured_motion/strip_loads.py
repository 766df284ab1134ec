"""The air loads of a measured motion by one coefficient model and a choice of further terms."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._jax.arrays import in_own_settings, jax, jnp
from wingbeat.aero.blade_element import BladeElement
from wingbeat.aero.closed_forms import added_inertia, added_mass, disc_area, induced_flow
from wingbeat.aero.coefficient_model import Kernel
from wingbeat.aero.strip_forces import StripForces, strip_forces, with_turning
from wingbeat_evidence.measured_motion.strip_case import StripCase
from wingbeat_evidence.measured_motion.strip_motion import StripMotion, semi_span
from wingbeat_evidence.measured_motion.wake import sampled_wake, strip_downwash

Array = NDArray[np.float64]


@dataclass(frozen=True)
class StripLoads:
    """The air loads of a measured motion through time.

    Attributes
    ----------
    fx, fz : forward and upward force of all wings [N], shape (n,).
    power : power that the wings give to the air [W], shape (n,): minus the power of loads and couples on the wing's
        motion through still air.
    alpha : angle of attack of each strip in the air that its wake moves [rad], shape (n, strips).
    """

    fx: Array
    fz: Array
    power: Array
    alpha: Array


def momentum_inflow(case: StripCase, factor: float) -> tuple[float, float]:
    """Return the velocity of the induced flow for the weight and speed of a case, forward and up [m/s].

    Parameters
    ----------
    case : the measured motion, whose wings span the disc.
    factor : induced power over that of an ideal disc.
    """
    area, force = disc_area(semi_span(case)), (0.0, case.weight)
    forward, up = induced_flow(case.density, area, factor, force, (case.speed, 0.0))
    return float(forward), float(up)


@in_own_settings
def strip_loads(case: StripCase, motion: StripMotion, moving: StripMotion, aero: BladeElement) -> StripLoads:
    """Return the air loads of the wings of a case.

    Parameters
    ----------
    case : the measured motion.
    motion : motion of the strips through still air, from `strip_motion`.
    moving : motion of the strips through the air at the wings; with inflow, from `StripMotion.in_moving_air`.
    aero : coefficients and terms; its number of strips and its force point are not used.
    """
    turns, kernel = aero.unsteady != "none", aero.kernel()
    met = moving if aero.wake == "none" else _in_wake(case, moving, kernel)
    numbers = (motion.chord, motion.width, met.chord_speed, met.normal_speed, motion.turning)
    loads = (_turning if turns else _steady)(kernel, case.density, case.area, *numbers)
    chordwise, normal = np.asarray(loads.chordwise), np.asarray(loads.normal)
    given = chordwise * motion.chord_speed + normal * motion.normal_speed
    if loads.couple is not None:
        mass = added_mass(case.density, motion.chord, motion.width)
        inertia = added_inertia(case.density, motion.chord, motion.width)
        across = -mass * moving.middle_rate
        couple = np.asarray(loads.couple) - inertia * motion.turning_rate
        # The added mass acts at mid-chord, where the normal speed differs from that of the quarter chord.
        middle_speed = motion.normal_speed - 0.25 * motion.chord * motion.turning
        given = given + across * middle_speed + couple * motion.turning
        normal = normal + across
    wings = 2.0 if case.mirrored else 1.0
    force = chordwise[..., None] * motion.ahead + normal[..., None] * motion.normal
    total = wings * force.sum(axis=1)
    return StripLoads(total[:, 0], total[:, 2], -wings * given.sum(axis=1), np.asarray(loads.alpha))


def _in_wake(case: StripCase, moving: StripMotion, kernel: Kernel) -> StripMotion:
    """Return the motion through air that the shed wake of each strip moves down, across the strip's chord."""
    speed = np.hypot(moving.chord_speed, moving.normal_speed) / (0.5 * moving.chord)
    following, steps = np.roll(speed, -1, axis=0), np.diff(case.times)
    if case.period is not None:
        steps = np.append(steps, max(case.period - (case.times[-1] - case.times[0]), 0.0))
    travelled = 0.5 * (speed + following)[: len(steps)] * steps[:, None]
    shed = strip_downwash(kernel, moving.chord, moving.chord_speed, moving.normal_speed, moving.turning)
    wake = sampled_wake(shed, travelled, case.period is not None)
    # In air that moves down, the strip moves up relative to the air.
    return replace(moving, normal_speed=moving.normal_speed + wake)


@jax.jit
def _steady(
    kernel: Kernel, density: float, area: Array, chord: Any, width: Any, along: Any, across: Any, turning: Any
) -> StripForces:
    return strip_forces(kernel, density, area, along, across, jnp.zeros_like(along))


@jax.jit
def _turning(
    kernel: Kernel, density: float, area: Array, chord: Any, width: Any, along: Any, across: Any, turning: Any
) -> StripForces:
    steady = strip_forces(kernel, density, area, along, across, jnp.zeros_like(along))
    return with_turning(steady, density, chord, width, turning, along, across)
