"""What stands below the face: the answer in brief and in full, sensitivities, the curve, pinned answers."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from wingbeat._base import NOMENCLATURE, for_people, in_words
from wingbeat_explorer.app.formatting import number, tiles
from wingbeat_explorer.app.scenario import Scenario
from wingbeat_explorer.app.session import Session
from wingbeat_explorer.app.speed_curve import Curve
from wingbeat_explorer.app.widgets import (
    Field,
    Rows,
    box,
    button,
    folded,
    heads,
    number_field,
    part,
    scrolled,
    set_class,
    tag,
)

_SWEEP = ("from", "to", "step")
_MOST_PINS = 8


class Brief:
    """One line below the face: what was solved, and a button that pins it; `pin` is called."""

    def __init__(self, pin: Callable[[], Any]) -> None:
        with part("section", "brief", aria_label="Result in brief"):
            with tag("div", classes="words"):
                self._title = tag("h2", "", "what")
                self._message = tag("p", "", "message")
                self._notes = tag("p", "", "note")
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
        notes = "; ".join(answer.get("notes", ()))
        self._notes.set_text(f"Read from the file of coefficients: {notes}." if notes else "")
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
    """The panel with all numbers of an answer, and buttons that save it: texts and what they call."""

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
            what = "Exact derivatives of the certified optimum with respect to every number on which it depends."
            tag("p", what, "note")
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
            with scrolled("Sensitivities"), tag("table"):
                tag(
                    "caption", "Change at the ends of each plausible range, extrapolated linearly: for ranking only"
                )
                units = [f"{name.replace('_', ' ')} [{found['units'][name]}]" for name in names]
                heads("Number", "Plausible", *units)
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


class CurvePanel:
    """The panel of the curve; `choose` is called with the speed whose answer the user wants to see."""

    def __init__(self, session: Session, curve: Curve, choose: Callable[[float], Any]) -> None:
        self._session, self._curve, self._choose = session, curve, choose
        self._shown: list[dict[str, Any]] = []
        with folded("Curve against speed", "curve"):
            self._build()

    def _build(self) -> None:
        sweep = self._session.scenario.sweep
        with tag("div", classes="sweep"):
            self._fields: list[Field] = [
                number_field(name, f"{value:g}", self._set(i), unit="m/s")
                for i, (name, value) in enumerate(zip(_SWEEP, sweep, strict=True))
            ]
        with tag("div", classes="acts"):
            button("Compute the curve", self._curve.start)
            self._stop = button("Cancel the curve", self._curve.cancel, disabled=True)
        text = "The curve appears by itself, each speed continued from its neighbour. To search every speed from "
        tag("p", f"{text}every start, or to change the range, compute it here.", "note")
        self._state = tag("p", "", "note", role="status")
        self._bar = tag("progress", classes="hidden", max=1, value=0, aria_label="Points of the curve")
        self._found = tag("div", classes="found")
        with self._found:
            tag("p", "These results belong to an earlier request.", "earlier")
            self._table = scrolled("Points of the curve")

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
        set_class(self._found, "stale", not self._curve.suits(scenario))
        for field, value in zip(self._fields, scenario.sweep, strict=True):
            field.show(f"{value:g}")

    def refuse(self, refusals: list[list[str]]) -> None:
        """Show what is wrong with the range."""
        for name, field in zip(_SWEEP, self._fields, strict=True):
            field.refuse("; ".join(message for where, message in refusals if where == f"sweep.{name}"))

    def show(self) -> None:
        """Show state and points of the curve."""
        curve = self._curve
        if self._state.text != curve.state:
            self._state.set_text(curve.state)
        self._stop.props.set_bool("disabled", not curve.is_running)
        set_class(self._bar, "hidden", not curve.is_running)
        self._bar.props["value"] = curve.done
        set_class(self._found, "stale", not curve.suits(self._session.scenario))
        if self._shown != curve.points:
            self._shown = list(curve.points)
            self._table.clear()
            with self._table:
                self._draw()

    def _draw(self) -> None:
        asked = self._curve.asked
        if asked is None or not self._shown:
            return
        with tag("table"):
            tag("caption", f"{asked.species}, {asked.aero}, minimum {asked.minimise.replace('_', ' ')}")
            heads("Speed [m/s]", "Frequency [Hz]", "Power [W]", "Status", "Result")
            with tag("tbody"):
                for point in self._shown:
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


class Pins:
    """The pinned answers of a page: a table to compare them.

    `fly_beside` is called with the answer to show as a ghost, or with None; `bring_back` with the one whose choices
    the form should show again.
    """

    def __init__(self, fly_beside: Callable[[Any], Any], bring_back: Callable[[Any], Any]) -> None:
        self._fly_beside, self._bring_back = fly_beside, bring_back
        self._answers: list[dict[str, Any]] = []
        self._ghost: dict[str, Any] | None = None
        self._box = box("Pinned results", "pins hidden")
        with self._box:
            self._note = tag("p", "", "note")
            self._place = scrolled("Pinned results")

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
            shown = tiles(self._answers[0]["record"])
            heads(
                "What", *(f"{label} [{unit}]" if unit else label for label, _, unit, _ in shown), "Stable", "Action"
            )
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
