"""The flight that the page opens with: solved beforehand, so that an animal flies before anything is solved.

``python -m wingbeat_explorer.app.first`` solves it again and writes the file. Run it when numbers or scenes change.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wingbeat._base import write_atomically
from wingbeat._workers.process import Context
from wingbeat.animal.species.making import load_species
from wingbeat_explorer.app.links import from_plain, to_plain
from wingbeat_explorer.app.scenario import Scenario

FILE = Path(__file__).with_name("first.json")


@dataclass(frozen=True)
class First:
    """The answer and the curve of the scenario of an empty page.

    Attributes
    ----------
    scenario : that of an empty page: a live pigeon within its plausible ranges.
    answer : as a worker returns it.
    points : of the curve, as a worker returns them.
    """

    scenario: Scenario
    answer: dict[str, Any]
    points: list[dict[str, Any]]


def read_first() -> First:
    """Return what was solved beforehand."""
    found = json.loads(FILE.read_text("utf-8"))
    return First(from_plain(found["scenario"]), found["answer"], found["points"])


def first_scenario() -> Scenario:
    """Return the scenario of an empty page."""
    from wingbeat_explorer.app.controls import choices_of  # here, because what reads the file needs no form

    choices = choices_of("animal", load_species("pigeon"))
    # At 8 m/s every wingbeat needs more fibres than the muscle has; at 16 m/s the Strouhal number is too small.
    return Scenario(speed=12.0, model="animal", within_plausible=True, sweep=(10.5, 14.0, 0.5), **choices)


def solve_first() -> dict[str, Any]:
    """Solve the scenario of an empty page and its curve, each speed from every start and from its neighbour."""
    from wingbeat_explorer.app.jobs import (
        do,  # here, because a server that only reads the file solves nothing itself
    )

    context, scenario = Context(lambda told: None, lambda: False), first_scenario()
    answer = do({"do": "orbit", "scenario": to_plain(scenario)}, context)
    # How long it took here is of no use to a visitor.
    answer["seconds"] = answer["solver_seconds"] = answer["record"]["solve_seconds"] = 0.0
    points: list[dict[str, Any]] = []
    for speed in scenario.speeds():
        near = next((point["near"] for point in reversed(points) if point["near"]), None)
        what = {"do": "point", "scenario": to_plain(scenario.at(speed)), "near": near, "whole": True}
        points.append(do(what, context))
    return {"scenario": to_plain(scenario), "answer": answer, "points": points}


if __name__ == "__main__":
    write_atomically(FILE, json.dumps(solve_first(), allow_nan=False).encode())
