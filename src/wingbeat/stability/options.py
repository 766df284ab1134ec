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
    agreement, most_blocks : the number of steps is multiplied by four until the characteristic polynomial agrees
        with that of the certified multipliers to this share of its largest coefficient, or until there are so many
        times 32 steps. Pigeons in cruise need 12 blocks. In hover the air stands still where the wing turns: with
        12 blocks, a hummingbird's multipliers are wrong by 2e-3.
    closure : an orbit that misses its start by more than this is refused [-], in the scales of `Mode.disturbance`.
        Flown in these steps, eight orbits of pigeon and bat from 4 to 16 m/s miss by 2e-6 at the most.

    >>> import wingbeat as wb
    >>> options = wb.LinearOptions(blocks=48)  # pass them on: wb.linearise(orbit, options=options)
    >>> options.blocks * 32
    1536
    """

    blocks: int = 12
    agreement: float = 1e-5
    most_blocks: int = 192
    closure: float = 1e-3

    def __post_init__(self) -> None:
        check_options(self)


DEFAULTS = LinearOptions()
