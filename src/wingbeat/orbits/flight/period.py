"""One period flown with fixed steps, and the exact derivative of its end.

First, the states are computed, step after step. Then the tangents of all steps are computed at once, as lanes; the
tangents of each step start from the state at its start. Last, the step maps are multiplied. The position (x, z)
does not affect the flight: it is a sum over the steps. With inner states, `lagged` does the last two.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import fusion_barrier, jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, unpack
from wingbeat.animal.vehicle import Vehicle
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.state_rates import GivingStroke, body_rates, rate_table, rates_by_wake, slopes_with_hinge
from wingbeat.mechanics.wing_motion import WingMotion, strips_of
from wingbeat.mechanics.wing_shape import LEADING, TRAILING, flap_angles, has_room, lateral_corner, lateral_corners
from wingbeat.orbits.flight.lagged import InnerStart, RepeatingStates, chained
from wingbeat.orbits.flight.march import (
    ALONG,
    AT_STAGES,
    STEPS,
    WEIGHTS,
    March,
    along_stages,
    combined,
    from_rows,
    in_lanes,
)
from wingbeat.orbits.search_options import WAKE, WakeOptions

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        EndJacobian,
        FlightState,
        FlownPath,
        Free,
        FreeTangents,
        LinearMap,
        MappedTangents,
        PathJacobian,
        PitchState,
        Samples,
        Scalar,
        Stages,
        StateTangents,
        StateVector,
        StrokeIndices,
        StrokeJacobian,
        StrokeRows,
        StrokeSeries,
        TableRows,
        TableTangents,
        Tangents,
    )

# The state that a period closes, and residuals that matter, in the same units [m, rad, m/s, rad/s].
PITCH_STATE = ("body_pitch", "u", "w", "pitch_rate")
CLOSURE = ("x", "z", *PITCH_STATE)
CLOSURE_SCALE = np.array([0.1, 0.1, 0.1, 1.0, 1.0, 10.0])
# The balances of forces and moment, each with the velocity that changes over the period if it fails.
THRUST, LIFT, MOMENT = "thrust", "lift", "pitching moment"
BALANCES = {THRUST: "u", LIFT: "w", MOMENT: "pitch_rate"}
PATH_NAMES = ("body_pitch", "flap")  # bounded along the whole path; flap is that of arm and hand

# --- How close a stroke comes to its limits: the plane of symmetry, and the range of the shoulder. ---
# Each row is the least distance from a limit: of the strips' leading and trailing corners in each quarter of the
# beat, of the flap angles of arm and hand over the whole beat.
QUARTERS = 4
# Name of the corners' limit among the active bounds.
SYMMETRY = "plane_of_symmetry"
# Number of sampled phases, and of steps of Newton's method from the least sample to the minimum. The eighth and
# highest harmonic has eight samples in each period. One step leaves an error of 7e-5 in the derivative,
# two steps leave 1e-8.
_SAMPLES, _NEWTON = 64, 2
# Name and sign of each row's limit.
ROWS = (*[(SYMMETRY, ">=")] * 2 * QUARTERS, *[("flap", ">=")] * 2, *[("flap", "<=")] * 2)

# Phases between which the minimum of each row is sought: for corners a quarter of the beat, for angles the whole
# beat.
_BEGIN = np.array([*np.tile(np.arange(QUARTERS) / QUARTERS, 2), *[0.0] * 4])
_END = np.array([*np.tile((np.arange(QUARTERS) + 1) / QUARTERS, 2), *[1.0] * 4])


def _series(vehicle: Vehicle, wingbeat: Wingbeat, phase: Samples, strips: int) -> StrokeSeries:
    """Return the series whose minima are the rows: corner distances in wing lengths, and angles; (4 N + 4, K)."""
    corners = [edge / vehicle.wing.semi_span for edge in lateral_corners(vehicle, wingbeat, phase, count=strips)]
    angles = flap_angles(wingbeat, phase)
    return jnp.concatenate([*corners, angles, -angles])


def _places(sampled: StrokeSeries, strips: int) -> tuple[StrokeIndices, StrokeIndices]:
    """Return, for each row, the index of the series with the least value, and the index of that sample."""
    # The sample is found first, from the minimum over all corners at each phase: XLA on CPU vectorises a minimum,
    # but not the search for its index.
    part = (sampled.shape[1] - 1) // QUARTERS
    quarters = np.arange(QUARTERS)[:, None] * part + np.arange(part + 1)
    corners = sampled[: 4 * strips].reshape(2, 2 * strips, -1)
    nearest = jnp.min(corners, axis=1)[:, quarters]
    place = quarters[:, 0] + jnp.argmin(nearest, axis=-1)
    corner = jnp.argmin(jnp.take_along_axis(corners, place[:, None], axis=2), axis=1)
    series = jnp.append((2 * strips * np.arange(2)[:, None] + corner).ravel(), 4 * strips + np.arange(4))
    return series, jnp.append(place.ravel(), jnp.argmin(sampled[4 * strips :], axis=-1))


def least_distances(vehicle: Vehicle, wingbeat: Wingbeat, strips: int) -> StrokeRows:
    """Return the least distance of each row, with derivatives at a fixed corner and phase, exact at a minimum."""
    samples = jnp.arange(_SAMPLES + 1) / _SAMPLES
    series, place = _places(jax.lax.stop_gradient(_series(vehicle, wingbeat, samples, strips)), strips)
    phase = place / _SAMPLES
    trailing, corner = jnp.divmod(series[: 2 * QUARTERS], 2 * strips)
    outer, strip = jnp.divmod(corner, strips)
    of_corners = jax.tree_util.tree_map(lambda a: a[strip], strips_of(vehicle.wing, strips))

    def distance(at: Samples) -> Samples:
        share, side = jnp.where(trailing, TRAILING, LEADING), 2.0 * outer - 1.0
        return lateral_corner(vehicle, wingbeat, of_corners, share, side, at, strips) / vehicle.wing.semi_span

    def angle(at: Samples) -> Samples:
        angles = flap_angles(wingbeat, at)
        return jnp.stack([angles[0, 0], angles[1, 1], -angles[0, 2], -angles[1, 3]])

    corners, angles = slice(2 * QUARTERS), slice(2 * QUARTERS, None)
    return jnp.concatenate([_at_least(distance, phase, corners), _at_least(angle, phase, angles)])


def _at_least(value: Callable[[Any], Any], phase: StrokeRows, rows: slice) -> Samples:
    """Return the minima of some rows, by Newton's method from the phases of the least samples."""
    phase = phase[rows]
    for _ in range(_NEWTON):
        one = jnp.ones_like(phase)
        slope, bend = jax.jvp(lambda at: jax.jvp(value, (at,), (one,))[1], (phase,), (one,))  # noqa: B023
        step = jnp.where(bend > 0, -slope / jnp.where(bend > 0, bend, 1.0), 0.0)
        phase = jnp.clip(phase + jnp.clip(step, -1.0 / _SAMPLES, 1.0 / _SAMPLES), _BEGIN[rows], _END[rows])
    return value(jax.lax.stop_gradient(phase))


# --- The derivative of a flight. ---
class Flown(NamedTuple):
    """A period flown from x = z = 0, and its derivatives by (body_pitch, u, w, pitch_rate, free parameters).

    `path` is body pitch, or the whole pitch state, at the start and after each step. The last axis of each Jacobian
    is the unknowns. The distances of the stroke from its limits are None unless requested.
    """

    end: StateVector
    path: FlownPath
    end_jacobian: EndJacobian
    path_jacobian: PathJacobian
    stroke: StrokeRows = None
    stroke_jacobian: StrokeJacobian = None
    inner: InnerStart | None = None  # at the start, with inner states, unless the flight diverges

    @property
    def stroke_map(self) -> np.ndarray:
        """Derivative of the pitch state and of inner states after the period by those before it."""
        # `end_jacobian` holds for inner states that repeat; a disturbance changes them, too.
        return np.asarray(self.end_jacobian)[2:, :4] if self.inner is None else self.inner.stroke_map


def tabulated(
    model: FlightModel, wingbeat: Wingbeat, first: Scalar, last: Scalar
) -> tuple[tuple[TableRows, Scalar], WingMotion | GivingStroke]:
    """Tabulate the wing at the ends of the steps, then at their middles; return rows, a step [s], the table."""
    whole = jnp.arange(STEPS + 1) / STEPS
    phase = first + (last - first) * jnp.concatenate([whole, whole[:-1] + 0.5 / STEPS])
    table = rate_table(model, wingbeat, phase)
    # One array is faster to slice than many.
    rows = jnp.concatenate([leaf.reshape(-1, leaf.shape[-1]) for leaf in jax.tree_util.tree_leaves(table)])
    return (rows, (last - first) / (wingbeat.frequency * STEPS)), table


def march(model: FlightModel, table: TableRows, like: Any, step: Scalar, start: FlightState) -> March:
    """Fly the steps in sequence by the classical Runge-Kutta method."""
    stages = jnp.asarray(ALONG), jnp.asarray(WEIGHTS)

    def advance(state: Any, rows: Any) -> tuple[Any, tuple[Any, Any]]:
        def stage(carry: tuple[Any, Any], given: Any) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
            (rate, mean), (row, along, weight) = carry, given
            here = state + along * step * rate
            rate = body_rates(model, from_rows(row, like), here)
            return (rate, mean + weight * rate), (here, rate)

        nothing = jnp.zeros_like(state)
        (_, mean), flown = jax.lax.scan(stage, (nothing, nothing), (rows, *stages))
        return state + step * mean, flown

    rows = jnp.stack([table.T[part] for part in AT_STAGES], axis=1)
    last, (states, rates) = jax.lax.scan(advance, start, rows)
    return March(states.transpose(2, 1, 0), rates.transpose(2, 1, 0), last)


def _stage_tangents(
    model: FlightModel, table: TableRows, tangents: TableTangents, like: Any, states: Stages
) -> tuple[StateTangents, FreeTangents]:
    """Differentiate the rates of all stages of all steps at once, by state and by free parameter."""
    _, _, by_state, by_free = along_stages(body_rates, model, table, like, states)

    def to_stages(rows: Any) -> Any:
        return rows.reshape(-1, 4, 4, STEPS)

    return to_stages(jax.vmap(by_state)(jnp.eye(4))), to_stages(jax.vmap(by_free)(in_lanes(tangents)))


def _through(by_state: LinearMap, tangents: Tangents) -> MappedTangents:
    """Apply a linear map (4, components, ..), state first, to tangents (directions, 4, ..)."""
    # XLA on CPU vectorises sums of products along the last axis, but not products of small matrices: with `einsum`,
    # a flight takes 1.8 ms in place of 1.6 ms.
    return sum(tangents[:, j, None] * by_state[j] for j in range(4))


def _chain(
    flight: March, by_state: StateTangents, by_free: FreeTangents, step: Scalar, step_tangent: Free, components: int
) -> Flown:
    """Compose the tangents of all stages into those of the period. Theory: equation ``step-chain``.

    Directions are the first axis, components the next, steps the last.
    """
    states, rates = flight.states, flight.rates
    by_free = jnp.concatenate([jnp.zeros((4, *by_free.shape[1:])), by_free])
    lengthen = jnp.pad(step_tangent, (4, 0))[:, None, None]
    first = jnp.broadcast_to(jnp.eye(lengthen.size, 4)[..., None], (lengthen.size, 4, STEPS))
    state_tangents, rate_tangents = [first], []
    for i, advance in enumerate((0.5, 0.5, 1.0, None)):
        rate_tangents.append(fusion_barrier(_through(by_state[:, :, i], state_tangents[i]) + by_free[:, :, i]))
        if advance is not None:
            state_tangents.append(first + advance * (step * rate_tangents[i] + lengthen * rates[:, i]))
    step_map = fusion_barrier(
        first + step * combined(rate_tangents) + lengthen * combined(rates.transpose(1, 0, 2))
    )
    mean_speed = combined(states.transpose(1, 0, 2))[1:3]
    place_map = fusion_barrier(step * combined(state_tangents)[:, 1:3] + lengthen * mean_speed)

    def follow(jacobian: Any, after: Any) -> tuple[Any, Any]:
        return _through(after[:4], jacobian).at[4:].add(after[4:]), jacobian

    last, path = jax.lax.scan(follow, jnp.eye(lengthen.size, 4), step_map.transpose(2, 0, 1))
    place = jnp.sum(_through(place_map[:4], path.transpose(1, 2, 0)), axis=-1)
    place = place.at[4:].add(jnp.sum(place_map[4:], axis=-1))
    return Flown(
        jnp.concatenate([step * jnp.sum(mean_speed, axis=-1), flight.last]),
        jnp.concatenate([states[:components, 0].T, flight.last[None, :components]]),
        jnp.concatenate([place, last], axis=1).T,
        jnp.concatenate([path[:, :, :components], last[None, :, :components]]).transpose(0, 2, 1),
    )


@exported(static=("free", "components", "stroke"))
def fly_part(
    model: FlightModel,
    wingbeat: Wingbeat,
    values: Free,
    start: PitchState,
    first: Scalar,
    last: Scalar,
    *,
    free: tuple[str, ...],
    components: int,
    stroke: bool,
) -> Flown:
    """Fly `STEPS` steps between two phases, and differentiate. Theory: equation ``runge-kutta``.

    The part from phase 0 also returns the least distances of the stroke from its limits over the whole beat: a
    separate program for them would double the cost.
    """

    def by_values(at: Any) -> Any:
        return tabulated(model, unpack(free, wingbeat, at), first, last)

    (table, step), along, like = jax.linearize(by_values, values, has_aux=True)
    tangents, step_tangent = jax.vmap(along)(jnp.eye(len(free)))
    table, tangents = fusion_barrier((table, tangents))
    flight = march(model, table, like, step, start)
    if start.size > len(PITCH_STATE):
        end, end_jacobian, path_jacobian = chained(
            (body_rates, rates_by_wake, slopes_with_hinge), model, table, tangents, like, flight, step, step_tangent
        )
        path = jnp.concatenate([flight.states[:, 0].T, flight.last[None]])
        flown = Flown(end, path, end_jacobian, path_jacobian)
    else:
        by_state, by_free = _stage_tangents(model, table, tangents, like, flight.states)
        flown = _chain(flight, by_state, by_free, step, step_tangent, components)
    if not stroke:
        return flown

    def near(at: Any) -> tuple[Any, Any]:
        def rows(values: Any) -> Any:
            return least_distances(model.vehicle, unpack(free, wingbeat, values), model.strips)

        found, along = jax.linearize(rows, at)
        return found, jax.vmap(along, out_axes=1)(jnp.eye(len(free)))

    def nothing(at: Any) -> tuple[Any, Any]:
        return jnp.zeros(len(ROWS)), jnp.zeros((len(ROWS), len(free)))

    rows, jacobian = jax.lax.cond(first == 0.0, near, nothing, values)
    return flown._replace(stroke=rows, stroke_jacobian=jacobian)


def flier(
    model: FlightModel,
    wingbeat: Wingbeat,
    free: tuple[str, ...],
    *,
    whole_path: bool = False,
    stroke: bool = False,
    lag: WakeOptions = WAKE,
    repeating: bool = True,
) -> Callable[..., Flown]:
    """Return a function of free parameters and pitch state that flies one period in `blocks` times `STEPS` steps.

    `Flown.path` holds the body pitch alone, or with `whole_path` the whole pitch state, whose derivatives take a
    tenth of a batch's time. With `stroke`, the flight has the distances of the stroke from its limits. Options of
    the lag of the wake are `lag`. Inner states are those that repeat, unless `repeating` is false: then they follow
    the pitch state that the function takes.
    """
    part = fly_part.bind(model, wingbeat, free=free, components=4 if whole_path else 1, stroke=stroke)

    def fly(values: np.ndarray, start: np.ndarray, blocks: int = 1) -> Flown:
        flown = part(values, start, 0.0, 1.0 / blocks)
        for i in range(1, blocks):
            flown = _then(flown, part(values, flown.end[2:], i / blocks, (i + 1) / blocks))
        return flown

    first = inner_start(model, wingbeat)
    return RepeatingStates(fly, first, whole_path, lag) if first.size and repeating else fly


def inner_start(model: FlightModel, wingbeat: Wingbeat) -> np.ndarray:
    """Return inner states to begin with: air at rest in the wake, and a hinge at rest."""
    hinge = wingbeat.pitch_hinge
    at_rest = [] if hinge is None else [hinge.rest_angle, 0.0]
    return np.array([*at_rest, *[0.0] * (0 if model.wake is None else 2 * model.strips)], dtype=float)


def _then(before: Flown, part: Flown) -> Flown:
    """Join two parts that were flown one after the other."""
    chained = before.end_jacobian[2:]
    states = len(chained)

    def from_start(jacobian: Any) -> np.ndarray:
        whole = np.asarray(jacobian)[..., :states] @ chained
        whole[..., states:] += np.asarray(jacobian)[..., states:]
        return whole

    end, end_jacobian = np.array(part.end), from_start(part.end_jacobian)
    end[:2] += before.end[:2]
    end_jacobian[:2] += before.end_jacobian[:2]
    return before._replace(
        end=end,
        path=np.concatenate([before.path, np.asarray(part.path)[1:]]),
        end_jacobian=end_jacobian,
        path_jacobian=np.concatenate([before.path_jacobian, from_start(part.path_jacobian)[1:]]),
    )


class StrokeLimits:
    """Margins of a stroke within its limits, if `limited`; `names` has name and sign of each row.

    `clearance` is the least distance of strip corners from the plane of symmetry in wing lengths, `free` the number
    of free parameters.
    """

    def __init__(
        self, vehicle: Vehicle, low: float, high: float, clearance: float, free: int, *, limited: bool
    ) -> None:
        beside = has_room(vehicle)
        self._kept = slice(0 if beside else 2 * QUARTERS, None if limited else 0)
        self.names = ROWS[self._kept]
        self._free = free
        if not beside:
            low, high = np.clip([low, high], -0.5 * math.pi, 0.5 * math.pi)
        self._limits = np.array([*[clearance] * 2 * QUARTERS, low, low, -high, -high])

    def margins(self, flown: Flown) -> tuple[np.ndarray, np.ndarray]:
        """Return the margin of each row [wing lengths, rad], and the derivative by the free parameters."""
        if not self.names:
            return np.zeros(0), np.zeros((0, self._free))
        return (flown.stroke - self._limits)[self._kept], flown.stroke_jacobian[self._kept]
