"""One beat of many flights at once in fixed Runge-Kutta steps, each flight with its own wingbeat and its own air.

Flights are the last axis, because XLA on CPU works along the last axis. The equations are those of one flight.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from wingbeat._jax.arrays import jax, jnp
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import FlightModel, body_rates, motion_table
from wingbeat.mechanics.flights import air_between

if TYPE_CHECKING:
    from wingbeat._jax.arrays import AirOfFlights, Flights, FlightStates, Samples, Scalar


def fly_beat_in_steps(
    model: FlightModel,
    wingbeat: Wingbeat,
    start: FlightStates,
    begun: Flights,
    air: AirOfFlights,
    spacing: Scalar,
    pitch: Samples,
    first: Scalar | float = 0.0,
    last: Scalar | float = 1.0,
) -> tuple[FlightStates, Flights]:
    """Fly one beat of many flights, or a part of it, with the classical Runge-Kutta method of order 4.

    Parameters
    ----------
    model : what flies.
    wingbeat : numbers, or arrays of shape (flights,).
    start : states at the first phase, shape (6, flights) [m, rad, m/s, rad/s].
    begun : time at phase 0 [s], shape (flights,).
    air : tables of the air's velocity, shape (flights, places, 2), as `air_between` takes them [m/s].
    spacing : time between two places of a table [s].
    pitch : body pitch of the undisturbed orbit at the ends of all steps [rad], shape (steps + 1,).
    first, last : phases at which the flights begin and end.

    Returns
    -------
    States at the last phase; largest deviation of the body pitch from `pitch` at an end of a step.
    """
    several, size = start.shape[1:], (last - first) / (pitch.shape[0] - 1)

    def motion_at(phase: Scalar) -> Any:
        return motion_table(model, wingbeat, jnp.broadcast_to(phase, several))

    def rates(motion: Any, phase: Scalar, state: FlightStates) -> FlightStates:
        place = (begun + phase / wingbeat.frequency) / spacing
        wind = jax.vmap(air_between, out_axes=1)(air, place)
        # The loads depend on the velocity through the air, and both frames have the same accelerations.
        by_time = body_rates(model, motion, state[2:].at[1:3].add(-wind))
        return jnp.concatenate([state[3:5], by_time]) / wingbeat.frequency

    def step(carry: Any, i: Scalar) -> tuple[Any, None]:
        state, motion, largest = carry
        phase = first + i * size
        middle, end = phase + 0.5 * size, phase + size
        half, whole = motion_at(middle), motion_at(end)
        k1 = rates(motion, phase, state)
        k2 = rates(half, middle, state + 0.5 * size * k1)
        k3 = rates(half, middle, state + 0.5 * size * k2)
        k4 = rates(whole, end, state + size * k3)
        state = state + size / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)
        away = jnp.abs(state[2] - pitch[i.astype(int) + 1])
        return (state, whole, jnp.maximum(largest, away)), None

    count = jnp.arange(pitch.shape[0] - 1, dtype=float)
    at_start = start, motion_at(jnp.asarray(first, dtype=float)), jnp.abs(start[2] - pitch[0])
    return jax.lax.scan(step, at_start, count)[0][::2]
