#!/usr/bin/env bash
# One would guess: a library of Pareto fronts leaves out, or refuses, a point with not-a-number in an objective, such as
# a design whose simulation failed.
# What happens: moocore and pymoo count it as not dominated, and let it dominate points that are better in the other
# objective. One failed design removes all others from the front, without a word. moocore's hypervolume of the same
# points ignores it with two objectives, and is not-a-number with three. Besides, of two equal designs moocore keeps one
# by default and pymoo both.
# Where it bites: fronts of designs of which some have no solution, selected from a table.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
python3 -m venv env
env/bin/pip install -q --disable-pip-version-check "moocore==0.3.2" "pymoo==0.6.2" "numpy==2.4.6"
env/bin/python - <<'PY'
import sys

import moocore
import numpy as np
import pymoo
from pymoo.util.nds.non_dominated_sorting import NonDominatedSorting

good = np.array([[1.0, 2.0], [2.0, 1.0], [3.0, 3.0]])
failed = np.vstack([good, [np.nan, 0.0]])
third = np.column_stack([failed, np.ones(4)])
equal = np.array([[1.0, 2.0], [1.0, 2.0]])


def of_pymoo(points):
    return sorted(int(i) for i in NonDominatedSorting().do(points, only_non_dominated_front=True))


def of_moocore(points, **how):
    return np.flatnonzero(moocore.is_nondominated(points, **how)).tolist()


print(f"moocore {moocore.__version__}, pymoo {pymoo.__version__}")
seen = {
    "front of three designs": (of_moocore(good), of_pymoo(good)),
    "and of a failed one": (of_moocore(failed), of_pymoo(failed)),
    "two equal designs": (of_moocore(equal), of_pymoo(equal)),
}
for what, both in seen.items():
    print(f"{what}: moocore {both[0]}, pymoo {both[1]}")
volumes = [moocore.hypervolume(p, ref=[4.0] * p.shape[1]) for p in (good, failed, third)]
print(f"hypervolumes without it, with it, with it and a third objective: {volumes}")
expected = {
    "front of three designs": ([0, 1], [0, 1]),
    "and of a failed one": ([3], [3]),
    "two equal designs": ([0], [0, 1]),
}
sys.exit(not (seen == expected and volumes[0] == volumes[1] and np.isnan(volumes[2])))
PY
