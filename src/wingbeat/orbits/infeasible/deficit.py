"""Which law of balance fails where there is no orbit, and by how much.

Of all beats within the bounds, that is sought whose end misses its start by velocities alone, and by as little as
can be. A force that is short on average changes the velocity over the beat, a moment the pitch rate; told as shares
of the weight, and of weight times chord, the two can be compared.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from wingbeat._jax.config import jnp
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.orbits.nlp.levenberg_marquardt import least_misses
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.problem import CLOSURE, CLOSURE_SCALE, OrbitProblem

THRUST, LIFT, MOMENT = "thrust", "lift", "pitching moment"
LAWS = (THRUST, LIFT, MOMENT)
# The state that does not return where a law fails.
_STATES = {THRUST: "u", LIFT: "w", MOMENT: "pitch_rate"}
# A miss that no law excuses, of 1 in the optimiser's scale, weighs as much as so many weights that are short.
_WEIGHT = 100.0
# Flights of an elastic solve at most, and those after which the best of several goes on alone; the share by which
# its last step lessens the squares.
_EVALUATIONS, _TRIAL = 150, 25
_SETTLED = 1e-5
# The least gravity that gives a weight to compare forces with [m/s2]; without one nothing is a share of it.
_LEAST_GRAVITY = 1e-3
# A miss that is none, in the optimiser's scale, and a share that is none.
_KEPT = 1e-3
NOTHING = 1e-3


@dataclass(frozen=True)
class Shortage:
    """What is short of a balance on average over the beat; negative where there is too much.

    Parameters
    ----------
    law : ``lift`` (upward force), ``thrust`` (forward force, drag taken off) or ``pitching moment`` (nose up).
    share : of the weight, or of weight times mean chord.
    amount : [N] or [N m].
    """

    law: str
    share: float
    amount: float

    @property
    def unit(self) -> str:
        """The unit of the amount."""
        return "N m" if self.law == MOMENT else "N"

    def __str__(self) -> str:
        share = f"{float(f'{abs(100 * self.share):.2g}'):g} %"
        if self.law == LIFT:
            return f"lift is {share} of the weight {'short' if self.share > 0 else 'too much'}"
        if self.law == THRUST:
            return f"thrust is {'short of drag' if self.share > 0 else 'more than drag'} by {share} of the weight"
        way = "nose-up" if self.share > 0 else "nose-down"
        return f"a {way} pitching moment of {abs(self.amount):.2g} N m is lacking ({share} of weight times chord)"


@dataclass(frozen=True)
class Closest:
    """The beat that comes closest to an orbit with some laws broken, in the optimiser's scale, and the shares."""

    scaled: np.ndarray
    shares: dict[str, float]
    keeps_the_rest: bool

    @property
    def is_excess(self) -> bool:
        """Whether a force is too large, not too small."""
        return any(self.shares.get(law, 0.0) < 0 for law in (LIFT, THRUST))

    @property
    def closes(self) -> bool:
        """Whether nothing is short at all."""
        return self.keeps_the_rest and self.size <= NOTHING

    @property
    def size(self) -> float:
        """Root of the sum of the squares of the shares."""
        return float(np.linalg.norm(list(self.shares.values())))


class Balance:
    """Closeness to an orbit, in shares of the weight."""

    def __init__(self, programme: Transcription) -> None:
        self._programme, problem = programme, programme.problem
        vehicle, gravity = problem.vehicle, max(problem.air.gravity, _LEAST_GRAVITY)
        weight = vehicle.mass * gravity
        self.units = {THRUST: weight, LIFT: weight, MOMENT: weight * vehicle.wing.mean_chord}
        inertias = {THRUST: vehicle.mass, LIFT: vehicle.mass, MOMENT: _pitch_inertia(problem)}
        self._rows = {law: CLOSURE.index(state) for law, state in _STATES.items()}
        # Times the frequency, the share that a miss of 1 in the optimiser's scale stands for.
        self._per_hertz = {law: inertias[law] * CLOSURE_SCALE[self._rows[law]] / self.units[law] for law in LAWS}

    def closest(self, scaled: np.ndarray, broken: Iterable[str] = LAWS, evaluations: int = _EVALUATIONS) -> Closest:
        """Return the beat near a place of the search that comes closest to an orbit, only these laws broken."""
        programme, broken = self._programme, tuple(broken)
        rows = [self._rows[law] for law in broken]
        per_hertz = np.array([self._per_hertz[law] for law in broken])
        names, scale = programme.unknowns.names, programme.unknowns.scale
        column = names.index("frequency") if "frequency" in names else None

        def weights(x: np.ndarray) -> np.ndarray:
            found = np.full(6, _WEIGHT)
            found[rows] = per_hertz * programme.problem.frequency(programme.physical(x))
            return found

        def misses(x: np.ndarray) -> np.ndarray:
            broken_limits = np.minimum(programme.margins(x), 0.0)
            return np.concatenate([weights(x) * programme.closure(x), _WEIGHT * broken_limits])

        def jacobian(x: np.ndarray) -> np.ndarray:
            by_closure = weights(x)[:, None] * programme.closure_jacobian(x)
            if column is not None:
                by_closure[rows, column] += per_hertz * scale[column] * programme.closure(x)[rows]
            passed = programme.margins(x)[:, None] < 0
            return np.concatenate([by_closure, _WEIGHT * passed * programme.margins_jacobian(x)])

        found = least_misses(misses, jacobian, scaled, programme.lower, programme.upper, evaluations, _SETTLED)
        short = -(weights(found) * programme.closure(found))[rows]
        rest = np.abs(np.delete(programme.closure(found), rows)).max()
        keeps = max(rest, -programme.margins(found).min()) <= _KEPT
        return Closest(found, dict(zip(broken, short.tolist(), strict=True)), bool(keeps))

    def failing(self, starts: Iterable[np.ndarray]) -> Closest:
        """Return a beat that closes, or the closest with the one law broken that alone will do, or with all.

        Of several laws that each will do, that which is broken least; but a force too large only where no shortage
        will do, for what is too much can mostly be spilled, and is then the price of another law.
        """
        together: list[Closest] = []
        for start in starts:
            together.append(self.closest(start, evaluations=_TRIAL))
            if together[-1].closes:
                return together[-1]
        best = self.closest(min(together, key=lambda c: (not c.keeps_the_rest, c.size)).scaled)
        if best.closes:
            return best
        for evaluations in (_TRIAL, _EVALUATIONS):
            alone = [self.closest(best.scaled, [law], evaluations) for law in LAWS]
            if keeping := [c for c in alone if c.keeps_the_rest]:
                least = min(keeping, key=lambda c: (c.is_excess, c.size))
                return self.closest(least.scaled, least.shares)
        return best

    def shortages(self, closest: Closest) -> tuple[Shortage, ...]:
        """Return what is short at a beat, the most first."""
        shares = sorted(closest.shares.items(), key=lambda item: -abs(item[1]))
        return tuple(Shortage(law, share, share * self.units[law]) for law, share in shares)


def _pitch_inertia(problem: OrbitProblem) -> float:
    """Return the moment of inertia about the vehicle's own centre of mass at the top of the stroke [kg m2]."""
    motion = motion_table(problem.model, problem.species.wingbeat, jnp.zeros(1))
    first = [float(part[0]) for part in motion.first_moment]
    offset = sum(part**2 for part in first) / problem.vehicle.mass
    return float(problem.vehicle.body.pitch_inertia + motion.inertia[0] - offset)
