#!/usr/bin/env bash
# NumPy's savetxt writes the names of columns behind "# ". One would guess that readers which know comments either read
# these names or refuse the table. NumPy's own genfromtxt reads them; pandas with comment="#" and polars with
# comment_prefix="#" drop them, take the first row of numbers for the names, and lose it: one frame of a film, or one
# sample of a record, without a warning. A decimal comma is worse: genfromtxt makes each such cell NaN, as silently.
# It bites whoever hands tables of measurements from NumPy to pandas, polars or wingbeat (which refuses the file).
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet numpy==2.3.5 pandas==2.3.3 polars==1.35.2
cd "$folder"
venv/bin/python - <<'PYTHON'
import warnings
import numpy as np
import pandas
import polars

warnings.simplefilter("error")
print("numpy", np.__version__, "pandas", pandas.__version__, "polars", polars.__version__)
table = np.array([[0.0, 48.5], [0.1, 47.1], [0.2, 41.5]])
np.savetxt("film.csv", table, fmt="%.1f", delimiter=",", header="time,flap_deg")
own = np.genfromtxt("film.csv", delimiter=",", names=True)
frame = pandas.read_csv("film.csv", comment="#")
quick = polars.read_csv("film.csv", comment_prefix="#")
print("genfromtxt:", own.dtype.names, len(own), "rows")
print("pandas:", list(frame.columns), len(frame), "rows")
print("polars:", quick.columns, len(quick), "rows")
assert own.dtype.names == ("time", "flap_deg") and len(own) == 3
assert list(frame.columns) == ["0.0", "48.5"] and len(frame) == 2
assert quick.columns == ["0.0", "48.5"] and len(quick) == 2
with open("comma.csv", "w") as file:
    file.write("time;flap_deg\n0,0;48,5\n0,1;47,1\n")
comma = np.genfromtxt("comma.csv", delimiter=";", names=True)
print("genfromtxt of decimal commas:", comma.tolist())
assert np.isnan(comma["time"]).all() and np.isnan(comma["flap_deg"]).all()
PYTHON
