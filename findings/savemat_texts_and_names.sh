#!/usr/bin/env bash
# One would guess that SciPy's savemat refuses what a MATLAB file cannot hold, and that Octave reads its texts.
# It writes a variable whose name has 70 characters, the most being 63, leaves out a field whose name begins with an
# underscore, and stores a text as UTF-8 under its number of characters. Octave takes that for the number of bytes:
# each letter beyond ASCII costs the end of the text, and a degree sign alone becomes half a character.
# It bites whoever saves units, names or labels for MATLAB and Octave from Python.
set -euo pipefail
command -v octave >/dev/null || { echo "octave is missing: apt-get install octave"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet numpy==2.3.5 scipy==1.17.1
cd "$folder"
venv/bin/python - <<'PYTHON'
import warnings
import scipy
from scipy.io import loadmat, savemat

print("scipy", scipy.__version__)
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    savemat("a.mat", {"name": "Größe", "unit": "°", "n" * 70: 1.0, "s": {"_kept": 2.0, "end": 3.0}}, long_field_names=True)
read = loadmat("a.mat", simplify_cells=True)
print("warnings:", [str(one.message) for one in caught])
print("a name of 70 characters is written:", "n" * 70 in read)
print("fields:", sorted(read["s"]))
assert "n" * 70 in read and sorted(read["s"]) == ["end"] and read["name"] == "Größe"
PYTHON
octave --version | head -1
octave --no-gui --quiet --eval '
    read = load("a.mat");
    name = double(read.name); unit = double(read.unit);
    printf("bytes of the name: %s\nbytes of the unit: %s\n", num2str(name), num2str(unit));
    whole = double("Größe"); degree = double("°");
    assert (isequal(name, whole(1:5)) && numel(whole) == 7);   # two letters of two bytes cost two bytes at the end
    assert (isequal(unit, degree(1)) && numel(degree) == 2);
' 2>/dev/null
