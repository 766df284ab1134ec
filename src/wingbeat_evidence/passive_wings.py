"""Published wings whose pitch is passive, flown on a stand from their own numbers, and their measured pitch."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, replace
from functools import cache
from importlib import resources
from typing import Any, NamedTuple

import numpy as np

from wingbeat.aero import BladeElement, Dickinson, TableCoefficients
from wingbeat.animal.kinematics import PitchHinge, Wingbeat
from wingbeat.animal.vehicle import Air, Body, Vehicle, Wing
from wingbeat.results.wing_on_stand import StandBeat, wing_on_stand

AMPLITUDE_LIMIT, PHASE_LIMIT = 0.25, 20.0  # a ratio, and degrees: the agreement that was asked for
MODELS = ("su-fan", "dickinson")


class Measured(NamedTuple):
    """What was measured of a wing's pitch [deg]; None where it was not."""

    harmonic: float | None
    peak: float | None
    lead: float | None


@dataclass(frozen=True)
class Flown:
    """A stroke on the stand, and how it compares."""

    stroke: StandBeat
    amplitude: float  # like the measured one: of the first harmonic, or the peak [deg]
    ratio: float  # of amplitudes, flown to measured
    phase_error: float | None  # flown less measured [deg]

    @property
    def within(self) -> bool:
        """Whether amplitude, and phase where it was measured, agree as was asked."""
        near = self.phase_error is None or abs(self.phase_error) <= PHASE_LIMIT
        return abs(self.ratio - 1) <= AMPLITUDE_LIMIT and near


@cache
def passive_wings() -> dict[str, Any]:
    """Return the list of wings, cases and guesses."""
    file = resources.files("wingbeat_evidence").joinpath("data/passive_wings.toml")
    return tomllib.loads(file.read_text("utf-8"))


def coefficients(model: str) -> Any:
    """Return a coefficient model with a centre of pressure: su-fan, or Dickinson's with the centre of Dickson."""
    if model == "su-fan":
        return model
    return with_centre(0.05, 0.82)


def with_centre(at_zero: float, slope: float) -> TableCoefficients:
    """Return Dickinson's coefficients with ``x_cp = at_zero + slope alpha/pi``."""
    degrees = np.arange(0.0, 91.0)
    plate, alpha = Dickinson(), np.radians(degrees)
    lift, drag, centre = plate.lift(alpha), plate.drag(alpha), at_zero + slope * alpha / np.pi
    return TableCoefficients("dickinson", degrees, lift, drag, centre)  # type: ignore[arg-type]


def harmonics(angles: Any, phase: Any, count: int = 3) -> Any:
    """Return the mean and the complex harmonics of angles, by least squares: Re sum h_k exp(2 pi i k phase)."""
    turns = 2 * np.pi * np.outer(phase, np.arange(1, count + 1))
    columns = np.concatenate([np.ones((len(phase), 1)), np.cos(turns), -np.sin(turns)], axis=1)
    found = np.linalg.lstsq(columns, np.asarray(angles), rcond=None)[0]
    return found[0], found[1 : count + 1] + 1j * found[count + 1 :]


def film_phase(case: dict[str, Any]) -> Any:
    """Return the phases of a filmed case's frames, 0 where the first harmonic of the flap is at its top."""
    frames = np.arange(len(case["flap_deg"])) * case["frequency"] / case["samples_a_second"]
    return frames + np.angle(harmonics(case["flap_deg"], frames)[1][0]) / (2 * np.pi)


def measured(case: dict[str, Any]) -> Measured:
    """Return amplitude and lead of a case's measured pitch."""
    if "pitch_deg" not in case:
        return Measured(case.get("harmonic_deg"), case.get("peak_deg"), case.get("lead_deg"))
    first = harmonics(case["pitch_deg"], film_phase(case))[1][0]
    return Measured(float(abs(first)), None, float(np.degrees(np.angle(first))))


def projected_peak(case: dict[str, Any]) -> float | None:
    """Return the peak pitch of photographed spars [deg] by the projection that reads the films.

    A point at x behind the axis is seen at x sin(pitch), so tan(seen) = tan(spar) sin(pitch). The authors' formula
    for the photographs, cos(pitch) = 1 - tan(seen)/tan(spar), is another.
    """
    if "spars_deg" not in case:
        return None
    seen, spar = np.radians(case["spars_deg"]).T
    return float(np.mean(np.degrees(np.arcsin(np.tan(seen) / np.tan(spar)))))


def flap_law(case: dict[str, Any]) -> dict[str, Any]:
    """Return the measured flap as the numbers of a wingbeat, with three harmonics where it was filmed."""
    if "flap_deg" not in case:
        return {"flap_amplitude": np.radians(case["flap_amplitude_deg"]).item()}
    found = np.pi / 180 * harmonics(case["flap_deg"], film_phase(case))[1]
    rest = tuple(float(part) for one in found[1:] for part in (one.real, -one.imag))
    return {"flap_amplitude": float(abs(found[0])), "flap_harmonics": rest}


def fly(case: dict[str, Any], model: str, *, aero: Any = None, unsteady: bool = True, **changes: float) -> Flown:
    """Return a case flown with a model; `changes` replace numbers of the wing or of its hinge (one wing)."""
    numbers = passive_wings()[case["wing"]] | changes
    names = ("semi_span", "chord", "mass", "pitch_axis", "mass_axis", "mass_gyration")
    wing = Wing(**{name: numbers[name] for name in names})
    hinge = PitchHinge(2 * numbers["stiffness"], 2 * numbers["damping"])
    law = {"flap_mean": 0.0, "pitch_mean": 0.0, "pitch_amplitude": 0.0} | flap_law(case)
    terms = "thin-aerofoil" if unsteady else "none"
    element = BladeElement(
        coefficients(model) if aero is None else aero, force_point="centre-of-pressure", strips=20
    )
    vehicle = Vehicle(Body(1.0, 1.0), wing)
    wingbeat = Wingbeat(case["frequency"], pitch_hinge=hinge, **law)
    stroke = wing_on_stand(vehicle, wingbeat, replace(element, unsteady=terms), Air())
    truth = measured(case)
    peak = float(np.degrees(np.max(np.abs(stroke.hinge_angle))))
    amplitude = np.degrees(stroke.amplitude).item() if truth.peak is None else peak
    aim = truth.harmonic if truth.peak is None else truth.peak
    assert aim is not None
    error = None if truth.lead is None else float((np.degrees(stroke.lead) - truth.lead + 180) % 360 - 180)
    return Flown(stroke, amplitude, amplitude / aim, error)


def reynolds(case: dict[str, Any]) -> float:
    """Return the Reynolds number of a case by chord and mean speed at the radius of gyration of the area."""
    wing = passive_wings()[case["wing"]]
    radius = wing["semi_span"] / np.sqrt(3)
    return float(
        4 * flap_law(case)["flap_amplitude"] * case["frequency"] * radius * wing["chord"] / Air().viscosity
    )
