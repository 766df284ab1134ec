"""Options of the diagnosis of a problem without an orbit."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from wingbeat.orbits.options.checks import check_options
from wingbeat.orbits.options.least_squares import LeastSquaresOptions


@dataclass(frozen=True)
class DiagnosisOptions:
    """Options of the diagnosis of a problem without an orbit: which balance fails, and which single changes fly.

    Parameters
    ----------
    nearest_ends : end points of starts from which the closest wingbeat is computed.
    ends_apart : two end points count as different if an unknown differs by this share of its range.
    deficit : least squares that find the wingbeat with the smallest deficit.
    trial_evaluations : evaluations for each end point before only the best continues.
    violation_weight : weight of the conditions that must hold: a residual of 1 in the optimiser's scale counts as
        much as a deficit of so many times the vehicle's weight.
    kept_closure : a condition holds if its residual is below this, in the optimiser's scale.
    least_gravity : smallest gravity that defines the weight with which forces are compared [m/s2].
    negligible_deficit : a deficit below this share of the weight counts as zero.
    negligible_change : a change below this share of its scale counts as zero: the starts had missed an orbit.
    mentioned : deficits above this share of the largest are reported.
    near_bound : a wingbeat nearer to a bound than this share of its range counts as at the bound.
    reported : largest number of reported changes.
    slack : the smallest change is widened to this multiple. At the smallest itself there is only one orbit, which
        is hard to certify.
    widened : steps of the last digit by which a change is widened until an orbit is certified.
    difference_step : of derivatives by a number of the vehicle or the flight, as a share of its scale.
    far_iterations, back_iterations : iterations of SLSQP with the number moved far, and each time it is moved back.
    back_times : how often it is moved back at most, each time from the last end point.
    raised_bounds : multiples of the lower bound of frequency that are tried where the minimum may be at it.
    raised_starts : starts for each of these bounds.
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

    def __post_init__(self) -> None:
        check_options(self)


@dataclass(frozen=True)
class ChangeOptions:
    """Options of the single changes that are tried if no orbit exists.

    Parameters
    ----------
    large_angle : a change of an angle by this counts as much as a change of another number by 100 % [rad].
    limit_factor : a limit moves by at most this multiple of itself.
    lightest : the lightest body, as a share of its mass.
    faster : largest increase of speed, as a share of the problem's speed or of `low_speed`, whichever is larger.
    slowest : slowest speed if the problem contains a cost of transport, as a share of the problem's.
    wide_frequency : the upper bound of frequency may rise to this multiple, or to 200 Hz if that is more; the lower
        bound may fall to its inverse, or to 0.1 Hz if that is less. Bounds of a scaling law used outside its data
        were 9 times too low (a bat of 10 kg).
    raised_frequency : increases of the upper bound of frequency that are tried first, as shares of it.
    beyond : mass, climb and shoulder are first moved by this multiple of the deficit, as a share of their scale.
    chords : largest shift of the shoulder [chords].
    low_speed : a change of speed or climb by this much is large if the speed is lower [m/s].
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
