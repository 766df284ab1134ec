"""A flight whose body moves as filmed: its loads, and the force that the model lacks for that motion."""

from __future__ import annotations

import functools
import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from wingbeat._base import FaultList
from wingbeat._base.datasets import KIND
from wingbeat._version import __version__
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.species.record import Species
from wingbeat.mechanics.beat_by_beat import check_samples
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.orbits.flight.beat import mean_positive
from wingbeat.results.dataset import evaluate_carried, flight_dataset
from wingbeat.results.record import beat_mean, shape_attribute, vehicle_record, wingbeat_record
from wingbeat.results.saving import Saveable

if TYPE_CHECKING:
    import xarray as xr


class Path(Protocol):
    """A motion of the body, such as `wingbeat.experiment.BodyPath`."""

    def states(self, phase: np.ndarray) -> np.ndarray:
        """Return (x, z, body_pitch, u, w, pitch_rate), shape (K, 6)."""
        ...

    def accelerations(self, phase: np.ndarray) -> np.ndarray:
        """Return (x'', z'', psi''), shape (K, 3)."""
        ...


@dataclass(frozen=True)
class CarriedFlight(Saveable):
    """A flight in which the motions of wings and body are both prescribed; made by `carry`.

    Attributes
    ----------
    model, wingbeat : the flight model and its wingbeat.
    phase : beats since the start, shape (K,).
    states : (x, z, body_pitch, u, w, pitch_rate), shape (K, 6) [m, m, rad, m/s, m/s, rad/s].
    accelerations : (x'', z'', psi''), shape (K, 3) [m/s2, m/s2, rad/s2].
    species : what flies, for drawings alone; None if it was not given.
    """

    model: FlightModel
    wingbeat: Wingbeat
    phase: np.ndarray
    states: np.ndarray
    accelerations: np.ndarray
    species: Species | None = None

    @functools.cached_property
    def dataset(self) -> xr.Dataset:
        """The time series of a flight, labelled, and the missing force and moment."""
        found, missing = evaluate_carried(self.model, self.wingbeat, self.phase, self.states, self.accelerations)
        attributes = {
            KIND: "flight",
            "body": "prescribed",
            "vehicle": json.dumps(vehicle_record(self.model.vehicle)),
            "air": json.dumps(vars(self.model.air)),
            "wingbeat": json.dumps(wingbeat_record(self.wingbeat)),
            **shape_attribute(self.species),
            "version": __version__,
        }
        return flight_dataset(self.model, self.wingbeat, self.phase, self.states, found, attributes, missing)

    @property
    def summary(self) -> dict[str, float]:
        """Means over the flight [SI], and the mean and root mean square of the missing force and moment.

        Missing forces are divided by the weight, the missing moment by weight times mean chord. A positive
        ``missing_force_z_mean`` is the share of the weight that the model's air loads do not support.
        """
        data, vehicle = self.dataset, self.model.vehicle
        weight = vehicle.mass * self.model.air.gravity
        scales = {"missing_force_x": weight, "missing_force_z": weight}
        scales["missing_moment"] = weight * vehicle.wing.mean_chord
        names = {"mean_u": "u", "mean_w": "w", "mean_body_pitch": "body_pitch"}
        names |= {"mean_power": "hinge_power", "mean_actuator_power": "actuator_power"}
        told = {name: beat_mean(data[series].to_numpy()) for name, series in names.items()}
        told["mean_positive_power"] = float(mean_positive(data["hinge_power"].to_numpy(), np))
        told["weight"] = float(weight)
        for name, scale in scales.items():
            share = data[name].to_numpy() / scale
            told[f"{name}_mean"] = beat_mean(share)
            told[f"{name}_rms"] = float(np.sqrt(beat_mean(share**2)))
        return {name: float(value) for name, value in told.items()}


def carry(
    model: FlightModel,
    wingbeat: Wingbeat,
    path: Path,
    beats: int = 1,
    samples: int = 128,
    *,
    species: Species | None = None,
) -> CarriedFlight:
    """Move the wings and the body of a vehicle as they were filmed, and evaluate the loads.

    The body's motion is prescribed, not integrated. This motion needs a force in addition to the air loads F and
    the weight: the missing force ``p' - F - M g``, with p the momentum of body and wings. The missing moment is
    about the body's centre of mass.

    Parameters
    ----------
    model : the flight model.
    wingbeat : the prescribed wingbeat.
    path : the prescribed motion of the body.
    beats : number of wingbeats.
    samples : samples per wingbeat.
    species : what flies; drawings of the flight show its shape.

    Raises
    ------
    InvalidInputError : beats or samples that are not whole numbers of at least 1.
    """
    faults = FaultList()
    check_samples(faults, beats, samples)
    faults.raise_if_any()
    phase = np.arange(beats * samples + 1) / samples
    return CarriedFlight(model, wingbeat, phase, path.states(phase), path.accelerations(phase), species)
