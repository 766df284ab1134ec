"""How an orbit answers to disturbances and to changes of its wingbeat, from beat to beat: `linearise`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._version import __version__
from wingbeat.errors import FaultList, install_extra
from wingbeat.kinematics import FREE_NAMES, parameter
from wingbeat.mechanics.flight_model import State
from wingbeat.orbits.flight.stroke_map import StrokeMap, stroke_map
from wingbeat.orbits.status import Status
from wingbeat.results.flight import Flight, simulate
from wingbeat.results.orbit import Orbit
from wingbeat.stability.averaged import averaged_rates
from wingbeat.stability.modes import PITCH_STATE, Mode, modes_of
from wingbeat.stability.options import DEFAULTS, LinearOptions
from wingbeat.stability.smooth import Compensation, can_be_smooth, compensation

if TYPE_CHECKING:
    import control

GUSTS = ("gust_u", "gust_w")


@dataclass(frozen=True)
class LinearFlight:
    """A certified orbit linearised from beat to beat; made by `linearise`.

    A small disturbance x of the state at the top of the stroke, changes y of the inputs and a gust g that blow for
    one beat lead to ``A x + B y + G g`` at the next top of the stroke.

    Attributes
    ----------
    orbit : the orbit.
    state : names of the state: body_pitch, u, w, pitch_rate [rad, m/s, m/s, rad/s]; height z [m] in front if asked.
    inputs : names of the parameters of the wingbeat that change from beat to beat.
    A : derivative of the state after a beat by the state before it, shape (n, n).
    B : derivative of the state after a beat by the inputs, shape (n, inputs).
    G : derivative of the state after a beat by the velocity (u, w) of air that moves evenly during this beat, shape
        (n, 2).
    dt : time of a beat [s].
    modes : of body_pitch, u, w, pitch_rate; the fastest growing first.
    averaged_modes : those of the averaged model, whose rates are the means over the beat.
    compensation : harmonics that go with the inputs, so that the wing does not jump; empty if not asked.
    """

    orbit: Orbit
    state: tuple[str, ...]
    inputs: tuple[str, ...]
    A: np.ndarray
    B: np.ndarray
    G: np.ndarray
    dt: float
    modes: tuple[Mode, ...]
    averaged_modes: tuple[Mode, ...]
    compensation: Compensation

    @property
    def spectral_radius(self) -> float:
        """Largest modulus of a multiplier; the orbit is stable if it is below 1."""
        return abs(self.modes[0].multiplier)

    def record(self) -> dict[str, Any]:
        """Return all numbers as a JSON-able dictionary in SI units and radians; complex numbers become pairs."""
        problem = self.orbit.problem
        shares = self.compensation.shares.T.tolist()
        return {
            **{"species": problem.species.name, "speed": problem.speed, "climb": problem.climb},
            "frequency": self.orbit.wingbeat.frequency,
            "dt": self.dt,
            "state": list(self.state),
            "inputs": list(self.inputs),
            "gusts": list(GUSTS),
            **{"A": self.A.tolist(), "B": self.B.tolist(), "G": self.G.tolist()},
            "compensation": {
                name: dict(zip(self.compensation.names, row, strict=True))
                for name, row in zip(self.inputs, shares, strict=True)
            },
            "spectral_radius": self.spectral_radius,
            "stable": self.spectral_radius < 1.0,
            "modes": [mode.record() for mode in self.modes],
            "averaged": {
                "spectral_radius": abs(self.averaged_modes[0].multiplier),
                "modes": [mode.record() for mode in self.averaged_modes],
            },
            "version": __version__,
        }

    def mode_flight(self, index: int, size: float = 0.05, beats: int = 8) -> Flight:
        """Fly the orbit with a mode's disturbance: the whole equations of motion, not the linear ones.

        Parameters
        ----------
        index : of the mode, the fastest growing first.
        size : factor on its `Mode.disturbance` [-].
        beats : number of beats.

        Raises
        ------
        InvalidInputError : an index that no mode has, a size that is not finite.

        >>> import wingbeat as wb
        >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
        >>> wb.linearise(orbit).mode_flight(0, beats=3).completed
        True
        """
        faults = FaultList()
        faults.whole("index", index, 0, len(self.modes) - 1)
        faults.number("size", size)
        faults.raise_if_any()
        disturbance = size * np.real(self.modes[index].disturbance)
        start = np.array(self.orbit.initial_state)
        start[2:] += disturbance
        return simulate(self.orbit.problem.model, self.orbit.wingbeat, State(*start.tolist()), beats)

    def to_control(self) -> control.StateSpace:
        """Return the linear flight as a state space of the library python-control; needs the extra ``control``.

        Its inputs are those of the wingbeat, then the gusts; its outputs are the state.

        Raises
        ------
        ImportError : without the extra.
        """
        try:
            import control
        except ImportError:
            raise ImportError(install_extra("control")) from None
        order, inputs = len(self.state), [*self.inputs, *GUSTS]
        return control.StateSpace(
            self.A,
            np.hstack([self.B, self.G]),
            np.eye(order),
            np.zeros((order, len(inputs))),
            self.dt,
            states=list(self.state),
            inputs=inputs,
            outputs=list(self.state),
        )


def linearise(
    orbit: Orbit,
    inputs: Sequence[str] | None = None,
    *,
    height: bool = False,
    smooth: bool = True,
    options: LinearOptions = DEFAULTS,
) -> LinearFlight:
    """Linearise a certified orbit from one beat to the next.

    Parameters
    ----------
    orbit : a certified orbit.
    inputs : names of parameters of the wingbeat that may change from beat to beat. Default: the free parameters of
        its problem that do not make the wing jump.
    height : whether the height z is part of the state.
    smooth : whether harmonics go with each input, so that the wing does not jump at the top of the stroke.
    options : of the linearisation.

    Raises
    ------
    InvalidInputError : an orbit that is not certified, inputs that are no parameters of a wingbeat, that are given
        twice, or that make the wing jump although `smooth` is asked.

    The map is the derivative of the flight of one beat; a gust that blows evenly for a beat acts by
    ``G = (I - A)[:, (u, w)]``, because air that moves with the body is still air.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> flight = wb.linearise(orbit)
    >>> [mode.kind for mode in flight.modes], round(flight.modes[0].time_to_double, 3)
    (['divergence', 'oscillation', 'subsidence'], 0.245)
    """
    faults = FaultList()
    if orbit.status is not Status.CONVERGED:
        faults.add("orbit", orbit.status.value, "is not certified", "linearise a certified orbit")
    if inputs is not None:
        _check_inputs(faults, inputs)
    faults.raise_if_any()
    problem, beat = orbit.problem, orbit.wingbeat
    names = _free_inputs(problem.free, orbit, smooth) if inputs is None else tuple(inputs)
    along = compensation(beat, names) if smooth else Compensation((), np.zeros((0, len(names))))
    start = np.array(orbit.initial_state)[2:]
    flown = stroke_map(problem.model, beat, start, (*names, *along.names), options.blocks)
    scales = _scales(orbit)
    averaged = averaged_rates(problem.model, beat, flown.path)
    return LinearFlight(
        orbit,
        ("z", *PITCH_STATE) if height else PITCH_STATE,
        names,
        *_matrices(flown, along, 1.0 / beat.frequency, height),
        1.0 / beat.frequency,
        tuple(modes_of(flown.by_state[1:, 1:], beat.frequency, flown.along, scales)),
        tuple(_averaged_modes(averaged, beat.frequency, len(flown.along), scales)),
        along,
    )


def _check_inputs(faults: FaultList, inputs: Sequence[str]) -> None:
    if isinstance(inputs, str) or not inputs:
        faults.add(
            "inputs", inputs, "must be a list of at least one name", "for example ['frequency', 'pitch_mean']"
        )
        return
    for name in inputs:
        faults.choice("inputs", name, FREE_NAMES)
    if len(set(inputs)) < len(inputs):
        faults.add("inputs", list(inputs), "has a name twice", "give each input once")


def _free_inputs(free: Sequence[str], orbit: Orbit, smooth: bool) -> tuple[str, ...]:
    """Return the free parameters of a problem, without those that make the wing jump."""
    names = [name for name in free if name in FREE_NAMES]
    if not smooth:
        return tuple(names)
    return tuple(name for name in names if can_be_smooth(orbit.wingbeat, name))


def _matrices(
    flown: StrokeMap, along: Compensation, dt: float, height: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return A, B and G, with or without the height."""
    count = flown.by_parameters.shape[1] - len(along.names)
    by_inputs = flown.by_parameters[:, :count] + flown.by_parameters[:, count:] @ along.shares
    # Relative to air that moves with (u, w), the body starts slower by these and ends faster by them.
    by_gust = (np.eye(5) - flown.by_state)[:, 2:4]
    by_gust[0, 1] += dt  # the air lifts the body
    rows = slice(0 if height else 1, None)
    return flown.by_state[rows, rows], by_inputs[rows], by_gust[rows]


def _averaged_modes(rates: np.ndarray, frequency: float, samples: int, scales: np.ndarray) -> list[Mode]:
    from scipy.linalg import expm

    along = np.stack([expm(rates * phase / frequency) for phase in np.linspace(0.0, 1.0, samples)])
    return modes_of(along[-1], frequency, along, scales)


def _scales(orbit: Orbit) -> np.ndarray:
    """Return disturbances of (body_pitch, u, w, pitch_rate) that count as equally large, shape (4,).

    A radian, the speed of the air at the wings' tips, and a radian in a beat.
    """
    problem, beat = orbit.problem, orbit.wingbeat
    tips = 4.0 * parameter(beat, "flap_amplitude") * beat.frequency * problem.vehicle.wing.semi_span
    speed = math.hypot(problem.speed, problem.climb, float(tips))
    return np.array([1.0, speed, speed, beat.frequency])
