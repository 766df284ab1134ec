"""A SYNTHETIC film: what a film of a known wingbeat shows, with the noise of a random generator."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat.animal.kinematics import (
    Wingbeat,
    chord_ratio,
    flap_angle,
    pitch_angle,
    span_ratio,
    sweep_angle,
    tip_twist,
)
from wingbeat.experiment.film import FILMED, Film


def _true(name: str, wingbeat: Wingbeat, phase: NDArray[np.float64], stroke_plane: float) -> Any:
    """Return what a perfect film of a wingbeat shows, in radians or as a fraction."""
    if name == "flap_deg":
        return flap_angle(wingbeat, phase)
    if name == "sweep_deg":
        sweep = sweep_angle(wingbeat, phase)
        return np.zeros_like(phase) if sweep is None else sweep
    if name == "stroke_plane_deg":
        return np.full_like(phase, stroke_plane + wingbeat.stroke_plane_tilt)
    if name in ("pitch_deg", "tip_pitch_deg"):
        root, twist = np.asarray(pitch_angle(wingbeat, phase)), tip_twist(wingbeat, phase)
        return root if name == "pitch_deg" else wingbeat.twist_ratio * root + (0.0 if twist is None else twist)
    chord = chord_ratio(wingbeat, phase) if name == "area_fraction" else None
    return np.asarray(span_ratio(wingbeat, phase)) * (1.0 if chord is None else np.asarray(chord))


def synthetic_film(
    wingbeat: Wingbeat,
    frames: int = 60,
    noise_deg: float = 1.0,
    seed: int = 0,
    columns: tuple[str, ...] = ("flap_deg",),
    start: float = 0.0,
    stroke_plane: float = 0.5 * math.pi,
) -> Film:
    """Return a film of a known wingbeat with white noise, labelled synthetic; the same seed gives the same film.

    Parameters
    ----------
    wingbeat : the wingbeat to film, one period in equal steps.
    frames : number of frames.
    noise_deg : standard deviation of the angles' noise [deg]; that of fractions is a hundredth of this number.
    seed : of the noise.
    columns : the columns that the film shows.
    start : phase of the wingbeat at the film's phase 0; without a column of flap, it has no effect.
    stroke_plane : angle of the vehicle's stroke plane from the body axis [rad]; the wingbeat's tilt adds to it.
    """
    random = np.random.default_rng(seed)
    phase = np.arange(frames) / frames
    at = phase + (start if "flap_deg" in columns else 0.0)
    seen = {}
    for name in columns:
        true = np.asarray(_true(name, wingbeat, at, stroke_plane))
        angle = FILMED[name] == "deg"
        noise = random.normal(scale=noise_deg if angle else 0.01 * noise_deg, size=frames)
        seen[name] = (np.degrees(true) if angle else true) + noise
    return Film("film of a known wingbeat", phase, seen, float(wingbeat.frequency), synthetic=True)
