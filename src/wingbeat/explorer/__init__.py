"""The explorer: what it shows of an orbit, and a folder of plain files that is an explorer without a server."""

from wingbeat.explorer.face import face_of
from wingbeat.explorer.lattice import default_speeds, point_of, solve_lattice
from wingbeat.explorer.measured import measured_points
from wingbeat.explorer.models import LATTICE_MODELS
from wingbeat.explorer.page import write_explorer

__all__ = [
    "LATTICE_MODELS",
    "default_speeds",
    "face_of",
    "measured_points",
    "point_of",
    "solve_lattice",
    "write_explorer",
]


def __dir__() -> list[str]:
    return sorted(__all__)
