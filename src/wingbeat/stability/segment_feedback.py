"""Feedback several times a beat: `feedback_in_beat`.

A beat is cut into M equal segments of the stroke. In each, flap and pitch are raised by a bump ``b sin^2(M pi s)``,
with s the phase of the stroke. It begins and ends without a jump of position or speed. Within its segment, a bump
is a change of the mean by b/2 and of the cosine of order M by -b/2, so it needs no law of its own.

With a delay, with servos, or with a hinge that gives way, `real_time` samples the beat at equal times and adds the
servos' angles instead.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import HIGHEST_ORDER, FaultList, Report, Reported, __version__
from wingbeat.aero.winds import Wind
from wingbeat.animal.kinematics import Wingbeat, flap_angle, parameter, pitch_angle, with_parameters
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.flights import air_at, air_phases, check_wind, fly_through, state_of
from wingbeat.mechanics.state_rates import HINGE_STATE
from wingbeat.orbits.options import check_certified
from wingbeat.stability.control_block import ServoDriver, save_block
from wingbeat.stability.imu import Estimator, Imu, check_noise_of, estimator_of
from wingbeat.stability.options import (
    FEEDBACK,
    FLIGHT_STATE,
    FeedbackOptions,
    check_no_wake,
    noise_of,
)
from wingbeat.stability.real_time import (
    MOST_WAITING,
    Timing,
    bump_parameters,
    fly_in_time,
    sample_maps,
    segment_maps,
    timed_hold,
)
from wingbeat.stability.reports import pairs, segment_report
from wingbeat.stability.riccati import multipliers_over, periodic_linear_quadratic
from wingbeat.stability.servos import (
    MOST_SAMPLES,
    SERVO_LAWS,
    SERVOED,
    WITHOUT_END,
    Servo,
    check_servos,
    check_timing,
)

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit

_TIMED_STEPS = 256  # of a beat, in which `SegmentFeedback.fly` flies with a delay or servos
_SAMPLES = 8  # of a segment, between which the adaptive integrator flies


@dataclass(frozen=True)
class SegmentFlight:
    """A flight with feedback several times a beat.

    Attributes
    ----------
    states : (x, z, body_pitch, u, w, pitch_rate) at the ends of all segments, shape (beats * segments + 1, 6).
    deviations : of (z, body_pitch, u, w, pitch_rate) from the orbit there, shape (beats * segments + 1, 5).
        A hinge that gives way adds its angle and rate to both.
    bumps : of flap and pitch in each segment [rad], shape (beats * segments, 2); or the commands of servos.
    angles : of the servos at the ends of all segments [rad], likewise; None for bumps without delay.
    estimates : of the deviations, which the controller used, shape (beats * segments, 5); likewise.
    readings : of an IMU, less those on the orbit: pitch rate, acceleration forward and up in body axes, height if
        there is a sensor, shape (beats * segments, readings).

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> flown = wb.feedback_in_beat(orbit, segments=4).fly(wb.winds.CosineGust(w=0.5), beats=2)
    >>> flown.bumps.shape, bool(abs(flown.bumps).max() > 0.0)
    ((8, 2), True)
    """

    states: np.ndarray
    deviations: np.ndarray
    bumps: np.ndarray
    angles: np.ndarray | None = None
    estimates: np.ndarray | None = None
    readings: np.ndarray | None = None


@dataclass(frozen=True)
class SegmentFeedback(Reported):
    """Feedback that adds bumps or servos' angles to flap and pitch; made by `feedback_in_beat`.

    Attributes
    ----------
    orbit : the orbit.
    phases : ends of the segments, shape (segments + 1,), from 0 to 1.
    path : (z, body_pitch, u, w, pitch_rate) of the orbit there, z from that at phase 0, shape (segments + 1, 5).
    A, B : linear maps over each segment, by the state and by the bumps, shapes (segments, 5, 5), (segments, 5, 2).
        With `timing` the state goes on behind these five: see `state`.
    gains : of each segment, shape (segments, 2, 5) [rad per unit of the state], or (segments, 2, states).
    lower, upper : smallest and largest bumps or commands of flap and pitch, shape (2,) [rad].
        A hinge that gives way adds its angle and rate to the state.
    timing : samples, delay and servos; None for bumps without delay.
    imu, estimator : what is measured, and the Kalman filter of the state; None if the state itself is measured.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> held = wb.feedback_in_beat(orbit, segments=4)
    >>> held.gains.shape, bool(held.spectral_radius < 1.0)
    ((4, 2, 5), True)
    """

    orbit: Orbit
    phases: np.ndarray
    path: np.ndarray
    A: np.ndarray
    B: np.ndarray
    gains: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    timing: Timing | None = None
    imu: Imu | None = None
    estimator: Estimator | None = None

    @property
    def state(self) -> tuple[str, ...]:
        """Names of the columns of `gains`: the state, angles of the servos, and commands that wait."""
        if self.timing is None:
            return FLIGHT_STATE
        servos = tuple(f"{law} servo" for law in self.laws) if self.timing.held else ()
        ago = range(1, self.timing.waiting + 2)
        waiting = (f"{law}, {n} sample{'s' if n > 1 else ''} ago" for n in ago for law in self.laws)
        return (*self.measured, *servos, *waiting)

    @property
    def measured(self) -> tuple[str, ...]:
        """Names of the states that are measured, or estimated from an IMU."""
        return (*FLIGHT_STATE, *HINGE_STATE[: self.orbit.hinge_start.size])

    @property
    def laws(self) -> tuple[str, ...]:
        """Names of what the commands move: flap and pitch, or those of `timing`."""
        return SERVO_LAWS if self.timing is None else self.timing.laws

    @property
    def multipliers(self) -> np.ndarray:
        """Multipliers of a beat with feedback, the largest first."""
        first = int(self.imu is not None and self.imu.height is None)  # without a sensor, the height is not held
        closed = (A - B @ K for A, B, K in zip(self.A, self.B, self.gains, strict=True))
        return multipliers_over([one[first:, first:] for one in closed])

    @property
    def spectral_radius(self) -> float:
        """Largest modulus of a multiplier with feedback; below 1 disturbances decay."""
        return float(np.abs(self.multipliers[0]))

    def wingbeat(self, bumps: np.ndarray) -> Wingbeat:
        """Return the wingbeat that flies bumps without delay; it holds within one segment.

        Parameters
        ----------
        bumps : of flap and pitch [rad], shape (2,).
        """
        beat, (names, shares) = self.orbit.wingbeat, bump_parameters(len(self.gains))
        changed = [float(parameter(beat, name)) for name in names] + shares @ bumps
        return with_parameters(beat, dict(zip(names, changed.tolist(), strict=True)))

    def fly(
        self,
        wind: Wind | tuple[float, float],
        beats: int = 30,
        noise: Mapping[str, float] | None = None,
        seed: int = 0,
        start: State | None = None,
    ) -> SegmentFlight:
        """Fly the orbit through a wind with this feedback, the whole equations of motion.

        Parameters
        ----------
        wind : velocity of the air, as in `simulate`.
        beats : number of wingbeats.
        noise : standard deviations of what is measured of the state, by name [m, rad, m/s, rad/s].
        seed : of the noise.
        start : at the top of the stroke; default the orbit's.

        Raises
        ------
        InvalidInputError : beats that are no whole number, a wind that is not finite, noise of an unknown state.
        """
        faults = FaultList()
        faults.whole("beats", beats, 1, 10_000)
        check_wind(faults, wind)
        check_noise_of(faults, self.imu, noise)
        faults.raise_if_any()
        begun = np.array(self.orbit.initial_state if start is None else state_of(start), dtype=float)
        random = np.random.default_rng(seed)
        deviations = noise_of(noise, self.measured, seed)
        error = deviations * random.standard_normal((beats, len(self.gains), len(deviations)))
        if self.imu is not None:
            error = self.imu.errors(random, beats, len(self.gains), 1)[..., 0]
        if self.timing is not None:
            return self._fly_in_time(wind, beats, error, begun)
        model, period = self.orbit.problem.model, 1.0 / self.orbit.wingbeat.frequency
        state, climb = begun, float(self.orbit.inputs["climb"]) * period
        states, deviations, bumps = [state], [begun[1:] - self.path[0] - [begun[1], 0, 0, 0, 0]], []
        for beat in range(beats):
            table = air_at(wind, period * (beat + air_phases()))
            raised = np.array([states[0][1] + climb * beat, 0.0, 0.0, 0.0, 0.0])
            for j in range(len(self.gains)):
                taken = np.clip(-self.gains[j] @ (deviations[-1] + error[beat, j]), self.lower, self.upper)
                taken = np.where(np.isfinite(taken), taken, 0.0)  # the vehicle has tumbled
                phases = np.linspace(self.phases[j], self.phases[j + 1], _SAMPLES + 1)
                flown, _ = fly_through(model, self.wingbeat(taken), State(*state), phases, air=table)
                state = flown[-1]
                states.append(state)
                deviations.append(state[1:] - self.path[j + 1] - raised)
                bumps.append(taken)
        return SegmentFlight(np.stack(states), np.stack(deviations), np.stack(bumps))

    @property
    def gait_speed(self) -> tuple[float, ...]:
        """Largest speeds of all `laws` in the orbit's own wingbeat [rad/s], to which servos add."""
        beat, phase = self.orbit.wingbeat, np.linspace(0.0, 1.0, 4097)
        laws = {"flap": flap_angle, "pitch": pitch_angle}
        angles = (laws[law](beat, phase) if law in laws else np.zeros(2) for law in self.laws)
        return tuple(float(np.abs(np.diff(np.asarray(one))).max() * 4096 * beat.frequency) for one in angles)

    def _report(self) -> Report:
        return segment_report(self.record())

    def record(self) -> dict[str, Any]:
        """Return all numbers as a JSON-able dictionary in SI units and radians; what has no limit is None."""
        orbit, N = self.orbit, len(self.gains)
        frequency, timing = float(orbit.wingbeat.frequency), self.timing
        free, known = [WITHOUT_END] * len(self.laws), len(self.measured)
        speed, pace = (free, free) if timing is None else (timing.speed.tolist(), timing.pace.tolist())

        def named(values: Any) -> dict[str, float | None]:
            return {k: v if v < WITHOUT_END else None for k, v in zip(self.laws, values, strict=True)}

        return {
            "species": orbit.inputs["species"]["name"],
            "speed": orbit.inputs["speed"],
            "climb": orbit.inputs["climb"],
            "frequency": frequency,
            "segments": N,
            "sample_rate": N * frequency,
            "delay_time": 0.0 if timing is None else (timing.waiting + timing.fraction) / (N * frequency),
            "held": timing is not None and timing.held,
            "state": list(self.state),
            "inputs": list(self.laws),
            "phases": self.phases.tolist(),
            "path": self.path.tolist(),
            "gains": self.gains.tolist(),
            "lower": dict(zip(self.laws, self.lower.tolist(), strict=True)),
            "upper": dict(zip(self.laws, self.upper.tolist(), strict=True)),
            "servo_speed": named(speed),
            "servo_bandwidth": named([one / (2.0 * math.pi) if one < WITHOUT_END else one for one in pace]),
            "gait_speed": dict(zip(self.laws, self.gait_speed, strict=True)),
            "imu": None if self.imu is None else dataclasses.asdict(self.imu),
            "estimator": None if self.estimator is None else self._filter(self.estimator),
            "memory": {"matrix": self.A[0][known:, known:].tolist(), "input": self.B[0][known:].tolist()},
            "multipliers": pairs(self.multipliers),
            "spectral_radius": self.spectral_radius,
            "open_loop": {"spectral_radius": float(np.abs(multipliers_over(list(self.A))[0]))},
            "version": __version__,
        }

    def _filter(self, found: Estimator) -> dict[str, Any]:
        path = np.concatenate([self.path[:-1, 4:5], found.felt, self.path[:-1, :1]], axis=1)
        arrays = {name: getattr(found, name).tolist() for name in ("gains", "by_state", "by_command")}
        output = found.output[0].tolist()
        return arrays | {
            "output": output,
            "path": path[:, : len(output)].tolist(),
            "spectral_radius": found.spectral_radius,
        }

    def save(self, path: str | PathLike[str]) -> None:
        """Write the controller as a block of difference equations: .json, .mat for MATLAB and Simulink, .csv.

        Theory: equation ``control-block``.

        Parameters
        ----------
        path : of the file to write.

        Raises
        ------
        InvalidInputError : another suffix.
        FileError : the file cannot be written.
        """
        save_block(self.record(), path)

    def driver(self) -> ServoDriver:
        """Return the controller and its servos at work, for ``MujocoFlight.fly(servos=...)``."""
        return ServoDriver(self.record())

    def bound(self, steps: int, start: np.ndarray | None = None) -> Callable[..., Any]:
        """Return `fly_in_time` with this feedback, which has a `timing`, in at least so many steps a beat.

        Parameters
        ----------
        steps : of a beat.
        start : state at the start, shape (6,); default the orbit's. A hinge starts as on the orbit.
        """
        orbit, timing, limits = self.orbit, self.timing, (self.lower, self.upper)
        assert timing is not None
        hold = timed_hold(orbit, timing, self.gains, limits, self.path[:-1], steps, self.estimator)
        begun = np.array(orbit.initial_state, dtype=float) if start is None else start
        place = np.append(begun, orbit.hinge_start), np.array(float(orbit.inputs["climb"]))
        named = {"laws": timing.laws, "held": timing.held, "samples": timing.samples}
        return fly_in_time.bind(orbit.problem.model, orbit.wingbeat, hold, *place, **named)

    def _fly_in_time(
        self, wind: Wind | tuple[float, float], beats: int, error: np.ndarray, begun: np.ndarray
    ) -> SegmentFlight:
        samples, spacing = len(self.gains), 1.0 / (_TIMED_STEPS * self.orbit.wingbeat.frequency)
        air = air_at(wind, spacing * np.arange(-1, beats * _TIMED_STEPS + 3))
        found = self.bound(_TIMED_STEPS, begun)(air[None], spacing, error[..., None])
        parts = (np.asarray(part)[..., 0].reshape(beats * samples, -1) for part in found[:4])
        states, bumps, angles, known = parts
        states = np.concatenate([np.append(begun, self.orbit.hinge_start)[None], states])
        along = np.concatenate([np.tile(self.path[:-1], (beats, 1)), self.path[:1]])
        climbed = self.path[-1, 0] - self.path[0, 0]  # in a beat
        known_states = len(self.measured)
        along[:, 0] += begun[1] + climbed * (np.arange(len(states)) // samples)
        return SegmentFlight(states, states[:, 1:] - along, bumps, angles, *np.split(known, [known_states], 1))


def feedback_in_beat(
    orbit: Orbit,
    segments: int | None = None,
    *,
    sample_rate: float | None = None,
    delay_time: float = 0.0,
    servos: Servo | Mapping[str, Servo] | None = None,
    imu: Imu | None = None,
    options: FeedbackOptions = FEEDBACK,
) -> SegmentFeedback:
    """Compute the linear feedback that holds an orbit by changes of flap and pitch several times a beat.

    Where a hinge gives way, it changes the flap, and the tail if there is one. The state then has the hinge's angle
    and rate: without an IMU, they count as measured.

    Parameters
    ----------
    orbit : a certified orbit.
    segments : number of segments of a beat, 2 to 8, or with servos to 256; the state is measured at the start of
        each. Default: 4, or what is nearest to `sample_rate`.
    sample_rate : measurements per second [Hz], in place of `segments`; a beat has a whole number of them.
    delay_time : from a measurement to the start of its effect [s].
    servos : of flap and pitch, or by the names of those that there are, of ``"flap"``, ``"pitch"``,
        ``"rest_angle"`` of the springs of a hinge that gives way, and ``"tail"``. Commands are held from
        sample to sample,
        and the servos follow them; without a speed or a bandwidth they make bumps without a jump.
    imu : from which a Kalman filter estimates the state, with servos or a delay; None to measure the state itself.
    options : scales of the state, and unit and reach of angles.

    Raises
    ------
    InvalidInputError : an orbit that is not certified or has the lag of the wake, segments that are no whole
        number from 2 to 8, a sample rate or a delay out of range, what is no servo or no IMU.

    The gains minimise the sum over all segments of squared deviations in scales and squared bumps in units; they
    solve the periodic discrete Riccati equation (Bittanti, Colaneri & De Nicolao 1991, in The Riccati Equation).
    They know the delay and the servos' bandwidth; limits and speeds act in flights alone. Theory: equation
    ``sampled-map``.

    >>> import math, wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> wb.feedback_in_beat(orbit, 4).spectral_radius < 1
    True
    >>> servo = wb.Servo(speed=math.radians(600))
    >>> slow = wb.feedback_in_beat(orbit, sample_rate=100.0, delay_time=0.01, servos=servo)
    >>> len(slow.gains), slow.spectral_radius < 1
    (10, True)
    """
    faults = FaultList()
    check_certified(faults, orbit.status, "hold a certified orbit")
    check_no_wake(faults, orbit.problem.aero.wake)
    vehicle, hinge = orbit.problem.vehicle, orbit.wingbeat.pitch_hinge
    moved = check_servos(faults, servos, hinge, vehicle.tail is not None)
    held = any(not one.ideal for one in moved.values())
    check_timing(faults, segments, sample_rate, delay_time, held)
    if imu is not None and not isinstance(imu, Imu):
        faults.add("imu", imu, "must be an Imu", "for example wb.Imu(gyro=0.002, accelerometer=0.05)")
    elif imu is not None and not held and not delay_time:
        faults.add("imu", imu, "is for feedback with servos or a delay", "give delay_time=0.001 for example")
    faults.raise_if_any()
    count, most = segments or 4, MOST_SAMPLES if held else HIGHEST_ORDER
    frequency = float(orbit.wingbeat.frequency)
    if sample_rate is not None:
        count = round(sample_rate / frequency)
        if not 2 <= count <= most:
            more = "" if held else "; servos with a speed or a bandwidth allow more"
            rule = f"makes {count} samples in a beat of {frequency:.3g} Hz, which may have 2 to {most}{more}"
            faults.add("sample_rate", sample_rate, rule, f"give {2 * frequency:.3g} to {most * frequency:.3g} Hz")
    late = delay_time * frequency * count
    if late > MOST_WAITING:
        fix = f"give at most {MOST_WAITING / frequency / count:.2g} s"
        faults.add("delay_time", delay_time, f"lasts longer than {MOST_WAITING} samples", fix)
    faults.raise_if_any()
    reach = options.reach * options.angle
    usual = SERVO_LAWS if hinge is None or not hinge.moves_root else ()
    laws = tuple(law for law in SERVOED if law in moved or law in usual)
    lower, upper, speed, pace = np.zeros((4, len(laws)))
    speed[:], pace[:] = WITHOUT_END, max((one.pace for one in moved.values()), default=0.0)  # one that is not moved
    for i, law in enumerate(laws):
        if law in moved:
            one = moved[law]
            lower[i] = -reach if one.lower is None else one.lower
            upper[i] = reach if one.upper is None else one.upper
            speed[i], pace[i] = min(one.speed, WITHOUT_END), one.pace
    used = upper - lower > 0.0
    if not used.any():
        faults.add("servos", servos, "leave nothing that can move", "give limits that differ")
        faults.raise_if_any()
    scales = np.array([options.scale(name) for name in FLIGHT_STATE])
    if held or delay_time > 0.0 or hinge is not None or laws != SERVO_LAWS:
        waiting = math.floor(late + 1e-9)
        timing = Timing(count, waiting, max(late - waiting, 0.0), held, laws, speed, pace)
        path, by_state, by_bumps, felt = sample_maps(orbit, timing)
        estimator = None if imu is None else estimator_of(imu, by_state, by_bumps, felt, 1.0 / frequency)
        phases = np.linspace(0.0, 1.0, count + 1)
    else:
        timing = estimator = None
        phases, path, by_state, by_bumps = segment_maps(orbit, count, options.linear.blocks)
    state_cost = np.zeros(by_state.shape[1:])
    state_cost[: len(scales), : len(scales)] = np.diag(1.0 / scales**2)
    if imu is not None and imu.height is None:
        state_cost[0, 0] = 0.0  # nothing tells the height
    input_cost = np.eye(int(used.sum())) / options.angle**2
    gains = np.zeros((count, len(laws), len(state_cost)))
    gains[:, used] = periodic_linear_quadratic(by_state, by_bumps[:, :, used], state_cost, input_cost)
    return SegmentFeedback(orbit, phases, path, by_state, by_bumps, gains, lower, upper, timing, imu, estimator)
