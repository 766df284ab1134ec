"""The paper's claims about its experiment, tested on what it prints and on synthetic measurements like its own."""

from __future__ import annotations

import math

from wingbeat.animal.species.making import load_species
from wingbeat.experiment import Campaign, fit_wing, reduce_runs, synthetic_runs
from wingbeat_evidence.paper.claim import NO_DATA, Claim, Finding, tested, untestable
from wingbeat_evidence.paper.treatments import ANIMALS, SPEEDS

REYNOLDS_FITTED = (2e4, 5e4)
# Chord, span and thickness of the plate [m].
CHORD, SPAN, THICKNESS = 0.076, 0.456, 0.008
# Width and height of the water channel's test section [m].
CHANNEL = (0.8, 0.6)
_USHERWOOD_REYNOLDS = 108_000.0


def _reynolds_at(speed: float) -> Finding:
    """Return whether both animals' chord Reynolds numbers at a flight speed [m/s] are in the fitted range."""
    animals = [load_species(animal) for animal in ANIMALS]
    found = [speed * animal.vehicle.wing.mean_chord / animal.air.viscosity for animal in animals]
    low, high = REYNOLDS_FITTED
    inside = all(low <= reynolds <= high for reynolds in found)
    return Finding(f"{speed:g} m/s", max(found, key=lambda reynolds: abs(math.log(reynolds / 4e4))), inside)


def experiment_claims() -> list[Claim]:
    """Return the claims about the experiment and the range that it covers."""
    width, height = CHANNEL
    where = "methods, experimental setup"
    fitted = fit_wing(reduce_runs(synthetic_runs(Campaign(rate=10.0), seed=0)))
    return [
        tested(
            "blockage",
            where,
            "The chord is under 10 % of the channel's width, so blockage is minor. Ours: the chord divided by the "
            f"width. Broadside to the flow, the plate blocks {100 * CHORD * SPAN / (width * height):.1f} % of the "
            "cross-section.",
            "< 0.10",
            "1",
            CHORD / width,
            CHORD / width < 0.1,
        ),
        tested(
            "aspect-ratio",
            where,
            "The plate has aspect ratio 6. Ours: its span divided by its chord.",
            6.0,
            "1",
            SPAN / CHORD,
            SPAN / CHORD == 6.0,
        ),
        untestable(
            "repeats",
            where,
            "Three repeats agree and their standard deviations are small, so the forces are steady. Ours: the "
            "number of runs in the whole experiment, repeats included.",
            "reproducible",
            "1",
            4 * 3 * (110 / 2 + 1),
            NO_DATA,
        ),
        untestable(
            "collapse",
            "results, centre of pressure",
            "The results at the four Reynolds numbers collapse onto one curve. Ours: how much the formulas vary "
            "with Reynolds number, which they do not contain.",
            "collapse",
            "1",
            0.0,
            NO_DATA,
        ),
        Claim(
            "animals-reynolds",
            "introduction; title",
            "Birds and bats fly at chord Reynolds numbers near 40 000, where the fit was made. Tested at each "
            f"speed: the Reynolds numbers of the paper's pigeon and bat are both from {REYNOLDS_FITTED[0]:.0f} to "
            f"{REYNOLDS_FITTED[1]:.0f}. Ours: of these two numbers, the one that is farther from 40 000 on a "
            "logarithmic scale.",
            40000.0,
            "1",
            tuple(_reynolds_at(speed) for speed in SPEEDS),
        ),
        untestable(
            "r-squared",
            "abstract; results, after the formulas",
            "A sine alone describes C_D, and a sine and an exponential describe C_L, both with R-squared above "
            "0.995. Ours: we fit the same forms to SYNTHETIC measurements like the paper's and give the smaller "
            "R-squared.",
            "> 0.995",
            "1",
            min(fitted.lift.r_squared, fitted.drag.r_squared),
            NO_DATA,
        ),
        tested(
            "usherwood-reynolds",
            "introduction",
            "Usherwood 2009 measured a dried pigeon wing up to a Reynolds number of 10 800. Tested: the abstract "
            "of Usherwood 2009 (PMC3380271) gives this number. Ours: the number in that abstract.",
            10800.0,
            "1",
            _USHERWOOD_REYNOLDS,
            _USHERWOOD_REYNOLDS == 10800.0,
        ),
    ]
