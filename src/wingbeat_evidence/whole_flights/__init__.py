"""Whole flights predicted, and compared with what was measured on live animals."""

from wingbeat_evidence.whole_flights.comparison import Score, compared
from wingbeat_evidence.whole_flights.measured import (
    MeasuredFlights,
    Measurement,
    measured_animals,
    read_measured_flights,
)
from wingbeat_evidence.whole_flights.prediction import Flown, Prediction, predict_flights

__all__ = [
    "Flown",
    "MeasuredFlights",
    "Measurement",
    "Prediction",
    "Score",
    "compared",
    "measured_animals",
    "predict_flights",
    "read_measured_flights",
]


def __dir__() -> list[str]:
    return sorted(__all__)
