"""One gust flown with and without feedback: what deviates from the orbit, and whether the flight is saved."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat.aero.winds import Wind
from wingbeat.orbits.problem.problem import PITCH_STATE
from wingbeat.results.flight import Flight, simulate
from wingbeat.results.orbit import Orbit
from wingbeat.stability.feedback import Feedback
from wingbeat.stability.feedback_options import DEFAULTS as SCALES
from wingbeat.stability.many_options import DEFAULTS, ManyOptions

SAMPLES = 64  # in each beat


@dataclass(frozen=True)
class GustFlight:
    """A flight through a wind, and the orbit on which it began.

    Attributes
    ----------
    flight : the flight.
    pitch : deviation of the body pitch from the orbit's at the same phase [rad], shape (K,).
    height : height above the orbit's path at the tops of the stroke [m], shape (beats + 1,).
    changes : of the inputs in each beat, shape (beats, inputs) [Hz, rad or shares].
    survived : as in `ManyFlights`.
    settled : beats after which attitude and velocities at the top of the stroke stay within half a scale of
        `FeedbackOptions`; None if they do not.
    """

    flight: Flight
    pitch: np.ndarray
    height: np.ndarray
    changes: np.ndarray
    survived: bool
    settled: int | None

    def record(self) -> dict[str, Any]:
        """Return the numbers as a JSON-able dictionary [m, rad]; None after the integrator gave up."""

        def finite(value: float) -> float | None:
            return float(value) if np.isfinite(value) else None

        return {
            "completed": self.flight.completed,
            "survived": self.survived,
            "largest_pitch": finite(np.abs(self.pitch).max()),
            "lowest": finite(self.height.min()),
            "highest": finite(self.height.max()),
            "settled_beats": self.settled,
        }


def fly_gust(
    orbit: Orbit,
    wind: Wind | tuple[float, float],
    beats: int = 30,
    *,
    feedback: Feedback | None = None,
    late: int = 0,
    noise: Mapping[str, float] | None = None,
    seed: int = 0,
    options: ManyOptions = DEFAULTS,
) -> GustFlight:
    """Fly an orbit through a wind with the adaptive integrator.

    Parameters
    ----------
    orbit : a certified orbit.
    wind, beats, feedback, late, noise, seed : as in `simulate_many`.
    options : say when a flight is lost.
    """
    controller = None if feedback is None else feedback.controller(noise, seed, late=late)
    model, beat, start = orbit.problem.model, orbit.wingbeat, orbit.initial_state
    species = orbit.problem.species
    flown = simulate(model, beat, start, beats, SAMPLES, wind=wind, controller=controller, species=species)
    path = simulate(model, beat, start, 1, SAMPLES).states[:-1, 2]
    pitch = flown.states[:, 2] - np.append(np.tile(path, beats), path[0])
    tops = flown.states[::SAMPLES]
    height = tops[:, 1] - float(start.z) - float(orbit.inputs["climb"]) * flown.time[::SAMPLES]
    kept = bool(options.keeps(np.abs(pitch).max(), height.min()))
    changes = np.zeros((beats, 0)) if controller is None else np.array(controller.commands)
    return GustFlight(flown, pitch, height, changes, flown.completed and kept, _settled(tops, orbit))


def _settled(tops: np.ndarray, orbit: Orbit) -> int | None:
    scales = np.array([SCALES.scale(name) for name in PITCH_STATE])
    away = np.abs((tops[:, 2:] - np.array(orbit.initial_state, dtype=float)[2:]) / scales).max(axis=1)
    unsettled = np.flatnonzero(~(away < 0.5))
    if not len(unsettled):
        return 0
    return int(unsettled[-1]) + 1 if unsettled[-1] + 1 < len(tops) else None
