"""Tracked points in three dimensions, as tracking programs write them: positions by name, clock, unit and gaps."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from wingbeat._base import Fault, FaultList, FileError, InvalidInputError, install_extra, read_text
from wingbeat._base.sheets import MAX_BYTES
from wingbeat.experiment.point_tables import (
    LEAST_SCORE,
    METRES,
    SCORES,
    UNIT_WORDS,
    Array,
    refuse,
    refuse_repeated,
    split_table,
    table_numbers,
    without_subject,
)

_FLAT = (
    "wingbeat needs points in three dimensions: triangulate the views of two or more calibrated cameras, for "
    "example with Anipose, DLTdv or Argus, and give the file that they write"
)
# No camera takes more frames [Hz].
_FASTEST = 1e6
# Frames from which a clock is checked against the stated rate.
_FEW = 10
_AXES = tuple(sign + axis for sign in ("+", "-", "") for axis in "xyz")
# Kinds whose programs write (0, 0, 0) for a point that was not seen. Elsewhere it may be the origin of the axes.
_ZERO_IS_GAP = ("DLTdv", "Qualisys .tsv", "OpenSim .trc", "C3D")


@dataclass(frozen=True)
class TrackedPoints:
    """Points that were tracked in three dimensions.

    Parameters
    ----------
    name : for messages, such as the name of the file.
    kind : what wrote the file, in words.
    positions : of each point by its name, in the file's axes and unit, shape (n, 3); NaN where it was not seen. In
        a copy, frames in which a point was seen in part become such gaps; so do points at exactly (0, 0, 0) where
        `kind` is that of a program that writes so what it did not see.
    times : of the frames [s], from the file; None if it has none.
    frames : numbers of the frames, shape (n,).
    rate : frames per second that the file states, None if it states none [Hz].
    unit : "m", "cm" or "mm" if the file states it.
    up : the file's vertical axis, such as "+z", if it states it.
    notes, warnings : what the reader did, such as points of low likelihood that were left out.

    Raises
    ------
    InvalidInputError : shapes that differ, a clock that does not rise, an unknown unit or axis, a frame rate that
        no camera has.
    """

    name: str
    kind: str
    positions: dict[str, Array]
    times: Array | None
    frames: Array
    rate: float | None = None
    unit: str | None = None
    up: str | None = None
    notes: tuple[str, ...] = ()
    warnings: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        faults, notes, warnings, file = FaultList(), list(self.notes), list(self.warnings), self.name
        frames = np.array(self.frames, dtype=float)
        times = None if self.times is None else np.array(self.times, dtype=float)
        positions = {name: np.array(at, dtype=float) for name, at in self.positions.items()}
        shapes = {f"point {name}": (at.shape, (*frames.shape, 3)) for name, at in positions.items()}
        shapes |= {} if times is None else {"times": (times.shape, frames.shape)}
        for what, (shape, right) in {"frames": (frames.shape, frames.shape[:1]), **shapes}.items():
            if shape != right or len(right) == 0:
                rule = "does not have a row for each frame, and a point has three columns"
                faults.add(f"{file}, {what}", f"shape {shape}", rule, f"give {right}")
        if self.unit is not None:
            faults.choice(f"{file}, unit", self.unit, tuple(METRES))
        if self.up is not None:
            faults.choice(f"{file}, up", self.up, _AXES)
        if self.rate is not None:
            faults.number(f"{file}, frame rate", self.rate, above=0, at_most=_FASTEST, unit="Hz")
        clocks = {"time": times, "frame": frames}
        for word, series in clocks.items():
            if series is not None:
                faults.first(f"{file}, {word}", series, ~np.isfinite(series), "must be finite")
        faults.raise_if_any()
        for word, series in clocks.items():
            if series is not None and (k := _first_fall(series)):
                fault = Fault(f"{file}, {word}[{k}]", float(series[k]), *_falls(word, series[k - 1]))
                raise InvalidInputError([fault])
        for name, at in positions.items():
            at[~np.isfinite(at).all(axis=1)] = np.nan
            empty = (at == 0).all(axis=1)
            some = f"{file}, {name}: {empty.sum()} frames at exactly (0, 0, 0)"
            if self.kind in _ZERO_IS_GAP:
                at[empty] = np.nan
                notes += [f"{some} are taken for gaps"] if empty.any() else []
            elif empty.any() and not empty.all():
                warnings.append(f"{some} are taken as they are; leave cells empty where the point was not seen")
        found = {"frames": frames, "times": times, "positions": positions}
        for name, value in (found | {"notes": tuple(notes), "warnings": tuple(warnings)}).items():
            object.__setattr__(self, name, value)


def _first_fall(series: Array) -> int:
    """Return the place of the first number that is not above the one before it; 0 if there is none."""
    rises = np.diff(series) > 0
    return 0 if rises.all() else int(np.argmin(rises)) + 1


def _falls(word: str, before: float) -> tuple[str, str]:
    return f"must be above the {word} before it, {before:g}", "sort the rows; drop repeated ones"


def read_points(source: Any) -> TrackedPoints:
    """Read points tracked in three dimensions from a file of a tracking program, or from a data set of movement.

    Text: any table with three columns ``<name>_x``, ``<name>_y``, ``<name>_z`` for each point (DLTdv, Argus,
    Anipose), DeepLabCut's three rows of heads, OpenSim's .trc, Qualisys' .tsv and the table of trajectories of
    Vicon Nexus. Others: C3D (needs ezc3d), NetCDF of movement, HDF5 of sleap-anipose. Points with a likelihood or
    score below 0.6 and points seen by fewer than two cameras become gaps. So do points at exactly (0, 0, 0) in
    files of DLTdv and Qualisys, in .trc and in C3D.

    Parameters
    ----------
    source : path of the file, or a data set of movement (an `xarray.Dataset` with a variable ``position``).

    Raises
    ------
    FileError : the file is missing or cannot be read, or ezc3d is not installed.
    InvalidInputError : points in two dimensions, cells that are not numbers, a clock that does not rise.
    """
    if not isinstance(source, str | Path):
        return _of_dataset(source, "a data set", "movement")
    path = Path(source)
    suffix = path.suffix.lower()
    if path.is_file() and suffix in (".c3d", ".nc", ".h5", ".hdf5", ".slp"):
        if suffix == ".c3d":
            return _read_c3d(path)
        return _read_hdf5(path)
    table = split_table(path.name, read_text(path, limit=MAX_BYTES))
    numbers = table_numbers(path.name, table)
    triples: dict[str, list[int]] = {}
    for axis in "xyz":
        refuse_repeated(path.name, [name for name, part in table.labels if part == axis])
    for k, (name, part) in enumerate(table.labels):
        if part in ("x", "y", "z"):
            triples.setdefault(name, [-1, -1, -1])["xyz".index(part)] = k
    positions = {name: numbers[:, places] for name, places in triples.items() if min(places) >= 0}
    names = [name for name, places in triples.items() if min(places) < 0]
    if not positions:
        head = ", ".join(dict.fromkeys(name for name, _ in table.labels if name))[:200]
        rule = "names no point with the three columns x, y and z"
        fix = "name the columns tip_x, tip_y, tip_z and so on"
        if "flap_deg" in head:
            fix = "these are angles already: give the file to orbit or simulate by --kinematics"
        if names:
            rule, fix = "has points with two coordinates only, as seen by one camera", _FLAT
        refuse(path.name, head, rule, fix)
    notes, warnings = [], []
    if names:
        warnings.append(f"{path.name}: {', '.join(names[:5])} lacks one of x, y, z and is left out")
    if table.kind == "DeepLabCut":
        warnings.append(
            f"{path.name}: DeepLabCut triangulates in the axes of its first camera, x right, y down, z away. "
            "If nobody turned them, give --up -y; a camera that is not level tilts the stroke by its own angle: "
            "--up takes its true direction too, such as --up=0,-0.96,-0.29 of one that looks 17 degrees down"
        )
    for name, at in positions.items():
        for k, (other, part) in enumerate(table.labels):
            if other == name and part in (*SCORES, "ncams"):
                with np.errstate(invalid="ignore"):
                    poor = numbers[:, k] < (2 if part == "ncams" else LEAST_SCORE)
                poor &= np.isfinite(at).all(axis=1)
                at[poor] = np.nan
                if poor.any():
                    why = "were seen by fewer than two cameras" if part == "ncams" else f"have a {part} below 0.6"
                    notes.append(f"{path.name}, {name}: {poor.sum()} of {len(at)} frames {why} and are left out")
    clock = {part: numbers[:, k] for k, (name, part) in enumerate(table.labels) if not name}
    times = clock.get("time", clock["milliseconds"] / 1000 if "milliseconds" in clock else None)
    frames = clock.get("frame", np.arange(len(numbers), dtype=float))
    for word, series in (("time", times), ("frame", frames)):
        if series is not None and (k := _first_fall(series)):
            where = f"{path.name} row {table.rows[k][0]}, {word}"
            refuse(where, float(series[k]), *_falls(word, series[k - 1]))
    rate = table.rate
    if times is not None and len(times) >= _FEW:
        times, rate = _even(path.name, times, frames, rate, notes, warnings)
    if "frame" not in clock and times is None:
        same = [k for k in range(1, len(numbers)) if np.array_equal(numbers[k], numbers[k - 1])]
        if same:
            rows = ", ".join(str(table.rows[k][0]) for k in same[:5])
            warnings.append(f"{path.name}: row {rows} repeats the row before it; a doubled row shifts the clock")
    return TrackedPoints(
        path.name, table.kind, positions, times, frames, rate, table.unit, None, (*notes,), (*warnings,)
    )


def _even(
    file: str, times: Array, frames: Array, rate: float | None, notes: list[str], warnings: list[str]
) -> tuple[Array, float | None]:
    """Return the times, evened if they were rounded to a millisecond, and the frames per second that fit them."""
    usual = (frames[-1] - frames[0]) / (times[-1] - times[0])
    slack = 0.02 + 0.001 / (times[-1] - times[0])
    if rate is not None and abs(rate / (len(times) * usual) - 1) < slack:
        warnings.append(
            f"{file}: the stated {rate:.0f} frames a second are the number of frames times the rate, as Kinetics "
            f"Toolkit 0.17 writes it; {rate / len(times):g} is taken, which fits the times"
        )
        rate = rate / len(times)
    whole = bool((abs(times * 1000 - np.round(times * 1000)) < 1e-6).all())
    if not whole or np.ptp(np.diff(times) / np.diff(frames)) < 1e-6:
        return times, rate
    fits = rate if rate is not None and abs(rate / usual - 1) < slack else usual
    even = times[0] + (frames - frames[0]) / fits
    if abs(even - times).max() > 0.001 or np.array_equal(times, np.round(times)):
        return times, rate
    notes.append(f"{file}: the times are rounded to a millisecond; {fits:.5g} frames a second are taken for even")
    return even, rate


def _of_dataset(data: Any, file: str, kind: str) -> TrackedPoints:
    """Return the points of a data set of movement: position by time, space, keypoints and individuals."""
    position = getattr(data, "data_vars", {}).get("position")
    known = position is not None and {"time", "space"} <= set(position.dims)
    if position is None or not known or not {"keypoints", "keypoint"} & set(position.dims):
        names = ", ".join(map(str, getattr(data, "data_vars", {}))) or type(data).__name__
        refuse(file, names, "is no data set of movement with poses", "give position(time, space, keypoints)")
    if "z" not in position["space"].values.tolist():
        refuse(file, "space = x, y", "has points with two coordinates only, as seen by one camera", _FLAT)
    position = position.sel(space=["x", "y", "z"]).transpose("time", "space", ...)
    scores = data.data_vars.get("confidence")
    others = [dim for dim in position.dims if dim not in ("time", "space")]
    found, notes = {}, []
    stacked = position.stack(point=others) if len(others) > 1 else position.rename({others[0]: "point"})
    sizes = {dim: position.sizes[dim] for dim in others}
    scored = None
    if scores is not None and {"time", *others} <= set(scores.dims):
        scored = scores.stack(point=others) if len(others) > 1 else scores.rename({others[0]: "point"})
    labels = []
    for label in stacked["point"].values.tolist():
        words = dict(zip(others, label if isinstance(label, tuple) else (label,), strict=True))
        labels.append(" ".join(str(one) for dim, one in words.items() if "individual" not in dim or sizes[dim] > 1))
    refuse_repeated(file, labels)
    for k, name in enumerate(labels):
        found[name] = np.array(stacked.isel(point=k).transpose("time", "space").values, dtype=float)
        if scored is not None:
            values = np.asarray(scored.isel(point=k).values, dtype=float)
            poor = (np.nan_to_num(values, nan=1.0) < LEAST_SCORE) & np.isfinite(found[name]).all(axis=1)
            found[name][poor] = np.nan
            if poor.any():
                why = "have a confidence below 0.6 and are left out"
                notes.append(f"{file}, {name}: {poor.sum()} of {len(poor)} frames {why}")
    clock = np.asarray(position["time"].values)
    rate, times = data.attrs.get("fps"), None
    if str(data.attrs.get("time_unit", "")).startswith("s"):
        times = clock.astype(float)
    frames = np.arange(len(clock), dtype=float) if times is not None else clock.astype(float)
    rate = float(rate) if isinstance(rate, int | float | np.number) and np.isfinite(float(rate)) else None
    return TrackedPoints(file, kind, found, times, frames, rate, None, None, tuple(notes))


def _read_hdf5(path: Path) -> TrackedPoints:
    """Read NetCDF of movement and HDF5 of sleap-anipose; SLEAP's own files hold points of one camera."""
    import h5py
    import xarray as xr

    try:
        with h5py.File(path, "r") as file:
            tracks: Any = np.asarray(file["tracks"]) if "tracks" in file else np.empty(0)
            names = [one.decode() for one in np.asarray(file["node_names"])] if "node_names" in file else []
            if names and tracks.ndim == 4 and tracks.shape[1] == 3:
                # movement writes points of three dimensions in the layout of SLEAP: track, space, node, frame.
                tracks = tracks.transpose(3, 0, 2, 1)
            elif path.suffix.lower() == ".slp" or (names and tracks.ndim == 4 and tracks.shape[1] == 2):
                refuse(path.name, "SLEAP", "has points with two coordinates only, as seen by one camera", _FLAT)
            if tracks.ndim == 4 and tracks.shape[-1] == 3:
                names = names or [f"node{k}" for k in range(tracks.shape[2])]
                refuse_repeated(path.name, names)
                found = {
                    f"track{i} {name}" if tracks.shape[1] > 1 else name: tracks[:, i, k].astype(float)
                    for i in range(tracks.shape[1])
                    for k, name in enumerate(names)
                }
                frames, told = np.arange(len(tracks), dtype=float), []
                if "node_names" not in file:
                    told = [
                        f"{path.name}: sleap-anipose smooths, fills frames that no camera saw, and marks neither: "
                        "amplitudes may be too small"
                    ]
                    if "frames" in file:
                        frames += float(np.asarray(file["frames"]).ravel()[0])
                return TrackedPoints(path.name, "SLEAP in 3-D", found, None, frames, warnings=tuple(told))
            if "position" not in file:
                rule = "is HDF5 without points that wingbeat knows"
                fix = "give NetCDF of movement, HDF5 of sleap-anipose, or a table with tip_x, tip_y, tip_z"
                refuse(path.name, ", ".join(list(file)[:6]), rule, fix)
        with xr.open_dataset(path, engine="h5netcdf") as data:
            return _of_dataset(data.load(), path.name, "movement")
    except InvalidInputError:
        raise
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        kind = "NetCDF-4 or HDF5 file that can be read"
        raise FileError(f"cannot read {path.name!r}: it is no {kind}: {str(error)[:120]}") from None


def _read_c3d(path: Path) -> TrackedPoints:
    """Read C3D with ezc3d."""
    try:
        import ezc3d
    except ImportError:
        raise FileError(f"ezc3d, which reads .c3d, is not installed here: {install_extra('c3d')}") from None
    try:
        file = ezc3d.c3d(str(path))
        data, given = np.array(file["data"]["points"][:3], dtype=float), file["parameters"]["POINT"]
        labels = [
            name.strip() for key in ("LABELS", "LABELS2", "LABELS3") for name in given.get(key, {}).get("value", [])
        ]
        unit = next(iter(given.get("UNITS", {}).get("value", [])), "")
        up = next(iter(given.get("Y_SCREEN", {}).get("value", [])), "")
        rate = float(file["header"]["points"]["frame_rate"])
        first = float(file["header"]["points"]["first_frame"])
    except (OSError, ValueError, KeyError, IndexError, RuntimeError, TypeError) as error:
        raise FileError(f"cannot read {path.name!r} as C3D: {str(error)[:120]}; is it whole?") from None
    labels = without_subject(labels[: data.shape[1]])
    refuse_repeated(path.name, [name for name in labels if name])
    found = {name: data[:, k].T for k, name in enumerate(labels) if name}
    bare = data.shape[1] - len(found)
    notes = (f"{path.name}: {bare} of {data.shape[1]} points have no name and are left out",) if bare else ()
    frames = first + np.arange(data.shape[2], dtype=float)
    stated = up.strip().lower() if re.fullmatch(r"[+-][xyz]", up.strip().lower()) else None
    length = UNIT_WORDS.get(unit.lower())
    return TrackedPoints(path.name, "C3D", found, None, frames, rate or None, length, stated, notes)
