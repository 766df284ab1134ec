"""What the tests of species share: a small good file, and the faults that a call is refused for."""

from typing import Any

import pytest

from wingbeat._base import InvalidInputError

MINIMAL = """
[vehicle]
mass = 0.3
[vehicle.body]
pitch_inertia = 1e-4
[vehicle.wing]
semi_span = 0.3
chord = 0.1
mass = 0.01
[wingbeat]
frequency = 5
flap_mean = 0
flap_amplitude_deg = 40
pitch_mean = 0.1
pitch_amplitude = 0.2
"""

# A species of which a test changes one number.
SPECIES = """
[vehicle]
mass = {mass}
[vehicle.body]
pitch_inertia = {inertia}
[vehicle.wing]
semi_span = 0.3
chord = {chord}
mass = 0.01
{more}
[wingbeat]
frequency = {frequency}
flap_mean = 0
flap_amplitude_deg = 40
pitch_mean = 0.1
pitch_amplitude = 0.2
[free]
frequency = {{ bounds = [2.0, 20.0], reason = "wide" }}
"""
GOOD = {"mass": "0.3", "inertia": "1e-4", "chord": "0.1", "frequency": "5", "more": ""}


def faults_of(call: Any, *arguments: Any) -> dict[str, str]:
    """Return the faults that a call is refused for: where -> the whole line."""
    with pytest.raises(InvalidInputError) as caught:
        call(*arguments)
    lines = {fault.where: str(fault) for fault in caught.value.faults}
    assert len(lines) == len(caught.value.faults), "one fault told twice"
    return lines


def check_words(message: str) -> str:
    """Return a message, which must say something on each of its lines and send no control characters."""
    assert all(line.strip() and line.isprintable() for line in message.split("\n")), message
    return message
