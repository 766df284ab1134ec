#!/usr/bin/env bash
# One would guess: a program that writes a polar into an AeroDyn airfoil file writes the angles that it was given.
# What happens: openfast_io 5.0 sets the first angle to -180 and the last to 180 degrees and gives the first row the
# lift, drag and moment of the last, whatever the angles were. It prints a sentence; the file says nothing. A polar from
# -10 to 12 degrees so has the lift of 12 degrees at -180, and loses both ends of its range.
# Where it bites: measured or XFOIL polars that are written for AeroDyn before they are extended to the full circle.
set -euo pipefail
command -v python3 >/dev/null || { echo "install python3 and python3-venv"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env || { echo "install python3-venv"; exit 77; }
env/bin/pip install -q --disable-pip-version-check "openfast-io==5.0.0" "numpy==2.4.6"
cat >ends.py <<'PY'
from importlib.metadata import version

import numpy as np
from openfast_io.FAST_writer import InputWriter_OpenFAST

print("openfast-io", version("openfast-io"))
alpha = np.arange(-10.0, 13.0, 2.0)
lift = 2 * np.pi * np.radians(alpha)
polar = {
    "InterpOrd": "DEFAULT", "NonDimArea": 1, "NumCoords": "0", "NumTabs": 1, "Re": 5e4, "UserProp": 0,
    "InclUAdata": False, "NumAlf": len(alpha), "Alpha": alpha.copy(), "Cl": lift.copy(),
    "Cd": 0.02 + 0.03 * lift**2, "Cm": 0 * lift, "Cpmin": 0 * lift,
}
writer = InputWriter_OpenFAST()
writer.FAST_runDirectory, writer.FAST_namingOut = ".", "wing"
columns = {"InCol_Alfa": 1, "InCol_Cl": 2, "InCol_Cd": 3, "InCol_Cm": 4, "InCol_Cpmin": 0}
writer.fst_vt = {"AeroDyn": {"af_data": [[polar]], "AFTabMod": 1, **columns}}
writer.write_AeroDynPolar()
lines = open("Airfoils/wing_AeroDyn_Polar_00.dat").read().splitlines()
rows = np.array([[float(cell) for cell in line.split()] for line in lines[-len(alpha) :]])
print("given:  ", alpha[[0, 1, -2, -1]], lift[[0, 1, -2, -1]].round(3))
print("written:", rows[[0, 1, -2, -1], 0], rows[[0, 1, -2, -1], 1].round(3))
assert rows[0, 0] == -180 and rows[-1, 0] == 180, "the ends are no longer moved"
assert np.isclose(rows[0, 1], lift[-1]), "the first row no longer has the lift of the last"
PY
env/bin/python ends.py
