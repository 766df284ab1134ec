"""Plain HTML controls, which assistive technology handles best, with labels, units, hints and messages."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from nicegui import ui
from nicegui.element import Element
from nicegui.elements.mixins.text_element import TextElement

from wingbeat_explorer.app.formatting import from_shown, not_a_number

# The typed text is stored in the properties from which the page is drawn; otherwise the next change of any element
# would undo it.
_KEEP = "(event) => { element.props.value = event.target.value; }"
# The value is sent as a text, whatever the control; a client that sends anything else is not one of ours.
_EMIT = "(event) => { element.props.value = event.target.value; emit(event.target.value); }"
_LONGEST = 5000  # characters of one entry
_MOST_LINES = 10


def tag(name: str, text: str | None = None, classes: str = "", **attributes: Any) -> Any:
    """Return an HTML element with a text; the text is escaped and never interpreted as HTML.

    In names of attributes an underscore stands for a hyphen (``aria_label``), and is dropped at the end (``for_``).
    """
    made = Element(tag=name) if text is None else TextElement(tag=name, text=text)
    if classes:
        made.classes(classes)
    for key, value in attributes.items():
        made.props[key.rstrip("_").replace("_", "-")] = value
    return made


class _Part(Element, component="part.js"):
    """An element whose content the browser draws anew without the rest of the page."""


def part(name: str, classes: str, **attributes: Any) -> Any:
    """Return an HTML element like `tag`, for a part of the page that changes often or holds many elements.

    The browser draws its content anew by itself. The element itself belongs to the page around, so its own
    attributes should rarely change.
    """
    made = _Part().classes(classes)
    made.props["as"] = name
    for key, value in attributes.items():
        made.props[key.replace("_", "-")] = value
    return made


def box(title: str, classes: str = "") -> Any:
    """Return a section with a heading; elements made in its ``with`` block are placed below the heading."""
    section = part("section", f"box {classes}")
    with section:
        heading = tag("h2", title)
    section.props["aria-labelledby"] = heading.html_id
    heading.props["id"] = heading.html_id
    return section


def folded(title: str, classes: str = "") -> Any:
    """Return a part of the page that is folded until the user opens it, like `box`."""
    fold = part("details", f"box fold {classes}")
    with fold:
        tag("summary", title)
    return fold


def scrolled(label: str) -> Any:
    """Return a part of the page that scrolls by itself, such as a wide table."""
    return tag("div", classes="scroll", tabindex="0", role="region", aria_label=label)


def heads(*texts: str) -> None:
    """Make the head of a table."""
    with tag("thead"), tag("tr"):
        for text in texts:
            tag("th", text, scope="col")


def set_class(element: Any, name: str, on: bool) -> None:
    """Give an element a class of the style sheet, or remove it."""
    element.classes(name) if on else element.classes(remove=name)


def button(text: str, act: Callable[[], Any], classes: str = "", **attributes: Any) -> Any:
    """Return a button."""
    made = tag("button", text, f"button {classes}", type="button", **attributes)

    def press(_: Any) -> None:
        with made.client:  # what it does may take away the part of the page that the button is in
            act()

    made.on("click", press, args=[])
    return made


class Field:
    """A control that holds the value, inside a row with its label, unit, hint and a place for its fault."""

    def __init__(self, row: Element, control: Any, fault: Any, hint: Any) -> None:
        self.row, self.control, self._fault, self._hint = row, control, fault, hint

    def show(self, value: Any) -> None:
        """Show a value, unless the field already shows it."""
        if self.control.props.get("value") != value:
            self.control.props["value"] = value

    def refuse(self, message: str) -> None:
        """Show a message about the value; an empty message removes it."""
        if self._fault.text == message:
            return
        self._fault.set_text(message)
        set_class(self._fault, "hidden", not message)
        self.control.props.set_optional("aria-invalid", "true" if message else None)

    def mark(self, text: str, odd: bool) -> None:
        """Show the plausible range, and mark a value outside it."""
        self._hint.set_text(text)
        set_class(self.row, "odd", odd)

    def number(self, text: str, unit: str = "") -> float | None:
        """Return the typed number in SI units and radians, or show the fault and return None."""
        value = from_shown(text, unit, several=False)
        if isinstance(value, float):
            return value
        self.refuse(not_a_number(text))
        return None


def _field(label: str, unit: str, hint: str, tip: str, make: Callable[[], Any], wide: bool) -> Field:
    row = tag("div", classes="field wide" if wide else "field")
    with row:
        name = tag("label", label)
        control = make()
        control.props["id"] = control.html_id
        name.props["for"] = control.html_id
        if unit:
            tag("span", unit, "unit", aria_hidden="true")
            name.set_text(label)
            control.props["aria-label"] = f"{label} [{unit}]"
        described = []
        below = tag("p", hint, "hint")
        below.props["id"] = below.html_id
        described.append(below.html_id)
        if tip:
            bubble = tag("span", tip, "tip", role="tooltip")
            bubble.props["id"] = bubble.html_id
            described.append(bubble.html_id)
        fault = tag("p", "", "fault hidden", role="alert")
        fault.props["id"] = fault.html_id
        control.props["aria-describedby"] = " ".join([*described, fault.html_id])
    return Field(row, control, fault, below)


def _heard(
    control: Any, event: str, act: Callable[[str], Any], refuse: Callable[[str], Any], throttle: float = 0.0
) -> None:
    def hear(event: Any) -> None:
        if isinstance(event.args, str) and len(event.args) > _LONGEST:
            refuse(f"the entry has {len(event.args)} characters; at most {_LONGEST} are allowed")
        elif isinstance(event.args, str):
            control.props._suspend_count += 1  # what the browser shows need not be sent back to it
            control.props["value"] = event.args
            control.props._suspend_count -= 1
            with control.client:  # what it does may take away the part of the page that the control is in
                act(event.args)

    if event != "input":
        control.on("input", js_handler=_KEEP)
    control.on(event, hear, js_handler=_EMIT, throttle=throttle, leading_events=True, trailing_events=True)


def _hearing(field: Field, act: Callable[[str], Any]) -> Field:
    _heard(field.control, "change", act, field.refuse)
    return field


def number_field(
    label: str, value: str, act: Callable[[str], Any], *, unit: str = "", hint: str = "", tip: str = ""
) -> Field:
    """Return a field for one number, or several separated by commas; `act` gets the text on entry."""

    def make() -> Any:
        return tag("input", type="text", inputmode="decimal", autocomplete="off", value=value)

    return _hearing(_field(label, unit, hint, tip, make, wide=False), act)


def text_field(label: str, value: str, act: Callable[[str], Any], *, hint: str = "") -> Field:
    """Return a field for a text."""

    def make() -> Any:
        return tag("input", type="text", autocomplete="off", spellcheck="false", value=value)

    return _hearing(_field(label, "", hint, "", make, wide=True), act)


def choice_field(label: str, options: Sequence[tuple[str, str]], value: str, act: Callable[[str], Any]) -> Field:
    """Return a field to choose one of several (value, label) pairs."""

    def make() -> Any:
        control = tag("select", value=value)
        with control:
            for key, text in options:
                tag("option", text, value=key)
        return control

    return _hearing(_field(label, "", "", "", make, wide=True), act)


def slider(label: str, value: float, least: float, most: float, step: float, act: Callable[[str], Any]) -> Any:
    """Return a slider; `act` is called at every movement, at most about twenty times a second."""
    control = tag("input", classes="slider", type="range", min=least, max=most, step=step, aria_label=label)
    control.props["value"] = value
    _heard(control, "input", act, lambda _: None, throttle=0.05)
    return control


class Rows:
    """Groups of labels and values that change in place."""

    def __init__(self) -> None:
        self._whole = tag("div", classes="groups")
        self._labels: list[tuple[str, str]] = []
        self._values: list[Any] = []

    def show(self, groups: Mapping[str, Sequence[Sequence[str]]]) -> None:
        """Show groups under their titles; groups without rows are left out."""
        flat = [(title, label, value) for title, rows in groups.items() for label, value in rows]
        labels = [(title, label) for title, label, _ in flat]
        if labels != self._labels:
            self._build({title: rows for title, rows in groups.items() if rows}, labels)
        for element, (_, _, value) in zip(self._values, flat, strict=True):
            if element.text != value:
                element.set_text(value)

    def _build(self, groups: Mapping[str, Sequence[Sequence[str]]], labels: list[tuple[str, str]]) -> None:
        self._whole.clear()
        self._labels, self._values = labels, []
        with self._whole:
            for title, rows in groups.items():
                with tag("div", classes="group"):
                    tag("h3", title)
                    with tag("dl"):
                        for label, value in rows:
                            with tag("div"):
                                tag("dt", label)
                                self._values.append(tag("dd", value))


def run_script(text: str) -> None:
    """Run a script in the visitor's browser; quote any text of the visitor in it with `json.dumps`."""
    ui.run_javascript(text)


class Trouble:
    """The place of the messages; it is made where the page has it, and hidden while there are none."""

    def __init__(self) -> None:
        self._box = tag("div", classes="trouble hidden", role="alert")
        with self._box:
            self._lines = tag("ul", classes="plain")
            button("Close", self.close, "small")

    def show(self, *lines: str) -> None:
        """Show these messages in place of earlier ones; of many, the first ten."""
        self._lines.clear()
        with self._lines:
            for line in lines[:_MOST_LINES]:
                tag("li", line)
            if len(lines) > _MOST_LINES:
                tag("li", f"And {len(lines) - _MOST_LINES} more.")
        self._box.classes(remove="hidden")

    def close(self) -> None:
        """Hide the messages."""
        self._box.classes("hidden")
