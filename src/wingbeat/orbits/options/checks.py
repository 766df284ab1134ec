"""The checks that every options class makes."""

from __future__ import annotations

import dataclasses
from typing import Any

from wingbeat._base import FaultList

_MOST = 1_000_000


def check_options(options: Any) -> None:
    """Refuse options that are not positive and finite, or not whole where their default is whole.

    Options that are neither numbers nor tuples of numbers must be of the class of their default.

    Raises
    ------
    InvalidInputError : names every fault.
    """
    faults = FaultList()
    for field in dataclasses.fields(options):
        where, value = f"{type(options).__name__}.{field.name}", getattr(options, field.name)
        default = field.default if field.default_factory is dataclasses.MISSING else field.default_factory()
        if isinstance(default, tuple) and isinstance(default[0], int | float):
            if not isinstance(value, tuple) or not value:
                faults.add(where, value, "must be a tuple of numbers", f"the default is {default}")
                continue
            for i, part in enumerate(value):
                _check_number(faults, f"{where}[{i}]", part, default[0], may_be_zero=True)
        elif isinstance(default, int | float):
            _check_number(faults, where, value, default)
        elif not isinstance(value, type(default)):
            faults.add(where, value, f"must be a {type(default).__name__}")
    faults.raise_if_any()


def _check_number(faults: FaultList, where: str, value: Any, like: float, may_be_zero: bool = False) -> None:
    if isinstance(like, int):
        faults.whole(where, value, 0 if may_be_zero else 1, _MOST)
    elif may_be_zero:
        faults.number(where, value, at_least=0.0)
    else:
        faults.number(where, value, above=0.0)
