"""Options of the searches for an orbit."""

from __future__ import annotations

from dataclasses import dataclass, field

from wingbeat.orbits.options.checks import check_options
from wingbeat.orbits.options.least_squares import LeastSquaresOptions
from wingbeat.orbits.options.start_families import START_FAMILIES, StartFamily


@dataclass(frozen=True)
class SearchOptions:
    """Options of the searches from several starts, before anything is certified.

    In the optimiser's scale 0.15 is 2 degrees of flap amplitude or body pitch, 0.9 Hz, or 0.15 m/s.

    Parameters
    ----------
    starts : of a problem that minimises the frequency within the species' bounds. With 6 none of 480 answers of the
        built-in animals was more than 0.5 % above the best of 80 random starts.
    starts_of_outputs : where the objective or a limit is an output of the wingbeat. Such problems have more optima:
        6 starts missed the bat's least frequency within a limit of its power at 10 m/s by half, 12 did not.
    starts_of_many_optima : where bounds are the user's own, or a peak is minimised. With a flap amplitude of 50 deg
        at most, 12 missed the bat's least frequency at 10 m/s by 3 %, 24 did not; of 30 random starts 4 led to the
        bat's least peak pitch torque at 14 m/s, which 12 missed by half.
    most_starts : as long as none can be certified, more starts follow, up to this many.
    start_families : the first starts, one in each family of wingbeats.
    random_margin : random starts keep this share of their range off the bounds.
    random_below, random_above : how far they go from the stock start in body pitch, u, w [rad, m/s, m/s] and pitch
        rate [rad/s].
    random_octaves : how far they go below and above the stock start's frequency.
    start_spread : how far from the best optimum the starts beside it are, in the optimiser's scale.
    iterations, tolerance : of SLSQP, and its tolerance of the objective.
    local_iterations : from the answer of a neighbouring problem.
    closure_tolerance : what a search must reach [m, rad, m/s, rad/s]. The last digits come when the orbit is
        corrected.
    optimality_tolerance : largest residual of the optimality conditions, in the optimiser's scale.
    bound_tolerance : an unknown this near to a bound, as a share of its range, is at the bound; likewise the limits
        along the path, in their own scale.
    diverged_closure, diverged_flights : a search that is still farther from closure after so many flights has
        diverged. Of 376 searches that met an orbit, 2 were.
    restoration : least squares that bring a start near closure before the objective counts.
    restored_closure : a start that stays farther from closure, in the optimiser's scale, is given up.
    same_optimum : optima nearer to one another than this, in the optimiser's scale, are of one family. Some
        wingbeats change a little at hardly any cost, and where along them a search stops is chance.
    uncorrected_error : an optimum whose objective is more than this share above a certified one is no better. Of
        200 frequencies nearly all changed by less than 0.0025 when they were corrected.
    plane_clearance : strip corners keep this share of the wing's length off the plane of symmetry. It is ten times
        what the other tolerances leave open: 3 micrometres of 0.3 m.
    largest_residual : residuals of flights that tumble off are cut to this, so that a line search can back away.
    """

    starts: int = 6
    starts_of_outputs: int = 12
    starts_of_many_optima: int = 24
    most_starts: int = 50
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
    largest_residual: float = 1e3

    def __post_init__(self) -> None:
        check_options(self)
