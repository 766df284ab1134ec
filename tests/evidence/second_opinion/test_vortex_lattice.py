"""Known cases in PteraSoftware through our adapter: a steady plate, and a plate that heaves."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.special import hankel2

import wingbeat as wb
from tests.helpers.given_motion import PIGEON, given_motion
from wingbeat_evidence.second_opinion.comparison import lattice_loads
from wingbeat_evidence.second_opinion.lattice import LatticeOptions
from wingbeat_evidence.second_opinion.vortex_lattice import code_version, fly_lattice

pytest.importorskip("pterasoftware", reason="needs the extra uvlm: PteraSoftware is not installed")
pytestmark = pytest.mark.filterwarnings("ignore")  # of the many packages that PteraSoftware brings


def test_lift_and_drag_of_a_steady_plate_are_those_of_a_lifting_line():
    """Glauert 1926, The Elements of Aerofoil and Airscrew Theory: aspect ratio 6, tau = 0.17, delta = 0.05."""
    chord, span, alpha, speed, density = 0.1, 0.6, math.radians(3.0), 10.0, 1.2
    x, y = np.linspace(0.0, -chord, 5), np.linspace(0.5 * span, -0.5 * span, 13)
    plate = np.stack(np.broadcast_arrays(x[:, None], y, 0.0), axis=-1)
    sinking = speed * math.cos(alpha), -speed * math.sin(alpha)
    force, moment = fly_lattice(np.tile(plate, (21, 1, 1, 1)), chord / speed, sinking, density, 1)
    forward, left, up = force.sum(axis=(0, 1, 2))
    lift = up * math.cos(alpha) + forward * math.sin(alpha)
    drag = up * math.sin(alpha) - forward * math.cos(alpha)
    pressure_area = 0.5 * density * speed**2 * chord * span
    ratio = span / chord
    slope = 2 * math.pi / (1 + 2 / ratio * (1 + 0.17))
    assert lift / pressure_area == pytest.approx(slope * alpha, rel=0.03)
    assert drag / pressure_area == pytest.approx((slope * alpha) ** 2 / (math.pi * ratio) * 1.05, rel=0.15)
    assert left == pytest.approx(0.0, abs=1e-9)
    # The centre of pressure is at the quarter chord.
    assert moment.sum(axis=(0, 1, 2))[1] == pytest.approx(-0.25 * chord * -up, rel=0.05)


def test_lift_of_a_long_wing_that_heaves_is_theodorsen_s():
    """Theodorsen 1935, NACA report 496: lift pi rho b^2 h'' + 2 pi rho U b C(k) h', downward h."""
    speed, chord, height, frequency = 10.0, 0.2, 0.004, 5.0
    wing = dataclasses.replace(PIGEON.wing, semi_span=3.0, chord=chord, shoulder=(0.0, 0.0, 0.0))
    still = wb.Wingbeat(
        frequency=frequency,
        flap_amplitude=0.0,
        pitch_amplitude=0.0,
        flap_mean=0.0,
        pitch_mean=0.0,
        span_retraction=0.0,
    )
    motion = given_motion(still, speed, heave=height, vehicle=dataclasses.replace(PIGEON, wing=wing))
    found = lattice_loads(motion, LatticeOptions(chordwise=4, spanwise=4, steps=32, beats=2))
    omega, b = 2 * math.pi * frequency, 0.5 * chord
    k = omega * b / speed
    lag = hankel2(1, k) / (hankel2(1, k) + 1j * hankel2(0, k))
    heave = -height  # of z = height cos(omega t), as a downward place
    section = math.pi * b**2 * -(omega**2) * heave + 2 * math.pi * speed * b * lag * 1j * omega * heave
    theory = motion.air.density * 2 * wing.semi_span * section
    first = 2 * np.fft.rfft(found.lift)[1] / len(found.lift)
    assert abs(first / theory) == pytest.approx(1.0, abs=0.1)
    assert np.angle(first / theory, deg=True) == pytest.approx(0.0, abs=5.0)
    # A heaving plate does not pitch: all power is that of its lift, and of its thrust at the speed of flight.
    work = np.real(-first * np.conj(1j * omega * height)) / 2 - found.thrust.mean() * speed
    assert found.power.mean() == pytest.approx(work, rel=0.05)


def test_version_is_one_with_free_flight():
    name, version = code_version().split()
    assert name == "PteraSoftware"
    assert tuple(map(int, version.split(".")[:2])) >= (5, 1)
