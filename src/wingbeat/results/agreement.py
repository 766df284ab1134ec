"""Whether the numbers of a saved orbit agree: record with inputs, record with series, series with Newton's laws.

A digest shows that a file was changed, but everybody can compute it. These checks show that the content of a file
is no orbit, even if its digest fits. They fly nothing again, and take 3 ms.
"""

from __future__ import annotations

import json
import math
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat.aero import BladeElement, SuFan
from wingbeat.datasets import SHAPE, STATE_NAMES
from wingbeat.errors import is_number
from wingbeat.kinematics import Wingbeat, stroke_phase
from wingbeat.orbits.infeasible.relaxation import Relaxation
from wingbeat.orbits.options.solver import DEFAULTS
from wingbeat.orbits.problem.plausible import judged_names
from wingbeat.orbits.status import Status
from wingbeat.results.aero_record import OWN, aero_inputs
from wingbeat.results.forms import from_json
from wingbeat.results.plausibility import judged
from wingbeat.results.provenance import inputs_of, problem_from
from wingbeat.results.record import (
    alpha_range,
    flight_numbers,
    power_summary,
    shape_attribute,
    vehicle_from,
    vehicle_record,
    wingbeat_record,
)
from wingbeat.vehicle import Air

if TYPE_CHECKING:
    import xarray as xr

    from wingbeat.species import Species

# Record and series come of two compiled programs, which may differ in a number's last digits.
_RELATIVE, _ABSOLUTE = 1e-6, 1e-9
# Pointwise identities of the series, relative to the largest value: rounding alone, at most 3e-16 in nine orbits.
_ROUNDING = 1e-9
# The integral of a rate agrees with its series to this share of the series' range. Measured: 1e-5 or better in nine
# orbits. A table of coefficients has kinks, which 256 samples resolve less well.
_INTEGRAL = 2e-3
# A beat of at least so many samples shows its mean and first harmonic to this share of their sum; where the half
# strokes differ, samples are interpolated to equal ones.
_ENOUGH, _OF_LAW = 64, 1e-3
# Series and their rates: each series is the integral of its rate over time.
_RATES = {
    **{"x": "u", "z": "w", "body_pitch": "pitch_rate", "u": "u_rate", "w": "w_rate"},
    **{"pitch_rate": "pitch_acceleration", "flap": "flap_rate", "wing_pitch": "wing_pitch_rate"},
}
# What the attributes of a curve repeat of the inputs; an orbit repeats its speed too.
REPEATED_BY_A_CURVE = ("vehicle", "air", "climb")
_PARTS_OF_HINGE = ("aerodynamic_power", "inertial_power", "body_power")
_PARTS_OF_AIR = ("profile_power", "induced_power", "parasite_power", "unsteady_power")


def check_orbit(record: dict[str, Any], inputs: dict[str, Any], dataset: xr.Dataset) -> None:
    """Check that record, inputs and series are those of one orbit.

    Parameters
    ----------
    record, inputs : of an orbit.
    dataset : its series.

    Raises
    ------
    ValueError : which numbers do not agree.
    LookupError, TypeError, AttributeError : record or inputs lack something, or hold it in another form.
    """
    series = {str(name): variable.values for name, variable in dataset.variables.items()}
    species, converged = species_of(inputs), Status(record["status"]) is Status.CONVERGED
    changes = [Relaxation(**change) for change in record["relaxations"]]
    demand(not (converged and (changes or record["failed_balance"])), "a converged orbit fails no balance")
    _check_inputs(record, inputs, species)
    check_series(series, species.vehicle.mass * species.air.gravity)
    _check_beat(record, series)
    flown = all(np.isfinite(series[name]).all() for name in (*STATE_NAMES, "hinge_power", "actuator_power"))
    if flown:
        _check_numbers(record, species, series)
    if converged:
        demand(flown, "a converged orbit flies the whole beat")
        _check_certificate(record, inputs)
        _check_newton(series, species)
    demand(record["stable"] is _stable(record["floquet_multipliers"], converged), "stable is not what follows")
    own = shape_attribute(species).get(SHAPE)
    demand(own == dataset.attrs.get(SHAPE, own), "shape is not that of the species")
    _check_plausibility(record, inputs, species)


def check_flight(dataset: xr.Dataset) -> None:
    """Check that vehicle, wingbeat and series of a flight can be those of one flight.

    Parameters
    ----------
    dataset : of a flight, in the form of one.

    Raises
    ------
    ValueError : which numbers do not agree.
    LookupError, TypeError, AttributeError : an attribute lacks something, or holds it in another form.
    """
    about = {name: from_json(dataset.attrs[name]) for name in ("vehicle", "air", "wingbeat")}
    vehicle, air, wingbeat = vehicle_from(about["vehicle"]), Air(**about["air"]), Wingbeat(**about["wingbeat"])
    again = (vehicle_record(vehicle), dict(vars(air)), wingbeat_record(wingbeat))
    for (name, own), found in zip(about.items(), again, strict=True):
        demand(own == json.loads(json.dumps(found)), f"{name} is of another form")
    series = {str(name): variable.values for name, variable in dataset.variables.items()}
    check_series(series, vehicle.mass * air.gravity)
    first = series["phase"] <= 1.0
    check_laws(wingbeat, *(series[name][first] for name in ("phase", "flap", "wing_pitch")))


def check_series(series: dict[str, np.ndarray], weight: float) -> None:
    """Check the identities that hold at every sample of a flight.

    Parameters
    ----------
    series : all series of a flight, by name.
    weight : of the vehicle [N].

    Raises
    ------
    ValueError : which series do not agree.
    """
    phase, time = series["phase"], series["time"]
    demand(phase.ndim == 1 and phase.size > 0 and phase[0] == 0, "phase does not begin at 0")
    demand(bool((np.diff(phase) > 0).all() and (np.diff(time) > 0).all()), "phase or time does not increase")
    torque = series["flap_torque"] * series["flap_rate"] + series["pitch_torque"] * series["wing_pitch_rate"]
    sums = {
        "hinge_power": (torque, sum(series[name] for name in _PARTS_OF_HINGE)),
        "air_power": (-sum(series[name] for name in _PARTS_OF_AIR),),
        "potential_energy": (weight * series["centre_of_mass_z"],),
    }
    for name, others in sums.items():
        for other in others:
            parts = np.abs(other) + np.abs(series[name])
            wrong = np.abs(series[name] - other) > _ROUNDING * np.nanmax(parts, initial=0.0)
            demand(not wrong.any(), f"{name} is not the sum of its parts")


def check_laws(wingbeat: Wingbeat, phase: np.ndarray, flap: np.ndarray, pitch: np.ndarray) -> None:
    """Check mean and first harmonic of flap and wing pitch, which no other harmonic of the wingbeat changes.

    Parameters
    ----------
    wingbeat : of the flight.
    phase, flap, pitch : samples of its first beat, shape (K,) [1, rad, rad].

    Raises
    ------
    ValueError : which angle is not that of the wingbeat.
    """
    if phase.size < _ENOUGH or phase[-1] != 1.0:
        return
    even = np.asarray(stroke_phase(wingbeat, phase))
    samples = np.arange(phase.size - 1) / (phase.size - 1)
    for name, values in (("flap", flap), ("pitch", pitch)):
        waves = np.fft.rfft(np.interp(samples, even, values)) / samples.size
        mean, amplitude = getattr(wingbeat, f"{name}_mean"), getattr(wingbeat, f"{name}_amplitude")
        away = max(abs(waves[0].real - mean), abs(2.0 * abs(waves[1]) - amplitude))
        demand(away <= _OF_LAW * (abs(mean) + amplitude) + _ABSOLUTE, f"{name} is not that of the wingbeat")


def _check_inputs(record: dict[str, Any], inputs: dict[str, Any], species: Species) -> None:
    for name in (*REPEATED_BY_A_CURVE, "speed"):
        demand(record[name] == inputs[name], f"{name} is not that of the inputs")
    demand(record["species"] == species.name, "species is not that of the inputs")
    demand(record.get("model") == inputs.get("model"), "model is not that of the inputs")
    demand(inputs["objective"] in (record["objective"], f"{OWN} {record['objective']}"), "objective is another")
    loads = {name: value for name, value in record["aero"].items() if name != "hand"}
    demand(loads.items() <= {**inputs["aero"], "hand": 0}.items(), "aero is not that of the inputs")
    demand({*species.warnings} <= {*record["warnings"]}, "a warning of the species is missing")
    stock, flown = inputs["stock_wingbeat"], record["wingbeat"]
    for name, value in stock.items():
        if isinstance(value, float) and name not in inputs["free"]:
            demand(flown.get(name) == value, f"wingbeat.{name} is not free, but differs from the species' own")


def _check_beat(record: dict[str, Any], series: dict[str, np.ndarray]) -> None:
    """Check phases, times, and the states at both ends of the beat."""
    wingbeat, phase = Wingbeat(**record["wingbeat"]), series["phase"]
    even = np.arange(phase.size) / max(phase.size - 1, 1)
    demand(phase.size > 2 and np.allclose(phase, even, 0.0, _ABSOLUTE), "phase is not one beat in equal steps")
    same("time", series["time"], phase / wingbeat.frequency)
    check_laws(wingbeat, phase, series["flap"], series["wing_pitch"])
    travelled = {"x": record["speed"] / wingbeat.frequency, "z": record["climb"] / wingbeat.frequency}
    for name in STATE_NAMES:
        first, last = float(series[name][0]), float(series[name][-1])
        demand(first == record["initial_state"][name], f"initial_state.{name} is not that of the series")
        closure = last - first - travelled.get(name, 0.0)
        same(f"closure.{name}", record["closure"][name], closure if math.isfinite(closure) else None)


def _check_numbers(record: dict[str, Any], species: Species, series: dict[str, np.ndarray]) -> None:
    """Check the record's numbers against the series, with the functions that made the record."""
    wingbeat = record["wingbeat"]
    problem: Any = SimpleNamespace(vehicle=species.vehicle, air=species.air, speed=record["speed"])
    beat: Any = SimpleNamespace(**series)
    solution: Any = SimpleNamespace(problem=problem)
    found = {
        **power_summary(solution, beat),
        **flight_numbers(problem, wingbeat["frequency"], wingbeat["flap_amplitude"]),
        "body_pitch_range": float(np.ptp(series["body_pitch"])),
    }
    for name, value in found.items():
        same(name, record[name], value)
    known = found | wingbeat
    if record["objective"] in known:
        same("objective_value", record["objective_value"], known[record["objective"]])
    for name, station in (("alpha_quarter_span", 0.25), ("alpha_three_quarter_span", 0.75)):
        same(name, record[name], alpha_range(beat, station))


def _check_certificate(record: dict[str, Any], inputs: dict[str, Any]) -> None:
    options = inputs.get("options", {}).get("certificate", {})
    tolerance = options.get("closure_tolerance", DEFAULTS.certificate.closure_tolerance)
    worst = max(map(abs, record["closure"].values()))
    demand(worst <= tolerance, f"a converged orbit does not close to {worst:.2g}")
    for asked, value in zip(inputs["constraints"], record["constraints"].values(), strict=True):
        beyond = (value - asked["limit"]) * (1.0 if asked["at_most"] else -1.0)
        demand(beyond <= 1e-3 * abs(asked["limit"]) + 1e-6, f"{asked['quantity']} is beyond its limit")


def _check_newton(series: dict[str, np.ndarray], species: Species) -> None:
    """Check that each series is the integral of its rate, momentum that of force, and energy that of power."""
    mass, gravity = species.vehicle.mass, species.air.gravity
    pairs = {name: (series[name], series[rate]) for name, rate in _RATES.items()}
    pairs |= {
        "momentum_x": (series["momentum_x"], series["force_x"]),
        "momentum_z": (series["momentum_z"], series["force_z"] - mass * gravity),
        "centre_of_mass_x": (series["centre_of_mass_x"], series["momentum_x"] / mass),
        "centre_of_mass_z": (series["centre_of_mass_z"], series["momentum_z"] / mass),
        "energy": (
            series["kinetic_energy"] + series["potential_energy"],
            series["actuator_power"] + series["air_power"],
        ),
    }
    for name, (values, rate) in pairs.items():
        change = values - values[0]
        away = np.abs(change - _integral(rate, float(series["time"][-1]))).max()
        size = np.ptp(change) + 1e-2 * np.abs(rate).max() * series["time"][-1] + np.finfo(float).tiny
        demand(away <= _INTEGRAL * size, f"{name} is not the integral of its rate")


def _integral(rate: np.ndarray, period: float) -> np.ndarray:
    """Return the integral over time of a periodic series with both ends, exact for its resolved harmonics."""
    count = rate.size - 1
    found = np.fft.rfft(rate[:-1]) / np.maximum(np.arange(count // 2 + 1), 1) / 2j / np.pi
    mean, found[0] = float(rate[:-1].mean()), 0.0
    waves = np.fft.irfft(found, count)
    return period * (np.append(waves, waves[0]) - waves[0] + mean * np.linspace(0.0, 1.0, count + 1))


def _stable(multipliers: list[list[Any]], converged: bool) -> bool | None:
    demand(len(multipliers) == 4, "there are not four Floquet multipliers")
    return max(math.hypot(*pair) for pair in multipliers) < 1.0 if converged else None


def _check_plausibility(record: dict[str, Any], inputs: dict[str, Any], species: Species) -> None:
    """Check that all numbers that can be judged are, and that each judgement follows from value and species."""
    problem: Any = SimpleNamespace(species=species, speed=record["speed"])
    names = judged_names(species, tuple(inputs["free"]))
    demand([one["name"] for one in record["plausibility"]] == list(names), "plausibility lacks a judgement")
    for one in record["plausibility"]:
        name, value = one["name"], one["value"]
        demand(value == record["wingbeat"].get(name, record.get(name, value)), f"the judged {name} is another")
        demand(one == judged(problem, name, value), f"{name} is judged wrongly")


def species_of(inputs: dict[str, Any]) -> Species:
    """Return the species of inputs that set up a problem, and nothing but what a problem has.

    The air loads are left out, for a model of them may take a second; `Orbit.problem` sets them up.

    Parameters
    ----------
    inputs : of an orbit.

    Raises
    ------
    ValueError, LookupError, TypeError, AttributeError : they are not the inputs of a problem.
    """
    known = [one for one in inputs["constraints"] if not one["quantity"].startswith(OWN)]
    least = "frequency" if inputs["objective"].startswith(OWN) else inputs["objective"]
    plain = inputs | {"aero": aero_inputs(BladeElement(SuFan())), "objective": least, "constraints": known}
    problem = problem_from(plain)
    again = inputs_of(problem, inputs["starts"], inputs["seed"])
    wrong = [name for name, value in again.items() if plain[name] != value]
    demand(not wrong, f"the inputs {', '.join(wrong)} are not those of a problem")
    names = (problem.species.common_name, problem.species.scientific_name)
    texts = (*names, *problem.species.free, *problem.species.guessed_bounds, *problem.species.warnings)
    for number in problem.species.numbers.values():
        texts += number.unit, number.source
        ends = number.range or ()
        demand(_is_plain(number.value) and all(map(is_number, ends)), "a number of the species is none")
    ends = (
        end for pair in (*problem.species.bounds.values(), *problem.species.path_bounds.values()) for end in pair
    )
    demand(all(map(is_number, ends)), "a bound of the species is none")
    demand(all(isinstance(text, str) for text in texts), "a text of the species is none")
    return problem.species


def _is_plain(value: Any) -> bool:
    return is_number(value) or (isinstance(value, list | tuple) and all(map(_is_plain, value)))


def same(name: str, own: Any, found: Any) -> None:
    """Demand that a number or a list of numbers is the one found; None stands for a number that is unknown."""
    if own is None or found is None:
        demand(own is found, f"{name} does not agree with the series")
        return
    good = np.shape(own) == np.shape(found) and np.allclose(own, found, _RELATIVE, _ABSOLUTE)
    demand(bool(good), f"{name} does not agree with the series")


def demand(good: bool, otherwise: str) -> None:
    """Raise `ValueError` with the words of the contradiction unless all is good."""
    if not good:
        raise ValueError(otherwise)
