#!/usr/bin/env bash
# One would guess: a file of coordinates as the airfoil sites offer it is read, or refused.
# What happens: in Lednicer's order (a line with two counts, then both sides from the nose) the counts are taken for a
# point. The drag coefficient of a NACA 4412 at 5 degrees becomes 1e104 without an error; the confidence is 0.
# Where it bites: airfoil sites hold files of both orders, and a loop over them is not looked at one by one.
set -euo pipefail
command -v python3 >/dev/null || { echo "install python3 and python3-venv"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env || { echo "install python3-venv"; exit 77; }
env/bin/pip install -q --disable-pip-version-check "neuralfoil==0.3.3" "aerosandbox==4.2.10" "numpy==2.3.5"
env/bin/python -W ignore - <<'PY'
from importlib.metadata import version

import aerosandbox
import neuralfoil

outline = aerosandbox.Airfoil("naca4412").coordinates
half = len(outline) // 2 + 1
upper, lower = outline[:half][::-1], outline[half - 1 :]
orders = {
    "selig": "NACA 4412\n" + "".join(f"{x:.6f} {y:.6f}\n" for x, y in outline),
    "lednicer": f"NACA 4412\n{len(upper)}. {len(lower)}.\n\n"
    + "".join(f"{x:.6f} {y:.6f}\n" for x, y in upper)
    + "\n"
    + "".join(f"{x:.6f} {y:.6f}\n" for x, y in lower),
}
found = {}
for order, text in orders.items():
    with open(f"{order}.dat", "w") as file:
        file.write(text)
    found[order] = neuralfoil.get_aero_from_dat_file(f"{order}.dat", alpha=5.0, Re=1e5)
    print(order, {key: float(found[order][key][0]) for key in ("CL", "CD", "analysis_confidence")})
print("neuralfoil", version("neuralfoil"), "aerosandbox", version("aerosandbox"))
assert 0.9 < found["selig"]["CL"][0] < 1.1 and found["selig"]["CD"][0] < 0.03
assert found["lednicer"]["CD"][0] > 1e6 and found["lednicer"]["analysis_confidence"][0] < 0.01
PY
