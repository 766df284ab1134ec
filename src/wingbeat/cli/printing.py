"""Reports on a terminal; this module imports nothing heavy."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wingbeat._base import Report, Tone, lines_of

if TYPE_CHECKING:
    from rich.console import Console

_STYLES: dict[Tone, str] = {
    "title": "bold",
    "good": "bold green",
    "doubtful": "bold yellow",
    "bad": "bold red",
    "warning": "yellow",
}


def print_report(report: Report, console: Console) -> None:
    """Print a report; its text is that of `summary`, with colours on a terminal."""
    from rich.text import Text

    for line in lines_of(report, console.width):
        styled = Text(line.text)  # as Text, for names come from files
        if line.toned:
            styled.stylize(_STYLES[line.tone], 0, line.toned)
        console.print(styled, soft_wrap=True)
