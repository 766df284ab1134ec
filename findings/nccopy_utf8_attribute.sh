#!/usr/bin/env bash
# One would guess: a text attribute in UTF-8 is the same text after nccopy, whoever reads the copy.
# What happens: the bytes stay, but netCDF's C library labels them ASCII. h5netcdf believes the label and returns each
# byte beyond ASCII as a lone surrogate, which cannot be printed or hashed as UTF-8. Without the copy it reads UTF-8.
# Where it bites: units and labels such as "°", "m²" or "ψ" in NetCDF-4 files that passed through nccopy, NCO or CDO.
set -euo pipefail
for program in python3 nccopy; do
  command -v "$program" >/dev/null || { echo "install python3, python3-venv and netcdf-bin"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv || { echo "install python3-venv"; exit 77; }
venv/bin/pip install --quiet h5netcdf==1.8.1 h5py==3.15.1 numpy==2.3.5
cat >attribute.py <<'PY'
import sys

import h5netcdf
import h5py
import numpy as np

print(f"h5netcdf {h5netcdf.__version__}, h5py {h5py.__version__}")
label = "pitch ψ [°]"
if len(sys.argv) == 1:
    with h5netcdf.File("own.nc", "w") as file:
        file.dimensions = {"time": 2}
        file.create_variable("pitch", ("time",), float)[:] = 0.0
    with h5py.File("own.nc", "r+") as file:
        text = label.encode()
        file["pitch"].attrs.create("long_name", np.array(text, h5py.string_dtype("utf-8", len(text))))
    sys.exit()
with h5netcdf.File("own.nc", "r") as own, h5netcdf.File("copy.nc", "r") as copy:
    before, after = (file.variables["pitch"].attrs["long_name"] for file in (own, copy))
print("own: ", ascii(before))
print("copy:", ascii(after))
same = after.encode("utf-8", "surrogateescape") == before.encode()
sys.exit(0 if before == label and after != label and same else "the behaviour has changed")
PY
venv/bin/python attribute.py
nccopy own.nc copy.nc
ncdump -h own.nc | grep long_name || true
venv/bin/python attribute.py copy
