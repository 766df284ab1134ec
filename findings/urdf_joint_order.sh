#!/usr/bin/env bash
# One would guess: the joints of a model have the order of the URDF, or that of their numbers.
# What happens: MuJoCo and yourdfpy keep the order of the file. Pinocchio, like all that builds on urdfdom, orders the
# joints of a link by name: pitch_1, pitch_10, pitch_2. A free base comes first.
# Where it bites: vectors of positions, gains and torques that go from one program to another by index.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "mujoco==4.0.0" "pin==4.1.0" "yourdfpy==0.0.60" "numpy==2.4.6"
env/bin/python - <<'PY'
import sys
from pathlib import Path

import mujoco
import pinocchio
import yourdfpy

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
names = ["pitch_1", "pitch_2", "pitch_10"]
links = "".join(f'<link name="{name}_link">{INERTIAL}</link>' for name in names)
joints = "".join(
    f'<joint name="{name}" type="revolute"><parent link="body"/><child link="{name}_link"/><axis xyz="0 1 0"/>'
    '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
    for name in names
)
Path("robot.urdf").write_text(f'<robot name="robot"><link name="body">{INERTIAL}</link>{links}{joints}</robot>')
model = mujoco.MjModel.from_xml_path("robot.urdf")
found = {
    "MuJoCo": [model.joint(i).name for i in range(model.njnt)],
    "yourdfpy": list(yourdfpy.URDF.load("robot.urdf").actuated_joint_names),
    "Pinocchio": [name for name in pinocchio.buildModelFromUrdf("robot.urdf").names if name != "universe"],
}
print(f"MuJoCo {mujoco.__version__}, Pinocchio {pinocchio.__version__}, yourdfpy 0.0.60: {found}")
sys.exit(not (found["MuJoCo"] == found["yourdfpy"] == names and found["Pinocchio"] == sorted(names)))
PY
