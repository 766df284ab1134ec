"""The paper's claims about its experiment, tested on what it prints and on a synthetic campaign like it."""

from __future__ import annotations

import math

from wingbeat.experiment import Campaign, fit_wing, reduce_runs, synthetic_runs
from wingbeat.paper.claim import NO_DATA, Claim, Finding, tested, untestable
from wingbeat.paper.treatments import ANIMALS, SPEEDS
from wingbeat.species import load_species

REYNOLDS_FITTED = (2e4, 5e4)
# Chord, span and thickness of the plate [m].
CHORD, SPAN, THICKNESS = 0.076, 0.456, 0.008
# Width and height of the water channel's test section [m].
CHANNEL = (0.8, 0.6)
_USHERWOOD_REYNOLDS = 108_000.0


def _reynolds_at(speed: float) -> Finding:
    """Return whether both animals' chord Reynolds numbers at a flight speed [m/s] are those of the fit."""
    animals = [load_species(animal) for animal in ANIMALS]
    found = [speed * animal.vehicle.wing.mean_chord / animal.air.viscosity for animal in animals]
    low, high = REYNOLDS_FITTED
    inside = all(low <= reynolds <= high for reynolds in found)
    return Finding(f"{speed:g} m/s", max(found, key=lambda reynolds: abs(math.log(reynolds / 4e4))), inside)


def experiment_claims() -> list[Claim]:
    """Return the claims about the experiment and what it covers."""
    width, height = CHANNEL
    where = "methods, experimental setup"
    fitted = fit_wing(reduce_runs(synthetic_runs(Campaign(rate=10.0), seed=0)))
    return [
        tested(
            "blockage",
            where,
            "the chord is under 10 % of the channel's width, so blockage is minor (tested: chord over width; "
            f"broadside the plate blocks {100 * CHORD * SPAN / (width * height):.1f} % of the section)",
            "< 0.10",
            "1",
            CHORD / width,
            CHORD / width < 0.1,
        ),
        tested("aspect-ratio", where, "the plate has aspect ratio 6", 6.0, "1", SPAN / CHORD, SPAN / CHORD == 6.0),
        untestable(
            "repeats",
            where,
            "three repeats agree, and standard deviations are small: the forces are steady (ours: runs "
            "that the sweep and its repeats make)",
            "reproducible",
            "1",
            4 * 3 * (110 / 2 + 1),
            NO_DATA,
        ),
        untestable(
            "collapse",
            "results, centre of pressure",
            "the four Reynolds numbers collapse (ours: how much the formulas vary with Reynolds number, which "
            "they do not contain)",
            "collapse",
            "1",
            0.0,
            NO_DATA,
        ),
        Claim(
            "animals-reynolds",
            "introduction; title",
            "birds and bats fly at chord Reynolds numbers near 40 000, where the fit was made (tested: pigeon and "
            f"bat of the paper, at each speed, within {REYNOLDS_FITTED[0]:.0f} to {REYNOLDS_FITTED[1]:.0f}; ours: "
            "the Reynolds number farther from 40 000)",
            40000.0,
            "1",
            tuple(_reynolds_at(speed) for speed in SPEEDS),
        ),
        untestable(
            "r-squared",
            "abstract; results, after the formulas",
            "C_D is described by a sine alone and C_L by a sine and an exponential, both with R-squared above "
            "0.995 (ours: the smaller of the two when those forms are fitted to a SYNTHETIC campaign like theirs)",
            "> 0.995",
            "1",
            min(fitted.lift.r_squared, fitted.drag.r_squared),
            NO_DATA,
        ),
        tested(
            "usherwood-reynolds",
            "introduction",
            "Usherwood 2009 measured a dried pigeon wing up to a Reynolds number of 10 800 (tested: that "
            "paper's own "
            "abstract, PMC3380271)",
            10800.0,
            "1",
            _USHERWOOD_REYNOLDS,
            _USHERWOOD_REYNOLDS == 10800.0,
        ),
    ]
