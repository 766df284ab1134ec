"""A filmed wingbeat: angles and span by phase, and its CSV file."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat.errors import FaultList
from wingbeat.experiment.wrapping import unwrapped
from wingbeat.files import write_atomically
from wingbeat.kinematics import (
    Wingbeat,
    chord_ratio,
    flap_angle,
    pitch_angle,
    span_ratio,
    sweep_angle,
    tip_twist,
)
from wingbeat.sheets import Sheet, check_unit, parse_numbers, read_sheet, split_unit

# What can be filmed, and its unit.
FILMED = {
    **{"flap_deg": "deg", "pitch_deg": "deg", "span_fraction": ""},
    **{"sweep_deg": "deg", "tip_pitch_deg": "deg", "stroke_plane_deg": "deg", "area_fraction": ""},
}
# The body, for a film that gives times.
BODY = dict.fromkeys(("body_x_m", "body_z_m"), "m") | dict.fromkeys(("body_pitch_deg",), "deg")
COLUMNS = FILMED | BODY
# What a fraction of 1 stands for.
WHOLE = {"span_fraction": "semi-span", "area_fraction": "full area"}
# Angles that a tracker may give anywhere on the circle.
_WRAPPED = ("pitch_deg", "tip_pitch_deg", "stroke_plane_deg", "body_pitch_deg")
_CLOCKS = {"phase": "", "time": "s"}
_CONSTANTS = {"frequency": "Hz", "frequency_se": "Hz"}
_FEWEST = 8
# Longest share of the beat without a frame; in a longer gap, cosine and sine are undetermined.
_WIDEST_GAP = 0.35


@dataclass(frozen=True)
class Film:
    """Angles and span of a wing, frame by frame, of one wingbeat or several similar ones.

    Parameters
    ----------
    name : for messages, such as the name of its file.
    phase : in beats, from any zero; from the top of the stroke if flap was not filmed, shape (n,).
    columns : any of ``flap_deg`` (wing up), ``pitch_deg`` (at the root, leading edge up, from the stroke plane's
        normal), ``span_fraction`` (of the semi-span), ``sweep_deg`` (span ahead of the stroke plane),
        ``tip_pitch_deg`` (as pitch, at the tip), ``stroke_plane_deg`` (from the body axis, as the species'
        `stroke_plane_angle`) and ``area_fraction`` (of the full area), shape (n,) each; NaN in frames where the
        quantity was not seen. Pitch and stroke plane may jump by whole turns. For the body: ``body_x_m`` (forward),
        ``body_z_m`` (up) and ``body_pitch_deg`` (nose up).
    frequency, frequency_se : wingbeat frequency, None if not known, and its standard error [Hz].
    synthetic : whether a random generator made the film.

    Attributes
    ----------
    notes : notes for the reader.

    Raises
    ------
    InvalidInputError : fewer than 8 frames, a phase that is not finite, no frame in a third of the beat, tip pitch
        without root pitch.
    """

    name: str
    phase: NDArray[np.float64]
    columns: dict[str, NDArray[np.float64]]
    frequency: float | None = None
    frequency_se: float = 0.0
    synthetic: bool = False
    notes: tuple[str, ...] = field(default=(), init=False)

    def __post_init__(self) -> None:
        faults = FaultList()
        if self.frequency is not None:
            faults.number(f"{self.name}, frequency", self.frequency, above=0, unit="Hz")
        faults.number(f"{self.name}, frequency_se", self.frequency_se, at_least=0, unit="Hz")
        if not set(self.columns) & set(FILMED) or set(self.columns) - set(COLUMNS):
            shown = ", ".join(self.columns) or "nothing"
            faults.add(f"{self.name}, columns", shown, "cannot be filmed", f"any of {', '.join(COLUMNS)}")
        if set(self.columns) & set(BODY) and self.frequency is None:
            rule = "is needed: velocities of the body need times, not only phases"
            faults.add(f"{self.name}, frequency", None, rule, "give it in Hz")
        if not np.isfinite(self.phase).all():
            row = int(np.argmin(np.isfinite(self.phase)))
            faults.add(f"{self.name}, phase[{row}]", float(self.phase[row]), "must be finite", "drop the frame")
        if "tip_pitch_deg" in self.columns and "pitch_deg" not in self.columns:
            rule = "needs pitch_deg: the twist is the pitch at the tip minus the pitch at the root"
            faults.add(f"{self.name}, columns", "tip_pitch_deg", rule, "add the column pitch_deg")
        faults.raise_if_any()
        object.__setattr__(self, "columns", dict(self.columns))
        notes = [note for name in self.columns for note in self._check(name, faults)]
        faults.raise_if_any()
        if self.synthetic:
            notes.insert(0, f"{self.name} is synthetic: made by a random generator, not filmed")
        object.__setattr__(self, "notes", tuple(notes))

    @property
    def shows_body(self) -> bool:
        """Whether the film shows the path of the body."""
        return bool(set(self.columns) & set(BODY))

    def seen(self, name: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return phases and values of the frames in which a column was seen.

        Parameters
        ----------
        name : of the column.
        """
        there = np.isfinite(self.columns[name])
        return self.phase[there], self.columns[name][there]

    def _check(self, name: str, faults: FaultList) -> list[str]:
        where, column = f"{self.name}, column {name}", self.columns[name]
        if column.shape != self.phase.shape:
            faults.add(where, f"shape {column.shape}", f"must be {self.phase.shape}, as phase")
            return []
        phase, values = self.seen(name)
        if len(values) < _FEWEST:
            rule = f"must be seen in at least {_FEWEST} frames"
            faults.add(where, f"{len(values)} frames", rule, "film more frames")
            return []
        place = np.sort(phase % 1.0)
        gaps = np.diff(np.append(place, place[0] + 1.0))
        if gaps.max() > _WIDEST_GAP:
            start = place[gaps.argmax()]
            rule = f"has no frame from phase {start:.2f} to {(start + gaps.max()) % 1.0:.2f}"
            faults.add(where, f"{len(values)} frames", rule, "are the phases in beats, and the frequency in Hz?")
        notes = self._unwrap(name, phase, faults) if name in _WRAPPED else []
        largest = float(np.abs(values).max())
        if FILMED.get(name) == "deg" and 0 < largest < 3.0:
            notes.append(
                f"{where}: no angle exceeds {largest:.2g} degrees; if these are radians, multiply them by 57.29578"
            )
        if FILMED.get(name) == "deg" and name not in _WRAPPED and largest > 180:
            faults.add(where, largest, "must lie between -180 and 180 degrees", "wrap the angle")
        if name in WHOLE and (values.min() <= 0 or values.max() > 2):
            worst = float(values.min() if values.min() <= 0 else values.max())
            faults.add(
                where,
                worst,
                f"is not a fraction of the {WHOLE[name]}",
                f"divide it by the {WHOLE[name]}; do not use percent",
            )
        return notes

    def _unwrap(self, name: str, phase: NDArray[np.float64], faults: FaultList) -> list[str]:
        """Remove jumps of whole turns from a column, and return a note if there were any."""
        where, column = f"{self.name}, column {name}", self.columns[name].astype(float)
        there = np.isfinite(column)
        column[there], moved = unwrapped(faults, where, phase, column[there])
        if not moved:
            return []
        self.columns[name] = column
        return [
            f"{where}: {moved} of {len(phase)} frames were moved by whole turns, because the angle jumps by 360 deg"
        ]

    def save(self, path: str | Path) -> None:
        """Write the film as a CSV file that `read_film` reads.

        Parameters
        ----------
        path : of the file to write.

        Raises
        ------
        FileError : the file cannot be written.
        """
        lines = []
        if self.synthetic:
            lines.append("# synthetic = yes, made by wingbeat's random generator from a known wingbeat, not filmed")
        if self.frequency is not None:
            lines += [f"# frequency [Hz] = {self.frequency!r}", f"# frequency_se [Hz] = {self.frequency_se!r}"]
        lines.append(",".join(["phase", *self.columns]))
        for row in zip(self.phase, *self.columns.values(), strict=True):
            lines.append(",".join("" if math.isnan(value) else f"{value:.8g}" for value in row))
        write_atomically(path, "\n".join(lines) + "\n")


def read_film(path: str | Path) -> Film:
    """Read a filmed wingbeat from CSV.

    One column is phase (in beats) or time [s]; time needs a line ``# frequency = 6.1`` [Hz] above the table. The
    other columns are any of those of `Film`; unknown columns are refused. A cell is empty where the wing was not
    seen.

    Parameters
    ----------
    path : of the CSV file.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : missing or unknown columns, other units, cells that are not numbers, and inputs that `Film`
        refuses, each fault with its row and column.
    """
    sheet, faults = read_sheet(path), FaultList()
    names, constants = _names(faults, sheet), _constants(faults, sheet)
    if "time" in names and "frequency" not in constants:
        fix = "add the line '# frequency [Hz] = ...' above the table, or give phases"
        faults.add(f"{sheet.file}, frequency", "", "is missing: it converts times to phases", fix)
    if set(names) & set(BODY) and "time" not in names:
        rule = "has the path of a body but no times"
        faults.add(f"{sheet.file} row {sheet.header_row}", ",".join(sheet.header), rule, "give time [s], not phase")
    numbers = parse_numbers(faults, sheet, names, blank=frozenset(COLUMNS)) if names else np.empty((0, 0))
    faults.raise_if_any()
    by_name = {name: numbers[:, k].copy() for k, name in enumerate(names)}
    frequency = constants.get("frequency")
    phase = by_name["phase"] if "phase" in by_name else by_name["time"] * (frequency or 0.0)
    columns = {name: by_name[name] for name in COLUMNS if name in by_name}
    return Film(
        sheet.file, phase, columns, frequency, constants.get("frequency_se", 0.0), "synthetic" in sheet.constants
    )


def _names(faults: FaultList, sheet: Sheet) -> list[str]:
    names: list[str] = []
    units = _CLOCKS | COLUMNS
    for k, cell in enumerate(sheet.header):
        name, unit = split_unit(cell)
        where = f"{sheet.file} row {sheet.header_row}, column {k + 1}"
        if name not in units:
            angle = name.startswith(("flap", "pitch", "sweep", "tip", "stroke", "body_pitch"))
            fix = "write degrees, with a name such as flap_deg" if angle else f"known are {', '.join(units)}"
            faults.add(where, cell, "is not a known column", fix)
        elif name in names:
            faults.add(where, cell, "appears twice", "keep one")
        else:
            check_unit(faults, where, unit, units[name])
        names.append(name)
    where = f"{sheet.file} row {sheet.header_row}"
    if len(set(names) & set(_CLOCKS)) != 1:
        rule = "must name exactly one of phase and time"
        faults.add(where, ",".join(sheet.header), rule, "phase in beats, time in s")
    if not set(names) & set(FILMED):
        fix = f"any of {', '.join(FILMED)}"
        faults.add(where, ",".join(sheet.header), "has no filmed column", fix)
    return names


def _constants(faults: FaultList, sheet: Sheet) -> dict[str, float]:
    found: dict[str, float] = {}
    for key, (row, text) in sheet.constants.items():
        name, unit = split_unit(key)
        if name not in _CONSTANTS:
            continue
        where = f"{sheet.file} row {row}, {name}"
        check_unit(faults, where, unit, _CONSTANTS[name])
        try:
            value = float(text)
        except ValueError:
            faults.add(where, text, "must be one number", "in Hz")
            continue
        if name == "frequency":
            faults.number(where, value, above=0, unit="Hz")
        else:
            faults.number(where, value, at_least=0, unit="Hz")
        found[name] = value
    return found


def _true(name: str, wingbeat: Wingbeat, phase: NDArray[np.float64], stroke_plane: float) -> Any:
    """Return what a perfect film of a wingbeat shows, in radians or as a fraction."""
    if name == "flap_deg":
        return flap_angle(wingbeat, phase)
    if name == "sweep_deg":
        sweep = sweep_angle(wingbeat, phase)
        return np.zeros_like(phase) if sweep is None else sweep
    if name == "stroke_plane_deg":
        return np.full_like(phase, stroke_plane + wingbeat.stroke_plane_tilt)
    if name in ("pitch_deg", "tip_pitch_deg"):
        root, twist = np.asarray(pitch_angle(wingbeat, phase)), tip_twist(wingbeat, phase)
        return root if name == "pitch_deg" else wingbeat.twist_ratio * root + (0.0 if twist is None else twist)
    chord = chord_ratio(wingbeat, phase) if name == "area_fraction" else None
    return np.asarray(span_ratio(wingbeat, phase)) * (1.0 if chord is None else np.asarray(chord))


def synthetic_film(
    wingbeat: Wingbeat,
    frames: int = 60,
    noise_deg: float = 1.0,
    seed: int = 0,
    columns: tuple[str, ...] = ("flap_deg",),
    start: float = 0.0,
    stroke_plane: float = 0.5 * math.pi,
) -> Film:
    """Return a film of a known wingbeat with white noise, labelled synthetic; the same seed gives the same film.

    Parameters
    ----------
    wingbeat : the wingbeat to film, one period in equal steps.
    frames : number of frames.
    noise_deg : standard deviation of the angles' noise [deg]; that of fractions is a hundredth of this number.
    seed : of the noise.
    columns : the columns that the film shows.
    start : phase of the wingbeat at the film's phase 0; without a column of flap, it has no effect.
    stroke_plane : angle of the vehicle's stroke plane from the body axis [rad]; the wingbeat's tilt adds to it.
    """
    random = np.random.default_rng(seed)
    phase = np.arange(frames) / frames
    at = phase + (start if "flap_deg" in columns else 0.0)
    seen = {}
    for name in columns:
        true = np.asarray(_true(name, wingbeat, at, stroke_plane))
        angle = FILMED[name] == "deg"
        noise = random.normal(scale=noise_deg if angle else 0.01 * noise_deg, size=frames)
        seen[name] = (np.degrees(true) if angle else true) + noise
    return Film("film of a known wingbeat", phase, seen, float(wingbeat.frequency), synthetic=True)
