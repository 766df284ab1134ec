"""The compiled program of many flights with linear feedback from beat to beat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, unpack
from wingbeat.mechanics.fixed_steps import fly_beat_in_steps
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.stability.smooth_commands import Smoother, parameters_of

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        AirOfFlights,
        Flights,
        FlownCommands,
        FlownTimes,
        FlownTops,
        NoiseOfFlights,
        Scalar,
    )


class Hold(NamedTuple):
    """Linear feedback as arrays.

    Attributes
    ----------
    gains, lower, upper : as in `Feedback`.
    smoother : keeps the wing from jumping.
    """

    gains: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    smoother: Smoother


class Course(NamedTuple):
    """The orbit that is held.

    Attributes
    ----------
    start : state at the top of the stroke, shape (6,).
    pitch : body pitch at the ends of all steps of a beat [rad], shape (steps + 1,).
    climb : mean climb rate [m/s].
    """

    start: np.ndarray
    pitch: np.ndarray
    climb: np.ndarray


@exported(static=("inputs", "harmonics", "delay", "late"))
def fly_held_beats(
    model: FlightModel,
    wingbeat: Wingbeat,
    hold: Hold,
    course: Course,
    air: AirOfFlights,
    spacing: Scalar,
    noise: NoiseOfFlights,
    *,
    inputs: tuple[str, ...],
    harmonics: tuple[str, ...],
    delay: int,
    late: int,
) -> tuple[FlownTops, FlownTimes, FlownCommands, Flights]:
    """Fly many flights from one start, each through its own air.

    Parameters
    ----------
    model, wingbeat : what flies.
    hold : its feedback.
    course : the orbit.
    air, spacing : as in `fly_beat_in_steps`.
    noise : what is added to the measured state, shape (beats, 5, flights).
    inputs, harmonics : names of the inputs of the feedback, and of the harmonics that go with them.
    delay : beats by which inputs act later.
    late : beats by which they act later still, unknown to the feedback.

    Returns
    -------
    States at the end of each beat, shape (beats, 6, flights), and its time; changes of the inputs, as they act,
    shape (beats, inputs, flights); largest deviation of the body pitch from the orbit's.
    """
    flights, count = air.shape[0], len(inputs)
    start = jnp.broadcast_to(course.start[:, None], (6, flights))

    def beat(carry: Any, error: Any) -> tuple[Any, Any]:
        state, time, waiting, largest = carry
        path = start[1:].at[0].add(course.climb * time)
        known = jnp.concatenate([state[1:] - path + error, *waiting[late:]])
        command = jnp.clip(-hold.gains @ known, hold.lower[:, None], hold.upper[:, None])
        queue = jnp.concatenate([waiting, command[None]])
        acting, waiting = queue[0], queue[1:]
        changed = wingbeat
        if inputs:
            numbers = parameters_of(wingbeat, hold.smoother, acting, inputs=inputs, harmonics=harmonics)
            changed = unpack((*inputs, *harmonics), wingbeat, numbers)
        ended, away = fly_beat_in_steps(model, changed, state, time, air, spacing, course.pitch)
        time = time + 1.0 / changed.frequency
        return (ended, time, waiting, jnp.maximum(largest, away)), (ended, time, acting)

    zeros = jnp.zeros(flights)
    begin = start, zeros, jnp.zeros((delay + late, count, flights)), zeros
    (*_, largest), (states, times, changes) = jax.lax.scan(beat, begin, noise)
    return states, times, changes, largest
