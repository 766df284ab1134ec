"""Numbers as the page shows them: with units, angles in degrees, and rounded."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable
from typing import Any

from wingbeat._base import NOMENCLATURE, Fault, for_people
from wingbeat.animal.species.numbers import Number, display
from wingbeat.words.orbit_words import mass_of

_LONGEST_LABEL, _LONGEST_ENDING = 60, 8  # characters


def number(value: float | None, digits: int = 4) -> str:
    """Return a number with at most `digits` digits, without trailing zeros; a dash if there is none."""
    return "–" if value is None else f"{value:.{digits}g}"


def sentence(where: str, message: str) -> str:
    """Return a fault as a complete sentence: what was refused and why."""
    text = message if message.endswith((".", "?")) else f"{message}."
    return f"{where}: {text}" if where else text


def refusals(faults: Iterable[Fault]) -> list[list[str]]:
    """Return [where, message] of each fault, as the page shows them."""
    return [[fault.where, f"{fault.rule}; {fault.fix}" if fault.fix else fault.rule] for fault in faults]


def not_a_number(text: str) -> str:
    """Return the message for a text that is not a number."""
    return f"{text[:30]!r} is not a number; type one, such as 9.5"


def spoken_path(path: str) -> str:
    """Return the short name of a number: ``mass`` for ``vehicle.wing.mass``."""
    return path.rpartition(".")[2].replace("_", " ")


def shown_text(path: str, number: Number) -> str:
    """Return a number as the user would type it, angles in degrees."""
    value = display(path, number)[1].value
    return ", ".join(f"{part:.10g}" for part in value) if isinstance(value, tuple) else f"{value:.10g}"


def range_text(path: str, number: Number) -> str:
    """Return the plausible range of a number in words; an empty text if none is known."""
    limits = display(path, number)[1].range
    return "" if limits is None else f"plausible {limits[0]:.4g} to {limits[1]:.4g}"


def from_shown(text: str, unit: str, several: bool) -> float | tuple[float, ...] | None:
    """Return the typed number or numbers (separated by commas) in SI units and radians; None if not a number."""
    try:
        parts = tuple(float(part) for part in text.replace(";", ",").split(","))
    except ValueError:
        return None
    if not all(math.isfinite(part) for part in parts) or (len(parts) > 1 and not several):
        return None
    # An angle goes through math.radians, as it does in a species file, so that the same number comes out.
    values = [math.radians(part) for part in parts] if unit == "rad" else list(parts)
    return tuple(values) if len(values) > 1 else values[0]


def tiles(record: dict[str, Any]) -> list[tuple[str, str, str, str]]:
    """Return the headline numbers of a record: label, number, unit, and all digits."""
    vehicle, power = record["vehicle"], record.get("mean_positive_power")
    mass = mass_of(vehicle)
    frequency = record["wingbeat"]["frequency"]
    amplitude = math.degrees(record["wingbeat"]["flap_amplitude"])
    cost = record.get("cost_of_transport")
    found = [
        ("frequency", "Wingbeat frequency", number(frequency), repr(frequency)),
        ("mean_positive_power", "Mean positive power", number(power), repr(power)),
        (
            "positive_power_per_mass",
            "Power per mass",
            number(None if power is None else power / mass, 3),
            repr(power),
        ),
        ("flap_amplitude", "Flap amplitude", number(amplitude, 3), repr(amplitude)),
        ("cost_of_transport", "Cost of transport", number(cost, 3), repr(cost)),
    ]
    return [(label, value, for_people(NOMENCLATURE[name].unit)[1], exact) for name, label, value, exact in found]


def clean_label(name: str) -> str:
    r"""Return a file's name for messages: the last part of its path, printable, shortened before its ending.

    >>> clean_label("../../etc/my\nbat.toml"), clean_label(80 * "a" + ".pol")[-8:]
    ('mybat.toml', 'aaaa.pol')
    """
    last = name.replace("\\", "/").rpartition("/")[2]
    stem, ending = os.path.splitext("".join(c for c in last if c.isprintable()).strip())
    ending = ending[:_LONGEST_ENDING]
    return stem[: _LONGEST_LABEL - len(ending)] + ending or "the file"
