"""The families of wingbeats in which the solver starts."""

from __future__ import annotations

import math
from typing import NamedTuple

# Multiple of the stock frequency. With multiples from 2 to 4, one start found an orbit for every pigeon and nearly
# every bat varied by +-30 %. With 1, a third of the bats' starts diverged, and took three times the flights.
_BRISK = 2.5


class StartFamily(NamedTuple):
    """A family of wingbeats: the changes that its start makes to the species' stock wingbeat.

    Parameters
    ----------
    flap_mean : offset of the mean flap angle from the middle of its bounds, as a share of half its range; default
        the stock wingbeat's value.
    pitch_mean, pitch_amplitude : values of the start; default those of the stock wingbeat [rad].
    flap_amplitude, frequency : multiples of those of the stock wingbeat.
    nose_up : nose-up rotation of the body from the body pitch at which the stroke plane is upright [rad].

    >>> import wingbeat as wb
    >>> fast = wb.StartFamily(frequency=4.0)
    >>> search = wb.SearchOptions(start_families=(fast, *wb.SearchOptions().start_families))
    >>> options = wb.SolverOptions(search=search)  # pass them on: wb.solve_orbit(problem, options=options)
    >>> len(options.search.start_families)
    7
    """

    flap_mean: float | None = None
    pitch_mean: float | None = None
    pitch_amplitude: float | None = None
    flap_amplitude: float = 1.0
    frequency: float = _BRISK
    nose_up: float = 0.1


_QUIET, _PITCHING, _STEEP = math.radians(3.0), math.radians(15.0), math.radians(30.0)
# Up to 108 starts were tried for each family, on 110 vehicles varied by +-40 %; these are the best. A wide and slow
# beat leads in 68 % of the cases to wings that hardly pitch and beat below the body; a fast beat leads to
# such wings in 55 %. For some bats, wide beats above a body whose nose is down are 30 % slower than any other.
START_FAMILIES = (
    StartFamily(),
    StartFamily(-0.8, 0.0, _QUIET, flap_amplitude=1.3, frequency=1.0, nose_up=0.35),
    StartFamily(0.8, 0.0, _QUIET),
    StartFamily(-0.8, None, _PITCHING),
    StartFamily(None, 0.0, _QUIET, frequency=1.0),
    StartFamily(0.4, 0.3, _STEEP, flap_amplitude=1.3, frequency=1.5, nose_up=-0.6),
)
