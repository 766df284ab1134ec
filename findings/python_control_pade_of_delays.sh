#!/usr/bin/env bash
# One would guess that Pade's rational function for a delay gets better with its order, and is good from order 3. For a
# plant that doubles in 64 ms, sampled at 100 Hz and 13 ms late, python-control then puts the largest stable gain at
# 82.3; it is 84.4 (exactly, with the waiting commands as states). Order 1 says 87.9, order 2 82.3, order 8 84.5. At
# order 12 the coefficients are 6e37; at 16, sample_system returns matrices that are not finite, with no more than
# NumPy's warning of an overflow.
# It bites whoever asks how much delay a controller survives.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet numpy==2.3.5 scipy==1.17.1 control==0.10.2
"$folder/venv/bin/python" -W error - <<'PYTHON'
import warnings

import control
import numpy as np

print("control", control.__version__)
growth, step, delay = 10.8, 0.01, 0.013


def largest_gain(A, B, C, D):
    """Return the largest gain of a stable loop, by bisection from one that is stable."""
    low, high = 30.0, 200.0
    for _ in range(60):
        gain = 0.5 * (low + high)
        closed = A - B @ np.linalg.solve(np.eye(1) + gain * D, gain * C)
        low, high = (gain, high) if np.abs(np.linalg.eigvals(closed)).max() < 1.0 else (low, gain)
    return low


plant, found = control.ss([[growth]], [[1.0]], [[1.0]], 0), {}
for order in (1, 2, 3, 5, 8):
    late = control.series(control.ss(control.tf(*control.pade(delay, order))), plant)
    sampled = control.sample_system(late, step, "zoh")
    found[order] = largest_gain(sampled.A, sampled.B, sampled.C, sampled.D)
    print(f"order {order}: largest gain {found[order]:.2f}")
# The command of two samples ago acts for 3 ms, then that of one sample ago.
grown = np.exp(growth * np.array([0.010, 0.007, 0.003]))
older, newer = grown[1] * (grown[2] - 1) / growth, (grown[1] - 1) / growth
A, B, C = np.array([[grown[0], newer, older], [0, 0, 0], [0, 1, 0]]), np.array([[0], [1], [0]]), np.array([[1, 0, 0]])
exact = largest_gain(A, B, C, np.zeros((1, 1)))
print(f"exactly: {exact:.2f}")
assert abs(found[3] / exact - 1) > 0.02 and abs(found[8] / exact - 1) < 0.005
assert found[1] > exact > found[5] > found[2] > found[3]
warnings.simplefilter("ignore")
late = control.series(control.ss(control.tf(*control.pade(delay, 16))), plant)
sampled = control.sample_system(late, step, "zoh")
print("order 16: finite", np.isfinite(late.A).all(), "- sampled: finite", np.isfinite(sampled.A).all())
assert np.isfinite(late.A).all() and not np.isfinite(sampled.A).all()
PYTHON
