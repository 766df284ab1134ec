"""Actuators of the flap hinges: muscles or motors, and the springs at the hinges."""

from __future__ import annotations

from typing import NamedTuple

from wingbeat.animal.actuators.motor import Motor
from wingbeat.animal.actuators.muscle import Muscle
from wingbeat.animal.actuators.springs import Springs

__all__ = ["Drive", "Motor", "Muscle", "Springs"]


class Drive(NamedTuple):
    """What drives the flap hinges of a vehicle; a part that the vehicle lacks is None.

    Attributes
    ----------
    muscle, motor, springs : those of the vehicle.
    """

    muscle: Muscle | None = None
    motor: Motor | None = None
    springs: Springs | None = None
