"""Names of the harmonics of a wingbeat: ``flap_sin_2`` is the second number of the list ``flap_harmonics``."""

from __future__ import annotations

# The lowest order of each law's harmonics: what is below it has a name of its own.
FIRST_ORDER = {"flap": 2, "pitch": 2, "span": 1, "sweep": 2, "chord": 1, "twist": 1}
# Laws that are a share of a length; the others are angles.
SHARES = ("span", "chord")
HIGHEST_ORDER = 8
HARMONIC_NAMES = tuple(
    f"{law}_{part}_{order}"
    for law, first in FIRST_ORDER.items()
    for order in range(first, HIGHEST_ORDER + 1)
    for part in ("cos", "sin")
)


def harmonic_place(name: str) -> tuple[str, int] | None:
    """Return the list that holds a harmonic, and its index in it; None if the name is not that of a harmonic.

    >>> harmonic_place("flap_sin_2"), harmonic_place("flap_mean")
    (('flap_harmonics', 1), None)
    """
    if name not in HARMONIC_NAMES:
        return None
    law, part, order = name.split("_")
    return f"{law}_harmonics", 2 * (int(order) - FIRST_ORDER[law]) + (part == "sin")
