"""How many random gusts an orbit survives, with and without feedback: `survey_gusts`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, Report, Reported
from wingbeat.aero.winds import CosineGust
from wingbeat.plots.draw_stability import survey_page
from wingbeat.results.orbit import Orbit
from wingbeat.stability.feedback import Feedback, feedback
from wingbeat.stability.feedback_report import survey_report
from wingbeat.stability.many_flights import simulate_many
from wingbeat.stability.many_options import DEFAULTS, ManyOptions
from wingbeat.stability.segment_feedback import SegmentFeedback

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

# Shortest and longest gust, and the time in which it may begin [beats].
_DURATION = (1.0, 8.0)
_BEGIN = 1.0
MOST_FLIGHTS = 100_000


@dataclass(frozen=True)
class GustSurvey(Reported):
    """Which of many random gusts were survived; made by `survey_gusts`.

    Attributes
    ----------
    size : largest velocity of each gust [m/s], shape (flights,).
    direction : into which it blows, from forward to up [rad], shape (flights,).
    start, duration : time at which it begins, and from its begin to its end [s], shape (flights,).
    survived : by the name of the feedback, shape (flights,) each.
    largest_pitch : largest deviation of the body pitch [rad], likewise.
    beats : of each flight.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> found = wb.survey_gusts(orbit, {"open": None, "held": wb.feedback(orbit)}, flights=20, size=3.0, seed=1)
    >>> found.share("held"), found.size.shape
    (1.0, (20,))
    """

    size: np.ndarray
    direction: np.ndarray
    start: np.ndarray
    duration: np.ndarray
    survived: dict[str, np.ndarray]
    largest_pitch: dict[str, np.ndarray]
    beats: int

    def share(self, name: str) -> float:
        """Return the share of gusts that were survived.

        Parameters
        ----------
        name : of the feedback.
        """
        return float(self.survived[name].mean())

    def by_size(self, name: str, bins: int = 10) -> tuple[np.ndarray, np.ndarray]:
        """Return the edges of equal bins of the gusts' size [m/s], and the share survived in each.

        Parameters
        ----------
        name : of the feedback.
        bins : number of bins.
        """
        return _shares(self.size, self.survived[name], np.linspace(0.0, float(self.size.max()), bins + 1))

    def by_direction(self, name: str, bins: int = 12) -> tuple[np.ndarray, np.ndarray]:
        """Return the edges of equal bins of the direction from 0 to 2 pi [rad], and the share survived in each.

        Parameters
        ----------
        name : of the feedback.
        bins : number of bins.
        """
        return _shares(self.direction, self.survived[name], np.linspace(0.0, 2 * math.pi, bins + 1))

    def _report(self) -> Report:
        return survey_report(self.record())

    def plot(self) -> Figure:
        """Return a figure of the share of gusts survived, by their size and by their direction."""
        return survey_page(self)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each gust: size [m/s], direction [rad], start and duration [s], then how it ended.

        For each feedback there are two more columns: ``survived.NAME`` and ``largest_pitch.NAME`` [rad].
        """
        import pandas as pd

        gust = {name: getattr(self, name) for name in ("size", "direction", "start", "duration")}
        for kind in ("survived", "largest_pitch"):
            gust |= {f"{kind}.{name}": values for name, values in getattr(self, kind).items()}
        return pd.DataFrame(gust)

    def record(self) -> dict[str, Any]:
        """Return the shares as a JSON-able dictionary in SI units and radians; an empty bin is None."""
        return {
            "flights": len(self.size),
            "beats": self.beats,
            "largest_gust": float(self.size.max()),
            "survived": {name: self.share(name) for name in self.survived},
            "by_size": {name: _record(*self.by_size(name)) for name in self.survived},
            "by_direction": {name: _record(*self.by_direction(name)) for name in self.survived},
        }


def _shares(values: np.ndarray, survived: np.ndarray, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    count, _ = np.histogram(values, edges)
    alive, _ = np.histogram(values[survived], edges)
    return edges, np.where(count > 0, alive / np.maximum(count, 1), np.nan)


def _record(edges: np.ndarray, shares: np.ndarray) -> dict[str, list[float | None]]:
    return {
        "edges": edges.tolist(),
        "shares": [share if math.isfinite(share) else None for share in shares.tolist()],
    }


def survey_gusts(
    orbit: Orbit,
    feedbacks: Mapping[str, Feedback | SegmentFeedback | None] | None = None,
    flights: int = 1000,
    *,
    size: float = 5.0,
    beats: int = 30,
    late: int = 0,
    noise: Mapping[str, float] | None = None,
    seed: int = 0,
    options: ManyOptions = DEFAULTS,
) -> GustSurvey:
    """Fly an orbit through random gusts, with each of several feedbacks through the same ones.

    Parameters
    ----------
    orbit : a certified orbit.
    feedbacks : of this orbit, by names, from `feedback` or `feedback_in_beat`; None flies without feedback.
        Default: without feedback, with that of `feedback`, and with that for one beat of delay.
    flights : number of gusts.
    size : of the largest gust [m/s].
    beats : number of wingbeats of a flight.
    late, noise : of all feedbacks, as in `simulate_many` [m, rad, m/s, rad/s].
    seed : of the random numbers.
    options : of `simulate_many`; they say when a flight is lost.

    Raises
    ------
    InvalidInputError : a number of flights that is not from 1 to 100000, a size that is not positive, and what
        `simulate_many` refuses.

    A gust is a `CosineGust`. Its size is uniform from 0 to `size`, its direction uniform around the circle, its
    duration uniform from 1 to 8 beats, and it begins uniformly within the first beat.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> found = wb.survey_gusts(orbit, {"open": None, "held": wb.feedback(orbit)}, flights=20, size=3.0, seed=1)
    >>> found.share("held") > found.share("open")
    True
    """
    faults = FaultList()
    faults.whole("flights", flights, 1, MOST_FLIGHTS)
    faults.number("size", size, above=0.0, unit="m/s")
    faults.whole("seed", seed, 0, 2**31)
    if feedbacks is not None and (not isinstance(feedbacks, Mapping) or not feedbacks):
        faults.add("feedbacks", feedbacks, "must be feedbacks by name", "for example {'held': wb.feedback(orbit)}")
    faults.raise_if_any()
    if feedbacks is None:
        feedbacks = {
            "no feedback": None,
            "feedback": feedback(orbit),
            "feedback, one beat late": feedback(orbit, delay=1),
        }
    random, period = np.random.default_rng(seed), 1.0 / orbit.wingbeat.frequency
    sizes, turns, starts, lengths = random.random((4, flights))
    sizes, turns, starts = size * sizes, 2 * math.pi * turns, _BEGIN * period * starts
    lengths = period * (_DURATION[0] + (_DURATION[1] - _DURATION[0]) * lengths)
    gusts = [
        CosineGust(*numbers)
        for numbers in zip(
            (sizes * np.cos(turns)).tolist(),
            (sizes * np.sin(turns)).tolist(),
            starts.tolist(),
            lengths.tolist(),
            strict=True,
        )
    ]
    asked: dict[str, Any] = {"late": late, "noise": noise, "seed": seed, "options": options}
    flown = {name: simulate_many(orbit, gusts, beats, feedback=held, **asked) for name, held in feedbacks.items()}
    survived = {name: found.survived for name, found in flown.items()}
    return GustSurvey(
        sizes, turns, starts, lengths, survived, {n: found.largest_pitch for n, found in flown.items()}, beats
    )
