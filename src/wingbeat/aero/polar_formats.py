"""Polars as other programs write them, recognised by their content: XFOIL and its relatives, AeroDyn, QBlade, UIUC.

Each form becomes the table that a CSV file would hold: angle, lift, drag and, if the file has it, the moment about
the quarter chord, with the file's own row numbers. What the head says (Re, Ncrit, Mach) becomes a column, a note.

What differs from what one would guess: the table of tests/cases/README.md.
"""

from __future__ import annotations

import functools
import math
import re
from typing import NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat._base.files import POLAR_SUFFIXES as POLAR_SUFFIXES
from wingbeat._base.sheets import Sheet, decimal_points, same_name

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?$")
# Programs whose polars have lines of text above the names of the columns.
_PROGRAMS = {
    "JavaFoil": r"(?i)\bcm 0[.,]25\b",
    "UIUC wind tunnel": r"(?i)^\s*average reynolds",
    "XFLR5": r"(?i)^\s*xflr5",
    "flow5": r"(?i)^\s*flow5",
    "airfoil site": r"(?i)^\s*xfoil polar\.|^\s*polar key\s*,",
    "XFOIL": r"(?i)^\s*xfoil\b|calculated polar for|^\s*xtrf\s*=|^\s*mach\s*=.*\bre\s*=",
}
_RE = re.compile(
    r"(?im)(?:\bre\s*=|^\s*reynolds number\s*,|^\s*average reynolds[^\n]*:)\s*([\d.,]+)(?:\s*[ed]\s*([+-]?\d+))?"
)
_NCRIT = re.compile(r"(?i)\bncrit\s*[=,]\s*([\d.]+)")
_MACH = re.compile(r"(?i)\bmach\s*[=,]\s*([\d.]+)")
_NAME = re.compile(r"(?im)(?:calculated polar for|^\s*airfoil)\s*[:,]\s*(\S.*?)\s*$")
_TYPE = re.compile(r"(?im)^\s*[1-4]\s+[1-4]\s+reynolds number\s*(fixed|~\s*1/sqrt\(cl\)|~\s*1/cl)")
_HEAD_WORDS = re.compile(
    r"(?i)xfoil|xflr5|flow5|calculated polar|reynolds|xtrf|mach|ncrit|airfoil|builder|comment|tabulated|number of"
    r"|max cl|polar key|\burl\b|\bre\s*="
)
_INCOMPRESSIBLE = 0.3
_WHOLE = "is the file whole? Export it again"
# Two rows of one angle are repeats of one point if lift and drag differ by no more than this.
_SAME_LIFT, _SAME_DRAG = 0.005, 0.001


class PolarFile(NamedTuple):
    """A polar of another program as a table; its moment, if it has one, is about the quarter chord."""

    sheet: Sheet
    quarter: bool  # whether it has a moment, about the quarter chord


class _Row(NamedTuple):
    row: int
    reynolds: str
    cells: tuple[str, ...]  # angle, lift, drag and, if known, moment
    group: float = 0.0  # the Reynolds number of its polar


def polar_of(faults: FaultList, file: str, text: str) -> PolarFile | None:
    """Return a file of another program as a table, or None if it is none of these. Faults of rows are noted."""
    lines = text.splitlines()
    start = "\n".join(lines[:60])
    if re.search(r"(?im)^[^!\n]*\bNumAlf\b", text):
        read = _airfoil_info
    elif re.search(r"(?im)number of airfoil tables in this file", start):
        read = _aerodyn_14
    elif re.search(r"(?m)^\S.*\s(POLARNAME|ISDECOMPOSED)\b", start):
        read = _qblade
    else:
        program = next((name for name, pattern in _PROGRAMS.items() if re.search(f"(?m){pattern}", start)), "")
        if not program or start.lstrip().startswith("#"):
            return None
        read = functools.partial(_with_heads, program=program)
    plain = decimal_points(faults, file, lines)
    found = read(faults, file, plain)
    said = () if plain is lines else ("decimal commas are read as points",)
    return found._replace(sheet=found.sheet._replace(notes=(*said, *found.sheet.notes)))


def _plain(cells: list[str]) -> list[str]:
    """Return cells whose numbers Python reads: Fortran's 1.0D-02 is 1.0E-02."""
    return [re.sub("[dD]", "E", cell) if _NUMBER.match(cell) else cell for cell in cells]


def _split(line: str, separator: str) -> list[str]:
    """Return the cells of a line, with names of two words as one."""
    line = re.sub(r"(?i)\b(top|bot) (xtr|itr)\b", r"\1_\2", line)
    line = re.sub(r"(?i)\bcm 0[.,]25\b", "Cm", line).strip()
    cells = line.split() if separator == " " else [cell.strip() for cell in line.split(separator)]
    while cells and not cells[-1]:
        cells.pop()
    return _plain(cells)


def _separator(line: str) -> str:
    return next((sign for sign in ("\t", ";", ",") if sign in line.strip()), " ")


_COLUMNS = {"alpha": "alpha", "aoa": "alpha", "α": "alpha", "cl": "lift", "cd": "drag", "cm": "moment"}
_COLUMNS |= {"re": "reynolds"}


def _places(line: str, program: str) -> dict[str, int]:
    """Return the index of each column if the line names columns, else nothing."""
    found: dict[str, int] = {}
    for k, cell in enumerate(_split(line, _separator(line))):
        if name := _COLUMNS.get(same_name(cell)):
            found.setdefault(name, k)
    if program == "JavaFoil" and "lift" in found:
        found.setdefault("alpha", 0)  # a Greek letter that encodings spoil
    return found if {"alpha", "lift"} <= set(found) else {}


def _with_heads(faults: FaultList, file: str, lines: list[str], program: str) -> PolarFile:
    """Read polars that have lines of text above the names of their columns, one below the other."""
    heads = [(i, places) for i, line in enumerate(lines) if (places := _places(line, program))]
    if not heads:
        rule = f"seems to be a polar of {program}, but no line names the columns alpha, CL and CD"
        faults.add(file, lines[0].strip(), rule, _WHOLE)
        faults.raise_if_any()
    rows: list[_Row] = []
    notes: list[str] = []
    above = 0  # where the head of the polar begins
    for (at, places), end in zip(heads, [*(i for i, _ in heads[1:]), len(lines)], strict=True):
        whole, separator = "\n".join(lines[above:at]), _separator(lines[at])
        if "drag" not in places:
            fix = "give the file that has lift and drag at each angle"
            if program == "UIUC wind tunnel":
                fix = "this is a lift file: its third column is the moment. Give the drag file of the same model "
                fix += "(its name ends in .DRG or _drg.txt), which has lift and drag at each angle"
            faults.add(f"{file} row {at + 1}", lines[at].strip(), "names lift, but no drag", fix)
            faults.raise_if_any()
        stated = _Stated.of(faults, f"{file} row {above + 1}", whole, program)
        own: list[_Row] = []
        widths: list[int] = []
        names, above = _split(lines[at], separator), end
        for number, line in enumerate(lines[at + 1 : end], start=at + 2):
            text = line.strip()
            cells = _split(line, separator)
            if not text or set(text) <= set("- \t") or all(re.fullmatch(r"[\[(].*[\])]|-", c) for c in cells):
                continue  # blank, a rule, or units
            numbers = [_NUMBER.match(cell) is not None for cell in cells]
            looks = len(cells) > 2 and 2 * sum(numbers) >= len(cells) and not _HEAD_WORDS.search(text)
            if above == end and not looks and not all(numbers):
                above = number - 1  # here the head of the next polar begins
            elif above < end and looks:
                faults.add(
                    f"{file} row {number}", text, "is a row of numbers in a polar's head", "is a line missing?"
                )
            elif above == end and not (looks and all(numbers)):
                rule = "has a cell that is not a number" if looks else "is no row of a polar"
                faults.add(f"{file} row {number}", text, rule, "write a number, or drop the row")
            elif above == end:
                widths.append(len(cells))
                own.append(_Row(number, "", tuple(cells)))
            if above < end and end == len(lines) and not _HEAD_WORDS.search(text) and not looks:
                rule = "is neither a row of numbers nor a line of a polar's head"
                faults.add(
                    f"{file} row {number}", text, rule, "is the file whole? Export it again, or drop the line"
                )
        if not own:
            fix = "XFOIL and its relatives leave out each point that did not converge: more iterations may help"
            faults.add(f"{file} row {at + 1}", lines[at].strip(), "has no row of numbers below it", fix)
            continue
        usual = max(set(widths), key=widths.count)
        if not 0 <= usual - len(names) <= (2 if program in ("XFLR5", "flow5") else 0):
            rule = f"has {usual} cells, but the head names {len(names)} columns"
            faults.add(f"{file} row {own[0].row}", lines[own[0].row - 1].strip(), rule, _WHOLE)
            continue
        for one in own:
            if len(one.cells) != usual:
                rule = f"has {len(one.cells)} cells, but the other rows have {usual}"
                faults.add(f"{file} row {one.row}", lines[one.row - 1].strip(), rule, "drop the row")
        own = [one for one in own if len(one.cells) == usual]
        if usual > len(names):
            told = (
                f"the head names {len(names)} columns and the rows have {usual} numbers, as {program} writes them"
            )
            notes.append(f"{told}; those up to C_M are read")
        if "reynolds" in places and len(own) > 1 and len({float(one.cells[places["alpha"]]) for one in own}) == 1:
            rule = "is a polar of one angle at several Reynolds numbers (type 4)"
            fix = "export polars of type 1, each at one Reynolds number and many angles"
            faults.add(f"{file} row {at + 1}", lines[at].strip(), rule, fix)
            faults.raise_if_any()
        wanted = [places[name] for name in ("alpha", "lift", "drag", "moment") if name in places]
        for one in own:
            chosen = tuple(one.cells[k] for k in wanted)
            known = one.cells[places["reynolds"]] if "reynolds" in places else stated.at(float(chosen[1]))
            rows.append(_Row(one.row, known, chosen, stated.reynolds or 0.0))
        if stated.angles is not None and stated.angles != len(own):
            rule = f"is the stated number of angles, but {len(own)} rows follow"
            faults.add(f"{file} row {at + 1}", stated.angles, rule, _WHOLE)
        still = [one for one in own if float(one.cells[places["drag"]]) == 0]
        if still and program != "UIUC wind tunnel":
            rule = f"is a row without drag ({len(still)} of {len(own)}): viscosity was off"
            fix = "a second VISC switches it off, and XFOIL appends below the old head: drop these rows"
            faults.add(f"{file} row {still[0].row}", lines[still[0].row - 1].strip(), rule, fix)
        notes += [stated.said, *_sweeps(own, program)]
    return _table(faults, file, heads[0][0] + 1, rows, notes, section=program != "UIUC wind tunnel")


class _Stated(NamedTuple):
    """What the head of one polar states."""

    reynolds: float | None
    kind: int  # 1: Re holds for all rows; 2: Re falls with the root of C_L; 3: with C_L
    angles: int | None  # number of rows
    said: str

    @classmethod
    def of(cls, faults: FaultList, where: str, head: str, program: str) -> _Stated:
        """Return what the head states; note a Reynolds number that is zero or can be read in two ways."""
        reynolds, kind = None, 1
        if found := _RE.search(head):
            digits, power = found.groups()
            digits = digits.rstrip(".")
            if "," in digits:
                faults.add(where, found[0].strip(), "has a comma, which can mean two numbers", "write plain digits")
            elif not _NUMBER.match(digits):
                faults.add(where, found[0].strip(), "is no Reynolds number", "write plain digits, without marks")
            else:
                reynolds = float(f"{digits}e{power or 0}")
        if way := _TYPE.search(head):
            kind = {"fixed": 1, "~1/sqrt(cl)": 2, "~1/cl": 3}[way[1].lower().replace(" ", "")]
        elif program in ("XFOIL", "XFLR5", "flow5"):
            program += ", the head does not say whether Re is fixed"
        if reynolds == 0:
            fix = "switch viscosity on (VISC 50000) and compute the polar again"
            faults.add(where, "Re = 0", "is a polar without viscosity, which has no drag", fix)
            reynolds = None
        name, values = _NAME.search(head), list[float | None]()
        for pattern in (_NCRIT, _MACH):
            found = pattern.search(head)
            values.append(float(found[1].rstrip(".")) if found and _NUMBER.match(found[1].rstrip(".")) else None)
            if found and values[-1] is None:
                faults.add(where, found[0].strip(), "is not a number", "write one number with a decimal point")
        ncrit, mach = values
        parts = [f"{program}: {name[1]}" if name else program]
        parts.append("no Re in the head" if reynolds is None else f"Re {reynolds:.0f}")
        parts += [f"Ncrit {ncrit:g}"] if ncrit is not None else []
        parts += [f"Mach {mach:g}"] if mach else []
        if kind > 1 and reynolds:
            law = "Re/sqrt(C_L)" if kind == 2 else "Re/C_L"
            parts.append(f"a polar of type {kind}: Re of a row is {law}")
        if mach and mach > _INCOMPRESSIBLE:
            parts.append("compressible, which flapping flight is not")
        count = re.search(r"(?im)^number of angles[^\n]*:\s*(\d+)", head)
        return cls(reynolds, kind, int(count[1]) if count else None, ", ".join(parts))

    def at(self, lift: float) -> str:
        """Return the Reynolds number of a row as text; empty where it is not known."""
        if self.reynolds is None or (self.kind > 1 and lift <= 0):
            return ""
        return f"{self.reynolds / {1: 1.0, 2: math.sqrt(max(lift, 0)), 3: lift}[self.kind]:.8g}"


def _sweeps(rows: list[_Row], program: str) -> list[str]:
    """Return a note on angles that are missing between the others."""
    angles = sorted({float(one.cells[0]) for one in rows})
    steps = np.diff(angles)
    if len(steps) < 3:
        return []
    gaps = [f"{angles[i]:g} and {angles[i + 1]:g}" for i in np.flatnonzero(steps > 1.6 * np.median(steps))]
    if not gaps:
        return []
    why = " (points that did not converge are left out)" if program in ("XFOIL", "XFLR5", "airfoil site") else ""
    return [f"no row between {', '.join(gaps[:6])}{', ...' * (len(gaps) > 6)} degrees{why}"]


def _table(
    faults: FaultList, file: str, header_row: int, rows: list[_Row], notes: list[str], *, section: bool
) -> PolarFile:
    """Return the rows of all polars as one table, sorted by Re and angle; repeats of one point are left out."""
    faults.raise_if_any()
    ordered = sorted(rows, key=lambda one: (one.group, float(one.cells[0])))
    kept: list[_Row] = []
    repeats = []
    for one in ordered:
        before = kept[-1] if kept else None
        if before is not None and before.group == one.group and float(before.cells[0]) == float(one.cells[0]):
            off = [abs(float(a) - float(b)) for a, b in zip(one.cells[1:3], before.cells[1:3], strict=True)]
            if off[0] <= _SAME_LIFT and off[1] <= _SAME_DRAG:
                repeats.append(one.cells[0])
                continue
        kept.append(one)
    for group in dict.fromkeys(one.group for one in kept):
        own = [one for one in kept if one.group == group]
        angles = np.array([float(one.cells[0]) for one in own])
        for end, beside in ((0, 1), (-1, -2)) if len(own) > 3 else ():
            gap = abs(angles[end] - angles[beside])
            if abs(angles[end]) == 180 and gap > max(60, 4 * np.median(np.diff(angles))):
                rule = f"is {gap:g} degrees from the row beside it: was its angle changed?"
                fix = (
                    "openfast_io moves both ends of a part polar to 180 degrees: drop the two rows, or export again"
                )
                faults.add(f"{file} row {own[end].row}", float(angles[end]), rule, fix)
    faults.raise_if_any()
    if repeats:
        notes.append(f"rows that repeat one are left out, at {', '.join(repeats[:6])} degrees")
    if [one.row for one in ordered] != sorted(one.row for one in rows):
        notes.append("the rows are sorted by angle; in the file they stand in the order of the sweeps")
    moment = all(len(one.cells) > 3 for one in kept)
    stated = any(one.reynolds for one in kept)
    if moment:
        notes.append("C_M is about the quarter chord; about mid-chord it is C_M + C_N/4")
    header = ["alpha", *(["reynolds"] if stated else []), "CL", "CD", *(["CM"] if moment else [])]
    table = []
    for one in kept:
        angle, *loads = one.cells
        cells = [angle, *([one.reynolds] if stated else []), *loads[: 3 if moment else 2]]
        table.append((one.row, ",".join(cells)))
    constants = {"aspect_ratio": (header_row, "inf")} if section else {}
    return PolarFile(Sheet(file, constants, header_row, header, table, tuple(notes)), moment)


def _numbers(faults: FaultList, where: str, line: str, least: int, most: int) -> list[str] | None:
    """Return the numbers of a row, or note what is wrong with it."""
    cells = _plain(line.replace(",", " ").split())
    if not least <= len(cells) <= most or not all(_NUMBER.match(cell) for cell in cells):
        wanted = f"{least} to {most}" if most > least else f"{least}"
        faults.add(where, line.strip(), f"is no row of {wanted} numbers", _WHOLE)
        return None
    return cells


def _airfoil_info(faults: FaultList, file: str, lines: list[str]) -> PolarFile:
    """Read an airfoil table of AeroDyn 15, AirfoilInfo: Re in millions, and tables of a stated length."""
    rows: list[_Row] = []
    notes: list[str] = []
    reynolds, left, header_row, stated = "", 0, 1, None
    for number, line in enumerate(lines, start=1):
        where, text = f"{file} row {number}", line.strip()
        if not text or text.startswith(("!", "#", "=")):
            continue
        words = _plain(text.split())
        if left:
            if cells := _numbers(faults, where, text, 3, 5):
                rows.append(_Row(number, reynolds, tuple(cells[:4]), float(reynolds or 0)))
            left -= 1
        elif len(words) > 1 and words[1] in ("Re", "NumAlf", "NumTabs"):
            if not _NUMBER.match(words[0]):
                faults.add(where, text, f"does not begin with the number {words[1]}", _WHOLE)
                faults.raise_if_any()
            value = float(words[0])
            if words[1] == "NumTabs":
                stated = int(value)
            elif words[1] == "NumAlf":
                left, header_row = int(value), number
                notes.append(f"AeroDyn table: Re {reynolds}, from millions" if reynolds else "AeroDyn: no Re")
            elif value > 100:
                fix = f"this format has Re in millions: write {value / 1e6:g}"
                faults.add(where, text, "is a Reynolds number of more than 100 millions", fix)
            else:
                reynolds = f"{value * 1e6:.8g}" if value > 0 else ""
        elif rows and len(words) > 2 and all(_NUMBER.match(word) for word in words):
            faults.add(
                where, text, "is a row beyond the length that NumAlf states", "correct NumAlf or drop the row"
            )
    tables = len([note for note in notes if note.startswith("AeroDyn")])
    if left:
        faults.add(
            f"{file} row {header_row}", "NumAlf", f"states {left} rows more than the file has", "is it whole?"
        )
    if stated is not None and stated != tables:
        faults.add(
            file, stated, f"is the stated number of tables NumTabs, but the file has {tables}", "is it whole?"
        )
    return _table(faults, file, header_row, rows, notes, section=False)


def _aerodyn_14(faults: FaultList, file: str, lines: list[str]) -> PolarFile:
    """Read an airfoil file of AeroDyn 14 or before, as QBlade and AirfoilPrep export it."""
    rows: list[_Row] = []
    notes: list[str] = []
    reynolds, identity, stated, ended, header_row, tables = "", "", 1, False, 1, 0
    for number, line in enumerate(lines, start=1):
        where, text = f"{file} row {number}", line.strip()
        words = _plain(text.split())
        if not words:
            continue
        if re.search(r"(?i)number of airfoil tables", text):
            stated = int(float(words[0])) if _NUMBER.match(words[0]) else 1
        elif text.upper().startswith("EOT"):
            ended = True
        elif _NUMBER.match(words[0]) and len(words) > 1 and not _NUMBER.match(words[1]):
            if re.search(r"(?i)reynolds number in millions", text):
                reynolds = f"{float(words[0]) * 1e6:.8g}" if float(words[0]) > 0 else ""
            elif re.search(r"(?i)table id", text):
                identity = words[0]
            header_row = number
        elif _NUMBER.match(words[0]) and rows and rows[-1].row < header_row:
            ended = False
        if _NUMBER.match(words[0]) and (len(words) > 2 and _NUMBER.match(words[1])):
            tables += not rows or rows[-1].row < header_row
            if len(words) > 4:
                rule = f"has {len(words)} numbers: several tables side by side"
                faults.add(where, text, rule, "export one table, with alpha, Cl, Cd and Cm")
                faults.raise_if_any()
            if cells := _numbers(faults, where, text, 3, 4):
                rows.append(_Row(number, reynolds, tuple(cells), float(reynolds or 0)))
        elif rows and number > rows[-1].row and not ended and header_row != number:
            faults.add(where, text, "is no row of 3 to 4 numbers", _WHOLE)
    if not rows:
        faults.add(file, "", "seems to be an airfoil file of AeroDyn, but has no row of numbers", _WHOLE)
    if tables != stated:
        faults.add(file, stated, f"is the stated number of tables, but the file has {tables}", _WHOLE)
    known = ", ".join(dict.fromkeys(one.reynolds for one in rows if one.reynolds))
    notes.append(f"AeroDyn table: Re {known}, from millions" if known else "AeroDyn table without Re")
    if not known and identity and float(identity):
        notes.append(f"the table's ID is {identity}; some programs write Re in millions there, which is not read")
    return _table(faults, file, header_row, rows, notes, section=False)


def _qblade(faults: FaultList, file: str, lines: list[str]) -> PolarFile:
    """Read a polar of QBlade (.plr): values before their keys, and three columns for each Reynolds number."""
    rows: list[_Row] = []
    reynolds: list[str] = []
    header_row = 1
    for number, line in enumerate(lines, start=1):
        where, text = f"{file} row {number}", line.strip()
        words = _plain(re.split(r"[\s,]+", text))
        if not text or set(text) <= set("-") or text.startswith(("#", "!")):
            continue
        numbers = [word for word in words if _NUMBER.match(word)]
        if "REYNOLDS" in words:
            reynolds, header_row = words[: words.index("REYNOLDS")], number
            if not reynolds or not all(_NUMBER.match(word) for word in reynolds):
                faults.add(where, text, "does not begin with Reynolds numbers", "export the polar again")
                faults.raise_if_any()
        elif "ISDECOMPOSED" in words and words[0].lower() in ("1", "true"):
            fix = "export the polar without the parts of attached and separated flow"
            faults.add(where, text, "is a decomposed polar, with other columns", fix)
            faults.raise_if_any()
        elif len(numbers) == len(words) > 2 or (rows and not re.search(r"\b[A-Z]{4,}\b", text)):
            width = 1 + 3 * max(len(reynolds), 1)
            if cells := _numbers(faults, where, text, width, width):
                for k in range(max(len(reynolds), 1)):
                    chosen = (cells[0], *cells[1 + 3 * k : 4 + 3 * k])
                    known = f"{float(reynolds[k]):.8g}" if reynolds else ""
                    rows.append(_Row(number, known, chosen, float(known or 0)))
    if not rows:
        faults.add(file, "", "seems to be a polar of QBlade, but has no row of numbers", "export it again")
    said = f"QBlade polar: Re {', '.join(reynolds)}" if reynolds else "QBlade polar without Re"
    return _table(faults, file, header_row, rows, [said], section=False)
