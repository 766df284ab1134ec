"""One beat as a time series, with its exact derivatives along the unknowns: what quantities are read off."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from wingbeat._jax.config import jax, jnp
from wingbeat._jax.elementwise_jvp import settled
from wingbeat._jax.exported import stored
from wingbeat.kinematics import Wingbeat, flap_angle, pitch_angle, unpack
from wingbeat.mechanics.body_dynamics import strip_loads
from wingbeat.mechanics.flight_model import FlightModel, air_loads, body_rates, motion_table
from wingbeat.mechanics.frames import from_world, to_world
from wingbeat.mechanics.hinge_torques import HingeMotion, hinge_loads, hinge_motion
from wingbeat.mechanics.wing_motion import WingMotion, strips_of, stroke_attitude
from wingbeat.orbits.flight.shooting import STEPS, Flown


class Beat(NamedTuple):
    """One beat from phase 0 to 1, both ends included, at equal phases: arrays of shape (K,), SI and radians.

    Names and units are those of a dataset. ``alpha``, ``strip_reynolds``, ``lift`` and ``drag`` are those of the
    strips of one wing, shape (K, strips). Torques and powers are of both wings together, ``force_x`` and
    ``force_z`` the air load on the whole vehicle. ``frequency`` [Hz], ``flap_amplitude`` [rad], ``speed`` and
    ``climb`` [m/s], ``mass`` [kg], ``weight`` [N] and ``semi_span`` [m] are numbers.
    """

    phase: Any
    time: Any
    body_pitch: Any
    u: Any
    w: Any
    pitch_rate: Any
    u_rate: Any
    w_rate: Any
    pitch_acceleration: Any
    flap: Any
    flap_rate: Any
    wing_pitch: Any
    wing_pitch_rate: Any
    flap_torque: Any
    pitch_torque: Any
    hinge_power: Any
    actuator_power: Any
    aerodynamic_power: Any
    inertial_power: Any
    body_power: Any
    alpha: Any
    strip_reynolds: Any
    lift: Any
    drag: Any
    force_x: Any
    force_z: Any
    frequency: Any
    flap_amplitude: Any
    speed: Any
    climb: Any
    mass: Any
    weight: Any
    semi_span: Any

    def mean(self, values: Any) -> Any:
        """Return the mean of a series over the beat, by the trapezoidal rule."""
        return jnp.mean(0.5 * (values[:-1] + values[1:]))

    def mean_positive(self, values: Any) -> Any:
        """Return the mean of the positive part of a series, which runs straight between its samples."""
        return mean_positive(values)


def mean_positive(values: Any, xp: Any = jnp) -> Any:
    """Return the mean of the positive part of samples at equal phases, straight lines between them.

    Unlike the mean of the samples' positive parts it has a derivative where a sample passes zero. `xp` is the array
    module of the samples.
    """
    before, after = values[:-1], values[1:]
    crosses = before * after < 0.0
    part = xp.maximum(before, after) ** 2 / xp.where(crosses, xp.abs(before - after), 1.0)
    whole = xp.maximum(before, 0.0) + xp.maximum(after, 0.0)
    return 0.5 * xp.mean(xp.where(crosses, part, whole))


# Numbers of a beat that are no series.
NUMBERS = ("frequency", "flap_amplitude", "speed", "climb", "mass", "weight", "semi_span")


class _Tables(NamedTuple):
    """What the wing does at given phases, whatever the body does."""

    phase: Any
    motion: WingMotion
    hinges: HingeMotion
    flap: Any
    wing_pitch: Any
    frequency: Any
    flap_amplitude: Any


def _tabulate(model: FlightModel, wingbeat: Wingbeat, phase: Any) -> _Tables:
    return _Tables(
        phase,
        motion_table(model, wingbeat, phase),
        hinge_motion(model.vehicle, wingbeat, phase, model.strips),
        flap_angle(wingbeat, phase),
        pitch_angle(wingbeat, phase),
        jnp.asarray(wingbeat.frequency, dtype=float),
        jnp.asarray(wingbeat.flap_amplitude, dtype=float),
    )


def _series(model: FlightModel, tables: _Tables, path: Any, mean_velocity: Any) -> Beat:
    motion = tables.motion
    body = settled(body_rates(model, motion, path)[1:])
    body_pitch, u, w, pitch_rate = path
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    loads = air_loads((model, motion), *from_world(attitude, u, w), pitch_rate)
    force_x, force_z = to_world(attitude, *loads.force)
    strips = strip_loads(model.kernel, model.air.density, motion, from_world(attitude, u, w), pitch_rate)
    hinges = hinge_loads(model, motion, tables.hinges, path, body)
    chord = strips_of(model.vehicle.wing, model.strips).chord
    return Beat(
        phase=tables.phase,
        time=tables.phase / tables.frequency,
        body_pitch=body_pitch,
        u=u,
        w=w,
        pitch_rate=pitch_rate,
        u_rate=body[0],
        w_rate=body[1],
        pitch_acceleration=body[2],
        flap=tables.flap,
        flap_rate=tables.hinges.flap_rate,
        wing_pitch=tables.wing_pitch,
        wing_pitch_rate=tables.hinges.pitch_rate,
        **hinges._asdict(),
        alpha=strips.alpha.T,
        strip_reynolds=model.air.reynolds(strips.speed.T, chord),
        lift=strips.lift.T,
        drag=strips.drag.T,
        force_x=force_x,
        force_z=force_z,
        frequency=tables.frequency,
        flap_amplitude=tables.flap_amplitude,
        speed=mean_velocity[0],
        climb=mean_velocity[1],
        mass=jnp.asarray(model.vehicle.mass, dtype=float),
        weight=model.vehicle.mass * model.air.gravity,
        semi_span=jnp.asarray(model.vehicle.wing.semi_span, dtype=float),
    )


@stored(static=("free",), hot=True)
def _part(
    model: FlightModel,
    wingbeat: Wingbeat,
    values: Any,
    path: Any,
    tangents: Any,
    ends: Any,
    mean_velocity: Any,
    *,
    free: tuple[str, ...],
) -> tuple[Beat, Beat]:
    """Return the beat between two phases, and its derivatives: directions are the first axis."""
    phase = ends[0] + (ends[1] - ends[0]) * jnp.arange(STEPS + 1) / STEPS

    tables, along = jax.linearize(lambda at: _tabulate(model, unpack(free, wingbeat, at), phase), values)
    directions = jnp.concatenate([jnp.zeros((4, len(free))), jnp.eye(len(free))])
    # Tables are settled so that each direction reads them and does not make them anew.
    tables, table_tangents = settled((tables, jax.vmap(along)(directions)))
    found, change = jax.linearize(lambda table, a: _series(model, table, a, mean_velocity), tables, path)
    return found, jax.vmap(change)(table_tangents, tangents)


def beat_reader(
    model: FlightModel, wingbeat: Wingbeat, free: tuple[str, ...], mean_velocity: tuple[float, float]
) -> Callable[[np.ndarray, Flown], tuple[Beat, Beat]]:
    """Return the beat, and its derivatives along the unknowns (first axis), as a function of a flight.

    The function takes the values of the parameters named in `free`, and what `flier` made of them.
    """
    part = _part.bind(model, wingbeat, free=free)
    velocity = np.array(mean_velocity)

    def read(values: np.ndarray, flown: Flown) -> tuple[Beat, Beat]:
        count = (len(flown.path) - 1) // STEPS
        pieces = []
        for i in range(count):
            here = slice(i * STEPS, (i + 1) * STEPS + 1)
            tangents = flown.path_jacobian[here].transpose(2, 1, 0)
            pieces.append(part(values, flown.path[here].T, tangents, np.array([i, i + 1]) / count, velocity))
        if count == 1:
            return pieces[0]
        beats, changes = zip(*pieces, strict=True)
        return _joined(beats, 0), _joined(changes, 1)

    return read


def _joined(pieces: tuple[Beat, ...], axis: int) -> Beat:
    """Return one beat of its parts along the axis of phases; where two meet they say the same."""

    def join(name: str) -> Any:
        parts = [np.asarray(getattr(piece, name)) for piece in pieces]
        if name in NUMBERS:
            return parts[0]
        after = [part.take(range(1, part.shape[axis]), axis) for part in parts[1:]]
        return np.concatenate([parts[0], *after], axis)

    return Beat(*(join(name) for name in Beat._fields))


@stored
def flown_beat(model: FlightModel, wingbeat: Wingbeat, phase: Any, path: Any, mean_velocity: Any) -> Beat:
    """Return the beat of states that were flown.

    Parameters
    ----------
    model, wingbeat : what flies.
    phase, path : equal phases from 0 to 1, shape (K,), and (body_pitch, u, w, pitch_rate) there, shape (K, 4)
        [rad, m/s, m/s, rad/s].
    mean_velocity : forward and up [m/s].
    """
    return _series(model, _tabulate(model, wingbeat, phase), path.T, mean_velocity)
