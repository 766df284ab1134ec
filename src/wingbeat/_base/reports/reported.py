"""`Reported`, the notebook manners of a result, and `drawn`, which finds the figure that belongs to it."""

from __future__ import annotations

import importlib
from typing import Any

from wingbeat._base.reports.blocks import Report
from wingbeat._base.reports.html import html_of
from wingbeat._base.reports.text import WIDTH, text_of


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


def drawn(page: str, *given: Any, **options: Any) -> Any:
    """Return a page of `wingbeat.plots`.

    The package is looked up by name when the page is drawn. Pages know the results that they draw, so results
    cannot import pages.

    Parameters
    ----------
    page : name of the function that draws it.
    given, options : its arguments.
    """
    return getattr(importlib.import_module("wingbeat.plots"), page)(*given, **options)
