"""One wing's tracked points: its angles in each frame, its stroke plane, and the noise of both."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from wingbeat.experiment.point_tables import FEWEST_SEEN, Array

# Frames of a marker that give its noise; more add nothing.
_NOISE_FRAMES = 1500


def wing_columns(wing: Mapping[str, Array], pitch: Array, normal: Array, fold: bool) -> dict[str, Array]:
    """Return the columns of one wing: angles [deg] and lengths, frame by frame.

    With the stroke plane's normal ``e_1`` and the direction ``e`` from shoulder to tip, flap is the angle of e in
    the stroke plane and sweep ``asin(e . e_1)``. The chord is the line from trailing to leading edge made normal
    to e, and pitch its angle from ``e_1`` made normal to e, leading edge up.

    Parameters
    ----------
    wing : points by role as forward, outward, up, shape (n, 3) each.
    pitch : of the body [rad], shape (n,).
    normal : of the stroke plane, its parts along and above the body axis, shape (2,).
    fold : whether flap is that of the arm, and the hand's angle to it a column.
    """
    c, s = np.cos(pitch), np.sin(pitch)

    def turned(to: Array, origin: Array) -> Array:
        x, y, z = (to - origin).T
        return np.stack([c * x + s * z, y, c * z - s * x], axis=1)

    def flap_of(e: Array) -> Array:
        return np.degrees(np.arctan2(e[:, 2] * normal[0] - e[:, 0] * normal[1], e[:, 1]))

    def normal_to(vector: Array, e: Array) -> Array:
        return vector - (vector * e).sum(axis=1)[:, None] * e

    n = np.array([normal[0], 0.0, normal[1]])
    span = turned(wing["tip"], wing["shoulder"])
    length = np.linalg.norm(span, axis=1)
    e = span / length[:, None]
    found = {"flap_deg": flap_of(e), "along": e[:, 0], "over": e[:, 2]}
    found["sweep_deg"] = np.degrees(np.arcsin(np.clip(e @ n, -1.0, 1.0)))
    lead = wing.get("leading", wing.get("wrist"))
    lead = None if lead is None else turned(lead, wing["shoulder"])
    trail = turned(wing["trailing"], wing["shoulder"]) if "trailing" in wing else None
    chord = None
    if lead is not None or trail is not None:
        chord = np.asarray((0.0 if lead is None else lead) - (0.0 if trail is None else trail))
    if chord is not None:
        raw, chord = chord, normal_to(chord, e)
        if "wrist" in wing and trail is not None:
            # The arm lies in the plane of shoulder, wrist and trailing edge, swept as the line to the tip is. Where
            # the hand folds, the chord is normal to the arm, but not to that line.
            wrist = turned(wing["wrist"], wing["shoulder"])
            one = raw / np.linalg.norm(raw, axis=1)[:, None]
            two = normal_to(wrist, one)
            two = two / np.linalg.norm(two, axis=1)[:, None]
            forth = np.stack([one @ n, two @ n], axis=1)
            size = np.linalg.norm(forth, axis=1)
            along = np.clip((e @ n) / np.maximum(size, 1e-9), -1.0, 1.0)
            forth = forth / np.maximum(size, 1e-9)[:, None]
            ahead = forth[:, :1] * one + forth[:, 1:] * two
            out = forth[:, 1:] * one - forth[:, :1] * two
            out = out * np.where((out * e).sum(axis=1) < 0, -1.0, 1.0)[:, None]
            out = along[:, None] * ahead + np.sqrt(1.0 - along**2)[:, None] * out
            arm = (wrist * out).sum(axis=1)[:, None] * out
            hand = span - arm
            found["fold_deg"] = (flap_of(arm) - flap_of(hand) + 180.0) % 360.0 - 180.0
            if fold:
                found["flap_deg"] = flap_of(arm)
                length = np.linalg.norm(arm, axis=1) + np.linalg.norm(hand, axis=1)
                e = arm / np.linalg.norm(arm, axis=1)[:, None]
                chord = normal_to(raw, e)
            found["wrist"] = np.linalg.norm(arm, axis=1) / (
                np.linalg.norm(arm, axis=1) + np.linalg.norm(hand, axis=1)
            )
    base = normal_to(np.broadcast_to(n, e.shape), e)
    base = base / np.linalg.norm(base, axis=1)[:, None]
    above = np.cross(base, e)

    def pitch_of(one: Array) -> Array:
        return np.degrees(np.arctan2((one * above).sum(axis=1), (one * base).sum(axis=1)))

    if chord is not None:
        found["pitch_deg"] = pitch_of(chord)
        found["chord"] = np.linalg.norm(chord, axis=1)
        if "tip_trailing" in wing:
            found["tip_pitch_deg"] = pitch_of(normal_to(turned(wing["tip"], wing["tip_trailing"]), e))
    found["span"] = length
    return found


def span_of(flap: Array, sweep: Array, tilt: Array) -> tuple[Array, Array]:
    """Return the direction from shoulder to tip, and the stroke plane's normal, as forward, left, up, shape (n, 3).

    It is the inverse of `wing_columns`: of flap and sweep [rad] of the left wing, with the stroke plane at `tilt`
    [rad] from the horizontal, shape (n,) each.
    """
    zero = np.zeros_like(flap)
    ahead = np.stack([np.sin(tilt), zero, np.cos(tilt)], axis=1)
    up = np.stack([-np.cos(tilt), zero, np.sin(tilt)], axis=1)
    e = np.cos(flap)[:, None] * np.array([0.0, 1.0, 0.0]) + np.sin(flap)[:, None] * up
    return np.cos(sweep)[:, None] * e + np.sin(sweep)[:, None] * ahead, ahead


def stroke_plane(wings: Mapping[str, Mapping[str, Array]], pitch: Array) -> tuple[Array, float, float]:
    """Return the stroke plane's normal (along, above the body axis), its angle and the angle's error [deg]."""
    found = [wing_columns(wing, pitch, np.array([1.0, 0.0]), False) for wing in wings.values()]
    ends = np.concatenate([np.stack([one["along"], one["over"]], axis=1) for one in found])
    ends = ends[np.isfinite(ends).all(axis=1)]
    _, axes = np.linalg.eigh(np.cov(ends.T))
    normal = axes[:, 0] * (1.0 if axes[:, 0].sum() > 0 else -1.0)
    off, over = ends @ normal, ends @ np.array([-normal[1], normal[0]])
    error = float(np.std(off) / (np.std(over) * math.sqrt(len(ends))))
    return normal, math.degrees(math.atan2(normal[0], normal[1])), math.degrees(error)


def marker_noise(time: Array, at: Array) -> float:
    """Return a point's noise in one coordinate: its residual about cubic smoothing splines in time, NaN if unknown.

    Generalised cross-validation chooses the weight of the penalty (Craven and Wahba 1978, doi 10.1007/BF01404567);
    the residual is divided by the frames minus the spline's degrees of freedom, whose trace is estimated by one
    random vector of signs (Hutchinson 1990, doi 10.1080/03610919008812866).
    """
    from scipy.interpolate import make_smoothing_spline

    seen = np.flatnonzero(np.isfinite(at).all(axis=1))[:_NOISE_FRAMES]
    if len(seen) < FEWEST_SEEN:
        return math.nan
    clock = (time[seen] - time[seen[0]]) / float(np.median(np.diff(time[seen])))
    signs = np.random.default_rng(0).choice([-1.0, 1.0], size=(len(seen), 3))
    best = np.full(3, np.inf)
    noise = np.full(3, np.nan)
    for weight in np.geomspace(1e-4, 1e8, 25):
        both = np.hstack([at[seen] - at[seen].mean(axis=0), signs])
        smooth = make_smoothing_spline(clock, both, lam=weight)(clock)
        degrees = (signs * smooth[:, 3:]).sum() / 3.0
        left = ((both[:, :3] - smooth[:, :3]) ** 2).sum(axis=0)
        spare = len(seen) - degrees
        if spare < 0.2 * len(seen):
            continue
        score = left / spare**2
        noise = np.where(score < best, np.sqrt(left / spare), noise)
        best = np.minimum(score, best)
    return float(np.sqrt(np.mean(noise**2)))


def column_errors(
    wing: Mapping[str, Array], pitch: Array, normal: Array, fold: bool, side: str, noise: Mapping[str, float]
) -> dict[str, Array]:
    """Return the standard error of each column and frame: each point is moved by its noise along each axis."""
    known, squares = wing_columns(wing, pitch, normal, fold), {}
    for role, at in wing.items():
        step = noise["_".join(filter(None, (side, role)))]
        for axis in np.eye(3):
            moved = wing_columns({**wing, role: at + step * axis}, pitch, normal, fold)
            for name, values in moved.items():
                change = values - known[name]
                if name.endswith("_deg"):
                    change = (change + 180.0) % 360.0 - 180.0
                squares[name] = squares.get(name, 0.0) + change**2
    return {name: np.sqrt(square) for name, square in squares.items()}
