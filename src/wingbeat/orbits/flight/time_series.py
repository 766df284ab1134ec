"""The time series of a flown beat: with exact derivatives for the solver, and along a certified path."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import fusion_barrier, jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, chord_ratio, flap_angle, held_at, pitch_angle, unpack
from wingbeat.mechanics.flight_model import FlightModel, air_loads, motion_table
from wingbeat.mechanics.hinge_torques import HingeMotion, hinge_loads, hinge_motion
from wingbeat.mechanics.state_rates import body_rates, held_wingbeat, rate_table
from wingbeat.mechanics.strip_air import loads_of_strips, velocity_at_wings, wake_of
from wingbeat.mechanics.wing_motion import WingMotion, strips_of, stroke_attitude
from wingbeat.mechanics.wing_shape import to_world
from wingbeat.orbits.flight.beat import BY_STRIP, NUMBERS, Beat
from wingbeat.orbits.flight.period import STEPS, Flown

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        FieldByFree,
        FieldByState,
        FieldTangents,
        Free,
        Pair,
        Path,
        PitchState,
        PitchTangents,
        Samples,
        Scalar,
        Triple,
    )


# Fields that take longer than the others, grouped by the cause: columns of strips, and a third motion of the wing.
_DEAR = (frozenset(BY_STRIP), frozenset({"actuator_power"}))


class _Tables(NamedTuple):
    """Tables of the wing's motion at given phases; the body's motion does not affect them."""

    phase: Samples
    motion: WingMotion
    hinges: HingeMotion
    flap: Samples
    wing_pitch: Samples
    frequency: Scalar
    flap_amplitude: Scalar
    chord_ratio: Samples | None


def _tabulate(model: FlightModel, wingbeat: Wingbeat, phase: Samples) -> _Tables:
    return _Tables(
        phase,
        motion_table(model, wingbeat, phase),
        hinge_motion(model, wingbeat, phase),
        flap_angle(wingbeat, phase),
        pitch_angle(wingbeat, phase),
        jnp.asarray(wingbeat.frequency, dtype=float),
        jnp.asarray(wingbeat.flap_amplitude, dtype=float),
        chord_ratio(wingbeat, phase),
    )


def _series(
    model: FlightModel, tables: _Tables, path: PitchState, mean_velocity: Pair, given: Triple | None = None
) -> Beat:
    """Return the series; `given` has the accelerations of a body whose wing's pitch gives way."""
    motion = tables.motion
    body = fusion_barrier(body_rates(model, motion, path)[1:4]) if given is None else given
    wake = wake_of(model, motion, path)
    body_pitch, u, w, pitch_rate = path if wake is None else path[:4]
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    loads = air_loads(model, motion, attitude, u, w, pitch_rate, body, wake)
    force_x, force_z = to_world(attitude, *loads.force)
    velocity = velocity_at_wings(model, attitude, u, w)
    strips = loads_of_strips(model, motion, velocity, pitch_rate, wake)
    hinges = hinge_loads(model, motion, tables.hinges, path, body)
    chord = strips_of(model.vehicle.wing, model.strips).chord
    if tables.chord_ratio is not None:
        chord = tables.chord_ratio[:, None] * chord
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


@exported(static=("free", "fields"))
def _part(
    model: FlightModel,
    wingbeat: Wingbeat,
    values: Free,
    path: PitchState,
    tangents: PitchTangents,
    ends: Pair,
    mean_velocity: Pair,
    *,
    free: tuple[str, ...],
    fields: tuple[str, ...],
) -> tuple[Beat, Beat]:
    """Return fields of the beat between two phases, and their derivatives, whose first axis is the unknowns."""
    phase = ends[0] + (ends[1] - ends[0]) * jnp.arange(STEPS + 1) / STEPS

    if wingbeat.pitch_hinge is not None:
        return _giving_part(model, wingbeat, values, path, tangents, phase, mean_velocity, free, fields)
    tables, along = jax.linearize(lambda at: _tabulate(model, unpack(free, wingbeat, at), phase), values)
    # The barrier keeps each direction from computing the tables again.
    tables, table_tangents = fusion_barrier((tables, jax.vmap(along)(jnp.eye(len(free)))))
    # A direction changes either the tables or the state. Separate derivatives save the zeros of the unchanged part.

    def series(tables: _Tables, path: Any) -> Beat:
        return _series(model, tables, path, mean_velocity).only(fields)

    found, by_table = jax.linearize(lambda table: series(table, path), tables)
    by_path = jax.linearize(lambda at: series(tables, at), path)[1]
    if model.wake is not None:
        # The path has more components than there are directions.
        still = jax.tree_util.tree_map(lambda a: jnp.zeros((4, *a.shape[1:])), table_tangents)
        whole = jax.tree_util.tree_map(lambda a, b: jnp.concatenate([a, b]), still, table_tangents)
        along_both = jax.vmap(lambda table, state: jax.tree_util.tree_map(jnp.add, by_table(table), by_path(state)))
        return found, along_both(whole, tangents)
    own = jax.vmap(by_table)(table_tangents)
    by_state = jax.vmap(by_path)(jnp.broadcast_to(jnp.eye(4)[..., None], (4, 4, len(phase))))
    return found, jax.tree_util.tree_map(lambda own, state: _along_path(own, state, tangents), own, by_state)


def _giving_part(
    model: FlightModel,
    wingbeat: Wingbeat,
    values: Free,
    path: PitchState,
    tangents: PitchTangents,
    phase: Samples,
    mean_velocity: Pair,
    free: tuple[str, ...],
    fields: tuple[str, ...],
) -> tuple[Beat, Beat]:
    """Do what `_part` does for a wing whose pitch gives way: its tables depend on the path, too."""
    # Tangents of all unknowns, in three steps with a barrier after each: rates, tables, series.
    own = jnp.concatenate([jnp.zeros((4, len(free))), jnp.eye(len(free))])

    def rates_of(at: Any, state: Any) -> Any:
        return body_rates(model, rate_table(model, unpack(free, wingbeat, at), phase), state)

    def tables_of(at: Any, angle: Any, rate: Any, acceleration: Any) -> _Tables:
        held = held_at(unpack(free, wingbeat, at), phase, angle, rate, acceleration)
        return _tabulate(model, held, phase)

    def series_of(tables: _Tables, state: Any, body: Any) -> Beat:
        return _series(model, tables, state, mean_velocity, body).only(fields)

    rates, along = jax.linearize(rates_of, values, path)
    rates, rate_tangents = fusion_barrier((rates, jax.vmap(along)(own, tangents)))
    hinge = path[4], path[5], rates[5]
    tables, along = jax.linearize(tables_of, values, *hinge)
    turned = jax.vmap(along)(own, tangents[:, 4], tangents[:, 5], rate_tangents[:, 5])
    tables, table_tangents = fusion_barrier((tables, turned))
    found, along = jax.linearize(series_of, tables, path[:4], rates[1:4])
    return found, jax.vmap(along)(table_tangents, tangents[:, :4], rate_tangents[:, 1:4])


def _along_path(own: FieldByFree, by_state: FieldByState, tangents: PitchTangents) -> FieldTangents:
    """Return the derivatives of a field: `own`, at a fixed path, plus those by the path at each sample's phase."""
    change = jnp.concatenate([jnp.zeros((4, *own.shape[1:])), own])
    if own.ndim == 1:  # a number
        return change
    places = (slice(None), slice(None), *[None] * (own.ndim - 2))
    return change + sum(tangents[:, j][places] * by_state[j] for j in range(4))


def beat_reader(
    model: FlightModel,
    wingbeat: Wingbeat,
    free: tuple[str, ...],
    mean_velocity: tuple[float, float],
    fields: tuple[str, ...] = Beat._fields,
) -> Callable[[np.ndarray, Flown], tuple[Beat, Beat]]:
    """Return a function of parameters and their flight that computes the beat and its derivatives by the unknowns.

    Fields that take long are computed only if they are named; otherwise they are None.
    """
    # All others cost little, so that few programs serve all objectives and limits.
    dear = frozenset[str]().union(*(group for group in _DEAR if group.isdisjoint(fields)))
    computed = tuple(name for name in Beat._fields if name != "drive" and name not in dear)
    part = _part.bind(model, wingbeat, free=free, fields=computed)
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
    """Join parts of a beat along the axis of phases; neighbours share the sample between them."""

    def join(name: str) -> Any:
        if name == "drive":
            return pieces[0].drive
        if getattr(pieces[0], name) is None:
            return None
        parts = [np.asarray(getattr(piece, name)) for piece in pieces]
        if name in NUMBERS:
            return parts[0]
        after = [part.take(range(1, part.shape[axis]), axis) for part in parts[1:]]
        return np.concatenate([parts[0], *after], axis)

    return Beat(*(join(name) for name in Beat._fields))


@exported
def flown_beat(model: FlightModel, wingbeat: Wingbeat, phase: Samples, path: Path, mean_velocity: Pair) -> Beat:
    """Return the time series of a path of pitch states, flown at equal phases from 0 to 1, both ends included."""
    states, body = path.T, None
    if wingbeat.pitch_hinge is not None:
        wingbeat, rates = held_wingbeat(model, wingbeat, phase, states)
        states, body = states[:4], rates[1:4]
    return _series(model, _tabulate(model, wingbeat, phase), states, mean_velocity, body)
