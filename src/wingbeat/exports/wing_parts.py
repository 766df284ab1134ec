"""A wing as rigid parts and joints, as multibody programs want it: MuJoCo, and readers of URDF and SDF.

Each joint's position is a sum of the wingbeat's laws. A wing whose span, fold and twist are constant is one rigid
part that turns about flap, sweep and pitch hinges. Any other wing has a part for each strip, which turns and slides
by itself, and a hand if the hand folds. The parts here are parts of the left wing; the right wing is its mirror
image. In a part's axes, x is along the chord to the leading edge, y along the span to the left and z along the
normal; its origin is on the axis of pitch.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat.animal.kinematics import LAWS, Wingbeat
from wingbeat.animal.pitch_hinge import PitchHinge
from wingbeat.animal.vehicle import Wing
from wingbeat.mechanics.wing_shape import mass_behind, mass_gyration, strips_of, twist_factors

if TYPE_CHECKING:
    from wingbeat.exports.gait import Laws

SIDES = {"left": 1.0, "right": -1.0}
# Multibody programs refuse a part without mass or inertia, so a zero is written as this [kg, kg m2], too small to
# matter.
NOTHING = 1e-14
_THICK = 1e-13  # inertia that thickness gives to a plate about its axes, as a share of that about its normal
THICKNESS = 0.002  # of the drawn wing [m]
AT_ZERO = np.array([float(name == "span_ratio") for name in LAWS])  # of each law, where its joint stands at zero
_FLAP, _FOLD = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)
_SWEEP, _PITCH, _SPAN = (0.0, 0.0, -1.0), (0.0, -1.0, 0.0), (0.0, 1.0, 0.0)


class Joint(NamedTuple):
    """One joint of the left wing, which slides along its axis or turns about it."""

    name: str  # without the side
    slides: bool
    axis: tuple[float, float, float]  # in the axes of its part
    laws: dict[str, float]  # its position as a sum of laws: factors [1, or m for a slide] by the laws' names
    spring: PitchHinge | None = None  # what holds it if nothing drives it; its numbers are those of both wings


class Strip(NamedTuple):
    """A strip of a part. Its places along the chord are ahead of the part's origin, the axis of pitch."""

    number: int  # from 1 at the root
    station: float  # place along the span of the part [m]
    chord: float  # [m]
    mass: float  # [kg]
    quarter_chord: float  # [m]
    centre: float  # of its mass [m]
    gyration: float  # radius of gyration of its mass along the chord [m]

    @property
    def mid_chord(self) -> float:
        """Its place along the chord [m]."""
        return self.quarter_chord - 0.25 * self.chord


@dataclass(frozen=True)
class Part:
    """A rigid part of the left wing, with the strips that belong to it and the parts that it holds."""

    name: str  # without the side
    station: float  # distance of its origin from the origin of the part that holds it, along the span [m]
    joints: tuple[Joint, ...]  # in order: each turns or slides those after it
    strips: tuple[Strip, ...]
    parts: tuple[Part, ...] = ()

    def inertia(self, sign: float) -> tuple[float, np.ndarray, np.ndarray]:
        """Return mass, centre of mass and inertia about it, shape (3, 3), of the strips of this part alone.

        Each strip is a rod along its chord. `sign` is that of the side, from `SIDES`.
        """
        if sum(strip.mass for strip in self.strips) < NOTHING:
            return NOTHING, np.zeros(3), np.diag([NOTHING] * 3)
        station, mass, x, gyration = (np.array([strip[i] for strip in self.strips]) for i in (1, 3, 5, 6))
        y, whole = sign * station, mass.sum()
        centre = mass @ x / whole, mass @ y / whole
        away_x, away_y = x - centre[0], y - centre[1]
        about_x = max(mass @ away_y**2, NOTHING)
        about_y = max(mass @ (away_x**2 + gyration**2), NOTHING)
        across, about_z = -mass @ (away_x * away_y), about_x + about_y
        # Of a plate without thickness, the inertias about two axes sum up to the third. MuJoCo refuses the plate if
        # rounding makes their sum the smaller one, which it does to every fourth wing.
        about_x, about_y = about_x + _THICK * about_z, about_y + _THICK * about_z
        inertia = [[about_x, across, 0.0], [across, about_y, 0.0], [0.0, 0.0, about_z]]
        return float(whole), np.array([*centre, 0.0]), np.array(inertia)

    def all_joints(self) -> list[Joint]:
        """Return the joints of this part and of those that it holds, in order."""
        return [*self.joints, *(joint for part in self.parts for joint in part.all_joints())]


def is_rigid(wingbeat: Wingbeat) -> bool:
    """Return whether the wing is one rigid part, because its span, fold and twist are constant."""
    twists = wingbeat.twist_ratio != 1.0 or wingbeat.twist_mean or wingbeat.twist_harmonics
    gives = isinstance(wingbeat.pitch_hinge, PitchHinge) and wingbeat.pitch_hinge.twist_share > 0
    return not (_spans(wingbeat) or wingbeat.fold_amplitude or twists or gives)


def _sweeps(wingbeat: Wingbeat) -> bool:
    return bool(wingbeat.sweep_mean or wingbeat.sweep_amplitude or wingbeat.sweep_harmonics)


def _spans(wingbeat: Wingbeat) -> bool:
    return bool(wingbeat.span_retraction or wingbeat.span_harmonics)


def mirrored(joint: Joint, sign: float) -> tuple[float, float, float]:
    """Return the axis of a joint of the wing on the side with this sign."""
    x, y, z = joint.axis
    # A mirror keeps a direction's components in its plane, and the component of a turn's axis across it.
    return (x, sign * y, z) if joint.slides else (sign * x, y, sign * z)


def _refuse_hinge(hinge: PitchHinge, wingbeat: Wingbeat) -> None:
    """Refuse a hinge that gives way on a wing whose strips it turns one by one, or whose stops no joint has."""
    faults, way = FaultList(), "export the gait as .csv, .mat or .c3d"
    if not is_rigid(wingbeat):
        rule = "turns strips that also twist, slide or fold: no joint with a spring stands for it"
        faults.add("pitch_hinge", "the wing's pitch", rule, f"{way}, or solve a wing that only flaps and sweeps")
    if hinge.stop_stiffness:
        rule = "belongs to stops that set in smoothly, which no joint has"
        fix = f"{way}, or solve without stops (0) if the wing stays clear of them"
        faults.add("pitch_hinge.stop_stiffness", hinge.stop_stiffness, rule, fix)
    faults.raise_if_any()


def wing_parts(wing: Wing, wingbeat: Wingbeat, count: int) -> Part:
    """Return the part at the shoulder, with all that it holds."""
    hinge = wingbeat.pitch_hinge
    if hinge is not None:
        _refuse_hinge(hinge, wingbeat)
    # A hand that folds about the axis of flap on an arm that sweeps would need two hinges with the same axis.
    if wingbeat.fold_amplitude and _sweeps(wingbeat):
        rule = "on a wing that sweeps cannot be represented by hinges one after another"
        fix = "export the gait as .csv, .mat or .c3d"
        raise InvalidInputError([Fault("wingbeat.fold_amplitude", wingbeat.fold_amplitude, rule, fix)])
    cut = strips_of(wing, count)
    fraction, quarter = np.asarray(cut.span_fraction), (wing.pitch_axis - 0.25) * np.asarray(cut.chord)
    own = quarter, quarter - mass_behind(wing, cut), np.sqrt(mass_gyration(wing, cut))
    columns = [np.asarray(column) for column in (cut.chord, cut.mass, *own)]

    def strip(i: int, station: float) -> Strip:
        return Strip(i + 1, station, *(column[i] for column in columns))

    shoulder = [Joint("flap", False, _FLAP, {"flap": 1.0})]
    if _sweeps(wingbeat):
        shoulder.append(Joint("sweep", False, _SWEEP, {"sweep": 1.0}))
    if is_rigid(wingbeat):
        shoulder.append(Joint("wing_pitch", False, _PITCH, {"wing_pitch": 1.0}, hinge))
        own = [strip(i, wing.semi_span * fraction[i]) for i in range(count)]
        return Part("wing", 0.0, tuple(shoulder), tuple(own))
    wrist = wingbeat.wrist if wingbeat.fold_amplitude else 1.0
    factors = np.asarray(twist_factors(wingbeat, fraction))

    def slide(name: str, reach: float) -> tuple[Joint, ...]:
        return (Joint(f"span_{name}", True, _SPAN, {"span_ratio": reach}),) if _spans(wingbeat) else ()

    def part(i: int, inner: float) -> Part:
        reach = wing.semi_span * float(fraction[i] - inner)
        turn = {"wing_pitch": float(factors[i]), "tip_twist": float(fraction[i])}
        pitch = Joint(f"wing_pitch_{i + 1}", False, _PITCH, turn)
        only = strip(i, 0.0)
        return Part(f"strip_{i + 1}", reach, (*slide(str(i + 1), reach), pitch), (only,))

    held = [part(i, 0.0) for i in range(count) if fraction[i] <= wrist]
    outer = tuple(part(i, wrist) for i in range(count) if fraction[i] > wrist)
    if outer:
        reach, fold = wing.semi_span * wrist, Joint("fold", False, _FOLD, {"fold": 1.0})
        held.append(Part("hand", reach, (*slide("hand", reach), fold), (), outer))
    return Part("wing", 0.0, tuple(shoulder), (), tuple(held))


def law_factors(joints: list[Joint]) -> np.ndarray:
    """Return the factor of each law on each joint, shape (joints, laws)."""
    return np.array([[joint.laws.get(name, 0.0) for name in LAWS] for joint in joints])


class WingJoints(NamedTuple):
    """All joints of both wings, in order: the left wing's, then the right wing's."""

    names: tuple[str, ...]
    factors: np.ndarray  # of each law on each joint, shape (joints, laws)
    driven: np.ndarray  # the places of those that something drives

    @classmethod
    def of(cls, part: Part) -> WingJoints:
        """Return the joints of a wing with this part at the shoulder, and of its mirror image."""
        joints = part.all_joints()
        factors = law_factors(joints)
        names = tuple(f"{side}_{joint.name}" for side in SIDES for joint in joints)
        driven = np.flatnonzero([joint.spring is None for joint in [*joints, *joints]])
        return cls(names, np.vstack([factors, factors]), driven)

    def motion(self, laws: Laws) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return positions, rates and accelerations of the joints, shape (..., joints), from those of the laws."""
        value, rate, acceleration = laws
        # A slide stands at zero at full span.
        return (value - AT_ZERO) @ self.factors.T, rate @ self.factors.T, acceleration @ self.factors.T
