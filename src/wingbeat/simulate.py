"""Flights from an initial state with an adaptive integrator, wings prescribed or driven by torques."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import diffrax
import numpy as np

from wingbeat.equations_of_motion import accelerations_from_torques
from wingbeat.errors import FaultList
from wingbeat.jax64 import jax, jnp
from wingbeat.kinematics import Wingbeat
from wingbeat.model import FlightModel, State, body_rates, check_state, motion_table

RTOL, ATOL = 1e-10, 1e-12
MAX_STEPS = 4096


@dataclass(frozen=True)
class Flight:
    """A flight sampled at phases: beats flown since the start, and the state at each."""

    model: FlightModel
    wingbeat: Wingbeat
    phase: np.ndarray
    state: State

    @property
    def time(self) -> np.ndarray:
        """Time since the start [s]."""
        return self.phase / self.wingbeat.frequency


def state_rates(model: FlightModel, wingbeat: Wingbeat, phase: Any, state: Any) -> Any:
    """Return d/dt of (x, z, body_pitch, u, w, pitch_rate), the wing's motion evaluated at this very phase."""
    return jnp.concatenate([state[3:5], body_rates(model, motion_table(model, wingbeat, phase), state[2:])])


def integrate(rates: Callable[..., Any], start: Any, times: Any, first_step: Any, args: Any) -> Any:
    """Integrate with Dopri8 at rtol 1e-10, stepping exactly onto `times`; not-a-number where it fails."""
    solution = diffrax.diffeqsolve(
        diffrax.ODETerm(rates),  # type: ignore[arg-type]
        diffrax.Dopri8(),
        times[0],
        times[-1],
        first_step,
        start,
        args=args,
        saveat=diffrax.SaveAt(ts=times),
        stepsize_controller=diffrax.ClipStepSizeController(
            diffrax.PIDController(rtol=RTOL, atol=ATOL), step_ts=times
        ),
        adjoint=diffrax.ForwardMode(),
        max_steps=MAX_STEPS,
        throw=False,
    )
    return jnp.where(jnp.isfinite(solution.ys), solution.ys, jnp.nan)


@jax.jit
def _fly(model: FlightModel, wingbeat: Wingbeat, start: Any, phases: Any) -> Any:
    period = 1.0 / wingbeat.frequency

    def rates(phase: Any, state: Any, args: Any) -> Any:
        return period * state_rates(*args, phase, state)

    return integrate(rates, start, phases, 1e-3, (model, wingbeat))


def simulate(
    model: FlightModel, wingbeat: Wingbeat, state: State, beats: int = 1, samples: int = 128
) -> Flight:
    """Fly an initial state for a number of wingbeats with prescribed wings.

    Parameters
    ----------
    model : the flight model.
    wingbeat : the prescribed wingbeat.
    state : the state at phase 0, the top of the stroke [m, rad, m/s, rad/s].
    beats : number of wingbeats.
    samples : samples a beat.

    Returns
    -------
    Flight : the states at ``beats * samples + 1`` phases; not-a-number from where the vehicle tumbled so fast that
        the integrator gave up.

    Raises
    ------
    InvalidInputError : a state that is not finite, beats or samples that are not whole numbers of at least 1.
    """
    faults = FaultList()
    for name, value, most in (("beats", beats, 10_000), ("samples", samples, 4096)):
        if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= most:
            faults.add(name, value, f"must be a whole number from 1 to {most}")
    faults.raise_if_any()
    check_state(state)
    one_beat = np.linspace(0.0, 1.0, samples + 1)
    current, pieces = np.array(state, dtype=float), [np.array([state], dtype=float)]
    for _ in range(beats):
        flown = np.asarray(_fly(model, wingbeat, current, one_beat))
        current = flown[-1]
        pieces.append(flown[1:])
    states = np.concatenate(pieces)
    phase = np.linspace(0.0, beats, beats * samples + 1)
    return Flight(model, wingbeat, phase, State(*states.T))


@functools.partial(jax.jit, static_argnames=("torques",))
def _drive(model: FlightModel, wingbeat: Wingbeat, start: Any, times: Any, torques: Any, args: Any) -> Any:
    def rates(time: Any, state: Any, args: Any) -> Any:
        q, q_dot = state[:5], state[5:]
        forced = accelerations_from_torques(model, wingbeat, q, q_dot, time, torques(time, args))
        return jnp.concatenate([q_dot, forced])

    return integrate(rates, start, times, 1e-3 / wingbeat.frequency, args)


def simulate_torque_driven(
    model: FlightModel,
    wingbeat: Wingbeat,
    coordinates: Any,
    rates: Any,
    torques: Callable[[Any, Any], Any],
    times: Any,
    args: Any = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Fly all five coordinates (x, z, body_pitch, flap, pitch) with the hinges driven by torques.

    Parameters
    ----------
    model : the flight model.
    wingbeat : gives span, fold and twist; its flap and pitch laws do not enter.
    coordinates, rates : q and q' at the first time, shape (5,) each [m, rad; per s].
    torques : JAX-traceable function of time [s] and `args` giving (flap, pitch) torques of both wings [N m].
    times : increasing sample times [s], shape (K,).
    args : passed to `torques`.

    Returns
    -------
    (q, q') : shape (K, 5) each; not-a-number where the integrator gave up.

    Raises
    ------
    InvalidInputError : wrong shapes, not finite, or times that do not increase.
    """
    faults = FaultList()
    q, q_dot, when = (np.asarray(a, dtype=float) for a in (coordinates, rates, times))
    for name, value in (("coordinates", q), ("rates", q_dot)):
        if value.shape != (5,) or not np.isfinite(value).all():
            faults.add(name, value, "must be five finite numbers", "x, z, body_pitch, flap, pitch")
    if when.ndim != 1 or when.size < 2 or not np.isfinite(when).all() or not (np.diff(when) > 0).all():
        faults.add("times", when, "must be at least two increasing times", "in seconds")
    faults.raise_if_any()
    states = np.asarray(_drive(model, wingbeat, np.concatenate([q, q_dot]), when, torques, args))
    return states[:, :5], states[:, 5:]
