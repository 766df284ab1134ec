"""What the tests of measured motions share."""

import math

import numpy as np
import pytest

from wingbeat.aero import TableCoefficients


@pytest.fixture(scope="module")
def polar():
    """The coefficients of a section with lift 2 pi sin(alpha)."""
    alpha = np.arange(-180.0, 181.0)
    lift = 2 * math.pi * np.sin(np.deg2rad(alpha))
    lift[[0, -1]] = 0.0
    return TableCoefficients("thin", alpha, lift, 0 * alpha, aspect_ratio=math.inf)  # type: ignore[arg-type]
