"""The errors that wingbeat raises, and checks of inputs that collect all faults before they raise one error."""

from __future__ import annotations

import math
import re
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from numbers import Real
from typing import Any, TypeGuard


@dataclass(frozen=True)
class Fault:
    """One fault of an input: where it is, its value, the rule that it breaks, and how to fix it.

    >>> print(Fault("wing.mass", -1.0, "must be > 0 kg", "give the mass of one wing"))
    wing.mass = -1.0: must be > 0 kg; give the mass of one wing
    """

    where: str
    value: Any
    rule: str
    fix: str = ""

    def __str__(self) -> str:
        shown = repr(self.value)
        shown = shown if len(shown) <= 60 else shown[:57] + "..."
        return f"{self.where} = {shown}: {self.rule}" + (f"; {self.fix}" if self.fix else "")


class WingbeatError(Exception):
    """The base class of all errors that wingbeat raises on purpose.

    >>> import wingbeat as wb
    >>> try:
    ...     wb.load_species("pigon")
    ... except wb.WingbeatError as error:
    ...     print(error)
    species = 'pigon': is not a built-in species; did you mean pigeon; or give the path of a .toml file
    """


class InvalidInputError(WingbeatError, ValueError):
    """Input was refused; ``faults`` holds every fault found, and the message has one line for each.

    >>> import wingbeat as wb
    >>> try:
    ...     wb.Body(mass=-0.3, pitch_inertia=0.0)
    ... except wb.InvalidInputError as error:
    ...     print(error.faults[0])
    ...     len(error.faults)
    body.mass = -0.3: must be > 0 kg; give the mass without the wings
    2
    """

    def __init__(self, faults: list[Fault]) -> None:
        self.faults = faults
        super().__init__("\n".join(str(fault) for fault in faults))


class FileError(WingbeatError):
    """A file could not be read or written; the message names the file, the reason and a fix.

    >>> import wingbeat as wb
    >>> try:
    ...     wb.load_orbit("missing.nc")
    ... except wb.FileError as error:
    ...     print(error)
    cannot read 'missing.nc': no such file or directory; check the path
    """


class ClusterError(WingbeatError):
    """Other machines cannot be reached or cannot do the work; the message says which, why, and how to fix it.

    >>> import wingbeat as wb
    >>> def run(study):
    ...     try:
    ...         return study.run(dask="tcp://lab:8786")
    ...     except wb.ClusterError as error:  # for example, no scheduler answers there
    ...         print(error)
    ...         return study.run(processes=2)
    >>> issubclass(wb.ClusterError, wb.WingbeatError)
    True
    """


class ForkError(WingbeatError, RuntimeError):
    """A forked process cannot run JAX if its parent has used JAX; the message says what to do instead.

    >>> import multiprocessing, wingbeat as wb
    >>> context = multiprocessing.get_context("spawn")  # after "fork", a solve in the new process raises ForkError
    >>> context.get_start_method(), issubclass(wb.ForkError, wb.WingbeatError)
    ('spawn', True)
    """


class WorkerError(WingbeatError, RuntimeError):
    """A worker process cannot be started, or two of them died on the same work; the message says which.

    >>> import wingbeat as wb
    >>> def solve(problems):
    ...     try:
    ...         return wb.solve_orbits(problems, processes=2)
    ...     except wb.WorkerError as error:  # for example, a process had too little memory
    ...         print(error)
    ...         return wb.solve_orbits(problems)
    >>> solve([])
    []
    """


def install_extra(extra: str) -> str:
    """Return the command that installs an extra; wingbeat is installed from a clone."""
    return f"in the clone run uv sync --inexact --extra {extra}, or pip install '.[{extra}]'"


def suggest(word: str, known: Iterable[str], *, most: int = 3, otherwise: str | None = None) -> str:
    """Return advice on an unknown word: up to `most` of the nearest known words, or else `otherwise`.

    Without `otherwise`, the advice names all known words if none is near.

    >>> suggest("pigon", ["bat", "pigeon"]), suggest("x", ["bat", "pigeon"]), suggest("x", ["bat"], otherwise="no")
    ('did you mean pigeon?', 'use one of bat, pigeon', 'no')
    """
    known = list(known)
    near = get_close_matches(word[:80], known, n=most, cutoff=0.55)
    if near:
        return f"did you mean {' or '.join(near)}?"
    return f"use one of {', '.join(known)}" if otherwise is None else otherwise


def first_line(error: BaseException) -> str:
    """Return an error's kind and the first line of its message."""
    return f"{type(error).__name__}: {error}".split("\n")[0]


def system_reason(error: Exception) -> str:
    """Return the system's reason for a failure, in lower case and without the path, which our messages contain."""
    return (getattr(error, "strerror", None) or str(error)).lower()


# Characters that change what a terminal shows: escapes and other controls, and marks that turn the way of writing.
_CONTROLS = re.compile(
    "[\x01-\x08\x0e-\x19\x1b-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]|\r(?!\n)"
)


def control_in(value: object) -> str | None:
    """Return a control character in a text, or in the texts of a list or dictionary; None if there is none."""
    if isinstance(value, str):
        found = _CONTROLS.search(value)
        return found and found[0]
    if isinstance(value, dict):
        value = [*value, *value.values()]
    return next(filter(None, map(control_in, value)), None) if isinstance(value, list | tuple) else None


def is_number(value: object) -> TypeGuard[int | float]:
    """Return whether a value is a number in the sense of TOML and JSON; true and false are not."""
    return isinstance(value, int | float) and not isinstance(value, bool)


# Rule and fix for a number that JAX traces, where numbers are checked.
TRACED = (
    "is traced by jax.grad, jit or vmap, and inputs are checked as numbers",
    "for derivatives of an optimum, use wb.differentiable_optimum(orbit, [names of the parameters])",
)


def is_traced(value: object) -> bool:
    """Return whether a value is one of JAX's tracers, which have no number yet."""
    jax = sys.modules.get("jax")  # without JAX there is no such value
    return jax is not None and isinstance(value, jax.core.Tracer)


# The rules for angles by the largest that is allowed. Larger numbers are most likely degrees.
IN_RADIANS = {
    math.pi: "must be an angle in radians, from -pi to pi",
    2 * math.pi: "must be a phase in radians, from -2 pi to 2 pi",
}


# The rule for counts and seeds; where their range is known, `FaultList.whole` says it too.
WHOLE = "must be a whole number"


class FaultList:
    """Collects faults so that a constructor or loader reports them all at once."""

    def __init__(self) -> None:
        self.faults: list[Fault] = []

    def add(self, where: str, value: Any, rule: str, fix: str = "") -> None:
        """Note a fault."""
        self.faults.append(Fault(where, value, rule, fix))

    def number(
        self,
        where: str,
        value: Any,
        *,
        above: float = -math.inf,
        at_least: float = -math.inf,
        below: float = math.inf,
        at_most: float = math.inf,
        unit: str = "",
        fix: str = "",
    ) -> bool:
        """Note a fault unless `value` is a finite real number within the limits; return whether it is."""
        if isinstance(value, bool) or not isinstance(value, Real):
            fix = "write float(...) around it" if getattr(value, "shape", None) == () else fix
            self.add(where, value, *(TRACED if is_traced(value) else ("must be a number", fix)))
            return False
        try:
            number = float(value)
        except OverflowError:  # a whole number beyond the largest float
            number = math.inf
        if not math.isfinite(number):
            self.add(where, value, "must be finite", fix)
        elif not (above < number < below and at_least <= number <= at_most):
            pairs = {">": above, ">=": at_least, "<": below, "<=": at_most}
            limits = [f"{sign} {limit:g}" for sign, limit in pairs.items() if math.isfinite(limit)]
            self.add(where, value, f"must be {' and '.join(limits)} {unit}".rstrip(), fix)
        else:
            return True
        return False

    def angle(
        self, where: str, value: Any, *, at_least: float = -math.inf, fix: str = "", advice: str = ""
    ) -> bool:
        """Note a fault unless `value` is an angle [rad] of at most pi, or 2 pi for a phase; return whether it is.

        `advice` says how to write it in degrees, if there is another way than those of a number's own name.
        """
        if not self.number(where, value, at_least=at_least, unit="rad", fix=fix):
            return False
        name = where.removesuffix(".range").rpartition(".")[2].partition("[")[0]
        most = 2 * math.pi if name.endswith("_phase") else math.pi
        if abs(value) <= most:
            return True
        advice = advice or f"write np.radians({value:g}), or {name}_deg in a species file or --set"
        self.add(where, value, IN_RADIANS[most], f"{value:g} seems to be in degrees: {advice}")
        return False

    def whole(self, where: str, value: Any, least: int, most: int, fix: str = "") -> bool:
        """Note a fault unless `value` is a whole number from `least` to `most`; return whether it is."""
        if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
            self.add(where, value, f"{WHOLE} from {least} to {most}", fix)
            return False
        return True

    def first(self, where: str, column: Any, wrong: Any, rule: str, fix: str = "") -> None:
        """Note the first number of a column, shape (n,), for which `wrong` is true, if there is one."""
        if wrong.any():
            row = int(wrong.argmax())
            self.add(f"{where}[{row}]", float(column[row]), rule, fix)

    def choice(self, where: str, value: Any, allowed: tuple[str, ...]) -> None:
        """Note a fault unless `value` is one of the names in `allowed`."""
        if value not in allowed:
            self.add(where, value, "is not a known choice", f"use one of {', '.join(allowed)}")

    def raise_if_any(self) -> None:
        """Raise `InvalidInputError` with all faults noted so far, if there are any."""
        if self.faults:
            raise InvalidInputError(self.faults)
