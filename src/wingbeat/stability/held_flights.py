"""The compiled program of many flights with linear feedback over the segments of a beat, or once a beat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, unpack
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.flights import fly_beat_in_steps
from wingbeat.stability.inputs import Smoother, parameters_of

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        AirOfFlights,
        Flights,
        FlownCommands,
        FlownTimes,
        FlownTops,
        NoiseOfFlights,
        Scalar,
        StateVector,
    )


class Hold(NamedTuple):
    """Linear feedback as arrays; feedback from beat to beat has one segment.

    Attributes
    ----------
    gains : of each segment, shape (segments, commands, 5 + delay * commands).
    lower, upper : largest commands, shape (commands,).
    shares : changes of the inputs per unit of each command, shape (inputs, commands).
    smoother : makes the parameters of a wingbeat from changes of the inputs.
    phases : ends of the segments, shape (segments + 1,).
    path : (z, body_pitch, u, w, pitch_rate) of the orbit at their starts, z from that at phase 0, (segments, 5).
    pitch : body pitch of the orbit at the ends of all steps [rad], shape (segments, steps + 1).
    """

    gains: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    shares: np.ndarray
    smoother: Smoother
    phases: np.ndarray
    path: np.ndarray
    pitch: np.ndarray


@exported(static=("inputs", "harmonics", "delay", "late"))
def fly_held(
    model: FlightModel,
    wingbeat: Wingbeat,
    hold: Hold,
    start: StateVector,
    climb: Scalar,
    air: AirOfFlights,
    spacing: Scalar,
    noise: NoiseOfFlights,
    *,
    inputs: tuple[str, ...],
    harmonics: tuple[str, ...],
    delay: int,
    late: int,
) -> tuple[FlownTops, FlownTimes, FlownCommands, Flights]:
    """Fly many flights from one start on an orbit that climbs by `climb` [m/s], each through its own air.

    Parameters
    ----------
    model, wingbeat, hold : what flies, and its feedback.
    start, climb : state of the orbit at the top of the stroke, and its mean climb rate.
    air, spacing : as in `fly_beat_in_steps`.
    noise : what is added to the measured state.
    inputs, harmonics : names of the inputs that change, and of the harmonics that go with them.
    delay, late : segments by which commands act later: known to the feedback, and unknown to it.

    Returns
    -------
    States at the end of each beat, and its time; commands of each segment, as they act; largest deviation of the
    body pitch from the orbit's.
    """
    flights, count = air.shape[0], hold.lower.shape[0]

    def segment(carry: Any, asked: Any) -> tuple[Any, Any]:
        state, time, waiting, largest = carry
        gains, first, last, path, pitch, error = asked
        along = jnp.broadcast_to(path[:, None], (5, flights)).at[0].add(start[1] + climb * time)
        known = jnp.concatenate([state[1:] - along + error, *waiting[late:]])
        command = jnp.clip(-gains @ known, hold.lower[:, None], hold.upper[:, None])
        command = jnp.where(jnp.isfinite(command), command, 0.0)  # the vehicle has tumbled
        queue = jnp.concatenate([waiting, command[None]])
        acting, waiting = queue[0], queue[1:]
        changed = wingbeat
        if inputs:
            changes = hold.shares @ acting
            numbers = parameters_of(wingbeat, hold.smoother, changes, inputs=inputs, harmonics=harmonics)
            changed = unpack((*inputs, *harmonics), wingbeat, numbers)
        ended, away = fly_beat_in_steps(model, changed, state, time, air, spacing, pitch, first, last)
        period = jnp.broadcast_to(1.0 / changed.frequency, (flights,))
        return (ended, time, waiting, jnp.maximum(largest, away)), (acting, period)

    def beat(carry: Any, errors: Any) -> tuple[Any, Any]:
        segments = hold.gains, hold.phases[:-1], hold.phases[1:], hold.path, hold.pitch, errors
        if errors.shape[0] == 1:  # no loop within the loop
            only = hold.gains[0], 0.0, 1.0, hold.path[0], hold.pitch[0], errors[0]
            (state, time, waiting, largest), (acting, period) = segment(carry, only)
            commands, periods = acting[None], period[None]
        else:
            (state, time, waiting, largest), (commands, periods) = jax.lax.scan(segment, carry, segments)
        time = time + periods[-1]
        return (state, time, waiting, largest), (state, time, commands)

    zeros = jnp.zeros(flights)
    begin = jnp.broadcast_to(start[:, None], (6, flights)), zeros, jnp.zeros((delay + late, count, flights)), zeros
    (*_, largest), (states, times, commands) = jax.lax.scan(beat, begin, noise)
    return states, times, commands, largest
