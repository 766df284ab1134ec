"""The classical Runge-Kutta method of order 4 as a table, so that its stages are a loop, compiled once.

A stage begins at the step's begin, plus `ALONG` of the step at the rate of the stage before; the step is the sum of
the stages' rates by `WEIGHTS`.
"""

from __future__ import annotations

import numpy as np

# When each stage is: at the begin (0), the middle (1) or the end (2) of the step.
PLACES = np.array([0, 1, 1, 2])
ALONG = np.array([0.0, 0.5, 0.5, 1.0])
WEIGHTS = np.array([1.0, 2.0, 2.0, 1.0]) / 6.0
