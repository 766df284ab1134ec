"""The CSV file of flights that were measured at several speeds: frequency, mechanical power, metabolic rate."""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList
from wingbeat._base.sheets import parse_numbers, read_sheet

MAX_FLIGHTS = 5000
# Unit of each column, and the spellings of the unit without spaces, points and signs of powers.
UNITS = {"speed": "m/s", "frequency": "Hz", "mechanical_power": "W", "metabolic_rate": "W"}
_SPELLED = {
    "m/s": {"m/s", "ms-1", "mps", "m/sec"},
    "Hz": {"hz", "1/s", "s-1", "beats/s", "wingbeats/s"},
    "W": {"w", "watt", "watts", "j/s"},
}
_CONVERT = {
    "km/h": "divide by 3.6",
    "kmh-1": "divide by 3.6",
    "kph": "divide by 3.6",
    "knots": "multiply by 0.5144",
    "kn": "multiply by 0.5144",
    "mph": "multiply by 0.447",
    "cm/s": "divide by 100",
    "w/kg": "multiply by the mass [kg], of the body or of the muscle, whichever it was divided by",
    "wkg-1": "multiply by the mass [kg], of the body or of the muscle, whichever it was divided by",
    "mw": "divide milliwatts by 1000",
    "rpm": "divide by 60",
    "1/min": "divide by 60",
    "rad/s": "divide by 2 pi",
    "mlo2/min": "multiply by 20.1 J/ml and divide by 60",
    "mlo2min-1": "multiply by 20.1 J/ml and divide by 60",
}
# Units that stand as the last words of a name: speed_m_s, power_w.
_TAILS = (("m", "s"), ("km", "h"), ("cm", "s"), ("w", "kg"), ("mps",), ("kph",), ("hz",), ("w",), ("mw",), ("rpm",))
# Words of a column's name, as in the explorer's viewer/src/explorer/own_tables.js.
_SPEED = {"speed", "airspeed", "velocity", "v", "u"}
_POWER = {"power", "p"}
_FREQUENCY = {"frequency", "freq", "f", "beats", "wbf"}
_ERROR = {"error", "err", "sd", "se", "sem", "std", "uncertainty", "stdev", "±", "+/"}
_LABEL = {"label", "name", "animal", "individual", "species", "source", "bird", "bat", "id", "who"}
_METABOLIC = {"metabolic", "metab", "met", "input", "respirometry", "aerobic", "chemical"}
_MECHANICAL = {"mechanical", "mech", "aerodynamic", "aero", "positive", "output", "pectoralis", "muscle", "hinge"}
_FASTEST = 200.0  # m/s, as in the explorer; what is faster is in another unit
_FAST = 60.0  # m/s, which only a stooping falcon exceeds


@dataclass(frozen=True)
class FlightPoints:
    """Flights that were measured at several speeds.

    Attributes
    ----------
    name : of the file.
    speed : shape (N,) [m/s].
    values : by quantity, ``frequency`` [Hz], ``mechanical_power`` and ``metabolic_rate`` [W], each of shape (N,);
        not a number where it was not measured.
    errors : of the same quantities, in the same units; not a number where none is given.
    labels : a text for each flight, which may be empty.
    notes : what was assumed about columns and units, and what was not read.
    """

    name: str
    speed: NDArray[np.float64]
    values: dict[str, NDArray[np.float64]]
    errors: dict[str, NDArray[np.float64]]
    labels: tuple[str, ...]
    notes: tuple[str, ...]


def read_flights(path: str | Path) -> FlightPoints:
    r"""Read measured flights from a CSV file, with one row for each flight or each mean at a speed.

    The columns are ``speed [m/s]`` and one or more of ``frequency [Hz]``, ``mechanical power [W]`` and
    ``metabolic power [W]``; each may have an error (``frequency error``, ``metabolic power sd``), and a column
    ``label`` names the flights. ``power`` alone is taken as mechanical, and a note says so. Units may stand in
    brackets or at the end of a name (``speed_m_s``); other units are refused with the conversion. A cell may be
    empty or NA.

    Parameters
    ----------
    path : of the CSV file.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : no column of speed, or none to compare; a column twice; an error that may belong to several
        columns; another unit; cells that are not numbers or are negative; more than 5000 rows. All faults at once.

    >>> import pathlib, tempfile, wingbeat as wb
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "flights.csv"
    ...     _ = path.write_text("speed [m/s],metabolic power [W],sd\n8,30,2\n12,35,3\n")
    ...     flights = wb.experiment.read_flights(path)
    >>> flights.values["metabolic_rate"].tolist(), flights.errors["metabolic_rate"].tolist()
    ([30.0, 35.0], [2.0, 3.0])
    """
    sheet, faults = read_sheet(path), FaultList()
    notes = [*sheet.notes]
    where = f"{sheet.file} row {sheet.header_row}"
    if len(sheet.rows) > MAX_FLIGHTS:
        rule = f"has {len(sheet.rows)} rows; at most {MAX_FLIGHTS} are read"
        faults.add(sheet.file, len(sheet.rows), rule, "give means over the flights at a speed")
        faults.raise_if_any()
    columns: list[str] = []  # what each column is: a quantity, "error of" one, "label", or "" if it is not read
    unnamed: list[int] = []
    bare: list[str] = []  # columns without a unit
    for place, cell in enumerate(sheet.header):
        words, unit = _words_and_unit(cell)
        what, is_error = "", bool(_ERROR & {*words})
        kinds = {
            "speed": bool(words) and (words[-1] in _SPEED or (is_error and bool(_SPEED & {*words}))),
            "frequency": bool(_FREQUENCY & {*words}),
            "power": bool(_POWER & {*words}) or {"metabolic", "rate"} <= {*words},
        }
        kind = next((kind for kind, is_it in kinds.items() if is_it), "")
        if kind == "speed" and "ground" in words:
            notes.append(f"column {cell!r} is not read: speed over ground is no airspeed")
        elif kind == "power":
            both = bool(_METABOLIC & {*words}) and bool(_MECHANICAL - {"muscle"} & {*words})
            what = "metabolic_rate" if _METABOLIC & {*words} else "mechanical_power"
            if both:
                faults.add(where, cell, "names both kinds of power", "name one: mechanical power or metabolic rate")
            elif what == "mechanical_power" and not _MECHANICAL & {*words} and not is_error:
                notes.append(f"column {cell!r} is taken as mechanical power; call it metabolic rate if it is that")
            elif is_error and not (_METABOLIC | _MECHANICAL) & {*words}:
                what = "power"
        elif kind:
            what = kind
        elif not is_error and _LABEL & {*words} and "label" not in columns:
            what = "label"
        elif is_error:
            unnamed.append(place)
        elif cell:
            notes.append(f"column {cell!r} is not read")
        if is_error and what:
            what = f"error of {what}"
        if what in columns and what and what != "label":
            fix = "keep one; is one of them the metabolic rate?" if what == "mechanical_power" else "keep one"
            faults.add(where, cell, f"is a second column of {what.replace('_', ' ')}", fix)
        wanted = UNITS.get(what.removeprefix("error of "), "W" if "power" in what else "")
        if unit and wanted and unit not in _SPELLED[wanted]:
            fix = _CONVERT.get(unit, "convert the numbers")
            faults.add(where, cell, f"is not in {wanted}", f"{fix}, and write [{wanted}]")
        elif not unit and what in UNITS:
            bare.append(f"{cell} ({wanted})")
        columns.append(what)
    if bare:
        notes.append(f"no unit is stated for {', '.join(bare)}; the numbers are taken in these units")
    given = [what for what in UNITS if what in columns and what != "speed"]
    for place, what in enumerate(columns):
        of = [one for one in given if what == "error of power" and one != "frequency"]
        of = given if place in unnamed else of
        if place in unnamed or what == "error of power":
            if len(of) == 1 and f"error of {of[0]}" not in columns:
                columns[place] = f"error of {of[0]}"
            elif of:
                rule = f"may be the error of {' or '.join(of).replace('_', ' ')}"
                faults.add(
                    where, sheet.header[place], rule, f"name it, for example {of[-1].replace('_', ' ')} error"
                )
            else:
                columns[place] = ""
                notes.append(f"column {sheet.header[place]!r} is not read: {_without_value(what)}")
    for what in [what for what in columns if what.startswith("error of ")]:
        if what.removeprefix("error of ") not in given:
            columns[columns.index(what)] = ""
            notes.append(f"the column {what.replace('_', ' ')} is not read: {_without_value(what)}")
    if "speed" not in columns:
        faults.add(where, ",".join(sheet.header), "has no column of airspeed", "name one speed [m/s]")
    if not given:
        fix = "name one frequency [Hz], mechanical power [W] or metabolic rate [W]"
        faults.add(where, ",".join(sheet.header), "has no column to compare with a curve", fix)
    faults.raise_if_any()
    names = [cell if what and what != "label" else "" for cell, what in zip(sheet.header, columns, strict=True)]
    blank = frozenset(name for name, what in zip(names, columns, strict=True) if what != "speed")
    numbers = parse_numbers(faults, sheet, names, blank=blank)
    for place, what in enumerate(columns):
        found = numbers[:, place].tolist() if names[place] else []
        for (row, _), value in zip(sheet.rows, found, strict=False):
            at = f"{sheet.file} row {row}, column {sheet.header[place]}"
            if value < 0:
                faults.add(at, value, "must be >= 0", "is the sign right?")
            elif what == "speed" and value > _FASTEST:
                faults.add(at, value, f"must be at most {_FASTEST:g} m/s", "is it in km/h? divide by 3.6")
            elif what == "frequency" and value == 0:
                faults.add(at, value, "must be > 0 Hz", "leave the cell empty if it was not measured")
    faults.raise_if_any()
    of = {what: numbers[:, place] for place, what in enumerate(columns) if names[place]}
    kept = np.any([np.isfinite(of[name]) for name in given], axis=0) if len(numbers) else np.zeros(0, bool)
    if not kept.any():
        faults.add(sheet.file, len(sheet.rows), "no row has a speed and a number to compare", "fill in a row")
        faults.raise_if_any()
    if left := int((~kept).sum()):
        notes.append(f"{left} of {len(kept)} rows hold nothing to compare")
    if (fastest := of["speed"][kept].max()) > _FAST:
        notes.append(f"the fastest speed, {fastest:g} m/s, is that of no level flight of an animal: is it in km/h?")
    labels = [""] * len(sheet.rows)
    if "label" in columns:
        at = columns.index("label")
        labels = [next(csv.reader([text], skipinitialspace=True))[at].strip() for _, text in sheet.rows]
    nothing = np.full(len(sheet.rows), np.nan)
    return FlightPoints(
        sheet.file,
        of["speed"][kept],
        {name: of[name][kept] for name in given},
        {name: of.get(f"error of {name}", nothing)[kept] for name in given},
        tuple(label for label, keep in zip(labels, kept, strict=True) if keep),
        tuple(notes),
    )


def _without_value(what: str) -> str:
    return "errors of speed are not used" if what == "error of speed" else "its quantity has no column"


def _words_and_unit(cell: str) -> tuple[list[str], str]:
    """Return a column's words and its unit: "Speed [m/s]", "speed_m_s" and "Speed (m/s)" are the same."""
    bracket = re.search(r"[\[(]([^\])]*)[\])]", cell)
    words = [word for word in re.split(r"[\s_-]+", re.sub(r"[\[(].*$", "", cell).lower()) if word]
    if bracket:
        return words, re.sub(r"[\s·*^.]", "", bracket[1].lower().replace("⁻¹", "-1").replace("−", "-"))
    for tail in _TAILS:
        if len(words) > len(tail) and tuple(words[-len(tail) :]) == tail:
            return words[: -len(tail)], "/".join(tail)
    return words, ""
