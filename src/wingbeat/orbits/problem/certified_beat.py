"""The time series of a certified flight."""

from __future__ import annotations

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.orbits.flight.beat import Beat, flown_beat
from wingbeat.orbits.flight.certify import Certificate
from wingbeat.orbits.problem.problem import OrbitProblem


def certified_beat(problem: OrbitProblem, wingbeat: Wingbeat, flown: Certificate) -> Beat:
    """Return the time series of a flight of the certifier, with the vehicle's muscles, motor and springs.

    Parameters
    ----------
    problem, wingbeat, flown : the problem, and the flight with this wingbeat.
    """
    velocity = problem.speed, problem.climb
    beat = flown_beat(problem.model, wingbeat, flown.phase, flown.states[:, 2:], velocity)
    return beat._replace(drive=problem.vehicle.drive)
