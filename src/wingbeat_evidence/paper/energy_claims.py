"""The paper's claims about power and body pitch at 10 m/s, each tested on certified orbits."""

from __future__ import annotations

import numpy as np

from wingbeat.plots.published import PAPER_PEAK_POWER, PAPER_PITCH_RANGE_DEG
from wingbeat_evidence.paper.claim import Evidence, FlightClaim, TestResult
from wingbeat_evidence.paper.treatments import ANIMALS, MODELS

# The largest power that CFD and a quasi-steady model give for similar bats [W].
BATS_NEED = 4.0


def _peaks(evidence: Evidence) -> list[float]:
    """Return the bat's peak powers at 10 m/s with Su-Fan and with Dickinson [W]."""
    return [float(evidence.record("bat", model)["peak_power"]) for model in MODELS]


def _ratio(evidence: Evidence, animal: str, key: str) -> TestResult:
    """Return a number at 10 m/s with Su-Fan divided by that with Dickinson; the claim holds below 1."""
    fit, fly = (float(evidence.record(animal, model)[key]) for model in MODELS)
    return fit / fly, fit < fly


def peak_power(model: str) -> FlightClaim:
    """Return the claim about the bat's peak power at 10 m/s with one model."""
    paper = PAPER_PEAK_POWER[model]

    def test(evidence: Evidence) -> TestResult:
        peak = float(evidence.record("bat", model)["peak_power"])
        return peak, abs(peak / paper - 1) <= 0.25

    return FlightClaim(
        f"peak-power-{model}",
        "results, energetics",
        f"With {model.title()} the peak power at 10 m/s is {paper:g} W. We read this as the bat's peak power. "
        "Tested: our peak power is within 25 % of the paper's.",
        paper,
        "W",
        test,
    )


def four_times(evidence: Evidence) -> TestResult:
    """Return the bat's peak power at 10 m/s with Dickinson divided by that with Su-Fan."""
    fit, fly = _peaks(evidence)
    return fly / fit, 3 <= fly / fit <= 5


def power_exponent(evidence: Evidence) -> TestResult:
    """Return the exponent that the two models' powers and frequencies at 10 m/s imply."""
    fit, fly = _peaks(evidence)
    slow, fast = (evidence.orbit("bat", model).wingbeat.frequency for model in MODELS)
    if abs(np.log(fast / slow)) < 0.05:
        return 0.0, False
    exponent = float(np.log(fly / fit) / np.log(fast / slow))
    return exponent, abs(exponent - 2) <= 0.5


def measured_power_below(evidence: Evidence) -> TestResult:
    """Return the lower of the two peak powers at 10 m/s [W]."""
    least = min(_peaks(evidence))
    return least, least > BATS_NEED


def lower_power(evidence: Evidence) -> TestResult:
    """Return the mean positive power at 10 m/s with Su-Fan divided by that with Dickinson.

    The result is the larger of the two animals' ratios.
    """
    ratios = [_ratio(evidence, animal, "mean_positive_power")[0] for animal in ANIMALS]
    return max(ratios), max(ratios) < 1


def pitch_range(model: str, bound: bool) -> FlightClaim:
    """Return the claim about the bat's range of body pitch at 10 m/s with one model."""
    paper = PAPER_PITCH_RANGE_DEG[model]

    def test(evidence: Evidence) -> TestResult:
        found = float(np.degrees(evidence.record("bat", model)["body_pitch_range"]))
        return found, found <= paper if bound else abs(found / paper - 1) <= 0.25

    amount, words = ("at most ", "at most") if bound else ("", "within 25 % of")
    return FlightClaim(
        f"pitch-range-{model}",
        "results, body pitch",
        f"With {model.title()} body pitch varies by {amount}{paper:g} deg within a wingbeat. We read this as the "
        f"bat's range at 10 m/s. Tested: our range is {words} {paper:g} deg.",
        paper,
        "deg",
        test,
    )


def few_degrees(evidence: Evidence) -> TestResult:
    """Return the bat's range of body pitch with Su-Fan at 10 m/s [deg]."""
    found = float(np.degrees(evidence.record("bat", "su-fan")["body_pitch_range"]))
    return found, found <= 5


def less_pitching(animal: str) -> FlightClaim:
    """Return the claim that an animal's body pitches less with Su-Fan at 10 m/s."""

    def test(evidence: Evidence) -> TestResult:
        return _ratio(evidence, animal, "body_pitch_range")

    return FlightClaim(
        f"less-pitching-{animal}",
        "abstract; discussion",
        f"With Su-Fan's coefficients the {animal}'s body pitches less. Tested: at 10 m/s the range of body pitch "
        "is smaller than with Dickinson. Ours: Su-Fan's range divided by Dickinson's.",
        "< 1",
        "1",
        test,
    )
