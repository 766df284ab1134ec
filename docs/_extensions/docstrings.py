"""Docstrings of wingbeat as Sphinx reads them.

A parameter stands as ``name : meaning``. In numpydoc's form, a type stands after the colon. Here types stand in the
signature, so the meaning moves to the line below.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import wingbeat as wb

if TYPE_CHECKING:
    from sphinx.application import Sphinx


_SECTIONS = ("Parameters", "Returns", "Raises", "Attributes", "Yields")
_ENTRY = re.compile(r"^(\S[^:]*?) : (.+)$")


def meanings_below(lines: list[str]) -> list[str]:
    """Return the lines of a docstring with each meaning below its name, and a heading above the example.

    Without the heading, napoleon takes the example's lines for entries of the section before it.
    """
    found: list[str] = []
    inside = False
    for i, line in enumerate(lines):
        underlined = i + 1 < len(lines) and set(lines[i + 1]) == {"-"}
        if underlined:
            inside = line.strip() in _SECTIONS
        if inside and line.startswith(">>> "):
            found += ["Examples", "--------"]
            inside = False
        entry = _ENTRY.match(line) if inside else None
        if entry:
            found += [entry[1], f"    {entry[2]}"]
        else:
            found.append(line)
    return found


_CITED = re.compile(r"(?<=Theory: )equations? [^.]+(?=\.)")
_LABEL = re.compile(r"``([a-z0-9-]+)``")


def equations_linked(lines: list[str]) -> list[str]:
    """Return the lines of a docstring with links to the equations that it names."""
    text = "\n".join(lines)
    linked = _CITED.sub(lambda cited: _LABEL.sub(r"\1 :eq:`\1`", cited[0]), text)
    return linked.split("\n")


_NAME = re.compile(r"(?<![`:\w])`([A-Za-z_][\w.]*)`(?!`)")


def names_linked(lines: list[str]) -> list[str]:
    """Return the lines of a docstring with links to public names of wingbeat; other names are code."""
    public = set(wb.__all__)
    link = "\n".join(lines)
    return _NAME.sub(lambda m: f":py:obj:`~wingbeat.{m[1]}`" if m[1] in public else f"``{m[1]}``", link).split("\n")


def _process(app: Sphinx, what: str, name: str, of: Any, options: Any, lines: list[str]) -> None:
    lines[:] = names_linked(equations_linked(meanings_below(lines)))


def setup(app: Sphinx) -> dict[str, Any]:
    """Run before napoleon, which has the default priority of 500."""
    app.connect("autodoc-process-docstring", _process, priority=400)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
