"""Options of many flights at once."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat.orbits.options.checks import check_options


@dataclass(frozen=True)
class ManyOptions:
    """Options of many flights at once.

    Parameters
    ----------
    steps : Runge-Kutta steps of a beat.
    air_samples : places in a beat at which the velocity of the air is tabulated; cubics give it between.
    lanes : flights that are computed at once.
    tilt : a flight is lost if its body pitch differs by more than this from the orbit's at the same phase [rad].
    loss : a flight is lost if it is more than this below the orbit's path at a top of the stroke [m].

    >>> import math, wingbeat as wb
    >>> options = wb.ManyOptions(tilt=math.radians(45))  # pass them on: wb.simulate_many(..., options=options)
    >>> round(options.tilt, 3), options.loss
    (0.785, 5.0)
    """

    steps: int = 64
    air_samples: int = 64
    lanes: int = 256
    tilt: float = math.radians(60.0)
    loss: float = 5.0

    def __post_init__(self) -> None:
        check_options(self)

    def keeps(self, largest_pitch: float | np.ndarray, lowest: float | np.ndarray) -> Any:
        """Return whether flights are not lost; False for numbers that are not finite.

        Parameters
        ----------
        largest_pitch : largest deviations of the body pitch from the orbit's [rad].
        lowest : least heights above the orbit's path [m].
        """
        return np.less_equal(largest_pitch, self.tilt) & np.greater_equal(lowest, -self.loss)


DEFAULTS = ManyOptions()
