"""The number that changes along a branch of orbits: speed, or the share of terms of the air loads."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import NamedTuple

from wingbeat.orbits.options.continuation import ContinuationOptions
from wingbeat.orbits.problem.problem import OrbitProblem


class Along(NamedTuple):
    """A number of a problem along which orbits are continued.

    Attributes
    ----------
    name, unit : of the number.
    of : function that returns the number of a problem.
    moved : function that returns a problem with another value of the number.
    steps : first and smallest step of the continuation, from its options.
    """

    name: str
    unit: str
    of: Callable[[OrbitProblem], float]
    moved: Callable[[OrbitProblem, float], OrbitProblem]
    steps: Callable[[ContinuationOptions], tuple[float, float]]


def with_share(problem: OrbitProblem, share: float) -> OrbitProblem:
    """Return a problem with another share of the terms of its air loads.

    Parameters
    ----------
    problem : the problem.
    share : 0 for none, 1 for all of each term.

    Raises
    ------
    InvalidInputError : a share outside 0 to 1.
    """
    return dataclasses.replace(problem, aero=dataclasses.replace(problem.aero, share=share))


SPEED = Along(
    "speed",
    "m/s",
    lambda problem: problem.speed,
    lambda problem, speed: dataclasses.replace(problem, speed=speed),
    lambda options: (options.first_speed_step, options.least_speed_step),
)
SHARE = Along(
    "share",
    "",
    lambda problem: problem.aero.share,
    with_share,
    lambda options: (options.first_share_step, options.least_share_step),
)
