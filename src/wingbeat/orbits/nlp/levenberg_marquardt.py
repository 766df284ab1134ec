"""Least squares within bounds by the Levenberg-Marquardt method, with an active set of bounds in each step.

Our problems have few unknowns, costly residuals, and bounds that are active at the solution. SciPy's reflective
method stays strictly inside the bounds. It needs twice as many flights, and spends a third of its time on its own
arithmetic.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy.optimize import lsq_linear

from wingbeat.orbits.search_options import LeastSquaresOptions

Values = Callable[[np.ndarray], np.ndarray]


def least_squares(
    residuals: Values,
    jacobian: Values,
    start: np.ndarray,
    lower: np.ndarray,
    upper: np.ndarray,
    options: LeastSquaresOptions,
    note: Callable[[np.ndarray], None] | None = None,
) -> np.ndarray:
    """Return the unknowns within bounds that minimise the sum of squares of residuals, which may diverge.

    `note` is called with the start and with each accepted step's end.
    """
    here = np.clip(start, lower, upper)
    found = residuals(here)
    squares, used, growth = _squares(found), 1, options.growth
    if note is not None:
        note(here)
    curvature, gradient = _model(jacobian(here), found)
    damping = options.damping * _size(curvature)
    while used < options.evaluations and np.isfinite(damping):
        turns = options.bound_changes * here.size
        step = _step(curvature, gradient, damping, lower - here, upper - here, turns)
        predicted = -float(2.0 * gradient @ step + step @ curvature @ step)
        if predicted <= options.tolerance * squares or np.abs(step).max() < options.step_tolerance:
            break
        there = np.clip(here + step, lower, upper)
        found = residuals(there)
        used += 1
        gained = squares - _squares(found)
        if not gained > options.accepted * predicted:
            damping, growth = damping * growth, 2.0 * growth
            continue
        last = gained <= options.tolerance * squares and gained > options.trusted * predicted
        here, squares = there, squares - gained
        if note is not None:
            note(here)
        if last:
            break
        curvature, gradient = _model(jacobian(here), found)
        damping *= max(options.shrink, 1.0 - (2.0 * gained / predicted - 1.0) ** 3)
        damping, growth = max(damping, options.least_damping * _size(curvature)), options.growth
    return here


def _size(curvature: np.ndarray) -> float:
    return max(float(curvature.diagonal().max()), np.finfo(float).tiny)


def _squares(residuals: np.ndarray) -> float:
    # The squares of a diverging flight overflow; such a step is rejected.
    with np.errstate(over="ignore", invalid="ignore"):
        return float(residuals @ residuals)


def _model(jacobian: np.ndarray, residuals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    with np.errstate(over="ignore", invalid="ignore"):
        return jacobian.T @ jacobian, jacobian.T @ residuals


def _step(
    curvature: np.ndarray, gradient: np.ndarray, damping: float, low: np.ndarray, high: np.ndarray, turns: int
) -> np.ndarray:
    """Return the best damped step within its bounds, by an active-set method of at most `turns` iterations."""
    damped = curvature + damping * np.eye(gradient.size)
    step = np.zeros(gradient.size)
    at_low, at_high = low >= 0, high <= 0
    for _ in range(turns):
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


def multiplier_residual(gradient: np.ndarray, equal: np.ndarray, within: np.ndarray) -> float:
    """Return the largest part of a gradient that multipliers of rows do not explain, not negative for `within`."""
    normals = np.concatenate([equal, within]).T
    multipliers = np.linalg.lstsq(normals, gradient)[0]
    if (multipliers[len(equal) :] < 0).any():
        least = np.repeat([-np.inf, 0.0], [len(equal), multipliers.size - len(equal)])
        with np.errstate(invalid="ignore"):  # it multiplies zero by infinity
            multipliers = lsq_linear(normals, gradient, bounds=(least, np.inf)).x
    return float(np.abs(normals @ multipliers - gradient).max())
