"""How a disturbed orbit returns: Floquet multipliers, from flights beside the certified path.

Differences serve here, not tangents: nothing is searched along them, they are right to some 1e-6, and they compile
in half the time.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from wingbeat.jax64 import jax, jnp
from wingbeat.kinematics import Wingbeat
from wingbeat.model import FlightModel, body_rates, motion_table
from wingbeat.orbits.runge_kutta import ALONG, PLACES, WEIGHTS
from wingbeat.slopes import settled
from wingbeat.stored import stored

# Steps between two states of a path of 256; they bring the multipliers of unstable bats within 1e-5 of those of an
# adaptive flight.
_STEPS = 5
# How far beside the path the flights begin: (body_pitch, u, w, pitch_rate) [rad, m/s, m/s, rad/s].
_BESIDE = np.array([1e-7, 1e-6, 1e-6, 1e-6])


@stored
def _state_maps(model: FlightModel, wingbeat: Wingbeat, path: Any) -> Any:
    """Return the derivative of each pitch state of a path, (K + 1, 4), by the one before, shape (K, 4, 4).

    All stretches between two states are flown at once, as lanes, each from where the path is and from beside it.
    """
    stretches = path.shape[0] - 1
    begin = jnp.arange(stretches) / stretches
    length = 1.0 / (stretches * _STEPS)
    seconds = length / wingbeat.frequency

    def stage(carry: Any, given: Any) -> tuple[Any, None]:
        state, rate, total = carry
        motion, along, weight = given
        here = settled(state + along * seconds * rate)
        rate = settled(jax.vmap(lambda at: body_rates(model, motion, at))(here))
        return (state, rate, total + weight * rate), None

    def step(state: Any, index: Any) -> tuple[Any, None]:
        phases = begin + length * (index + jnp.array([0.0, 0.5, 1.0])[:, None])
        motion = motion_table(model, wingbeat, phases.ravel())
        rows = jax.tree_util.tree_map(
            lambda leaf: jnp.moveaxis(leaf.reshape(*leaf.shape[:-1], 3, stretches), -2, 0)[PLACES], motion
        )
        nothing = jnp.zeros_like(state)
        stages = rows, jnp.asarray(ALONG), jnp.asarray(WEIGHTS)
        (_, _, change), _ = jax.lax.scan(stage, (state, nothing, nothing), stages)
        return state + seconds * change, None

    beside = jnp.concatenate([jnp.zeros((1, 4)), jnp.diag(_BESIDE)])
    end, _ = jax.lax.scan(step, path[:-1].T + beside[..., None], jnp.arange(_STEPS))
    return ((end[1:] - end[0]) / _BESIDE[:, None, None]).transpose(2, 1, 0)


def floquet_multipliers(model: FlightModel, wingbeat: Wingbeat, path: np.ndarray) -> np.ndarray:
    """Return the multipliers of (body_pitch, u, w, pitch_rate) over a period, largest modulus first, shape (4,).

    They are the eigenvalues of the monodromy matrix, the derivative of the pitch state after a period with
    respect to that before. Not-a-number where the flight tumbles off.

    Parameters
    ----------
    path : the pitch state at evenly spaced phases from 0 to 1, as the certifier flew it, shape (K + 1, 4).
    """
    maps = np.asarray(_state_maps(model, wingbeat, path))
    if not np.isfinite(maps).all():
        return np.full(4, np.nan + 0j)
    found = np.linalg.eigvals(_chained(maps))
    return found[np.lexsort((-found.imag, -found.real, -np.round(np.abs(found), 9)))]


def _chained(maps: np.ndarray) -> np.ndarray:
    """Return the product of linear maps, shape (K, 4, 4), the first applied first; many pairs at a time."""
    while len(maps) > 1:
        last = maps[len(maps) // 2 * 2 :]
        maps = np.concatenate([maps[1::2] @ maps[: len(maps) // 2 * 2 : 2], last])
    return maps[0]
