"""The face of the explorer as an element of the page, and what the browser fetches for it.

Each download has a name that nobody can guess; a session keeps its last few.
"""

from __future__ import annotations

import json
import secrets
from collections import OrderedDict
from collections.abc import Callable
from typing import Any, NamedTuple

from nicegui import ui

from wingbeat.orbits.problem.quantities import FASTEST
from wingbeat_explorer.app.scenario import Scenario, animals
from wingbeat_explorer.app.widgets import run_script, tag
from wingbeat_explorer.models import EXPLORER_MODELS

DOWNLOADS = "/wingbeat/downloads/"  # the address, without the name
_MOST = 12
BUNDLE = "/wingbeat/explorer.js"
READY = "/wingbeat/first.json"  # the face that was solved beforehand
# What the face asks is sent at most about twenty times a second while its point is dragged.
_THROTTLE = 0.05


class Download(NamedTuple):
    """Bytes with their media type, and the file name under which a browser saves them, if it does."""

    content: bytes
    kind: str
    name: str = ""


class Downloads:
    """Keeps the last few downloads of each session."""

    def __init__(self) -> None:
        self._kept: dict[str, OrderedDict[str, Download]] = {}

    def put(self, session: str, download: Download) -> str:
        """Return the address at which a download can be fetched."""
        own = self._kept.setdefault(session, OrderedDict())
        name = secrets.token_urlsafe(16)
        own[name] = download
        while len(own) > _MOST:
            own.popitem(last=False)
        return DOWNLOADS + name

    def get(self, name: str) -> Download | None:
        """Return a download; None if it has been dropped."""
        return next((own[name] for own in self._kept.values() if name in own), None)

    def leave(self, session: str) -> None:
        """Drop all downloads of a session."""
        self._kept.pop(session, None)


class Face:
    """The element of a page that holds the component, which fetches the session's answers from `downloads`.

    `is_ready` says whether the answer to the first scenario was solved beforehand. `ask` is called with the choices
    that were changed (species, model or speed [m/s]), `push` when the visitor wants the flight pushed, and `pin`
    with whether it is to stay beside those that follow.
    """

    def __init__(
        self,
        downloads: Downloads,
        session: str,
        scenario: Scenario,
        is_ready: bool,
        ask: Callable[..., Any],
        push: Callable[[], Any],
        pin: Callable[[bool], Any],
    ) -> None:
        self._downloads, self._session, self._ask = downloads, session, ask
        self._scenario = scenario
        self.count = 0  # of answers that the browser was given
        self._place: Any = tag("div", classes="face", id="answer", tabindex="-1")
        # The component's event, with what is chosen now.
        self._place.on(
            "ask",
            self._hear,
            js_handler="(event) => emit(event.detail)",
            throttle=_THROTTLE,
            leading_events=True,
            trailing_events=True,
        )
        self._place.on("push", push, args=[])
        self._place.on("pin", lambda event: pin(event.args is True), js_handler="(event) => emit(event.detail)")
        choices, chosen = _offered(scenario)
        about = {"choices": choices, "chosen": chosen, "ready": READY if is_ready else None, "session": session}
        text = json.dumps(about).replace("<", "\\u003c")
        ui.add_head_html(f"<script>wingbeatPage.begin({text});</script>")

    def _hear(self, event: Any) -> None:
        """Change the choices that differ from the scenario's; a client that sends anything else is not ours."""
        asked, now = event.args, _chosen(self._scenario)
        if not isinstance(asked, dict):
            return
        changed = {name: asked[name] for name in now if name in asked and asked[name] != now[name]}
        wanted: dict[str, Any] = {}
        if changed.get("animal") in [name for name, _ in animals()]:
            wanted["species"] = changed["animal"]
        if changed.get("model") in EXPLORER_MODELS:
            wanted["model"] = changed["model"]
        speed = changed.get("speed")
        # A truth value counts as a number in Python, and a whole number may be too large for a float.
        if not wanted and isinstance(speed, int | float) and not isinstance(speed, bool) and 0 <= speed <= FASTEST:
            wanted["speed"] = float(speed)
        if wanted:
            self._ask(**wanted)

    def choose(self, scenario: Scenario) -> None:
        """Show which animal and model are chosen."""
        before, self._scenario = self._scenario, scenario
        if _offered(before) != _offered(scenario):
            self._run("choose", *_offered(scenario))

    def show(self, answer: dict[str, Any]) -> None:
        """Show an answer; one that was continued is provisional."""
        self.count += 1
        self._run("show", self._address(answer["face"]), bool(answer.get("continued")))

    def show_curve(self, data: dict[str, Any]) -> None:
        """Show the curve, as `wingbeat_explorer.app.speed_curve.drawn` returns it."""
        self._run("showCurve", data)

    def compare(self, answer: dict[str, Any] | None) -> None:
        """Show another answer beside the one on the page; None ends the comparison."""
        self._run("compare", None if answer is None else self._address(answer["face"]))

    def push(self, pushes: str, words: str) -> None:
        """Offer flights through gusts, given as JSON text, and say something about them."""
        self._run("push", self._address(pushes), words)

    def say(self, text: str) -> None:
        """Say what the visitor waits for."""
        self._run("say", text)

    def set_theme(self, theme: str) -> None:
        """Set the theme: ``system``, ``light`` or ``dark``."""
        self._run("setTheme", theme)

    def _address(self, content: str) -> str:
        return self._downloads.put(self._session, Download(content.encode(), "application/json"))

    def _run(self, act: str, *words: Any) -> None:
        run_script(f"wingbeatPage.{act}({', '.join(json.dumps(word) for word in words)})")


def _offered(scenario: Scenario) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return animals and models to choose from, and those that are chosen."""
    own = scenario.species if scenario.species_file else None
    listed = [{"name": name, "title": title} for name, title in animals() if name != own]
    if own is not None:
        listed.insert(0, {"name": own, "title": f"{own} (loaded file)"})
    models = [{"name": name, "title": one.title} for name, one in EXPLORER_MODELS.items()]
    return {"animals": listed, "models": models}, {"animal": scenario.species, "model": scenario.face_model}


def _chosen(scenario: Scenario) -> dict[str, Any]:
    return {"animal": scenario.species, "model": scenario.face_model, "speed": scenario.speed}
