"""What ``orbit`` and ``simulate`` report about a filmed wingbeat."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import Parameter

from wingbeat.experiment import FilmedBeat
from wingbeat.experiment.film import WHOLE
from wingbeat.nomenclature import NOMENCLATURE, for_people, plain_unit
from wingbeat.results.rows import power_label

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit
    from wingbeat.results.spread import Spread

# Number of random draws of the film that are solved for an error bar, which is then accurate to an eighth.
DRAWS = 32
Kinematics = Annotated[
    Path | None,
    Parameter(
        help="A filmed wingbeat (.csv): phase, or time and '# frequency = ..', with flap_deg, pitch_deg, ..."
    ),
]
_POWERS = ("mean_power", "mean_positive_power", "peak_power")


def film_record(beat: FilmedBeat) -> dict[str, Any]:
    """Return the spline fits of a film, fit for JSON."""
    laws = {
        name: {"frames": law.frames, "residual_sd": law.residual_sd, "degrees_of_freedom": law.degrees}
        for name, law in beat.laws.items()
    }
    return {"film": beat.film.name, "synthetic": beat.film.synthetic, "laws": laws, "notes": list(beat.notes)}


def film_lines(beat: FilmedBeat) -> list[str]:
    """Describe the spline fits of a film, with a line for each column, and its notes."""
    lines = []
    for name, law in beat.laws.items():
        unit = f"of the {WHOLE[name]}" if name in WHOLE else "deg"
        lines.append(
            f"{beat.film.name}, {name}: {law.frames} frames, residual {law.residual_sd:.2g} {unit}, spline "
            f"with {law.degrees:.3g} degrees of freedom"
        )
    return [*lines, *(f"note: {note}" for note in beat.notes)]


def spread_record(spread: Spread) -> dict[str, Any]:
    """Return the standard errors of an orbit, fit for JSON."""
    errors = {name: spread.standard_error(name) for name in spread.values}
    return {"draws": spread.asked, "draws_certified": spread.certified, "standard_errors": errors}


def spread_lines(spread: Spread, orbit: Orbit) -> list[str]:
    """Return lines with the powers and trims of an orbit and their standard errors."""
    record, lines = orbit.record(), []
    for name in _POWERS:
        shown, unit = plus_minus(record[name], spread.standard_error(name)), plain_unit(name)
        lines.append(f"{power_label(name)}: {shown} {unit}")
    for name in orbit.problem.free:
        error = spread.standard_error(f"wingbeat.{name}") if f"wingbeat.{name}" in spread.values else None
        value = record["wingbeat"].get(name)
        if value is None:
            continue  # a harmonic, which stands in a list
        factor, unit = for_people(NOMENCLATURE[name].unit)
        shown = plus_minus(factor * value, None if error is None else factor * error)
        lines.append(f"trimmed {name.replace('_', ' ')}: {shown} {unit}".rstrip())
    edge = "; the other draws have none: the wingbeat is close to the limit of flight, and errors may be larger"
    ending = "" if spread.certified == spread.asked else edge
    flown = f"{spread.certified} of {spread.asked} random draws of the film have an orbit"
    return [*lines, f"one standard error; {flown}{ending}"]


def plus_minus(value: float, error: float | None) -> str:
    """Return a value and its error, to the error's second digit.

    >>> plus_minus(25.1234, 0.812)
    '25.12 +- 0.81'
    """
    if error is None or not error > 0:
        return f"{value:.4g} +- ?"
    digits = max(1 - math.floor(math.log10(error)), 0)
    return f"{value:.{digits}f} +- {error:.{digits}f}"
