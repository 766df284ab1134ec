"""``wingbeat export``: a saved orbit for robot controllers, ROS, MATLAB, motion capture and MuJoCo."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from wingbeat._base import FaultList
from wingbeat.cli.arguments import Whole, check_outputs, option, written_to
from wingbeat.cli.problem_options import unpacking
from wingbeat.cli.process import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.exports.robot import GUESSED
from wingbeat.exports.save import SAMPLES, check_export
from wingbeat.exports.save import export as write_gait
from wingbeat.orbits.options import Status
from wingbeat.results.orbit import load_orbit


def export(
    file: Annotated[Path, option("A file written by `orbit -o`.")],
    *,
    output: Annotated[
        Path,
        written_to(
            "The file to write: .csv or .mat for the motion and torques of one wing, .c3d for motion capture, "
            ".xml for MuJoCo, .urdf for ROS and other robotics, .sdf for Gazebo, .yaml for a message of ROS 2."
        ),
    ],
    samples: Annotated[Whole, option("Number of equal phases of the beat; not for .urdf and .sdf.")] = SAMPLES,
) -> int:
    """Write the gait of a saved orbit for another tool.

    .csv: time, angles, rates, accelerations, torques and power of one wing, for a robot's controller. .mat: the
    same for MATLAB and Simulink. .c3d: points of body and wings in the world; needs the extra c3d. .xml: a MuJoCo
    model of the vehicle with the gait as keyframe and table. .urdf, .sdf: links with mass and inertia, joints with
    axes and limits. .yaml: one beat of these joints as a trajectory_msgs/msg/JointTrajectory, for `ros2 topic pub`.
    Units are SI, angles in radians. Exit code 3: the orbit is not certified.

    Examples: wingbeat export pigeon.nc -o gait.csv --samples 200; wingbeat export pigeon.nc -o pigeon.urdf
    """
    faults = FaultList()
    check_export(faults, "--output", output, samples)
    faults.raise_if_any()
    orbit = load_orbit(file)
    if orbit.status is not Status.CONVERGED:
        print(f"{file}: {orbit.status.value}: {orbit.message}", file=sys.stderr)
        return EXIT_NOT_CERTIFIED
    with unpacking(file):
        _ = orbit.problem
    check_outputs(output)
    write_gait(orbit, output, samples)
    note = f"; {GUESSED}" if output.suffix.lower() in (".urdf", ".sdf") else ""
    print(f"wrote {output}{note}", file=sys.stderr)
    return EXIT_GOOD
