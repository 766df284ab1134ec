"""Disturbed flights that a page of the viewer can show on demand: `Push`."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    import xarray as xr


class Push(NamedTuple):
    """A flight that begins on an orbit and meets a gust.

    Attributes
    ----------
    direction : of the gust, in words.
    size : largest velocity of the gust [m/s].
    feedback : whether feedback changes the wingbeat.
    outcome : how the flight ends, in words.
    dataset : time series of the flight, until it is lost.
    pitch : body pitch less that of the orbit at the same phase [rad], shape (K,).
    height : height above the path of the orbit [m], shape (K,).
    """

    direction: str
    size: float
    feedback: bool
    outcome: str
    dataset: xr.Dataset
    pitch: np.ndarray
    height: np.ndarray

    @property
    def label(self) -> str:
        """What is flown, in words."""
        return f"{self.direction} gust of {self.size:g} m/s, {'with' if self.feedback else 'without'} feedback"
