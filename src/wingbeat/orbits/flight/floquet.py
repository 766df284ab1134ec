"""How disturbances of an orbit grow or decay: Floquet multipliers, from flights beside the certified path.

Finite differences suffice, because no optimiser uses these derivatives. The differences are accurate to about 1e-6,
and they compile in half the time that tangents take.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._jax.arrays import fusion_barrier, jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import FlightModel, body_rates, motion_table
from wingbeat.mechanics.flights import Steps
from wingbeat.orbits.flight.runge_kutta import ALONG, PLACES, WEIGHTS

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Stretches, StretchMaps, StretchStates


# Number of steps in each step of the certifier, whose steps are short at the kinks of the loads. With two, the
# multipliers of unstable bats are within 1e-5 of those of an adaptive flight.
_STEPS = 2
# Distances from the path at which the flights start: (body_pitch, u, w, pitch_rate) [rad, m/s, m/s, rad/s].
_BESIDE = np.array([1e-7, 1e-6, 1e-6, 1e-6])
# Number of stretches of the path that are flown at once, as lanes: few enough for the processor's first cache.
_LANES = 64


@exported
def _state_maps(
    model: FlightModel, wingbeat: Wingbeat, begin: Stretches, end: Stretches, path: StretchStates
) -> StretchMaps:
    """Return the derivative of each stretch's last pitch state by its first, shape (K, 4, 4).

    Each stretch is flown from its start on the path, shape (K, 4), and from disturbed starts near the path.
    """
    length = (end - begin) / _STEPS
    seconds = length / wingbeat.frequency

    def stage(carry: Any, given: Any) -> tuple[Any, None]:
        state, rate, total = carry
        motion, along, weight = given
        here = fusion_barrier(state + along * seconds * rate)
        rate = fusion_barrier(jax.vmap(lambda at: body_rates(model, motion, at))(here))
        return (state, rate, total + weight * rate), None

    def step(state: Any, index: Any) -> tuple[Any, None]:
        phases = begin + length * (index + jnp.array([0.0, 0.5, 1.0])[:, None])
        motion = motion_table(model, wingbeat, phases.ravel())
        rows = jax.tree_util.tree_map(
            lambda leaf: jnp.moveaxis(leaf.reshape(*leaf.shape[:-1], 3, -1), -2, 0)[PLACES], motion
        )
        nothing = jnp.zeros_like(state)
        stages = rows, jnp.asarray(ALONG), jnp.asarray(WEIGHTS)
        (_, _, change), _ = jax.lax.scan(stage, (state, nothing, nothing), stages)
        return state + seconds * change, None

    beside = jnp.concatenate([jnp.zeros((1, 4)), jnp.diag(_BESIDE)])
    there, _ = jax.lax.scan(step, path.T + beside[..., None], jnp.arange(_STEPS))
    return ((there[1:] - there[0]) / _BESIDE[:, None, None]).transpose(2, 1, 0)


def floquet_multipliers(model: FlightModel, wingbeat: Wingbeat, steps: Steps) -> np.ndarray:
    """Return the multipliers of (body_pitch, u, w, pitch_rate) over a period, largest modulus first, shape (4,).

    They are the eigenvalues of the `monodromy` matrix; not-a-number if the flight diverges.

    Parameters
    ----------
    steps : the certifier's steps.
    model, wingbeat : the flight model and its wingbeat.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> steps = wb.certify(orbit.problem.model, orbit.wingbeat, orbit.initial_state[2:]).steps
    >>> multipliers = wb.floquet_multipliers(orbit.problem.model, orbit.wingbeat, steps)
    >>> round(float(abs(multipliers[0])), 2)
    1.35
    """
    return multipliers_of(monodromy(model, wingbeat, steps))


def multipliers_of(matrix: np.ndarray) -> np.ndarray:
    """Return the eigenvalues of a monodromy matrix, largest modulus first, shape (4,).

    They are not-a-number if the matrix is.

    Theory: equation ``multipliers``.
    """
    if not np.isfinite(matrix).all():
        return np.full(4, np.nan + 0j)
    found = np.linalg.eigvals(matrix)
    return found[np.lexsort((-found.imag, -found.real, -np.round(np.abs(found), 9)))]


def monodromy(model: FlightModel, wingbeat: Wingbeat, steps: Steps) -> np.ndarray:
    """Return the derivative of (body_pitch, u, w, pitch_rate) at the end of a period by those at its start.

    Its shape is (4, 4). It is not-a-number if the flight diverges.

    Theory: equation ``monodromy``.

    Parameters
    ----------
    model, wingbeat, steps : as of `floquet_multipliers`.
    """
    phase, path = steps.phase, steps.states[:, 2:]
    if phase[-1] < 1.0:
        return np.full((4, 4), np.nan)
    maps_of, count, blocks = _state_maps.bind(model, wingbeat), len(phase) - 1, []
    for first in range(0, count, _LANES):
        # Spare lanes repeat the last stretch.
        lanes = np.minimum(np.arange(first, first + _LANES), count - 1)
        blocks.append(maps_of(phase[lanes], phase[lanes + 1], path[lanes]))
    return _chained(np.concatenate(blocks)[:count])


def _chained(maps: np.ndarray) -> np.ndarray:
    """Return the product of linear maps, shape (K, 4, 4), by pairwise multiplication; the first map acts first."""
    while len(maps) > 1:
        last = maps[len(maps) // 2 * 2 :]
        maps = np.concatenate([maps[1::2] @ maps[: len(maps) // 2 * 2 : 2], last])
    return maps[0]
