"""The unknowns that the solver varies."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Unknowns:
    """Names, bounds and scales of the unknowns: the pitch state at phase 0, then the free parameters.

    Parameters
    ----------
    names : of the unknowns.
    lower, upper : bounds, SI and radians, shape (unknowns,).
    scale : differences that matter, shape (unknowns,); the optimiser's scale is in multiples of them.
    """

    names: tuple[str, ...]
    lower: np.ndarray
    upper: np.ndarray
    scale: np.ndarray
