"""Options of the correction of an optimum, and of its certificate."""

from __future__ import annotations

from dataclasses import dataclass, field

from wingbeat.mechanics.flights import RTOL
from wingbeat.orbits.options.checks import check_options


@dataclass(frozen=True)
class NewtonOptions:
    """Options of Newton's method on the optimality conditions.

    Parameters
    ----------
    iterations : largest number of iterations.
    step_tolerance : the method ends with a step shorter than this, in the optimiser's scale.
    difference_step : step of the differences that measure the curvature along the null space [optimiser's scale].
    residual_tolerance, gradient_tolerance : the method also ends when the residual and the reduced gradient are
        this small, in the optimiser's scale. A further step could not improve them.
    rank_tolerance : singular values below this share of the largest count as zero.
    normal_share : a step updates the curvature along the null space if its normal part is at most this share of its
        tangential part.
    curvature_share : the update also requires that the curvature along the step exceeds this share of the expected
        curvature.
    diverged : a larger violation, in the optimiser's scale, ends the method.

    >>> import wingbeat as wb
    >>> newton = wb.NewtonOptions(iterations=20)
    >>> options = wb.SolverOptions(certificate=wb.CertificateOptions(newton=newton))
    >>> options.changed()  # pass them on: wb.solve_orbit(problem, options=options)
    {'certificate': {'newton': {'iterations': 20}}}
    """

    iterations: int = 10
    step_tolerance: float = 1e-5
    difference_step: float = 1e-4
    residual_tolerance: float = 3e-8
    gradient_tolerance: float = 3e-6
    rank_tolerance: float = 1e-13
    normal_share: float = 0.05
    curvature_share: float = 0.1
    diverged: float = 5.0

    def __post_init__(self) -> None:
        check_options(self)


@dataclass(frozen=True)
class CertificateOptions:
    """Options of the correction of an optimum to a closed orbit, and of the flight that certifies it.

    Parameters
    ----------
    closure_tolerance : largest residual of a certified orbit [m, rad, m/s, rad/s].
    limit_tolerance : body pitch and flap angles [rad], corners of the wing [wing lengths] and constraints [the
        constraint's scale] may exceed their limits by this.
    aimed_closure : target of the correction, stricter than the tolerance so that rounding does not decide [m, rad,
        m/s, rad/s].
    rtol : relative tolerance of the certifying flight (Dopri8).
    rough_rtol : relative tolerance of flights that only serve the correction. They are accurate to 1e-8 and take
        half the time.
    fine_blocks : a corrected flight has this many times as many steps as the solver's flights.
    linear_range : the derivative of a finer flight is valid within this distance, in the optimiser's scale.
    linearisations : the derivative of a finer flight is computed at most this many times.
    linearised_step : before the derivative is updated, Newton's method ends with a step shorter than this, in the
        optimiser's scale.
    corrections : largest number of certifying flights.
    trial_corrections, trial_reduction : after `trial_corrections` corrections, the residual must have shrunk to the
        share `trial_reduction` of its first value; otherwise the correction ends.
    bound_updates : how often the active bounds are determined again if a wingbeat closes but is not optimal.
    iterations, tolerance : largest number of iterations of SLSQP, and its tolerance of the objective. SLSQP takes
        over where Newton's method fails.
    newton : options of Newton's method, which follows the optimum while its closure is corrected.

    >>> import wingbeat as wb
    >>> options = wb.SolverOptions(certificate=wb.CertificateOptions(corrections=20))
    >>> options.changed()  # pass them on: wb.solve_orbit(problem, options=options)
    {'certificate': {'corrections': 20}}
    """

    closure_tolerance: float = 1e-6
    limit_tolerance: float = 1e-6
    aimed_closure: float = 3e-7
    rtol: float = RTOL
    rough_rtol: float = 2e-9
    fine_blocks: int = 6
    linear_range: float = 2e-2
    linearisations: int = 4
    linearised_step: float = 1e-3
    corrections: int = 12
    trial_corrections: int = 4
    trial_reduction: float = 0.1
    bound_updates: int = 2
    iterations: int = 40
    tolerance: float = 1e-14
    newton: NewtonOptions = field(default_factory=NewtonOptions)

    def __post_init__(self) -> None:
        check_options(self)
