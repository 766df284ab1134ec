"""Objectives of a study: names that wingbeat knows, or a function in a Python file, ``mine.py:mean_lift``.

The code that runs is always what `as_inputs` has just read from the user's file. A store holds only its digest, and
nothing that a store holds is run.
"""

from __future__ import annotations

import functools
import hashlib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from wingbeat._base import FaultList, first_line, read_text
from wingbeat.orbits.problem.quantities import Quantity, named_objective

_MARK = ".py:"


def as_inputs(text: str, folder: Path) -> dict[str, str]:
    """Return inputs from which a worker makes an objective; a function's file is included as text.

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


def described(inputs: Mapping[str, str]) -> dict[str, str]:
    """Return what a store may hold of the inputs of an objective: the digest of the code instead of the code.

    >>> described({"name": "lift", "file": "mine.py", "code": "def lift(beat): ..."})["digest"][:8]
    '8e1f8275'
    """
    kept = {key: value for key, value in inputs.items() if key != "code"}
    return kept | ({"digest": hashlib.sha256(inputs["code"].encode()).hexdigest()} if "code" in inputs else {})


def changed_code(ours: Iterable[Mapping[str, str]], kept: Iterable[Mapping[str, Any]]) -> str:
    """Return in words which functions of a study's files differ from those that a store's points were made with.

    Parameters
    ----------
    ours : inputs of the study's objectives, in the form of `as_inputs`.
    kept : inputs of the bases in the store, in the form of `Recipe.described`.
    """
    theirs = [described(inputs["objective"]) for inputs in kept]
    changed = {
        f"{one['file']}:{one['name']}"
        for one in map(described, ours)
        if "digest" in one
        and one not in theirs
        and any((one["file"], one["name"]) == (other.get("file"), other.get("name")) for other in theirs)
    }
    rule = "differs from the one that they were made with"
    return "".join(f": the objective {what} {rule}" for what in sorted(changed))


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
