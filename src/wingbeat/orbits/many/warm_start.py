"""Which problems of a batch are similar, and what solved ones predict for the others."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import NamedTuple

import numpy as np

from wingbeat._jax.arrays import jax
from wingbeat.orbits.nlp.newton_kkt import ReducedHessian
from wingbeat.orbits.options.continuation import ContinuationOptions
from wingbeat.orbits.options.solver import DEFAULTS
from wingbeat.orbits.problem.problem import OrbitProblem


class Group(NamedTuple):
    """Indices of problems that differ in numbers only: those to solve first, and the others, split into parts."""

    first: list[int]
    parts: list[list[int]]


def group_similar(
    problems: Sequence[OrbitProblem], options: ContinuationOptions = DEFAULTS.continuation
) -> list[Group]:
    """Return groups of problems that differ in numbers only, in an order that favours predictions.

    The problems of a group share a species and a coefficient model, by name. In a large group, a sample of problems
    is to be solved first. All others are split into parts, each of which contains problems with similar numbers.
    The sample and each part are ordered in the same way: first comes the problem whose numbers are nearest to the
    mean, and each next problem is the one farthest from all problems already in the list. Groups depend on the
    problems alone, not on the number of processes.
    """
    kinds: dict[object, list[int]] = {}
    for i, problem in enumerate(problems):
        kinds.setdefault(kind(problem), []).append(i)
    groups = []
    for members in kinds.values():
        places = differences([numbers_of(problems[i]) for i in members], options.rounding)
        whole = np.arange(len(members))
        first = _spread(places, whole, len(members) if len(members) <= options.batch_size else options.batch_first)
        rest = np.setdiff1d(whole, first)
        parts = (
            [_spread(places, part, part.size) for part in _parts(places, rest, options.batch_size)]
            if rest.size
            else []
        )
        groups.append(Group([members[j] for j in first], [[members[j] for j in part] for part in parts]))
    return groups


def kind(problem: OrbitProblem) -> Hashable:
    """Return a value that is equal for problems that differ in numbers only."""
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


def differences(described: Sequence[np.ndarray], rounding: float) -> np.ndarray:
    """Return coordinates of problems of one kind about their mean, shape (problems, directions).

    The directions are those in which the problems differ. The distance of two problems is the distance of the
    numbers that describe them, each number divided by its largest magnitude.
    """
    numbers = np.array(described)
    numbers = numbers / np.maximum(np.abs(numbers).max(axis=0), np.finfo(float).tiny)
    places, sizes, _ = np.linalg.svd(numbers - numbers.mean(axis=0), full_matrices=False)
    counts = sizes > rounding * np.sqrt(numbers.size)
    return places[:, counts] * sizes[counts]


def numbers_of(problem: OrbitProblem) -> np.ndarray:
    """Return the numbers that distinguish a problem from others of its kind."""
    leaves = jax.tree_util.tree_leaves((problem.model, problem.species.wingbeat))
    bounds = list(problem.bounds.values())
    # Numbers that a coefficient model lacks are not-a-number.
    return np.nan_to_num(np.concatenate([np.ravel(a) for a in (*leaves, problem.speed, problem.climb, bounds)]))


def _parts(places: np.ndarray, members: np.ndarray, most: int) -> list[np.ndarray]:
    """Halve along the direction with the largest range, and halve the parts again until all are small enough."""
    if members.size <= most:
        return [members]
    here = places[members]
    order = members[np.argsort(here[:, np.ptp(here, axis=0).argmax()], kind="stable")] if here.size else members
    half = members.size // 2
    return _parts(places, order[:half], most) + _parts(places, order[half:], most)


def _spread(places: np.ndarray, members: np.ndarray, count: int) -> np.ndarray:
    """Return `count` members: first the one nearest to the mean, then always the farthest from those chosen."""
    here = places[members] - places[members].mean(axis=0)
    order, away = [], np.full(members.size, np.inf)
    nearest = np.linalg.norm(here, axis=1).argmin()
    for _ in range(count):
        order.append(nearest)
        away = np.minimum(away, np.linalg.norm(here - here[nearest], axis=1))
        away[order] = -1.0
        nearest = away.argmax()
    return members[order]


class Known(NamedTuple):
    """A solved problem.

    Parameters
    ----------
    numbers : the numbers that distinguish it from others of its kind.
    unknowns : of its optimum.
    active : the bounds that are active at the optimum.
    reduced_hessian : the curvature at the optimum.
    """

    numbers: np.ndarray
    unknowns: np.ndarray
    active: tuple[str, ...]
    reduced_hessian: ReducedHessian | None


class Answers:
    """Solutions of problems of one kind, and predictions from the nearest of them for problems to come.

    Parameters
    ----------
    known : problems solved before.
    coming : the numbers of the problems to come, which are named by their index.
    options : of the prediction.
    """

    def __init__(
        self,
        known: Sequence[Known],
        coming: Sequence[np.ndarray],
        options: ContinuationOptions = DEFAULTS.continuation,
    ) -> None:
        self._before, self._near_share = len(known), options.near_share
        self._places = differences([*(one.numbers for one in known), *coming], options.rounding)
        self._known = list(known)
        self._at = list(range(len(known)))

    def add(self, place: int, known: Known) -> None:
        """Add the solution of a problem that was to come."""
        self._at.append(self._before + place)
        self._known.append(known)

    def predict(self, place: int) -> list[tuple[np.ndarray, ReducedHessian | None]]:
        """Return predicted unknowns, each with the curvature of the nearest solution that has one.

        A prediction uses solutions with the same active bounds, which count as one family. Where families meet, the
        nearest solutions differ in their active bounds, and each family makes its own prediction. The list is empty
        if one of these families has too few solutions.
        """
        away = self._places[self._at] - self._places[self._before + place]
        order = np.linalg.norm(away, axis=1).argsort(kind="stable")
        enough = away.shape[1] + 2
        families = dict.fromkeys(self._known[i].active for i in order[:enough])
        members = [np.array([i for i in order if self._known[i].active == family]) for family in families]
        if any(alike.size < enough for alike in members):
            return []
        return [self._predicted(alike, away[alike]) for alike in members]

    def _predicted(self, alike: np.ndarray, away: np.ndarray) -> tuple[np.ndarray, ReducedHessian | None]:
        known = [self._known[i] for i in alike]
        unknowns = _regression(away, np.array([one.unknowns for one in known]), self._near_share)
        return unknowns, next((one.reduced_hessian for one in known if one.reduced_hessian is not None), None)


def _regression(away: np.ndarray, values: np.ndarray, near_share: float) -> np.ndarray:
    """Fit a parabola to values, the nearest first, or a line if they are too few; return the fit at distance 0."""
    directions = away.shape[1]
    columns = np.hstack([np.ones((len(away), 1)), away])
    one, other = np.triu_indices(directions)
    if len(away) >= 1.5 * (columns.shape[1] + one.size):
        columns = np.hstack([columns, away[:, one] * away[:, other]])
    count = 2 * max(columns.shape[1], directions + 2)
    distance = np.linalg.norm(away[:count], axis=1)
    weights = 1.0 / (distance + near_share * distance[-1])[:, None]
    return np.linalg.lstsq(columns[:count] * weights, values[:count] * weights)[0][0]
