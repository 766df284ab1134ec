"""Modes of a disturbed flight: what grows or decays from beat to beat, how fast, and what moves in each.

The disturbances are of (body_pitch, u, w, pitch_rate). Modes are those of the map over a beat, or those of the
averaged model, whose rates are linear with the mean over the beat of their derivatives.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import Report, Reported
from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import FlightModel, body_rates, motion_table
from wingbeat.orbits.flight.period import PITCH_STATE
from wingbeat.stability.reports import mode_report

if TYPE_CHECKING:
    from wingbeat._jax.arrays import PitchState, RatesByState, Samples

# A multiplier whose imaginary part is below this share of its modulus is real.
_REAL = 1e-9


@dataclass(frozen=True)
class Mode(Reported):
    """One mode of a disturbed flight: its disturbance is multiplied by the same number in each beat.

    Attributes
    ----------
    kind : ``divergence`` grows and ``subsidence`` decays without oscillating; an ``oscillation`` has a pair of
        complex multipliers; a ``flip`` changes sign every beat.
    multiplier : Floquet multiplier; of a complex pair, the one with positive imaginary part.
    time_to_double, time_to_half : [s]; None for the one that does not apply.
    period : of an oscillation, or of a flip, which takes two beats [s]; None for others. The map gives the
        frequency of an oscillation only up to multiples of the wingbeat frequency; this is the longest period.
    damping : damping ratio of an oscillation or of a flip, negative if it grows; None for others.
    disturbance : of (body_pitch, u, w, pitch_rate) at phase 0, shape (4,). Its length is 1 in the scales of
        `modes_of`.
    shares : mean size over the beat of each of the four numbers, without growth and decay, as a share of their sum.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> fastest = wb.linearise(orbit).modes[0]
    >>> fastest.kind, round(fastest.time_to_double, 2)  # it doubles in so many seconds
    ('divergence', 0.24)
    """

    kind: str
    multiplier: complex
    time_to_double: float | None
    time_to_half: float | None
    period: float | None
    damping: float | None
    disturbance: np.ndarray
    shares: dict[str, float]

    def _report(self) -> Report:
        return mode_report(self.record())

    def record(self) -> dict[str, Any]:
        """Return the mode as a JSON-able dictionary; complex numbers become pairs."""
        return {
            "kind": self.kind,
            "multiplier": [self.multiplier.real, self.multiplier.imag],
            "modulus": abs(self.multiplier),
            "time_to_double": self.time_to_double,
            "time_to_half": self.time_to_half,
            "period": self.period,
            "damping": self.damping,
            "disturbance": [[value.real, value.imag] for value in self.disturbance.tolist()],
            "shares": self.shares,
        }


def modes_of(monodromy: np.ndarray, frequency: float, transition: np.ndarray, scales: np.ndarray) -> list[Mode]:
    """Return the modes of a map from beat to beat, the fastest growing first.

    `monodromy` is the derivative of the state after a beat by that before it, `transition` the same at equal
    phases from 0 to 1, shape (K, 4, 4); `scales` are disturbances that count as equally large.

    Theory: equation ``mode-rates``.
    """
    multipliers, vectors = np.linalg.eig(monodromy)
    found = []
    for i in np.lexsort((-np.imag(multipliers), -np.round(np.abs(multipliers), 12))):
        multiplier, vector = complex(multipliers[i]), vectors[:, i].astype(complex)
        if multiplier.imag < -_REAL * abs(multiplier):
            continue
        vector = vector / np.linalg.norm(vector / scales)
        found.append(_mode(multiplier, frequency, vector, _shares(multiplier, transition @ vector, scales)))
    return found


def _mode(multiplier: complex, frequency: float, disturbance: np.ndarray, shares: dict[str, float]) -> Mode:
    size = abs(multiplier)
    swings = abs(multiplier.imag) > _REAL * size
    if swings:
        kind = "oscillation"
    elif multiplier.real < 0:
        kind = "flip"
    else:
        kind = "divergence" if size > 1 else "subsidence"
    rate = frequency * math.log(size) if size > 0 else -math.inf
    turn = frequency * abs(cmath.phase(multiplier))
    turns = kind in ("oscillation", "flip")
    return Mode(
        kind,
        multiplier,
        math.log(2) / rate if rate > 0 else None,
        -math.log(2) / rate if rate < 0 else None,
        2 * math.pi / turn if turns else None,
        -rate / math.hypot(rate, turn) if turns and math.isfinite(rate) else None,
        disturbance,
        shares,
    )


def _shares(multiplier: complex, path: np.ndarray, scales: np.ndarray) -> dict[str, float]:
    """Return the mean size of each number over the beat, without growth and decay, as a share of their sum.

    Theory: equation ``mode-shares``.
    """
    decay = cmath.log(multiplier) if multiplier else 0.0
    steady = path * np.exp(-decay * np.linspace(0.0, 1.0, len(path)))[:, None]
    sizes = np.abs(steady / scales)[:-1].mean(axis=0)
    return dict(zip(PITCH_STATE, (sizes / sizes.sum()).tolist(), strict=True))


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

    `path` holds the states at equal phases from 0 to 1, shape (K, 4). Theory: equation ``averaged-model``.
    """
    phase = np.linspace(0.0, 1.0, len(path))[:-1]
    return np.asarray(_rates_by_state.bind(model, wingbeat)(phase, path[:-1].T)).mean(axis=-1).T


def averaged_modes(rates: np.ndarray, frequency: float, samples: int, scales: np.ndarray) -> list[Mode]:
    """Return the modes of steady rates whose derivatives by the state are `rates`, shape (4, 4) [per s].

    Theory: equation ``averaged-model``.
    """
    from scipy.linalg import expm

    transition = np.stack([expm(rates * phase / frequency) for phase in np.linspace(0.0, 1.0, samples)])
    return modes_of(transition[-1], frequency, transition, scales)
