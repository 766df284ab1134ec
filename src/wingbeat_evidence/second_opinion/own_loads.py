"""Our own loads for a given motion, to show what each term of the air loads contributes to the same beat."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import in_own_settings, jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.aero.blade_element import BladeElement
from wingbeat.aero.closed_forms import body_drag, crossflow_force
from wingbeat.animal.kinematics import Wingbeat, flap_angle, pitch_angle
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.wing_points import air_forces_on, point_motion
from wingbeat.mechanics.wing_shape import time_rates
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


@in_own_settings
def own_loads(motion: Motion, aero: BladeElement, phase: np.ndarray) -> WingLoads:
    """Return the air loads of our blade elements for a given motion.

    Parameters
    ----------
    motion : of the vehicle; its accelerations need not agree with these loads.
    aero : the air loads.
    phase : phases of one beat, shape (K,).

    Raises
    ------
    InvalidInputError : an inflow model that has no solution at the mean velocity.
    """
    model = FlightModel(motion.vehicle, aero, motion.air, motion.velocity)
    acceleration = jnp.asarray(motion.acceleration(phase))
    found = _loads_along(model, motion.wingbeat, motion.state(phase), acceleration, jnp.asarray(phase))
    return WingLoads(*(np.asarray(value) for value in found))


@exported
def _loads_along(model: FlightModel, wingbeat: Wingbeat, state: State, acceleration: Any, phase: Any) -> Any:
    def at(body: State, body_acceleration: Any, when: Any) -> Any:
        flap, pitch = (
            time_rates(lambda t, law=law: law(wingbeat, t), when, wingbeat.frequency)
            for law in (flap_angle, pitch_angle)
        )
        q = jnp.stack([body.x, body.z, body.body_pitch, flap[0], pitch[0]])
        q_dot = jnp.stack([body.u, body.w, body.pitch_rate, flap[1], pitch[1]])
        q_second = jnp.concatenate([body_acceleration, jnp.stack([flap[2], pitch[2]])])
        points = point_motion(model, wingbeat, q, q_dot, when / wingbeat.frequency)
        air = air_forces_on(model, wingbeat, q, q_dot, when / wingbeat.frequency, points, q_second)
        trunk, density, velocity = model.vehicle.body, model.air.density, (body.u, body.w)
        upright = -jnp.sin(body.body_pitch), jnp.cos(body.body_pitch)
        along = body_drag(trunk.drag_area, density, velocity, jnp)
        across = crossflow_force(trunk.crossflow_area, density, upright, velocity, jnp)
        drag = along[0] + across[0], along[1] + across[1]
        forward, up = air.generalised[0] - drag[0], air.generalised[1] - drag[1]
        return forward, up, drag[0] * body.u + drag[1] * body.w - air.power, air.strips.alpha

    return jax.vmap(at)(state, acceleration, phase)
