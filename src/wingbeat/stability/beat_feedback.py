"""Feedback from beat to beat that holds an orbit, and the controller that flies it: `feedback`."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, Report, Reported, __version__
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import State
from wingbeat.stability.inputs import Smoother, changed_wingbeat, smoother
from wingbeat.stability.linear_flight import LinearFlight, linearise
from wingbeat.stability.options import (
    FEEDBACK,
    FLIGHT_STATE,
    MOST_DELAY,
    FeedbackOptions,
    check_delay,
    command_limits,
    noise_of,
    weights_of,
)
from wingbeat.stability.reports import feedback_report, pairs
from wingbeat.stability.riccati import (
    Reach,
    check_reach,
    closed_loop,
    delayed,
    linear_quadratic,
    multipliers_over,
    reaches,
    sufficient,
)

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit


@dataclass(frozen=True)
class Feedback(Reported):
    """Feedback that changes the wingbeat at each top of the stroke; made by `feedback`.

    With the state's deviation x from the orbit and the inputs ``y[1] ... y[delay]`` of the last beats, the oldest
    first, the new inputs are ``-gains @ [x, y[1], ..., y[delay]]``, limited to `lower` and `upper`. They act
    `delay` beats later.

    Attributes
    ----------
    flight : the linear flight for which it was computed; its state begins with the height.
    delay : beats by which inputs act later.
    gains : shape (inputs, 5 + delay * inputs) [unit of the input per unit of the state]. The columns belong to
        `gain_columns`.
    cost : matrix P of the cost to go ``x' P x``, shape (5 + delay * inputs, 5 + delay * inputs) [1].
    lower, upper : largest changes of the inputs, shape (inputs,) [Hz, rad or shares].
    controllability : what the inputs do to each mode, the fastest growing first.
    sufficient : every input that alone reaches all modes that do not decay without feedback.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> held = wb.feedback(orbit)
    >>> held.gains.shape, bool(held.spectral_radius < 1.0)
    ((5, 5), True)
    """

    flight: LinearFlight
    delay: int
    gains: np.ndarray
    cost: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    controllability: tuple[Reach, ...]
    sufficient: tuple[str, ...]

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the parameters of the wingbeat that it changes."""
        return self.flight.inputs

    @property
    def multipliers(self) -> np.ndarray:
        """Multipliers of the flight with feedback and all pending inputs, the largest first."""
        return self.multipliers_if_late(0)

    @property
    def gain_columns(self) -> tuple[str, ...]:
        """Names of the columns of `gains`: the state, then each waiting input, such as ``frequency, 1 beat ago``.

        An input that was computed several beats ago comes first.
        """
        ago = (f"{beats} beat{'s' if beats > 1 else ''} ago" for beats in range(self.delay, 0, -1))
        return (*self.flight.state, *(f"{name}, {when}" for when in ago for name in self.inputs))

    @property
    def spectral_radius(self) -> float:
        """Largest modulus of a multiplier with feedback; below 1 disturbances decay."""
        return float(np.abs(self.multipliers[0]))

    def multipliers_if_late(self, late: int) -> np.ndarray:
        """Return the multipliers with more delay than the feedback was computed for, the largest first.

        Parameters
        ----------
        late : number of beats beyond `delay`.

        Raises
        ------
        InvalidInputError : not a whole number from 0 to 4.
        """
        faults = FaultList()
        faults.whole("late", late, 0, MOST_DELAY)
        faults.raise_if_any()
        return multipliers_over([closed_loop(*_deviation_map(self.flight), self.gains, self.delay, late)])

    @functools.cached_property
    def smoother(self) -> Smoother:
        """What keeps the wing from jumping when inputs change."""
        return smoother(self.flight.orbit.wingbeat, self.inputs, self.flight.compensation)

    def wingbeat(self, changes: Sequence[float] | np.ndarray) -> Wingbeat:
        """Return the orbit's wingbeat with changed inputs, whose wing does not jump at the top of the stroke.

        Parameters
        ----------
        changes : of the inputs, shape (inputs,) [Hz, rad or shares].
        """
        beat, harmonics = self.flight.orbit.wingbeat, self.flight.compensation.names
        return changed_wingbeat(beat, self.smoother, self.inputs, harmonics, np.asarray(changes, dtype=float))

    def controller(
        self, noise: Mapping[str, float] | None = None, seed: int = 0, *, late: int = 0
    ) -> FeedbackController:
        """Return a controller for `simulate`.

        Parameters
        ----------
        noise : standard deviations of what is measured of the state, by name [m, rad, m/s, rad/s].
        seed : of the noise.
        late : beats of delay in addition to the delay for which the feedback was computed.

        Raises
        ------
        InvalidInputError : noise of an unknown state, or that is negative or not finite; a seed or a lateness that
            is no whole number.

        >>> import wingbeat as wb
        >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
        >>> hold = wb.feedback(orbit).controller()
        >>> gust = wb.winds.CosineGust(w=2.0, duration=0.3)
        >>> start = orbit.initial_state
        >>> flown = wb.simulate(orbit.problem.model, orbit.wingbeat, start, 12, wind=gust, controller=hold)
        >>> bool(abs(flown.states[-1, 2] - start.body_pitch) < 0.02)
        True
        """
        faults = FaultList()
        faults.whole("late", late, 0, MOST_DELAY)
        faults.raise_if_any()
        return FeedbackController(self, late, noise_of(noise, self.flight.state, seed), seed)

    def _report(self) -> Report:
        return feedback_report(self.record())

    def record(self) -> dict[str, Any]:
        """Return all numbers as a JSON-able dictionary in SI units and radians; complex numbers become pairs."""
        flight, asked = self.flight, self.flight.orbit.inputs
        return {
            "species": asked["species"]["name"],
            "speed": asked["speed"],
            "climb": asked["climb"],
            "frequency": flight.orbit.wingbeat.frequency,
            "dt": flight.dt,
            "state": list(flight.state),
            "inputs": list(self.inputs),
            "delay": self.delay,
            "gains": self.gains.tolist(),
            "gain_columns": list(self.gain_columns),
            "cost": self.cost.tolist(),
            "lower": dict(zip(self.inputs, self.lower.tolist(), strict=True)),
            "upper": dict(zip(self.inputs, self.upper.tolist(), strict=True)),
            "multipliers": pairs(self.multipliers),
            "spectral_radius": self.spectral_radius,
            "open_loop": {
                "multipliers": [[m.multiplier.real, m.multiplier.imag] for m in flight.modes],
                "spectral_radius": flight.spectral_radius,
            },
            "controllability": [
                {"kind": m.kind, "multiplier": [m.multiplier.real, m.multiplier.imag], "effects": m.effects}
                for m in self.controllability
            ],
            "sufficient": list(self.sufficient),
            "version": __version__,
        }


class FeedbackController:
    """A function of the beats flown and the state at the top of the stroke that returns the next wingbeat.

    It may fly one flight after another: at its first beat it forgets the flight before. The height is measured
    from the start, relative to the path that climbs as the orbit does; the distance x is not used.

    Theory: equation ``feedback-law``.

    Attributes
    ----------
    feedback : the feedback that it flies.
    late : beats of delay in addition to the delay for which the feedback was computed.
    noise : standard deviations of what is measured of the state, shape (5,) [m, rad, m/s, m/s, rad/s].
    seed : of the noise.
    commands : inputs of each beat so far, as they act, each of shape (inputs,) [Hz, rad or shares].

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> hold = wb.feedback(orbit).controller()
    >>> flown = wb.simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, beats=3, controller=hold)
    >>> flown.completed, len(hold.commands)
    (True, 3)
    """

    def __init__(self, feedback: Feedback, late: int, noise: np.ndarray, seed: int) -> None:
        self.feedback, self.late, self.noise, self.seed = feedback, late, noise, seed
        self._begin(State())

    def _begin(self, state: State) -> None:
        self.commands: list[np.ndarray] = []
        waiting = self.feedback.delay + self.late
        self._waiting = [np.zeros(len(self.feedback.inputs)) for _ in range(waiting)]  # the oldest first
        self._random = np.random.default_rng(self.seed)
        self._ground, self._time = float(state.z), 0.0

    def __call__(self, beats: int, state: State) -> Wingbeat:
        """Return the wingbeat of the next beat.

        Parameters
        ----------
        beats : number of beats flown.
        state : at the top of the stroke [m, rad, m/s, rad/s].
        """
        if beats == 0:
            self._begin(state)
        feedback, orbit = self.feedback, self.feedback.flight.orbit
        height = float(state.z) - self._ground - float(orbit.inputs["climb"]) * self._time
        pitch_state = np.array(state, dtype=float)[2:] - np.array(orbit.initial_state, dtype=float)[2:]
        deviation = np.concatenate([[height], pitch_state])
        deviation = deviation + self.noise * self._random.standard_normal(len(self.noise))
        known = np.concatenate([deviation, *self._waiting[self.late :]])
        command = np.clip(-feedback.gains @ known, feedback.lower, feedback.upper)
        if not np.isfinite(command).all():  # the vehicle has tumbled
            command = np.zeros_like(command)
        self._waiting.append(command)
        acting = self._waiting.pop(0)
        self.commands.append(acting)
        wingbeat = feedback.wingbeat(acting)
        self._time += 1.0 / wingbeat.frequency
        return wingbeat


def feedback(
    orbit: Orbit,
    inputs: Sequence[str] | None = None,
    *,
    delay: int = 0,
    weights: Mapping[str, float] | None = None,
    limits: Mapping[str, float] | None = None,
    options: FeedbackOptions = FEEDBACK,
) -> Feedback:
    """Compute the linear feedback that holds an orbit by changes of the wingbeat from beat to beat.

    Theory: equation ``quadratic-cost``.

    Parameters
    ----------
    orbit : a certified orbit.
    inputs : names of parameters of the wingbeat that may change from beat to beat. Default: those free parameters
        of its problem whose jumps harmonics can undo. The five stock parameters are the frequency, and the means
        and amplitudes of flap and pitch. With second harmonics as compensation, they make every smooth change that
        these parameters and the second harmonics of flap and pitch allow. If a second harmonic such
        as `flap_cos_2` is itself an input, harmonics of order 3 compensate it.
    delay : beats between the measurement and the beat that it changes, 0 to 4.
    weights : factors on the costs of states and inputs by name [-]; 1 if not given.
    limits : largest changes of inputs by name [Hz, rad or shares]; else `FeedbackOptions.reach` units, or as far
        as a wingbeat may change.
    options : scales and units, and the linearisation.

    Raises
    ------
    InvalidInputError : what `linearise` refuses; a delay that is no whole number from 0 to 4; weights or limits of
        unknown names, not positive, or beyond what a wingbeat allows; a mode that does not decay and that no input
        reaches.

    The gains minimise the sum over all beats of squared deviations in scales and squared inputs in units: the
    linear-quadratic regulator, from the discrete algebraic Riccati equation (Kalman 1960; Anderson & Moore, Optimal
    Control, 1990). Inputs that are still pending belong to the state.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> held = wb.feedback(orbit, delay=1)
    >>> held.gains.shape, bool(held.spectral_radius < 1 < held.flight.spectral_radius)
    ((5, 10), True)
    """
    faults = FaultList()
    check_delay(faults, delay)
    faults.raise_if_any()
    flight = _hinge_followed(linearise(orbit, inputs, height=True, options=options.linear))
    names = flight.inputs
    if not names:
        rule = "no free parameter of the problem can change without a jump of the wing"
        faults.add("inputs", inputs, rule, "name a parameter of the wingbeat such as pitch_mean")
    factors = weights_of(faults, weights, (*flight.state, *names))
    lower, upper = command_limits(faults, orbit.wingbeat, names, limits, options)
    faults.raise_if_any()
    scales = np.array([options.scale(name) for name in flight.state])
    units = np.array([options.unit(name) for name in names])
    A, B = _deviation_map(flight)
    kinds = {1.0 + 0.0j: "height"} | {mode.multiplier: mode.kind for mode in flight.modes}
    modes = reaches(A * scales / scales[:, None], B * units / scales[:, None], names, kinds)
    check_reach(faults, modes, names, options.least_effect)
    faults.raise_if_any()
    order, count = len(scales), len(names)
    state_cost = np.zeros((order + delay * count,) * 2)
    state_cost[:order, :order] = np.diag(factors[:order] / scales**2)
    gains, cost = linear_quadratic(*delayed(A, B, delay), state_cost, np.diag(factors[order:] / units**2))
    alone = sufficient(modes, names, options.least_effect)
    return Feedback(flight, delay, gains, cost, lower, upper, modes, alone)


def _hinge_followed(flight: LinearFlight) -> LinearFlight:
    """Return the linear flight of the body alone, if the hinge of its wing follows at once.

    What a disturbance of a hinge leaves after a beat is a few per cent to some 40 per cent of it, and no sensor of
    the body knows it. Theory: equation ``hinge-followed``.
    """
    size = len(FLIGHT_STATE)
    if len(flight.state) == size:
        return flight
    own = slice(size, None)
    share = flight.A[:size, own] @ np.linalg.inv(np.eye(len(flight.state) - size) - flight.A[own, own])
    A, B, G = (each[:size] + share @ each[own] for each in (flight.A[:, :size], flight.B, flight.G))
    return dataclasses.replace(flight, state=flight.state[:size], A=A, B=B, G=G)


def _deviation_map(flight: LinearFlight) -> tuple[np.ndarray, np.ndarray]:
    """Return A and B of deviations from the orbit, whose height is that of the climbing path at the same time."""
    by_inputs, orbit = flight.B.copy(), flight.orbit
    if "frequency" in flight.inputs:  # a shorter beat ends lower on the path
        lower = float(orbit.inputs["climb"]) / float(orbit.wingbeat.frequency) ** 2
        by_inputs[0, flight.inputs.index("frequency")] += lower
    return flight.A, by_inputs
