"""Inputs that change the wingbeat from beat to beat without a jump of the wing where one beat follows another.

A jump would be an impulse on the body, which a map from beat to beat would not contain. So each input comes with
harmonics that keep the wing's position and velocity at the top of the stroke: to first order in `compensation`, and
exactly for changes of any size in `parameters_of`. The product of a new frequency and a new amplitude, for example,
would still make the wing jump in speed with the shares of the former.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FIRST_ORDER, HIGHEST_ORDER, FaultList
from wingbeat._jax.arrays import jax, jnp, unchecked
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import (
    Wingbeat,
    flap_angle,
    fold_angle,
    parameter,
    pitch_angle,
    span_ratio,
    sweep_angle,
    tip_twist,
    unpack,
    with_parameters,
)

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        AllParameters,
        Commands,
        Free,
        InputChanges,
        LawJumps,
        LawRates,
        Parameters,
        ParameterSlopes,
        Phases,
    )

# The laws that move mass. The chord law does not: the mass stays distributed over the full chord, and the unsteady
# loads leave out the rate of the chord.
LAWS = ("flap", "pitch", "span", "sweep", "twist", "fold", "stroke plane")
# A smaller change of a law per unit of an input is rounding [rad, rad/s; shares of the span].
_NOTHING = 1e-12
# The harmonics enter position and speed linearly. Where an input changes how much they do so, corrections are
# repeated: each leaves less than a fifth of the jump.
_CORRECTIONS = 12
_BEND = {"downstroke_fraction", "twist_ratio"}


class Compensation(NamedTuple):
    """Harmonics that go with inputs."""

    names: tuple[str, ...]
    shares: np.ndarray  # change of each harmonic per unit of each input, shape (harmonics, inputs)


def laws_at(wingbeat: Wingbeat, phase: Phases) -> Phases:
    """Return all laws at phases, in the order of `LAWS`; the twist law is the whole pitch at the tip."""
    nothing, hinge = jnp.zeros_like(phase), wingbeat.pitch_hinge
    pitch, sweep, twist = pitch_angle(wingbeat, phase), sweep_angle(wingbeat, phase), tip_twist(wingbeat, phase)
    if hinge is not None:  # its angle is a state, which no change of its numbers moves at once
        prescribed = unchecked(Wingbeat, vars(wingbeat) | {"pitch_hinge": None})
        pitch, twist = pitch_angle(prescribed, phase), tip_twist(prescribed, phase)
        pitch = nothing if hinge.moves_root else pitch
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
    """Return how far laws and their rates [1/s] jump at phase 0 per unit of parameters, shape (laws, 2, names)."""
    values = np.array([parameter(wingbeat, name) for name in names], dtype=float)
    return np.array(_jumps.bind(wingbeat, names=names)(values))


def smooth_ones(wingbeat: Wingbeat, names: Sequence[str]) -> tuple[str, ...]:
    """Return the names of those parameters whose jumps harmonics can undo."""
    if not names:
        return ()
    lasting = law_jumps(wingbeat, tuple(names))[[law not in FIRST_ORDER for law in LAWS]]
    return tuple(name for i, name in enumerate(names) if not np.abs(lasting[..., i]).max() > _NOTHING)


def compensation(wingbeat: Wingbeat, inputs: Sequence[str]) -> Compensation:
    """Return the harmonics that keep the wing's position and velocity at phase 0 while inputs change.

    Inputs that move the hand or the stroke plane at phase 0 are refused, which no harmonic can undo, and so are
    inputs that contain the harmonics of all orders. Theory: equation ``compensation``.
    """
    if not inputs:
        return Compensation((), np.zeros((0, 0)))
    jumps = law_jumps(wingbeat, tuple(inputs))
    moved = np.abs(jumps).max(axis=1) > _NOTHING  # by law and parameter
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


class Smoother(NamedTuple):
    """What keeps the wing from jumping, as arrays."""

    numbers: np.ndarray  # of the inputs, then of their harmonics, in the undisturbed wingbeat
    top: np.ndarray  # all laws at phase 0, and their derivatives by the phase times the frequency, shape (laws, 2)
    corrections: np.ndarray  # changes of harmonics that undo a unit of each of these, (harmonics, laws, 2)


def smoother(wingbeat: Wingbeat, inputs: tuple[str, ...], harmonics: Compensation) -> Smoother:
    """Return what keeps the wing from jumping when inputs change."""
    numbers = [float(parameter(wingbeat, name)) for name in (*inputs, *harmonics.names)]
    top = top_of(wingbeat)
    if not harmonics.names:
        return Smoother(np.array(numbers), top, np.zeros((0, *top.shape)))
    held = np.array([law in FIRST_ORDER for law in LAWS])[:, None, None]
    own = np.where(held, law_jumps(wingbeat, harmonics.names), 0.0) / np.array([1.0, wingbeat.frequency])[:, None]
    inverse = np.linalg.pinv(own.reshape(-1, len(harmonics.names)), rcond=1e-9)
    return Smoother(np.array(numbers), top, inverse.reshape(-1, *top.shape))


def top_of(wingbeat: Wingbeat) -> np.ndarray:
    """Return all laws at the top of the stroke and their rates, (laws, 2) [rad, rad/s; shares of the span]."""
    return np.asarray(_top(wingbeat))


@exported
def _top(wingbeat: Wingbeat) -> LawRates:
    place, by_phase = _place_and_slope(wingbeat, jnp.array(0.0))
    return jnp.stack([place, wingbeat.frequency * by_phase], axis=-1)


def _place_and_slope(wingbeat: Wingbeat, phase: Any) -> tuple[Any, Any]:
    return jax.jvp(lambda at: laws_at(wingbeat, at), (phase,), (jnp.ones_like(phase),))


def parameters_of(
    wingbeat: Wingbeat, smooth: Smoother, changes: Commands, *, inputs: tuple[str, ...], harmonics: tuple[str, ...]
) -> Parameters:
    """Return inputs and harmonics of a changed wingbeat, shape (inputs + harmonics, ...).

    Theory: equation ``exact-compensation``.
    """
    several = changes.shape[1:]
    numbers = smooth.numbers.reshape(-1, *[1] * len(several))
    given = numbers[: len(inputs)] + changes
    waves = jnp.broadcast_to(numbers[len(inputs) :], (len(harmonics), *several))
    phase = jnp.zeros(several)
    top = jnp.reshape(smooth.top, (*smooth.top.shape, *[1] * len(several)))
    count = _CORRECTIONS if _BEND & set(inputs) else 1
    for _ in range(count if harmonics else 0):
        beat = unpack((*inputs, *harmonics), wingbeat, jnp.concatenate([given, waves]))
        place, slope = _place_and_slope(beat, phase)
        away = jnp.stack([place - top[:, 0], slope - top[:, 1] / beat.frequency], axis=1)
        waves = waves - jnp.tensordot(smooth.corrections, away, 2)
    return jnp.concatenate([given, waves])


@exported(static=("inputs", "harmonics"))
def _parameters_of(
    wingbeat: Wingbeat, smooth: Smoother, changes: Commands, *, inputs: tuple[str, ...], harmonics: tuple[str, ...]
) -> Parameters:
    return parameters_of(wingbeat, smooth, changes, inputs=inputs, harmonics=harmonics)


@exported(static=("inputs", "harmonics"))
def parameters_and_slopes(
    wingbeat: Wingbeat,
    smooth: Smoother,
    changes: InputChanges,
    *,
    inputs: tuple[str, ...],
    harmonics: tuple[str, ...],
) -> tuple[AllParameters, ParameterSlopes]:
    """Return what `parameters_of` returns for one wingbeat, and its derivatives by the changes."""

    def at(changes: Any) -> tuple[Any, Any]:
        found = parameters_of(wingbeat, smooth, changes, inputs=inputs, harmonics=harmonics)
        return found, found

    slopes, found = jax.jacfwd(at, has_aux=True)(changes)
    return found, slopes


def changed_wingbeat(
    wingbeat: Wingbeat, smooth: Smoother, inputs: tuple[str, ...], harmonics: tuple[str, ...], changes: np.ndarray
) -> Wingbeat:
    """Return the wingbeat with changed inputs [Hz, rad or shares], whose wing does not jump."""
    numbers = _parameters_of(wingbeat, smooth, np.asarray(changes, float), inputs=inputs, harmonics=harmonics)
    return with_parameters(wingbeat, dict(zip((*inputs, *harmonics), numbers.tolist(), strict=True)))
