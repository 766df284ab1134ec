"""Limits of the stroke map that are tightened step by step, from an orbit that is far from stable."""

from __future__ import annotations

import dataclasses

import numpy as np

from wingbeat.orbits.nlp.local_search import optimise
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.limits import Constraint
from wingbeat.orbits.problem.map_quantities import MapQuantity


def tightened(programme: Transcription, start: np.ndarray) -> np.ndarray:
    """Return unknowns near a local optimum; start from an orbit that exceeds limits of the stroke map.

    Each limit moves in steps of equal ratio. Its first value is that of the limited quantity at the start, its last
    is the limit asked for. A short search follows each step.

    Parameters
    ----------
    programme : of the problem with its limits.
    start : unknowns of an orbit of the problem without these limits.
    """
    problem, options = programme.problem, programme.options
    stroke_map = np.asarray(programme.fly(start[4:], start[:4]).end_jacobian)[2:, :4]
    for share in np.linspace(0.0, 1.0, options.search.tightening_steps + 1)[1:]:
        limits = tuple(_between(c, stroke_map, float(share)) for c in problem.subject_to)
        nearer = Transcription(dataclasses.replace(problem, subject_to=limits), options)
        scaled = nearer.scaled(start)
        start = nearer.physical(
            optimise(nearer, scaled, options.search.tightening_iterations, options.search.tolerance)[0]
        )
    return start


def _between(constraint: Constraint, stroke_map: np.ndarray, share: float) -> Constraint:
    """Return a limit between the quantity's value at the start and the limit asked for; leave other constraints."""
    quantity, limit = constraint.quantity, constraint.limit
    if not (isinstance(quantity, MapQuantity) and constraint.at_most):
        return constraint
    there = float(np.max(quantity.of(stroke_map)))
    if not there > limit > 0:
        return constraint
    return dataclasses.replace(constraint, limit=there * (limit / there) ** share)
