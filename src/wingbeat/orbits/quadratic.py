"""A small convex quadratic programme with elastic rows, by a primal-dual interior point method.

Mehrotra's predictor and corrector (SIAM J. Optim. 2, 1992, doi 10.1137/0802028). Rows that cannot all hold within
the bounds give way at a price, so that there always is an answer; where the price exceeds their multipliers, they
hold if they can.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from wingbeat.jax64 import jax, jnp

_ITERATIONS = 40
# The duality gap that counts as none, the share of the way to the boundary that a step may go, and what no
# distance from a bound nor its multiplier may fall below.
_GAP = 1e-13
_STEP = 0.995
_TINY = 1e-14


class Quadratic(NamedTuple):
    """Least ``g d + d B d / 2``, d in its bounds, ``A d + c`` zero or, where `equality` is 0, at least zero."""

    hessian: Any
    gradient: Any
    rows: Any
    values: Any
    equality: Any
    lower: Any
    upper: Any
    price: Any


class _Point(NamedTuple):
    """A step d, how far rows exceed and miss zero, the rows' multipliers, and those of the four kinds of bounds."""

    step: Any
    above: Any
    below: Any
    multipliers: Any
    at_lower: Any
    at_upper: Any
    at_above: Any
    at_below: Any


def solve_quadratic(problem: Quadratic) -> tuple[Any, Any]:
    """Return the step d and the multipliers of the rows, positive where a row pushes its value up."""

    def going_on(state: tuple[Any, Any, Any]) -> Any:
        _, iteration, gap = state
        return (gap > _GAP) & (iteration < _ITERATIONS)

    def advance(state: tuple[Any, Any, Any]) -> tuple[Any, Any, Any]:
        point, iteration, _ = state
        after = _improve(problem, point)
        return after, iteration + 1, _gap(problem, after)

    start = _start(problem)
    found, _, _ = jax.lax.while_loop(going_on, advance, (start, 0, _gap(problem, start)))
    return jnp.clip(found.step, problem.lower, problem.upper), found.multipliers


def _start(problem: Quadratic) -> _Point:
    width = problem.upper - problem.lower
    step = jnp.clip(0.0, problem.lower + 0.05 * width, problem.upper - 0.05 * width)
    value = problem.rows @ step + problem.values
    above = jnp.maximum(value, 0.0) + 0.05
    ones, half = jnp.ones_like(step), jnp.full_like(value, jnp.maximum(1.0, 0.5 * problem.price))
    return _Point(step, above, above - jnp.minimum(value, above - 0.05), 0.0 * value, ones, ones, half, half)


def _distances(problem: Quadratic, point: _Point) -> tuple[Any, ...]:
    """Return the distances from the bounds, each beside its multiplier."""
    return (
        jnp.maximum(point.step - problem.lower, _TINY),
        jnp.maximum(problem.upper - point.step, _TINY),
        point.above,
        point.below,
    )


def _gap(problem: Quadratic, point: _Point) -> Any:
    """Return the mean product of distances and multipliers, or the rows' residual if that is larger."""
    residual = problem.rows @ point.step + problem.values - point.above + point.below
    products = [d * z for d, z in zip(_distances(problem, point), point[4:], strict=True)]
    return jnp.maximum(jnp.mean(jnp.concatenate(products)), 1e-4 * jnp.max(jnp.abs(residual)))


def _improve(problem: Quadratic, point: _Point) -> _Point:
    """Return the point after a predictor and a corrector step with one factorisation."""
    lower, upper, above, below = distances = _distances(problem, point)
    duals = point[4:]
    # An inequality costs only where it is missed.
    price_above = problem.price * problem.equality
    residual_step = (
        problem.hessian @ point.step
        + problem.gradient
        - point.multipliers @ problem.rows
        - point.at_lower
        + point.at_upper
    )
    residual_above = price_above + point.multipliers - point.at_above
    residual_below = problem.price - point.multipliers - point.at_below
    residual_rows = problem.rows @ point.step + problem.values - point.above + point.below
    give_above, give_below = above / point.at_above, below / point.at_below
    give = give_above + give_below
    matrix = (
        problem.hessian
        + jnp.diag(point.at_lower / lower + point.at_upper / upper)
        + problem.rows.T @ (problem.rows / give[:, None])
    )
    scale = 1.0 / jnp.sqrt(jnp.diag(matrix))
    factor = jnp.linalg.cholesky(scale[:, None] * matrix * scale + 1e-15 * jnp.eye(scale.size))

    def solve(targets: tuple[Any, ...]) -> _Point:
        by_lower, by_upper, by_above, by_below = (t / d for t, d in zip(targets, distances, strict=True))
        sink = -residual_rows - give_above * (residual_above + by_above) + give_below * (residual_below + by_below)
        right = -residual_step - by_lower + by_upper + (sink / give) @ problem.rows
        half = jax.lax.linalg.triangular_solve(factor, (scale * right)[:, None], left_side=True, lower=True)
        whole = jax.lax.linalg.triangular_solve(factor, half, left_side=True, lower=True, transpose_a=True)
        step = scale * whole[:, 0]
        multipliers = (sink - problem.rows @ step) / give
        over = -give_above * (residual_above + by_above + multipliers)
        under = give_below * (multipliers - residual_below - by_below)
        return _Point(
            step,
            over,
            under,
            multipliers,
            -by_lower - point.at_lower / lower * step,
            -by_upper + point.at_upper / upper * step,
            -by_above - point.at_above / above * over,
            -by_below - point.at_below / below * under,
        )

    def moves(change: _Point) -> tuple[Any, ...]:
        return change.step, -change.step, change.above, change.below

    def lengths(change: _Point) -> tuple[Any, Any]:
        return _reach(distances, moves(change)), _reach(duals, change[4:])

    products = [d * z for d, z in zip(distances, duals, strict=True)]
    mean = jnp.mean(jnp.concatenate(products))
    predicted = solve(tuple(products))
    primal, dual = lengths(predicted)
    ahead = [
        (d + primal * dd) * (z + dual * dz)
        for d, dd, z, dz in zip(distances, moves(predicted), duals, predicted[4:], strict=True)
    ]
    aim = mean * (jnp.mean(jnp.concatenate(ahead)) / mean) ** 3
    second = [dd * dz for dd, dz in zip(moves(predicted), predicted[4:], strict=True)]
    change = solve(tuple(p + s - aim for p, s in zip(products, second, strict=True)))
    primal, dual = (jnp.minimum(1.0, _STEP * length) for length in lengths(change))
    return _Point(
        point.step + primal * change.step,
        jnp.maximum(point.above + primal * change.above, _TINY),
        jnp.maximum(point.below + primal * change.below, _TINY),
        point.multipliers + dual * change.multipliers,
        *(jnp.maximum(z + dual * dz, _TINY) for z, dz in zip(duals, change[4:], strict=True)),
    )


def _reach(values: tuple[Any, ...], changes: tuple[Any, ...]) -> Any:
    """Return the longest step, at most some 1/0.995, that keeps the values positive."""
    value, change = jnp.concatenate(values), jnp.concatenate(changes)
    return jnp.min(jnp.where(change < 0, -value / jnp.where(change < 0, change, -1.0), 1.0 / _STEP))
