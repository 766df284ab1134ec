"""What the paper prints about its figures 5 to 8, whether our orbits agree, and why they may differ."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

# Limits of the tests, the same as those of the claims.
CLOSE, TWICE, NEAR_PEAK = 0.15, (1.7, 2.3), 0.25
_OPEN = (
    "The paper leaves open which mean angles are free and how far the wing may flap. It does not say what the "
    "coefficients are at negative angles of attack, either. Our result depends on each of these."
)
WHY = {
    5: _OPEN,
    6: f"{_OPEN} Wingbeats of another family have other angles.",
    7: f"{_OPEN} The paper gives no wing mass. A wingbeat of lowest frequency does not have the lowest power.",
    8: f"{_OPEN} The paper gives neither the body's pitch inertia nor the position of the shoulder.",
}


class Printed(NamedTuple):
    """A statement that the paper prints, our number in words, and whether it agrees."""

    statement: str
    ours: str
    agrees: bool


def near(value: float, printed: float, share: float) -> bool:
    """Return whether a number differs from a printed one by at most `share` of the printed one."""
    return abs(value / printed - 1.0) <= share


def told(figure: int, printed: Sequence[Printed]) -> str:
    """Return the sentences of a caption: the printed numbers, our numbers, and possible reasons if they differ.

    >>> told(7, [Printed("a peak of 30 W", "31 W", True)])
    'The paper prints a peak of 30 W; ours: 31 W, which agrees.'
    """
    words = [
        f"The paper prints {one.statement}; ours: {one.ours}, which {'agrees' if one.agrees else 'contradicts it'}."
        for one in printed
    ]
    differing = [WHY[figure]] if any(not one.agrees for one in printed) else []
    return " ".join([*words, *differing])
