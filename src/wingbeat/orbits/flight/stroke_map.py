"""The stroke map of an orbit: how the state after a beat depends on the state before it and on the wingbeat."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from wingbeat.animal.kinematics import Wingbeat, parameter
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.orbits.flight.shooting import Flown, flier

# Distances from the start at which flights begin: (body_pitch, u, w, pitch_rate) [rad, m/s, m/s, rad/s]. The first
# derivatives of a flight are exact to 1e-13, so one-sided differences of them can have steps as short as this.
_BESIDE = (1e-7, 1e-6, 1e-6, 1e-6)


class StrokeMap(NamedTuple):
    """Derivatives of (z, body_pitch, u, w, pitch_rate) after one beat, and of the pitch state along the beat.

    Attributes
    ----------
    by_state : by the same five numbers before the beat, shape (5, 5).
    by_parameters : by parameters of the wingbeat, which hold for the whole beat, shape (5, parameters).
    transition : derivatives of (body_pitch, u, w, pitch_rate) at equal phases from 0 to 1 by the same four at
        phase 0, shape (K, 4, 4).
    path : the four numbers at these phases, shape (K, 4) [rad, m/s, m/s, rad/s].
    """

    by_state: np.ndarray
    by_parameters: np.ndarray
    transition: np.ndarray
    path: np.ndarray


def stroke_map(
    model: FlightModel, wingbeat: Wingbeat, pitch_state: np.ndarray, parameters: tuple[str, ...], blocks: int
) -> StrokeMap:
    """Differentiate one beat, exactly for its fixed steps.

    Theory: equation ``stroke-map``.

    Parameters
    ----------
    model, wingbeat : what flies.
    pitch_state : (body_pitch, u, w, pitch_rate) at phase 0, shape (4,) [rad, m/s, m/s, rad/s].
    parameters : names of the parameters of the wingbeat, at least one.
    blocks : number of blocks of 32 steps.
    """
    fly = flier(model, wingbeat, parameters, whole_path=True)
    values = np.array([parameter(wingbeat, name) for name in parameters], dtype=float)
    flown = fly(values, np.asarray(pitch_state, dtype=float), blocks)
    end = np.asarray(flown.end_jacobian)[1:]
    height = np.eye(5, 1)  # the flight does not depend on the height
    return StrokeMap(
        np.hstack([height, end[:, :4]]),
        end[:, 4:],
        np.asarray(flown.path_jacobian)[..., :4],
        np.asarray(flown.path),
    )


def map_and_changes(
    fly: Callable[..., Flown], values: np.ndarray, start: np.ndarray, blocks: int, flown: Flown
) -> tuple[np.ndarray, np.ndarray]:
    """Return the stroke map of (body_pitch, u, w, pitch_rate), shape (4, 4), and its derivatives by the unknowns.

    The derivatives have the shape (unknowns, 4, 4). They are second derivatives of the flight, which do not depend
    on the order of differentiation. So we shift each of the four states in turn, and take the change of the exact
    first derivatives by all unknowns. This takes four flights, however many parameters are free.

    Parameters
    ----------
    fly : as `flier` returns it.
    values, start, blocks : the arguments of `fly`.
    flown : the flight with these arguments.
    """
    here = np.asarray(flown.end_jacobian)[2:]
    beside = [np.asarray(fly(values, start + step, blocks).end_jacobian)[2:] for step in np.diag(_BESIDE)]
    changes = [(there - here) / step for there, step in zip(beside, _BESIDE, strict=True)]
    return here[:, :4], np.stack(changes, axis=-1).transpose(1, 0, 2)
