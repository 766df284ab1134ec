"""An orbit in MuJoCo: vehicle and gait as a model (MJCF), and its flight under the gait and wingbeat's air loads.

The wings' parts and joints are those of `wing_parts`.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple
from xml.etree import ElementTree as Xml

import numpy as np

from wingbeat._base import Fault, FaultList, FileError, InvalidInputError, install_extra
from wingbeat.animal.kinematics import LAWS, Wingbeat
from wingbeat.animal.vehicle import Vehicle
from wingbeat.exports.gait import Gait, Laws, gait_of, laws_at
from wingbeat.exports.wing_parts import SIDES, THICKNESS, Part, WingJoints, is_rigid, mirrored, wing_parts
from wingbeat.mechanics.equations_of_motion import air_forces
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.flights import Controller, commanded
from wingbeat.orbits.options import check_certified
from wingbeat.viewer.scene import body_axes, tail_corners

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit

BODY_JOINTS = ("x", "z", "body_pitch")
_BODY, _WINGS = slice(0, len(BODY_JOINTS)), slice(len(BODY_JOINTS), None)
STEPS = 512
KEY = "top_of_stroke"
# Critically damped springs of this frequency, in wingbeat frequencies, hold the wings to the gait. They remove the
# drift of the integrator, and their torques are zero on the gait.
_HOLD = 4.0
HINGES = [[*LAWS].index("flap"), [*LAWS].index("wing_pitch")]


def _numbers(*values: Any) -> str:
    return " ".join(repr(float(value)) for value in values)


def mujoco_xml(gait: Gait) -> str:
    """Return the text of the model, which needs no other file.

    Its keyframe ``top_of_stroke`` is the orbit at phase 0; its custom numbers ``gait_time`` and ``gait_<joint>``
    are the joints' positions at the gait's phases.
    """
    orbit, vehicle, wingbeat = gait.orbit, gait.orbit.problem.vehicle, gait.orbit.wingbeat
    wing, strips, what = vehicle.wing, orbit.problem.model.strips, orbit.inputs
    root = wing_parts(wing, wingbeat, strips)
    top = Xml.Element("mujoco", model=f"{what['species']['name']} at {what['speed']:g} m per s")
    top.append(Xml.Comment(_ABOUT))
    exact = {"boundmass": "0", "boundinertia": "0", "balanceinertia": "false", "inertiafromgeom": "false"}
    Xml.SubElement(top, "compiler", {"angle": "radian", "autolimits": "false"} | exact)
    option = Xml.SubElement(top, "option", gravity=_numbers(0, 0, -what["air"]["gravity"]), integrator="RK4")
    option.set("timestep", _numbers(1.0 / wingbeat.frequency / max(STEPS, _hinge_steps(root, wingbeat))))
    Xml.SubElement(option, "flag", contact="disable")
    body = _add_body(Xml.SubElement(top, "worldbody"), vehicle, wingbeat.tail_tilt)
    # Axes of a wing at rest: x normal to the stroke plane, y to the left, z up along it.
    angle, (forward, left, up) = wing.stroke_plane_angle + wingbeat.stroke_plane_tilt, wing.shoulder
    axes = _numbers(math.sin(angle), 0, math.cos(angle), 0, 1, 0)
    for side, sign in SIDES.items():
        place = {"pos": _numbers(forward, sign * left, up), "xyaxes": axes}
        _add_part(body, side, root, wing.semi_span / strips, place)
    joints = WingJoints.of(root)
    motors = Xml.SubElement(top, "actuator")
    for name in (joints.names[i] for i in joints.driven):
        Xml.SubElement(motors, "motor", name=name, joint=name)
    _add_gait(top, gait, joints)
    Xml.indent(top)
    return Xml.tostring(top, encoding="unicode") + "\n"


# MuJoCo's RK4 takes springs and dampers explicitly: it diverges where its step times the fastest rate of a hinge is
# above 2.8 [1].
_STEP_TIMES_RATE = 2.0


def _hinge_steps(root: Part, wingbeat: Wingbeat) -> int:
    """Return the least number of steps in a beat that a hinge that gives way takes; 0 without one."""
    if (hinge := wingbeat.pitch_hinge) is None:
        return 0
    mass, centre, inertia = root.inertia(1.0)
    moved = inertia[1, 1] + mass * centre[0] ** 2
    rate = np.abs(np.roots([moved, 0.5 * hinge.damping, 0.5 * hinge.stiffness])).max()
    return math.ceil(rate / wingbeat.frequency / _STEP_TIMES_RATE)


_ABOUT = (
    " Written by the package wingbeat. Units: SI, radians. World: x forward, y to the left, z up. Positive are: "
    "body nose up, wing up, leading edge up. The body moves in the plane of symmetry: its inertias in roll and yaw "
    "have no effect and are copies of that in pitch. A motor's control is the torque of one hinge [N m]. A pitch "
    "hinge that gives way has no motor: stiffness and damping are those of one wing. The model has no air loads. "
)


def _add_body(world: Xml.Element, vehicle: Vehicle, tail_tilt: float) -> Xml.Element:
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
    if (tail := vehicle.tail) is None:
        return body
    corners, lifted = tail_corners(tail, tail_tilt), tail.incidence + tail_tilt
    axes = _numbers(math.cos(lifted), 0, math.sin(lifted), 0, 1, 0)
    half = 0.5 * math.hypot(*(corners[0] - 0.5 * (corners[1] + corners[2]))[[0, 2]])
    place = _numbers(-tail.arm, 0, tail.height)
    _add_shape(body, "box", pos=place, xyaxes=axes, size=_numbers(half, 0.5 * corners[1, 1], THICKNESS / 2))
    Xml.SubElement(body, "site", name="tail", pos=place, xyaxes=axes, size="0.001")
    return body


def _add_shape(body: Xml.Element, kind: str, **attributes: str) -> None:
    """Add a shape that is only drawn: it has no mass and touches nothing."""
    only_drawn = {"mass": "0", "contype": "0", "conaffinity": "0", "rgba": "0.6 0.65 0.7 0.6"}
    Xml.SubElement(body, "geom", {"type": kind} | only_drawn | attributes)


def _add_part(holder: Xml.Element, side: str, part: Part, width: float, place: dict[str, str]) -> None:
    sign = SIDES[side]
    body = Xml.SubElement(holder, "body", {"name": f"{side}_{part.name}"} | place)
    for joint in part.joints:
        kind, axis = "slide" if joint.slides else "hinge", _numbers(*mirrored(joint, sign))
        node = Xml.SubElement(body, "joint", name=f"{side}_{joint.name}", type=kind, axis=axis)
        if (spring := joint.spring) is not None:
            node.set("stiffness", _numbers(0.5 * spring.stiffness))
            node.set("damping", _numbers(0.5 * spring.damping))
            node.set("springref", _numbers(spring.rest_angle))
    Xml.SubElement(body, "inertial", _inertia(part, sign))
    for strip in part.strips:
        half = _numbers(strip.chord / 2, width / 2, THICKNESS / 2)
        _add_shape(body, "box", pos=_numbers(strip.mid_chord, sign * strip.station, 0), size=half)
        at = _numbers(strip.quarter_chord, sign * strip.station, 0)
        Xml.SubElement(body, "site", name=f"{side}_strip_{strip.number}", pos=at, size="0.001")
    for inner in part.parts:
        _add_part(body, side, inner, width, {"pos": _numbers(0, sign * inner.station, 0)})


def _inertia(part: Part, sign: float) -> dict[str, str]:
    mass, centre, inertia = part.inertia(sign)
    turns = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    full = {"fullinertia": _numbers(*turns)} if part.strips else {"diaginertia": _numbers(*turns[:3])}
    return {"pos": _numbers(*centre), "mass": _numbers(mass)} | full


def _add_gait(top: Xml.Element, gait: Gait, joints: WingJoints) -> None:
    """Add the gait: the keyframe of its first phase, and a table with a row of numbers for each joint."""
    (wings, wing_rates, _), states = joints.motion(gait.laws), gait.states
    position, rate = np.hstack([states[:, :3], wings]), np.hstack([states[:, 3:], wing_rates])
    table = Xml.SubElement(top, "custom")
    columns = zip((*BODY_JOINTS, *joints.names), position.T, strict=True)
    rows = {"time": gait.dataset["time"].values, **dict(columns)}
    key = {"qpos": _numbers(*position[0]), "qvel": _numbers(*rate[0])}
    if is_rigid(gait.orbit.wingbeat) and len(joints.names) == 4:
        driven = ("flap", "pitch")[: len(joints.driven) // 2]
        torque = {name: 0.5 * gait.dataset[f"{name}_torque"].values for name in driven}
        rows |= {f"{side}_{joint}_torque": torque[joint] for side in SIDES for joint in torque}
        key["ctrl"] = _numbers(*[torque[joint][0] for _ in SIDES for joint in torque])
    for name, values in rows.items():
        Xml.SubElement(table, "numeric", name=f"gait_{name}", data=_numbers(*values))
    Xml.SubElement(Xml.SubElement(top, "keyframe"), "key", {"name": KEY, "time": "0"} | key)


class MujocoStates(NamedTuple):
    """The flight that MuJoCo computed, step by step.

    Attributes
    ----------
    time : [s], shape (K,).
    states : (x, z, body_pitch, u, w, pitch_rate), shape (K, 6) [m, m, rad, m/s, m/s, rad/s].
    positions : of all joints, in the order of the model's, shape (K, joints) [m or rad].
    torques : of the motors, in the order of the model's actuators, shape (K, motors) [N m; N for slides].
    """

    time: np.ndarray
    states: np.ndarray
    positions: np.ndarray
    torques: np.ndarray


class MujocoFlight:
    """A certified orbit in MuJoCo, with the gait as the drive of its wings; needs the extra ``mujoco``.

    A pitch hinge that gives way is not driven: MuJoCo's own springs and dampers act on it.

    Parameters
    ----------
    orbit : a certified orbit.
    steps : number of MuJoCo's time steps in a beat.

    Attributes
    ----------
    model, data : MuJoCo's model, and its data at the top of the stroke.

    Raises
    ------
    InvalidInputError : an orbit not certified, or with the lag of the wake; steps not whole, from 16 to 100000, or
        too few for a hinge that gives way; such a hinge with stops, or on a wing that also twists, slides or folds.
    FileError : MuJoCo is not installed.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon").with_values({"wingbeat.span_retraction": 0.0})
    >>> flight = wb.MujocoFlight(wb.solve_orbit(wb.OrbitProblem(pigeon, speed=12.0), starts=2), steps=64)
    >>> flown = flight.fly(beats=1)
    >>> flown.states.shape
    (65, 6)
    """

    def __init__(self, orbit: Orbit, steps: int = 256) -> None:
        faults = FaultList()
        check_certified(faults, orbit.status, "export a certified orbit")
        faults.whole("steps", steps, 16, 100_000, "time steps of a beat")
        if (wake := orbit.problem.aero.wake) != "none":
            faults.add("aero.wake", wake, "has states that MuJoCo does not carry along", "export the gait (.xml)")
        faults.raise_if_any()
        problem = orbit.problem
        root = wing_parts(problem.vehicle.wing, orbit.wingbeat, problem.model.strips)
        if steps < (least := _hinge_steps(root, orbit.wingbeat)):
            rule = "are too few for spring and damper of the pitch hinge, with which MuJoCo's RK4 diverges"
            faults.add("steps", steps, rule, f"take at least {least}")
            faults.raise_if_any()
        engine = _mujoco()
        self._gait, self._steps, self._flown = orbit.wingbeat, steps, problem.model
        self._gives = self._gait.pitch_hinge is not None
        self.model: Any = engine.MjModel.from_xml_string(mujoco_xml(gait_of(orbit, 2)))
        self.data: Any = engine.MjData(self.model)
        self._joints = WingJoints.of(root)
        # The joints as they would move if flap angle and wing pitch at the root were zero.
        self._besides = self._joints._replace(factors=self._joints.factors.copy())
        self._besides.factors[:, HINGES] = 0.0
        # What the joints do when a coordinate moves, and forces on them that do the work of forces on coordinates.
        self._moved = np.zeros((self.model.nv, 5))
        self._moved[_BODY, :3] = np.eye(3)
        self._moved[_WINGS, 3:] = self._joints.factors[:, HINGES]
        self._spread = self._moved @ np.linalg.inv(self._moved.T @ self._moved)
        # The joints that motors drive; the others, and the body, follow from the forces on them.
        self._driven = _WINGS.start + self._joints.driven
        self._free = np.setdiff1d(np.arange(self.model.nv), self._driven)
        numbers = range(1, problem.model.strips + 1)
        self._sites = {s: [self.model.site(f"{s}_strip_{i}").id for i in numbers] for s in SIDES}
        self.reset()

    def reset(self) -> None:
        """Go back to the top of the stroke."""
        # Of the step under way: its start and length, and angles and rates of servos at both ends.
        self._servos: tuple[float, float, Any, Any] | None = None
        _mujoco().mj_resetDataKeyframe(self.model, self.data, self.model.key(KEY).id)
        self._beat(self._gait)

    def _beat(self, wingbeat: Wingbeat) -> None:
        """Begin to drive the wings by a wingbeat, from its top of the stroke."""
        if wingbeat.pitch_hinge != self._gait.pitch_hinge:
            fault = Fault(
                "controller", wingbeat.pitch_hinge, "changes the hinge", "keep that of the orbit in MuJoCo"
            )
            raise InvalidInputError([fault])
        self._wingbeat, self._begun = wingbeat, float(self.data.time)
        self.model.opt.timestep = 1.0 / wingbeat.frequency / self._steps

    def drive(self, model: Any, data: Any) -> None:
        """Set the air loads and the motors' torques of an instant, in the form of MuJoCo's control callback.

        Use it as ``mujoco.set_mjcb_control(flight.drive)`` in a simulation of your own. The torques give the wings
        the accelerations of the gait, whatever the body does. The air loads are set as ``data.qfrc_applied``.

        Parameters
        ----------
        model, data : as MuJoCo passes them to the callback.
        """
        engine = _mujoco()
        wanted = np.zeros(model.nv)
        laws = laws_at(self._wingbeat, np.array((data.time - self._begun) * self._wingbeat.frequency))
        if self._servos is not None:
            laws = laws[0].copy(), laws[1].copy(), laws[2].copy()
            for law, more in zip(laws, self._offsets(*self._servos, float(data.time)), strict=True):
                law[HINGES] += more
        position, rate, acceleration = self._joints.motion(laws)
        hold = _HOLD * 2 * np.pi * self._wingbeat.frequency
        behind, slower = position - data.qpos[_WINGS], rate - data.qvel[_WINGS]
        wanted[_WINGS] = acceleration + 2 * hold * slower + hold**2 * behind
        loads, added = self._air_loads(model, data, laws)

        def resisted(acceleration: np.ndarray) -> np.ndarray:
            force = np.zeros(model.nv)
            engine.mj_mulM(model, data, force, acceleration)
            return force + self._spread @ (added @ (self._spread.T @ acceleration))

        # The free accelerations, of the body and of hinges that give way, follow from their rows. The motors give
        # what the other rows then lack.
        wanted[self._free], given = 0.0, data.qfrc_passive - data.qfrc_bias
        own = np.stack([resisted(unit)[self._free] for unit in np.eye(model.nv)[self._free]], axis=-1)
        wanted[self._free] = np.linalg.solve(own, (loads + given - resisted(wanted))[self._free])
        inertia = np.zeros(model.nv)
        engine.mj_mulM(model, data, inertia, wanted)
        air = loads - self._spread @ (added @ (self._spread.T @ wanted))
        data.qfrc_applied[:] = air
        data.ctrl[:] = (inertia - given - air)[self._driven]

    def _coordinates(self, data: Any, laws: Laws) -> tuple[np.ndarray, np.ndarray]:
        """Return the five coordinates and their rates."""
        position, rate = data.qpos.copy(), data.qvel.copy()
        # The five coordinates do not contain the motion of span, fold, sweep and twist at this time.
        besides, besides_rate, _ = self._besides.motion(laws)
        position[_WINGS] -= besides
        rate[_WINGS] -= besides_rate
        return self._spread.T @ position, self._spread.T @ rate

    def _air_loads(self, model: Any, data: Any, laws: Laws) -> tuple[np.ndarray, np.ndarray]:
        """Return the air loads on the joints that no acceleration causes, and the added mass, shape (5, 5)."""
        engine, (q, q_dot) = _mujoco(), self._coordinates(data, laws)
        found = air_forces(self._flown, self._wingbeat, q, q_dot, np.float64(data.time - self._begun))
        on_joints, force = np.zeros(model.nv), np.asarray(found.strip_force)
        for side, sign in SIDES.items():
            for site, load in zip(self._sites[side], force * [1.0, sign, 1.0], strict=True):
                at, body = data.site_xpos[site], model.site_bodyid[site]
                engine.mj_applyFT(model, data, load, np.zeros(3), at, body, on_joints)
        # Body drag, tail, and the part of the strips' loads that does not act at the quarter chord.
        rest = np.asarray(found.generalised) - self._moved.T @ on_joints
        return on_joints + self._spread @ rest, np.asarray(found.added_mass)

    @staticmethod
    def _offsets(begun: float, step: float, start: Any, end: Any, time: float) -> np.ndarray:
        """Return what servos add to flap and pitch, with rates and accelerations: a cubic in each step, (3, 2)."""
        (angle, rate), (angle_end, rate_end) = start, end
        s, rise = (time - begun) / step, (angle_end - angle) / step
        bend = 3.0 * rise - 2.0 * rate - rate_end
        twist = rate + rate_end - 2.0 * rise
        return np.stack(
            [
                angle + step * s * (rate + s * (bend + s * twist)),
                rate + s * (2.0 * bend + 3.0 * s * twist),
                (2.0 * bend + 6.0 * s * twist) / step,
            ]
        )

    def fly(
        self,
        beats: int = 1,
        controller: Controller | None = None,
        servos: Callable[..., tuple[np.ndarray, np.ndarray]] | None = None,
    ) -> MujocoStates:
        """Fly from the state in `data` with MuJoCo's own steps, and return the states before and after each step.

        Parameters
        ----------
        beats : number of wingbeats.
        controller : gives the wingbeat of each beat from the number of beats flown and the state, as in `simulate`;
            None for the gait of the orbit.
        servos : called at the start of each step with time [s], length of the step [s], state, and angle and rate
            of a hinge that gives way [rad, rad/s]; returns the angles and rates that are added to flap and pitch at
            its end, shape (2,) each. Such is `SegmentFeedback.driver`. A hinge that gives way takes no angle.

        Raises
        ------
        InvalidInputError : beats that are not a whole number of at least 1; a controller that returns no wingbeat.
        """
        faults = FaultList()
        faults.whole("beats", beats, 1, 10_000)
        faults.raise_if_any()
        engine, data = _mujoco(), self.data
        found = []

        def note() -> None:
            engine.mj_forward(self.model, data)  # a step ends with the torques of its last stage
            state = np.concatenate([data.qpos[_BODY], data.qvel[_BODY]])
            found.append((data.time, state, data.qpos.copy(), data.ctrl.copy()))

        before, self._servos = engine.get_mjcb_control(), None
        engine.set_mjcb_control(self.drive)
        try:
            note()
            for beat in range(beats):
                if controller is not None:
                    self._beat(commanded(controller, beat, State(*found[-1][1]), self._gives))
                for _ in range(self._steps):
                    if servos is not None:
                        before_it = self._servos[3] if self._servos is not None else (np.zeros(2), np.zeros(2))
                        time, step = float(data.time), float(self.model.opt.timestep)
                        measured: list[Any] = [State(*found[-1][1])]
                        if self._gives:
                            phase = np.array((time - self._begun) * self._wingbeat.frequency)
                            coordinates = self._coordinates(data, laws_at(self._wingbeat, phase))
                            measured.append([float(one[4]) for one in coordinates])
                        self._servos = time, step, before_it, servos(time, step, *measured)
                    engine.mj_step(self.model, data)
                    note()
        finally:
            engine.set_mjcb_control(before)
            self._servos = None
        return MujocoStates(*(np.array(column) for column in zip(*found, strict=True)))


def _mujoco() -> Any:
    try:
        import mujoco
    except ImportError:
        raise FileError(f"MuJoCo is not installed here: {install_extra('mujoco')}") from None
    return mujoco
