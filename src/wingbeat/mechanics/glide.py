"""Steady glide with the wings held still: the balance of forces and moment, and the torques that hold the wings.

In steady glide nothing accelerates, so the five-coordinate equations say what must act on each coordinate:
``tau = g - f_aero``. Its first two components vanish if the forces balance; the third is the moment that a tail
would have to supply; the last two are the torques with which the hinges hold the wings. With a plain wing at the
body's centre of mass the first two equations are ``C_L cos(gamma) + C_D sin(gamma) = 2 M g / (rho V^2 S)`` and
``tan(gamma) = C_D / C_L``.
"""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat._jax.arrays import jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, unpack
from wingbeat.mechanics.equations_of_motion import air_forces, equations_of_motion
from wingbeat.mechanics.flight_model import FlightModel, at_velocity
from wingbeat.mechanics.wing_shape import stroke_pitch

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Coordinates, Scalar


TRIMS = ("body-pitch", "flap", "tail")
# Balanced means: force / weight and moment / (weight times chord) are at most this.
_BALANCED = 1e-11
# Steps, from no trim to each end of its range, in which a sign change of the moment is sought.
_STEPS = 12


class Posture(NamedTuple):
    """What defines a steady glide."""

    speed: Scalar  # along the path [m/s]
    glide_angle: Scalar  # of the path below the horizontal [rad]
    body_above_path: Scalar  # angle of the body above the path [rad]
    flap: Scalar  # [rad]
    angle_of_attack: Scalar  # of the root chord at zero flap angle [rad]
    tail_tilt: Scalar = 0.0  # added to the tail's incidence [rad]


class Glide(NamedTuple):
    """One steady glide; torques are of both wings together."""

    angle_of_attack: float  # of the root chord at zero flap angle [rad]
    speed: float  # along the path [m/s]
    sink: float  # downwards [m/s]
    glide_angle: float  # of the path below the horizontal [rad]
    glide_ratio: float  # distance over height lost
    body_pitch: float  # [rad]
    wing_pitch: float  # [rad]
    flap: float  # [rad]
    tail_tilt: float  # added to the tail's incidence [rad]; 0 without a tail
    tail_moment: float  # that a tail, or a further one, would need to supply, nose-up positive [N m]; 0 if trimmed
    flap_torque: float  # that holds the wings [N m]
    pitch_torque: float
    trimmed: bool  # whether the pitching moment vanishes


# The number of a posture that each trim turns.
_COLUMNS = {"body-pitch": 2, "flap": 3, "tail": 5}


def held_still(wingbeat: Wingbeat) -> Wingbeat:
    """Return a wingbeat with wings held still: spread and straight, as at mid-downstroke, with the same twist."""
    still = {"flap_amplitude": 0.0, "pitch_amplitude": 0.0, "span_retraction": 0.0, "fold_amplitude": 0.0}
    # A glide is at phase 0, where harmonics would be those of the top of the stroke.
    bare = {"chord_retraction": 0.0, "chord_harmonics": (), "twist_harmonics": ()}
    return dataclasses.replace(wingbeat, **still, **bare)


def _angles(model: FlightModel, posture: Posture) -> tuple[Scalar, Scalar]:
    """Return body pitch and wing pitch [rad]."""
    body_pitch = posture.body_above_path - posture.glide_angle
    above_body = posture.angle_of_attack - posture.body_above_path
    return body_pitch, above_body - stroke_pitch(model.vehicle.wing.stroke_plane_angle)


@exported
def _required(model: FlightModel, wingbeat: Wingbeat, numbers: Coordinates) -> Coordinates:
    """Return what must act on the five coordinates in a posture; without a tail, it has no last number."""
    posture = Posture(*numbers)
    if model.vehicle.tail is not None:
        wingbeat = unpack(("tail_tilt",), wingbeat, numbers[5:])
    body_pitch, wing_pitch = _angles(model, posture)
    none = jnp.zeros(())
    ahead, down = posture.speed * jnp.cos(posture.glide_angle), posture.speed * jnp.sin(posture.glide_angle)
    model = at_velocity(model, (ahead, -down))
    q = jnp.stack([none, none, body_pitch, posture.flap, wing_pitch])
    q_dot = jnp.stack([ahead, -down, none, none, none])
    gravity = equations_of_motion(model, wingbeat, q, q_dot, none).gravity_force
    return gravity - air_forces(model, wingbeat, q, q_dot, none).generalised


class GlideSolver:
    """Finds steady glides of one vehicle at given angles of attack; its wings are held at one flap angle [rad].

    `trim` turns until the pitching moment vanishes, within `reach` [rad]. With ``"body-pitch"``, the wings keep
    their angle of attack; with ``"flap"`` or ``"tail"``, the body stays along the path. Without a tail, ``"tail"``
    turns nothing.
    """

    def __init__(
        self, model: FlightModel, wingbeat: Wingbeat, flap: float, trim: str, reach: tuple[float, float]
    ) -> None:
        self.model, self._flap, self._trim, self._reach = model, flap, trim, reach
        self._required, self._tilt = _required.bind(model, held_still(wingbeat)), wingbeat.tail_tilt
        weight = model.vehicle.mass * model.air.gravity
        self._scale = np.array([weight, weight, weight * model.vehicle.wing.mean_chord])

    def at(self, angle_of_attack: float) -> Glide:
        """Return the glide at an angle of attack; all its numbers are NaN if the forces cannot balance."""
        start = Posture(*self._closed_form(angle_of_attack), 0.0, self._flap, angle_of_attack, self._tilt)
        posture = self._solve(start, rows=2, free=[0, 1])
        if posture is None:
            nowhere = Posture(*[math.nan] * 6)._replace(angle_of_attack=angle_of_attack)
            return self._glide_of(nowhere, trimmed=False)
        no_tail = self._trim == "tail" and self.model.vehicle.tail is None
        turned = None if no_tail else self._trimmed(posture)
        return self._glide_of(turned or posture, trimmed=turned is not None)

    def _trimmed(self, untrimmed: Posture) -> Posture | None:
        """Return the trimmed posture nearest to `untrimmed`, or None; the forces balance in every posture tried."""
        column, reach = _COLUMNS[self._trim], np.array(self._reach)
        if self._trim == "body-pitch":
            reach = reach + untrimmed.glide_angle  # above the path, not the horizontal
        ends: list[tuple[Posture, float] | None] = [(untrimmed, self._moment(untrimmed))] * 2
        for step in range(1, _STEPS + 1):
            for side, end in enumerate(ends):
                if end is None:
                    continue
                angle = untrimmed[column] + step / _STEPS * (reach[side] - untrimmed[column])
                turned = Posture(*(angle if i == column else value for i, value in enumerate(end[0])))
                there = self._solve(turned, rows=2, free=[0, 1])
                if there is None:
                    ends[side] = None
                    continue
                (last, opposite), moment = end, self._moment(there)
                if moment * opposite <= 0.0:  # between the two, to where a straight line has no moment
                    share = opposite / (opposite - moment) if opposite != moment else 0.0
                    between = Posture(*(a + share * (b - a) for a, b in zip(last, there, strict=True)))
                    found = self._solve(between, rows=3, free=[0, 1, column])
                    if found is not None and reach[0] <= found[column] <= reach[1]:
                        return found
                ends[side] = there, moment
        return None

    def _evaluate(self, numbers: np.ndarray) -> np.ndarray:
        """Return what must act on the five coordinates in a posture."""
        return np.asarray(self._required(numbers if self.model.vehicle.tail is not None else numbers[:5]))

    def _moment(self, posture: Posture) -> float:
        return float(self._evaluate(np.array(posture))[2])

    def _closed_form(self, alpha: float) -> tuple[float, float]:
        """Return speed and glide angle of a simple wing that approximates this one, in closed form."""
        vehicle, air = self.model.vehicle, self.model.air
        # One strip stands for all: this glide is only where the search for the balance starts.
        lift, drag = (float(c[0]) for c in self.model.kernel.lift_drag(jnp.asarray([alpha])))
        area = 2.0 * vehicle.wing.semi_span * vehicle.wing.mean_chord
        drag += vehicle.body.drag_area / area
        if vehicle.tail is not None:
            drag += vehicle.tail.drag_coefficient * vehicle.tail.area / area
        pressure = vehicle.mass * air.gravity / (area * math.hypot(lift, drag))
        return math.sqrt(2.0 * pressure / air.density), math.atan2(drag, lift)

    def _solve(self, start: Posture, rows: int, free: list[int]) -> Posture | None:
        """Return the posture near `start` in which the first `rows` components vanish, or None."""
        from scipy.optimize import root

        held = np.array(start)

        def numbers(unknowns: np.ndarray) -> np.ndarray:
            found = held.copy()
            found[free] = unknowns
            return found

        def residual(unknowns: np.ndarray) -> np.ndarray:
            return self._evaluate(numbers(unknowns))[:rows] / self._scale[:rows]

        found = root(residual, held[free], tol=1e-14)
        posture = Posture(*numbers(found.x).tolist())
        # `root` may report a failure where the residual is one bit too large.
        balanced = np.abs(residual(found.x)).max() <= _BALANCED
        # The forces also balance where a wing falls broadside.
        ahead = posture.speed > 0.0 and abs(posture.glide_angle) < 0.5 * math.pi
        return posture if balanced and ahead else None

    def _glide_of(self, posture: Posture, trimmed: bool) -> Glide:
        required = self._evaluate(np.array(posture))
        body_pitch, wing_pitch = _angles(self.model, posture)
        return Glide(
            posture.angle_of_attack,
            posture.speed,
            posture.speed * math.sin(posture.glide_angle),
            posture.glide_angle,
            1.0 / math.tan(posture.glide_angle),
            body_pitch,
            wing_pitch,
            posture.flap,
            posture.tail_tilt,
            0.0 if trimmed else float(required[2]),
            float(required[3]),
            float(required[4]),
            trimmed,
        )
