"""What several commands share: how their options turn into a species and its air loads."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

from wingbeat.aero import BladeElement, load_coefficients
from wingbeat.errors import FaultList, InvalidInputError
from wingbeat.species import Species, load_species, parse_setting

Settings = Annotated[
    list[str] | None,
    Parameter(
        name="--set",
        consume_multiple=True,
        negative=(),
        help="Numbers to change, PATH=VALUE with the paths of the record: wing.mass=0.02 air.density=1.0 ...",
    ),
]
AeroName = Annotated[
    str, Parameter(help="Coefficients: su-fan, dickinson, ... (see `polar`), or a table ending in .csv.")
]
Extension = Annotated[
    str,
    Parameter(help="How angles beyond the fit are reached: mirrored, signed-drag, signed, clipped-drag."),
]
BlendWidth = Annotated[float, Parameter(help="Half width of the blends at 0, 90 and 180 degrees [deg].")]
Strips = Annotated[int, Parameter(help="Number of strips of one wing.")]
ForcePoint = Annotated[str, Parameter(help="Where the force acts: quarter-chord or centre-of-pressure.")]


def species_with(name: str, settings: list[str] | None) -> Species:
    """Load a species and change the numbers given with ``--set``; all faults of the settings at once."""
    species = load_species(name)
    values, faults = {}, FaultList()
    for text in settings or []:
        try:
            path, value = parse_setting(text)
        except InvalidInputError as error:
            faults.faults.extend(error.faults)
            continue
        if path in values:
            faults.add("--set", text, "is set twice", "keep one of them")
        values[path] = value
    faults.raise_if_any()
    return species.with_values(values) if values else species


def aero_with(name: str, extension: str, blend_width_deg: float, strips: int, force_point: str) -> BladeElement:
    """Return the air loads that the options ask for."""
    return BladeElement(load_coefficients(name, extension, blend_width_deg), strips, force_point)
