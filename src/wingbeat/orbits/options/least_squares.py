"""Options of least squares within bounds."""

from __future__ import annotations

from dataclasses import dataclass

from wingbeat.orbits.options.checks import check_options


@dataclass(frozen=True)
class LeastSquaresOptions:
    """Options of the Levenberg-Marquardt method within bounds; dampings and steps as Nielsen proposes them.

    Parameters
    ----------
    evaluations : largest number of evaluations of the residuals.
    tolerance : it ends where a step lessens the sum of squares by less than this share.
    step_tolerance : a shorter step, in the optimiser's scale, ends it.
    damping, least_damping : initial and smallest damping, divided by the largest curvature. Without the smallest,
        fewer residuals than unknowns fix no step.
    shrink, growth : of the damping after a step that is taken, at most, and after the first that is not.
    accepted : a step that gains less than this share of the linear model's prediction is rejected.
    trusted : only a step that gains more than this share may be the last.
    bound_changes : bounds that one step may meet or leave, over the number of unknowns.
    """

    evaluations: int = 150
    tolerance: float = 1e-5
    step_tolerance: float = 1e-9
    damping: float = 1e-3
    least_damping: float = 1e-12
    shrink: float = 0.2
    growth: float = 2.0
    accepted: float = 1e-3
    trusted: float = 0.25
    bound_changes: int = 4

    def __post_init__(self) -> None:
        check_options(self)
