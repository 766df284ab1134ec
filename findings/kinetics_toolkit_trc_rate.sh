#!/usr/bin/env bash
# One would guess: the DataRate of a .trc file that a library of motion analysis writes is the frames per second.
# What happens: Kinetics Toolkit 0.17 divides the number of frames by the first time step, so 60 frames at 240 Hz state
# 14400 Hz, and rounds times to a millisecond, so that the usual step states 250 Hz. Neither is the camera's rate.
# Where it bites: filters, resampling and velocities downstream that take either number from the file.
set -euo pipefail
command -v python3 >/dev/null || { echo "install python3 and python3-venv"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env || { echo "install python3-venv"; exit 77; }
env/bin/pip install -q --disable-pip-version-check "kineticstoolkit==0.17.0" "numpy==2.4.6" "pandas==3.0.3"
cat >rate.py <<'PY'
from importlib.metadata import version

import kineticstoolkit as ktk
import numpy as np

FRAMES, RATE = 60, 240.0
print("kineticstoolkit", version("kineticstoolkit"))
markers = ktk.TimeSeries(time=np.arange(FRAMES) / RATE)
markers = markers.add_data("tip", np.column_stack([np.zeros((FRAMES, 2)), np.arange(FRAMES) / 100, np.ones(FRAMES)]))
markers = markers.add_data_info("tip", "Unit", "m")
ktk.kinematics.write_trc_file(markers, "tip.trc")
lines = open("tip.trc").read().splitlines()
stated = float(lines[2].split("\t")[0])
times = np.array([float(line.split("\t")[1]) for line in lines[6:]])
usual = 1 / np.median(np.diff(times))
print(f"camera {RATE:g} Hz; DataRate {stated:g}; first times {times[:4].tolist()}, usual step {usual:g} Hz")
assert abs(stated - FRAMES * RATE) < 1e-3, "DataRate is no longer the number of frames times the rate"
assert abs(usual - 250) < 1e-6, "times are no longer rounded to a millisecond"
PY
env/bin/python rate.py
