#!/usr/bin/env bash
# One would guess: `from scipy.optimize import minimize` imports the minimisers and linear algebra.
# What happens: with SciPy 1.17 it imports three times as many modules as NumPy itself, among them unittest, numpy.testing,
# numpy.f2py (a Fortran compiler's front end), scipy.fft and scipy.spatial. No smaller import exists: any submodule of
# scipy.optimize imports the whole.
# Where it bites: the start of short commands. Of a process that minimises once, it is a tenth or more of the time.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "scipy==1.17.1" "numpy==2.4.6"
env/bin/python - <<'PY'
import sys

before = len(sys.modules)
import numpy

after = len(sys.modules)
import scipy
from scipy.optimize._slsqp_py import fmin_slsqp  # the smallest part that one could ask for

found = [name for name in ("unittest", "numpy.testing", "numpy.f2py", "scipy.fft", "scipy.spatial") if name in sys.modules]
print(f"SciPy {scipy.__version__}, NumPy {numpy.__version__}: {after - before} modules for NumPy,")
print(f"{len(sys.modules) - after} more for one minimiser, with {', '.join(found)}")
sys.exit(len(found) < 5 or len(sys.modules) - after < 2 * (after - before))
PY
