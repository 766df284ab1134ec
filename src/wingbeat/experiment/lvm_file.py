"""LabVIEW's measurement files (.lvm), as NI 4139 specifies them and as LabVIEW writes them."""

from __future__ import annotations

import datetime
import re
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat.experiment.recording import SHOWN_FAULTS, Array, Recording, cell_numbers

# Absolute times of LabVIEW count seconds from 1904; a number above this is one, of 1936 or later.
_ABSOLUTE = 1e9
_COUNTED_FROM_FIRST = "its times are absolute; they are counted from the first sample here"
# Keys of a packet's header in .lvm files (NI 4139, Specification for the LabVIEW Measurement File).
_PACKET_KEYS = {
    *("Channels", "Samples", "Date", "Time", "Y_Unit_Label", "X_Unit_Label", "Y_Dimension", "X_Dimension", "X0"),
    *("Delta_X", "Notes", "Test_Name", "Test_Numbers", "Test_Series", "UUT_M/N", "UUT_Name", "UUT_S/N"),
}
_HEADER_END = "***End_of_Header***"


class _Packet(NamedTuple):
    """One packet of an .lvm file: its header, its columns' names, and its rows."""

    header: dict[str, list[str]]
    names: list[str]
    rows: list[tuple[int, list[str]]]


def read_lvm(file: str, text: str, notes: list[str]) -> Recording:
    """Read a LabVIEW measurement file, as specified by NI 4139 (versions 0.92 to 2)."""
    lines = re.split(r"\r\n|\n|\r", text)
    head: dict[str, str] = {}
    separator = "\t"
    for line in lines:
        if line.startswith(_HEADER_END):
            break
        if match := re.match(r"Separator(\W)(\w*|\W)", line):
            separator = {"Tab": "\t", "Comma": ","}.get(match[2], match[1])
        key, *value = line.split(separator)
        head[key] = value[0].strip() if value else ""
    else:
        rule = f"has no line {_HEADER_END}"
        raise InvalidInputError([Fault(file, lines[0].strip(), rule, "is the file cut short?")])
    faults, end = FaultList(), lines.index(line)
    if separator == "," and re.search(r"^Decimal_Separator,,", text, re.MULTILINE):
        fix = "save the file with tabs between columns"
        raise InvalidInputError([Fault(f"{file}, Separator", separator, "is the decimal separator too", fix)])
    packets = _packets(faults, file, [line.split(separator) for line in lines[end + 1 :]], end + 2)
    faults.raise_if_any()
    if not packets or not packets[0].rows:
        raise InvalidInputError([Fault(file, "0 rows", "holds no numbers", "is the file cut short?")])
    names = packets[0].names
    for packet in packets[1:]:
        if packet.names != names:
            rule = (
                f"are the channels of a later packet, row {packet.rows[0][0] - 1 if packet.rows else '?'}, but the"
            )
            rule += f" first has {', '.join(names)}"
            fix = "save each set of channels to its own file"
            raise InvalidInputError([Fault(file, ", ".join(packet.names), rule, fix)])
    comma = _decimal_comma(faults, file, head.get("Decimal_Separator", ""), separator, packets, notes)
    faults.raise_if_any()
    if comma:
        packets = [
            p._replace(rows=[(row, [cell.replace(",", ".") for cell in cells]) for row, cells in p.rows])
            for p in packets
        ]
    which = head.get("X_Columns", "One") or "One"
    every = list(range(len(names)))
    y_columns = [k for k in every if names[k] not in ("X_Value", "Comment") and (k or which == "No")]
    rows = [row for packet in packets for row in packet.rows]
    header = packets[0].header

    def stated(key: str, column: int, packet: _Packet = packets[0]) -> str:
        cells = packet.header.get(key, [])
        return cells[column].strip() if column < len(cells) else ""

    samples = [stated("Samples", k) for k in y_columns]
    promised = max((int(count) for count in samples if count.isdecimal()), default=0)
    if promised > len(packets[0].rows):
        there = len(packets[0].rows)
        notes.append(f"{file}: its head promises {promised} samples, but {there} are there; is the file cut short?")

    def numbers(faults: FaultList, columns: list[int]) -> Array:
        return cell_numbers(faults, file, rows, {y_columns[k]: names[y_columns[k]] for k in columns})

    def clock(faults: FaultList, columns: list[int]) -> Array | None:
        places = [y_columns[k] for k in columns]
        dimension = stated("X_Dimension", places[0]) or "Time"
        if dimension.lower() != "time":
            rule = "is the dimension of x, but a run needs times"
            faults.add(f"{file}, X_Dimension", dimension, rule, "save the signals over time")
            return None
        factor = {"": 1.0, "s": 1.0, "sec": 1.0, "ms": 1e-3}.get(stated("X_Unit_Label", places[0]).lower())
        if factor is None:
            unit = stated("X_Unit_Label", places[0])
            faults.add(f"{file}, X_Unit_Label", unit, "is no unit of time that is read", "save seconds")
            return None
        if which == "No":
            return _counted(faults, file, packets, places, stated, factor, notes)
        x_of = {places[0]: 0} if which == "One" else {k: k - 1 for k in places}
        found = [cell_numbers(faults, file, rows, {x: "X_Value"})[:, 0] for x in sorted(set(x_of.values()))]
        if faults.faults:
            return None
        if any(np.abs(other - found[0]).max() > 1e-6 * max(np.ptp(found[0]), 1e-9) for other in found[1:]):
            fix = "resample the channels to common times before you save them"
            faults.add(f"{file}, X_Value", "", "differs between the channels of one run", fix)
            return None
        return _joined(file, factor * found[0], packets, notes)

    units = [stated("Y_Unit_Label", k) or None for k in y_columns]
    kind = "a measurement file of LabVIEW (.lvm)"
    if header.get("Notes"):
        notes.append(f"{file}: its head notes: {' '.join(header['Notes'][1:]).strip()[:200]}")
    return Recording(file, kind, [names[k].strip() for k in y_columns], units, numbers, clock, notes, {})


def _packets(faults: FaultList, file: str, table: list[list[str]], first_row: int) -> list[_Packet]:
    """Return the packets of an .lvm file without its special blocks; note what belongs to none."""
    packets: list[_Packet] = []
    header: dict[str, list[str]] = {}
    names: list[str] | None = None
    rows: list[tuple[int, list[str]]] = []
    special = None
    for row, cells in enumerate(table, start=first_row):
        first = cells[0].strip()
        if special is not None:
            special = None if first == "***End_Special***" else special
        elif first == "***Start_Special***":
            special = row
        elif not any(cell.strip() for cell in cells) or first == _HEADER_END:
            continue
        elif first in _PACKET_KEYS:
            if names is not None:
                packets.append(_Packet(header, names, rows))
                header, names, rows = {}, None, []
            header[first] = cells
        elif names is None:
            names = [cell.strip() for cell in cells]
            while names and not names[-1]:
                names.pop()
        else:
            rest = [cell.strip() for cell in cells[len(names) :]]
            comment = names[-1] == "Comment"
            if any(rest) and not (comment and not any(re.search(r"\d", cell) for cell in [*rest, cells[-1]])):
                rule = f"has {len(cells)} cells, but the header names {len(names)} columns"
                if len(faults.faults) < SHOWN_FAULTS:
                    faults.add(f"{file} row {row}", " ".join(cells), rule, "check separator and decimal separator")
            rows.append((row, [cell.strip() for cell in cells]))
    if special is not None:
        faults.add(f"{file} row {special}", "***Start_Special***", "is never ended", "is the file cut short?")
    if names is not None:
        packets.append(_Packet(header, names, rows))
    return packets


def _decimal_comma(
    faults: FaultList, file: str, stated: str, separator: str, packets: list[_Packet], notes: list[str]
) -> bool:
    """Return whether numbers have decimal commas: as the head says, or as the numbers show where it does not.

    Files of LabVIEW before 8.6 do not say; there the clock in the head may have a comma and the numbers points.
    """
    width = len(packets[0].names) - (packets[0].names[-1] == "Comment")
    cells = [cell for packet in packets for _, row in packet.rows for cell in row[:width]]
    commas = next((cell for cell in cells if re.fullmatch(r"[-+]?\d*,\d+(E[-+]?\d+)?", cell, re.I)), None)
    points = next((cell for cell in cells if re.fullmatch(r"[-+]?\d*\.\d+(E[-+]?\d+)?", cell, re.I)), None)
    if separator == ",":
        return False
    if commas and points:
        rule = f"has a decimal comma, but {points} has a point"
        faults.add(f"{file}, Decimal_Separator", commas, rule, "save the file with one of them")
    elif stated and stated != ("," if commas else "." if points else stated):
        rule = f"is the decimal separator by the head, but the numbers are like {commas or points}"
        faults.add(f"{file}, Decimal_Separator", stated, rule, "correct the head")
    elif not stated and commas:
        notes.append(f"{file}: its head names no Decimal_Separator; {commas} was read with a decimal comma")
    return commas is not None


def _counted(
    faults: FaultList,
    file: str,
    packets: list[_Packet],
    places: list[int],
    stated: Callable[..., str],
    factor: float,
    notes: list[str],
) -> Array | None:
    """Return the times [s] of a file without x-values, from X0 and Delta_X times a factor; an empty X0 is 0."""
    steps = {}
    for key in ("Delta_X", "X0"):
        texts = {stated(key, place) for place in places}
        try:
            values = {float(text.replace(",", ".") or 0) for text in texts if text or key == "X0"}
        except ValueError:
            values = set()
        if len(values) != 1:
            faults.add(f"{file}, {key}", " ".join(sorted(texts)), "must be one number for all channels of a run")
            return None
        steps[key] = factor * values.pop()
    if steps["X0"] > _ABSOLUTE:
        notes.append(f"{file}: {_COUNTED_FROM_FIRST}")
        steps["X0"] = 0.0
    count = [len(packet.rows) for packet in packets]
    samples = stated("Samples", places[0])
    per_packet = int(samples) if samples.isdecimal() and int(samples) else sum(count)
    joined = max(len(packets), -(-sum(count) // per_packet))
    if joined > 1:
        notes.append(f"{file}: no x-values; its {joined} packets were joined as if no time passed between them")
    return steps["X0"] + steps["Delta_X"] * np.arange(sum(count))


def _joined(file: str, x: Array, packets: list[_Packet], notes: list[str]) -> Array:
    """Return the times of all packets; where x begins anew in each, the packets are joined, and that is said."""
    if x[0] > _ABSOLUTE:
        notes.append(f"{file}: {_COUNTED_FROM_FIRST}")
        x = x - x[0]
    back = np.flatnonzero(np.diff(x) <= 0) + 1
    if not back.size or x.size < 4:
        return x
    stamps = [_stamp(packet) for packet in packets]
    starts = np.cumsum([0, *(len(packet.rows) for packet in packets)])[:-1]
    if len(packets) > 1 and np.array_equal(back, starts[1:]) and None not in stamps:
        since = [(stamp - stamps[0]).total_seconds() for stamp in stamps]  # type: ignore[operator]
        moved = np.concatenate([part + at for part, at in zip(np.split(x, back), since, strict=True)])
        if (np.diff(moved) > 0).all():
            notes.append(
                f"{file}: x begins anew in each of {len(packets)} packets; the packets' own clocks were added"
            )
            return moved
    size = int(back[0])
    step = float(np.median(np.diff(x[:size]))) if size > 1 else 0.0
    anew = np.array_equal(back, np.arange(size, x.size, size)) and np.allclose(
        x[back], x[0], atol=1e-9 + 1e-6 * step
    )
    if anew and step > 0:
        notes.append(
            f"{file}: x begins anew every {size} samples; the {back.size + 1} packets were joined as if no time "
            "passed between them"
        )
        return x[0] + step * np.arange(x.size)
    return x  # the run's own check refuses times that do not rise


def _stamp(packet: _Packet) -> datetime.datetime | None:
    """Return when a packet began, or None if it does not say."""
    date, clock = (
        next((c.strip() for c in packet.header.get(key, [])[1:] if c.strip()), "") for key in ("Date", "Time")
    )
    try:
        seconds = clock.replace(",", ".").partition(".")
        day = datetime.datetime.strptime(f"{date} {seconds[0]}", "%Y/%m/%d %H:%M:%S")
        return day + datetime.timedelta(seconds=float(f"0.{seconds[2] or 0}"))
    except ValueError:
        return None
