"""Messages about errors at the top of the page."""

from __future__ import annotations

from wingbeat_explorer.app.widgets import button, tag

_MOST_LINES = 10


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
