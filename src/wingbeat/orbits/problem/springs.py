"""Springs at the flap hinges: the power that they leave to the actuators, and the best springs for a given beat.

A linear spring between body and arm gives the torque ``-k (flap - rest)``, for both wings together. The spring's
net work over a closed beat is zero, so it moves power from phases with too much power to phases with too little.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import jax, jnp
from wingbeat.animal.actuators import spring_torque
from wingbeat.orbits.flight.beat import Beat, mean_positive

# With a rest angle farther away, a spring is in effect a constant torque.
_FARTHEST_REST = math.pi


@dataclass(frozen=True)
class SpringCost:
    """The actuators' mean positive power with flap springs that by default exert no torque in mid-stroke."""

    stiffness: float
    rest_angle: float | None = None

    def __call__(self, beat: Beat) -> Any:
        """Return this power for a beat [W]."""
        rest = beat.mean(beat.flap) if self.rest_angle is None else self.rest_angle
        torque = spring_torque(self.stiffness, beat.flap, rest)
        return beat.mean_positive(beat.hinge_power - torque * beat.flap_rate)


class Spring(NamedTuple):
    """Both flap springs together: stiffness [N m/rad], rest angle [rad], and the actuators' remaining power [W].

    Stiffness 0 means no spring; the rest angle is then None.
    """

    stiffness: float
    rest_angle: float | None
    mean_positive_power: float


@jax.jit
def _left(spring: Any, flap: Any, flap_rate: Any, power: Any) -> Any:
    """Return the mean positive power left by a spring ``(k, k rest)``, and its derivative."""

    def left(k: Any, preload: Any) -> Any:
        return mean_positive(power + (k * flap - preload) * flap_rate)

    return jax.value_and_grad(lambda s: left(s[0], s[1]))(spring)


def best_spring(flap: Any, flap_rate: Any, hinge_power: Any) -> Spring:
    """Return the springs with which the actuators need the least mean positive power, for one closed beat.

    The power is linear in stiffness and in stiffness times rest angle, so its mean positive part is convex in both,
    and SciPy's SLSQP finds the global minimum. If many springs are equally good, it returns one of them. The rest
    angle stays within half a turn.

    Parameters
    ----------
    flap, flap_rate, hinge_power : at equal phases from 0 to 1, both ends included [rad, rad/s, W].

    >>> phase = np.linspace(0.0, 1.0, 257)
    >>> flap, rate = np.cos(2 * np.pi * phase), -2 * np.pi * np.sin(2 * np.pi * phase)
    >>> best = best_spring(flap, rate, -3.0 * (flap - 0.2) * rate)
    >>> round(best.stiffness, 2), round(best.rest_angle, 2)
    (3.0, 0.2)
    """
    from scipy.optimize import minimize

    series = tuple(np.asarray(a, dtype=float) for a in (flap, flap_rate, hinge_power))
    without = float(mean_positive(series[2], np))
    # Scale: the stiffness of a spring that alone would take up a torque typical of this power.
    rate = np.abs(series[1]).max()
    size = np.abs(series[2]).max() / (rate * np.ptp(series[0])) if rate > 0.0 else 0.0
    if size == 0.0 or without == 0.0:
        return Spring(0.0, None, without)

    def left(scaled: np.ndarray) -> tuple[float, np.ndarray]:
        value, slope = _left(jnp.asarray(scaled * size), *series)
        return float(value) / without, np.asarray(slope) * size / without

    farthest = np.array([[_FARTHEST_REST, -1.0], [_FARTHEST_REST, 1.0]])
    found = minimize(
        left,
        np.zeros(2),
        jac=True,
        method="SLSQP",
        bounds=[(0.0, None), (None, None)],
        constraints={"type": "ineq", "fun": lambda s: farthest @ s, "jac": lambda s: farthest},
        options={"ftol": 1e-14, "maxiter": 300},
    )
    stiffness, preload = found.x * size
    if found.fun >= 1.0 or stiffness <= 0.0:
        return Spring(0.0, None, without)
    return Spring(float(stiffness), float(preload / stiffness), float(found.fun) * without)
