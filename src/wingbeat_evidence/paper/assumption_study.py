"""The claims about flight, judged under many sets of assumptions. Each piece of the sample is a few studies."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from wingbeat.animal.species.making import load_species
from wingbeat.results.orbit import Orbit
from wingbeat.studies.engine import Engine
from wingbeat.studies.stopping import Stop
from wingbeat.studies.study import Study, plan_study
from wingbeat_evidence.paper.assumptions import TRIMS, Values, changes_under, free_under
from wingbeat_evidence.paper.claim import FlightClaim
from wingbeat_evidence.paper.flight_claim_list import flight_claim_list
from wingbeat_evidence.paper.treatments import MODELS, Case

# The speeds that the claims need [m/s]. Each solution is a start for the next speed; slow flight is the hardest.
SPEEDS = {"pigeon": (16.0, 12.0, 10.0), "bat": (12.0, 10.0, 8.0, 5.0)}
# Orbits that one set needs.
ORBITS = len(MODELS) * sum(len(speeds) for speeds in SPEEDS.values())
# Claims left out: identities, which hold in every set; claims that need many starts; claims with the same number as
# another claim.
_LEFT_OUT = {
    "closed-loops",
    "open-loop",
    "printed-sign",
    "stable",
    "least-frequency",
    "force-balance",
    "differentiable",
    "few-degrees",
}
# Starts of each orbit, one of them from the solution at the previous speed, and how reliable they are. Of the
# same 103 orbits, six starts missed 10 and gave too high a frequency for 4, at 1.4 times the cost.
STARTS = 4
SURENESS = (
    f"To check the starts, we solved 12 sets with 20 starts, which found 103 orbits. With {STARTS} starts, 11 of "
    "these orbits are missed, and 2 have a frequency more than 0.5 % too high."
)
_SET = "set"


@dataclass(frozen=True)
class Judged:
    """Sets of assumptions and what they give.

    ``numbers`` and ``holds`` have shape (sets, claims). ``holds`` is 0 or 1. Both are NaN where a claim cannot be
    tested. ``flown`` counts the certified orbits of each set.
    """

    sets: tuple[Values, ...]
    claims: tuple[FlightClaim, ...]
    numbers: np.ndarray
    holds: np.ndarray
    flown: np.ndarray


class Group(NamedTuple):
    """Sets of a piece with the same free mean angles: their indices, and their studies by animal and model."""

    places: list[int]
    studies: dict[tuple[str, str], Study]


def study_claims() -> tuple[FlightClaim, ...]:
    """Return the claims that depend on assumptions."""
    return tuple(claim for claim in flight_claim_list() if claim.id not in _LEFT_OUT)


def plan_piece(sets: list[Values], folder: Path) -> list[Group]:
    """Return the studies that solve the sets, with their stores in a folder.

    All sets of a study have the same free parameters.
    """
    groups = []
    for trims in TRIMS:
        places = [i for i, values in enumerate(sets) if values["trims"] == trims]
        if places:
            here = [sets[i] for i in places]
            series = [(animal, model) for animal in SPEEDS for model in MODELS]
            groups.append(Group(places, {key: _planned(here, *key, folder) for key in series}))
    return groups


def _planned(sets: list[Values], animal: str, model: str, folder: Path) -> Study:
    species, trims = load_species(animal), str(sets[0]["trims"])
    rows = [changes_under(values, species, model) for values in sets]
    vary: dict[str, Any] = {path: {"list": [row[path] for row in rows]} for path in rows[0]}
    return plan_study(
        species=animal,
        aero=model,
        free=free_under(trims),
        vary=vary | {"speed": {"grid": list(SPEEDS[animal])}},
        chain="speed",
        starts=STARTS,
        most_starts=STARTS,
        explain=False,
        store=folder / f"{animal}-{model}-{trims}.study.sqlite",
    )


def fly_piece(
    groups: list[Group],
    engine: Callable[[], Engine],
    stop: Stop,
    progress: Callable[[int], None] | None = None,
) -> None:
    """Solve the orbits without a result, study by study, until all are done or a stop is requested.

    Parameters
    ----------
    groups : groups from `plan_piece`.
    engine : makes the engine that runs a study.
    stop : checked between batches.
    progress : called with the number of orbits of the piece that have a result.
    """
    before = 0
    for planned in (one for group in groups for one in group.studies.values()):
        if stop.level:
            return
        done = before

        def told(tally: Any, done: int = done) -> None:
            if progress is not None:
                progress(done + tally.done)

        before += planned.run_on(engine(), stop, retry_failed=True, progress=told).total


def judge_piece(sets: list[Values], groups: list[Group]) -> Judged:
    """Judge the claims under each set of a solved piece, with the orbits of one set in memory at a time."""
    claims = study_claims()
    numbers, holds = (np.full((len(sets), len(claims)), np.nan) for _ in range(2))
    flown = np.zeros(len(sets), dtype=int)
    for group in groups:
        for place, orbits in zip(group.places, _sets_of_orbits(group), strict=True):
            for k, claim in enumerate(claims):
                (finding,) = claim.judge(orbits, [_SET]).findings
                if finding.number is not None and finding.holds is not None:
                    numbers[place, k], holds[place, k] = finding.number, finding.holds
            flown[place] = sum(orbit.status.value == "converged" for orbit in orbits.values())
    return Judged(tuple(sets), claims, numbers, holds, flown)


def _sets_of_orbits(group: Group) -> Iterator[dict[Case, Orbit]]:
    """Yield the orbits of each set of a group."""
    series = {key: one.orbits() for key, one in group.studies.items()}
    for _ in group.places:
        orbits = {}
        for (animal, model), row in series.items():
            for told, orbit in islice(row, len(SPEEDS[animal])):
                if orbit is not None:
                    orbits[Case(_SET, animal, model, told["speed"])] = orbit
        yield orbits


def seconds_of(groups: list[Group]) -> float:
    """Return the time that the orbits of a piece took on one core [s]."""
    return sum(one.status().seconds for group in groups for one in group.studies.values())
