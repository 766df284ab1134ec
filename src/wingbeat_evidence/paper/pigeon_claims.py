"""The paper's claims about the pigeon's frequency, each judged by every reference that we have."""

from __future__ import annotations

import functools
from collections.abc import Callable

import numpy as np

from wingbeat.animal.species.making import load_species
from wingbeat.plots.published import PIGEON_REFERENCES
from wingbeat_evidence.paper.claim import Claim, Evidence, FlightClaim, TestResult, untestable
from wingbeat_evidence.paper.treatments import SAMPLE_SPEED

_RESULTS = "results, simulations"
_WORDS = {
    "usherwood": "from loaded pigeons at 4.46 m/s, Usherwood et al. 2005",
    "pennycuick": "from Pennycuick's law of 1996 for this mass, span and area",
}
# "Agrees very well": the mean deviation is at most this. Usherwood et al. 2005 state 8.02 +- 0.69 Hz, a spread of
# 9 %. If the other quantity has the same spread, a difference of 12 % is within one standard deviation.
AGREES = 0.15


@functools.cache
def pigeon_reference(name: str) -> float:
    """Return a reference frequency for the paper's pigeon [Hz].

    >>> [round(pigeon_reference(name), 1) for name in PIGEON_REFERENCES]
    [8.0, 8.3]
    """
    species = load_species("pigeon")
    return PIGEON_REFERENCES[name].value(species.vehicle, species.air, SAMPLE_SPEED)


def deviation(evidence: Evidence, animal: str, model: str, speeds: np.ndarray, measured: float) -> float:
    """Return the mean relative deviation of the lowest frequencies from a measured frequency [Hz]."""
    return float(np.mean(np.abs(evidence.frequencies(animal, model, speeds) / measured - 1)))


def closer_at_speed(name: str, animal: str, measured: float, words: str) -> FlightClaim:
    """Return the claim that Su-Fan's frequency is nearer to a measured one [Hz] than Dickinson's above 10 m/s."""

    def test(evidence: Evidence) -> TestResult:
        speeds = evidence.speeds(animal, "su-fan", "dickinson", above=10.0)
        ours, theirs = (deviation(evidence, animal, m, speeds, measured) for m in ("su-fan", "dickinson"))
        return theirs / ours, ours < theirs

    return FlightClaim(
        name,
        "abstract; discussion, simulations",
        f"The {animal}'s frequency is closer to the measured one with Su-Fan's than with Dickinson's coefficients, "
        "especially at high speed. Tested: at 10 m/s and above, its mean relative deviation from the reference is "
        f"smaller with Su-Fan. Ours: Dickinson's deviation divided by Su-Fan's. Reference: {measured:.3g} Hz, "
        f"{words}.",
        "> 1",
        "1",
        test,
    )


def _by_model(model: str, measured: float, good: Callable[[float], bool]) -> Callable[[Evidence], TestResult]:
    def test(evidence: Evidence) -> TestResult:
        found = deviation(evidence, "pigeon", model, evidence.speeds("pigeon", model, above=11.0), measured)
        return found, good(found)

    return test


def pigeon_claims() -> list[FlightClaim]:
    """Return the claims about the pigeon's frequency, each once for every reference."""
    claims = []
    for name in PIGEON_REFERENCES:
        measured = pigeon_reference(name)
        by = f"{measured:.3g} Hz, {_WORDS[name]}"
        claims += [
            FlightClaim(
                f"pigeon-agrees-{name}",
                _RESULTS,
                "Above 10 m/s the pigeon's frequency agrees very well with the measured one. Tested: its mean "
                f"relative deviation from the reference is at most {100 * AGREES:.0f} %. Ours: this deviation. "
                f"Reference: {by}. For comparison, Usherwood et al. state a spread of 9 %.",
                "remarkably well",
                "1",
                _by_model("su-fan", measured, lambda found: found <= AGREES),
            ),
            FlightClaim(
                f"pigeon-dickinson-off-{name}",
                _RESULTS,
                "Above 10 m/s Dickinson's coefficients give the pigeon a frequency that agrees poorly with "
                f"measurement. Tested: its mean relative deviation from the reference is above {100 * AGREES:.0f} "
                f"%. Ours: this deviation. Reference: {by}.",
                "poor",
                "1",
                _by_model("dickinson", measured, lambda found: found > AGREES),
            ),
            closer_at_speed(f"pigeon-closer-at-speed-{name}", "pigeon", measured, _WORDS[name]),
        ]
    return claims


def pigeon_data_claim() -> Claim:
    """Return the claim that the pigeon's frequency agrees with the data that the paper draws; we cannot test it."""
    return untestable(
        "pigeon-agrees",
        _RESULTS,
        "Above 10 m/s the pigeon's frequency agrees very well with the one that Tobalske and Dial 1996 measured. "
        "Other rows judge this claim by two other references. Ours: the lower of the frequencies that these two "
        "give.",
        "remarkably well",
        "Hz",
        min(pigeon_reference(name) for name in PIGEON_REFERENCES),
        "cannot be tested with the paper's data: neither the paper nor the abstract of its source gives numbers",
    )
