"""A vehicle and its gait as a MuJoCo model (MJCF): body, wings, joints, motors, sites and the gait's table.

Each joint's position is a sum of the wingbeat's laws. A wing whose span, fold and twist are constant is one rigid
part that turns about flap, sweep and pitch hinges. Any other wing has a part for each strip, which turns and slides
by itself, and a hand if the hand folds. The parts here are parts of the left wing; the right wing is its mirror
image. In a part's axes, x is along the chord to the leading edge, y along the span to the left and z along the
normal; its origin is on the line of the quarter chords.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple
from xml.etree import ElementTree as Xml

import numpy as np

from wingbeat._base import FaultList
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.vehicle import Tail, Vehicle, Wing
from wingbeat.exports.gait import LAW_NAMES, Gait, Laws, laws_at
from wingbeat.mechanics.wing_motion import strips_of
from wingbeat.mechanics.wing_shape import twist_factors
from wingbeat.viewer.look import body_axes, tail_corners

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
    """Return the part at the shoulder, with all that it holds."""
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


STEPS = 512
KEY = "top_of_stroke"
_THICKNESS = 0.002  # of the drawn wing, half of it [m]


def _numbers(*values: Any) -> str:
    return " ".join(repr(float(value)) for value in values)


def mujoco_xml(gait: Gait) -> str:
    """Return the text of the model.

    The text needs no other file. Its keyframe ``top_of_stroke`` is the orbit at phase 0; its custom numbers
    ``gait_time`` and ``gait_<joint>`` are the joints' positions at the gait's phases.
    A wing that joints cannot represent is refused.
    """
    faults = FaultList()
    check_wing(faults, gait.orbit.wingbeat)
    faults.raise_if_any()
    orbit, vehicle, wingbeat = gait.orbit, gait.orbit.problem.vehicle, gait.orbit.wingbeat
    root = wing_parts(vehicle.wing, wingbeat, orbit.problem.model.strips)
    what = orbit.inputs
    top = Xml.Element("mujoco", model=f"{what['species']['name']} at {what['speed']:g} m per s")
    top.append(Xml.Comment(_ABOUT))
    exact = {"boundmass": "0", "boundinertia": "0", "balanceinertia": "false", "inertiafromgeom": "false"}
    Xml.SubElement(top, "compiler", {"angle": "radian", "autolimits": "false"} | exact)
    option = Xml.SubElement(top, "option", gravity=_numbers(0, 0, -what["air"]["gravity"]), integrator="RK4")
    option.set("timestep", _numbers(1.0 / wingbeat.frequency / STEPS))
    Xml.SubElement(option, "flag", contact="disable")
    _add_body(Xml.SubElement(top, "worldbody"), vehicle, wingbeat.tail_tilt)
    body = top.find("worldbody/body")
    assert body is not None
    for side in SIDES:
        _add_wing(body, side, vehicle.wing, vehicle.wing.stroke_plane_angle + wingbeat.stroke_plane_tilt, root)
    joints = WingJoints.of(root)
    motors = Xml.SubElement(top, "actuator")
    for name in joints.names:
        Xml.SubElement(motors, "motor", name=name, joint=name)
    _add_gait(top, gait, joints)
    Xml.indent(top)
    return Xml.tostring(top, encoding="unicode") + "\n"


_ABOUT = (
    " Written by the package wingbeat. Units: SI, radians. World: x forward, y to the left, z up. Positive are: "
    "body nose up, wing up, leading edge up. The body moves in the plane of symmetry: its inertias in roll and yaw "
    "have no effect and are copies of that in pitch. A motor's control is the torque of one hinge [N m]. The model "
    "has no air loads. "
)


def _add_body(world: Xml.Element, vehicle: Vehicle, tail_tilt: float) -> None:
    body = Xml.SubElement(world, "body", name="body")
    slide, up, turn = BODY_JOINTS
    Xml.SubElement(body, "joint", name=slide, type="slide", axis="1 0 0")
    Xml.SubElement(body, "joint", name=up, type="slide", axis="0 0 1")
    Xml.SubElement(body, "joint", name=turn, type="hinge", axis="0 -1 0")
    inertia = _numbers(*[vehicle.body.pitch_inertia] * 3)
    Xml.SubElement(body, "inertial", pos="0 0 0", mass=_numbers(vehicle.body.mass), diaginertia=inertia)
    length, depth = body_axes(vehicle.body)
    _add_shape(body, "ellipsoid", size=_numbers(length, depth, depth))
    Xml.SubElement(body, "site", name="body", size="0.001")
    if vehicle.tail is not None:
        _add_tail(body, vehicle.tail, tail_tilt)


def _add_tail(body: Xml.Element, tail: Tail, tilt: float) -> None:
    corners = tail_corners(tail, tilt)
    lifted = tail.incidence + tilt
    axes = _numbers(math.cos(lifted), 0, math.sin(lifted), 0, 1, 0)
    half = 0.5 * math.hypot(*(corners[0] - 0.5 * (corners[1] + corners[2]))[[0, 2]])
    place = _numbers(-tail.arm, 0, tail.height)
    _add_shape(body, "box", pos=place, xyaxes=axes, size=_numbers(half, 0.5 * corners[1, 1], _THICKNESS / 2))
    Xml.SubElement(body, "site", name="tail", pos=place, xyaxes=axes, size="0.001")


def _add_shape(body: Xml.Element, kind: str, **attributes: str) -> None:
    """Add a shape that is only drawn: it has no mass and touches nothing."""
    only_drawn = {"mass": "0", "contype": "0", "conaffinity": "0", "rgba": "0.6 0.65 0.7 0.6"}
    Xml.SubElement(body, "geom", {"type": kind} | only_drawn | attributes)


def _add_wing(body: Xml.Element, side: str, wing: Wing, stroke_plane_angle: float, root: Part) -> None:
    """Add a wing at its shoulder, in axes at rest: x normal to the stroke plane, y to the left, z up along it."""
    sine, cosine = math.sin(stroke_plane_angle), math.cos(stroke_plane_angle)
    forward, left, up = wing.shoulder
    place = {"pos": _numbers(forward, SIDES[side] * left, up), "xyaxes": _numbers(sine, 0, cosine, 0, 1, 0)}
    _add_part(body, side, root, wing.semi_span / len(_strips(root)), place)


def _strips(part: Part) -> list[Strip]:
    return [*part.strips, *(strip for inner in part.parts for strip in _strips(inner))]


def _add_part(holder: Xml.Element, side: str, part: Part, width: float, place: dict[str, str]) -> None:
    sign = SIDES[side]
    name = f"{side}_{part.name}" if part.name else f"{side}_wing"
    body = Xml.SubElement(holder, "body", {"name": name} | place)
    for joint in part.joints:
        x, y, z = joint.axis
        # A mirror keeps a direction's components in its plane, and the component of a turn's axis across it.
        axis = (x, sign * y, z) if joint.slides else (sign * x, y, sign * z)
        kind = "slide" if joint.slides else "hinge"
        Xml.SubElement(body, "joint", name=f"{side}_{joint.name}", type=kind, axis=_numbers(*axis))
    Xml.SubElement(body, "inertial", _inertia(part, sign))
    for strip in part.strips:
        half = _numbers(strip.chord / 2, width / 2, _THICKNESS / 2)
        _add_shape(body, "box", pos=_numbers(-strip.chord / 4, sign * strip.station, 0), size=half)
        at = _numbers(0, sign * strip.station, 0)
        Xml.SubElement(body, "site", name=f"{side}_strip_{strip.number}", pos=at, size="0.001")
    for inner in part.parts:
        _add_part(body, side, inner, width, {"pos": _numbers(0, sign * inner.station, 0)})


def _inertia(part: Part, sign: float) -> dict[str, str]:
    """Return mass, centre of mass and inertia of a part's strips, each a uniform rod along its chord."""
    if not part.strips:
        return {"pos": "0 0 0", "mass": _numbers(NOTHING), "diaginertia": _numbers(*[NOTHING] * 3)}
    station, chord, mass = (np.array([strip[i] for strip in part.strips]) for i in (1, 2, 3))
    x, y, whole = -chord / 4, sign * station, mass.sum()
    centre = mass @ x / whole, mass @ y / whole
    away_x, away_y = x - centre[0], y - centre[1]
    about_x = max(mass @ away_y**2, NOTHING)
    about_y = mass @ (away_x**2 + chord**2 / 12)
    full = about_x, about_y, about_x + about_y, -mass @ (away_x * away_y), 0.0, 0.0
    return {"pos": _numbers(*centre, 0), "mass": _numbers(whole), "fullinertia": _numbers(*full)}


def _add_gait(top: Xml.Element, gait: Gait, joints: WingJoints) -> None:
    """Add the gait: the keyframe of its first phase, and a table with a row of numbers for each joint."""
    wings = joints.motion(laws_at(gait.orbit.wingbeat, gait.phase))
    states = gait.states
    position = np.hstack([states[:, :3], wings.position])
    rate = np.hstack([states[:, 3:], wings.rate])
    table = Xml.SubElement(top, "custom")
    rows = {"time": gait.dataset["time"].values}
    rows |= dict(zip((*BODY_JOINTS, *joints.names), position.T, strict=True))
    key = {"qpos": _numbers(*position[0]), "qvel": _numbers(*rate[0])}
    if is_rigid(gait.orbit.wingbeat) and len(joints.names) == 4:
        torque = {name: 0.5 * gait.dataset[f"{name}_torque"].values for name in ("flap", "pitch")}
        rows |= {f"{side}_{joint}_torque": torque[joint] for side in SIDES for joint in torque}
        key["ctrl"] = _numbers(*[torque[joint][0] for _ in SIDES for joint in torque])
    for name, values in rows.items():
        Xml.SubElement(table, "numeric", name=f"gait_{name}", data=_numbers(*values))
    Xml.SubElement(Xml.SubElement(top, "keyframe"), "key", {"name": KEY, "time": "0"} | key)
