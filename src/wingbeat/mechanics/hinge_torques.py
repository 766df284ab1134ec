"""What the hinges must give, and for what: torques and powers, from sums over the wing that depend on time alone.

By d'Alembert the effort along a motion of the wing is ``sum m (r'' - g) . v - F . v``, v what that motion does to
each point: for a hinge torque dr/d(angle), for the power of all actuators dr/dt in body axes. In stroke axes
``r'' = p'' + psi'' E b - psi'^2 b + 2 psi' E b' + b''`` with b the place of a point, so that all sums over mass
points depend on time alone, as in `body_dynamics`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from wingbeat._jax.config import jax, jnp
from wingbeat.kinematics import Wingbeat, flap_angle, pitch_angle
from wingbeat.mechanics.body_dynamics import strip_loads, strip_moments
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.frames import Pair, Triple, from_world
from wingbeat.mechanics.wing_motion import (
    Strips,
    WingMotion,
    WingShape,
    beside,
    dot,
    over_strips,
    shape_at,
    strips_of,
    stroke_attitude,
    sums_over_strips,
    time_rates,
    turned,
    wing_shape,
)
from wingbeat.vehicle import Vehicle


class Along(NamedTuple):
    """What one motion of the wing moves, v being its velocity per unit of the motion, any trailing axes of times.

    By strip: ``lever``, the quarter chord's velocity along the normal that the strip has without pitch, and
    ``turning``, that of its pitch. Sums over the mass of both wings: ``first_moment`` of v, and of v times place
    turned by a right angle (``swirl``), place (``spin``), rate turned (``coriolis``) and acceleration (``push``).
    Where the wing sweeps, ``reach`` is the quarter chord's velocity along the unpitched chord, else None.
    SI units; v is in m/rad for a hinge, in m/s for the whole motion.
    """

    lever: Any
    turning: Any
    first_moment: Pair
    swirl: Any
    spin: Any
    coriolis: Any
    push: Any
    reach: Any = None


class HingeMotion(NamedTuple):
    """Rates of flap and root pitch [rad/s], and what these two and the wing's whole motion move."""

    flap_rate: Any
    pitch_rate: Any
    flap: Along
    pitch: Along
    whole: Along


class HingeLoads(NamedTuple):
    """Hinge torques [N m] and powers [W], both wings together.

    The hinge power is the sum of three shares: ``aerodynamic_power`` against the air loads, ``inertial_power`` that
    speeds up the wings as seen from the body, and ``body_power``, the rest: the wings are carried by a body that
    accelerates and turns, in gravity.
    """

    flap_torque: Any
    pitch_torque: Any
    hinge_power: Any
    actuator_power: Any
    aerodynamic_power: Any
    inertial_power: Any
    body_power: Any


class _Effort(NamedTuple):
    """What a motion of the wing takes against the air, for its own acceleration in the body, and for the body's."""

    air: Any
    inertia: Any
    body: Any

    @property
    def whole(self) -> Any:
        return self.body + self.inertia + self.air


class _Chords(NamedTuple):
    """Where the strips are: their shape, their mid-chords, and vectors to the leading edge."""

    shape: WingShape
    middle: Triple
    fore: Triple


def _chords(shape: WingShape, strips: Strips) -> _Chords:
    quarter, fore = 0.25 * strips.chord, shape.chordwise
    x, y, z = (place - quarter * ahead for place, ahead in zip(shape.place, fore, strict=True))
    return _Chords(shape, (x, y, z), fore)


def hinge_motion(vehicle: Vehicle, wingbeat: Wingbeat, phase: Any, count: int) -> HingeMotion:
    """Tabulate what the hinges move at the given phases."""
    phase = jnp.asarray(phase, dtype=float)
    strips = beside(strips_of(vehicle.wing, count), phase)

    def by_time(at: Any) -> _Chords:
        return _chords(shape_at(vehicle, wingbeat, strips, at), strips)

    def by_angles(flap: Any, pitch: Any) -> _Chords:
        return _chords(wing_shape(vehicle, wingbeat, strips, phase, flap, pitch), strips)

    here, rates, pushes = time_rates(by_time, phase, wingbeat.frequency)
    angles = flap_angle(wingbeat, phase), pitch_angle(wingbeat, phase)
    one, none = jnp.ones_like(phase), jnp.zeros_like(phase)
    flap, pitch = (jax.jvp(by_angles, angles, along)[1] for along in ((one, none), (none, one)))
    _, flap_rate, _ = time_rates(lambda at: flap_angle(wingbeat, at), phase, wingbeat.frequency)
    _, pitch_rate, _ = time_rates(lambda at: pitch_angle(wingbeat, at), phase, wingbeat.frequency)
    moving = here, rates, pushes
    return HingeMotion(flap_rate, pitch_rate, *(_along(moving, v, strips) for v in (flap, pitch, rates)))


def _along(moving: tuple[_Chords, _Chords, _Chords], velocity: _Chords, strips: Strips) -> Along:
    here, rates, pushes = moving
    # The mass of a strip is spread along its chord: its second moment about mid-chord is that of a uniform rod.
    mass, spread = 2.0 * strips.mass, strips.chord * strips.chord / 12.0

    def in_plane(chords: _Chords) -> tuple[Pair, Pair]:
        return (chords.middle[0], chords.middle[2]), (chords.fore[0], chords.fore[2])

    def work(middle: Pair, fore: Pair) -> Any:
        return dot(middle, of_middle) + spread * dot(fore, of_fore)

    swept = here.shape.sweep_sine is not None
    of_middle, of_fore = in_plane(velocity)
    (place, fore), (speed, fore_speed) = in_plane(here), in_plane(rates)
    rows = (
        *of_middle,
        work(turned(place), turned(fore)),
        work(place, fore),
        work(turned(speed), turned(fore_speed)),
        dot(pushes.middle, velocity.middle) + spread * dot(pushes.fore, velocity.fore),
    )
    sums = sums_over_strips(mass, rows)
    return Along(
        lever=velocity.shape.above * here.shape.flap_cosine - velocity.shape.left * here.shape.flap_sine,
        turning=dot(velocity.fore, here.shape.normal) if swept else velocity.shape.pitch,
        first_moment=(sums[0], sums[1]),
        swirl=sums[2],
        spin=sums[3],
        coriolis=sums[4],
        push=sums[5],
        reach=dot(velocity.shape.place, here.shape.level) if swept else None,
    )


def hinge_loads(
    model: FlightModel, motion: WingMotion, hinges: HingeMotion, pitch_state: Any, body_acceleration: Any
) -> HingeLoads:
    """Return torques and powers of a flight.

    Parameters
    ----------
    model, motion, hinges : the flight model and its tables at the same phases.
    pitch_state : (body_pitch, u, w, pitch_rate) [rad, m/s, m/s, rad/s].
    body_acceleration : (x'', z'', psi'') [m/s2, m/s2, rad/s2].
    """
    body_pitch, u, w, pitch_rate = pitch_state
    ax, az, pitch_acceleration = body_acceleration
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    strips = strip_loads(model.kernel, model.air.density, motion, from_world(attitude, u, w), pitch_rate)
    moments = strip_moments(model.kernel, motion, strips) if model.at_centre_of_pressure else 0.0
    felt = from_world(attitude, ax, az + model.air.gravity)

    def effort(along: Along) -> _Effort:
        air = strips.normal * along.lever + moments * along.turning
        if along.reach is not None:
            air = air + strips.chordwise * along.reach
        return _Effort(
            air=-2.0 * over_strips(air),
            inertia=along.push,
            body=dot(felt, along.first_moment)
            + pitch_acceleration * along.swirl
            - pitch_rate * pitch_rate * along.spin
            + 2.0 * pitch_rate * along.coriolis,
        )

    flap, pitch = effort(hinges.flap), effort(hinges.pitch)
    shares = (a * hinges.flap_rate + b * hinges.pitch_rate for a, b in zip(flap, pitch, strict=True))
    return HingeLoads(
        flap.whole,
        pitch.whole,
        flap.whole * hinges.flap_rate + pitch.whole * hinges.pitch_rate,
        effort(hinges.whole).whole,
        *shares,
    )
