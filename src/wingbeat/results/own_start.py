"""A start of the user's own for `solve_orbit`, made from an orbit, a wingbeat, a film or numbers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from wingbeat._base import NOMENCLATURE, FaultList, for_people, suggest
from wingbeat.animal.kinematics import ANGLES, FREE_NAMES, Wingbeat, in_use, parameter
from wingbeat.experiment.body_path import fit_body_path
from wingbeat.experiment.film_fit import FilmedBeat
from wingbeat.mechanics.flights import state_of
from wingbeat.orbits.flight.period import PITCH_STATE
from wingbeat.orbits.options import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.filmed import filmed_species
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.starts import OwnStart, structured_starts

# Fixed parameters that differ by less are the same for a reader [rad, or a ratio].
_ALIKE = 1e-3
_START_FIX = "give an orbit, a wingbeat, (wingbeat, state), a film's fit, or numbers such as {'frequency': 8.0}"


def own_start(problem: OrbitProblem, given: Any, kind: str = "", options: SolverOptions = DEFAULTS) -> OwnStart:
    """Return the unknowns of a problem in a wingbeat, a wingbeat and state, a film's fit, or a table of numbers.

    What `given` lacks is taken from the first usual start; what the problem holds fixed stays as it is. Each of
    these is a note. `InvalidInputError` if it is none of these, or holds names or numbers that cannot be used.
    """
    unknowns, usual = problem.unknowns(), structured_starts(problem, options.search)[0]
    faults, stock, notes = FaultList(), problem.species.wingbeat, []
    values: dict[str, float] = {}
    wingbeat, state = given if isinstance(given, tuple | list) and len(given) == 2 else (given, None)
    if isinstance(wingbeat, FilmedBeat):
        kind, beat = "film", wingbeat
        wingbeat = filmed_species(beat, problem.species).wingbeat
        notes += beat.warnings
        if unseen := [name for name in problem.free if name not in beat.held]:
            notes.append(f"not filmed, so the species' own: {', '.join(unseen)}")
        if state is not None:
            notes.append("the state is the one given with the film")
        elif beat.film.shows_body:
            usually = {"body_x_m": ("u", problem.speed), "body_z_m": ("w", problem.climb)}
            usually["body_pitch_deg"] = ("body_pitch", float(usual[0]))
            lacking = {name: own for column, (name, own) in usually.items() if column not in beat.film.columns}
            state = fit_body_path(beat, **lacking).states(np.zeros(1))[0]
            if lacking:
                notes.append(f"the body's {', '.join(lacking)} was not filmed, so taken from the problem")
    if isinstance(wingbeat, Wingbeat):
        kind = kind or "wingbeat"
        values = {name: float(parameter(wingbeat, name)) for name in problem.free}
        fixed = [name for name in FREE_NAMES if name not in problem.free]
        pairs = [(name, float(parameter(wingbeat, name)), float(parameter(stock, name))) for name in fixed]
        pairs = [
            (n, a, b) for n, a, b in pairs if abs(a - b) > _ALIKE and (in_use(wingbeat, n) or in_use(stock, n))
        ]
        pairs.sort(key=lambda pair: -abs(pair[1] - pair[2]))
        if pairs:
            said = ", ".join(f"{n} {_shown(n, b)} (the start has {_shown(n, a)})" for n, a, b in pairs[:4])
            more = f" and {len(pairs) - 4} more" if len(pairs) > 4 else ""
            notes.append(f"not free, so the problem's own value holds: {said}{more}")
        if state is not None:
            values |= dict(zip(PITCH_STATE, map(float, state_of(state)[2:]), strict=True))
    elif isinstance(given, Mapping):
        kind = kind or "numbers"
        for name, value in given.items():
            if name not in unknowns.names:
                fix = suggest(
                    str(name), unknowns.names, otherwise=f"this problem seeks {', '.join(unknowns.names)}"
                )
                faults.add(f"start.{name}", value, "is no unknown of this problem", fix)
            elif (faults.angle if name in (*ANGLES, "body_pitch") else faults.number)(f"start.{name}", value):
                values[name] = float(value)
    else:
        faults.add("start", type(given).__name__, "is nothing that a search can start from", _START_FIX)
    faults.raise_if_any()
    if added := [name for name in unknowns.names if name not in values]:
        notes.append(f"not given, so taken from the first usual start: {', '.join(added)}")
    whole = np.array([values.get(name, own) for name, own in zip(unknowns.names, usual, strict=True)])
    inside = np.clip(whole, unknowns.lower, unknowns.upper)
    for name, value, begun in zip(unknowns.names, whole.tolist(), inside.tolist(), strict=True):
        if value != begun:
            notes.append(
                f"{name} {_shown(name, value)} is outside its bounds: the search starts at {_shown(name, begun)}"
            )
    return OwnStart(kind, dict(zip(unknowns.names, inside.tolist(), strict=True)), tuple(notes))


def _shown(name: str, value: float) -> str:
    factor, unit = for_people(NOMENCLATURE[name].unit) if name in NOMENCLATURE else (1.0, "")
    return f"{value * factor:.4g} {unit}".rstrip()
