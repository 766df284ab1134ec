"""The study's page: what agrees with the radar and what does not; every number in it is computed."""

from __future__ import annotations

import math

import numpy as np
from alerstam_flights import FREQUENCY, HELD, POWER, Bird, Point
from alerstam_spread import Moved
from alerstam_summary import AIR, FITTED, Row, column, compare, exponent
from numpy.typing import NDArray

from wingbeat.species import scaling

HEAD = """# Birds from mass, span and area alone, against the radar

Written by `python validation/alerstam.py`; no number in the tables is typed in. `wb.bird` builds each of
the {count} species of Alerstam et al. 2007 (PLoS Biol 5:e197, doi 10.1371/journal.pbio.0050197, CC BY 4.0)
that have mass, span and area; the rest is by scaling laws. One batch of {asked} problems,
of which {points} ended in a certified orbit,
finds the wingbeat of least positive hinge power at seven speeds, 0.65 to 1.6 times that at which a wing of lift
coefficient 1 carries the bird: the measured airspeed plays no part. Curves that were not smooth were searched
again, speed by speed from their neighbours' answers. A parabola through the lowest point and its neighbours gives
the minimum-power speed and, of power over speed, the maximum-range speed. At its measured airspeed each bird is
flown for least power and for least frequency. Air loads: Su-Fan, no induced flow, no body drag; the best orbits
met, not proven least. All species: [alerstam.csv](../data/alerstam.csv); all orbits:
[alerstam_points.csv](../data/alerstam_points.csv).

![predicted against measured speeds, residuals against Reynolds number, frequencies](alerstam.png)

A: dashed is equal, the band 20 % either side. B: predicted over measured speed. C: frequency at the measured
airspeed over Pennycuick's law of 1996; black squares are measured frequencies of other birds. D: speeds over that
at lift coefficient 1. Grey in B to D: where the paper's plate was fitted, by mean chord and measured airspeed.
"""

SPEEDS_HEAD = """
## Speeds

Ratio: median of predicted over measured. Scatter: one standard deviation of that ratio, as a factor. Correlation:
of logarithms. Slope: of the ratio's logarithm in that of the Reynolds number, with its 95 % interval, which is too
narrow, for species are not independent. The two laws were fitted to these birds by Alerstam et al., and the last
line is their median: yardsticks, not predictions.

| airspeed measured, against | species | ratio | scatter | correlation | within 20 % | slope in Re |
| --- | --- | --- | --- | --- | --- | --- |
"""


def speeds(found: list[Row]) -> str:
    """Return the table of speeds: the model's, then laws fitted to these very birds as a yardstick."""
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
    head = "\n## What agrees and what does not\n\n| claim | found | verdict |\n| --- | --- | --- |\n"
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
        _verdict("and not faster than their maximum-range speed", f"{beyond:.0%} are faster", beyond < 0.1),
        _verdict(
            "exponent of speed over wing loading, by least squares",
            f"maximum range {ours:.2f}, measured {theirs:.2f} ± {error:.2f}",
            abs(ours - theirs) < error,
        ),
        _verdict(
            "the residual does not hang on the Reynolds number",
            f"slope {far.slope_in_reynolds:+.2f} ± {far.slope_error:.2f}",
            abs(far.slope_in_reynolds) < far.slope_error,
        ),
    ]


def _beat_verdicts(found: list[Row]) -> list[str]:
    reynolds, mass = column(found, "reynolds"), column(found, "mass")
    law = column(found, "pennycuick_frequency")
    lines = []
    for name, label in (
        ("least_frequency", "least frequency"),
        ("least_power_frequency", "frequency of least power"),
    ):
        c = compare(column(found, name), law, reynolds)
        seen = f"median ratio {c.median_ratio:.2f}, scatter {c.scatter:.2f}, correlation {c.correlation:.2f}"
        lines.append(_verdict(f"{label} is Pennycuick's but for a factor", seen, c.scatter < 1.2))
        lines.append(_verdict("and that factor is one", seen, abs(math.log(c.median_ratio)) < math.log(1.2)))
        ours, _ = exponent(column(found, name), mass)
        (own, error), reported = exponent(law, mass), "-0.67 to -0.29"
        seen = f"{ours:.2f}; Pennycuick's law of these birds {own:.2f}, van den Berg and Rayner {reported}"
        lines.append(_verdict(f"{label} falls with mass as Pennycuick's", seen, abs(ours - own) < 0.05 + error))
        lines.append(_verdict("and as van den Berg and Rayner's", seen, -0.67 < ours < -0.29))
    return lines


def _power_verdicts(found: list[Row], points: list[Point]) -> list[str]:
    pigeon = next(p for p in points if p.species == "Columba livia" and p.asked == POWER)
    specific = float(np.nanmedian(column(found, "least_power") / column(found, "mass")))
    cheap = [p for p in points if p.asked == POWER]
    leaning = sum("frequency" in p.active_bounds.split() for p in cheap)
    return [
        _verdict(
            "power of the loaded pigeon at 4.46 m/s: 25.6 ± 3.8 W by the pressures on its wings",
            f"{pigeon.power:.0f} W",
            abs(pigeon.power - 25.6) < 2 * 3.8,
        ),
        _verdict(
            "least power per mass; a pigeon sprints at 51 W/kg (Pennycuick 1968, 20.4 W of 0.4 kg)",
            f"median {specific:.0f} W/kg",
            specific < 51,
        ),
        _verdict(
            "least power has a frequency of its own, within four times Pennycuick's",
            f"{leaning} of {len(cheap)} orbits of least power lean on that guessed bound",
            leaning == 0,
            "agrees",
            "not always",
        ),
    ]


def _verdict(claim: str, found: str, good: bool, yes: str = "agrees", no: str = "does not agree") -> str:
    return f"| {claim} | {found} | {yes if good else no} |"


def _frequencies(points: list[Point], timed: list[Bird]) -> str:
    head = (
        "\n## The few measured frequencies\n\nAll in Hz, at the speed of the measurement (ground speed for the "
        "alcids, which is not quite airspeed). Held: least power with the measured amplitude.\n\n"
        "| species | speed [m/s] | measured | least power | least frequency | amplitude held | Pennycuick 1996 "
        "| by mass | by wing |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n"
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
    """Return what the spread of each derived number and guess does to the answers."""
    head = (
        "\n## How much hangs on what was derived\n\nEach number alone at either end of its spread (span "
        "retraction: 0 and 0.5; body drag: the alternative of that name). Change in percent of minimum-power speed "
        "/ maximum-range speed / least power.\n\n"
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


def misses(found: list[Row]) -> str:
    """Return the ten species farthest off, and those without a minimum within the speeds flown."""
    good = [row for row in found if math.isfinite(row.max_range_speed)]
    far = sorted(good, key=lambda row: -abs(math.log(row.max_range_speed / row.airspeed)))[:10]
    lines = [
        f"| {row.species} | {row.airspeed:.1f} | {row.min_power_speed:.1f} | {row.max_range_speed:.1f} "
        f"| {row.reynolds:.2g} |"
        for row in far
    ]
    head = (
        "\n## The farthest off\n\n| species | measured [m/s] | minimum power [m/s] | maximum range [m/s] | Re |\n"
        "| --- | --- | --- | --- | --- |\n"
    )
    none = [row.species for row in found if not (math.isfinite(row.min_power_speed) and row in good)]
    rest = f"\nNo lowest point within the speeds flown: {', '.join(none)}.\n" if none else ""
    return head + "\n".join(lines) + "\n" + rest


TAIL = """
## What to make of it

- Nothing was fitted, and the model puts the species in order, but no better than their wing loading does: both
  speeds are nearly fixed multiples of that at lift coefficient 1 (panel D), as coefficients that do not know the
  Reynolds number must make them. Measured speeds are no such multiple: birds with lightly loaded wings fly far
  above. To foretell the airspeed of a species the model serves no better than one speed for all.
- The misses are largest where the plate was fitted, so flying beyond the fit does not by itself explain them.
- What may explain them, none of it tested here: no induced flow (slow flight looks too cheap, so both speeds come
  out too low); a thick plate's drag at small angles (fast flight looks too dear, with the same effect); small birds
  that bound with folded wings, which the model cannot; and birds on passage that choose their speed for other ends
  than power or range.
- The least frequency follows Pennycuick's law over three decades of mass but for a constant factor. That is
  consistent with the law, and little more: its exponents come from dimensional reasoning that the model obeys too.
- Least power asks for some twice the frequency of animals, often for as much as its bound lets it have, and more
  with the measured amplitude of the alcids. Positive hinge power puts no price on frequency as such; muscles do.
- Power is several times what was measured. A power from this model is not an animal's.
- The spread of the derived numbers does not close the gap: the table above moves either speed by a tenth or so, and
  power by a quarter. The guessed span retraction moves the minimum-power speed most. It is one number at a time,
  for three birds.
"""
