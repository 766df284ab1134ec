"""All options of the solvers in one value."""

from __future__ import annotations

import dataclasses
import enum
import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from wingbeat._base import FaultList
from wingbeat.orbits.search_options import (
    CertificateOptions,
    LeastSquaresOptions,
    Options,
    SearchOptions,
    WakeOptions,
)


class Status(enum.Enum):
    """How the solver ended; the value is the name in records.

    >>> import wingbeat as wb
    >>> [status.value for status in wb.Status]
    ['converged', 'infeasible', 'not-converged']
    >>> wb.Status("converged") is wb.Status.CONVERGED
    True
    """

    CONVERGED = "converged"
    INFEASIBLE = "infeasible"
    NOT_CONVERGED = "not-converged"


def check_certified(faults: FaultList, status: Status, fix: str, lacks: str = "") -> None:
    """Note a fault unless an orbit is certified; `lacks` names what it therefore has not."""
    if status is not Status.CONVERGED:
        rule = f"is not certified, so it has no {lacks}" if lacks else "is not certified"
        faults.add("orbit", status.value, rule, fix)


@dataclass(frozen=True)
class ContinuationOptions(Options):
    """Options of the continuation of orbits along speed, frequency or the share of a term, and between problems.

    Parameters
    ----------
    max_step : an orbit within this distance of another, in the optimiser's scale, may be its continuation. The
        default is 2 degrees of flap amplitude or of body pitch, 0.9 Hz, or 0.15 m/s. Orbits farther apart belong to
        one branch only if orbits between them lead from one to the other.
    first_speed_step, least_speed_step : first and smallest step of speed [m/s]. A branch ends if the smallest step
        cannot continue it.
    first_share_step, least_share_step : the same along the share of a term of the air loads.
    first_frequency_step, least_frequency_step : the same along frequency, as shares of the frequency.
    step_growth : the next step is at most this multiple of the last.
    aimed_step : the next step is chosen so that the orbit moves by this share of `max_step`.
    step_iterations : iterations of the solver if Newton's method fails, for example where a bound becomes active.
    fewer_starts : at speeds between the first and the last, the number of starts is divided by this, because
        continuation finds most optima there.
    followed : number of optima of one speed that are continued, the best first.
    near_closure : unknowns with a smaller residual, in the optimiser's scale, count as close to an orbit.
    sweeps : largest number of passes along a series, up and down.
    improvement : a neighbour's result must be better by this share to replace a problem's own.
    batch_size : largest number of problems that are solved in sequence, so that earlier solutions help later ones.
        It is small enough to spread a batch over processes.
    batch_first : in a group of more than `batch_size` similar problems, this many are solved first; they help
        all others.
    near_share : solutions have about equal weight in a prediction if their distances from the predicted problem are
        below this share of the largest of these distances.
    rounding : relative differences between numbers that come from rounding.
    refined_to : distance from the lowest point of a curve to its neighbours on both sides [m/s]; speeds are added
        until it is reached. Power 0.1 m/s beside its minimum is higher by 1e-4 of itself (pigeon), 100 times the
        1e-6 to which certified orbits agree; 0.01 m/s would be lost in them.

    >>> import wingbeat as wb
    >>> options = wb.SolverOptions(continuation=wb.ContinuationOptions(first_speed_step=0.1))
    >>> options.changed()  # pass them on: wb.solve_curve(problem, speeds, options=options)
    {'continuation': {'first_speed_step': 0.1}}
    """

    max_step: float = 0.15
    first_speed_step: float = 0.25
    least_speed_step: float = 0.02
    first_share_step: float = 0.1
    least_share_step: float = 0.005
    first_frequency_step: float = 0.04
    least_frequency_step: float = 0.003
    step_growth: float = 4.0
    aimed_step: float = 0.8
    step_iterations: int = 20
    fewer_starts: int = 3
    followed: int = 5
    near_closure: float = 5.0
    sweeps: int = 6
    improvement: float = 1e-4
    batch_size: int = 256
    batch_first: int = 128
    near_share: float = 0.3
    rounding: float = 1e-12
    refined_to: float = 0.1


@dataclass(frozen=True)
class SensitivityOptions(Options):
    """Options of the derivatives of an optimum.

    Parameters
    ----------
    fine_blocks : a flight has this many times as many steps as the solver's flights. It is accurate to 1e-5.
    step : step of the central differences, as a share of a parameter's size.
    step_tolerance : Newton's method, which finds the optimum of these flights, ends with a step shorter than this,
        in the optimiser's scale.
    room : how far difference steps may leave the bounds, in the optimiser's scale.

    >>> import wingbeat as wb
    >>> options = wb.SolverOptions(sensitivity=wb.SensitivityOptions(step=3e-4))
    >>> options.changed()  # pass them on: wb.sensitivities(orbit, options=options)
    {'sensitivity': {'step': 0.0003}}
    """

    fine_blocks: int = 6
    step: float = 1e-4
    step_tolerance: float = 1e-9
    room: float = 1.0


@dataclass(frozen=True)
class DiagnosisOptions(Options):
    """Options of the diagnosis of a problem without an orbit: which balance fails, and which changes help.

    Parameters
    ----------
    nearest_ends : number of end points of starts at which the search for the closest wingbeat begins.
    ends_apart : two end points count as different if an unknown differs by this share of its range.
    deficit : options of the least squares that find the wingbeat with the smallest deficit.
    trial_evaluations : number of evaluations from each end point. After them, only the best end point continues.
    violation_weight : weight of the conditions that must hold. A residual of 1 in the optimiser's scale counts as
        much as a deficit of this multiple of the vehicle's weight.
    kept_closure : a condition holds if its residual is below this, in the optimiser's scale.
    least_gravity : if gravity is below this, this value gives the weight that forces are divided by [m/s2].
    negligible_deficit : a deficit below this share of the weight counts as zero.
    clear_deficit : at a given frequency, no more starts follow if the closest wingbeat of the first ones misses a
        balance by this share. In four such flights (pigeon, gull, bat), none of 38 more starts closed.
    negligible_change : a change below this share of its scale counts as zero. The problem then has an orbit that
        the starts missed.
    mentioned : deficits above this share of the largest are reported.
    near_bound : a wingbeat nearer to a bound than this share of its range counts as at the bound.
    reported : largest number of reported changes.
    slack : the smallest change is widened to this multiple of itself. With the smallest change there is only one
        orbit, and that orbit is hard to certify.
    widened : numbers of steps in the last digit by which a change is widened. They are tried in this order until
        an orbit is certified.
    difference_step : step of the difference quotients for derivatives by a number of the vehicle or the flight, as
        a share of the number's scale.
    far_iterations, back_iterations : largest number of SLSQP iterations when a changed number is first moved far,
        and each time it is then moved back.
    back_times : the number is moved back at most this often, each time from the last end point.
    raised_bounds : multiples of the lower bound of frequency that are tried where the lowest frequency may be at
        this bound.
    raised_starts : number of starts for each of these raised bounds.
    term_starts : number of starts of the search without one term of the air loads. The closest wingbeat is one
        more start.
    term_trace : a first search keeps this share of the term, because the compiled programs then still apply. The
        problem without the term needs programs of its own, and is solved only if the first search closes.

    >>> import wingbeat as wb
    >>> options = wb.SolverOptions(diagnosis=wb.DiagnosisOptions(reported=5))
    >>> options.changed()  # pass them on: wb.solve_orbit(problem, options=options)
    {'diagnosis': {'reported': 5}}
    """

    nearest_ends: int = 6
    ends_apart: float = 0.2
    deficit: LeastSquaresOptions = field(default_factory=LeastSquaresOptions)
    trial_evaluations: int = 25
    violation_weight: float = 100.0
    kept_closure: float = 1e-3
    least_gravity: float = 1e-3
    negligible_deficit: float = 1e-3
    clear_deficit: float = 0.05
    negligible_change: float = 1e-3
    mentioned: float = 0.2
    near_bound: float = 0.02
    reported: int = 3
    slack: float = 1.02
    widened: tuple[int, ...] = (0, 1, 3, 10)
    difference_step: float = 1e-6
    far_iterations: int = 40
    back_iterations: int = 60
    back_times: int = 3
    raised_bounds: tuple[float, ...] = (2.0, 4.0, 8.0)
    raised_starts: int = 4
    term_starts: int = 4
    term_trace: float = 1e-9


@dataclass(frozen=True)
class ChangeOptions(Options):
    """Options of the single changes that are tried if no orbit exists.

    Parameters
    ----------
    large_angle : a change of an angle by this counts as much as a change of another number by 100 % [rad].
    limit_factor : a limit moves by at most this multiple of itself.
    lightest : the lightest body that is tried, as a share of the body's mass.
    faster : largest increase of speed, as a share of the problem's speed or of `low_speed`, whichever is larger.
    slowest : lowest speed that is tried if the problem contains a cost of transport, as a share of the problem's
        speed.
    wide_frequency : the upper bound of frequency may rise to this multiple of itself, or to 200 Hz if that is more.
        The lower bound may fall to its value divided by this number, or to 0.1 Hz if that is less. A scaling law
        that was used outside its data, for a bat of 10 kg, gave bounds that were 9 times too low.
    raised_frequency : increases of the upper bound of frequency that are tried first, as shares of this bound.
    beyond : mass, climb and shoulder are first moved by this multiple of the deficit, as a share of their scale.
    chords : largest shift of the shoulder [chords].
    low_speed : if the problem's speed is lower than this, a change of speed or climb by this much is large [m/s].

    >>> import wingbeat as wb
    >>> options = wb.SolverOptions(changes=wb.ChangeOptions(lightest=0.5))
    >>> options.changed()  # pass them on: wb.solve_orbit(problem, options=options)
    {'changes': {'lightest': 0.5}}
    """

    large_angle: float = math.radians(60.0)
    limit_factor: float = 30.0
    lightest: float = 0.1
    faster: float = 5.0
    slowest: float = 0.01
    wide_frequency: float = 10.0
    raised_frequency: tuple[float, ...] = (1.0, 3.0, 9.0)
    beyond: float = 1.1
    chords: float = 2.0
    low_speed: float = 2.0


@dataclass(frozen=True, repr=False)
class SolverOptions(Options):
    """Every tuning number of the solvers, each with its default. Printed, it shows those that are not the default.

    Parameters
    ----------
    search : options of the starts and the local searches.
    certificate : options of the correction of an optimum, and of the flight that certifies it.
    continuation : options of the continuation of orbits along speed, and from problem to problem.
    diagnosis : options of the diagnosis of the balance that fails if there is no orbit.
    changes : options of the changes that are tried if there is no orbit.
    sensitivity : options of the derivatives of an optimum.
    wake : options of the lag of the wake.

    Raises
    ------
    InvalidInputError : a value of another class.

    >>> from wingbeat.orbits.search_options import SearchOptions
    >>> SolverOptions(search=SearchOptions(iterations=100)).changed()
    {'search': {'iterations': 100}}
    >>> SolverOptions(), SolverOptions(search=SearchOptions(iterations=100))
    (SolverOptions(), SolverOptions(search=SearchOptions(iterations=100)))
    """

    search: SearchOptions = field(default_factory=SearchOptions)
    certificate: CertificateOptions = field(default_factory=CertificateOptions)
    continuation: ContinuationOptions = field(default_factory=ContinuationOptions)
    diagnosis: DiagnosisOptions = field(default_factory=DiagnosisOptions)
    changes: ChangeOptions = field(default_factory=ChangeOptions)
    sensitivity: SensitivityOptions = field(default_factory=SensitivityOptions)
    wake: WakeOptions = field(default_factory=WakeOptions)

    def __repr__(self) -> str:  # not every number: this is the default that `help` shows of each solver
        return _shown(self, SolverOptions())

    def changed(self) -> dict[str, Any]:
        """Return the options that are not the defaults, as a nested dictionary that JSON can hold."""
        return _differences(self, DEFAULTS)


def _changes(options: Any, usual: Any) -> Iterator[tuple[str, Any, Any]]:
    """Yield name, value and default of the options that are not the default."""
    for each in dataclasses.fields(options):
        value, default = getattr(options, each.name), getattr(usual, each.name)
        if value != default:
            yield each.name, value, default


def _shown(options: Any, usual: Any) -> str:
    """Return options as Python writes them, without those that are the default."""
    shown = [
        f"{name}={_shown(value, default) if dataclasses.is_dataclass(value) else repr(value)}"
        for name, value, default in _changes(options, usual)
    ]
    return f"{type(options).__name__}({', '.join(shown)})"


def _differences(options: Any, usual: Any) -> dict[str, Any]:
    return {
        name: _differences(value, default) if dataclasses.is_dataclass(value) else value
        for name, value, default in _changes(options, usual)
    }


DEFAULTS = SolverOptions()
