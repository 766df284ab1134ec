"""The page: its layout, and how choices, answers and files go from one part to the other."""

from __future__ import annotations

import base64
import json
import re
from contextlib import AbstractContextManager
from typing import Any

from nicegui import Client, ui

from wingbeat.app.answer import Answer, Headline, Influence
from wingbeat.app.controls import Controls
from wingbeat.app.curve import CurvePanel
from wingbeat.app.downloads import Download, Downloads
from wingbeat.app.flying import Flying
from wingbeat.app.formatting import sentence
from wingbeat.app.links import from_plain, from_query, to_json, to_query
from wingbeat.app.pins import Pins
from wingbeat.app.scenario import Scenario
from wingbeat.app.session import BUSY, Session, known
from wingbeat.app.widgets import button, choice_field, run_script, set_class, tag
from wingbeat.errors import InvalidInputError
from wingbeat.workers.fair_pool import Event, FairPool

_KINDS = {"nc": "application/x-netcdf", "png": "image/png", "pdf": "application/pdf", "json": "application/json"}
_THEMES = (("system", "As the system"), ("light", "Light"), ("dark", "Dark"))
_MOST_LINES = 10
_ACCEPT = ".toml,.nc,.json"


class Page:
    """The page of one visitor; it is the `View` of its session.

    Parameters
    ----------
    name : of the session.
    pool, downloads : of the server.
    query : query of the page's address, which may hold a scenario.
    """

    def __init__(self, name: str, pool: FairPool, downloads: Downloads, query: str) -> None:
        self.name, self._downloads = name, downloads
        self._client: Client = ui.context.client
        self._refusals, scenario = [], Scenario()
        try:
            scenario = from_query(query)
        except InvalidInputError as error:
            self._refusals = [f"The link was not understood. {fault}" for fault in error.faults]
        self._session = Session(name, pool, scenario, self)
        self._build(scenario)
        self._asked = False
        self._client.on_connect(self._come)

    def _come(self) -> None:
        """Solve the scenario in the address once a browser has connected; fetching the page starts nothing."""
        if self._asked:  # the socket was lost, and has connected again
            return
        self._asked = True
        self._session.ask(whole=True)
        if self._refusals:  # shown after the request, because a request removes earlier messages
            self.show_trouble(*self._refusals)

    @property
    def is_open(self) -> bool:
        """Whether the page's socket is connected."""
        return self._client.has_socket_connection

    def context(self) -> AbstractContextManager[Any]:
        """Return the context in which the page's elements may be changed."""
        return self._client

    def leave(self) -> None:
        """Release everything of the page, because its visitor has left."""
        self._session.leave()
        self._downloads.leave(self.name)

    # What stands where -------------------------------------------------------------------------------------------

    def _build(self, scenario: Scenario) -> None:
        self._controls = Controls(scenario, self._session.change)
        tag("a", "Skip to the result", "skip", href="#answer")
        with tag("header", classes="top"):
            self._build_header()
        with tag("div", classes="status"):
            self._build_status()
        self._whole = tag("div", classes="whole")
        with self._whole:
            with tag("div", classes="side quick"):
                self._controls.build_flight()
            with tag("div", classes="middle", id="answer", tabindex="-1"):
                self._headline = Headline()
                self._flying = Flying(self._downloads, self.name)
                self._pins = Pins(self._fly_beside, self._bring_back)
                with tag("div", classes="below"):
                    self._build_panels()
            with tag("div", classes="side more"):
                self._controls.build_loads()

    def _build_header(self) -> None:
        tag("h1", "wingbeat explorer")
        with tag("div", classes="tools"):
            what = "A species file (TOML), an orbit (NetCDF), or a saved state (JSON)"
            self._upload = tag("label", "Load a file", "button", title=what)
            chooser = tag("input", classes="unseen", type="file", accept=_ACCEPT)
            chooser.props["id"] = self._upload.props["for"] = chooser.html_id
            script = f"async (event) => emit(await wingbeatPage.upload(event.target, {json.dumps(self.name)}))"
            chooser.on("change", self._uploaded, js_handler=script)
            button("Save the state", self._save_state, title="A JSON file that this page can load")
            button("Copy the link", lambda: run_script("wingbeatPage.copyLink()"), title="It reproduces this page")
            self._dark = ui.dark_mode(None)
            choice_field("Colours", _THEMES, "system", self._set_theme)

    def _build_status(self) -> None:
        self._state = tag("p", "", "state", role="status", aria_live="polite")
        self._bar = tag("progress", classes="hidden", max=1, value=0, aria_label="Starts done")
        button("Solve", lambda: self._session.ask(whole=True), "primary")
        self._stop = button("Cancel", self._session.stop, disabled=True)
        self._trouble = tag("div", classes="trouble hidden", role="alert")
        with self._trouble:
            self._trouble_lines = tag("ul", classes="plain")
            button("Close", self._close_trouble, "small")

    def _build_panels(self) -> None:
        self._answer = Answer(
            {
                "Pin": self._pin,
                "Record (JSON)": self._save_record,
                "Time series (NetCDF)": lambda: self._make_file("nc"),
                "Figure (PNG)": lambda: self._make_file("png"),
                "Figure (PDF)": lambda: self._make_file("pdf"),
            }
        )
        with tag("div", classes="column"):
            self._curve = CurvePanel(self._session, lambda speed: self._session.change(speed=speed))
            self._influence = Influence(self._differentiate)

    # What the session says ---------------------------------------------------------------------------------------

    def show_scenario(self, scenario: Scenario) -> None:
        """Show a scenario in the form and in the address, and clear messages about the previous one."""
        self._close_trouble()
        self._controls.show(scenario)
        self._curve.show_sweep(scenario)
        run_script(f"wingbeatPage.setQuery({json.dumps(to_query(scenario))})")

    def show_state(self, text: str, busy: bool, done: float | None = None) -> None:
        """Show what the session is doing."""
        if self._state.text != text:
            self._state.set_text(text)
        self._stop.props.set_bool("disabled", not busy)
        set_class(self._bar, "hidden", done is None)
        self._bar.props["value"] = done or 0

    def show_answer(self, answer: dict[str, Any]) -> None:
        """Show an answer."""
        self._flying.show(answer.pop("scene"))
        self._headline.show(answer)
        self._answer.show(answer)
        self._influence.clear()
        self._curve.mark(float(answer["record"]["speed"]))

    def show_stale(self, stale: bool) -> None:
        """Dim the answer while it belongs to another scenario than the form shows."""
        set_class(self._whole, "stale", stale)

    def show_refusals(self, refusals: list[list[str]]) -> None:
        """Show each refusal beside its control, or above the form if it belongs to no control."""
        self._curve.refuse(refusals)
        homeless = self._controls.refuse([each for each in refusals if not each[0].startswith("sweep.")])
        if homeless:
            self.show_trouble(*homeless)

    def show_trouble(self, *lines: str) -> None:
        """Show a message about an error."""
        self._trouble_lines.clear()
        with self._trouble_lines:
            for line in lines[:_MOST_LINES]:
                tag("li", line)
            if len(lines) > _MOST_LINES:
                tag("li", f"And {len(lines) - _MOST_LINES} more.")
        self._trouble.classes(remove="hidden")

    def _close_trouble(self) -> None:
        self._trouble.classes("hidden")

    # What the visitor does ---------------------------------------------------------------------------------------

    def _set_theme(self, theme: str) -> None:
        self._dark.set_value({"light": False, "dark": True}.get(theme))
        self._flying.set_theme(theme)

    def _pin(self) -> None:
        if self._session.answer is not None:
            self._pins.pin(self._session.answer)

    def _fly_beside(self, answer: dict[str, Any] | None) -> None:
        self._session.beside = None if answer is None else known(answer)
        if self._session.answer is not None:
            what = {"do": "scene", "of": known(self._session.answer), "beside": self._session.beside}
            self._start(what, "Drawing.", lambda found: self._flying.show(found["scene"]))

    def _bring_back(self, answer: dict[str, Any]) -> None:
        sweep = self._session.scenario.sweep
        self._session.scenario = from_plain({**answer["scenario"], "sweep": list(sweep)})
        self._session.ask(whole=True)

    def _differentiate(self) -> None:
        answer = self._session.answer
        if answer is None or answer["record"]["status"] != "converged":
            self._influence.say("Sensitivities need a certified orbit.")
            return
        self._influence.clear()
        self._influence.say("Computing sensitivities; the first time takes about twenty seconds.")

        def show(found: dict[str, Any]) -> None:
            if self._session.answer is answer:
                self._influence.say("")
                self._influence.show(found)

        self._start({"do": "influence", "of": known(answer)}, "", show, self._influence.say)

    def _start(self, what: dict[str, Any], doing: str, show: Any, say: Any = None, end: Any = None) -> None:
        """Submit a job to the pool in addition to the search, and show its result."""
        say = say or (lambda text: self.show_state(text, busy=False))

        def hear(event: Event) -> None:
            if event.ends and end is not None:
                end()
            if event.kind == "waiting":
                say(f"Waiting: number {event.value} in the queue.")
            elif event.kind == "done" and "refused" in event.value:
                say("Refused.")
                self.show_trouble(*(sentence(*each) for each in event.value["refused"]))
            elif event.kind == "done":
                say("Done.")
                show(event.value)
            elif event.ends:
                self._session.tell_ending(event)

        if doing:
            say(doing)
        if self._session.start(what, hear) is None:
            self.show_trouble(BUSY)
            if end is not None:
                end()

    # Files -------------------------------------------------------------------------------------------------------

    def _download(self, content: bytes, kind: str) -> None:
        record = self._session.answer["record"] if self._session.answer else {}
        name = re.sub(r"[^A-Za-z0-9-]+", "-", f"{record.get('species', 'state')}-{record.get('speed', '')}").strip(
            "-"
        )
        address = self._downloads.put(self.name, Download(content, _KINDS[kind], f"{name[:60]}.{kind}"))
        run_script(f"wingbeatPage.download({json.dumps(address)})")

    def _save_state(self) -> None:
        self._download(to_json(self._session.scenario).encode(), "json")

    def _save_record(self) -> None:
        if self._session.answer is not None:
            self._download(json.dumps(self._session.answer["record"], indent=2).encode(), "json")

    def _make_file(self, kind: str) -> None:
        if self._session.answer is not None:
            what = {"do": "file", "as": kind, "of": known(self._session.answer)}
            self._start(what, "Writing.", lambda found: self._download(base64.b64decode(found["content"]), kind))

    def _uploaded(self, event: Any) -> None:
        """Show why the server refused an upload; `read_file` reports on files that it accepted."""
        if isinstance(event.args, str) and event.args:
            self.show_trouble(event.args[:300])

    def read_file(self, path: str, label: str, done: Any) -> None:
        """Read a file that the visitor sent, in a worker; `done` is called when the file is no longer needed."""

        def show(found: dict[str, Any]) -> None:
            if "answer" in found:
                scenario = from_plain(found["scenario"]) if found["scenario"] is not None else None
                self._session.take_file(found["answer"] | {"from_file": label}, scenario)
                if scenario is None:
                    self.show_trouble(
                        f"{label} is shown as it is; the form cannot represent it: {found['why_not']}."
                    )
            elif "text" in found:
                self._session.change(species=found["species"], species_file=found["text"], values={}, bounds={})
            else:
                self._session.scenario = from_plain(found["scenario"])
                self._session.ask(whole=True)

        with self._client:
            self._close_trouble()
            self._start({"do": "read", "path": path, "label": label}, f"Reading {label}.", show, end=done)
