"""The table of claims that agree or not, with a column for each model, and the few measured frequencies."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from alerstam_flights import FREQUENCY, HELD, POWER, Bird, Point
from alerstam_summary import AIR, Row, column, compare, exponent, loading_of, of_model

from wingbeat.animal.species import scaling
from wingbeat.models import MODELS


class Verdict(NamedTuple):
    """A claim, what came out, and what that means for the claim."""

    claim: str
    found: str
    verdict: str


def verdicts(found: list[Row], points: list[Point], timed: list[Bird]) -> str:
    """Return the table of what agrees and what does not by each model, and the few measured frequencies."""
    flown = [model for model in MODELS if of_model(found, model)]
    columns = []
    for model in flown:
        own, its = of_model(found, model), [point for point in points if point.model == model]
        columns.append([*_speed_verdicts(own), *_beat_verdicts(own), *_power_verdicts(own, its)])
    heads = " | ".join(f"`{model}`" for model in flown)
    lines = [f"| claim | {heads} |", "| --- " * (len(flown) + 1) + "|"]
    for alike in zip(*columns, strict=True):
        cells = [f"**{one.verdict}**: {one.found}" for one in alike]
        lines.append(f"| {alike[0].claim} | {' | '.join(cells)} |")
    return "\n## Comparison with claims\n\n" + "\n".join(lines) + "\n" + _frequencies(points, timed)


def _speed_verdicts(found: list[Row]) -> list[Verdict]:
    measured, reynolds = column(found, "airspeed"), column(found, "reynolds")
    slow, fast = column(found, "min_power_speed"), column(found, "max_range_speed")
    loading = loading_of(found)
    far, near = compare(fast, measured, reynolds), compare(slow, measured, reynolds)
    alone = compare(loading, measured, reynolds).correlation
    both = np.isfinite(slow) & np.isfinite(fast)
    faster = float(np.mean(measured[both] > slow[both]))
    beyond = float(np.mean(measured[both] > fast[both]))
    (ours, _), (theirs, error) = exponent(fast, loading), exponent(measured, loading)
    return [
        _verdict(
            "the model ranks the species by airspeed",
            f"correlation {far.correlation:.2f} for the maximum-range speed, {alone:.2f} for wing loading alone",
            far.correlation > alone + 0.05,
            "better than wing loading alone",
            "no better than wing loading alone",
        ),
        _verdict(
            "birds fly at their maximum-range speed",
            f"median ratio {far.median_ratio:.2f}, {far.within_20_percent:.0%} within 20 %",
            far.within_20_percent > 0.5,
        ),
        _verdict(
            "birds fly at their minimum-power speed",
            f"median ratio {near.median_ratio:.2f}, {near.within_20_percent:.0%} within 20 %",
            near.within_20_percent > 0.5,
        ),
        _verdict("birds fly faster than their minimum-power speed", f"{faster:.0%} of species", faster > 0.9),
        _verdict("birds fly no faster than their maximum-range speed", f"{beyond:.0%} are faster", beyond < 0.1),
        _verdict(
            "the model's maximum-range speed and the measured speed rise with wing loading by the same exponent "
            "(least squares)",
            f"exponent {ours:.2f} for the maximum-range speed, {theirs:.2f} ± {error:.2f} for the measured speed",
            abs(ours - theirs) < error,
        ),
        _verdict(
            "the ratio of maximum-range to measured speed does not depend on the Reynolds number",
            f"slope {far.slope_in_reynolds:+.2f} ± {far.slope_error:.2f}",
            abs(far.slope_in_reynolds) < far.slope_error,
        ),
    ]


def _beat_verdicts(found: list[Row]) -> list[Verdict]:
    reynolds, mass = column(found, "reynolds"), column(found, "mass")
    law = column(found, "pennycuick_frequency")
    lines = []
    for name, label in (
        ("least_frequency", "minimum frequency"),
        ("least_power_frequency", "frequency of minimum power"),
    ):
        c = compare(column(found, name), law, reynolds)
        seen = f"median ratio {c.median_ratio:.2f}, scatter {c.scatter:.2f}, correlation {c.correlation:.2f}"
        lines.append(_verdict(f"{label} is proportional to Pennycuick's law", seen, c.scatter < 1.2))
        lines.append(
            _verdict(f"{label} equals Pennycuick's law", seen, abs(math.log(c.median_ratio)) < math.log(1.2))
        )
        ours, _ = exponent(column(found, name), mass)
        (own, error), reported = exponent(law, mass), "-0.67 to -0.29"
        seen = (
            f"exponent of mass: {ours:.2f} in the model, {own:.2f} in Pennycuick's law for these birds, "
            f"{reported} in van den Berg and Rayner"
        )
        falls = f"{label} falls with mass as"
        lines.append(_verdict(f"{falls} Pennycuick's law says", seen, abs(ours - own) < 0.05 + error))
        lines.append(_verdict(f"{falls} van den Berg and Rayner's law says", seen, -0.67 < ours < -0.29))
    return lines


def _power_verdicts(found: list[Row], points: list[Point]) -> list[Verdict]:
    pigeon = next(p for p in points if p.species == "Columba livia" and p.asked == POWER)
    specific = float(np.nanmedian(column(found, "hinge_power") / column(found, "mass")))
    leaning, count = at_frequency_bound(points)
    return [
        _verdict(
            "a loaded pigeon needs 25.6 ± 3.8 W at 4.46 m/s (from pressures on its wings)",
            f"{pigeon.hinge_power:.0f} W",
            abs(pigeon.hinge_power - 25.6) < 2 * 3.8,
        ),
        _verdict(
            "hinge power per mass, at the minimum-power speed, is at most the 51 W/kg of a sprinting pigeon "
            "(Pennycuick 1968, 20.4 W of 0.4 kg)",
            f"median {specific:.0f} W/kg",
            specific < 51,
        ),
        _verdict(
            "at minimum power, frequency is below its bound (a guess: four times Pennycuick's law)",
            f"{leaning} of {count} orbits of minimum power are at the bound",
            leaning == 0,
            "agrees",
            "not always",
        ),
    ]


def at_frequency_bound(points: list[Point]) -> tuple[int, int]:
    """Return how many orbits of minimum power are at the bound of frequency, and how many there are."""
    cheap = [p for p in points if p.asked == POWER]
    return sum("frequency" in p.active_bounds.split() for p in cheap), len(cheap)


def _verdict(claim: str, found: str, good: bool, yes: str = "agrees", no: str = "does not agree") -> Verdict:
    return Verdict(claim, found, yes if good else no)


def _frequencies(points: list[Point], timed: list[Bird]) -> str:
    head = (
        "\n## Measured frequencies\n\nFrequencies are in Hz, at the speed of the measurement. For the alcids (the "
        "first four species) this speed is the ground speed, which differs slightly from the airspeed. The columns "
        "*minimum power* and *minimum frequency* give the frequency of the orbit with that objective. *Amplitude "
        "fixed* gives the frequency of minimum power with the measured flap amplitude. The last three columns are "
        "scaling laws.\n\n| species | speed [m/s] | measured | model | minimum power | minimum frequency | "
        "amplitude fixed | Pennycuick 1996 | law by mass | law by wing |\n" + "| --- " * 10 + "|\n"
    )
    lines = []
    for bird in timed:
        wing = scaling.BIRD_SEMI_SPAN(bird.span)
        laws = (
            scaling.BIRD_FREQUENCY(bird.mass, bird.span, bird.area, AIR.density, AIR.gravity),
            scaling.FREQUENCY_BY_MASS(bird.mass),
            scaling.FREQUENCY_BY_WING(wing),
        )
        measured = [bird.name, f"{bird.airspeed:.1f}", f"{bird.frequency:.1f} ± {bird.frequency_sd:.1f}"]
        for model in MODELS:
            own = {
                p.asked: p.frequency
                for p in points
                if (p.model, p.species) == (model, bird.name) and abs(p.speed - bird.airspeed) < 1e-3
            }
            if own:
                beats = [_beat(own.get(key, math.nan)) for key in (POWER, FREQUENCY, HELD)]
                lines.append(" | ".join([*measured, f"`{model}`", *beats, *(f"{law:.1f}" for law in laws)]))
    return head + "".join(f"| {line} |\n" for line in lines)


def _beat(frequency: float) -> str:
    return f"{frequency:.1f}" if math.isfinite(frequency) else ""
