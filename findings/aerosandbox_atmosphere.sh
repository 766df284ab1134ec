#!/usr/bin/env bash
# One would guess: Atmosphere(altitude=9000) of AeroSandbox is the standard atmosphere at a height of 9000 m.
# What happens: the default method, "differentiable", is a smooth fit that misses the standard (method="isa") by up to
# 1.4 % in density and 3.2 K up to 11 km; and both take geopotential altitude, where ambiance and fluids take geometric
# height, which is another 0.15 % in density at 9000 m.
# Where it bites: densities and Reynolds numbers at altitude that are compared between programs or with the table.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "aerosandbox==4.2.10" "ambiance==1.3.1" "numpy==2.4.6"
env/bin/python - <<'PY'
import sys
from importlib.metadata import version

import aerosandbox as asb
import ambiance
import numpy as np

heights = np.arange(0.0, 11001.0, 250.0)
default, isa = asb.Atmosphere(altitude=heights), asb.Atmosphere(altitude=heights, method="isa")
geometric = ambiance.Atmosphere(heights)
share = 100 * (default.density() / isa.density() - 1)
kelvin = default.temperature() - isa.temperature()
worst = int(np.abs(share).argmax())
print(f"AeroSandbox {version('aerosandbox')}, ambiance {version('ambiance')}")
print(f"default less isa: density {share[worst]:+.2f} % at {heights[worst]:.0f} m, temperature up to {np.abs(kelvin).max():.2f} K")
at = int(np.flatnonzero(heights == 9000.0)[0])
other = 100 * (geometric.density[at] / isa.density()[at] - 1)
print(f"at 9000: isa {isa.density()[at]:.5f} kg/m3, ambiance {geometric.density[at]:.5f} kg/m3 ({other:+.2f} %)")
sys.exit(not (abs(share[worst]) > 0.5 and np.abs(kelvin).max() > 1.0 and 0.1 < other < 0.2))
PY
