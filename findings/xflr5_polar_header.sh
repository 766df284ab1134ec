#!/usr/bin/env bash
# One would guess: a polar that XFLR5 exports as text can be read by the names above its columns.
# What happens: two names hold a space ("Top Xtr", "Bot Xtr"), so ten columns look like twelve, and XFLR5 6.61 writes
# twelve numbers below them. pandas finds twelve names and twelve numbers and says nothing: the column "Bot" holds the
# lowest pressure coefficient, "Xtr" the transition on the lower side. Exports of 6.12 have ten numbers: XCp is NaN.
# Where it bites: transition, hinge moment and centre of pressure of any polar read by name. Up to Cm all is well.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "pandas==2.3.3" "numpy==2.3.5"
env/bin/python - <<'PY'
import io

import pandas

head = "  alpha     CL        CD       CDp       Cm    Top Xtr Bot Xtr   Cpmin    Chinge    XCp    \n"
of_661 = " -24.000  -0.7585   0.29481   0.28669   0.0419  1.0000  0.0225  -1.5489   0.0000   0.0000   0.0000   0.2964\n"
of_612 = "  -4.000  -0.2313   0.00861   0.00307  -0.0438  0.6596  0.0081  -1.7721   0.0000   0.0512\n"
print("pandas", pandas.__version__)
new = pandas.read_csv(io.StringIO(head + of_661), sep=r"\s+").iloc[0]
old = pandas.read_csv(io.StringIO(head + of_612), sep=r"\s+").iloc[0]
print("6.61:", new.to_dict())
print("6.12:", old.to_dict())
assert new["Cm"] == 0.0419 and new["Xtr"] == 0.0225 and new["Bot"] == -1.5489  # of ten columns, Cpmin is -1.5489
assert old["Cm"] == -0.0438 and old["Bot"] == -1.7721 and old["XCp"] != old["XCp"]
PY
