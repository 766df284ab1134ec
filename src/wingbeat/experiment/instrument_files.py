"""Opens the files of load cells: LabVIEW's .lvm and .tdms, logs of ATI force sensors, tables with other names."""

from __future__ import annotations

import csv
import logging
import re
from pathlib import Path
from typing import Any

import numpy as np

from wingbeat._base import Fault, FaultList, FileError, InvalidInputError, install_extra, read_text
from wingbeat._base.sheets import LARGEST, MAX_BYTES, number_in, parse_numbers, read_sheet, split_unit
from wingbeat.experiment.lvm_file import read_lvm
from wingbeat.experiment.recording import Array, Recording, cell_numbers

# Where a log may name its axes.
_HEAD_LINES, _HEAD_BYTES = 40, 1 << 16
_AXES = re.compile(r"(?i)(^|[,;\t]\s*\"?)fx\b[^,;\t]*[,;\t]\s*\"?fy\b[^,;\t]*[,;\t]\s*\"?fz\b")


def open_recording(path: Path) -> Recording:
    """Read a file of a load cell, whatever instrument or program wrote it."""
    try:
        with open(path, "rb") as file:
            start = file.read(4)
    except OSError:
        start = b""  # `read_text` finds the words
    if start == b"TDSm":
        return _read_tdms(path)
    if start == b"TDSh":
        rule = "is the index of a TDMS file, which holds no numbers"
        raise InvalidInputError([Fault(path.name, path.suffix, rule, "give the .tdms file beside it")])
    notes = []
    try:
        text = read_text(path, limit=MAX_BYTES)
    except FileError:
        # LabVIEW writes in the code page of Windows, in which a degree sign is no UTF-8.
        if start not in (b"LabV", b"\xef\xbb\xbfL"):
            raise
        text = path.read_bytes()[:MAX_BYTES].decode("cp1252", errors="replace")
        notes.append(f"{path.name}: is not UTF-8; its names were read in the code page of western Windows (cp1252)")
    if text.startswith("LabVIEW Measurement"):
        return read_lvm(path.name, text, notes)
    lines = text.splitlines()
    axes = _axes_row(lines)
    if axes is not None and not lines[0].startswith("#"):
        return _read_ati(path.name, lines, axes)
    return _read_table(path, of_program=axes is not None)


def is_instrument_file(path: Path) -> bool:
    """Return whether a file is one that an instrument writes, and not a table with our names."""
    try:
        with open(path, "rb") as file:
            head = file.read(_HEAD_BYTES)
    except (OSError, ValueError):
        return False
    if head[:4] in (b"TDSm", b"TDSh") or head.lstrip(b"\xef\xbb\xbf").startswith(b"LabVIEW Measurement"):
        return True
    return _axes_row(head.decode("latin-1").splitlines()) is not None


def _axes_row(lines: list[str]) -> int | None:
    """Return the index of the line that names the axes of a force sensor, or None."""
    named = (i for i, line in enumerate(lines[:_HEAD_LINES]) if not line.startswith("#") and _AXES.search(line))
    return next(named, None)


# --- LabVIEW, .tdms ---


def _read_tdms(path: Path) -> Recording:
    """Read a TDMS file by npTDMS: channels with their scales applied, units, and clocks."""
    try:
        from nptdms import TdmsFile
        from nptdms.log import log_manager
    except ImportError:
        raise FileError(f"reading {path.name} needs npTDMS: {install_extra('tdms')}") from None
    file = path.name
    log_manager.set_level(logging.ERROR)  # its own handler would write bytes of damaged names to the terminal
    try:
        # Of a damaged file its structures, sizes or codes are wrong, each with an error of another kind.
        content: Any = TdmsFile.read(path)
        found = [(channel, np.asarray(channel[:])) for group in content.groups() for channel in group.channels()]
        status = content.file_status
    except Exception as error:
        reason = f"{type(error).__name__}: {error}".split("\n")[0][:120]
        raise InvalidInputError([Fault(file, reason, "cannot be read by npTDMS", "is the file damaged?")]) from None
    finally:
        log_manager.set_level(logging.WARNING)
    notes = []
    if status.incomplete_final_segment or status.channel_statuses:
        notes.append(f"{file}: its last segment is not complete; was the recording interrupted?")
    bare = [channel.name for channel, _ in found]
    names = [c.name if bare.count(c.name) == 1 else f"{c.group_name}/{c.name}" for c, _ in found]

    def text(channel: Any, *keys: str) -> str | None:
        return next((str(channel.properties[key]).strip() for key in keys if channel.properties.get(key)), None)

    def numbers(faults: FaultList, columns: list[int]) -> Array:
        series = []
        for k in columns:
            values = found[k][1]
            if values.dtype.kind == "M" and values.size:
                values = (values - values[0]) / np.timedelta64(1, "s")
            if values.dtype.kind not in "iufb":
                faults.add(f"{file}, channel {names[k]}", str(values.dtype), "holds no numbers", "choose another")
            series.append(values)
        if len({len(values) for values in series}) > 1:
            sizes = ", ".join(f"{names[k]} {len(found[k][1])}" for k in columns)
            fix = "was the recording interrupted?" if notes else "record them at one rate"
            faults.add(file, sizes, "are the numbers of samples of the channels", fix)
        faults.raise_if_any()
        table = np.stack([np.asarray(values, dtype=float) for values in series], axis=1)
        for k, values in zip(columns, table.T, strict=True):
            bad = np.isfinite(values) & (np.abs(values) > LARGEST)
            rule, fix = "is larger than any measurement", "is the file damaged? Drop the sample"
            faults.first(f"{file}, channel {names[k]}", values, bad, rule, fix)
        return table

    def clock(faults: FaultList, columns: list[int]) -> Array | None:
        properties = [found[k][0].properties for k in columns]
        steps = {p.get("wf_increment") for p in properties}
        offsets = {p.get("wf_start_offset", 0.0) for p in properties}
        if steps == {None}:
            return None
        if len(steps) > 1 or len(offsets) > 1:
            shown = ", ".join(
                f"{names[k]} {p.get('wf_increment')} s" for k, p in zip(columns, properties, strict=True)
            )
            faults.add(
                f"{file}, wf_increment", shown, "differs between the channels of one run", "record at one rate"
            )
            return None
        step, offset = steps.pop(), offsets.pop()
        if not isinstance(step, float | int) or not np.isfinite(step) or step <= 0 or not np.isfinite(offset):
            faults.add(f"{file}, wf_increment", step, "must be a positive number [s]", "give --set sample_rate=..")
            return None
        starts = [start for p in properties if (start := p.get("wf_start_time")) is not None]
        try:
            apart = abs((max(starts) - min(starts)) / np.timedelta64(1, "s")) if starts else 0.0
        except (TypeError, ValueError):
            apart = 0.0
        if apart > step:
            notes.append(f"{file}: its channels start {apart:.3g} s apart; they were taken as simultaneous")
        return offset + step * np.arange(len(found[columns[0]][1]))

    units = [text(channel, "unit_string", "NI_UnitDescription") for channel, _ in found]
    constants = {
        key: (0, str(value))
        for owner in (content, *content.groups())
        for key, value in owner.properties.items()
        if isinstance(value, int | float) and not isinstance(value, bool)
    }
    return Recording(file, "a TDMS file of LabVIEW", names, units, numbers, clock, notes, constants)


# --- ATI and other tables ---


def _read_ati(file: str, lines: list[str], axes: int) -> Recording:
    """Read a log of an ATI sensor: head lines with units, then a table with the axes Fx, Fy, Fz, Tx, Ty, Tz.

    The forms are those of the Net F/T demo of ATI (Java, its source is public) and of the DAQ F/T logs: keys are
    followed by a colon or a comma. In the Net F/T demo's table the numbers are already divided by the counts per
    unit that its head states, and Time is a clock with whole seconds, so the sequence numbers give the time.
    """
    faults, notes = FaultList(), []
    separator = next((sign for sign in ("\t", ";", ",") if sign in lines[axes]), ",")
    head: dict[str, str] = {}
    for line in lines[:axes]:
        for part in re.split(r",\s+(?=[A-Z])", line):
            key, sign, value = part.strip().strip('"').partition(":")
            if not sign:
                key, sign, value = part.strip().partition(separator)
            if sign:
                head[re.sub(r"\W", "", key).lower()] = value.strip().strip('"')
    cells = list(csv.reader(lines[axes:], delimiter=separator, skipinitialspace=True))
    names = [cell.strip() for cell in cells[0]]
    rows = [
        (axes + 2 + i, [c.strip() for c in row]) for i, row in enumerate(cells[1:]) if any(c.strip() for c in row)
    ]
    widths = {len(row) for _, row in rows}
    if not rows:
        faults.add(f"{file} row {axes + 1}", lines[axes], "is followed by no numbers", "is the file cut short?")
    elif len(widths) == 1 and (width := widths.pop()) < len(names):
        notes.append(f"{file}: the rows end after {names[width - 1]}; {', '.join(names[width:])} have no numbers")
    elif any(width != len(names) for width in {len(row) for _, row in rows}):
        row, short = next(pair for pair in rows if len(pair[1]) != len(names))
        rule = f"has {len(short)} cells, but the header names {len(names)} columns"
        faults.add(f"{file} row {row}", separator.join(short), rule, "drop the row; decimal commas need semicolons")
    faults.raise_if_any()
    if separator != "," and any(re.search(r"\d,\d", cell) for _, row in rows[:50] for cell in row):
        notes.append(f"{file}: the numbers were read with decimal commas")
        rows = [(row, [cell.replace(",", ".") for cell in one]) for row, one in rows]
    force, torque = (
        next((head[key] for key in (f"{kind}units", f"{kind}unit") if head.get(key)), None)
        for kind in ("force", "torque")
    )
    units: list[str | None] = []
    for name in names:
        plain, own = split_unit(name)
        axis = re.fullmatch(r"([ftm])[xyz]", plain.strip().lower())
        units.append(own or (None if axis is None else force if axis[1] == "f" else torque))
    per = {kind: number_in(head.get(f"countsperunit{kind}") or "") for kind in ("force", "torque")}

    def numbers(faults: FaultList, columns: list[int]) -> Array:
        values = cell_numbers(faults, file, rows, {k: names[k] for k in columns})
        for i, k in enumerate(columns):
            axis = re.fullmatch(r"([ftm])[xyz]", split_unit(names[k]).name.lower())
            counts = axis and per["force" if axis[1] == "f" else "torque"]
            if (
                counts
                and counts > 1
                and (values[:, i] == np.round(values[:, i])).all()
                and np.ptp(values[:, i]) > 0
            ):
                rule = f"holds whole numbers, which may be counts; {counts:g} counts are one unit"
                faults.add(f"{file}, channel {names[k]}", f"{values[0, i]:g}", rule, "divide them by it, if so")
        return values

    lower = [name.lower() for name in names]
    status = next((k for k, name in enumerate(lower) if name.startswith("status")), None)
    if status is not None:
        bad = sum(row[status].strip().lower() not in ("0", "0x0", "0x00000000") for _, row in rows)
        if bad:
            notes.append(f"{file}: the sensor's status is not 0 in {bad} of {len(rows)} samples; was it saturated?")

    def clock(faults: FaultList, columns: list[int]) -> Array | None:
        rate, sequence = number_in(head.get("rdtsamplerate") or ""), "rdt sequence"
        if not rate or rate <= 0 or sequence not in lower:
            return None
        place = lower.index(sequence)
        count = cell_numbers(faults, file, rows, {place: names[place]})[:, 0]
        notes.append(f"{file}: the times are RDT Sequence / {rate:g} Hz, the sample rate when its program started")
        times = (count - count[0]) / rate
        if "time" in lower and times.size:
            seconds = len({row[lower.index("time")] for _, row in rows if lower.index("time") < len(row)}) - 1
            if abs(times[-1] - seconds) > 2 + 0.1 * seconds:
                notes.append(f"{file}: these times last {times[-1]:.4g} s, but its clock shows {seconds} s")
        return times

    return Recording(file, "a log of an ATI force sensor", names, units, numbers, clock, notes, {})


def _read_table(path: Path, of_program: bool) -> Recording:
    """Read a table with a header row, in which the columns may have any names."""
    sheet = read_sheet(path, of_program=of_program)
    heads = [split_unit(cell) for cell in sheet.header]

    def numbers(faults: FaultList, columns: list[int]) -> Array:
        names = [head.name if k in columns else "" for k, head in enumerate(heads)]
        return parse_numbers(faults, sheet, names)[:, columns]

    notes = [f"{sheet.file}: {note}" for note in sheet.notes]
    names, units = [head.name for head in heads], [head.unit for head in heads]
    return Recording(sheet.file, "a table", names, units, numbers, lambda *_: None, notes, sheet.constants)
