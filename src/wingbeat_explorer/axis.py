"""What a lattice runs along: the speed, or another number, such as the stiffness of a robot's pitch hinges."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from wingbeat._base import FaultList, find, plain
from wingbeat.animal.species.building import settable
from wingbeat.animal.species.numbers import path_of
from wingbeat.animal.species.species import Species
from wingbeat.models import model_of
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat_explorer.models import EXPLORER_MODELS


class Axis(NamedTuple):
    """What changes from one flight of a lattice to the next.

    Attributes
    ----------
    name : ``"speed"``, or the path of a number as in ``--set``.
    unit : of its values.
    label : how the page calls it.
    """

    name: str
    unit: str
    label: str

    def value_of(self, problem: OrbitProblem) -> float:
        """Return where a problem lies along the axis, in its unit.

        Parameters
        ----------
        problem : from `problems_along`.
        """
        if self == SPEED:
            return problem.speed
        key = settable(self.name, 0.0, FaultList())
        assert key is not None, "problems_along has checked it"
        value: Any = problem.species.numbers[key.path].value
        return float(f"{math.degrees(value):.12g}") if self.name.endswith("_deg") else value


SPEED = Axis("speed", "m/s", "speed")


def problems_along(
    species: Species, model: str, values: Sequence[float], along: str = SPEED.name, speed: float | None = None
) -> tuple[Axis, list[OrbitProblem]]:
    """Return the axis of a lattice and its problems, one for each value.

    Parameters
    ----------
    species : the animal or robot.
    model : one of `wingbeat_explorer.LATTICE_MODELS`.
    values : increasing, speeds [m/s] or values of the number that changes.
    along : ``"speed"``, or the path of a number as `Species.with_values` takes it.
    speed : of all flights [m/s], where another number changes.

    Raises
    ------
    InvalidInputError : no value, or values that do not increase; an unknown model or path; a path of no single
        number, or of one that the model searches for; no speed, or one speed too many; a value out of range.

    >>> import wingbeat as wb
    >>> axis, (soft, stiff) = problems_along(
    ...     wb.load_species("robofalcon2"), "animal", [1.4, 2.8], "pitch_hinge.stiffness", 8.0
    ... )
    >>> axis.label, axis.unit, soft.speed, axis.value_of(stiff)
    ('stiffness of the pitch hinges', 'N m/rad', 8.0, 2.8)
    """
    faults, moves = FaultList(), along == SPEED.name
    faults.choice("model", model, tuple(EXPLORER_MODELS))
    if not len(values) or any(later <= value for value, later in itertools.pairwise(values)):
        rule = "must be at least one, and increase"
        faults.add("speeds" if moves else "values", list(values), rule, "for example 8, 10, 12")
    if moves and speed is not None:
        faults.add("speed", speed, "is given beside speeds that change", "leave it out, or name another number")
    elif not moves and speed is None:
        faults.add("speed", speed, f"is missing: only {along} changes", "give the speed of all flights, such as 8")
    key = None if moves else settable(along, float(values[0]) if len(values) else 0.0, faults)
    if key is not None and key.shape != "number":
        faults.add("along", along, "is no single number", "choose a number such as pitch_hinge.stiffness")
    faults.raise_if_any()
    meant = EXPLORER_MODELS[model]
    if key is None:
        made = model_of(meant.model, species)
        return SPEED, [made.problem(species, float(value), **meant.changes) for value in values]
    each = [species.with_values({along: float(value)}) for value in values]
    problems = [model_of(meant.model, one).problem(one, float(speed or 0.0), **meant.changes) for one in each]
    if key.path in map(path_of, problems[0].free):
        faults.add("along", along, f"is free: the model {model} searches for it", "choose one that stays fixed")
    faults.raise_if_any()
    term = find(along)
    assert term is not None
    return Axis(along, plain(term.unit), term.label), problems
