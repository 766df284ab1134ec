"""Docstrings of wingbeat as Sphinx reads them.

A parameter stands as ``name : meaning``. In numpydoc's form, a type stands after the colon. Here types stand in
the signature, so the meaning moves to the line below. Text and examples after the last section get headings of
their own, because a section of numpydoc ends only at the next heading.
"""

from __future__ import annotations

import itertools
import re
from typing import TYPE_CHECKING, Any

import lazy_loader

import wingbeat
import wingbeat_evidence

if TYPE_CHECKING:
    from sphinx.application import Sphinx

_SECTIONS = ("Parameters", "Returns", "Raises", "Attributes", "Yields")
_ENTRY = re.compile(r"^(\S[^:]*?) : (.+)$")
_CITED = re.compile(r"(?<=Theory: )equations? [^.]+(?=\.)")
_LABEL = re.compile(r"``([a-z0-9-]+)``")
_NAME = re.compile(r"(?<![`:\w])`([A-Za-z_][\w.]*)`(?!`)")
# Each public name, and under which it has its page.
_PLACE = {
    name: f"{package.__name__}.{name}"
    for package in (wingbeat_evidence, wingbeat)
    for name in lazy_loader.attach_stub(package.__name__, str(package.__file__))[2]
}


def in_numpydoc_form(lines: list[str]) -> list[str]:
    """Return the lines of a docstring with each meaning below its name, and headings after the last section."""
    found: list[str] = []
    inside, before = False, ""
    for line, below in itertools.zip_longest(lines, lines[1:], fillvalue=""):
        entry = _ENTRY.match(line) if inside else None
        if below and set(below) == {"-"}:
            inside = line.strip() in _SECTIONS
        elif line.startswith(">>>") and not before and found:
            found += ["Examples", "--------"]
            inside = False
        elif inside and not before and line and not line.startswith(" ") and not entry and set(line) != {"-"}:
            found += ["Notes", "-----"]
            inside = False
        found += [entry[1], f"    {entry[2]}"] if entry else [line]
        before = line
    return found


def equations_linked(lines: list[str]) -> list[str]:
    """Return the lines of a docstring with links to the equations that it names."""
    linked = _CITED.sub(lambda cited: _LABEL.sub(r"\1 :eq:`\1`", cited[0]), "\n".join(lines))
    return linked.split("\n")


def names_linked(lines: list[str]) -> list[str]:
    """Return the lines of a docstring with links to public names of our packages; other names are code."""

    def link(name: re.Match[str]) -> str:
        return f":py:obj:`~{_PLACE[name[1]]}`" if name[1] in _PLACE else f"``{name[1]}``"

    return _NAME.sub(link, "\n".join(lines)).split("\n")


def _process(app: Sphinx, what: str, name: str, of: Any, options: Any, lines: list[str]) -> None:
    lines[:] = names_linked(equations_linked(in_numpydoc_form(lines)))


def setup(app: Sphinx) -> dict[str, Any]:
    """Run before napoleon, which has the default priority of 500."""
    app.connect("autodoc-process-docstring", _process, priority=400)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
