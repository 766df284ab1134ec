"""How a disturbed orbit returns: Floquet multipliers, from flights beside the certified path.

Differences serve here, not tangents: nothing is searched along them, they are right to some 1e-6, and they compile
in half the time.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from wingbeat.jax64 import jax, jnp
from wingbeat.kinematics import Wingbeat
from wingbeat.model import FlightModel, body_rates, motion_table
from wingbeat.slopes import settled
from wingbeat.stored import stored

# Steps between two states of a path of 256; they bring the multipliers of unstable bats within 1e-5 of those of an
# adaptive flight. Kinks of the loads, not the method's order, decide how many it takes.
_STEPS = 5
# Shu and Osher's method of order 3 (1988, doi 10.1016/0021-9991(88)90177-5): when in the step each stage is, and
# how much it keeps of the step's begin; the rest is the stage before and a step along its rate.
_WHEN = np.array([0.0, 1.0, 0.5])
_KEPT = np.array([0.0, 3.0, 1.0]) / np.array([1.0, 4.0, 3.0])
# How far beside the path the flights begin: (body_pitch, u, w, pitch_rate) [rad, m/s, m/s, rad/s].
_BESIDE = np.array([1e-7, 1e-6, 1e-6, 1e-6])
# Stretches of the path that are flown at once, as lanes: few enough for the processor's nearest memory.
_LANES = 64


@stored
def _state_maps(model: FlightModel, wingbeat: Wingbeat, path: Any) -> Any:
    """Return the derivative of each pitch state of a path, (K + 1, 4), by the one before, shape (K, 4, 4).

    Each stretch between two states is flown from where the path is and from beside it.
    """
    stretches = path.shape[0] - 1
    lanes = math.gcd(stretches, _LANES)
    length = 1.0 / (stretches * _STEPS)
    seconds = length / wingbeat.frequency
    beside = jnp.concatenate([jnp.zeros((1, 4)), jnp.diag(_BESIDE)])

    def fly(given: tuple[Any, Any]) -> Any:
        begin, path = given

        def step(state: Any, index: Any) -> tuple[Any, None]:
            phases = begin + length * (index + _WHEN[:, None])
            motion = motion_table(model, wingbeat, phases.ravel())

            def stage(here: Any, given: tuple[Any, Any]) -> tuple[Any, None]:
                motion, kept = given
                rate = jax.vmap(lambda at: body_rates(model, motion, at))(here)
                return settled(kept * state + (1.0 - kept) * (here + seconds * rate)), None

            rows = jax.tree_util.tree_map(
                lambda leaf: jnp.moveaxis(leaf.reshape(*leaf.shape[:-1], _WHEN.size, lanes), -2, 0), motion
            )
            return jax.lax.scan(stage, state, (rows, _KEPT))[0], None

        end, _ = jax.lax.scan(step, path + beside[..., None], jnp.arange(_STEPS))
        return (end[1:] - end[0]) / _BESIDE[:, None, None]

    begins = (jnp.arange(stretches) / stretches).reshape(-1, lanes)
    paths = path[:-1].reshape(-1, lanes, 4).transpose(0, 2, 1)
    return jax.lax.map(fly, (begins, paths)).transpose(0, 3, 2, 1).reshape(-1, 4, 4)


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
