"""Servos that move flap, pitch, a hinge's springs or the tail, and checks of what real-time feedback is given."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from wingbeat._base import HIGHEST_ORDER, FaultList
from wingbeat._jax.arrays import jnp
from wingbeat.animal.pitch_hinge import PitchHinge

SERVO_LAWS = ("flap", "pitch")
# What a servo may move: the rest angle is that of the springs of a hinge that gives way.
SERVOED = (*SERVO_LAWS, "rest_angle", "tail")
MOST_SAMPLES = 256  # of a beat
# Stands for an infinite speed [rad/s] or bandwidth [1/s] where both meet in one formula.
WITHOUT_END = 1e9
SLOWING = math.radians(10.0)  # distance from its command at which a servo begins to slow down, if not known


@dataclass(frozen=True)
class Servo:
    """What moves flap, pitch, a hinge's rest angle or the tail beyond the gait: limits of angle, speed, bandwidth.

    Parameters
    ----------
    speed : largest speed [rad/s]. A data sheet's 0.1 s for 60 degrees is ``math.radians(600)``.
    bandwidth : of a first-order lag [Hz]; an angle follows a small step of the command with the time constant
        1/(2 pi bandwidth). If only the speed is given, the servo slows down within 10 degrees of its command, a
        guess: 9.5 Hz with 600 degrees per second. No servo starts and stops at once, and gains that take it for one
        that does are useless.
    lower, upper : smallest and largest command [rad], at most and at least 0; None for `FeedbackOptions.reach`
        units of an angle.

    Raises
    ------
    InvalidInputError : a speed or bandwidth that is not positive, limits without 0 between them.

    Theory: equation ``servo``.

    >>> import math, wingbeat as wb
    >>> wb.Servo(speed=math.radians(600), upper=0.1).ideal, wb.Servo(lower=-0.1).ideal
    (False, True)
    """

    speed: float = math.inf
    bandwidth: float = math.inf
    lower: float | None = None
    upper: float | None = None

    def __post_init__(self) -> None:
        faults = FaultList()
        fix = "leave it out if there is no such limit"
        if self.speed != math.inf:
            faults.number("servo.speed", self.speed, above=0.0, unit="rad/s", fix=fix)
        if self.bandwidth != math.inf:
            faults.number("servo.bandwidth", self.bandwidth, above=0.0, unit="Hz", fix=fix)
        if self.lower is not None:
            faults.number("servo.lower", self.lower, at_least=-math.pi, at_most=0.0, unit="rad")
        if self.upper is not None:
            faults.number("servo.upper", self.upper, at_least=0.0, at_most=math.pi, unit="rad")
        faults.raise_if_any()

    @property
    def ideal(self) -> bool:
        """Whether neither speed nor bandwidth is limited."""
        return self.speed == math.inf and self.bandwidth == math.inf

    @property
    def pace(self) -> float:
        """Inverse of the time constant [1/s]."""
        own = self.speed / SLOWING if self.bandwidth == math.inf else 2.0 * math.pi * self.bandwidth
        return min(own, WITHOUT_END)


def check_servos(
    faults: FaultList, servos: Servo | Mapping[str, Servo] | None, hinge: PitchHinge | None, tail: bool
) -> dict[str, Servo]:
    """Return the servo of each law that has one, and note what is no servo.

    One servo, or None for ideal ones, stands for those of flap and pitch; where nothing drives the pitch, for flap
    and the tail, if there is one.
    """
    driven = hinge is None or not hinge.moves_root
    if servos is None or isinstance(servos, Servo):
        usual = SERVO_LAWS if driven else ("flap", "tail")
        return dict.fromkeys([law for law in usual if law != "tail" or tail], servos or Servo())
    if not isinstance(servos, Mapping) or not servos:
        faults.add("servos", servos, "must be a Servo, or servos by name", "for example {'pitch': wb.Servo()}")
        return {}
    for name, one in servos.items():
        faults.choice("servos", name, SERVOED)
        if name == "pitch" and not driven:
            fix = "give flap, tail, or rest_angle for a servo that turns the springs"
            faults.add("servos", name, "gives way: nothing drives it", fix)
        if (name == "tail" and not tail) or (name == "rest_angle" and hinge is None):
            faults.add("servos", name, "moves nothing of this vehicle", "give flap or pitch")
        if not isinstance(one, Servo):
            faults.add(f"servos.{name}", one, "must be a Servo", "for example wb.Servo(speed=10.0)")
    if len({one.ideal for one in servos.values() if isinstance(one, Servo)}) > 1:
        rule = "mix a servo without limits of speed or bandwidth with one that has them"
        faults.add("servos", list(servos), rule, "give both a speed or a bandwidth, or leave one out")
    return dict(servos) if not faults.faults else {}


def check_timing(
    faults: FaultList, segments: int | None, sample_rate: float | None, delay_time: float | None, held: bool
) -> None:
    """Note numbers out of range, and two of which only one can be given; None stands for what is not given."""
    if segments is not None:
        faults.whole("segments", segments, 2, MOST_SAMPLES if held else HIGHEST_ORDER, "4 for example")
    if delay_time is not None:
        faults.number("delay_time", delay_time, at_least=0.0, unit="s")
    if sample_rate is not None:
        faults.number("sample_rate", sample_rate, above=0.0, unit="Hz")
        if segments is not None:
            faults.add("segments", segments, "is given beside a sample rate", "leave one of them out")


def follow(angle: Any, target: Any, speed: Any, pace: Any, time: Any) -> Any:
    """Return the angle of a servo that follows a constant target for some time. Theory: equation ``servo``."""
    away = target - angle
    far = jnp.abs(away)
    slewing = jnp.clip((far - speed / pace) / speed, 0.0, time)
    left = (far - speed * slewing) * jnp.exp(-pace * (time - slewing))
    return target - jnp.sign(away) * left
