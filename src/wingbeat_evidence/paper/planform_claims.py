"""The paper's claim that the shape of the wing matters little, tested on wings beside the paper's rectangle."""

from __future__ import annotations

import numpy as np

from wingbeat_evidence.paper.claim import Claim, Evidence, Finding, NotFlownError
from wingbeat_evidence.paper.treatments import ANIMALS, DEFAULT, MODELS, PLANFORMS, Orbits

# "Does not have a significant impact" means that the median change of frequency is at most this. The error of the
# strips is as large: ten strips, the paper's number, leave an error of some per cent
# (docs/evidence/convergence.md).
INSIGNIFICANT = 0.05


def planform_claim(orbits: Orbits) -> Claim:
    """Return the claim that the wing's shape matters little, tested with two other wings.

    The tapered wing has the area of the paper's rectangle. The leaf-shaped wing also has its second moment of area
    about the shoulder.
    """
    findings = tuple(_beside_the_rectangle(orbits, name) for name in PLANFORMS)
    return Claim(
        "wing-shape",
        "methods, simulation",
        "The shape of the wing does not change the optimum much. Tested: another wing of the same span replaces "
        "the rectangle. Over all speeds, animals and models, the median change of frequency is at most "
        f"{100 * INSIGNIFICANT:.0f} %. The other wing is tapered 3 to 1 with the rectangle's area, or leaf-shaped "
        "with the rectangle's area and second moment of area about the shoulder. Ours: this median change.",
        "not significant",
        "1",
        findings,
    )


def _beside_the_rectangle(orbits: Orbits, planform: str) -> Finding:
    rectangle, other = Evidence(orbits, DEFAULT), Evidence(orbits, planform)
    changes = []
    try:
        for animal in ANIMALS:
            for model in MODELS:
                speeds = np.intersect1d(other.speeds(animal, model), rectangle.speeds(animal, model))
                ratio = other.frequencies(animal, model, speeds) / rectangle.frequencies(animal, model, speeds)
                changes += list(np.abs(ratio - 1))
    except NotFlownError:
        changes = []
    used = tuple(sorted(rectangle.used | other.used))
    if not changes:
        return Finding(planform, None, None, used)
    median = float(np.median(changes))
    return Finding(planform, median, median <= INSIGNIFICANT, used)
