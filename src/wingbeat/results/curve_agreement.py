"""Whether the numbers of a saved curve agree with one another, as `agreement` checks those of an orbit."""

from __future__ import annotations

import json
import math
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import harmonic_place
from wingbeat._base.datasets import STATE_NAMES
from wingbeat.animal.kinematics import PARAMETER_NAMES
from wingbeat.orbits.options.solver import DEFAULTS
from wingbeat.orbits.problem.plausible import judged_names
from wingbeat.orbits.status import Status
from wingbeat.results.aero_record import OWN
from wingbeat.results.agreement import REPEATED_BY_A_CURVE, check_limits, species_of
from wingbeat.results.forms import from_json
from wingbeat.results.plausibility import judged
from wingbeat.results.record import flight_numbers
from wingbeat.results.series_agreement import demand, same

if TYPE_CHECKING:
    import xarray as xr

    from wingbeat.animal.species.record import Species

_LISTS = ("marks", "constraints")
# Numbers that every certified orbit has, moving or not.
_ALWAYS = (
    *(f"{part}_{name}" for part in ("initial", "closure") for name in STATE_NAMES),
    *("mean_power", "peak_power", "mean_positive_power", "mean_actuator_power", "peak_actuator_power"),
    *("body_pitch_range", "largest_multiplier"),
)


def check_curve(dataset: xr.Dataset, inputs: dict[str, Any]) -> None:
    """Check that points, marks and inputs are those of one curve.

    Parameters
    ----------
    dataset : of a curve, in the form of one.
    inputs : of the curve.

    Raises
    ------
    ValueError : which numbers do not agree.
    LookupError, TypeError, AttributeError : the inputs lack something, or hold it in another form.
    """
    columns = {str(name): variable.values for name, variable in dataset.variables.items()}
    species, about = species_of(inputs | {"speed": inputs["speed"][0]}), dataset.attrs
    for name in REPEATED_BY_A_CURVE:
        own = from_json(about[name]) if isinstance(about[name], str) else float(about[name])
        demand(own == inputs[name], f"{name} is not that of the inputs")
    demand(about["species"] == species.name, "species is not that of the inputs")
    demand(inputs["objective"] in (about["objective"], f"{OWN} {about['objective']}"), "objective is another")
    demand(inputs["power_limit"] is None or inputs["power_limit"] > 0, "power_limit is not positive")
    speeds = columns["speed"]
    demand(speeds.tolist() == inputs["speed"], "speed is not that of the inputs")
    demand(bool((np.diff(speeds) > 0).all()), "speed does not increase")
    demand(columns["optimum"].tolist() == list(range(columns["optimum"].size)), "optimum does not count from 0")
    demand(columns["continued"].shape[0] == speeds.size - 1, "continued has not one item for each pair of speeds")
    for name in _LISTS:
        demand(all(isinstance(one, str | dict) for one in json.loads(about[name])), f"{name} is of another form")
    demand(all(isinstance(one, str) for one in json.loads(about["warnings"])), "warnings are of another form")
    for mark in json.loads(about["marks"]):
        demand({*mark} == {"kind", "lower_speed", "upper_speed", "what"}, "a mark is of another form")
        demand({mark["lower_speed"], mark["upper_speed"]} <= {*speeds.tolist()}, "a mark is at none of the speeds")
        demand(isinstance(mark["kind"], str) and isinstance(mark["what"], str), "a mark is of another form")
    found = columns["family"] >= 0
    for i, status in enumerate(columns["status"].tolist()):
        converged = Status(status) is Status.CONVERGED
        demand(converged == bool(found[i, 0]), "status does not fit the optima")
        enough = not converged or columns["distinct_optima"][i] >= found[i].sum()
        demand(bool(enough), "distinct_optima is too small")
        _check_point(columns, i, found[i], species, inputs, str(about["objective"]))


def _check_point(
    columns: dict[str, np.ndarray], i: int, found: np.ndarray, species: Species, inputs: dict[str, Any], least: str
) -> None:
    """Check the optima at one speed: the numbers of those that there are, and nothing in place of the others."""
    numbers = {name: v[i] for name, v in columns.items() if v.ndim == 2 and v.dtype.kind == "f"}
    for name, values in numbers.items():
        demand(not np.isfinite(values[~found]).any(), f"{name} has values where there is no optimum")
    demand(bool((np.diff(numbers["objective_value"][found]) >= 0).all()), "the optima of a speed are not in order")
    speed = float(columns["speed"][i])
    problem: Any = SimpleNamespace(species=species, vehicle=species.vehicle, air=species.air, speed=speed)
    weight = species.vehicle.mass * species.air.gravity
    options = inputs.get("options", {}).get("certificate", {})
    tolerance = options.get("closure_tolerance", DEFAULTS.certificate.closure_tolerance)
    for k in np.flatnonzero(found).tolist():
        own = {name: float(v[k]) for name, v in numbers.items()}
        derived = flight_numbers(problem, own["frequency"], own["flap_amplitude"])
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
        demand(own["mean_power"] <= own["mean_positive_power"] <= max(own["peak_power"], 0.0), "powers contradict")
        for name in PARAMETER_NAMES:
            stock = inputs["stock_wingbeat"].get(name)
            if name in own and harmonic_place(name) is None and name not in inputs["free"] and stock is not None:
                demand(own[name] == stock, f"{name} is not free, but differs from the species' own")
        outside = {*filter(None, str(columns["outside_ranges"][i, k]).split(", "))}
        values = {**own, "positive_power_per_mass": own["mean_positive_power"] / species.vehicle.mass}
        for name in {*judged_names(species, tuple(inputs["free"]))} & {*values}:
            is_out = judged(problem, name, values[name])["within"] is False
            demand(is_out == (name in outside), f"{name} is judged wrongly")
