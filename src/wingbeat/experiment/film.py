"""A filmed wingbeat: angles and span by phase, what is wrong if they cannot be that, and SYNTHETIC films."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat._base.sheets import write_columns
from wingbeat.animal.kinematics import (
    Wingbeat,
    chord_ratio,
    flap_angle,
    fold_angle,
    pitch_angle,
    span_ratio,
    sweep_angle,
    tip_twist,
)
from wingbeat.experiment.periodic import MIN_BEATS, SURE, Array, Clip, clip_rate, scatter_at

# What can be filmed, and its unit.
FILMED = {"flap_deg": "deg", "pitch_deg": "deg", "span_fraction": "", "sweep_deg": "deg"}
FILMED |= {"tip_pitch_deg": "deg", "stroke_plane_deg": "deg", "area_fraction": "", "fold_deg": "deg"}
# The body, for a film that gives times.
BODY = dict.fromkeys(("body_x_m", "body_z_m"), "m") | dict.fromkeys(("body_pitch_deg",), "deg")
COLUMNS = FILMED | BODY
# What a fraction of 1 stands for.
WHOLE = {"span_fraction": "semi-span", "area_fraction": "full area"}
# Angles that a tracker may give anywhere on the circle.
WRAPPED = ("pitch_deg", "tip_pitch_deg", "stroke_plane_deg", "body_pitch_deg")
_FEWEST = 8
# Longest share of the beat without a frame; in a longer gap, cosine and sine are undetermined.
_WIDEST_GAP = 0.35
# Angles of a wing in radians lie below this number [rad].
_LARGEST_RADIANS = 3.2
# A tracker sees all angles of a wing about equally well. In radians, an angle's scatter is 57 times smaller than in
# degrees: below this share of the flap's, or below this number of degrees. The body is tracked better than a wing.
_QUIET_SHARE, _QUIET_DEG = 0.2, 0.06
# Correlation of ranks above which an angle only rises or only falls.
_ONE_WAY = 0.95
# Phases in another unit: how many of them are a beat.
_PHASE_UNITS = {"degrees": 360.0, "per cent of a beat": 100.0, "radians": 2 * math.pi}
# A rate of phases that differs from one beat a beat by less than this is right.
_PHASE_ERROR = 0.03
# Every flying animal spreads its wings to more than this share in some part of the beat.
_SPREAD = 0.7


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
        `stroke_plane_angle`), ``area_fraction`` (of the full area) and ``fold_deg`` (of the hand below the arm),
        shape (n,) each; NaN in frames where the quantity was not seen. Pitch and stroke plane may
        jump by whole turns. For the body: ``body_x_m`` (forward), ``body_z_m`` (up) and ``body_pitch_deg`` (nose
        up).
    frequency, frequency_se : wingbeat frequency, None if not known, and its standard error [Hz].
    synthetic : whether a random generator made the film.
    fitted : whether the frequency is that of the frames themselves.
    stated : the frequency that the film's file states, None if it states none [Hz].
    read_notes, read_warnings : what the reader of the file found, see `notes` and `warnings`.
    wrist : where the hand folds, as a fraction of the span; None if not filmed.
    semi_span : shoulder to tip of the spread wing [m]; None if not measured. It is compared with the species'.

    Attributes
    ----------
    clip : beats and rate of the frames themselves, in beats per beat of `phase`; None if they show no beat.
    notes : all notes for the reader, warnings included.
    warnings : those notes that may change the answer.

    Raises
    ------
    InvalidInputError : fewer than 8 frames, a phase that is not finite, no frame in a third of the beat, tip pitch
        without root pitch; phases of two beats or more whose frames repeat at another rate; a flap angle that only
        rises or falls, or that is in radians; fractions of a span that are lengths or per cent.
    """

    name: str
    phase: NDArray[np.float64]
    columns: dict[str, NDArray[np.float64]]
    frequency: float | None = None
    frequency_se: float = 0.0
    synthetic: bool = False
    fitted: bool = False
    stated: float | None = None
    read_notes: tuple[str, ...] = ()
    read_warnings: tuple[str, ...] = ()
    wrist: float | None = None
    semi_span: float | None = None
    clip: Clip | None = field(default=None, init=False)
    notes: tuple[str, ...] = field(default=(), init=False)
    warnings: tuple[str, ...] = field(default=(), init=False)

    def __post_init__(self) -> None:
        faults = FaultList()
        if self.frequency is not None:
            faults.number(f"{self.name}, frequency", self.frequency, above=0, unit="Hz")
        faults.number(f"{self.name}, frequency_se", self.frequency_se, at_least=0, unit="Hz")
        if self.wrist is not None:
            fix = "a fraction of the span, from the shoulder"
            faults.number(f"{self.name}, wrist", self.wrist, above=0, below=1, fix=fix)
        if self.semi_span is not None:
            faults.number(f"{self.name}, semi_span", self.semi_span, above=0, unit="m")
        if not set(self.columns) & set(FILMED) or set(self.columns) - set(COLUMNS):
            shown = ", ".join(self.columns) or "nothing"
            faults.add(f"{self.name}, columns", shown, "cannot be filmed", f"any of {', '.join(COLUMNS)}")
        if set(self.columns) & set(BODY) and self.frequency is None:
            rule = "is needed: velocities of the body need times, not only phases"
            faults.add(f"{self.name}, frequency", None, rule, "give it in Hz")
        faults.first(
            f"{self.name}, phase", self.phase, ~np.isfinite(self.phase), "must be finite", "drop the frame"
        )
        if "tip_pitch_deg" in self.columns and "pitch_deg" not in self.columns:
            rule = "needs pitch_deg: the twist is the pitch at the tip minus the pitch at the root"
            faults.add(f"{self.name}, columns", "tip_pitch_deg", rule, "add the column pitch_deg")
        faults.raise_if_any()
        object.__setattr__(self, "columns", dict(self.columns))
        for name, column in self.columns.items():
            where = f"{self.name}, column {name}"
            if column.shape != self.phase.shape:
                faults.add(where, f"shape {column.shape}", f"must be {self.phase.shape}, as phase")
            elif (count := int(np.isfinite(column).sum())) < _FEWEST:
                rule = f"must be seen in at least {_FEWEST} frames"
                faults.add(where, f"{count} frames", rule, "film more frames")
            elif name == "flap_deg":
                check_flap(faults, where, *self.seen(name))
        faults.raise_if_any()
        self._check_clock()
        notes = [note for name in self.columns for note in self._check(name, faults)]
        faults.raise_if_any()
        warnings = [*self.read_warnings, *self._suspicions()]
        if self.synthetic:
            notes.insert(0, f"{self.name} is synthetic: made by a random generator, not filmed")
        object.__setattr__(self, "notes", (*notes, *self.read_notes, *warnings))
        object.__setattr__(self, "warnings", tuple(warnings))

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

    def _check_clock(self) -> None:
        """Compare the beats of the frames with those of the phases; phases within one beat say nothing about it."""
        order = np.argsort(self.phase, kind="stable")
        clock = self.phase[order]
        clip = clip_rate(clock, {name: self.columns[name][order] for name in FILMED if name in self.columns})
        if clip is None or not clip.clear or clock[-1] - clock[0] < MIN_BEATS:
            return
        object.__setattr__(self, "clip", clip)
        loose = max(_PHASE_ERROR, SURE * clip.rate_se, 0.5 * abs(clip.change))
        if abs(clip.rate - 1.0) <= loose or even_only(clip.rate, self.columns):
            return
        unit = [name for name, turn in _PHASE_UNITS.items() if abs(clip.rate * turn - 1.0) < 0.15]
        if not unit and np.array_equal(clock, np.round(clock)):
            unit = ["numbers of frames"]
        every = f"{1 / clip.rate:.4g}"
        rule = f"the frames repeat every {every} of phase, but a phase counts beats"
        fix = f"the phases seem to be {unit[0]}; divide them by {every}" if unit else "correct the phases"
        raise InvalidInputError([Fault(f"{self.name}, phase", f"{clock[0]:g} to {clock[-1]:g}", rule, fix)])

    def _check(self, name: str, faults: FaultList) -> list[str]:
        where = f"{self.name}, column {name}"
        phase, values = self.seen(name)
        place = np.sort(phase % 1.0)
        gaps = np.diff(np.append(place, place[0] + 1.0))
        if gaps.max() > _WIDEST_GAP:
            start = place[gaps.argmax()]
            rule = f"has no frame from phase {start:.2f} to {(start + gaps.max()) % 1.0:.2f}"
            faults.add(where, f"{len(values)} frames", rule, "are the phases in beats, and the frequency in Hz?")
        notes = []
        if name in WRAPPED:
            there, column = np.isfinite(self.columns[name]), self.columns[name].astype(float)
            column[there], moved = unwrapped(faults, where, phase, column[there])
            if moved:
                self.columns[name] = column
                why = "were moved by whole turns, because the angle jumps by 360 deg"
                notes.append(f"{where}: {moved} of {len(phase)} frames {why}")
        largest = float(np.abs(values).max())
        if FILMED.get(name) == "deg" and name not in WRAPPED and largest > 180:
            faults.add(where, largest, "must lie between -180 and 180 degrees", "wrap the angle")
        if name in WHOLE and (values.min() <= 0 or values.max() > 2):
            worst = float(values.min() if values.min() <= 0 else values.max())
            rule = f"is not a fraction of the {WHOLE[name]}"
            fix = f"divide by the {WHOLE[name]} in the same unit"
            if worst > 2:
                looks = "per cent" if 60 < worst <= 130 and values.min() > 10 else "a length or an area"
                fix = f"the numbers seem to be {looks}; {'divide by 100' if looks == 'per cent' else fix}"
            faults.add(where, worst, rule, fix)
        return notes

    def _suspicions(self) -> list[str]:
        """Return warnings of a frequency that drifts, of angles in radians, and of spans in metres."""
        found = []
        if self.clip is not None and self.clip.drifts:
            first, last = (end * (self.frequency or 1.0) for end in self.clip.ends)
            unit = "Hz" if self.frequency else "beats per beat of phase"
            found.append(
                f"{self.name}: the frequency {'falls' if last < first else 'rises'} from {first:.3g} to {last:.3g} "
                f"{unit} within the clip; the fit is one mean wingbeat: choose beats that are alike"
            )
        quiet = _QUIET_DEG
        if "flap_deg" in self.columns:
            quiet = max(quiet, _QUIET_SHARE * scatter_at(*self.seen("flap_deg"), 1.0))
        for name in self.columns:
            where, (phase, values) = f"{self.name}, column {name}", self.seen(name)
            largest = float(np.abs(values).max())
            limit = _QUIET_DEG if name in BODY else quiet
            small = COLUMNS[name] == "deg" and name != "flap_deg" and 0 < largest < _LARGEST_RADIANS
            small = small and np.ptp(values) > 0  # a constant was set, not tracked
            scatter = scatter_at(phase, values, 1.0) if small else math.inf
            if scatter < min(limit, 0.5 * float(np.sqrt(np.mean(values**2)))):
                found.append(
                    f"{where}: no angle exceeds {largest:.2g} degrees, and they scatter far less than tracked "
                    "angles do; if these are radians, multiply them by 57.29578"
                )
            if name in WHOLE and (most := float(np.quantile(values, 0.9))) < _SPREAD:
                found.append(
                    f"{where}: the wing never spreads to more than {most:.2g} of the {WHOLE[name]}; if these are "
                    "lengths or areas, divide them by it"
                )
        return found

    def save(self, path: str | Path) -> None:
        """Write the film as a CSV file that `read_film` reads, with phases; with times if it shows the body's path.

        Parameters
        ----------
        path : of the file to write.

        Raises
        ------
        FileError : the file cannot be written.
        """
        clock, order = {"phase": self.phase}, np.arange(len(self.phase))
        if self.shows_body and self.frequency is not None:  # the path of a body needs times, which rise
            clock, order = {"time [s]": self.phase / self.frequency}, np.argsort(self.phase, kind="stable")
        columns = {name: column[order] for name, column in (clock | self.columns).items()}
        write_columns(path, constant_lines(self), columns)


def constant_lines(film: Film) -> list[str]:
    """Return the lines ``# name = value`` that a film's file has above its table."""
    lines, said = [], "yes, made by wingbeat's random generator from a known wingbeat, not filmed"
    if film.synthetic:
        lines.append(f"# synthetic = {said}")
    numbers = {"wrist": film.wrist, "semi_span [m]": film.semi_span}
    if film.frequency is not None:
        numbers = {"frequency [Hz]": film.frequency, "frequency_se [Hz]": film.frequency_se} | numbers
    # As Python's float, for NumPy's would be written "np.float64(6.1)".
    return lines + [f"# {name} = {float(value)!r}" for name, value in numbers.items() if value is not None]


def check_flap(faults: FaultList, where: str, clock: Array, flap: Array) -> None:
    """Note a flap angle in radians, and one that does not go up and down."""
    largest = float(np.abs(flap).max(initial=0.0))
    if 0 < largest < _LARGEST_RADIANS:
        rule = "is the largest flap angle: these seem to be radians, not degrees"
        faults.add(where, largest, rule, "multiply them by 57.29578")
    elif way := _one_way(flap[np.argsort(clock, kind="stable")]):
        rule = f"{way} from frame to frame and never turns back"
        looks = "it seems to be a phase, a time or an unwrapped angle"
        faults.add(where, f"{len(flap)} frames", f"{rule}: {looks}", "give the flap angle, up positive")


def even_only(rate: float, columns: Mapping[str, Any]) -> bool:
    """Return whether columns repeat twice a beat as a span or a sweep may do, but a flap angle cannot."""
    return "flap_deg" not in columns and abs(rate - 2.0) < 2 * _PHASE_ERROR


def _one_way(values: Array) -> str:
    """Return "rises" or "falls" if a series does so all the time, but for jumps back; "" if it turns."""
    jumps = np.flatnonzero(np.abs(np.diff(values)) > 0.5 * max(float(np.ptp(values)), 1e-9)) + 1
    parts = [part for part in np.split(values, jumps) if len(part) > 5 and np.ptp(part) > 0]
    if not parts:
        return ""
    ranks = [np.argsort(np.argsort(part, kind="stable")) for part in parts]
    ways = [np.corrcoef(np.arange(len(rank)), rank)[0, 1] for rank in ranks]
    way = float(np.average(ways, weights=[len(part) for part in parts]))
    return "" if abs(way) < _ONE_WAY else "rises" if way > 0 else "falls"


def unwrapped(faults: FaultList, where: str, phase: Array, angle: Array) -> tuple[Array, int]:
    """Return an angle without jumps over the beat [deg], and the number of frames moved by whole turns.

    In the order of phase within the beat, each frame is moved by whole turns until it lies within half a turn of
    the frame before. Then all frames are moved together, so that their mean lies within half a turn of 0. A frame
    that is not moved keeps every digit.
    """
    order = np.argsort(phase % 1.0, kind="stable")
    smooth = np.empty_like(angle)
    smooth[order] = np.unwrap(angle[order], period=360.0)
    smooth -= 360.0 * np.round(smooth.mean() / 360.0)
    first, last = smooth[order[0]], smooth[order[-1]]
    if abs(first - last) > 180.0:
        rule = f"turns from {first:.4g} to {last:.4g} degrees in one beat and does not come back"
        faults.add(where, f"{len(angle)} frames", rule, "film more frames, or drop those where the tracker slipped")
    return smooth, int(np.count_nonzero(np.abs(smooth - angle) > 1.0))


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
    sweep, twist, chord = (law(wingbeat, at) for law in (sweep_angle, tip_twist, chord_ratio))
    root, span = np.asarray(pitch_angle(wingbeat, at)), np.asarray(span_ratio(wingbeat, at))
    true = {
        "flap_deg": flap_angle(wingbeat, at),
        "pitch_deg": root,
        "span_fraction": span,
        "sweep_deg": 0.0 if sweep is None else sweep,
        "tip_pitch_deg": wingbeat.twist_ratio * root + (0.0 if twist is None else twist),
        "stroke_plane_deg": stroke_plane + wingbeat.stroke_plane_tilt,
        "area_fraction": span * (1.0 if chord is None else np.asarray(chord)),
        "fold_deg": fold_angle(wingbeat, at),
    }
    seen = {}
    for name in columns:
        angle = FILMED[name] == "deg"
        noise = random.normal(scale=noise_deg if angle else 0.01 * noise_deg, size=frames)
        seen[name] = (np.degrees(np.asarray(true[name])) if angle else true[name]) + noise
    return Film("film of a known wingbeat", phase, seen, float(wingbeat.frequency), synthetic=True)
