"""Where a vehicle's body and strips are at one instant of its sample orbit: what figure 2 draws."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from wingbeat.aero import BladeElement, load_coefficients
from wingbeat.animal.kinematics import Wingbeat, flap_angle, pitch_angle, span_ratio, tip_twist
from wingbeat.animal.species.making import load_species
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.wing_points import corners_of, wing_points
from wingbeat.mechanics.wing_shape import air_chord, strips_of, stroke_pitch, twist_factors
from wingbeat.records.flight_dataset import evaluate
from wingbeat.results.orbit import Orbit
from wingbeat.viewer.scene import body_axes
from wingbeat_evidence.paper.treatments import MODELS, SAMPLE_SPEED


class Posture(NamedTuple):
    """A vehicle at one instant, its body's centre of mass at the origin; world axes, left wing, metres, radians.

    ``outlines`` are the corners of the strips in the order of `CORNERS`, shape (N, 4, 3). ``quarter_chord`` and the
    unit vectors ``chordwise`` and ``spanwise`` have shape (N, 3). ``stroke`` is the nose-up pitch of the stroke
    axes. ``body_axes`` are the half length and half depth of the ellipsoid drawn as the body.
    """

    phase: float
    span_fraction: np.ndarray
    outlines: np.ndarray
    quarter_chord: np.ndarray
    chordwise: np.ndarray
    spanwise: np.ndarray
    shoulder: np.ndarray
    body_pitch: float
    stroke: float
    flap: float
    body_axes: tuple[float, float]


class Section(NamedTuple):
    """A strip's cross-section: speed, forces, and angles [rad] from the direction of the chord at zero pitch.

    ``pitch`` is the angle of the chord, ``motion`` that of the velocity, and ``alpha`` their difference. ``lift``
    and ``drag`` are those of one strip [N].
    """

    pitch: float
    motion: float
    alpha: float
    speed: float
    lift: float
    drag: float


class Flown(NamedTuple):
    """A flight model with its wingbeat, and body pitch, u, w and pitch rate at phases from 0 to 1, shape (K,)."""

    model: FlightModel
    wingbeat: Wingbeat
    phase: np.ndarray
    states: np.ndarray

    def state(self, phase: float) -> np.ndarray:
        """Return the state at a phase, shape (6,), with the body at the origin."""
        found = [np.interp(phase, self.phase, column) for column in self.states.T]
        return np.array([0.0, 0.0, *found[2:]])


def flown(animal: str, orbit: Orbit | None) -> Flown:
    """Return the flight of a certified orbit; without one, the stock wingbeat in steady level flight."""
    if orbit is None:
        species = load_species(animal)
        aero = BladeElement(load_coefficients(MODELS[0]))
        level = np.array([State(u=SAMPLE_SPEED)] * 2, dtype=float)
        model = FlightModel(species.vehicle, aero, species.air)
        return Flown(model, species.wingbeat, np.array([0.0, 1.0]), level)
    states = np.stack([orbit.dataset[name].values for name in State._fields], axis=1)
    return Flown(orbit.problem.model, orbit.wingbeat, orbit.dataset["phase"].values, states)


def posture(flight: Flown, phase: float) -> Posture:
    """Return a vehicle's posture at a phase of its wingbeat, from the points that the equations of motion use."""
    model, wingbeat = flight.model, flight.wingbeat
    attitude, flap = float(flight.state(phase)[2]), float(flap_angle(wingbeat, phase))
    q = np.array([0.0, 0.0, attitude, flap, float(pitch_angle(wingbeat, phase))])
    points = wing_points(model, wingbeat, q, phase / wingbeat.frequency)
    quarter, fore, normal = (np.asarray(a) for a in (points.quarter_chord, points.chordwise, points.normal))
    along = np.cross(normal, fore)
    wing, strips = model.vehicle.wing, strips_of(model.vehicle.wing, model.strips)
    width = wing.semi_span / model.strips * span_ratio(wingbeat, phase)
    ahead, left, above = wing.shoulder
    c, s = math.cos(attitude), math.sin(attitude)
    return Posture(
        phase,
        np.asarray(strips.span_fraction),
        np.asarray(corners_of(points, air_chord(wingbeat, strips.chord, phase), width)),
        quarter,
        fore,
        along,
        np.array([c * ahead - s * above, left, s * ahead + c * above]),
        attitude,
        attitude + float(stroke_pitch(wing.stroke_plane_angle)),
        flap,
        body_axes(model.vehicle.body),
    )


def section(flight: Flown, phase: float, strip: int) -> Section:
    """Return angles, speed and forces of one strip at a phase."""
    model, wingbeat = flight.model, flight.wingbeat
    found = evaluate(model, wingbeat, np.array([phase]), flight.state(phase)[None])
    station, twist = (strip + 0.5) / model.strips, tip_twist(wingbeat, phase)
    pitch = float(
        found.wing_pitch[0] * twist_factors(wingbeat, station) + station * (0.0 if twist is None else twist)
    )
    alpha = float(found.alpha[0, strip])
    rest = (float(values[0, strip]) for values in (found.strip_speed, found.lift, found.drag))
    return Section(pitch, pitch - alpha, alpha, *rest)
