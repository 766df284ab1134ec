"""Tables of tracked points: DLTdv, Anipose, DeepLabCut, OpenSim, Qualisys, Vicon and their like."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any, NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat._base.sheets import MAX_CELL_FAULTS, NO_VALUE, number_in, same_name, split_cells, split_unit

Array = NDArray[np.float64]
# Metres in a unit of length.
METRES = {"m": 1.0, "cm": 0.01, "mm": 0.001}
UNIT_WORDS = {**{name: name for name in METRES}, "meters": "m", "metres": "m", "meter": "m", "metre": "m"}
UNIT_WORDS |= {"millimeters": "mm", "millimetres": "mm", "centimeters": "cm", "centimetres": "cm"}
# Below this likelihood DeepLabCut and movement themselves drop a point (pcutoff 0.6, filter_by_confidence 0.6).
LEAST_SCORE = 0.6
# A point that was seen in fewer frames has no noise that could be told from its motion.
FEWEST_SEEN = 12
SCORES = ("score", "likelihood", "confidence")
_FRAMES = ("frame", "frames", "fnum", "framenumber", "frameindex", "frameidx", "frameno", "field")
_TIMES = ("time", "times", "timeseconds", "timesec", "t")
_MOST_FRAMES = 100_000
# No animal's file has larger numbers in any unit.
_LARGEST = 1e7
# The axis at the end of a column's name, after a sign, a figure or a change to capitals: tip_x, pt1_X, tip X, tipX.
_AXIS_LAST = re.compile(r"(?P<name>.*?)(?:[\s_.:\-]+(?P<a>[xyzXYZ])|(?<=\d)(?P<b>[xyzXYZ])|(?<=[a-z])(?P<c>[XYZ]))")
_AXIS_FIRST = re.compile(r"(?P<a>[xyzXYZ])[\s_.:\-]+(?P<name>.+)")


class Table(NamedTuple):
    """A text file's table: labels of columns (name and what it holds), cells with their row, and the head."""

    kind: str
    labels: list[tuple[str, str]]
    rows: list[tuple[int, list[str]]]
    rate: float | None = None
    unit: str | None = None


def refuse(where: str, value: Any, rule: str, fix: str = "") -> NoReturn:
    """Raise the one fault of a file."""
    raise InvalidInputError([Fault(where, value, rule, fix)])


def refuse_repeated(file: str, names: Sequence[str]) -> None:
    """Refuse names that two points share: one of them would be lost."""
    if repeated := sorted({name for name in names if names.count(name) > 1}):
        rule = "names more than one point of the file"
        refuse(f"{file}, points", ", ".join(repeated[:5]), rule, "give each point its own name")


def without_subject(names: Sequence[str]) -> list[str]:
    """Return names such as Bird:tip without what stands before the colon, if they then still differ."""
    short = [name.rpartition(":")[2] for name in names]
    return short if len(set(short)) == len(set(names)) else list(names)


def split_table(file: str, text: str) -> Table:
    """Split a text into a table, and say what wrote it."""
    lines = [(row, line) for row, line in enumerate(text.splitlines(), start=1) if line.strip(" ,;\t")]
    lines = [(row, line) for row, line in lines if not line.lstrip().startswith("#")]
    if len(lines) < 2:
        refuse(file, text[:40], "holds no table of points", "is it the right file?")
    if re.match(r"(?i)sparse format\b", lines[0][1].strip()):
        return _sparse(file, lines)
    counts = {sign: sum(line.count(sign) for _, line in lines[:40]) for sign in "\t;,"}
    sign = max(counts, key=lambda one: (counts[one], one != ",")) if any(counts.values()) else " "
    if sign == "," and counts[";"] >= len(lines[:40]):
        sign = ";"  # decimal commas
    rows = [(row, split_cells(line, sign)) for row, line in lines]
    first = rows[0][1]
    key = same_name(first[0])
    if key == "pathfiletype":
        return _trc(file, rows)
    if key in ("noofframes", "fileversion") or any(cells[0] == "MARKER_NAMES" for _, cells in rows[:20]):
        return _qualisys(file, rows)
    if key == "trajectories" or any(cells[0] == "Trajectories" for _, cells in rows[:200]):
        return _vicon(file, rows)
    head = next((i for i, (_, cells) in enumerate(rows) if _mostly_numbers(cells)), len(rows))
    if head == 0:
        refuse(f"{file} row {rows[0][0]}", first[0], "holds numbers, but the first row must name the columns")
    heads = [cells for _, cells in rows[:head]]
    table = rows[head:]
    words = [same_name(cells[0]) for cells in heads]
    if "bodyparts" in words and "coords" in words:
        names = heads[words.index("bodyparts")]
        if "individuals" in words:
            animals = heads[words.index("individuals")]
            if len(set(animals[1:])) > 1:
                names = [f"{a} {b}" for a, b in zip(animals, names, strict=False)]
        labels = [("", "frame"), *zip(names[1:], heads[words.index("coords")][1:], strict=False)]
        kind = "DeepLabCut" if "movement" not in heads[0][1:2] else "movement, in DeepLabCut's form"
        return Table(kind, [(name, part.lower()) for name, part in labels], table)
    last, units = heads[-1], set()
    if len(heads) > 1 and sum(cell.strip().lower() in ("x", "y", "z") for cell in last) >= 3:
        names = _filled(heads[-2])
        return Table(
            "a table", [_label(f"{name}_{cell}", units) for name, cell in zip(names, last, strict=False)], table
        )
    labels = [_label(cell, units) for cell in last]
    kind = "Anipose" if any(part == "ncams" for _, part in labels) else "a table"
    if any(re.fullmatch(r"pt\d+", name) for name, part in labels if part == "x"):
        kind = "DLTdv"
    if len(units) > 1:
        refuse(
            f"{file} row {rows[head - 1][0]}", ", ".join(sorted(units)), "are units of one table", "use one unit"
        )
    return Table(kind, labels, table, None, next(iter(units), None))


def _filled(cells: Sequence[str]) -> list[str]:
    """Return names of which each stands above the first of several columns, for all of them."""
    found, name = [], ""
    for cell in cells:
        name = cell.strip() or name
        found.append(name)
    return found


def _number(cell: str) -> float | None:
    """Return the finite number of a cell, with a decimal point or comma; None if it holds none."""
    value = number_in(cell.replace(",", ".", 1))
    return value if value is not None and math.isfinite(value) else None


def _mostly_numbers(cells: Sequence[str]) -> bool:
    given = [cell for cell in cells if cell.strip().lower() not in NO_VALUE]
    return sum(_number(cell) is not None for cell in given) > 0.5 * len(given) and bool(given)


def _label(cell: str, units: set[str]) -> tuple[str, str]:
    """Return the point and the part ("x", "score", ..) of a column; a clock has no point; others have no part."""
    name, unit = split_unit(cell)
    plain = same_name(name)
    if plain in _FRAMES:
        return "", "frame"
    if plain in _TIMES:
        return "", "milliseconds" if (unit or "").lower() in ("ms", "milliseconds") else "time"
    for part in (*SCORES, "ncams"):
        if re.search(rf"[\s_.:\-]{part}$", name, re.IGNORECASE):
            return name[: -len(part) - 1], part
    match = _AXIS_LAST.fullmatch(name) or _AXIS_FIRST.fullmatch(name)
    if match is None:
        return name, ""
    if (unit or "").lower() in UNIT_WORDS:
        units.add(UNIT_WORDS[(unit or "").lower()])
    axis = next(value for key, value in match.groupdict().items() if key != "name" and value)
    return match["name"].strip() or "point", axis.lower()


def _sparse(file: str, lines: list[tuple[int, str]]) -> Table:
    """Return the table of DLTdv's sparse form: a title, the size, then row, column, value; the rest are gaps."""
    if "3D" not in lines[0][1]:
        fix = "give the file ...xyzpts.tsv beside it, which DLTdv writes where the cameras are calibrated"
        refuse(f"{file} row {lines[0][0]}", lines[0][1].strip(), "is DLTdv's sparse format without 3D points", fix)
    try:
        frames, columns, entries = (int(cell) for cell in lines[1][1].split())
        given = [(int(a), int(b), float(c)) for a, b, c in (line.split() for _, line in lines[2:])]
    except ValueError:
        frames, columns, entries, given = 0, 0, 0, []
    inside = all(1 <= i <= frames and 1 <= k <= columns for i, k, _ in given)
    if not given or len(given) != entries or columns % 3 or not inside:
        rule = "is DLTdv's sparse format, but the rows do not fit the size in row 2: frames, columns, entries"
        refuse(f"{file} row {lines[1][0]}", lines[1][1].strip(), rule, "is the file whole? Save it again")
    first, last = min(i for i, _, _ in given), max(i for i, _, _ in given)
    if last - first >= _MOST_FRAMES:
        refuse(file, f"{last - first + 1} frames", f"are more than {_MOST_FRAMES}", "cut the clip")
    cells = [[str(i)] + [""] * columns for i in range(first, last + 1)]
    for i, k, value in given:
        cells[i - first][k] = repr(value)
    labels = [("", "frame"), *((f"pt{k // 3 + 1}", "xyz"[k % 3]) for k in range(columns))]
    return Table("DLTdv, sparse", labels, list(enumerate(cells, start=3)))


def _trc(file: str, rows: list[tuple[int, list[str]]]) -> Table:
    """Return the table of a .trc file: row 3 has rate and unit, row 4 names, row 5 axes."""
    if len(rows) < 6 or "DataRate" not in rows[1][1]:
        refuse(file, rows[-1][1][0], "is cut off: a .trc has five rows of heads and a row for each frame")
    head = dict(zip(rows[1][1], rows[2][1], strict=False))
    names = _filled(rows[3][1])
    width = len([cell for cell in rows[4][1] if cell])
    labels = [("", "frame"), ("", "time")]
    for k in range(2, max(len(names), width + 2)):
        labels.append((names[min(k, len(names) - 1)], "xyz"[(k - 2) % 3]))
    labels = labels[: 2 + width]
    stated = head.get("NumFrames", "")
    found = sum(bool(cells[0]) for _, cells in rows[5:])
    if (count := _number(stated)) is not None and int(count) != found:
        refuse(f"{file} row {rows[2][0]}, NumFrames", stated, f"but the file has {found} frames", "is it cut off?")
    unit = UNIT_WORDS.get(head.get("Units", "").lower())
    return Table("OpenSim .trc", labels, rows[5:], _number(head.get("DataRate", "")), unit)


def _qualisys(file: str, rows: list[tuple[int, list[str]]]) -> Table:
    """Return the table of a .tsv of Qualisys Track Manager: lines KEY value, then names; lengths are in mm."""
    keys = {cells[0]: (i, cells[1:]) for i, (_, cells) in enumerate(rows[:40]) if re.match(r"[A-Z_]+$", cells[0])}
    if "MARKER_NAMES" not in keys:
        refuse(file, rows[0][1][0], "has no line MARKER_NAMES", "export the 3D data from Qualisys Track Manager")
    names = [name for name in keys["MARKER_NAMES"][1] if name]
    start = 1 + max(i for i, _ in keys.values())
    labels = [(name, axis) for name in names for axis in "xyz"]
    if start < len(rows) and not _mostly_numbers(rows[start][1]):
        start += 1
    width = max((len(cells) for _, cells in rows[start:]), default=0)
    labels = [("", "frame"), ("", "time")][: max(width - len(labels), 0)] + labels
    text = next(iter(keys.get("FREQUENCY", (0, [""]))[1]), "")
    stated = next(iter(keys.get("NO_OF_FRAMES", (0, [""]))[1]), "")
    if (count := _number(stated)) is not None and int(count) != len(rows) - start:
        rule = f"but the file has {len(rows) - start} frames"
        refuse(f"{file}, NO_OF_FRAMES", stated, rule, "is it cut off?")
    return Table("Qualisys .tsv", labels, rows[start:], _number(text), "mm")


def _vicon(file: str, rows: list[tuple[int, list[str]]]) -> Table:
    """Return the trajectories of a .csv of Vicon Nexus: rate, names (Subject:NAME), axes, units, frames."""
    at = next(i for i, (_, cells) in enumerate(rows) if cells[0] == "Trajectories")
    if len(rows) < at + 6 or (rate := _number(rows[at + 1][1][0])) is None:
        refuse(file, "Trajectories", "is not followed by a rate, three rows of heads and the frames")
    names = without_subject(_filled(rows[at + 2][1]))
    axes, units = rows[at + 3][1], {cell for cell in rows[at + 4][1] if cell in METRES}
    labels: list[tuple[str, str]] = []
    for k, cell in enumerate(axes):
        name = names[min(k, len(names) - 1)]
        labels.append((name, cell.lower()) if cell.lower() in ("x", "y", "z") else _label(cell, set()))
    end = next((i for i, (_, cells) in enumerate(rows) if i > at + 5 and _number(cells[0]) is None), len(rows))
    return Table("Vicon Nexus", labels, rows[at + 5 : end], rate, next(iter(units), None))


def table_numbers(file: str, table: Table) -> Array:
    """Return the numbers of all rows; empty cells are NaN, other cells that are not numbers are refused."""
    faults, used = FaultList(), [k for k, (_, part) in enumerate(table.labels) if part]
    if len(table.rows) > _MOST_FRAMES:
        faults.add(file, f"{len(table.rows)} frames", f"are more than {_MOST_FRAMES}", "cut the clip")
        faults.raise_if_any()
    found = np.full((len(table.rows), len(table.labels)), np.nan)
    for i, (row, cells) in enumerate(table.rows):
        if len(faults.faults) > MAX_CELL_FAULTS:
            faults.add(file, f"{MAX_CELL_FAULTS} faults and more", "too many to list", "is it the right file?")
            break
        missing = len(table.labels) - len(cells)
        extra = [cell for cell in cells[len(table.labels) :] if cell]
        # Some writers of tab-separated files drop the tabs behind the last point that was seen.
        if extra or (missing > 0 and not (missing % 3 == 0 and "." in table.kind)):
            rule = f"has {len(cells)} cells, but the head names {len(table.labels)} columns"
            faults.add(f"{file} row {row}", ",".join(cells)[:60], rule, "is the row cut off, or a column missing?")
            continue
        for k in used:
            cell = cells[k] if k < len(cells) else ""
            if cell.lower() in NO_VALUE:
                continue
            found[i, k] = np.inf if (value := _number(cell)) is None else value
            if not abs(found[i, k]) < _LARGEST:
                where = f"{file} row {row}, column {'_'.join(filter(None, table.labels[k]))}"
                faults.add(where, cell, "is not a coordinate", "write one number, or leave the cell empty")
    clock = [k for k, (name, part) in enumerate(table.labels) if part and not name]  # not pandas' unnamed index
    for k in clock:
        if not faults.faults and not np.isfinite(found[:, k]).all():
            row = table.rows[int(np.argmin(np.isfinite(found[:, k])))][0]
            faults.add(f"{file} row {row}, {table.labels[k][1]}", "", "is empty", "number every frame")
    faults.raise_if_any()
    return found
