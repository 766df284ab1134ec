"""Options of the solver's starts and of its local searches."""

from __future__ import annotations

from dataclasses import dataclass, field

from wingbeat.orbits.options.checks import check_options
from wingbeat.orbits.options.least_squares import LeastSquaresOptions
from wingbeat.orbits.options.start_families import START_FAMILIES, StartFamily


@dataclass(frozen=True)
class SearchOptions:
    """Options of the solver's starts, before anything is certified.

    In the optimiser's scale, 0.15 is 2 degrees of flap amplitude or body pitch, 0.9 Hz, or 0.15 m/s.

    Parameters
    ----------
    starts : number of starts of a problem that minimises the frequency within the species' bounds. With 6 starts,
        none of 480 optima of the built-in species was more than 0.5 % above the best of 80 random starts.
    starts_of_outputs : number of starts if the objective or a limit is an output of the wingbeat. Such problems
        have more optima. For the bat at 10 m/s within a power limit, 6 starts gave 1.5 times the lowest frequency;
        12 starts found the lowest frequency.
    starts_of_many_optima : number of starts if the user sets bounds, or if a peak is minimised. With the flap
        amplitude limited to 50 deg, 12 starts missed the bat's lowest frequency at 10 m/s by 3 %; 24 starts found
        it. 12 starts missed the bat's lowest peak pitch torque at 14 m/s by half; of 30 random starts, 4 led to it.
    most_starts : while no start leads to a certified orbit, more starts follow, up to this many.
    most_stable_starts : the same, if the problem asks for stability. Stable orbits are next to optima without
        limits of stability; few are found from other starts. Of 190 stable orbits of random vehicles, 6 needed it.
    start_families : the first starts, one in each family of wingbeats.
    random_margin : distance of random starts from the bounds, as a share of the range.
    random_below, random_above : largest distance of random starts below and above the stock start in body pitch, u,
        w [rad, m/s, m/s] and pitch rate [rad/s].
    random_octaves : how far random starts go below and above the stock start's frequency [octaves].
    start_spread : distance of additional starts from the best optimum, in the optimiser's scale.
    iterations, tolerance : largest number of iterations of SLSQP, and its tolerance of the objective.
    local_iterations : iterations of a search that starts from the result of a neighbouring problem.
    closure_tolerance : a start must reach a residual this small [m, rad, m/s, rad/s]. The later correction of the
        orbit gives the last digits.
    optimality_tolerance : largest residual of the optimality conditions, in the optimiser's scale.
    bound_tolerance : an unknown closer to a bound than this share of its range is at the bound. The same number
        holds for limits along the path, in their own scale.
    diverged_closure, diverged_flights : a local search is stopped as diverged after at least `diverged_flights`
        flights if its violation in every flight, in the optimiser's scale, exceeded `diverged_closure`. The rule
        would have stopped 2 of 376 searches that found an orbit.
    restoration : options of the least squares that bring a start close to closure before the objective counts.
    restored_closure : a start is abandoned if its residual is then larger than this, in the optimiser's scale.
    same_optimum : optima closer to one another than this, in the optimiser's scale, count as one. Some wingbeats
        can change a little while the objective hardly changes. It is then chance where a local search stops.
    uncorrected_error : error of the objective of an uncorrected optimum, as a share of the objective. An
        uncorrected optimum is left out if its objective exceeds that of a certified optimum by more than this,
        because correction would not make it the better one. Correction changed nearly all of 200 frequencies by
        less than this.
    plane_clearance : strip corners stay away from the plane of symmetry by this share of the wing's length. The
        default is ten times the other tolerances; for a wing of 0.3 m it is 3 micrometres.
    dear_stability : limits of stability are also tightened step by step if no stable orbit is found, or if the
        objective of the best stable orbit exceeds that of the best orbit without these limits by more than this
        share. Direct searches exceeded this share at 4 of 15 speeds of the pigeon. Their objectives were up to 12 %
        above those from tightened limits.
    tightening_steps, tightening_iterations : steps in which limits of stability are tightened, and the largest
        number of iterations of SLSQP in each. Of 6 searches that succeeded with 8 steps, 2 failed with 4 steps.
    largest_residual : residuals of diverging flights, in the optimiser's scale, are limited to this, so that a line
        search can shorten its step.

    >>> import wingbeat as wb
    >>> options = wb.SolverOptions(search=wb.SearchOptions(most_starts=100))
    >>> options.changed()  # pass them on: wb.solve_orbit(problem, options=options)
    {'search': {'most_starts': 100}}
    """

    starts: int = 6
    starts_of_outputs: int = 12
    starts_of_many_optima: int = 24
    most_starts: int = 50
    most_stable_starts: int = 18
    start_families: tuple[StartFamily, ...] = START_FAMILIES
    random_margin: float = 0.1
    random_below: tuple[float, ...] = (0.2, 0.5, 1.0, 2.0)
    random_above: tuple[float, ...] = (0.3, 0.5, 1.0, 2.0)
    random_octaves: tuple[float, ...] = (1.2, 0.8)
    start_spread: float = 0.5
    iterations: int = 60
    tolerance: float = 1e-6
    local_iterations: int = 40
    closure_tolerance: float = 1e-4
    optimality_tolerance: float = 1e-5
    bound_tolerance: float = 1e-6
    diverged_closure: float = 0.3
    diverged_flights: int = 60
    restoration: LeastSquaresOptions = field(
        default_factory=lambda: LeastSquaresOptions(evaluations=40, tolerance=1e-4)
    )
    restored_closure: float = 1e-3
    same_optimum: float = 0.05
    uncorrected_error: float = 0.01
    plane_clearance: float = 1e-5
    dear_stability: float = 0.07
    tightening_steps: int = 8
    tightening_iterations: int = 15
    largest_residual: float = 1e3

    def __post_init__(self) -> None:
        check_options(self)
