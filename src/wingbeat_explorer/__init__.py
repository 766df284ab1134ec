"""The explorer: what it shows of an orbit, and a folder of plain files that is an explorer without a server."""

from wingbeat_explorer.face_data import face_of, measured_points
from wingbeat_explorer.folder import write_explorer
from wingbeat_explorer.lattice import default_speeds, point_of, solve_lattice
from wingbeat_explorer.models import LATTICE_MODELS

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
