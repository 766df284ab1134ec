"""The parts of a wing in MuJoCo and their joints: each joint's position is a sum of the wingbeat's laws.

A wing whose span, fold and twist are constant is one rigid part that turns about flap, sweep and pitch hinges. Any
other wing has a part for each strip, which turns and slides by itself, and a hand if the hand folds. The parts
here are parts of the left wing; the right wing is its mirror image. In a part's axes, x is along the chord to the
leading edge, y along the span to the left and z along the normal; its origin is on the line of the quarter chords.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.vehicle import Wing
from wingbeat.exports.gait import LAW_NAMES, Laws
from wingbeat.mechanics.wing_motion import strips_of, twist_factors

SIDES = {"left": 1.0, "right": -1.0}
BODY_JOINTS = ("x", "z", "body_pitch")
# MuJoCo refuses a part without mass or inertia, so a zero is written as this [kg, kg m2], too small to matter.
NOTHING = 1e-14

_AT_ZERO = np.array([float(name == "span_ratio") for name in LAW_NAMES])
_HINGES = [LAW_NAMES.index("flap"), LAW_NAMES.index("wing_pitch")]
_FLAP, _FOLD = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)
_SWEEP, _PITCH, _SPAN = (0.0, 0.0, -1.0), (0.0, -1.0, 0.0), (0.0, 1.0, 0.0)


class Joint(NamedTuple):
    """One joint of the left wing.

    Attributes
    ----------
    name : without the side.
    slides : True if the joint slides along its axis, False if it turns about it.
    axis : in the axes of its part.
    laws : its position as a sum of laws: factors [1, or m for a slide] by the laws' names.
    """

    name: str
    slides: bool
    axis: tuple[float, float, float]
    laws: dict[str, float]


class Strip(NamedTuple):
    """A strip: its number from 1 at the root, place along the span of its part [m], chord [m] and mass [kg]."""

    number: int
    station: float
    chord: float
    mass: float


@dataclass(frozen=True)
class Part:
    """A rigid part of the left wing.

    Attributes
    ----------
    name : without the side; empty for the part at the shoulder.
    station : distance of its origin from the origin of the part that holds it, along the span [m].
    joints : in MuJoCo's order: each turns or slides those after it.
    strips : the strips that belong to it.
    parts : the parts that it holds.
    """

    name: str
    station: float
    joints: tuple[Joint, ...]
    strips: tuple[Strip, ...]
    parts: tuple[Part, ...] = ()

    def all_joints(self) -> list[Joint]:
        """Return the joints of this part and of those that it holds, in MuJoCo's order."""
        return [*self.joints, *(joint for part in self.parts for joint in part.all_joints())]


def is_rigid(wingbeat: Wingbeat) -> bool:
    """Return whether the wing is one rigid part, because its span, fold and twist are constant."""
    twists = wingbeat.twist_ratio != 1.0 or wingbeat.twist_mean or wingbeat.twist_harmonics
    return not (_spans(wingbeat) or wingbeat.fold_amplitude or twists)


def check_wing(faults: FaultList, wingbeat: Wingbeat) -> None:
    """Note a fault if joints cannot represent the wing.

    A hand that folds about the axis of flap on an arm that sweeps would need two hinges with the same axis.
    """
    if wingbeat.fold_amplitude and _sweeps(wingbeat):
        rule = "on a wing that sweeps cannot be represented by MuJoCo's joints"
        faults.add(
            "wingbeat.fold_amplitude", wingbeat.fold_amplitude, rule, "export the gait as .csv, .mat or .c3d"
        )


def _sweeps(wingbeat: Wingbeat) -> bool:
    return bool(wingbeat.sweep_mean or wingbeat.sweep_amplitude or wingbeat.sweep_harmonics)


def _spans(wingbeat: Wingbeat) -> bool:
    return bool(wingbeat.span_retraction or wingbeat.span_harmonics)


def wing_parts(wing: Wing, wingbeat: Wingbeat, count: int) -> Part:
    """Return the part at the shoulder, with all that it holds.

    Parameters
    ----------
    wing : the wing.
    wingbeat : the laws that move it.
    count : number of strips.
    """
    fraction, chord, mass = (np.asarray(a) for a in strips_of(wing, count))
    shoulder = [Joint("flap", False, _FLAP, {"flap": 1.0})]
    if _sweeps(wingbeat):
        shoulder.append(Joint("sweep", False, _SWEEP, {"sweep": 1.0}))
    if is_rigid(wingbeat):
        shoulder.append(Joint("wing_pitch", False, _PITCH, {"wing_pitch": 1.0}))
        own = [Strip(i + 1, wing.semi_span * fraction[i], chord[i], mass[i]) for i in range(count)]
        return Part("", 0.0, tuple(shoulder), tuple(own))
    wrist = wingbeat.wrist if wingbeat.fold_amplitude else 1.0
    factors = np.asarray(twist_factors(wingbeat, fraction))

    def slide(name: str, reach: float) -> tuple[Joint, ...]:
        return (Joint(f"span_{name}", True, _SPAN, {"span_ratio": reach}),) if _spans(wingbeat) else ()

    def part(i: int, inner: float) -> Part:
        reach = wing.semi_span * float(fraction[i] - inner)
        turn = {"wing_pitch": float(factors[i]), "tip_twist": float(fraction[i])}
        pitch = Joint(f"wing_pitch_{i + 1}", False, _PITCH, turn)
        only = Strip(i + 1, 0.0, chord[i], mass[i])
        return Part(f"strip_{i + 1}", reach, (*slide(str(i + 1), reach), pitch), (only,))

    held = [part(i, 0.0) for i in range(count) if fraction[i] <= wrist]
    outer = tuple(part(i, wrist) for i in range(count) if fraction[i] > wrist)
    if outer:
        reach = wing.semi_span * wrist
        fold = Joint("fold", False, _FOLD, {"fold": 1.0})
        held.append(Part("hand", reach, (*slide("hand", reach), fold), (), outer))
    return Part("", 0.0, tuple(shoulder), (), tuple(held))


class JointMotion(NamedTuple):
    """Three arrays of shape (..., joints): positions of all joints, and their first and second time derivatives."""

    position: np.ndarray
    rate: np.ndarray
    acceleration: np.ndarray


@dataclass(frozen=True)
class WingJoints:
    """All joints of both wings, in MuJoCo's order: the left wing's, then the right wing's.

    Attributes
    ----------
    names : of the joints, with their sides.
    factors : of each law on each joint, shape (joints, laws), in the order of `LAW_NAMES`.
    """

    names: tuple[str, ...]
    factors: np.ndarray

    @classmethod
    def of(cls, part: Part) -> WingJoints:
        """Return the joints of a wing with this part at the shoulder, and of its mirror image."""
        joints = part.all_joints()
        factors = np.array([[joint.laws.get(name, 0.0) for name in LAW_NAMES] for joint in joints])
        names = tuple(f"{side}_{joint.name}" for side in SIDES for joint in joints)
        return cls(names, np.vstack([factors, factors]))

    def motion(self, laws: Laws) -> JointMotion:
        """Return the motion of the joints from the laws of `laws_at`."""
        value, rate, acceleration = laws
        # A slide stands at zero at full span.
        value = value - _AT_ZERO
        return JointMotion(*(law @ self.factors.T for law in (value, rate, acceleration)))

    @property
    def by_hinge_angles(self) -> np.ndarray:
        """What each joint does when the flap angle or the root's wing pitch changes, shape (joints, 2)."""
        return self.factors[:, _HINGES]

    @property
    def without_hinge_angles(self) -> WingJoints:
        """The same joints as they would move if flap angle and wing pitch at the root were zero."""
        factors = self.factors.copy()
        factors[:, _HINGES] = 0.0
        return WingJoints(self.names, factors)
