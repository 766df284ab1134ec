"""Checks of what feedback is given by name: weights and noise; and of its delays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from wingbeat._base import FaultList, suggest

# Longest delay [beats].
MOST_DELAY = 4


def noise_of(noise: Mapping[str, float] | None, state: tuple[str, ...], seed: int) -> np.ndarray:
    """Return the standard deviations of what is measured of the state, in its order.

    Parameters
    ----------
    noise : by name of the state [m, rad, m/s, rad/s]; None for no noise.
    state : names of the state.
    seed : of the random numbers.

    Raises
    ------
    InvalidInputError : unknown names, numbers that are negative or not finite, a seed that is no whole number.
    """
    faults = FaultList()
    check_noise(faults, noise, state, seed)
    faults.raise_if_any()
    return np.array([(noise or {}).get(name, 0.0) for name in state])


def check_noise(faults: FaultList, noise: Mapping[str, float] | None, state: tuple[str, ...], seed: int) -> None:
    """Note noise of unknown names, standard deviations that are negative or not finite, and a seed out of range."""
    faults.whole("seed", seed, 0, 2**31)
    for name, value in _named(faults, "noise", noise, state).items():
        faults.number(f"noise.{name}", value, at_least=0.0, fix="give a standard deviation")


def check_delay(faults: FaultList, delay: int) -> None:
    """Note a delay of feedback that is no whole number from 0 to `MOST_DELAY`."""
    fix = "commands act in the same beat (0), in the next (1) and so on"
    faults.whole("delay", delay, 0, MOST_DELAY, fix)


def weights_of(faults: FaultList, weights: Mapping[str, float] | None, known: tuple[str, ...]) -> np.ndarray:
    """Return factors on the costs of states and inputs, 1 where none is given; empty if there are faults.

    Parameters
    ----------
    faults : receives factors of unknown names and those that are not positive.
    weights : factors by name [-].
    known : names of the states, then of the inputs.
    """
    given = _named(faults, "weights", weights, known)
    for name, value in given.items():
        faults.number(f"weights.{name}", value, above=0.0, fix="1 is the default")
    return np.array([given.get(name, 1.0) for name in known], dtype=float) if not faults.faults else np.ones(0)


def _named(faults: FaultList, where: str, given: Any, known: tuple[str, ...]) -> dict[str, Any]:
    """Return numbers by name, and note names that are unknown."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        faults.add(where, given, "must be numbers by name", f"for example {{'{known[-1]}': 0.1}}")
        return {}
    for name in given:
        if name not in known:
            fix = suggest(str(name), known, most=1)
            faults.add(where, name, "names neither a state nor an input of this feedback", fix)
    return {name: value for name, value in given.items() if name in known}


def check_late(faults: FaultList, late: int) -> None:
    """Note a lateness that is no whole number from 0 to `MOST_DELAY`."""
    faults.whole("late", late, 0, MOST_DELAY)
