"""PteraSoftware's unsteady ring vortex lattice, fed with the corners of panels at every step.

PteraSoftware's own movements are sums of sines of the angles of a wing's axes. They cannot describe our wings,
which flap, pitch, twist, fold and sweep, change span, and ride on a body that heaves and pitches. So we build the
lattice of each step here, with subclasses of three PteraSoftware classes: a wing whose mesh is given, a movement
that is a list of airplanes, and a solver that reports progress. PteraSoftware's geometry axes are aft, right and
up; half a turn about the up axis converts them to ours.
"""

from __future__ import annotations

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


def _airplane(ps: Any, corners: np.ndarray) -> Any:
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
            self.wake_ring_vortices = np.zeros((0, columns), dtype=object)
            self.gridWrvp_GP1_CgP1 = np.empty((0, columns + 1, 3))
            self.panels = _panels(corners)

    root = section(num_spanwise_panels=columns, spanwise_spacing="uniform")
    tip = section(num_spanwise_panels=None, Lp_Wcsp_Lpp=(0.0, span, 0.0))
    wing = GivenWing([root, tip], num_chordwise_panels=rows)
    return ps.geometry.airplane.Airplane([wing], s_ref=chord * span, c_ref=chord, b_ref=span)


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
