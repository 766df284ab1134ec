"""Options of manoeuvres."""

from __future__ import annotations

from dataclasses import dataclass

from wingbeat.orbits.options.checks import check_options
from wingbeat.stability.feedback_options import FeedbackOptions


@dataclass(frozen=True)
class ManoeuvreOptions:
    """Options of manoeuvres from one speed to another.

    Parameters
    ----------
    acceleration : mean acceleration for which the number of beats is chosen, if it is not given [m/s2]. From 12 to
        14 m/s a pigeon can do with 1 m/s2, but not with 2: its frequency would exceed its limit.
    doublings : if the number of beats is not given and does not suffice, it is doubled at most so many times. From
        12 to 14 m/s, beats for 2 m/s2 must be doubled once.
    speed_step : largest step of speed between the steady flights that make the schedule [m/s].
    iterations : largest number of Gauss-Newton steps of a steady flight and of a transition. Pigeons took 4 to 9.
    free_steps, caution : after so many steps of a transition, the cost of a step over that of the deviation grows
        by this factor with each step. Without it, a pigeon from 6 to 16 m/s was not through in 30 steps.
    largest_step : no step changes an input by more than this many of its units [-].
    step_tolerance : a search ends when no input changes by more than this many of its units [-].
    blocks : a beat is flown in this many times 32 steps; the adaptive integrator corrects the end of the beat.
    corrections : how often the ends of all beats are corrected; each time the misses fall by a factor of 10 or
        more.
    defect : a manoeuvre is certified if no beat, flown by the adaptive integrator, misses its end by more than this
        share of the scales of the state [-].
    jump : nor is it certified if the wing jumps from beat to beat by more than this [rad or rad/s]. Rounding leaves
        some 1e-13.
    smoothness : cost of a change of an input from beat to beat, over the cost of its deviation from the schedule.
    reach : commands exceed the inputs of the steady flights by at most so many of their units [-]. A pigeon that
        flies from 6 to 16 m/s and back needs 4.0 with 2 m/s2, and 3.0 with 1 m/s2.
    feedback : scales of the state and units of the inputs.

    >>> import wingbeat as wb
    >>> options = wb.ManoeuvreOptions(acceleration=0.5)  # pass them on: wb.manoeuvre(..., options=options)
    >>> options.acceleration, options.feedback.z
    (0.5, 0.2)
    """

    acceleration: float = 1.0
    doublings: int = 3
    speed_step: float = 1.0
    iterations: int = 30
    free_steps: int = 3
    caution: float = 3.0
    largest_step: float = 4.0
    step_tolerance: float = 1e-8
    blocks: int = 2
    corrections: int = 4
    defect: float = 1e-6
    jump: float = 1e-9
    smoothness: float = 10.0
    reach: float = 6.0
    feedback: FeedbackOptions = FeedbackOptions()  # noqa: RUF009, frozen

    def __post_init__(self) -> None:
        check_options(self)


DEFAULTS = ManoeuvreOptions()
