"""The panel of the curve against speed: its range, its state and the table of its points."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from wingbeat_explorer.app.curve import Curve
from wingbeat_explorer.app.formatting import number
from wingbeat_explorer.app.scenario import Scenario
from wingbeat_explorer.app.session import Session
from wingbeat_explorer.app.widgets import Field, button, folded, number_field, set_class, tag

_SWEEP = ("from", "to", "step")


class CurvePanel:
    """What stands below the face of a page's curve.

    Parameters
    ----------
    session, curve : of the page.
    choose : called with the speed whose answer the user wants to see.
    """

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
            self._table = tag(
                "div", classes="scroll", tabindex="0", role="region", aria_label="Points of the curve"
            )

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
            what = f"{asked.species}, {asked.aero}, minimum {asked.minimise.replace('_', ' ')}"
            tag("caption", what)
            with tag("thead"), tag("tr"):
                for head in ("Speed [m/s]", "Frequency [Hz]", "Power [W]", "Status", "Result"):
                    tag("th", head, scope="col")
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
