"""What the motion of strips must satisfy before loads are computed on it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList

# Where an element of an array stands: in a file or in Python.
Where = Callable[[str, tuple[int, ...]], str]

FEWEST = 8
# Widest step in beats: with fewer than five times a beat, neither speeds nor accelerations can be told.
_WIDEST = 0.2
# Narrowest step over the widest: a spline through closer times would be all noise.
_NARROWEST = 1e-3
# Faults of one kind that are listed one by one.
_LISTED = 5


class Limits(NamedTuple):
    """The range of a number or of a component, its unit, and the fix for a number outside the range."""

    least: float
    most: float
    unit: str
    fix: str = ""


# The lower ends of mass, density and the like are far below any flyer; 0 itself is refused.
SCALAR_LIMITS = {
    "mass": Limits(1e-9, 1e6, "kg", "in kilograms"),
    "density": Limits(1e-3, 1e4, "kg/m3", "air at sea level has 1.2"),
    "gravity": Limits(1e-3, 1e3, "m/s2", "9.81 on Earth"),
    "frequency": Limits(1e-3, 1e5, "Hz", "wingbeats per second"),
    "speed": Limits(0.0, 1e3, "m/s", "0 in hover"),
}
_POSITIONS = Limits(-1e5, 1e5, "m", "in metres")
_SPEEDS = Limits(-1e3, 1e3, "m/s", "in metres per second")
ARRAY_LIMITS = {
    "times": Limits(-1e7, 1e7, "s", "in seconds"),
    "position": _POSITIONS,
    "chord": Limits(-1e3, 1e3, "m", "in metres"),
    "area": Limits(1e-14, 1e4, "m2", "give square metres, and leave out a strip that has no area at any time"),
    "velocity": _SPEEDS,
    "rear_velocity": _SPEEDS,
}
_SHORTEST_CHORD = 1e-7
_LARGEST_FORCE = 1e7


def check_scalars(faults: FaultList, values: Mapping[str, Any], where: Callable[[str], str]) -> None:
    """Note the invalid numbers, texts and switches of a case."""
    for name, value in values.items():
        if name in SCALAR_LIMITS:
            limits = SCALAR_LIMITS[name]
            number = {"at_least": limits.least, "at_most": limits.most, "unit": limits.unit, "fix": limits.fix}
            faults.number(where(name), value, **number)
        elif name == "name" and not (isinstance(value, str) and value.strip() and value.isprintable()):
            faults.add(where(name), value, "must be one line of text", 'for example name = "pigeon, slow"')
        elif name in ("mirrored", "periodic") and not isinstance(value, bool):
            faults.add(where(name), value, "must be true or false", "without quotes")


def check_arrays(
    faults: FaultList, arrays: Mapping[str, NDArray[np.float64] | None], frequency: float, where: Where
) -> None:
    """Note arrays of another shape, numbers that are not finite or out of range, and chords of zero length."""
    times, area = arrays["times"], arrays["area"]
    if times is None or times.ndim != 1 or area is None or area.ndim != 2 or not area.size:
        faults.add(where("area", ()), "", "must have a row for each time and a column for each strip")
        return
    before, shape = len(faults.faults), (len(times), area.shape[1])
    for name, values in arrays.items():
        wanted = shape[:1] if name == "times" else shape if name == "area" else (*shape, 3)
        if values is None:
            continue
        if values.shape != wanted:
            faults.add(where(name, ()), values.shape, f"must have the shape {wanted}")
            continue
        limits = ARRAY_LIMITS[name]
        with np.errstate(invalid="ignore"):
            bad = ~((values >= limits.least) & (values <= limits.most))
        rule = f"must be finite and from {limits.least:g} to {limits.most:g} {limits.unit}"
        _list(faults, bad, values, name, where, rule, limits.fix)
    if len(faults.faults) > before:
        return
    if len(times) < FEWEST:
        faults.add(where("times", ()), len(times), f"must hold at least {FEWEST} times", "measure more often")
        return
    check_steps(faults, times, frequency, where)
    chord = arrays["chord"]
    assert chord is not None
    length = np.sqrt((chord * chord).sum(-1))
    rule = f"the length of a chord must be at least {_SHORTEST_CHORD:g} m"
    fix = "leave out a strip that has no chord at any time"
    _list(faults, length < _SHORTEST_CHORD, length, "chord", where, rule, fix)


def check_steps(faults: FaultList, times: NDArray[np.float64], frequency: float, where: Where) -> None:
    """Note times that do not rise, and steps that are too wide to resolve a beat or far narrower than others."""
    steps = np.diff(times)
    falls = np.append(False, steps <= 0)
    _list(faults, falls, times, "times", where, "must be later than the previous time [s]", "sort the rows by time")
    if falls.any():
        return
    wide = np.append(False, steps * frequency > _WIDEST)
    rule = f"the step from the previous time must be at most {_WIDEST:g} beats"
    _list(
        faults,
        wide,
        times,
        "times",
        where,
        rule,
        "check that frequency is in Hz and time in s; if they are, fill the gap",
    )
    close = np.append(False, steps < _NARROWEST * steps.max())
    rule = f"the step from the previous time must be at least {_NARROWEST:g} of the widest step"
    _list(faults, close, times, "times", where, rule, "drop one of the two times")


def _list(
    faults: FaultList, bad: NDArray[np.bool_], values: Any, name: str, where: Where, rule: str, fix: str
) -> None:
    """Note the first few bad values one by one, and then their total number."""
    places = np.argwhere(bad)
    for place in places[:_LISTED]:
        index = tuple(int(i) for i in place)
        faults.add(where(name, index), float(values[index]), rule, fix)
    if len(places) > _LISTED:
        faults.add(where(name, ()), f"{len(places)} values", "have this fault in total", fix)


def check_window(
    faults: FaultList,
    times: NDArray[np.float64],
    start: float | None,
    end: float | None,
    where: Callable[[str], str],
) -> None:
    """Note a window that is not a pair of rising numbers or contains too few times."""
    first, last = float(times[0]), float(times[-1])
    given = {"start": first if start is None else start, "end": last if end is None else end}
    if not all([faults.number(where(name), value, unit="s") for name, value in given.items()]):
        return
    if given["start"] >= given["end"]:
        faults.add(where("start"), given["start"], f"must be below the end, {given['end']:g} s", "exchange them")
        return
    held = int(((times >= given["start"]) & (times <= given["end"])).sum())
    if held < FEWEST:
        rule = f"the window contains {held} times and needs {FEWEST}"
        faults.add(where("start"), given["start"], rule, f"the times run from {first:g} to {last:g} s")


def check_measured(faults: FaultList, case: Any) -> None:
    """Note forces of the wrong length, forces not measured in the window, and both or neither kind of force."""
    if bool(case.forces) == (case.mean_force is not None):
        fix = "give the forces through time, or their mean"
        faults.add("forces", sorted(case.forces), "exactly one of forces and mean_force must be given", fix)
    if case.mean_force is not None:
        check_mean_force(faults, "mean_force", case.mean_force)
    for kind in ("forces", "errors"):
        for name, values in getattr(case, kind).items():
            place = f"{kind}[{name!r}]"
            if name not in ("fx", "fz"):
                faults.add(place, name, "is not a force that wingbeat compares", "use fx (forward) and fz (up)")
            elif name not in case.forces:
                fix = "give errors only for names that are in forces, or add this force there"
                faults.add(place, name, "is not a force that was measured", fix)
            elif np.shape(values) != case.times.shape:
                faults.add(place, np.shape(values), f"must have the same shape as times, {case.times.shape}")
            elif not (np.abs(values[case.inside]) <= _LARGEST_FORCE).all():
                faults.add(
                    place, "not finite or beyond 1e7 N", "must be finite and within 1e7 N from `start` to `end`"
                )
            elif kind == "errors" and (values[case.inside] < 0).any():
                faults.add(place, "below 0", "must be standard errors", "give their absolute values")


def check_mean_force(faults: FaultList, where: str, given: Any) -> None:
    """Note a mean force that is not a pair of numbers."""
    if not isinstance(given, list | tuple) or len(given) != 2:
        faults.add(where, given, "must be two numbers, forward and up [N]", "for example [0.0, 0.0085]")
        return
    for i, value in enumerate(given):
        limits = {"at_least": -_LARGEST_FORCE, "at_most": _LARGEST_FORCE, "unit": "N"}
        faults.number(f"{where}[{i}]", value, **limits)
