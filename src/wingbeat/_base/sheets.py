"""Tables of measurements: ``# key = value`` lines above them, columns with units, separators, cells and numbers."""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base.errors import Fault, FaultList, FileError, InvalidInputError
from wingbeat._base.files import read_text, write_atomically

# A record of 30 s at 10 kHz has some 20 MB.
MAX_BYTES = 1 << 26
# A list of forty bad cells helps as much as a longer one.
MAX_CELL_FAULTS = 40
# A file needs some twenty constants. More lines than these are not ours, and would fill the memory.
MAX_CONSTANTS = 1000
# No instrument gives larger numbers, and their squares would overflow.
LARGEST = 1e100
# What programs write where there is no value, in lower case: pandas, NumPy, MATLAB, R, LabVIEW, spreadsheets.
NO_VALUE = {"", "nan", "-nan", "na", "n/a", "#n/a", "null", "none", "<na>", "1.#qnan", "-1.#ind", "nan(ind)"}
# Which wing columns and points belong to, and how names spell it.
SIDES = ("both", "left", "right")
SIDE_WORDS = {"left": "left", "l": "left", "right": "right", "r": "right"}
_SAME = {"n·m": "n m", "n*m": "n m", "nm": "n m", "n.m": "n m", "-": "", "1": ""}
_SAME |= {"°": "deg", "degrees": "deg", "seconds": "s"}
# What programs and instruments write: a pattern at the beginning, # lines left out, and what to do with the file.
_COPY_POLAR = "give it where coefficients are read: --aero, polar, fit, glide"
_COPY_LOADS = "wingbeat reduce reads it: --channels normal=NAME,tangential=NAME,moment=NAME"
_COPY_POINTS = "wingbeat reads angles, not points: wingbeat film POINTS -o film.csv computes the angles"
_KNOWN_FILES = (
    (r"labview measurement", f"a measurement file of LabVIEW (.lvm); {_COPY_LOADS}"),
    (r"ati (daq|industrial|net f/t)|.{0,400}?^calibration,ft\d", f"a log of an ATI force sensor; {_COPY_LOADS}"),
    (
        r"([^\n]*,)?\s*fx\b[^\n]*\bfy\b[^\n]*\bfz\b",
        f"a log of a force sensor with the axes Fx, Fy, Fz; {_COPY_LOADS}",
    ),
    (r"scorer,|[^\n]*\nbodyparts,", f"points tracked by DeepLabCut; {_COPY_POINTS}"),
    (r"\w*pt1_x,", f"points tracked by DLTdv; {_COPY_POINTS}"),
    (r"[^\n]*_ncams,", f"points tracked by Anipose; {_COPY_POINTS}"),
    (r"[^\n]*(frame_idx|track,)[^\n]*\.score", f"points tracked by SLEAP; {_COPY_POINTS}"),
    (r"pathfiletype", f"marker points of OpenSim or a motion-capture system (.trc); {_COPY_POINTS}"),
    (r"xfoil polar\.", f"a polar from an airfoil site (XFOIL, with lines of text above it); {_COPY_POLAR}"),
    (r"(xfoil|xflr5) ", f"a polar of XFOIL or XFLR5; {_COPY_POLAR}"),
    (r"!.*(airfoilinfo|numalf)|aerodyn", f"an airfoil table of AeroDyn; {_COPY_POLAR}"),
    (r"<(!doctype|html)", "a web page, not a table; download the table itself"),
)
# Files that hold no text.
_BINARY = {
    **dict.fromkeys((".xlsx", ".xls", ".ods"), "a spreadsheet; save its table as CSV"),
    **dict.fromkeys((".mat", ".h5", ".hdf5"), "a file of MATLAB or HDF5; write its table as CSV (writetable)"),
    **{".tdms": f"a file of LabVIEW; {_COPY_LOADS}", ".c3d": f"marker points (C3D); {_COPY_POINTS}"},
}
# How many characters of a file show what it is.
_FIRST = 4000


class Heading(NamedTuple):
    """A name, and the unit that follows it in brackets; None without one."""

    name: str
    unit: str | None


class Sheet(NamedTuple):
    """The parts of a CSV file: constants by key, column names, and cells; constants and cells with their row."""

    file: str
    constants: dict[str, tuple[int, str]]
    header_row: int
    header: list[str]
    rows: list[tuple[int, str]]
    notes: tuple[str, ...] = ()  # on separators and decimal commas


def split_unit(text: str) -> Heading:
    """Return a column name or key without its unit, and the unit."""
    match = re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\]|\((.*)\))?\s*", text)
    name, square, round_ = match.groups() if match else (text.strip(), None, None)
    unit = square if square is not None else round_
    return Heading(name, None if unit is None else unit.strip())


def check_unit(faults: FaultList, where: str, unit: str | None, wanted: str) -> None:
    """Note a fault if the given unit differs from the unit in which the column is read."""
    if unit is None:
        return
    plain = re.sub(r"\s+", " ", unit.strip().lower().replace("^", "").replace("²", "2").replace("³", "3"))
    plain = re.sub(r"\s*/\s*", "/", plain)
    if _SAME.get(plain, plain) == wanted.lower():
        return
    rule = f"is not the expected unit, [{wanted}]" if wanted else "is a unit, but this quantity has none"
    fix = f"convert the numbers to {wanted} and write [{wanted}]" if wanted else "leave the brackets out"
    faults.add(where, unit, rule, fix)


def same_name(text: str) -> str:
    """Return a name without its unit, in lower case, of letters and digits only: spellings of one name agree.

    >>> same_name("C_L"), same_name("c l [-]"), same_name("Wing Speed (m/s)")
    ('cl', 'cl', 'wingspeed')
    """
    return re.sub(r"[\W_]", "", split_unit(text).name.lower())


def seems_to_be(text: str) -> str | None:
    """Return what a file that is not a CSV table seems to be, and what to do with it; None if nothing shows it."""
    lines = [line for line in text[:_FIRST].splitlines() if line.strip() and not line.lstrip().startswith("#")]
    head = "\n".join(lines).lstrip()
    for pattern, words in _KNOWN_FILES:
        if re.match(pattern, head, re.IGNORECASE | re.DOTALL | re.MULTILINE):
            return words
    return None


def cut_short(text: str) -> tuple[str, ...]:
    """Return a note if a text ends without a line break, in a number that is shorter than the one above it."""
    last = [re.split(r"[\s,;]+", line.strip())[-1] for line in text.rstrip().splitlines()[-2:]]
    if (
        len(last) < 2
        or text.endswith(("\n", "\r"))
        or any(number_in(cell) is None for cell in last)
        or len(last[1]) >= len(last[0])
    ):
        return ()
    return (
        f"the file ends within its last line, at {last[1]}, which is shorter than the number above: is it whole?",
    )


# A number with a comma; with three digits behind it and one to three before, it can be two numbers.
_COMMA = re.compile(r"(?<![\d.,])[+-]?\d+(?:,\d+)+(?:[eE][+-]?\d+)?(?![\d.,])")
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2}(,\d{3})+$")
_SEPARATORS = {";": "semicolons", "\t": "tabs", " ": "spaces"}


def _with_commas(
    file: str, table: list[tuple[int, str]], constants: dict[str, tuple[int, str]]
) -> tuple[list[tuple[int, str]], dict[str, tuple[int, str]], tuple[str, ...]]:
    """Return a table with commas between columns and points in numbers, its constants, and what was changed.

    The line that names the columns shows the separator: semicolons, tabs, spaces, else commas. Commas inside
    numbers are decimal commas if one of them can be nothing else, and no number has a point. Numbers that can be
    read in two ways are refused.
    """
    first = table[0][1]
    sign = next((sign for sign in ";\t" if sign in first.strip()), "")
    glued = re.sub(r"\s+(?=[\[(])", "", first)
    if not sign and "," not in first and len(table) > 1:
        widths = {len(text.split()) for _, text in table[1:]}
        if len(glued.split()) > 1 and widths == {len(glued.split())}:
            sign, table = " ", [(table[0][0], glued), *table[1:]]
        elif len(glued.split()) > 1 and max(widths) > 1:
            rule = (
                f"names {len(glued.split())} columns between spaces, and the rows have {sorted(widths)[-1]} cells"
            )
            fix = "write commas between the columns, and names of one word"
            raise InvalidInputError([Fault(f"{file} row {table[0][0]}", first, rule, fix)])
    if not sign:
        return table, constants, ()
    body = "\n".join(text for _, text in table[1:])
    commas = _COMMA.findall(body)
    decimal = bool(commas)
    if commas:
        points = re.search(r"\d\.\d|(?<![\w.,])\.\d", body)
        sure = [cell for cell in commas if not _THOUSANDS.match(cell) and cell.count(",") == 1]
        worst = next((cell for cell in commas if cell.count(",") > 1), commas[0])
        row = next(number for number, text in table[1:] if worst in text)
        if points or not sure or worst.count(",") > 1:
            rule = "can be read in two ways: with a decimal comma, or with a mark between thousands"
            rule = "has a comma, and other numbers of the file have points" if points else rule
            fix = "write decimal points, and no mark between thousands"
            raise InvalidInputError([Fault(f"{file} row {row}", worst, rule, fix)])
    changed = []
    for k, (row, text) in enumerate(table):
        if decimal and k:
            text = re.sub(r"(?<=\d),(?=\d)", ".", text)
        if sign == " ":
            cells = text.split()
        elif '"' in text:
            cells = [cell.strip() for cell in next(csv.reader([text], delimiter=sign))]
        else:
            cells = text.split(sign)
        quoted = [f'"{cell}"' if "," in cell and '"' not in cell else cell for cell in cells]
        changed.append((row, ",".join(quoted)))
    said = f"{_SEPARATORS[sign]} between the columns" + (" and decimal commas" if decimal else "")
    plain = {key: (row, value.strip(f"{sign} ")) for key, (row, value) in constants.items()}
    if decimal:
        plain = {k: (row, v.replace(",", ".") if _COMMA.fullmatch(v) else v) for k, (row, v) in plain.items()}
    return changed, plain, (f"read with {said}",)


# A number between spaces, tabs or semicolons, and one whose comma can be nothing but decimal: 0,500 or 2,5.
_EITHER = re.compile(r"[+-]?(\d+|\d*[.,]\d+)([eEdD][+-]?\d+)?$")
_DECIMAL = re.compile(r"[+-]?(0*,\d+|\d+,(\d{1,2}|\d{4,}))([eEdD][+-]?\d+)?$")
# A row of whole numbers between commas, some with zeros in front: the digits behind decimal commas.
_COMMAS_ONLY = re.compile(r"(?=.*,\s*0\d)\s*[+-]?\d+(\s*,\s*[+-]?\d+){5,}\s*$")
# A Reynolds number whose commas may stand between thousands, as XFOIL, UIUC and QBlade place it; 1,000 e 6 cannot.
_MARKED = re.compile(
    r"(?i)\bre\w*\s*[=:]\s*[1-9]\d{0,2}(,\d{3})+(?!\s*[ed]\s*[+\d])|^\s*[1-9]\d{0,2}(,\d{3})+\s*$"
    r"|(,\d{3})+\s+(?-i:REYNOLDS)"
)


def decimal_points(faults: FaultList, file: str, lines: list[str]) -> list[str]:
    """Return the lines of a program's text with points for decimal commas; the same list if no row has any.

    Rows of numbers between spaces, tabs or semicolons show it: commas in numbers are decimal commas if one of them
    can be nothing else, and no row has a point.

    >>> decimal_points(FaultList(), "a.txt", ["Mach = 0,100", "1,000 -0,250 0,020"])
    ['Mach = 0.100', '1.000 -0.250 0.020']
    """
    commas, points = list[tuple[int, str]](), 0
    for number, line in enumerate(lines, start=1):
        cells = re.split(r"[\s;]+", line.strip(" \t;"))
        if _COMMAS_ONLY.match(line):
            fix = "export with spaces or semicolons between columns"
            faults.add(f"{file} row {number}", line.strip(), "has commas between columns and in numbers", fix)
            faults.raise_if_any()
        if len(cells) > 2 and all(_EITHER.match(cell) for cell in cells):
            commas += [(number, cell) for cell in cells if "," in cell]
            points += "." in line
    if not commas:
        return lines
    if points or not any(_DECIMAL.match(cell) for _, cell in commas):
        rule = f"has a comma, and {points} rows have decimal points" if points else "can be read in two ways"
        number, cell = commas[0]
        faults.add(f"{file} row {number}", cell, rule, "write decimal points, and no mark between thousands")
        faults.raise_if_any()
    return [line if _MARKED.search(line) else re.sub(r"(?<=\d),(?=\d)", ".", line) for line in lines]


def read_sheet(path: str | Path, *, of_program: bool = False) -> Sheet:
    """Split a CSV file into its constants (``# name = value``) and its table, without converting numbers.

    Columns may be separated by commas, semicolons, tabs or spaces; the sheet's notes say so. Blank rows are left
    out, and so are rows of commas alone, which spreadsheets write for them. A file is refused if it is empty or of
    another format (unless it is known to be a table `of_program`), or if a constant appears twice in any spelling.
    """
    path = Path(path)
    faults = FaultList()
    constants: dict[str, tuple[int, str]] = {}
    given: dict[str, str] = {}
    table: list[tuple[int, str]] = []
    try:
        whole = read_text(path, limit=MAX_BYTES)
        words = None if of_program else seems_to_be(whole)
    except FileError:
        words, whole = _BINARY.get(path.suffix.lower()), path.suffix
        if words is None or not path.is_file():
            raise
    if words:
        first = whole.lstrip().partition("\n")[0].strip()
        raise InvalidInputError([Fault(path.name, first, f"this seems to be {words}")])
    for row, line in enumerate(whole.splitlines(), start=1):
        text = line.strip()
        if text.startswith("#"):
            key, equals, value = text.lstrip("# ").partition("=")
            name = key.strip()
            plain = same_name(name)
            if not equals or not plain or name.startswith("note:"):
                continue  # a line of text, or of = signs
            earlier = given.setdefault(plain, name)
            if name in constants or earlier != name:
                also = "" if earlier == name else f" (above as {earlier})"
                faults.add(f"{path.name} row {row}", name, f"appears twice{also}", "keep one")
            elif len(constants) == MAX_CONSTANTS:
                rule = f"is one of more than {MAX_CONSTANTS} lines '# name = value'"
                faults.add(f"{path.name} row {row}", name, rule, "is it the right file?")
                break
            else:
                constants[name] = (row, value.strip())
        elif text.strip(", \t"):
            table.append((row, text))
    if not table and not faults.faults:
        faults.add(f"{path.name} row 1", "", "the file holds no table", "the first row names the columns")
    faults.raise_if_any()
    table, constants, notes = _with_commas(path.name, table, constants)
    notes = (*notes, *cut_short(whole))
    header = split_cells(table[0][1])
    if all(number_in(cell) is not None for cell in header):
        rule, fix = (
            "holds numbers, but the first row of the table must name the columns",
            "write the names without #",
        )
        raise InvalidInputError([Fault(f"{path.name} row {table[0][0]}", table[0][1], rule, f"{fix} in front")])
    return Sheet(path.name, constants, table[0][0], header, table[1:], notes)


def parse_numbers(
    faults: FaultList, sheet: Sheet, names: list[str], *, blank: frozenset[str] = frozenset()
) -> NDArray[np.float64]:
    """Return the numbers of all rows, shape (rows, columns); a cell that is not a number is noted and becomes NaN.

    `names` are the columns' names in messages; the cells of a column with the name "" are not read, and become NaN.
    In the columns `blank`, a cell may be empty or one of `NO_VALUE`, such as NA, which gives NaN.
    """
    if sheet.rows and not blank and all(names):
        try:  # the quick way, for files in which nothing is wrong
            numbers = np.loadtxt([text for _, text in sheet.rows], delimiter=",", ndmin=2, comments=None)
        except ValueError:
            numbers = np.empty((0, 0))
        # Not a number compares as False.
        if numbers.shape == (len(sheet.rows), len(names)) and (np.abs(numbers) <= LARGEST).all():
            return numbers
    values = np.full((len(sheet.rows), len(names)), np.nan)
    widths = [len(split_cells(text)) for _, text in sheet.rows[:MAX_CELL_FAULTS]]
    width = max(set(widths), key=widths.count, default=0)
    others = "all" if widths.count(width) == len(widths) else "most"
    # A few rows are listed one by one; of many, the one sentence that holds for most helps more.
    many = len(sheet.rows) > MAX_CELL_FAULTS and widths.count(width) > 0.8 * len(widths)
    if len(sheet.rows) > 1 and width != len(names) and (others == "all" or many):
        rule = f"and {others} others have {width} cells, but the header names {len(names)} columns"
        row, text = sheet.rows[widths.index(width)]
        fix = "write decimal points, not commas" if width == 2 * len(names) else "name every column"
        if all(text.endswith(",") for _, text in sheet.rows):
            fix = "drop the commas at the ends of the rows"
        faults.add(f"{sheet.file} row {row}", text, rule, fix)
        return values
    enough = len(faults.faults) + MAX_CELL_FAULTS
    for i, (row, text) in enumerate(sheet.rows):
        if len(faults.faults) > enough:
            shown = f"{MAX_CELL_FAULTS} faults and more"
            faults.add(sheet.file, shown, "too many to list", "is it the right file?")
            break
        cells = split_cells(text)
        if len(cells) != len(names):
            rule = f"has {len(cells)} cells, but the header names {len(names)} columns"
            faults.add(f"{sheet.file} row {row}", text, rule, "write decimal points, not commas")
            continue
        for k, (name, cell) in enumerate(zip(names, cells, strict=True)):
            if name and (name not in blank or cell.lower() not in NO_VALUE):
                values[i, k] = _number(faults, f"{sheet.file} row {row}, column {name}", cell)
    return values


def write_columns(path: str | Path, lines: Sequence[str], columns: Mapping[str, NDArray[np.float64]]) -> None:
    """Write a CSV file: `lines` above the names of the columns, and a row for each number; NaN is an empty cell."""
    rows = (
        ",".join("" if np.isnan(value) else f"{value:.8g}" for value in row)
        for row in zip(*columns.values(), strict=True)
    )
    write_atomically(path, "\n".join([*lines, ",".join(columns), *rows]) + "\n")


def split_cells(text: str, sign: str = ",") -> list[str]:
    """Return the cells of a row between commas or another sign; between spaces none are empty."""
    if sign == " ":
        return text.split()
    try:
        return [cell.strip() for cell in next(csv.reader([text], delimiter=sign))]
    except csv.Error:  # a cell of more than 131072 characters
        return [text]


def number_in(cell: str) -> float | None:
    """Return the number in a cell, which may be infinite or NaN; None if it holds none.

    Python alone would read 1_000 and the digits of other scripts, which no instrument writes.

    >>> number_in(" 1e3 "), number_in("1_000"), number_in("")
    (1000.0, None, None)
    """
    try:
        return float(cell) if cell.strip().isascii() and "_" not in cell else None
    except ValueError:
        return None


def _number(faults: FaultList, where: str, cell: str) -> float:
    if cell.lower() in NO_VALUE:
        rule = "has no value" if cell else "is empty"
        faults.add(where, cell, f"{rule}, but this column needs one in each row", "give the value or drop the row")
    elif (number := number_in(cell)) is None:
        faults.add(where, cell, "is not a number", "write one number with a decimal point, or drop the row")
    elif not np.isfinite(number):
        faults.add(where, number, "must be finite", "drop the row or give a value")
    elif abs(number) > LARGEST:
        faults.add(where, number, "is larger than any measurement", "drop the row or give a value")
    else:
        return number
    return np.nan
