"""Named sets of assumptions for what the paper leaves open, and the orbits for its figures and claims."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from wingbeat._workers.pool import in_processes
from wingbeat.aero import BladeElement, load_coefficients
from wingbeat.animal.species.making import load_species
from wingbeat.orbits.batch import find_series
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.solve import Progress, Settings
from wingbeat.results.orbit import Orbit

ANIMALS = ("pigeon", "bat")
MODELS = ("su-fan", "dickinson")
# The speed of the paper's sample orbit, forces, power and body pitch [m/s].
SAMPLE_SPEED = 10.0
SPEEDS = tuple(float(speed) for speed in range(4, 21))
QUICK_SPEEDS = (4.0, 5.0, 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 20.0)


@dataclass(frozen=True)
class Treatment:
    """One set of assumptions where the paper is silent.

    Parameters
    ----------
    name : name in file names and tables.
    words : description for readers.
    extension : how the coefficients are continued to negative angles of attack (`wingbeat.aero.EXTENSIONS`).
    uniform_wings : whether the wing mass is uniform along the span, not distributed as in dissected wings.
    flap_amplitude_deg : largest flap amplitude allowed [deg]; None takes the bound of the species file.
    taper : tip chord divided by root chord, at the same mean chord; 1 is the paper's rectangle.
    leaf : whether the wing is leaf-shaped, with the rectangle's span, area and second moment of area: `leaf_chord`.
    """

    name: str
    words: str
    extension: str
    uniform_wings: bool = False
    flap_amplitude_deg: float | None = None
    taper: float = 1.0
    leaf: bool = False


_HEAVY = "but the flap amplitude is at most 45 deg and the wing mass is uniform along the span"
TREATMENTS = (
    Treatment(
        "mirrored",
        "coefficients mirrored at negative angles; wing mass as in the species file",
        "mirrored",
    ),
    Treatment(
        "signed",
        "at negative angles the printed formulas give C_D, and C_L but for Su-Fan's, whose exponential grows "
        "without bound there; Su-Fan's C_L is mirrored here too",
        "signed",
    ),
    Treatment("mirrored-heavy", f"as mirrored, {_HEAVY}", "mirrored", True, 45.0),
    Treatment("signed-heavy", f"as signed, {_HEAVY}", "signed", True, 45.0),
    Treatment(
        "mirrored-tapered", "as mirrored, but with wings of the same area tapered 3 to 1", "mirrored", taper=1 / 3
    ),
    Treatment(
        "mirrored-leaf",
        "as mirrored, but with leaf-shaped wings of the same area and second moment of area about the shoulder",
        "mirrored",
        leaf=True,
    ),
)
DEFAULT = TREATMENTS[0].name
# The treatments that the figures show.
DRAWN = TREATMENTS[:2]
PLANFORMS = tuple(treatment.name for treatment in TREATMENTS if treatment.leaf or treatment.taper != 1.0)
# Number of stations of the wings that are not rectangles; root chord of the leaf divided by that of the rectangle.
_STATIONS, _ROOT = 11, 0.25


@dataclass(frozen=True, order=True)
class Case:
    """One orbit to solve: its treatment, animal, coefficient model and speed [m/s]."""

    treatment: str
    animal: str
    model: str
    speed: float

    @property
    def name(self) -> str:
        """Name of its record file, without the ending."""
        return f"{self.treatment}-{self.animal}-{self.model}-{self.speed:g}"


Orbits = Mapping[Case, Orbit]


def all_cases(speeds: Iterable[float], treatments: Iterable[Treatment] = TREATMENTS) -> list[Case]:
    """Return the cases at these speeds: every treatment, animal and model."""
    return [
        Case(treatment.name, animal, model, float(speed))
        for treatment in treatments
        for animal in ANIMALS
        for model in MODELS
        for speed in speeds
    ]


def tapered_chord(chord: float, taper: float) -> tuple[float, ...]:
    """Return the chords of a tapered wing [m], at as many stations as a leaf, so that both use one program.

    Parameters
    ----------
    chord : mean chord [m].
    taper : tip chord divided by root chord.
    """
    root = 2.0 * chord / (1.0 + taper)
    return tuple(np.linspace(root, taper * root, _STATIONS).tolist())


def leaf_chord(chord: float) -> tuple[float, ...]:
    """Return the chords of a leaf-shaped wing from root to tip [m]: widest past mid-span, narrow at both ends.

    The chord is that of the rectangle plus a parabola. This changes neither the area nor the second moment of area
    about the shoulder, ``int s^2 c ds``. Between the stations the chord is linear.
    """
    eta = np.linspace(0.0, 1.0, _STATIONS)
    # Simpson's rule is exact here: between stations the integrands are at most cubic.
    fine = np.linspace(0.0, 1.0, 2 * (_STATIONS - 1) + 1)
    weight = np.where(np.arange(fine.size) % 2, 4.0, 2.0)
    weight[[0, -1]] = 1.0
    basis = np.array([np.interp(fine, eta, power) for power in (np.ones_like(eta), eta, eta**2)])
    area, second = basis @ weight, basis @ (weight * fine**2)
    parabola = np.linalg.svd(np.stack([area, second]))[2][-1] @ np.array([np.ones_like(eta), eta, eta**2])
    return tuple((chord * (1.0 + (_ROOT - 1.0) * parabola / parabola[0])).tolist())


def problem_of(case: Case) -> OrbitProblem:
    """Return the orbit problem of a case: level flight at the lowest frequency."""
    treatment = next(t for t in TREATMENTS if t.name == case.treatment)
    species = load_species(case.animal)
    if treatment.uniform_wings:
        species = species.with_values({"wing.mass_exponent": 0.0})
    if treatment.taper != 1:
        species = species.with_values(
            {"wing.chord": tapered_chord(species.vehicle.wing.mean_chord, treatment.taper)}
        )
    if treatment.leaf:
        species = species.with_values({"wing.chord": leaf_chord(species.vehicle.wing.mean_chord)})
    aero = BladeElement(load_coefficients(case.model, treatment.extension))
    problem = OrbitProblem(species, speed=case.speed, aero=aero)
    if treatment.flap_amplitude_deg is None:
        return problem
    lower, upper = problem.bounds["flap_amplitude"]
    narrowed = {"flap_amplitude": (lower, min(upper, math.radians(treatment.flap_amplitude_deg)))}
    return dataclasses.replace(problem, bounds={**problem.bounds, **narrowed})


def chain(treatment: str, animal: str, speeds: Iterable[float]) -> list[Case]:
    """Return the cases of an animal, ordered so that neighbours are similar.

    The first coefficient model comes first, at increasing speeds. The second follows at decreasing speeds.
    """
    up = sorted(speeds)
    rows = zip(MODELS, (up, up[::-1]), strict=True)
    return [Case(treatment, animal, model, speed) for model, row in rows for speed in row]


def _solve_row(row: list[Case], starts: int) -> list[Solution]:
    return find_series([problem_of(case) for case in row], Settings(starts, advise=False))


def solve_cases(
    cases: Iterable[Case], starts: int, processes: int = 1, progress: Progress | None = None
) -> dict[Case, Orbit]:
    """Solve and certify the orbits of the cases, and return all of them, failed ones too.

    The cases of one animal under one treatment are solved as a series, so that each also starts from the solutions
    of its neighbours.

    Parameters
    ----------
    cases : the orbits to solve.
    starts : starts of each case, not counting those from the solutions of its neighbours.
    processes : Python processes that share the series.
    progress : called with (series done, all series).
    """
    wanted = sorted(set(cases))
    rows = []
    for treatment, animal in sorted({(case.treatment, case.animal) for case in wanted}):
        speeds = {case.speed for case in wanted if (case.treatment, case.animal) == (treatment, animal)}
        rows.append([case for case in chain(treatment, animal, speeds) if case in wanted])
    solved = in_processes(functools.partial(_solve_row, starts=starts), rows, processes, progress)
    found = {
        case: Orbit.of(solution, starts)
        for row, solutions in zip(rows, solved, strict=True)
        for case, solution in zip(row, solutions, strict=True)
    }
    return {case: found[case] for case in wanted}


def certified(orbits: Orbits, treatment: str, animal: str, model: str) -> dict[float, Orbit]:
    """Return the certified orbits of a series by speed."""
    return {
        case.speed: orbit
        for case, orbit in orbits.items()
        if (case.treatment, case.animal, case.model) == (treatment, animal, model)
        and orbit.status.value == "converged"
    }
