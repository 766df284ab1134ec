#!/usr/bin/env bash
# One would guess: a reader of LabVIEW's .lvm files reads decimal commas, or refuses them.
# What happens: lvm_read knows only the Decimal_Separator of the head. Files of LabVIEW before 8.6 (Writer_Version
# 0.92) have none: NI's specification says that it is then the system's. Every number becomes NaN, the times too,
# without a warning; with the line added, the same file is read.
# Where it bites: records of continental Europe from old rigs; a mean that skips NaN hides it.
set -euo pipefail
command -v python3 >/dev/null || { echo "install python3 and python3-venv"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv venv || { echo "install python3-venv"; exit 77; }
venv/bin/pip install --quiet lvm_read==1.26 numpy==2.3.5
venv/bin/python -W error - <<'PYTHON'
import lvm_read
import numpy as np

print("lvm_read", lvm_read.__version__)
HEAD = "LabVIEW Measurement\t\nWriter_Version\t0.92\nReader_Version\t1\nSeparator\tTab\n"
TAIL = (
    "Multi_Headings\tNo\nX_Columns\tOne\nTime_Pref\tRelative\nDate\t2007/05/02\nTime\t10:11:12,5\n"
    "***End_of_Header***\t\n\t\nChannels\t1\t\nSamples\t3\t\nDate\t2007/05/02\t\nTime\t10:11:12,5\t\n"
    "X_Dimension\tTime\t\n***End_of_Header***\t\t\nX_Value\tFz\tComment\n"
    "0,000000\t2,883681\n0,020000\t2,890789\n0,040000\t2,900702\n"
)
bare = np.array(lvm_read.read_str(HEAD + TAIL)[0]["data"])
said = np.array(lvm_read.read_str(HEAD + "Decimal_Separator\t,\n" + TAIL)[0]["data"])
print("without Decimal_Separator:", bare.tolist())
print("with Decimal_Separator:   ", said.tolist())
assert np.isnan(bare[:, :2]).all()
assert np.allclose(said[:, :2], [[0, 2.883681], [0.02, 2.890789], [0.04, 2.900702]])
PYTHON
