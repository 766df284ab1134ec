"""The blocks of a report: lines, tables and notes, without a word on how they look."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Literal, NamedTuple

# What a text means, from which terminal and page choose its look. "doubtful" is certified, but not plausible.
Tone = Literal["", "title", "good", "doubtful", "bad", "warning"]


class Line(NamedTuple):
    """A line of text.

    Attributes
    ----------
    text : the text after the head.
    head : the first words, if they have a tone of their own.
    tone : of the head; without a head, of the whole text.
    wraps : whether a text that is too long for the page goes on in the next line.
    """

    text: str
    head: str = ""
    tone: Tone = ""
    wraps: bool = True


class Notes(NamedTuple):
    """Texts for the reader, each with a dash before it.

    Attributes
    ----------
    texts : the notes.
    tone : of all of them.
    """

    texts: tuple[str, ...]
    tone: Tone = "warning"


class Row(NamedTuple):
    """A row of a table.

    Attributes
    ----------
    cells : one text for each column; the row of a single cell is a heading of the rows below it.
    tone : of the whole row.
    """

    cells: tuple[str, ...]
    tone: Tone = ""


class Table(NamedTuple):
    """A table.

    Attributes
    ----------
    rows : of the table.
    headings : of the columns; none for a list of labels and values.
    align : a letter for each column: ``l`` for text, which may wrap; ``n`` for names and ``r`` for numbers, which
        may not.
    label_width : least width of the first column [letters].
    """

    rows: tuple[Row, ...]
    headings: tuple[str, ...] = ()
    align: str = "ll"
    label_width: int = 0


Block = Line | Notes | Table
Report = Sequence[Block]

LABEL_WIDTH = 33  # letters; so many hold nearly every label of an orbit, and all its values start in one column


def grouped(groups: Mapping[str, Iterable[tuple[str, str]]]) -> Table:
    """Return a table of labels and values under the titles of their groups; groups without rows are left out.

    Parameters
    ----------
    groups : rows of label and value by the title of the group.

    >>> grouped({"wingbeat": [("frequency", "6.1 Hz")], "stability": []}).rows
    (Row(cells=('wingbeat',), tone='title'), Row(cells=('frequency', '6.1 Hz'), tone=''))
    """
    rows: list[Row] = []
    for title, pairs in groups.items():
        listed = [Row(pair) for pair in pairs]
        rows += [Row((title,), "title"), *listed] if listed else []
    return Table(tuple(rows), label_width=LABEL_WIDTH)
