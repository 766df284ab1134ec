"""An orbit's own loads compared with those of a vortex lattice on the same motion, as numbers."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, InvalidInputError
from wingbeat._base.datasets import downstrokes
from wingbeat.aero.blade_element import BladeElement
from wingbeat.records.inputs import aero_from
from wingbeat_evidence.second_opinion.lattice import LatticeOptions, lattice_of, sum_of_panels
from wingbeat_evidence.second_opinion.left_out import left_out
from wingbeat_evidence.second_opinion.motion import Motion
from wingbeat_evidence.second_opinion.own_loads import WingLoads, own_loads
from wingbeat_evidence.second_opinion.vortex_lattice import code_version, fly_lattice

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit

ATTACHED = math.radians(15.0)  # flow beyond it is probably not attached, but a lattice has only attached flow
# Each term of our loads alone, and both together: (unsteady, inflow).
TERMS = (("none", "none"), ("thin-aerofoil", "none"), ("none", "momentum"), ("thin-aerofoil", "momentum"))
_FINE = 3600  # steps of a beat, to which a lag is resolved
_SMALL = 1e-3  # of the weight: a smaller mean force gets no ratio


@dataclass(frozen=True)
class SecondOpinion:
    """One motion, and the air loads that two codes compute for it.

    Attributes
    ----------
    code : name and version of the other code.
    species, speed : name of the species, and its mean forward speed [m/s].
    weight : [N].
    options : of the lattice.
    phase : phases of the samples, shape (K,).
    strokes : phases at the start and end of each downstroke.
    terms : (unsteady, inflow), the terms with which the orbit was computed.
    wake : lag of the wake with which the orbit was computed; all our loads have it.
    ours : our loads for each pair of terms; None if the coefficients do not allow these terms.
    refused : for each pair of terms without loads, the reason.
    theirs : loads of the lattice.
    """

    code: str
    species: str
    speed: float
    weight: float
    options: LatticeOptions
    phase: np.ndarray
    strokes: list[tuple[float, float]]
    terms: tuple[str, str]
    wake: str
    ours: dict[tuple[str, str], WingLoads | None]
    refused: dict[tuple[str, str], str]
    theirs: WingLoads

    @property
    def own(self) -> WingLoads:
        """Our loads with the terms with which the orbit was computed."""
        found = self.ours[self.terms]
        assert found is not None  # the orbit was solved with them
        return found

    @property
    def beyond(self) -> np.ndarray:
        """Whether the angle of attack of each of our strips exceeds 15 degrees, shape (K, N)."""
        alpha = self.own.alpha
        assert alpha is not None  # our loads have strips
        return np.abs(alpha) > ATTACHED

    def record(self) -> dict[str, Any]:
        """Return all numbers as a JSON-able dictionary in SI units; lags are shares of a beat."""
        return {
            "with": "uvlm",
            "code": self.code,
            "species": self.species,
            "speed": self.speed,
            "weight": self.weight,
            "lattice": dataclasses.asdict(self.options),
            "unsteady": self.terms[0],
            "inflow": self.terms[1],
            "wake": self.wake,
            **differences(self.own, self.theirs, self.weight),
            "beyond_15_deg": float(np.mean(self.beyond)),
            "terms": [
                {"unsteady": terms[0], "inflow": terms[1], "wake": self.wake}
                | (
                    {"refused": self.refused[terms]}
                    if found is None
                    else differences(found, self.theirs, self.weight)
                )
                for terms, found in self.ours.items()
            ],
            "left_out": left_out(*self.terms, self.wake),
        }


def compare_with_lattice(
    orbit: Orbit, options: LatticeOptions | None = None, progress: Callable[[int, int], None] | None = None
) -> SecondOpinion:
    """Compute the loads of a vortex lattice on an orbit's motion, and our own loads with and without each term.

    Flat panels stand in for cambered wings, turned up by the polar's angle without lift. Needs the extra ``uvlm``.

    Parameters
    ----------
    orbit : a certified orbit.
    options : of the lattice.
    progress : called with (steps done, steps in all).

    Raises
    ------
    InvalidInputError : an orbit that does not close, or that flies more slowly than the wake sinks in hover.
    FileError : PteraSoftware is not installed.
    """
    options = options or LatticeOptions()
    code = code_version()
    model, inputs = orbit.problem.model, orbit.inputs
    _check(orbit.status.value, model.vehicle, model.air, inputs["speed"], inputs["climb"])
    motion = Motion.of(orbit.dataset, model.vehicle, orbit.wingbeat, model.air)
    aero = aero_from(inputs["aero"])
    phase = np.arange(0, options.steps, 2) / options.steps
    ours, refused = _with_each_term(motion, aero, phase)
    theirs = lattice_loads(motion, options, progress, aero)
    weight = motion.vehicle.mass * motion.air.gravity
    name, speed = inputs["species"]["name"], float(inputs["speed"])
    strokes = downstrokes(orbit.dataset["phase"].values, orbit.dataset["flap_rate"].values)
    terms = (aero.unsteady, aero.inflow)
    return SecondOpinion(
        code, name, speed, weight, options, phase, strokes, terms, aero.wake, ours, refused, theirs
    )


def lattice_loads(
    motion: Motion,
    options: LatticeOptions,
    progress: Callable[[int, int], None] | None = None,
    aero: BladeElement | None = None,
) -> WingLoads:
    """Return the loads of the lattice on a motion, at every second step of a beat.

    The lattice uses backward differences of position and circulation, so its loads are late by up to a step. This
    error, and that of the panels, is proportional to the size of steps and panels. We remove both by extrapolation
    from two lattices: the given one, and one with half as many steps and panels in each direction.

    Parameters
    ----------
    motion, options, progress : as in `compare_with_lattice`.
    aero : our loads, for whose camber the panels are turned; not turned if not given.

    Raises
    ------
    FileError : PteraSoftware is not installed.
    """
    both, found, done = (options, options.halved), [], 0
    whole = sum(one.steps * one.beats for one in both)
    for one in both:
        phases = np.arange(one.steps * one.beats) / one.steps
        corners, step = lattice_of(motion, one, phases, aero), motion.period / one.steps
        told = None if progress is None else functools.partial(_told, progress, done, whole)
        loads = fly_lattice(corners, step, motion.velocity, motion.air.density, one.steps, told)
        found.append(sum_of_panels(one.spanwise, corners[-one.steps :], step, motion.velocity, *loads))
        done += len(phases)
    fine, coarse = found
    return WingLoads(
        *(2.0 * getattr(fine, name)[::2] - getattr(coarse, name) for name in ("thrust", "lift", "power"))
    )


def _told(progress: Callable[[int, int], None], before: int, whole: int, done: int, _: int) -> None:
    progress(before + done, whole)


def _check(status: str, vehicle: Any, air: Any, speed: float, climb: float) -> None:
    faults = FaultList()
    if status != "converged":
        faults.add("FILE", status, "is not a certified orbit, so its motion does not repeat", "solve it first")
    hover = math.sqrt(vehicle.mass * air.gravity / (2.0 * air.density * math.pi * vehicle.wing.semi_span**2))
    if math.hypot(speed, climb) < hover:
        rule = (
            f"is slower than {hover:.2g} m/s, the speed at which the wake sinks in hover. The lattice's wake does "
            "not move after it is shed and would stay between the wings"
        )
        faults.add("speed", speed, rule, "compare an orbit at a higher speed")
    faults.raise_if_any()


def _with_each_term(
    motion: Motion, aero: BladeElement, phase: np.ndarray
) -> tuple[dict[tuple[str, str], WingLoads | None], dict[tuple[str, str], str]]:
    ours: dict[tuple[str, str], WingLoads | None] = {}
    refused = {}
    for terms in TERMS:
        try:
            loads = dataclasses.replace(aero, unsteady=terms[0], inflow=terms[1])
            ours[terms] = own_loads(motion, loads, phase)
        except InvalidInputError as error:  # coefficients without an aspect ratio, a descent into the own wake
            ours[terms], refused[terms] = None, str(error)
    return ours, refused


def differences(ours: WingLoads, theirs: WingLoads, weight: float) -> dict[str, Any]:
    """Return the mean loads, their ratios, and the differences between the two lifts over the beat.

    Parameters
    ----------
    ours, theirs : loads at the same phases of one beat.
    weight : [N].
    """
    return {
        "mean_lift": _means(ours.lift, theirs.lift, _SMALL * weight),
        "mean_thrust": _means(ours.thrust, theirs.thrust, _SMALL * weight),
        "aerodynamic_power": _means(ours.power, theirs.power, 0.0),
        "lift_lag": lag(ours.lift, theirs.lift),
        "thrust_lag": lag(ours.thrust, theirs.thrust),
        "lift_rms_difference": _rms(ours.lift - theirs.lift) / weight,
        "thrust_rms_difference": _rms(ours.thrust - theirs.thrust) / weight,
        "lift_rms_of_theirs": _rms(theirs.lift) / weight,
    }


def _means(ours: np.ndarray, theirs: np.ndarray, small: float) -> dict[str, float | None]:
    mine, other = float(np.mean(ours)), float(np.mean(theirs))
    return {"ours": mine, "theirs": other, "ratio": other / mine if abs(mine) > small else None}


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values * values)))


def lag(first: np.ndarray, second: np.ndarray) -> float:
    """Return the delay of the second of two periodic series, as a share of a beat between -0.5 and 0.5.

    The delay is the shift at which the correlation of the two series is largest.

    >>> beat = np.arange(40) / 40
    >>> round(lag(np.cos(2 * np.pi * beat), np.cos(2 * np.pi * (beat - 0.1))), 3)
    0.1
    """
    spectrum = np.fft.rfft(second - np.mean(second)) * np.conj(np.fft.rfft(first - np.mean(first)))
    shift = int(np.argmax(np.fft.irfft(spectrum, _FINE))) / _FINE
    return shift - 1.0 if shift > 0.5 else shift
