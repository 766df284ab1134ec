"""Numbers that follow from a flown beat: means and peaks of power, what power is made of, and numbers of flow."""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import KIND, FaultList
from wingbeat._base.datasets import at_station
from wingbeat.aero import BladeElement
from wingbeat.aero.wake import is_stalled
from wingbeat.animal.vehicle import Air, Vehicle, Wing
from wingbeat.mechanics.wing_shape import strip_chords
from wingbeat.orbits.flight.beat import Beat, best_spring, mean_positive
from wingbeat.orbits.problem.quantities import QUANTITIES
from wingbeat.orbits.problem.quantity import drive_numbers
from wingbeat.records.tables import finite_or_none

if TYPE_CHECKING:
    import xarray as xr

SHARES = {"aerodynamic": "aerodynamic_power", "inertial": "inertial_power", "body": "body_power"}
SPENT = {name: f"{name}_power" for name in ("profile", "induced", "parasite", "unsteady")}
_RETURNED = (-1.0, 0.0, 0.25, 0.5, 0.75, 1.0)


def power_account(dataset: xr.Dataset) -> dict[str, Any]:
    """Account for the power of an orbit, both wings [W].

    Parameters
    ----------
    dataset : `Orbit.dataset`, also one read from a file.

    Returns
    -------
    A dictionary for JSON; all values are None if the flight diverged. ``mean_power`` and ``mean_positive_power``
    are those of the hinges. ``braking`` is the mean power of negative work. ``cost_by_returned`` holds pairs
    (share, mean power): the mean power if this share of negative work is returned; at share -1, negative work costs
    as much as positive work. ``shares`` has the aerodynamic, the inertial and the body part of the hinge power,
    each with mean, minimum (``least``) and maximum (``most``). ``spent`` has the parts of the power of all
    actuators in the same form. These parts are profile, induced, parasite and unsteady, which are spent on the air,
    and inertial, the rate of change of kinetic and potential energy. ``best_spring`` gives, for both flap springs
    together, ``stiffness`` [N m/rad], ``rest_angle`` [rad] (None if no spring helps) and the remaining
    ``mean_positive_power``.

    Raises
    ------
    InvalidInputError : the dataset is not an orbit, or was written by a version of wingbeat without these parts.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
    >>> account = wb.power_account(orbit.dataset)
    >>> sum(share["mean"] for share in account["shares"].values()) - account["mean_power"] < 1e-12
    True
    """
    faults = FaultList()
    if (kind := dataset.attrs.get(KIND)) != "orbit":
        faults.add("dataset", kind, "is not an orbit: only a closed wingbeat has a power account")
    elif missing := [name for name in (*SHARES.values(), *SPENT.values()) if name not in dataset]:
        faults.add("dataset", missing, "is missing from the dataset", "solve the orbit again")
    faults.raise_if_any()
    flap, rate, power = (dataset[name].values for name in ("flap", "flap_rate", "hinge_power"))
    mean, positive = beat_mean(power), float(mean_positive(power, np))
    flown = bool(np.isfinite(power).all())
    spring = best_spring(flap, rate, power)._asdict() if flown else {"stiffness": None, "rest_angle": None}
    account = {
        "mean_power": mean,
        "mean_positive_power": positive,
        "braking": positive - mean,
        "cost_by_returned": [[share, positive - share * (positive - mean)] for share in _RETURNED],
        "shares": {name: _spread(dataset[variable].values) for name, variable in SHARES.items()},
        "spent": {name: _spread(values) for name, values in spent_power(dataset).items()},
        "best_spring": {"mean_positive_power": None, **spring},
    }
    return finite_or_none(account)


def spent_power(dataset: xr.Dataset) -> dict[str, np.ndarray]:
    """Return the time series of the parts of the actuator power [W]; the sum of the parts is the actuator power."""
    against_air = {name: dataset[variable].values for name, variable in SPENT.items()}
    return {**against_air, "inertial": (dataset["actuator_power"] + dataset["air_power"]).values}


def _spread(values: np.ndarray) -> dict[str, float]:
    return {"mean": beat_mean(values), "least": float(values.min()), "most": float(values.max())}


def beat_mean(values: np.ndarray) -> float:
    """Return the mean over one beat of samples at equal phases from 0 to 1, both ends included."""
    return float(np.trapezoid(values, dx=1.0 / (len(values) - 1)))


# What `power_summary` gives.
POWERS = (
    *("mean_power", "peak_power", "mean_positive_power", "mean_actuator_power", "peak_actuator_power"),
    "cost_of_transport",
)


def power_summary(vehicle: Vehicle, air: Air, speed: float, beat: Beat) -> dict[str, float | None]:
    """Return means and peaks of hinge and actuator power, both wings [W], and the cost of transport."""
    with np.errstate(over="ignore", invalid="ignore"):  # of a diverged flight
        positive = float(mean_positive(beat.hinge_power, np))
    weight = vehicle.mass * air.gravity
    return {
        "mean_power": beat_mean(beat.hinge_power),
        "peak_power": float(beat.hinge_power.max()),
        "mean_positive_power": positive,
        "mean_actuator_power": beat_mean(beat.actuator_power),
        "peak_actuator_power": float(beat.actuator_power.max()),
        "cost_of_transport": positive / (weight * speed) if weight * speed else None,
    }


def flight_numbers(
    vehicle: Vehicle, air: Air, speed: float, frequency: float, flap_amplitude: float
) -> dict[str, float | None]:
    """Return Strouhal number, and reduced frequency and Reynolds number of the mean chord; None in hover."""
    wing = vehicle.wing
    if speed == 0:
        return {"strouhal": None, "reduced_frequency": None, "reynolds": None}
    return {
        "strouhal": 2.0 * frequency * wing.semi_span * math.sin(flap_amplitude) / speed,
        "reduced_frequency": math.pi * frequency * wing.mean_chord / speed,
        "reynolds": air.reynolds(speed, wing.mean_chord),
    }


def beat_numbers(
    vehicle: Vehicle, air: Air, speed: float, beat: Beat, frequency: float, flap_amplitude: float
) -> dict[str, Any]:
    """Return the numbers of an orbit's record that follow from its flown beat."""
    found: dict[str, Any] = power_summary(vehicle, air, speed, beat) | drive_numbers(beat)
    found |= flight_numbers(vehicle, air, speed, frequency, flap_amplitude)
    found["body_pitch_range"] = float(np.ptp(beat.body_pitch))
    for name, station in (("alpha_quarter_span", 0.25), ("alpha_three_quarter_span", 0.75)):
        alpha = at_station(beat.alpha, station)  # effective, interpolated between strips
        found[name] = [float(alpha.min()), float(alpha.max())]
    return found


def detached_share(aero: BladeElement, wing: Wing, beat: Beat) -> float:
    """Return the share of the beat in which the angle of attack is beyond that of largest lift, by wing area."""
    areas = np.asarray(strip_chords(wing, count=aero.strips))
    # A wing that lets air through in the upstroke has less lift there, but the same angle of largest lift.
    whole = dataclasses.replace(aero, upstroke_factor=1.0)
    detached = is_stalled(whole.stall_numbers()[0], beat.alpha)
    return beat_mean(np.asarray(detached, dtype=float) @ (areas / areas.sum()))


# Judged numbers that are not in a record, and which quantities of a beat they are.
_OF_BEAT = ("peak_force_over_weight", "mean_body_pitch")


def judged_values(record: dict[str, Any], beat: Beat, mass: float) -> dict[str, Any]:
    """Return the numbers of a record and of its beat by name, among them all those that can be judged."""
    of_beat = {name: float(np.max(QUANTITIES[name].of(beat))) for name in _OF_BEAT}
    per_mass = {"positive_power_per_mass": record["mean_positive_power"] / mass}
    return {**record, **record["wingbeat"], **per_mass, **of_beat}
