"""Figures as files: PNG, PDF or SVG, the same bytes for the same figure."""

from __future__ import annotations

import os
from os import PathLike
from typing import TYPE_CHECKING, Any

from wingbeat._base import FaultList, writing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FIGURE_SUFFIXES = (".png", ".pdf", ".svg")

_SAVING: dict[str, Any] = {"pdf.fonttype": 42, "svg.hashsalt": "wingbeat"}


def check_figure_name(faults: FaultList, where: str, path: str | PathLike[str]) -> None:
    """Note a fault unless the suffix of a name is that of a figure that can be written.

    Parameters
    ----------
    faults : receives the fault.
    where : the name of the option or argument.
    path : of the figure.
    """
    if os.path.splitext(path)[1].lower() not in FIGURE_SUFFIXES:
        faults.add(where, os.fspath(path), "is not a figure format", f"end it in {', '.join(FIGURE_SUFFIXES)}")


def save_figure(figure: Figure, path: str | PathLike[str]) -> None:
    """Write a figure as PNG (300 dots per inch), PDF or SVG, by its suffix, completely or not at all.

    The same figure gives the same bytes: no date is written. Text in a PDF stays text.

    Parameters
    ----------
    figure : a figure, such as `wingbeat_page` returns.
    path : of the file to write; its suffix, .png, .pdf or .svg, determines the format.

    Raises
    ------
    InvalidInputError : another suffix.
    FileError : the file cannot be written.
    """
    from matplotlib import rc_context

    from wingbeat._base.notebook_figure import LONG_LINES

    faults = FaultList()
    check_figure_name(faults, "path", path)
    faults.raise_if_any()
    kind = os.path.splitext(path)[1][1:].lower()
    undated: dict[str, Any] = {"png": {}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}[kind]
    with rc_context(_SAVING | LONG_LINES), writing(path) as beside:  # type: ignore[arg-type]
        figure.savefig(beside, format=kind, dpi=300, metadata=undated)
