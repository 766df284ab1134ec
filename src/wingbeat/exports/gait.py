"""The gait of an orbit, and how other tools take it.

A gait is what one wing does at equal phases of the beat, and what drives it. It is written as a table for a robot's
controller (CSV), as structures with time for MATLAB and Simulink, or as points of body and wings for motion
laboratories (C3D).
"""

from __future__ import annotations

import csv
import functools
import io
import json
from dataclasses import dataclass
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import (
    NOMENCLATURE,
    Fault,
    FaultList,
    FileError,
    InvalidInputError,
    Term,
    install_extra,
    writing,
)
from wingbeat._jax.arrays import jnp
from wingbeat._jax.exported import jit_soon
from wingbeat.animal.kinematics import LAWS, Wingbeat, held_at
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.flights import fly_through
from wingbeat.mechanics.state_rates import HINGE_STATE, body_rates, rate_table
from wingbeat.mechanics.wing_motion import time_rates
from wingbeat.mechanics.wing_points import surface_points
from wingbeat.orbits.flight.certificate import certify
from wingbeat.orbits.options import DEFAULTS
from wingbeat.records.flight_dataset import evaluate, flight_attributes, flight_dataset
from wingbeat.results.flight import simulate

if TYPE_CHECKING:
    import xarray as xr

    from wingbeat._jax.arrays import FlightState, Phases
    from wingbeat.results.orbit import Orbit

# Values of a law that is off.
_OFF = {"span_ratio": 1.0, "chord_ratio": 1.0}
# For these quantities the record has the sum of both wings.
_OF_ONE_WING = ("flap_torque", "pitch_torque", "hinge_torque", "hinge_power", "actuator_power")


@jit_soon
def _laws(wingbeat: Wingbeat, phase: Phases) -> tuple[Phases, Phases, Phases]:
    def values(at: Phases) -> Phases:
        found = {name: law(wingbeat, at) for name, law in LAWS.items()}
        off = {name: jnp.full_like(at, _OFF.get(name, 0.0)) for name in found}
        return jnp.stack([off[name] if law is None else law for name, law in found.items()], axis=-1)

    return time_rates(values, phase, wingbeat.frequency)


# Three arrays of shape (..., laws): `LAWS`, of which those that are off are constant, and their first and second
# time derivatives.
Laws = tuple[np.ndarray, np.ndarray, np.ndarray]


def laws_at(wingbeat: Wingbeat, phase: np.ndarray) -> Laws:
    """Return the laws and their time derivatives at phases."""
    value, rate, acceleration = _laws(wingbeat, np.asarray(phase, dtype=float))
    return np.asarray(value), np.asarray(rate), np.asarray(acceleration)


@jit_soon
def _hinge_accelerations(model: FlightModel, wingbeat: Wingbeat, phase: Phases, states: FlightState) -> Phases:
    return body_rates(model, rate_table(model, wingbeat, phase), states)[5]


def as_flown(orbit: Orbit, phase: np.ndarray) -> Wingbeat:
    """Return an orbit's wingbeat at phases that start with 0; a hinge that gives way is held as it moved there."""
    model, wingbeat, start = orbit.problem.model, orbit.wingbeat, orbit.initial_state
    if wingbeat.pitch_hinge is None:
        return wingbeat
    states = fly_through(model, wingbeat, start, phase, wake=(hinge_start(orbit),))[0]
    return _held(model, wingbeat, phase, states)


def _held(model: FlightModel, wingbeat: Wingbeat, phase: np.ndarray, states: np.ndarray) -> Wingbeat:
    angle, rate = states[:, 6:].T
    acceleration = np.asarray(_hinge_accelerations(model, wingbeat, phase, states[:, 2:].T))
    return held_at(wingbeat, phase, angle, rate, acceleration)


def hinge_start(orbit: Orbit) -> np.ndarray:
    """Return angle and rate at phase 0 of an orbit's hinge that gives way, shape (2,) [rad, rad/s]."""
    start = orbit.record()["hinge_start"]
    return np.array([start[name] for name in HINGE_STATE])


@dataclass(frozen=True)
class Gait:
    """One beat of a certified orbit at K equal phases; all series have K + 1 values, the last at the next top."""

    orbit: Orbit
    samples: int  # K
    dataset: xr.Dataset

    @property
    def phase(self) -> np.ndarray:
        """The phases."""
        return self.dataset["phase"].values

    @property
    def states(self) -> np.ndarray:
        """The body's states (x, z, body_pitch, u, w, pitch_rate), shape (K + 1, 6)."""
        return np.stack([self.dataset[name].values for name in self.orbit.initial_state._fields], axis=-1)

    @property
    def hinge(self) -> np.ndarray | None:
        """Angle and rate of a hinge that gives way, shape (K + 1, 2) [rad, rad/s]; None without one."""
        if self.orbit.wingbeat.pitch_hinge is None:
            return None
        return np.stack([self.dataset[name].values for name in HINGE_STATE], axis=-1)

    @functools.cached_property
    def laws(self) -> Laws:
        """The laws and their time derivatives at the phases, with the pitch as it was flown."""
        wingbeat = self.orbit.wingbeat
        if self.hinge is not None:
            states = np.hstack([self.states, self.hinge])
            wingbeat = _held(self.orbit.problem.model, wingbeat, self.phase, states)
        return laws_at(wingbeat, self.phase)

    @property
    def about(self) -> str:
        """Whose gait it is, and at which speed."""
        what = self.orbit.inputs
        return f"{what['species']['name']} at {what['speed']:g} m/s"

    @functools.cached_property
    def columns(self) -> list[tuple[Term, np.ndarray]]:
        """Time, each law that moves with its rate and acceleration, and torques and powers of one wing."""
        found = [(NOMENCLATURE["time"], self.dataset["time"].values)]
        laws = self.laws
        for i, name in enumerate(LAWS):
            values, term = laws[0][:, i], NOMENCLATURE[name]
            # A law that does not move may be held away from where it is if it is off.
            if name in ("flap", "wing_pitch") or np.ptp(values) > 0 or values[0] != _OFF.get(name, 0.0):
                base, of = "" if term.unit == "1" else f"{term.unit} ", f"of the {term.label}"
                rate = NOMENCLATURE.get(f"{name}_rate") or Term(f"{name}_rate", f"{base}s-1", f"rate {of}")
                twice = Term(f"{name}_acceleration", f"{base}s-2", f"second time derivative {of}")
                found += [(term, values), (rate, laws[1][:, i]), (twice, laws[2][:, i])]
        if self.hinge is not None:
            found += [(NOMENCLATURE[name], self.dataset[name].values) for name in HINGE_STATE]
        for name in _OF_ONE_WING:
            if name not in self.dataset:
                continue
            term = NOMENCLATURE[name]
            label = term.label.replace("both wings", "one wing").replace("hinges, one wing", "hinge of one wing")
            found.append((Term(f"{name}_per_wing", term.unit, label), 0.5 * self.dataset[name].values))
        return found

    @functools.cached_property
    def constants(self) -> dict[str, tuple[float, str]]:
        """Numbers that a reader of the table needs beside it, with their units, by the names of the record."""
        wing, beat = self.orbit.problem.vehicle.wing, self.orbit.wingbeat
        values = {
            "frequency": beat.frequency,
            "stroke_plane_angle": wing.stroke_plane_angle + beat.stroke_plane_tilt,
            "twist_ratio": beat.twist_ratio,
            "wrist": beat.wrist,
        }
        if self.orbit.problem.vehicle.tail is not None:
            values["tail_tilt"] = beat.tail_tilt
        return {name: (float(value), NOMENCLATURE[name].unit) for name, value in values.items()}


def gait_of(orbit: Orbit, samples: int) -> Gait:
    """Return the gait of a certified orbit at so many equal phases of the beat, flown from its initial state.

    With the lag of the wake, or a hinge that gives way, their states at phase 0 are those that repeat.
    """
    model, wingbeat, start = orbit.problem.model, orbit.wingbeat, orbit.initial_state
    if wingbeat.pitch_hinge is not None:
        flight = simulate(model, wingbeat, start, beats=1, samples=samples, hinge=hinge_start(orbit))
        if not flight.completed:
            rule = "breaks off when it is flown again from its start"
            raise InvalidInputError([Fault("orbit", orbit.status.value, rule, "solve it again")])
        return Gait(orbit, samples, flight.dataset)
    if model.wake is None:
        return Gait(orbit, samples, simulate(model, wingbeat, start, beats=1, samples=samples).dataset)
    flown, faults = certify(model, wingbeat, np.array(start)[2:]), FaultList()
    assert flown.wake is not None
    # Found anew, from air at rest: within 2e-8 m/s for orbits of pigeon and bat.
    faults.number("wake_closure", flown.wake_miss, at_most=DEFAULTS.certificate.closure_tolerance)
    faults.raise_if_any()
    phase = np.arange(samples + 1) / samples
    states = fly_through(model, wingbeat, start, phase, wake=(flown.wake[0],))[0]
    flight = model, wingbeat, phase, states[:, :6]
    series = flight_dataset(*flight, evaluate(*flight, states[:, 6:]), flight_attributes(model, wingbeat, None))
    return Gait(orbit, samples, series)


def gait_csv(gait: Gait) -> bytes:
    """Return a CSV table: a header of comment lines with units, then one row for each equal phase of the beat.

    It leaves out the end of the beat, for the first row follows again one time step after the last.
    """
    out = io.StringIO()
    out.write(f"# gait of one wing of {gait.about}, written by the package wingbeat; SI units, radians\n")
    out.write("# the wings move alike; the beat repeats after the last row\n")
    for name, (value, unit) in gait.constants.items():
        out.write(f"# {name} = {json.dumps(value)}{_bracket(unit)}\n")
    out.write("#\n# columns: name [unit] meaning\n")
    for term, _ in gait.columns:
        out.write(f"# {term.name}{_bracket(term.unit)} {term.label}\n")
    table = csv.writer(out, lineterminator="\n")
    table.writerow(term.name for term, _ in gait.columns)
    table.writerows(zip(*(map(repr, values[:-1].tolist()) for _, values in gait.columns), strict=True))
    return out.getvalue().encode()


def _bracket(unit: str) -> str:
    return f" [{unit}]" if unit else ""


def gait_mat(gait: Gait) -> bytes:
    """Return a MATLAB file, version 5, with a structure with time for each series of the gait.

    Simulink's block From Workspace takes such structures: `time`, and `signals` with `values` and `dimensions`.
    The last value belongs to the next top of the stroke, so that interpolation covers the whole beat.
    """
    from scipy.io import savemat

    (_, time), *series = gait.columns

    def signals(term: Term, values: np.ndarray) -> dict[str, Any]:
        return {"values": values[:, None], "dimensions": 1.0, "label": term.name}

    content: dict[str, Any] = {
        "gait": {term.name: {"time": time[:, None], "signals": signals(term, values)} for term, values in series},
        "units": {term.name: term.unit for term, _ in gait.columns},
        "meaning": {term.name: term.label for term, _ in gait.columns},
        "constants": {name: value for name, (value, _) in gait.constants.items()},
        "constants_units": {name: unit for name, (_, unit) in gait.constants.items()},
        "about": gait.about,
    }
    held = io.BytesIO()
    savemat(held, content, long_field_names=True, do_compression=True, oned_as="column")
    return held.getvalue()


def write_c3d(orbit: Orbit, samples: int, path: str | PathLike[str]) -> None:
    """Write a C3D file, in single precision and metres: body, shoulders, wing tips, and edges at strips' centres.

    Its frames are the equal phases of the beat. A wing's tip is on its quarter-chord line. Strips are counted from
    1 at the root.
    """
    try:
        import ezc3d
    except ImportError:
        raise FileError(f"ezc3d, which writes .c3d, is not installed here: {install_extra('c3d')}") from None

    gait, problem, strips = gait_of(orbit, samples), orbit.problem, orbit.problem.model.strips
    stations = np.concatenate([[0.0], (np.arange(strips) + 0.5) / strips, [1.0]])
    states, phase = gait.states[:-1], gait.phase[:-1]
    given = problem.vehicle.passive, orbit.wingbeat, State(*states.T), phase
    turned = () if gait.hinge is None else (gait.hinge[:-1, 0],)
    surface = np.asarray(surface_points(*given, stations, np.array([0.0, 0.25, 1.0]), *turned))
    leading, quarter, trailing = (surface[:, row] for row in range(3))
    body = np.stack([states[:, 0], np.zeros(len(states)), states[:, 1]], axis=-1)[:, None]
    left = np.concatenate([quarter[:, [0, -1]], leading[:, 1:-1], trailing[:, 1:-1]], axis=1)
    numbers = range(1, strips + 1)
    names = ["shoulder", "tip", *(f"{edge}_{i}" for edge in ("leading", "trailing") for i in numbers)]
    labels = ["body", *(f"{side}_{name}" for side in ("left", "right") for name in names)]
    positions = np.concatenate([body, left, left * [1.0, -1.0, 1.0]], axis=1)
    file = ezc3d.c3d()
    about = file["parameters"]["POINT"]
    about["RATE"]["value"] = [samples * orbit.wingbeat.frequency]
    about["LABELS"]["value"] = labels
    about["DESCRIPTIONS"]["value"] = [label.replace("_", " ") for label in labels]
    about["UNITS"]["value"] = ["m"]
    data = np.ones((4, len(labels), samples))
    data[:3] = positions.transpose(2, 1, 0)
    file["data"]["points"] = data
    with writing(path) as beside:
        file.write(str(beside))
