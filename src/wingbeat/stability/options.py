"""Options of the linearisation of a flight."""

from __future__ import annotations

from dataclasses import dataclass

from wingbeat.orbits.options.checks import check_options


@dataclass(frozen=True)
class LinearOptions:
    """Options of the linearisation of a flight.

    Parameters
    ----------
    blocks : the beat is flown in this many times 32 steps. With 12, the multipliers of pigeon and bat are within
        1e-4 of those of an adaptive flight; with 2, within 2e-3.
    """

    blocks: int = 12

    def __post_init__(self) -> None:
        check_options(self)


DEFAULTS = LinearOptions()
