"""Arguments of several commands: options in few words, ranges of numbers, and checks of the files they name.

Nothing heavy is imported here: also commands that need no arrays and no data sets take their options from it.
"""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import fields, is_dataclass
from decimal import Decimal, InvalidOperation
from fractions import Fraction
from math import floor, lcm
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter, Token

from wingbeat._base import FaultList, writing
from wingbeat.plots import check_figure_name

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

# --- options ---


def option(text: str, *names: str, signed: bool = False) -> Parameter:
    """Return an option or an argument with its help, and its names if it is not called as its parameter is.

    The value of a `signed` one may begin with a minus that belongs to no number, as in ``--up -y``.
    """
    return Parameter(name=names or None, help=text, allow_leading_hyphen=signed)


def flag(text: str) -> Parameter:
    """Return an option that is either given or not, with its help."""
    return Parameter(negative="", help=text)


def several(text: str, *names: str) -> Parameter:
    """Return an `option` that takes all values up to the next option."""
    return Parameter(name=names or None, consume_multiple=True, negative=(), help=text)


def figure(what: str) -> Parameter:
    """Return the option of a figure's file."""
    return option(f"{what}: .png, .pdf or .svg.")


def written_to(text: str) -> Parameter:
    """Return the option ``--output``, with its help."""
    return option(text, "--output", "-o")


def _whole(type_: type, tokens: Sequence[Token]) -> int:
    """Return a whole number, or refuse it; cyclopts alone would round 1.5."""
    text = tokens[0].value
    try:
        return int(text)
    except ValueError:
        raise ValueError(f'"{text}" is not a whole number') from None


Whole = Annotated[int, Parameter(converter=_whole)]
Seed = Annotated[Whole, option("Seed of the random starts.")]
Output = Annotated[
    Path | None, written_to("Write the result: .nc for `show`, `plot`, `view`; .csv; .mat for MATLAB.")
]


def named_numbers(
    faults: FaultList, option: str, words: list[str] | None, names: Sequence[str], example: str
) -> dict[str, float]:
    """Return the numbers of words such as ``w=3`` by name, and note what cannot be read."""
    found: dict[str, float] = {}
    if words is not None and not words:
        faults.add(option, "", "must be NAME=VALUE", f"for example {example}")
    for word in words or []:
        name, _, text = word.partition("=")
        try:
            value = float(text)
        except ValueError:
            faults.add(option, word, "must be NAME=VALUE with a number", f"for example {example}")
            continue
        if name in found:
            faults.add(option, word, "is given twice", "keep one of them")
        faults.choice(option, name, tuple(names))
        found[name] = value
    return found


def given_beside(command: Callable[..., Any], values: dict[str, Any], *allowed: str) -> list[str]:
    """Return the options, as typed, that differ from their defaults, except those in `allowed`."""
    defaults = {name: parameter.default for name, parameter in inspect.signature(command).parameters.items()}
    names = []
    for name, value in values.items():
        if is_dataclass(value):
            names += [field.name for field in fields(value) if getattr(value, field.name) != field.default]
        elif name not in allowed and value != defaults[name]:
            names.append(name)
    return ["SPECIES" if name == "species" else "--" + name.strip("_").replace("_", "-") for name in names]


def as_typed(**values: Any) -> list[str]:
    """Return options as words of a command line; those that are None are left out.

    >>> as_typed(set=["wing.mass=0.02", "air.density=1.1"], climb=None, hand_from=0.5)
    ['--set', 'wing.mass=0.02', '--set', 'air.density=1.1', '--hand-from', '0.5']
    """
    words = []
    for name, value in values.items():
        for one in value if isinstance(value, list | tuple) else [] if value is None else [value]:
            words += [f"--{name.replace('_', '-')}", str(one)]
    return words


# --- ranges of numbers: ``start:stop:step``, the stop included ---

_MAX_VALUES = 10_000_000
_MAX_DIGITS = 12
_SYNTAX = "write start:stop:step, for example 0:110:2, or one number"


def _exact(faults: FaultList, where: str, text: str) -> Fraction | None:
    """Return the decimal number exactly, or None with a fault noted."""
    try:
        number = Decimal(text.strip())
    except InvalidOperation:
        faults.add(where, text, "is not a number", _SYNTAX)
        return None
    if not number.is_finite():
        faults.add(where, text, "must be finite", _SYNTAX)
        return None
    exponent = number.as_tuple().exponent
    # Read exactly, 1e999999 would fill the memory.
    if number and (number.adjusted() > _MAX_DIGITS or int(exponent) < -_MAX_DIGITS):
        faults.add(where, text, f"has more than {_MAX_DIGITS} digits before or after the point", "round it")
        return None
    return Fraction(number)


def parse_range(text: str, where: str) -> NDArray[np.float64]:
    """Return the numbers of ``start:stop:step``, both ends included exactly, or a single number, shape (n,).

    >>> parse_range("0:0.3:0.1", "--alpha").tolist()
    [0.0, 0.1, 0.2, 0.3]
    >>> parse_range("5", "--alpha").tolist()
    [5.0]
    """
    import numpy as np

    faults = FaultList()
    pieces = str(text).split(":")
    if len(pieces) not in (1, 3):
        faults.add(where, text, f"has {len(pieces)} numbers instead of 1 or 3", _SYNTAX)
        faults.raise_if_any()
    parts = [part for piece in pieces if (part := _exact(faults, where, piece)) is not None]
    faults.raise_if_any()
    if len(parts) == 1:
        return np.array([float(parts[0])])
    start, stop, step = parts
    if step == 0:
        faults.add(where, text, "the step must not be 0", _SYNTAX)
        faults.raise_if_any()
    steps = (stop - start) / step
    if steps < 0:
        faults.add(where, text, "the step leads away from the stop", "reverse the sign of the step")
    elif steps >= _MAX_VALUES:
        faults.add(where, text, f"gives more than {_MAX_VALUES} values", "take a larger step")
    elif steps.denominator != 1:
        nearest = float(start + floor(steps) * step), float(start + (floor(steps) + 1) * step)
        fix = f"stop at {nearest[0]:g} or {nearest[1]:g}, or change the step"
        faults.add(where, text, "the stop is not a whole number of steps from the start", fix)
    faults.raise_if_any()
    # In whole units of the common denominator every value is exact, and its quotient rounded only once.
    unit = lcm(start.denominator, step.denominator)
    return np.array([(int(start * unit) + i * int(step * unit)) / unit for i in range(int(steps) + 1)])


# --- files ---


class _Enough(Exception):
    """Raised to leave `writing` once it has shown that a path can be written; nothing is written yet."""


def check_result(faults: FaultList, output: Path | None, *read: Path | str | None, **figures: Path | None) -> None:
    """Note what `check_files` notes, and a result's name with an unknown ending.

    `check_outputs` refuses folders and devices.
    """
    if output is not None and (os.path.isfile(output) or not os.path.exists(output)):
        from wingbeat.records.result_files import check_result_name

        check_result_name(faults, "--output", output)
    check_files(faults, output, *read, **figures)


def check_files(
    faults: FaultList, output: Path | None = None, *read: Path | str | None, **figures: Path | None
) -> None:
    """Note figure names without a figure's suffix, and what `check_apart` notes."""
    drawn = {f"--{name.replace('_', '-')}": path for name, path in figures.items()}
    for given, path in drawn.items():
        if path is not None:
            check_figure_name(faults, given, path)
    check_apart(faults, [("--output", output), *drawn.items()], *read)


def check_apart(faults: FaultList, written: Sequence[tuple[str, Path | None]], *read: Path | str | None) -> None:
    """Note files, each with its option, that are written twice, or written over one that the command reads."""
    taken = {_real(path): "" for path in read if path is not None}
    for given, path in written:
        if path is None:
            continue
        other = taken.setdefault(_real(path), given)
        if not other:
            faults.add(given, str(path), "is a file that the command reads", "choose another name")
        elif other != given:
            faults.add(given, str(path), f"is also the file of {other}", "give each option its own file")


def _real(path: Path | str) -> str:
    """Return the path of the file itself, behind links."""
    with suppress(ValueError):  # a NUL in the path; it is refused later, when the file is opened
        return os.path.realpath(path)
    return str(path)


def check_outputs(*paths: Path | None) -> None:
    """Refuse a path that cannot be written, before the work starts; an existing file is not changed."""
    for path in paths:
        if path is not None:
            with suppress(_Enough), writing(path):
                raise _Enough
