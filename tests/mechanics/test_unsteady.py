"""Unsteady air and inflow in flight: the plain oracle, the two forms, energy, torques, derivatives."""

import dataclasses
import functools

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import wingbeat as wb
from tests.helpers import oracle, unsteady_oracle
from tests.helpers.differences import differences, rates_along
from tests.helpers.differences import miss as of_jacobians
from tests.helpers.driven import spline_torques
from tests.helpers.models import changed
from tests.helpers.oracle_coefficients import mirrored
from tests.helpers.programs import compiled
from tests.helpers.unsteady_flights import (
    ALL_TERMS,
    CHORD,
    CRUISE,
    NAMES,
    PHASES,
    SAMPLES,
    all_terms,
    coordinates,
    flown_with,
    loads,
    section,
    states_at,
)
from wingbeat._jax.arrays import jax, jnp, unchecked
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.mechanics.flights import fly_beats
from wingbeat.mechanics.state_rates import body_rates
from wingbeat.records.flight_dataset import evaluate

# --- The oracle


def wang(alpha):
    """Return (c_l, c_d, x_cp) of Wang 2004, coefficients of a section."""
    c_l, c_d, *_ = mirrored(
        alpha, lambda a: 1.2 * np.sin(np.radians(2 * a)), lambda a: 1.4 - np.cos(np.radians(2 * a))
    )
    return c_l, c_d, 0.25


# Coefficient model, the oracle's formula of it, whether every law is on, and the terms.
KINDS = {
    "stock": ("su-fan", oracle.su_fan, False, {}),
    "all terms": (section(), oracle.su_fan, True, ALL_TERMS),
    "inflow alone": ("wang", wang, False, {"inflow": "momentum", "unsteady": "none"}),
}
UNSTEADY = ("stock", "all terms")


def flown_as(name, kind):
    coefficients, _, every_law, terms = KINDS[kind]
    return flown_with(name, every_law, coefficients, **terms)


def flier_of(model, beat, formula, terms):
    """Return what the oracle flies in place of the package; its own inflow, by bisection."""
    vehicle, air = model.vehicle, model.air
    wind = (0.0, 0.0)
    if "inflow" in terms:
        speed, climb = CRUISE
        drag = 0.5 * air.density * vehicle.body.drag_area * np.hypot(speed, climb)
        weight = (vehicle.body.mass + 2 * vehicle.wing.mass) * air.gravity
        force, factor = (drag * speed, weight + drag * climb), terms.get("induced_factor", 1.2)
        wind = unsteady_oracle.induced_wind(air.density, vehicle.wing.semi_span, factor, force, CRUISE)
    return unsteady_oracle.Flier(
        {part: vars(record) for part, record in vars(vehicle).items() if record is not None},
        vars(beat),
        vars(air),
        formula,
        10,
        terms.get("force_point") == "centre-of-pressure",
        terms.get("airspeed") == "full",
        0.0 if terms.get("unsteady") == "none" else 1.0,
        wind,
    )


@functools.cache
def against_the_oracle(name, kind):
    """Return a model, its beat, the oracle's flier, and states where every strip flies outside the blends."""
    _, formula, _, terms = KINDS[kind]
    model, beat = flown_as(name, kind)
    flier = flier_of(model, beat, formula, terms)
    found, random = [], np.random.default_rng(NAMES.index(name))
    for _ in range(400):
        state = random.uniform([-1, -1, -0.6, 2, -2, -6], [1, 1, 0.6, 12, 2, 6])
        phase = random.uniform(-0.5, 1.5)
        try:
            wanted = unsteady_oracle.accelerations(flier, state, phase)
        except ValueError:
            continue
        found.append((state, phase, wanted))
        if len(found) == 16:
            break
    assert len(found) == 16
    states, phases, wanted = (np.array(column) for column in zip(*found, strict=True))
    return model, beat, flier, states, phases, wanted


def assert_flies_as(flier, now, states, phases, wanted):
    np.testing.assert_allclose(now.acceleration, wanted, rtol=1e-9, atol=1e-9)
    rows = [unsteady_oracle.torques_and_powers(flier, *at) for at in zip(states, phases, strict=True)]
    rows_of = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    found = {key: getattr(now, key) for key in ("hinge_power", "actuator_power", "air_power")}
    found["torques"] = np.stack([now.flap_torque, now.pitch_torque], axis=-1)
    for key, value in rows_of.items():
        np.testing.assert_allclose(found[key], value, rtol=1e-9, atol=1e-10 * np.abs(value).max(), err_msg=key)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", NAMES)
def test_accelerations_torques_and_powers_are_those_of_the_oracle(name, kind):
    model, beat, flier, states, phases, wanted = against_the_oracle(name, kind)
    assert_flies_as(flier, loads(model, beat, wb.State(*states.T), phases), states, phases, wanted)


@pytest.mark.parametrize("kind", UNSTEADY)
@pytest.mark.parametrize("share", [0.0, 0.3])
@pytest.mark.parametrize("name", NAMES)
def test_a_share_of_the_unsteady_terms_is_that_of_the_oracle(name, share, kind):
    model, beat, flier, states, phases, _ = against_the_oracle(name, kind)
    flier = dataclasses.replace(flier, share=share)
    wanted = [unsteady_oracle.accelerations(flier, *at) for at in zip(states, phases, strict=True)]
    now = loads(changed(model, unsteady=np.asarray(share)), beat, wb.State(*states.T), phases)
    assert_flies_as(flier, now, states, phases, np.array(wanted))


def test_the_comparison_sees_each_unsteady_term():
    """A share of the terms that is off by a millionth, and a wind that is, are found."""
    model, beat, flier, states, phases, _ = against_the_oracle("bat", "all terms")
    now = loads(model, beat, wb.State(*states.T), phases).acceleration[0]
    for other in (
        dataclasses.replace(flier, share=1.0 + 1e-6),
        dataclasses.replace(flier, wind=(flier.wind[0], flier.wind[1] * (1 + 1e-6))),
    ):
        missed = np.abs(unsteady_oracle.accelerations(other, states[0], phases[0]) / now - 1.0).max()
        assert missed > 1e-8


# --- The two forms


@pytest.mark.slow
@pytest.mark.parametrize("kind", UNSTEADY)
@pytest.mark.parametrize("name", NAMES)
def test_the_five_coordinates_need_no_force_but_the_hinge_torques(name, kind):
    model, beat = flown_as(name, kind)
    states = states_at(PHASES)
    now = loads(model, beat, states, PHASES)
    motion = coordinates(beat, now, states, PHASES)
    found = np.asarray(wb.generalised_torques(model, beat, *motion, PHASES / beat.frequency))
    weight, torque = model.vehicle.mass * model.air.gravity, np.abs(found[:, 3:]).max(axis=0)
    force = np.abs(now.air_force[:, :3]).max(axis=0)
    assert np.abs(found[:, :3]).max() <= 1e-10 * max(weight, force.max())
    torques = np.stack([now.flap_torque, now.pitch_torque], axis=-1)
    assert (np.abs(found[:, 3:] - torques) <= 1e-10 * torque).all()


@pytest.mark.parametrize("name", NAMES)
def test_air_forces_fall_by_the_added_mass_with_acceleration(name):
    model, beat = all_terms(name)
    states = states_at(PHASES)
    now = loads(model, beat, states, PHASES)
    *motion, acceleration = coordinates(beat, now, states, PHASES)
    time = PHASES / beat.frequency
    held, moved = (wb.air_forces(model, beat, *motion, time, a) for a in (0.0 * acceleration, acceleration))
    fallen = np.einsum("tij,tj->ti", np.asarray(held.added_mass), acceleration)
    np.testing.assert_allclose(held.generalised - moved.generalised, fallen, atol=1e-11 * np.abs(fallen).max())
    matrix = np.asarray(held.added_mass)
    np.testing.assert_allclose(matrix, np.swapaxes(matrix, 1, 2), rtol=0, atol=1e-15)
    assert np.linalg.eigvalsh(matrix).min() >= -1e-12
    mass = model.vehicle.wing.mass * 2
    assert 0.05 * mass < matrix[:, 1, 1].max() < mass


# --- Energy, momentum


def held_by(flight):
    """Return energy and momentum (x, z)."""
    return np.stack([flight.kinetic_energy + flight.potential_energy, *flight.momentum.T])


@pytest.mark.parametrize("kind", UNSTEADY)
@pytest.mark.parametrize("name", NAMES)
def test_energy_changes_by_the_actuators_and_the_air_and_momentum_by_the_air(name, kind):
    model, beat = flown_as(name, kind)
    states = states_at(PHASES)
    now = loads(model, beat, states, PHASES)
    energy, *momentum = rates_along(loads, held_by, model, beat, states, PHASES, now.acceleration)
    peak = np.abs(now.actuator_power).max()
    assert np.abs(energy - now.actuator_power - now.air_power).max() <= 1e-10 * peak
    pushed = now.air_force[:, :2] - [0.0, model.vehicle.mass * model.air.gravity]
    assert np.abs(np.transpose(momentum) - pushed).max() <= 1e-10 * np.abs(pushed).max()
    shares = now.aerodynamic_power + now.inertial_power + now.body_power
    np.testing.assert_allclose(shares, now.hinge_power, rtol=0, atol=1e-11 * np.abs(now.hinge_power).max())


# --- Torques drive the wings


@pytest.mark.parametrize("name", NAMES)
def test_torques_drive_the_wing_along_its_prescribed_flight(name):
    # The terms and the number of samples are those of the orbits in `test_unsteady_orbits`.
    model, beat = flown_with(name, False, inflow="momentum")
    phase, states = fly_beats(model, beat, wb.State(0.0, 0.0, 0.2, *CRUISE, 0.0), 1, SAMPLES)[:2]
    now = evaluate(model, beat, phase, states)
    q = np.column_stack([states[:, :3], now.flap, now.wing_pitch])
    rates = np.column_stack([states[:, 3:], now.flap_rate, now.wing_pitch_rate])
    torques = np.column_stack([now.flap_torque, now.pitch_torque])
    upto = slice(0, SAMPLES // 8 + 1, SAMPLES // 64)  # an eighth of a beat

    def miss(flown):
        spline = CubicSpline(phase / beat.frequency, torques)
        found = wb.simulate_torque_driven(
            flown, beat, q[0], rates[0], spline_torques, spline.x[upto], (spline.x, spline.c)
        )
        by_rates = np.abs(found.rates - rates[upto]) / np.abs(rates).max(axis=0)
        return np.maximum(np.abs(found.coordinates - q[upto]), by_rates).max()

    assert miss(model) <= 1e-6
    # In steady air the same torques drive another motion.
    assert miss(changed(model, unsteady=np.asarray(0.0))) > 1e-3


# --- Derivatives


def changed_record(record, **fields):
    return unchecked(type(record), vars(record) | fields)


@compiled
def rates_and_change(model, beat, phase, numbers, direction):
    """Return the rates of the pitch state, and their change with numbers of state, wingbeat, vehicle and air."""

    def rates(numbers):
        chord, density, share, frequency, fold, sweep, twist, *pitch_state = numbers
        wing = changed_record(model.vehicle.wing, chord=chord * jnp.asarray(CHORD))
        flown = changed(
            model,
            vehicle=changed_record(model.vehicle, wing=wing),
            air=changed_record(model.air, density=density),
            unsteady=share,
        )
        flapped = changed_record(
            beat, frequency=frequency, fold_amplitude=fold, sweep_amplitude=sweep, twist_ratio=twist
        )
        state = jnp.stack(pitch_state)[:, None] * jnp.ones_like(phase)
        return body_rates(flown, motion_table(flown, flapped, phase), state).ravel()

    return jax.jvp(rates, (numbers,), (direction,))


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_derivatives_by_state_wingbeat_vehicle_and_air_are_those_of_differences(name):
    model, beat = all_terms(name)
    numbers = np.array([1.0, 1.2, 0.9, 6.0, 0.3, 0.2, 0.7, 0.3, 8.0, 0.4, 1.5])
    steps = [*[1e-3] * 7, 1e-4, 1e-3, 1e-3, 1e-2]

    def at(numbers, direction):
        return [
            np.asarray(a) for a in rates_and_change(model, beat, np.array([0.13, 0.4, 0.71]), numbers, direction)
        ]

    exact = np.stack([at(numbers, direction)[1] for direction in np.eye(numbers.size)], axis=-1)
    found = differences(lambda near: at(near, 0.0 * near)[0], numbers, steps)
    assert of_jacobians(exact, found) <= 1e-7
