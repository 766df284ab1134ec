"""PteraSoftware's unsteady ring vortex lattice, fed with the corners of panels at every step.

PteraSoftware's own movements are sums of sines of the angles of a wing's axes. They cannot describe our wings,
which flap, pitch, twist, fold and sweep, change span, and ride on a body that heaves and pitches. So we build the
lattice of each step here, with subclasses of three PteraSoftware classes: a wing whose mesh is given, a movement
that is a list of airplanes, and a solver that reports progress. PteraSoftware's geometry axes are aft, right and
up; half a turn about the up axis converts them to ours.
"""

from __future__ import annotations

import contextlib
import copy
import importlib.metadata
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from wingbeat._base import FileError, install_extra

_TO_WORLD = np.array([-1.0, -1.0, 1.0])


class PanelLoads(NamedTuple):
    """Loads on the panels at the requested steps, shape (K, C, S, 3).

    Attributes
    ----------
    force : [N].
    moment : of these forces about the origin of the corners [N m].
    """

    force: np.ndarray
    moment: np.ndarray


def code_version() -> str:
    """Return name and version of the code.

    Raises
    ------
    FileError : it is not installed.
    """
    try:
        return f"PteraSoftware {importlib.metadata.version('pterasoftware')}"
    except importlib.metadata.PackageNotFoundError:
        raise FileError(f"PteraSoftware is not installed here: {install_extra('uvlm')}") from None


def fly_lattice(
    corners: np.ndarray,
    step: float,
    velocity: tuple[float, float],
    density: float,
    last: int,
    progress: Callable[[int, int], None] | None = None,
) -> PanelLoads:
    """Fly a lattice from rest and return the loads of its last steps.

    Parameters
    ----------
    corners : of the panels, from leading to trailing edge and from left to right, in axes that fly at `velocity`
        (forward, left, up) [m], shape (K, C + 1, S + 1, 3).
    step : between two times [s].
    velocity : of these axes through still air, forward and up [m/s]; not zero.
    density : of the air [kg/m3].
    last : number of steps at the end whose loads are returned.
    progress : called with (steps done, steps in all).

    Raises
    ------
    FileError : PteraSoftware is not installed.
    """
    code_version()
    import pterasoftware as ps  # pyright: ignore[reportMissingImports]

    speed, fall = math.hypot(*velocity), math.atan2(-velocity[1], velocity[0])
    point = ps.operating_point.OperatingPoint(rho=density, vCg__E=speed, alpha=math.degrees(fall), beta=0.0)
    airplanes = [_airplane(ps, one) for one in corners * _TO_WORLD]
    movement = _movement(ps)(airplanes, point, step, step * last)
    problem = ps.problems.UnsteadyProblem(movement, only_final_results=True)
    _solver(ps, progress)(problem).run(prescribed_wake=True, calculate_streamlines=False, show_progress=False)
    loads = [
        [[(panel.forces_GP1, panel.moments_GP1_CgP1) for panel in row] for row in airplane.wings[0].panels]
        for airplane in airplanes[-last:]
    ]
    force, moment = np.moveaxis(np.array(loads), 3, 0) * _TO_WORLD
    return PanelLoads(force, moment)


def _airplane(ps: Any, corners: np.ndarray, name: str = "wings", weight: float = 0.0) -> Any:
    """Return an airplane with one wing, whose panels have these corners (axes aft, right and up)."""
    rows, columns = corners.shape[0] - 1, corners.shape[1] - 1
    chord = float(np.linalg.norm(np.diff(corners, axis=0), axis=-1).sum(axis=0).mean())
    span = float(np.linalg.norm(np.diff(corners[0], axis=0), axis=-1).sum())
    flat = ps.geometry.airfoil.Airfoil(name="naca0012")

    def section(**place: Any) -> Any:
        return ps.geometry.wing_cross_section.WingCrossSection(airfoil=flat, chord=chord, **place)

    class GivenWing(ps.geometry.wing.Wing):
        """A wing whose panels are given; its cross sections only serve to give its mean chord and span."""

        __slots__ = ()

        @property
        def standard_mean_chord(self) -> float:
            return chord  # vortex cores are a share of it; the projected chord of a raised wing is too short

        def generate_mesh(self, symmetry_type: int) -> None:
            self.symmetry_type = symmetry_type
            self.num_spanwise_panels, self.num_panels = columns, rows * columns
            self.gridWrvp_GP1_CgP1 = np.empty((0, columns + 1, 3))
            self.panels = _panels(corners)

        def __deepcopy__(self, memo: dict[int, Any]) -> Any:
            found = super().__deepcopy__(memo)  # a plain wing: the rounds of a free flight are flown with a copy
            found.__class__ = type(self)
            return found

    root = section(num_spanwise_panels=columns, spanwise_spacing="uniform")
    tip = section(num_spanwise_panels=None, Lp_Wcsp_Lpp=(0.0, span, 0.0))
    wing = GivenWing([root, tip], num_chordwise_panels=rows)
    about = {"name": name, "weight": weight, "s_ref": chord * span, "c_ref": chord, "b_ref": span}
    return ps.geometry.airplane.Airplane([wing], **about)


def _panels(corners: np.ndarray) -> np.ndarray:
    from pterasoftware._panel import Panel  # pyright: ignore[reportMissingImports]

    rows, columns = corners.shape[0] - 1, corners.shape[1] - 1
    panels = np.empty((rows, columns), dtype=object)
    for i, j in np.ndindex(rows, columns):
        front_left, front_right, back_left, back_right = (
            np.array(corners[i + down, j + out]) for down in (0, 1) for out in (0, 1)
        )
        panel = Panel(front_right, front_left, back_left, back_right, i == 0, i == rows - 1)
        panel.is_left_edge, panel.is_right_edge = j == 0, j == columns - 1
        panel.local_chordwise_position, panel.local_spanwise_position = i, j
        panels[i, j] = panel
    return panels


def _movement(ps: Any) -> Any:
    class GivenMovement(ps.movements.movement.Movement):
        """A movement made from given airplanes, for which the base class has no constructor."""

        __slots__ = ()

        def __init__(self, airplanes: list[Any], point: Any, step: float, period: float) -> None:
            self._airplanes, self._operating_points = (tuple(airplanes),), (point,) * len(airplanes)
            self._delta_time, self._num_steps = step, len(airplanes)
            self._max_wake_rows = None
            self._lcm_period = self._max_period = self._min_period = period
            self._static = False

    return GivenMovement


def _solver(ps: Any, progress: Callable[[int, int], None] | None) -> Any:
    class ReportingSolver(ps.unsteady_ring_vortex_lattice_method.UnsteadyRingVortexLatticeMethodSolver):
        """The unchanged solver, which also reports its progress."""

        __slots__ = ()

        def _calculate_vortex_strengths(self) -> None:
            super()._calculate_vortex_strengths()
            if progress is not None:
                progress(self._current_step + 1, self.num_steps)

    return ReportingSolver


class _Tumbled(Exception):
    """The body has pitched so far that its flight is over."""


# PteraSoftware 5.1.0 itself ends beyond 90 degrees: it makes a roll of -180 degrees of this, and refuses it.
_TUMBLED_DEG = 85.0


class FreeFlight(NamedTuple):
    """A flight at each step, shape (K, ...): led, then free; it ends where the body pitches past 85 degrees.

    Attributes
    ----------
    state : of the point about which the body turns: x and z (up) [m], body pitch [rad], and their rates, (K, 6).
    force : of the lattice forward and up in the world [N], (K, 2).
    moment : of the lattice about that point, nose-up positive [N m], (K,).
    rounds : evaluations of the lattice at each free step, until loads and motion agree; 21 if they never did.
    """

    state: np.ndarray
    force: np.ndarray
    moment: np.ndarray
    rounds: np.ndarray


def fly_free(
    corners: np.ndarray,
    step: float,
    led: np.ndarray,
    body: tuple[float, float, float, float],
    others: Callable[[int, np.ndarray], np.ndarray] | None = None,
    wake_rows: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> FreeFlight:
    """Fly a lattice freely: PteraSoftware's strong coupling of its lattice with one rigid body in MuJoCo.

    MuJoCo's body has one constant inertia. The loads at the end of a step act through all of it, and rounds go on
    until they agree with the motion that they make.

    Parameters
    ----------
    corners : of the panels at every step, in axes of the body (forward, left, up) about the point about which it
        turns [m], shape (K, C + 1, S + 1, 3).
    step : between two times [s].
    led : states through which the body is led until it is released at the last one, so that it has a wake: as
        `FreeFlight.state`, shape (L, 6), L from 2.
    body : mass [kg], pitch inertia about that point [kg m2], gravity [m/s2], density of the air [kg/m3].
    others : loads that a lattice does not have: called with the number of the step and the state, returns force
        forward and up [N], and moment [N m].
    wake_rows : rows of panels of the wake that are kept, at least 1; None keeps all.
    progress : called with (steps done, steps in all).

    Raises
    ------
    FileError : PteraSoftware is not installed.
    """
    code_version()
    import pterasoftware as ps  # pyright: ignore[reportMissingImports]

    mass, inertia, gravity, density = body
    airplanes = [_airplane(ps, one, str(at), mass * gravity) for at, one in enumerate(corners * _TO_WORLD)]
    point = _operating_point(ps, led[0], density, gravity)
    movement = _free_movement(ps)(airplanes, point, step, len(led) - 1, wake_rows)
    turned = inertia * np.eye(3)  # a symmetric flight only pitches

    def outside(point: Any, airplane: Any) -> tuple[np.ndarray, np.ndarray]:
        if others is None:
            return np.zeros(3), np.zeros(3)
        forward, up, nose_up = others(int(airplane.name), _state_of(point))
        to_wind = point.T_pas_E_CgP1_to_W_CgP1[:3, :3]
        return to_wind @ np.array([forward, 0.0, -up]), to_wind @ np.array([0.0, nose_up, 0.0])

    problem = _led_problem(ps)(led, movement, mass=mass, I_BP1_CgP1=turned, external_loads_fn=outside)
    run = _free_solver(ps, progress)(problem)
    with contextlib.suppress(_Tumbled):
        run.run(prescribed_wake=True, calculate_streamlines=False, show_progress=False)
    found = [one for one in problem.steady_problems if one.airplanes[0].forces_W is not None]
    loads = np.array([_loads_of(one) for one in found])
    state = np.array([_state_of(one.operating_point) for one in found])
    return FreeFlight(state, loads[:, :2], loads[:, 2], np.array(run.rounds))


def _state_of(point: Any) -> np.ndarray:
    place, pitch = point.CgP1_E_Eo, math.radians(point.angles_E_to_BP1_izyx[1])
    velocity = -point.vCg__E * (point.T_pas_W_CgP1_to_E_CgP1[:3, :3] @ np.array([-1.0, 0.0, 0.0]))
    turning = math.radians(point.omegas_BP1__E[1])
    return np.array([place[0], -place[2], pitch, velocity[0], -velocity[2], turning])


def _loads_of(problem: Any) -> list[float]:
    to_world = problem.operating_point.T_pas_W_CgP1_to_E_CgP1[:3, :3]
    force, moment = (to_world @ getattr(problem.airplanes[0], name) for name in ("forces_W", "moments_W_CgP1"))
    return [force[0], -force[2], moment[1]]


def _operating_point(ps: Any, state: np.ndarray, density: float, gravity: float) -> Any:
    x, z, pitch, forward, up, turning = state
    return ps.operating_point.OperatingPoint(
        rho=density,
        vCg__E=math.hypot(forward, up),
        alpha=math.degrees(pitch - math.atan2(up, forward)),
        beta=0.0,
        angles_E_to_BP1_izyx=(0.0, math.degrees(pitch), 0.0),
        CgP1_E_Eo=(x, 0.0, -z),
        g_E=(0.0, 0.0, gravity),
        omegas_BP1__E=(0.0, math.degrees(turning), 0.0),
    )


def _free_movement(ps: Any) -> Any:
    class GivenFirst:
        """Makes the airplane of the first step, as `FreeFlightUnsteadyProblem` asks for it."""

        def __init__(self, airplane: Any) -> None:
            self._airplane = airplane

        def generate_airplane_at_time_step(self, step: int, delta_time: float) -> Any:
            return copy.deepcopy(self._airplane)

    class GivenMovement(ps.movements.free_flight_movement.FreeFlightMovement):
        """A movement made from given airplanes."""

        __slots__ = ()

        def __init__(
            self, airplanes: list[Any], point: Any, step: float, led_steps: int, wake_rows: int | None
        ) -> None:
            point_movement = ps.movements.free_flight_operating_point_movement.FreeFlightOperatingPointMovement
            self._operating_point_movement = point_movement(point)
            self._airplanes, self._airplane_movements = (tuple(airplanes),), (GivenFirst(airplanes[0]),)
            self._delta_time, self._num_steps = step, len(airplanes)
            self._prescribed_num_steps, self._free_num_steps = led_steps, len(airplanes) - led_steps
            self._max_wake_rows = wake_rows
            self._lcm_period = self._max_period = self._min_period = step
            self._static = False

    return GivenMovement


def _led_problem(ps: Any) -> Any:
    class LedProblem(ps.problems.FreeFlightUnsteadyProblem):
        """The unchanged problem, whose body is led along given states before it is released.

        The base class lets it coast: straight, and turning at its first rate.
        """

        __slots__ = ("_led",)

        def __init__(self, led: np.ndarray, movement: Any, **about: Any) -> None:
            super().__init__(movement, **about)
            self._led = led

        def _advance_body(self, interval_loads_E: Any) -> Any:
            at = len(self._steady_problems)
            if at >= len(self._led):
                return super()._advance_body(interval_loads_E)
            x, z, pitch, forward, up, turning = self._led[at]
            model = self._mujoco_model
            model._data.qpos[:] = x, 0.0, -z, math.cos(0.5 * pitch), 0.0, math.sin(0.5 * pitch), 0.0
            model._data.qvel[:] = forward, 0.0, -up, 0.0, turning, 0.0
            model.restore_state(model.save_state())
            return model.get_state()

        @staticmethod
        def _build_next_operating_point(**about: Any) -> Any:
            # Past 90 degrees of pitch, heading and roll turn by 180.
            if np.max(np.abs(about["angles_E_to_BP1_izyx"])) > _TUMBLED_DEG:
                raise _Tumbled
            return ps.problems.FreeFlightUnsteadyProblem._build_next_operating_point(**about)

    return LedProblem


def _free_solver(ps: Any, progress: Callable[[int, int], None] | None) -> Any:
    solver = ps.free_flight_unsteady_ring_vortex_lattice_method.FreeFlightUnsteadyRingVortexLatticeMethodSolver

    class CountingSolver(solver):
        """The unchanged solver, which counts its rounds and reports its progress."""

        __slots__ = ("rounds",)

        def __init__(self, problem: Any) -> None:
            self.rounds: list[int] = []
            super().__init__(problem)

        def freeze_substep(self, next_steady_problem: Any) -> None:
            self.rounds.append(0)
            super().freeze_substep(next_steady_problem)

        def evaluate_trial_aero_loads(self, trial_operating_point: Any, step: int) -> Any:
            self.rounds[-1] += 1
            return super().evaluate_trial_aero_loads(trial_operating_point, step)

        def _update_next_step_hook(self, step: int) -> None:
            super()._update_next_step_hook(step)
            if progress is not None:
                progress(step + 1, self.num_steps)

    return CountingSolver
