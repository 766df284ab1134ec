"""Inputs that change the wingbeat from beat to beat without a jump of the wing where one beat follows another.

A jump would be an impulse on the body, which a map from beat to beat would not contain. So each input comes with
harmonics that keep the wing's position and velocity at the top of the stroke.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FIRST_ORDER, HIGHEST_ORDER, FaultList, suggest
from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import (
    FREE_NAMES,
    Wingbeat,
    flap_angle,
    fold_angle,
    parameter,
    pitch_angle,
    span_ratio,
    sweep_angle,
    tip_twist,
    unpack,
)
from wingbeat.animal.vehicle import Vehicle

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Free, LawJumps, Phases

# The laws that move mass. The chord law does not: the mass stays distributed over the full chord, and the unsteady
# loads leave out the rate of the chord.
LAWS = ("flap", "pitch", "span", "sweep", "twist", "fold", "stroke plane")
# A smaller change of a law per unit of an input is rounding [rad, rad/s; shares of the span].
_NOTHING = 1e-12


class Compensation(NamedTuple):
    """Harmonics that go with inputs.

    Attributes
    ----------
    names : of the harmonics.
    shares : change of each harmonic per unit of each input, shape (harmonics, inputs).
    """

    names: tuple[str, ...]
    shares: np.ndarray


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


def laws_at(wingbeat: Wingbeat, phase: Phases) -> Phases:
    """Return all laws at a phase, in the order of `LAWS`; the twist law is the whole pitch at the tip.

    Parameters
    ----------
    wingbeat : one wingbeat, or one for each phase.
    phase : phases, shape (...).
    """
    nothing = jnp.zeros_like(phase)
    pitch, sweep, twist = pitch_angle(wingbeat, phase), sweep_angle(wingbeat, phase), tip_twist(wingbeat, phase)
    tip = wingbeat.twist_ratio * pitch + (nothing if twist is None else twist)
    laws = (
        flap_angle(wingbeat, phase),
        pitch,
        span_ratio(wingbeat, phase),
        nothing if sweep is None else sweep,
        tip,
        fold_angle(wingbeat, phase),
        nothing + wingbeat.stroke_plane_tilt,
    )
    return jnp.stack([jnp.asarray(law, dtype=float) for law in laws])


@exported(static=("names",))
def _jumps(wingbeat: Wingbeat, values: Free, *, names: tuple[str, ...]) -> LawJumps:
    """Return the derivatives of all laws and of their rates [1/s] at phase 0 by parameters, (laws, 2, names)."""

    def positions_and_rates(at: Free) -> LawJumps:
        beat = unpack(names, wingbeat, at)
        position, by_phase = jax.jvp(lambda phase: laws_at(beat, phase), (jnp.array(0.0),), (jnp.array(1.0),))
        return jnp.stack([position, beat.frequency * by_phase], axis=-1)

    return jax.jacfwd(positions_and_rates)(values)


def law_jumps(wingbeat: Wingbeat, names: tuple[str, ...]) -> np.ndarray:
    """Return how far laws and their rates [1/s] jump at phase 0 per unit of parameters, shape (laws, 2, names).

    Parameters
    ----------
    wingbeat : the wingbeat.
    names : of the parameters, at least one.
    """
    values = np.array([parameter(wingbeat, name) for name in names], dtype=float)
    return np.array(_jumps.bind(wingbeat, names=names)(values))


def _is_moved(jumps: np.ndarray) -> np.ndarray:
    """Return for each law and parameter whether the wing jumps, shape (laws, parameters)."""
    return np.abs(jumps).max(axis=1) > _NOTHING


def smooth_ones(wingbeat: Wingbeat, names: Sequence[str]) -> tuple[str, ...]:
    """Return the names of those parameters whose jumps harmonics can undo."""
    if not names:
        return ()
    moved = _is_moved(law_jumps(wingbeat, tuple(names)))
    lasting = moved[[law not in FIRST_ORDER for law in LAWS]]
    return tuple(name for name, jumps in zip(names, lasting.T, strict=True) if not jumps.any())


def compensation(wingbeat: Wingbeat, inputs: Sequence[str]) -> Compensation:
    """Return the harmonics that keep the wing's position and velocity at phase 0 while inputs change.

    Theory: equation ``compensation``.

    Parameters
    ----------
    wingbeat : the wingbeat.
    inputs : names of parameters of the wingbeat.

    Raises
    ------
    InvalidInputError : inputs that move the hand or the stroke plane at phase 0, which no harmonic can undo; inputs
        that contain the harmonics of all orders.
    """
    if not inputs:
        return Compensation((), np.zeros((0, 0)))
    jumps = law_jumps(wingbeat, tuple(inputs))
    moved = _is_moved(jumps)
    faults = FaultList()
    names: list[str] = []
    for law, moved_by in zip(LAWS, moved, strict=True):
        if law in FIRST_ORDER and moved_by.any():
            names += _harmonics(faults, law, inputs)
        elif moved_by.any():
            for name in np.array(inputs)[moved_by].tolist():
                rule = f"makes the {law} jump from one beat to the next, and no harmonic can undo that"
                faults.add("inputs", name, rule, "leave it out, or give smooth=False (--jumps) to accept the jump")
    faults.raise_if_any()
    if not names:
        return Compensation((), np.zeros((0, len(inputs))))
    rows = [i for i, law in enumerate(LAWS) if law in FIRST_ORDER and moved[i].any()]
    own = law_jumps(wingbeat, tuple(names))[rows].reshape(len(names), -1)
    shares = np.linalg.solve(own, -jumps[rows].reshape(len(names), -1))
    # Where the twist follows the pitch, the harmonics of the twist have nothing left to undo.
    used = [bool(np.abs(row).max() > _NOTHING) for row in shares]
    kept = tuple(name for name, is_used in zip(names, used, strict=True) if is_used)
    return Compensation(kept, np.where(np.abs(shares) > _NOTHING, shares, 0.0)[used])


def _harmonics(faults: FaultList, law: str, inputs: Sequence[str]) -> list[str]:
    """Return cosine and sine of the lowest order that is not among the inputs."""
    for order in range(FIRST_ORDER[law], HIGHEST_ORDER + 1):
        pair = [f"{law}_cos_{order}", f"{law}_sin_{order}"]
        if not set(pair) & set(inputs):
            return pair
    rule = f"contain all orders of the {law} harmonics, and one must be left to keep the wing from jumping"
    faults.add("inputs", list(inputs), rule, f"leave out one order up to {HIGHEST_ORDER}")
    return []
