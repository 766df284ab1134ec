"""Flights with unsteady air and inflow that several tests use."""

import dataclasses
import math

import numpy as np

import wingbeat as wb
from tests.helpers.oracle_laws import wing_angles
from wingbeat.records.flight_dataset import evaluate

NAMES = ("pigeon", "bat")
CRUISE = (8.0, 0.5)
PHASES = np.linspace(0.0, 1.0, 17)[:-1]
SAMPLES = 4096  # of a beat that is flown
# Every law of the wingbeat, and what only some vehicles have.
EVERY_LAW = {
    "flap_mean": 0.1,
    "pitch_mean": 0.2,
    "pitch_amplitude": 0.3,
    "pitch_phase": 0.2,
    "sweep_mean": 0.1,
    "sweep_amplitude": 0.2,
    "sweep_phase": 0.3,
    "fold_amplitude": 0.3,
    "wrist": 0.45,
    "span_retraction": 0.3,
    "twist_ratio": 0.6,
    "stroke_plane_tilt": 0.1,
    "tail_tilt": 0.15,
    "downstroke_fraction": 0.55,
    "flap_harmonics": (0.05, 0.02),
    "pitch_harmonics": (0.03, -0.04),
    "span_harmonics": (0.02, 0.01),
    "chord_retraction": 0.2,
    "twist_mean": -0.1,
    "sweep_harmonics": (0.04, -0.03),
    "chord_harmonics": (0.05, 0.1, -0.04, 0.03),
    "twist_harmonics": (0.1, -0.2, 0.03, 0.05),
}
TAIL = wb.Tail(0.005, 0.15, 3.0, drag_coefficient=0.03, height=0.02, incidence=-0.1)
SHOULDER, CHORD, TILTED, DRAG_AREA = (0.02, 0.01, 0.03), (0.12, 0.13, 0.06), 1.3, 1e-3


def vehicle_and_beat(name, every_law):
    species = wb.load_species(name)
    if not every_law:
        return species.vehicle, species.wingbeat
    wing = dataclasses.replace(
        species.vehicle.wing, shoulder=SHOULDER, chord=CHORD, stroke_plane_angle=TILTED, mass_exponent=1.5
    )
    body = dataclasses.replace(species.vehicle.body, drag_area=DRAG_AREA)
    return wb.Vehicle(body, wing, TAIL), dataclasses.replace(species.wingbeat, **EVERY_LAW)


def section():
    """Return the coefficients of `SuFan` as those of a section: with inflow they stay what they are."""
    return dataclasses.replace(wb.aero.SuFan(), aspect_ratio=math.inf)


# Every term at once. Compiling takes up to half a minute for each set of terms, so few sets are flown.
ALL_TERMS = {
    "inflow": "momentum",
    "induced_factor": 1.35,
    "force_point": "centre-of-pressure",
    "airspeed": "full",
}


def flown_with(name, every_law=True, coefficients="su-fan", velocity=CRUISE, **terms):
    """Return a model with unsteady air and, unless told otherwise, nothing else beyond the plate, and its beat."""
    vehicle, beat = vehicle_and_beat(name, every_law)
    aero = wb.aero.BladeElement(coefficients, **{"unsteady": "thin-aerofoil", **terms})
    return wb.FlightModel(vehicle, aero, velocity=velocity), beat


def all_terms(name):
    """Return a model and beat with every law and every term."""
    return flown_with(name, True, section(), **ALL_TERMS)


def states_at(phase, seed=0):
    random = np.random.default_rng(seed)
    low, high = [-1, -1, -0.5, 4, -2, -5], [1, 1, 0.6, 11, 2, 5]
    return wb.State(*random.uniform(low, high, (len(phase), 6)).T)


def loads(model, beat, states, phase):
    """Return the loads, in blocks of phases: they are one compiled program however many phases there are."""
    return evaluate(model, beat, phase, np.stack(states, axis=-1))


def coordinates(beat, now, states, phase):
    """Return q, q' and q'' of the five coordinates in a flight with prescribed wings."""
    angles = [[angle[2] for angle in wing_angles(vars(beat), at)] for at in phase]
    q = np.stack([*states[:3], now.flap, now.wing_pitch], axis=-1)
    q_dot = np.stack([*states[3:], now.flap_rate, now.wing_pitch_rate], axis=-1)
    return q, q_dot, np.concatenate([now.acceleration, angles], axis=-1)
