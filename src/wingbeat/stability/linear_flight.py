"""How an orbit answers to disturbances and to changes of its wingbeat, from beat to beat: `linearise`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, Report, Reported, __version__, install_extra
from wingbeat.animal.kinematics import Wingbeat, flap_angle
from wingbeat.mechanics.flight_model import State
from wingbeat.orbits.flight.certificate import StrokeMap, stroke_map
from wingbeat.orbits.flight.period import PITCH_STATE
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.plots.draw_stability import stability_page
from wingbeat.results.flight import Flight, simulate
from wingbeat.stability.inputs import Compensation, compensation, smooth_ones
from wingbeat.stability.modes import Mode, averaged_jacobian, averaged_modes, modes_of
from wingbeat.stability.options import LINEAR, LinearOptions, check_certified, check_inputs
from wingbeat.stability.reports import linear_report

if TYPE_CHECKING:
    import control
    from matplotlib.figure import Figure

    from wingbeat.results.orbit import Orbit

GUSTS = ("gust_u", "gust_w")


@dataclass(frozen=True)
class LinearFlight(Reported):
    """A certified orbit linearised from beat to beat; made by `linearise`.

    A small disturbance x of the state at the top of the stroke leads to ``A x + B y + G g`` at the next top of the
    stroke. Here y are changes of the inputs and g is a gust, both constant for one beat. An input ``frequency``
    changes the time of its beat; `dt` is the time of a beat of the undisturbed orbit.

    Attributes
    ----------
    orbit : the orbit.
    state : names of the state: body_pitch, u, w, pitch_rate [rad, m/s, m/s, rad/s]; with `height`, z [m] is first.
    inputs : names of the parameters of the wingbeat that change from beat to beat.
    A : derivative of the state after a beat by the state before it, shape (n, n).
    B : derivative of the state after a beat by the inputs, shape (n, inputs).
    G : derivative of the state after a beat by the velocity (u, w) of air that is uniform and constant for a beat,
        shape (n, 2).
    dt : time of a beat [s].
    modes : of body_pitch, u, w, pitch_rate; the fastest growing first.
    averaged_modes : modes of the averaged model, whose matrix holds the derivatives of the rates by the state,
        averaged along the orbit.
    compensation : harmonics that go with the inputs, so that the wing does not jump; empty without `smooth`.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> flight = wb.linearise(orbit)
    >>> flight.state, round(flight.spectral_radius, 2)
    (('body_pitch', 'u', 'w', 'pitch_rate'), 1.35)
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
        """Largest modulus of a multiplier; below 1 disturbances decay."""
        return abs(self.modes[0].multiplier)

    def _report(self) -> Report:
        return linear_report(self.record())

    def plot(self) -> Figure:
        """Return a figure of the multipliers, the growth and what moves in each mode."""
        return stability_page([self.record()])

    def record(self) -> dict[str, Any]:
        """Return all numbers as a JSON-able dictionary in SI units and radians; complex numbers become pairs."""
        asked, harmonics = self.orbit.inputs, self.compensation
        return {
            "species": asked["species"]["name"],
            "speed": asked["speed"],
            "climb": asked["climb"],
            "frequency": self.orbit.wingbeat.frequency,
            "dt": self.dt,
            "state": list(self.state),
            "inputs": list(self.inputs),
            "gusts": list(GUSTS),
            "A": self.A.tolist(),
            "B": self.B.tolist(),
            "G": self.G.tolist(),
            "compensation": {
                name: dict(zip(harmonics.names, row, strict=True))
                for name, row in zip(self.inputs, harmonics.shares.T.tolist(), strict=True)
            },
            "spectral_radius": self.spectral_radius,
            "stable": self.orbit.record()["stable"],  # by the certified multipliers
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
        start, problem = np.array(self.orbit.initial_state), self.orbit.problem
        start[2:] += size * np.real(self.modes[index].disturbance)
        return simulate(problem.model, self.orbit.wingbeat, State(*start.tolist()), beats, species=problem.species)

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
        matrices = self.A, np.hstack([self.B, self.G]), np.eye(order), np.zeros((order, len(inputs)))
        state = list(self.state)
        return control.StateSpace(*matrices, self.dt, states=state, inputs=inputs, outputs=state)


def linearise(
    orbit: Orbit,
    inputs: Sequence[str] | None = None,
    *,
    height: bool = False,
    smooth: bool = True,
    options: LinearOptions = LINEAR,
) -> LinearFlight:
    """Linearise a certified orbit from one beat to the next.

    Theory: equations ``beat-map`` and ``gust-map``.

    Parameters
    ----------
    orbit : a certified orbit.
    inputs : names of parameters of the wingbeat that may change from beat to beat. Default: those free parameters
        of its problem whose jumps harmonics can undo.
    height : whether the height z is part of the state.
    smooth : whether harmonics go with each input, so that the wing does not jump at the top of the stroke.
    options : of the linearisation.

    Raises
    ------
    InvalidInputError : an orbit that is not certified, or that does not close when this version flies it; inputs
        that are no parameters of the wingbeat, that are given twice or change nothing, or whose jumps no harmonic
        can undo.

    The map is the derivative of the flight of one beat. Loads depend only on the velocity relative to the air, so
    ``G = (I - A)[:, (u, w)]`` for a gust that is uniform and constant for one beat; with the height, the air also
    carries the body up by ``dt`` per unit of w.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> flight = wb.linearise(orbit)
    >>> [mode.kind for mode in flight.modes], round(flight.modes[0].time_to_double, 3)
    (['divergence', 'oscillation', 'subsidence'], 0.245)
    """
    faults = FaultList()
    check_certified(faults, orbit, "linearise a certified orbit")
    problem, beat = orbit.problem, orbit.wingbeat
    if inputs is not None:
        check_inputs(faults, inputs, problem.vehicle)
    faults.raise_if_any()
    names = tuple(problem.free if inputs is None else inputs)
    if smooth and inputs is None:
        names = smooth_ones(beat, names)
    harmonics = compensation(beat, names) if smooth else Compensation((), np.zeros((0, len(names))))
    start = np.array(orbit.initial_state)[2:]
    flown = _accurate_map(orbit, start, (*names, *harmonics.names) or ("frequency",), options)
    scales = _scales(problem, beat)
    miss = float(np.abs((flown.path[-1] - flown.path[0]) / scales).max())
    if not miss <= options.closure:
        faults.add("orbit", miss, "does not close when this version flies it", "solve the orbit again")
    faults.raise_if_any()
    averaged = averaged_jacobian(problem.model, beat, flown.path)
    by_inputs = flown.by_parameters[:, : len(names)]
    if harmonics.names:
        by_inputs = by_inputs + flown.by_parameters[:, len(names) :] @ harmonics.shares
    # At the start, the velocity of the air is subtracted from that of the body. At the end, it is added again.
    by_gust = (np.eye(5) - flown.by_state)[:, 2:4]
    by_gust[0, 1] += 1.0 / beat.frequency  # the air lifts the body
    rows = slice(0 if height else 1, None)
    return LinearFlight(
        orbit,
        ("z", *PITCH_STATE)[rows],
        names,
        flown.by_state[rows, rows],
        by_inputs[rows],
        by_gust[rows],
        1.0 / beat.frequency,
        tuple(modes_of(flown.by_state[1:, 1:], beat.frequency, flown.transition, scales)),
        tuple(averaged_modes(averaged, beat.frequency, len(flown.transition), scales)),
        harmonics,
    )


def _accurate_map(
    orbit: Orbit, start: np.ndarray, parameters: tuple[str, ...], options: LinearOptions
) -> StrokeMap:
    """Return the stroke map, flown in so many steps that its multipliers agree with those of the certificate.

    They are compared by their characteristic polynomials, because two multipliers that nearly meet are inaccurate
    one by one.
    """
    certified = np.poly([complex(*pair) for pair in orbit.record()["floquet_multipliers"]])
    blocks = options.blocks
    while True:
        flown = stroke_map(orbit.problem.model, orbit.wingbeat, start, parameters, blocks)
        away = np.abs(np.poly(flown.by_state[1:, 1:]) - certified).max() / np.abs(certified).max()
        if not away > options.agreement or blocks >= options.most_blocks:
            return flown
        blocks *= 4


def _scales(problem: OrbitProblem, wingbeat: Wingbeat) -> np.ndarray:
    """Return disturbances of (body_pitch, u, w, pitch_rate) that count as equally large, shape (4,).

    They are a radian for the pitch, and a radian in a beat for the pitch rate. For both velocities, they are the
    root sum square of flight speed and mean flapping speed of the wing tips.
    """
    flap = np.asarray(flap_angle(wingbeat, np.linspace(0.0, 1.0, 65)))
    tips = float(np.abs(np.diff(flap)).sum()) * wingbeat.frequency * problem.vehicle.wing.semi_span
    speed = math.hypot(problem.speed, problem.climb, tips) or 1.0  # nothing moves without weight in hover
    return np.array([1.0, speed, speed, wingbeat.frequency])
