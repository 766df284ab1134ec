"""The gait of an orbit: what one wing does at equal phases of the beat, and what drives it."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat._base import NOMENCLATURE, FaultList, Term
from wingbeat._jax.arrays import jnp
from wingbeat._jax.exported import jit_soon
from wingbeat.animal.kinematics import (
    Wingbeat,
    chord_ratio,
    flap_angle,
    fold_angle,
    pitch_angle,
    span_ratio,
    sweep_angle,
    tip_twist,
)
from wingbeat.mechanics.wing_motion import time_rates
from wingbeat.orbits.status import Status
from wingbeat.results.flight import simulate
from wingbeat.results.orbit import Orbit

if TYPE_CHECKING:
    import xarray as xr

    from wingbeat._jax.arrays import Phases

# The laws of a wing, by their names in data sets.
_LAWS = {
    "flap": flap_angle,
    "wing_pitch": pitch_angle,
    "sweep": sweep_angle,
    "span_ratio": span_ratio,
    "fold": fold_angle,
    "tip_twist": tip_twist,
    "chord_ratio": chord_ratio,
}
LAW_NAMES = tuple(_LAWS)
# Values of a law that is off.
_OFF = {"span_ratio": 1.0, "chord_ratio": 1.0}
# For these quantities the record has the sum of both wings.
_OF_ONE_WING = ("flap_torque", "pitch_torque", "hinge_power", "actuator_power")


@jit_soon
def _laws(wingbeat: Wingbeat, phase: Phases) -> tuple[Phases, Phases, Phases]:
    def values(at: Phases) -> Phases:
        found = {name: law(wingbeat, at) for name, law in _LAWS.items()}
        off = {name: jnp.full_like(at, _OFF.get(name, 0.0)) for name in found}
        return jnp.stack([off[name] if law is None else law for name, law in found.items()], axis=-1)

    return time_rates(values, phase, wingbeat.frequency)


# Three arrays of shape (..., laws): the laws of `LAW_NAMES`, and their first and second time derivatives.
Laws = tuple[np.ndarray, np.ndarray, np.ndarray]


def laws_at(wingbeat: Wingbeat, phase: np.ndarray) -> Laws:
    """Return three arrays of shape (..., laws): the laws of `LAW_NAMES`, their first and second time derivatives.

    Parameters
    ----------
    wingbeat : gives the laws; a law that is off is constant.
    phase : phases, shape (...).
    """
    value, rate, acceleration = _laws(wingbeat, np.asarray(phase, dtype=float))
    return np.asarray(value), np.asarray(rate), np.asarray(acceleration)


class Column(NamedTuple):
    """One series of a gait: its name, unit and meaning, and its values, shape (K,)."""

    term: Term
    values: np.ndarray


@dataclass(frozen=True)
class Gait:
    """One beat of a certified orbit at equal phases, from one top of the stroke to the next.

    Attributes
    ----------
    orbit : the orbit.
    samples : number of equal phases of the beat, K; all series have K + 1 values, the last at the next top.
    dataset : the time series of the beat at these phases, as in `Orbit.dataset`.
    """

    orbit: Orbit
    samples: int
    dataset: xr.Dataset

    @property
    def phase(self) -> np.ndarray:
        """The phases, shape (K + 1,)."""
        return self.dataset["phase"].values

    @property
    def states(self) -> np.ndarray:
        """The body's states (x, z, body_pitch, u, w, pitch_rate), shape (K + 1, 6)."""
        return np.stack([self.dataset[name].values for name in self.orbit.initial_state._fields], axis=-1)

    @functools.cached_property
    def columns(self) -> list[Column]:
        """Time, each law that moves with its rate and acceleration, and torques and powers of one wing."""
        found = [Column(NOMENCLATURE["time"], self.dataset["time"].values)]
        laws = laws_at(self.orbit.wingbeat, self.phase)
        for i, name in enumerate(LAW_NAMES):
            if name in ("flap", "wing_pitch") or np.ptp(laws[0][:, i]) > 0 or self._is_held(name, laws[0][0, i]):
                found += [Column(term, of[:, i]) for term, of in zip(_derivatives(name), laws, strict=True)]
        for name in _OF_ONE_WING:
            term = NOMENCLATURE[name]
            label = term.label.replace("both wings", "one wing").replace("hinges, one wing", "hinge of one wing")
            found.append(Column(Term(f"{name}_per_wing", term.unit, label), 0.5 * self.dataset[name].values))
        return found

    @staticmethod
    def _is_held(name: str, value: float) -> bool:
        """Return whether a law that does not move is held away from where it is if it is off."""
        return bool(abs(value - _OFF.get(name, 0.0)) > 0)

    @functools.cached_property
    def constants(self) -> dict[str, tuple[float, str]]:
        """Numbers that a reader of the table needs beside it, with their units, by the names of the record."""
        wing, beat = self.orbit.problem.vehicle.wing, self.orbit.wingbeat
        values = {
            "frequency": beat.frequency,
            "stroke_plane_angle": wing.stroke_plane_angle + beat.stroke_plane_tilt,
            "twist_ratio": beat.twist_ratio,
            "wrist": beat.wrist,
        }
        if self.orbit.problem.vehicle.tail is not None:
            values["tail_tilt"] = beat.tail_tilt
        return {name: (float(value), NOMENCLATURE[name].unit) for name, value in values.items()}


def _derivatives(name: str) -> tuple[Term, Term, Term]:
    """Return the entries of a law, of its rate and of its acceleration."""
    term = NOMENCLATURE[name]
    base = "" if term.unit == "1" else f"{term.unit} "
    rate = NOMENCLATURE.get(f"{name}_rate") or Term(f"{name}_rate", f"{base}s-1", f"rate of the {term.label}")
    return term, rate, Term(f"{name}_acceleration", f"{base}s-2", f"second time derivative of the {term.label}")


def check_certified(faults: FaultList, orbit: Orbit) -> None:
    """Note a fault unless an orbit is certified."""
    if orbit.status is not Status.CONVERGED:
        faults.add("orbit", orbit.status.value, "is not certified", "export a certified orbit")


def gait_of(orbit: Orbit, samples: int) -> Gait:
    """Return the gait of a certified orbit, flown from its initial state.

    Parameters
    ----------
    orbit : a certified orbit.
    samples : number of equal phases of the beat.
    """
    flight = simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, beats=1, samples=samples)
    return Gait(orbit, samples, flight.dataset)
