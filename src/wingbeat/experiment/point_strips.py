"""From tracked points to the strips of a wing through a beat, a case for ``wingbeat validate``."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError, quoted, write_atomically
from wingbeat.experiment.body_path import fit_body_path
from wingbeat.experiment.point_angles import PointAngles
from wingbeat.experiment.point_tables import METRES, Array
from wingbeat.experiment.wing_points import span_of, wing_columns

_STRIPS, _TIMES = 12, 50
_DENSITY, _GRAVITY = 1.225, 9.81
_COLUMNS = "time_s,strip,x_m,y_m,z_m,chord_x_m,chord_y_m,chord_z_m,area_m2,vx_m_s,vy_m_s,vz_m_s,"
_COLUMNS += "v3x_m_s,v3y_m_s,v3z_m_s"


def strips_table(path: str | Path) -> Path:
    """Return the path of the strips that `save_strips` writes beside a case."""
    return Path(path).with_name(f"{Path(path).stem}_strips.csv")


def save_strips(found: PointAngles, path: str | Path, mass: float) -> tuple[str, ...]:
    """Write a strip-motion case: the wing as it beats on average, and the mean force of the filmed flight.

    Span positions follow from shoulder, wrist and tip, the chord from the leading (or wrist) and trailing points,
    twist and taper from a trailing point at the tip. The line of quarter chords is that from shoulder to tip.

    Parameters
    ----------
    found : angles of the points.
    path : of the case to write (.toml); the strips go beside it (.csv).
    mass : of the whole animal [kg].

    Returns
    -------
    tuple of str : what was assumed.

    Raises
    ------
    FileError : a file cannot be written.
    InvalidInputError : points without the wing's chord or without the path of the body, an impossible mass.
    """
    faults, file, beat = FaultList(), found.film.name, found.beat
    faults.number("--mass", mass, above=0, unit="kg")
    faults.raise_if_any()
    for wing in found.wings.values():
        if not {"wrist", "leading"} & set(wing) or "trailing" not in wing or "pitch_deg" not in beat.laws:
            fix = "name a trailing point, and a wrist or a leading point at the same place along the wing"
            raise InvalidInputError([Fault(f"{file}, strips", "", "the chord of the wing is not measured", fix)])
    if not found.film.shows_body:
        rule = "need the path of the body in metres, which the points do not show"
        fix = "strips are those of a flying animal: give --units if the unit is not known"
        raise InvalidInputError([Fault(f"{file}, strips", "", rule, fix)])
    metres = METRES[found.unit or "m"]
    chords, tips = [], []
    for wing in found.wings.values():
        still = wing_columns(wing, np.zeros(len(found.time)), np.array([1.0, 0.0]), False)
        chords.append(np.nanmedian(still["chord"]) * metres)
        if "tip_trailing" in wing:
            tips.append(np.nanmedian(np.linalg.norm(wing["tip"] - wing["tip_trailing"], axis=1)) * metres)
    root = float(np.mean(chords))
    end = float(np.mean(tips)) if tips else root
    wrist = found.film.wrist or 0.5
    place = (np.arange(_STRIPS) + 0.5) / _STRIPS
    chord = np.interp(place, [0.0, wrist, 1.0], [root, root, end])
    body, laws = fit_body_path(beat), beat.laws

    def angle(name: str, phase: Array) -> Array:
        there = name in laws
        return np.radians(laws[name].curve(phase + beat.shift)[0]) if there else np.zeros(len(phase))

    def wing_at(phase: Array) -> tuple[Array, Array, Array]:
        """Return quarter chords and chords, shape (n, strips, 3), and the length of the wing."""
        state = body.states(phase)
        plane = np.radians(found.stroke_plane_deg) + 0.0 * phase
        tilt = plane - state[:, 2]
        zero = np.zeros(len(phase))
        sweep, pitch = angle("sweep_deg", phase), angle("pitch_deg", phase)
        twist = angle("tip_pitch_deg", phase) - pitch if "tip_pitch_deg" in laws else zero
        length: Array = found.semi_span * np.asarray(laws["span_fraction"].curve(phase + beat.shift)[0], np.float64)

        def line(flap: Array) -> tuple[Array, Array, Array]:
            e, ahead = span_of(flap, sweep, tilt)
            base = ahead - (ahead * e).sum(axis=1)[:, None] * e
            base = base / np.linalg.norm(base, axis=1)[:, None]
            return e, base, np.asarray(np.cross(base, e), dtype=np.float64)

        arm = line(angle("flap_deg", phase))
        hand = line(angle("flap_deg", phase) - angle("fold_deg", phase))
        at, lines = [], []
        for eta, size in zip(place, chord, strict=True):
            _, base, above = hand if eta > wrist else arm
            theta = pitch + eta * twist
            lines.append(size * (np.cos(theta)[:, None] * base + np.sin(theta)[:, None] * above))
            out = min(eta, wrist) * arm[0] + max(eta - wrist, 0.0) * hand[0]
            at.append(length[:, None] * out + np.stack([state[:, 0], zero, state[:, 1]], axis=1))
        wing = (np.asarray(np.stack(one, axis=1), dtype=np.float64) for one in (at, lines))
        return next(wing), next(wing), length

    phase, step = np.arange(_TIMES) / _TIMES, 1e-4
    (at, lines, length), before, after = (wing_at(phase + move) for move in (0.0, -step, step))
    speeds = [
        (after[0] - share * after[1] - before[0] + share * before[1]) / (2 * step) * body.frequency
        for share in (0.0, 0.5)
    ]
    travel = body.states(phase)
    at = at - np.stack([travel[:, 0], 0 * phase, travel[:, 1]], axis=1)[:, None, :]
    area = chord * length[:, None] / _STRIPS
    table = np.concatenate([at, lines, area[:, :, None], *speeds], axis=2)
    rows = [_COLUMNS]
    for i, moment in enumerate(phase / body.frequency):
        rows += [",".join([f"{moment:.7g}", str(k), *(f"{x:.6g}" for x in one)]) for k, one in enumerate(table[i])]
    assumed = [
        "the line of quarter chords is that from shoulder to tip",
        f"the chord is {root:.3g} m from the shoulder to the wrist, as measured at one place",
        f"and {end:.3g} m at the tip, as measured" if tips else "and also to the tip, where no point shows it",
        "the pitch at the tip is measured" if "tip_pitch_deg" in laws else "no twist: no point tip_trailing",
        "the roots of the wings meet in the plane of symmetry; the other side is the mirror image",
        f"the mean force is that of the filmed path: {mass:g} kg, {_GRAVITY} m/s2, and its mean acceleration",
        f"still air of {_DENSITY} kg/m3",
    ]
    path, table_path = Path(path), strips_table(path)
    force = [mass * body.acceleration[0], mass * (_GRAVITY + body.acceleration[1])]
    lines_of_case = [
        f"# Made by wingbeat film from {quoted(file)}.",
        f"# Each beat has {_TIMES} times, strips count from root to tip.",
        *(f"# Assumed: {one}." for one in assumed),
        "# The force of the body and tail is not known: the mean force is that of the whole animal.",
        f"name = {quoted(path.stem)}",
        f"mass = {float(mass)!r}",
        f"density = {_DENSITY}",
        f"gravity = {_GRAVITY}",
        f"frequency = {body.frequency:.6g}",
        f"speed = {math.hypot(*body.velocity):.6g}",
        "mirrored = true",
        "periodic = true",
        f"strips = {quoted(table_path.name)}",
        f"mean_force = [{force[0]:.6g}, {force[1]:.6g}]",
    ]
    write_atomically(table_path, "\n".join(rows) + "\n")
    write_atomically(path, "\n".join(lines_of_case) + "\n")
    return tuple(assumed)
