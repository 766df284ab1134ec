"""Options of the diagnosis of a problem without an orbit."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from wingbeat.orbits.options.checks import check_options
from wingbeat.orbits.options.least_squares import LeastSquaresOptions


@dataclass(frozen=True)
class DiagnosisOptions:
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

    def __post_init__(self) -> None:
        check_options(self)


@dataclass(frozen=True)
class ChangeOptions:
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

    def __post_init__(self) -> None:
        check_options(self)
