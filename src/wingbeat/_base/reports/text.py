"""A report as lines of text of a given width."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator
from itertools import zip_longest
from typing import NamedTuple

from wingbeat._base.reports.blocks import Line, Notes, Report, Row, Table, Tone

WIDTH = 80  # letters
_GAP, _INDENT = "  ", "  "
_NARROWEST = 9  # letters, of a column that wraps


class Printed(NamedTuple):
    """A line of text, of which the first letters may have a tone.

    Attributes
    ----------
    text : of the line.
    tone : of its first letters.
    toned : number of letters with this tone.
    """

    text: str
    tone: Tone
    toned: int


def text_of(report: Report, width: int = WIDTH) -> str:
    """Return a report as text, without colours.

    Parameters
    ----------
    report : its blocks.
    width : of a line [letters].

    >>> print(text_of([Line("closes", "certified: "), Table((Row(("frequency", "6.1 Hz")),))]))
    certified: closes
    frequency  6.1 Hz
    """
    return "\n".join(line.text for line in lines_of(report, width))


def lines_of(report: Report, width: int = WIDTH) -> Iterator[Printed]:
    """Yield the lines of a report.

    Parameters
    ----------
    report : its blocks.
    width : of a line [letters].
    """
    for block in report:
        if isinstance(block, Line):
            yield from _lines(block, width)
        elif isinstance(block, Notes):
            for text in block.texts:
                for i, part in enumerate(_wrapped(text, width - 2)):
                    line = f"{_INDENT if i else '- '}{part}"
                    yield Printed(line, block.tone, len(line))
        else:
            yield from _table(block, width)


def _lines(line: Line, width: int) -> Iterator[Printed]:
    whole = line.head + line.text
    parts = _wrapped(whole, width) if line.wraps else [whole]
    left = len(line.head) if line.head else len(whole)
    for part in parts:
        toned = min(left, len(part)) if line.tone else 0
        yield Printed(part, line.tone, toned)
        left = max(left - len(part) - 1, 0)  # a blank ends at the break


def _wrapped(text: str, width: int) -> list[str]:
    """Return the lines of a text, broken at blanks where it is too wide; its own breaks and indents stay."""
    found = []
    for line in text.split("\n"):
        if len(line) <= width:
            found.append(line)
            continue
        indent = line[: len(line) - len(line.lstrip())]
        found += textwrap.wrap(line, max(width, _NARROWEST), subsequent_indent=indent, break_on_hyphens=False) or [
            ""
        ]
    return found


def _table(table: Table, width: int) -> Iterator[Printed]:
    has_titles = any(len(row.cells) == 1 for row in table.rows) and len(table.align) > 1
    indent = _INDENT if has_titles else ""
    rows = [*([Row(table.headings)] if table.headings else []), *table.rows]
    cells = [_indented(row, indent) for row in rows]
    widths = _widths(table, [row for row in cells if len(row) > 1 or len(table.align) == 1], width)
    for row, shown in zip(rows, cells, strict=True):
        if has_titles and len(row.cells) == 1:
            yield Printed("", "", 0)
            yield Printed(row.cells[0], row.tone, len(row.cells[0]))
            continue
        wrapped = [
            _wrapped(text, size) if side == "l" else text.split("\n")
            for text, size, side in zip(shown, widths, table.align, strict=True)
        ]
        for parts in zip_longest(*wrapped, fillvalue=""):
            sides = zip(parts, widths, table.align, strict=True)
            padded = [part.rjust(size) if side == "r" else part.ljust(size) for part, size, side in sides]
            line = _GAP.join(padded).rstrip()
            yield Printed(line, row.tone, len(line) if row.tone else 0)


def _indented(row: Row, indent: str) -> tuple[str, ...]:
    return row.cells if len(row.cells) == 1 else (indent + row.cells[0], *row.cells[1:])


def _widths(table: Table, cells: list[tuple[str, ...]], width: int) -> list[int]:
    """Return the width of each column; the widest columns of text become narrower until the table fits."""
    columns = zip(*cells, strict=True) if cells else [("",)] * len(table.align)
    widths = [max(len(line) for text in column for line in text.split("\n")) for column in columns]
    widths[0] = max(widths[0], min(table.label_width, width // 2))
    room = width - len(_GAP) * (len(widths) - 1)
    texts = [i for i, side in enumerate(table.align) if side == "l"]
    while sum(widths) > room:
        widest = max(texts, key=lambda i: widths[i], default=None)
        if widest is None or widths[widest] <= _NARROWEST:
            break
        widths[widest] -= 1
    return widths
