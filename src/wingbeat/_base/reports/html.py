"""A report as a piece of HTML for notebooks: it loads nothing, and takes its colours from the page around it."""

from __future__ import annotations

import html

from wingbeat._base.reports.blocks import Line, Notes, Report, Row, Table, Tone

# Inline and not a style sheet: a notebook may show many pieces, and some hosts drop style sheets.
_BOX = "font-family:inherit;font-size:0.92em;line-height:1.35;overflow-x:auto;max-width:100%"
_TABLE = "border-collapse:collapse;margin:0.3em 0;color:inherit;background:transparent;font-size:inherit"
_CELL = "padding:0.1em 0.9em 0.1em 0;border:0;background:transparent;color:inherit;vertical-align:top"
_HEAD = f"{_CELL};font-weight:600;border-bottom:1px solid currentColor;opacity:0.75"
_TITLE = f"{_CELL};font-weight:600;padding-top:0.6em;text-align:left"
_LINE = "margin:0.15em 0;color:inherit"
# No colours, which would have to suit light and dark pages: a mark, its weight, and how faint it is.
_TONES: dict[Tone, str] = {
    "": "",
    "title": "font-weight:600",
    "good": "font-weight:600",
    "doubtful": "font-weight:600",
    "bad": "font-weight:600",
    "warning": "font-style:italic",
}
_MARKS: dict[Tone, str] = {"good": "✓ ", "doubtful": "△ ", "bad": "✗ "}
_NUMBERS = "text-align:right;font-variant-numeric:tabular-nums;white-space:pre"
_WORDS = "text-align:left"
_LABEL = "opacity:0.75"


def html_of(report: Report, name: str) -> str:
    """Return a report as one HTML element.

    Parameters
    ----------
    report : its blocks.
    name : of what the report is about, for screen readers.

    >>> html_of([Line("a < b")], "Orbit").count("a &lt; b")
    1
    """
    body = "".join(_block(block) for block in report)
    return f'<div class="wingbeat-report" role="group" aria-label="{html.escape(name)}" style="{_BOX}">{body}</div>'


def _block(block: Line | Notes | Table) -> str:
    if isinstance(block, Line):
        if not block.head:
            return f'<div style="{_styles(_LINE, _TONES[block.tone])}">{_marked(block.text, block.tone)}</div>'
        head = f'<span style="{_TONES[block.tone]}">{_marked(block.head, block.tone)}</span>'
        return f'<div style="{_LINE}">{head}{_text(block.text)}</div>'
    if isinstance(block, Notes):
        items = "".join(f"<li>{_text(text)}</li>" for text in block.texts)
        style = _styles("margin:0.3em 0;padding-left:1.4em", _TONES[block.tone])
        return f'<ul style="{style}">{items}</ul>' if items else ""
    return _table(block)


def _table(table: Table) -> str:
    heads = "".join(
        f'<th scope="col" style="{_styles(_HEAD, _side(side))}">{_text(text)}</th>'
        for text, side in zip(table.headings, table.align, strict=bool(table.headings))
    )
    head = f"<thead><tr>{heads}</tr></thead>" if heads else ""
    body = "".join(_row(row, table) for row in table.rows)
    return f'<table style="{_TABLE}">{head}<tbody>{body}</tbody></table>'


def _row(row: Row, table: Table) -> str:
    columns = len(table.align)
    if len(row.cells) == 1 and columns > 1:
        cell = f'<th scope="rowgroup" colspan="{columns}" style="{_TITLE}">{_text(row.cells[0])}</th>'
        return f'<tr style="background:transparent">{cell}</tr>'
    faint = "" if table.headings else _LABEL
    cells = "".join(
        f'<td style="{_styles(_CELL, _side(side), _TONES[row.tone], faint if i == 0 else "")}">{_text(text)}</td>'
        for i, (text, side) in enumerate(zip(row.cells, table.align, strict=True))
    )
    return f'<tr style="background:transparent">{cells}</tr>'


def _side(side: str) -> str:
    return _NUMBERS if side == "r" else _WORDS


def _styles(*parts: str) -> str:
    return ";".join(part for part in parts if part)


def _marked(text: str, tone: Tone) -> str:
    return _MARKS.get(tone, "") + _text(text)


def _text(text: str) -> str:
    return html.escape(text.strip()).replace("\n", "<br>") if text.strip() else ""
