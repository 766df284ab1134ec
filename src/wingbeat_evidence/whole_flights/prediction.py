"""Predictions of whole flights: an animal flown at each speed, with the band due to its uncertain numbers."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, Report, Reported
from wingbeat._jax.arrays import jnp
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.species import Species
from wingbeat.models import Model, model_of
from wingbeat.orbits.options import Status
from wingbeat.orbits.problem.quantities import QUANTITIES
from wingbeat.orbits.problem.quantity import Quantity
from wingbeat.orbits.solution import search_near
from wingbeat.orbits.solve import Progress
from wingbeat.orbits.uncertainty import Samples, sample_orbits
from wingbeat.results.orbit import Orbit, solve_orbits
from wingbeat.results.sensitivities import sensitivities
from wingbeat_evidence.whole_flights.measured import COMPARED, MeasuredFlights

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

_AMPLITUDE = Quantity("flap_amplitude_deg", lambda beat: jnp.degrees(beat.flap_amplitude), "deg", 10.0)
# Fewer certified draws give no band.
FEWEST_DRAWS = 10
_BAND = (10.0, 90.0)  # per cent of the certified draws
# A rank correlation with one of some 30 numbers says something from about a hundred draws on: of 12 draws, one of
# them explains half of the variance by chance.
_RANKED = 100
_NAMED = 3  # numbers of the animal that are named for a quantity


@dataclass(frozen=True)
class Flown:
    """A flight at one speed.

    Attributes
    ----------
    speed : [m/s].
    status, message : of the orbit.
    values : quantities of a certified orbit, in the units of the nomenclature; empty without one.
    peak_activation : largest share of the muscle's fibres that the beat uses; None without muscle.
    active_bounds : free parameters that are at a bound.
    frequency_basis : where the frequency comes from: ``"measured"``, ``"law"``, ``"guess"``, ``"given"`` or
        ``"free"``.
    frequency_range : plausible range of the animal's own frequency [Hz]; None if it was not flown at that.
    body_pitch_deg : mean pitch of the body [deg]; None without an orbit.
    low, high : the band of each quantity: 10th and 90th percentile of the certified draws; without draws, over the
        range of the frequency if it was asked for, else empty.
    drawn, certified : number of draws of the animal's numbers, and number of draws that fly.
    due_to : for each quantity, the numbers of the animal that are most correlated with it over the draws, each with
        the square of the rank correlation; empty with fewer than 100 certified draws.
    """

    speed: float
    status: str
    message: str
    values: dict[str, float]
    peak_activation: float | None = None
    active_bounds: tuple[str, ...] = ()
    frequency_basis: str = "free"
    frequency_range: tuple[float, float] | None = None
    body_pitch_deg: float | None = None
    low: dict[str, float] = field(default_factory=dict)
    high: dict[str, float] = field(default_factory=dict)
    drawn: int = 0
    certified: int = 0
    due_to: dict[str, dict[str, float]] = field(default_factory=dict)


@dataclass(frozen=True)
class Prediction(Reported):
    """The flights of an animal at all speeds; made by `predict_flights`.

    Attributes
    ----------
    flights : the measured flights.
    model : name of the model, as in `wb.models`.
    objective : what the wingbeats minimise.
    flown : one flight for each speed, in their order.

    >>> import dataclasses, wingbeat_evidence as evidence
    >>> flights = dataclasses.replace(evidence.read_measured_flights("pigeon"), speeds=(12.0,))
    >>> prediction = evidence.predict_flights(flights, model="paper")
    >>> speeds, frequencies, low, high = prediction.series("frequency")
    >>> speeds.tolist(), frequencies.round(1).tolist()
    ([12.0], [9.5])
    """

    flights: MeasuredFlights
    model: str
    objective: str
    flown: tuple[Flown, ...]

    def series(self, quantity: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return four arrays of shape (K,): speeds [m/s], values, low and high end of the band; NaN if missing.

        Parameters
        ----------
        quantity : one of `COMPARED`.
        """
        rows = [
            (one.speed, *(part.get(quantity, np.nan) for part in (one.values, one.low, one.high)))
            for one in self.flown
        ]
        speeds, values, low, high = np.array(rows).T
        return speeds, values, low, high

    def _report(self) -> Report:
        from wingbeat_evidence.whole_flights.report import (
            prediction_report,  # which compares predictions, and so knows them
        )

        return prediction_report(self)

    def plot(self) -> Figure:
        """Return a figure of the predicted flights and the measured ones."""
        from wingbeat_evidence.whole_flights.figure import (
            flights_page,  # which draws predictions, and so knows them
        )

        return flights_page(self)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each speed; quantities have the names of the nomenclature, behind ``values.``.

        With draws, ``low.`` and ``high.`` hold the ends of their bands. Units are those of the nomenclature.
        """
        import pandas as pd

        return pd.json_normalize([vars(one) for one in self.flown])

    def plain(self) -> dict[str, Any]:
        """Return the prediction without the measurements, as plain values fit for JSON."""
        return {"model": self.model, "objective": self.objective, "flown": [vars(one) for one in self.flown]}

    @classmethod
    def of_plain(cls, flights: MeasuredFlights, plain: dict[str, Any]) -> Prediction:
        """Return the prediction that `plain` described.

        Parameters
        ----------
        flights : the measured flights.
        plain : from `plain`, also by way of JSON.
        """
        pairs = ("active_bounds", "frequency_range")
        rows = [
            row | {name: tuple(row[name]) for name in pairs if row.get(name) is not None} for row in plain["flown"]
        ]
        return cls(flights, plain["model"], plain["objective"], tuple(Flown(**row) for row in rows))

    @property
    def minimum_power_speed(self) -> float | None:
        """Speed of the certified flight with the lowest mean positive power [m/s]; None if none is certified."""
        flown = [one for one in self.flown if one.values]
        best = min(flown, key=lambda one: one.values["positive_power_per_mass"], default=None)
        return None if best is None else best.speed


def predict_flights(
    flights: MeasuredFlights,
    model: str = "animal",
    draws: int = 0,
    seed: int = 0,
    processes: int = 1,
    progress: Progress | None = None,
    frequency_band: bool = False,
) -> Prediction:
    """Fly an animal at the speeds of its measured flights.

    No number is fitted to the measurements. The measurements only say at which speeds to fly. For the band, each
    draw takes random values, within their ranges, for all numbers of the species file and of the laws. Draws stay
    in the orbit's family: a draw counts as not certified if the solver, started from the orbit, finds no flight
    for it.

    Parameters
    ----------
    flights : from `read_measured_flights`.
    model : ``"animal"`` or ``"paper"``.
    draws : number of draws of the animal's numbers at each speed; 0 for no band.
    seed : of starts and draws.
    processes : Python processes that share the draws.
    progress : called with (flights and draws done, flights and draws in all).
    frequency_band : without draws, fly each speed also at both ends of the range of the animal's own frequency,
        with one search from its orbit.

    Raises
    ------
    InvalidInputError : draws neither 0 nor from 10 to 100000; faults of the species file or the model.
    FileError : the species file cannot be read.

    >>> import dataclasses, wingbeat_evidence as evidence
    >>> flights = dataclasses.replace(evidence.read_measured_flights("pigeon"), speeds=(12.0,))
    >>> flown = evidence.predict_flights(flights, model="paper").flown[0]
    >>> flown.status, round(flown.values["frequency"], 1)
    ('converged', 9.5)
    """
    faults = FaultList()
    if draws:
        faults.whole("draws", draws, FEWEST_DRAWS, 100_000, "0 for no band")
    faults.raise_if_any()
    species = load_species(flights.species)
    chosen = model_of(model, species)
    problems = [chosen.problem(species, speed=speed) for speed in flights.speeds]
    total = len(problems) * (1 + draws)

    orbits = solve_orbits(problems, seed=seed, in_order=True, progress=_after(progress, 0, total))
    flown = [
        _flown(orbit, draws, seed, processes, _after(progress, len(problems) + i * draws, total))
        for i, orbit in enumerate(orbits)
    ]
    if frequency_band and not draws:
        flown = [_between_ends(chosen, species, *both) for both in zip(orbits, flown, strict=True)]
    return Prediction(flights, model, problems[0].minimise.name, tuple(flown))


def _after(progress: Progress | None, before: int, total: int) -> Progress | None:
    """Return a function that reports the progress of a part of the work, after `before` of `total` steps."""
    return None if progress is None else lambda done, _: progress(before + done, total)


def _flown(orbit: Orbit, draws: int, seed: int, processes: int, progress: Progress | None) -> Flown:
    about = (orbit.problem.speed, orbit.status.value, orbit.message)
    if orbit.status is not Status.CONVERGED:
        return Flown(*about, {})
    record = orbit.record()
    values = _values(record, orbit.problem.model.vehicle.mass)
    known: dict[str, Any] = {
        "peak_activation": record.get("peak_activation"),
        "active_bounds": tuple(record["active_bounds"]),
        "frequency_basis": orbit.problem.frequency_basis,
        "body_pitch_deg": next(
            (math.degrees(one["value"]) for one in record["plausibility"] if one["name"] == "mean_body_pitch"), None
        ),
    }
    if known["frequency_basis"] not in ("free", "given"):
        known["frequency_range"] = orbit.problem.species.own_frequency(orbit.problem.speed).range
    if draws:
        known |= _band(orbit, _quantities(values), draws, seed, processes, progress)
    return Flown(*about, values, **known)


def _between_ends(model: Model, species: Species, orbit: Orbit, flown: Flown) -> Flown:
    """Return the flight with the band over the range of its frequency; without it if neither end flies."""
    if flown.frequency_range is None:
        return flown
    found = [flown.values]
    for frequency in flown.frequency_range:
        problem = dataclasses.replace(model, frequency=frequency).problem(species, speed=flown.speed)
        near = search_near(problem, orbit.unknowns)
        if near is not None:
            found.append(_values(Orbit.of(near, 1).record(), problem.model.vehicle.mass))
    if len(found) == 1:
        return flown
    ends = {name: [one[name] for one in found] for name in flown.values}
    low, high = ({name: end(values) for name, values in ends.items()} for end in (min, max))
    return dataclasses.replace(flown, low=low, high=high)


def _values(record: dict[str, Any], mass: float) -> dict[str, float]:
    wingbeat = record["wingbeat"]
    own = {
        "frequency": wingbeat["frequency"],
        "flap_amplitude_deg": math.degrees(wingbeat["flap_amplitude"]),
        "positive_power_per_mass": record["mean_positive_power"] / mass,
    }
    return own | {name: record[name] for name in COMPARED if name in record}


def _quantities(values: dict[str, float]) -> list[Quantity]:
    return [_AMPLITUDE if name == _AMPLITUDE.name else QUANTITIES[name] for name in values]


def _band(
    orbit: Orbit, quantities: Sequence[Quantity], draws: int, seed: int, processes: int, progress: Progress | None
) -> dict[str, Any]:
    found = sensitivities(orbit, quantities)
    samples = sample_orbits(
        found.problem,
        found.unknowns,
        found.slopes,
        found.spreads(),
        quantities,
        draws,
        seed,
        processes,
        progress,
        starts=0,
    )
    certified = int(samples.certified.sum())
    told: dict[str, Any] = {"drawn": draws, "certified": certified}
    if certified < FEWEST_DRAWS:
        return told
    low, high = np.percentile(samples.quantities[samples.certified], _BAND, axis=0)
    names = [one.name for one in quantities]
    ranked = names if certified >= _RANKED else []
    return told | {
        "low": dict(zip(names, low.tolist(), strict=True)),
        "high": dict(zip(names, high.tolist(), strict=True)),
        "due_to": {name: _due_to(samples, i) for i, name in enumerate(ranked)},
    }


def _due_to(samples: Samples, column: int) -> dict[str, float]:
    """Return the numbers most correlated with a quantity over the draws, with the squared rank correlation."""
    from scipy.stats import rankdata

    values = rankdata(samples.quantities[samples.certified, column])
    if np.ptp(values) == 0:
        return {}
    drawn = rankdata(samples.deviations[samples.certified], axis=0)
    moved = np.ptp(drawn, axis=0) > 0
    shares = np.zeros(drawn.shape[1])
    shares[moved] = [np.corrcoef(values, row)[0, 1] ** 2 for row in drawn.T[moved]]
    best = np.argsort(-shares, kind="stable")[:_NAMED]
    return {samples.paths[i]: float(shares[i]) for i in best}
