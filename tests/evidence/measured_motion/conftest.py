"""What the tests of measured motions share."""

import math

import numpy as np
import pytest

from wingbeat.aero import TableCoefficients


@pytest.fixture(scope="module")
def polar():
    """The coefficients of a section with lift 2 pi sin(alpha) to 45 degrees, and next to no drag."""
    alpha = np.arange(-180.0, 181.0)
    lift = np.clip(2 * math.pi * np.sin(np.deg2rad(alpha)), -4.44, 4.44)
    lift[[0, -1]] = 0.0
    drag = np.full_like(alpha, 1e-9)
    return TableCoefficients("thin", alpha, lift, drag, aspect_ratio=math.inf)  # type: ignore[arg-type]
