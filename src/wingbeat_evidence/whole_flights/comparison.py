"""Predicted flights against measured ones: each measurement, the predictions at its speeds, and the verdict."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wingbeat._base import label_of, plain_unit
from wingbeat_evidence.whole_flights.measured import Measurement
from wingbeat_evidence.whole_flights.prediction import Prediction

# How far a prediction may lie outside the measured values and still count as agreeing: factors, and m/s.
AGREES = {
    "frequency": 1.25,
    "flap_amplitude_deg": 1.25,
    "positive_power_per_mass": 2.0,
    "muscle_power_per_mass": 2.0,
    "muscle_work_per_mass": 2.0,
    "metabolic_rate": 2.0,
    "net_muscle_efficiency": 2.0,
    "flight_efficiency": 2.0,
    "peak_activation": 1.0,
    "minimum_power_speed": 3.0,
}


@dataclass(frozen=True)
class Score:
    """A measurement and its prediction.

    Attributes
    ----------
    measurement : as read.
    speeds : the flown speeds to which it applies [m/s]; none for the speed of minimum power.
    predicted : lowest and highest prediction at these speeds; None if none is certified.
    band : the same over the range of the animal's frequency, or over draws; None if neither was flown.
    ratio : lowest and highest ratio of prediction to the middle of the measured values; None without a prediction,
        or for the speed of minimum power.
    agrees : whether every prediction is within the measured range or differs from the nearer end of this range by
        at most the factor in `AGREES`; no factor applies to a range that begins at 0, because its upper end is a
        limit. The speed of minimum power may be outside by 3 m/s. None if no flight is certified.
    at_edge : whether the speed of minimum power is the first or the last that was flown.
    """

    measurement: Measurement
    speeds: tuple[float, ...]
    predicted: tuple[float, float] | None
    ratio: tuple[float, float] | None
    agrees: bool | None
    at_edge: bool = False
    band: tuple[float, float] | None = None


def compared(prediction: Prediction) -> list[Score]:
    """Return a score for each measurement that can be compared.

    A measurement of muscle is left out if the model has no muscle, and one of frequency if the animal was flown at
    its own frequency, which is then an input. A measured frequency stays if a law gave that input.

    Parameters
    ----------
    prediction : from `predict_flights`.
    """
    return [
        _of_curve(prediction, one) if one.speeds is None else _at_speeds(prediction, one, one.speeds)
        for one in prediction.flights.measurements
        if (one.speeds is None or _is_known(prediction, one.quantity)) and not is_input(prediction, one)
    ]


def is_input(prediction: Prediction, one: Measurement) -> bool:
    """Return whether a measurement is of a frequency that the flights were given.

    Parameters
    ----------
    prediction : from `predict_flights`.
    one : one of its measurements.
    """
    if one.quantity != "frequency" or one.speeds is None:
        return False
    low, high = one.speeds
    bases = {row.frequency_basis for row in prediction.flown if row.values and low <= row.speed <= high}
    return bool(bases - {"free", "law"}) or (bases == {"law"} and one.basis != "measured")


def _is_known(prediction: Prediction, quantity: str) -> bool:
    """Return whether the model gives the quantity; True also if no flight is certified."""
    flown = [one for one in prediction.flown if one.values]
    return not flown or any(quantity in one.values for one in flown)


def _of_curve(prediction: Prediction, one: Measurement) -> Score:
    best = prediction.minimum_power_speed
    if best is None:
        return Score(one, (), None, None, None)
    flown = [row.speed for row in prediction.flown if row.values]
    low, high = one.values
    near = low - AGREES[one.quantity] <= best <= high + AGREES[one.quantity]
    return Score(one, (), (best, best), None, near, best in (flown[0], flown[-1]))


def _at_speeds(prediction: Prediction, one: Measurement, speeds: tuple[float, float]) -> Score:
    low, high = one.values
    rows = [row for row in prediction.flown if speeds[0] <= row.speed <= speeds[1]]
    values = [row.values[one.quantity] for row in rows if row.values]
    at = tuple(row.speed for row in rows)
    if not values:
        return Score(one, at, None, None, None)
    ends, factor = (min(values), max(values)), AGREES[one.quantity] if low else 1.0
    middle = float(np.mean(one.values))
    agrees = low / factor <= ends[0] and ends[1] <= high * factor
    lows = [row.low[one.quantity] for row in rows if one.quantity in row.low]
    highs = [row.high[one.quantity] for row in rows if one.quantity in row.high]
    band = (min(lows), max(highs)) if lows else None
    return Score(one, at, ends, (ends[0] / middle, ends[1] / middle), agrees, band=band)


def words_of(score: Score) -> str:
    """Return the verdict in a word or two.

    Parameters
    ----------
    score : from `compared`.
    """
    if score.agrees is None:
        return "no flight"
    return ("yes" if score.agrees else "no") + (", at the edge" if score.at_edge else "")


def name_of(quantity: str) -> str:
    """Return a quantity in words, with its unit.

    Parameters
    ----------
    quantity : one of `COMPARED`.

    >>> name_of("frequency")
    'wingbeat frequency [Hz]'
    """
    unit = plain_unit(quantity)
    return label_of(quantity) if unit == "1" else f"{label_of(quantity)} [{unit}]"


def ends_of(values: tuple[float, float] | None) -> str:
    """Return a lowest and a highest value in words; one number if they are equal, a dash if there are none.

    Parameters
    ----------
    values : such as those of a measurement, in any unit.

    >>> ends_of((5.0, 7.25)), ends_of((5.0, 5.0)), ends_of(None)
    ('5 to 7.25', '5', '-')
    """
    if values is None:
        return "-"
    low, high = (f"{value:.3g}" for value in values)
    return low if low == high else f"{low} to {high}"
