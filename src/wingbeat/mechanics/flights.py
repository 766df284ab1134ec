"""Flights from an initial state with prescribed wings: one beat, several through moving air, many at once.

A single flight takes the adaptive steps of Dopri8, many flights at once take fixed Runge-Kutta steps. Flights are
then the last axis, because XLA on CPU works along the last axis; the equations are those of one flight.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import RTOL, Fault, FaultList, InvalidInputError
from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.aero.winds import Wind
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.state_rates import HINGE_STATE, body_rates, rate_table
from wingbeat.mechanics.strip_air import refuse_without_wake

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        AirOfFlights,
        AirTable,
        AirVelocity,
        Flights,
        FlightStates,
        Integrated,
        Samples,
        Scalar,
        StartState,
        StateVector,
    )

# Absolute tolerance divided by the relative one; states are in SI units and of order one.
_ATOL = 1e-2
# The integrator may take so many steps in a beat, besides those onto every fourth of the times. The polynomials of
# all steps are kept.
_BETWEEN = 4
_IN_A_BEAT = 1024
# The air's velocity is tabulated at this many equal phases of a beat. Between two of them, it is a cubic that
# depends on the nearest four.
_AIR_SAMPLES = 64
# Strips that a vector unit takes at a time. A flight with 16 strips, six of them without effect, takes 0.8 of the
# time of a flight with 10.
_VECTOR = 8


def state_rates(model: FlightModel, wingbeat: Wingbeat, phase: Scalar, state: StateVector) -> StateVector:
    """Return d/dt of (x, z, body_pitch, u, w, pitch_rate) at a phase. Theory: equation ``state-rates``."""
    # Padded strips would have states of their wake, too.
    motion = rate_table(model, wingbeat, phase, _VECTOR if model.wake is None else 1)
    return jnp.concatenate([state[3:5], body_rates(model, motion, state[2:])])


def integrate(
    rates: Callable[..., Any], start: StartState, times: Samples, args: Any, most_steps: int, rtol: Scalar = RTOL
) -> Integrated:
    """Integrate with Dopri8; `rates` takes (time, state, args).

    Returns the states at `times`, NaN after the integrator gave up, then times and states of its own steps, in
    arrays of the largest length, filled with infinity after the last step.
    """
    import diffrax  # half a second to import, and not needed where the traced program is on disk

    rates = jax.jit(rates)  # traced once, however often diffrax asks for its shape
    # A step ends exactly at every fourth of the times; its own polynomials give the states between. Steps that
    # end at every time would take a third longer, and longer steps fail at kinks of the loads.
    controller = diffrax.ClipStepSizeController(
        diffrax.PIDController(rtol=rtol, atol=_ATOL * rtol), step_ts=times[::_BETWEEN], store_rejected_steps=None
    )
    solution = diffrax.diffeqsolve(
        diffrax.ODETerm(rates),  # type: ignore[arg-type]
        diffrax.Dopri8(),
        times[0],
        times[-1],
        None,
        start,
        args=args,
        saveat=diffrax.SaveAt(t0=True, steps=True, dense=True),
        stepsize_controller=controller,
        adjoint=diffrax.ForwardMode(),
        max_steps=most_steps + times.size // _BETWEEN,
        throw=False,
    )
    found = jax.vmap(solution.evaluate)(times)
    return jnp.where(jnp.isfinite(found), found, jnp.nan), solution.ts, solution.ys


class Steps(NamedTuple):
    """Where an integrator stepped."""

    phase: np.ndarray  # shape (M,)
    states: np.ndarray  # shape (M, 6), in the order and units of `State`; then those of hinge and wake


@exported
def _fly(model: FlightModel, wingbeat: Wingbeat, start: StateVector, phases: Samples, rtol: Scalar) -> Integrated:
    def rates(phase: Scalar, state: StateVector, args: tuple[FlightModel, Wingbeat]) -> Any:
        flown, beat = args
        return state_rates(flown, beat, phase, state) / beat.frequency

    return integrate(rates, start, phases, (model, wingbeat), _IN_A_BEAT, rtol)


@exported
def _fly_in_wind(
    model: FlightModel, wingbeat: Wingbeat, start: StateVector, phases: Samples, rtol: Scalar, air: AirTable
) -> Integrated:
    """Fly through air whose velocity is tabulated from one place before the beat to one place after it."""

    def rates(phase: Scalar, state: StateVector, args: tuple[FlightModel, Wingbeat, AirTable]) -> Any:
        flown, beat, table = args
        wind = air_between(table, phase * _AIR_SAMPLES)
        # The loads depend on the velocity through the air. The accelerations relative to the air and to the ground
        # are equal.
        through_air = state_rates(flown, beat, phase, state.at[3:5].add(-wind))
        return through_air.at[:2].add(wind) / beat.frequency

    return integrate(rates, start, phases, (model, wingbeat, air), _IN_A_BEAT, rtol)


def air_between(table: AirTable, place: Scalar) -> AirVelocity:
    """Return the air's velocity between the places of a table, by cubics (Catmull-Rom).

    `table` holds velocities at equal steps, from one step before place 0 to one step after the last place; `place`
    counts steps from place 0; the first and last cubics go on beyond the ends.
    """
    first = jnp.clip(jnp.floor(place), 0, table.shape[0] - 4)
    before, here, there, behind = jax.lax.dynamic_slice_in_dim(table, first.astype(int), 4)
    s = place - first
    from_here, from_there = 0.5 * (there - before), 0.5 * (behind - here)
    bend = 3.0 * (there - here) - 2.0 * from_here - from_there
    return here + s * (from_here + s * (bend + s * (2.0 * (here - there) + from_here + from_there)))


def fly_through(
    model: FlightModel,
    wingbeat: Wingbeat,
    state: State,
    phases: np.ndarray,
    rtol: float = RTOL,
    air: np.ndarray | None = None,
    wake: tuple[np.ndarray, ...] = (),
) -> tuple[np.ndarray, Steps]:
    """Fly `state`, at phase 0, to phases that increase from 0; `air` is its velocity at the `air_phases`.

    `wake` holds the states at phase 0 of the lag of the wake, shape (2 strips,), or angle and rate of a hinge that
    gives way, shape (2,).

    Returns the states, shape (K, 6), and after them those of wake or hinge, NaN after the integrator gave up, and
    the integrator's steps.
    """
    given = model, wingbeat, np.concatenate([np.array(state, dtype=float), *wake]), phases, rtol
    states, at, there = _fly(*given) if air is None else _fly_in_wind(*given, air)
    count = int(np.isfinite(at).sum())
    # Copies, because a view of any part would keep the whole result of the program in memory.
    return states.copy(), Steps(at[:count].copy(), there[:count].copy())


def air_phases() -> np.ndarray:
    """Return the phases at which a flight needs the velocity of the air, from before the beat to after it."""
    return np.arange(-1, _AIR_SAMPLES + 2) / _AIR_SAMPLES


def state_of(given: Any) -> State:
    """Return a state that was given as a `State` or as its six numbers; refuse what is neither.

    >>> state_of(np.array([0.0, 0.0, 0.1, 10.0, 0.0, 0.0])).u
    10.0
    """
    faults = FaultList()
    if isinstance(given, State):
        values = list(given)
    else:
        values = np.asarray(given).tolist() if hasattr(given, "__array__") else given
        whole = isinstance(values, list | tuple) and len(values) == len(State._fields)
        if not whole or any(isinstance(value, list | tuple) for value in values):
            told = f"shape {np.shape(given)}" if hasattr(given, "__array__") else given
            rule = "must be a State or six numbers: x, z [m], body_pitch [rad], u, w [m/s], pitch_rate [rad/s]"
            faults.add("initial_state", told, rule, "for example wb.State(u=10.0), or flight.states[-1]")
            faults.raise_if_any()
    for name, value in zip(State._fields, values, strict=True):
        where = f"initial_state.{name}"
        if name == "body_pitch":  # a body that has turned over has a pitch within half a turn too
            faults.angle(where, value, advice=f"write np.radians({value}), or take whole turns away")
        else:
            faults.number(where, value)
    faults.raise_if_any()
    return State(*values)


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

    `begun` is the time at phase 0 of each flight, `spacing` [s] that of the places in `air`. Returns the states at
    phase `last`, and the largest deviation of the body pitch from `pitch`, that of the undisturbed orbit at the
    ends of all steps.
    """
    several, size = start.shape[1:], (last - first) / (pitch.shape[0] - 1)

    def motion_at(phase: Scalar) -> Any:
        return rate_table(model, wingbeat, jnp.broadcast_to(phase, several))

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


# Takes the number of beats flown and the state at the top of the stroke; returns the wingbeat of the next beat.
Controller = Callable[[int, State], Wingbeat]


class FlownBeats(NamedTuple):
    """A flight of several beats."""

    phase: np.ndarray  # beats since the start, shape (K,)
    states: np.ndarray  # (x, z, body_pitch, u, w, pitch_rate) there, NaN after the integrator gave up
    wingbeats: tuple[Wingbeat, ...]  # of each beat
    air: np.ndarray | None  # its velocity there, forward and up [m/s], shape (K, 2); None for still air
    hinge: np.ndarray | None  # angle and rate of a hinge that gives way, shape (K, 2) [rad, rad/s]


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


def hinge_of(given: Any, wingbeat: Wingbeat) -> np.ndarray:
    """Return angle and rate at phase 0 of a wingbeat's hinge, shape (2,), at rest if not given; (0,) without one.

    >>> hinge_of(None, Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3)).shape
    (0,)
    """
    faults, hinge = FaultList(), wingbeat.pitch_hinge
    if hinge is None:
        if given is not None:
            rule = "has no effect on a wing whose pitch is prescribed"
            faults.add("hinge", given, rule, "leave it out, or set pitch_hinge.stiffness")
            faults.raise_if_any()
        return np.zeros(0)
    if given is None:
        return np.array([hinge.rest_angle, 0.0], dtype=float)
    values = np.asarray(given).tolist() if hasattr(given, "__array__") else given
    if isinstance(given, Mapping) and given.keys() == {*HINGE_STATE}:
        values = [given[name] for name in HINGE_STATE]
    if not isinstance(values, list | tuple) or len(values) != len(HINGE_STATE):
        faults.add("hinge", given, "must be two numbers", "angle [rad] and rate [rad/s], or leave it out for rest")
        faults.raise_if_any()
    faults.angle("hinge.angle", values[0])
    faults.number("hinge.rate", values[1], unit="rad/s")
    faults.raise_if_any()
    return np.array(values, dtype=float)


def fly_beats(
    model: FlightModel,
    wingbeat: Wingbeat,
    state: State,
    beats: int,
    samples: int,
    wind: Wind | tuple[float, float] | None = None,
    controller: Controller | None = None,
    hinge: Any = None,
) -> FlownBeats:
    """Fly several beats, ``beats * samples + 1`` samples in all; None is still air, and a hinge at rest."""
    refuse_without_wake(model)
    one_beat, current, begun = np.linspace(0.0, 1.0, samples + 1), state, 0.0
    turned = hinge_of(hinge, wingbeat)
    pieces, wingbeats, airs = [np.concatenate([np.array(state, dtype=float), turned])[None]], [], []
    for beat in range(beats):
        now = wingbeat if controller is None else commanded(controller, beat, current, turned.size > 0)
        wingbeats.append(now)
        table = None
        if wind is not None:
            table = air_at(wind, begun + air_phases() / now.frequency)
            airs.append(air_at(wind, begun + one_beat[beat > 0 :] / now.frequency))
        flown, _ = fly_through(model, now, current, one_beat, air=table, wake=(turned,))
        current, turned = State(*flown[-1, :6]), flown[-1, 6:]
        pieces.append(flown[1:])
        begun += 1.0 / now.frequency
    phase, whole = np.linspace(0.0, beats, beats * samples + 1), np.concatenate(pieces)
    air, given = np.concatenate(airs) if airs else None, whole[:, 6:] if turned.size else None
    return FlownBeats(phase, whole[:, :6].copy(), tuple(wingbeats), air, given)


def commanded(controller: Controller, beat: int, state: State, gives: bool) -> Wingbeat:
    """Return the wingbeat that a controller asks for; `gives` says whether the wing's pitch gives way."""
    wingbeat = controller(beat, state)
    if not isinstance(wingbeat, Wingbeat):
        rule = f"returned {type(wingbeat).__name__} after {beat} beats"
        raise InvalidInputError([Fault("controller", wingbeat, rule, "return a Wingbeat")])
    if (wingbeat.pitch_hinge is not None) != gives:
        rule = f"{'takes away' if gives else 'adds'} the hinge that gives way, after {beat} beats"
        raise InvalidInputError(
            [Fault("controller", wingbeat.pitch_hinge, rule, "keep pitch_hinge in the wingbeat")]
        )
    return wingbeat


def air_at(wind: Wind | tuple[float, float], times: np.ndarray) -> np.ndarray:
    """Return the velocity of the air at given times, forward and up [m/s], shape (K, 2)."""
    velocity = wind(times) if callable(wind) else wind
    try:
        columns = [np.broadcast_to(np.asarray(part, dtype=float), times.shape) for part in velocity]
    except (TypeError, ValueError):
        columns = []
    if len(columns) != 2 or not np.isfinite(columns).all():
        rule = f"must return two finite velocities for each of {len(times)} times"
        raise InvalidInputError([Fault("wind", velocity, rule, "forward and up [m/s]")])
    return np.column_stack(columns)
