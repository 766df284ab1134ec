"""The curve against speed. Workers solve it point by point; it can wait in the queue and be cancelled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from nicegui import ui

from wingbeat.app.curve_chart import chart
from wingbeat.app.formatting import number
from wingbeat.app.links import to_plain
from wingbeat.app.scenario import Scenario
from wingbeat.app.session import BUSY, Session
from wingbeat.app.widgets import Field, box, button, number_field, set_class, tag
from wingbeat.workers.fair_pool import Event, Job

_SWEEP = ("from", "to", "step")
_ENDINGS = {
    "lost": "the solver process ended ({})",
    "late": "no result within {:g} s",
    "failed": "the solver failed ({})",
    "stopped": "the solver was stopped",
}


class CurvePanel:
    """The panel of frequency and power against speed.

    Parameters
    ----------
    session : requests the points from the solver.
    choose : called with the speed whose answer the user wants to see.
    """

    def __init__(self, session: Session, choose: Callable[[float], Any]) -> None:
        self._session, self._choose = session, choose
        self._job: Job | None = None
        self._speeds: list[float] = []
        self._points: list[dict[str, Any]] = []
        self._asked: Scenario | None = None
        with box("Curve against speed", "curve"):
            self._build()

    def _build(self) -> None:
        sweep = self._session.scenario.sweep
        with tag("div", classes="sweep"):
            self._fields: list[Field] = [
                number_field(name, f"{value:g}", self._set(i), unit="m/s")
                for i, (name, value) in enumerate(zip(_SWEEP, sweep, strict=True))
            ]
        with tag("div", classes="acts"):
            button("Compute the curve", self.start)
            self._stop = button("Cancel the curve", self.cancel, disabled=True)
        self._state = tag(
            "p", "Each speed is solved from every start and from the result of the neighbouring speed.", "note"
        )
        self._state.props["role"] = "status"
        self._bar = tag("progress", classes="hidden", max=1, value=0, aria_label="Points of the curve")
        self._found = tag("div", classes="found")
        with self._found:
            self._build_found()

    def _build_found(self) -> None:
        tag("p", "These results belong to an earlier request.", "earlier")
        self._drawing = ui.html("", sanitize=False)  # holds numbers and words of our own alone
        self._table = tag("div", classes="scroll", tabindex="0", role="region", aria_label="Points of the curve")

    def _set(self, place: int) -> Callable[[str], None]:
        def act(text: str) -> None:
            if (value := self._fields[place].number(text)) is None:
                return
            sweep = list(self._session.scenario.sweep)
            sweep[place] = value
            self._session.rearrange(sweep=tuple(sweep))

        return act

    def show_sweep(self, scenario: Scenario) -> None:
        """Show the range of speeds of a scenario, and dim a curve that belongs to another scenario."""
        other = self._asked is not None and not scenario.at(self._asked.speed).asks_as(self._asked)
        set_class(self._found, "stale", other)
        for field, value in zip(self._fields, scenario.sweep, strict=True):
            field.show(f"{value:g}")

    def refuse(self, refusals: list[list[str]]) -> None:
        """Show what is wrong with the range."""
        for name, field in zip(_SWEEP, self._fields, strict=True):
            field.refuse("; ".join(message for where, message in refusals if where == f"sweep.{name}"))

    def start(self) -> None:
        """Request every point, the slowest first."""
        self.cancel()
        if self._session.scenario.faults().faults:
            self._state.set_text("Not started: a choice is invalid; see the mark beside it.")
            return
        self._asked, self._points = self._session.scenario, []
        self.show_sweep(self._asked)
        self._speeds = self._asked.speeds()
        self._stop.props.pop("disabled", None)
        self._bar.classes(remove="hidden")
        self._next(None)

    def cancel(self) -> None:
        """Request no more points, and keep those already solved."""
        if self._job is not None:
            job, self._job = self._job, None
            self._session.cancel(job)
            self._finish(f"Cancelled after {len(self._points)} of {len(self._speeds)} speeds.")

    def _next(self, near: dict[str, Any] | None) -> None:
        done, total = len(self._points), len(self._speeds)
        self._bar.props["value"] = done / total
        if done == total:
            self._job = None
            self._finish(self._summary())
            return
        assert self._asked is not None
        speed = self._speeds[done]
        what = {"do": "point", "scenario": to_plain(self._asked.at(speed)), "near": near}
        job = self._session.start(what, lambda event: self._hear(job, event))
        self._job = job
        if job is None:
            self._finish(BUSY)

    def _hear(self, job: Job | None, event: Event) -> None:
        if job is None or job is not self._job:
            return
        done, total = len(self._points), len(self._speeds)
        if event.kind == "waiting":
            self._state.set_text(f"{done} of {total} speeds; waiting, number {event.value} in the queue.")
        elif event.kind in ("started", "progress"):
            self._state.set_text(f"{done} of {total} speeds; solving {self._speeds[done]:g} m/s.")
        elif event.kind == "done" and "refused" not in event.value:
            before = next((p["near"] for p in reversed(self._points) if p["near"]), None)
            self._points.append(event.value)
            self._draw()
            self._next(event.value["near"] or before)
        elif event.ends:
            self._job = None
            why = event.value["refused"][0][1] if event.kind == "done" else _ENDINGS[event.kind].format(event.value)
            self._finish(f"Stopped after {done} of {total} speeds: {why}.")

    def _finish(self, text: str) -> None:
        self._state.set_text(text)
        self._stop.props["disabled"] = True
        self._bar.classes("hidden")

    def _summary(self) -> str:
        known = [p for p in self._points if p["status"] == "converged" and p["mean_positive_power"] is not None]
        gaps = len(self._points) - len(known)
        text = f"{len(known)} speeds certified" + (f", {gaps} without an orbit" if gaps else "")
        if known:
            least = min(known, key=lambda point: point["mean_positive_power"])
            power = number(least["mean_positive_power"], 3)
            text += f". Lowest power of the certified speeds: {power} W at {least['speed']:g} m/s"
        return text + "."

    def mark(self, speed: float) -> None:
        """Mark the speed of the answer that the page shows."""
        self._now = speed
        if self._points:
            self._drawing.set_content(chart(self._points, self._speeds, speed))

    def _draw(self) -> None:
        self._drawing.set_content(chart(self._points, self._speeds, getattr(self, "_now", None)))
        self._table.clear()
        with self._table, tag("table"):
            assert self._asked is not None
            what = f"{self._asked.species}, {self._asked.aero}, minimum {self._asked.minimise.replace('_', ' ')}"
            tag("caption", what)
            with tag("thead"), tag("tr"):
                for head in ("Speed [m/s]", "Frequency [Hz]", "Power [W]", "Status", "Result"):
                    tag("th", head, scope="col")
            with tag("tbody"):
                for point in self._points:
                    self._row(point)

    def _row(self, point: dict[str, Any]) -> None:
        speed = point["speed"]
        with tag("tr"):
            tag("th", f"{speed:g}", scope="row")
            tag("td", number(point["frequency"]))
            tag("td", number(point["mean_positive_power"]))
            tag("td", "certified" if point["status"] == "converged" else point["status"])
            with tag("td"):
                button("Show", lambda: self._choose(speed), "small", aria_label=f"Show {speed:g} m/s")
