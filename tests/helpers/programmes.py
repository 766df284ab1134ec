"""Nonlinear programmes at their stock start, and differences of their functions."""

import numpy as np

from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.starts import start_point


def differences(function, scaled, step=1e-6):
    ahead, behind = (
        np.array([function(scaled + sign * step * e) for e in np.eye(scaled.size)]) for sign in (1, -1)
    )
    return ((ahead - behind) / (2 * step)).T


def stock_point(problem):
    """Return the programme and the stock start at 9 Hz, and the same moved a little."""
    programme = Transcription(problem)
    point = start_point(problem, 0, 0)
    point[4] = 9.0
    scaled = programme.scaled(point)
    return programme, scaled, scaled + 0.01 * np.random.default_rng(1).normal(size=scaled.size)
