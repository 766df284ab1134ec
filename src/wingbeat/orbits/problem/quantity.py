"""A number or a series computed from one beat, which can be minimised or kept within a limit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from wingbeat._base import FaultList
from wingbeat.orbits.flight.beat import Beat


@dataclass(frozen=True)
class Quantity:
    """A number computed from one wingbeat, or a series along it that counts by its largest value.

    Parameters
    ----------
    name : its name in records and messages.
    of : function of a `Beat`, in JAX-compatible Python; returns a number, or an array (K,) or
        (K, m) of K phases.
    unit : of the value.
    scale : a difference that matters. The optimiser divides the value by it, so that its numbers are near one.
    parameter : name of the wingbeat parameter that equals the quantity, if any. As an objective, the quantity then
        needs no flight.
    in_hover : advice, in words, on what to use instead in hover, if the quantity is undefined at speed 0.
    needs : ``"muscle"`` or ``"motor"`` if the vehicle must have one.

    Raises
    ------
    InvalidInputError : an empty name, a function that cannot be called, a scale that is not positive.

    >>> lift = Quantity("mean_lift", lambda beat: beat.mean(beat.lift.sum(axis=1)), unit="N")
    >>> lift.name
    'mean_lift'
    """

    name: str
    of: Callable[[Beat], Any]
    unit: str = "1"
    scale: float = 1.0
    parameter: str | None = None
    in_hover: str | None = None
    needs: str | None = None

    def __post_init__(self) -> None:
        faults = FaultList()
        if not isinstance(self.name, str) or not self.name.strip():
            faults.add("quantity.name", self.name, "must be a name", "such as mean_lift")
        if not callable(self.of):
            faults.add("quantity.of", self.of, "is not a function", "give a function of a Beat")
        faults.number("quantity.scale", self.scale, above=0, fix="a difference that matters")
        faults.raise_if_any()
