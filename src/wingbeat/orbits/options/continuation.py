"""Options of methods that start from a known optimum: continuation, series, batches, derivatives."""

from __future__ import annotations

from dataclasses import dataclass

from wingbeat.orbits.options.checks import check_options


@dataclass(frozen=True)
class ContinuationOptions:
    """Options of the continuation of orbits along speed, along the share of a term, and from problem to problem.

    Parameters
    ----------
    max_step : an orbit within this distance of another, in the optimiser's scale, may be its continuation. The
        default is 2 degrees of flap amplitude or of body pitch, 0.9 Hz, or 0.15 m/s. Orbits farther apart belong to
        one branch only if orbits between them lead from one to the other.
    first_speed_step, least_speed_step : first and smallest step of speed [m/s]. A branch ends if the smallest step
        cannot continue it.
    first_share_step, least_share_step : the same along the share of a term of the air loads.
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

    def __post_init__(self) -> None:
        check_options(self)


@dataclass(frozen=True)
class SensitivityOptions:
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

    def __post_init__(self) -> None:
        check_options(self)
