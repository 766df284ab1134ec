"""Files of load-cell runs: from channels to loads in SI units, constants, and zero readings from other files."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList, InvalidInputError, suggest
from wingbeat._base.sheets import Sheet, check_unit, number_in, parse_numbers, read_sheet, same_name, split_unit
from wingbeat.experiment.instrument_files import Recording, is_instrument_file, open_recording
from wingbeat.experiment.load_cell_run import (
    CHANNELS,
    COLUMN_UNITS,
    CONSTANT_UNITS,
    MIN_SAMPLES,
    OPTIONAL_UNITS,
    TARE_UNITS,
    LoadCellRun,
)
from wingbeat.experiment.load_cell_setup import KINDS, LoadCellSetup, unit_factor, unit_in
from wingbeat.experiment.steadiness import standard_error

_SPELLINGS = {same_name(name): name for name in CONSTANT_UNITS | OPTIONAL_UNITS | TARE_UNITS}
# A zero reading whose halves differ by this share of the run's force is not at rest.
_MOVING = 0.1


def read_run(path: str | Path, setup: LoadCellSetup | None = None) -> LoadCellRun:
    """Read one run from a CSV file, or from a file of LabVIEW (.lvm, .tdms) or an ATI force sensor.

    A CSV file has constants as ``# key = value`` lines, then a table of samples with the columns time,
    normal_force, tangential_force, moment and alpha_deg, in any order, each with or without its unit in brackets;
    others are ignored. The keys are speed, density, viscosity, chord, span. Optional keys are thickness,
    channel_width and the zero readings tare_normal_force, tare_tangential_force, tare_moment. A zero reading has
    two values: before the run, after the run. For other files `setup` says which channel is which, and adds
    constants; units that the file or the setup states are converted, and the run's notes say so.

    Parameters
    ----------
    path : of the file.
    setup : channels, constants and zero that the file lacks.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : a missing column or key, another unit, angles in radians, cells that are not numbers, and
        inputs that `LoadCellRun` refuses, each fault with its row and column.
    """
    path = Path(path)
    if setup is not None or is_instrument_file(path):
        return _mapped_run(path, LoadCellSetup() if setup is None else setup)
    sheet, faults = read_sheet(path), FaultList()
    place = _columns(faults, sheet)
    constants = _constants(faults, sheet.file, sheet.constants)
    if set(place) != set(COLUMN_UNITS):
        faults.raise_if_any()
    names = [split_unit(cell).name for cell in sheet.header]
    numbers = parse_numbers(faults, sheet, names)
    faults.raise_if_any()
    series: dict[str, Any] = {name: numbers[:, k].copy() for name, k in place.items()}
    single: dict[str, Any] = {name: values[0] for name, values in constants.items() if name not in TARE_UNITS}
    tare = [constants.get(key, (np.nan, np.nan)) for key in TARE_UNITS]
    try:
        notes = tuple(f"{sheet.file}: {note}" for note in sheet.notes)
        return LoadCellRun(sheet.file, **series, **single, tare=tare, notes=notes)
    except InvalidInputError as error:
        placed = [dataclasses.replace(fault, where=_in_sheet(fault.where, sheet)) for fault in error.faults]
        raise InvalidInputError(placed) from None


def _mapped_run(path: Path, setup: LoadCellSetup) -> LoadCellRun:
    """Return the run of a recording whose channels are named by a setup."""
    faults = FaultList()
    recording = open_recording(path)
    file, notes = recording.file, []
    constants = _constants(faults, file, recording.constants, setup.constants)
    loads, given = _channels(faults, recording, setup, notes)
    if recording.kind != "a table" and (own := [name for name in constants if name not in setup.constants]):
        values = ", ".join(f"{name} = {constants[name][0]:g}" for name in own)
        notes.append(f"{file}: {values} by the file's properties")
    single: dict[str, Any] = {name: values[0] for name, values in constants.items() if name not in TARE_UNITS}
    tare = np.array([constants.get(key, (np.nan, np.nan)) for key in TARE_UNITS])
    tare_se = None
    if setup.tare:
        if np.isfinite(tare).any():
            faults.add(f"{file}, tare", "", "is given as numbers and as a file", "leave out one of the two")
        if any(other.resolve() == path.resolve() for other in setup.tare):
            faults.add("tare", path.name, "is the run itself", "name a record with the fluid at rest")
        else:
            tare, tare_se = _zero(faults, setup, given, loads, notes)
    axis = float(setup.constants.get("moment_axis", 0.0))
    if axis:  # nose-up about mid-chord, from that about an axis behind it
        loads["moment"] = loads["moment"] - axis * loads["normal_force"]
        tare[2] = tare[2] - axis * tare[0]
        if tare_se is not None:
            tare_se[2] = np.hypot(tare_se[2], axis * tare_se[0])
    elif recording.kind.startswith("a log of an ATI") and "moment_axis" not in setup.constants:
        notes.append(
            f"{file}: the moment was taken as about mid-chord; ATI's is about the sensor's origin: if that is "
            "elsewhere, give its distance behind mid-chord, --set moment_axis=.."
        )
    faults.raise_if_any()
    said = (*recording.notes, *notes)
    return LoadCellRun(file, **loads, **single, tare=tare, tare_se=tare_se, notes=tuple(dict.fromkeys(said)))


def _channels(
    faults: FaultList, recording: Recording, setup: LoadCellSetup, notes: list[str], still: bool = False
) -> tuple[dict[str, Any], list[str]]:
    """Return time, loads and angle in SI units and degrees, and the loads' channels; raise if some are missing.

    A record that is `still` needs no angle.
    """
    file = recording.file
    wanted = {name: setup.channels.get(name, name) for name in COLUMN_UNITS if name != "time"}
    wanted.update(setup.channels)
    columns: dict[str, tuple[int, float, str | None]] = {}
    for name, text in wanted.items():
        found = _named(recording, text)
        if len(found) == 1:
            columns[name] = found[0]
        elif found:
            fix = f"name one of {', '.join(recording.names[k] for k, _, _ in found)}"
            faults.add(f"{file}, {name}", text, "is the name of several channels", fix)
        elif name in setup.channels and not (still and name == "alpha_deg"):
            near = suggest(text.lstrip("-"), recording.names, otherwise=f"it has {recording.shown()}")
            faults.add(f"{file}, {name}", text, "is no channel of the file", near)
    if missing := [
        name.replace("_", " ") for name in CHANNELS if name not in columns and name not in setup.channels
    ]:
        rule = f"are the channels of {recording.kind}, which does not say which is the {', the '.join(missing)}"
        fix = "say so: --channels normal=NAME,tangential=NAME,moment=NAME, with -NAME for a reversed sign"
        if "alpha_deg" not in columns and setup.alpha_deg is None:
            fix += ", and alpha=NAME or --alpha-deg for the angle"
        faults.add(file, recording.shown(), rule, fix)
    elif not still and "alpha_deg" not in columns and setup.alpha_deg is None and not faults.faults:
        rule = "are its channels, none of which is named for the angle"
        faults.add(
            f"{file}, alpha_deg", recording.shown(), rule, "add alpha=NAME to --channels, or give --alpha-deg"
        )
    if len({k for k, _, _ in columns.values()}) < len(columns):
        faults.add(f"{file}, channels", ", ".join(wanted[name] for name in columns), "name one channel twice")
    faults.raise_if_any()
    order = list(columns)
    values = recording.numbers(faults, [columns[name][0] for name in order])
    faults.raise_if_any()
    series: dict[str, Any] = {}
    converted, unstated = [], []
    for k, name in enumerate(order):
        column, sign, own = columns[name]
        label = recording.names[column]
        stated = [unit for unit in (recording.units[column], unit_in(label)) if unit]
        unit = own or next(iter(stated), None)
        factor = 1.0
        if own is None and len({unit_factor(one, KINDS[name]) for one in stated}) > 1:
            fix = f"say which its numbers are in, such as {split_unit(label).name} [{stated[1]}]"
            faults.add(f"{file}, {name} = {label}", " and ".join(stated), "are two units of one channel", fix)
        if unit is None and not (name == "alpha_deg" and "deg" in label.lower()):
            unstated.append(f"{label} ({COLUMN_UNITS[name]})")
        elif unit is not None:
            factor, why = unit_factor(unit, KINDS[name])
            if factor is None and name == "moment" and own is None and unit_factor(unit, "force")[0] == 1.0:
                factor = 1.0
                notes.append(f"{file}: the moment is read from {label}, which the file calls a force: taken as N m")
            elif factor is None:
                fix = f"state the unit of its numbers, such as {label} [{COLUMN_UNITS[name]}]"
                faults.add(f"{file}, {name} = {label}", unit, why, fix)
                factor = 1.0
            elif factor != 1.0:
                converted.append(f"{label} from {unit} to {COLUMN_UNITS[name]}")
        series[name] = sign * factor * values[:, k]
    if converted:
        notes.append(f"{file}: converted {', '.join(converted)}")
    if unstated:
        notes.append(f"{file}: no unit is stated for {', '.join(unstated)}; the numbers are taken in these units")
    if setup.alpha_deg is not None:
        if "alpha_deg" not in series:
            series["alpha_deg"] = float(setup.alpha_deg)
        elif abs(float(series["alpha_deg"].mean()) - setup.alpha_deg) > 1.0:
            mean = float(series["alpha_deg"].mean())
            rule = f"is the angle, but channel {wanted['alpha_deg']} has {mean:.4g} deg on average"
            faults.add(f"{file}, alpha_deg", setup.alpha_deg, rule, "keep one")
    rate = setup.constants.get("sample_rate")
    own = series.get("time")
    if own is None:
        own = recording.clock(faults, [columns[name][0] for name in CHANNELS])
    if own is None and "time" not in series:
        named = [
            k for k, name in enumerate(recording.names) if same_name(name) in ("time", "t", "timestamp", "times")
        ]
        if len(named) == 1 and rate is None and not faults.faults:
            label, bad = recording.names[named[0]], FaultList()
            unit = recording.units[named[0]] or unit_in(label)
            factor = unit_factor(unit, "time")[0] if unit else 1.0
            times = recording.numbers(bad, named)[:, 0]
            if factor is None:
                faults.add(f"{file}, {label}", unit, "is no unit of time that is read", "give time=NAME [s]")
            elif np.isfinite(times).any():  # else a clock as text, which says nothing
                own = factor * times
                faults.faults.extend(bad.faults)
                if unit is None:
                    notes.append(f"{file}: no unit is stated for {label}; it is taken as the time in s")
    if rate is not None:
        count = values.shape[0]
        if own is not None and own.size > 1 and abs(float(np.median(np.diff(own))) * rate - 1) > 0.01:
            step = float(np.median(np.diff(own)))
            notes.append(f"{file}: samples are {step:.4g} s apart by the file; the stated {rate:g} Hz was used")
        own = np.arange(count) / rate
    if own is None and not faults.faults:
        rule = "are its channels; it does not say when they were measured"
        faults.add(file, recording.shown(), rule, "name the channel, time=NAME, or give --set sample_rate=.. in Hz")
    faults.raise_if_any()
    return series | {"time": own}, [recording.names[columns[name][0]] for name in CHANNELS]


def _named(recording: Recording, text: str) -> list[tuple[int, float, str | None]]:
    """Return the channels that a text may name, with sign and stated unit: its exact name first."""
    for sign, rest in ((1.0, text), (-1.0, text[1:])) if text.startswith("-") else ((1.0, text),):
        name, unit = split_unit(rest)
        for wanted, own in ((rest.strip(), None), (name, unit)):
            for same in (str, str.lower):
                exact = [k for k, label in enumerate(recording.names) if same(label) == same(wanted)]
                bare = [
                    k for k, label in enumerate(recording.names) if same(split_unit(label).name) == same(wanted)
                ]
                if exact or bare:
                    return [(k, sign, own) for k in exact or bare]
    return []


def _zero(
    faults: FaultList, setup: LoadCellSetup, given: list[str], loads: dict[str, Any], notes: list[str]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the means of the channels in the files at rest and their standard errors, shape (3, 2)."""
    zeros, errors = [], []
    for path in setup.tare:
        recording = open_recording(path)
        series, names = _channels(faults, recording, setup, notes, still=True)
        notes += recording.notes
        still = np.stack([series[name] for name in CHANNELS])
        if names != given:
            notes.append(
                f"{recording.file}: its zero is that of {', '.join(names)}, the run's loads are {', '.join(given)}"
            )
        if still.shape[1] < MIN_SAMPLES:
            rule = f"must hold at least {MIN_SAMPLES} samples"
            faults.add(f"{recording.file}, tare", still.shape[1], rule, "record longer")
            continue
        halves = [half.mean(axis=1) for half in np.array_split(still[:2], 2, axis=1)]
        change = float(np.hypot(*(halves[1] - halves[0])))
        noise = float(np.hypot(*np.diff(still[:2], axis=1).std(axis=1))) / np.sqrt(still.shape[1])
        flow = np.array([loads[name].mean() for name in CHANNELS[:2]]) - still[:2].mean(axis=1)
        if change > _MOVING * float(np.hypot(*flow)) and change > 5 * noise:
            rule = "is not at rest: the force changes within the record"
            faults.add(f"{recording.file}, tare", f"{change:.2g} N", rule, "record the zero in still fluid")
        tilt = float(np.mean(series.get("alpha_deg", 0.0))) - float(np.mean(loads["alpha_deg"]))
        if "alpha_deg" in series and abs(tilt) > 0.5:
            other_axes = "the weight of the plate acts on other axes there"
            notes.append(f"{recording.file}: its angle differs by {tilt:.3g} deg from the run's; {other_axes}")
        zeros.append(still.mean(axis=1))
        errors.append(standard_error(still))
    if faults.faults:
        return np.full((3, 2), np.nan), np.zeros((3, 2))
    return np.stack([zeros[0], zeros[-1]], axis=1), np.stack([errors[0], errors[-1]], axis=1)


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
            fix = "name it alpha_deg and write degrees; radians times 57.29578 are degrees"
            faults.add(where, cell, "does not say that it is in degrees", fix)
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


def _constants(
    faults: FaultList, file: str, stated: dict[str, tuple[int, str]], setup: Mapping[str, Any] | None = None
) -> dict[str, tuple[float, ...]]:
    """Return the constants of the run; note missing ones, other units, and values that are not numbers."""
    found: dict[str, tuple[float, ...]] = {}
    units = CONSTANT_UNITS | OPTIONAL_UNITS | TARE_UNITS
    for key, (row, text) in stated.items():
        name, unit = _SPELLINGS.get(same_name(key), ""), split_unit(key).unit
        if name not in units:
            continue
        where = f"{file} row {row}, {name}" if row else f"{file}, {name}"
        check_unit(faults, where, unit, units[name])
        wanted = 2 if name in TARE_UNITS else 1
        cells = [number_in(cell) for cell in text.split(",")]
        values = tuple(cell for cell in cells if cell is not None)
        values = values if len(values) == len(cells) else ()
        if values and not np.isfinite(values).all():
            faults.add(where, text, "must be finite", f"give the reading in {units[name]}, or leave the line out")
        elif len(values) != wanted:
            rule = "must be two numbers, before and after the run" if wanted == 2 else "must be one number"
            fix = f"give only numbers, in {units[name]}; the unit goes in brackets before the ="
            faults.add(where, text, rule, fix)
        else:
            found[name] = values
    for name, value in (setup or {}).items():
        if name not in units:
            continue
        values = tuple(map(float, value)) if isinstance(value, list | tuple) else (float(value),)
        if found.setdefault(name, values) != values:
            rule = f"is stated, but the file says {', '.join(f'{number:g}' for number in found[name])}"
            faults.add(f"{file}, {name}", value, rule, "keep one")
    lacking = {
        name: unit
        for name, unit in CONSTANT_UNITS.items()
        if name not in found and not any(_SPELLINGS.get(same_name(key)) == name for key in stated)
    }
    if setup is not None and lacking:
        fix = f"give --set {' '.join(f'{name}=..' for name in lacking)} in {', '.join(lacking.values())}, or a TOML"
        faults.add(f"{file}, constants", ", ".join(lacking), "are missing", fix)
    else:
        for name, unit in lacking.items():
            faults.add(f"{file}, {name}", "", "is missing", f"add the line '# {name} [{unit}] = ...'")
    return found
