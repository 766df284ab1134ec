"""Unsteady loads of a thin aerofoil on a strip: their numbers, and Theodorsen's without the lag of the wake."""

import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat._jax.arrays import jnp
from wingbeat.aero.closed_forms import added_inertia, added_mass, damping_couple, rotation_force, rotation_lift
from wingbeat.aero.strip_forces import strip_forces, with_turning

DENSITY, CHORD, SPEED = 1.225, 0.112, 10.0
HALF = 0.5 * CHORD
WAY = 2.0 * math.pi * np.linspace(0.0, 1.0, 33)[:-1]
# Amplitudes of plunge [m] and pitch [rad] for which the aerofoil is linear to 1e-8, pitch ahead of plunge [rad],
# and frequency [rad/s].
SMALL = {"plunge": (1e-6, 0.0, 0.0, 40.0), "pitch": (0.0, 1e-5, 0.0, 40.0), "both": (1e-6, 1e-5, 0.7, 120.0)}


def thin_aerofoil(alpha):
    return 2.0 * jnp.pi * jnp.sin(alpha), 0.0 * alpha


def harmonic(amplitude, ahead, omega):
    """Return a motion with its two time derivatives."""
    return (
        amplitude * np.cos(WAY + ahead),
        -amplitude * omega * np.sin(WAY + ahead),
        -amplitude * omega**2 * np.cos(WAY + ahead),
    )


def theodorsen(plunge, pitch):
    """Return lift up and moment nose-up about the quarter chord, per length, with C = 1 and a = -1/2."""
    (_, h_d, h_dd), (theta, theta_d, theta_dd) = plunge, pitch
    b, a, u = HALF, -0.5, SPEED
    lift = math.pi * DENSITY * b**2 * (h_dd + u * theta_d - b * a * theta_dd)
    lift += 2.0 * math.pi * DENSITY * u * b * (h_d + u * theta + b * (0.5 - a) * theta_d)
    moment = -math.pi * DENSITY * b**2 * (b * h_dd / 2.0 + u * b * theta_d + 3.0 / 8.0 * b**2 * theta_dd)
    return lift, moment


def motion(kind):
    plunge, pitch, ahead, omega = SMALL[kind]
    return harmonic(plunge, 0.0, omega), harmonic(pitch, ahead, omega)


def test_added_mass_of_a_plate_of_a_metre():
    assert added_mass(DENSITY, CHORD, 1.0) == pytest.approx(0.012069, abs=5e-7)
    assert added_mass(DENSITY, CHORD, 0.3) == pytest.approx(0.3 * math.pi * DENSITY * HALF**2, rel=1e-14)
    # About mid-chord an ellipse without thickness: a mass of pi rho b^2 and a radius squared of b^2/8.
    about_middle = added_mass(DENSITY, CHORD, 1.0) * HALF**2 / 8.0
    assert added_inertia(DENSITY, CHORD, 1.0) == pytest.approx(about_middle, rel=1e-14)


def test_rotation_is_lift_across_the_velocity_and_does_no_work():
    along, across = rotation_force(DENSITY, CHORD, 0.1, 7.0, 3.0, -4.0)
    assert along * 3.0 + across * -4.0 == pytest.approx(0.0, abs=1e-16)
    circulation = 0.5 * math.pi * CHORD**2 * 7.0
    assert math.hypot(along, across) == pytest.approx(DENSITY * circulation * 5.0 * 0.1, rel=1e-14)
    assert rotation_lift(DENSITY, CHORD, 0.1, 7.0) * 5.0 == pytest.approx(math.hypot(along, across), rel=1e-14)
    # Forward flight while the leading edge rises: upwards.
    assert rotation_force(DENSITY, CHORD, 0.1, 7.0, 3.0, 0.0)[1] > 0.0


@pytest.mark.parametrize("turning", [7.0, -7.0])
def test_the_couple_opposes_the_turning(turning):
    couple = damping_couple(DENSITY, CHORD, 0.1, turning, 5.0)
    assert couple == pytest.approx(-math.pi / 16.0 * DENSITY * CHORD**3 * 5.0 * turning * 0.1, rel=1e-14)
    assert couple * turning < 0.0


@pytest.mark.parametrize("kind", SMALL)
def test_strips_are_theodorsens_without_the_lag_of_the_wake(kind):
    plunge, pitch = motion(kind)
    (_, down, down_rate), (theta, turning, turning_rate) = plunge, pitch
    sine, cosine = np.sin(theta), np.cos(theta)
    # The quarter chord moves forward with the speed of flight, and downward as the section plunges.
    vc, vn = SPEED * cosine - down * sine, -SPEED * sine - down * cosine
    flat, chord, width = np.zeros_like(theta), np.full_like(theta, CHORD), np.ones_like(theta)
    kernel = wb.aero.coefficients_of(thin_aerofoil).kernel()
    steady = strip_forces(kernel, DENSITY, jnp.asarray(chord * width), jnp.asarray(vc), jnp.asarray(vn), flat)
    assert steady.couple is None
    turned = with_turning(steady, DENSITY, chord, width, turning, vc, vn)
    # d/dt of -U sin - h' cos, and of the speed of the mid-chord below it.
    normal_rate = -SPEED * cosine * turning - down_rate * cosine + down * sine * turning
    resisted = -added_mass(DENSITY, CHORD, 1.0) * (normal_rate - 0.25 * CHORD * turning_rate)
    lift = turned.normal * cosine + turned.chordwise * sine + resisted * cosine
    moment = turned.couple - added_inertia(DENSITY, CHORD, 1.0) * turning_rate - 0.25 * CHORD * resisted
    wanted_lift, wanted_moment = theodorsen(plunge, pitch)
    assert np.abs(lift - wanted_lift).max() <= 1e-6 * np.abs(wanted_lift).max()
    assert np.abs(moment - wanted_moment).max() <= 1e-8 * np.abs(wanted_moment).max()
    if kind != "plunge":  # the couples are no trifle
        assert np.abs(-0.25 * CHORD * resisted - wanted_moment).max() > 0.3 * np.abs(wanted_moment).max()


def test_a_wing_held_out_level_is_theodorsens():
    """Through the flight model: a body that plunges, on whose hinges the wings pitch."""
    span = 0.3
    vehicle = wb.Vehicle(wb.Body(0.1, 1e-4), wb.Wing(span, CHORD, 0.01))
    model = wb.FlightModel(vehicle, wb.aero.BladeElement(thin_aerofoil, 1, unsteady="thin-aerofoil"))
    plunge, pitch = motion("both")
    none = np.zeros_like(WAY)
    q, rate, second = (
        np.stack([none + forward, -down, none, none, turn], axis=-1)
        for forward, down, turn in zip((0.0, SPEED, 0.0), plunge, pitch, strict=True)
    )
    found = np.asarray(
        wb.air_forces(model, wb.Wingbeat(5.0, 0.0, 0.0, 0.0, 0.0), q, rate, none, second).generalised
    )
    lift, moment = theodorsen(plunge, pitch)
    for wanted, of_wings in ((lift, found[:, 1]), (moment, found[:, 4])):
        assert np.abs(of_wings - 2.0 * span * wanted).max() <= 1e-6 * np.abs(2.0 * span * wanted).max()


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("unsteady", "theodorsen", "unsteady = 'theodorsen'"),
        ("inflow", "glauert", "inflow = 'glauert'"),
        ("induced_factor", -0.1, "induced_factor = -0.1"),
        ("induced_factor", math.nan, "induced_factor = nan"),
    ],
)
def test_terms_that_are_unknown_or_negative_are_refused(field, value, words):
    with pytest.raises(wb.InvalidInputError, match=f"aero.{words}"):
        wb.aero.BladeElement("su-fan", **{field: value})


def test_all_terms_are_off_unless_asked_for():
    plain = wb.aero.BladeElement("su-fan")
    assert (plain.unsteady, plain.inflow, plain.induced_factor) == ("none", "none", 1.2)
    model = wb.FlightModel(wb.load_species("pigeon").vehicle, plain)
    assert (model.unsteady, model.induced_factor, model.induced_flow) == (0.0, None, None)
