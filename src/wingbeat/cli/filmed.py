"""What ``orbit`` and ``simulate`` report about a filmed wingbeat."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import Parameter

from wingbeat._base import NOMENCLATURE, FaultList, for_people, plain_unit, written
from wingbeat.experiment import FilmedBeat, fit_film, read_film
from wingbeat.experiment.film import WHOLE
from wingbeat.words.orbit_words import power_label

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit
    from wingbeat.results.spread import Spread

# Number of random draws of the film that are solved for an error bar, which is then accurate to an eighth.
DRAWS = 32
Kinematics = Annotated[
    Path | None,
    Parameter(help="A filmed wingbeat (.csv): time [s], or phase in beats, with flap_deg, pitch_deg, ..."),
]
Side = Annotated[
    Literal["both", "left", "right"] | None,
    Parameter(help="With --kinematics: the wing to read where left and right were filmed; default: their mean."),
]
_POWERS = ("mean_power", "mean_positive_power", "peak_power")


def filmed_beat(kinematics: Path, side: str | None) -> FilmedBeat:
    """Read a film and fit its wingbeat."""
    return fit_film(read_film(kinematics, side or "both"))


def check_side(faults: FaultList, side: str | None, kinematics: Path | None) -> None:
    """Note a side that is chosen without a film."""
    if side is not None and kinematics is None:
        faults.add(
            "--side", side, "chooses a wing of a film, but there is none", "give --kinematics, or leave it out"
        )


def film_record(beat: FilmedBeat) -> dict[str, Any]:
    """Return the spline fits of a film, fit for JSON."""
    laws = {
        name: {"frames": law.frames, "residual_sd": law.residual_sd, "degrees_of_freedom": law.degrees}
        for name, law in beat.laws.items()
    }
    film = beat.film
    clock = {"frequency": film.frequency, "frequency_se": film.frequency_se, "frequency_fitted": film.fitted}
    named = {"film": film.name, "synthetic": film.synthetic} | clock
    return named | {"laws": laws, "notes": list(beat.notes), "warnings": list(beat.warnings)}


def film_lines(beat: FilmedBeat) -> list[str]:
    """Describe the spline fits of a film, with a line for each column, and its notes, but not its warnings."""
    lines, film = [], beat.film
    if film.fitted and film.frequency is not None and film.clip is not None:
        shown = written(film.frequency, film.frequency_se, "Hz")
        stated = f"; its file says {film.stated:.5g} Hz" if film.stated else ""
        lines.append(
            f"{film.name}: frequency {shown}, fitted to the {film.clip.beats:.2g} beats of the clip{stated}"
        )
    for name, law in beat.laws.items():
        unit = f"of the {WHOLE[name]}" if name in WHOLE else "deg"
        lines.append(
            f"{beat.film.name}, {name}: {law.frames} frames, residual {law.residual_sd:.2g} {unit}, spline "
            f"with {law.degrees:.3g} degrees of freedom"
        )
    return [*lines, *(f"note: {note}" for note in beat.notes if note not in beat.warnings)]


def spread_record(spread: Spread) -> dict[str, Any]:
    """Return the standard errors of an orbit, fit for JSON."""
    errors = {name: spread.standard_error(name) for name in spread.values}
    held = {name: spread.limited(name).share for name in spread.values}
    told = {"draws": spread.asked, "draws_certified": spread.certified, "standard_errors": errors}
    return told | {"set_by_limit": {name: share for name, share in held.items() if share}}


def spread_lines(spread: Spread, orbit: Orbit) -> list[str]:
    """Return lines with the powers and trims of an orbit and their standard errors."""
    record, lines = orbit.record(), []
    for name in _POWERS:
        lines.append(f"{power_label(name)}: {_shown(spread, name, record[name], plain_unit(name))}")
    for name in orbit.problem.free:
        value = record["wingbeat"].get(name)
        if value is None:
            continue  # a harmonic, which stands in a list
        factor, unit = for_people(NOMENCLATURE[name].unit)
        lines.append(f"trimmed {name.replace('_', ' ')}: {_shown(spread, f'wingbeat.{name}', value, unit, factor)}")
    edge = "; the other draws have none: the wingbeat is close to the limit of flight, and errors may be larger"
    ending = "" if spread.certified == spread.asked else edge
    flown = f"{spread.certified} of {spread.asked} random draws of the film have an orbit"
    return [*lines, f"one standard error; {flown}{ending}"]


def _shown(spread: Spread, name: str, value: float, unit: str, factor: float = 1.0) -> str:
    """Return a number of the orbit with its standard error, or with the limit that set it in the draws."""
    error = spread.standard_error(name) if name in spread.values else None
    if error is None:
        return plus_minus(factor * value, None, unit)
    return spread.limited(name).shown(value, error, unit, factor)


def plus_minus(value: float, error: float | None, unit: str = "") -> str:
    """Return a value and its error, which may not be known, to the digits that the error decides.

    >>> plus_minus(25.1234, 0.812), plus_minus(25.1234, None, "W")
    ('25.1 +- 0.8', '25.12 +- ? W')
    """
    return written(value, math.nan if error is None else error, unit)
