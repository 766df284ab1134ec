#!/usr/bin/env bash
# One would guess: NeuralFoil takes any angle of attack, and what it gives beyond the stall is at least a plate's drag.
# What happens: at 90 degrees its drag coefficient of a NACA 0012 is below 0.1, where a plate has about 2. No warning
# comes; only the key analysis_confidence, which is 0 there, says so. AeroSandbox's method of the airfoil adds the
# separated flow (include_360_deg_effects): 2.1, at the same confidence of 0.
# Where it bites: flapping wings, rotors at rest, gliders on a winch: whatever meets air across the wing.
set -euo pipefail
command -v python3 >/dev/null || { echo "install python3 and python3-venv"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env || { echo "install python3-venv"; exit 77; }
env/bin/pip install -q --disable-pip-version-check "neuralfoil==0.3.3" "aerosandbox==4.2.10" "numpy==2.3.5"
env/bin/python - <<'PY'
from importlib.metadata import version

import aerosandbox
import neuralfoil
import numpy as np

section, angles = aerosandbox.Airfoil("naca0012"), np.array([8.0, 90.0])
plain = neuralfoil.get_aero_from_airfoil(section, alpha=angles, Re=3e4)
whole = section.get_aero_from_neuralfoil(alpha=angles, Re=3e4, mach=0.0, include_360_deg_effects=True)
print("neuralfoil", version("neuralfoil"), "aerosandbox", version("aerosandbox"))
for name, found in (("neuralfoil", plain), ("aerosandbox", whole)):
    print(name, "C_D at 8 and 90 deg", np.round(found["CD"], 3), "confidence", np.round(found["analysis_confidence"], 2))
assert plain["CD"][1] < 0.1 and plain["analysis_confidence"][1] < 0.01
assert whole["CD"][1] > 1
PY
