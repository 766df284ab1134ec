"""What stability is given: options, and checks by name of inputs, delays, weights, noise and limits of commands."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat._base import SHARES, FaultList, InvalidInputError, suggest
from wingbeat.animal.kinematics import ANGLES, FREE_NAMES, Wingbeat, parameter, with_parameters
from wingbeat.animal.vehicle import Vehicle
from wingbeat.orbits.flight.period import PITCH_STATE
from wingbeat.orbits.search_options import Options

FLIGHT_STATE = ("z", *PITCH_STATE)  # what a flight returns to after a beat, and feedback measures: all but x


@dataclass(frozen=True)
class LinearOptions(Options):
    """Options of the linearisation of a flight.

    Parameters
    ----------
    blocks : the beat is flown in this many times 32 steps. With 12, the multipliers of pigeon and bat differ
        from those of an adaptive flight by less than 1e-4 of the largest multiplier.
    agreement, most_blocks : the number of steps is multiplied by four until the characteristic polynomial agrees
        with that of the certified multipliers to this share of its largest coefficient, or until there are so many
        times 32 steps. Pigeons in cruise need 12 blocks. In hover the air stands still where the wing turns: with
        12 blocks, a hummingbird's multipliers are wrong by 2e-3.
    closure : an orbit that misses its start by more than this is refused [-], in the scales of `Mode.disturbance`.
        Flown in these steps, eight orbits of pigeon and bat from 4 to 16 m/s miss by 2e-6 at the most.

    >>> import wingbeat as wb
    >>> options = wb.LinearOptions(blocks=48)  # pass them on: wb.linearise(orbit, options=options)
    >>> options.blocks * 32
    1536
    """

    blocks: int = 12
    agreement: float = 1e-5
    most_blocks: int = 192
    closure: float = 1e-3


LINEAR = LinearOptions()


@dataclass(frozen=True)
class FeedbackOptions(Options):
    """Options of feedback from beat to beat.

    A deviation of the state by its scale costs as much as a change of an input by its unit.

    Parameters
    ----------
    z : scale of the height [m].
    body_pitch : scale [rad].
    u, w : scales of the velocity, forward and up [m/s].
    pitch_rate : scale [rad/s].
    angle : unit of inputs that are angles [rad].
    frequency : unit of the frequency [Hz].
    ratio : unit of inputs that are shares or ratios, such as the twist ratio [-].
    reach : inputs change by at most so many units, if no limits are given [-].
    least_effect : an input reaches a mode if its unit moves the mode by more than this share of a unit [-].
    linear : options of the linearisation.

    >>> import wingbeat as wb
    >>> options = wb.FeedbackOptions(z=0.5)  # pass them on: wb.feedback(orbit, options=options)
    >>> options.z, options.body_pitch
    (0.5, 0.1)
    """

    z: float = 0.2
    body_pitch: float = 0.1
    u: float = 1.0
    w: float = 1.0
    pitch_rate: float = 2.0
    angle: float = math.radians(3.0)
    frequency: float = 0.5
    ratio: float = 0.05
    reach: float = 4.0
    least_effect: float = 1e-6
    linear: LinearOptions = LINEAR

    def scale(self, state: str) -> float:
        """Return the scale of a state [m, rad, m/s, rad/s].

        Parameters
        ----------
        state : its name.
        """
        return getattr(self, state)

    def unit(self, name: str) -> float:
        """Return the unit of an input [Hz, rad or shares].

        Parameters
        ----------
        name : of the input.
        """
        if name == "frequency":
            return self.frequency
        return self.angle if name in ANGLES and not name.startswith(SHARES) else self.ratio


FEEDBACK = FeedbackOptions()


@dataclass(frozen=True)
class ManoeuvreOptions(Options):
    """Options of manoeuvres from one speed to another.

    Parameters
    ----------
    acceleration : mean acceleration for which the number of beats is chosen, if it is not given [m/s2]. From 12 to
        14 m/s a pigeon can do with 1 m/s2, but not with 2: its frequency would exceed its limit.
    doublings : if the number of beats is not given and does not suffice, it is doubled at most so many times. From
        12 to 14 m/s, beats for 2 m/s2 must be doubled once.
    speed_step : largest step of speed between the steady flights that make the schedule [m/s].
    iterations : largest number of Gauss-Newton steps of a steady flight and of a transition. Pigeons took 4 to 9.
    free_steps, caution : after so many steps of a transition, the cost of a step over that of the deviation grows
        by this factor with each step. Without it, a pigeon from 6 to 16 m/s was not through in 30 steps.
    largest_step : no step changes an input by more than this many of its units [-].
    step_tolerance : a search ends when no input changes by more than this many of its units [-].
    blocks : a beat is flown in this many times 32 steps; the adaptive integrator corrects the end of the beat.
    corrections : how often the ends of all beats are corrected; each time the misses fall by a factor of 10 or
        more.
    defect : a manoeuvre is certified if no beat, flown by the adaptive integrator, misses its end by more than this
        share of the scales of the state [-].
    jump : nor is it certified if the wing jumps from beat to beat by more than this [rad or rad/s]. Rounding leaves
        some 1e-13.
    smoothness : cost of a change of an input from beat to beat, over the cost of its deviation from the schedule.
    reach : commands exceed the inputs of the steady flights by at most so many of their units [-]. A pigeon that
        flies from 6 to 16 m/s and back needs 4.0 with 2 m/s2, and 3.0 with 1 m/s2.
    feedback : scales of the state and units of the inputs.

    >>> import wingbeat as wb
    >>> options = wb.ManoeuvreOptions(acceleration=0.5)  # pass them on: wb.manoeuvre(..., options=options)
    >>> options.acceleration, options.feedback.z
    (0.5, 0.2)
    """

    acceleration: float = 1.0
    doublings: int = 3
    speed_step: float = 1.0
    iterations: int = 30
    free_steps: int = 3
    caution: float = 3.0
    largest_step: float = 4.0
    step_tolerance: float = 1e-8
    blocks: int = 2
    corrections: int = 4
    defect: float = 1e-6
    jump: float = 1e-9
    smoothness: float = 10.0
    reach: float = 6.0
    feedback: FeedbackOptions = FEEDBACK


MANOEUVRE = ManoeuvreOptions()


@dataclass(frozen=True)
class ManyOptions(Options):
    """Options of many flights at once.

    Parameters
    ----------
    steps : Runge-Kutta steps of a beat.
    air_samples : places in a beat at which the velocity of the air is tabulated; cubics give it between.
    lanes : flights that are computed at once.
    tilt : a flight is lost if its body pitch differs by more than this from the orbit's at the same phase [rad].
    loss : a flight is lost if it is more than this below the orbit's path at a top of the stroke [m].

    >>> import math, wingbeat as wb
    >>> options = wb.ManyOptions(tilt=math.radians(45))  # pass them on: wb.simulate_many(..., options=options)
    >>> round(options.tilt, 3), options.loss
    (0.785, 5.0)
    """

    steps: int = 64
    air_samples: int = 64
    lanes: int = 256
    tilt: float = math.radians(60.0)
    loss: float = 5.0

    def keeps(self, largest_pitch: float | np.ndarray, lowest: float | np.ndarray) -> Any:
        """Return whether flights are not lost; False for numbers that are not finite.

        Parameters
        ----------
        largest_pitch : largest deviations of the body pitch from the orbit's [rad].
        lowest : least heights above the orbit's path [m].
        """
        return np.less_equal(largest_pitch, self.tilt) & np.greater_equal(lowest, -self.loss)


MANY = ManyOptions()


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
    if not (isinstance(inputs, list | tuple) and inputs and all(isinstance(name, str) for name in inputs)):
        rule = "must be a list of at least one name"
        faults.add("inputs", inputs, rule, "for example ['frequency', 'pitch_mean']")
        return
    for name in inputs:
        if name not in FREE_NAMES:
            fix = "give a parameter of the wingbeat such as frequency, or a harmonic such as flap_cos_2"
            fix = suggest(name, FREE_NAMES, most=1, otherwise=fix)
            faults.add("inputs", name, "is not a parameter of the wingbeat", fix)
    if len(set(inputs)) < len(inputs):
        faults.add("inputs", list(inputs), "has a name twice", "give each input once")
    if vehicle is not None and vehicle.tail is None and "tail_tilt" in inputs:
        rule = "changes nothing, because there is no tail"
        faults.add("inputs", "tail_tilt", rule, "leave it out, or give a tail")


def check_no_wake(faults: FaultList, wake: str) -> None:
    """Note the lag of the wake."""
    if wake != "none":
        faults.add("aero.wake", wake, "has states that stability does not know", "solve the orbit without the wake")


def check_no_hinge(faults: FaultList, wingbeat: Wingbeat) -> None:
    """Note a hinge that gives way, whose angle and rate the beats of a manoeuvre do not hand on."""
    if wingbeat.pitch_hinge is not None:
        fix = "hold one speed with wb.feedback or wb.feedback_in_beat (`wingbeat feedback`), or prescribe the pitch"
        faults.add("pitch_hinge", "the wing's pitch", "gives way, and manoeuvres do not know the hinge", fix)


def check_delay(faults: FaultList, delay: int) -> None:
    """Note a delay of feedback that is no whole number from 0 to `MOST_DELAY`."""
    faults.whole("delay", delay, 0, MOST_DELAY, "commands act in the same beat (0), in the next (1) and so on")


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
            rule = "names neither a state nor an input of this feedback"
            faults.add(where, name, rule, suggest(str(name), known, most=1))
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
        limit = float(given.get(name, options.reach * options.unit(name)))
        if name in given:
            _check_wingbeat(faults, wingbeat, name, limit, (low, high))
        lower.append(-limit if name in given else max(-limit, low - value))
        upper.append(limit if name in given else min(limit, high - value))
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
