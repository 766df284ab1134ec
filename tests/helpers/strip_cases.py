"""Strip-motion cases made from formulas, as values and as files."""

import dataclasses
import math
from pathlib import Path

import numpy as np

from wingbeat_evidence.measured_motion import StripCase

PHASES = {"frequency": 2.0, "speed": 10.0}


def rotated(angle):
    """Return the unit vectors along the chord, forward, and along the normal of sections pitched up by an angle."""
    zero = np.zeros_like(angle)
    ahead = np.stack([np.cos(angle), zero, np.sin(angle)], -1)
    normal = np.stack([-np.sin(angle), zero, np.cos(angle)], -1)
    return ahead, normal


def section_case(plunge, pitch, *, strips=5, count=200, chord=0.2, width=0.1, velocities=True, **changes):
    """Return a case of a wing section whose strips all plunge and pitch about the quarter chord.

    `plunge` [m, up] and `pitch` [rad, nose up] are functions of time that return value and rate.
    """
    about = {"name": "section", "mass": 0.5, "density": 1.2, "gravity": 9.81, "mirrored": True, "periodic": True}
    about |= PHASES | {"mean_force": (0.0, 1.0)} | changes
    times = np.arange(count) / count / about["frequency"]
    (height, climb), (angle, turning) = plunge(times), pitch(times)
    ahead, normal = rotated(angle)
    shape = (count, strips, 3)
    side = (np.arange(strips) + 0.5) * width
    place = np.zeros(shape)
    place[..., 0] = (about["speed"] * times)[:, None]
    place[..., 1] = side
    place[..., 2] = height[:, None]
    velocity = np.zeros(shape)
    velocity[..., 0], velocity[..., 2] = about["speed"], climb[:, None]
    rear = velocity - (0.5 * chord * turning)[:, None, None] * normal[:, None]
    return StripCase(
        times=times,
        position=place,
        chord=np.broadcast_to(chord * ahead[:, None], shape).copy(),
        area=np.full(shape[:2], chord * width),
        velocity=velocity if velocities else None,
        rear_velocity=rear if velocities else None,
        **about,
    )


def flapping_case(*, strips=8, count=160, semi_span=0.3, chord=0.08, velocities=True, **changes):
    """Return a case of a rigid wing that flaps about the body's axis with a pitch that changes along the beat."""
    about = {"name": "flapping", "mass": 0.05, "density": 1.2, "gravity": 9.81, "mirrored": True, "periodic": True}
    about |= {"frequency": 8.0, "speed": 4.0, "mean_force": (0.1, 0.5)} | changes
    times = np.arange(count) / count / about["frequency"]
    omega = 2 * math.pi * about["frequency"]
    flap, flap_rate = 0.8 * np.cos(omega * times) + 0.1, -0.8 * omega * np.sin(omega * times)
    pitch, pitch_rate = 0.3 * np.sin(omega * times) + 0.1, 0.3 * omega * np.cos(omega * times)
    zero = np.zeros_like(times)
    outward = np.stack([zero, np.cos(flap), np.sin(flap)], -1)
    upward = np.stack([zero, -np.sin(flap), np.cos(flap)], -1)
    forward = np.stack([zero + 1.0, zero, zero], -1)
    ahead = np.cos(pitch)[:, None] * forward + np.sin(pitch)[:, None] * upward
    normal = -np.sin(pitch)[:, None] * forward + np.cos(pitch)[:, None] * upward
    radius = (np.arange(strips) + 0.5) * semi_span / strips
    place = radius[None, :, None] * outward[:, None]
    velocity = radius[None, :, None] * (flap_rate[:, None] * upward)[:, None]
    # The chord turns by its pitch and with the flap, whose axis lies forward.
    turned = pitch_rate[:, None] * normal + flap_rate[:, None] * np.sin(pitch)[:, None] * -outward
    rear = velocity - 0.5 * chord * turned[:, None]
    advance = np.array([about["speed"], 0.0, 0.0])
    return StripCase(
        times=times,
        position=place + times[:, None, None] * advance,
        chord=np.broadcast_to(chord * ahead[:, None], place.shape).copy(),
        area=np.full(place.shape[:2], chord * semi_span / strips),
        velocity=velocity + advance if velocities else None,
        rear_velocity=rear + advance if velocities else None,
        **about,
    )


def both_wings(case: StripCase) -> StripCase:
    """Return a mirrored case with the strips of the other wing in place of the mirror."""
    mirror = np.array([1.0, -1.0, 1.0])

    def doubled(values):
        return None if values is None else np.concatenate([values[:, ::-1] * mirror, values], axis=1)

    return dataclasses.replace(
        case,
        mirrored=False,
        position=doubled(case.position),
        chord=doubled(case.chord),
        velocity=doubled(case.velocity),
        rear_velocity=doubled(case.rear_velocity),
        area=np.concatenate([case.area[:, ::-1], case.area], axis=1),
    )


def strips_text(case: StripCase) -> str:
    """Return the table of strips of a case."""
    head = "time_s,strip,x_m,y_m,z_m,chord_x_m,chord_y_m,chord_z_m,area_m2"
    parts = [case.position, case.chord, case.area[..., None]]
    if case.velocity is not None:
        head, parts = f"{head},vx_m_s,vy_m_s,vz_m_s", [*parts, case.velocity]
    if case.rear_velocity is not None:
        head, parts = f"{head},v3x_m_s,v3y_m_s,v3z_m_s", [*parts, case.rear_velocity]
    numbers = np.concatenate(parts, axis=-1)
    rows = [
        ",".join([f"{time:.17g}", str(k), *(f"{value:.17g}" for value in numbers[i, k])])
        for i, time in enumerate(case.times)
        for k in range(case.area.shape[1])
    ]
    return "\n".join([head, *rows]) + "\n"


def forces_text(case: StripCase) -> str:
    """Return the table of forces of a case."""
    columns = {f"{axis}_n": values for axis, values in case.forces.items()}
    columns |= {f"{axis}_n_se": values for axis, values in case.errors.items()}
    rows = [
        ",".join(f"{value:.17g}" for value in (time, *(values[i] for values in columns.values())))
        for i, time in enumerate(case.times)
    ]
    return "\n".join([",".join(["time_s", *columns]), *rows]) + "\n"


def case_text(case: StripCase) -> str:
    """Return the TOML of a case."""
    numbers = ("mass", "density", "gravity", "frequency", "speed")
    lines = [f'name = "{case.name}"', *(f"{name} = {getattr(case, name)!r}" for name in numbers)]
    lines += [f"{name} = {str(getattr(case, name)).lower()}" for name in ("mirrored", "periodic")]
    lines += ['strips = "strips.csv"']
    lines += ['forces = "forces.csv"'] if case.forces else [f"mean_force = {list(case.mean_force or ())!r}"]
    lines += [f"from = {case.start!r}"] * (case.start is not None) + [f"to = {case.end!r}"] * (case.end is not None)
    lines += [f'wing = "{case.wing}"'] * (case.wing is not None)
    return "\n".join(lines) + "\n"


def write_case(case: StripCase, folder: Path) -> Path:
    """Write the files of a case into a folder, and return the path of its case.toml."""
    folder.mkdir(exist_ok=True)
    (folder / "strips.csv").write_text(strips_text(case))
    if case.forces:
        (folder / "forces.csv").write_text(forces_text(case))
    path = folder / "case.toml"
    path.write_text(case_text(case))
    return path
