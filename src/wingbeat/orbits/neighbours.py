"""Which problems of a batch are alike, and what the answers of some foretell of another's."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

import numpy as np

from wingbeat.jax64 import jax
from wingbeat.orbits.polish import Polish
from wingbeat.orbits.problem import OrbitProblem

# Problems that learn from one another: enough for good guesses, few enough to share a batch out over processes.
TOGETHER = 256
# Answers nearer than this share of the farthest one asked weigh alike.
_NEAR = 0.3
# Relative differences between numbers that come from rounding.
_ROUNDING = 1e-12


def alike(problems: Sequence[OrbitProblem]) -> list[list[int]]:
    """Return the indices of problems in groups that differ in numbers only, each group in an order to learn from.

    A group is of one species and one coefficient model, by name. It has neighbouring numbers, and its order goes to
    what is farthest from all that came before. Groups hang on the problems alone, not on who solves them.
    """
    kinds: dict[object, list[int]] = {}
    for i, problem in enumerate(problems):
        kinds.setdefault(kind(problem), []).append(i)
    groups = []
    for members in kinds.values():
        places = differences([numbers_of(problems[i]) for i in members])
        groups += [[members[j] for j in _spread(places, part)] for part in _parts(places, np.arange(len(members)))]
    return groups


def kind(problem: OrbitProblem) -> Hashable:
    """Return what problems share that differ in numbers only."""
    leaves, tree = jax.tree_util.tree_flatten((problem.model, problem.species.wingbeat))
    shapes = tuple(np.shape(leaf) for leaf in leaves)
    names = (
        problem.species.name,
        problem.aero.coefficients.name,
        *problem.free,
        repr(problem.minimise),
        repr(problem.subject_to),
    )
    return names, tree, shapes


def differences(described: Sequence[np.ndarray]) -> np.ndarray:
    """Return where problems of one kind are, from their mean, in as few directions as they differ in.

    Distances are those between the numbers that describe them, each over its largest; shape (problems, directions).
    """
    numbers = np.array(described)
    numbers = numbers / np.maximum(np.abs(numbers).max(axis=0), np.finfo(float).tiny)
    places, sizes, _ = np.linalg.svd(numbers - numbers.mean(axis=0), full_matrices=False)
    told = sizes > _ROUNDING * np.sqrt(numbers.size)
    return places[:, told] * sizes[told]


def numbers_of(problem: OrbitProblem) -> np.ndarray:
    """Return the numbers that tell a problem from others of its kind."""
    leaves = jax.tree_util.tree_leaves((problem.model, problem.species.wingbeat))
    bounds = list(problem.bounds.values())
    # What a coefficient model has none of is not-a-number.
    return np.nan_to_num(np.concatenate([np.ravel(a) for a in (*leaves, problem.speed, problem.climb, bounds)]))


def _parts(places: np.ndarray, members: np.ndarray) -> list[np.ndarray]:
    """Halve where the numbers differ most, until the parts are small enough."""
    if members.size <= TOGETHER:
        return [members]
    here = places[members]
    order = members[np.argsort(here[:, np.ptp(here, axis=0).argmax()], kind="stable")] if here.size else members
    half = members.size // 2
    return _parts(places, order[:half]) + _parts(places, order[half:])


def _spread(places: np.ndarray, members: np.ndarray) -> np.ndarray:
    """Return the members from the middle on, each the farthest from those before it."""
    here = places[members] - places[members].mean(axis=0)
    order, away = [], np.full(members.size, np.inf)
    nearest = np.linalg.norm(here, axis=1).argmin()
    for _ in members:
        order.append(nearest)
        away = np.minimum(away, np.linalg.norm(here - here[nearest], axis=1))
        away[order] = -1.0
        nearest = away.argmax()
    return members[order]


class Answers:
    """Answers of a group's problems, given by their numbers, and what the nearest of them foretell of the next."""

    def __init__(self, described: Sequence[np.ndarray]) -> None:
        self._places = differences(described)
        self._known: list[int] = []
        self._unknowns: list[np.ndarray] = []
        self._active: list[tuple[str, ...]] = []
        self._polishes: list[Polish | None] = []

    def add(self, index: int, unknowns: np.ndarray, active: tuple[str, ...], polish: Polish | None) -> None:
        """Remember the answer of a problem, the bounds active at it, and what corrected it if it was foretold."""
        self._known.append(index)
        self._unknowns.append(unknowns)
        self._active.append(active)
        self._polishes.append(polish)

    def foretell(self, index: int) -> list[tuple[np.ndarray, Polish | None]]:
        """Foretell unknowns, and lend the nearest polish, from the answers with the same bounds active.

        Where families meet, the nearest answers differ in their active bounds, and each family foretells its own.
        The list is empty where too little is known of one of them.
        """
        away = self._places[self._known] - self._places[index]
        order = np.linalg.norm(away, axis=1).argsort(kind="stable")
        enough = away.shape[1] + 2
        families = dict.fromkeys(self._active[i] for i in order[:enough])
        members = [np.array([i for i in order if self._active[i] == family]) for family in families]
        if any(alike.size < enough for alike in members):
            return []
        return [self._foretold(alike, away[alike]) for alike in members]

    def _foretold(self, alike: np.ndarray, away: np.ndarray) -> tuple[np.ndarray, Polish | None]:
        unknowns = _regression(away, np.array(self._unknowns)[alike])
        return unknowns, next((self._polishes[i] for i in alike if self._polishes[i] is not None), None)


def _regression(away: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the value at 0 of a parabola through values, nearest first, or of a line where they are too few."""
    directions = away.shape[1]
    columns = np.hstack([np.ones((len(away), 1)), away])
    one, other = np.triu_indices(directions)
    if len(away) >= 1.5 * (columns.shape[1] + one.size):
        columns = np.hstack([columns, away[:, one] * away[:, other]])
    count = 2 * max(columns.shape[1], directions + 2)
    distance = np.linalg.norm(away[:count], axis=1)
    weights = 1.0 / (distance + _NEAR * distance[-1])[:, None]
    return np.linalg.lstsq(columns[:count] * weights, values[:count] * weights)[0][0]
