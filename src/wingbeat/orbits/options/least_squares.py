"""Options of least squares within bounds."""

from __future__ import annotations

from dataclasses import dataclass

from wingbeat.orbits.options.checks import check_options


@dataclass(frozen=True)
class LeastSquaresOptions:
    """Options of the Levenberg-Marquardt method within bounds, with Nielsen's rule for the damping.

    Parameters
    ----------
    evaluations : largest number of evaluations of the residuals.
    tolerance : the method ends when a step reduces the sum of squares by less than this share.
    step_tolerance : a step shorter than this, in the optimiser's scale, also ends it.
    damping, least_damping : initial and smallest damping, each as a ratio to the largest curvature. If there are
        fewer residuals than unknowns, a step without damping would not be unique.
    shrink, growth : an accepted step multiplies the damping by the ratio `shrink` or a larger one. The first
        rejected step multiplies it by `growth`, and each further rejected step by twice the previous ratio.
    accepted : a step that gains less than this share of the linear model's prediction is rejected.
    trusted : only a step that gains more than this share of the prediction may be the last.
    bound_changes : largest number of active-set iterations of one step, divided by the number of unknowns. Each
        iteration makes one bound active or inactive.

    >>> import wingbeat as wb
    >>> deficit = wb.LeastSquaresOptions(evaluations=300)
    >>> options = wb.SolverOptions(diagnosis=wb.DiagnosisOptions(deficit=deficit))
    >>> options.changed()  # pass them on: wb.solve_orbit(problem, options=options)
    {'diagnosis': {'deficit': {'evaluations': 300}}}
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
