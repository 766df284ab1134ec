"""What the results of stability say to a reader: blocks of reports, each from the `record` of a result."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from wingbeat._base import Line, Report, Row, Table, grouped
from wingbeat.animal.kinematics import ANGLES
from wingbeat.stability.servos import SLOWING

# What moves in a mode, as pages and screens name it.
MOVING = {"body_pitch": "body pitch", "u": "u", "w": "w", "pitch_rate": "pitch rate"}
MOVING |= {"hinge_angle": "hinge angle", "hinge_rate": "hinge rate"}
# How the state is shown: label, and the size of the unit in SI units.
STATE_UNITS = {
    "z": ("z [m]", 1.0),
    "body_pitch": ("pitch [deg]", math.radians(1.0)),
    "u": ("u [m/s]", 1.0),
    "w": ("w [m/s]", 1.0),
    "pitch_rate": ("rate [deg/s]", math.radians(1.0)),
}
# Parameters of `causes_report`.
_MOST = 10


def linear_report(record: dict[str, Any]) -> Report:
    """Return the verdict, the numbers of each mode, and the verdict of the averaged model."""
    modes = [block for mode in record["modes"] for block in mode_report(mode)]
    averaged, whole = (
        f"{part['spectral_radius']:.3f} ({part['modes'][0]['kind']})" for part in (record["averaged"], record)
    )
    last = f"averaged over the beat, spectral radius {averaged} in place of {whole}"
    return [Line(headline(record), wraps=False), *modes, Line(""), Line(last, wraps=False)]


def headline(record: dict[str, Any]) -> str:
    """Return the verdict on one orbit in a line."""
    where = f"{record['species']} at {record['speed']:g} m/s, {record['frequency']:.4g} Hz"
    seconds = record["modes"][0]["time_to_double"]
    if record["stable"] or seconds is None:
        verdict = "stable" if record["stable"] else "unstable"
        return f"{where}: {verdict}, spectral radius {record['spectral_radius']:.3f}"
    return f"{where}: unstable, disturbances double in {seconds:.3g} s ({seconds / record['dt']:.3g} beats)"


def mode_report(mode: dict[str, Any]) -> Report:
    """Return the numbers of a mode under its kind."""
    real, imaginary = mode["multiplier"]
    rows = [("multiplier", f"{real:.3f}" + (f" ± {imaginary:.3f}i" if mode["kind"] == "oscillation" else ""))]
    for label, name in (("doubles in", "time_to_double"), ("halves in", "time_to_half")):
        if mode[name] is not None:
            # A multiplier of 0 ends a disturbance within the beat.
            beats = math.log(2) / abs(math.log(mode["modulus"])) if mode["modulus"] > 0 else 0.0
            rows.append((label, f"{mode[name]:.3g} s ({beats:.3g} beats)"))
    if mode["period"] is not None:
        rows.append(("period", f"{mode['period']:.3g} s"))
        rows.append(("damping ratio", "-" if mode["damping"] is None else f"{mode['damping']:.2g}"))
    parts = sorted(mode["shares"].items(), key=lambda part: -part[1])
    rows.append(("what moves", ", ".join(f"{MOVING[name]} {share:.0%}" for name, share in parts)))
    return [grouped({mode["kind"]: rows})._replace(label_width=0)]


def causes_report(record: dict[str, Any]) -> Report:
    """Return the numbers that move the spectral radius most over their plausible ranges."""
    rows = []
    for parameter in record["parameters"][:_MOST]:
        unit, ends, (low, high) = parameter["unit"], parameter["plausible"], parameter["change_to_ends"]
        factor, unit = (math.degrees(1.0), " deg") if unit == "rad" else (1.0, "" if unit == "1" else f" {unit}")
        cells = (
            parameter["parameter"],
            f"{factor * parameter['value']:.4g}{unit}",
            f"{parameter['spectral_radius'] / factor:+.3g}" + (f" per{unit}" if unit else ""),
            "+-1 %" if ends is None else f"{factor * ends[0]:.3g} to {factor * ends[1]:.3g}{unit}",
            f"{low + 0.0:+.2g}, {high + 0.0:+.2g}",
        )
        rows.append(Row(cells))
    return [
        Line(f"what moves the spectral radius {record['spectral_radius']:.3f} most", tone="title"),
        Table(tuple(rows), ("parameter", "value", "derivative", "plausible", "change at both ends"), "nrrrr"),
        Line("the changes are extrapolated linearly: for ranking only"),
        Line("for the share of stable orbits run `wingbeat uncertainty`"),
    ]


def feedback_report(record: dict[str, Any]) -> Report:
    """Return what the feedback does, its gains, and the multipliers with it and without."""
    rows = []
    for name, gains in zip(record["inputs"], record["gains"], strict=True):
        # The gains of pending inputs, behind those of the state, are in the record alone.
        unit, size = ("deg", math.radians(1.0)) if name in ANGLES else ("Hz" if name == "frequency" else "-", 1.0)
        changes = (f"{-gain * one / size:.3g}" for gain, (_, one) in zip(gains, STATE_UNITS.values(), strict=False))
        rows.append(Row((f"{name} [{unit}]", *changes)))
    headings = ("", *(label for label, _ in STATE_UNITS.values()))
    delay = record["delay"]
    where = f"{record['species']} at {record['speed']:g} m/s, {record['frequency']:.4g} Hz"
    acting = f"{beats_of(delay)} later" if delay else "in the same beat"
    first = (
        f"{where}: spectral radius {record['open_loop']['spectral_radius']:.3f} without feedback, "
        f"{record['spectral_radius']:.3f} with feedback that acts {acting}"
    )
    beats = "beat" if delay == 1 else beats_of(delay)
    last = [
        Line(f"and of the inputs of the last {beats}: see --json, whose `gains`"),
        Line("have the opposite sign (inputs = -gains x deviations), SI units and radians"),
    ]
    return [
        Line(first, wraps=False),
        Line(""),
        Line("change of the inputs per unit of"),
        Table(tuple(rows), headings, "n" + "r" * len(STATE_UNITS)),
        *(last if delay else []),
        Line(""),
        Line("multipliers without feedback: " + _numbers(record["open_loop"]["multipliers"]), wraps=False),
        Line("multipliers with feedback:    " + _numbers(record["multipliers"]), wraps=False),
        Line("inputs that suffice alone:    " + (", ".join(record["sufficient"]) or "none"), wraps=False),
    ]


def segment_report(record: dict[str, Any]) -> Report:
    """Return what feedback within a beat does, its servos, and what these leave out."""
    free, held = record["open_loop"]["spectral_radius"], record["spectral_radius"]
    lines = [
        f"{record['species']} at {record['speed']:g} m/s, {record['frequency']:.4g} Hz: "
        f"spectral radius {free:.3f} without feedback, {held:.3f} with feedback",
        f"{record['segments']} samples a beat ({record['sample_rate']:.4g} Hz), "
        f"{1e3 * record['delay_time']:.3g} ms from a measurement to its effect",
    ]
    for name in record["inputs"]:
        low, high, speed, bandwidth = (
            record[key][name] for key in ("lower", "upper", "servo_speed", "servo_bandwidth")
        )
        if low == high:
            lines.append(f"{name}: not moved")
            continue
        quick = "" if speed is None else f", {math.degrees(speed):.4g} deg/s"
        quick += "" if bandwidth is None else f", bandwidth {bandwidth:.3g} Hz"
        if speed is not None and bandwidth is not None and math.isclose(2.0 * math.pi * bandwidth * SLOWING, speed):
            quick += " (a guess from its speed)"
        lines.append(f"{name}: {math.degrees(low):+.3g} to {math.degrees(high):+.3g} deg{quick}")
    if record["imu"] is not None:
        radius = record["estimator"]["spectral_radius"]
        lines.append(f"the state by a Kalman filter from an IMU: its errors have the spectral radius {radius:.3f}")
        if record["imu"]["height"] is None:
            lines.append("No sensor gives the height: it is not held.")
    elif "hinge_angle" in record["state"]:
        lines.append("The angle and rate of the pitch hinge count as measured; --imu estimates them.")
    for name, speed in record["servo_speed"].items():
        own = record["gait_speed"][name]
        if speed is not None and own > speed and record["lower"][name] < record["upper"][name]:
            lines.append(
                f"The gait moves {name} at up to {math.degrees(own):.0f} deg/s: this servo of "
                f"{math.degrees(speed):.0f} deg/s can add to the gait, not make it."
            )
    return [Line(line, wraps=False) for line in lines]


def survey_report(record: dict[str, Any]) -> Report:
    """Return the share of random gusts that were survived with each feedback."""
    shares = tuple(Row((f"  {name}", f"{share:.1%}")) for name, share in record["survived"].items())
    gusts = f"{record['flights']} gusts of up to {record['largest_gust']:.2g} m/s, {beats_of(record['beats'])} each"
    return [Line(f"share survived of {gusts}"), Table(shares, align="lr")]


def beats_of(count: int) -> str:
    """Return a number of beats in words."""
    return f"{count} beat" if count == 1 else f"{count} beats"


def _numbers(pairs: list[list[float]]) -> str:
    """Return the multipliers, one of each complex pair, without those near 0, which belong to pending inputs."""
    return ", ".join(
        f"{real:.3f}" + (f" ± {imaginary:.3f}i" if imaginary > 0 else "")
        for real, imaginary in pairs
        if imaginary >= 0 and math.hypot(real, imaginary) > 5e-4
    )


def manoeuvre_report(record: dict[str, Any]) -> Report:
    """Return how the search ended, the steady flights, and time and distance."""
    rows = []
    for end in record["ends"]:
        free = end["free_frequency"]
        numbers = f"{end['speed']:g}", f"{end['beats']}", f"{end['frequency']:.4g}"
        rows.append(Row((*numbers, "" if free is None else f"{free:.4g}")))
    return [
        Line(f"{record['species']} from {record['speed']:g} m/s: {record['message']}", wraps=False),
        Table(tuple(rows), ("to [m/s]", "beats", "f [Hz]", "least f [Hz]"), "rrrr"),
        *([Line(f"{record['time'][-1]:.2f} s, {record['distance']:.1f} m")] if len(record["time"]) > 1 else []),
    ]


def pairs(values: np.ndarray) -> list[list[float]]:
    """Return complex numbers as pairs of real and imaginary part, fit for JSON."""
    return [[one.real, one.imag] for one in values.astype(complex).tolist()]
