"""A vehicle and its gait as a MuJoCo model (MJCF): body, wings, joints, motors, sites and the gait's table."""

from __future__ import annotations

import math
from typing import Any
from xml.etree import ElementTree as Xml

import numpy as np

from wingbeat._base import FaultList
from wingbeat.animal.vehicle import Tail, Vehicle, Wing
from wingbeat.exports.gait import Gait, laws_at
from wingbeat.exports.mujoco_joints import (
    BODY_JOINTS,
    NOTHING,
    SIDES,
    Part,
    Strip,
    WingJoints,
    check_wing,
    is_rigid,
    wing_parts,
)
from wingbeat.viewer.shape import body_axes, tail_corners

STEPS = 512
KEY = "top_of_stroke"
_THICKNESS = 0.002  # of the drawn wing, half of it [m]


def _numbers(*values: Any) -> str:
    return " ".join(repr(float(value)) for value in values)


def mujoco_xml(gait: Gait) -> str:
    """Return the text of the model.

    The text needs no other file. Its keyframe ``top_of_stroke`` is the orbit at phase 0; its custom numbers
    ``gait_time`` and ``gait_<joint>`` are the joints' positions at the gait's phases.

    Parameters
    ----------
    gait : the gait.

    Raises
    ------
    InvalidInputError : a wing that joints cannot represent.
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
