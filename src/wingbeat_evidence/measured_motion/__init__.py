"""Measured motions of wings, strip by strip: the loads of every model and term, compared with measured forces."""

from wingbeat_evidence.measured_motion.choice import Regime
from wingbeat_evidence.measured_motion.comparison import Validation, ValidationRow, validate
from wingbeat_evidence.measured_motion.reading import read_strip_case, shipped_cases
from wingbeat_evidence.measured_motion.scores import Score
from wingbeat_evidence.measured_motion.strip_case import StripCase
from wingbeat_evidence.measured_motion.strip_loads import StripLoads
from wingbeat_evidence.measured_motion.strip_motion import StripMotion

__all__ = [
    "Regime",
    "Score",
    "StripCase",
    "StripLoads",
    "StripMotion",
    "Validation",
    "ValidationRow",
    "read_strip_case",
    "shipped_cases",
    "validate",
]


def __dir__() -> list[str]:
    return sorted(__all__)
