"""The orbit record: everything about an orbit in one JSON-able dictionary, names as in the API."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from wingbeat._base.datasets import SHAPE, at_station
from wingbeat._jax.arrays import at_default
from wingbeat._version import __version__
from wingbeat.animal.kinematics import NAMED_IF_ON, Wingbeat
from wingbeat.animal.species.record import Species
from wingbeat.animal.vehicle import Body, Motor, Muscle, Springs, Tail, Vehicle, Wing
from wingbeat.mechanics.flight_model import State
from wingbeat.orbits.flight.beat import Beat, mean_positive
from wingbeat.orbits.problem.drive import drive_numbers
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.status import Status
from wingbeat.results.aero_record import aero_record
from wingbeat.results.plausibility import plausibility
from wingbeat.results.warnings import orbit_warnings

# Parts that a vehicle may lack.
_PARTS = {"tail": Tail, "muscle": Muscle, "motor": Motor, "springs": Springs}


def vehicle_record(vehicle: Vehicle) -> dict[str, Any]:
    """Return the vehicle's numbers."""
    wing = dict(vars(vehicle.wing))
    wing["chord"] = list(wing["chord"]) if isinstance(wing["chord"], tuple) else wing["chord"]
    wing["shoulder"] = list(wing["shoulder"])
    others = {name: getattr(vehicle, name) for name in _PARTS}
    found = {name: dict(vars(part)) for name, part in others.items() if part is not None}
    return {"body": dict(vars(vehicle.body)), "wing": wing, **found}


def vehicle_from(record: dict[str, Any]) -> Vehicle:
    """Return the vehicle that `vehicle_record` described, without a tail or other part that the record lacks.

    Raises
    ------
    KeyError, TypeError, ValueError : the dictionary was not made by `vehicle_record`.
    """
    parts = {name: made(**record[name]) for name, made in _PARTS.items() if name in record}
    return Vehicle(Body(**record["body"]), Wing(**record["wing"]), **parts)


def wingbeat_record(wingbeat: Wingbeat) -> dict[str, Any]:
    """Return the wingbeat's numbers; the laws in `NAMED_IF_ON` are left out if they are off."""
    left_out = [name for name in NAMED_IF_ON if at_default(wingbeat, name) or getattr(wingbeat, name) == ()]
    return {
        name: list(value) if isinstance(value, tuple) else value
        for name, value in vars(wingbeat).items()
        if name not in left_out
    }


def shape_attribute(species: Species | None) -> dict[str, str]:
    """Return the attribute of a data set that says how the animal looks; nothing without a species."""
    if species is None:
        return {}
    return {SHAPE: json.dumps({"kind": species.kind} | (species.shape.drawn() if species.shape else {}))}


def orbit_record(solution: Solution) -> dict[str, Any]:
    """Return the record of an orbit.

    A number without a value (a cost of transport in hover, any number of a diverged flight) is None, never NaN.
    """
    problem, wingbeat, certificate = solution.problem, solution.wingbeat, solution.certificate
    beat = solution.beat()
    record = {
        "status": solution.status.value,
        "message": solution.message,
        "species": problem.species.name,
        **({} if problem.origin is None else {"model": problem.origin.record()}),
        "vehicle": vehicle_record(problem.vehicle),
        "aero": aero_record(problem.aero),
        "air": dict(vars(problem.air)),
        "speed": float(problem.speed),
        "climb": float(problem.climb),
        "objective": problem.minimise.name,
        "objective_value": solution.objective,
        "constraints": {str(c): solution.value_of(c.quantity, beat) for c in problem.subject_to},
        "wingbeat": wingbeat_record(wingbeat),
        "initial_state": dict(zip(State._fields, certificate.states[0].tolist(), strict=True)),
        "active_bounds": list(solution.active_bounds),
        "closure": dict(solution.closure),
        "failed_balance": [{**vars(s), "unit": s.unit} for s in solution.deficits],
        "relaxations": [dict(vars(r)) for r in solution.relaxations],
        "optimality": solution.optimality,
        "starts": solution.starts,
        "distinct_optima": solution.distinct_optima,
        "starts_at_best": solution.starts_at_best,
        **power_summary(solution, beat),
        **drive_numbers(beat),
        **flight_numbers(problem, wingbeat.frequency, wingbeat.flap_amplitude),
        "body_pitch_range": float(np.ptp(certificate.states[:, 2])),
        "alpha_quarter_span": alpha_range(beat, 0.25),
        "alpha_three_quarter_span": alpha_range(beat, 0.75),
        "floquet_multipliers": [[float(m.real), float(m.imag)] for m in solution.multipliers],
        "stable": bool(np.abs(solution.multipliers).max() < 1.0) if solution.status is Status.CONVERGED else None,
        **_stability_price(solution),
        "warnings": orbit_warnings(solution, beat),
        "solve_seconds": solution.seconds,
        "version": __version__,
    }
    record["plausibility"] = plausibility(problem, beat, record)
    return finite_or_none(record)


def _stability_price(solution: Solution) -> dict[str, float | None]:
    """Return the price of stability; empty if the problem was not also solved without its limits of stability."""
    if solution.free_objective is None:
        return {}
    return {"free_objective": solution.free_objective, "price_of_stability": solution.price_of_stability}


def beat_mean(values: np.ndarray) -> float:
    """Return the mean over one beat of samples at equal phases from 0 to 1, both ends included."""
    return float(np.trapezoid(values, dx=1.0 / (len(values) - 1)))


# What `power_summary` gives.
POWERS = (
    *("mean_power", "peak_power", "mean_positive_power", "mean_actuator_power", "peak_actuator_power"),
    "cost_of_transport",
)


def power_summary(solution: Solution, beat: Beat) -> dict[str, float | None]:
    """Return means and peaks of hinge and actuator power, both wings [W], and the cost of transport."""
    problem = solution.problem
    with np.errstate(over="ignore", invalid="ignore"):  # of a diverged flight
        positive = float(mean_positive(beat.hinge_power, np))
    weight = problem.vehicle.mass * problem.air.gravity
    return {
        "mean_power": beat_mean(beat.hinge_power),
        "peak_power": float(beat.hinge_power.max()),
        "mean_positive_power": positive,
        "mean_actuator_power": beat_mean(beat.actuator_power),
        "peak_actuator_power": float(beat.actuator_power.max()),
        "cost_of_transport": positive / (weight * problem.speed) if weight * problem.speed else None,
    }


def flight_numbers(problem: OrbitProblem, frequency: float, flap_amplitude: float) -> dict[str, float | None]:
    """Return Strouhal number, reduced frequency and Reynolds number; they are None in hover.

    Reduced frequency and Reynolds number are those of the mean chord.
    """
    wing, speed = problem.vehicle.wing, problem.speed
    if speed == 0:
        return {"strouhal": None, "reduced_frequency": None, "reynolds": None}
    return {
        "strouhal": 2.0 * frequency * wing.semi_span * math.sin(flap_amplitude) / speed,
        "reduced_frequency": math.pi * frequency * wing.mean_chord / speed,
        "reynolds": problem.air.reynolds(speed, wing.mean_chord),
    }


def alpha_range(beat: Beat, station: float) -> list[float]:
    """Return the smallest and largest effective alpha [rad] at a span fraction, interpolated between strips."""
    alpha = at_station(beat.alpha, station)
    return [float(alpha.min()), float(alpha.max())]


def finite_or_none(value: Any) -> Any:
    """Return a copy with every float that is not finite replaced by None."""
    if isinstance(value, dict):
        return {key: finite_or_none(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [finite_or_none(item) for item in value]
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    return value
