"""The options ``--gust`` and ``--turbulence``: air that moves while an animal flies."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields
from typing import Annotated, Any

import numpy as np
from cyclopts import Parameter

from wingbeat._base import FaultList
from wingbeat.aero.winds import LEVELS, CosineGust, DrydenTurbulence, Wind
from wingbeat.cli.options import Whole, named_numbers

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
        faults = FaultList()
        found = named_numbers(faults, "--gust", gust, _KEYS, "w=3")
        faults.raise_if_any()
        parts.append(CosineGust(**found))
    if turbulence is not None:
        parts.append(DrydenTurbulence(airspeed, turbulence, seed=seed))
    return _sum(parts) if parts else None


def _sum(parts: list[Wind]) -> Callable[[np.ndarray], tuple[Any, Any]]:
    def air(times: np.ndarray) -> tuple[Any, Any]:
        found = [part(times) for part in parts]
        return sum(u for u, _ in found), sum(w for _, w in found)

    return air
