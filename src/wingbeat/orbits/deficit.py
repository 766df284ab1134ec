"""Which balance fails if there is no orbit, and by how much.

We look for the wingbeat, within bounds, that returns to its position and attitude and comes closest to its initial
velocity. If the mean force is too small, the velocity changes over the beat; if the mean moment is too small, the
pitch rate changes. We divide forces by the weight and moments by weight times chord, so that they can be compared.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from wingbeat.animal.kinematics import at_rest
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.orbits.changes import holds_frequency
from wingbeat.orbits.flight.period import BALANCES, CLOSURE, CLOSURE_SCALE, LIFT, MOMENT, THRUST
from wingbeat.orbits.nlp.levenberg_marquardt import least_squares

if TYPE_CHECKING:
    from wingbeat.orbits.nlp.transcription import Candidate, Transcription
    from wingbeat.orbits.options import DiagnosisOptions


@dataclass(frozen=True)
class Deficit:
    """The mean deficit of a balance over the beat; negative for an excess."""

    law: str  # ``lift`` (upward force), ``thrust`` (forward force minus drag) or ``pitching moment`` (nose up)
    share: float  # of the weight, or of weight times mean chord
    amount: float  # [N] or [N m]

    @property
    def unit(self) -> str:
        """The unit of the amount."""
        return "N m" if self.law == MOMENT else "N"

    def __str__(self) -> str:
        share = f"{float(f'{abs(100 * self.share):.2g}'):g} %"
        if self.law == LIFT:
            return f"lift is {'short' if self.share > 0 else 'too large'} by {share} of the weight"
        if self.law == THRUST:
            return f"thrust {'is short of' if self.share > 0 else 'exceeds'} drag by {share} of the weight"
        way = "nose-up" if self.share > 0 else "nose-down"
        return f"a {way} pitching moment of {abs(self.amount):.2g} N m is lacking ({share} of weight times chord)"


@dataclass(frozen=True)
class Unbalanced:
    """The beat closest to an orbit if the balances in `shares` may fail, in the optimiser's scale.

    Deficits together up to `negligible` count as zero; `keeps_the_rest` says whether all other conditions hold.
    """

    scaled: np.ndarray
    shares: dict[str, float]
    keeps_the_rest: bool
    negligible: float

    @property
    def is_excess(self) -> bool:
        """Whether a force is too large."""
        return any(self.shares.get(law, 0.0) < 0 for law in (LIFT, THRUST))

    @property
    def closes(self) -> bool:
        """Whether no balance fails and all other conditions hold."""
        return self.keeps_the_rest and self.size <= self.negligible

    @property
    def size(self) -> float:
        """Root of the sum of the squares of the shares."""
        return float(np.linalg.norm(list(self.shares.values())))


class Balance:
    """Finds the wingbeat closest to an orbit, and the mean forces and moment that it lacks."""

    def __init__(self, programme: Transcription) -> None:
        self._programme, problem = programme, programme.problem
        self._options = programme.options.diagnosis
        vehicle, gravity = problem.vehicle, max(problem.air.gravity, self._options.least_gravity)
        weight = vehicle.mass * gravity
        self.units = {THRUST: weight, LIFT: weight, MOMENT: weight * vehicle.wing.mean_chord}
        motion = motion_table(problem.model, at_rest(problem.species.wingbeat, np.zeros(1)), np.zeros(1))
        offset = sum(float(part[0]) ** 2 for part in motion.first_moment) / vehicle.mass
        # About the vehicle's own centre of mass at the top of the stroke [kg m2].
        pitch_inertia = float(vehicle.body.pitch_inertia + motion.inertia[0] - offset)
        inertias = {THRUST: vehicle.mass, LIFT: vehicle.mass, MOMENT: pitch_inertia}
        self._rows = {law: CLOSURE.index(state) for law, state in BALANCES.items()}
        # Share of the weight for a residual of 1 in the optimiser's scale, divided by the frequency.
        self._per_hertz = {
            law: inertias[law] * CLOSURE_SCALE[self._rows[law]] / self.units[law] for law in BALANCES
        }

    def nearest(
        self, scaled: np.ndarray, broken: Iterable[str] = tuple(BALANCES), evaluations: int | None = None
    ) -> Unbalanced:
        """Search from scaled unknowns for the beat closest to an orbit if only these balances may fail."""
        options, weight = self._options, self._options.violation_weight
        least = options.deficit if evaluations is None else replace(options.deficit, evaluations=evaluations)
        programme, broken = self._programme, tuple(broken)
        rows = [self._rows[law] for law in broken]
        per_hertz = np.array([self._per_hertz[law] for law in broken])
        names, scale = programme.unknowns.names, programme.unknowns.scale
        column = names.index("frequency") if "frequency" in names else None

        def weights(x: np.ndarray) -> np.ndarray:
            found = np.full(6, weight)
            found[rows] = per_hertz * programme.problem.frequency(programme.physical(x))
            return found

        def residuals(x: np.ndarray) -> np.ndarray:
            exceeded = np.minimum(programme.inequalities(x), 0.0)
            return np.concatenate([weights(x) * programme.closure(x), weight * exceeded])

        def jacobian(x: np.ndarray) -> np.ndarray:
            by_closure = weights(x)[:, None] * programme.closure_jacobian(x)
            if column is not None:
                by_closure[rows, column] += per_hertz * scale[column] * programme.closure(x)[rows]
            exceeded = programme.inequalities(x)[:, None] < 0
            return np.concatenate([by_closure, weight * exceeded * programme.inequalities_jacobian(x)])

        found = least_squares(residuals, jacobian, scaled, programme.lower, programme.upper, least)
        short = -(weights(found) * programme.closure(found))[rows]
        rest = np.abs(np.delete(programme.closure(found), rows)).max()
        keeps = max(rest, -programme.inequalities(found).min()) <= options.kept_closure
        return Unbalanced(
            found, dict(zip(broken, short.tolist(), strict=True)), bool(keeps), options.negligible_deficit
        )

    def failing(self, starts: Iterable[np.ndarray]) -> Unbalanced:
        """Return a beat that closes, or else the closest beat, in which only one balance fails if possible."""
        trial = self._options.trial_evaluations
        together: list[Unbalanced] = []
        for start in starts:
            together.append(self.nearest(start, evaluations=trial))
            if together[-1].closes:
                return together[-1]
        best = self.nearest(min(together, key=lambda c: (not c.keeps_the_rest, c.size)).scaled)
        if best.closes:
            return best
        for evaluations in (trial, None):
            alone = [self.nearest(best.scaled, [law], evaluations) for law in BALANCES]
            if keeping := [c for c in alone if c.keeps_the_rest]:
                # An excess of force comes last: it can mostly be removed at the expense of another balance.
                least = min(keeping, key=lambda c: (c.is_excess, c.size))
                return self.nearest(least.scaled, least.shares)
        return best

    def deficits(self, beat: Unbalanced) -> tuple[Deficit, ...]:
        """Return the deficits of a beat, the largest first."""
        shares = sorted(beat.shares.items(), key=lambda item: -abs(item[1]))
        return tuple(Deficit(law, share, share * self.units[law]) for law, share in shares)


@dataclass(frozen=True)
class Nearest:
    """The closest wingbeat, in the optimiser's scale, and its deficits, the largest first."""

    scaled: np.ndarray
    deficits: tuple[Deficit, ...]
    closes: bool


def nearest_beat(programme: Transcription, found: Sequence[Candidate]) -> Nearest:
    """Return the closest wingbeat; the search for it starts where the local searches ended."""
    balance, options = Balance(programme), programme.options.diagnosis
    apart, ends = options.ends_apart * (programme.upper - programme.lower), []
    for end in (c.scaled for c in sorted(found, key=lambda c: c.violation)):
        if len(ends) < options.nearest_ends and all((np.abs(end - other) > apart).any() for other in ends):
            ends.append(end)
    beat = balance.failing(ends)
    return Nearest(beat.scaled, balance.deficits(beat), beat.closes)


def is_clear(nearest: Nearest, options: DiagnosisOptions) -> bool:
    """Return whether the closest wingbeat misses a balance by so much that more starts hardly find an orbit."""
    return not nearest.closes and max(abs(deficit.share) for deficit in nearest.deficits) >= options.clear_deficit


def words_of(programme: Transcription, nearest: Nearest) -> str:
    """Return the deficits of the closest wingbeat as part of a sentence."""
    problem, deficits = programme.problem, nearest.deficits
    words = [
        str(d) for d in deficits if abs(d.share) >= programme.options.diagnosis.mentioned * abs(deficits[0].share)
    ]
    inner = programme.inner_start(nearest.scaled)
    if problem.species.wingbeat.pitch_hinge is not None and (inner is None or not inner.repeats):
        # Deficits of a beat that no other follows mean nothing.
        words = ["the pitch of the wings does not repeat after a beat: spring and damper of the hinge are too weak"]
    place = f"at {problem.speed:g} m/s" if problem.speed else "in hover"
    place += f" and {problem.species.wingbeat.frequency:.3g} Hz" if holds_frequency(problem) else ""
    limits = ", ".join(str(c) for c in problem.subject_to)
    return f"{place}{f' with {limits}' if limits else ''}, {' and '.join(words)}"


def bounds_near(programme: Transcription, scaled: np.ndarray) -> Iterator[tuple[str, str]]:
    """Yield (name, sign) of each bound, and of each limit along the path, that a beat is near."""
    share = programme.options.diagnosis.near_bound
    names, reach = programme.unknowns.names, share * (programme.upper - programme.lower)
    for name, x, low, high, near in zip(names, scaled, programme.lower, programme.upper, reach, strict=False):
        if name in programme.problem.free:
            if x - low <= near:
                yield name, ">="
            if high - x <= near:
                yield name, "<="
    path = zip(programme.path_limits, programme.inequalities(scaled), strict=False)
    yield from dict.fromkeys(limit for limit, inside in path if inside <= share)
