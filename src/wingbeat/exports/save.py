"""`export`: writes the gait of an orbit for another tool, in the format that the suffix names."""

from __future__ import annotations

import os
from os import PathLike
from typing import TYPE_CHECKING

from wingbeat._base import FaultList, write_atomically
from wingbeat.exports.gait import gait_csv, gait_mat, gait_of, write_c3d
from wingbeat.exports.mujoco_flight import mujoco_xml
from wingbeat.exports.robot import joint_trajectory, sdf, urdf
from wingbeat.orbits.options import check_certified

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit

SAMPLES = 256
_WRITERS = {
    **{".csv": gait_csv, ".mat": gait_mat, ".xml": mujoco_xml},
    **{".urdf": urdf, ".sdf": sdf, ".yaml": joint_trajectory},
}
EXPORT_SUFFIXES = (*_WRITERS, ".c3d")
# As many as `simulate` allows in a beat; MuJoCo 3 reads no more than 500 numbers in a row.
_MOST_SAMPLES = {".xml": 499}
_MOST = 4096


def check_export(faults: FaultList, where: str, path: str | PathLike[str], samples: int) -> None:
    """Note a fault unless the suffix of a file name is that of a format for gaits, which can hold the samples."""
    suffix = os.path.splitext(path)[1].lower()
    faults.whole("samples", samples, 2, _MOST_SAMPLES.get(suffix, _MOST), "equal phases of one beat")
    if suffix not in EXPORT_SUFFIXES:
        fix = (
            "end the name in .csv, .mat (MATLAB), .c3d (motion capture), .xml (MuJoCo), .urdf, .sdf (Gazebo) or "
            ".yaml (ROS 2)"
        )
        if suffix == ".nc":
            fix += "; an orbit is saved as .nc by `wingbeat orbit -o`"
        faults.add(where, os.fspath(path), "does not end in a suffix for a gait", fix)


def export(orbit: Orbit, path: str | PathLike[str], samples: int = SAMPLES) -> None:
    """Write the gait of a certified orbit for another tool; the suffix of the file's name sets the format.

    ====== ===================================================================================
    suffix content
    ====== ===================================================================================
    .csv   angles, rates, accelerations, torques and power of one wing, a row per phase
    .mat   the same as structures with time, which Simulink's From Workspace takes
    .c3d   points of body and wings in the world, a frame per phase; needs the extra ``c3d``
    .xml   a MuJoCo model with body, wings, motors, pitch springs and the gait as keyframe and table
    .urdf  links with mass and inertia, joints with limits, for ROS and other robotics
    .sdf   the same for Gazebo
    .yaml  one beat as a message trajectory_msgs/msg/JointTrajectory of ROS 2
    ====== ===================================================================================

    `Orbit.save` is for all results of an orbit, as they were computed; `export` is for the motion alone, sampled at
    equal phases.

    Parameters
    ----------
    orbit : a certified orbit.
    path : of the file to write.
    samples : number of equal phases of the beat; .urdf and .sdf have no table and need none.

    Raises
    ------
    InvalidInputError : another suffix, an orbit that is not certified or whose wake does not repeat with the lag
        of the wake, a pitch hinge that no joint stands for (.xml, .urdf, .sdf, .yaml), samples that are not a whole
        number from 2 to 4096 (for .xml from 2 to 499).
    FileError : the file cannot be written; .c3d without the extra.

    >>> import tempfile, pathlib, wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     wb.export(orbit, pathlib.Path(folder) / "gait.csv", samples=100)
    ...     len((pathlib.Path(folder) / "gait.csv").read_text().splitlines()) > 100
    True
    """
    faults = FaultList()
    check_export(faults, "path", path, samples)
    check_certified(faults, orbit.status, "export a certified orbit")
    faults.raise_if_any()
    suffix = os.path.splitext(path)[1].lower()
    if suffix == ".c3d":
        write_c3d(orbit, samples, path)
    else:
        write_atomically(path, _WRITERS[suffix](gait_of(orbit, samples)))
