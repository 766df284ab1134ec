"""The certificate: an independent adaptive flight of one period, and the stability that comes with it.

Nothing of the search is used: Dopri8 at rtol 1e-10 with error control, the wing's motion evaluated where the
integrator asks, the tangents from the variational equations.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat.flights import integrate, state_rates
from wingbeat.jax64 import jax, jnp
from wingbeat.kinematics import Wingbeat, unpack
from wingbeat.model import FlightModel
from wingbeat.stored import stored

SAMPLES = 256


@dataclass(frozen=True)
class Certificate:
    """One period flown by the certifier.

    Phases (K,), states (K, 6), and the derivative (6, 4 + n) of the end with respect to the pitch state
    at the start and the n free parameters.
    """

    phase: np.ndarray
    states: np.ndarray
    jacobian: np.ndarray

    @property
    def end(self) -> np.ndarray:
        """The state at the end of the period."""
        return self.states[-1]

    @property
    def monodromy(self) -> np.ndarray:
        """The derivative of (body_pitch, u, w, pitch_rate) after a period with respect to them before, (4, 4)."""
        return self.jacobian[2:, :4]

    @property
    def multipliers(self) -> np.ndarray:
        """Floquet multipliers of (body_pitch, u, w, pitch_rate), largest modulus first."""
        if not np.isfinite(self.monodromy).all():
            return np.full(4, np.nan + 0j)
        found = np.linalg.eigvals(self.monodromy)
        return found[np.lexsort((-found.imag, -found.real, -np.round(np.abs(found), 9)))]


@stored(static=("free",))
def _fly_with_variations(
    model: FlightModel, wingbeat: Wingbeat, values: Any, start: Any, phases: Any, *, free: tuple[str, ...]
) -> Any:
    columns = 4 + len(free)

    def rates(phase: Any, state: Any, args: tuple[FlightModel, Wingbeat, Any]) -> Any:
        flown, beat, parameters = args

        def body(pitch_state: Any, at: Any) -> Any:
            place = jnp.zeros(2)  # nothing depends on where the vehicle is
            now = unpack(free, beat, at)
            return state_rates(flown, now, phase, jnp.concatenate([place, pitch_state])) / now.frequency

        value, along = jax.linearize(body, state[2:6], parameters)
        variations = state[6:].reshape(6, columns)[2:]
        seeds = jnp.eye(columns)[4:]
        varied = jax.vmap(along, in_axes=1, out_axes=1)(variations, seeds)
        return jnp.concatenate([value, varied.ravel()])

    first = jnp.concatenate([start, jnp.eye(6, columns, -2).ravel()])
    return integrate(rates, first, phases, (model, wingbeat, values), controlled=6)


def certify(
    model: FlightModel, wingbeat: Wingbeat, pitch_state: np.ndarray, free: tuple[str, ...] = ()
) -> Certificate:
    """Fly one period from x = z = 0 and the given (body_pitch, u, w, pitch_rate)."""
    phase = np.linspace(0.0, 1.0, SAMPLES + 1)
    start = np.concatenate([[0.0, 0.0], pitch_state])
    values = np.array([getattr(wingbeat, name) for name in free], dtype=float)
    flown = np.asarray(_fly_with_variations(model, wingbeat, values, start, phase, free=free))
    return Certificate(phase, flown[:, :6], flown[-1, 6:].reshape(6, -1))
