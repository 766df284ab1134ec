"""Figures that a notebook shows as the last value of a cell, also without ``%matplotlib inline``."""

from __future__ import annotations

import io
from typing import Any

from matplotlib import rc_context
from matplotlib.figure import Figure

# The PNG writer draws lines in pieces, because a whole line of thousands of beats is too long for it.
LONG_LINES: dict[str, Any] = {"agg.path.chunksize": 20_000}
_DPI = 144  # letters of 7 points are then 14 pixels high, and a page is 1037 pixels wide


class NotebookFigure(Figure):
    """A figure of matplotlib that notebooks can show by themselves.

    A figure that was not made by ``pyplot`` is shown as a line of text, unless ``%matplotlib inline`` is active.
    """

    def _repr_png_(self) -> bytes:
        out = io.BytesIO()
        with rc_context(LONG_LINES):  # type: ignore[arg-type]
            self.savefig(out, format="png", dpi=_DPI)
        return out.getvalue()
