"""Inputs that change the wingbeat from beat to beat without a jump of the wing where one beat follows another.

A jump would be an impulse on the body, which a map from beat to beat would not contain. So each input comes with
harmonics that keep the wing's position and velocity at the top of the stroke.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat._jax.config import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.errors import FaultList
from wingbeat.harmonics import FIRST_ORDER, HIGHEST_ORDER
from wingbeat.kinematics import (
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

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Free, LawJumps, Phases

# The laws that move mass. The chord law is not one of them: the mass stays distributed over the full chord.
_LAWS = ("flap", "pitch", "span", "sweep", "twist", "fold", "stroke plane")
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


def _at_top(wingbeat: Wingbeat, phase: Phases) -> Phases:
    """Return all laws at a phase, in the order of `_LAWS`; the twist law is the whole pitch at the tip."""
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
        position, by_phase = jax.jvp(lambda phase: _at_top(beat, phase), (jnp.array(0.0),), (jnp.array(1.0),))
        return jnp.stack([position, beat.frequency * by_phase], axis=-1)

    return jax.jacfwd(positions_and_rates)(values)


def _jump(wingbeat: Wingbeat, names: tuple[str, ...]) -> np.ndarray:
    values = np.array([parameter(wingbeat, name) for name in names], dtype=float)
    return np.array(_jumps.bind(wingbeat, names=names)(values))


def can_be_smooth(wingbeat: Wingbeat, name: str) -> bool:
    """Return whether harmonics can keep the wing from jumping if a parameter changes from beat to beat."""
    jumps = _jump(wingbeat, (name,))
    return all(law in FIRST_ORDER for law, jump in zip(_LAWS, jumps, strict=True) if np.abs(jump).max() > _NOTHING)


def compensation(wingbeat: Wingbeat, inputs: Sequence[str]) -> Compensation:
    """Return the harmonics that keep the wing's position and velocity at phase 0 while inputs change.

    Parameters
    ----------
    wingbeat : the wingbeat.
    inputs : names of parameters of the wingbeat.

    Raises
    ------
    InvalidInputError : inputs that move the hand or the stroke plane at phase 0, which no harmonic can undo.
    """
    jumps = _jump(wingbeat, tuple(inputs))
    moved = [law for law, jump in zip(_LAWS, jumps, strict=True) if np.abs(jump).max() > _NOTHING]
    faults = FaultList()
    for law in moved:
        if law not in FIRST_ORDER:
            at_fault = [n for n, jump in zip(inputs, jumps[_LAWS.index(law)].T, strict=True) if jump.any()]
            for name in at_fault:
                rule = f"makes the {law} jump from one beat to the next, and no harmonic can undo that"
                faults.add(f"inputs.{name}", name, rule, "leave it out, or give smooth=False to accept the jump")
    faults.raise_if_any()
    names: list[str] = []
    for law in moved:
        used = {name for name in inputs if name.startswith((f"{law}_cos_", f"{law}_sin_"))}
        order = next(
            n for n in range(FIRST_ORDER[law], HIGHEST_ORDER + 1) if not {f"{law}_cos_{n}", f"{law}_sin_{n}"} & used
        )
        names += [f"{law}_cos_{order}", f"{law}_sin_{order}"]
    if not names:
        return Compensation((), np.zeros((0, len(inputs))))
    own = _jump(wingbeat, tuple(names))
    rows = [_LAWS.index(law) for law in moved]
    shares = np.linalg.solve(own[rows].reshape(len(names), -1), -jumps[rows].reshape(len(names), -1))
    return Compensation(tuple(names), np.where(np.abs(shares) < _NOTHING, 0.0, shares))
