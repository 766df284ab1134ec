"""What a visitor asks for beside the search: pushed flights, sensitivities, and files to save or to read."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Callable
from typing import Any

from wingbeat._workers.pool import Event, Job
from wingbeat_explorer.app.face_element import Download, Downloads, Face
from wingbeat_explorer.app.formatting import sentence
from wingbeat_explorer.app.links import from_plain, to_json
from wingbeat_explorer.app.panels import Influence
from wingbeat_explorer.app.scenario import Scenario
from wingbeat_explorer.app.session import BUSY, Session, View, known
from wingbeat_explorer.app.widgets import run_script

_KINDS = {"nc": "application/x-netcdf", "png": "image/png", "pdf": "application/pdf", "json": "application/json"}


class Errands:
    """The errands of one page; `view` shows what went wrong."""

    def __init__(self, session: Session, downloads: Downloads, view: View) -> None:
        self._session, self._downloads, self._view = session, downloads, view
        self._pushing: Job | None = None
        self._pushed: Scenario | None = None
        self._pushes = 0
        self._unread: set[Callable[[], Any]] = set()

    def push(self, face: Face) -> None:
        """Fly the orbit through gusts, and offer these flights below the picture."""
        answer = self._session.answer
        if answer is None or answer["record"]["status"] != "converged":
            return
        self._stop_pushing()
        self._pushed = self._session.answered
        self._pushes += 1
        mine = self._pushes

        def show(found: dict[str, Any]) -> None:
            if self._session.answer is answer:
                words = f"Flights with feedback are left out: {found['why_not']}." if found["why_not"] else ""
                face.push(found["pushes"], words)

        def told(done: int, total: int) -> str:
            return f"Flying through gusts: {done} of {total} flights."

        def ended() -> None:
            if mine == self._pushes:
                self._pushing = None

        doing = "Computing the feedback that holds this flight; the first time takes some seconds."
        what = {"do": "pushes", "of": known(answer)}
        self._pushing = self._start(what, doing, show, face.say, end=ended, told=told)

    def push_again(self, face: Face) -> None:
        """Push the new answer, too, if the last one had its scenario and is still being pushed."""
        if self._stop_pushing() and self._pushed is not None and self._session.answered.asks_as(self._pushed):
            self.push(face)

    def _stop_pushing(self) -> bool:
        """Fly no more gusts; return whether there were more to fly."""
        job, self._pushing = self._pushing, None
        if job is not None:
            self._session.cancel(job)
        return job is not None

    def differentiate(self, influence: Influence) -> None:
        """Compute the sensitivities of the answer."""
        answer = self._session.answer
        if answer is None or answer["record"]["status"] != "converged":
            influence.say("Sensitivities need a certified orbit.")
            return
        influence.clear()
        doing = "Computing sensitivities; the first time takes about twenty seconds."

        def show(found: dict[str, Any]) -> None:
            if self._session.answer is answer:
                influence.say("")
                influence.show(found)

        self._start({"do": "influence", "of": known(answer)}, doing, show, influence.say)

    def _start(
        self,
        what: dict[str, Any],
        doing: str,
        show: Callable[[dict[str, Any]], Any],
        say: Callable[[str], Any] | None = None,
        end: Callable[[], Any] | None = None,
        told: Callable[[int, int], str] | None = None,
        name: str = "The request",
    ) -> Job | None:
        """Submit a job beside the search, and show its progress and result; `name` is what may be refused."""
        say = say or (lambda text: self._view.show_state(text, busy=False))

        def hear(event: Event) -> None:
            if event.ends and end is not None:
                end()
            if event.kind == "waiting":
                say(f"Waiting: number {event.value} in the queue.")
            elif event.kind == "progress" and told is not None:
                say(told(*event.value))
            elif event.kind == "done" and "refused" in event.value:
                say(f"{name} was refused.")
                self._view.show_trouble(*(sentence(*each) for each in event.value["refused"]))
            elif event.kind == "done":
                say("Done.")
                show(event.value)
            elif event.ends and event.kind != "stopped":
                self._session.tell_ending(event)

        if doing:
            say(doing)
        job = self._session.start(what, hear)
        if job is None:
            self._view.show_trouble(BUSY)
            if end is not None:
                end()
        return job

    # Files -------------------------------------------------------------------------------------------------------

    def _download(self, content: bytes, kind: str) -> None:
        record = self._session.answer["record"] if self._session.answer else {}
        named = f"{record.get('species', 'state')}-{record.get('speed', '')}"
        name = re.sub(r"[^A-Za-z0-9-]+", "-", named).strip("-")
        download = Download(content, _KINDS[kind], f"{name[:60]}.{kind}")
        address = self._downloads.put(self._session.name, download)
        run_script(f"wingbeatPage.download({json.dumps(address)})")

    def save_state(self) -> None:
        """Send the choices as a JSON file."""
        self._download(to_json(self._session.scenario).encode(), "json")

    def save_record(self) -> None:
        """Send the record of the answer as a JSON file."""
        if self._session.answer is not None:
            self._download(json.dumps(self._session.answer["record"], indent=2).encode(), "json")

    def make_file(self, kind: str) -> None:
        """Send the answer as a file of a kind: ``nc``, ``png`` or ``pdf``."""
        if self._session.answer is not None:
            what = {"do": "file", "as": kind, "of": known(self._session.answer)}
            self._start(what, "Writing.", lambda found: self._download(base64.b64decode(found["content"]), kind))

    def read(self, path: str, label: str, done: Callable[[], Any]) -> None:
        """Read a file that the visitor sent, in a worker; `done` is called when the file is no longer needed."""
        self._unread.add(done)

        def end() -> None:
            self._unread.discard(done)
            done()

        def show(found: dict[str, Any]) -> None:
            if "answer" in found:
                scenario = from_plain(found["scenario"]) if found["scenario"] is not None else None
                self._session.take_file(found["answer"] | {"from_file": label}, scenario)
                if scenario is None:
                    text = f"{label} is shown as it is; the controls cannot represent it: {found['why_not']}."
                    self._view.show_trouble(text)
            elif "aero_file" in found:
                self._session.change(**found)
            elif "text" in found:
                self._session.change(species=found["species"], species_file=found["text"], values={}, bounds={})
            else:
                self._session.scenario = from_plain(found["scenario"])
                self._session.ask(whole=True)

        now = self._session.scenario
        what = {"do": "read", "path": path, "label": label}
        what |= {"extension": now.extension, "blend_width_deg": now.blend_width_deg}
        self._start(what, f"Reading {label}.", show, end=end, name=label)

    def leave(self) -> None:
        """Release the files that are not read yet, because the visitor has left."""
        for done in self._unread:
            done()
