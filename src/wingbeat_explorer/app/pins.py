"""Pinned answers: a table to compare them, to bring one back, or to show one as a ghost beside the answer."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from wingbeat._base import in_words
from wingbeat_explorer.app.formatting import number, tiles
from wingbeat_explorer.app.widgets import box, button, tag

_MOST_PINS = 8


class Pins:
    """The pinned answers of a page.

    Parameters
    ----------
    fly_beside : called with the answer to show as a ghost; with None to show no ghost.
    bring_back : called with the answer whose choices the form should show again.
    """

    def __init__(self, fly_beside: Callable[[Any], Any], bring_back: Callable[[Any], Any]) -> None:
        self._fly_beside, self._bring_back = fly_beside, bring_back
        self._answers: list[dict[str, Any]] = []
        self._ghost: dict[str, Any] | None = None
        self._box = box("Pinned results", "pins hidden")
        with self._box:
            self._note = tag("p", "", "note")
            self._place = tag("div", classes="scroll", tabindex="0", role="region", aria_label="Pinned results")

    def pin(self, answer: dict[str, Any]) -> None:
        """Pin an answer; if there are too many, the oldest is removed."""
        if any(each is answer for each in self._answers):
            self._note.set_text("This result is already pinned.")
            return
        self._answers.append(answer)
        self._box.classes(remove="hidden")
        text = "Pinned. Change the speed or the animal, then show this result as a ghost beside the next one."
        if len(self._answers) > _MOST_PINS:
            gone = self._answers.pop(0)
            text = f"Pinned; the oldest was removed, because at most {_MOST_PINS} are kept."
            if gone is self._ghost:
                self._fly(None)
        self._note.set_text(text)
        self._draw()

    def compare(self, answer: dict[str, Any] | None) -> None:
        """Pin an answer and show it as a ghost; None ends the comparison."""
        if answer is not None:
            self.pin(answer)
            self._note.set_text("Pinned, and shown beside the result on the page.")
        self._fly(answer)

    def _fly(self, answer: dict[str, Any] | None) -> None:
        self._ghost = answer
        self._draw()
        self._fly_beside(answer)

    def _drop(self, answer: dict[str, Any]) -> None:
        self._answers = [each for each in self._answers if each is not answer]
        if answer is self._ghost:
            self._fly(None)
        self._draw()

    def _draw(self) -> None:
        self._place.clear()
        if not self._answers:
            return
        with self._place, tag("table"):
            tag("caption", "Pinned results", "unseen")
            heads = [
                f"{label} [{unit}]" if unit else label for label, _, unit, _ in tiles(self._answers[0]["record"])
            ]
            with tag("thead"), tag("tr"):
                for head in ("What", *heads, "Stable", "Action"):
                    tag("th", head, scope="col")
            with tag("tbody"):
                for answer in self._answers:
                    self._row(answer)

    def _row(self, answer: dict[str, Any]) -> None:
        record = answer["record"]
        aero, minimised = record["aero"]["coefficients"], in_words(record["objective"])
        name = f"{record['species']} at {number(record['speed'])} m/s, {aero}, minimum {minimised}"
        flies = answer is self._ghost
        with tag("tr"):
            with tag("th", scope="row"):
                tag("span", name)
                if record["status"] != "converged":
                    tag("span", f" ({record['status']})", "bad-text")
            for _, value, _, _ in tiles(record):
                tag("td", value)
            stable = record.get("stable")
            tag("td", "–" if stable is None else "yes" if stable else "no")
            with tag("td", classes="acts"):
                ghost = button(
                    "Ghost",
                    lambda: self._fly(None if flies else answer),
                    "small",
                    aria_label=f"Show as ghost: {name}",
                )
                ghost.props["aria-pressed"] = "true" if flies else "false"
                if answer.get("scenario"):
                    button("Restore", lambda: self._bring_back(answer), "small", aria_label=f"Restore: {name}")
                button("Remove", lambda: self._drop(answer), "small", aria_label=f"Remove: {name}")
