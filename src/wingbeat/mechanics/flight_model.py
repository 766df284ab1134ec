"""The flight model: vehicle, air loads and air joined into one right-hand side."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.config import jnp, register_record
from wingbeat._jax.elementwise_jvp import elementwise_jvp
from wingbeat.aero.blade_element import blade_element_of
from wingbeat.errors import FaultList
from wingbeat.kinematics import Wingbeat
from wingbeat.mechanics.body_dynamics import BodyLoads, accelerations, body_drag, wing_loads
from wingbeat.mechanics.frames import from_world
from wingbeat.mechanics.wing_motion import WingMotion, stroke_attitude, wing_motion
from wingbeat.vehicle import Air, Vehicle

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Component, Phases, PitchState


if TYPE_CHECKING:
    from wingbeat.aero.coefficient_model import Kernel


class State(NamedTuple):
    """The body's state in the world, numbers or arrays of one shape.

    Attributes
    ----------
    x, z : place, forward and up [m].
    body_pitch : nose-up positive [rad].
    u, w : velocity, forward and up [m/s].
    pitch_rate : [rad/s].
    """

    x: Component = 0.0
    z: Component = 0.0
    body_pitch: Component = 0.0
    u: Component = 0.0
    w: Component = 0.0
    pitch_rate: Component = 0.0


def check_state(state: State) -> None:
    """Check that every number of a state is finite.

    Raises
    ------
    InvalidInputError : some number is not finite.
    """
    faults = FaultList()
    for name in State._fields:
        faults.number(f"initial_state.{name}", getattr(state, name))
    faults.raise_if_any()


@register_record(static=("strips", "at_centre_of_pressure", "full_airspeed"))
@dataclass(frozen=True, init=False)
class FlightModel:
    """A vehicle, its air loads and the air: all numbers of the equations of motion but the wingbeat; a JAX pytree.

    Parameters
    ----------
    vehicle : body and wings.
    aero : a `BladeElement`, or a coefficient model, its name, the path of its file, or a function of the angle of
        attack [rad] that returns (C_L, C_D).
    air : standard air if not given.

    Attributes
    ----------
    vehicle, air : as given.
    kernel : of the coefficient model.
    strips : number of strips of a wing.
    at_centre_of_pressure : whether the force acts at the centre of pressure.
    full_airspeed : whether the force depends on the whole airspeed of a strip.

    Raises
    ------
    InvalidInputError, FileError : an `aero` that is none of these.

    >>> from wingbeat.species import load_species
    >>> FlightModel(load_species("pigeon").vehicle, "dickinson").strips
    10
    """

    vehicle: Vehicle
    air: Air
    kernel: Kernel
    strips: int
    at_centre_of_pressure: bool
    full_airspeed: bool

    def __init__(self, vehicle: Vehicle, aero: Any, air: Air | None = None) -> None:
        loads = blade_element_of(aero)
        fields = {
            "vehicle": vehicle,
            "air": air or Air(),
            "kernel": loads.coefficients.kernel(),
            "strips": loads.strips,
            "at_centre_of_pressure": loads.force_point == "centre-of-pressure",
            "full_airspeed": loads.airspeed == "full",
        }
        for name, value in fields.items():
            object.__setattr__(self, name, value)


def motion_table(model: FlightModel, wingbeat: Wingbeat, phase: Phases, vector: int = 1) -> WingMotion:
    """Tabulate the wing's motion at given phases.

    Parameters
    ----------
    model, wingbeat : the wing and how it beats.
    phase : phases, shape (...).
    vector : pads the strips to a multiple of this number.
    """
    return wing_motion(model.vehicle, wingbeat, phase, model.strips, vector, model.full_airspeed)


@elementwise_jvp
def air_loads(
    model_and_motion: tuple[FlightModel, WingMotion], forward: Phases, up: Phases, pitch_rate: Phases
) -> BodyLoads:
    """Return the air loads on the whole vehicle in stroke axes.

    Parameters
    ----------
    model_and_motion : the flight model and its table of the wing's motion.
    forward, up : velocity of the body in stroke axes [m/s].
    pitch_rate : [rad/s].
    """
    model, motion = model_and_motion
    wings = wing_loads(
        model.kernel, model.air.density, motion, (forward, up), pitch_rate, model.at_centre_of_pressure
    )
    drag = body_drag(model.vehicle.body.drag_area, model.air.density, (forward, up))
    return wings._replace(force=(wings.force[0] + drag[0], wings.force[1] + drag[1]))


def body_rates(model: FlightModel, motion: WingMotion, pitch_state: PitchState) -> PitchState:
    """Return d/dt of (body_pitch, u, w, pitch_rate), shape (4, ...) [rad/s, m/s2, m/s2, rad/s2].

    The place of the body does not enter.

    Parameters
    ----------
    model : the flight model.
    motion : its table of the wing's motion.
    pitch_state : (body_pitch, u, w, pitch_rate), shape (4, ...) [rad, m/s, m/s, rad/s].
    """
    body_pitch, u, w, pitch_rate = pitch_state
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    # The air loads depend on the pitch state in three ways only, so three derivatives of the loads serve all four.
    loads = air_loads((model, motion), *from_world(attitude, u, w), pitch_rate)
    ax, az, pitch_acceleration = accelerations(
        model.vehicle, model.air.gravity, motion, loads, attitude, pitch_rate
    )
    return jnp.stack([pitch_rate, ax, az, pitch_acceleration])
