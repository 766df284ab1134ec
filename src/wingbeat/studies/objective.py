"""Objectives of a study: names that wingbeat knows, or a function in a Python file, ``mine.py:mean_lift``."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

from wingbeat.errors import FaultList, first_line
from wingbeat.files import read_text
from wingbeat.orbits.problem.quantities import Quantity, named_objective

_MARK = ".py:"


def as_inputs(text: str, folder: Path) -> dict[str, str]:
    """Return inputs that restore an objective on any machine; a function's file is included as text.

    Raises
    ------
    InvalidInputError, FileError : an unknown name, a file that cannot be read or run, no such function.
    """
    if _MARK not in text:
        return {"name": named_objective(text).name}
    file, _, name = text.rpartition(":")
    found = {"name": name, "file": Path(file).name, "code": read_text(folder / file)}
    from_inputs(found)
    return found


def named(text: str) -> str:
    """Return the name of an objective, as in records, for a text that `as_inputs` accepts."""
    return text.rpartition(":")[2] if _MARK in text else named_objective(text).name


def from_inputs(inputs: dict[str, str]) -> Quantity:
    """Return the objective that `as_inputs` described.

    Raises
    ------
    InvalidInputError : its code cannot be run, or does not define it.
    """
    if "code" not in inputs:
        return named_objective(inputs["name"])
    return _run(inputs["name"], inputs["file"], inputs["code"])


@functools.cache
def _run(name: str, file: str, code: str) -> Quantity:
    """Return a quantity from a file's code, cached, because JAX compiles every new function object anew."""
    faults, space = FaultList(), {"__name__": Path(file).stem, "__file__": file}
    where = f"minimise {file}:{name}"
    try:
        exec(compile(code, file, "exec"), space)
    except (Exception, SystemExit) as error:  # whatever a user's file raises
        reason = first_line(error)
        faults.add(where, file, f"cannot be run: {reason}", "correct the file; it may import wingbeat and jax")
        faults.raise_if_any()
    found: Any = space.get(name)
    if isinstance(found, Quantity):
        return found
    if not callable(found):
        faults.add(where, name, "is not a function or a Quantity of that file", "see docs/guide/objectives.md")
        faults.raise_if_any()
    return Quantity(name, found)
