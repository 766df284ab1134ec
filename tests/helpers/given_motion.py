"""Motions that no orbit has to be solved for: a body on a given path, with wings that beat as told."""

import numpy as np
import xarray as xr

import wingbeat as wb
from wingbeat_evidence.second_opinion.motion import Motion

PIGEON = wb.load_species("pigeon").vehicle


def given_motion(wingbeat, speed=10.0, heave=0.0, pitch=0.0, vehicle=PIGEON, climb=0.0):
    """Return a motion whose body heaves [m] and pitches [rad] once a beat about a straight flight."""
    phase = np.linspace(0.0, 1.0, 257)
    omega, time = 2 * np.pi * wingbeat.frequency, phase / wingbeat.frequency
    cosine, sine, still = np.cos(2 * np.pi * phase), np.sin(2 * np.pi * phase), np.zeros_like(phase)
    series = {
        "x": speed * time,
        "z": climb * time + heave * cosine,
        "body_pitch": pitch * cosine,
        "u": still + speed,
        "w": climb - heave * omega * sine,
        "pitch_rate": -pitch * omega * sine,
        "u_rate": still,
        "w_rate": -heave * omega**2 * cosine,
        "pitch_acceleration": -pitch * omega**2 * cosine,
    }
    dataset = xr.Dataset({name: ("phase", values) for name, values in series.items()}, {"phase": phase})
    return Motion.of(dataset, vehicle, wingbeat, wb.Air())
