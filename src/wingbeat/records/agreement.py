"""Whether the numbers of a saved result agree: record with inputs, record with series, series with Newton's laws.

A digest shows that a file was changed, but everybody can compute it. These checks show that the content of a file
is no orbit, flight or curve, even if its digest fits. They fly nothing again, and take some milliseconds.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import SHAPE, STATE_NAMES, harmonic_place, is_number, over_of
from wingbeat._jax.arrays import own_settings
from wingbeat.aero import BladeElement, SuFan
from wingbeat.animal.kinematics import LAWS, PARAMETER_NAMES, Wingbeat, held_at, parameter
from wingbeat.animal.vehicle import Air
from wingbeat.mechanics.state_rates import HINGE_STATE
from wingbeat.orbits.changes import Relaxation
from wingbeat.orbits.flight.beat import Beat
from wingbeat.orbits.flight.period import PATH_NAMES, SYMMETRY
from wingbeat.orbits.options import DEFAULTS, Status
from wingbeat.orbits.problem.origin import frequency_basis
from wingbeat.orbits.problem.quantities import judged_names
from wingbeat.records.forms import from_json
from wingbeat.records.hinges import hinge_numbers
from wingbeat.records.inputs import (
    OWN,
    aero_inputs,
    inputs_of,
    problem_from,
    shape_attribute,
    vehicle_from,
    vehicle_record,
    wingbeat_from,
    wingbeat_record,
)
from wingbeat.records.judgements import judged
from wingbeat.records.numbers import beat_numbers, flight_numbers, judged_values

if TYPE_CHECKING:
    import xarray as xr

    from wingbeat.animal.species.species import Species

# Record and series come of two compiled programs, which may differ in a number's last digits.
_RELATIVE, _ABSOLUTE = 1e-6, 1e-9
# Pointwise identities of the series, relative to the largest value: rounding alone, at most 3e-16 in nine orbits.
_ROUNDING = 1e-9
# The integral of a rate agrees with its series to this share of the series' range. Measured: 1e-5 or better in nine
# orbits. A table of coefficients has kinks, which 256 samples resolve less well.
_INTEGRAL = 2e-3
# Series that a law of the wing gives at every phase. Measured: to 1e-15 in 22 files.
_OF_LAWS = ("flap", "wing_pitch", "span_ratio", "fold", "sweep")
# Faster flights (SI) are running off, and their powers may overflow.
_RUNS_OFF = 1e6
# Series and their rates: each series is the integral of its rate over time.
_RATES = {
    **{"x": "u", "z": "w", "body_pitch": "pitch_rate", "u": "u_rate", "w": "w_rate"},
    **{"pitch_rate": "pitch_acceleration", "flap": "flap_rate", "wing_pitch": "wing_pitch_rate"},
}
_PARTS_OF_HINGE = ("aerodynamic_power", "inertial_power", "body_power")
_PARTS_OF_AIR = ("profile_power", "induced_power", "parasite_power", "unsteady_power")

# Quantities of an orbit keep to their limits to this share.
_OF_LIMIT = 1e-3
# The extremes of samples, and those between samples, which limits apply to. Measured: 6e-5.
_OF_RANGE = 2e-2
# An unknown is at its bound if it is closer than a tolerance; these multiples of it leave room for rounding.
_SURELY_AT, _SURELY_NOT = 0.5, 100.0
# What the attributes of a curve repeat of the inputs; an orbit repeats its speed too.
REPEATED_BY_A_CURVE = ("vehicle", "air", "climb")


def check_orbit(record: dict[str, Any], inputs: dict[str, Any], dataset: xr.Dataset) -> None:
    """Check that record, inputs and series are those of one orbit."""
    series = {str(name): variable.values for name, variable in dataset.variables.items()}
    species, converged = species_of(inputs), Status(record["status"]) is Status.CONVERGED
    changes = [Relaxation(**change) for change in record["relaxations"]]
    demand(not (converged and (changes or record["failed_balance"])), "a converged orbit fails no balance")
    _check_inputs(record, inputs, species)
    check_series(series, species.vehicle.mass * species.air.gravity)
    _check_beat(record, series)
    whole = {name for name, values in series.items() if values.dtype.kind != "f" or np.isfinite(values).all()}
    flown = {*STATE_NAMES, "hinge_power", "actuator_power"} <= whole
    if flown:
        _check_numbers(record, species, series)
    if converged:
        demand(whole == {*series}, "a converged orbit flies the whole beat")
        _check_certificate(record, inputs)
        check_newton(series, species)
    demand(len(record["floquet_multipliers"]) == 4, "there are not four Floquet multipliers")
    stable = max(math.hypot(*pair) for pair in record["floquet_multipliers"]) < 1.0 if converged else None
    demand(record["stable"] is stable, "stable is not what follows")
    own = shape_attribute(species).get(SHAPE)
    demand(own == dataset.attrs.get(SHAPE, own), "shape is not that of the species")
    # All numbers that can be judged are, and each judgement follows from value and species.
    names = judged_names(species, tuple(inputs["free"]))
    demand([one["name"] for one in record["plausibility"]] == list(names), "plausibility lacks a judgement")
    for one in record["plausibility"]:
        found = judged(species, record["speed"], one["name"], one["value"])
        demand(one == found, f"{one['name']} is judged wrongly")


def check_limits(
    numbers: Mapping[str, Any], active: Iterable[str], inputs: dict[str, Any], unknown: Iterable[str]
) -> None:
    """Check that free parameters are within their bounds, and that all bounds that they reach are listed."""
    active = set(active)
    tolerance = inputs.get("options", {}).get("search", {}).get("bound_tolerance", DEFAULTS.search.bound_tolerance)
    for name in {*inputs["free"]} & {*numbers}:
        low, high = inputs["bounds"][name]
        inside = min(numbers[name] - low, high - numbers[name]) / max(high - low, np.finfo(float).tiny)
        demand(inside >= -tolerance, f"{name} is beyond its bounds")
        demand(inside > _SURELY_AT * tolerance or name in active, f"{name} is at a bound that is not listed")
        demand(inside < _SURELY_NOT * tolerance or name not in active, f"{name} is at no bound, but one is listed")
    texts = limit_texts(inputs)
    known = {*inputs["free"], *unknown, *PATH_NAMES, SYMMETRY, *texts}
    demand(active <= known, "a bound is listed that the problem has not")
    for text, asked in zip(texts, inputs["constraints"], strict=True):
        if (value := numbers.get(text)) is not None:
            beyond = (value - asked["limit"]) * (1.0 if asked["at_most"] else -1.0)
            near = _OF_LIMIT * abs(asked["limit"]) + 1e-6
            demand(beyond <= near, f"{asked['quantity']} is beyond its limit")
            demand(beyond >= -near or text not in active, f"{text} is listed, but not reached")
            reached = beyond >= -_ABSOLUTE * abs(asked["limit"])
            demand(not reached or text in active, f"{text} is reached, but not listed")


def limit_texts(inputs: dict[str, Any]) -> list[str]:
    """Return the constraints of inputs as texts, as in records."""
    asked = inputs["constraints"]
    names = [one["quantity"].removeprefix(f"{OWN} ") for one in asked]
    return [f"{n}{'<=' if c['at_most'] else '>='}{c['limit']:g}" for n, c in zip(names, asked, strict=True)]


def _check_inputs(record: dict[str, Any], inputs: dict[str, Any], species: Species) -> None:
    for name in (*REPEATED_BY_A_CURVE, "speed"):
        demand(record[name] == inputs[name], f"{name} is not that of the inputs")
    demand(record["species"] == species.name, "species is not that of the inputs")
    demand(record.get("model") == inputs.get("model"), "model is not that of the inputs")
    demand(inputs["objective"] in (record["objective"], f"{OWN} {record['objective']}"), "objective is another")
    basis = frequency_basis(inputs["free"], inputs.get("own_frequency", False), species, inputs["speed"])
    demand(record.get("frequency_basis", basis) == basis, f"frequency_basis is not {basis}")
    loads = {name: value for name, value in record["aero"].items() if name != "hand"}
    demand(loads.items() <= {**inputs["aero"], "hand": 0}.items(), "aero is not that of the inputs")
    demand({*species.warnings} <= {*record["warnings"]}, "a warning of the species is missing")
    own = inputs.get("start")
    demand((record.get("start") or {"values": None})["values"] == own, "start is not that of the inputs")
    names = {*STATE_NAMES[2:], *inputs["free"]}
    demand(own is None or {*own} == names, "start has other unknowns than the problem")
    stock, flown = inputs["stock_wingbeat"], record["wingbeat"]
    for name, value in stock.items():
        if isinstance(value, float) and name not in inputs["free"]:
            demand(flown.get(name) == value, f"wingbeat.{name} is not free, but differs from the species' own")


def _check_beat(record: dict[str, Any], series: dict[str, np.ndarray]) -> None:
    """Check phases, times, and the states at both ends of the beat."""
    wingbeat, phase = wingbeat_from(record["wingbeat"]), series["phase"]
    own = {name: float(series[name][0]) for name in HINGE_STATE if name in series}
    demand(own == record.get("hinge_start", {}), "hinge_start is not that of the series")
    even = np.arange(phase.size) / max(phase.size - 1, 1)
    demand(phase.size > 2 and np.allclose(phase, even, 0.0, _ABSOLUTE), "phase is not one beat in equal steps")
    check_wings(wingbeat, series)
    travelled = {"x": record["speed"] / wingbeat.frequency, "z": record["climb"] / wingbeat.frequency}
    for name in STATE_NAMES:
        first, last = float(series[name][0]), float(series[name][-1])
        demand(first == record["initial_state"][name], f"initial_state.{name} is not that of the series")
        closure = last - first - travelled.get(name, 0.0)
        same(f"closure.{name}", record["closure"][name], closure if math.isfinite(closure) else None)


def _check_numbers(record: dict[str, Any], species: Species, series: dict[str, np.ndarray]) -> None:
    """Check the record's numbers against the series, with the functions that made the record."""
    wingbeat, vehicle = record["wingbeat"], species.vehicle
    weight = vehicle.mass * species.air.gravity
    of_vehicle = {"mass": vehicle.mass, "weight": weight, "semi_span": vehicle.wing.semi_span}
    known = {**series, **wingbeat, **record, **of_vehicle, "drive": vehicle.drive}
    beat = Beat(**{name: known[name] for name in Beat._fields})
    with own_settings():
        of_wingbeat = wingbeat["frequency"], wingbeat["flap_amplitude"]
        found = beat_numbers(vehicle, species.air, record["speed"], beat, *of_wingbeat)
        values = judged_values(record, beat, vehicle.mass)
        motion = np.stack([series[name] for name in HINGE_STATE], axis=1) if "hinge_angle" in series else None
        flown, strips = wingbeat_from(wingbeat), record["aero"]["strips"]
        of_hinge = hinge_numbers(species.kind, vehicle, flown, strips, beat, motion)
    for name, value in found.items():
        same(name, record[name], value)
    for name in {*of_hinge} & {*record}:  # earlier versions wrote none
        same(name, record[name], of_hinge[name])
    for one in record["plausibility"]:
        same(one["name"], one["value"], values[one["name"]])
    if (least := record["objective"]) in {*found, *wingbeat}:
        same("objective_value", record["objective_value"], {**found, **wingbeat}[least])


def _check_certificate(record: dict[str, Any], inputs: dict[str, Any]) -> None:
    options = inputs.get("options", {}).get("certificate", {})
    tolerance = options.get("closure_tolerance", DEFAULTS.certificate.closure_tolerance)
    worst = max(map(abs, record["closure"].values()))
    demand(worst <= tolerance, f"a converged orbit does not close to {worst:.2g}")
    demand([*record["constraints"]] == limit_texts(inputs), "constraints are not those of the inputs")
    known = {one["name"]: one["value"] for one in record["plausibility"]} | record
    for text, asked in zip(record["constraints"], inputs["constraints"], strict=True):
        if asked["quantity"] in known:
            own, found = record["constraints"][text], known[asked["quantity"]]
            near = own == found or (None not in (own, found) and math.isclose(own, found, rel_tol=_OF_RANGE))
            demand(near, f"{text} does not agree with the series")
    wingbeat = wingbeat_from(record["wingbeat"])
    numbers = {name: float(parameter(wingbeat, name)) for name in inputs["free"]} | record["constraints"]
    check_limits(numbers, record["active_bounds"], inputs, record["initial_state"])


def species_of(inputs: dict[str, Any]) -> Species:
    """Return the species of inputs that set up a problem, and nothing but what a problem has."""
    # The air loads are left out, for a model of them may take a second; `Orbit.problem` sets them up.
    known = [one for one in inputs["constraints"] if not one["quantity"].startswith(OWN)]
    plain_objective = "frequency" if "frequency" in inputs["free"] else "mean_positive_power"
    least = plain_objective if inputs["objective"].startswith(OWN) else inputs["objective"]
    plain = inputs | {"aero": aero_inputs(BladeElement(SuFan())), "objective": least, "constraints": known}
    problem = problem_from(plain)
    again = inputs_of(problem, inputs["starts"], inputs["seed"])
    wrong = [name for name, value in again.items() if plain[name] != value]
    demand(not wrong, f"the inputs {', '.join(wrong)} are not those of a problem")
    own = problem.species
    texts = [own.common_name, own.scientific_name, *own.free, *own.guessed_bounds, *own.warnings]
    for number in own.numbers.values():
        texts += number.unit, number.source
        good = _is_plain(number.value) and all(map(is_number, number.range or ()))
        demand(good, "a number of the species is none")
    pairs = (*own.bounds.values(), *own.path_bounds.values())
    demand(all(is_number(end) for pair in pairs for end in pair), "a bound of the species is none")
    demand(all(isinstance(text, str) for text in texts), "a text of the species is none")
    return own


def _is_plain(value: Any) -> bool:
    return is_number(value) or (isinstance(value, list | tuple) and all(map(_is_plain, value)))


# Numbers that every certified orbit has, moving or not.
_ALWAYS = (
    *(f"{part}_{name}" for part in ("initial", "closure") for name in STATE_NAMES),
    *("mean_power", "peak_power", "mean_positive_power", "mean_actuator_power", "peak_actuator_power"),
    *("body_pitch_range", "largest_multiplier"),
)


def check_curve(dataset: xr.Dataset, inputs: dict[str, Any]) -> None:
    """Check that points, marks and inputs are those of one curve."""
    columns = {str(name): variable.values for name, variable in dataset.variables.items()}
    about = dataset.attrs
    over = over_of(about)
    species = species_of(inputs | ({"speed": inputs["speed"][0]} if over == "speed" else {}))
    demand(over == "speed" or float(about["speed"]) == inputs["speed"], "speed is not that of the inputs")
    demand(over == "speed" or "frequency" not in inputs["free"], "frequency is free over frequency")
    for name in REPEATED_BY_A_CURVE:
        own = from_json(about[name]) if isinstance(about[name], str) else float(about[name])
        demand(own == inputs[name], f"{name} is not that of the inputs")
    demand(about["species"] == species.name, "species is not that of the inputs")
    demand(inputs["objective"] in (about["objective"], f"{OWN} {about['objective']}"), "objective is another")
    demand(inputs["power_limit"] is None or inputs["power_limit"] > 0, "power_limit is not positive")
    values = columns[over]
    demand(values.tolist() == inputs[over], f"{over} is not that of the inputs")
    demand(bool((np.diff(values) > 0).all()), f"{over} does not increase")
    demand(columns["optimum"].tolist() == list(range(columns["optimum"].size)), "optimum does not count from 0")
    demand(columns["continued"].shape[0] == values.size - 1, "continued has not one item for each pair of points")
    for name in ("marks", "constraints"):
        demand(all(isinstance(one, str | dict) for one in json.loads(about[name])), f"{name} is of another form")
    demand(all(isinstance(one, str) for one in json.loads(about["warnings"])), "warnings are of another form")
    for mark in json.loads(about["marks"]):
        ends = [f"{side}_{over}" for side in ("lower", "upper")]
        demand({*mark} == {"kind", *ends, "what"}, "a mark is of another form")
        demand({mark[end] for end in ends} <= {*values.tolist()}, "a mark is at none of the points")
        demand(isinstance(mark["kind"], str) and isinstance(mark["what"], str), "a mark is of another form")
    found = columns["family"] >= 0
    own_frequency = over == "speed" and inputs.get("own_frequency", False)
    for i, status in enumerate(columns["status"].tolist()):
        converged = Status(status) is Status.CONVERGED
        demand(converged == bool(found[i, 0]), "status does not fit the optima")
        demand(not converged or columns["distinct_optima"][i] >= found[i].sum(), "distinct_optima is too small")
        given = {over: float(values[i])} | ({"speed": inputs["speed"]} if over == "frequency" else {})
        flown = species.at_own_frequency(given["speed"]) if own_frequency else species
        _check_point(columns, i, found[i], flown, inputs, str(about["objective"]), given)


def _check_point(
    columns: dict[str, np.ndarray],
    i: int,
    found: np.ndarray,
    species: Species,
    inputs: dict[str, Any],
    least: str,
    given: dict[str, float],
) -> None:
    """Check the optima at one point: the numbers of those that there are, and nothing in place of the others.

    `given` has the speed, and over frequency the frequency.
    """
    numbers = {name: v[i] for name, v in columns.items() if v.ndim == 2 and v.dtype.kind == "f"}
    for name, values in numbers.items():
        demand(not np.isfinite(values[~found]).any(), f"{name} has values where there is no optimum")
    demand(bool((np.diff(numbers["objective_value"][found]) >= 0).all()), "the optima of a point are not in order")
    speed = given["speed"]
    weight = species.vehicle.mass * species.air.gravity
    options = inputs.get("options", {}).get("certificate", {})
    tolerance = options.get("closure_tolerance", DEFAULTS.certificate.closure_tolerance)
    for k in np.flatnonzero(found).tolist():
        own = given | {name: float(v[k]) for name, v in numbers.items()}
        derived = flight_numbers(species.vehicle, species.air, speed, own["frequency"], own["flap_amplitude"])
        derived["cost_of_transport"] = own["mean_positive_power"] / (weight * speed) if weight * speed else None
        for name, value in derived.items():
            same(name, own[name] if math.isfinite(own[name]) else None, value)
        if least in own:
            same("objective_value", own["objective_value"], own[least])
        for name in {*_ALWAYS, *PARAMETER_NAMES} & {*own}:
            demand(math.isfinite(own[name]), f"{name} of an optimum is no number")
        worst = max(abs(own[f"closure_{name}"]) for name in STATE_NAMES)
        demand(worst <= tolerance, f"an optimum does not close to {worst:.2g}")
        listed = filter(None, str(columns["active_bounds"][i, k]).split(", "))
        check_limits({name: own[name] for name in {*PARAMETER_NAMES} & {*own}}, listed, inputs, STATE_NAMES)
        if "muscle_work_per_mass" in own:
            power = own["muscle_work_per_mass"] * own["frequency"]
            same("muscle_power_per_mass", own["muscle_power_per_mass"], power)
        demand(own["mean_power"] <= own["mean_positive_power"] <= max(own["peak_power"], 0.0), "powers contradict")
        for name in PARAMETER_NAMES:
            stock = parameter(species.wingbeat, name) if name in inputs["stock_wingbeat"] else None
            if (
                name in own
                and name not in given
                and harmonic_place(name) is None
                and name not in inputs["free"]
                and stock is not None
            ):
                demand(own[name] == stock, f"{name} is not free, but differs from the species' own")
        outside = {*filter(None, str(columns["outside_ranges"][i, k]).split(", "))}
        values = {**own, "positive_power_per_mass": own["mean_positive_power"] / species.vehicle.mass}
        for name in {*judged_names(species, tuple(inputs["free"]))} & {*values}:
            is_out = judged(species, speed, name, values[name])["within"] is False
            demand(is_out == (name in outside), f"{name} is judged wrongly")


def check_flight(dataset: xr.Dataset) -> None:
    """Check that vehicle, wingbeat and series of a flight can be those of one flight."""
    about = {name: from_json(dataset.attrs[name]) for name in ("vehicle", "air", "wingbeat")}
    vehicle, air, wingbeat = vehicle_from(about["vehicle"]), Air(**about["air"]), wingbeat_from(about["wingbeat"])
    again = (vehicle_record(vehicle), dict(vars(air)), wingbeat_record(wingbeat))
    for (name, own), found in zip(about.items(), again, strict=True):
        demand(own == json.loads(json.dumps(found)), f"{name} is of another form")
    series = {str(name): variable.values for name, variable in dataset.variables.items()}
    check_series(series, vehicle.mass * air.gravity)
    check_finite(series)
    first = series["phase"] < 1.0  # a controller may change the wingbeat of the next beat
    check_wings(wingbeat, {name: values[first] for name, values in series.items() if values.shape == first.shape})


def check_series(series: dict[str, np.ndarray], weight: float) -> None:
    """Check the identities that hold at every sample of a flight."""
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


def check_finite(series: dict[str, np.ndarray]) -> None:
    """Check that all series of a flight are finite at all samples before it runs off."""
    calm = np.logical_and.reduce([np.abs(series[name]) < _RUNS_OFF for name in STATE_NAMES])
    for name, values in series.items():
        own = values[calm] if len(values) == len(calm) else values
        demand(own.dtype.kind != "f" or bool(np.isfinite(own).all()), f"{name} holds what is no number")


def check_wings(wingbeat: Wingbeat, series: dict[str, np.ndarray]) -> None:
    """Check that times and positions of the wings are those of the wingbeat."""
    same("time", series["time"], series["phase"] / wingbeat.frequency)
    phase, beat = series["phase"], wingbeat
    if wingbeat.pitch_hinge is not None:
        demand({*HINGE_STATE, "hinge_torque"} <= {*series}, "the hinge gives way, but its motion is missing")
        torque = wingbeat.pitch_hinge.torque(series["hinge_angle"], series["hinge_rate"])
        same("hinge_torque", series["hinge_torque"], torque)
        beat = held_at(wingbeat, phase, series["hinge_angle"], series["hinge_rate"], np.zeros_like(phase))
    for name in _OF_LAWS:
        with own_settings():
            found = LAWS[name](beat, phase)
        good = np.allclose(series[name], 0.0 if found is None else found, 0.0, _ABSOLUTE)
        demand(good, f"{name} is not that of the wingbeat")


def check_newton(series: dict[str, np.ndarray], species: Species) -> None:
    """Check that each series is the integral of its rate, momentum that of force, and energy that of power."""
    mass, gravity = species.vehicle.mass, species.air.gravity
    springs = series.get("hinge_torque", 0.0) * series.get("hinge_rate", 0.0)  # which take and return energy
    pairs = {name: (series[name], series[rate]) for name, rate in _RATES.items()}
    pairs |= {
        "momentum_x": (series["momentum_x"], series["force_x"]),
        "momentum_z": (series["momentum_z"], series["force_z"] - mass * gravity),
        "centre_of_mass_x": (series["centre_of_mass_x"], series["momentum_x"] / mass),
        "centre_of_mass_z": (series["centre_of_mass_z"], series["momentum_z"] / mass),
        "energy": (
            series["kinetic_energy"] + series["potential_energy"],
            series["actuator_power"] + series["air_power"] + springs,
        ),
    }
    if "hinge_angle" in series:
        pairs["hinge_angle"] = series["hinge_angle"], series["hinge_rate"]
    for name, (values, rate) in pairs.items():
        change = values - values[0]
        away = np.abs(change - _integral(rate, float(series["time"][-1]))).max()
        size = np.ptp(change) + 1e-2 * np.abs(rate).max() * series["time"][-1] + np.finfo(float).tiny
        # A motion whose amplitude is at its bound of 0 has a rate of 1e-17, and nothing but rounding to integrate.
        rounding = np.finfo(float).eps * np.abs(values).max()
        demand(away <= _INTEGRAL * size + rounding, f"{name} is not the integral of its rate")


def _integral(rate: np.ndarray, period: float) -> np.ndarray:
    """Return the integral over time of a periodic series with both ends, exact for its resolved harmonics."""
    count = rate.size - 1
    found = np.fft.rfft(rate[:-1]) / np.maximum(np.arange(count // 2 + 1), 1) / 2j / np.pi
    mean, found[0] = float(rate[:-1].mean()), 0.0
    waves = np.fft.irfft(found, count)
    return period * (np.append(waves, waves[0]) - waves[0] + mean * np.linspace(0.0, 1.0, count + 1))


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
