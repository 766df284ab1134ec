"""Which assumptions a claim depends on: permutation importance in a quadratic response surface."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from wingbeat_evidence.paper.assumptions import ASSUMPTIONS, Values

_FOLDS = 10
# A surface needs at least this many outcomes for each of its terms.
_PER_TERM = 2


@dataclass(frozen=True)
class Importance:
    """How much of a claim's number each assumption explains, and how well the surface predicts unseen numbers.

    ``shares`` : for each assumption, the share of the variance that the surface no longer explains if the values of
    this assumption are shuffled.
    ``quality`` : R-squared in ten-fold cross-validation; the shares mean little where it is low.
    """

    shares: np.ndarray
    quality: float


def fewest_outcomes() -> int:
    """Return the least number of outcomes that a surface of all assumptions needs."""
    one = [np.zeros((1, max(len(a.choices) - 1, 1))) for a in ASSUMPTIONS]
    return _PER_TERM * _surface(one).shape[1]


def importance(sets: Sequence[Values], numbers: np.ndarray) -> Importance | None:
    """Return what a claim's number depends on, or None if too few sets give a number or all give the same number.

    Numbers are replaced by their ranks, so that a few outliers do not dominate the surface.

    Parameters
    ----------
    sets : the assumptions, one for each number.
    numbers : a claim's number under each set, NaN where it cannot be tested, shape (sets,).
    """
    from scipy.stats import rankdata

    told = np.isfinite(numbers)
    if told.sum() < fewest_outcomes() or np.ptp(numbers[told]) == 0:
        return None
    ranks = rankdata(numbers[told])
    target = (ranks - ranks.mean()) / ranks.std()
    telling = [values for values, there in zip(sets, told, strict=True) if there]
    coordinates = [_coordinates([values[a.name] for values in telling], a.choices) for a in ASSUMPTIONS]
    random = np.random.default_rng(0)
    fold = random.permutation(len(target)) % _FOLDS
    predicted, shuffled = np.zeros(len(target)), np.zeros((len(ASSUMPTIONS), len(target)))
    for k in range(_FOLDS):
        held = fold == k
        solution = np.linalg.lstsq(_surface([c[~held] for c in coordinates]), target[~held])[0]
        predicted[held] = _surface([c[held] for c in coordinates]) @ solution
        for i in range(len(ASSUMPTIONS)):
            order = random.permutation(int(held.sum()))
            mixed = [c[held][order] if i == j else c[held] for j, c in enumerate(coordinates)]
            shuffled[i, held] = _surface(mixed) @ solution
    error = np.mean((target - predicted) ** 2)
    lost = np.mean((target - shuffled) ** 2, axis=1) - error
    return Importance(np.maximum(lost, 0.0) / 2.0, float(1.0 - error))


def _coordinates(values: list[float | str], choices: tuple[str, ...]) -> np.ndarray:
    """Return an assumption's columns: numbers from -1 to 1, or 0 and 1 for each choice but the first."""
    if choices:
        return np.array([[float(value == choice) for choice in choices[1:]] for value in values])
    column = np.array(values, dtype=float)
    return (2.0 * (column - column.min()) / np.ptp(column) - 1.0)[:, None]


def _surface(coordinates: list[np.ndarray]) -> np.ndarray:
    """Return the terms of the response surface: constant, every column, every square and product of two columns."""
    columns = np.concatenate(coordinates, axis=1)
    owner = np.concatenate([[i] * c.shape[1] for i, c in enumerate(coordinates)])
    terms = [np.ones((len(columns), 1)), columns]
    for i in range(columns.shape[1]):
        # A column of 0 and 1 is its own square, and two such columns of one assumption are never 1 together.
        number = coordinates[owner[i]].shape[1] == 1
        others = [j for j in range(i, columns.shape[1]) if owner[i] != owner[j] or number]
        if others:
            terms.append(columns[:, i : i + 1] * columns[:, others])
    return np.concatenate(terms, axis=1)
