#!/usr/bin/env bash
# One would guess that points in three dimensions that one library of animal tracking writes without a word are read
# by another as they are, or refused. movement 0.15 saves points with x, y and z in the layout of SLEAP's analysis
# files; sleap-io 0.9.5, the reader of that layout, returns x and y and says nothing. Only movement itself reads the
# third coordinate back. It bites whoever keeps triangulated points in such a file: a wing seen from above is taken
# for the whole.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
command -v python3 >/dev/null || { echo "install python3"; exit 77; }
python3 -m venv env
env/bin/python -m pip install --quiet "movement==0.15.0" "sleap-io==0.9.5"
env/bin/python - <<'PYTHON'
import warnings

import h5py
import numpy as np

warnings.simplefilter("error", UserWarning)
import movement
import sleap_io
from movement.io import load_poses, save_poses

print("movement", movement.__version__, "sleap-io", sleap_io.__version__)
points = np.random.default_rng(0).normal(size=(20, 3, 2, 1))  # time, space, keypoints, individuals
data = load_poses.from_numpy(
    points, np.ones((20, 2, 1)), individual_names=["bird"], keypoint_names=["shoulder", "tip"], fps=240
)
save_poses.to_sleap_analysis_file(data, "points.h5")
with h5py.File("points.h5") as file:
    written = file["tracks"].shape
back = load_poses.from_sleap_file("points.h5", fps=240).position.shape
read = sleap_io.load_file("points.h5").numpy().shape
print("written (track, space, node, frame):", written)
print("read by movement (time, space, keypoints, individuals):", back)
print("read by sleap-io (frame, track, node, space):", read)
assert written == (1, 3, 2, 20)
assert back == (20, 3, 2, 1)
assert read == (20, 1, 2, 2)
PYTHON
