"""Which way is forward, up and outward in the axes of tracked points: from flags, from the points, or refused."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat.experiment.point_names import NamedPoints
from wingbeat.experiment.point_tables import Array
from wingbeat.experiment.tracked_points import TrackedPoints

# The lab axis along which the tip swings most is up if swing over mean is so many times that of the sideways axis.
# With the flap's mean at 0 it is above 5, at 30 degrees 3, at 45 degrees 1.
_CLEAR_SWING = 2.0
# A lab axis that makes a smaller angle than this with the path is not up [cosine].
_ALONG = 0.77
# Without travel, nothing tells a vertical stroke from a horizontal one but the swing of the tip.
_CLEAR_TETHERED = 1.4
# A direction is an axis of the file if it is this near [cosine].
_AN_AXIS = 0.99999
# A climb or descent above this is said [deg].
_STEEP = 20.0


class Axes(NamedTuple):
    """Directions in the file's axes, and how they were found.

    Attributes
    ----------
    forward, up : horizontal direction of flight, and the vertical, unit vectors of shape (3,).
    outward : direction of each wing from the body, by side.
    sides : "left" or "right" of each wing in right-handed axes, by side as named.
    travels : whether the animal travels by more than a wing's length.
    climb : angle of the path above the horizontal [rad].
    speed : of the path, in the file's unit of length over seconds.
    notes, warnings : how the directions were found, and what is doubtful.
    """

    forward: Array
    up: Array
    outward: dict[str, Array]
    sides: dict[str, str]
    travels: bool
    climb: float
    speed: float
    notes: tuple[str, ...]
    warnings: tuple[str, ...]


def _unit(vector: Array) -> Array:
    return vector / np.linalg.norm(vector)


def _without(vector: Array, along: Array) -> Array:
    """Return a vector without its part along a unit vector."""
    return vector - (vector @ along) * along


def axis_vector(faults: FaultList, where: str, word: str | None) -> Array | None:
    """Return the unit vector of a word: "z", "+y", "-x", or three numbers such as "0.1,-0.99,0.05".

    None without a word, or with a fault noted.

    >>> axis_vector(FaultList(), "--up", "-y").tolist(), axis_vector(FaultList(), "--up", "0,3,4").tolist()
    ([-0.0, -1.0, -0.0], [0.0, 0.6, 0.8])
    """
    if word is None:
        return None
    if match := re.fullmatch(r"([+-]?)([xyz])", word.strip().lower()):
        return (-1.0 if match[1] == "-" else 1.0) * np.eye(3)["xyz".index(match[2])]
    with suppress(ValueError):
        vector = np.array([float(cell) for cell in re.split(r"[\s,;]+", word.strip(" ()[]"))])
        length = float(np.linalg.norm(vector))
        if vector.shape == (3,) and 0 < length < math.inf:
            return vector / length
    fix = "write x, y or z, with - for the opposite direction, such as -y, or three numbers, such as 0.1,-0.99,0.05"
    faults.add(where, word, "is no axis", fix)
    return None


def axis_name(vector: Array, *, nearest: bool = True) -> str:
    """Return the nearest axis of the file, such as "+z"; if not `nearest`, three numbers for another direction."""
    k = int(np.argmax(np.abs(vector)))
    if not nearest and abs(vector[k]) < _AN_AXIS:
        return ",".join(f"{part:.3g}" for part in vector)
    return f"{'-' if vector[k] < 0 else '+'}{'xyz'[k]}"


def find_axes(
    tracked: TrackedPoints,
    named: NamedPoints,
    time: Array,
    side: str | None,
    up: Array | None,
    forward: Array | None,
) -> Axes:
    """Return forward, up and outward directions.

    Forward comes from the flag, from the body's points (rear to front), from the path if it is longer than a wing,
    or else from the wing's own chord. Up comes from the flag, from the file, from both wings, or else is that axis
    of the file along which the tip swings most for its mean. The axes are taken for right-handed: left is up x
    forward.

    Parameters
    ----------
    tracked, named : the points.
    time : of the frames [s].
    side : "left", "right" or "both", as given by the user.
    up, forward : unit vectors of the flags, from `axis_vector`.

    Raises
    ------
    InvalidInputError : directions that cannot be found, a side that contradicts the sign of up.
    """
    file, notes, warnings = tracked.name, [], []
    spans = {one: wing["tip"] - wing["shoulder"] for one, wing in named.wings.items()}
    lengths = {one: float(np.nanmedian(np.linalg.norm(span, axis=1))) for one, span in spans.items()}
    length = float(np.mean(list(lengths.values())))
    _check_lengths(file, named, lengths, time)
    middle = np.mean([wing["shoulder"] for wing in named.wings.values()], axis=0)
    seen = np.isfinite(middle).all(axis=1)
    velocity = np.zeros(3)
    if seen.sum() > 2:
        velocity = np.polynomial.polynomial.polyfit(time[seen], middle[seen], 1)[1]
    speed = float(np.linalg.norm(velocity))
    travels = speed * float(time[-1] - time[0]) > length
    axis = None
    if {"front", "rear"} <= set(named.body):
        axis = np.nanmean(named.body["front"] - named.body["rear"], axis=0)
        axis = _unit(axis)
    way = velocity / speed if travels else axis
    if forward is not None:
        how = "--forward"
        if way is not None and forward @ way < 0.5:
            warnings.append(f"{file}: --forward {axis_name(forward)} is not where the animal flies or points")
        way = forward
        if travels and forward @ velocity > 0.5 * speed:
            how, way = "the path, with the sign of --forward", velocity / speed
    elif travels:
        how = "the path, which is longer than a wing"
    elif axis is not None:
        how = "the points front and rear"
    else:
        how = "the wing's chord; the animal does not travel"
    if travels and axis is not None and axis @ velocity < 0:
        rule = "points against the direction of flight"
        fix = "exchange front and rear, or state the direction with --forward"
        raise InvalidInputError([Fault(f"{file}, front minus rear", axis_name(axis), rule, fix)])
    found = up is not None
    if up is not None:
        said = "--up"
    elif tracked.up is not None:
        up, said, found = axis_vector(FaultList(), file, tracked.up), "the file's own vertical", True
    elif set(named.wings) == {"left", "right"} and way is not None:
        left = _without(np.nanmean(named.wings["left"]["shoulder"] - named.wings["right"]["shoulder"], axis=0), way)
        up = axis_vector(FaultList(), file, axis_name(np.cross(way, left)))
        said = "the axis of the file nearest to forward x left"
    else:
        up, said = _swung(file, spans, way), "the axis along which the tip swings most"
        if way is None:
            warnings.append(
                f"{file}: up is taken to be {axis_name(up)}, {said}, as in a vertical stroke; the animal does not "
                "travel: if it hovers with a horizontal stroke, give --up"
            )
    assert up is not None
    shown, opposite = (axis_name(one, nearest=False) for one in (up, -up))
    if way is None:
        one, span = next(iter(spans.items()))
        out = _unit(_without(np.nanmean(span / np.linalg.norm(span, axis=1)[:, None], axis=0), up))
        way = _ahead(file, named.wings[one], np.cross(out, up))
    flat = _without(way, up)
    if np.linalg.norm(flat) < 0.3:
        rule, fix = f"is along the direction of flight, {axis_name(way)}", "give --up, or --forward, or both"
        raise InvalidInputError([Fault(f"{file}, up", shown, rule, fix)])
    flat = _unit(flat)
    left = np.cross(up, flat)
    outs = {one: float(np.nanmean(span @ left)) for one, span in spans.items()}
    true = {one: "left" if out > 0 else "right" for one, out in outs.items()}
    if len(true) > 1 and len(set(true.values())) == 1:
        rule, fix = "lie on the same side of the body", "check the names of the points, and --up and --forward"
        raise InvalidInputError([Fault(f"{file}, both wings", next(iter(true.values())), rule, fix)])
    for one, lies in true.items():
        asked = one or (side if side in ("left", "right") else "")
        if not asked or asked == lies:
            continue
        if not found:
            rule = (
                f"but with {shown} up and {axis_name(flat)} forward the wing lies on the {lies} "
                "(left = up x forward)"
            )
            fix = (
                f"if the axes are right-handed, up is {opposite}: give --up {opposite}; if up is {shown}, the axes "
                f"are left-handed or it is the {lies} wing: give --up {shown}"
            )
            raise InvalidInputError([Fault(f"{file}, side", asked, rule, fix)])
        warnings.append(
            f"{file}: with {shown} up and {axis_name(flat)} forward the {asked} wing lies on the {lies}: the axes "
            "are left-handed, or the side is wrong; the angles are the same"
        )
        break
    if not any(named.wings) and side is None and not found:
        notes.append(
            f"{file}: up is {shown}, {said}; in right-handed axes this is the "
            f"{next(iter(true.values()))} wing. If it is the other wing, give --up {opposite}"
        )
    else:
        notes.append(f"{file}: up is {shown}, from {said}" if found else f"{file}: up is {shown}, {said}")
    tilt = math.degrees(math.asin(np.clip(way @ up, -1, 1)))
    notes.append(f"{file}: forward is {np.round(flat, 2).tolist()}, from {how}")
    climb = math.asin(np.clip(velocity @ up / speed, -1, 1)) if travels else 0.0
    if abs(math.degrees(climb)) > _STEEP:
        warnings.append(
            f"{file}: the path {'climbs' if climb > 0 else 'falls'} by {abs(math.degrees(climb)):.0f} deg; if the "
            "file's axes are those of a camera, turn them upright first"
        )
    elif not travels and abs(tilt) > _STEEP:
        notes.append(f"{file}: the body axis is {tilt:.0f} deg from the horizontal")
    outward = {one: (1.0 if lies == "left" else -1.0) * left for one, lies in true.items()}
    return Axes(flat, up, outward, true, bool(travels), climb, speed, tuple(notes), tuple(warnings))


def _check_lengths(file: str, named: NamedPoints, lengths: Mapping[str, float], time: Array) -> None:
    """Refuse wings whose points are exchanged: the tip is farthest from the shoulder and moves most."""
    faults = FaultList()
    for one, wing in named.wings.items():
        where = f"{file}, {one or 'wing'}"
        fix = "are two names exchanged? Check --points"
        if not lengths[one] > 0:
            faults.add(where, lengths[one], "tip and shoulder are at the same place", fix)
            continue
        if "wrist" in wing:
            arm = float(np.nanmedian(np.linalg.norm(wing["wrist"] - wing["shoulder"], axis=1)))
            if arm > lengths[one]:
                rule = f"is the distance from shoulder to wrist, above that to the tip, {lengths[one]:.4g}"
                faults.add(where, float(f"{arm:.4g}"), rule, fix)
        swings = {}
        for role in ("shoulder", "tip"):
            seen = np.isfinite(wing[role]).all(axis=1)
            line = np.polynomial.polynomial.polyfit(time[seen], wing[role][seen], 2)
            rest = wing[role][seen] - np.polynomial.polynomial.polyval(time[seen], line).T
            swings[role] = float(np.sqrt((rest**2).sum(axis=1).mean()))
        if swings["shoulder"] > 0.7 * swings["tip"]:
            rule = f"is the swing of the shoulder about its path, beside {swings['tip']:.3g} of the tip"
            faults.add(where, float(f"{swings['shoulder']:.3g}"), rule, fix)
    faults.raise_if_any()


def _swung(file: str, spans: Mapping[str, Array], way: Array | None) -> Array:
    """Return that axis of the file along which the tip swings most for its mean; refuse if two are alike."""
    span = next(iter(spans.values()))
    span = span / np.linalg.norm(span, axis=1)[:, None]
    scores = np.zeros(3)
    for k, axis in enumerate(np.eye(3)):
        if way is None:
            scores[k] = np.nanstd(span[:, k])
            continue
        across = _without(axis, way)
        if np.linalg.norm(across) < math.sqrt(1 - _ALONG**2):
            continue
        across = _unit(across)
        both = [(np.nanstd(span @ one), abs(np.nanmean(span @ one))) for one in (across, np.cross(across, way))]
        (swing, mean), (beside, middle) = both
        # Swing over mean; a wing stays on its own side, so the mean of its sideways part is large.
        scores[k] = (swing / max(mean, 0.05)) / (beside / max(middle, 0.05))
    order = np.argsort(scores)[::-1]
    best, second = scores[order[0]], scores[order[1]]
    least = _CLEAR_TETHERED * second if way is None else max(_CLEAR_SWING, 1.5 * second)
    if not best > least:
        rule = "cannot be found: the tip swings alike along two axes of the file"
        shown = ", ".join(f"{'xyz'[k]} {scores[k]:.2g}" for k in order[:2])
        raise InvalidInputError([Fault(f"{file}, up", shown, rule, "give --up, such as --up z")])
    return np.eye(3)[order[0]]


def _ahead(file: str, wing: Mapping[str, Array], across: Array) -> Array:
    """Return that one of two opposite directions in which the leading edge lies."""
    span = wing["tip"] - wing["shoulder"]
    lead = wing.get("leading", wing.get("wrist"))
    trail = wing.get("trailing")
    if lead is None and trail is None:
        rule = "cannot be found: the animal does not travel, and no point shows the wing's chord"
        fix = "give --forward, such as --forward x, or name a wrist or trailing point"
        raise InvalidInputError([Fault(f"{file}, forward", None, rule, fix)])
    along = span / np.linalg.norm(span, axis=1)[:, None]

    def off(point: Array) -> Array:
        apart = point - wing["shoulder"]
        return apart - (apart * along).sum(axis=1)[:, None] * along

    chord = (0.0 if lead is None else off(lead)) - (0.0 if trail is None else off(trail))
    part = np.nanmean(np.asarray(chord) @ across)
    return across if part > 0 else -across
