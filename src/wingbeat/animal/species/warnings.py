"""What looks odd in a species: numbers outside their ranges, derived numbers, parameters without effect."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wingbeat._base import plain_unit
from wingbeat.animal.kinematics import parameter
from wingbeat.animal.species.building import words
from wingbeat.animal.species.law import OUTSIDE
from wingbeat.animal.species_schema import Number, display

if TYPE_CHECKING:
    from wingbeat.animal.species.record import Species

DERIVED = "derived: "  # begins the source of a number that a scaling law gave
NOT_MEASURED = "derived by scaling laws, not measured: "  # begins the warning that lists such numbers


def find_warnings(species: Species) -> tuple[str, ...]:
    """Return one line for each thing that is possible but odd."""
    found = []
    for path, number in (species.numbers | (species.shape.numbers if species.shape else {})).items():
        values = number.value if isinstance(number.value, tuple) else (number.value,)
        if number.range and not all(number.range[0] <= value <= number.range[1] for value in values):
            name, shown = display(path, number)
            unit = "" if shown.unit == "1" else f" {shown.unit}"
            source = f" ({number.source})" if number.source else ""
            low, high = shown.range or number.range
            found.append(
                f"{name} = {words(path, number)} is outside its plausible range {low:g} to {high:g}{unit}{source}"
            )
    for name, (low, high) in species.bounds.items():
        value = parameter(species.wingbeat, name)
        if not low <= value <= high:
            path = f"wingbeat.{name}"
            guess = words(path, Number(value, plain_unit(name)))
            found.append(f"{path} = {guess} is outside its bounds; the solver starts from the nearer bound")
    derived = [
        path.removeprefix("vehicle.")
        for path, number in species.numbers.items()
        if path.startswith("vehicle.") and number.source.startswith(DERIVED)
    ]
    if derived:
        found.append(NOT_MEASURED + ", ".join(derived))
    found += _outside_data(species)
    if species.vehicle.tail is None and (species.wingbeat.tail_tilt or "tail_tilt" in species.free):
        found.append("wingbeat.tail_tilt has no effect: there is no tail; add the table [vehicle.tail]")
    if not species.free:
        found.append("free: no wingbeat parameter is free, so no orbit can be found; add the table [free]")
    return tuple(found)


def _outside_data(species: Species) -> list[str]:
    """Warn of numbers that scaling laws gave outside the data they were fitted to."""
    told = [
        f"{path.removeprefix('vehicle.')} ({number.source.partition(OUTSIDE)[2].partition(' (')[0]})"
        for path, number in species.numbers.items()
        if number.source.startswith(DERIVED) and OUTSIDE in number.source
    ]
    if not told:
        return []
    return [f"scaling laws used outside the data they were fitted to, so unreliable: {'; '.join(told)}"]
