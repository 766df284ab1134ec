"""A wing whose pitch gives way, on a stand that holds the body: what its hinge does over a stroke."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat._jax.arrays import jax, jnp
from wingbeat.aero.blade_element import blade_element_of
from wingbeat.animal.kinematics import PitchHinge, Wingbeat, flap_angle
from wingbeat.animal.vehicle import Air, Vehicle
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.state_rates import GivingStroke, acceleration_on_stand, rate_table

if TYPE_CHECKING:
    from numpy.typing import NDArray

_SETTLING = 40  # strokes before Newton's method; a hinge without damper loses its start to the air in some ten
_NEWTON = 30  # steps of Newton's method: the wings of the evidence needed a few
_CLOSURE = 1e-8  # in radians, and in radians a stroke


@dataclass(frozen=True)
class StandBeat:
    """A periodic stroke of a wing on a stand.

    Attributes
    ----------
    phase : of the stroke, (N,).
    flap_angle, hinge_angle : there [rad], (N,).
    hinge_rate : there [rad/s], (N,).
    multipliers : Floquet multipliers of the hinge, (2,).
    settled : whether the wing comes to this stroke by itself: all multipliers lie inside the unit circle.

    >>> import numpy as np
    >>> phase = np.arange(8) / 8
    >>> flap, pitch = 0.6 * np.cos(2 * np.pi * phase), -0.4 * np.sin(2 * np.pi * phase)
    >>> beat = StandBeat(phase, flap, pitch, np.zeros(8), np.array([0.1, 0.2j]))
    >>> round(beat.amplitude, 3), round(float(np.degrees(beat.lead)), 1), beat.settled
    (0.4, 90.0, True)
    """

    phase: NDArray[np.float64]
    flap_angle: NDArray[np.float64]
    hinge_angle: NDArray[np.float64]
    hinge_rate: NDArray[np.float64]
    multipliers: NDArray[np.complex128]

    @property
    def settled(self) -> bool:
        """Whether the wing comes to this stroke by itself."""
        return bool(np.all(np.abs(self.multipliers) < 1))

    @property
    def amplitude(self) -> float:
        """Amplitude of the first harmonic of the hinge angle [rad]."""
        return float(2 * abs(np.mean(self.hinge_angle * np.exp(-2j * np.pi * self.phase))))

    @property
    def lead(self) -> float:
        """Phase by which the first harmonic of the hinge angle leads that of the flap angle [rad], -pi to pi."""
        turn = np.exp(-2j * np.pi * self.phase)
        return float(np.angle(np.mean(self.hinge_angle * turn) / np.mean(self.flap_angle * turn)))


@jax.jit
def _stroke(model: FlightModel, wingbeat: Wingbeat, start: Any, speed: Any, phase: Any) -> Any:
    """Return angle and rate at each step and the end, (N + 1, 2), by the classical Runge-Kutta rule."""
    step = 1 / (wingbeat.frequency * phase.size)

    def rates(at: Any, state: Any) -> Any:
        stroke = rate_table(model, wingbeat, at[None])
        assert isinstance(stroke, GivingStroke)
        return jnp.stack([state[1], acceleration_on_stand(model, stroke, state[:1], state[1:], speed)[0]])

    def advance(state: Any, at: Any) -> Any:
        half, full = at + 0.5 / phase.size, at + 1 / phase.size
        k1 = rates(at, state)
        k2 = rates(half, state + 0.5 * step * k1)
        k3 = rates(half, state + 0.5 * step * k2)
        k4 = rates(full, state + step * k3)
        return state + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4), state

    last, states = jax.lax.scan(advance, start, phase)
    return jnp.concatenate([states, last[None]])


def wing_on_stand(
    vehicle: Vehicle, wingbeat: Wingbeat, aero: Any, air: Air | None = None, speed: float = 0.0, steps: int = 512
) -> StandBeat:
    """Return the periodic stroke of a wing with a passive pitch hinge while a stand holds the body.

    The wing starts at the hinge's rest angle and flaps until it settles; Newton's method closes the stroke. The
    body is held at zero pitch, in still air or in a wind tunnel.

    Parameters
    ----------
    vehicle : whose wing it is; the body does not move.
    wingbeat : with the flap law and a `PitchHinge`.
    aero : a coefficient model, its name, or a `BladeElement`. The force acts at the centre of pressure unless the
        `BladeElement` says otherwise: at the quarter chord, air exerts no torque about an axis there.
    air : standard air if not given.
    speed : of the wind from ahead [m/s].
    steps : number of steps of the integration in a stroke, at least 32.

    Returns
    -------
    StandBeat : the stroke.

    Raises
    ------
    InvalidInputError : a wingbeat without a `PitchHinge`, a speed that is negative, too few steps, or no periodic
        stroke found.

    Theory: equation ``hinge-balance``. Source: Whitney and Wood 2010 (doi 10.1017/S002211201000265X).

    >>> import wingbeat as wb
    >>> robot = wb.load_species("robofalcon2")
    >>> hinge = wb.PitchHinge(stiffness=1.4, damping=0.017)
    >>> wingbeat = wb.Wingbeat(6.0, 0.0, 0.6, 0.0, 0.0, pitch_hinge=hinge)
    >>> stroke = wb.wing_on_stand(robot.vehicle, wingbeat, "su-fan", speed=8.0)
    >>> stroke.settled
    True
    """
    faults = FaultList()
    faults.number("speed", speed, at_least=0, unit="m/s")
    faults.whole("steps", steps, 32, 1_000_000)
    if not isinstance(wingbeat.pitch_hinge, PitchHinge):
        faults.add("wingbeat.pitch_hinge", wingbeat.pitch_hinge, "is missing", "give the wing a PitchHinge")
    faults.raise_if_any()
    assert isinstance(wingbeat.pitch_hinge, PitchHinge)
    element = blade_element_of(aero, "centre-of-pressure")
    model = FlightModel(vehicle, element, Air() if air is None else air, (speed, 0.0))
    phase = np.arange(steps) / steps
    scale = np.array([1.0, wingbeat.frequency])

    def flown(start: Any) -> Any:
        return np.asarray(_stroke(model, wingbeat, start, speed, phase))

    start = np.array([wingbeat.pitch_hinge.rest_angle, 0.0])
    for _ in range(_SETTLING):
        start = flown(start)[-1]
    for _ in range(_NEWTON):
        states = flown(start)
        miss = (states[-1] - states[0]) / scale
        small = 1e-6 * np.diag(scale)
        slope = np.stack([(flown(start + d)[-1] - flown(start - d)[-1]) / 2e-6 for d in small], axis=1)
        if np.max(np.abs(miss)) < _CLOSURE:
            flap = np.asarray(flap_angle(wingbeat, phase))
            found = np.linalg.eigvals(slope / scale[:, None]).astype(complex)
            return StandBeat(phase, flap, states[:-1, 0], states[:-1, 1], found)
        start = start - scale * np.linalg.solve(slope / scale[:, None] - np.eye(2), miss)
        if not np.all(np.isfinite(start)):
            break
    fix = "give the hinge a damper or a stiffer spring, or fewer flaps a second"
    raise InvalidInputError([Fault("pitch_hinge", wingbeat.pitch_hinge.stiffness, "finds no periodic stroke", fix)])
