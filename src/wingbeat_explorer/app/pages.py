"""The page of each visitor: its layout, and how choices, answers and files go from one part to the other.

The `House` is what all visitors share: the pool of workers, the downloads, and the open pages.
"""

from __future__ import annotations

import json
import secrets
import tempfile
from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any

from nicegui import Client, ui

from wingbeat._base import InvalidInputError
from wingbeat._workers.pool import Event
from wingbeat.aero.polar_formats import POLAR_SUFFIXES
from wingbeat_explorer.app.controls import Controls
from wingbeat_explorer.app.errands import Errands
from wingbeat_explorer.app.face_element import Downloads, Face
from wingbeat_explorer.app.first import read_first
from wingbeat_explorer.app.links import from_plain, from_query, to_plain, to_query
from wingbeat_explorer.app.panels import Answer, Brief, CurvePanel, Influence, Pins
from wingbeat_explorer.app.scenario import Scenario, animals
from wingbeat_explorer.app.session import FairPool, Session
from wingbeat_explorer.app.speed_curve import Curve, drawn
from wingbeat_explorer.app.widgets import Trouble, button, choice_field, folded, part, run_script, set_class, tag

_THEMES = (("system", "System"), ("light", "Light"), ("dark", "Dark"))
_ACCEPT = ",".join((".toml", ".nc", ".json", *POLAR_SUFFIXES))
_WORK = "wingbeat_explorer.app.jobs:do"
# Most pages that were fetched and wait for their browser to connect. Browsers connect within a second. Programs
# that only fetch pages never do, and each page takes 3.2 MB of memory until NiceGUI drops it after a minute. A
# browser whose page was dropped loads it again by itself.
MOST_WAITING = 20


class Page:
    """The page of one visitor: the `View` of the session of its name. The address may hold a scenario."""

    def __init__(self, name: str, house: House, query: str) -> None:
        self.name, self._house, self._first = name, house, house.first
        self._client: Client = ui.context.client
        self._refusals, scenario = [], self._first.scenario
        try:
            scenario = from_query(query) if query else scenario
        except InvalidInputError as error:
            self._refusals = [f"The link was not understood. {fault}" for fault in error.faults]
        self._is_ready = scenario.asks_as(self._first.scenario)
        self._session = Session(name, house.pool, scenario, self)
        self._curve = Curve(self._session, self._show_curve)
        self._curve_shown: dict[str, Any] | None = None
        self._marks: set[str] = set()
        self._errands = Errands(self._session, house.downloads, self)
        self._build(scenario)
        self._asked = False
        self._client.on_connect(self._come)

    def _come(self) -> None:
        """Solve the scenario in the address once a browser has connected; fetching the page starts nothing.

        If the scenario was solved beforehand, the browser has fetched the answer by itself.
        """
        if self._asked:  # the socket was lost, and has connected again
            return
        self._asked = True
        if not self._is_ready:
            if not self._session.ask(whole=True):
                self._face.say("")  # nothing is solved, so nobody waits
        else:
            if self._session.scenario == self._first.scenario:
                self._curve.take(self._first.scenario, self._first.answer, self._first.points)
            self._session.take_ready(self._first.answer)
            self._is_ready = False
            self._house.warm_up()  # who looks at it may soon move on
        if self._refusals:  # shown after the request, because a request removes earlier messages
            self.show_trouble(*self._refusals)

    @property
    def waits(self) -> bool:
        """Whether the page was fetched, but no browser has connected to it yet."""
        return not self._asked

    def drop(self) -> None:
        """Delete the page, as if its visitor had left."""
        self._client.delete()

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
        self._errands.leave()
        self._house.downloads.leave(self.name)

    # What stands where -------------------------------------------------------------------------------------------

    def _build(self, scenario: Scenario) -> None:
        self._controls = Controls(scenario, self._session.change)
        tag("a", "Skip to the result", "skip", href="#answer")
        with tag("header", classes="top"):
            self._build_header()
        with tag("div", classes="whole"):
            ask, push = self._controls.choose, lambda: self._errands.push(self._face)
            self._face = Face(self._house.downloads, self.name, scenario, self._is_ready, ask, push, self._keep)
            self._brief = Brief(self._pin)
            self._pins = Pins(self._face.compare, self._bring_back)
            with tag("div", classes="below"):
                self._build_panels()

    def _build_header(self) -> None:
        tag("p", "wingbeat explorer", "brand")
        with tag("details", classes="drawer"):
            with tag("summary", classes="button primary"):
                tag("span", "Change the animal, the air or the numbers", "wide-only")
                tag("span", "Animal, air, numbers", "narrow-only")
            with tag("div", classes="sheet"):
                self._controls.build_flight(lambda: self._session.ask(whole=True))
                with folded("Expert numbers", "expert"):
                    self._controls.build_loads()
        with part("div", "status"):
            self._state = tag("p", "", "state", role="status", aria_live="polite")
            tag("p", "This result belongs to an earlier request.", "earlier")
            self._bar = tag("progress", classes="hidden", max=1, value=0, aria_label="Starts done")
            self._stop = button("Cancel", self._session.stop, "small", disabled=True)
        with tag("details", classes="menu"):
            tag("summary", "File, link, colours", "button")
            with tag("div", classes="items"):
                self._build_menu()
        tag("p", None, "refusal hidden")
        self._trouble = Trouble()

    def _build_menu(self) -> None:
        what = "A species file (TOML), a polar, an orbit (NetCDF), or a saved state (JSON)"
        self._upload = tag("label", "Load a file", "button", title=what)
        chooser = tag("input", classes="unseen", type="file", accept=_ACCEPT)
        chooser.props["id"] = self._upload.props["for"] = chooser.html_id
        script = f"async (event) => emit(await wingbeatPage.upload(event.target, {json.dumps(self.name)}))"
        chooser.on("change", self._uploaded, js_handler=script)
        button("Save the state", self._errands.save_state, title="A JSON file that this page can load")
        button("Copy the link", lambda: run_script("wingbeatPage.copyLink()"), title="It reproduces this page")
        self._dark = ui.dark_mode(None)
        choice_field("Colours", _THEMES, "system", self._set_theme)

    def _build_panels(self) -> None:
        self._answer = Answer(
            {
                "Record (JSON)": self._errands.save_record,
                "Time series (NetCDF)": lambda: self._errands.make_file("nc"),
                "Figure (PNG)": lambda: self._errands.make_file("png"),
                "Figure (PDF)": lambda: self._errands.make_file("pdf"),
            }
        )
        self._curve_panel = CurvePanel(self._session, self._curve, lambda speed: self._session.change(speed=speed))
        self._influence = Influence(lambda: self._errands.differentiate(self._influence))

    # What the session says ---------------------------------------------------------------------------------------

    def show_scenario(self, scenario: Scenario) -> None:
        """Show a scenario in the controls and in the address, and clear messages about the previous one."""
        self._trouble.close()
        self._controls.show(scenario)
        self._face.choose(scenario)
        if not self._curve.suits(scenario):
            self._curve.pause()
        self._mark("old-curve", not self._curve.suits(scenario))
        self._curve_panel.show_sweep(scenario)
        run_script(f"wingbeatPage.setQuery({json.dumps(to_query(scenario))})")

    def show_state(self, text: str, busy: bool, done: float | None = None) -> None:
        """Show what the session is doing."""
        if self._state.text != text:
            self._state.set_text(text)
        self._stop.props.set_bool("disabled", not busy)
        set_class(self._bar, "hidden", done is None)
        self._bar.props["value"] = done or 0
        if not busy:
            self._curve.go_on()

    def show_answer(self, answer: dict[str, Any]) -> None:
        """Show an answer; its curve follows once the controls are left alone."""
        if not self._is_ready:
            self._face.show(answer)
        self._brief.show(answer, self._face.count)
        self._answer.show(answer)
        self._influence.clear()
        if answer["scenario"] is not None and not answer.get("continued"):
            self._curve.follow(self._session.answered, answer)
        self._show_curve()
        self._errands.push_again(self._face)

    def _show_curve(self) -> None:
        """Show the curve in the face and in its panel."""
        curve, answer, scenario = self._curve, self._session.answer, self._session.answered
        if answer is not None and answer["scenario"] is None:  # from a file that the controls cannot represent
            answer = None
        if answer is None or curve.is_of(scenario):
            data = drawn(curve.asked or scenario, curve.points, answer, curve.measured, curve.pending)
        else:  # the answer was continued, and its curve begins when the controls are left alone
            data = drawn(scenario, (), answer, answer["measured"], scenario.speeds())
        if data != self._curve_shown:
            self._curve_shown = data
            self._face.show_curve(data)
        self._curve_panel.show()
        self._mark("old-curve", not curve.suits(self._session.scenario))

    def show_stale(self, stale: bool) -> None:
        """Dim the answer while it belongs to another scenario than the controls show."""
        self._mark("stale", stale)

    def _mark(self, name: str, on: bool) -> None:
        """Give the page's body a class, or remove it; a class of an element would have all inside it drawn anew."""
        if (name in self._marks) != on:
            self._marks ^= {name}
            run_script(f"wingbeatPage.mark({json.dumps(name)}, {json.dumps(on)})")

    def show_refusals(self, refusals: list[list[str]]) -> None:
        """Show each refusal beside its control, or at the top if it belongs to no control."""
        self._curve_panel.refuse(refusals)
        homeless = self._controls.refuse([each for each in refusals if not each[0].startswith("sweep.")])
        if homeless:
            self.show_trouble(*homeless)

    def show_trouble(self, *lines: str) -> None:
        """Show a message about an error."""
        self._trouble.show(*lines)

    # What the visitor does ---------------------------------------------------------------------------------------

    def _set_theme(self, theme: str) -> None:
        self._dark.set_value({"light": False, "dark": True}.get(theme))
        self._face.set_theme(theme)

    def _pin(self) -> None:
        if self._session.answer is not None:
            self._pins.pin(self._session.answer)

    def _keep(self, wanted: bool) -> None:
        """Pin the answer and fly it beside those that follow, or end the comparison."""
        self._pins.compare(self._session.answer if wanted else None)

    def _bring_back(self, answer: dict[str, Any]) -> None:
        sweep = self._session.scenario.sweep
        self._session.scenario = from_plain({**answer["scenario"], "sweep": list(sweep)})
        self._session.ask(whole=True)

    def _uploaded(self, event: Any) -> None:
        """Show why the server refused an upload; `read_file` reports on files that it accepted."""
        if isinstance(event.args, str) and event.args:
            self.show_trouble(event.args[:300])

    def read_file(self, path: str, label: str, done: Callable[[], Any]) -> None:
        """Read a file that the visitor sent; `done` is called when the file is no longer needed."""
        with self._client:
            self._trouble.close()
            self._errands.read(path, label, done)


class House:
    """What all visitors share, with so many worker processes."""

    def __init__(self, processes: int) -> None:
        self._is_warm = False
        self.pool = FairPool(_WORK, processes)
        self.downloads = Downloads()
        self.first = read_first()
        animals()  # now, so that the first visitor need not wait for it
        self.pages: dict[str, Page] = {}
        self.folder = tempfile.TemporaryDirectory(prefix="wingbeat-")

    def warm_up(self) -> None:
        """Solve the first flight in one worker, then in another, so that a move need not wait for its compilation.

        Only the first call does anything.
        """
        if self._is_warm:
            return
        self._is_warm = True
        near = self.first.answer["near"]
        what = {"do": "orbit", "scenario": to_plain(self.first.scenario), "near": near}

        def go_on(event: Event) -> None:
            if event.ends:  # in the background, which takes another worker
                self.pool.submit("warm-up", what, lambda event: None, background=True)

        self.pool.submit("warm-up", what, go_on)

    def open_page(self, client: Client, query: str) -> None:
        """Build a page for a new visitor; of pages to which nobody has connected, only the latest are kept."""
        waiting = [page for page in self.pages.values() if page.waits]
        for page in waiting[: max(len(waiting) - MOST_WAITING + 1, 0)]:
            page.drop()
        name = secrets.token_urlsafe(12)
        page = self.pages[name] = Page(name, self, query)

        def leave() -> None:
            del self.pages[name]
            page.leave()

        client.on_delete(leave)

    def close(self) -> None:
        """End the workers and delete all temporary files."""
        self.pool.close()
        self.folder.cleanup()
