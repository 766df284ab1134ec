"""Points of the unit cube that cover it evenly: SciPy's Sobol sequence and Latin hypercubes."""

from __future__ import annotations

import warnings

import numpy as np
from numpy.typing import NDArray


def unit_points(method: str, count: int, directions: int, seed: int) -> NDArray[np.float64]:
    """Return points of the unit cube, shape (count, directions).

    Sobol's sequence (scrambled with the seed) begins with the same points for every count, so that points can be
    added later. A Latin hypercube has different points for each count.

    Parameters
    ----------
    method : "sobol" or "latin-hypercube".
    count, directions : numbers of points and of coordinates.
    seed : of the scrambling, or of the hypercube.

    >>> bool((unit_points("sobol", 4, 2, 0) == unit_points("sobol", 8, 2, 0)[:4]).all())
    True
    """
    from scipy.stats import qmc

    random = np.random.default_rng(seed)
    if method == "latin-hypercube":
        return qmc.LatinHypercube(directions, rng=random).random(count)
    with warnings.catch_warnings():
        # If the count is not a power of two, the sequence is a little less even. It has no other effect.
        warnings.filterwarnings("ignore", message="The balance properties of Sobol")
        return qmc.Sobol(directions, scramble=True, rng=random).random(count)
