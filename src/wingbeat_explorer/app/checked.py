"""Values in links and in JSON from elsewhere: each function checks one, and returns None for anything else."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from wingbeat._base import is_number

_LONGEST_WORD = 200
_LONGEST_NUMBER = 40  # characters
_MOST_PARTS = 1000
NO_YES = ("no", "yes")  # a truth value as a text


def number_in(text: str) -> float | None:
    """Return the finite number that a text is."""
    try:
        return finite(float(text)) if len(text) < _LONGEST_NUMBER else None
    except ValueError:
        return None


def value_in(text: str) -> float | list[Any] | None:
    """Return the number or the list of numbers, in brackets, that a text is."""
    if not text.startswith("["):
        return number_in(text)
    parts = [number_in(part) for part in text[1:-1].split(",")] if text.endswith("]") and text != "[]" else []
    return parts if parts and None not in parts else None


def finite(value: Any) -> float | None:
    """Return a finite number as a float."""
    if not is_number(value):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None


def word(value: Any) -> str | None:
    """Return a text of one line that is not too long to be shown."""
    good = isinstance(value, str) and len(value) <= _LONGEST_WORD and value.isprintable()
    return value if good else None


def truth_in(text: str) -> bool | None:
    """Return the truth value that a text is."""
    return text == NO_YES[True] if text in NO_YES else None


def switch(value: Any) -> bool | None:
    """Return a truth value."""
    return value if isinstance(value, bool) else None


def text_of(value: Any) -> str | None:
    """Return a text that UTF-8 can encode; JSON may contain lone surrogates, which have no code in UTF-8."""
    return value if isinstance(value, str) and value.encode(errors="ignore").decode() == value else None


def every(value: Any, check: Callable[[Any], Any]) -> tuple[Any, ...] | None:
    """Return a list whose parts all pass a check, as a tuple."""
    if not isinstance(value, list | tuple) or len(value) > _MOST_PARTS:
        return None
    parts = tuple(check(part) for part in value)
    return None if None in parts else parts


def table(value: Any, check: Callable[[Any], Any]) -> dict[str, Any] | None:
    """Return a dictionary whose names are words and whose values all pass a check."""
    if not isinstance(value, dict):
        return None
    parts = {word(name): check(part) for name, part in value.items()}
    return None if None in parts or None in parts.values() else parts  # type: ignore[return-value]
