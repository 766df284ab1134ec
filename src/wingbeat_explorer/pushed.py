"""Flights of an orbit through gusts, for the explorer's picture."""

from __future__ import annotations

from typing import Any

from wingbeat._base import InvalidInputError, first_line
from wingbeat.orbits.options import Status
from wingbeat.results.orbit import Orbit
from wingbeat.stability.gust_flights import fly_pushes
from wingbeat.viewer import scene
from wingbeat_explorer.thinning import thinned_pushes

DIRECTIONS = ("upward", "tail")
SIZES = (1.0,)  # m/s
BEATS = 12


def flown_through_gusts(orbit: Orbit, **asked: Any) -> tuple[list[dict[str, Any]], str]:
    """Return flights through gusts as the viewer's scene holds them, and why those with feedback are left out.

    The reason is empty if they are not left out.

    Parameters
    ----------
    orbit : the flight that meets the gusts.
    asked : further parameters of `fly_pushes`.

    Raises
    ------
    InvalidInputError : an orbit that is not certified; parameters that `fly_pushes` refuses.
    """
    why_not = ""
    try:
        flown = fly_pushes(orbit, **asked)
    except InvalidInputError as error:
        flown = fly_pushes(orbit, delay=None, **asked)  # refuses what does not concern the feedback
        why_not = first_line(error)
    return scene([("", orbit.dataset)], flown)["pushes"], why_not


def pushes_of(orbit: Orbit) -> list[dict[str, Any]]:
    """Return flights through gusts of 1 m/s from below and from behind, small enough for a page with many animals.

    They last twelve beats, or until the animal is lost, without and with feedback. If no feedback holds the orbit,
    there are only those without. An orbit that is not certified has none.

    Parameters
    ----------
    orbit : the flight that meets the gusts.
    """
    if orbit.status is not Status.CONVERGED:
        return []
    pushes, _ = flown_through_gusts(orbit, beats=BEATS, directions=DIRECTIONS, sizes=SIZES)
    return thinned_pushes(pushes)
