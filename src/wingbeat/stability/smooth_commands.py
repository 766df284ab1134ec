"""Wingbeats whose inputs are changed by a finite amount, with harmonics so that the wing does not jump.

The shares of `compensation` hold for small changes: the product of a new frequency and a new amplitude would still
make the wing jump in speed. Here the harmonics are those with which position and velocity stay exactly the same.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FIRST_ORDER
from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, parameter, unpack, with_parameters
from wingbeat.stability.inputs import LAWS, Compensation, law_jumps, laws_at

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        AllParameters,
        Commands,
        InputChanges,
        LawRates,
        Parameters,
        ParameterSlopes,
    )

# The harmonics enter position and speed linearly. Where an input changes how much they do so, corrections are
# repeated: each leaves less than a fifth of the jump.
_CORRECTIONS = 12
_BEND = {"downstroke_fraction", "twist_ratio"}


class Smoother(NamedTuple):
    """What keeps the wing from jumping, as arrays.

    Attributes
    ----------
    numbers : of the inputs, then of their harmonics, in the undisturbed wingbeat, shape (inputs + harmonics,).
    top : all laws at phase 0, and their derivatives by the phase times the frequency, shape (laws, 2).
    corrections : changes of the harmonics that undo a unit of each of these, by phase, shape (harmonics, laws, 2).
    """

    numbers: np.ndarray
    top: np.ndarray
    corrections: np.ndarray


def smoother(wingbeat: Wingbeat, inputs: tuple[str, ...], harmonics: Compensation) -> Smoother:
    """Return what keeps the wing from jumping when inputs change.

    Parameters
    ----------
    wingbeat : the undisturbed wingbeat.
    inputs : names of the inputs.
    harmonics : that go with them.
    """
    numbers = [float(parameter(wingbeat, name)) for name in (*inputs, *harmonics.names)]
    top = top_of(wingbeat)
    if not harmonics.names:
        return Smoother(np.array(numbers), top, np.zeros((0, *top.shape)))
    held = np.array([law in FIRST_ORDER for law in LAWS])[:, None, None]
    own = np.where(held, law_jumps(wingbeat, harmonics.names), 0.0) / np.array([1.0, wingbeat.frequency])[:, None]
    inverse = np.linalg.pinv(own.reshape(-1, len(harmonics.names)), rcond=1e-9)
    return Smoother(np.array(numbers), top, inverse.reshape(-1, *top.shape))


def top_of(wingbeat: Wingbeat) -> np.ndarray:
    """Return all laws at the top of the stroke and their rates, shape (laws, 2) [rad, rad/s; shares of the span].

    Parameters
    ----------
    wingbeat : the wingbeat.
    """
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

    Parameters
    ----------
    wingbeat : the undisturbed wingbeat.
    smooth : what keeps the wing from jumping.
    changes : of the inputs, shape (inputs, ...) [Hz, rad or shares].
    inputs, harmonics : their names.
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
    """Return what `parameters_of` returns for one wingbeat, and its derivatives by the changes.

    Parameters
    ----------
    wingbeat, smooth, inputs, harmonics : as in `parameters_of`.
    changes : of the inputs, shape (inputs,) [Hz, rad or shares].
    """

    def at(changes: Any) -> tuple[Any, Any]:
        found = parameters_of(wingbeat, smooth, changes, inputs=inputs, harmonics=harmonics)
        return found, found

    slopes, found = jax.jacfwd(at, has_aux=True)(changes)
    return found, slopes


def changed_wingbeat(
    wingbeat: Wingbeat, smooth: Smoother, inputs: tuple[str, ...], harmonics: tuple[str, ...], changes: np.ndarray
) -> Wingbeat:
    """Return the wingbeat with changed inputs, whose wing does not jump.

    Parameters
    ----------
    wingbeat, smooth, inputs, harmonics : as in `parameters_of`.
    changes : of the inputs, shape (inputs,) [Hz, rad or shares].
    """
    numbers = _parameters_of(wingbeat, smooth, np.asarray(changes, float), inputs=inputs, harmonics=harmonics)
    return with_parameters(wingbeat, dict(zip((*inputs, *harmonics), numbers.tolist(), strict=True)))
