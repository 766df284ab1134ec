#!/usr/bin/env bash
# One would guess: a joint without a limit of its torque is written effort="inf" in URDF, or without the attribute.
# What happens: MuJoCo and yourdfpy read "inf"; urdfdom, the parser of ROS (here in Pinocchio), refuses the file.
# Without the attribute, urdfdom refuses it as well, and MuJoCo takes it as unlimited. effort="0", which is no torque
# to a controller, is unlimited to MuJoCo too.
# Where it bites: a file that one reader accepts does not start a robot. Write a large number, such as 1e9.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "mujoco==4.0.0" "pin==4.1.0" "yourdfpy==0.0.60" "numpy==2.4.6"
env/bin/python - 2>messages <<'PY'
import sys
from pathlib import Path

import mujoco
import pinocchio
import yourdfpy

LINK = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
READERS = {
    "MuJoCo": lambda: mujoco.MjModel.from_xml_path("robot.urdf").jnt_actfrcrange[0, 1],
    "urdfdom": lambda: pinocchio.buildModelFromUrdf("robot.urdf").upperEffortLimit[0],
    "yourdfpy": lambda: yourdfpy.URDF.load("robot.urdf").joint_map["flap"].limit.effort,
}
found, unlimited = {}, {}
for effort in ('effort="inf"', "", 'effort="0"', 'effort="1e9"'):
    Path("robot.urdf").write_text(f"""<robot name="robot"><link name="body">{LINK}</link><link name="wing">{LINK}</link>
      <joint name="flap" type="revolute"><parent link="body"/><child link="wing"/>
      <axis xyz="1 0 0"/><limit lower="-1" upper="1" velocity="1" {effort}/></joint></robot>""")
    for reader, read in READERS.items():
        try:
            value = read()
            found[effort, reader] = None if value is None else float(value)
        except ValueError:
            found[effort, reader] = "refused"
    unlimited[effort] = not mujoco.MjModel.from_xml_path("robot.urdf").jnt_actfrclimited[0]
    print(effort or "no effort", {reader: found[effort, reader] for reader in READERS})
print(f"MuJoCo {mujoco.__version__}, Pinocchio {pinocchio.__version__}, yourdfpy 0.0.60; in MuJoCo, 0 is unlimited")
expected = {"inf": [float("inf"), "refused", float("inf")], "": [0.0, "refused", None], "0": [0.0] * 3}
expected["1e9"] = [1e9] * 3
sys.exit([unlimited[effort] for effort in ("", 'effort="0"', 'effort="1e9"')] != [True, True, False] or list(found.values()) != [value for values in expected.values() for value in values])
PY
