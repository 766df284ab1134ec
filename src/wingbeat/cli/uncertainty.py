"""``wingbeat uncertainty``: error bars of an orbit, to first order and from orbits with random parameters."""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any

from rich.console import Console

from wingbeat._base import FaultList, InvalidInputError, cf, for_people, written
from wingbeat._workers.tuning import core_count
from wingbeat.cli import problem_options as options
from wingbeat.cli.arguments import Whole, flag, option, several
from wingbeat.cli.process import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.terminal import print_json, progress_bar
from wingbeat.orbits.options import Status
from wingbeat.orbits.problem.outputs import check_quantities
from wingbeat.results.error_bars import (
    Comparison,
    Difference,
    check_draws,
    difference_by_samples,
    uncertainty_by_samples,
)
from wingbeat.results.orbit import solve_orbit
from wingbeat.results.sensitivities import QUANTITIES, in_words, quantity_of, ranked_in_words, sensitivities

_DEFAULT = (*QUANTITIES, "spectral_radius")
_CONDITIONS = ("speed", "climb", "payload", "altitude", "temperature", "frequency")


def uncertainty(
    species: Annotated[str, options.SPECIES],
    *,
    speed: Annotated[float, options.SPEED],
    climb: options.Climb = 0.0,
    model: options.ModelOptions = options.DEFAULT_MODEL,
    minimise: options.Minimise = None,
    quantities: Annotated[
        list[str] | None,
        several(
            "Quantities whose uncertainty to compute, as in `wingbeat orbit`, or free parameters such as "
            f"flap_amplitude; default {' '.join(_DEFAULT)}."
        ),
    ] = None,
    against: Annotated[
        list[str] | None,
        several(
            "Another condition, such as altitude=0: print both, and the difference with the error bar of the same "
            f"draws. NAME=VALUE: {', '.join(_CONDITIONS)}, or a path as in --set."
        ),
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
    Quote the mean and deviation of the draws: "N of M certified". Two bars that overlap may hide a difference that
    is certain, because most of what is uncertain is the same in both conditions: compare them with --against.
    With spectral_radius among the quantities, the command counts the draws whose orbit is stable.

    Exit code 0: certified. 3: there is no certified orbit to vary.

    Examples: wingbeat uncertainty pigeon --speed 10 --samples 500 --share 0.3;
    wingbeat uncertainty pigeon --speed 14 --model animal --altitude 3000 --against altitude=0 --samples 200
    """
    asked = {"climb": climb, "minimise": minimise}
    problem = model.problem(species, speed, set_, payload, within_plausible=within_plausible, **asked)
    problems = [problem]
    if against is not None:
        conditions, settings = _conditions(against)
        of_model = {name: value for name, value in conditions.items() if hasattr(model, name)}
        kept = [text for text in set_ or () if text.partition("=")[0].strip() not in settings]
        there = dataclasses.replace(model, **of_model).problem(
            species,
            conditions.get("speed", speed),
            [*kept, *settings.values()] or None,
            conditions.get("payload", payload),
            within_plausible=within_plausible,
            **asked | {"climb": conditions.get("climb", climb)},
        )
        problems.append(there)
    faults, fit = FaultList(), model.fit()
    check_draws(faults, problem, samples, share, fit)
    faults.raise_if_any()
    asked_for = _DEFAULT if quantities is None else quantities
    named = [quantity_of(name, problem.free) for name in asked_for]
    known = list({quantity.name: quantity for quantity in named}.values())  # each once
    of_beat = [quantity for quantity in known if not quantity.parameter]
    if unknown := check_quantities(of_beat, problem.aero, problem.vehicle.drive, problem.map_states):
        raise InvalidInputError(unknown)
    slopes = []
    for one in problems:
        with progress_bar(f"{one.species.name} at {one.speed:g} m/s") as progress:
            orbit = solve_orbit(one, seed=seed, progress=progress)
        if orbit.status is not Status.CONVERGED:
            where = "" if one is problem else f"with {' '.join(against or ())}, "
            Console(stderr=True).print(f"{where}{orbit.status.value}: {orbit.message}", markup=False)
            return EXIT_NOT_CERTIFIED
        slopes.append(sensitivities(orbit, known))
    names = [quantity.name for quantity in known]
    if not json:  # before the draws, so that a run that is stopped leaves an answer
        console = Console(stderr=True)
        console.print(f"To first order, not yet checked by {samples} draws:")
        for found, where in zip(slopes, ("", f", with {' '.join(against or ())}"), strict=False):
            for name in names:
                told = in_words(found.error_bar(name, fit, share))
                console.print(f"  {told}{where}", markup=False, highlight=False, soft_wrap=True)
    for guess in dict.fromkeys(line for found in slopes for line in found.guesses):
        Console(stderr=True).print(guess, markup=False, highlight=False, soft_wrap=True)
    processes = max(1, min(core_count(), samples // 200))  # one takes as long to start as some hundred draws
    drawing = names, samples, seed, fit, share, processes
    if against is not None:
        with progress_bar(f"{samples} pairs of draws") as progress:
            differences = difference_by_samples(slopes[0], slopes[1], *drawing, progress)
        _tell_differences(differences, " ".join(against), json)
        return EXIT_GOOD
    with progress_bar(f"{samples} draws") as progress:
        compared = uncertainty_by_samples(slopes[0], *drawing, progress)
    if json:
        print_json({name: _plain(one) for name, one in compared.items()})
    else:
        for one in compared.values():
            _print(one, Console())
        _tell_unsolved(next(iter(compared.values())))
        print(_QUOTE)
    return EXIT_GOOD


_QUOTE = (
    'To quote: mean and standard deviation of the draws, the lines "... certified"; the first order says what they '
    "are due to."
)


def _conditions(against: list[str]) -> tuple[dict[str, float], dict[str, str]]:
    """Return the values of the options, and the numbers by path, that ``--against`` changes."""
    faults, options_, settings = FaultList(), {}, {}
    example = "for example altitude=0, or wing.mass=0.02"
    if not against:
        faults.add("--against", "", "must be NAME=VALUE", example)
    for text in against:
        name, equals, value = (part.strip() for part in text.partition("="))
        if name in options_ or name in settings:
            faults.add("--against", text, "is given twice", "keep one of them")
        elif "." in name or not equals:
            settings[name] = text
            if not equals:
                faults.add("--against", text, "must be NAME=VALUE", example)
        elif name not in _CONDITIONS:
            faults.choice("--against", name, _CONDITIONS)
        else:
            try:
                options_[name] = float(value)
            except ValueError:
                faults.add("--against", text, "must be NAME=VALUE with a number", example)
    faults.raise_if_any()
    return options_, settings


def _tell_differences(found: dict[str, Difference], against: str, json: bool) -> None:
    if json:
        parts = ("here", "there", "difference")
        print_json(
            {
                name: {part: _plain(getattr(one, part)) for part in parts} | {"exact": list(one.exact)}
                for name, one in found.items()
            }
        )
        return
    console = Console()
    for one in found.values():
        _print_difference(one, against, console)
    first = next(iter(found.values()))
    _tell_unsolved(first.here)
    _tell_unsolved(first.there, f"with {against}, ")
    for exact in dict.fromkeys(path for one in found.values() for path in one.exact):
        console.print(f"{exact} differs as asked, so it counts as exact", markup=False, highlight=False)


def _tell_unsolved(one: Comparison, where: str = "") -> None:
    if one.unsolved is not None and one.unsolved.draws:
        Console().print(f"{where}{one.unsolved}", markup=False, highlight=False, soft_wrap=True)


def _print_difference(one: Difference, against: str, console: Console) -> None:
    """Print a quantity of both conditions, and the difference with its error bar."""
    bar, apart = one.difference.first_order, one.difference
    name, (factor, unit) = bar.quantity.replace("_", " "), for_people(cf(bar.unit))
    rows = [
        (f"{name}{where}, {each.certified} of {each.drawn} certified", _shown(each))
        for where, each in (("", one.here), (f" with {against}", one.there))
    ]
    least = f"  difference, of {apart.certified} pairs of draws"
    if apart.limited.most:
        rows.append((least, f"set by limits in {100 * apart.limited.share:.0f} % of them, so it is no prediction"))
    else:
        shown = written(factor * apart.mean, factor * apart.deviation, unit)
        sure = f", {abs(apart.mean) / apart.deviation:.1f} deviations from 0" if apart.deviation else ""
        rows.append((least, shown + sure))
        label = "  first order" if apart.first_order_holds else "  first order (ranking only)"
        told = in_words(bar) if apart.first_order_holds else ranked_in_words(bar)
        rows.append((label, told.removeprefix(f"{name} ")))
    _print_rows(rows, console)


def _shown(one: Comparison) -> str:
    """Return what the draws say of a quantity, angles in degrees."""
    factor, unit = for_people(cf(one.first_order.unit))
    return one.limited.shown(one.mean, one.deviation, unit, factor)


def _plain(one: Comparison) -> dict[str, Any]:
    holds = one.first_order_holds
    told = one.first_order._asdict() if holds else one.first_order.ranked()
    stable = None if one.stable is None else one.stable.record()
    plain = one._asdict() | {"first_order": told, "first_order_holds": holds}
    lost = None if one.unsolved is None else one.unsolved._asdict()
    return plain | {"limited": one.limited._asdict(), "stable": stable, "unsolved": lost}


def _print(one: Comparison, console: Console) -> None:
    bar = one.first_order
    name = bar.quantity.replace("_", " ")
    factor, unit = for_people(cf(bar.unit))
    if one.first_order_holds and bar.ranking:
        rows = [(f"{name}, first order", in_words(bar).removeprefix(f"{name} "))]
        rows += [
            ("  mean over the ranges", written(factor * (bar.value + bar.shift), factor * bar.deviation, unit))
        ]
    else:
        label = "first order (ranking only)" if bar.ranking else "of the orbit"
        rows = [(f"{name}, {label}", ranked_in_words(bar).removeprefix(f"{name} "))]
    rows.append((f"{name}, {one.certified} of {one.drawn} certified", _shown(one)))
    if one.deviation and not one.limited.most:
        rows += [
            ("  standard error of that deviation", written(factor * one.standard_error, unit=unit, digits=2)),
            ("  variance that first order explains", f"{max(one.explained, 0.0):.1%}"),
        ]
        if (away := abs(one.mean - bar.value) / one.deviation) > 1.0:
            apart = written(factor * (one.mean - bar.value), unit=unit, digits=2)
            why = "the ranges lie to one side of the values, or the answer is curved"
            rows.append(("  mean of the draws less the orbit's own", f"{apart}, {away:.1f} deviations: {why}"))
    if one.stable is not None:
        rows.append(("the verdict `stable`", str(one.stable)))
    _print_rows(rows, console)


def _print_rows(rows: list[tuple[str, str]], console: Console) -> None:
    for label, value in rows:
        console.print(f"{label:47s} {value}", markup=False, highlight=False, soft_wrap=True)
