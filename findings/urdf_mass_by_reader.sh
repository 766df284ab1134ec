#!/usr/bin/env bash
# One would guess: all readers of one URDF find the same mass, that of its links.
# What happens: for a robot of 0.33 kg, whose body of 0.3 kg holds a frame without <inertial>, Pinocchio finds 0.33 kg,
# MuJoCo 0.03 kg, because it welds the root link to the world and drops its mass without a word, and PyBullet 1.33 kg,
# because it gives the frame 1 kg. PyBullet also replaces each <inertia> by that of the collision shapes, unless
# URDF_USE_INERTIA_FROM_FILE is given.
# Where it bites: anything that flies, swims or walks. In MuJoCo, write <mujoco><compiler fusestatic="false"/></mujoco>
# into the file and add a free joint; for PyBullet, give every link an <inertial>.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "mujoco==4.0.0" "pybullet==3.2.7" "pin==4.1.0" "numpy==2.4.6"
env/bin/python - 2>messages <<'PY'
import sys
from pathlib import Path

import mujoco
import pinocchio
import pybullet

LINK = '<inertial><mass value="{}"/><inertia ixx="1e-3" iyy="1e-3" izz="1e-3" ixy="0" ixz="0" iyz="0"/></inertial>'
Path("robot.urdf").write_text(f"""<robot name="robot">
  <link name="body">{LINK.format(0.3)}</link>
  <link name="frame"/>
  <link name="wing">{LINK.format(0.03)}</link>
  <joint name="fixed" type="fixed"><parent link="body"/><child link="frame"/></joint>
  <joint name="flap" type="revolute"><parent link="body"/><child link="wing"/>
    <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>""")
mass = {}
model = pinocchio.buildModelFromUrdf("robot.urdf", pinocchio.JointModelFreeFlyer())
mass["Pinocchio"] = sum(inertia.mass for inertia in model.inertias)
mass["MuJoCo"] = float(mujoco.MjModel.from_xml_path("robot.urdf").body_mass.sum())
pybullet.connect(pybullet.DIRECT)
found = {}
for flag in (0, pybullet.URDF_USE_INERTIA_FROM_FILE):
    robot = pybullet.loadURDF("robot.urdf", flags=flag)
    links = [pybullet.getDynamicsInfo(robot, i) for i in range(-1, pybullet.getNumJoints(robot))]
    mass["PyBullet"], found[flag] = sum(link[0] for link in links), links[0][2][0]
print(f"MuJoCo {mujoco.__version__}, Pinocchio {pinocchio.__version__}, PyBullet 3.2.7, mass [kg] of 0.33: {mass}")
print(f"PyBullet, inertia of the body in place of 1e-3: {found[0]:.1e}; with the flag: {found[flag]:.1e}")
as_described = abs(mass["Pinocchio"] - 0.33) < 1e-9 and abs(mass["MuJoCo"] - 0.03) < 1e-9
as_described &= abs(mass["PyBullet"] - 1.33) < 1e-9 and found[0] < 1e-6 and abs(found[flag] - 1e-3) < 1e-9
sys.exit(not as_described)
PY
