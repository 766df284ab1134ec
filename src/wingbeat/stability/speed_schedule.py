"""Steady flights from one speed to another, and the schedule of states and commands that follows them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from wingbeat.animal.kinematics import parameter
from wingbeat.orbits.status import Status
from wingbeat.results.orbit import solve_orbit
from wingbeat.stability.beat_map import BeatMap
from wingbeat.stability.manoeuvre_options import ManoeuvreOptions
from wingbeat.stability.steady_flight import SteadyFlight, defect_of, steady_flight


def steady_start(beat_map: BeatMap, options: ManoeuvreOptions) -> SteadyFlight:
    """Return the first orbit as a steady flight.

    Parameters
    ----------
    beat_map : the map of a beat.
    options : with the scales of its defect.
    """
    orbit, still = beat_map.orbit, np.zeros(len(beat_map.inputs))
    speed, frequency = float(orbit.inputs["speed"]), float(orbit.wingbeat.frequency)
    defect = defect_of(beat_map, speed, beat_map.start, still, frequency, options)
    return SteadyFlight(speed, beat_map.start, still, frequency, defect, True)


@dataclass(frozen=True)
class Road:
    """Steady flights from one speed to another, and why there are no more, if so.

    Attributes
    ----------
    flights : the steady flights, from the first speed as far as they were found.
    free_frequency : of the best orbit at the last speed [Hz].
    failure : why the speed was not reached; None if it was.
    """

    flights: list[SteadyFlight]
    free_frequency: float
    failure: str | None


def road_back(passed: list[SteadyFlight], speed: float, beat_map: BeatMap) -> Road | None:
    """Return the way back over the steady flights passed, None if none of them had this speed.

    Parameters
    ----------
    passed : steady flights so far, in the order in which they were found.
    speed : to reach [m/s].
    beat_map : the map of a beat.
    """
    for i in range(len(passed) - 2, -1, -1):
        if passed[i].speed == speed and math.isfinite(passed[i].defect):
            free = float(beat_map.orbit.wingbeat.frequency) if i == 0 else math.nan
            return Road(passed[i:][::-1], free, None)
    return None


def road_to(beat_map: BeatMap, here: SteadyFlight, speed: float, options: ManoeuvreOptions) -> Road:
    """Return steady flights from one to a speed, each near the inputs of the best orbits between both.

    Parameters
    ----------
    beat_map : the map of a beat.
    here : the first of the flights.
    speed : to reach [m/s].
    options : of the search.
    """
    orbit = beat_map.orbit
    best = solve_orbit(orbit.problem.at_speed(speed), int(orbit.inputs["starts"]))
    if best.status is not Status.CONVERGED:
        return Road([here], math.nan, f"there is no certified orbit at {speed:g} m/s: {best.message}")
    first, last = ([float(parameter(one.wingbeat, name)) for name in beat_map.inputs] for one in (orbit, best))
    wanted = np.array(last) - np.array(first)
    count = max(math.ceil(abs(speed - here.speed) / options.speed_step), 1)
    flights = [here]
    for share in np.linspace(0.0, 1.0, count + 1)[1:]:
        between = speed if share == 1.0 else float(here.speed + share * (speed - here.speed))
        toward = here.changes + share * (wanted - here.changes)
        flights.append(steady_flight(beat_map, between, toward, flights[-1], options, exact=share == 1.0))
        if not flights[-1].converged:
            failure = f"no steady flight with this top of the stroke was found at {between:.3g} m/s"
            return Road(flights, float(best.wingbeat.frequency), failure)
    return Road(flights, float(best.wingbeat.frequency), None)


def schedule(flights: list[SteadyFlight], count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return states at the tops of the stroke and changes in the beats; the speed starts and ends smoothly.

    Parameters
    ----------
    flights : steady flights from the first speed to the last.
    count : number of beats.
    """
    at = np.linspace(0.0, 1.0, len(flights))
    tops = np.linspace(0.0, 1.0, count + 1)
    ramp = tops**2 * (3.0 - 2.0 * tops)

    def along(shares: np.ndarray, name: str) -> np.ndarray:
        values = np.array([getattr(flight, name) for flight in flights])
        return np.stack([np.interp(shares, at, column) for column in values.T], axis=-1)

    return along(ramp, "state"), along(0.5 * (ramp[1:] + ramp[:-1]), "changes")
