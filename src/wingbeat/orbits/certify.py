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
from wingbeat.kinematics import Wingbeat
from wingbeat.model import FlightModel
from wingbeat.stored import stored

SAMPLES = 256


@dataclass(frozen=True)
class Certificate:
    """One period flown by the certifier: phases (K,), states (K, 6), and the monodromy matrix (4, 4)."""

    phase: np.ndarray
    states: np.ndarray
    monodromy: np.ndarray

    @property
    def end(self) -> np.ndarray:
        """The state at the end of the period."""
        return self.states[-1]

    @property
    def multipliers(self) -> np.ndarray:
        """Floquet multipliers of (body_pitch, u, w, pitch_rate), largest modulus first."""
        if not np.isfinite(self.monodromy).all():
            return np.full(4, np.nan + 0j)
        found = np.linalg.eigvals(self.monodromy)
        return found[np.lexsort((-found.imag, -found.real, -np.round(np.abs(found), 9)))]


@stored
def _fly_with_variations(model: FlightModel, wingbeat: Wingbeat, start: Any, phases: Any) -> Any:
    def rates(phase: Any, state: Any, args: tuple[FlightModel, Wingbeat]) -> Any:
        flown, beat = args

        def body(pitch_state: Any) -> Any:
            place = jnp.zeros(2)  # nothing depends on where the vehicle is
            return state_rates(flown, beat, phase, jnp.concatenate([place, pitch_state])) / beat.frequency

        value, along = jax.linearize(body, state[2:6])
        varied = jax.vmap(along, in_axes=1, out_axes=1)(state[6:].reshape(4, 4))
        return jnp.concatenate([value, varied[2:].ravel()])

    first = jnp.concatenate([start, jnp.eye(4).ravel()])
    return integrate(rates, first, phases, (model, wingbeat))


def certify(model: FlightModel, wingbeat: Wingbeat, pitch_state: np.ndarray) -> Certificate:
    """Fly one period from x = z = 0 and the given (body_pitch, u, w, pitch_rate)."""
    phase = np.linspace(0.0, 1.0, SAMPLES + 1)
    start = np.concatenate([[0.0, 0.0], pitch_state])
    flown = np.asarray(_fly_with_variations(model, wingbeat, start, phase))
    return Certificate(phase, flown[:, :6], flown[-1, 6:].reshape(4, 4))
