"""How a disturbed orbit returns: Floquet multipliers, from the exact derivative of one period flown."""

from __future__ import annotations

import numpy as np

from wingbeat.kinematics import Wingbeat, parameter
from wingbeat.model import FlightModel
from wingbeat.orbits.shooting import flier

# Blocks of steps that bring the multipliers of unstable bats within 1e-5 of those of an adaptive flight.
_BLOCKS = 64


def floquet_multipliers(
    model: FlightModel, wingbeat: Wingbeat, pitch_state: np.ndarray, free: tuple[str, ...]
) -> np.ndarray:
    """Return the multipliers of (body_pitch, u, w, pitch_rate) over a period, largest modulus first, shape (4,).

    They are the eigenvalues of the monodromy matrix, the derivative of the pitch state after a period with
    respect to that before. Not-a-number where the flight tumbles off.
    """
    values = np.array([parameter(wingbeat, name) for name in free], dtype=float)
    monodromy = flier(model, wingbeat, free)(values, pitch_state, _BLOCKS).end_jacobian[2:, :4]
    if not np.isfinite(monodromy).all():
        return np.full(4, np.nan + 0j)
    found = np.linalg.eigvals(monodromy)
    return found[np.lexsort((-found.imag, -found.real, -np.round(np.abs(found), 9)))]
