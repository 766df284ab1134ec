"""From tracked points to a film: flap, pitch, sweep, fold and span of a wing, frame by frame, with errors."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat._base.sheets import SIDES, write_columns
from wingbeat.experiment.film import FILMED, Film, constant_lines
from wingbeat.experiment.film_file import joined
from wingbeat.experiment.film_fit import FilmedBeat, fit_film
from wingbeat.experiment.periodic import MIN_BEATS, Clip, FilmedLaw, clip_rate, fit_law, fourier_columns
from wingbeat.experiment.point_axes import Axes, axis_vector, find_axes
from wingbeat.experiment.point_names import NamedPoints, name_points
from wingbeat.experiment.point_tables import METRES, Array
from wingbeat.experiment.tracked_points import TrackedPoints, read_points
from wingbeat.experiment.wing_points import column_errors, marker_noise, stroke_plane, wing_columns

# Semi-spans of flying animals and robots [m], from a small insect's to an albatross's, and their speeds [m/s].
_SEMI_SPANS, _MOST_SPEED = (0.002, 1.7), 40.0
# Their semi-span times frequency [m/s]: 0.2 of small butterflies, 0.5 of a fruit fly, 5 of an albatross.
_BEATEN = (0.1, 10.0)
# Length of the chord's baseline over its noise below which pitch is left out.
_CHORD_NOISE = 3.0
# Standard error of the pitch's mean or amplitude above which one in eighty is off by two degrees [deg].
_UNSURE_PITCH = 0.8
# A hand that drops by less than this, or by less than so many errors, is not called a fold [deg].
_LEAST_FOLD, _SURE_FOLD = 3.0, 4.0
# A step of the shoulder that differs by more than this share of the usual one, and so many errors, is doubtful.
_JUMP, _SURE_JUMP = 0.6, 3.5
# Frames in a beat below which harmonics of the flap are lost.
_FEW_FRAMES = 8
# A scatter of frames below so many times that of the points' noise is explained by it.
_EXPLAINED = 1.5


@dataclass(frozen=True)
class PointAngles:
    """The angles of a wing from tracked points; made by `angles_from_points`.

    Attributes
    ----------
    film : the angles, frame by frame.
    beat : the periodic laws fitted to the film.
    errors : standard error of a frame of each column, from the noise of the points.
    time : of the frames [s].
    clip : beats and rate of the flap.
    tracked, named, axes : the points, which of them is what, and the directions found.
    wings : points of each wing by side and role, as forward, outward and up from the shoulder, shape (n, 3).
    noise : standard deviation of each point in one coordinate, in the file's unit, by role.
    body_pitch_deg : mean angle of the body axis above the horizontal [deg].
    stroke_plane_deg, stroke_plane_se : angle of the stroke plane from the body axis, and its standard error [deg].
    semi_span : shoulder to tip, largest of the beat [m]; in the file's unit if that is not known.
    unit : "m", "cm", "mm", or None if not known.
    notes : what the reader must know, warnings included.
    warnings : those notes that may change the answer.
    """

    film: Film
    beat: FilmedBeat
    errors: dict[str, Array]
    time: Array
    clip: Clip
    tracked: TrackedPoints
    named: NamedPoints
    axes: Axes
    wings: dict[str, dict[str, Array]]
    noise: dict[str, float]
    body_pitch_deg: float
    stroke_plane_deg: float
    stroke_plane_se: float
    semi_span: float
    unit: str | None
    notes: tuple[str, ...]
    warnings: tuple[str, ...]

    def record(self) -> dict[str, Any]:
        """Return frequency, means and amplitudes with standard errors, residuals, gaps and notes, fit for JSON.

        Means and amplitudes are those of `Wingbeat`: the mean of the fitted law, and its first harmonic.
        """
        film, laws = self.film, self.beat.laws
        found: dict[str, Any] = {"frequency": film.frequency, "frequency_se": film.frequency_se}
        flap = np.radians(laws["flap_deg"].curve(np.arange(64) / 64)[0])
        # An error of the stroke plane turns all frames alike.
        shared = {"pitch_deg": np.cos(flap).mean(), "tip_pitch_deg": np.cos(flap).mean()}
        shared |= {"sweep_deg": abs(np.sin(flap).mean())}
        for name in ("flap_deg", "pitch_deg", "sweep_deg", "fold_deg", "tip_pitch_deg", "span_fraction"):
            if name not in laws:
                if name in ("flap_deg", "pitch_deg", "sweep_deg"):
                    found |= {f"{name.replace('_deg', '')}_{what}_deg": None for what in ("mean", "amplitude")}
                continue
            word, unit = (name.removesuffix("_deg"), "_deg") if name.endswith("_deg") else (name, "")
            mean, amplitude = f"{word}_mean{unit}", f"{word}_amplitude{unit}"
            value, error = first_harmonic(laws[name])
            found |= {mean: float(laws[name].coefficients[0]), amplitude: value}
            common = self.stroke_plane_se * float(shared.get(name, 0.0))
            found |= {f"{mean}_se": math.hypot(math.sqrt(laws[name].covariance[0, 0]), common)}
            found |= {f"{amplitude}_se": error}
        share, share_se = downstroke(laws["flap_deg"])
        found |= {"downstroke_fraction": share, "downstroke_fraction_se": share_se}
        found |= {"stroke_plane_deg": self.stroke_plane_deg, "stroke_plane_deg_se": self.stroke_plane_se}
        metres = METRES.get(self.unit or "", math.nan)
        found["semi_span"] = None if self.unit is None else self.semi_span
        found["speed"] = self.axes.speed * metres if self.unit is not None and self.axes.travels else None
        found["climb_deg"] = math.degrees(self.axes.climb) if self.axes.travels else None
        found["wrist"] = film.wrist
        found["frames"] = len(self.time)
        found["frames_used"] = int(np.isfinite(film.columns["flap_deg"]).sum())
        found["beats"] = self.clip.beats
        found["residuals"] = {name: law.residual_sd for name, law in laws.items()}
        found["frame_errors"] = {name: float(np.nanmedian(error)) for name, error in self.errors.items()}
        found["noise"] = {
            role: noise if self.unit is None else noise * metres for role, noise in self.noise.items()
        }
        gaps = {
            role: ~np.isfinite(self.tracked.positions[name]).all(axis=1) for role, name in self.named.names.items()
        }
        found["gaps"] = {role: int(gap.sum()) for role, gap in gaps.items()}
        found["points"] = dict(self.named.names)
        found["axes"] = {"forward": self.axes.forward.tolist(), "up": self.axes.up.tolist()}
        found["sides"] = sorted(self.axes.sides.values())
        found |= {"unit": self.unit, "kind": self.tracked.kind}
        return found | {"notes": list(self.notes), "warnings": list(self.warnings)}

    def save(self, path: str | Path) -> None:
        """Write the film as a CSV file that `read_film`, ``orbit`` and ``simulate`` read.

        Parameters
        ----------
        path : of the file to write.

        Raises
        ------
        FileError : the file cannot be written.
        """
        lines = [f"# note: {note}" for note in self.notes] + constant_lines(self.film)
        write_columns(path, lines, {"time [s]": self.time, **self.film.columns})


def first_harmonic(law: FilmedLaw) -> tuple[float, float]:
    """Return the amplitude of the first harmonic without what noise adds to it on average, and its error."""
    waves, covariance = law.coefficients[1:3], law.covariance[1:3, 1:3]
    size = math.hypot(*waves)
    along = waves / max(size, 1e-300)
    # The mean of a length with noise e in each of two directions exceeds the true one by e^2/2 over it.
    value = math.sqrt(max(size**2 - 0.5 * float(np.trace(covariance)), 0.0))
    return value, math.sqrt(max(float(along @ covariance @ along), 0.0))


def downstroke(law: FilmedLaw) -> tuple[float, float]:
    """Return the share of the beat from the top of the flap to its bottom, and its standard error."""
    phase, random = np.arange(720) / 720, np.random.default_rng(0)
    draws = random.multivariate_normal(law.coefficients, law.covariance, size=48)
    curves = np.vstack([law.coefficients, draws]) @ fourier_columns(phase).T
    shares = ((curves.argmin(axis=1) - curves.argmax(axis=1)) / 720.0) % 1.0
    return float(shares[0]), float(np.sqrt(np.mean((shares[1:] - shares[0]) ** 2)))


def angles_from_points(
    source: Any,
    points: str | Path | Mapping[str, str] | None = None,
    *,
    frame_rate: float | None = None,
    side: str | None = None,
    up: str | None = None,
    forward: str | None = None,
    units: str | None = None,
    semi_span: float | None = None,
) -> PointAngles:
    """Return the angles of a wing from points that were tracked in three dimensions.

    Angles are relative to the body: its axis is the line from the point rear to the point front where both were
    tracked, and else the path. The stroke plane's normal is that direction of the plane of symmetry in which the
    directions from shoulder to tip vary least. Frames are not smoothed; the periodic laws of `fit_film` are. The
    errors are those of the points' noise, which is their residual about a smoothing spline in time.

    Parameters
    ----------
    source : path of the file, a data set of movement, see `read_points`, or a `TrackedPoints`.
    points : which point is what, see `name_points`; None for usual names such as left_wrist.
    frame_rate : frames per second, if the file does not state it [Hz].
    side : "left", "right" or "both" wings; None for all that are named.
    up, forward : axis of the file, "z" or "-y", or three numbers, "0.1,-0.99,0.05"; None to find it.
    units : "m", "cm" or "mm"; None for the file's, or the only one that suits an animal.
    semi_span : length from shoulder to tip of the spread wing [m]; None for the largest of the beat.

    Raises
    ------
    FileError : a file that cannot be read.
    InvalidInputError : what is missing or contradicts itself, with the flag that helps.

    >>> import wingbeat as wb
    >>> from wingbeat.experiment.tracked_points import TrackedPoints
    >>> time = np.arange(90) / 240
    >>> flap, one = np.radians(5 + 40 * np.cos(2 * np.pi * 8.2 * time)), np.ones(90)
    >>> wing = 0.3 * np.stack([0 * one, np.cos(flap), np.sin(flap)], axis=1)
    >>> body = np.stack([6 * time, 0.03 * one, one], axis=1)
    >>> at = {"shoulder": body, "tip": body + wing}
    >>> found = angles_from_points(TrackedPoints("a wing", "made", at, time, time))
    >>> told = found.record()
    >>> round(told["frequency"], 2), round(told["flap_mean_deg"], 2), round(told["flap_amplitude_deg"], 2)
    (8.2, 5.0, 40.0)
    """
    faults = FaultList()
    if side is not None:
        faults.choice("--side", side, SIDES)
    given_up, given_forward = axis_vector(faults, "--up", up), axis_vector(faults, "--forward", forward)
    if units is not None:
        faults.choice("--units", units, tuple(METRES))
    if frame_rate is not None:
        faults.number("--frame-rate", frame_rate, above=0, at_most=1e6, unit="Hz")
    if semi_span is not None:
        faults.number("--semi-span", semi_span, above=0, at_most=100, unit="m")
    faults.raise_if_any()
    tracked = source if isinstance(source, TrackedPoints) else read_points(source)
    file, notes, warnings = tracked.name, [*tracked.notes], [*tracked.warnings]
    named = name_points(tracked, points, side)
    notes += named.notes
    time, told = _clock(tracked, frame_rate)
    warnings += told
    axes = find_axes(tracked, named, time, side, given_up, given_forward)
    notes += axes.notes
    warnings += axes.warnings

    def placed(at: Array, one: str) -> Array:
        return np.stack([at @ axes.forward, at @ axes.outward[one], at @ axes.up], axis=1)

    wings = {one: {role: placed(at, one) for role, at in wing.items()} for one, wing in named.wings.items()}
    first = next(iter(wings))
    pitch, filmed_pitch = np.full(len(time), axes.climb), None
    body = {role: placed(at, first) for role, at in named.body.items()}
    if {"front", "rear"} <= set(body):
        x, _, z = (body["front"] - body["rear"]).T
        filmed_pitch = np.arctan2(z, x)
        pitch = np.full(len(time), np.nanmean(filmed_pitch))
    elif axes.travels:
        notes.append(f"{file}: no points front and rear, so the body axis is taken to lie along the path")
    rough = wing_columns(wings[first], pitch, np.array([1.0, 0.0]), False)["flap_deg"]
    clip = clip_rate(time, {"flap_deg": rough})
    if clip is None or not clip.clear or clip.beats < MIN_BEATS:
        short = "show no beat" if clip is None or not clip.clear else f"are {clip.beats:.2g} beats"
        rule = f"{short}: two beats that are alike are needed"
        fix = "track a longer clip of steady flight; are the points and the frame rate right?"
        raise InvalidInputError([Fault(f"{file}, frames", len(time), rule, fix)])
    if (few := 1 / (clip.rate * float(np.median(np.diff(time))))) < _FEW_FRAMES:
        warnings.append(f"{file}: only {few:.2g} frames in a beat; harmonics of the angles are lost or mistaken")
    if filmed_pitch is not None:
        law = fit_law(clip.rate * time[np.isfinite(filmed_pitch)], filmed_pitch[np.isfinite(filmed_pitch)])
        pitch = law.curve(clip.rate * time)[0]
        notes.append(
            f"{file}: the body axis runs from rear to front, pitched by {np.degrees(pitch).mean():.3g} deg"
        )
    normal, plane, plane_se = stroke_plane(wings, pitch)
    if plane_se > 2.0:
        warnings.append(f"{file}: the stroke plane, at {plane:.3g} deg, is uncertain by {plane_se:.2g} deg")
    elif abs(plane - 90.0) < 2.0 * plane_se:
        notes.append(
            f"{file}: the stroke plane is at right angles to the body axis within its error, {plane_se:.2g} deg"
        )
    every = {one: wing_columns(wing, pitch, normal, False) for one, wing in wings.items()}
    fold = _folds(file, every, clip.rate * time, notes)
    if fold:
        every = {one: wing_columns(wing, pitch, normal, True) for one, wing in wings.items()}
    noise = {}
    for one, wing in named.wings.items():
        noise |= {"_".join(filter(None, (one, role))): marker_noise(time, at) for role, at in wing.items()}
    if axes.travels:
        # A row that is missing, repeated or out of place shows in the even path of the shoulder.
        way = wings[first]["shoulder"][:, 0]
        steps = np.diff(way) / np.diff(time) / np.nanmedian(np.diff(way) / np.diff(time)) - 1.0
        doubt = noise["_".join(filter(None, (first, "shoulder")))] * math.sqrt(2.0)
        doubt /= abs(float(np.nanmedian(np.diff(way))))
        jumps = np.flatnonzero(np.abs(np.nan_to_num(steps)) > max(_JUMP, _SURE_JUMP * doubt))
        if len(jumps):
            warnings.append(
                f"{file}: between frames {jumps[0] + 1} and {jumps[0] + 2} the shoulder moves by "
                f"{steps[jumps[0]] + 1:.2g} times the usual step: is a row missing, repeated or out of place?"
            )
    spread = {one: column_errors(wing, pitch, normal, fold, one, noise) for one, wing in wings.items()}
    for one, found in every.items():
        where = f"{file}, {one} wing" if one else file
        if "pitch_deg" not in found:
            if one == first:
                notes.append(f"{where}: no wrist, leading or trailing point, so there is no pitch")
            continue
        if np.nanmean(np.cos(np.radians(found["pitch_deg"]))) < 0:
            rule = "points backward: the leading point lies behind the trailing point or the line of the wing"
            fix = "are two names exchanged, or is --forward the other way?"
            raise InvalidInputError([Fault(f"{where}, chord", "", rule, fix)])
        size, doubt = float(np.nanmedian(found["chord"])), float(np.nanmedian(spread[one]["chord"]))
        if size < _CHORD_NOISE * doubt:
            share = size / float(np.nanmedian(found["span"]))
            warnings.append(
                f"{where}: the chord's points are only {share:.2g} of the wing apart, {size / doubt:.2g} times "
                "their noise: pitch is left out; track a point at the trailing edge"
            )
            for name in ("pitch_deg", "tip_pitch_deg"):
                found.pop(name, None)
    wingspan = float(np.mean([_largest(found["span"], clip.rate * time) for found in every.values()]))
    unit, said, sure = _unit(tracked, units, wingspan, axes.speed, clip.rate)
    (notes if sure else warnings).append(said)
    metres = METRES.get(unit or "", math.nan)
    if semi_span is not None and unit is None:
        raise InvalidInputError([Fault("--semi-span", semi_span, "needs the unit of the points", "give --units")])
    full = wingspan if semi_span is None else semi_span / metres
    for columns in (*every.values(), *spread.values()):
        columns["span_fraction"] = columns["span"] / full
    if semi_span is None:
        shown = f"{wingspan * metres:.4g} m" if unit else f"{wingspan:.4g} in the file's unit"
        notes.append(f"{file}: the full span is the beat's largest, {shown}; --semi-span replaces it")
    names = [name for name in FILMED if all(name in found for found in every.values())]
    names = [name for name in names if fold or name != "fold_deg"]
    for one, found in every.items():
        if lost := [name for name in FILMED if name in found and name not in names and name != "fold_deg"]:
            notes.append(f"{file}, {one} wing: {', '.join(lost)} is left out, because the other wing has none")
    sided = {(one, name): found[name] for one, found in every.items() for name in names}
    columns, more, doubts = joined(faults, file, sided, "both")
    faults.raise_if_any()
    notes += [note for note in more if len(wings) > 1]
    warnings += doubts
    errors = {
        name: np.sqrt(np.mean([found[name] ** 2 for found in spread.values()], axis=0) / len(spread))
        for name in names
    }
    columns["stroke_plane_deg"] = np.full(len(time), round(plane, 4))
    if axes.travels and unit is not None:
        middle = np.mean([wing["shoulder"] for wing in wings.values()], axis=0)
        if filmed_pitch is not None:
            middle = 0.5 * (body["front"] + body["rear"])
        start = middle[np.isfinite(middle).all(axis=1)][0]
        columns["body_x_m"], columns["body_z_m"] = ((middle - start)[:, k] * metres for k in (0, 2))
        columns["body_pitch_deg"] = np.degrees(pitch if filmed_pitch is None else filmed_pitch)
        what = "between front and rear" if filmed_pitch is not None else "at the shoulders"
        notes.append(f"{file}: the body's path is that of the point {what}, not of the centre of mass")
    elif not axes.travels:
        notes.append(f"{file}: the animal travels less than a wing's length, so the film has no path of the body")
    wrists = [found["wrist"] for found in every.values() if "wrist" in found]
    film = Film(
        file, clip.rate * time, columns, clip.rate, clip.rate_se, False, True, None, tuple(notes), tuple(warnings),
        float(np.nanmean(wrists)) if len(wrists) == len(every) else None, full * metres if unit else None,
    )  # fmt: skip
    beat = fit_film(film)
    # Scatter that the noise of the points explains is no sign of beats that differ.
    sizes = {name: float(np.sqrt(np.nanmean(errors[name] ** 2))) for name in names}
    plain = [name for name in names if beat.laws[name].residual_sd < _EXPLAINED * sizes[name]]
    explained = {beat.misfits[name, "scattered"] for name in plain if (name, "scattered") in beat.misfits}
    calm = [one for one in beat.notes if one not in explained]
    if explained:
        calm.append(f"{file}: the scatter of {', '.join(plain)} is that of the points' noise")
    doubtful = [one for one in beat.warnings if one not in explained]
    if (pitched := beat.laws.get("pitch_deg")) is not None:
        doubt = max(math.sqrt(pitched.covariance[0, 0]), first_harmonic(pitched)[1])
        if doubt > _UNSURE_PITCH:
            fix = "a longer clip" if "trailing" in wings[first] else "a point at the trailing edge"
            calm.append(f"{file}: pitch is uncertain by {doubt:.2g} deg; track {fix}")
            doubtful.append(calm[-1])
    return PointAngles(
        film, beat, errors, time, clip, tracked, named, axes, wings, noise, float(np.degrees(pitch).mean()),
        plane, plane_se, full * (metres if unit else 1.0), unit, tuple(calm), tuple(doubtful),
    )  # fmt: skip


def _clock(tracked: TrackedPoints, given: float | None) -> tuple[Array, list[str]]:
    """Return the times of the frames [s], from 0, and warnings; refuse a clip without a clock."""
    file, frames = tracked.name, tracked.frames
    if len(frames) < 2:
        raise InvalidInputError([Fault(file, len(frames), "holds too few frames", "is it cut off?")])
    if tracked.times is not None:
        step = float(np.median(np.diff(tracked.times)))
        if not np.array_equal(tracked.times, np.round(tracked.times)):
            for where, known in (("frame rate", tracked.rate), ("--frame-rate", given)):
                if known is not None and abs(step * known - 1) > 0.02:
                    rule = f"does not fit the times, which step by {step:.4g} s: {1 / step:.4g} frames a second"
                    raise InvalidInputError([Fault(f"{file}, {where}", known, rule, "correct it, or the times")])
            return tracked.times - tracked.times[0], []
        frames = tracked.times  # they are counted, not measured
    steps, rate, told = np.diff(frames), given or tracked.rate, []
    if rate is None:
        rule = "is missing: the file holds no times, and angles need a clock"
        fix = "give --frame-rate with the frames per second of your film, such as --frame-rate 500"
        raise InvalidInputError([Fault(f"{file}, frame rate", None, rule, fix)])
    if tracked.rate is not None and given is not None and abs(given / tracked.rate - 1) > 0.02:
        told.append(f"{file}: --frame-rate {given:g} replaces the file's own {tracked.rate:g} frames a second")
    if (steps != steps[0]).any():
        told.append(f"{file}: {int((steps > steps.min()).sum())} times frames are missing between two rows")
    return (frames - frames[0]) / rate, told


def _folds(file: str, every: Mapping[str, Mapping[str, Array]], phase: Array, notes: list[str]) -> bool:
    """Return whether the hands drop below the arms by more than noise; add a note."""
    if not all("fold_deg" in found for found in every.values()):
        if all("chord" in found for found in every.values()):
            notes.append(f"{file}: without wrist and trailing edge the wing is taken to be flat, without fold")
        return False
    drop = np.mean([found["fold_deg"] for found in every.values()], axis=0)
    seen = np.isfinite(drop)
    if seen.sum() < _FEW_FRAMES:
        return False
    law = fit_law(phase[seen], drop[seen])
    size, error = first_harmonic(law)
    wrist = float(np.nanmean([found["wrist"] for found in every.values()]))
    if 2.0 * size > _LEAST_FOLD and size > _SURE_FOLD * error:
        notes.append(
            f"{file}: the hand folds against the arm by {2 * size:.2g} deg; flap is the arm's, and the wrist is at "
            f"{wrist:.2f} of the span, where the film then folds it"
        )
        return True
    notes.append(f"{file}: the hand stays in line with the arm ({size:.2g} +- {error:.2g} deg)")
    return False


def _largest(span: Array, phase: Array) -> float:
    """Return the largest span of the fitted law, or the mean of a span that varies by no more than its noise."""
    seen = np.isfinite(span)
    law = fit_law(phase[seen], span[seen])
    return float(law.curve(np.arange(180) / 180)[0].max() if law.varies else law.coefficients[0])


def _unit(
    tracked: TrackedPoints, given: str | None, span: float, speed: float, rate: float
) -> tuple[str | None, str, bool]:
    """Return the unit of length, None if it is not known, a sentence on where it comes from, and if it suits."""
    file, stated = tracked.name, tracked.unit
    if given is not None and stated is not None and given != stated:
        raise InvalidInputError([Fault("--units", given, f"the file says {stated}", "leave the option out")])
    if unit := given or stated:
        said = f"{file}: lengths are in {unit}, {'as given' if given else 'as the file says'}"
        if _SEMI_SPANS[0] / 3 <= span * METRES[unit] <= 3 * _SEMI_SPANS[1]:
            return unit, said, True
        return unit, f"{said}: the wing is then {span * METRES[unit]:.3g} m long, as that of no animal", False
    (low, high), (slow, fast) = _SEMI_SPANS, _BEATEN
    likely = [name for name, m in METRES.items() if low <= span * m <= high and speed * m < _MOST_SPEED]
    likely = [name for name in likely if slow <= span * METRES[name] * rate <= fast]
    if len(likely) == 1:
        long = f"{span * METRES[likely[0]]:.3g} m long"
        return likely[0], f"{file}: lengths seem to be in {likely[0]}: the wing is then {long}", True
    shown = " or ".join(f"{name} ({span * METRES[name]:.2g} m)" for name in likely) or "none of m, cm, mm"
    said = f"{file}: the unit of lengths may be {shown}: the film has angles but no path; give --units"
    return None, said, False
