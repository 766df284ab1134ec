"""Flights of an orbit through gusts, small enough for a page with many animals."""

from __future__ import annotations

from typing import Any

from wingbeat.errors import InvalidInputError
from wingbeat.explorer.thinning import thinned_pushes
from wingbeat.orbits.status import Status
from wingbeat.results.orbit import Orbit
from wingbeat.stability.pushes import fly_pushes
from wingbeat.viewer import scene

DIRECTIONS = ("upward", "tail")
SIZES = (1.0,)  # m/s
BEATS = 12


def pushes_of(orbit: Orbit) -> list[dict[str, Any]]:
    """Return flights through gusts of 1 m/s from below and from behind, as the viewer's scene holds them.

    They last twelve beats, or until the animal is lost, without and with feedback. If no feedback holds the orbit,
    there are only those without. An orbit that is not certified has none.

    Parameters
    ----------
    orbit : the flight that meets the gusts.
    """
    if orbit.status is not Status.CONVERGED:
        return []
    asked = {"beats": BEATS, "directions": DIRECTIONS, "sizes": SIZES}
    try:
        flown = fly_pushes(orbit, **asked)
    except InvalidInputError:
        flown = fly_pushes(orbit, delay=None, **asked)
    return thinned_pushes(scene([("", orbit.dataset)], flown)["pushes"])
