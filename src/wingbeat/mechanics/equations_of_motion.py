"""The five-coordinate equations of motion ``D q'' + C q' + h + g = tau + f_aero`` as arrays.

Coordinates q = (x, z, body pitch psi, flap phi, root wing pitch theta); both wings are counted. Span and fold are
functions of time, so the equations are rheonomic; for rigid wings h vanishes and they are those of Su et al. 2023
(doi 10.48550/arXiv.2302.09602). Every term is a sum over mass points of partial velocities ``dr/dq``, which are
exact derivatives of the wing's position (`wing_shape.wing_shape`).
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from wingbeat._base import FaultList
from wingbeat._jax.arrays import in_own_settings, jax, jnp
from wingbeat._jax.exported import jit_soon
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.pitch_hinge import PitchHinge
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.flights import integrate
from wingbeat.mechanics.state_rates import refuse_without_motion
from wingbeat.mechanics.strip_air import is_unsteady, refuse_without_wake
from wingbeat.mechanics.wing_points import (
    AirForces,
    WingPoints,
    air_forces_on,
    partial_velocities,
    point_motion,
    wing_points,
)
from wingbeat.mechanics.wing_shape import strips_of

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        CoordinateMatrix,
        Coordinates,
        Integrated,
        MassPoints,
        Pair,
        Phases,
        Samples,
        Scalar,
        StartState,
    )


class EquationsOfMotion(NamedTuple):
    """The terms on the left of the equations of motion ``D q'' + C q' + h + g = tau + f_aero``.

    Each array may have further leading axes.

    C is in Christoffel form: ``D' - 2 C`` is skew for rigid wings.

    Attributes
    ----------
    mass_matrix : D, shape (..., 5, 5) [kg, kg m, kg m2].
    velocity_matrix : C, shape (..., 5, 5).
    time_force : h, generalised force that arises because span, fold, sweep and twist are prescribed functions of
        time; zero for rigid wings; shape (..., 5) [N, N m].
    gravity_force : g, generalised force of gravity; shape (..., 5) [N, N m].
    """

    mass_matrix: CoordinateMatrix
    velocity_matrix: CoordinateMatrix
    time_force: Coordinates
    gravity_force: Coordinates


def refuse_unknown_twist(wingbeat: Wingbeat) -> None:
    """Refuse a hinge that twists the wing, whose angle is no coordinate; one that turns it whole is the fifth."""
    if isinstance(wingbeat.pitch_hinge, PitchHinge) and wingbeat.pitch_hinge.twist_share:
        refuse_without_motion(wingbeat)


def drift_velocities(model: FlightModel, wingbeat: Wingbeat, q: Coordinates, time: Scalar) -> WingPoints:
    """Return ``dr/dt`` of all wing points at fixed q [m/s]. Theory: equation ``drift``."""
    return jax.jvp(lambda t: wing_points(model, wingbeat, q, t), (time,), (jnp.ones_like(time),))[1]


def bias_accelerations(
    model: FlightModel, wingbeat: Wingbeat, q: Coordinates, q_dot: Coordinates, time: Scalar
) -> tuple[MassPoints, MassPoints]:
    """Return the mass points' ``d(dr/dq)/dq q'`` (last axis of five) and ``d2r/dt2 + 2 d2r/dqdt q'``.

    Theory: equations ``time-force`` and ``frozen-motion``.
    """

    def by_q(at: Coordinates) -> Any:
        return partial_velocities(model, wingbeat, at, time).mass

    def by_time(at: Coordinates, when: Scalar) -> Any:
        return drift_velocities(model, wingbeat, at, when).mass

    still, one = jnp.zeros_like(time), jnp.ones_like(time)
    partial_rate = jax.jvp(by_q, (q,), (q_dot,))[1]
    return partial_rate, jax.jvp(by_time, (q, time), (2.0 * q_dot, still))[1] + jax.jvp(
        by_time, (q, time), (jnp.zeros_like(q), one)
    )[1]


def _terms(
    model: FlightModel, wingbeat: Wingbeat, q: Coordinates, q_dot: Coordinates, time: Phases
) -> EquationsOfMotion:
    """Return them at one instant. Theory: equations ``mass-matrix``, ``velocity-matrix`` and ``gravity-force``."""
    # A point has half a strip's mass, and there are two wings.
    body, mass = model.vehicle.body, strips_of(model.vehicle.wing, model.strips).mass
    partial = partial_velocities(model, wingbeat, q, time).mass
    partial_rate, drift_rate = bias_accelerations(model, wingbeat, q, q_dot, time)
    own = jnp.diag(jnp.asarray([body.mass, body.mass, body.pitch_inertia, 0.0, 0.0]))
    down = model.air.gravity * jnp.asarray([0.0, 0.0, 1.0])
    return EquationsOfMotion(
        own + jnp.einsum("n,knai,knaj->ij", mass, partial, partial),
        jnp.einsum("n,knai,knaj->ij", mass, partial, partial_rate),
        jnp.einsum("n,knai,kna->i", mass, partial, drift_rate),
        jnp.einsum("n,knai,a->i", mass, partial, down) + jnp.zeros(5).at[1].set(body.mass * model.air.gravity),
    )


def accelerations_from_torques(
    model: FlightModel, wingbeat: Wingbeat, q: Coordinates, q_dot: Coordinates, time: Phases, torques: Pair
) -> Coordinates:
    """Return q'' of a vehicle whose hinges are driven by torques. Theory: equation ``torque-driven``."""
    terms = _terms(model, wingbeat, q, q_dot, time)
    air = _air_forces(model, wingbeat, q, q_dot, time)
    tau = jnp.concatenate([jnp.zeros(3), jnp.asarray(torques)])
    inertia = terms.mass_matrix + air.added_mass if is_unsteady(model) else terms.mass_matrix
    applied = tau + air.generalised
    return jnp.linalg.solve(inertia, applied - resistance(terms, q_dot))


def resistance(terms: EquationsOfMotion, q_dot: Coordinates) -> Coordinates:
    """Return ``C q' + h + g``, shape (5,) [N, N m]."""
    return terms.velocity_matrix @ q_dot + terms.time_force + terms.gravity_force


def _air_forces(
    model: FlightModel,
    wingbeat: Wingbeat,
    q: Coordinates,
    q_dot: Coordinates,
    time: Phases,
    q_acceleration: Coordinates | None = None,
) -> AirForces:
    motion = point_motion(model, wingbeat, q, q_dot, time)
    return air_forces_on(model, wingbeat, q, q_dot, time, motion, q_acceleration)


def _torque(
    model: FlightModel,
    wingbeat: Wingbeat,
    q: Coordinates,
    q_dot: Coordinates,
    time: Phases,
    q_acceleration: Coordinates,
) -> Coordinates:
    terms = _terms(model, wingbeat, q, q_dot, time)
    air = _air_forces(model, wingbeat, q, q_dot, time, q_acceleration).generalised
    return terms.mass_matrix @ q_acceleration + resistance(terms, q_dot) - air


@functools.partial(jit_soon, static_argnums=0)
def _over_axes(
    function: Callable[..., Any], model: FlightModel, wingbeat: Wingbeat, time: Phases, *vectors: Any
) -> Any:
    """Apply a function of q, q', time and perhaps q'' to arrays with any leading axes."""
    refuse_without_wake(model)
    refuse_unknown_twist(wingbeat)
    moment, *rows = (jnp.asarray(a, dtype=float) for a in (time, *vectors))
    axes = jnp.broadcast_shapes(moment.shape, *(row.shape[:-1] for row in rows))
    flat = [jnp.broadcast_to(row, (*axes, 5)).reshape(-1, 5) for row in rows]
    times = jnp.broadcast_to(moment, axes).ravel()
    found = jax.vmap(lambda t, q, q_dot, *more: function(model, wingbeat, q, q_dot, t, *more))(times, *flat)
    return jax.tree_util.tree_map(lambda a: a.reshape(*axes, *a.shape[1:]), found)


@in_own_settings
def equations_of_motion(
    model: FlightModel, wingbeat: Wingbeat, q: Coordinates, q_dot: Coordinates, time: Phases
) -> EquationsOfMotion:
    """Return the terms of the five-coordinate equations of motion ``D q'' + C q' + h + g = tau + f_aero``.

    Source: Su et al. 2023 (doi 10.48550/arXiv.2302.09602); h is added for prescribed span, fold, sweep and twist.

    Theory: equation ``equations-of-motion``.

    Parameters
    ----------
    model : the flight model.
    wingbeat : gives span, fold, sweep and twist as functions of time; its flap and pitch laws do not enter.
    q, q_dot : (x, z, body pitch, flap, root wing pitch) and rates, shape (..., 5) [m, rad; per s].
    time : [s], shape (...).

    Returns
    -------
    EquationsOfMotion : ``mass_matrix`` D and ``velocity_matrix`` C of shape (..., 5, 5), ``time_force`` h and
        ``gravity_force`` g of shape (..., 5); JAX arrays, so that they can be differentiated.

    Raises
    ------
    InvalidInputError : a model with the lag of the wake.

    >>> import numpy as np, wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    >>> terms = wb.equations_of_motion(model, pigeon.wingbeat, np.zeros(5), np.zeros(5), 0.0)
    >>> round(float(terms.mass_matrix[0, 0]), 3)
    0.316
    """
    return _over_axes(_terms, model, wingbeat, time, q, q_dot)


@in_own_settings
def air_forces(
    model: FlightModel,
    wingbeat: Wingbeat,
    q: Coordinates,
    q_dot: Coordinates,
    time: Phases,
    q_acceleration: Coordinates | None = None,
) -> AirForces:
    """Return the generalised air loads f_aero of both wings and the body, and the loads of the strips.

    Parameters
    ----------
    model, wingbeat, q, q_dot, time : as in `equations_of_motion`.
    q_acceleration : q'', for the added mass, shape (..., 5) [m/s2, rad/s2]; None leaves this part out.

    Returns
    -------
    AirForces : ``generalised`` is f_aero, shape (..., 5) [N, N m].

    Raises
    ------
    InvalidInputError : a model with the lag of the wake.

    >>> import numpy as np, wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, "su-fan")
    >>> forward = np.array([10.0, 0.0, 0.0, 0.0, 0.0])
    >>> wb.air_forces(model, pigeon.wingbeat, np.zeros(5), forward, 0.0).generalised.shape
    (5,)
    """
    more = () if q_acceleration is None else (q_acceleration,)
    return _over_axes(_air_forces, model, wingbeat, time, q, q_dot, *more)


@in_own_settings
def generalised_torques(
    model: FlightModel,
    wingbeat: Wingbeat,
    q: Coordinates,
    q_dot: Coordinates,
    q_acceleration: Coordinates,
    time: Phases,
) -> Coordinates:
    """Return the generalised force that must act on the coordinates, ``tau = D q'' + C q' + h + g - f_aero``.

    Theory: equation ``generalised-torques``.

    Parameters
    ----------
    model, wingbeat, q, q_dot, time : as in `equations_of_motion`.
    q_acceleration : q'' of shape (..., 5) [m/s2, rad/s2].

    Returns
    -------
    tau of shape (..., 5). The first three components are zero in free flight [N, N, N m]; the others are the flap
    and pitch hinge torques of both wings together [N m].

    Raises
    ------
    InvalidInputError : a model with the lag of the wake.

    >>> import numpy as np, wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, "su-fan")
    >>> rest = np.zeros(5)
    >>> tau = wb.generalised_torques(model, pigeon.wingbeat, rest, rest, rest, 0.0)
    >>> round(float(tau[1]) / pigeon.vehicle.mass, 2)  # what holds it up in still air: its weight
    9.81
    """
    return _over_axes(_torque, model, wingbeat, time, q, q_dot, q_acceleration)


# Most steps of the integrator in a flight with driven wings, see `integrate`.
_IN_A_FLIGHT = 4096


@functools.partial(jit_soon, static_argnums=0)
def _drive(
    torques: Any, model: FlightModel, wingbeat: Wingbeat, start: StartState, times: Samples, args: Any
) -> Integrated:
    def rates(time: Scalar, state: Any, args: Any) -> Any:
        q, q_dot = state[:5], state[5:]
        flown, beat, more = args
        torque = torques(time, more)
        return jnp.concatenate([q_dot, accelerations_from_torques(flown, beat, q, q_dot, time, torque)])

    return integrate(rates, start, times, (model, wingbeat, args), _IN_A_FLIGHT)


def fly_torque_driven(
    model: FlightModel,
    wingbeat: Wingbeat,
    coordinates: ArrayLike,
    rates: ArrayLike,
    torques: Callable[[Any, Any], Any],
    times: ArrayLike,
    args: Any = None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fly as `simulate_torque_driven` does; return times (K,), q and q' (K, 5)."""
    refuse_without_wake(model)
    refuse_unknown_twist(wingbeat)
    faults = FaultList()
    q, q_dot, when = (np.asarray(a, dtype=float) for a in (coordinates, rates, times))
    for name, value in (("coordinates", q), ("rates", q_dot)):
        if value.shape != (5,) or not np.isfinite(value).all():
            faults.add(name, value, "must be five finite numbers", "x, z, body_pitch, flap, pitch")
        elif name == "coordinates":
            for i, angle in enumerate(value[2:].tolist(), start=2):
                faults.angle(f"coordinates[{i}]", angle, advice=f"write np.radians({angle:g})")
    if when.ndim != 1 or when.size < 2 or not np.isfinite(when).all() or not (np.diff(when) > 0).all():
        faults.add("times", when, "must be at least two increasing times", "in seconds")
    faults.raise_if_any()
    states = np.asarray(_drive(torques, model, wingbeat, np.concatenate([q, q_dot]), when, args)[0])
    return when, states[:, :5], states[:, 5:]
