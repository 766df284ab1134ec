"""The curve against speed: workers solve it point by point, in the background."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from wingbeat._workers.pool import Event, Job
from wingbeat_explorer.app.formatting import number
from wingbeat_explorer.app.links import to_plain
from wingbeat_explorer.app.scenario import Scenario
from wingbeat_explorer.app.session import BUSY, Session

_ENDINGS = {
    "lost": "the solver process ended ({})",
    "late": "no result within {:g} s",
    "failed": "the solver failed ({})",
    "stopped": "the solver was stopped",
}


class Curve:
    """The points of one page's curve; `show` is called when points or state have changed."""

    def __init__(self, session: Session, show: Callable[[], Any]) -> None:
        self._session, self._show = session, show
        self._job: Job | None = None
        self._whole, self._is_paused, self._gave_way = False, False, False
        self._start_near: tuple[float, Any] | None = None
        self._waiting: list[float] = []
        self.asked: Scenario | None = None
        self.measured: list[dict[str, Any]] = []
        self.points: list[dict[str, Any]] = []
        self.state = ""

    @property
    def is_running(self) -> bool:
        """Whether points are being solved."""
        return self._job is not None or self._gave_way

    @property
    def pending(self) -> list[float]:
        """The speeds that are still to be solved [m/s]; none if nothing is being solved."""
        return sorted(self._waiting) if self.is_running else []

    @property
    def done(self) -> float:
        """The solved share of the speeds."""
        return len(self.points) / max(len(self.points) + len(self._waiting), 1)

    def is_of(self, scenario: Scenario) -> bool:
        """Return whether the curve is that of a scenario, whose speed and range do not matter."""
        return self.asked is not None and scenario.at(self.asked.speed).asks_as(self.asked)

    def suits(self, scenario: Scenario) -> bool:
        """Return whether nothing is shown that belongs to another scenario."""
        return self.asked is None or self.is_of(scenario)

    def take(self, scenario: Scenario, answer: dict[str, Any], points: list[dict[str, Any]]) -> None:
        """Show points that were solved beforehand, from every start."""
        self._whole, self.asked, self.points, self._waiting = True, scenario, list(points), []
        self.measured = answer["measured"]
        self._tell(self._summary())

    def follow(self, scenario: Scenario, answer: dict[str, Any]) -> None:
        """Begin the curve of an answer outwards from it, or go on with it after a pause."""
        if not self.is_of(scenario):
            self._begin(scenario, answer, whole=False)
        elif self._is_paused:
            self._is_paused = False
            self._next()
        self.measured = answer["measured"]

    def start(self) -> None:
        """Solve every point from every start, and from its neighbour."""
        if self._session.scenario.faults().faults:
            self._tell("Not started: a choice is invalid; see the mark beside it.")
            return
        session = self._session
        scenario, answer = session.scenario, session.answer
        if answer is not None and not scenario.at(session.answered.speed).asks_as(session.answered):
            answer = None  # of another scenario, whose measurements are of another animal
        self._begin(scenario, answer, whole=True)

    def _begin(self, scenario: Scenario, answer: dict[str, Any] | None, whole: bool) -> None:
        self.cancel()
        self._whole, self.asked, self.points = whole, scenario, []
        now = scenario.speed
        self._start_near = (now, answer.get("near")) if answer else None
        self.measured = answer["measured"] if answer else []
        speeds = scenario.speeds()
        # Outwards from the answer, so that each point has a neighbour to continue from.
        self._waiting = [speed for speed in speeds if speed >= now] + [s for s in reversed(speeds) if s < now]
        self.state = f"0 of {len(speeds)} speeds."
        self._next()

    def cancel(self) -> None:
        """Request no more points, and keep those already solved."""
        self._is_paused = False
        self._stop("Cancelled")

    def pause(self) -> None:
        """Request no more points while the page asks for another scenario; `follow` goes on if it comes back."""
        if self.is_running:
            self._is_paused = True
            self._stop("Paused")

    def _stop(self, how: str) -> None:
        if self.is_running:
            job, self._job, self._gave_way = self._job, None, False
            if job is not None:
                self._session.cancel(job)
            total = len(self.points) + len(self._waiting)
            self._tell(f"{how} after {len(self.points)} of {total} speeds.")

    def go_on(self) -> None:
        """Solve the next point if the curve gave way to a search, and this has ended."""
        if self._gave_way and self._session.rests:
            self._next()

    def _next(self) -> None:
        self._job, self._gave_way = None, False
        if not self._waiting:
            self._tell(self._summary())
            return
        if not self._session.rests:  # whoever moves the point does not wait for the curve
            self._gave_way, done = True, len(self.points)
            self._tell(f"{done} of {done + len(self._waiting)} speeds; waiting for the search to end.")
            return
        assert self.asked is not None
        speed = self._waiting[0]
        scenario = to_plain(self.asked.at(speed))
        what = {"do": "point", "scenario": scenario, "near": self._near(speed), "whole": self._whole}
        job = self._session.start(what, lambda event: self._hear(job, event), background=True)
        self._job = job
        if job is None:
            self._tell(BUSY)
        else:
            self._show()

    def _near(self, speed: float) -> dict[str, Any] | None:
        """Return the certified orbit of the nearest speed."""
        known = [(point["speed"], point["near"]) for point in self.points]
        if self._start_near is not None:
            known.append(self._start_near)
        certified = [(abs(at - speed), near) for at, near in known if near]
        return min(certified, key=lambda pair: pair[0])[1] if certified else None

    def _hear(self, job: Job | None, event: Event) -> None:
        if job is None or job is not self._job:
            return
        done = len(self.points)
        total = done + len(self._waiting)
        if event.kind == "waiting":
            self._tell(f"{done} of {total} speeds; waiting, number {event.value} in the queue.")
        elif event.kind in ("started", "progress"):
            self._tell(f"{done} of {total} speeds; solving {self._waiting[0]:g} m/s.")
        elif event.kind == "done" and "refused" not in event.value:
            self._waiting.pop(0)
            self.points = sorted([*self.points, event.value], key=lambda point: point["speed"])
            self._next()
        elif event.ends:
            self._job = None
            why = event.value["refused"][0][1] if event.kind == "done" else _ENDINGS[event.kind].format(event.value)
            self._tell(f"Stopped after {done} of {total} speeds: {why}.")

    def _tell(self, text: str) -> None:
        self.state = text
        self._show()

    def _summary(self) -> str:
        known = [p for p in self.points if p["status"] == "converged" and p["mean_positive_power"] is not None]
        gaps = len(self.points) - len(known)
        text = f"{len(known)} speeds certified" + (f", {gaps} without an orbit" if gaps else "")
        if known:
            least = min(known, key=lambda point: point["mean_positive_power"])
            power = number(least["mean_positive_power"], 3)
            text += f". Lowest power of the certified speeds: {power} W at {least['speed']:g} m/s"
        how = "solved from every start and from its neighbour" if self._whole else "continued from its neighbour"
        return f"{text}. Each speed was {how}."


def drawn(
    scenario: Scenario,
    points: Sequence[dict[str, Any]],
    answer: dict[str, Any] | None,
    measured: Sequence[dict[str, Any]],
    pending: Sequence[float] = (),
) -> dict[str, Any]:
    """Return the curve of a scenario as the face draws it.

    The points are as a worker returns them; the answer on the page is one of them, if it belongs to the curve.
    `measured` is from `measured_points`, and `pending` are the speeds that are still to be solved [m/s].
    """
    found = {point["speed"]: _drawn(point) for point in points}
    if answer is not None:
        record = answer["record"]
        at = {"speed": record["speed"], "frequency": record["wingbeat"]["frequency"]}
        one = at | {name: record[name] for name in ("status", "mean_positive_power")}
        found[record["speed"]] = _drawn(one | {"plausible": answer["plausible"]})
    in_order = [found[speed] for speed in sorted(found)]
    about = {"measured": list(measured), "pending": list(pending), "range": scenario.sweep[:2]}
    return {"points": in_order, **about}


def _drawn(point: dict[str, Any]) -> dict[str, Any]:
    return {
        "speed": point["speed"],
        "power": point["mean_positive_power"],
        "frequency": point["frequency"],
        "certified": point["status"] == "converged",
        "plausible": point["plausible"],
    }
