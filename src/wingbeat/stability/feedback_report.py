"""What a feedback and a survey of gusts say to a reader, as the blocks of a report."""

from __future__ import annotations

import math
from typing import Any

from wingbeat._base import Line, Report, Row, Table
from wingbeat.animal.kinematics import ANGLES

# How the state is shown: label, and the size of the unit in SI units.
STATE_UNITS = {
    "z": ("z [m]", 1.0),
    "body_pitch": ("pitch [deg]", math.radians(1.0)),
    "u": ("u [m/s]", 1.0),
    "w": ("w [m/s]", 1.0),
    "pitch_rate": ("rate [deg/s]", math.radians(1.0)),
}


def feedback_report(record: dict[str, Any]) -> Report:
    """Return what the feedback does, its gains, and the multipliers with it and without.

    Parameters
    ----------
    record : of `Feedback.record`.
    """
    rows = tuple(Row(_gains(name, row)) for name, row in zip(record["inputs"], record["gains"], strict=True))
    headings = ("", *(label for label, _ in STATE_UNITS.values()))
    delay = record["delay"]
    beats = "beat" if delay == 1 else beats_of(delay)
    last = [
        Line(f"and of the inputs of the last {beats}: see --json, whose `gains`"),
        Line("have the opposite sign (inputs = -gains x deviations), SI units and radians"),
    ]
    return [
        Line(headline(record), wraps=False),
        Line(""),
        Line("change of the inputs per unit of"),
        Table(rows, headings, "n" + "r" * len(STATE_UNITS)),
        *(last if delay else []),
        Line(""),
        Line("multipliers without feedback: " + _numbers(record["open_loop"]["multipliers"]), wraps=False),
        Line("multipliers with feedback:    " + _numbers(record["multipliers"]), wraps=False),
        Line("inputs that suffice alone:    " + (", ".join(record["sufficient"]) or "none"), wraps=False),
    ]


def survey_report(record: dict[str, Any]) -> Report:
    """Return the share of random gusts that were survived with each feedback.

    Parameters
    ----------
    record : of `GustSurvey.record`.
    """
    shares = tuple(Row((f"  {name}", f"{share:.1%}")) for name, share in record["survived"].items())
    gusts = f"{record['flights']} gusts of up to {record['largest_gust']:.2g} m/s, {beats_of(record['beats'])} each"
    return [Line(f"share survived of {gusts}"), Table(shares, align="lr")]


def headline(record: dict[str, Any]) -> str:
    """Return what a feedback does to an orbit in a line."""
    where = f"{record['species']} at {record['speed']:g} m/s, {record['frequency']:.4g} Hz"
    acting = "in the same beat" if not record["delay"] else f"{beats_of(record['delay'])} later"
    return (
        f"{where}: spectral radius {record['open_loop']['spectral_radius']:.3f} without feedback, "
        f"{record['spectral_radius']:.3f} with feedback that acts {acting}"
    )


def beats_of(count: int) -> str:
    """Return a number of beats in words."""
    return f"{count} beat" if count == 1 else f"{count} beats"


def _gains(name: str, row: list[float]) -> tuple[str, ...]:
    """Return the change of an input per unit of each state; the gains of pending inputs follow in the record."""
    unit, size = ("deg", math.radians(1.0)) if name in ANGLES else ("Hz" if name == "frequency" else "-", 1.0)
    changes = [f"{-gain * one / size:.3g}" for gain, (_, one) in zip(row, STATE_UNITS.values(), strict=False)]
    return f"{name} [{unit}]", *changes


def _numbers(pairs: list[list[float]]) -> str:
    """Return the multipliers, one of each complex pair, without those near 0, which belong to pending inputs."""
    shown = [
        (real, imaginary) for real, imaginary in pairs if imaginary >= 0 and math.hypot(real, imaginary) > 5e-4
    ]
    return ", ".join(f"{real:.3f}" + (f" ± {imaginary:.3f}i" if imaginary > 0 else "") for real, imaginary in shown)
