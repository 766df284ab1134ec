"""Flights from an initial state with prescribed wings: the verb, and what it gives back."""

from __future__ import annotations

import functools
import json
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING

import numpy as np

from wingbeat._version import __version__
from wingbeat.errors import FaultList
from wingbeat.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import FlightModel, State, check_state
from wingbeat.mechanics.flights import fly_beats
from wingbeat.results.dataset import evaluate, flight_dataset
from wingbeat.results.saving import save_result
from wingbeat.results.storage import KIND

if TYPE_CHECKING:
    import xarray as xr


@dataclass(frozen=True)
class Flight:
    """A flight with prescribed wings, sampled along its beats; made by `simulate`.

    Attributes
    ----------
    model, wingbeat : what flew.
    phase : beats since the start, shape (K,).
    states : (x, z, body_pitch, u, w, pitch_rate), shape (K, 6) [m, m, rad, m/s, m/s, rad/s]; not-a-number from
        where the integrator gave up.
    """

    model: FlightModel
    wingbeat: Wingbeat
    phase: np.ndarray
    states: np.ndarray

    @property
    def completed(self) -> bool:
        """Whether the flight went to the end; False where the vehicle tumbled and the integrator gave up."""
        return bool(np.isfinite(self.states).all())

    @functools.cached_property
    def dataset(self) -> xr.Dataset:
        """The time series, labelled; its phase runs on from beat to beat."""
        found = evaluate(self.model, self.wingbeat, self.phase, self.states)
        attributes = {
            KIND: "flight",
            "vehicle": json.dumps({"body": vars(self.model.vehicle.body), "wing": vars(self.model.vehicle.wing)}),
            "air": json.dumps(vars(self.model.air)),
            "wingbeat": json.dumps(vars(self.wingbeat)),
            "version": __version__,
        }
        return flight_dataset(self.model, self.wingbeat, self.phase, self.states, found, attributes)

    def save(self, path: str | PathLike[str]) -> None:
        """Write everything as NetCDF-4 (.nc), as a flat table (.csv) or for MATLAB (.mat); see `save_result`.

        Parameters
        ----------
        path : of the file to write; its suffix, .nc, .csv or .mat, says which.

        Raises
        ------
        InvalidInputError : another suffix.
        FileError : the file cannot be written.
        """
        save_result(self.dataset, path)


def simulate(model: FlightModel, wingbeat: Wingbeat, state: State, beats: int = 1, samples: int = 128) -> Flight:
    """Fly an initial state for a number of wingbeats with prescribed wings.

    Parameters
    ----------
    model : the flight model, from `flight_model`.
    wingbeat : the prescribed wingbeat.
    state : the state at phase 0, the top of the stroke [m, rad, m/s, rad/s].
    beats : number of wingbeats.
    samples : samples a beat.

    Raises
    ------
    InvalidInputError : a state that is not finite, beats or samples that are not whole numbers of at least 1.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.flight_model(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    >>> flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0), beats=1)
    >>> flight.states.shape, flight.completed
    ((129, 6), True)
    """
    faults = FaultList()
    for name, value, most in (("beats", beats, 10_000), ("samples", samples, 4096)):
        faults.whole(name, value, 1, most)
    faults.raise_if_any()
    check_state(state)
    return Flight(model, wingbeat, *fly_beats(model, wingbeat, state, beats, samples))
