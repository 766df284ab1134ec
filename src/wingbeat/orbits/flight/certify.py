"""The certificate: an independent adaptive flight of one period.

It shares nothing with the solver's flights: Dopri8, with error control at rtol 1e-10, evaluates the wing's motion
at its own instants.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.flights import RTOL, Steps, fly_through

SAMPLES = 256
# Number of samples of a flight that serves only the correction.
_ROUGH_SAMPLES = 32


@dataclass(frozen=True)
class Certificate:
    """One period flown by the certifier.

    Attributes
    ----------
    phase : phases of the samples, shape (K,).
    states : (x, z, body_pitch, u, w, pitch_rate) there, shape (K, 6) [m, m, rad, m/s, m/s, rad/s].
    steps : the integrator's steps.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> flown = wb.certify(orbit.problem.model, orbit.wingbeat, orbit.initial_state[2:])
    >>> round(float(flown.end[0]) * orbit.wingbeat.frequency, 3), flown.pitch.shape  # mean speed, body pitch
    (12.0, (257,))
    """

    phase: np.ndarray
    states: np.ndarray
    steps: Steps

    @property
    def end(self) -> np.ndarray:
        """The state at the end of the period."""
        return self.states[-1]

    @property
    def pitch(self) -> np.ndarray:
        """Body pitch along the path [rad]."""
        return self.states[:, 2]


def certify(
    model: FlightModel, wingbeat: Wingbeat, pitch_state: np.ndarray, rtol: float = RTOL, *, rough: bool = False
) -> Certificate:
    """Fly one period from x = z = 0 and the given (body_pitch, u, w, pitch_rate).

    Theory: equation ``certificate``.

    Parameters
    ----------
    model, wingbeat : the flight model and its wingbeat.
    pitch_state : initial pitch state, shape (4,) [rad, m/s, m/s, rad/s].
    rtol : relative tolerance of the flight.
    rough : whether to sample the path at only a few phases, which takes half the time.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> flown = wb.certify(orbit.problem.model, orbit.wingbeat, orbit.initial_state[2:])
    >>> bool(abs(flown.end[2:] - flown.states[0, 2:]).max() < 1e-6)
    True
    """
    # A rough flight has the same number of phases, the last ones all at the end. One compiled program thus serves
    # both kinds of flight.
    phase = np.minimum(np.linspace(0.0, SAMPLES / _ROUGH_SAMPLES if rough else 1.0, SAMPLES + 1), 1.0)
    start = State(0.0, 0.0, *pitch_state)
    return Certificate(phase, *fly_through(model, wingbeat, start, phase, rtol))
