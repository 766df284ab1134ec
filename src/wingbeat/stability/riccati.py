"""Linear feedback of a linear map from beat to beat: its gains, its closed loop, and what its inputs reach."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wingbeat._base import FaultList

# Modes whose modulus is within this of 1 neither grow nor decay.
_NEUTRAL = 1e-6
# Periods after which the cost to go repeats itself; some dozens are enough.
_MOST_PERIODS = 10_000


class Reach(NamedTuple):
    """What inputs do to one mode.

    Attributes
    ----------
    kind : of the mode, as in `Mode`; ``height`` for the height, which alone has no effect on the flight.
    multiplier : of the mode; of a pair the one with positive imaginary part.
    effects : how far a unit of each input moves the mode's own coordinate in a beat, in units (the test of Popov,
        Belevitch and Hautus, input by input); 0 if the input does not reach the mode.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> reach = wb.feedback(orbit).controllability[0]
    >>> reach.kind, max(reach.effects, key=reach.effects.get)
    ('divergence', 'flap_amplitude')
    """

    kind: str
    multiplier: complex
    effects: dict[str, float]

    @property
    def persists(self) -> bool:
        """Whether the mode does not decay by itself."""
        return abs(self.multiplier) >= 1.0 - _NEUTRAL


def reaches(A: np.ndarray, B: np.ndarray, inputs: tuple[str, ...], kinds: dict[complex, str]) -> tuple[Reach, ...]:
    """Return what inputs do to each mode of a map in units, the fastest growing first. Theory: equation ``reach``.

    `kinds` are those of modes by their multipliers; the nearest one counts.
    """
    multipliers, left = np.linalg.eig(A.T)
    found = []
    for i in np.argsort(-np.abs(multipliers), kind="stable"):
        multiplier = complex(multipliers[i])
        if multiplier.imag < -1e-12:
            continue
        vector = left[:, i] / np.linalg.norm(left[:, i])
        nearest = min(kinds, key=lambda known: abs(known - multiplier))
        effects = dict(zip(inputs, np.abs(vector @ B).tolist(), strict=True))
        found.append(Reach(kinds[nearest], multiplier, effects))
    return tuple(found)


def check_reach(faults: FaultList, modes: tuple[Reach, ...], inputs: tuple[str, ...], least: float) -> None:
    """Note modes that do not decay and that no input reaches with an effect above the least."""
    for mode in modes:
        if mode.persists and max(mode.effects.values()) <= least:
            rule = f"reach no {mode.kind} with multiplier {mode.multiplier:.3g}, which does not decay by itself"
            faults.add("inputs", list(inputs), rule, "add an input such as pitch_mean")


def sufficient(modes: tuple[Reach, ...], inputs: tuple[str, ...], least: float) -> tuple[str, ...]:
    """Return every input that alone reaches all modes that do not decay."""
    lasting = [mode.effects for mode in modes if mode.persists]
    return tuple(name for name in inputs if all(effects[name] > least for effects in lasting))


def delayed(A: np.ndarray, B: np.ndarray, delay: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the map whose inputs act some beats later; its state has the pending inputs behind, the oldest first.

    Theory: equation ``delayed-map``.
    """
    if delay == 0:
        return A, B
    order, count = B.shape
    whole = order + delay * count
    later, entering = np.zeros((whole, whole)), np.zeros((whole, count))
    later[:order, :order] = A
    later[:order, order : order + count] = B
    later[order:-count, order + count :] = np.eye((delay - 1) * count)
    entering[-count:] = np.eye(count)
    return later, entering


def linear_quadratic(
    A: np.ndarray, B: np.ndarray, state_cost: np.ndarray, input_cost: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the gains K with which ``y = -K x`` has the least cost over all beats, and the matrix P.

    The cost of a beat is ``x' Q x + y' R y``, the cost to go ``x' P x``. Theory: equation ``riccati``.
    """
    from scipy.linalg import solve_discrete_are

    cost = solve_discrete_are(A, B, state_cost, input_cost)
    return np.linalg.solve(input_cost + B.T @ cost @ B, B.T @ cost @ A), cost


def periodic_linear_quadratic(
    A: np.ndarray, B: np.ndarray, state_cost: np.ndarray, input_cost: np.ndarray
) -> np.ndarray:
    """Return gains of each of M maps that follow each other periodically, shape (M, m, n).

    The Riccati equation is stepped back through the maps until the cost to go repeats itself.

    Theory: equation ``periodic-riccati``.
    """
    cost, gains = state_cost.copy(), np.zeros((len(A), B.shape[2], A.shape[1]))
    for _ in range(_MOST_PERIODS):
        before = cost
        for j in range(len(A) - 1, -1, -1):
            gains[j] = np.linalg.solve(input_cost + B[j].T @ cost @ B[j], B[j].T @ cost @ A[j])
            cost = state_cost + A[j].T @ cost @ (A[j] - B[j] @ gains[j])
            cost = 0.5 * (cost + cost.T)
        if np.abs(cost - before).max() <= 1e-12 * np.abs(cost).max():
            break
    return gains


def periodic_kalman(A: np.ndarray, C: np.ndarray, unknown: np.ndarray, error: np.ndarray) -> np.ndarray:
    """Return the gains of a Kalman filter for M maps that follow each other periodically, shape (M, n, readings).

    `unknown` has the covariance of what moves the state beside the map, shape (M, n, n), `error` that of readings
    ``C x``. The covariance of the prediction is stepped on through the maps until it repeats itself.

    Theory: equation ``periodic-kalman``.
    """
    spread, gains = np.mean(unknown, axis=0), np.zeros((len(A), A.shape[1], len(C)))
    for _ in range(_MOST_PERIODS):
        before = spread
        for j in range(len(A)):
            gains[j] = np.linalg.solve(error + C @ spread @ C.T, C @ spread).T
            spread = A[j] @ (spread - gains[j] @ C @ spread) @ A[j].T + unknown[j]
            spread = 0.5 * (spread + spread.T)
        if np.abs(spread - before).max() <= 1e-10 * np.abs(spread).max():
            break
    return gains


def gains_along(
    A: Sequence[np.ndarray], B: Sequence[np.ndarray], state_cost: np.ndarray, input_cost: np.ndarray, delay: int = 0
) -> np.ndarray:
    """Return gains of each of K + 1 maps that follow each other, the last for ever; shape (K + 1, m, n + delay m).

    The last map has the gains of `linear_quadratic`; the Riccati equation is stepped back from its cost to go.

    Theory: equation ``riccati-along``.
    """
    maps = [delayed(one, entering, delay) for one, entering in zip(A, B, strict=True)]
    order, whole = len(state_cost), len(maps[-1][0])
    costs = np.zeros((whole, whole))
    costs[:order, :order] = state_cost
    last, cost = linear_quadratic(*maps[-1], costs, input_cost)
    gains = [last]
    for later, entering in reversed(maps[:-1]):
        gain = np.linalg.solve(input_cost + entering.T @ cost @ entering, entering.T @ cost @ later)
        cost = costs + later.T @ cost @ (later - entering @ gain)
        cost = 0.5 * (cost + cost.T)
        gains.append(gain)
    return np.array(gains[::-1])


def multipliers_over(maps: Sequence[np.ndarray]) -> np.ndarray:
    """Return the multipliers of maps that follow each other in a beat, the largest first."""
    whole = np.eye(len(maps[0]))
    for one in maps:
        whole = one @ whole
    found = np.linalg.eigvals(whole)
    return found[np.argsort(-np.abs(found), kind="stable")]


def closed_loop(A: np.ndarray, B: np.ndarray, gains: np.ndarray, delay: int, late: int = 0) -> np.ndarray:
    """Return the map of the state and all pending inputs with feedback, `late` beats beyond the delay of its gains.

    Theory: equation ``closed-loop``.
    """
    order, count = B.shape
    later, entering = delayed(A, B, delay + late)
    known = [*range(order), *range(order + late * count, order + (late + delay) * count)]
    taken = np.zeros((count, len(later)))
    taken[:, known] = gains
    return later - entering @ taken
