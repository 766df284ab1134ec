"""Least squares within bounds, by Levenberg and Marquardt's damped steps with the bounds that hold them back kept.

Few unknowns, costly misses, and bounds that are met at the answer: SciPy's reflective method keeps inside of those
and takes twice the flights, a third of the time of which goes to its own arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

Values = Callable[[np.ndarray], np.ndarray]

# Damping of the first step over the largest curvature, and the least, without which fewer misses than unknowns fix
# no step; how it shrinks at most, and first grows.
_DAMPING, _LEAST = 1e-3, 1e-12
_SHRINK, _GROW = 0.2, 2.0
# A step that lessens the squares by less than this share of what the linear model foretold is not taken; one that
# keeps to more than the second share may be the last.
_TAKEN, _TRUSTED = 1e-3, 0.25
# Bounds that are taken up or let go for one step, at most, over the number of unknowns.
_TURNS = 4
# A step shorter than this is none.
_STILL = 1e-9


def least_misses(
    misses: Values,
    jacobian: Values,
    start: np.ndarray,
    lower: np.ndarray,
    upper: np.ndarray,
    evaluations: int,
    settled: float,
) -> np.ndarray:
    """Return where, within bounds, the squares of misses sum up to the least.

    Parameters
    ----------
    misses, jacobian : as functions of the unknowns; misses may be wild or not-a-number away from the start.
    start : unknowns to start from, moved within the bounds.
    lower, upper : the bounds.
    evaluations : of the misses, at most.
    settled : a share of the sum of squares, by less than which the last step lessens it.
    """
    here = np.clip(start, lower, upper)
    told = misses(here)
    squares, used, growth = _squares(told), 1, _GROW
    curvature, gradient = _model(jacobian(here), told)
    damping = _DAMPING * _size(curvature)
    while used < evaluations and np.isfinite(damping):
        step = _step(curvature, gradient, damping, lower - here, upper - here)
        foretold = -float(2.0 * gradient @ step + step @ curvature @ step)
        if foretold <= settled * squares or np.abs(step).max() < _STILL:
            break
        there = np.clip(here + step, lower, upper)
        told = misses(there)
        used += 1
        gained = squares - _squares(told)
        if not gained > _TAKEN * foretold:
            damping, growth = damping * growth, 2.0 * growth
            continue
        last = gained <= settled * squares and gained > _TRUSTED * foretold
        here, squares = there, squares - gained
        if last:
            break
        curvature, gradient = _model(jacobian(here), told)
        damping *= max(_SHRINK, 1.0 - (2.0 * gained / foretold - 1.0) ** 3)
        damping, growth = max(damping, _LEAST * _size(curvature)), _GROW
    return here


def _size(curvature: np.ndarray) -> float:
    return max(float(curvature.diagonal().max()), np.finfo(float).tiny)


def _squares(misses: np.ndarray) -> float:
    # A flight that runs off overflow in what is squared; such a step is not taken.
    with np.errstate(over="ignore", invalid="ignore"):
        return float(misses @ misses)


def _model(jacobian: np.ndarray, misses: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    with np.errstate(over="ignore", invalid="ignore"):
        return jacobian.T @ jacobian, jacobian.T @ misses


def _step(
    curvature: np.ndarray, gradient: np.ndarray, damping: float, low: np.ndarray, high: np.ndarray
) -> np.ndarray:
    """Return the damped step that is best within its bounds, by the active-set method."""
    damped = curvature + damping * np.eye(gradient.size)
    step = np.zeros(gradient.size)
    at_low, at_high = low >= 0, high <= 0
    for _ in range(_TURNS * gradient.size):
        free = ~(at_low | at_high)
        way = np.zeros(gradient.size)
        slope = gradient + damped @ step
        if free.any():
            way[free] = np.linalg.solve(damped[np.ix_(free, free)], -slope[free])
        with np.errstate(divide="ignore", invalid="ignore"):
            reach = np.where(way > 0, (high - step) / way, np.where(way < 0, (low - step) / way, np.inf))
        first = int(reach.argmin())
        if reach[first] < 1.0:
            step = np.clip(step + reach[first] * way, low, high)
            (at_high if way[first] > 0 else at_low)[first] = True
            continue
        step = np.clip(step + way, low, high)
        slope = gradient + damped @ step
        pull = np.where(at_low, -slope, np.where(at_high, slope, 0.0))
        if pull.max() <= 0:
            break
        at_low[pull.argmax()] = at_high[pull.argmax()] = False
    return step
