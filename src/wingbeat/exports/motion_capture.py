"""A beat as motion capture: points of body and wings in a C3D file, the format of motion laboratories."""

from __future__ import annotations

from os import PathLike
from typing import NamedTuple

import numpy as np

from wingbeat._base import FileError, install_extra, writing
from wingbeat.exports.gait import Gait
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.wing_points import surface_points


class Points(NamedTuple):
    """Points of a vehicle in the world: labels, and positions (x forward, y left, z up) [m], shape (K, P, 3)."""

    labels: list[str]
    positions: np.ndarray


def check_c3d() -> None:
    """Refuse to write a C3D file without the library that writes it.

    Raises
    ------
    FileError : ezc3d is not installed.
    """
    try:
        import ezc3d  # noqa: F401
    except ImportError:
        raise FileError(f"ezc3d, which writes .c3d, is not installed here: {install_extra('c3d')}") from None


def points_of(gait: Gait) -> Points:
    """Return the points of the beat's K equal phases: body, shoulders, wing tips, and edges at the strips' centres.

    A wing's tip is on its quarter-chord line. Strips are counted from 1 at the root.

    Parameters
    ----------
    gait : the gait.
    """
    problem, strips = gait.orbit.problem, gait.orbit.problem.model.strips
    stations = np.concatenate([[0.0], (np.arange(strips) + 0.5) / strips, [1.0]])
    states, phase = gait.states[:-1], gait.phase[:-1]
    given = problem.vehicle.passive, gait.orbit.wingbeat, State(*states.T), phase
    surface = np.asarray(surface_points(*given, stations, np.array([0.0, 0.25, 1.0])))
    leading, quarter, trailing = (surface[:, row] for row in range(3))
    body = np.stack([states[:, 0], np.zeros(len(states)), states[:, 1]], axis=-1)[:, None]
    left = np.concatenate([quarter[:, [0, -1]], leading[:, 1:-1], trailing[:, 1:-1]], axis=1)
    numbers = range(1, strips + 1)
    names = ["shoulder", "tip", *(f"{edge}_{i}" for edge in ("leading", "trailing") for i in numbers)]
    labels = ["body", *(f"{side}_{name}" for side in ("left", "right") for name in names)]
    return Points(labels, np.concatenate([body, left, left * [1.0, -1.0, 1.0]], axis=1))


def write_c3d(gait: Gait, path: str | PathLike[str]) -> None:
    """Write the points of the beat as a C3D file; its frames are the equal phases, its unit is the metre.

    C3D stores numbers in single precision.

    Parameters
    ----------
    gait : the gait.
    path : of the file to write.

    Raises
    ------
    FileError : without the extra ``c3d``; the file cannot be written.
    """
    check_c3d()
    import ezc3d

    points = points_of(gait)
    file = ezc3d.c3d()
    about = file["parameters"]["POINT"]
    about["RATE"]["value"] = [gait.samples * gait.orbit.wingbeat.frequency]
    about["LABELS"]["value"] = points.labels
    about["DESCRIPTIONS"]["value"] = [label.replace("_", " ") for label in points.labels]
    about["UNITS"]["value"] = ["m"]
    data = np.ones((4, len(points.labels), gait.samples))
    data[:3] = points.positions.transpose(2, 1, 0)
    file["data"]["points"] = data
    with writing(path) as beside:
        file.write(str(beside))
