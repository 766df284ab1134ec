"""The body's accelerations with the wing motion prescribed: force and moment balance in stroke axes.

These are the first three of the equations of motion of Su et al. 2023 (doi 10.48550/arXiv.2302.09602), summed over
mass points: ``sum m r'' = F + M g`` and ``sum m (dr/dpsi) . (r'' - g) = moment``, with
``r'' = p'' + psi'' E b - psi'^2 b + 2 psi' E b' + b''`` in axes that turn with the body. Here p is the position
of the body, b that of a point relative to the body, and E turns a vector nose-up by a right angle.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from wingbeat._jax.arrays import computed_once, cos, fusion_barrier, jnp, sin
from wingbeat.aero.blade_element import StripForces, strip_forces
from wingbeat.aero.closed_forms import body_drag, tail_force
from wingbeat.animal.vehicle import Vehicle
from wingbeat.mechanics.frames import dot, from_world, quarter_turn, to_world
from wingbeat.mechanics.strip_sums import sum_over_strips
from wingbeat.mechanics.wing_motion import WingMotion

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Pair, PerStrip, Phases, Scalar, Triple


if TYPE_CHECKING:
    from wingbeat.aero.coefficient_model import Kernel


class BodyLoads(NamedTuple):
    """Air loads on the whole vehicle, wings and body, in stroke axes.

    Attributes
    ----------
    force : forward and up [N].
    moment : about the body's centre of mass, nose-up positive [N m].
    """

    force: Pair
    moment: Phases


def strip_loads(
    kernel: Kernel, density: Scalar, motion: WingMotion, velocity: Pair, pitch_rate: Phases
) -> StripForces:
    """Return the quasi-steady loads on the strips of one wing, from the coefficients.

    The velocity of the quarter chord determines the angle of attack, wherever the force acts. The loads are along
    the chord and the normal of the unpitched strip.

    Theory: equations ``strip-velocity`` and ``strip-velocity-stroke``.

    Parameters
    ----------
    kernel : of the coefficient model.
    density : of the air [kg/m3].
    motion : of the wing.
    velocity : of the body relative to the air at the wings, in stroke axes, forward and up [m/s].
    pitch_rate : [rad/s].
    """
    forward_speed, up_speed = velocity[0] - pitch_rate * motion.above, velocity[1] + pitch_rate * motion.ahead
    normal_speed = up_speed * motion.flap_cosine + motion.flapping_speed
    chord_speed = forward_speed
    if motion.unpitched is not None:
        chord_speed = dot(motion.unpitched, (forward_speed, up_speed)) + motion.sweeping_speed
    span_speed = None
    if motion.span is not None:
        span_speed = dot(motion.span, (forward_speed, up_speed)) + motion.spanwise_speed
    return strip_forces(kernel, density, motion.area, chord_speed, normal_speed, motion.pitch, span_speed)


def strip_moments(kernel: Kernel, motion: WingMotion, strips: StripForces) -> PerStrip:
    """Return the moments of the strips' loads about their quarter chords, leading edge up [N m].

    The loads act at the centre of pressure.
    """
    across = strips.normal * cos(motion.pitch) - strips.chordwise * sin(motion.pitch)
    return pressure_offset(kernel, strips.alpha, motion.area / motion.width) * across


def wing_loads(
    kernel: Kernel,
    density: Scalar,
    motion: WingMotion,
    velocity: Pair,
    pitch_rate: Phases,
    at_centre_of_pressure: bool,
    unsteady: Scalar = 0.0,
) -> BodyLoads:
    """Return the air loads on both wings, in stroke axes, for a body that does not accelerate.

    Theory: equation ``wing-loads``.

    Parameters
    ----------
    kernel, density, motion, velocity, pitch_rate : as in `strip_loads`.
    at_centre_of_pressure : whether loads act at the centre of pressure rather than at the quarter chord.
    unsteady : share of the unsteady loads, 1 for all; it has no effect if `motion` has no unsteady loads.
    """
    strips = strip_loads(kernel, density, motion, velocity, pitch_rate)
    forward, up = strips.chordwise, strips.normal * motion.flap_cosine
    across = motion.flap_cosine  # share of a moment about the span that pitches the body
    if motion.unpitched is not None:
        forward, up = (
            strips.chordwise * motion.unpitched[0],
            up + strips.chordwise * motion.unpitched[1],
        )
        across = across * motion.unpitched[0]
    moment = motion.ahead * up - motion.above * forward
    if at_centre_of_pressure:
        moment = moment + strip_moments(kernel, motion, strips) * across
    forward, up, moment = (2.0 * sum_over_strips(a) for a in (forward, up, moment))
    if motion.unsteady is not None:
        through_air = *velocity, pitch_rate
        more = [one.load(unsteady * density, through_air, None, strips.speed) for one in motion.unsteady]
        forward, up, moment = forward + more[0], up + more[1], moment + more[2]
    return BodyLoads((forward, up), moment)


def pressure_offset(kernel: Kernel, alpha: PerStrip, chord: PerStrip) -> PerStrip:
    """Return how far the centre of pressure lies ahead of the quarter chord [m].

    Theory: equation ``force-point``.
    """
    return chord * (0.25 - kernel.centre_of_pressure(alpha))


class BodyAir(NamedTuple):
    """Air loads on the body and its tail.

    Attributes
    ----------
    force : forward and up [N], in the axes of the velocity.
    moment : about the body's centre of mass, nose-up positive [N m]; None without a tail.
    """

    force: Pair
    moment: Phases | None


def body_air(
    vehicle: Vehicle,
    density: Scalar,
    velocity: Pair,
    pitch_rate: Phases,
    axes: Phases | Scalar = 0.0,
    tilt: Phases | Scalar | None = None,
) -> BodyAir:
    """Return the air loads on the body and its tail.

    All forces on the body other than those of the wings are added here. The tail's velocity relative to the air
    comes from the body's velocity and pitch rate; the flow that the wings induce does not reach the tail.

    Theory: equation ``tail-velocity``.

    Parameters
    ----------
    vehicle : gives drag area and tail.
    density : of the air [kg/m3].
    velocity : of the body's centre of mass relative to the undisturbed air, forward and up [m/s].
    pitch_rate : [rad/s].
    axes : nose-up pitch of the velocity's axes relative to body axes [rad].
    tilt : added to the tail's incidence [rad]; None means 0.
    """
    drag, tail = body_drag(vehicle.body.drag_area, density, velocity, jnp), vehicle.tail
    if tail is None:
        return BodyAir(drag, None)
    # Behind the barriers, geometry and force are computed once for all directions of a derivative. A flight with a
    # tail then takes 1.15 times as long as one with no tail. Without the barriers it takes 1.5 times as long.
    incidence = (tail.incidence if tilt is None else tail.incidence + tilt) - axes
    (ahead, above), normal = from_world(axes, -tail.arm, tail.height), (-sin(incidence), cos(incidence))
    (ahead, above), normal = fusion_barrier(((ahead, above), normal))
    there = velocity[0] - pitch_rate * above, velocity[1] + pitch_rate * ahead
    force = tail_force(density, tail.area, tail.lift_slope, tail.drag_coefficient, normal, there, jnp)
    forward, up = computed_once(force)
    return BodyAir((drag[0] + forward, drag[1] + up), ahead * up - above * forward)


class _Balance(NamedTuple):
    """The three equations without the body's accelerations, and the inertias that multiply the accelerations."""

    mass: Scalar
    forward: Phases
    up: Phases
    turn: Phases
    arm: Pair
    inertia: Phases


def _balance(
    vehicle: Vehicle, gravity: Scalar, motion: WingMotion, loads: BodyLoads, attitude: Phases, pitch_rate: Phases
) -> _Balance:
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
    return _Balance(mass, force_forward, force_up, turn, arm, inertia)


def missing_loads(
    vehicle: Vehicle,
    gravity: Scalar,
    motion: WingMotion,
    loads: BodyLoads,
    attitude: Phases,
    pitch_rate: Phases,
    acceleration: Triple,
) -> Triple:
    """Return the force in the world [N] and the nose-up moment [N m] that must act to give this acceleration.

    They act in addition to the air loads and gravity. Each is the left side minus the right side of an equation of
    `accelerations`.

    Theory: equation ``missing-loads``.

    Parameters
    ----------
    vehicle, gravity, motion, attitude, pitch_rate : as in `accelerations`.
    loads : air loads that act at this acceleration, in stroke axes of the body.
    acceleration : x'' and z'' in the world [m/s2] and psi'' [rad/s2].
    """
    rows = _balance(vehicle, gravity, motion, loads, attitude, pitch_rate)
    along, turning = from_world(attitude, acceleration[0], acceleration[1]), acceleration[2]
    forward = rows.mass * along[0] + turning * rows.arm[0] - rows.forward
    up = rows.mass * along[1] + turning * rows.arm[1] - rows.up
    x, z = to_world(attitude, forward, up)
    return x, z, dot(rows.arm, along) + turning * rows.inertia - rows.turn


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

    Parameters
    ----------
    vehicle : gives the masses and the body's inertia.
    gravity : [m/s2].
    motion : of the wing.
    loads : air loads in stroke axes, for a body that does not accelerate.
    attitude : pitch of the stroke axes from the world's [rad].
    pitch_rate : psi' [rad/s].
    unsteady_density : density of the air times the share of unsteady loads [kg/m3].
    """
    mass, force_forward, force_up, turn, arm, inertia = _balance(
        vehicle, gravity, motion, loads, attitude, pitch_rate
    )
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
    ax, az = to_world(attitude, forward, up)
    return ax, az, pitch_acceleration


def _solve_symmetric(rows: tuple[tuple[Phases, ...], ...], right: Triple) -> Triple:
    """Solve three linear equations; the symmetric matrix is given by the rows of its upper triangle.

    Cofactors need only one division. The barriers make XLA compute matrix and right side once for all directions of
    a derivative; without them a flight takes 1.2 times as long.

    Theory: equation ``body-inertia``.
    """
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
