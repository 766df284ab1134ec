"""The averaged model: derivatives of the rates by the state along the orbit, averaged over the beat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import FlightModel, body_rates, motion_table

if TYPE_CHECKING:
    from wingbeat._jax.arrays import PitchState, RatesByState, Samples


@exported
def _rates_by_state(model: FlightModel, wingbeat: Wingbeat, phase: Samples, path: PitchState) -> RatesByState:
    """Return the derivatives of the four rates by the four states at each phase, shape (4 states, 4 rates, K)."""
    motion = motion_table(model, wingbeat, phase)

    def by_state(seed: Any) -> Any:
        tangent = jnp.broadcast_to(seed[:, None], path.shape)
        return jax.jvp(lambda state: body_rates(model, motion, state), (path,), (tangent,))[1]

    return jax.vmap(by_state)(jnp.eye(4))


def averaged_jacobian(model: FlightModel, wingbeat: Wingbeat, path: np.ndarray) -> np.ndarray:
    """Return the mean over the beat of the derivatives of the four rates (rows) by the four states, shape (4, 4).

    Theory: equation ``averaged-model``.

    Parameters
    ----------
    model, wingbeat : what flies.
    path : (body_pitch, u, w, pitch_rate) at equal phases from 0 to 1, shape (K, 4) [rad, m/s, m/s, rad/s].
    """
    phase = np.linspace(0.0, 1.0, len(path))[:-1]
    return np.asarray(_rates_by_state.bind(model, wingbeat)(phase, path[:-1].T)).mean(axis=-1).T
