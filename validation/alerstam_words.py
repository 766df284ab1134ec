"""The study's page: what agrees with the radar and what does not. Every number is computed."""

from __future__ import annotations

import math

import numpy as np
from alerstam_flights import FREQUENCY, HELD, POWER, Bird, Point
from alerstam_spread import Moved
from alerstam_summary import AIR, FITTED, Row, column, compare, exponent
from numpy.typing import NDArray

from wingbeat.species import scaling

HEAD = """# {count} birds against radar measurements

`python validation/alerstam.py` writes this page and computes every number in its tables. `wb.bird` builds each
of the {count} species of Alerstam et al. 2007 (PLoS Biol 5:e197, doi 10.1371/journal.pbio.0050197, CC BY 4.0)
that have mass, span and area; scaling laws give the rest. One batch of {asked} problems, of which {points}
ended in a certified orbit, minimises positive hinge power at seven speeds. The speeds are 0.65 to 1.6 times
that at which a wing of lift coefficient 1 carries the bird, and do not depend on the measured airspeed. Curves
that were not smooth were solved again, speed by speed from their neighbours' results. A parabola through the
lowest point and its neighbours gives the minimum-power speed, and the same for power over speed gives the
maximum-range speed. At its measured airspeed each bird is also flown with minimum power and with minimum
frequency. Air loads: Su-Fan, no induced flow, no body drag. The orbits are the best found; better ones may
exist. All species: [alerstam.csv](../data/alerstam.csv); all orbits:
[alerstam_points.csv](../data/alerstam_points.csv).

![predicted against measured speeds, residuals against Reynolds number, frequencies](alerstam.png)

A: the dashed line marks equality, the band 20 % on either side. B: predicted over measured speed. C: frequency
at the measured airspeed over Pennycuick's law of 1996; black squares are measured frequencies of other birds.
D: speeds divided by the speed at lift coefficient 1. Grey in B to D: the Reynolds numbers of the paper's plate,
by mean chord and measured airspeed.
"""

SPEEDS_HEAD = """
## Speeds

Ratio: median of predicted over measured speed. Scatter: one standard deviation of that ratio, as a factor.
Correlation: correlation of the logarithms. Slope: change of the ratio's logarithm with that of the Reynolds
number, with its 95 % interval. The interval is too narrow, because species are not independent. Alerstam et al.
fitted the two laws to these birds, and the last line is their median speed. These three are for comparison;
they are not predictions.

| measured airspeed compared with | species | ratio | scatter | correlation | within 20 % | slope in Re |
| --- | --- | --- | --- | --- | --- | --- |
"""


def speeds(found: list[Row]) -> str:
    """Return the table of speeds: the model's, then laws fitted to these birds for comparison."""
    measured, reynolds = column(found, "airspeed"), column(found, "reynolds")
    inside = (reynolds >= FITTED[0]) & (reynolds <= FITTED[1])
    loading = column(found, "mass") * AIR.gravity / column(found, "wing_area")
    low, high = (f"{limit:.0e}".replace("e+0", "e") for limit in FITTED)
    lines = []
    for name, label in (("min_power_speed", "minimum-power speed"), ("max_range_speed", "maximum-range speed")):
        values = column(found, name)
        lines.append(_speed_line(f"model, {label}", values, measured, reynolds))
        lines.append(
            _speed_line(f"the same, Re {low} to {high}", values[inside], measured[inside], reynolds[inside])
        )
        lines.append(_speed_line("the same, outside", values[~inside], measured[~inside], reynolds[~inside]))
    by_mass = np.array([scaling.CRUISE_BY_MASS(row.mass) for row in found])
    lines.append(_speed_line("law 15.9 m^0.13, fitted to these birds", by_mass, measured, reynolds))
    lines.append(_speed_line("law 4.3 (m g/S)^0.31, the same", 4.3 * loading**0.31, measured, reynolds))
    lines.append(_speed_line("one speed for all", np.full(len(found), np.median(measured)), measured, reynolds))
    return SPEEDS_HEAD + "\n".join(lines) + "\n"


def _speed_line(label: str, *values: NDArray[np.float64]) -> str:
    c = compare(*values)
    alike = "" if math.isnan(c.correlation) else f"{c.correlation:.2f}"
    slope = f"{c.slope_in_reynolds:+.2f} ± {c.slope_error:.2f}"
    cells = c.count, f"{c.median_ratio:.2f}", f"{c.scatter:.2f}", alike, f"{c.within_20_percent:.0%}", slope
    return f"| {label} | {' | '.join(str(cell) for cell in cells)} |"


def verdicts(found: list[Row], points: list[Point], timed: list[Bird]) -> str:
    """Return the table of what agrees and what does not, and the few measured frequencies."""
    head = "\n## Comparison with claims\n\n| claim | result | verdict |\n| --- | --- | --- |\n"
    lines = [*_speed_verdicts(found), *_beat_verdicts(found), *_power_verdicts(found, points)]
    return head + "\n".join(lines) + "\n" + _frequencies(points, timed)


def _speed_verdicts(found: list[Row]) -> list[str]:
    measured, reynolds = column(found, "airspeed"), column(found, "reynolds")
    slow, fast = column(found, "min_power_speed"), column(found, "max_range_speed")
    loading = column(found, "mass") * AIR.gravity / column(found, "wing_area")
    far, near = compare(fast, measured, reynolds), compare(slow, measured, reynolds)
    alone = compare(loading, measured, reynolds).correlation
    both = np.isfinite(slow) & np.isfinite(fast)
    faster = float(np.mean(measured[both] > slow[both]))
    beyond = float(np.mean(measured[both] > fast[both]))
    (ours, _), (theirs, error) = exponent(fast, loading), exponent(measured, loading)
    return [
        _verdict(
            "the model orders the species by airspeed",
            f"correlation {far.correlation:.2f} (maximum range); wing loading alone {alone:.2f}",
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
            "speed grows with wing loading to the same power (least squares)",
            f"maximum range {ours:.2f}, measured {theirs:.2f} ± {error:.2f}",
            abs(ours - theirs) < error,
        ),
        _verdict(
            "the ratio does not depend on the Reynolds number",
            f"slope {far.slope_in_reynolds:+.2f} ± {far.slope_error:.2f}",
            abs(far.slope_in_reynolds) < far.slope_error,
        ),
    ]


def _beat_verdicts(found: list[Row]) -> list[str]:
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
        seen = f"{ours:.2f}; Pennycuick's law of these birds {own:.2f}, van den Berg and Rayner {reported}"
        lines.append(_verdict(f"{label} falls with mass as Pennycuick's law", seen, abs(ours - own) < 0.05 + error))
        lines.append(
            _verdict(f"{label} falls with mass as van den Berg and Rayner's law", seen, -0.67 < ours < -0.29)
        )
    return lines


def _power_verdicts(found: list[Row], points: list[Point]) -> list[str]:
    pigeon = next(p for p in points if p.species == "Columba livia" and p.asked == POWER)
    specific = float(np.nanmedian(column(found, "least_power") / column(found, "mass")))
    cheap = [p for p in points if p.asked == POWER]
    leaning = sum("frequency" in p.active_bounds.split() for p in cheap)
    return [
        _verdict(
            "power of the loaded pigeon at 4.46 m/s: 25.6 ± 3.8 W from the pressures on its wings",
            f"{pigeon.power:.0f} W",
            abs(pigeon.power - 25.6) < 2 * 3.8,
        ),
        _verdict(
            "minimum power per mass is at most the 51 W/kg of a sprinting pigeon (Pennycuick 1968, 20.4 W of 0.4 "
            "kg)",
            f"median {specific:.0f} W/kg",
            specific < 51,
        ),
        _verdict(
            "minimum power occurs below the upper bound of frequency, four times Pennycuick's",
            f"{leaning} of {len(cheap)} orbits of minimum power are at that guessed bound",
            leaning == 0,
            "agrees",
            "not always",
        ),
    ]


def _verdict(claim: str, found: str, good: bool, yes: str = "agrees", no: str = "does not agree") -> str:
    return f"| {claim} | {found} | {yes if good else no} |"


def _frequencies(points: list[Point], timed: list[Bird]) -> str:
    head = (
        "\n## Measured frequencies\n\nFrequencies are in Hz, at the speed of the measurement (for the alcids "
        "ground speed, which differs slightly from airspeed). *Amplitude fixed*: minimum power with the measured "
        "amplitude.\n\n| species | speed [m/s] | measured | minimum power | minimum frequency | amplitude fixed | "
        "Pennycuick 1996 | law by mass | law by wing |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n"
    )
    lines = []
    for bird in timed:
        own = {
            p.asked: p.frequency for p in points if p.species == bird.name and abs(p.speed - bird.airspeed) < 1e-3
        }
        wing = scaling.BIRD_SEMI_SPAN(bird.span)
        laws = (
            scaling.BIRD_FREQUENCY(bird.mass, bird.span, bird.area, AIR.density, AIR.gravity),
            scaling.FREQUENCY_BY_MASS(bird.mass),
            scaling.FREQUENCY_BY_WING(wing),
        )
        cells = [bird.name, f"{bird.airspeed:.1f}", f"{bird.frequency:.1f} ± {bird.frequency_sd:.1f}"]
        cells += [f"{own[key]:.1f}" if key in own else "" for key in (POWER, FREQUENCY, HELD)]
        lines.append("| " + " | ".join(cells + [f"{law:.1f}" for law in laws]) + " |")
    return head + "\n".join(lines) + "\n"


def spread_table(moved: list[Moved]) -> str:
    """Return how the range of each derived number and guess changes the results."""
    head = (
        "\n## Sensitivity to the derived numbers\n\nEach number is changed alone, to either end of its plausible "
        "range (span retraction: 0 and 0.5; body drag: the alternative of that name). Change in percent of "
        "minimum-power speed / maximum-range speed / minimum power.\n\n"
    )
    birds = list(dict.fromkeys(row.species for row in moved))
    lines = ["| number | " + " | ".join(birds) + " |", "| --- " * (len(birds) + 1) + "|"]
    base = {row.species: row for row in moved if row.what == "as derived"}
    for what in dict.fromkeys(row.what for row in moved if row.what != "as derived"):
        cells = []
        for name in birds:
            row, own = next(r for r in moved if (r.species, r.what) == (name, what)), base[name]
            changes = (
                row.min_power_speed / own.min_power_speed,
                row.max_range_speed / own.max_range_speed,
                row.least_power / own.least_power,
            )
            cells.append(" / ".join("-" if math.isnan(c) else f"{100 * (c - 1):+.0f}" for c in changes))
        lines.append(f"| {what.replace('_', ' ')} | {' | '.join(cells)} |")
    return head + "\n".join(lines) + "\n"


def largest_differences(found: list[Row]) -> str:
    """Return the ten species with the largest differences, and those without a minimum within the speeds flown."""
    good = [row for row in found if math.isfinite(row.max_range_speed)]
    far = sorted(good, key=lambda row: -abs(math.log(row.max_range_speed / row.airspeed)))[:10]
    lines = [
        f"| {row.species} | {row.airspeed:.1f} | {row.min_power_speed:.1f} | {row.max_range_speed:.1f} "
        f"| {row.reynolds:.2g} |"
        for row in far
    ]
    head = (
        "\n## Largest differences\n\n| species | measured [m/s] | minimum power [m/s] | maximum range [m/s] | Re "
        "|\n| --- | --- | --- | --- | --- |\n"
    )
    none = [row.species for row in found if not (math.isfinite(row.min_power_speed) and row in good)]
    rest = f"\nNo minimum within the speeds flown: {', '.join(none)}.\n" if none else ""
    return head + "\n".join(lines) + "\n" + rest


TAIL = """
## Conclusions

- Nothing was fitted. The model puts the species in the right order, but no better than wing loading alone does.
  Both predicted speeds are nearly fixed multiples of the speed at lift coefficient 1 (panel D), because the
  coefficients do not depend on the Reynolds number. Measured speeds are not such a multiple: birds with low
  wing loading fly far faster. The model predicts the airspeed of a species no better than one speed for all
  birds does.
- The differences are largest at the Reynolds numbers of the plate, so flying outside that range does not by
  itself explain them.
- Possible explanations, none of them tested here: the model has no induced flow (it underestimates the power of
  slow flight, so both speeds are too low); a thick plate has high drag at small angles (the model overestimates
  the power of fast flight, with the same effect); small birds fly in bounds with folded wings, which the model
  cannot do; migrating birds may not choose their speed for power or range.
- The minimum frequency is proportional to Pennycuick's law over three decades of mass. That is consistent with
  the law but little more: its exponents come from dimensional reasoning that the model obeys too.
- Minimum power occurs at about twice the frequency of animals, often at its upper bound, and at still higher
  frequencies with the measured amplitude of the alcids. Positive hinge power assigns no cost to frequency as
  such; muscles do.
- Power is several times the measured one. Do not take a power from this model for an animal's.
- The uncertainty of the derived numbers does not explain the difference. In the table above they change either
  speed by about a tenth and power by about a quarter. The guessed span retraction changes the minimum-power
  speed most. The table changes one number at a time, for three birds.
"""
