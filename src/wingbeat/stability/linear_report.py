"""What a linear flight and its modes say to a reader, as the blocks of a report."""

from __future__ import annotations

import math
from typing import Any

from wingbeat._base import Line, Report, grouped

# What moves in a mode, as pages and screens name it.
MOVING = {"body_pitch": "body pitch", "u": "u", "w": "w", "pitch_rate": "pitch rate"}


def linear_report(record: dict[str, Any]) -> Report:
    """Return the verdict, the numbers of each mode, and the verdict of the averaged model.

    Parameters
    ----------
    record : of `LinearFlight.record`.
    """
    modes = [block for mode in record["modes"] for block in mode_report(mode)]
    return [Line(headline(record), wraps=False), *modes, Line(""), Line(_averaged(record), wraps=False)]


def mode_report(mode: dict[str, Any]) -> Report:
    """Return the numbers of a mode under its kind.

    Parameters
    ----------
    mode : of `Mode.record`.
    """
    return [grouped({mode["kind"]: _rows(mode)})._replace(label_width=0)]


def headline(record: dict[str, Any]) -> str:
    """Return the verdict on one orbit in a line."""
    where = f"{record['species']} at {record['speed']:g} m/s, {record['frequency']:.4g} Hz"
    seconds = record["modes"][0]["time_to_double"]
    if record["stable"] or seconds is None:
        verdict = "stable" if record["stable"] else "unstable"
        return f"{where}: {verdict}, spectral radius {record['spectral_radius']:.3f}"
    return f"{where}: unstable, disturbances double in {seconds:.3g} s ({seconds / record['dt']:.3g} beats)"


def _averaged(record: dict[str, Any]) -> str:
    averaged = record["averaged"]
    kind = averaged["modes"][0]["kind"]
    return (
        f"averaged over the beat, spectral radius {averaged['spectral_radius']:.3f} ({kind}) in place of "
        f"{record['spectral_radius']:.3f} ({record['modes'][0]['kind']})"
    )


def _rows(mode: dict[str, Any]) -> list[tuple[str, str]]:
    """Return what is said of a mode."""
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
    return rows
