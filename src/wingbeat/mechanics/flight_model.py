"""The flight model: vehicle, air loads and air joined into one right-hand side."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat._jax.arrays import at_default, elementwise_jvp, jnp, register_record, unchecked
from wingbeat.aero.blade_element import BladeElement, blade_element_of
from wingbeat.aero.closed_forms import body_drag, check_descent, disc_area, induced_flow
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.vehicle import Air, Vehicle
from wingbeat.mechanics.body_dynamics import BodyLoads, accelerations, body_air, wing_loads
from wingbeat.mechanics.frames import dot, from_world
from wingbeat.mechanics.wing_motion import WingMotion, stroke_attitude, wing_motion

if TYPE_CHECKING:
    from wingbeat._jax.arrays import BodyAcceleration, Component, Pair, Phases, PitchState, Scalar


if TYPE_CHECKING:
    from wingbeat.aero.coefficient_model import Kernel


class State(NamedTuple):
    """The body's state in the world, numbers or arrays of one shape.

    Theory: equation ``body-state``.

    Attributes
    ----------
    x, z : position, forward and up [m].
    body_pitch : nose-up positive [rad].
    u, w : velocity, forward and up [m/s].
    pitch_rate : [rad/s].

    >>> import wingbeat as wb
    >>> start = wb.State(u=10.0)  # for wb.simulate
    >>> start.u, start.body_pitch
    (10.0, 0.0)
    """

    x: Component = 0.0
    z: Component = 0.0
    body_pitch: Component = 0.0
    u: Component = 0.0
    w: Component = 0.0
    pitch_rate: Component = 0.0


def state_of(given: Any) -> State:
    """Return a state that was given as a `State` or as its six numbers.

    Parameters
    ----------
    given : a `State`, or x, z [m], body_pitch [rad], u, w [m/s] and pitch_rate [rad/s] in a list, a tuple or an
        array, shape (6,).

    Raises
    ------
    InvalidInputError : not six numbers, some number is not finite, a body pitch above pi.

    >>> state_of(np.array([0.0, 0.0, 0.1, 10.0, 0.0, 0.0])).u
    10.0
    """
    faults = FaultList()
    if isinstance(given, State):
        values = list(given)
    else:
        values = np.asarray(given).tolist() if hasattr(given, "__array__") else given
        if not isinstance(values, list | tuple) or np.shape(values) != (len(State._fields),):
            told = f"shape {np.shape(given)}" if hasattr(given, "__array__") else given
            rule = "must be a State or six numbers: x, z [m], body_pitch [rad], u, w [m/s], pitch_rate [rad/s]"
            faults.add("initial_state", told, rule, "for example wb.State(u=10.0), or flight.states[-1]")
            faults.raise_if_any()
    for name, value in zip(State._fields, values, strict=True):
        where = f"initial_state.{name}"
        if name == "body_pitch":  # a body that has turned over has a pitch within half a turn too
            faults.angle(where, value, advice=f"write np.radians({value}), or take whole turns away")
        else:
            faults.number(where, value)
    faults.raise_if_any()
    return State(*values)


@register_record(static=("strips", "at_centre_of_pressure", "full_airspeed"), optional=("unsteady",))
@dataclass(frozen=True, init=False)
class FlightModel:
    """A vehicle, its air loads and the air: all numbers of the equations of motion except the wingbeat, a pytree.

    Parameters
    ----------
    vehicle : body and wings.
    aero : a `BladeElement`, or a coefficient model, its name, the path of its file, or a function of the angle of
        attack [rad] that returns (C_L, C_D).
    air : standard air if not given.
    velocity : mean velocity of the flight, forward and up [m/s]; only needed to compute the inflow of `aero`.

    Attributes
    ----------
    vehicle : as given, without muscle, motor and springs.
    air : as given.
    kernel : of the coefficient model; with inflow, of the sectional coefficients.
    strips : number of strips of a wing.
    at_centre_of_pressure : whether the force acts at the centre of pressure.
    full_airspeed : whether the force depends on the whole airspeed of a strip.
    unsteady : share of the unsteady terms: 1 for all, 0 for none.
    induced_factor : induced power divided by that of an ideal disc, a ratio; None without inflow.
    induced_flow : induced velocity of the air at the wings, forward and up [m/s]; None without inflow.

    Raises
    ------
    InvalidInputError, FileError : an `aero` that is none of these; inflow without a velocity, or with one at which
        the wings descend into their own wake.

    >>> from wingbeat import load_species
    >>> FlightModel(load_species("pigeon").vehicle, "dickinson").strips
    10
    """

    vehicle: Vehicle
    air: Air
    kernel: Kernel
    strips: int
    at_centre_of_pressure: bool
    full_airspeed: bool
    unsteady: float = 0.0
    induced_factor: float | None = None
    induced_flow: tuple[float, float] | None = None

    def __init__(
        self, vehicle: Vehicle, aero: Any, air: Air | None = None, velocity: tuple[float, float] | None = None
    ) -> None:
        loads, air = blade_element_of(aero), air or Air()
        fields = {
            "vehicle": vehicle.passive,
            "air": air,
            "kernel": loads.kernel(),
            "strips": loads.strips,
            "at_centre_of_pressure": loads.force_point == "centre-of-pressure",
            "full_airspeed": loads.airspeed == "full",
            "unsteady": 0.0 if loads.unsteady == "none" else loads.share,
            "induced_factor": None if loads.inflow == "none" else loads.share * loads.induced_factor,
            "induced_flow": _checked_flow(vehicle, loads, air, velocity),
        }
        for name, value in fields.items():
            object.__setattr__(self, name, value)


def _checked_flow(
    vehicle: Vehicle, aero: BladeElement, air: Air, velocity: tuple[float, float] | None
) -> tuple[float, float] | None:
    """Return the induced flow of a flight, None without inflow; refuse a velocity in the vortex ring."""
    if aero.inflow == "none":
        return None
    faults = FaultList()
    if velocity is None:
        rule, fix = "is needed for the inflow", "give the mean velocity (forward, up) of the flight [m/s]"
        faults.add("velocity", velocity, rule, fix)
        faults.raise_if_any()
        return None
    area, weight = disc_area(vehicle.wing.semi_span), vehicle.mass * air.gravity
    factor = aero.share * aero.induced_factor
    check_descent(faults, air.density, area, factor, weight, velocity)
    faults.raise_if_any()
    flow = flow_at(vehicle, air, factor, velocity)
    return float(flow[0]), float(flow[1])


def at_velocity(model: FlightModel, velocity: Pair) -> FlightModel:
    """Return the model with the induced flow for another mean velocity.

    Parameters
    ----------
    model : the flight model; a model without inflow is returned unchanged.
    velocity : forward and up [m/s].
    """
    if model.induced_factor is None:
        return model
    flow = flow_at(model.vehicle, model.air, model.induced_factor, velocity, jnp)
    return unchecked(FlightModel, vars(model) | {"induced_flow": flow})


def flow_at(vehicle: Vehicle, air: Air, factor: Scalar, velocity: Pair, xp: Any = np) -> Pair:
    """Return the induced flow at the wings in steady flight, forward and up [m/s].

    The wings carry the weight and balance the body's drag at the mean velocity. The tail's lift and drag are left
    out: they depend on the attitude, which is not known beforehand, and they are a small share of the weight.

    Theory: equation ``mean-force``.

    Parameters
    ----------
    vehicle, air : the vehicle, and the air in which it flies.
    factor : induced power divided by that of an ideal disc, a ratio.
    velocity : mean velocity, forward and up [m/s].
    xp : the array module that computes, numpy or jax.numpy.
    """
    drag = body_drag(vehicle.body.drag_area, air.density, velocity, xp)
    force = -drag[0], vehicle.mass * air.gravity - drag[1]
    return induced_flow(air.density, disc_area(vehicle.wing.semi_span), factor, force, velocity, xp)


def motion_table(model: FlightModel, wingbeat: Wingbeat, phase: Phases, vector: int = 1) -> WingMotion:
    """Tabulate the wing's motion at given phases.

    Parameters
    ----------
    model, wingbeat : the wing and how it beats.
    phase : phases, shape (...).
    vector : the number of strips is padded to a multiple of this number.
    """
    return wing_motion(
        model.vehicle, wingbeat, phase, model.strips, vector, model.full_airspeed, is_unsteady(model)
    )


def is_unsteady(model: FlightModel) -> bool:
    """Return whether a model has unsteady terms."""
    return not at_default(model, "unsteady")


@elementwise_jvp
def _air_loads(
    model_and_motion: tuple[FlightModel, WingMotion], forward: Phases, up: Phases, pitch_rate: Phases, *body: Phases
) -> BodyLoads:
    """Return the air loads on a vehicle that does not accelerate, in stroke axes.

    `forward` and `up` are the body's velocity relative to the air at the wings [m/s]; `body` is its velocity
    relative to the undisturbed air, if that differs.
    """
    model, motion = model_and_motion
    wings = wing_loads(
        model.kernel,
        model.air.density,
        motion,
        (forward, up),
        pitch_rate,
        model.at_centre_of_pressure,
        model.unsteady,
    )
    axes = 0.0 if model.vehicle.tail is None else stroke_attitude(model.vehicle.wing, motion, 0.0)
    around = body or (forward, up)
    own = body_air(model.vehicle, model.air.density, around, pitch_rate, axes, motion.tail_tilt)
    moment = wings.moment if own.moment is None else wings.moment + own.moment
    return BodyLoads((wings.force[0] + own.force[0], wings.force[1] + own.force[1]), moment)


def velocity_at_wings(model: FlightModel, attitude: Phases, u: Phases, w: Phases) -> Pair:
    """Return the velocity of the body relative to the air at the wings, in stroke axes [m/s].

    Parameters
    ----------
    model : gives the induced flow.
    attitude : pitch of the stroke axes from the world's [rad].
    u, w : velocity of the body, forward and up [m/s].
    """
    if model.induced_flow is None:
        return from_world(attitude, u, w)
    forward, up = model.induced_flow
    return from_world(attitude, u - forward, w - up)


def air_loads(
    model: FlightModel,
    motion: WingMotion,
    attitude: Phases,
    u: Phases,
    w: Phases,
    pitch_rate: Phases,
    acceleration: BodyAcceleration | None = None,
) -> BodyLoads:
    """Return the air loads on the whole vehicle in stroke axes.

    Parameters
    ----------
    model : the flight model.
    motion : its table of the wing's motion.
    attitude : pitch of the stroke axes from the world's [rad].
    u, w, pitch_rate : velocity of the body, forward and up, and its pitch rate [m/s, m/s, rad/s].
    acceleration : (x'', z'', psi'') of the body, for the added mass, shape (3, ...) [m/s2, m/s2, rad/s2]; None for
        a body that does not accelerate.
    """
    velocity = velocity_at_wings(model, attitude, u, w)
    body = () if model.induced_flow is None else from_world(attitude, u, w)
    loads = _air_loads((model, motion), *velocity, pitch_rate, *body)
    if motion.unsteady is None or acceleration is None:
        return loads
    rates = (*from_world(attitude, acceleration[0], acceleration[1]), acceleration[2])
    more = [unsteady_density(model) * dot(tuple(one.by_acceleration), rates) for one in motion.unsteady]
    return BodyLoads((loads.force[0] - more[0], loads.force[1] - more[1]), loads.moment - more[2])


def unsteady_density(model: FlightModel) -> Scalar:
    """Return the density of the air times the share of unsteady loads [kg/m3]."""
    return model.unsteady * model.air.density


def body_rates(model: FlightModel, motion: WingMotion, pitch_state: PitchState) -> PitchState:
    """Return d/dt of (body_pitch, u, w, pitch_rate), shape (4, ...) [rad/s, m/s2, m/s2, rad/s2].

    The position of the body has no effect.

    Theory: equation ``state-rates``.

    Parameters
    ----------
    model : the flight model.
    motion : its table of the wing's motion.
    pitch_state : (body_pitch, u, w, pitch_rate), shape (4, ...) [rad, m/s, m/s, rad/s].
    """
    body_pitch, u, w, pitch_rate = pitch_state
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    # Without inflow, the air loads depend on the pitch state through three numbers only: the velocity in stroke
    # axes and the pitch rate. So three derivatives of the loads give those by all four parts of the state.
    loads = air_loads(model, motion, attitude, u, w, pitch_rate)
    ax, az, pitch_acceleration = accelerations(
        model.vehicle, model.air.gravity, motion, loads, attitude, pitch_rate, unsteady_density(model)
    )
    return jnp.stack([pitch_rate, ax, az, pitch_acceleration])
