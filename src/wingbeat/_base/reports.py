"""Reports: what a result says of itself, as blocks that terminals print and notebooks show.

The blocks hold no word on how they look. As HTML, a report loads nothing and takes its colours from the page.
"""

from __future__ import annotations

import html
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import zip_longest
from typing import Literal, NamedTuple

# What a text means, from which terminal and page choose its look. "doubtful" is certified, but not plausible.
Tone = Literal["", "title", "good", "doubtful", "bad", "warning"]


class Line(NamedTuple):
    """A line of text."""

    text: str  # after the head
    head: str = ""  # the first words, if they have a tone of their own
    tone: Tone = ""  # of the head; without a head, of the whole text
    wraps: bool = True  # whether a text that is too long for the page goes on in the next line


class Notes(NamedTuple):
    """Texts for the reader, each with a dash before it."""

    texts: tuple[str, ...]
    tone: Tone = "warning"


class Row(NamedTuple):
    """A row of a table."""

    cells: tuple[str, ...]  # one for each column; the row of a single cell is a heading of the rows below it
    tone: Tone = ""  # of the whole row


class Table(NamedTuple):
    """A table."""

    rows: tuple[Row, ...]
    headings: tuple[str, ...] = ()  # of the columns; none for a list of labels and values
    align: str = "ll"  # a letter for each column: l for text, which may wrap; n for names, r for numbers
    label_width: int = 0  # least width of the first column [letters]


Block = Line | Notes | Table
Report = Sequence[Block]

LABEL_WIDTH = 33  # letters; so many hold nearly every label of an orbit, and all its values start in one column


def grouped(groups: Mapping[str, Iterable[tuple[str, str]]]) -> Table:
    """Return a table of labels and values under the titles of their groups; groups without rows are left out."""
    rows: list[Row] = []
    for title, pairs in groups.items():
        listed = [Row(pair) for pair in pairs]
        rows += [Row((title,), "title"), *listed] if listed else []
    return Table(tuple(rows), label_width=LABEL_WIDTH)


# --- as text ---

WIDTH = 80  # letters
_GAP, _INDENT = "  ", "  "
_NARROWEST = 9  # letters, of a column that wraps


class Printed(NamedTuple):
    """A line of text, of which the first `toned` letters have a tone."""

    text: str
    tone: Tone
    toned: int


def text_of(report: Report, width: int = WIDTH) -> str:
    """Return a report as text of a width [letters], without colours."""
    return "\n".join(line.text for line in lines_of(report, width))


def lines_of(report: Report, width: int = WIDTH) -> Iterator[Printed]:
    """Yield the lines of a report of a width [letters]."""
    for block in report:
        if isinstance(block, Line):
            whole = block.head + block.text
            left = len(block.head) if block.head else len(whole)
            for part in _wrapped(whole, width) if block.wraps else [whole]:
                yield Printed(part, block.tone, min(left, len(part)) if block.tone else 0)
                left = max(left - len(part) - 1, 0)  # a blank ends at the break
        elif isinstance(block, Notes):
            for text in block.texts:
                for i, part in enumerate(_wrapped(text, width - 2)):
                    line = f"{_INDENT if i else '- '}{part}"
                    yield Printed(line, block.tone, len(line))
        else:
            yield from _table_lines(block, width)


def _wrapped(text: str, width: int) -> list[str]:
    """Return the lines of a text, broken at blanks where it is too wide; its own breaks and indents stay."""
    found = []
    for line in text.split("\n"):
        if len(line) <= width:
            found.append(line)
            continue
        indent = line[: len(line) - len(line.lstrip())]
        parts = textwrap.wrap(line, max(width, _NARROWEST), subsequent_indent=indent, break_on_hyphens=False)
        found += parts or [""]
    return found


def _table_lines(table: Table, width: int) -> Iterator[Printed]:
    has_titles = any(len(row.cells) == 1 for row in table.rows) and len(table.align) > 1
    indent = _INDENT if has_titles else ""
    rows = [*([Row(table.headings)] if table.headings else []), *table.rows]
    cells = [row.cells if len(row.cells) == 1 else (indent + row.cells[0], *row.cells[1:]) for row in rows]
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


# --- as HTML ---

# Inline and not a style sheet: a notebook may show many pieces, and some hosts drop style sheets.
_BOX = "font-family:inherit;font-size:0.92em;line-height:1.35;overflow-x:auto;max-width:100%"
_TABLE = "border-collapse:collapse;margin:0.3em 0;color:inherit;background:transparent;font-size:inherit"
_CELL = "padding:0.1em 0.9em 0.1em 0;border:0;background:transparent;color:inherit;vertical-align:top"
_HEAD = f"{_CELL};font-weight:600;border-bottom:1px solid currentColor;opacity:0.75"
_TITLE = f"{_CELL};font-weight:600;padding-top:0.6em;text-align:left"
_LINE = "margin:0.15em 0;color:inherit"
# No colours, which would have to suit light and dark pages: a mark, its weight, and how faint it is.
_TONES: dict[str, str] = {"": "", "warning": "font-style:italic"}
_TONES |= dict.fromkeys(("title", "good", "doubtful", "bad"), "font-weight:600")
_MARKS: dict[Tone, str] = {"good": "✓ ", "doubtful": "△ ", "bad": "✗ "}
_SIDES = {"l": "text-align:left", "n": "text-align:left"}
_SIDES["r"] = "text-align:right;font-variant-numeric:tabular-nums;white-space:pre"
_LABEL = "opacity:0.75"


def html_of(report: Report, name: str) -> str:
    """Return a report as one HTML element; screen readers say the name of what it is about."""
    body = "".join(_block_html(block) for block in report)
    return f'<div class="wingbeat-report" role="group" aria-label="{html.escape(name)}" style="{_BOX}">{body}</div>'


def _block_html(block: Block) -> str:
    if isinstance(block, Line):
        first, tone = _MARKS.get(block.tone, "") + _text(block.head or block.text), _TONES[block.tone]
        if not block.head:
            return f'<div style="{_styles(_LINE, tone)}">{first}</div>'
        return f'<div style="{_LINE}"><span style="{tone}">{first}</span>{_text(block.text)}</div>'
    if isinstance(block, Notes):
        items = "".join(f"<li>{_text(text)}</li>" for text in block.texts)
        style = _styles("margin:0.3em 0;padding-left:1.4em", _TONES[block.tone])
        return f'<ul style="{style}">{items}</ul>' if items else ""
    heads = "".join(
        f'<th scope="col" style="{_styles(_HEAD, _SIDES[side])}">{_text(text)}</th>'
        for text, side in zip(block.headings, block.align, strict=bool(block.headings))
    )
    head = f"<thead><tr>{heads}</tr></thead>" if heads else ""
    columns, body = len(block.align), ""
    for row in block.rows:
        if len(row.cells) == 1 and columns > 1:
            cells = f'<th scope="rowgroup" colspan="{columns}" style="{_TITLE}">{_text(row.cells[0])}</th>'
        else:
            styles = [_styles(_CELL, _SIDES[side], _TONES[row.tone]) for side in block.align]
            styles[0] = _styles(styles[0], "" if block.headings else _LABEL)
            pairs = zip(styles, row.cells, strict=True)
            cells = "".join(f'<td style="{style}">{_text(text)}</td>' for style, text in pairs)
        body += f'<tr style="background:transparent">{cells}</tr>'
    return f'<table style="{_TABLE}">{head}<tbody>{body}</tbody></table>'


def _styles(*parts: str) -> str:
    return ";".join(part for part in parts if part)


def _text(text: str) -> str:
    return html.escape(text.strip()).replace("\n", "<br>")


# --- results that say what they hold ---


class Reported:
    """A result that says what it holds: as text, and as a table if it is the last value of a notebook's cell."""

    def _report(self) -> Report:
        raise NotImplementedError

    def summary(self, width: int = WIDTH) -> str:
        """Return what is worth knowing as text, in readable units: what the command line prints.

        Parameters
        ----------
        width : of a line [letters].
        """
        return text_of(self._report(), width)

    def _repr_html_(self) -> str:
        return html_of(self._report(), type(self).__name__)
