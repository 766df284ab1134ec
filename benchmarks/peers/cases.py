"""What every contestant is asked: the same animals, models, speeds, bounds and starts, all read from wingbeat."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import wingbeat as wb
from wingbeat.orbits.starts import start_point

ANIMALS = ("pigeon", "bat")
MODELS = ("su-fan", "dickinson")
SPEEDS = (6.0, 8.0, 10.0, 12.0, 14.0)


@dataclass(frozen=True)
class Case:
    """One periodic-orbit problem."""

    animal: str
    model: str
    speed: float

    def problem(self) -> wb.OrbitProblem:
        """Return the problem as wingbeat holds it: vehicle, stock wingbeat, bounds, 10 strips."""
        aero = wb.aero.load_coefficients(self.model, "mirrored")
        return wb.OrbitProblem(wb.load_species(self.animal), speed=self.speed, aero=aero)

    def __str__(self) -> str:
        return f"{self.animal} {self.model} {self.speed:g} m/s"


@dataclass(frozen=True)
class Answer:
    """What a contestant hands back: body_pitch, u, w, pitch_rate at phase 0, then the free wingbeat parameters."""

    unknowns: np.ndarray
    success: bool


# A contestant builds what it can use again for every speed, and returns what solves from a start.
Solve = Callable[[wb.OrbitProblem, np.ndarray], Answer]
Build = Callable[[wb.OrbitProblem], Solve]


def all_cases(speeds: tuple[float, ...] = SPEEDS) -> list[Case]:
    return [Case(*parts) for parts in itertools.product(ANIMALS, MODELS, speeds)]


def first_start(problem: wb.OrbitProblem) -> np.ndarray:
    """Return the nine unknowns that everybody starts from."""
    return start_point(problem, 0, 0)
