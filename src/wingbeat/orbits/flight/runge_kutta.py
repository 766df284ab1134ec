"""The classical Runge-Kutta method of order 4 as a table, so that its stages are one loop, compiled once.

Each stage starts from the state at the start of the step. To this state it adds the share `ALONG` of the step,
times the rate of the stage before. The rate of the whole step is the mean of the stages' rates, weighted by
`WEIGHTS`.
"""

from __future__ import annotations

import numpy as np

# Time of each stage: the start (0), the middle (1) or the end (2) of the step.
PLACES = np.array([0, 1, 1, 2])
ALONG = np.array([0.0, 0.5, 0.5, 1.0])
WEIGHTS = np.array([1.0, 2.0, 2.0, 1.0]) / 6.0
