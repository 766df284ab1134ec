"""The study's page: how the speeds of both models compare with the radar's. Every number is computed."""

from __future__ import annotations

import math

import numpy as np
from alerstam_flights import ANIMAL, HELD, PAPER, Point
from alerstam_loading import SPEEDS
from alerstam_spread import Moved
from alerstam_summary import AIR, FITTED, Row, column, compare, exponent, loading_of, of_model
from alerstam_verdicts import at_frequency_bound
from numpy.typing import NDArray

from wingbeat.animal.species import scaling
from wingbeat.models import MODELS

HEAD = """# {count} birds against radar measurements

`python validation/alerstam.py` writes this page and computes every number in its tables. Alerstam et al. 2007
(PLoS Biol 5:e197, doi 10.1371/journal.pbio.0050197, CC BY 4.0) measured the airspeeds of birds by radar. For
{count} of their species, mass, span and area are known. `wb.bird` builds each of these species from the three
numbers; scaling laws give the rest. Each bird is flown by the [models](../guide/models.md) `paper` and `animal`,
and nothing is fitted.

The model `paper` computes air loads from the Su-Fan coefficients, without induced flow and without body drag. Its
least power is the least positive hinge power, because it has no muscle. The model `animal` has feathered wings. Its
air loads include induced flow, rotation and added mass; scaling laws give body drag, tail and muscle. Its least
power is the least *metabolic* power of the flight muscle, which is this model's own objective. It leaves out the
resting rate, heart, breathing, other muscles and the muscle's recovery. Theories of flight speed ask what a flight
costs the bird, and only metabolic power includes what force and frequency cost the muscle. We chose this objective
before any comparison with the radar. The tables also hold the positive hinge power of the orbits.

Each bird flies with least power at several speeds. These speeds are multiples of the speed at which a wing of lift
coefficient 1 carries the bird, so they do not depend on the measured airspeed. The model `paper` has seven
multiples, from 0.65 to 1.6. The model `animal` has five, from 1.1 to 1.5. If a bird's power, or its power over
speed, is least at an end of the flown speeds, further speeds follow beyond that end. A parabola through the point
of lowest power and its two neighbours gives the minimum-power speed. In the same way, power over speed gives the
maximum-range speed. Each bird also flies at its measured airspeed, with least power and with minimum frequency.

For `paper`, one batch solves all problems. If a bird's power does not change smoothly with speed, its orbits are
solved again, each starting from the results at the neighbouring speeds. For `animal`, the birds are solved in order
of mass. Each bird starts from the orbits of the next lighter bird, and at some speeds also from its own stock
wingbeat. Each orbit then serves as a start at the neighbouring speeds, until no orbit improves.
{certified}

The orbits are the best found; better ones may exist. The tables behind this page are
[alerstam.csv](../../data/alerstam.csv) (all species) and [alerstam_points.csv](../../data/alerstam_points.csv) (all
orbits).

![predicted against measured speeds, residuals against Reynolds number, frequencies](alerstam.png)

Each model has a column of panels. a: predicted against measured speed. The dashed line marks equality, the band
20 % on either side. b: predicted speed divided by measured speed. c: frequency at the measured airspeed, divided by
the frequency of Pennycuick's law (1996). Black squares are frequencies that other studies measured on other birds
(see the table *Measured frequencies*). d: speeds divided by the speed at lift coefficient 1. The grey bands in b to
d are the Reynolds numbers at which the model's coefficients were measured: 20 000 to 50 000 for the plate of the
Su-Fan coefficients, 50 000 to 108 000 for feathered wings. The Reynolds number of a bird is that of its mean chord
at its measured airspeed.
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

The last three rows are for comparison; they are not predictions of a model. Two of them are laws that Alerstam et
al. fitted to these birds. The last row predicts the same speed for all birds: the median of the measured speeds.

| measured airspeed compared with | species | ratio | scatter | correlation | within 20 % | slope in Re |
| --- | --- | --- | --- | --- | --- | --- |
"""


def head(found: list[Row], points: list[Point]) -> str:
    """Return the page's beginning: what was flown, and of how many problems an orbit was certified."""
    certified = []
    for model in _flown(found):
        own = [point for point in points if point.model == model]
        good = sum(math.isfinite(point.power) for point in own)
        certified.append(f"{good} of {len(own)} problems of `{model}` ({good / len(own):.1%})")
    text = f"Certified orbits were found for {' and '.join(certified)}."
    if missing := [model for model in MODELS if not of_model(found, model)]:
        text += f" No bird has been flown with {' or '.join(f'`{model}`' for model in missing)} yet."
    return HEAD.format(count=len(of_model(found, PAPER)), certified=text)


def _flown(found: list[Row]) -> list[str]:
    return [model for model in MODELS if of_model(found, model)]


def speeds(found: list[Row]) -> str:
    """Return the table of speeds: the models', then laws fitted to these birds for comparison."""
    lines = []
    for model in _flown(found):
        own = of_model(found, model)
        measured, reynolds = column(own, "airspeed"), column(own, "reynolds")
        inside = (reynolds >= FITTED[model][0]) & (reynolds <= FITTED[model][1])
        low, high = (f"{limit:.3g}".replace("e+0", "e") for limit in FITTED[model])
        for name, label in SPEEDS:
            values = column(own, name)
            lines.append(_speed_line(f"`{model}`, {label}", values, measured, reynolds))
            for some, where in ((inside, f"Re {low} to {high}"), (~inside, "other Re")):
                part = values[some], measured[some], reynolds[some]
                lines.append(_speed_line(f"`{model}`, {label}, birds at {where}", *part))
    own = of_model(found, PAPER)
    measured, reynolds, loading = column(own, "airspeed"), column(own, "reynolds"), loading_of(own)
    by_mass = np.array([scaling.CRUISE_BY_MASS(row.mass) for row in own])
    lines.append(_speed_line("law 15.9 m^0.13, fitted to these birds", by_mass, measured, reynolds))
    by_loading = 4.3 * loading**0.31
    lines.append(_speed_line("law 4.3 (m g/S)^0.31, fitted to these birds", by_loading, measured, reynolds))
    lines.append(_speed_line("one speed for all", np.full(len(own), np.median(measured)), measured, reynolds))
    return SPEEDS_HEAD + "\n".join(lines) + "\n"


def _speed_line(label: str, *values: NDArray[np.float64]) -> str:
    c = compare(*values)
    alike = "" if math.isnan(c.correlation) else f"{c.correlation:.2f}"
    slope = f"{c.slope_in_reynolds:+.2f} ± {c.slope_error:.2f}"
    cells = c.count, f"{c.median_ratio:.2f}", f"{c.scatter:.2f}", alike, f"{c.within_20_percent:.0%}", slope
    return f"| {label} | {' | '.join(str(cell) for cell in cells)} |"


def spread_table(moved: list[Moved]) -> str:
    """Return how the range of each derived number and guess changes the results."""
    head = (
        "\n## Sensitivity to the derived numbers\n\nThese are results of the model `paper`. Each number is changed "
        "alone, to the low or high end of its plausible range. The ends for span retraction are 0 and 0.5; "
        "in the row *body-drag* the body has drag, by the law for birds ([tails](../guide/tails.md#body-drag)), "
        "and in all other rows it has none. Each cell gives three changes in percent: of the "
        "minimum-power speed / of the maximum-range speed / of the minimum power. A dash means that power, or "
        "power over speed, has no minimum within the speeds flown.\n\n"
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
    flown = _flown(found)
    by_bird = {row.species: [one for one in found if one.species == row.species] for row in found}

    def worst(species: str) -> float:
        ratios = [row.max_range_speed / row.airspeed for row in by_bird[species]]
        return max((abs(math.log(ratio)) for ratio in ratios if math.isfinite(ratio)), default=0.0)

    columns = [f"{label}, `{model}`" for _, label in SPEEDS for model in flown]
    lines = [f"| species | measured | {' | '.join(columns)} | Re |", "| --- " * (len(columns) + 3) + "|"]
    for species in sorted(by_bird, key=lambda species: -worst(species))[:10]:
        own = by_bird[species]
        cells = [f"{getattr(row, name):.1f}" for name, _ in SPEEDS for row in own]
        lines.append(f"| {species} | {own[0].airspeed:.1f} | {' | '.join(cells)} | {own[0].reynolds:.2g} |")
    rest = ""
    for model in flown:
        none = [
            row.species
            for row in of_model(found, model)
            if not all(math.isfinite(getattr(row, name)) for name, _ in SPEEDS)
        ]
        if none:
            rest += f"\nNo minimum within the speeds flown, with `{model}`: {', '.join(none)}.\n"
    return "\n## Largest differences\n\nSpeeds in m/s.\n\n" + "\n".join(lines) + "\n" + rest


def failures(points: list[Point]) -> str:
    """Return the problems without a certified orbit, if any."""
    lost = [point for point in points if not math.isfinite(point.power)]
    if not lost:
        return ""
    lines = [
        f"| {point.species} | `{point.model}` | {point.asked} | {point.speed:.1f} | {point.status} |"
        for point in lost
    ]
    head = "\n## Without a certified orbit\n\n| species | model | problem | speed [m/s] | status |\n" + "| --- " * 5
    return head + "|\n" + "\n".join(lines) + "\n"


TAIL = """
## Conclusions

For the model `paper`:

- Nothing was fitted. The model ranks the species by speed, but no better than wing loading alone does. Both
  predicted speeds are nearly fixed multiples of the speed at lift coefficient 1 (panel d), because the
  coefficients do not depend on the Reynolds number. Measured speeds are not fixed multiples of that speed: birds
  with low wing loading fly far faster than a fixed multiple predicts. The model predicts the airspeed of a species
  no better than one speed for all birds does.
- Predicted and measured speeds differ most at the Reynolds numbers at which the plate was measured. Flight outside
  this range of Reynolds numbers therefore does not explain the differences by itself.
- The air loads offer two possible explanations, and the model `animal` differs from `paper` in both. First, the
  model `paper` has no induced flow. It underestimates the power of slow flight, so both speeds are too low. Second,
  a thick plate has high drag at small angles. The model `paper` overestimates the power of fast flight, and this
  too makes both speeds too low.
- We did not test two other explanations. Small birds fold their wings between bursts of flapping. The models
  cannot fold their wings in this way. Migrating birds may not choose their speed for power or range.
- The minimum frequency is proportional to Pennycuick's law over three decades of mass. This result is consistent
  with the law but hardly confirms it, because the law's exponents come from dimensional reasoning, which our model
  obeys too.
- The model's orbits of least power have about twice the frequency of live animals. In {leaning} of {count} of these
  orbits the frequency is at its upper bound. With the flap amplitude fixed at the measured amplitude of the alcids
  (auks), the frequency of least power is even higher: {low:.0f} to {high:.0f} Hz. Frequency as such does not raise
  the positive hinge power, but it raises the energy that a muscle needs.
- The predicted power is several times the measured power. Do not use a power from this model as the power of an
  animal.
- The uncertainty of the derived numbers does not explain the differences from measurement. In the table above,
  most derived numbers change either speed by at most about a tenth and power by at most about a quarter. The
  guessed span retraction changes the minimum-power speed most. The table changes one number at a time, for three
  birds.
"""

BESIDE = """
For the model `animal` (values of `paper` in brackets):

- The median ratio of predicted to measured speed is {range_animal:.2f} ({range_paper:.2f}) for the maximum-range
  speed and {power_animal:.2f} ({power_paper:.2f}) for the minimum-power speed. The predicted maximum-range speed
  rises with wing loading by the exponent {exponent_animal:.2f} ({exponent_paper:.2f}), the measured speed by the
  exponent {exponent_measured:.2f}. Induced flow and wings of less drag thus
  {explain}.
- Both predicted speeds are again nearly fixed multiples of the speed at lift coefficient 1. For nine tenths of the
  species, the maximum-range speed is {low:.2f} to {high:.2f} ({low_paper:.2f} to {high_paper:.2f}) times as high.
- The positive hinge power at the minimum-power speed is {hinge_animal:.0f} ({hinge_paper:.0f}) W/kg in the median.
- At the measured airspeed, least power needs {beat_animal:.2f} ({beat_paper:.2f}) times the frequency of
  Pennycuick's law, in the median.
"""


def conclusions(found: list[Row], points: list[Point]) -> str:
    """Return what the tables above say."""
    its = [point for point in points if point.model == PAPER]
    leaning, count = at_frequency_bound(its)
    held = [point.frequency for point in its if point.asked == HELD]
    text = TAIL.format(leaning=leaning, count=count, low=min(held), high=max(held))
    return text + _beside(found) if of_model(found, ANIMAL) else text


def _beside(found: list[Row]) -> str:
    numbers: dict[str, float] = {}
    off = {}
    for model in MODELS:
        own = of_model(found, model)
        measured, reynolds, loading = column(own, "airspeed"), column(own, "reynolds"), loading_of(own)
        fast, mass = column(own, "max_range_speed"), column(own, "mass")
        at_one = np.sqrt(2 * loading / AIR.density)
        slopes = exponent(fast, loading)[0], exponent(measured, loading)[0]
        numbers |= {
            f"range_{model}": compare(fast, measured, reynolds).median_ratio,
            f"power_{model}": compare(column(own, "min_power_speed"), measured, reynolds).median_ratio,
            f"exponent_{model}": slopes[0],
            "exponent_measured": slopes[1],
            f"hinge_{model}": float(np.nanmedian(column(own, "hinge_power") / mass)),
            f"beat_{model}": float(
                np.nanmedian(column(own, "least_power_frequency") / column(own, "pennycuick_frequency"))
            ),
        }
        end = "" if model == ANIMAL else f"_{model}"
        numbers[f"low{end}"], numbers[f"high{end}"] = np.nanquantile(fast / at_one, [0.05, 0.95])
        off[model] = abs(math.log(numbers[f"range_{model}"])), abs(slopes[0] - slopes[1])
    level, slope = (off[ANIMAL][i] < off[PAPER][i] - 0.05 for i in (0, 1))
    explain = {
        (True, True): "explain part of the difference in speed and part of the difference in the exponent",
        (True, False): "explain part of the difference in speed, but not the difference in the exponent",
        (False, True): "explain part of the difference in the exponent, but not the difference in speed",
        (False, False): "explain neither the difference in speed nor the difference in the exponent",
    }[level, slope]
    return BESIDE.format(explain=explain, **numbers)
