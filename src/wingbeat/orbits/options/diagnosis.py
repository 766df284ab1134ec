"""Options of what is found out where there is no orbit."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from wingbeat.orbits.options.checks import check_options
from wingbeat.orbits.options.least_squares import LeastSquaresOptions


@dataclass(frozen=True)
class DiagnosisOptions:
    """Options of the diagnosis of a problem without an orbit: what is short, and which single changes fly.

    Parameters
    ----------
    nearest_ends : ends of searches that the beat nearest to an orbit is sought from.
    ends_apart : two ends count as two where an unknown differs by this share of its range.
    deficit : least squares that find the beat with the least deficit.
    trial_evaluations : of each end, before the best goes on alone.
    violation_weight : a residual of 1 in the optimiser's scale, where the law of balance is kept, weighs as much as
        so many weights that are short.
    kept_closure : a residual, in the optimiser's scale, that counts as none.
    least_gravity : gives a weight to compare forces with [m/s2].
    nothing : a share of the weight that counts as none.
    mentioned : of several deficits those are reported that are more than this share of the largest.
    near_bound : a beat nearer to a bound than this share of its range is held back by it.
    reported : changes that are reported, at most.
    slack : times the least change that is reported. At the least itself there is one orbit only, and it is hard to
        certify.
    widened : steps of the last digit by which a change is widened until an orbit is certified.
    difference_step : of derivatives by a number of the vehicle or the flight, as a share of its scale.
    far_iterations, back_iterations : of the search with the number moved far, and of each that moves it back.
    back_times : how often it is moved back, each time from where the last ended.
    raised_bounds : times the lower bound of frequency, where the least frequency may end at it.
    raised_starts : searches for each of these bounds.
    """

    nearest_ends: int = 6
    ends_apart: float = 0.2
    deficit: LeastSquaresOptions = field(default_factory=LeastSquaresOptions)
    trial_evaluations: int = 25
    violation_weight: float = 100.0
    kept_closure: float = 1e-3
    least_gravity: float = 1e-3
    nothing: float = 1e-3
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
    """Options of the single changes that are tried where there is no orbit.

    Parameters
    ----------
    large_angle : a change of an angle by this counts as large as a change of another number by all of itself [rad].
    limit_factor : times itself that a limit is raised by, or lowered.
    lightest : the lightest body, as a share of its mass.
    faster : the most that is added to the speed, as a share of what was asked for.
    slowest : the slowest flight where a cost of transport is asked for, as a share of the speed.
    wide_frequency : the ends of the range of frequencies move to so many times themselves, or divided by it. Bounds
        of a scaling law used outside its data were 9 times too low (a bat of 10 kg).
    raised_frequency : shares of the upper end by which it is raised first.
    beyond : times the deficit that a number is moved first.
    chords : that the shoulder is moved by, at most.
    low_speed : what counts as a large change of a speed near 0 [m/s].
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
