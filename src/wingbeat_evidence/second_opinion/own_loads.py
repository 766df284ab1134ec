"""Our own loads for a given motion, to show what each term of the air loads contributes to the same beat."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import in_own_settings, jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.aero.blade_element import BladeElement
from wingbeat.aero.wake import wake_rates
from wingbeat.animal.kinematics import Wingbeat, flap_angle, pitch_angle
from wingbeat.mechanics.flight_model import FlightModel, State, motion_table
from wingbeat.mechanics.strip_air import wake_of
from wingbeat.mechanics.wing_points import air_forces_on, point_motion
from wingbeat.mechanics.wing_shape import time_rates
from wingbeat.orbits.flight.march import ALONG, PLACES, WEIGHTS
from wingbeat_evidence.second_opinion.motion import Motion


class WingLoads(NamedTuple):
    """Loads of both wings over a beat, arrays of shape (K,).

    Attributes
    ----------
    thrust, lift : force forward and up in the world [N].
    power : power that the wings give to the air: minus force times velocity relative to still air [W].
    alpha : angles of attack of the strips [rad], shape (K, N); None where the code has no strips.
    """

    thrust: np.ndarray
    lift: np.ndarray
    power: np.ndarray
    alpha: np.ndarray | None = None


# Steps of a beat in which the states of the wake are integrated.
_STEPS = 512


@in_own_settings
def own_loads(motion: Motion, aero: BladeElement, phase: np.ndarray) -> WingLoads:
    """Return the air loads of our blade elements for a given motion; with the lag, of a wake that repeats.

    Parameters
    ----------
    motion : of the vehicle; its accelerations need not agree with these loads.
    aero : the air loads.
    phase : phases of one beat, shape (K,).

    Raises
    ------
    InvalidInputError : an inflow model that has no solution at the mean velocity; wings too short for the lag.
    """
    model = FlightModel(motion.vehicle, aero, motion.air, motion.velocity)
    more = () if model.wake is None else (jnp.asarray(_wake_states(model, motion, phase)),)
    acceleration = jnp.asarray(motion.acceleration(phase))
    found = _loads_along(model, motion.wingbeat, motion.state(phase), acceleration, jnp.asarray(phase), *more)
    return WingLoads(*(np.asarray(value) for value in found))


def _wake_states(model: FlightModel, motion: Motion, phase: np.ndarray) -> np.ndarray:
    """Return the states of the wake that repeat after a beat [m/s], shape (K, 2 N)."""
    from scipy.interpolate import CubicSpline

    assert model.wake is not None
    rates, step = model.wake.rates, motion.period / _STEPS
    ends = np.arange(2 * _STEPS + 1) / (2 * _STEPS)  # of the steps, and their middles
    shed, pace = map(np.asarray, _shed_along(model, motion.wingbeat, motion.state(ends), jnp.asarray(ends)))

    def beat(states: np.ndarray) -> np.ndarray:
        path = [states]
        for begin in range(0, 2 * _STEPS, 2):
            slope, mean = np.zeros_like(states), np.zeros_like(states)
            for at, along, weight in zip(PLACES, ALONG, WEIGHTS, strict=True):
                here, now = path[-1] + along * step * slope, begin + at
                slope = np.stack(wake_rates(rates, pace[now], shed[now], here))
                mean += weight * slope
            path.append(path[-1] + step * mean)
        return np.stack(path)

    # The rates are linear in each state, so two beats determine the one that repeats.
    nothing = np.zeros((2, model.strips))
    still = beat(nothing)
    by_start = beat(nothing + 1.0) - still
    path = still + by_start * (still[-1] / (1.0 - by_start[-1]))
    return CubicSpline(ends[::2], path.reshape(len(path), -1))(phase)


@exported
def _shed_along(model: FlightModel, wingbeat: Wingbeat, state: State, phase: Any) -> Any:
    """Return what the strips shed [m/s] and their pace [semi-chords/s], shape (K, N) each."""

    def at(body: State, when: Any) -> Any:
        states = jnp.zeros(2 * model.strips)  # no part of either
        flown = jnp.concatenate([jnp.stack([body.body_pitch, body.u, body.w, body.pitch_rate]), states])
        wake = wake_of(model, motion_table(model, wingbeat, when), flown)
        assert wake is not None
        return wake.shed, wake.pace

    return jax.vmap(at)(state, phase)


@exported
def _loads_along(
    model: FlightModel, wingbeat: Wingbeat, state: State, acceleration: Any, phase: Any, wake: Any = None
) -> Any:
    def at(body: State, body_acceleration: Any, when: Any, states: Any) -> Any:
        flap, pitch = (
            time_rates(lambda t, law=law: law(wingbeat, t), when, wingbeat.frequency)
            for law in (flap_angle, pitch_angle)
        )
        q = jnp.stack([body.x, body.z, body.body_pitch, flap[0], pitch[0]])
        q_dot = jnp.stack([body.u, body.w, body.pitch_rate, flap[1], pitch[1]])
        q_second = jnp.concatenate([body_acceleration, jnp.stack([flap[2], pitch[2]])])
        points = point_motion(model, wingbeat, q, q_dot, when / wingbeat.frequency)
        air = air_forces_on(model, wingbeat, q, q_dot, when / wingbeat.frequency, points, q_second, states)
        force = 2.0 * jnp.sum(air.strip_force, axis=0)  # without body and tail
        return force[0], force[2], -air.power - air.spent.parasite, air.strips.alpha

    return jax.vmap(at)(state, acceleration, phase, wake)
