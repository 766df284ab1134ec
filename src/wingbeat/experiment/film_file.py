"""The CSV file of a filmed wingbeat: its columns and constants, its clock, and the two sides of the animal."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from decimal import Decimal
from pathlib import Path
from typing import NamedTuple

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError, plain_unit, written
from wingbeat._base.sheets import (
    SIDE_WORDS,
    SIDES,
    Sheet,
    check_unit,
    number_in,
    parse_numbers,
    read_sheet,
    same_name,
    split_unit,
)
from wingbeat.experiment.film import BODY, COLUMNS, FILMED, WRAPPED, Film, check_flap, even_only
from wingbeat.experiment.periodic import MIN_BEATS, SURE, Array, Clip, clip_rate

# 100 s at 1000 frames a second: no animal repeats one wingbeat for longer. The fit of so many takes a second.
MAX_FRAMES = 100_000
_CLOCKS = {"phase": "", "time": "s", "frame": ""}
_CONSTANTS = {
    "frequency": "Hz",
    "frequency_se": "Hz",
    "frame_rate": "Hz",
    "wrist": "",
    "semi_span": plain_unit("semi_span"),
}
_SPELLINGS = {
    **{same_name(name): name for name in (*_CLOCKS, *COLUMNS, *_CONSTANTS)},
    **dict.fromkeys(("frames", "framenumber", "frameno", "frameindex", "fnum"), "frame"),
    **dict.fromkeys(("fps", "framespersecond", "samplerate", "samplingrate"), "frame_rate"),
}
# A header's frequency that differs by less than this share from the clip's own may be the mean of more beats: the
# periods of one animal scatter by about 3 %. More than the second share is wrong even if the header has few digits.
_ROUNDED, _COARSE = 0.03, 0.05
# What the times seem to be if the clip beats so many times too slowly.
_TIME_UNITS = {"milliseconds": 1e3, "microseconds": 1e6, "minutes": 1 / 60}
# Beats slower than this one are those of times in milliseconds or frames [Hz].
_SLOWEST = 0.05
# No camera takes frames closer together [s].
_SHORTEST_STEP = 1e-9
# Difference of the two sides that no tracking error explains [deg, or hundredths of a fraction].
_UNEQUAL = 3.0
# So many frames with both wings give their mean difference.
_FEWEST_PAIRS = 8


class _Given(NamedTuple):
    """A constant of the file: its number, its text, and where it is."""

    value: float
    text: str
    where: str


def read_film(path: str | Path, side: str = "both") -> Film:
    """Read a filmed wingbeat from CSV.

    One column is phase (in beats), time [s], or frame (a number, which needs a line ``# frame rate [Hz] = 240``).
    Times and frames need a line ``# frequency [Hz] = 6.1`` above the table if the clip has fewer than two beats. A
    longer clip determines its frequency; one that disagrees is refused. A line ``# wrist = 0.5`` says where the
    hand folds, as a fraction of the span; a line ``# semi_span [m] = 0.31``, how long the spread wing is. The
    other columns are any of those of `Film`, each for both wings together or for one wing: ``left_flap_deg``,
    ``right_flap_deg``; unknown columns are refused. A cell is empty, NaN or NA where the wing was not seen.

    Parameters
    ----------
    path : of the CSV file.
    side : of columns for the left and the right wing, "left", "right", or "both" for the mean of the two. Where
        only one wing was seen, half the mean difference of the two is added or subtracted.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : missing or unknown columns, other units, cells that are not numbers, times that do not rise,
        a frequency that is not that of the frames, more than 100 000 frames, and inputs that `Film` refuses, each
        fault with its row and column.
    """
    faults = FaultList()
    faults.choice("side", side, SIDES)
    faults.raise_if_any()
    sheet = read_sheet(path)
    sides = _columns(faults, sheet)
    given = _constants(faults, sheet)
    if len(sheet.rows) > MAX_FRAMES:
        where = f"{sheet.file} row {sheet.rows[MAX_FRAMES][0]}"
        rule = f"has more than {MAX_FRAMES} rows, 100 s at 1000 frames a second"
        why = "no animal repeats a beat for longer"
        faults.add(where, f"{len(sheet.rows)} frames", f"{rule}; {why}", "cut the clip")
    clocks = [name for _, name in sides if name in _CLOCKS]
    if set(name for _, name in sides) & set(BODY) and clocks == ["phase"]:
        rule = "has the path of a body but no times"
        faults.add(f"{sheet.file} row {sheet.header_row}", ",".join(sheet.header), rule, "give time [s], not phase")
    if clocks == ["frame"] and "frame_rate" not in given:
        fix = "add the line '# frame rate [Hz] = 240' above the table, with the frames per second of your film"
        faults.add(f"{sheet.file}, frame rate", "", "is missing: the rows count frames", fix)
    unread = len(faults.faults)
    names = ["" if not name else split_unit(cell).name for (_, name), cell in zip(sides, sheet.header, strict=True)]
    blank = frozenset(cell for cell, (_, name) in zip(names, sides, strict=True) if name not in _CLOCKS)
    numbers = np.empty((0, len(names)))
    if len(sheet.rows) <= MAX_FRAMES:
        numbers = parse_numbers(faults, sheet, names, blank=blank)
    if len(clocks) != 1 or unread or faults.faults or not len(numbers):
        if not len(sheet.rows):
            faults.add(f"{sheet.file} row {sheet.header_row}", "", "has no row of numbers", "add the frames")
        faults.raise_if_any()
    seen = {key: numbers[:, k].copy() for k, key in enumerate(sides)}
    columns, notes, warnings = joined(faults, sheet.file, seen, side)
    if "flap_deg" in columns:
        there = np.isfinite(columns["flap_deg"])
        where, at = f"{sheet.file}, column flap_deg", seen["", clocks[0]]
        check_flap(faults, where, at[there], columns["flap_deg"][there])
    faults.raise_if_any()
    phase, rate, rate_se, fitted = _clock(sheet, given, clocks[0], seen["", clocks[0]], columns)
    synthetic = any(same_name(key) == "synthetic" for key in sheet.constants)
    stated = given["frequency"].value if "frequency" in given else None
    notes = (*sheet.notes, *notes)
    wrist, span = (given[name].value if name in given else None for name in ("wrist", "semi_span"))
    return Film(sheet.file, phase, columns, rate, rate_se, synthetic, fitted, stated, notes, warnings, wrist, span)


def _columns(faults: FaultList, sheet: Sheet) -> list[tuple[str, str]]:
    """Return side ("" for both) and name of each column; ("", "") for an unnamed one, such as an index."""
    found: list[tuple[str, str]] = []
    units = _CLOCKS | COLUMNS
    for k, cell in enumerate(sheet.header):
        where = f"{sheet.file} row {sheet.header_row}, column {k + 1}"
        name, unit = split_unit(cell)
        words = re.split(r"[\s_]+", name)
        side = next((SIDE_WORDS[word.lower()] for word in words if word.lower() in SIDE_WORDS), "")
        plain = same_name("".join(word for word in words if word.lower() not in SIDE_WORDS))
        if unit in ("deg", "degrees", "°") and plain + "deg" in _SPELLINGS:
            plain += "deg"  # "flap [deg]"
        known = _SPELLINGS.get(plain, "")
        if not name:
            known = side = ""
        elif known not in units or (side and known not in FILMED):
            angle = plain.startswith(("flap", "pitch", "sweep", "tip", "stroke", "bodypitch"))
            fix = "write degrees, with a name such as flap_deg" if angle else f"known are {', '.join(units)}"
            faults.add(where, cell, "is not a known column", fix)
        elif (side, known) in found:
            faults.add(where, cell, "appears twice", "keep one")
        else:
            check_unit(faults, where, unit, units[known])
        found.append((side, known))
    if {("", "time"), ("", "phase")} & set(found):
        found = [("", "") if name == "frame" else (side, name) for side, name in found]
    where, header = f"{sheet.file} row {sheet.header_row}", ",".join(sheet.header)
    names = [name for _, name in found]
    if sum(name in _CLOCKS for name in names) != 1:
        fix = "phase in beats, time in s, or frame with a line '# frame rate [Hz] = ..'"
        faults.add(where, header, "must name exactly one of phase, time and frame", fix)
    if not set(names) & set(FILMED):
        faults.add(where, header, "has no filmed column", f"any of {', '.join(FILMED)}")
    for name in FILMED:
        if ("", name) in found and {("left", name), ("right", name)} & set(found):
            rule = f"has {name} for both wings together and for one"
            faults.add(where, header, rule, "keep one kind of column")
    return found


def _constants(faults: FaultList, sheet: Sheet) -> dict[str, _Given]:
    found: dict[str, _Given] = {}
    for key, (row, text) in sheet.constants.items():
        name = _SPELLINGS.get(same_name(key), "")
        if name not in _CONSTANTS:
            continue
        where = f"{sheet.file} row {row}, {name.replace('frame_', 'frame ')}"
        unit = _CONSTANTS[name]
        check_unit(faults, where, (split_unit(key).unit or unit).replace("fps", "Hz"), unit)
        if (value := number_in(text)) is None:
            faults.add(where, text, "must be one number", f"in {unit}" if unit else "a fraction of the span")
            continue
        above, at_least = (-math.inf, 0.0) if name == "frequency_se" else (0.0, -math.inf)
        if name == "wrist":
            faults.number(where, value, above=0, below=1, fix="a fraction of the span, from the shoulder")
        else:
            faults.number(where, value, above=above, at_least=at_least, unit=unit)
        if name in found:
            faults.add(where, text, f"is given twice, as {found[name].text} too", "keep one")
        found[name] = _Given(value, text, where)
    return found


def _clock(
    sheet: Sheet, given: Mapping[str, _Given], kind: str, clock: Array, columns: Mapping[str, Array]
) -> tuple[Array, float | None, float, bool]:
    """Return phases, frequency, its error and whether it is fitted; refuse times that contradict the header."""
    header, error, rate = (given.get(name) for name in ("frequency", "frequency_se", "frame_rate"))
    frequency, frequency_se = header.value if header else None, error.value if error else 0.0
    if kind == "phase":
        return clock, frequency, frequency_se, False
    steps = np.diff(clock)
    if not (steps > 0).all():
        k = int(np.argmin(steps > 0)) + 1
        where = f"{sheet.file} row {sheet.rows[k][0]}, column {kind}"
        rule = f"must be above the {kind} before it, {clock[k - 1]:g}"
        fix = "sort the rows, drop repeated ones; put several clips together by phase, not by time"
        raise InvalidInputError([Fault(where, float(clock[k]), rule, fix)])
    step, counts = float(np.median(steps)) if len(steps) else 1.0, bool(np.array_equal(clock, np.round(clock)))
    if step < _SHORTEST_STEP:
        rule = f"is the usual step between two frames, shorter than any camera's, {_SHORTEST_STEP:g} s"
        raise InvalidInputError([Fault(f"{sheet.file}, column {kind}", step, rule, "give the times in seconds")])
    if rate is not None and (kind == "frame" or counts):
        clock, counts = clock / rate.value, False
    elif rate is not None and abs(step * rate.value - 1.0) > 0.02:
        rule = f"does not fit the times, which step by {step:.4g} s: {1 / step:.4g} frames a second"
        raise InvalidInputError([Fault(rate.where, rate.value, rule, "correct the line or the times")])
    filmed = {name: columns[name] for name in FILMED if name in columns}
    clip = clip_rate(clock, filmed) if len(clock) >= _FEWEST_PAIRS else None
    clip = clip if clip is not None and clip.clear else None
    if header is not None and clip is not None:
        _compare(header, frequency_se, clip, float(clock[-1] - clock[0]), counts, columns)
    elif header is None and (clip is None or clip.beats < MIN_BEATS):
        short = "the frames show no beat" if clip is None else f"a clip of {clip.beats:.2g} beats does not show it"
        rule = f"is missing: it converts times to phases, and {short}"
        fix = "add the line '# frequency [Hz] = ...' above the table, or give phases"
        raise InvalidInputError([Fault(f"{sheet.file}, frequency", "", rule, fix)])
    elif header is None and clip is not None:
        frequency = clip.rate
        if counts or frequency < _SLOWEST:
            looks = "be milliseconds: write seconds"
            if counts:
                looks = "count frames: add the line '# frame rate [Hz] = ..'"
            rule = f"is that of the clip, {1 / frequency:.4g} s a beat: the times seem to {looks}"
            raise InvalidInputError([Fault(f"{sheet.file}, frequency", frequency, rule)])
    own = clip is not None and clip.beats >= MIN_BEATS and not even_only(clip.rate / (frequency or 1.0), columns)
    if clip is not None and own and (error is None or clip.rate_se < error.value):
        return clip.rate * clock, clip.rate, clip.rate_se, True
    return clock * (frequency or 0.0), frequency, frequency_se, False


def _compare(
    header: _Given, error: float, clip: Clip, span: float, counts: bool, columns: Mapping[str, Array]
) -> None:
    """Refuse a header's frequency that the frames contradict, with what may have gone wrong."""
    ratio = header.value / clip.rate
    if max(clip.beats, header.value * span) < MIN_BEATS or even_only(1 / ratio, columns) or not ratio < np.inf:
        return
    last_digit = 0.5 * 10.0 ** int(Decimal(header.text).as_tuple().exponent)
    loose = max(_ROUNDED, min(last_digit / clip.rate, _COARSE)) * clip.rate
    loose = max(loose, SURE * clip.rate_se, 0.5 * abs(clip.change), SURE * error)
    if abs(header.value - clip.rate) <= loose:
        return
    own = written(clip.rate, clip.rate_se, "Hz")
    rule = f"the clip itself beats at {own}; the header says {header.text}"
    if counts:
        fix = (
            f"the times seem to count frames, about {ratio:.4g} a second: add the line '# frame rate [Hz] = ..' "
            "with the frames per second of your film"
        )
    elif near := [unit for unit, factor in _TIME_UNITS.items() if abs(ratio / factor - 1) < 0.15]:
        fix = f"the times seem to be {near[0]}: write seconds"
    elif abs(ratio - 2) < 0.1 or abs(ratio - 0.5) < 0.025:
        fix = "a beat is a downstroke and an upstroke: correct the line, or the times if the frame rate is another"
    else:
        fix = "correct the line or the times"
    raise InvalidInputError([Fault(header.where, header.value, rule, fix)])


def joined(
    faults: FaultList, file: str, seen: Mapping[tuple[str, str], Array], side: str
) -> tuple[dict[str, Array], tuple[str, ...], tuple[str, ...]]:
    """Return the columns with the two wings joined, or one of them chosen, with notes and warnings."""
    columns, notes, warnings = {}, [], []
    for name in (name for name in COLUMNS if any(key[1] == name for key in seen)):
        wings = {key: seen[key, name] for key in ("left", "right") if (key, name) in seen}
        if not wings:
            columns[name] = seen["", name]
        elif len(wings) == 1 or side != "both":
            chosen = side if side in wings else next(iter(wings))
            if side not in ("both", chosen):
                faults.add(f"{file}, side", side, f"has no column {side}_{name}", f"give side {chosen} or both")
            columns[name] = wings[chosen]
            notes.append(f"{file}, column {name}: the {chosen} wing's")
        else:
            columns[name] = _mean_wing(faults, f"{file}, column {name}", name, wings, notes, warnings)
    return columns, tuple(notes), tuple(warnings)


def _mean_wing(
    faults: FaultList, where: str, name: str, wings: Mapping[str, Array], notes: list[str], warnings: list[str]
) -> Array:
    """Return the mean of both wings' columns; note their difference, and a right wing with the other sign."""
    left, right = wings["left"], wings["right"]
    if name in WRAPPED:
        right = right + 360.0 * np.round(np.nan_to_num((left - right) / 360.0))
    both = np.isfinite(left) & np.isfinite(right)
    unit, half = COLUMNS[name], 0.0
    if (count := int(both.sum())) >= _FEWEST_PAIRS:
        apart, centre = left[both] - right[both], 0.5 * (left[both] + right[both])
        mean, error = float(apart.mean()), float(apart.std(ddof=1)) / math.sqrt(count)
        turned, half = centre - centre.mean(), 0.5 * mean
        # How much farther one wing swings than the other: the slope of the difference over the mean of the two.
        spread = max(float(turned.std()), 1e-30)
        wider = float((apart - mean) @ turned) / (count * spread)
        opposed = float((left[both] - left[both].mean()) @ (right[both] - right[both].mean()))
        if name == "flap_deg" and opposed < -0.5 * count * left[both].std() * right[both].std():
            rule = "falls where the left wing's rises: it seems to have the other sign"
            faults.add(f"{where}, right", f"{len(right)} frames", rule, "count both flap angles up positive")
        shown = f"left minus right is {written(mean, error, unit)} on average"
        notes.append(f"{where}: the mean of both wings; {shown}")
        least = _UNEQUAL * (1.0 if unit == "deg" else 0.01)
        for what, size in (("on average", mean), ("in amplitude", math.sqrt(2.0) * wider)):
            if abs(size) > max(least, SURE * error):
                warnings.append(
                    f"{where}: the left and the right wing differ by {abs(size):.2g} {unit} {what}, more than "
                    "their noise; wingbeat moves both wings alike: choose a side, or beats of straight flight"
                )
    one = np.where(np.isfinite(left), left - half, right + half)
    return np.where(both, 0.5 * (left + right), one)
