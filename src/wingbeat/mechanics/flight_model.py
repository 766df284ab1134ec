"""The flight model, vehicle, air loads and air, and its right-hand side with the wing motion prescribed.

The body's accelerations follow from the first three equations of motion of Su et al. 2023
(doi 10.48550/arXiv.2302.09602), summed over mass points in stroke axes: ``sum m r'' = F + M g`` and
``sum m (dr/dpsi) . (r'' - g) = moment``, with ``r'' = p'' + psi'' E b - psi'^2 b + 2 psi' E b' + b''`` in axes that
turn with the body. Here p is the position of the body, b that of a point relative to the body, and E turns a vector
nose-up by a right angle.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat._jax.arrays import at_default, elementwise_jvp, fusion_barrier, jnp, register_record, unchecked
from wingbeat.aero.blade_element import BladeElement, blade_element_of
from wingbeat.aero.closed_forms import body_drag, check_descent, disc_area, induced_flow
from wingbeat.aero.strip_forces import StripForces
from wingbeat.aero.wake import WakeLag
from wingbeat.animal.kinematics import PitchHinge, Wingbeat
from wingbeat.animal.vehicle import Air, Vehicle, Wing
from wingbeat.mechanics.strip_air import (
    StripWake,
    body_air,
    is_unsteady,
    loads_of_strips,
    strip_moments,
    unsteady_density,
    velocity_at_wings,
)
from wingbeat.mechanics.wing_motion import WingMotion, stroke_attitude, wing_motion
from wingbeat.mechanics.wing_shape import (
    UnturnedShapes,
    dot,
    from_world,
    quarter_turn,
    strips_of,
    sum_over_strips,
    to_world,
)

if TYPE_CHECKING:
    from wingbeat._jax.arrays import BodyAcceleration, Component, Pair, PerStrip, Phases, Scalar, Triple
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
    wake : numbers of the lag of the wake; None without it.

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
    wake: WakeLag | None = None

    def __init__(
        self, vehicle: Vehicle, aero: Any, air: Air | None = None, velocity: tuple[float, float] | None = None
    ) -> None:
        loads, air = blade_element_of(aero), air or Air()
        _check_stations(vehicle.wing, loads.strips)
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
            "wake": loads.wake_lag(2.0 * vehicle.wing.semi_span / vehicle.wing.mean_chord),
        }
        for name, value in fields.items():
            object.__setattr__(self, name, value)


def _check_stations(wing: Wing, count: int) -> None:
    """Refuse a table of masses that so many strips cannot hold."""
    if wing.mass_stations is None:
        return
    cut = strips_of(wing, count)
    place, mass = np.asarray(cut.span_fraction), np.asarray(cut.mass)
    own = np.array(wing.station_masses) * wing.mass / sum(wing.station_masses or ())
    short = [abs(mass @ place**n - own @ np.array(wing.mass_stations) ** n) > 1e-9 * wing.mass for n in range(3)]
    if not mass.min() >= 0 or any(short):
        rule = f"is too few to keep the moments of wing.station_masses: one would weigh {mass.min():.3g} kg"
        fix = "take more strips, cut the wing into more pieces, or count what sits at the shoulder to the body"
        raise InvalidInputError([Fault("aero.strips", count, rule, fix)])


def _checked_flow(
    vehicle: Vehicle, aero: BladeElement, air: Air, velocity: tuple[float, float] | None
) -> tuple[float, float] | None:
    """Return the induced flow of a flight, None without inflow; refuse a velocity in the vortex ring."""
    if aero.inflow == "none":
        return None
    faults = FaultList()
    if velocity is None:
        rule, fix = "is needed for the inflow", "give the mean velocity (forward, up) of the flight [m/s]"
        raise InvalidInputError([Fault("velocity", velocity, rule, fix)])
    area, weight = disc_area(vehicle.wing.semi_span), vehicle.mass * air.gravity
    factor = aero.share * aero.induced_factor
    check_descent(faults, air.density, area, factor, weight, velocity)
    faults.raise_if_any()
    flow = flow_at(vehicle, air, factor, velocity)
    return float(flow[0]), float(flow[1])


def at_velocity(model: FlightModel, velocity: Pair) -> FlightModel:
    """Return the model with the induced flow for another mean velocity."""
    if model.induced_factor is None:
        return model
    flow = flow_at(model.vehicle, model.air, model.induced_factor, velocity, jnp)
    return unchecked(FlightModel, vars(model) | {"induced_flow": flow})


def flow_at(vehicle: Vehicle, air: Air, factor: Scalar, velocity: Pair, xp: Any = np) -> Pair:
    """Return the induced flow at the wings in steady flight, forward and up [m/s]. Theory: equation ``mean-force``.

    The wings carry the weight and balance the body's drag at the mean velocity. The loads of tail and cross flow
    are left out: they depend on the attitude, which is not known beforehand, and are a small share of the weight.
    """
    drag = body_drag(vehicle.body.drag_area, air.density, velocity, xp)
    force = -drag[0], vehicle.mass * air.gravity - drag[1]
    return induced_flow(air.density, disc_area(vehicle.wing.semi_span), factor, force, velocity, xp)


def motion_table(
    model: FlightModel,
    wingbeat: Wingbeat,
    phase: Phases,
    vector: int = 1,
    shapes: UnturnedShapes | None = None,
) -> WingMotion:
    """Tabulate the wing's motion at phases; the number of strips is padded to a multiple of `vector`.

    `shapes` are as in `wing_motion`.
    """
    assert not isinstance(wingbeat.pitch_hinge, PitchHinge), "the motion of the hinge is not known"
    terms = model.full_airspeed, is_unsteady(model), model.wake is not None
    return wing_motion(model.vehicle, wingbeat, phase, model.strips, vector, *terms, shapes=shapes)


class BodyLoads(NamedTuple):
    """Air loads on the whole vehicle, wings and body, in stroke axes."""

    force: Pair  # forward and up [N]
    moment: Phases  # about the body's centre of mass, nose-up positive [N m]


def wing_loads(
    model: FlightModel, motion: WingMotion, velocity: Pair, pitch_rate: Phases, strips: StripForces
) -> BodyLoads:
    """Return the air loads on both wings of a body that does not accelerate. Theory: equation ``wing-loads``."""
    forward, up, moment = (2.0 * sum_over_strips(a) for a in strip_parts(model, motion, strips))
    if motion.unsteady is not None:
        through_air = *velocity, pitch_rate
        more = [one.load(unsteady_density(model), through_air, None, strips.speed) for one in motion.unsteady]
        forward, up, moment = forward + more[0], up + more[1], moment + more[2]
    return BodyLoads((forward, up), moment)


def strip_parts(model: FlightModel, motion: WingMotion, strips: StripForces) -> tuple[PerStrip, PerStrip, PerStrip]:
    """Return the parts of the strips of one wing in the force forward and up, and in the moment on the body."""
    forward, up = strips.chordwise, strips.normal * motion.flap_cosine
    across = motion.flap_cosine  # share of a moment about the span that pitches the body
    if motion.unpitched is not None:
        forward, up = strips.chordwise * motion.unpitched[0], up + strips.chordwise * motion.unpitched[1]
        across = across * motion.unpitched[0]
    moment = motion.ahead * up - motion.above * forward
    if model.at_centre_of_pressure:
        moment = moment + strip_moments(model, motion, strips) * across
    return forward, up, moment


@elementwise_jvp
def _air_loads(
    model_and_motion: tuple[FlightModel, WingMotion], forward: Phases, up: Phases, pitch_rate: Phases, *body: Phases
) -> BodyLoads:
    """Return the air loads on a vehicle that does not accelerate, in stroke axes.

    The velocity is relative to the air at the wings; `body` is that relative to the undisturbed air, if it differs.
    """
    strips = loads_of_strips(*model_and_motion, (forward, up), pitch_rate, None)
    return loads_at(*model_and_motion, (forward, up), pitch_rate, body, strips)


def loads_at(
    model: FlightModel,
    motion: WingMotion,
    velocity: Pair,
    pitch_rate: Phases,
    body: Pair | tuple[()],
    strips: StripForces,
) -> BodyLoads:
    """Return the air loads in stroke axes from those of the strips; `body` is as in `_air_loads`."""
    forward, up = velocity
    wings = wing_loads(model, motion, (forward, up), pitch_rate, strips)
    turned = model.vehicle.tail is not None or not at_default(model.vehicle.body, "crossflow_area")
    axes = stroke_attitude(model.vehicle.wing, motion, 0.0) if turned else 0.0
    around = body or (forward, up)
    force, moment = body_air(model.vehicle, model.air.density, around, pitch_rate, axes, motion.tail_tilt)
    moment = wings.moment if moment is None else wings.moment + moment
    return BodyLoads((wings.force[0] + force[0], wings.force[1] + force[1]), moment)


def air_loads(
    model: FlightModel,
    motion: WingMotion,
    attitude: Phases,
    u: Phases,
    w: Phases,
    pitch_rate: Phases,
    acceleration: BodyAcceleration | None = None,
    wake: StripWake | None = None,
) -> BodyLoads:
    """Return the air loads on the whole vehicle in stroke axes; without `acceleration`, without added mass."""
    velocity = velocity_at_wings(model, attitude, u, w)
    body = () if model.induced_flow is None else from_world(attitude, u, w)
    if wake is None:
        loads = _air_loads((model, motion), *velocity, pitch_rate, *body)
    else:
        strips = loads_of_strips(model, motion, velocity, pitch_rate, wake)
        loads = loads_at(model, motion, velocity, pitch_rate, body, strips)
    if motion.unsteady is None or acceleration is None:
        return loads
    rates = (*from_world(attitude, acceleration[0], acceleration[1]), acceleration[2])
    more = [unsteady_density(model) * dot(tuple(one.by_acceleration), rates) for one in motion.unsteady]
    return BodyLoads((loads.force[0] - more[0], loads.force[1] - more[1]), loads.moment - more[2])


def balance(
    vehicle: Vehicle, gravity: Scalar, motion: WingMotion, loads: BodyLoads, attitude: Phases, pitch_rate: Phases
) -> tuple[Scalar, Phases, Phases, Phases, Pair, Phases]:
    """Return mass, the equations' three sums without the body's accelerations, and their arm and inertia."""
    mass = vehicle.mass
    pull = from_world(attitude, 0.0, -gravity)
    arm, coriolis = quarter_turn(motion.first_moment), quarter_turn(motion.first_moment_rate)
    force_forward, force_up = (
        loads.force[i]
        + mass * pull[i]
        + pitch_rate * (pitch_rate * motion.first_moment[i] - 2.0 * coriolis[i])
        - motion.first_moment_acceleration[i]
        for i in range(2)
    )
    turn = loads.moment + dot(arm, pull) - pitch_rate * motion.inertia_rate - motion.acceleration_moment
    inertia = vehicle.body.pitch_inertia + motion.inertia
    return mass, force_forward, force_up, turn, arm, inertia


def accelerations(
    vehicle: Vehicle,
    gravity: Scalar,
    motion: WingMotion,
    loads: BodyLoads,
    attitude: Phases,
    pitch_rate: Phases,
    unsteady_density: Scalar = 0.0,
) -> Triple:
    """Return the body's accelerations x'' and z'' in the world [m/s2] and psi'' [rad/s2].

    The three equations are linear in psi'' and the acceleration a in stroke axes: ``M a + psi'' E S = F + M g +
    psi'^2 S - 2 psi' E S' - S''`` and ``(E S) . a + I psi'' = moment + (E S) . g - psi' I' - K``. S is the wings'
    first moment, I the pitch inertia of body and wings, K the wings' acceleration moment.

    Theory: equations ``body-balance`` and ``body-accelerations``.
    """
    mass, force_forward, force_up, turn, arm, inertia = balance(
        vehicle, gravity, motion, loads, attitude, pitch_rate
    )
    right = force_forward, force_up, turn
    forward, up, pitch_acceleration = of_body_balance(mass, arm, inertia, motion, unsteady_density, right)
    ax, az = to_world(attitude, forward, up)
    return ax, az, pitch_acceleration


def of_body_balance(
    mass: Scalar, arm: Pair, inertia: Phases, motion: WingMotion, unsteady_density: Scalar, right: Triple
) -> Triple:
    """Return the body's accelerations in stroke axes from the right sides of its three equations of motion.

    Theory: equation ``body-accelerations``.
    """
    force_forward, force_up, turn = right
    if motion.unsteady is None:
        pitch_acceleration = (turn - dot(arm, (force_forward, force_up)) / mass) / (inertia - dot(arm, arm) / mass)
        forward = (force_forward - pitch_acceleration * arm[0]) / mass
        up = (force_up - pitch_acceleration * arm[1]) / mass
    else:
        # The air resists acceleration as mass does; the three loads make a symmetric matrix.
        air = [unsteady_density * one.by_acceleration for one in motion.unsteady]
        rows = (
            (mass + air[0][0], air[0][1], arm[0] + air[0][2]),
            (mass + air[1][1], arm[1] + air[1][2]),
            (inertia + air[2][2],),
        )
        forward, up, pitch_acceleration = _solve_symmetric(rows, (force_forward, force_up, turn))
    return forward, up, pitch_acceleration


def _solve_symmetric(rows: tuple[tuple[Phases, ...], ...], right: Triple) -> Triple:
    """Solve three linear equations, given the upper triangle's rows. Theory: equation ``body-inertia``."""
    # Cofactors need only one division. The barriers make XLA compute matrix and right side once for all directions
    # of a derivative; without them a flight takes 1.2 times as long.
    (a, b, c), (d, e), (f,) = fusion_barrier(rows)
    x, y, z = fusion_barrier(right)
    first, second, third = d * f - e * e, c * e - b * f, b * e - c * d
    middle, last = a * f - c * c, a * d - b * b
    mixed = b * c - a * e
    scale = 1.0 / (a * first + b * second + c * third)
    return (
        (first * x + second * y + third * z) * scale,
        (second * x + middle * y + mixed * z) * scale,
        (third * x + mixed * y + last * z) * scale,
    )
