"""Flights from an initial state with an adaptive integrator, wings prescribed or driven by torques."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from wingbeat._base import FaultList
from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported, jit_soon
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.equations_of_motion import accelerations_from_torques
from wingbeat.mechanics.flight_model import FlightModel, State, body_rates, motion_table

if TYPE_CHECKING:
    from wingbeat._jax.arrays import AirTable, AirVelocity, Integrated, Samples, Scalar, StartState, StateVector


RTOL = 1e-10
# Absolute tolerance divided by the relative one; states are in SI units and of order one.
_ATOL = 1e-2
# The integrator steps onto every fourth of the times asked for (_BETWEEN). It may take _IN_A_BEAT further steps in
# a beat, and _IN_A_FLIGHT in a flight with driven wings. The polynomials of all steps are kept.
_BETWEEN = 4
_IN_A_BEAT = 1024
_IN_A_FLIGHT = 4096
# The air's velocity is tabulated at this many equal phases of a beat. Between two of them, it is a cubic that
# depends on the nearest four.
_AIR_SAMPLES = 64
# Strips that a vector unit takes at a time. A flight with 16 strips, six of them without effect, takes 0.8 of the
# time of a flight with 10.
_VECTOR = 8


def state_rates(model: FlightModel, wingbeat: Wingbeat, phase: Scalar, state: StateVector) -> StateVector:
    """Return d/dt of (x, z, body_pitch, u, w, pitch_rate), with the wing's motion evaluated exactly at this phase.

    Theory: equation ``state-rates``.

    Parameters
    ----------
    model, wingbeat : what flies.
    phase : one phase.
    state : shape (6,) [m, rad, m/s, rad/s].
    """
    motion = motion_table(model, wingbeat, phase, _VECTOR)
    return jnp.concatenate([state[3:5], body_rates(model, motion, state[2:])])


def integrate(
    rates: Callable[..., Any], start: StartState, times: Samples, args: Any, most_steps: int, rtol: Scalar = RTOL
) -> Integrated:
    """Integrate with Dopri8.

    A step ends exactly at every fourth of the times; the integrator's own polynomials give the states at the times
    between. Steps that end at every time would take a third longer, and longer steps fail at kinks of the loads.

    Parameters
    ----------
    rates : of (time, state, args).
    start : state at the first time, shape (n,).
    times : increasing, shape (K,).
    args : passed to `rates`.
    most_steps : largest number of steps, not counting those that end at a given time.
    rtol : relative tolerance; the absolute one is a hundredth of it.

    Returns
    -------
    States at `times`, shape (K, n), NaN after the integrator gave up; times and states of its own steps, in arrays
    of the largest length, filled with infinity after the last step.
    """
    import diffrax  # half a second to import, and not needed where the traced program is on disk

    rates = jax.jit(rates)  # traced once, however often diffrax asks for its shape
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
    """Where an integrator stepped.

    Attributes
    ----------
    phase : phases, shape (M,).
    states : the states there, shape (M, 6), in the order and units of `State`.
    """

    phase: np.ndarray
    states: np.ndarray


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

    The slope of the cubics at a place is half the difference of the velocities at the two neighbouring places.

    Parameters
    ----------
    table : velocity at equal steps, from one step before place 0 to one step after the last place [m/s].
    place : steps from place 0; the first and last cubics go on beyond the ends.
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
) -> tuple[np.ndarray, Steps]:
    """Fly an initial state with prescribed wings.

    Parameters
    ----------
    model, wingbeat : what flies.
    state : at phase 0 [m, rad, m/s, rad/s].
    phases : in increasing order from 0, shape (K,); equal phases are allowed.
    rtol : relative tolerance.
    air : velocity of the air at the phases of `air_phases`, forward and up [m/s]; None for still air.

    Returns
    -------
    States (x, z, body_pitch, u, w, pitch_rate), shape (K, 6), NaN after the integrator gave up; and the
    integrator's steps.
    """
    given = model, wingbeat, np.array(state, dtype=float), phases, rtol
    states, at, there = _fly(*given) if air is None else _fly_in_wind(*given, air)
    count = int(np.isfinite(at).sum())
    # Copies, because a view of any part would keep the whole result of the program in memory.
    return states.copy(), Steps(at[:count].copy(), there[:count].copy())


def air_phases() -> np.ndarray:
    """Return the phases at which a flight needs the velocity of the air, from before the beat to after it."""
    return np.arange(-1, _AIR_SAMPLES + 2) / _AIR_SAMPLES


@functools.partial(jit_soon, static_argnums=0)
def _drive(
    torques: Any, model: FlightModel, wingbeat: Wingbeat, start: StartState, times: Samples, args: Any
) -> Integrated:
    def rates(time: Scalar, state: Any, args: Any) -> Any:
        q, q_dot = state[:5], state[5:]
        flown, beat, more = args
        torque = torques(time, more)
        return jnp.concatenate([q_dot, accelerations_from_torques(flown, beat, q, q_dot, time, torque)])

    return integrate(rates, start, times, (model, wingbeat, args), _IN_A_FLIGHT)


def fly_torque_driven(
    model: FlightModel,
    wingbeat: Wingbeat,
    coordinates: ArrayLike,
    rates: ArrayLike,
    torques: Callable[[Any, Any], Any],
    times: ArrayLike,
    args: Any = None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fly as `simulate_torque_driven` does; return times (K,), q and q' (K, 5).

    Raises
    ------
    InvalidInputError : wrong shapes, numbers that are not finite, angles above pi, or times that do not increase.
    """
    faults = FaultList()
    q, q_dot, when = (np.asarray(a, dtype=float) for a in (coordinates, rates, times))
    for name, value in (("coordinates", q), ("rates", q_dot)):
        if value.shape != (5,) or not np.isfinite(value).all():
            faults.add(name, value, "must be five finite numbers", "x, z, body_pitch, flap, pitch")
        elif name == "coordinates":
            for i, angle in enumerate(value[2:].tolist(), start=2):
                faults.angle(f"coordinates[{i}]", angle, advice=f"write np.radians({angle:g})")
    if when.ndim != 1 or when.size < 2 or not np.isfinite(when).all() or not (np.diff(when) > 0).all():
        faults.add("times", when, "must be at least two increasing times", "in seconds")
    faults.raise_if_any()
    states = np.asarray(_drive(torques, model, wingbeat, np.concatenate([q, q_dot]), when, args)[0])
    return when, states[:, :5], states[:, 5:]
