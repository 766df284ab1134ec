"""Options of the linearisation of a flight."""

from __future__ import annotations

from dataclasses import dataclass

from wingbeat.orbits.options.checks import check_options


@dataclass(frozen=True)
class LinearOptions:
    """Options of the linearisation of a flight.

    Parameters
    ----------
    blocks : the beat is flown in this many times 32 steps. With 12, the multipliers of pigeon and bat differ
        from those of an adaptive flight by less than 1e-4 of the largest multiplier.
    closure : an orbit that misses its start by more than this is refused [-], in the scales of `Mode.disturbance`.
        Flown in these steps, eight orbits of pigeon and bat from 4 to 16 m/s miss by 2e-6 at the most.
    """

    blocks: int = 12
    closure: float = 1e-3

    def __post_init__(self) -> None:
        check_options(self)


DEFAULTS = LinearOptions()
