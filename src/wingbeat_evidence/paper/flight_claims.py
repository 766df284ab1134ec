"""The paper's claims about flight, each tested on certified orbits under every treatment."""

from __future__ import annotations

import numpy as np

from wingbeat._base.datasets import at_station
from wingbeat.plots.published import PAPER_BAT_FREQUENCY
from wingbeat.records.numbers import beat_mean
from wingbeat_evidence.paper.claim import Evidence, FlightClaim, TestResult
from wingbeat_evidence.paper.pigeon_claims import deviation
from wingbeat_evidence.paper.treatments import SAMPLE_SPEED

# Stations of arm and hand, as fractions of the span.
ARM, HAND = 0.25, 0.75
BAT_MEASURED = PAPER_BAT_FREQUENCY


def station_series(evidence: Evidence, model: str, name: str, station: float) -> np.ndarray:
    """Return a quantity of the bat's strips at 10 m/s over the wingbeat, at a span fraction.

    Axes x, y, z come last, if there are any.
    """
    values = evidence.orbit("bat", model).dataset[name].values
    return at_station(np.moveaxis(values, 1, -1), station)


def station_force(evidence: Evidence, model: str, axis: int, station: float) -> np.ndarray:
    """Return the force on both wings' strips at a span fraction, divided by weight; axis 0: forward, 2: up."""
    orbit = evidence.orbit("bat", model)
    vehicle, air = orbit.problem.vehicle, orbit.problem.air
    return 2.0 * station_series(evidence, model, "strip_force", station)[:, axis] / (vehicle.mass * air.gravity)


def closed_loops(evidence: Evidence) -> TestResult:
    """Return the largest closure residual of any state except x over all sample orbits."""
    misses = [
        abs(miss)
        for animal in ("pigeon", "bat")
        for model in ("su-fan", "dickinson")
        for name, miss in evidence.record(animal, model)["closure"].items()
        if name != "x"
    ]
    return max(misses), max(misses) <= 1e-6


def open_loop(evidence: Evidence) -> TestResult:
    """Return the distance gained in a wingbeat [m]."""
    states = evidence.orbit("pigeon", "su-fan").dataset["x"].values
    gained = float(states[-1] - states[0])
    expected = SAMPLE_SPEED / evidence.orbit("pigeon", "su-fan").wingbeat.frequency
    return gained, abs(gained / expected - 1) < 1e-6


def printed_sign(evidence: Evidence) -> TestResult:
    """Return the forward speed that the periodicity condition gives with the sign as printed [m/s]."""
    orbit = evidence.orbit("pigeon", "su-fan")
    x = orbit.dataset["x"].values
    speed = float(x[0] - x[-1]) * orbit.wingbeat.frequency
    return speed, speed > 0.0


def stable(evidence: Evidence) -> TestResult:
    """Return the largest modulus of a Floquet multiplier over the Su-Fan orbits of both animals."""
    sizes = []
    for animal in ("pigeon", "bat"):
        for speed in evidence.speeds(animal, "su-fan"):
            pairs = np.array(evidence.record(animal, "su-fan", speed)["floquet_multipliers"])
            sizes.append(np.hypot(*pairs.T).max())
    return max(sizes), max(sizes) < 1


def least_frequency(evidence: Evidence) -> TestResult:
    """Return the largest number of distinct optima that the starts of one problem found."""
    counts = [
        evidence.record(animal, "su-fan", speed)["distinct_optima"]
        for animal in ("pigeon", "bat")
        for speed in evidence.speeds(animal, "su-fan")
    ]
    return max(counts), max(counts) == 1


def bat_slow_alike(evidence: Evidence) -> TestResult:
    """Return the bat's frequency with Dickinson divided by that with Su-Fan, up to 5 m/s.

    The result is the ratio at the speed where the ratio differs most from 1.
    """
    speeds = evidence.speeds("bat", "su-fan", "dickinson", below=5.0)
    ratios = evidence.frequencies("bat", "dickinson", speeds) / evidence.frequencies("bat", "su-fan", speeds)
    worst = ratios[np.abs(np.log(ratios)).argmax()]
    return float(worst), abs(worst - 1) <= 0.15


def bat_parts(evidence: Evidence) -> TestResult:
    """Return the slope against speed of the bat's frequency with Dickinson divided by that with Su-Fan.

    The speeds are 5 to 12 m/s.
    """
    speeds = evidence.speeds("bat", "su-fan", "dickinson", above=5.0, below=12.0)
    ratios = evidence.frequencies("bat", "dickinson", speeds) / evidence.frequencies("bat", "su-fan", speeds)
    growth = float(np.polyfit(speeds, ratios, 1)[0]) if len(speeds) > 1 else 0.0
    return growth, growth > 0 and bool(ratios[-1] > ratios[0])


def bat_agrees(evidence: Evidence) -> TestResult:
    """Return the mean relative deviation of the bat's frequency with Su-Fan from 6 Hz, at 5 to 10 m/s."""
    speeds = evidence.speeds("bat", "su-fan", above=5.0, below=10.0)
    ours = deviation(evidence, "bat", "su-fan", speeds, BAT_MEASURED)
    return ours, ours <= 0.15


def bat_invariant(evidence: Evidence) -> TestResult:
    """Return the range of the bat's frequency with Su-Fan divided by its mean, at 5 to 10 m/s."""
    frequencies = evidence.frequencies("bat", "su-fan", evidence.speeds("bat", "su-fan", above=5.0, below=10.0))
    spread = float(np.ptp(frequencies) / frequencies.mean())
    return spread, spread <= 0.15


def twice_the_frequency(evidence: Evidence) -> TestResult:
    """Return the bat's frequency at 10 m/s with Dickinson divided by that with Su-Fan."""
    fit, fly = (evidence.orbit("bat", model).wingbeat.frequency for model in ("su-fan", "dickinson"))
    return fly / fit, 1.7 <= fly / fit <= 2.3


def smaller_alpha(station: float) -> FlightClaim:
    """Return the claim that effective angles of attack are smaller with Su-Fan at a span fraction."""

    def test(evidence: Evidence) -> TestResult:
        sizes = [
            float(np.degrees(np.abs(station_series(evidence, model, "alpha", station)).mean()))
            for model in ("su-fan", "dickinson")
        ]
        return sizes[0] - sizes[1], sizes[0] < sizes[1]

    words = "1/4" if station == ARM else "3/4"
    return FlightClaim(
        f"smaller-alpha-{words.replace('/', '-of-')}",
        "results, forces; discussion",
        f"At {words} span the bat's effective angles of attack are smaller with Su-Fan. Tested: at 10 m/s the mean "
        "absolute angle over the wingbeat is smaller than with Dickinson. Ours: Su-Fan's mean minus Dickinson's.",
        "< 0",
        "deg",
        test,
    )


def smaller_force(axis: int, words: str) -> FlightClaim:
    """Return the claim that the force along an axis is smaller with Su-Fan at both stations."""

    def test(evidence: Evidence) -> TestResult:
        ratios = [
            np.ptp(station_force(evidence, "su-fan", axis, station))
            / np.ptp(station_force(evidence, "dickinson", axis, station))
            for station in (ARM, HAND)
        ]
        return float(max(ratios)), max(ratios) < 1

    return FlightClaim(
        f"smaller-{words}-force",
        "results, forces",
        f"The bat's {words} forces at 1/4 and 3/4 span are smaller with Su-Fan. Tested: at 10 m/s their "
        "peak-to-peak ranges over the wingbeat are smaller than with Dickinson. Ours: Su-Fan's range divided by "
        "Dickinson's, at the station with the larger ratio.",
        "< 1",
        "1",
        test,
    )


def hand_alpha_larger(evidence: Evidence) -> TestResult:
    """Return the mean absolute alpha at 3/4 span (hand) minus that at 1/4 span (arm) [deg].

    The result is the smaller of the two models' values.
    """
    sizes = [
        [np.degrees(np.abs(station_series(evidence, model, "alpha", s)).mean()) for s in (ARM, HAND)]
        for model in ("su-fan", "dickinson")
    ]
    excess = min(hand - arm for arm, hand in sizes)
    return float(excess), excess > 0


def _means(evidence: Evidence, axis: int) -> list[list[float]]:
    return [
        [beat_mean(station_force(evidence, model, axis, station)) for station in (ARM, HAND)]
        for model in ("su-fan", "dickinson")
    ]


def arm_lifts(evidence: Evidence) -> TestResult:
    """Return the mean upward force at 1/4 span (arm) minus that at 3/4 span (hand), divided by weight.

    The result is the smaller of the two models' values.
    """
    means = _means(evidence, 2)
    return min(arm - hand for arm, hand in means), all(arm > hand and arm > 0 for arm, hand in means)


def hand_thrusts(evidence: Evidence) -> TestResult:
    """Return the hand's mean forward force divided by weight, for the model with the smaller force."""
    hands = [hand for _, hand in _means(evidence, 0)]
    return min(hands), min(hands) > 0


def arm_drags(evidence: Evidence) -> TestResult:
    """Return the mean forward force at 1/4 span (arm) minus that at 3/4 span (hand), divided by weight.

    The result is the larger of the two models' values.
    """
    gaps = [arm - hand for arm, hand in _means(evidence, 0)]
    return max(gaps), max(gaps) < 0


def arm_pitches_least(evidence: Evidence) -> TestResult:
    """Return the root's pitch amplitude with Su-Fan minus that with Dickinson, bat at 10 m/s [deg]."""
    fit, fly = (evidence.orbit("bat", model).wingbeat.pitch_amplitude for model in ("su-fan", "dickinson"))
    return float(np.degrees(fit - fly)), fit < fly


def force_balance(evidence: Evidence) -> TestResult:
    """Return how far the mean air force deviates from zero forward and from the weight upward.

    The result is the largest deviation of all sample orbits, divided by weight.
    """
    worst = 0.0
    for animal in ("pigeon", "bat"):
        for model in ("su-fan", "dickinson"):
            orbit = evidence.orbit(animal, model)
            weight = orbit.problem.vehicle.mass * orbit.problem.air.gravity
            lift, thrust = (beat_mean(orbit.dataset[name].values) / weight for name in ("force_z", "force_x"))
            worst = max(worst, abs(lift - 1), abs(thrust))
    # The trapezoidal rule over 256 samples, not the flight, limits the accuracy of the means.
    return worst, worst < 1e-2


def differentiable(evidence: Evidence) -> TestResult:
    """Return the largest residual of the optimality conditions of the sample orbits."""
    residuals = [
        evidence.record(animal, model)["optimality"]
        for animal in ("pigeon", "bat")
        for model in ("su-fan", "dickinson")
    ]
    return max(residuals), max(residuals) <= 1e-5
