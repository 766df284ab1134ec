"""The parts of a wing in MuJoCo and their joints: each joint's position is a sum of the wingbeat's laws.

A wing whose span, fold and twist stand still is one rigid part that turns about flap, sweep and pitch hinges. Any
other wing has a part for each strip, which turns and slides by itself, and a hand if the hand folds. Parts are
those of the left wing; the right one is its mirror image. In a part's axes, x is along the chord to the leading
edge, y along the span to the left and z along the normal; its origin is on the line of the quarter chords.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from wingbeat.exports.gait import LAW_NAMES, laws_at
from wingbeat.kinematics import Wingbeat
from wingbeat.mechanics.wing_motion import strips_of, twist_factors
from wingbeat.vehicle import Wing

SIDES = {"left": 1.0, "right": -1.0}
BODY_JOINTS = ("x", "z", "body_pitch")
# MuJoCo refuses a part without mass or inertia, so nothing is written as this [kg, kg m2]; it changes nothing.
NOTHING = 1e-14

_HINGES = [LAW_NAMES.index("flap"), LAW_NAMES.index("wing_pitch")]
_FLAP, _SWEEP, _PITCH, _SPAN = (1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.0, -1.0, 0.0), (0.0, 1.0, 0.0)


class Joint(NamedTuple):
    """One joint of the left wing.

    Attributes
    ----------
    name : without the side.
    slides : whether it slides along its axis rather than turn about it.
    axis : in the axes of its part.
    laws : its position as a sum of laws: factors [1, or m for a slide] by the laws' names.
    """

    name: str
    slides: bool
    axis: tuple[float, float, float]
    laws: dict[str, float]


class Strip(NamedTuple):
    """A strip of a part: its number from 1 at the root, place along the part's span [m], chord [m] and mass [kg]."""

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
    station : distance of its origin from that of the part that holds it, along the span [m].
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
    """Return whether the wing is one rigid part: its span, fold and twist stand still."""
    beat = wingbeat
    return not (
        beat.span_retraction
        or beat.span_harmonics
        or beat.fold_amplitude
        or beat.twist_ratio != 1.0
        or beat.twist_mean
        or beat.twist_harmonics
    )


def wing_parts(wing: Wing, wingbeat: Wingbeat, count: int) -> Part:
    """Return the part at the shoulder, with all that it holds.

    Parameters
    ----------
    wing : the wing.
    wingbeat : the laws that move it.
    count : number of strips.
    """
    strips = strips_of(wing, count)
    fraction, chord, mass = (np.asarray(a) for a in strips)
    values = laws_at(wingbeat, np.linspace(0.0, 1.0, 65))[0]
    sweeps = bool(np.any(values[:, LAW_NAMES.index("sweep")]))
    shoulder = [Joint("flap", False, _FLAP, {"flap": 1.0})]
    shoulder += [Joint("sweep", False, _SWEEP, {"sweep": 1.0})] if sweeps else []
    if is_rigid(wingbeat):
        shoulder.append(Joint("wing_pitch", False, _PITCH, {"wing_pitch": 1.0}))
        own = [Strip(i + 1, wing.semi_span * fraction[i], chord[i], mass[i]) for i in range(count)]
        return Part("", 0.0, tuple(shoulder), tuple(own))
    wrist = wingbeat.wrist if wingbeat.fold_amplitude else 1.0
    factors = np.asarray(twist_factors(wingbeat, fraction))

    def part(i: int, inner: float) -> Part:
        reach = wing.semi_span * float(fraction[i] - inner)
        turn = {"wing_pitch": float(factors[i]), "tip_twist": float(fraction[i])}
        joints = _Slide(wingbeat, reach).joints(f"span_{i + 1}")
        joints += (Joint(f"wing_pitch_{i + 1}", False, _PITCH, turn),)
        return Part(f"strip_{i + 1}", reach, joints, (Strip(i + 1, 0.0, chord[i], mass[i]),))

    held = [part(i, 0.0) for i in range(count) if fraction[i] <= wrist]
    outer = tuple(part(i, wrist) for i in range(count) if fraction[i] > wrist)
    if outer:
        reach = wing.semi_span * wrist
        held.append(Part("hand", reach, _hand_joints(wingbeat, reach, sweeps), (), outer))
    return Part("", 0.0, tuple(shoulder), (), tuple(held))


class _Slide(NamedTuple):
    wingbeat: Wingbeat
    reach: float

    def joints(self, name: str) -> tuple[Joint, ...]:
        """Return the slide of what sits at a distance from its shoulder or wrist; none if the span stands still."""
        if not (self.wingbeat.span_retraction or self.wingbeat.span_harmonics):
            return ()
        return (Joint(name, True, _SPAN, {"span_ratio": self.reach}),)


def _hand_joints(wingbeat: Wingbeat, reach: float, sweeps: bool) -> tuple[Joint, ...]:
    """Return the joints of the hand. It flaps less than the arm by the fold, and both sweep by the same angle."""
    down = -_FLAP[0], -_FLAP[1], -_FLAP[2]
    fold = Joint("fold", False, down, {"fold": 1.0})
    before, after = (), ()
    if sweeps:
        before = (Joint("hand_unsweep", False, _SWEEP, {"sweep": -1.0}),)
        after = (Joint("hand_sweep", False, _SWEEP, {"sweep": 1.0}),)
    return (*_Slide(wingbeat, reach).joints("span_hand"), *before, fold, *after)


class JointMotion(NamedTuple):
    """Positions of all joints with their first and second time derivatives, shape (..., joints) each."""

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

    def motion(self, wingbeat: Wingbeat, phase: np.ndarray) -> JointMotion:
        """Return the motion of the joints in a wingbeat, at phases of shape (...)."""
        value, rate, acceleration = laws_at(wingbeat, phase)
        # A slide stands at zero at full span.
        value = value - np.array([float(name == "span_ratio") for name in LAW_NAMES])
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
