"""Feedback in real time: sampled, late, and flown by servos that follow held commands; for `feedback_in_beat`.

A beat has N samples at equal times. Each sets a command for all laws that servos move, which acts after the delay.
Servos add what they reach to the laws of the gait: ideal ones a bump, real ones a held angle that they follow with
finite speed and bandwidth. Flights are computed in steps, in which the angle of a servo is a cubic, so the wing's
momentum is that of the servo's velocity.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import at_default, jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, parameter, stroke_phase, unpack
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.flights import air_between, fly_through
from wingbeat.mechanics.state_rates import body_rates, hinge_states, rate_table
from wingbeat.orbits.flight.period import flier
from wingbeat.stability.imu import Estimator
from wingbeat.stability.servos import SERVO_LAWS, follow

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        AirOfFlights,
        Flights,
        FlownCommands,
        FlownSamples,
        NoiseOfFlights,
        Samples,
        Scalar,
        ServoMaps,
        ServoStates,
        StateVector,
    )
    from wingbeat.results.orbit import Orbit

MOST_WAITING = 64  # samples of delay
SUBSTEPS = 8  # of a step, in each of which a servo follows a constant target
_STEPS = 256  # of a beat, for the linear maps
_ORDER = 2  # of the harmonics that carry a servo's velocity and acceleration


class Timing(NamedTuple):
    """How a beat is sampled and what acts when."""

    samples: int  # of a beat
    waiting: int  # whole samples of delay
    fraction: float  # of a sample that the delay lasts longer
    held: bool  # servos follow held commands; else they make bumps
    laws: tuple[str, ...]  # that servos move, of `SERVOED`
    speed: np.ndarray  # of these, shape (laws,) [rad/s]
    pace: np.ndarray  # inverse of their time constants, shape (laws,) [1/s]


class TimedHold(NamedTuple):
    """Feedback in real time as arrays, for n states of body and hinge, and so many laws."""

    gains: np.ndarray  # of each sample, shape (samples, laws, n + laws (held + waiting + 1))
    lower: np.ndarray  # smallest and largest commands, shape (laws,)
    upper: np.ndarray
    speed: np.ndarray  # of the servos, shape (laws,)
    pace: np.ndarray
    target: np.ndarray  # from `shares_of_commands`
    ending: np.ndarray
    path: (
        np.ndarray
    )  # (z, body_pitch, u, w, pitch_rate) and hinge at the samples, z from phase 0, shape (samples, n)
    pitch: np.ndarray  # body pitch of the orbit at the ends of all steps [rad], shape (samples, steps + 1)
    estimator: Estimator | None  # of the state from what an IMU feels; None if the state itself is measured


def shares_of_commands(timing: Timing, steps: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the shares of the older and the newer of the two commands that act in a sample of so many steps.

    For servos: shares of their mean target in each substep, and of that at its end, shape (steps, SUBSTEPS, 2)
    each. For bumps: of the angle and of its slope by time in samples at the ends of all steps, (steps + 1, 2) each.
    Theory: equation ``late-command``.
    """
    late = timing.fraction
    if timing.held:
        ends = np.linspace(0.0, 1.0, steps * SUBSTEPS + 1)
        newer = np.diff(np.maximum(ends - late, 0.0)) * steps * SUBSTEPS, (ends[1:] > late + 1e-12) * 1.0
        mean, last = (np.stack([1.0 - one, one], axis=-1).reshape(steps, SUBSTEPS, 2) for one in newer)
        return mean, last
    since = np.linspace(0.0, 1.0, steps + 1)[:, None] + [1.0 - late, -late]
    inside = (since >= 0.0) & (since <= 1.0)
    return inside * np.sin(np.pi * since) ** 2, inside * np.pi * np.sin(2.0 * np.pi * since)


# --- flights ---


def _cubic(angle: Any, rate: Any, angle_end: Any, rate_end: Any, time: Any) -> tuple[Any, Any, Any]:
    """Return the cubic through angles and rates at both ends of a step that lasts `time`.

    Angles, rates and accelerations, each at the start, the middle and the end, which are the second axis.
    """
    mean = (angle_end - angle) / time
    middle = 0.5 * (angle + angle_end) + 0.125 * time * (rate - rate_end), 1.5 * mean - 0.25 * (rate + rate_end)
    bends = 6.0 * mean - 4.0 * rate - 2.0 * rate_end, rate_end - rate, 2.0 * rate + 4.0 * rate_end - 6.0 * mean
    return (
        jnp.stack([angle, middle[0], angle_end], axis=1),
        jnp.stack([rate, middle[1], rate_end], axis=1),
        jnp.stack(bends, axis=1) / time,
    )


def with_offsets(
    wingbeat: Wingbeat, phase: Any, offsets: tuple[Any, Any, Any], laws: tuple[str, ...] = SERVO_LAWS
) -> Wingbeat:
    """Return a wingbeat whose laws are changed at a phase by angles, their rates and accelerations.

    Mean and second harmonic make the change of flap and pitch; it holds at this phase alone. The springs of a hinge
    and the tail have neither mass nor rate. Theory: equation ``servo-offset``.
    """
    value, rate, acceleration = offsets
    by_phase, twice = rate / wingbeat.frequency, acceleration / wingbeat.frequency**2
    at, slope, bend = phase, 1.0, 0.0
    if not at_default(wingbeat, "downstroke_fraction"):

        def stretched(place: Any) -> Any:
            return jax.jvp(lambda p: stroke_phase(wingbeat, p), (place,), (jnp.ones_like(place),))

        (at, slope), (_, bend) = jax.jvp(stretched, (phase,), (jnp.ones_like(phase),))
    turns = 2.0 * math.pi * _ORDER
    sine = by_phase / (turns * slope)
    cosine = (turns * sine * bend - twice) / (turns * slope) ** 2
    c, s = jnp.cos(turns * at), jnp.sin(turns * at)
    changes = value - cosine, cosine * c - sine * s, cosine * s + sine * c
    still = {"rest_angle": "hinge_rest_angle", "tail": "tail_tilt"}
    more: dict[str, tuple[Any, int]] = {}  # changes of all laws, and which law's they are
    for i, law in enumerate(laws):
        parts = (f"{law}_{part}" for part in ("mean", f"cos_{_ORDER}", f"sin_{_ORDER}"))
        more |= (
            {still[law]: (value, i)} if law in still else {name: (changes[k], i) for k, name in enumerate(parts)}
        )
    numbers = [parameter(wingbeat, name) + change[i] for name, (change, i) in more.items()]
    return unpack(tuple(more), wingbeat, numbers)


def _step(
    model: FlightModel,
    wingbeat: Wingbeat,
    state: Any,
    phase: Any,
    size: Any,
    servos: tuple[Any, Any, Any],
    laws: tuple[str, ...],
    wind_at: Any,
) -> Any:
    """Return states of many flights one step of the classical Runge-Kutta method later.

    Behind body and hinge come the integrals over time of what accelerometers feel, forward and up in body axes.
    Theory: equation ``specific-force``.
    """
    at = jnp.stack([jnp.broadcast_to(phase + part * size, state.shape[1:]) for part in (0.0, 0.5, 1.0)])
    motion, hinge = rate_table(model, with_offsets(wingbeat, at, servos, laws), at), hinge_states(wingbeat)
    stages = np.array([0, 1, 1, 2])
    # One body for the four stages, because compiling takes longer than flying.
    along = jax.tree_util.tree_map(lambda a: jnp.moveaxis(jnp.broadcast_to(a, a.shape), -2, 0)[stages], motion)
    winds = jnp.stack([wind_at(one) for one in at])[stages]

    def stage(carry: Any, within: Any) -> tuple[Any, None]:
        last, total = carry
        moved, wind, share, weight = within
        place = state + share * size * last
        # The loads depend on the velocity through the air, and both frames have the same accelerations.
        by_time = body_rates(model, moved, place[2 : 6 + hinge].at[1:3].add(-wind))
        c, s, lift = jnp.cos(place[2]), jnp.sin(place[2]), by_time[2] + model.air.gravity
        felt = jnp.stack([by_time[1] * c + lift * s, lift * c - by_time[1] * s])
        rates = jnp.concatenate([place[3:5], by_time, felt]) / wingbeat.frequency
        return (rates, total + weight * rates), None

    shares, weights = np.array([0.0, 0.5, 0.5, 1.0]), np.array([1.0, 2.0, 2.0, 1.0]) / 6.0
    (_, total), _ = jax.lax.scan(stage, (0.0 * state, 0.0 * state), (along, winds, shares, weights))
    return state + size * total


@exported(static=("laws", "held", "samples"))
def fly_in_time(
    model: FlightModel,
    wingbeat: Wingbeat,
    hold: TimedHold,
    start: StateVector,
    climb: Scalar,
    air: AirOfFlights,
    spacing: Scalar,
    noise: NoiseOfFlights,
    *,
    laws: tuple[str, ...],
    held: bool,
    samples: int,
) -> tuple[FlownSamples, FlownCommands, FlownCommands, FlownCommands, Flights]:
    """Fly many flights from the start of an orbit that climbs by `climb` [m/s], each through its own air.

    Return the states at the end of each sample, the commands, the angles of the servos at its end, the deviations
    that the controller knew and those that an IMU measured, and the largest deviation of the body pitch.
    """
    flights, steps, period = air.shape[0], hold.pitch.shape[1] - 1, 1.0 / wingbeat.frequency
    size = 1.0 / (samples * steps)
    time = size * period
    most, speed, pace = (values[:, None] for values in (hold.speed, hold.speed, hold.pace))
    hinge, count, known_states = hinge_states(wingbeat), len(laws), 5 + hinge_states(wingbeat)
    servoed = slice(known_states, known_states + count)
    queue = (hold.gains.shape[2] - known_states) // count - held  # commands that wait at the start of a sample

    def sample(carry: Any, asked: Any) -> tuple[Any, Any]:
        state, angle, rate, waiting, guess, largest, begun = carry
        gains, path, pitch, first, error, estimator = asked
        along = jnp.broadcast_to(path[:, None], (known_states, flights)).at[0].add(start[1] + climb * begun[0])
        away = state[1 : 6 + hinge] - along
        measured = jnp.zeros((0, flights))
        if estimator is None:
            known = jnp.concatenate([away + error, *([angle] if held else []), *waiting])
        else:
            turning, felt = away[4:5], state[6 + hinge :] * (samples / period) - estimator.felt[:, None]
            sensed = jnp.concatenate([turning, felt, away[:1]])
            measured = sensed[: error.shape[0]] + error
            known = guess + estimator.gains @ (measured - estimator.output @ guess)
        estimate = known[:known_states]
        command = jnp.clip(-gains @ known[: gains.shape[1]], hold.lower[:, None], hold.upper[:, None])
        command = jnp.where(jnp.isfinite(command), command, 0.0)  # the vehicle has tumbled
        if estimator is not None:
            guess = estimator.by_state @ known + estimator.by_command @ command
            if held:  # the controller knows how fast its servos are
                reach = most * (period / samples)
                begun_at = known[servoed]
                guess = guess.at[servoed].set(begun_at + jnp.clip(guess[servoed] - known[servoed], -reach, reach))
        given = jnp.concatenate([command[None], waiting])
        newer, older = given[queue - 1], given[queue]

        def step(inner: Any, within: Any) -> tuple[Any, None]:
            state, angle, rate, largest = inner
            i, target, ending, orbit_pitch = within
            if held:

                def substep(at: Any, shares: Any) -> tuple[Any, None]:
                    return follow(at, shares[0] * older + shares[1] * newer, speed, pace, time / SUBSTEPS), None

                angle_end, _ = jax.lax.scan(substep, angle, target)
                aim = ending[-1, 0] * older + ending[-1, 1] * newer
                rate_end = jnp.clip(pace * (aim - angle_end), -most, most)
            else:
                angle_end = target[1, 0] * older + target[1, 1] * newer
                rate_end = (ending[1, 0] * older + ending[1, 1] * newer) * (samples / period)
            servos = _cubic(angle, rate, angle_end, rate_end, time)
            phase = first + i * size

            def wind_at(at: Any) -> Any:
                return jax.vmap(air_between, out_axes=1)(air, (begun + at * period) / spacing)

            state = _step(model, wingbeat, state, phase, size, servos, laws, wind_at)
            away = jnp.abs(state[2] - orbit_pitch)
            return (state, angle_end, rate_end, jnp.maximum(largest, away)), None

        tables = (hold.target, hold.ending) if held else tuple(_pairs(one) for one in (hold.target, hold.ending))
        each = jnp.arange(steps, dtype=float), *tables, pitch[1:]
        largest = jnp.maximum(largest, jnp.abs(state[2] - pitch[0]))
        state = state.at[6 + hinge :].set(0.0)
        (state, angle, rate, largest), _ = jax.lax.scan(step, (state, angle, rate, largest), each)
        told = jnp.concatenate([estimate, measured])
        return (state, angle, rate, given[:-1], guess, largest, begun), (state[: 6 + hinge], command, angle, told)

    def beat(carry: Any, errors: Any) -> tuple[Any, Any]:
        firsts = jnp.arange(samples, dtype=float) / samples
        asked = hold.gains, hold.path, hold.pitch, firsts, errors, hold.estimator
        inner, found = jax.lax.scan(sample, carry, asked)
        return (*inner[:-1], inner[-1] + period), found

    zeros, none = jnp.zeros(flights), jnp.zeros((count, flights))
    felt, guess = jnp.zeros(2), jnp.zeros((0, flights))
    if hold.estimator is not None:  # as if the orbit had been flown before
        felt = hold.estimator.felt[0] * (period / samples)
        guess = jnp.zeros((hold.estimator.by_state.shape[-1], flights))
    state = jnp.broadcast_to(jnp.concatenate([start, felt])[:, None], (8 + hinge, flights))
    begin = state, none, none, jnp.zeros((queue, count, flights)), guess, zeros, zeros
    (*_, largest, _), found = jax.lax.scan(beat, begin, noise)
    return *found, largest


def _pairs(values: Any) -> Any:
    """Return each value with the next one."""
    return jnp.stack([values[:-1], values[1:]], axis=1)


def timed_hold(
    orbit: Orbit,
    timing: Timing,
    gains: np.ndarray,
    limits: tuple[np.ndarray, np.ndarray],
    path: np.ndarray,
    steps: int,
    estimator: Estimator | None = None,
) -> TimedHold:
    """Return feedback as arrays, for flights in at least so many steps a beat."""
    count = math.ceil(steps / timing.samples)
    ends = np.linspace(0.0, 1.0, timing.samples * count + 1)
    flown, _ = fly_through(
        orbit.problem.model, orbit.wingbeat, orbit.initial_state, ends, wake=(orbit.hinge_start,)
    )
    pitch = np.stack([flown[j * count : (j + 1) * count + 1, 2] for j in range(timing.samples)])
    shares = shares_of_commands(timing, count)
    return TimedHold(gains, *limits, timing.speed, timing.pace, *shares, path, pitch, estimator)


def by_beats(fly: Callable[..., Any], frequency: float) -> Callable[..., tuple[np.ndarray, ...]]:
    """Return what gives states and times at the ends of beats, commands, and largest pitch, from `fly_in_time`."""

    def flown(air: np.ndarray, spacing: float, errors: np.ndarray) -> tuple[np.ndarray, ...]:
        states, commands, *_, largest = (np.asarray(part) for part in fly(air, spacing, errors))
        ends = np.arange(1, len(states) + 1) / frequency
        return states[:, -1], np.repeat(ends[:, None], len(largest), axis=1), commands, largest

    return flown


# --- linear maps ---


@exported(static=("laws",))
def _step_maps(
    model: FlightModel, wingbeat: Wingbeat, states: ServoStates, phases: Samples, *, laws: tuple[str, ...]
) -> ServoMaps:
    """Return ends of steps between phases, with derivatives by the n states without x, and by servos' cubic.

    The cubic has angles and rates of all laws at the start, then at the end. The ends are those of the state
    without x, then what an accelerometer has felt. Shape (n + 2, 1 + n + 4 laws, steps).
    """
    size, count = phases[1] - phases[0], len(laws)
    several, order = states.shape[0], states.shape[1] - 1

    def after(changes: Any) -> Any:
        whole = jnp.concatenate([jnp.zeros((1, several)), changes[:order], jnp.zeros((2, several))])
        a, b, c, d = (changes[order + i * count : order + (i + 1) * count] for i in range(4))
        servos = _cubic(a, b, c, d, size / wingbeat.frequency)
        begun = jnp.concatenate([states.T, jnp.zeros((2, several))]) + whole
        ended = _step(model, wingbeat, begun, phases[:-1], size, servos, laws, lambda at: 0.0 * at)
        return ended[1:]

    still = jnp.zeros((order + 4 * count, several))

    def by(direction: Any) -> Any:
        return jax.jvp(after, (still,), (jnp.broadcast_to(direction[:, None], still.shape),))[1]

    return jnp.concatenate([after(still)[:, None], jnp.moveaxis(jax.vmap(by)(jnp.eye(len(still))), 0, 1)], axis=1)


def sample_maps(orbit: Orbit, timing: Timing) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return the orbit's path at the samples, and the maps A and B of each sample by state and commands.

    At last what an accelerometer feels in the mean of a sample, by state and commands, shape (samples, 2, states +
    laws + 1) [m/s2]; its last column is that of the orbit.

    The state is that of body and hinge, then the angles of the servos if commands are held, then the commands that
    wait, the newest first. Servos have no limits here. Theory: equation ``sampled-map``.
    """
    N, steps, pace = timing.samples, math.ceil(_STEPS / timing.samples), timing.pace
    phases = np.linspace(0.0, 1.0, N * steps + 1)
    model, beat, laws, hinge = orbit.problem.model, orbit.wingbeat, len(timing.laws), orbit.hinge_start
    flown, _ = fly_through(model, beat, orbit.initial_state, phases, wake=(hinge,))
    parts = np.moveaxis(np.asarray(_step_maps(model, beat, flown[:-1], phases, laws=timing.laws)), -1, 0)
    path, order = flown[::steps, 1:].copy(), flown.shape[1] - 1
    path[:, 0] -= float(orbit.initial_state.z)
    mean, last = shares_of_commands(timing, steps)
    time = 1.0 / (orbit.wingbeat.frequency * N * steps)
    keep = np.exp(-pace * time / SUBSTEPS)
    held, queue = laws * timing.held, timing.waiting + 1
    whole = order + held + laws * queue
    # Each row below is a linear function of (state, command): the last columns are the command.
    own = np.eye(whole, whole + laws)
    commands = [np.eye(whole + laws)[whole:], *(own[order + held + laws * i :][:laws] for i in range(queue))]
    newer, older = commands[queue - 1], commands[queue]
    A, B, felt = np.zeros((N, whole, whole)), np.zeros((N, whole, laws)), np.zeros((N, 2, whole + laws + 1))
    for j in range(N):
        body = own[:order]
        if timing.held:
            angle = own[order : order + laws]
            rate = pace[:, None] * (older - angle)
        else:
            angle, rate = mean[0, 0] * older + mean[0, 1] * newer, (last[0, 0] * older + last[0, 1] * newer) * N
            rate = rate * orbit.wingbeat.frequency
        for k in range(steps):
            if timing.held:
                end = angle
                for s in mean[k]:
                    aim = s[0] * older + s[1] * newer
                    end = aim + keep[:, None] * (end - aim)
                rate_end = pace[:, None] * (last[k, -1, 0] * older + last[k, -1, 1] * newer - end)
            else:
                end = mean[k + 1, 0] * older + mean[k + 1, 1] * newer
                rate_end = (last[k + 1, 0] * older + last[k + 1, 1] * newer) * N * orbit.wingbeat.frequency
            part = parts[j * steps + k]
            changed = part[:, 1:] @ np.concatenate([body, angle, rate, end, rate_end])
            body, felt[j, :, :-1] = changed[:order], felt[j, :, :-1] + changed[order:]
            felt[j, :, -1] += part[order:, 0]
            angle, rate = end, rate_end
        rows = np.concatenate([body, *([angle] if timing.held else []), *commands[:queue]])
        A[j], B[j] = rows[:, :whole], rows[:, whole:]
    return path, A, B, felt / (time * steps)


def bump_parameters(segments: int) -> tuple[tuple[str, ...], np.ndarray]:
    """Return the parameters that make bumps, and the change of each by bumps of flap and pitch, (names, 2).

    Theory: equation ``bump``.
    """
    names = tuple(name for law in SERVO_LAWS for name in (f"{law}_mean", f"{law}_cos_{segments}"))
    return names, np.kron(np.eye(len(SERVO_LAWS)), [[0.5], [-0.5]])


def segment_maps(orbit: Orbit, segments: int, blocks: int) -> tuple[np.ndarray, ...]:
    """Return the ends of the segments, the orbit's state there, and the linear map over each segment."""
    from scipy.integrate import cumulative_simpson
    from scipy.interpolate import CubicSpline

    beat, start = orbit.wingbeat, np.array(orbit.initial_state, dtype=float)[2:]
    names, shares = bump_parameters(segments)
    fly = flier(orbit.problem.model, beat, names, whole_path=True)
    flown = fly(np.array([float(parameter(beat, name)) for name in names]), start, blocks)
    path, by = np.asarray(flown.path), np.asarray(flown.path_jacobian)  # (K, 4), (K, 4, 4 + names)
    phase = np.linspace(0.0, 1.0, len(path))
    by = np.concatenate([by[..., :4], by[..., 4:] @ shares], axis=-1)

    def with_height(rates: np.ndarray) -> np.ndarray:
        """Return the integral over time of the upward velocity, in front of the others."""
        height = cumulative_simpson(rates[:, 2], dx=phase[1] / beat.frequency, axis=0, initial=0.0)
        return np.concatenate([height[:, None], rates], axis=1)

    ends = _phases_of(beat, segments)
    states, moved = (CubicSpline(phase, with_height(part), axis=0)(ends) for part in (path, by))
    lifted = np.zeros((segments + 1, 5, 1))
    lifted[:, 0] = 1.0  # the height shifts the height alone
    since = np.concatenate([lifted, moved[..., :4]], axis=-1)
    by_state = np.stack([since[j + 1] @ np.linalg.inv(since[j]) for j in range(segments)])
    by_bumps = np.stack([moved[j + 1, :, 4:] - by_state[j] @ moved[j, :, 4:] for j in range(segments)])
    return ends, states, by_state, by_bumps


def _phases_of(beat: Wingbeat, segments: int) -> np.ndarray:
    """Return the phases at which the phase of the stroke is a multiple of 1 / segments."""
    phase = np.linspace(0.0, 1.0, 4097)
    stretched = np.asarray(stroke_phase(beat, phase))
    return np.interp(np.arange(segments + 1) / segments, stretched, phase)
