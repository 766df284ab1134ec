"""A section that plunges or pitches, flown as an orbit with the lag: Garrick 1936 and Theodorsen 1935.

The wing of one strip beats by a small angle on a body so heavy that it flies straight. Theory: equations
``wake-downwash`` and ``shed-downwash``.
"""

import math

import numpy as np
import pytest
from scipy.special import hankel2

import wingbeat as wb
from wingbeat._jax.arrays import jnp
from wingbeat.animal.vehicle import Body, Vehicle, Wing
from wingbeat.orbits.flight.certificate import certify
from wingbeat.orbits.flight.time_series import flown_beat

pytestmark = pytest.mark.slow

SPEED, CHORD, SPAN, DENSITY = 10.0, 0.1, 1.0, 1.225
HALF, ANGLE = 0.5 * CHORD, 2e-3
# Reduced frequencies at which Jones's C(k) gives Garrick's power and thrust within 1 %. Its own error is largest
# near 0.22 (F 1.8 %, |C|^2 3.6 %) and 1 (2.1 and 4.1 %).
NEAR = (0.1, 0.4)
JONES = ((0.165, 0.0455), (0.335, 0.3))


def theodorsen(k):
    first, zeroth = hankel2(1, k), hankel2(0, k)
    return first / (first + 1j * zeroth)


def jones(k):
    return 1 - sum(a * 1j * k / (b + 1j * k) for a, b in JONES)


CASES = [*((k, theodorsen, 1e-2) for k in NEAR), (0.22, jones, 1e-3), (1.0, jones, 1e-3)]


class Section(wb.aero.FunctionCoefficients):
    """Coefficients of a section, ``C_L = 2 pi sin(alpha)`` and ``C_D = 0``."""

    aspect_ratio = math.inf


def section():
    return Section(lambda alpha: (2 * math.pi * jnp.sin(alpha), 0.0 * alpha), "section")


def flown(k, *, flap=0.0, pitch=0.0, unsteady="thin-aerofoil", wake="jones-section"):
    frequency = k * SPEED / (HALF * 2 * math.pi)
    vehicle = Vehicle(Body(1e9, 1e9), Wing(SPAN, CHORD, 1e-9))
    aero = wb.aero.BladeElement(section(), strips=1, unsteady=unsteady, wake=wake)
    model = wb.FlightModel(vehicle, aero, wb.Air(DENSITY, 1.5e-5, 0.0))
    beat = wb.Wingbeat(frequency, 0.0, flap, 0.0, pitch)
    certificate = certify(model, beat, np.array([0.0, SPEED, 0.0, 0.0]))
    assert certificate.wake_miss is None or certificate.wake_miss < 1e-9
    series = flown_beat(model, beat, certificate.phase, certificate.path, np.array([SPEED, 0.0]))
    return 2 * math.pi * frequency, series


def first_harmonic(series):
    return 2 * np.mean(series[:-1] * np.exp(-2j * math.pi * np.arange(256) / 256))


@pytest.mark.parametrize(("k", "of", "within"), CASES)
def test_plunging_costs_and_pushes_what_garrick_says(k, of, within):
    omega, series = flown(k, flap=ANGLE)
    fast = omega * ANGLE * 0.5 * SPAN  # of the strip's centre
    c, both = of(k), 2 * SPAN  # two wings
    power = math.pi * DENSITY * HALF * SPEED * c.real * fast**2 * both
    thrust = math.pi * DENSITY * HALF * abs(c) ** 2 * fast**2 * both
    found = np.mean(series.aerodynamic_power[:-1]), np.mean(series.force_x[:-1])
    assert found[0] == pytest.approx(power, rel=within)
    assert found[1] == pytest.approx(thrust, rel=within)


@pytest.mark.parametrize(("k", "of", "within"), CASES)
def test_pitching_about_the_quarter_chord_lifts_what_theodorsen_says(k, of, within):
    omega, series = flown(k, pitch=ANGLE)
    angle = first_harmonic(np.asarray(series.wing_pitch))
    rate, turn = 1j * omega * angle, -(omega**2) * angle
    circulation = 2 * math.pi * DENSITY * SPEED * HALF * of(k) * (SPEED * angle + HALF * rate)
    lift = math.pi * DENSITY * HALF**2 * (SPEED * rate + 0.5 * HALF * turn) + circulation
    found = first_harmonic(np.asarray(series.force_z)) / (2 * SPAN)
    if of is theodorsen:  # Jones's C(k) has other phases, here by up to 1.3 degrees
        assert abs(np.angle(found / lift, deg=True)) < 1.5
        found = abs(found) * lift / abs(lift)
    assert abs(found - lift) < within * abs(lift)
