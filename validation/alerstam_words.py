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

`python validation/alerstam.py` writes this page and computes every number in its tables. Alerstam et al. 2007
(PLoS Biol 5:e197, doi 10.1371/journal.pbio.0050197, CC BY 4.0) measured the airspeeds of birds by radar. For
{count} of their species, mass, span and area are known. `wb.bird` builds each of these species from the three
numbers; scaling laws give the rest.

Each bird flies with minimum positive hinge power at seven speeds. These are 0.65 to 1.6 times the speed at
which a wing of lift coefficient 1 carries the bird; they do not depend on the measured airspeed. A parabola
through the point of lowest power and its two neighbours gives the minimum-power speed. In the same way, power
over speed gives the maximum-range speed. Each bird also flies at its measured airspeed, with minimum power and
with minimum frequency. One batch solves all {asked} problems. If the power of a bird does not change smoothly
with speed, its orbits are solved again, each starting from its neighbours' results. In the end, {points} of the
problems have a certified orbit.

The air loads are those of the Su-Fan coefficients, without induced flow and without body drag. The orbits are
the best found; better ones may exist. The tables behind this page are [alerstam.csv](../data/alerstam.csv)
(all species) and [alerstam_points.csv](../data/alerstam_points.csv) (all orbits).

![predicted against measured speeds, residuals against Reynolds number, frequencies](alerstam.png)

A: predicted against measured speed. The dashed line marks equality, the band 20 % on either side. B: predicted
speed divided by measured speed. C: frequency at the measured airspeed, divided by the frequency of Pennycuick's
law (1996). Black squares are frequencies that other studies measured on other birds (see the table *Measured
frequencies*). D: speeds divided by the speed at lift coefficient 1. The grey bands in B to D are the Reynolds
numbers 20 000 to 50 000, at which Su et al. measured the plate of the Su-Fan coefficients. The Reynolds number of
a bird is that of its mean chord at its measured airspeed.
"""

SPEEDS_HEAD = """
## Speeds

The columns of the table are:

- *ratio*: the median of predicted over measured speed;
- *scatter*: one standard deviation of that ratio, as a factor;
- *correlation*: the correlation of the logarithms of both speeds;
- *within 20 %*: the share of species whose predicted speed is within 20 % of the measured one;
- *slope in Re*: the slope of the ratio's logarithm against the logarithm of the Reynolds number, with its 95 %
  interval. The interval is too narrow, because species are not independent.

The last three rows are not predictions of the model; they are there for comparison. Alerstam et al. fitted the two
laws to these birds. The last row predicts the same speed for all birds, the median of the measured speeds.

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
            _speed_line(f"{label}, birds at Re {low} to {high}", values[inside], measured[inside], reynolds[inside])
        )
        lines.append(
            _speed_line(f"{label}, birds at other Re", values[~inside], measured[~inside], reynolds[~inside])
        )
    by_mass = np.array([scaling.CRUISE_BY_MASS(row.mass) for row in found])
    lines.append(_speed_line("law 15.9 m^0.13, fitted to these birds", by_mass, measured, reynolds))
    lines.append(
        _speed_line("law 4.3 (m g/S)^0.31, fitted to these birds", 4.3 * loading**0.31, measured, reynolds)
    )
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
        seen = (
            f"exponent of mass: {ours:.2f} in the model, {own:.2f} in Pennycuick's law for these birds, "
            f"{reported} in van den Berg and Rayner"
        )
        falls = f"{label} falls with mass as"
        lines.append(_verdict(f"{falls} Pennycuick's law says", seen, abs(ours - own) < 0.05 + error))
        lines.append(_verdict(f"{falls} van den Berg and Rayner's law says", seen, -0.67 < ours < -0.29))
    return lines


def _power_verdicts(found: list[Row], points: list[Point]) -> list[str]:
    pigeon = next(p for p in points if p.species == "Columba livia" and p.asked == POWER)
    specific = float(np.nanmedian(column(found, "least_power") / column(found, "mass")))
    leaning, count = _at_frequency_bound(points)
    return [
        _verdict(
            "a loaded pigeon needs 25.6 ± 3.8 W at 4.46 m/s (from pressures on its wings)",
            f"the model needs {pigeon.power:.0f} W",
            abs(pigeon.power - 25.6) < 2 * 3.8,
        ),
        _verdict(
            "minimum power per mass is at most the 51 W/kg of a sprinting pigeon (Pennycuick 1968, 20.4 W of 0.4 "
            "kg)",
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


def _at_frequency_bound(points: list[Point]) -> tuple[int, int]:
    """Return how many orbits of minimum power are at the bound of frequency, and how many there are."""
    cheap = [p for p in points if p.asked == POWER]
    return sum("frequency" in p.active_bounds.split() for p in cheap), len(cheap)


def _verdict(claim: str, found: str, good: bool, yes: str = "agrees", no: str = "does not agree") -> str:
    return f"| {claim} | {found} | {yes if good else no} |"


def _frequencies(points: list[Point], timed: list[Bird]) -> str:
    head = (
        "\n## Measured frequencies\n\nFrequencies are in Hz, at the speed of the measurement. For the alcids (the "
        "first four species) this is the ground speed, which differs slightly from the airspeed. The columns "
        "*minimum power* and *minimum frequency* give the frequency of the orbit with that objective. *Amplitude "
        "fixed* gives the frequency of minimum power with the measured flap amplitude. The last three columns are "
        "scaling laws.\n\n| species | speed [m/s] | measured | minimum power | minimum frequency | amplitude fixed "
        "| Pennycuick 1996 | law by mass | law by wing |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n"
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
        "\n## Sensitivity to the derived numbers\n\nEach number is changed alone, to the low or high end of its "
        "plausible range. The ends for span retraction are 0 and 0.5; *body-drag* is the species' alternative of "
        "that name. Each cell gives three changes in percent: of the minimum-power speed / of the maximum-range "
        "speed / of the minimum power. A dash: power, or power over speed, has no minimum within the speeds "
        "flown.\n\n"
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
  wing loading fly far faster than that. The model predicts the airspeed of a species no better than one speed
  for all birds does.
- Predicted and measured speeds differ most at the Reynolds numbers at which the plate was measured. Flight
  outside that range therefore does not explain the differences by itself.
- We tested none of these possible explanations:
  - The model has no induced flow. It underestimates the power of slow flight, so both speeds are too low.
  - A thick plate has high drag at small angles. The model overestimates the power of fast flight, and
    this too makes both speeds too low.
  - Small birds fold their wings between bursts of flapping, which the model cannot do.
  - Migrating birds may not choose their speed for power or range.
- The minimum frequency is proportional to Pennycuick's law over three decades of mass. That is consistent with
  the law but hardly confirms it: the law's exponents come from dimensional reasoning, which our model obeys too.
- The model needs least power at about twice the frequency at which animals fly. In {leaning} of {count} orbits that
  frequency is at its upper bound. With the measured flap amplitude of the alcids (auks), the frequency of
  least power is even higher: {low:.0f} to {high:.0f} Hz. Positive hinge power does not grow with frequency
  as such, but the energy that a muscle needs does.
- The predicted power is several times the measured power. Do not take a power from this model for an animal's.
- The uncertainty of the derived numbers does not explain the differences from measurement. In the table above,
  most derived numbers change either speed by at most about a tenth and power by at most about a quarter. The
  guessed span retraction changes the minimum-power speed most. The table changes one number at a time, for three
  birds.
"""


def conclusions(points: list[Point]) -> str:
    """Return what the tables above say."""
    leaning, count = _at_frequency_bound(points)
    held = [point.frequency for point in points if point.asked == HELD]
    return TAIL.format(leaning=leaning, count=count, low=min(held), high=max(held))
