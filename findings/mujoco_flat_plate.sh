#!/usr/bin/env bash
# One would guess: a thin plate, whose inertias obey Ixx + Iyy = Izz, is a body for MuJoCo like any other.
# What happens: MuJoCo checks A + B >= C of the principal inertias without tolerance. If the plate's axes are not its
# principal ones, rounding decides: it refuses one plate in five, "inertia must satisfy A + B >= C".
# Where it bites: wings, fins and panels from formulas; a design loads, the next one does not. balanceinertia makes
# a sphere of the body; adding 1e-13 of Izz to Ixx and Iyy keeps it a plate.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "mujoco==4.0.0" "numpy==2.4.6"
env/bin/python - <<'PY'
import sys

import mujoco
import numpy as np

TEXT = """<mujoco><worldbody><body><joint type="hinge"/>
<inertial pos="0 0 0" mass="0.03" fullinertia="{} {} {} {} 0 0"/></body></worldbody></mujoco>"""
rng, refused = np.random.default_rng(0), {}
for share in (0.0, 1e-13):
    refused[share] = 0
    for _ in range(300):
        along, across = rng.uniform(0.5, 1.0, 2) * 1e-4
        product = rng.uniform(-0.5, 0.5) * np.sqrt(along * across)
        flat = float(along + across)
        try:
            mujoco.MjModel.from_xml_string(
                TEXT.format(float(along) + share * flat, float(across) + share * flat, flat, float(product))
            )
        except ValueError as error:
            assert "A + B >= C" in str(error), error
            refused[share] += 1
print(f"MuJoCo {mujoco.__version__}, refused of 300 plates, by the share of Izz that is added: {refused}")
sys.exit(not (refused[0.0] > 30 and refused[1e-13] == 0))
PY
