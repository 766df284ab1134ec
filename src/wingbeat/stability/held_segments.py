"""The compiled program of many flights with linear feedback several times a beat."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, unpack
from wingbeat.mechanics.fixed_steps import fly_beat_in_steps
from wingbeat.mechanics.flight_model import FlightModel

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        AirOfFlights,
        Flights,
        FlownBumps,
        FlownTimes,
        FlownTops,
        NoiseInBeats,
        Scalar,
        StateVector,
    )


class SegmentHold(NamedTuple):
    """Linear feedback within a beat as arrays.

    Attributes
    ----------
    gains, limit : as in `SegmentFeedback`.
    numbers : of the parameters that make bumps, in the undisturbed wingbeat, shape (names,).
    shares : change of each by bumps of flap and pitch, shape (names, 2).
    phases, path : ends of the segments, and the orbit there, as in `SegmentFeedback`.
    pitch : body pitch of the orbit at the ends of all steps [rad], shape (segments, steps + 1).
    """

    gains: np.ndarray
    limit: np.ndarray
    numbers: np.ndarray
    shares: np.ndarray
    phases: np.ndarray
    path: np.ndarray
    pitch: np.ndarray


@exported(static=("names",))
def fly_held_segments(
    model: FlightModel,
    wingbeat: Wingbeat,
    hold: SegmentHold,
    start: StateVector,
    climb: Scalar,
    air: AirOfFlights,
    spacing: Scalar,
    noise: NoiseInBeats,
    *,
    names: tuple[str, ...],
) -> tuple[FlownTops, FlownTimes, FlownBumps, Flights]:
    """Fly many flights from one start, each through its own air.

    Parameters
    ----------
    model, wingbeat : what flies.
    hold : its feedback.
    start : state of the orbit at the top of the stroke.
    climb : mean climb rate of the orbit [m/s].
    air, spacing : as in `fly_beat_in_steps`.
    noise : what is added to the measured state, shape (beats, segments, 5, flights).
    names : of the parameters that make bumps.

    Returns
    -------
    States at the end of each beat, shape (beats, 6, flights), and its time; bumps of flap and pitch in each
    segment, shape (beats, segments, 2, flights); largest deviation of the body pitch from the orbit's.
    """
    flights = air.shape[0]

    def segment(carry: Any, asked: Any) -> tuple[Any, Any]:
        state, time, largest = carry
        gains, first, last, path, pitch, error = asked
        along = path.at[0].add(start[1] + climb * time[0])
        bumps = jnp.clip(-gains @ (state[1:] - along[:, None] + error), -hold.limit, hold.limit)
        bumps = jnp.where(jnp.isfinite(bumps), bumps, 0.0)  # the vehicle has tumbled
        changed = unpack(names, wingbeat, hold.numbers[:, None] + hold.shares @ bumps)
        ended, away = fly_beat_in_steps(model, changed, state, time, air, spacing, pitch, first, last)
        return (ended, time, jnp.maximum(largest, away)), bumps

    def beat(carry: Any, errors: Any) -> tuple[Any, Any]:
        segments = hold.gains, hold.phases[:-1], hold.phases[1:], hold.path[:-1], hold.pitch, errors
        (state, time, largest), bumps = jax.lax.scan(segment, carry, segments)
        time = time + 1.0 / wingbeat.frequency
        return (state, time, largest), (state, time, bumps)

    zeros = jnp.zeros(flights)
    begin = jnp.broadcast_to(start[:, None], (6, flights)), zeros, zeros
    (*_, largest), (states, times, bumps) = jax.lax.scan(beat, begin, noise)
    return states, times, bumps, largest
