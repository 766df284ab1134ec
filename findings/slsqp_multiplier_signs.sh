#!/usr/bin/env bash
# One would guess: SciPy's SLSQP and trust-constr return the same Lagrange multipliers for the same constraints.
# What happens: those of an upper limit agree, those of an equality and of a lower limit have opposite signs; SLSQP lists
# equalities first, whatever order they are given in, and returns none of the bounds, trust-constr returns them last.
# Where it bites: shadow prices and sensitivities read from the result, when a solver is exchanged for the other, and
# checks of optimality that add up multipliers times gradients.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "scipy==1.17.1" "numpy==2.4.6"
env/bin/python - <<'PY'
import sys

import numpy as np
import scipy
from scipy.optimize import Bounds, LinearConstraint, minimize

# The least distance from (2, 1, 3, 0) with z <= 2, w >= 1, x + y = 2.2 and the bound x <= 1: at (1, 1.2, 2, 1).
target = np.array([2.0, 1.0, 3.0, 0.0])
rows = {"upper": [0, 0, 1, 0], "lower": [0, 0, 0, 1], "equal": [1, 1, 0, 0]}
ends = {"upper": (-np.inf, 2.0), "lower": (1.0, np.inf), "equal": (2.2, 2.2)}
limits = [LinearConstraint(np.atleast_2d(rows[name]), *ends[name]) for name in rows]
found = {}
for method, tight in (("SLSQP", {"ftol": 1e-12}), ("trust-constr", {"gtol": 1e-10, "xtol": 1e-12})):
    solved = minimize(
        lambda x: ((x - target) ** 2).sum(),
        np.zeros(4),
        jac=lambda x: 2 * (x - target),
        hess=(lambda x: 2 * np.eye(4)) if method == "trust-constr" else None,
        method=method,
        bounds=Bounds([-9] * 4, [1, 9, 9, 9]),
        constraints=limits,
        options=tight,
    )
    assert np.allclose(solved.x, [1, 1.2, 2, 1], atol=1e-4), solved.x
    found[method] = solved
slsqp = dict(zip(("equal", "upper", "lower"), found["SLSQP"].multipliers.round(3).tolist(), strict=True))
trust = dict(zip((*rows, "bounds"), (np.round(v, 3).tolist() for v in found["trust-constr"].v), strict=True))
print(f"SciPy {scipy.__version__}, constraints given as upper, lower, equal")
print(f"SLSQP, in its order: {slsqp}")
print(f"trust-constr, in its order: {trust}")
as_described = (
    np.isclose(slsqp["upper"], trust["upper"][0], atol=0.01)
    and np.isclose(slsqp["equal"], -trust["equal"][0], atol=0.01)
    and np.isclose(slsqp["lower"], -trust["lower"][0], atol=0.01)
    and np.isclose(trust["bounds"][0], 2.4, atol=0.01)
)
sys.exit(not as_described)
PY
