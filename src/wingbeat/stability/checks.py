"""Checks of what feedback and manoeuvres are given: inputs, delays, weights, noise and limits, by name."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from wingbeat._base import FaultList, InvalidInputError, suggest
from wingbeat.animal.kinematics import FREE_NAMES, Wingbeat, parameter, with_parameters
from wingbeat.animal.vehicle import Vehicle
from wingbeat.stability.options import FeedbackOptions

# Longest delay [beats].
MOST_DELAY = 4
# What a wingbeat allows, beyond which no command may go; half the frequency, for slower beats are no small change.
ALLOWED = {
    "flap_amplitude": (0.0, math.inf),
    "pitch_amplitude": (0.0, math.inf),
    "sweep_amplitude": (0.0, math.inf),
    "span_retraction": (0.0, 0.95),
    "chord_retraction": (0.0, 0.95),
    "downstroke_fraction": (0.05, 0.95),
}


def check_inputs(faults: FaultList, inputs: Any, vehicle: Vehicle | None = None) -> None:
    """Note inputs that are no list of different parameters of a wingbeat, or that change nothing on a vehicle."""
    named = isinstance(inputs, list | tuple) and len(inputs) > 0 and all(isinstance(name, str) for name in inputs)
    if not named:
        fix = "for example ['frequency', 'pitch_mean']"
        faults.add("inputs", inputs, "must be a list of at least one name", fix)
        return
    for name in inputs:
        if name not in FREE_NAMES:
            fix = "give a parameter of the wingbeat such as frequency, or a harmonic such as flap_cos_2"
            fix = suggest(name, FREE_NAMES, most=1, otherwise=fix)
            faults.add("inputs", name, "is not a parameter of the wingbeat", fix)
    if len(set(inputs)) < len(inputs):
        faults.add("inputs", list(inputs), "has a name twice", "give each input once")
    if vehicle is not None and vehicle.tail is None and "tail_tilt" in inputs:
        faults.add(
            "inputs", "tail_tilt", "changes nothing, because there is no tail", "leave it out, or give a tail"
        )


def check_delay(faults: FaultList, delay: int) -> None:
    """Note a delay of feedback that is no whole number from 0 to `MOST_DELAY`."""
    fix = "commands act in the same beat (0), in the next (1) and so on"
    faults.whole("delay", delay, 0, MOST_DELAY, fix)


def check_late(faults: FaultList, late: int) -> None:
    """Note a lateness that is no whole number from 0 to `MOST_DELAY`."""
    faults.whole("late", late, 0, MOST_DELAY)


def noise_of(noise: Mapping[str, float] | None, state: tuple[str, ...], seed: int) -> np.ndarray:
    """Return the standard deviations of what is measured of the state, in its order; refuse what is none."""
    faults = FaultList()
    check_noise(faults, noise, state, seed)
    faults.raise_if_any()
    return np.array([(noise or {}).get(name, 0.0) for name in state])


def check_noise(faults: FaultList, noise: Mapping[str, float] | None, state: tuple[str, ...], seed: int) -> None:
    """Note noise of unknown names, standard deviations that are negative or not finite, and a seed out of range."""
    faults.whole("seed", seed, 0, 2**31)
    for name, value in _named(faults, "noise", noise, state).items():
        faults.number(f"noise.{name}", value, at_least=0.0, fix="give a standard deviation")


def weights_of(faults: FaultList, weights: Mapping[str, float] | None, known: tuple[str, ...]) -> np.ndarray:
    """Return factors on the costs of states and inputs, 1 where none is given; empty if there are faults."""
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


def command_limits(
    faults: FaultList,
    wingbeat: Wingbeat,
    inputs: tuple[str, ...],
    limits: Mapping[str, float] | None,
    options: FeedbackOptions,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest changes of inputs downwards and upwards, shape (inputs,) each [Hz, rad or shares].

    Limits of unknown inputs, that are not positive, or that no wingbeat allows are noted.
    """
    given: dict[str, float] = {}
    if limits is not None and not isinstance(limits, Mapping):
        faults.add("limits", limits, "must be numbers by name", "for example {'pitch_mean': 0.1}")
    elif limits is not None:
        given = dict(limits)
        for name, limit in given.items():
            if name not in inputs:
                faults.add("limits", name, "is not an input of this feedback", suggest(str(name), inputs, most=1))
            faults.number(f"limits.{name}", limit, above=0.0, fix="give the largest change")
    if faults.faults:
        return np.zeros(len(inputs)), np.zeros(len(inputs))
    lower, upper = [], []
    for name in inputs:
        value = float(parameter(wingbeat, name))
        low, high = ALLOWED.get(name, (-math.inf, math.inf))
        if name == "frequency":
            low = 0.5 * value
        if name in given:
            limit = float(given[name])
            _check_wingbeat(faults, wingbeat, name, limit, (low, high))
            lower.append(-limit)
            upper.append(limit)
        else:
            limit = options.reach * options.unit(name)
            lower.append(max(-limit, low - value))
            upper.append(min(limit, high - value))
    return np.array(lower), np.array(upper)


def _check_wingbeat(
    faults: FaultList, wingbeat: Wingbeat, name: str, limit: float, allowed: tuple[float, float]
) -> None:
    """Note a limit with which the wingbeat would not be one."""
    value = float(parameter(wingbeat, name))
    for end in (value - limit, value + limit):
        if not allowed[0] <= end <= allowed[1]:
            rule = f"lets {name} reach {end:.3g}, and a wingbeat allows {allowed[0]:.3g} to {allowed[1]:.3g}"
            most = min(value - allowed[0], allowed[1] - value)
            fix = f"give at most {most:.3g}" if most > 0 else "leave the input out, or give no limit for it"
            faults.add(f"limits.{name}", limit, rule, fix)
            return
        try:
            with_parameters(wingbeat, {name: end})
        except InvalidInputError as error:
            faults.add(f"limits.{name}", limit, f"leads to no wingbeat ({error.faults[0]})", "give a smaller one")
            return
