"""The options ``--gust`` and ``--turbulence``: air that moves while an animal flies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Annotated, Any

import numpy as np
from cyclopts import Parameter

from wingbeat.cli.options import Whole
from wingbeat.errors import FaultList
from wingbeat.winds import LEVELS, CosineGust, DrydenTurbulence, Wind

Gust = Annotated[
    list[str] | None,
    Parameter(
        consume_multiple=True,
        negative=(),
        help="Gust that rises and falls once: u=1 w=3 start=0.2 duration=0.5 (forward and up [m/s], times [s]).",
    ),
]
Turbulence = Annotated[
    str | None,
    Parameter(help=f"Dryden turbulence 30 m above the ground: {', '.join(LEVELS)}. See --wind-seed."),
]
WindSeed = Annotated[Whole, Parameter(help="Seed of the turbulence.")]

_KEYS = tuple(field.name for field in fields(CosineGust))


def wind_of(gust: list[str] | None, turbulence: str | None, seed: int, airspeed: float) -> Wind | None:
    """Return the wind that the options ask for, the sum if they ask for several; None for still air.

    Parameters
    ----------
    gust, turbulence, seed : as typed.
    airspeed : of the flight [m/s].

    Raises
    ------
    InvalidInputError : keys or numbers of a gust that cannot be read, and what the winds themselves refuse.
    """
    parts: list[Wind] = []
    if gust is not None:
        parts.append(CosineGust(**_read(gust)))
    if turbulence is not None:
        parts.append(DrydenTurbulence(airspeed, turbulence, seed=seed))
    return _sum(parts) if parts else None


def _sum(parts: list[Wind]) -> Callable[[np.ndarray], tuple[Any, Any]]:
    def air(times: np.ndarray) -> tuple[Any, Any]:
        found = [part(times) for part in parts]
        return sum(u for u, _ in found), sum(w for _, w in found)

    return air


def _read(words: list[str]) -> dict[str, float]:
    """Return the numbers of a gust by name; all faults are reported at once."""
    faults, found = FaultList(), {}
    if not words:
        faults.add("--gust", "", "must be NAME=VALUE", "for example w=3")
    for word in words:
        name, _, text = word.partition("=")
        try:
            value = float(text)
        except ValueError:
            faults.add("--gust", word, "must be NAME=VALUE with a number", "for example w=3")
            continue
        if name in found:
            faults.add("--gust", word, "is given twice", "keep one of them")
        faults.choice("--gust", name, _KEYS)
        found[name] = value
    faults.raise_if_any()
    return found
