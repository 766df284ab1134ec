"""The numbers of the study's page, for its template: how the speeds of both models compare with the radar's."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from alerstam_flights import ANIMAL, FREQUENCY, HELD, PAPER, POWER, Bird, Point
from alerstam_spread import Moved
from alerstam_summary import (
    AIR,
    CLEARLY,
    FITTED,
    SAMPLES,
    SPEEDS,
    Row,
    change,
    column,
    compare,
    exponent,
    left_by_fit,
    loading_of,
    of_model,
)
from numpy.typing import NDArray
from page_script import filled

from wingbeat.animal.species import scaling
from wingbeat.models import MODELS
from wingbeat_evidence.markdown import markdown_table

Numbers = NDArray[np.float64]


def page(found: list[Row], points: list[Point], timed: list[Bird], moved: list[Moved]) -> str:
    """Return the page."""
    multiples, certified = {}, []
    for model in MODELS:
        own, its = of_model(found, model), [point for point in points if point.model == model]
        at_one = np.sqrt(2 * loading_of(own) / AIR.density)
        ends = np.nanquantile(column(own, "max_range_speed") / at_one, [0.05, 0.95])
        multiples |= dict(zip((f"low_{model}", f"high_{model}"), ends, strict=True))
        good = [point for point in its if math.isfinite(point.power)]
        certified.append(f"{len(good)} of {len(its)} problems of `{model}`")
    held = [point.frequency for point in points if (point.model, point.asked) == (PAPER, HELD)]
    birds = of_model(found, PAPER)
    return filled(
        "alerstam",
        count=len(birds),
        certified=" and ".join(certified),
        speeds=_speeds(found),
        **{f"{model}_range": " to ".join(f"{limit:.3g}" for limit in FITTED[model]) for model in MODELS},
        samples=SAMPLES,
        clearly=CLEARLY,
        claims=_claims(found, points),
        law=exponent(column(birds, "pennycuick_frequency"), column(birds, "mass"))[0],
        frequencies=_frequencies(points, timed),
        low=min(held),
        high=max(held),
        spread_birds=", ".join(dict.fromkeys(row.species for row in moved)),
        spread=_spread(moved),
        **multiples,
    )


def _speeds(found: list[Row]) -> str:
    """Return the table of speeds: the models', then laws fitted to these birds for comparison."""
    birds = of_model(found, PAPER)
    measured, reynolds, loading = column(birds, "airspeed"), column(birds, "reynolds"), loading_of(birds)
    by_mass = np.array([scaling.CRUISE_BY_MASS(row.mass) for row in birds])
    rows = []
    for model in MODELS:
        low, high = FITTED[model]
        inside = (reynolds >= low) & (reynolds <= high)
        for name, label in SPEEDS:
            values = column(of_model(found, model), name)
            part = compare(values[inside], measured[inside], reynolds[inside])
            gained = change(values, loading, measured)
            left = f"{math.exp(left_by_fit(values, measured)):.3f} "
            left += f"({gained[0]:+.1%}; {gained[1]:+.1%} to {gained[2]:+.1%})"
            inner = f"{part.median_ratio:.2f} ({part.count})"
            rows.append(_speed_cells(f"`{model}`, {label}", inner, left, values, measured, reynolds))
    alone = f"{math.exp(left_by_fit(loading, measured)):.3f}"
    for label, left, values in (
        ("law 15.9 m^0.13", "", by_mass),
        ("law 4.3 (m g/S)^0.31", alone, 4.3 * loading**0.31),
        ("one speed for all", "", np.full(len(birds), np.median(measured))),
    ):
        rows.append(_speed_cells(label, "", left, values, measured, reynolds))
    heads = ["predictor", "ratio", "at Re (birds)", "scatter", "correlation", "within 20 %", "slope in Re"]
    return markdown_table([*heads, "fitted scatter"], rows)


def _speed_cells(label: str, inner: str, left: str, *values: Numbers) -> list[str]:
    c = compare(*values)
    alike = "" if math.isnan(c.correlation) else f"{c.correlation:.2f}"
    slope = f"{c.slope_in_reynolds:+.2f} ± {c.slope_error:.2f}"
    near = f"{c.within_20_percent:.0%}"
    return [label, f"{c.median_ratio:.2f}", inner, f"{c.scatter:.2f}", alike, near, slope, left]


def _claims(found: list[Row], points: list[Point]) -> str:
    """Return the table of what agrees and what does not, a column for each model."""
    columns = []
    for model in MODELS:
        its = [point for point in points if point.model == model]
        columns.append(list(_verdicts(of_model(found, model), its)))
    rows = []
    for alike in zip(*columns, strict=True):
        verdicts = (seen if good is None else f"**{'yes' if good else 'no'}**: {seen}" for _, seen, good in alike)
        rows.append([alike[0][0], *verdicts])
    return markdown_table(["claim", *(f"`{model}`" for model in MODELS)], rows)


def _verdicts(found: list[Row], points: list[Point]) -> Iterator[tuple[str, str, bool | None]]:
    """Yield each claim, what one model makes of it, and whether they agree; None for what is an input."""
    measured, reynolds, loading = column(found, "airspeed"), column(found, "reynolds"), loading_of(found)
    slow, fast = column(found, "min_power_speed"), column(found, "max_range_speed")
    both = np.isfinite(slow) & np.isfinite(fast)
    faster, beyond = (float(np.mean(measured[both] > speed[both])) for speed in (slow, fast))
    (ours, _), (theirs, error) = exponent(fast, loading), exponent(measured, loading)
    yield "birds fly faster than their minimum-power speed", f"{faster:.0%} do", faster > 0.9
    yield "birds fly no faster than their maximum-range speed", f"{beyond:.0%} are faster", beyond < 0.1
    seen = f"exponent {ours:.2f}, measured {theirs:.2f} ± {error:.2f}"
    yield "maximum-range speed rises with wing loading as measured", seen, abs(ours - theirs) < error
    mass, law = column(found, "mass"), column(found, "pennycuick_frequency")
    own, error = exponent(law, mass)
    for name, label in (
        ("least_frequency", "minimum frequency"),
        ("least_power_frequency", "that of minimum power"),
    ):
        if name == "least_power_frequency" and points[0].model == ANIMAL:
            for claim in ("is proportional to the law", "equals the law", "falls with mass as the law"):
                yield f"{label} {claim}", "given by the law", None
            continue
        values = column(found, name)
        c, power = compare(values, law, reynolds), exponent(values, mass)[0]
        seen = f"scatter {c.scatter:.2f}, correlation {c.correlation:.2f}"
        yield f"{label} is proportional to the law", seen, c.scatter < 1.2
        seen = f"ratio {c.median_ratio:.2f}"
        yield f"{label} equals the law", seen, abs(math.log(c.median_ratio)) < math.log(1.2)
        yield f"{label} falls with mass as the law", f"exponent {power:.2f}", abs(power - own) < 0.05 + error
    pigeon = next(p for p in points if p.species == "Columba livia" and p.asked == POWER)
    claim = "a loaded pigeon needs 25.6 ± 3.8 W at 4.46 m/s (pressures on its wings)"
    flown = math.isfinite(pigeon.hinge_power)
    seen = f"{pigeon.hinge_power:.0f} W" if flown else "no flight at its own frequency"
    yield claim, seen, flown and abs(pigeon.hinge_power - 25.6) < 2 * 3.8
    specific = float(np.nanmedian(column(found, "hinge_power") / mass))
    claim = "hinge power at the minimum-power speed: at most 51 W/kg, a sprinting pigeon (Pennycuick 1968)"
    yield claim, f"median {specific:.0f} W/kg", specific < 51
    cheap = [p for p in points if p.asked == POWER]
    leaning = sum("frequency" in p.active_bounds.split() for p in cheap)
    claim = "at minimum power, frequency is below its bound (a guess: four times the law)"
    given = points[0].model == ANIMAL
    yield (
        claim,
        "given" if given else f"{leaning} of {len(cheap)} orbits are at it",
        None if given else leaning == 0,
    )


def _frequencies(points: list[Point], timed: list[Bird]) -> str:
    rows = []
    for bird in timed:
        laws = (
            scaling.BIRD_FREQUENCY(bird.mass, bird.span, bird.area, AIR.density, AIR.gravity),
            scaling.FREQUENCY_BY_MASS(bird.mass),
            scaling.FREQUENCY_BY_WING(scaling.BIRD_SEMI_SPAN(bird.span)),
        )
        own = {
            (p.asked, p.model): f"{p.frequency:.1f}"
            for p in points
            if p.species == bird.name and abs(p.speed - bird.airspeed) < 1e-3 and math.isfinite(p.frequency)
        }
        beats = [", ".join(own.get((asked, model), "-") for model in MODELS) for asked in (POWER, FREQUENCY, HELD)]
        measured = f"{bird.frequency:.1f} ± {bird.frequency_sd:.1f}"
        rows.append([bird.name, f"{bird.airspeed:.1f}", measured, *beats, *(f"{law:.1f}" for law in laws)])
    heads = ["species", "at [m/s]", "measured", "minimum power", "minimum frequency", "amplitude fixed"]
    return markdown_table([*heads, "Pennycuick", "law by mass", "law by wing"], rows)


def _spread(moved: list[Moved]) -> str:
    """Return how far the range of each derived number and guess changes the results at most."""
    base = {row.species: row for row in moved if row.what == "as derived"}
    largest: dict[str, list[float]] = {}
    names = ("min_power_speed", "max_range_speed", "least_power")
    for row in moved:
        if row.what != "as derived":
            name = row.what.removesuffix(" low").removesuffix(" high").replace("_", " ")
            changes = [abs(getattr(row, one) / getattr(base[row.species], one) - 1) for one in names]
            before = largest.setdefault(name, [0.0] * len(names))
            largest[name] = [float(np.fmax(old, new)) for old, new in zip(before, changes, strict=True)]
    rows = [[name, *(f"{100 * value:.0f}" for value in values)] for name, values in largest.items()]
    return markdown_table(["number", "minimum-power speed", "maximum-range speed", "minimum power"], rows)
