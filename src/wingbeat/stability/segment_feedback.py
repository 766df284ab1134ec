"""Feedback several times a beat: `feedback_in_beat`.

A beat is cut into M equal segments of the stroke. In each, flap and pitch are raised by a bump ``b sin^2(M pi s)``,
with s the phase of the stroke. It begins and ends without a jump of position or speed. Within its segment, a bump
is a change of the mean by b/2 and of the cosine of order M by -b/2, so it needs no law of its own.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from wingbeat._base import HIGHEST_ORDER, FaultList
from wingbeat.aero.winds import Wind
from wingbeat.animal.kinematics import Wingbeat, parameter, stroke_phase, with_parameters
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.flights import air_at, air_phases, check_wind, fly_through
from wingbeat.orbits.flight.period import flier
from wingbeat.orbits.options import check_certified
from wingbeat.stability.options import FEEDBACK, FLIGHT_STATE, FeedbackOptions, check_no_wake
from wingbeat.stability.riccati import multipliers_over, periodic_linear_quadratic

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit

_LAWS = ("flap", "pitch")
_SAMPLES = 8  # of a segment, between which the adaptive integrator flies


@dataclass(frozen=True)
class SegmentFlight:
    """A flight with feedback several times a beat.

    Attributes
    ----------
    states : (x, z, body_pitch, u, w, pitch_rate) at the ends of all segments, shape (beats * segments + 1, 6).
    deviations : of (z, body_pitch, u, w, pitch_rate) from the orbit there, shape (beats * segments + 1, 5).
    bumps : of flap and pitch in each segment [rad], shape (beats * segments, 2).

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> flown = wb.feedback_in_beat(orbit, segments=4).fly(wb.winds.CosineGust(w=0.5), beats=2)
    >>> flown.bumps.shape, bool(abs(flown.bumps).max() > 0.0)
    ((8, 2), True)
    """

    states: np.ndarray
    deviations: np.ndarray
    bumps: np.ndarray


@dataclass(frozen=True)
class SegmentFeedback:
    """Feedback that adds bumps to flap and pitch in each segment of a beat; made by `feedback_in_beat`.

    Attributes
    ----------
    orbit : the orbit.
    phases : ends of the segments, shape (segments + 1,), from 0 to 1.
    path : (z, body_pitch, u, w, pitch_rate) of the orbit there, z from that at phase 0, shape (segments + 1, 5).
    A, B : linear maps over each segment, by the state and by the bumps, shapes (segments, 5, 5), (segments, 5, 2).
    gains : of each segment, shape (segments, 2, 5) [rad per unit of the state].
    limit : largest bump [rad].

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
    limit: float

    @property
    def multipliers(self) -> np.ndarray:
        """Multipliers of a beat with feedback, the largest first."""
        return multipliers_over([A - B @ K for A, B, K in zip(self.A, self.B, self.gains, strict=True)])

    @property
    def spectral_radius(self) -> float:
        """Largest modulus of a multiplier with feedback; below 1 disturbances decay."""
        return float(np.abs(self.multipliers[0]))

    def wingbeat(self, bumps: np.ndarray) -> Wingbeat:
        """Return the wingbeat that flies bumps; it holds within one segment.

        Parameters
        ----------
        bumps : of flap and pitch [rad], shape (2,).
        """
        beat, (names, shares) = self.orbit.wingbeat, bump_parameters(len(self.gains))
        changed = [float(parameter(beat, name)) for name in names] + shares @ bumps
        return with_parameters(beat, dict(zip(names, changed.tolist(), strict=True)))

    def fly(self, wind: Wind | tuple[float, float], beats: int = 30) -> SegmentFlight:
        """Fly the orbit through a wind with this feedback, the whole equations of motion.

        Parameters
        ----------
        wind : velocity of the air, as in `simulate`.
        beats : number of wingbeats.

        Raises
        ------
        InvalidInputError : beats that are no whole number, a wind that is not finite.
        """
        faults = FaultList()
        faults.whole("beats", beats, 1, 10_000)
        check_wind(faults, wind)
        faults.raise_if_any()
        model, period = self.orbit.problem.model, 1.0 / self.orbit.wingbeat.frequency
        state, climb = np.array(self.orbit.initial_state, dtype=float), float(self.orbit.inputs["climb"]) * period
        states, deviations, bumps = [state], [np.zeros(5)], []
        for beat in range(beats):
            table = air_at(wind, period * (beat + air_phases()))
            raised = np.array([states[0][1] + climb * beat, 0.0, 0.0, 0.0, 0.0])
            for j in range(len(self.gains)):
                taken = np.clip(-self.gains[j] @ deviations[-1], -self.limit, self.limit)
                taken = np.where(np.isfinite(taken), taken, 0.0)  # the vehicle has tumbled
                phases = np.linspace(self.phases[j], self.phases[j + 1], _SAMPLES + 1)
                flown, _ = fly_through(model, self.wingbeat(taken), State(*state), phases, air=table)
                state = flown[-1]
                states.append(state)
                deviations.append(state[1:] - self.path[j + 1] - raised)
                bumps.append(taken)
        return SegmentFlight(np.stack(states), np.stack(deviations), np.stack(bumps))


def feedback_in_beat(orbit: Orbit, segments: int = 4, *, options: FeedbackOptions = FEEDBACK) -> SegmentFeedback:
    """Compute the linear feedback that holds an orbit by bumps of flap and pitch several times a beat.

    Parameters
    ----------
    orbit : a certified orbit.
    segments : number of segments of a beat, 2 to 8; the state is measured at the start of each.
    options : scales of the state, and unit and reach of angles.

    Raises
    ------
    InvalidInputError : an orbit that is not certified or has the lag of the wake, segments that are no whole
        number from 2 to 8.

    The gains minimise the sum over all segments of squared deviations in scales and squared bumps in units; they
    solve the periodic discrete Riccati equation (Bittanti, Colaneri & De Nicolao 1991, in The Riccati Equation).

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> wb.feedback_in_beat(orbit, 4).spectral_radius < 1
    True
    """
    faults = FaultList()
    check_certified(faults, orbit.status, "hold a certified orbit")
    check_no_wake(faults, orbit.problem.aero.wake)
    faults.whole("segments", segments, 2, HIGHEST_ORDER, "4 for example")
    faults.raise_if_any()
    phases, path, by_state, by_bumps = _segment_maps(orbit, segments, options.linear.blocks)
    scales = np.array([options.scale(name) for name in FLIGHT_STATE])
    costs = np.diag(1.0 / scales**2), np.eye(len(_LAWS)) / options.angle**2
    gains = periodic_linear_quadratic(by_state, by_bumps, *costs)
    return SegmentFeedback(orbit, phases, path, by_state, by_bumps, gains, options.reach * options.angle)


def bump_parameters(segments: int) -> tuple[tuple[str, ...], np.ndarray]:
    """Return the parameters that make bumps, and the change of each by bumps of flap and pitch, (names, 2).

    Theory: equation ``bump``.
    """
    names = tuple(name for law in _LAWS for name in (f"{law}_mean", f"{law}_cos_{segments}"))
    return names, np.kron(np.eye(len(_LAWS)), [[0.5], [-0.5]])


def _segment_maps(orbit: Orbit, segments: int, blocks: int) -> tuple[np.ndarray, ...]:
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
