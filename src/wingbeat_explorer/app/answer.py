"""The answer below the face: what was solved, all its numbers, and what it depends on."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from wingbeat._base import NOMENCLATURE, for_people
from wingbeat_explorer.app.formatting import number, tiles
from wingbeat_explorer.app.widgets import Rows, button, folded, part, tag


class Brief:
    """One line below the face: what was solved, and a button that pins it; `pin` is called."""

    def __init__(self, pin: Callable[[], Any]) -> None:
        with part("section", "brief", aria_label="Result in brief"):
            with tag("div", classes="words"):
                self._title = tag("h2", "", "what")
                self._message = tag("p", "", "message")
            self._pin = button("Pin", pin, disabled=True, title="Keep this result to compare it with the next one")

    def show(self, answer: dict[str, Any], count: int) -> None:
        """Show what was solved; the face shows the same as soon as it has drawn so many answers."""
        record = answer["record"]
        climb = f", climbing {number(record['climb'])} m/s" if record["climb"] else ""
        aero = record["aero"]["coefficients"]
        self._title.set_text(f"{record['species']} at {number(record['speed'])} m/s{climb}, {aero}")
        self._title.props["data-solver-seconds"] = answer["solver_seconds"]
        self._title.props["data-count"] = count
        self._message.set_text(_message(answer))
        self._pin.props.pop("disabled", None)


def _message(answer: dict[str, Any]) -> str:
    # Of a certified orbit, the face already says this.
    parts = [] if answer["record"]["status"] == "converged" else [str(answer["record"]["message"])]
    if answer.get("from_file"):
        parts.append(f"From the file {answer['from_file']}; not solved here.")
    elif answer.get("continued"):
        parts.append("Continued from the previous result, with one start.")
    if answer.get("continued_better") is not None:
        minimised = answer["record"]["objective"]
        factor, unit = for_people(NOMENCLATURE[minimised].unit)
        better = f"{minimised.replace('_', ' ')}, {number(factor * answer['continued_better'])} {unit}".rstrip()
        found = f"Continuation from an earlier result found a lower {better}."
        parts.append(f"{found} More starts may find it.")
    text = ". ".join(part.rstrip(".") for part in parts if part)
    return f"{text[:1].upper()}{text[1:]}." if text else ""


class Answer:
    """The panel with all numbers of an answer, and buttons that save it.

    Parameters
    ----------
    acts : the function that each button calls, by the button's text.
    """

    def __init__(self, acts: dict[str, Callable[[], Any]]) -> None:
        with folded("All numbers and files", "answer"):
            with tag("div", classes="acts"):
                self._buttons = [button(text, act, disabled=True) for text, act in acts.items()]
            self._strip = tag("dl", classes="tiles")
            self._tiles: dict[str, Any] = {}
            self._rows = Rows()

    def show(self, answer: dict[str, Any]) -> None:
        """Show an answer."""
        for each in self._buttons:
            each.props.pop("disabled", None)
        for label, value, unit, exact in tiles(answer["record"]):
            shown = self._tile(label, unit)
            if shown.text != value:
                shown.set_text(value)
            shown.props["title"] = f"{exact} {unit}".strip()
            shown.props["data-exact"] = exact
        self._rows.show(answer["groups"])

    def _tile(self, label: str, unit: str) -> Any:
        if label not in self._tiles:
            with self._strip, tag("div", classes="tile"):
                tag("dt", label)
                with tag("dd"):
                    self._tiles[label] = tag("output", "", "value")
                    tag("span", unit, "unit")
        return self._tiles[label]


class Influence:
    """The panel of sensitivities: the parameters by rank, and the price of each active bound."""

    def __init__(self, ask: Callable[[], Any]) -> None:
        with folded("Sensitivities", "influence"):
            tag(
                "p",
                "Exact derivatives of the certified optimum with respect to every number on which it depends.",
                "note",
            )
            with tag("div", classes="acts"):
                button("Compute sensitivities", ask)
            self._state = tag("p", "", "note", role="status")
            self._place = tag("div")

    def say(self, text: str) -> None:
        """Show the progress, or what went wrong."""
        self._state.set_text(text)

    def clear(self) -> None:
        """Empty the panel, because the answer has changed."""
        self._state.set_text("")
        self._place.clear()

    def show(self, found: dict[str, Any]) -> None:
        """Show the sensitivities that were computed."""
        names = list(found["values"])
        self._place.clear()
        with self._place:
            with tag("ul", classes="plain"):
                for one in found["rankings"]:
                    tag("li", _ranking(one))
            with (
                tag("div", classes="scroll", tabindex="0", role="region", aria_label="Sensitivities"),
                tag("table"),
            ):
                tag(
                    "caption",
                    "Change at the ends of each plausible range, extrapolated linearly: for ranking only",
                )
                with tag("thead"), tag("tr"):
                    tag("th", "Number", scope="col")
                    tag("th", "Plausible", scope="col")
                    for name in names:
                        tag("th", f"{name.replace('_', ' ')} [{found['units'][name]}]", scope="col")
                with tag("tbody"):
                    for one in found["ranked"]:
                        _ranked(one, names)
            tag("h3", "Prices of the active bounds")
            with tag("ul", classes="plain"):
                for price in found["prices"]:
                    tag("li", _price(price, found["units"]))
                if not found["prices"]:
                    tag("li", "No bound is active.")


def _ranking(one: dict[str, Any]) -> str:
    """Return what a quantity depends on most; a linear change over whole ranges gives no valid error bar."""
    unit = "" if one["unit"] == "1" else f" {one['unit']}"
    parts = ", ".join(f"{name} ({share:.0%})" for name, share in list(one["ranking"].items())[:3])
    due = "no plausible range moves it"
    if parts:
        due = f"largest shares of the variance, to first order: {parts}"
    elif one["set_by_limit"]:
        due = "set by the limit, so it is no prediction and has no error bar"
    return f"{str(one['quantity']).replace('_', ' ')} {number(one['value'])}{unit}; {due}"


def _ranked(one: dict[str, Any], names: list[str]) -> None:
    with tag("tr"):
        # Spaces let a narrow column break the path between its words.
        tag("th", one["path"].replace(".", " ").replace("_", " "), scope="row")
        scale, unit = for_people(one["unit"])
        ends = one["plausible"]
        tag("td", "±1 %" if ends is None else f"{scale * ends[0]:.3g} to {scale * ends[1]:.3g} {unit}".rstrip())
        for name in names:
            tag("td", "{:+.2g}, {:+.2g}".format(*one["swings"][name]))


def _price(price: dict[str, Any], units: dict[str, str]) -> str:
    in_degrees = price["unit"] == "rad"
    per = math.radians(1.0) if in_degrees else 0.01 * price["size"]
    amount = "1 deg" if in_degrees else f"{per:.3g} {price['unit']}"
    changes = [
        f"{slope * per:+.3g} {units[name]} of {name.replace('_', ' ')}" for name, slope in price["by"].items()
    ]
    return f"{amount} more of {price['path']}: {', '.join(changes)}"
