"""The exported model flown by MuJoCo: the gait drives the wings, and wingbeat's air loads act on them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FaultList, FileError, install_extra
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.exports.gait import Laws, check_certified, gait_of, laws_at
from wingbeat.exports.mujoco_model import BODY_JOINTS, KEY, SIDES, WingJoints, mujoco_xml, wing_parts
from wingbeat.mechanics.equations_of_motion import air_forces
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.flights import Controller, commanded

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit

_BODY = slice(0, len(BODY_JOINTS))
_WINGS = slice(len(BODY_JOINTS), None)
# Critically damped springs of this frequency, in wingbeat frequencies, hold the wings to the gait. They remove the
# drift of the integrator, and their torques are zero on the gait.
_HOLD = 4.0


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

    Parameters
    ----------
    orbit : a certified orbit.
    steps : number of MuJoCo's time steps in a beat.

    Attributes
    ----------
    model, data : MuJoCo's model, and its data at the top of the stroke.

    Raises
    ------
    InvalidInputError : an orbit that is not certified; steps that are not a whole number from 16 to 100000.
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
        check_certified(faults, orbit)
        faults.whole("steps", steps, 16, 100_000, "time steps of a beat")
        faults.raise_if_any()
        engine = _mujoco()
        problem, self._gait, self._steps = orbit.problem, orbit.wingbeat, steps
        self._flown = problem.model
        self.model: Any = engine.MjModel.from_xml_string(mujoco_xml(gait_of(orbit, 2)))
        self.data: Any = engine.MjData(self.model)
        self._joints = WingJoints.of(wing_parts(problem.vehicle.wing, self._gait, problem.model.strips))
        self._besides = self._joints.without_hinge_angles
        # What the joints do when one of the five coordinates moves, and forces on the joints that do the work of
        # forces on the coordinates.
        self._moved = np.zeros((self.model.nv, 5))
        self._moved[_BODY, :3] = np.eye(3)
        self._moved[_WINGS, 3:] = self._joints.by_hinge_angles
        self._spread = self._moved @ np.linalg.inv(self._moved.T @ self._moved)
        numbers = range(1, problem.model.strips + 1)
        self._sites = {s: [self.model.site(f"{s}_strip_{i}").id for i in numbers] for s in SIDES}
        self.reset()

    def reset(self) -> None:
        """Go back to the top of the stroke."""
        engine = _mujoco()
        engine.mj_resetDataKeyframe(self.model, self.data, self.model.key(KEY).id)
        self._beat(self._gait)

    def _beat(self, wingbeat: Wingbeat) -> None:
        """Begin to drive the wings by a wingbeat, from its top of the stroke."""
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
        gait = self._joints.motion(laws)
        hold = _HOLD * 2 * np.pi * self._wingbeat.frequency
        wanted[_WINGS] = (
            gait.acceleration
            + 2 * hold * (gait.rate - data.qvel[_WINGS])
            + hold**2 * (gait.position - data.qpos[_WINGS])
        )
        loads, added = self._air_loads(model, data, laws)

        def resisted(acceleration: np.ndarray) -> np.ndarray:
            force = np.zeros(model.nv)
            engine.mj_mulM(model, data, force, acceleration)
            return force + self._spread @ (added @ (self._spread.T @ acceleration))

        # The body's accelerations follow from the body's rows. The motors give what the wings' rows then lack.
        own = np.stack([resisted(unit)[_BODY] for unit in np.eye(model.nv)[_BODY]], axis=-1)
        free = (loads - data.qfrc_bias - resisted(wanted))[_BODY]
        wanted[_BODY] = np.linalg.solve(own, free)
        inertia = np.zeros(model.nv)
        engine.mj_mulM(model, data, inertia, wanted)
        air = loads - self._spread @ (added @ (self._spread.T @ wanted))
        data.qfrc_applied[:] = air
        data.ctrl[:] = (inertia + data.qfrc_bias - air)[_WINGS]

    def _air_loads(self, model: Any, data: Any, laws: Laws) -> tuple[np.ndarray, np.ndarray]:
        """Return the air loads on the joints that no acceleration causes, and the added mass, shape (5, 5)."""
        engine = _mujoco()
        position, rate = data.qpos.copy(), data.qvel.copy()
        # The five coordinates do not contain the motion of span, fold, sweep and twist at this time.
        besides = self._besides.motion(laws)
        position[_WINGS] -= besides.position
        rate[_WINGS] -= besides.rate
        q, q_dot = self._spread.T @ position, self._spread.T @ rate
        found = air_forces(self._flown, self._wingbeat, q, q_dot, np.float64(data.time - self._begun))
        on_joints, force = np.zeros(model.nv), np.asarray(found.strip_force)
        for side, sign in SIDES.items():
            for site, load in zip(self._sites[side], force * [1.0, sign, 1.0], strict=True):
                at, body = data.site_xpos[site], model.site_bodyid[site]
                engine.mj_applyFT(model, data, load, np.zeros(3), at, body, on_joints)
        # Body drag, tail, and the part of the strips' loads that does not act at the quarter chord.
        rest = np.asarray(found.generalised) - self._moved.T @ on_joints
        return on_joints + self._spread @ rest, np.asarray(found.added_mass)

    def fly(self, beats: int = 1, controller: Controller | None = None) -> MujocoStates:
        """Fly from the state in `data` with MuJoCo's own steps, and return the states before and after each step.

        Parameters
        ----------
        beats : number of wingbeats.
        controller : gives the wingbeat of each beat from the number of beats flown and the state, as in `simulate`;
            None for the gait of the orbit.

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

        before = engine.get_mjcb_control()
        engine.set_mjcb_control(self.drive)
        try:
            note()
            for beat in range(beats):
                if controller is not None:
                    self._beat(commanded(controller, beat, State(*found[-1][1])))
                for _ in range(self._steps):
                    engine.mj_step(self.model, data)
                    note()
        finally:
            engine.set_mjcb_control(before)
        return MujocoStates(*(np.array(column) for column in zip(*found, strict=True)))


def _mujoco() -> Any:
    try:
        import mujoco
    except ImportError:
        raise FileError(f"MuJoCo is not installed here: {install_extra('mujoco')}") from None
    return mujoco
