"""Fixed steps of a period: the method of Runge and Kutta as a table, and rows of the wing's motion."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import jax, jnp

if TYPE_CHECKING:
    from wingbeat._jax.arrays import FlightState, Stages, TableRows, TableTangents

# --- The classical Runge-Kutta method of order 4 as a table, so that its stages are one loop, compiled once. ---
# Each stage starts from the state at the start of the step, plus the share `ALONG` of the step times the rate of
# the stage before. The rate of the whole step is the mean of the stages' rates, weighted by `WEIGHTS`.
# Time of each stage: the start (0), the middle (1) or the end (2) of the step.
PLACES = np.array([0, 1, 1, 2])
ALONG = np.array([0.0, 0.5, 0.5, 1.0])
WEIGHTS = np.array([1.0, 2.0, 2.0, 1.0]) / 6.0

# One compiled march has this many steps; finer flights chain several marches.
STEPS = 32


def from_rows(rows: TableRows, like: Any) -> Any:
    """Return a table from its rows; `like` is a table with the same structure."""
    leaves, tree = jax.tree_util.tree_flatten(like)
    sizes = np.cumsum([int(np.prod(leaf.shape[:-1])) for leaf in leaves])
    parts = jnp.split(rows, sizes[:-1])
    shaped = [part.reshape(*leaf.shape[:-1], *rows.shape[1:]) for part, leaf in zip(parts, leaves, strict=True)]
    return jax.tree_util.tree_unflatten(tree, shaped)


# Indices of the four stages of all steps along the last axis of a table of `tabulated`.
AT_STAGES = [(slice(STEPS), slice(STEPS + 1, None), slice(1, STEPS + 1))[place] for place in PLACES]


class March(NamedTuple):
    """States and rates of all stages, (S, 4 stages, steps), and the last state, (S,); S is 4 without a wake."""

    states: Stages
    rates: Stages
    last: FlightState


def in_lanes(rows: TableRows | TableTangents) -> Any:
    """Return rows of a table at the four stages of all steps, as lanes of the last axis."""
    return jnp.concatenate([rows[..., part] for part in AT_STAGES], axis=-1)


def along_stages(
    body_rates: Callable[..., Any], model: Any, table: TableRows, like: Any, states: Stages
) -> tuple[Any, Any, Callable[..., Any], Callable[..., Any]]:
    """Return motion and states at all stages as lanes, and functions that differentiate the rates there.

    The first function takes a tangent of the state, the same at all stages, and the second one rows of a table.
    """
    lanes, state = from_rows(in_lanes(table), like), states.reshape(states.shape[0], -1)

    def by_state(seed: Any) -> Any:
        tangent = jnp.broadcast_to(seed[:, None], state.shape)
        return jax.jvp(lambda s: body_rates(model, lanes, s), (state,), (tangent,))[1]

    def by_free(rows: Any) -> Any:
        tangent = from_rows(rows, like)
        return jax.jvp(lambda motion: body_rates(model, motion, state), (lanes,), (tangent,))[1]

    return lanes, state, by_state, by_free


def combined(stages: Any) -> Any:
    """Return the weighted mean of the four stages along the first axis."""
    return sum(weight * stages[i] for i, weight in enumerate(WEIGHTS.tolist()))
