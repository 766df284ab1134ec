"""How far inputs of feedback may change."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from wingbeat._base import FaultList, InvalidInputError, suggest
from wingbeat.animal.kinematics import Wingbeat, parameter, with_parameters
from wingbeat.stability.feedback_options import FeedbackOptions

# What a wingbeat allows, beyond which no command may go; half the frequency, for slower beats are no small change.
ALLOWED = {
    "flap_amplitude": (0.0, math.inf),
    "pitch_amplitude": (0.0, math.inf),
    "sweep_amplitude": (0.0, math.inf),
    "span_retraction": (0.0, 0.95),
    "chord_retraction": (0.0, 0.95),
    "downstroke_fraction": (0.05, 0.95),
}


def command_limits(
    faults: FaultList,
    wingbeat: Wingbeat,
    inputs: tuple[str, ...],
    limits: Mapping[str, float] | None,
    options: FeedbackOptions,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the largest changes of inputs downwards and upwards, shape (inputs,) each [Hz, rad or shares].

    Parameters
    ----------
    faults : receives limits of unknown inputs, limits that are not positive, and those that no wingbeat allows.
    wingbeat : of the orbit.
    inputs : names of the inputs.
    limits : largest changes by name; None or a missing name for the default.
    options : give the default.
    """
    given = _read(faults, limits, inputs)
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


def _read(faults: FaultList, limits: Any, inputs: tuple[str, ...]) -> dict[str, float]:
    if limits is None:
        return {}
    if not isinstance(limits, Mapping):
        faults.add("limits", limits, "must be numbers by name", "for example {'pitch_mean': 0.1}")
        return {}
    for name, value in limits.items():
        if name not in inputs:
            fix = suggest(str(name), inputs, most=1)
            faults.add("limits", name, "is not an input of this feedback", fix)
        faults.number(f"limits.{name}", value, above=0.0, fix="give the largest change")
    return dict(limits)


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
