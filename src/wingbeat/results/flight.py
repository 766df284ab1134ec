"""Simulated flights: the wings are prescribed or driven by torques, the body is free or moves as filmed."""

from __future__ import annotations

import dataclasses
import functools
import itertools
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from wingbeat._base import KIND, NOMENCLATURE, FaultList, __version__, attributes_of
from wingbeat.aero.winds import Wind
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.species.species import Species
from wingbeat.mechanics.equations_of_motion import fly_torque_driven
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.flights import Controller, check_samples, check_wind, fly_beats, state_of
from wingbeat.orbits.flight.beat import mean_positive
from wingbeat.records.flight_dataset import evaluate, evaluate_carried, flight_attributes, flight_dataset
from wingbeat.records.numbers import beat_mean
from wingbeat.records.result_files import Saveable

if TYPE_CHECKING:
    import xarray as xr


# How far a tail tilts [rad].
_MOST_TILT = math.radians(30.0)


@dataclass(frozen=True)
class Flight(Saveable):
    """A flight with prescribed wings, sampled along its beats; made by `simulate`.

    Attributes
    ----------
    model : the flight model.
    wingbeat : the wingbeat; in a controlled flight, that of the first beat.
    phase : beats since the start, shape (K,).
    states : (x, z, body_pitch, u, w, pitch_rate), shape (K, 6) [m, m, rad, m/s, m/s, rad/s]; not-a-number after the
        integrator gave up.
    wingbeats : the wingbeat of each beat.
    air : velocity of the air, forward and up [m/s], shape (K, 2); None for still air.
    species : what flies, for drawings alone; None if it was not given.
    hinge : angle and rate of a pitch hinge that gives way, shape (K, 2) [rad, rad/s]; None without one.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, "su-fan")
    >>> flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), beats=1)
    >>> flight.completed, flight.dataset["body_pitch"].attrs["units"]
    (True, 'rad')
    """

    model: FlightModel
    wingbeat: Wingbeat
    phase: np.ndarray
    states: np.ndarray
    wingbeats: tuple[Wingbeat, ...]
    air: np.ndarray | None = None
    species: Species | None = None
    hinge: np.ndarray | None = None

    @property
    def completed(self) -> bool:
        """Whether the flight went to the end; False where the vehicle tumbled and the integrator gave up."""
        return bool(np.isfinite(self.states).all())

    @functools.cached_property
    def time(self) -> np.ndarray:
        """Time since the start [s], shape (K,)."""
        ends = np.concatenate([[0.0], np.cumsum([1.0 / beat.frequency for beat in self.wingbeats])])
        return np.interp(self.phase, np.arange(len(ends)), ends)

    @functools.cached_property
    def dataset(self) -> xr.Dataset:
        """The time series, labelled; its phase runs on from beat to beat."""
        import xarray as xr

        attributes = flight_attributes(self.model, self.wingbeat, self.species)
        changes = [i for i, (one, other) in enumerate(itertools.pairwise(self.wingbeats), 1) if one != other]
        ends = itertools.pairwise([0, *changes, len(self.wingbeats)])
        runs = [self._run(first, last, attributes) for first, last in ends]
        found = runs[0] if len(runs) == 1 else xr.concat(runs, "phase", data_vars="minimal", coords="minimal")
        found["time"] = ("phase", self.time, found["time"].attrs)
        if self.air is not None:
            for name, column in zip(("air_u", "air_w"), self.air.T, strict=True):
                found[name] = ("phase", column, attributes_of(NOMENCLATURE[name]))
        return found

    def _run(self, first: int, last: int, attributes: dict[str, Any]) -> xr.Dataset:
        """Return the series of beats with the same wingbeat; the sample between two runs belongs to the earlier."""
        samples = (len(self.phase) - 1) // len(self.wingbeats)
        here = slice(first * samples + (first > 0), last * samples + 1)
        wingbeat, phase, states = self.wingbeats[first], self.phase[here], self.states[here]
        through_air = states
        if self.air is not None:
            through_air = states - np.pad(self.air[here], ((0, 0), (3, 1)))
        hinge = None if self.hinge is None else self.hinge[here]
        found = evaluate(self.model, wingbeat, phase, through_air, hinge=hinge)
        return flight_dataset(self.model, wingbeat, phase, states, found, attributes, hinge=hinge)


def simulate(
    model: FlightModel,
    wingbeat: Wingbeat,
    state: State | ArrayLike,
    beats: int = 1,
    samples: int = 128,
    *,
    wind: Wind | tuple[float, float] | None = None,
    controller: Controller | None = None,
    species: Species | None = None,
    hinge: ArrayLike | Mapping[str, float] | None = None,
) -> Flight:
    """Fly an initial state for a number of wingbeats with prescribed wings, or wings whose pitch gives way.

    Parameters
    ----------
    model : the flight model, a `FlightModel`.
    wingbeat : the prescribed wingbeat.
    state : the state at phase 0, the top of the stroke: a `State`, or its six numbers x, z [m], body_pitch [rad],
        u, w [m/s], pitch_rate [rad/s] as a list or an array, such as ``flight.states[-1]``.
    beats : number of wingbeats.
    samples : samples per wingbeat.
    wind : velocity of the air, forward and up [m/s]: two numbers, or a function of times [s] such as those of
        `wb.winds`. It must be smooth over a 64th of a beat. Loads of the air's own acceleration are left out.
    controller : function of the number of beats flown and the state at the top of the stroke; it returns the
        wingbeat of the next beat. Inputs of `linearise` change a wingbeat without a jump of the wing.
    species : what flies; drawings of the flight show its shape. The flight itself does not depend on it.
    hinge : angle and rate at phase 0 of a pitch hinge that gives way [rad, rad/s], such as ``flight.hinge[-1]``, or
        ``orbit.record()["hinge_start"]``, without which an orbit is not repeated; by default, at rest.

    Raises
    ------
    InvalidInputError : a state that is not six finite numbers, a body pitch above pi, which is most likely in
        degrees, beats or samples that are not whole numbers of at least 1, a model with the lag of the wake, a
        wind that is not finite or has another shape than its times, a controller that returns no wingbeat, a
        hinge for a wing without one.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    >>> flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), beats=1)
    >>> flight.states.shape, flight.completed
    ((129, 6), True)
    """
    faults = FaultList()
    check_samples(faults, beats, samples)
    check_wind(faults, wind)
    if controller is not None and not callable(controller):
        faults.add("controller", controller, "must be a function of the beats flown and the state")
    faults.raise_if_any()
    flown = fly_beats(model, wingbeat, state_of(state), beats, samples, wind, controller, hinge)
    series = flown.phase, flown.states, flown.wingbeats, flown.air
    return Flight(model, flown.wingbeats[0], *series, species, flown.hinge)


# The generalised coordinates and their rates, as a data set names them.
_DRIVEN = ("x", "z", "body_pitch", "flap", "wing_pitch", "u", "w", "pitch_rate", "flap_rate", "wing_pitch_rate")


@dataclass(frozen=True)
class TorqueDrivenFlight(Saveable):
    """A flight whose wings are driven by torques.

    Attributes
    ----------
    time : sample times [s], shape (K,).
    coordinates : x, z [m], body pitch, flap and wing pitch [rad], shape (K, 5).
    rates : of the coordinates, shape (K, 5).

    >>> import jax.numpy as jnp, wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, "su-fan")
    >>> start, rates = [0.0, 0.0, 0.1, 0.4, 0.2], [10.0, 0.0, 0.0, 0.0, 0.0]
    >>> limp = wb.simulate_torque_driven(
    ...     model, pigeon.wingbeat, start, rates, lambda time, _: jnp.zeros(2), [0.0, 0.01]
    ... )
    >>> limp.coordinates.shape
    (2, 5)
    """

    time: np.ndarray
    coordinates: np.ndarray
    rates: np.ndarray

    @property
    def completed(self) -> bool:
        """Whether the flight went to the end; False where the vehicle tumbled and the integrator gave up."""
        return bool(np.isfinite(self.coordinates).all())

    @functools.cached_property
    def dataset(self) -> xr.Dataset:
        """The time series, labelled."""
        import xarray as xr

        series = zip(_DRIVEN, np.hstack([self.coordinates, self.rates]).T, strict=True)
        return xr.Dataset(
            {name: ("time", value, attributes_of(NOMENCLATURE[name])) for name, value in series},
            {"time": ("time", self.time, attributes_of(NOMENCLATURE["time"]))},
            {"Conventions": "CF-1.11", KIND: "torque-driven flight", "version": __version__},
        )


def simulate_torque_driven(
    model: FlightModel,
    wingbeat: Wingbeat,
    coordinates: Any,
    rates: Any,
    torques: Callable[[Any, Any], Any],
    times: Any,
    args: Any = None,
) -> TorqueDrivenFlight:
    """Fly all five coordinates (x, z, body_pitch, flap, wing_pitch) with the hinges driven by torques.

    Parameters
    ----------
    model : the flight model.
    wingbeat : gives span, fold, sweep and twist; its flap and pitch laws are not used.
    coordinates, rates : q and q' at the first time, shape (5,) each [m, rad; per s].
    torques : JAX-traceable function of time [s] and `args` that gives (flap, pitch) torques of both wings [N m].
    times : increasing sample times [s], shape (K,).
    args : passed to `torques`.

    Raises
    ------
    InvalidInputError : wrong shapes, not finite, times that do not increase, or a model with the lag of the wake.

    The equations are ``D(q) q'' + C(q, q') q' + g = Q_air + B tau`` of Su et al. 2023
    (doi 10.48550/arXiv.2302.09602).

    >>> import jax.numpy as jnp, wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, "su-fan")
    >>> start, rates = [0.0, 0.0, 0.1, 0.4, 0.2], [10.0, 0.0, 0.0, 0.0, 0.0]
    >>> limp = wb.simulate_torque_driven(
    ...     model, pigeon.wingbeat, start, rates, lambda time, _: jnp.zeros(2), [0.0, 0.01]
    ... )
    >>> limp.completed, limp.dataset["flap"].attrs["units"]
    (True, 'rad')
    """
    return TorqueDrivenFlight(*fly_torque_driven(model, wingbeat, coordinates, rates, torques, times, args))


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
        attributes = flight_attributes(self.model, self.wingbeat, self.species, body="prescribed")
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

    def balanced(self) -> CarriedFlight | None:
        """Return the first beat with the tail tilted so that no moment is missing on average.

        The result is None if no tilt within 30 degrees does that.
        """
        from scipy.optimize import root_scalar

        first = self.phase <= 1.0
        series = {name: getattr(self, name)[first] for name in ("phase", "states", "accelerations")}

        def tilted(tilt: float) -> CarriedFlight:
            wingbeat = dataclasses.replace(self.wingbeat, tail_tilt=tilt)
            return dataclasses.replace(self, wingbeat=wingbeat, **series)

        def missing(tilt: float) -> float:
            return tilted(tilt).summary["missing_moment_mean"]

        if missing(-_MOST_TILT) * missing(_MOST_TILT) > 0:
            return None
        return tilted(root_scalar(missing, bracket=(-_MOST_TILT, _MOST_TILT), xtol=1e-6).root)


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
    InvalidInputError : beats or samples that are not whole numbers of at least 1; a model with the lag of the
        wake.
    """
    faults = FaultList()
    check_samples(faults, beats, samples)
    faults.raise_if_any()
    phase = np.arange(beats * samples + 1) / samples
    return CarriedFlight(model, wingbeat, phase, path.states(phase), path.accelerations(phase), species)
