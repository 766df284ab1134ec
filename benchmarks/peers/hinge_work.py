"""Hinge torques and powers of model.md 5, written a second time for any array library.

By d'Alembert the effort along a motion of the wing is ``sum m (r'' - g) . v - F . v``, v what that motion does to
each point in body axes. Flapping turns the whole wing about the axis `e_c0` through the shoulder; pitching turns
each strip about its quarter chord, on which the air's force acts and does no work then.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from physics import Flier, Strip, Strips, Wing, air_load, strip_at, wing_at


class HingeWork(NamedTuple):
    """Of both wings together: torques [N m] at flap and root pitch, powers [W] of hinges and of all actuators."""

    flap_torque: Any
    pitch_torque: Any
    hinge_power: Any
    actuator_power: Any


def hinge_work(
    ops: Any, flier: Flier, beat: dict[str, Any], phase: Any, state: tuple[Any, ...], bent: tuple[Any, ...]
) -> HingeWork:
    """Return torques and powers at phases where the body has a state (psi, u, w, psi') and accelerations `bent`."""
    (psi, u, w, rate), (ax, az, spin) = state, bent
    wing = wing_at(ops, flier, beat, phase)
    sin_psi, cos_psi = ops.sin(psi + flier.pitched), ops.cos(psi + flier.pitched)
    body_c, body_d = u * cos_psi + w * sin_psi, w * cos_psi - u * sin_psi
    # What every point feels of the body's flight besides its turning, gravity included.
    felt_c = ax * cos_psi + (az + flier.air.gravity) * sin_psi
    felt_d = (az + flier.air.gravity) * cos_psi - ax * sin_psi
    (ahead, above), quarter, second = flier.shoulder, flier.chord / 4, flier.chord**2 / 12

    flapping = pitching = whole = 0.0
    for lane in flier.lanes:
        strip = strip_at(ops, lane, wing)
        (so, co, *_), (st, ct, *_) = strip.flap, strip.pitch
        side, side1, side2 = _sideways(lane, wing)
        (ec, ec1, ec2), (ed, ed1, ed2), (ey, ey1, ey2) = strip.chord_c, strip.chord_d, _chord_sideways(strip)
        d, d1, d2 = (strip.place[key] for key in ("d", "d1", "d2"))

        along, across = air_load(ops, flier, wing, strip, body_c, body_d, rate)
        fy, fd = along * ey - across * ct * so, along * ed + across * ct * co

        # Accelerations of mid-chord and of the chord's direction, in stroke axes.
        mc, md = ahead - quarter * ec, above + d - quarter * ed
        mc1, md1, my1 = -quarter * ec1, d1 - quarter * ed1, side1 - quarter * ey1
        felt = (
            felt_c - quarter * ec2 - 2 * rate * md1 - spin * md - rate * rate * mc,
            side2 - quarter * ey2,
            felt_d + d2 - quarter * ed2 + 2 * rate * mc1 + spin * mc - rate * rate * md,
        )
        turned = (
            ec2 - 2 * rate * ed1 - spin * ed - rate * rate * ec,
            ey2,
            ed2 + 2 * rate * ec1 + spin * ec - rate * rate * ed,
        )

        by_flap = _dot(felt, (0.0, quarter * ed - d, side - quarter * ey)) + second * _dot(turned, (0.0, -ed, ey))
        tilting = -lane.twist * st, -lane.twist * ct * so, lane.twist * ct * co
        by_pitch = second * _dot(turned, tilting) - quarter * _dot(felt, tilting)
        by_all = _dot(felt, (mc1, my1, md1)) + second * _dot(turned, (ec1, ey1, ed1))
        flapping = flapping + ops.total(lane.mass * by_flap + fy * d - fd * side)
        pitching = pitching + ops.total(lane.mass * by_pitch)
        whole = whole + ops.total(lane.mass * by_all - fy * side1 - fd * d1)

    flap_torque, pitch_torque = 2 * flapping, 2 * pitching
    power = flap_torque * wing.flap[1] + pitch_torque * wing.tilt[1]
    return HingeWork(flap_torque, pitch_torque, power, 2 * whole)


def _dot(a: tuple[Any, ...], b: tuple[Any, ...]) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _sideways(lane: Strips, wing: Wing) -> tuple[Any, Any, Any]:
    """Return how far out a strip's quarter chord is from the shoulder, with two rates."""
    length, length1, length2 = wing.span

    def of(limb: dict[str, Any]) -> tuple[Any, Any, Any]:
        s, c, turn1, turn2 = limb["s"], limb["c"], limb["turn1"], limb["turn2"]
        bent = (length2 - length * turn1 * turn1) * c - (2 * length1 * turn1 + length * turn2) * s
        return length * c, limb["y1"], bent

    arm, hand = of(wing.arm), of(wing.hand)
    inner, outer = lane.inner, lane.outer
    return inner * arm[0] + outer * hand[0], inner * arm[1] + outer * hand[1], inner * arm[2] + outer * hand[2]


def _chord_sideways(strip: Strip) -> tuple[Any, Any, Any]:
    """Return the sideways part of the chord's direction, with two rates."""
    (so, co, p1, p2), (st, ct, t1, t2) = strip.flap, strip.pitch
    return (
        -st * so,
        -t1 * ct * so - p1 * st * co,
        -(t2 * ct - (t1 * t1 + p1 * p1) * st) * so - (2 * t1 * p1 * ct + p2 * st) * co,
    )
