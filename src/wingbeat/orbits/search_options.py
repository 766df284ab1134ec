"""Options of the solver's starts and of its local searches."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass, field
from typing import NamedTuple

from wingbeat._base import RTOL, FaultList

_MOST = 1_000_000


@dataclass(frozen=True)
class Options:
    """Options, each refused unless it is of the class of its default, and a number positive and finite.

    A number is whole where its default is. A tuple of numbers holds at least one; they may be zero.
    """

    def __post_init__(self) -> None:
        faults = FaultList()
        for each in dataclasses.fields(self):
            where, value = f"{type(self).__name__}.{each.name}", getattr(self, each.name)
            default = each.default if each.default_factory is dataclasses.MISSING else each.default_factory()
            if isinstance(default, tuple) and isinstance(default[0], int | float):
                if not isinstance(value, tuple) or not value:
                    faults.add(where, value, "must be a tuple of numbers", f"the default is {default}")
                    continue
                for i, part in enumerate(value):
                    if isinstance(default[0], int):
                        faults.whole(f"{where}[{i}]", part, 0, _MOST)
                    else:
                        faults.number(f"{where}[{i}]", part, at_least=0.0)
            elif isinstance(default, int):
                faults.whole(where, value, 1, _MOST)
            elif isinstance(default, float):
                faults.number(where, value, above=0.0)
            elif not isinstance(value, type(default)):
                faults.add(where, value, f"must be a {type(default).__name__}")
        faults.raise_if_any()


@dataclass(frozen=True)
class LeastSquaresOptions(Options):
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


# Multiple of the stock frequency. With multiples from 2 to 4, one start found an orbit for every pigeon and nearly
# every bat varied by +-30 %. With 1, a third of the bats' starts diverged, and took three times the flights.
_BRISK = 2.5


class StartFamily(NamedTuple):
    """A family of wingbeats: the changes that its start makes to the species' stock wingbeat.

    Parameters
    ----------
    flap_mean : offset of the mean flap angle from the middle of its bounds, as a share of half its range; default
        the stock wingbeat's value.
    pitch_mean, pitch_amplitude : values of the start; default those of the stock wingbeat [rad].
    flap_amplitude, frequency : multiples of those of the stock wingbeat.
    nose_up : nose-up rotation of the body from the body pitch at which the stroke plane is upright [rad].

    >>> import wingbeat as wb
    >>> fast = wb.StartFamily(frequency=4.0)
    >>> search = wb.SearchOptions(start_families=(fast, *wb.SearchOptions().start_families))
    >>> options = wb.SolverOptions(search=search)  # pass them on: wb.solve_orbit(problem, options=options)
    >>> len(options.search.start_families)
    7
    """

    flap_mean: float | None = None
    pitch_mean: float | None = None
    pitch_amplitude: float | None = None
    flap_amplitude: float = 1.0
    frequency: float = _BRISK
    nose_up: float = 0.1


_QUIET, _PITCHING, _STEEP = math.radians(3.0), math.radians(15.0), math.radians(30.0)
# Up to 108 starts were tried for each family, on 110 vehicles varied by +-40 %; these are the best. A wide and slow
# beat leads in 68 % of the cases to wings that hardly pitch and beat below the body; a fast beat leads to
# such wings in 55 %. For some bats, wide beats above a body whose nose is down are 30 % slower than any other.
START_FAMILIES = (
    StartFamily(),
    StartFamily(-0.8, 0.0, _QUIET, flap_amplitude=1.3, frequency=1.0, nose_up=0.35),
    StartFamily(0.8, 0.0, _QUIET),
    StartFamily(-0.8, None, _PITCHING),
    StartFamily(None, 0.0, _QUIET, frequency=1.0),
    StartFamily(0.4, 0.3, _STEEP, flap_amplitude=1.3, frequency=1.5, nose_up=-0.6),
)


@dataclass(frozen=True)
class SearchOptions(Options):
    """Options of the solver's starts, before anything is certified.

    In the optimiser's scale, 0.15 is 2 degrees of flap amplitude or body pitch, 0.9 Hz, or 0.15 m/s.

    Parameters
    ----------
    starts : number of starts of a problem that minimises the frequency within the species' bounds. With 6 starts,
        none of 480 optima of the built-in species was more than 0.5 % above the best of 80 random starts.
    starts_of_outputs : number of starts if the objective or a limit is an output of the wingbeat. Such problems
        have more optima. For the bat at 10 m/s within a power limit, 6 starts gave 1.5 times the lowest frequency;
        12 starts found the lowest frequency.
    starts_at_own_frequency : number of starts if an output of the wingbeat is minimised without limits at the
        animal's own frequency: one in each family. In 15 flights of 7 birds and 4 bats by the model animal, 6
        starts lost none of the best orbits of 12 starts, 5 starts lost one bat's, and 3 starts lost all four bats'.
    starts_of_many_optima : number of starts if the user sets bounds, or if a peak is minimised. With the flap
        amplitude limited to 50 deg, 12 starts missed the bat's lowest frequency at 10 m/s by 3 %; 24 starts found
        it. 12 starts missed the bat's lowest peak pitch torque at 14 m/s by half; of 30 random starts, 4 led to it.
    starts_within_ranges : number of starts that search within plausible ranges from the beginning, one in each
        family, if an output of the wingbeat is minimised. All starts search without the ranges, and their optima
        lead into them. Where no orbit is found, the other starts follow. In 19 flights of random birds and bats by
        the model animal, this number and `same_value` changed no best optimum by more than 1e-4 against 24 starts,
        for 0.64 of the time (`benchmarks/plausible_search.py`); in one, only starts within the ranges led to it.
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
    many_free, many_times : over at least so many free parameters, both have so many times as many iterations. With
        9 free, of a bat at 6 m/s, none of 6 starts ended at an optimum within 60 iterations, and all within 120; of
        another at 5 m/s, only those found the best optimum, of a third of the power. Fewer parameters need no more.
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
    same_value : within plausible ranges, optima without the ranges whose objectives differ by no more than this
        share of them count as one: where one of them leads into the ranges, no search begins at the others.
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
    starts_at_own_frequency: int = 6
    starts_of_many_optima: int = 24
    starts_within_ranges: int = 6
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
    many_free: int = 9
    many_times: int = 2
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
    same_value: float = 1e-3
    uncorrected_error: float = 0.01
    plane_clearance: float = 1e-5
    dear_stability: float = 0.07
    tightening_steps: int = 8
    tightening_iterations: int = 15
    largest_residual: float = 1e3


@dataclass(frozen=True)
class WakeOptions(Options):
    """Options of the lag of the wake and of hinges that give way: how states at phase 0 are found that repeat.

    Parameters
    ----------
    near : in a flight of the solver the states repeat if the next step of Newton's method is shorter than this
        [m/s]. That step is taken too, to first order. Beside orbits of a pigeon and a bat, closure is then exact to
        1e-14 and its derivatives to 4e-7, in the optimiser's scale; with 1e-2, only to 4e-7 and 1e-2.
    most_flights : largest number of such steps. In searches of a pigeon at 6 and 12 m/s and of a bat at 3 and 10
        m/s, 1218 of 1220 flights that did not diverge needed at most 4, the others 6 and 8. A beat whose wake does
        not repeat counts as not closed.
    diverged : a flight has diverged if its numbers are larger than this; their squares soon overflow.
    repeats : in a certificate the states repeat within this [m/s], a thousandth of `closure_tolerance`. With 1e-5,
        the end of a bat's beat moves by 6e-6 in SI units, with 1e-7 by 3e-8.
    rough_repeats : the same in flights that only serve the correction, whose `rough_rtol` is as coarse [m/s].
    far : a ratio; if Newton's step is longer than this times one plus the largest state, the states at the end of
        the beat are taken in its place.
    certifying_flights : largest number of flights of a certificate. From the states that the search knows it needed
        3 to 6, from air at rest 17 and more.

    >>> import wingbeat as wb
    >>> options = wb.SolverOptions(wake=wb.WakeOptions(most_flights=12))
    >>> options.changed()  # pass them on: wb.solve_orbit(problem, options=options)
    {'wake': {'most_flights': 12}}
    """

    near: float = 1e-6
    most_flights: int = 8
    diverged: float = 1e12
    repeats: float = 1e-9
    rough_repeats: float = 1e-6
    far: float = 2.0
    certifying_flights: int = 21


WAKE = WakeOptions()


@dataclass(frozen=True)
class NewtonOptions(Options):
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


@dataclass(frozen=True)
class CertificateOptions(Options):
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
