"""Write docs/evidence/live_statements.md: published statements about live flight, and what the model does.

    python validation/live_statements.py

The statements were chosen from abstracts before any flight was made; the rules of the verdicts were written after.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from page_script import ROOT, filled

import wingbeat as wb
from wingbeat._base import write_atomically
from wingbeat_evidence.markdown import markdown_table


class Statement(NamedTuple):
    """Say what a source says, and what flights by the model say: numbers in words, and whether they bear it out."""

    said: str
    source: str
    flown: Callable[[], tuple[str, bool]]


def flights(
    species: wb.Species, speeds: Sequence[float], frequency: float | None = None, climb: float = 0.0
) -> list[wb.Orbit]:
    """Return the certified flights of an animal by the model `animal`."""
    model = wb.models.animal(species, frequency)
    orbits = wb.solve_orbits([model.problem(species, speed, climb) for speed in speeds], in_order=True)
    for orbit in orbits:
        if orbit.status is not wb.Status.CONVERGED:
            raise SystemExit(f"no certified flight for a statement: {orbit.message}")
    return list(orbits)


def numbers(orbits: Sequence[wb.Orbit], name: str) -> np.ndarray:
    """Return a quantity of flights, shape (K,)."""
    return np.array([orbit.record()[name] for orbit in orbits], dtype=float)


def amplitudes(orbits: Sequence[wb.Orbit]) -> np.ndarray:
    """Return flap amplitudes [deg], shape (K,)."""
    return np.degrees([orbit.wingbeat.flap_amplitude for orbit in orbits])


def loaded(name: str, shares: Sequence[float], speed: float, exponent: float = 0.0) -> list[wb.Orbit]:
    """Return flights of a bird with loads that are shares of its mass; its frequency rises with a power of mass."""
    found, own = [], wb.load_species(name)
    for share in shares:
        species = wb.models.animal(own).species(own)
        if share:
            species = species.with_payload(share * own.vehicle.mass)
        beat = wb.models.animal(own).problem(own, speed).species.wingbeat.frequency
        found += flights(species, (speed,), beat * (1 + share) ** exponent)
    return found


def swallow() -> tuple[str, bool]:
    """Say how the cost of a swallow grows with its mass, at a fixed frequency and at one that grows too."""
    shares, found = (0.0, 0.1, 0.2), []
    for exponent in (0.0, 0.38):
        rate = numbers(loaded("barn-swallow", shares, 9.0, exponent), "metabolic_rate")
        found.append(float(np.polyfit(np.log1p(shares), np.log(rate), 1)[0]))
    return (
        f"9 m/s, to 20 % load: m^{found[0]:.2f}; with that rise of frequency m^{found[1]:.2f}",
        0.5 * 0.58 <= found[1] <= 2 * 0.58,
    )


def cockatiel_force() -> tuple[str, bool]:
    """Say how a cockatiel's power and amplitude vary with speed at one frequency."""
    found = flights(wb.load_species("cockatiel"), (3.0, 5.0, 7.0, 9.0, 11.0, 13.0))
    power, amplitude = numbers(found, "mean_positive_power"), amplitudes(found)
    folds = [float(one.max() / one.min()) for one in (power, amplitude)]
    return (
        f"3 to 13 m/s: power {folds[0]:.1f}-fold, amplitude and strain {folds[1]:.1f}-fold",
        folds[0] < 4 and folds[1] < 1.25 * 1.4,
    )


def cockatiel_load() -> tuple[str, bool]:
    """Say what a load costs a cockatiel."""
    found = loaded("cockatiel", (0.0, 0.15), 9.0)
    rate, amplitude = numbers(found, "metabolic_rate"), amplitudes(found)
    rise, wider = 100 * (rate[1] / rate[0] - 1), 100 * (amplitude[1] / amplitude[0] - 1)
    return (
        f"9 m/s, 15 % load: cost {rise:+.0f} %, amplitude {wider:+.0f} %, of {rate[0]:.1f} W",
        rise < 11 and wider < 10 and 0.5 < rate[0] / 16.7 < 2,
    )


def swift() -> tuple[str, bool]:
    """Say how the angular velocity of a swift's wing varies with speed at one frequency."""
    found = flights(wb.load_species("common-swift"), (8.0, 8.4, 9.2))
    velocity = amplitudes(found) * [orbit.wingbeat.frequency for orbit in found]
    rise = 100 * (velocity[-1] / velocity[0] - 1)
    retraction = [orbit.wingbeat.span_retraction for orbit in found]
    return (
        f"angular velocity {rise:+.0f} %; span retracted by {max(retraction):.1f}, at its limit",
        abs(rise) < 5 and max(retraction) < 0.3,
    )


def climb() -> tuple[str, bool]:
    """Say what a pigeon's climb costs beyond its gain of potential energy."""
    pigeon, speed, power, gained = wb.load_species("pigeon"), 4.5, {}, {}
    for angle in (-30, 0, 30):
        up = speed * math.sin(math.radians(angle))
        (flown,) = flights(pigeon, (speed * math.cos(math.radians(angle)),), climb=up)
        power[angle] = float(numbers([flown], "mean_positive_power")[0])
        gained[angle] = pigeon.vehicle.mass * pigeon.air.gravity * up
    shares = {angle: (power[angle] - power[0]) / gained[angle] for angle in (30, -30)}
    return (
        f"4.5 m/s, 30 deg: climb adds {shares[30]:.2f} of the potential power, descent saves {shares[-30]:.2f}",
        all(0.8 <= share <= 1.2 for share in shares.values()),
    )


def starling() -> tuple[str, bool]:
    """Say how a starling's metabolic rate varies with speed."""
    rate = numbers(flights(wb.load_species("common-starling"), (6.3, 8.0, 10.0, 12.0, 14.4)), "metabolic_rate")
    return (
        f"{rate[0]:.1f} W, at least {rate.min():.1f} W, then {rate[-1]:.1f} W",
        bool(rate[-1] > rate[0] > rate.min() and 0.5 < rate[0] / 10.4 < 2 and 0.5 < rate[-1] / 14.9 < 2),
    )


def pigeon() -> tuple[str, bool]:
    """Say at which speeds a pigeon needs no more power than it can keep up."""
    speeds = [6.0, 8.0, 10.0, 12.0, 14.0, 16.0]
    power = numbers(flights(wb.load_species("pigeon"), speeds), "mean_positive_power")
    power = power / wb.load_species("pigeon").vehicle.mass
    kept = [speed for speed, one in zip(speeds, power, strict=True) if one <= 26.3]
    said = " to ".join(dict.fromkeys(f"{one:g}" for one in (kept[0], kept[-1])))
    return f"{said} m/s; {power[0]:.0f} W/kg at 6 m/s", kept == speeds


STATEMENTS = (
    Statement(
        "A pigeon's greatest steady power, 26.3 W/kg, is enough for 3 to 16 m/s.",
        "Pennycuick 1968, J Exp Biol 49:527",
        pigeon,
    ),
    Statement(
        "A pigeon that climbs or descends by up to 60 or 30 deg needs the power of level flight and the change of "
        "potential energy.",
        "Berg and Biewener 2008, J Exp Biol 211:1120",
        climb,
    ),
    Statement(
        "From 1 to 13 m/s a cockatiel's muscle power varies 2-fold, its strain 1.4-fold: force does most of it.",
        "Hedrick, Tobalske and Biewener 2003, J Exp Biol 206:1363",
        cockatiel_force,
    ),
    Statement(
        "Loads of 5 to 15 % raise neither a cockatiel's cost, 16.7 W, nor its amplitude.",
        "Hambly, Harper and Speakman 2004, J Exp Biol 207:3969",
        cockatiel_load,
    ),
    Statement(
        "A swallow's cost grows with its mass as m^0.58, its frequency as m^0.38.",
        "Schmidt-Wellenburg, Biebach, Daan and Visser 2007, J Comp Physiol B 177:327",
        swallow,
    ),
    Statement(
        "From 8.0 to 9.2 m/s the angular velocity of a swift's wing stays the same; it is retracted little.",
        "Henningsson, Spedding and Hedenstrom 2008, J Exp Biol 211:717",
        swift,
    ),
    Statement(
        "A starling's metabolic rate rises from 10.4 W at 6.3 m/s to 14.9 W at 14.4 m/s, on a U-shaped curve.",
        "Ward et al. 2001, J Exp Biol 204:3311",
        starling,
    ),
)


if __name__ == "__main__":
    rows, verdicts = [], []
    for one in STATEMENTS:
        words, borne = one.flown()
        verdicts.append(borne)
        rows.append([one.said, one.source, words, "borne out" if borne else "**contradicted**"])
        print(" | ".join(rows[-1]), flush=True)
    text = filled(
        "live_statements",
        table=markdown_table(["statement", "source", "the model", "verdict"], rows),
        borne=sum(verdicts),
        known=len(verdicts),
    )
    write_atomically(ROOT / "docs" / "evidence" / "live_statements.md", text)
