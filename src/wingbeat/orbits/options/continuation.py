"""Options of all that begins from a known answer: along speed, in series and batches, and of derivatives."""

from __future__ import annotations

from dataclasses import dataclass

from wingbeat.orbits.options.checks import check_options


@dataclass(frozen=True)
class ContinuationOptions:
    """Options of the continuation of orbits along speed and from problem to problem.

    Parameters
    ----------
    max_step : an orbit this near to another, in the optimiser's scale, may be its continuation. It is 2 degrees
        of flap amplitude and of body pitch, 0.9 Hz, 0.15 m/s. Orbits farther apart are of one branch only if
        orbits between them lead from one to the other.
    first_speed_step, least_speed_step : along speed [m/s]. A branch that cannot be continued by the least ends.
    step_growth : the next step is at most so many times the last.
    aimed_step : a step aims at this share of `max_step`.
    step_iterations : of the search where Newton's method fails, as where a bound is met or left.
    fewer_starts : between the ends of a range of speeds the starts are divided by this, for most is found by
        continuing.
    followed : optima of one speed that are continued, the best first.
    near_closure : unknowns this near to closure, in the optimiser's scale, are next to an orbit.
    sweeps : along a series, up and down, at most.
    improvement : a neighbour's answer must be better by this share to replace one's own.
    batch_size : problems that are solved one after the other, each helped by those before; few enough to share a
        batch out over processes.
    batch_first : of more that are alike so many go first and help all others.
    near_share : answers nearer than this share of the farthest one in use weigh alike in a prediction.
    rounding : relative differences between numbers that come from rounding.
    """

    max_step: float = 0.15
    first_speed_step: float = 0.25
    least_speed_step: float = 0.02
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

    def __post_init__(self) -> None:
        check_options(self)


@dataclass(frozen=True)
class SensitivityOptions:
    """Options of the derivatives of an optimum.

    Parameters
    ----------
    fine_blocks : the flights have so many times the steps of a search's; they are right to 1e-5.
    step : of central differences, as a share of a parameter's size.
    step_tolerance : of Newton's method that follows the optimum, so that what should vanish does.
    room : how far steps may go outside of the bounds, in the unknowns' scale.
    """

    fine_blocks: int = 6
    step: float = 1e-4
    step_tolerance: float = 1e-9
    room: float = 1.0

    def __post_init__(self) -> None:
        check_options(self)
