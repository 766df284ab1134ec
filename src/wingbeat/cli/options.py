"""Options that several commands share, and the checks of the files that they name."""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter, Token

from wingbeat._base import FaultList, FileError, InvalidInputError, first_line, writing
from wingbeat.animal.species.reading import parse_setting
from wingbeat.animal.species.record import Species
from wingbeat.orbits.problem.map_quantities import STABLE_RADIUS
from wingbeat.records.inputs import NotInFileError
from wingbeat.records.result_files import check_result_name


def _whole(type_: type, tokens: Sequence[Token]) -> int:
    """Return a whole number, or refuse it; cyclopts alone would round 1.5."""
    text = tokens[0].value
    try:
        return int(text)
    except ValueError:
        raise ValueError(f'"{text}" is not a whole number') from None


SPECIES = Parameter(help="Name of a species, or path of a species file.")
Climb = Annotated[float, Parameter(help="Mean climb rate [m/s].")]
Whole = Annotated[int, Parameter(converter=_whole)]
Seed = Annotated[Whole, Parameter(help="Seed of the random starts.")]
Limits = Annotated[
    list[str] | None,
    Parameter(consume_multiple=True, negative=(), help="Limits: 'peak_power<=30' 'frequency=6' ..."),
]
Stable = Annotated[
    bool,
    Parameter(negative="", help="Find an orbit on which disturbances decay: short for 'spectral_radius<=0.995'."),
]
Settings = Annotated[
    list[str] | None,
    Parameter(
        name="--set",
        consume_multiple=True,
        negative=(),
        help="Numbers to change, PATH=VALUE: wing.mass=0.02 ... `wingbeat species NAME` lists the paths.",
    ),
]
Payload = Annotated[float, Parameter(help="Load carried at the body's centre of mass [kg].")]
WithinPlausible = Annotated[
    bool,
    Parameter(negative="", help="Keep parameters, powers and forces within the species' plausible ranges."),
]
WingsMayCross = Annotated[
    bool,
    Parameter(negative="", help="Let the wings pass through the plane of symmetry and through each other."),
]


def with_stability(limits: list[str] | None, stable: bool) -> list[str]:
    """Return the limits of ``--subject-to``, with the limit of ``--stable``."""
    return [*(limits or ()), *([f"spectral_radius<={STABLE_RADIUS}"] if stable else [])]


def with_settings(species: Species, settings: list[str] | None, payload: float = 0.0) -> Species:
    """Return a species with the numbers of ``--set`` and a payload; all faults are reported at once."""
    values, faults = {}, FaultList()
    if settings is not None and not settings:
        faults.add("--set", "", "must be PATH=VALUE", "for example wing.mass=0.02")
    for text in settings or []:
        try:
            path, value = parse_setting(text)
        except InvalidInputError as error:
            faults.faults.extend(error.faults)
            continue
        if path in values:
            faults.add("--set", text, "is set twice", "keep one of them")
        values[path] = value
    faults.raise_if_any()
    return (species.with_values(values) if values else species).with_payload(payload)


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


@contextmanager
def unpacking(path: Path) -> Iterator[None]:
    """Raise a `FileError` in place of any error that occurs while the orbit of the file at `path` is set up."""
    try:
        yield
    except NotInFileError as error:
        raise FileError(f"cannot set up the orbit in {str(path)!r} again: {error} in Python") from None
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        reason = first_line(error)
        raise FileError(
            f"cannot read {str(path)!r} as an orbit: its inputs are damaged ({reason}); solve the orbit again"
        ) from None


class _Enough(Exception):
    """Raised to leave `writing` once it has shown that a path can be written; nothing is written yet."""


Output = Annotated[
    Path | None,
    Parameter(
        name=["--output", "-o"], help="Write the result: .nc for `show`, `plot`, `view`; .csv; .mat for MATLAB."
    ),
]


def check_result(faults: FaultList, output: Path | None) -> None:
    """Note an output name with an unknown ending; `check_outputs` refuses folders and devices."""
    if output is not None and (os.path.isfile(output) or not os.path.exists(output)):
        check_result_name(faults, "--output", output)


def check_files(faults: FaultList, output: Path | None = None, **figures: Path | None) -> None:
    """Note figure names without a figure's suffix, and files that two options name."""
    taken = {} if output is None else {_real(output): "--output"}
    for name, figure in figures.items():
        if figure is None:
            continue
        from wingbeat.plots import check_figure_name  # takes 0.15 s, which a command without figures need not spend

        option = f"--{name.replace('_', '-')}"
        check_figure_name(faults, option, figure)
        other = taken.setdefault(_real(figure), option)
        if other != option:
            faults.add(option, str(figure), f"is also the file of {other}", "give each option its own file")


def _real(path: Path) -> str:
    """Return the resolved path of a file; an impossible path is refused later, when it is written."""
    try:
        return os.path.realpath(path)
    except ValueError:  # a NUL
        return str(path)


def check_outputs(*paths: Path | None) -> None:
    """Refuse a path that cannot be written, before the work starts; an existing file is not changed."""
    for path in paths:
        if path is not None:
            with suppress(_Enough), writing(path):
                raise _Enough
