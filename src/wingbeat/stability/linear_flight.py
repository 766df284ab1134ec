"""How an orbit answers to disturbances and to changes of its wingbeat, from beat to beat: `linearise`.

Modes say what grows or decays, how fast, and what moves in each. They are those of the map over a beat, or those
of the averaged model, whose rates are linear with the mean over the beat of their derivatives.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, Report, Reported, __version__, install_extra
from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, flap_angle
from wingbeat.animal.pitch_hinge import HINGE_NAMES
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.state_rates import HINGE_STATE, body_rates, rate_table
from wingbeat.orbits.flight.certificate import StrokeMap, multipliers_of, stroke_map
from wingbeat.orbits.flight.period import PITCH_STATE
from wingbeat.orbits.options import check_certified
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.plots.draw_stability import stability_page
from wingbeat.results.flight import Flight, simulate
from wingbeat.stability.inputs import Compensation, compensation, smooth_ones
from wingbeat.stability.options import FLIGHT_STATE, LINEAR, LinearOptions, check_inputs, check_no_wake
from wingbeat.stability.reports import linear_report, mode_report

if TYPE_CHECKING:
    import control
    from matplotlib.figure import Figure

    from wingbeat._jax.arrays import PitchState, RatesByState, Samples
    from wingbeat.results.orbit import Orbit

# A multiplier whose imaginary part is below this share of its modulus is real.
_REAL = 1e-9


@dataclass(frozen=True)
class Mode(Reported):
    """One mode of a disturbed flight: its disturbance is multiplied by the same number in each beat.

    Attributes
    ----------
    kind : ``divergence`` grows and ``subsidence`` decays without oscillating; an ``oscillation`` has a pair of
        complex multipliers; a ``flip`` changes sign every beat.
    multiplier : Floquet multiplier; of a complex pair, the one with positive imaginary part.
    time_to_double, time_to_half : [s]; None for the one that does not apply.
    period : of an oscillation, or of a flip, which takes two beats [s]; None for others. The map gives the
        frequency of an oscillation only up to multiples of the wingbeat frequency; this is the longest period.
    damping : damping ratio of an oscillation or of a flip, negative if it grows; None for others.
    disturbance : of (body_pitch, u, w, pitch_rate) at phase 0, shape (4,). Its length is 1 in the scales of
        `modes_of`.
    shares : mean size over the beat of each of the four numbers, without growth and decay, as a share of their sum.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> fastest = wb.linearise(orbit).modes[0]
    >>> fastest.kind, round(fastest.time_to_double, 2)  # it doubles in so many seconds
    ('divergence', 0.24)
    """

    kind: str
    multiplier: complex
    time_to_double: float | None
    time_to_half: float | None
    period: float | None
    damping: float | None
    disturbance: np.ndarray
    shares: dict[str, float]

    def _report(self) -> Report:
        return mode_report(self.record())

    def record(self) -> dict[str, Any]:
        """Return the mode as a JSON-able dictionary; complex numbers become pairs."""
        return {
            "kind": self.kind,
            "multiplier": [self.multiplier.real, self.multiplier.imag],
            "modulus": abs(self.multiplier),
            "time_to_double": self.time_to_double,
            "time_to_half": self.time_to_half,
            "period": self.period,
            "damping": self.damping,
            "disturbance": [[value.real, value.imag] for value in self.disturbance.tolist()],
            "shares": self.shares,
        }


def modes_of(monodromy: np.ndarray, frequency: float, transition: np.ndarray, scales: np.ndarray) -> list[Mode]:
    """Return the modes of a map from beat to beat, the fastest growing first.

    `monodromy` is the derivative of the state after a beat by that before it, `transition` the same at equal
    phases from 0 to 1, shape (K, 4, 4); `scales` are disturbances that count as equally large.

    Theory: equation ``mode-rates``.
    """
    multipliers, vectors = np.linalg.eig(monodromy)
    found = []
    for i in np.lexsort((-np.imag(multipliers), -np.round(np.abs(multipliers), 12))):
        multiplier, vector = complex(multipliers[i]), vectors[:, i].astype(complex)
        if multiplier.imag < -_REAL * abs(multiplier):
            continue
        vector = vector / np.linalg.norm(vector / scales)
        found.append(_mode(multiplier, frequency, vector, _shares(multiplier, transition @ vector, scales)))
    return found


def _mode(multiplier: complex, frequency: float, disturbance: np.ndarray, shares: dict[str, float]) -> Mode:
    size = abs(multiplier)
    swings = abs(multiplier.imag) > _REAL * size
    if swings:
        kind = "oscillation"
    elif multiplier.real < 0:
        kind = "flip"
    else:
        kind = "divergence" if size > 1 else "subsidence"
    rate = frequency * math.log(size) if size > 0 else -math.inf
    turn = frequency * abs(cmath.phase(multiplier))
    turns = kind in ("oscillation", "flip")
    return Mode(
        kind,
        multiplier,
        math.log(2) / rate if rate > 0 else None,
        -math.log(2) / rate if rate < 0 else None,
        2 * math.pi / turn if turns else None,
        -rate / math.hypot(rate, turn) if turns and math.isfinite(rate) else None,
        disturbance,
        shares,
    )


def _shares(multiplier: complex, path: np.ndarray, scales: np.ndarray) -> dict[str, float]:
    """Return the mean size of each number over the beat, without growth and decay, as a share of their sum.

    Theory: equation ``mode-shares``.
    """
    decay = cmath.log(multiplier) if multiplier else 0.0
    steady = path * np.exp(-decay * np.linspace(0.0, 1.0, len(path)))[:, None]
    sizes = np.abs(steady / scales)[:-1].mean(axis=0)
    names = (*PITCH_STATE, *HINGE_STATE)[: len(scales)]
    return dict(zip(names, (sizes / sizes.sum()).tolist(), strict=True))


@exported
def _rates_by_state(model: FlightModel, wingbeat: Wingbeat, phase: Samples, path: PitchState) -> RatesByState:
    """Return the derivatives of all rates by all states at each phase, shape (states, rates, K)."""
    motion = rate_table(model, wingbeat, phase)

    def by_state(seed: Any) -> Any:
        tangent = jnp.broadcast_to(seed[:, None], path.shape)
        return jax.jvp(lambda state: body_rates(model, motion, state), (path,), (tangent,))[1]

    return jax.vmap(by_state)(jnp.eye(len(path)))


def averaged_jacobian(model: FlightModel, wingbeat: Wingbeat, path: np.ndarray) -> np.ndarray:
    """Return the mean over the beat of the derivatives of all rates (rows) by all states, shape (4, 4).

    `path` holds the states at equal phases from 0 to 1, shape (K, 4); a hinge adds two.

    Theory: equation ``averaged-model``.
    """
    phase = np.linspace(0.0, 1.0, len(path))[:-1]
    return np.asarray(_rates_by_state.bind(model, wingbeat)(phase, path[:-1].T)).mean(axis=-1).T


def averaged_modes(rates: np.ndarray, frequency: float, samples: int, scales: np.ndarray) -> list[Mode]:
    """Return the modes of steady rates whose derivatives by the state are `rates`, shape (4, 4) [per s].

    Theory: equation ``averaged-model``.
    """
    from scipy.linalg import expm

    transition = np.stack([expm(rates * phase / frequency) for phase in np.linspace(0.0, 1.0, samples)])
    return modes_of(transition[-1], frequency, transition, scales)


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
        A hinge that gives way adds hinge_angle and hinge_rate [rad, rad/s].
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
        asked, harmonics, flown = self.orbit.inputs, self.compensation, self.orbit.record()
        return {
            "species": asked["species"]["name"],
            "speed": asked["speed"],
            "climb": asked["climb"],
            **{name: flown[name] for name in ("air", "carried_mass") if name in flown},
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
            "stable": flown["stable"],  # by the certified multipliers
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
        orbit, moved = self.orbit, size * np.real(self.modes[index].disturbance)
        start, hinge = np.array(orbit.initial_state), orbit.hinge_start + moved[4:]
        start[2:] += moved[:4]
        own = {"species": orbit.problem.species, "hinge": hinge if hinge.size else None}
        return simulate(orbit.problem.model, orbit.wingbeat, State(*start.tolist()), beats, **own)

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


# A hinge is built once: no command changes its numbers, unless it is asked to.
_BUILT = tuple(HINGE_NAMES)


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
    InvalidInputError : an orbit that is not certified, has the lag of the wake, or does not close when this
        version flies it; inputs that are no parameters of the wingbeat, that are given twice or change nothing, or
        whose jumps no harmonic can undo.

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
    check_certified(faults, orbit.status, "linearise a certified orbit")
    check_no_wake(faults, orbit.problem.aero.wake)
    problem, beat = orbit.problem, orbit.wingbeat
    if inputs is not None:
        check_inputs(faults, inputs, problem.vehicle)
    faults.raise_if_any()
    names = tuple(n for n in problem.free if n not in _BUILT) if inputs is None else tuple(inputs)
    if smooth and inputs is None:
        names = smooth_ones(beat, names)
    harmonics = compensation(beat, names) if smooth else Compensation((), np.zeros((0, len(names))))
    start = np.append(np.array(orbit.initial_state)[2:], orbit.hinge_start)
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
    by_gust = (np.eye(len(flown.by_state)) - flown.by_state)[:, 2:4]
    by_gust[0, 1] += 1.0 / beat.frequency  # the air lifts the body
    rows = slice(0 if height else 1, None)
    return LinearFlight(
        orbit,
        (*FLIGHT_STATE, *HINGE_STATE[: orbit.hinge_start.size])[rows],
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
        away = np.abs(np.poly(multipliers_of(flown.by_state[1:, 1:])) - certified).max() / np.abs(certified).max()
        if not away > options.agreement or blocks >= options.most_blocks:
            return flown
        blocks *= 4


def _scales(problem: OrbitProblem, wingbeat: Wingbeat) -> np.ndarray:
    """Return disturbances of (body_pitch, u, w, pitch_rate), and of a hinge, that count as equally large.

    They are a radian for angles, and a radian in a beat for their rates. For both velocities, they are the
    root sum square of flight speed and mean flapping speed of the wing tips.
    """
    flap = np.asarray(flap_angle(wingbeat, np.linspace(0.0, 1.0, 65)))
    tips = float(np.abs(np.diff(flap)).sum()) * wingbeat.frequency * problem.vehicle.wing.semi_span
    speed = math.hypot(problem.speed, problem.climb, tips) or 1.0  # nothing moves without weight in hover
    scales = np.array([1.0, speed, speed, wingbeat.frequency])
    return scales if wingbeat.pitch_hinge is None else np.append(scales, [1.0, wingbeat.frequency])
