"""The driver of a study: it hands out points without a result, and saves each result before it waits for more."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from wingbeat.studies.units import CERTIFIED, FAILED, Outcome, Unit, Waiting, failed

if TYPE_CHECKING:
    from wingbeat.studies.engine import Ended, Engine
    from wingbeat.studies.stopping import Stop
    from wingbeat.studies.store import Store

# Seconds of work in a batch: much longer than handing it out takes, but short for a waiting user.
_BATCH_SECONDS = 1.5
_MOST = 256
# How many processes may be lost on a point before the point is given up, by the way in which they ended. A kill
# from outside is not the point's fault, and is unlikely to hit the same point three times.
_TRIES = {"crashed": 3, "timeout": 2}


@dataclass
class Tally:
    """The progress of a run: points of the study, how many have each status, and how many this run has solved."""

    total: int
    counts: dict[str, int]
    here: int = 0
    begun: float = field(default_factory=time.monotonic)
    first: tuple[int, float] | None = None  # how many points ended first, together, and when, on the same clock

    @property
    def done(self) -> int:
        """Number of points with a result."""
        return sum(self.counts.values()) - self.count("waiting")

    def count(self, *statuses: str) -> int:
        """Return the number of points with one of these statuses."""
        return sum(self.counts.get(status, 0) for status in statuses)

    @property
    def certified(self) -> int:
        """Number of points with a certified orbit."""
        return self.count(CERTIFIED)

    @property
    def failed(self) -> int:
        """Number of points on which the search gave no result: errors, crashes, time-outs."""
        return self.count(*FAILED)

    @property
    def rate(self) -> float:
        """Points solved per second in this run."""
        return self.here / max(time.monotonic() - self.begun, 1e-9)

    @property
    def seconds_left(self) -> float | None:
        """Seconds left, from the points solved after the first ones, which also compile programs; None before."""
        if self.first is None or self.here <= self.first[0]:
            return None
        each = (time.monotonic() - self.first[1]) / (self.here - self.first[0])
        return (self.total - self.done) * each

    def add(self, outcomes: list[Outcome]) -> None:
        """Count new outcomes of waiting points."""
        for outcome in outcomes:
            self.counts[outcome.status] = self.count(outcome.status) + 1
        self.here += len(outcomes)
        if self.first is None and self.here:
            self.first = self.here, time.monotonic()
        self.counts["waiting"] = self.count("waiting") - len(outcomes)


Progress = Callable[[Tally], None]


class _Job(NamedTuple):
    """A unit to solve: which of its points are wanted, and how often its process was lost."""

    unit: Unit
    wanted: frozenset[str]
    losses: int = 0


class _Queue:
    """Jobs in the order in which the engine gets them: first lost ones, one by one, then those of the plan."""

    def __init__(self, waiting: Iterator[Waiting], engine: Engine, points: int) -> None:
        self._waiting = waiting
        self.lost: deque[_Job] = deque()
        self._engine = engine
        self._left = points
        self._seconds: float | None = None

    def learn(self, points: int, seconds: float) -> None:
        """Record the times that points took."""
        if points:
            mean = seconds / points
            self._seconds = mean if self._seconds is None else 0.7 * self._seconds + 0.3 * mean

    def take(self) -> list[_Job]:
        """Return the next batch; it is empty if no job waits."""
        if self.lost:
            return [self.lost.popleft()]
        # Small batches first, to see how long a point takes; small batches last, so that all processes end
        # together.
        wanted = 1 if self._seconds is None else _BATCH_SECONDS / max(self._seconds, 1e-6)
        wanted = max(1, min(wanted, _MOST, self._left / (2 * self._engine.workers)))
        batch: list[_Job] = []
        while sum(len(job.unit.tasks) for job in batch) < int(wanted):
            if (found := next(self._waiting, None)) is None:
                break
            batch.append(_Job(found.unit, frozenset(found.wanted)))
            self._left -= len(found.wanted)
        return batch


def drive(
    store: Store, engine: Engine, stop: Stop, progress: Progress | None = None, retry_failed: bool = False
) -> Tally:
    """Solve all points of a store that have no result yet, and save the results of each batch as soon as it ends.

    This is the only writer of the store. The engine is always closed at the end.
    """
    run = store.begin_run()
    counts = store.counts()
    tally = Tally(sum(counts.values()), counts)
    if retry_failed:
        for status in FAILED:
            counts["waiting"] = counts.get("waiting", 0) + counts.pop(status, 0)
    jobs = _Queue(store.waiting(run if retry_failed else 0), engine, counts.get("waiting", 0))
    flying: dict[int, list[_Job]] = {}
    number = 0
    try:
        stop.driving = True
        while True:
            while stop.level == 0 and engine.free > 0 and (batch := jobs.take()):
                number += 1
                flying[number] = batch
                engine.submit(number, [job.unit for job in batch])
            if not flying or stop.due:
                break
            ended = engine.wait(0.2)
            if ended is not None:
                batch = flying.pop(ended.batch)
                jobs.learn(len(ended.outcomes), sum(outcome.seconds for outcome in ended.outcomes))
                wanted = frozenset().union(*(job.wanted for job in batch))
                outcomes = [outcome for outcome in ended.outcomes if outcome.key in wanted]
                if ended.lost is not None:
                    given_up, again = _after_loss(ended, ended.lost, batch)
                    outcomes += given_up
                    jobs.lost.extend(again)
                store.save(outcomes, ended.worker, 1 + max(job.losses for job in batch), run)
                tally.add(outcomes)
            if progress is not None:
                progress(tally)
    finally:
        stop.driving = False
        engine.close()
    return tally


def _after_loss(ended: Ended, how: str, batch: list[_Job]) -> tuple[list[Outcome], list[_Job]]:
    """Return the points to give up, because they were lost too often, and the jobs to retry.

    The first point without a report is blamed. If an engine reports no points before a batch ends, each unit is
    first retried in a separate process; only then is a unit blamed.
    """
    told = {outcome.key for outcome in ended.outcomes}
    given_up: list[Outcome] = []
    again: list[_Job] = []
    blamed = not ended.told and len(batch) > 1
    for job in batch:
        left = [task.key for task in job.unit.tasks if task.key not in told and task.key not in job.unit.skip]
        if not left:
            continue
        if blamed:
            # All points of a chain are asked for again, because each answer depends on the one before it.
            again.append(job._replace(wanted=job.wanted - told))
            continue
        blamed = True
        if job.losses + 1 < _TRIES[how]:
            again.append(job._replace(wanted=job.wanted - told, losses=job.losses + 1))
            continue
        at_fault = left[:1] if ended.told else left
        given_up += [failed(key, how, ended.text) for key in at_fault if key in job.wanted]
        if rest := job.wanted - told - set(at_fault):
            again.append(_Job(job.unit._replace(skip=(*job.unit.skip, *at_fault)), rest))
    return given_up, again
