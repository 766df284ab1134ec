"""How the wings beat: the record of a wingbeat and its laws as functions of phase.

Phase runs from 0 at the top of the stroke to 1; the downstroke is its first half.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from wingbeat.elementary import cos, sin
from wingbeat.errors import FaultList
from wingbeat.jax64 import jax, register_record


@register_record
@dataclass(frozen=True)
class Wingbeat:
    """One periodic wingbeat; amplitudes are half of peak to peak.

    Parameters
    ----------
    frequency : [Hz].
    flap_mean, flap_amplitude : flap angle, wing up positive [rad].
    pitch_mean, pitch_amplitude : wing pitch at the root, leading edge up positive [rad].
    span_retraction : share of the span drawn in at mid-upstroke, 0 to below 1.
    twist_ratio : wing pitch at the tip over that at the root; 1 is no twist.
    fold_amplitude : angle by which the hand drops below the arm at mid-upstroke [rad].
    wrist : span fraction of the wrist.

    Raises
    ------
    InvalidInputError : frequency not positive, an amplitude negative, retraction or wrist outside 0..1.

    >>> Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3).twist_ratio
    1.0
    """

    frequency: float
    flap_mean: float
    flap_amplitude: float
    pitch_mean: float
    pitch_amplitude: float
    span_retraction: float = 0.0
    twist_ratio: float = 1.0
    fold_amplitude: float = 0.0
    wrist: float = 0.5

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("wingbeat.frequency", self.frequency, above=0, unit="Hz")
        faults.number("wingbeat.flap_mean", self.flap_mean, unit="rad")
        half = "amplitudes are half of peak to peak"
        faults.number("wingbeat.flap_amplitude", self.flap_amplitude, at_least=0, unit="rad", fix=half)
        faults.number("wingbeat.pitch_mean", self.pitch_mean, unit="rad")
        faults.number("wingbeat.pitch_amplitude", self.pitch_amplitude, at_least=0, unit="rad", fix=half)
        faults.number("wingbeat.span_retraction", self.span_retraction, at_least=0, below=1)
        faults.number("wingbeat.twist_ratio", self.twist_ratio, fix="1 is no twist")
        faults.number("wingbeat.fold_amplitude", self.fold_amplitude, unit="rad")
        faults.number("wingbeat.wrist", self.wrist, at_least=0, at_most=1, fix="a fraction of the span")
        faults.raise_if_any()


def recovery(phase: Any) -> Any:
    """Return the recovery law ``(1 - sin 2 pi phase)/2``: 0 at mid-downstroke, 1 at mid-upstroke."""
    return 0.5 * (1.0 - sin(2 * math.pi * phase))


def flap_angle(wingbeat: Wingbeat, phase: Any) -> Any:
    """Return the flap angle of the arm, up positive [rad]."""
    return wingbeat.flap_mean + wingbeat.flap_amplitude * cos(2 * math.pi * phase)


def pitch_angle(wingbeat: Wingbeat, phase: Any) -> Any:
    """Return the wing pitch at the root, leading edge up positive [rad]."""
    return wingbeat.pitch_mean - wingbeat.pitch_amplitude * sin(2 * math.pi * phase)


def span_ratio(wingbeat: Wingbeat, phase: Any) -> Any:
    """Return the span over the full span."""
    return 1.0 - wingbeat.span_retraction * recovery(phase)


def fold_angle(wingbeat: Wingbeat, phase: Any) -> Any:
    """Return the angle of the hand below the arm [rad]."""
    return wingbeat.fold_amplitude * recovery(phase)


def unpack(free: tuple[str, ...], wingbeat: Wingbeat, values: Any) -> Wingbeat:
    """Return the wingbeat with its free parameters replaced by `values`, in the order of `free`."""
    names = vars(wingbeat)
    replaced = {name: values[i] for i, name in enumerate(free)}
    return jax.tree_util.tree_unflatten(
        jax.tree_util.tree_structure(wingbeat), [replaced.get(name, names[name]) for name in names]
    )
