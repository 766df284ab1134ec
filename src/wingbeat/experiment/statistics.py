"""The standard error of a record's mean if successive samples are correlated, and the scatter between repeats."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

MIN_BLOCKS = 8


def standard_error(series: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the standard error of the mean of each row of `series`, shape (..., n), by block means.

    The samples are averaged in blocks of B = 1, 2, 4, ... The standard error estimated from the block means grows
    with B until the means are independent. We use the smallest B with ``B^3 > 2 n (se_B / se_1)^4``, which balances
    bias and scatter of the estimate, and never fewer than 8 blocks.

    Flyvbjerg and Petersen 1989, J. Chem. Phys. 91:461, doi 10.1063/1.457480; the choice of the block is that of
    Lee et al. 2011, Phys. Rev. E 83:066706, doi 10.1103/PhysRevE.83.066706.

    >>> white = np.random.default_rng(0).normal(size=(1, 4096))
    >>> bool(abs(standard_error(white)[0] * 64 - 1) < 0.2)
    True
    >>> bool(standard_error(np.repeat(white, 16, axis=1))[0] * 64 > 0.8)
    True
    """
    n = series.shape[-1]
    blocks, size = series, 1
    first = found = _error_of_independent(series)
    settled = np.zeros(series.shape[:-1], dtype=bool)
    while blocks.shape[-1] // 2 >= MIN_BLOCKS and not settled.all():
        blocks, size = 0.5 * (blocks[..., 0 : blocks.shape[-1] // 2 * 2 : 2] + blocks[..., 1::2]), 2 * size
        error = _error_of_independent(blocks)
        found = np.where(settled, found, error)
        with np.errstate(divide="ignore", invalid="ignore"):
            settled |= size**3 > 2 * n * np.nan_to_num(found / first) ** 4
    return found


def _error_of_independent(blocks: NDArray[np.float64]) -> NDArray[np.float64]:
    return blocks.std(axis=-1, ddof=1) / np.sqrt(blocks.shape[-1])


def added_variance(values: NDArray[np.float64], errors: NDArray[np.float64], groups: NDArray[np.intp]) -> float:
    """Return the variance between repeats that their own standard errors do not explain, one value for all groups.

    With ``w = 1/se^2``, their sum ``W`` in a group and ``Q = sum w (x - mean)^2``, the result is the moment
    estimator ``tau^2 = (Q - df) / sum(W - sum(w^2)/W)`` if ``Q > df + 2 sqrt(2 df)``, which is two standard
    deviations of chi^2 above its mean. Otherwise it is 0, because estimated errors make Q slightly too large:
    DerSimonian and Laird 1986, doi 10.1016/0197-2456(86)90046-2.

    Parameters
    ----------
    values, errors : one mean and its standard error for each run, shape (runs,).
    groups : number of each run's group, from 0; the runs of a group are repeats of one point; shape (runs,).

    >>> added_variance(np.array([1.0, 3.0]), np.array([1e-6, 1e-6]), np.array([0, 0]))  # doctest: +ELLIPSIS
    1.999...
    """
    count = np.bincount(groups)
    freedom = int((count - 1)[count > 0].sum())
    if freedom == 0 or not (errors > 0).all():
        return 0.0
    weight = errors**-2
    total = np.bincount(groups, weight)
    mean = np.bincount(groups, weight * values) / total
    excess = float((weight * (values - mean[groups]) ** 2).sum()) - freedom
    if excess <= 2.0 * np.sqrt(2.0 * freedom):
        return 0.0
    room = float((total - np.bincount(groups, weight**2) / total).sum())
    return excess / room
