"""One run on the load cell: what was recorded, at which angle, in which stream, on which plate."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList, InvalidInputError, plain_unit
from wingbeat._base.sheets import Sheet, check_unit, parse_numbers, read_sheet, same_name, split_unit
from wingbeat.aero.polar_sheet import check_radians
from wingbeat.experiment.possible import check_constants

MIN_SAMPLES = 32
# If the angle spreads more than this within one record, the plate was still turning.
MAX_TURN_DEG = 1.0
# A load cell that is read less often is in other units: milliseconds, or numbers of samples [s].
SLOWEST_STEP = 1.0
CHANNELS = ("normal_force", "tangential_force", "moment")
COLUMN_UNITS = {name: plain_unit(name) for name in ("time", *CHANNELS, "alpha_deg")}
CONSTANT_UNITS = {name: plain_unit(name) for name in ("speed", "density", "viscosity", "chord", "span")}
OPTIONAL_UNITS = {name: plain_unit(name) for name in ("thickness", "channel_width")}
TARE_UNITS = {f"tare_{name}": COLUMN_UNITS[name] for name in CHANNELS}
_SPELLINGS = {same_name(name): name for name in CONSTANT_UNITS | OPTIONAL_UNITS | TARE_UNITS}


@dataclass(frozen=True)
class LoadCellRun:
    """The record of one run at one angle of attack.

    Parameters
    ----------
    name : the run's name in messages, such as its file.
    time : rising times of the samples [s], shape (n,).
    normal_force, tangential_force : along the plate's normal and towards its trailing edge [N], shape (n,).
    moment : about mid-chord, nose-up positive [N m], shape (n,).
    alpha_deg : angle of attack read by the encoder [deg], shape (n,) or one number.
    speed, density, viscosity : of the stream [m/s, kg/m3, m2/s]; the viscosity is kinematic.
    chord, span : of the plate [m].
    thickness : of the plate [m]; 0 if not known.
    channel_width : width of the channel across the span [m], or None.
    tare : readings of each channel in still fluid before and after the run [N, N, N m], shape (3, 2); NaN, or None
        for all channels, where there is none.

    Raises
    ------
    InvalidInputError : a constant that no stream and no plate has, a viscosity that no fluid of this density has, a
        Reynolds number below 1, fewer than 32 samples, columns of different length, values that are not finite,
        times that do not rise or are a second apart, an angle that moves by over a degree or exceeds half a turn.
    """

    name: str
    time: NDArray[np.float64]
    normal_force: NDArray[np.float64]
    tangential_force: NDArray[np.float64]
    moment: NDArray[np.float64]
    alpha_deg: NDArray[np.float64] | float
    speed: float
    density: float
    viscosity: float
    chord: float
    span: float
    thickness: float = 0.0
    channel_width: float | None = None
    tare: Any = None

    def __post_init__(self) -> None:
        faults = FaultList()
        for name, unit in CONSTANT_UNITS.items():
            faults.number(
                f"{self.name}, {name}", getattr(self, name), above=0, unit=unit, fix="give it in SI units"
            )
        faults.number(f"{self.name}, thickness", self.thickness, at_least=0, unit="m")
        if self.channel_width is not None:
            faults.number(f"{self.name}, channel_width", self.channel_width, above=0, unit="m")
        for name in COLUMN_UNITS:
            object.__setattr__(self, name, np.asarray(getattr(self, name), dtype=np.float64))
        tare = np.full((3, 2), np.nan) if self.tare is None else np.asarray(self.tare, dtype=np.float64)
        object.__setattr__(self, "tare", tare)
        if tare.shape != (3, 2) or np.isinf(tare).any():
            rule = "must be three pairs of finite numbers"
            faults.add(f"{self.name}, tare", self.tare, rule, "give the readings before and after the run")
        object.__setattr__(self, "alpha_deg", np.broadcast_to(self.alpha_deg, np.shape(self.time)))
        if not faults.faults:
            check_constants(faults, self)
        _check_series(faults, self)
        faults.raise_if_any()

    @property
    def duration(self) -> float:
        """Length of the record: number of samples times the mean step [s]."""
        return float((self.time[-1] - self.time[0]) * len(self.time) / (len(self.time) - 1))

    @property
    def reynolds(self) -> float:
        """``Re = U c / nu`` [-]."""
        return self.speed * self.chord / self.viscosity


def _check_series(faults: FaultList, run: LoadCellRun) -> None:
    shape = run.time.shape
    if len(shape) != 1 or shape[0] < MIN_SAMPLES:
        rule = f"must hold at least {MIN_SAMPLES} samples"
        faults.add(f"{run.name}, time", f"shape {shape}", rule, "record longer")
        return
    for name in COLUMN_UNITS:
        column = getattr(run, name)
        if column.shape != shape:
            faults.add(f"{run.name}, {name}", f"shape {column.shape}", f"must have the shape of time, {shape}")
        elif not np.isfinite(column).all():
            first = int(np.argmin(np.isfinite(column)))
            faults.add(f"{run.name}, {name}[{first}]", float(column[first]), "must be finite", "drop the sample")
    if len(faults.faults):
        return
    steps = np.diff(run.time)
    if steps.min() <= 0:
        first = int(np.argmin(steps > 0)) + 1
        rule = f"must be above the time before it, {run.time[first - 1]:g} s"
        faults.add(f"{run.name}, time[{first}]", float(run.time[first]), rule, "sort by time, drop duplicates")
    elif (step := float(np.median(steps))) >= SLOWEST_STEP:
        counts = step == 1.0 and np.array_equal(run.time, np.round(run.time))
        rule = (
            f"has samples {step:.4g} s apart; the times seem to {'count samples' if counts else 'be milliseconds'}"
        )
        faults.add(f"{run.name}, time", f"{run.time[0]:g} to {run.time[-1]:g}", rule, "give seconds")
    alpha = np.asarray(run.alpha_deg)
    if np.abs(alpha).max() > 180:
        worst = float(alpha[np.argmax(np.abs(alpha))])
        faults.add(f"{run.name}, alpha_deg", worst, "must lie between -180 and 180 degrees", "wrap the angle")
    elif (spread := float(alpha.std())) > MAX_TURN_DEG:
        rule = f"moves with a standard deviation of {spread:.2g} degrees, but a run has one angle"
        faults.add(f"{run.name}, alpha_deg", float(alpha.mean()), rule, "write one file for each angle")


def read_run(path: str | Path) -> LoadCellRun:
    """Read one run from a CSV file: constants as ``# key = value`` lines, then a table of samples.

    The columns are time, normal_force, tangential_force, moment and alpha_deg, in any order, each with or without
    its unit in brackets; others are ignored. The keys are speed, density, viscosity, chord, span. Optional keys are
    thickness, channel_width and the zero readings tare_normal_force, tare_tangential_force, tare_moment. A zero
    reading has two values: before the run, after the run.

    Parameters
    ----------
    path : of the CSV file.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : a missing column or key, another unit, angles in radians, cells that are not numbers, and
        inputs that `LoadCellRun` refuses, each fault with its row and column.
    """
    sheet, faults = read_sheet(path), FaultList()
    place = _columns(faults, sheet)
    constants = _constants(faults, sheet)
    if set(place) != set(COLUMN_UNITS):
        faults.raise_if_any()
    names = [split_unit(cell).name for cell in sheet.header]
    numbers = parse_numbers(faults, sheet, names)
    faults.raise_if_any()
    series: dict[str, Any] = {name: numbers[:, k].copy() for name, k in place.items()}
    single: dict[str, Any] = {name: values[0] for name, values in constants.items() if name not in TARE_UNITS}
    tare = [constants.get(key, (np.nan, np.nan)) for key in TARE_UNITS]
    try:
        return LoadCellRun(sheet.file, **series, **single, tare=tare)
    except InvalidInputError as error:
        placed = [dataclasses.replace(fault, where=_in_sheet(fault.where, sheet)) for fault in error.faults]
        raise InvalidInputError(placed) from None


def _in_sheet(where: str, sheet: Sheet) -> str:
    """Return where in the file a run's fault is: a constant, a sample, or a whole column."""
    name, _, index = where.removeprefix(f"{sheet.file}, ").removesuffix("]").partition("[")
    for key, (row, _) in sheet.constants.items():
        if _SPELLINGS.get(same_name(key)) == name:
            return f"{sheet.file} row {row}, {name}"
    if name not in COLUMN_UNITS:
        return where
    row = sheet.rows[int(index)][0] if index else sheet.header_row
    return f"{sheet.file} row {row}, column {name}"


def _columns(faults: FaultList, sheet: Sheet) -> dict[str, int]:
    """Return the index of each column; note missing columns, other units, and angles that are not in degrees."""
    place: dict[str, int] = {}
    for k, cell in enumerate(sheet.header):
        name, unit = split_unit(cell)
        where = f"{sheet.file} row {sheet.header_row}, column {k + 1}"
        if name in ("alpha", "angle", "alpha_rad"):
            rule = "does not say that it is in degrees"
            fix = "name it alpha_deg and write degrees; radians times 57.29578 are degrees"
            faults.add(where, cell, rule, fix)
            place["alpha_deg"] = k
        elif name in place:
            faults.add(where, cell, "appears twice", "keep one")
        elif name in COLUMN_UNITS:
            check_unit(faults, f"{where}, {name}", unit, COLUMN_UNITS[name])
            place[name] = k
    for name, unit in COLUMN_UNITS.items():
        if name not in place:
            where = f"{sheet.file} row {sheet.header_row}, column {name}"
            faults.add(where, ",".join(sheet.header), "the column is missing", f"add {name} [{unit}]")
    return place


def _constants(faults: FaultList, sheet: Sheet) -> dict[str, tuple[float, ...]]:
    """Return the constants of the run; note missing ones, other units, and values that are not numbers."""
    found: dict[str, tuple[float, ...]] = {}
    units = CONSTANT_UNITS | OPTIONAL_UNITS | TARE_UNITS
    for key, (row, text) in sheet.constants.items():
        name, unit = _SPELLINGS.get(same_name(key), ""), split_unit(key).unit
        if name not in units:
            continue
        where = f"{sheet.file} row {row}, {name}"
        check_unit(faults, where, unit, units[name])
        wanted = 2 if name in TARE_UNITS else 1
        cells = [cell.strip() for cell in text.split(",")]
        # One try for all cells: "0.5 m/s" and "fast" cause the same fault.
        values: tuple[float, ...]
        try:
            values = tuple(float(cell) for cell in cells)
        except ValueError:
            values = ()
        if values and not np.isfinite(values).all():
            faults.add(where, text, "must be finite", f"give the reading in {units[name]}, or leave the line out")
            continue
        if len(values) != wanted:
            rule = "must be two numbers, before and after the run" if wanted == 2 else "must be one number"
            fix = f"give only numbers, in {units[name]}; the unit goes in brackets before the ="
            faults.add(where, text, rule, fix)
            continue
        found[name] = values
    for name, unit in CONSTANT_UNITS.items():
        if not any(_SPELLINGS.get(same_name(key)) == name for key in sheet.constants):
            faults.add(f"{sheet.file}, {name}", "", "is missing", f"add the line '# {name} [{unit}] = ...'")
    return found


def refuse_radians(where: str, angles: NDArray[np.float64]) -> None:
    """Refuse a sweep of angles that does not go beyond pi: such a sweep is in radians.

    Raises
    ------
    InvalidInputError : four angles or more, none beyond pi, and some not zero.
    """
    faults = FaultList()
    check_radians(faults, where, angles)
    faults.raise_if_any()
