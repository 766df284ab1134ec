"""A vehicle and its gait for robotics: links and joints as URDF or SDF, and one beat as a message of ROS 2.

The links are the body and the parts of `wing_parts`. In URDF and SDF a joint moves one link, so a part with several
joints has a link without mass between two of them. Joints that one law moves together follow one of them (mimic),
which then stands for the law. No joint holds the body: it flies.
"""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.etree import ElementTree as Xml

import numpy as np

from wingbeat._base import Fault, InvalidInputError
from wingbeat.animal.kinematics import LAWS, parameter
from wingbeat.animal.pitch_hinge import PitchHinge
from wingbeat.animal.vehicle import Body, Tail
from wingbeat.exports.gait import Gait, Laws, as_flown, laws_at
from wingbeat.exports.wing_parts import (
    AT_ZERO,
    NOTHING,
    SIDES,
    THICKNESS,
    Joint,
    Part,
    WingJoints,
    law_factors,
    mirrored,
    wing_parts,
)
from wingbeat.mechanics.wing_shape import strips_of
from wingbeat.viewer.scene import body_axes, tail_corners

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit

# URDF demands an effort of each joint. This one limits nothing [N or N m].
NO_LIMIT = 1e9
Triple = tuple[float, float, float]
_PHASES = np.arange(4096) / 4096  # at which extremes of the laws are looked up
_TORQUES = {"flap": "flap_torque", "wing_pitch": "pitch_torque"}


class _Shape(NamedTuple):
    """A box, or a cylinder along z, that is only drawn."""

    kind: str
    sizes: dict[str, str]
    place: Triple
    pitch: float = 0.0  # by which it is turned about y [rad]


class _Link(NamedTuple):
    name: str
    mass: float
    centre: np.ndarray  # of mass, in the link's axes [m]
    inertia: np.ndarray  # about it, shape (3, 3) [kg m2]
    shapes: tuple[_Shape, ...] = ()

    @property
    def moments(self) -> dict[str, str]:
        return {f"i{'xyz'[i]}{'xyz'[k]}": _numbers(self.inertia[i, k]) for i in range(3) for k in range(i, 3)}


class _Limits(NamedTuple):
    lower: float
    upper: float
    effort: float
    velocity: float


class _Hinge(NamedTuple):
    """A joint between two links, at its own position zero."""

    name: str
    kind: str
    parent: str
    child: str
    place: Triple  # of the child in the parent's axes [m]
    pitch: float  # by which the child's axes are turned about the parent's y [rad]
    axis: Triple  # in the child's axes
    limits: _Limits
    mimic: _Followed | None
    spring: PitchHinge | None  # of a joint that nothing drives


class _Robot(NamedTuple):
    name: str
    links: list[_Link]
    hinges: list[_Hinge]


class _Followed(NamedTuple):
    """The joint that another one follows, and the other's position as a linear function of its position."""

    joint: str
    ratio: float
    offset: float


def _limits(orbit: Orbit, joints: list[Joint], laws: Laws) -> dict[str, _Limits]:
    """Return the limits of each joint, those of its laws within the bounds of the problem.

    What the wingbeat does beyond them, for example by harmonics, counts as well. A hinge that gives way may turn
    all around.
    """
    bounds, wingbeat = orbit.problem.bounds, orbit.wingbeat

    def ends(name: str) -> np.ndarray:
        return np.array(bounds.get(name, [parameter(wingbeat, name)] * 2), dtype=float)

    def around(law: str) -> np.ndarray:
        return ends(f"{law}_mean") + [-1.0, 1.0] * ends(f"{law}_amplitude")[[1, 1]]

    within = {
        "flap": np.array(bounds["flap"]),
        "wing_pitch": around("pitch") if wingbeat.pitch_hinge is None else np.array([-np.pi, np.pi]),
        "sweep": around("sweep"),
        "span_ratio": 1.0 - ends("span_retraction"),
        "fold": ends("fold_amplitude"),
        "tip_twist": ends("twist_mean"),
        "chord_ratio": 1.0 - ends("chord_retraction"),
    }
    values, rates, _ = laws
    reached = np.concatenate([values, np.stack([within[name] for name in LAWS], axis=1)]) - AT_ZERO
    lower, upper = reached.min(axis=0), reached.max(axis=0)
    followed, found = _followed(joints, values), {}
    efforts = {law: 0.5 * float(np.abs(orbit.dataset[name].values).max()) for law, name in _TORQUES.items()}
    for joint, factors in zip(joints, law_factors(joints), strict=True):
        low, high = (np.where(factors > 0, *pair) @ factors for pair in ((lower, upper), (upper, lower)))
        law, effort = _driver(joint, values), NO_LIMIT
        if joint.name in followed or joint.spring is not None:
            effort = 0.0
        elif law in efforts:
            effort = efforts[law] / abs(joint.laws[law])
        found[joint.name] = _Limits(float(low), float(high), effort, float(np.abs(rates @ factors).max()))
    return found


def _driver(joint: Joint, values: np.ndarray) -> str | None:
    """Return the only law that moves a joint; None if it stands still or more than one moves it."""
    moving = [law for law in joint.laws if np.ptp(values[:, [*LAWS].index(law)]) > 0]
    return moving[0] if len(moving) == 1 else None


def _followed(joints: list[Joint], values: np.ndarray) -> dict[str, _Followed]:
    """Return what joints follow: of those that one law alone moves, the one that it moves furthest.

    `values` are those of the laws at some phases.
    """
    found = {}
    still = np.where(np.ptp(values, axis=0) > 0, 0.0, values[0] - AT_ZERO)
    held = {joint.name: float(factors @ still) for joint, factors in zip(joints, law_factors(joints), strict=True)}
    for law in LAWS:
        alone = [joint for joint in joints if _driver(joint, values) == law]
        for joint in alone:
            first = max(alone, key=lambda other: abs(other.laws[law]))
            if joint is not first:
                ratio = joint.laws[law] / first.laws[law]
                found[joint.name] = _Followed(first.name, ratio, held[joint.name] - ratio * held[first.name])
    return found


def _body(body: Body, tail: Tail | None, tail_tilt: float) -> _Link:
    """Return the body with its tail, whose mass it contains.

    The wingbeat's flight is in the plane of symmetry, so the inertias in roll and yaw are guesses: those of the
    spheroid that is drawn.
    """
    length, depth = body_axes(body)
    pitch = body.pitch_inertia
    roll = min(0.4 * body.mass * depth**2, 2.0 * pitch)  # a body has no larger one about one axis than about two
    sizes = {"radius": _numbers(depth), "length": _numbers(2.0 * length)}
    shapes = [_Shape("cylinder", sizes, (0.0, 0.0, 0.0), 0.5 * math.pi)]
    if tail is not None:
        corners = tail_corners(tail, tail_tilt)
        chord = math.hypot(*(corners[0] - 0.5 * (corners[1] + corners[2]))[[0, 2]])
        box = {"size": _numbers(chord, 2.0 * corners[1, 1], THICKNESS)}
        shapes.append(_Shape("box", box, (-tail.arm, 0.0, tail.height), -tail.incidence - tail_tilt))
    return _Link("body", body.mass, np.zeros(3), np.diag([roll, pitch, pitch]), tuple(shapes))


def _robot(orbit: Orbit) -> _Robot:
    problem, wingbeat = orbit.problem, orbit.wingbeat
    wing, strips = problem.vehicle.wing, problem.model.strips
    root = wing_parts(wing, wingbeat, strips)
    joints = root.all_joints()
    spread = strips_of(wing, strips)
    about = float(np.asarray(spread.mass) @ (wing.semi_span * np.asarray(spread.span_fraction)) ** 2)
    if 2 * len(joints) * NOTHING > 1e-6 * about:
        rule = f"has an inertia of {about:.2g} kg m2 about the shoulder, to which links without mass would add"
        raise InvalidInputError([Fault("wing.mass", wing.mass, rule, "export the gait as .csv, .mat or .xml")])
    laws = laws_at(as_flown(orbit, _PHASES), _PHASES)
    followed, limits = _followed(joints, laws[0]), _limits(orbit, joints, laws)
    links, hinges = [_body(problem.vehicle.body, problem.vehicle.tail, wingbeat.tail_tilt)], []

    def add(side: str, part: Part, holder: str, place: Triple, pitch: float) -> None:
        sign, last = SIDES[side], part.joints[-1]
        for joint in part.joints:
            name = f"{side}_{part.name}" if joint is last else f"{side}_{joint.name}_link"
            if joint is not last:
                links.append(_Link(name, NOTHING, np.zeros(3), np.diag([NOTHING] * 3)))
            mimic = followed.get(joint.name)
            mimic = mimic and mimic._replace(joint=f"{side}_{mimic.joint}")
            what = f"{side}_{joint.name}", "prismatic" if joint.slides else "revolute"
            where = holder, name, place, pitch, mirrored(joint, sign)
            hinges.append(_Hinge(*what, *where, limits[joint.name], mimic, joint.spring))
            holder, place, pitch = name, (0.0, 0.0, 0.0), 0.0
        width = wing.semi_span / strips
        drawn = (
            _Shape("box", {"size": _numbers(s.chord, width, THICKNESS)}, (s.mid_chord, sign * s.station, 0.0))
            for s in part.strips
        )
        links.append(_Link(holder, *part.inertia(sign), tuple(drawn)))
        for inner in part.parts:
            add(side, inner, holder, (0.0, sign * inner.station, 0.0), 0.0)

    forward, left, up = wing.shoulder
    plane = wing.stroke_plane_angle + wingbeat.stroke_plane_tilt - 0.5 * math.pi
    for side, sign in SIDES.items():
        add(side, root, "body", (forward, sign * left, up), plane)
    # Readers make names of topics and frames of it.
    return _Robot(re.sub(r"\W+", "_", orbit.inputs["species"]["name"]), links, hinges)


# What a reader of the file has to know, for its vehicle may leave the plane of symmetry.
GUESSED = "the body's inertias in roll and yaw are guesses"
_ABOUT = (
    "written by the package wingbeat. Units: SI, radians. Axes: x forward, y to the left, z up. Positive are: wing "
    f"up, leading edge up. The link body flies freely and contains the tail's mass; {GUESSED}. Efforts and "
    "velocities are the peaks of one wing in the beat; the effort of a hinge is that of actuator and springs "
    "together. A joint that follows another one (mimic) has no actuator and no effort; nor has a pitch hinge that "
    "gives way, which may turn all around. An effort of "
    f"{NO_LIMIT:g} limits nothing: wingbeat does not compute it. The model has no air loads. A mass of {NOTHING:g} "
    "stands for none. "
)


def _about(gait: Gait, more: str = "") -> Any:  # a comment is an element of its own type
    return Xml.Comment(f" {re.sub('-+', '-', gait.about)}, {_ABOUT}{more}")  # two dashes would end a comment


def _springs_left_out(gait: Gait) -> str:
    """Say what URDF has no element for."""
    hinge = gait.orbit.wingbeat.pitch_hinge
    if hinge is None:
        return ""
    spring = f"{0.5 * hinge.stiffness:g} N m/rad and the rest angle {hinge.rest_angle:g} rad"
    return f"URDF has no springs: each wing_pitch needs one with {spring}, as the SDF has. "


def urdf(gait: Gait) -> bytes:
    """Return the vehicle as URDF, which needs no other file.

    MuJoCo reads the element ``mujoco``, without which it drops the body's mass; other readers pass over it.
    """
    robot = _robot(gait.orbit)
    top = Xml.Element("robot", name=robot.name)
    top.append(_about(gait, _springs_left_out(gait)))
    Xml.SubElement(Xml.SubElement(top, "mujoco"), "compiler", fusestatic="false", discardvisual="false")

    def origin(holder: Xml.Element, place: np.ndarray | Triple, pitch: float = 0.0) -> None:
        Xml.SubElement(holder, "origin", xyz=_numbers(*place), rpy=_numbers(0.0, pitch, 0.0))

    for link in robot.links:
        node = Xml.SubElement(top, "link", name=link.name)
        inertial = Xml.SubElement(node, "inertial")
        origin(inertial, link.centre)
        Xml.SubElement(inertial, "mass", value=_numbers(link.mass))
        Xml.SubElement(inertial, "inertia", link.moments)
        for shape in link.shapes:
            visual = Xml.SubElement(node, "visual")
            origin(visual, shape.place, shape.pitch)
            Xml.SubElement(Xml.SubElement(visual, "geometry"), shape.kind, shape.sizes)
    for hinge in robot.hinges:
        node = Xml.SubElement(top, "joint", name=hinge.name, type=hinge.kind)
        Xml.SubElement(node, "parent", link=hinge.parent)
        Xml.SubElement(node, "child", link=hinge.child)
        origin(node, hinge.place, hinge.pitch)
        Xml.SubElement(node, "axis", xyz=_numbers(*hinge.axis))
        Xml.SubElement(node, "limit", {name: _numbers(value) for name, value in hinge.limits._asdict().items()})
        if hinge.spring is not None:
            Xml.SubElement(node, "dynamics", damping=_numbers(0.5 * hinge.spring.damping), friction="0")
        if (mimic := hinge.mimic) is not None:
            line = {"multiplier": _numbers(mimic.ratio), "offset": _numbers(mimic.offset)}
            Xml.SubElement(node, "mimic", {"joint": mimic.joint} | line)
    return _xml(top)


def sdf(gait: Gait) -> bytes:
    """Return the vehicle as SDF 1.11, which needs no other file."""
    robot = _robot(gait.orbit)
    top = Xml.Element("sdf", version="1.11")
    top.append(_about(gait))
    model, held = Xml.SubElement(top, "model", name=robot.name), {hinge.child: hinge for hinge in robot.hinges}

    def put(holder: Xml.Element, texts: dict[str, str]) -> None:
        for name, text in texts.items():
            Xml.SubElement(holder, name).text = text

    def pose(place: np.ndarray | Triple, pitch: float = 0.0) -> str:
        return _numbers(*place, 0.0, pitch, 0.0)

    for link in robot.links:
        node = Xml.SubElement(model, "link", name=link.name)
        if link.name in held:
            hinge = held[link.name]
            Xml.SubElement(node, "pose", relative_to=hinge.parent).text = pose(hinge.place, hinge.pitch)
        inertial = Xml.SubElement(node, "inertial")
        put(inertial, {"mass": _numbers(link.mass), "pose": pose(link.centre)})
        put(Xml.SubElement(inertial, "inertia"), link.moments)
        for i, shape in enumerate(link.shapes):
            visual = Xml.SubElement(node, "visual", name=f"{link.name}_shape_{i + 1}")
            put(visual, {"pose": pose(shape.place, shape.pitch)})
            put(Xml.SubElement(Xml.SubElement(visual, "geometry"), shape.kind), shape.sizes)
    for hinge in robot.hinges:
        node = Xml.SubElement(model, "joint", name=hinge.name, type=hinge.kind)
        put(node, {"parent": hinge.parent, "child": hinge.child})
        axis = Xml.SubElement(node, "axis")
        put(axis, {"xyz": _numbers(*hinge.axis)})
        limits = {name: _numbers(value) for name, value in hinge.limits._asdict().items()}
        put(Xml.SubElement(axis, "limit"), limits)
        if hinge.spring is not None:
            given = {"damping": 0.5 * hinge.spring.damping, "spring_reference": hinge.spring.rest_angle}
            given["spring_stiffness"] = 0.5 * hinge.spring.stiffness
            put(Xml.SubElement(axis, "dynamics"), {name: _numbers(value) for name, value in given.items()})
        if (mimic := hinge.mimic) is not None:
            line = {"multiplier": _numbers(mimic.ratio), "offset": _numbers(mimic.offset), "reference": "0"}
            put(Xml.SubElement(axis, "mimic", joint=mimic.joint), line)
    return _xml(top)


def joint_trajectory(gait: Gait) -> bytes:
    """Return one beat as YAML, a message trajectory_msgs/msg/JointTrajectory of ROS 2.

    It has the joints that something drives and that follow no other one. Its last point is the next top of the
    stroke. Efforts are left out, because ROS's joint_trajectory_controller refuses them unless its hardware takes
    efforts as commands.
    """
    wingbeat, problem = gait.orbit.wingbeat, gait.orbit.problem
    root = wing_parts(problem.vehicle.wing, wingbeat, problem.model.strips)
    found = WingJoints.of(root)
    followers = _followed(root.all_joints(), laws_at(as_flown(gait.orbit, _PHASES), _PHASES)[0])
    own = [i for i in found.driven if found.names[i].partition("_")[2] not in followers]
    position, rate, acceleration = (a[:, own] for a in found.motion(gait.laws))
    lines = [
        f"# one wingbeat of {gait.about}, written by the package wingbeat; SI units, radians",
        "# ros2 topic pub --once /joint_trajectory_controller/joint_trajectory \\",
        '#   trajectory_msgs/msg/JointTrajectory --yaml-file FILE    (or "$(cat FILE)", in older releases)',
        "# The wings move at its end: set allow_nonzero_velocity_at_trajectory_end of the controller to true.",
        "header: {stamp: {sec: 0, nanosec: 0}, frame_id: ''}",
        f"joint_names: [{', '.join(found.names[i] for i in own)}]",
        "points:",
    ]
    for k, time in enumerate(gait.dataset["time"].values):
        seconds, rest = divmod(round(time * 1e9), 10**9)
        lines += [
            f"- positions: {_list(position[k])}",
            f"  velocities: {_list(rate[k])}",
            f"  accelerations: {_list(acceleration[k])}",
            "  effort: []",
            f"  time_from_start: {{sec: {seconds}, nanosec: {rest}}}",
        ]
    return ("\n".join(lines) + "\n").encode()


def _list(values: np.ndarray) -> str:
    # To YAML 1.1, which PyYAML and so ROS reads, 1e-05 is a text and 1.0e-05 a number.
    texts = (repr(value) for value in values.tolist())
    return f"[{', '.join(text if '.' in text else text.replace('e', '.0e') for text in texts)}]"


def _numbers(*values: float) -> str:
    return " ".join(repr(float(value) + 0.0) for value in values)  # no -0.0


def _xml(top: Xml.Element) -> bytes:
    Xml.indent(top)
    return Xml.tostring(top, encoding="utf-8", xml_declaration=True) + b"\n"
