"""Labelled time series of a flight: an xarray Dataset with units and long names."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import KIND, NOMENCLATURE, SERIES, SERIES_WHERE_ON, __version__, attributes_of
from wingbeat.animal.kinematics import Wingbeat, chord_ratio, held_at, tip_twist
from wingbeat.animal.species.species import Species
from wingbeat.mechanics.flight_loads import Loads, MissingLoads, carried_loads, flight_loads
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.state_rates import HINGE_STATE
from wingbeat.mechanics.wing_points import CORNERS, strip_corners
from wingbeat.records.forms import SERIES_DIMS
from wingbeat.records.inputs import shape_attribute, vehicle_record, wingbeat_record

if TYPE_CHECKING:
    import xarray as xr

_BLOCK = 257


def evaluate(
    model: FlightModel,
    wingbeat: Wingbeat,
    phase: np.ndarray,
    states: np.ndarray,
    wake: np.ndarray | None = None,
    hinge: np.ndarray | None = None,
) -> Loads:
    """Return the loads along sampled states, shape (K, 6), and those of wake or hinge, as NumPy arrays."""
    if hinge is not None:

        def with_hinge(*given: Any) -> Any:
            return flight_loads(*given[:4], None, given[4])

        return Loads(*_along(with_hinge, model, wingbeat, phase, states, hinge))
    more = () if wake is None else (wake,)
    return Loads(*_along(flight_loads, model, wingbeat, phase, states, *more))


def evaluate_carried(
    model: FlightModel, wingbeat: Wingbeat, phase: np.ndarray, states: np.ndarray, accelerations: np.ndarray
) -> tuple[Loads, MissingLoads]:
    """Return the loads of a body with prescribed accelerations, shape (K, 3), and the missing force and moment."""

    def both(*given: Any) -> tuple[Any, ...]:
        loads, missing = carried_loads(*given)
        return *loads, *missing

    found, count = _along(both, model, wingbeat, phase, states, accelerations), len(Loads._fields)
    return Loads(*found[:count]), MissingLoads(*found[count:])


def _along(
    function: Callable[..., Sequence[Any]],
    model: FlightModel,
    wingbeat: Wingbeat,
    phase: np.ndarray,
    states: np.ndarray,
    *more: np.ndarray,
) -> list[Any]:
    """Evaluate in blocks of equal length, because JAX compiles anew for each length; the last block is padded."""
    found = []
    for first in range(0, len(phase), _BLOCK):
        here = np.minimum(np.arange(first, first + _BLOCK), len(phase) - 1)
        found.append(function(model, wingbeat, State(*states[here].T), phase[here], *(a[here] for a in more)))
    series = zip(*found, strict=True)
    return [None if values[0] is None else np.concatenate(values)[: len(phase)] for values in series]


def flight_attributes(
    model: FlightModel, wingbeat: Wingbeat, species: Species | None, **more: str
) -> dict[str, Any]:
    """Return the attributes of a flight: what flew, and how an animal looks."""
    return {
        KIND: "flight",
        **more,
        "vehicle": json.dumps(vehicle_record(model.vehicle)),
        "air": json.dumps(vars(model.air)),
        "wingbeat": json.dumps(wingbeat_record(wingbeat)),
        **shape_attribute(species),
        "version": __version__,
    }


def flight_dataset(
    model: FlightModel,
    wingbeat: Wingbeat,
    phase: np.ndarray,
    states: np.ndarray,
    found: Loads,
    attributes: dict[str, Any],
    missing: MissingLoads | None = None,
    hinge: np.ndarray | None = None,
) -> xr.Dataset:
    """Assemble states and loads into a Dataset with dimensions phase, station, corner and axis."""
    import xarray as xr

    by_name = dict(zip(State._fields, np.asarray(states).T, strict=True))
    beat, more = wingbeat, ()
    if hinge is not None:
        beat, more = held_at(wingbeat, phase, hinge[:, 0], hinge[:, 1], np.zeros(len(phase))), (hinge[:, 0],)
        by_name |= dict(zip(HINGE_STATE, hinge.T, strict=True))
        by_name["hinge_torque"] = np.asarray(wingbeat.pitch_hinge.torque(*hinge.T))
    laws = {"chord_ratio": chord_ratio(wingbeat, phase), "tip_twist": tip_twist(beat, phase)}
    by_name |= {name: np.asarray(law) for name, law in laws.items() if law is not None}
    by_name |= {f"missing_{name}": value for name, value in (missing._asdict() if missing else {}).items()}
    by_name["time"] = phase / wingbeat.frequency
    by_name |= {name: value for name, value in found._asdict().items() if value is not None}
    corners = _along(lambda *given: [strip_corners(*given)], model, wingbeat, phase, states, *more)
    by_name["strip_corner"] = corners[0]
    by_name |= _columns(found.acceleration, "u_rate", "w_rate", "pitch_acceleration")
    by_name |= _columns(found.air_force, "force_x", "force_z", "pitching_moment")
    by_name |= _columns(found.centre_of_mass, "centre_of_mass_x", "centre_of_mass_z")
    by_name |= _columns(found.momentum, "momentum_x", "momentum_z")
    coordinates = {
        "phase": phase,
        "station": (np.arange(model.strips) + 0.5) / model.strips,
        "corner": list(CORNERS),
        "axis": ["x", "y", "z"],
    }
    return xr.Dataset(
        {
            term.name: (SERIES_DIMS.get(term.name, ("phase",)), by_name[term.name], attributes_of(term))
            for term in (*SERIES, *SERIES_WHERE_ON)
            if term.name in by_name
        },
        {name: (name, value, attributes_of(NOMENCLATURE[name])) for name, value in coordinates.items()},
        {"Conventions": "CF-1.11", **attributes},
    )


def _columns(values: np.ndarray, *names: str) -> dict[str, np.ndarray]:
    return {name: values[..., i] for i, name in enumerate(names)}
