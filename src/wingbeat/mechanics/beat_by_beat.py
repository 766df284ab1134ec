"""Flights of several beats, through still or moving air, with a wingbeat that may change from beat to beat."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat.aero.winds import Wind
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.flights import air_phases, fly_through

# Takes the number of beats flown and the state at the top of the stroke; returns the wingbeat of the next beat.
Controller = Callable[[int, State], Wingbeat]


class FlownBeats(NamedTuple):
    """A flight of several beats.

    Attributes
    ----------
    phase : beats since the start, shape (K,).
    states : (x, z, body_pitch, u, w, pitch_rate) there, shape (K, 6), NaN after the integrator gave up.
    wingbeats : the wingbeat of each beat.
    air : velocity of the air there, forward and up [m/s], shape (K, 2); None for still air.
    """

    phase: np.ndarray
    states: np.ndarray
    wingbeats: tuple[Wingbeat, ...]
    air: np.ndarray | None


def check_samples(faults: FaultList, beats: int, samples: int) -> None:
    """Note numbers of beats, and of samples in each, that no flight can have."""
    faults.whole("beats", beats, 1, 10_000)
    faults.whole("samples", samples, 1, 4096)


def check_wind(faults: FaultList, wind: object) -> None:
    """Note a wind that is neither two finite velocities nor a function."""
    if isinstance(wind, tuple | list):
        if len(wind) != 2:
            faults.add("wind", wind, "must be two velocities", "forward and up [m/s]")
        for name, value in zip("uw", wind, strict=False):
            faults.number(f"wind.{name}", value, unit="m/s")
    elif wind is not None and not callable(wind):
        fix = "for example wb.winds.CosineGust(w=2.0)"
        faults.add("wind", wind, "must be two velocities or a function of times", fix)


def fly_beats(
    model: FlightModel,
    wingbeat: Wingbeat,
    state: State,
    beats: int,
    samples: int,
    wind: Wind | tuple[float, float] | None = None,
    controller: Controller | None = None,
) -> FlownBeats:
    """Fly several beats with prescribed wings, ``beats * samples + 1`` samples in all.

    Parameters
    ----------
    model, wingbeat, state : as in `fly_through`.
    beats : number of beats.
    samples : number of samples in each beat.
    wind : velocity of the air: two numbers, or a function of times; None for still air.
    controller : gives the wingbeat of each beat; None for the same wingbeat in all.

    Raises
    ------
    InvalidInputError : a wind that gives no finite velocities, a controller that returns no wingbeat.
    """
    one_beat, current, begun = np.linspace(0.0, 1.0, samples + 1), state, 0.0
    pieces, wingbeats, airs = [np.array([state], dtype=float)], [], []
    for beat in range(beats):
        now = wingbeat if controller is None else commanded(controller, beat, current)
        wingbeats.append(now)
        table = None
        if wind is not None:
            table = air_at(wind, begun + air_phases() / now.frequency)
            airs.append(air_at(wind, begun + one_beat[beat > 0 :] / now.frequency))
        flown, _ = fly_through(model, now, current, one_beat, air=table)
        current = State(*flown[-1])
        pieces.append(flown[1:])
        begun += 1.0 / now.frequency
    phase = np.linspace(0.0, beats, beats * samples + 1)
    return FlownBeats(phase, np.concatenate(pieces), tuple(wingbeats), np.concatenate(airs) if airs else None)


def commanded(controller: Controller, beat: int, state: State) -> Wingbeat:
    """Return the wingbeat that a controller asks for.

    Parameters
    ----------
    controller : gives the wingbeat of each beat.
    beat : number of beats flown.
    state : at the top of the stroke.

    Raises
    ------
    InvalidInputError : the controller returns no wingbeat.
    """
    wingbeat = controller(beat, state)
    if not isinstance(wingbeat, Wingbeat):
        rule = f"returned {type(wingbeat).__name__} after {beat} beats"
        raise InvalidInputError([Fault("controller", wingbeat, rule, "return a Wingbeat")])
    return wingbeat


def air_at(wind: Wind | tuple[float, float], times: np.ndarray) -> np.ndarray:
    """Return the velocity of the air at given times, forward and up [m/s], shape (K, 2).

    Parameters
    ----------
    wind : two numbers, or a function of times.
    times : [s], shape (K,).

    Raises
    ------
    InvalidInputError : a wind that returns something else.
    """
    velocity = wind(times) if callable(wind) else wind
    try:
        columns = [np.broadcast_to(np.asarray(part, dtype=float), times.shape) for part in velocity]
    except (TypeError, ValueError):
        columns = []
    if len(columns) != 2 or not np.isfinite(columns).all():
        rule = f"must return two finite velocities for each of {len(times)} times"
        raise InvalidInputError([Fault("wind", velocity, rule, "forward and up [m/s]")])
    return np.column_stack(columns)
