"""``wingbeat uncertainty``: error bars of an orbit, to first order and from orbits with random parameters."""

from __future__ import annotations

from typing import Annotated, Any

from rich.console import Console

from wingbeat._base import FaultList, InvalidInputError, written
from wingbeat._workers.tuning import core_count
from wingbeat.cli import problem_options as options
from wingbeat.cli.arguments import Whole, flag, option, several
from wingbeat.cli.process import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.terminal import print_json, progress_bar
from wingbeat.orbits.options import Status
from wingbeat.orbits.problem.outputs import check_quantities
from wingbeat.orbits.problem.quantities import named_objective
from wingbeat.results.orbit import solve_orbit
from wingbeat.results.sensitivities import (
    QUANTITIES,
    Comparison,
    check_draws,
    in_words,
    ranked_in_words,
    sensitivities,
    uncertainty_by_samples,
)

_DEFAULT = (*QUANTITIES, "spectral_radius")


def uncertainty(
    species: Annotated[str, options.SPECIES],
    *,
    speed: Annotated[float, options.SPEED],
    climb: options.Climb = 0.0,
    model: options.ModelOptions = options.DEFAULT_MODEL,
    minimise: options.Minimise = None,
    quantities: Annotated[
        list[str] | None,
        several(f"Quantities whose uncertainty to compute, as in `wingbeat orbit`; default {' '.join(_DEFAULT)}."),
    ] = None,
    within_plausible: options.WithinPlausible = False,
    samples: Annotated[Whole, option("Number of random samples to solve.")] = 2000,
    share: Annotated[
        float, option("Fraction of every plausible range to sample, around the parameter's value.")
    ] = 1.0,
    seed: Annotated[Whole, option("Seed of the samples.")] = 0,
    set_: options.Settings = None,
    payload: options.Payload = 0.0,
    json: Annotated[bool, flag("Print the numbers as JSON and nothing else.")] = False,
) -> int:
    """Compute the uncertainty of an orbit's frequency, power and stability, and check its first-order estimate.

    Every number of the species file is drawn uniformly from its plausible range. If `--aero` names a fit, its
    coefficients are drawn from their covariance. The orbit of every draw belongs to the same family.
    With spectral_radius among the quantities, the command counts the draws whose orbit is stable.

    Exit code 0: certified. 3: there is no certified orbit to vary.

    Example: wingbeat uncertainty pigeon --speed 10 --samples 500 --share 0.3
    """
    asked = {"climb": climb, "minimise": minimise}
    problem = model.problem(species, speed, set_, payload, within_plausible=within_plausible, **asked)
    faults, fit = FaultList(), model.fit()
    check_draws(faults, problem, samples, share, fit)
    faults.raise_if_any()
    named = map(named_objective, _DEFAULT if quantities is None else quantities)
    known = list({quantity.name: quantity for quantity in named}.values())  # each once
    if unknown := check_quantities(known, problem.aero, problem.vehicle.drive):
        raise InvalidInputError(unknown)
    with progress_bar(f"{problem.species.name} at {speed:g} m/s") as progress:
        orbit = solve_orbit(problem, seed=seed, progress=progress)
    if orbit.status is not Status.CONVERGED:
        Console(stderr=True).print(f"{orbit.status.value}: {orbit.message}", markup=False)
        return EXIT_NOT_CERTIFIED
    slopes = sensitivities(orbit, known)
    names = [quantity.name for quantity in known]
    if not json:  # before the draws, so that a run that is stopped leaves an answer
        console = Console(stderr=True)
        console.print(f"To first order, not yet checked by {samples} draws:")
        for name in names:
            told = in_words(slopes.error_bar(name, fit, share))
            console.print(f"  {told}", markup=False, highlight=False, soft_wrap=True)
    processes = max(1, min(core_count(), samples // 200))  # one takes as long to start as some hundred draws
    with progress_bar(f"{samples} draws") as progress:
        found = uncertainty_by_samples(slopes, names, samples, seed, fit, share, processes, progress)
    if json:
        print_json({name: _plain(one) for name, one in found.items()})
    else:
        for one in found.values():
            _print(one, Console())
    return EXIT_GOOD


def _plain(one: Comparison) -> dict[str, Any]:
    holds = one.first_order_holds
    told = one.first_order._asdict() if holds else one.first_order.ranked()
    stable = None if one.stable is None else one.stable.record()
    plain = one._asdict() | {"first_order": told, "first_order_holds": holds}
    return plain | {"limited": one.limited._asdict(), "stable": stable}


def _print(one: Comparison, console: Console) -> None:
    bar = one.first_order
    name = bar.quantity.replace("_", " ")
    shown = one.limited.shown(one.mean, one.deviation, bar.unit)
    if one.first_order_holds and bar.ranking:
        rows = [(f"{name}, first order", in_words(bar).removeprefix(f"{name} "))]
        rows += [("  mean over the ranges", written(bar.value + bar.shift, bar.deviation, bar.unit))]
    else:
        label = "first order (ranking only)" if bar.ranking else "of the orbit"
        rows = [(f"{name}, {label}", ranked_in_words(bar).removeprefix(f"{name} "))]
    rows.append((f"{name}, {one.certified} of {one.drawn} certified", shown))
    if one.deviation and not one.limited.most:
        rows += [
            ("  standard error of that deviation", written(one.standard_error, unit=bar.unit, digits=2)),
            ("  variance that first order explains", f"{max(one.explained, 0.0):.1%}"),
        ]
    if one.stable is not None:
        rows.append(("the verdict `stable`", str(one.stable)))
    for label, value in rows:
        console.print(f"{label:48s}{value}", markup=False, highlight=False, soft_wrap=True)
