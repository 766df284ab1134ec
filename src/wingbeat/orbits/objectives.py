"""What an orbit search makes small: an objective is a value with a name, a unit and an exact gradient."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np


class Objective(Protocol):
    """What the search asks of an objective.

    `scale` is a difference that matters, so that the optimiser sees numbers near one; `needs` are the wingbeat
    parameters that must be free for the objective to move.
    """

    @property
    def name(self) -> str:
        """Name in records and on the command line."""
        ...

    @property
    def unit(self) -> str:
        """Unit of the value."""
        ...

    @property
    def scale(self) -> float:
        """A difference that matters."""
        ...

    @property
    def needs(self) -> tuple[str, ...]:
        """Wingbeat parameters that must be free."""
        ...

    def value(self, names: tuple[str, ...], unknowns: Any) -> float:
        """Return the objective at unknowns of these names."""
        ...

    def gradient(self, names: tuple[str, ...], unknowns: Any) -> Any:
        """Return its derivative with respect to the unknowns."""
        ...


@dataclass(frozen=True)
class Frequency:
    """The wingbeat frequency, which Su et al. 2023 (doi 10.48550/arXiv.2302.09602) make least.

    >>> Frequency().value(("body_pitch", "frequency"), [0.1, 6.0])
    6.0
    """

    name: str = "frequency"
    unit: str = "Hz"
    scale: float = 3.0
    needs: tuple[str, ...] = ("frequency",)

    def value(self, names: tuple[str, ...], unknowns: Any) -> float:
        """Return the frequency [Hz]."""
        return float(unknowns[names.index("frequency")])

    def gradient(self, names: tuple[str, ...], unknowns: Any) -> Any:
        """Return the unit vector of the frequency."""
        return np.eye(len(names))[names.index("frequency")]
