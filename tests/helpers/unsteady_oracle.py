"""A slow, plain oracle for the loads of unsteady air on flapping wings; NumPy alone.

It shares no formula with the package: rotation, added mass and couples are written strip by strip from the
accelerations of the wing's points, which `oracle.Wing` has exactly from rigid-body recursion. The air's resistance
to acceleration is not written down at all: the balance of forces and moment is linear in the body's acceleration,
so its values at four accelerations solve it.

Conventions, `state`, `phase` and `coefficients` as in `oracle`. `wind` is the velocity (x, z) of the air at the
wings; the body's drag is that of still air. `share` multiplies the unsteady terms.
"""

import dataclasses
import math

import numpy as np

from tests.helpers import oracle
from tests.helpers.oracle import Y, Z, cross
from tests.helpers.oracle_laws import wing_angles


@dataclasses.dataclass(frozen=True)
class Flier:
    """A vehicle with its wingbeat and air as dictionaries, and how the air loads its strips."""

    vehicle: dict
    wingbeat: dict
    air: dict
    coefficients: object
    strips: int = 10
    force_at_cp: bool = False
    full_airspeed: bool = False
    share: float = 1.0
    wind: tuple = (0.0, 0.0)


@dataclasses.dataclass(frozen=True)
class Strips:
    """Loads of the left wing at one instant: (force, place, velocity) groups, and couples, leading edge up."""

    wing: oracle.Wing
    pushes: list
    couples: np.ndarray
    turning: np.ndarray


def induced_wind(density, semi_span, factor, force, velocity):
    """Velocity (x, z) of the air at the wings by momentum, from bisection on the induced speed.

    Theory: equation ``induced-flow``.
    """
    size = math.hypot(*force)
    n = np.array(force) / size
    held = factor * size / (2.0 * density * math.pi * semi_span**2)
    low, high = 0.0, 10.0 * math.sqrt(held) + 1.0
    for _ in range(200):
        middle = 0.5 * (low + high)
        if middle * np.linalg.norm(np.array(velocity) + middle * n) < held:
            low = middle
        else:
            high = middle
    return tuple(-low * n)


def _wing(flier, state, phase, acceleration, wind=(0.0, 0.0)):
    x, z, psi, u, w, rate = state
    through_air = (x, z, psi, u - wind[0], w - wind[1], rate)
    vehicle, wingbeat = flier.vehicle, flier.wingbeat
    return oracle._prescribed(vehicle, wingbeat, through_air, phase, flier.strips, acceleration)


def _dots(a, b):
    return np.einsum("nk,nk->n", *np.broadcast_arrays(a, b))


def strip_loads(flier, state, phase, acceleration):
    """Every load of the air on the left wing whose body has `acceleration` (ax, az, psi_dd).

    Theory: equations ``chord-turning``, ``rotation-force``, ``added-mass`` and ``unsteady-couple``.
    """
    wing = _wing(flier, state, phase, acceleration)
    # An even wind that does not change is a frame that moves: seen from it, the air is still.
    seen = _wing(flier, state, phase, acceleration, flier.wind)
    density, c, dr = flier.air["density"], wing.air_chord, wing.width
    loads = seen.air_loads(flier.air, flier.coefficients, flier.force_at_cp, flier.full_airspeed)
    place, steady = loads[0], loads[2]
    ahead = _dots(place - wing.station, wing.e_c)
    pushes = [(steady, place, wing.point(ahead)[1])]

    spin, spin_rate = wing.spin
    span = np.broadcast_to(wing.e_s, spin.shape)
    turning = -_dots(spin, span)
    turning_rate = -_dots(spin_rate, span) - _dots(spin, cross(spin, span))

    quarter, v, _ = seen.point(0.0)
    vc, vn = _dots(v, wing.e_c), _dots(v, wing.e_n)
    circulation = flier.share * 0.5 * math.pi * c**2 * turning
    rotation = density * dr * circulation * np.array([-vn, vc])
    force = rotation[0][:, None] * wing.e_c + rotation[1][:, None] * wing.e_n
    pushes.append((force, quarter, wing.point(0.0)[1]))

    middle, v_mid, a_mid = seen.point(-c / 4.0)
    normal_rate = _dots(a_mid, wing.e_n) + _dots(v_mid, cross(spin, wing.e_n))
    mass = flier.share * 0.25 * math.pi * density * c**2 * dr
    pushes.append(((-mass * normal_rate)[:, None] * wing.e_n, middle, wing.point(-c / 4.0)[1]))

    airspeed = np.linalg.norm(v, axis=1) if flier.full_airspeed else np.hypot(vc, vn)
    damping = math.pi / 16.0 * density * c**3 * airspeed * turning * dr
    inertia = math.pi / 128.0 * density * c**4 * turning_rate * dr
    return Strips(wing, pushes, -flier.share * (damping + inertia), turning)


def _resultant(force, arm):
    """Both wings' force along x and z and nose-up moment."""
    return 2.0 * np.array([force[:, 0].sum(), force[:, 2].sum(), -cross(arm, force)[:, 1].sum()])


def unbalance(flier, state, phase, acceleration):
    """What is left of force along x and z and of nose-up moment on a body with this acceleration.

    Theory: equations ``body-balance`` and ``body-inertia``.
    """
    body, gravity = flier.vehicle["body"], flier.air["gravity"]
    loads = strip_loads(flier, state, phase, acceleration)
    wing = loads.wing
    ax, az, turning = acceleration
    own, _ = oracle.body_air(flier.vehicle, flier.wingbeat, flier.air, wing)
    left = own - body["mass"] * np.array([ax, az + gravity, 0.0])
    left[2] -= body["pitch_inertia"] * turning
    for force, place, _ in loads.pushes:
        left += _resultant(force, place - wing.body)
    # A couple about -e_s, leading edge up, has this share about -y.
    left[2] += 2.0 * loads.couples @ (np.broadcast_to(wing.e_s, (flier.strips, 3)) @ Y)
    for m, r, _, a in wing.mass_points():
        left += _resultant(-m[:, None] * (a + gravity * Z), r - wing.body)
    return left


def accelerations(flier, state, phase):
    """Body accelerations (ax, az, psi_dd), m/s2 and rad/s2."""
    at_rest = unbalance(flier, state, phase, np.zeros(3))
    columns = [unbalance(flier, state, phase, one) - at_rest for one in np.eye(3)]
    return np.linalg.solve(np.transpose(columns), -at_rest)


def torques_and_powers(flier, state, phase):
    """Hinge torques (flap, pitch) in N m, and hinge, actuator and air power in W, of both wings.

    Theory: equations ``hinge-torques``, ``hinge-power``, ``actuator-power`` and ``air-power``.
    """
    acceleration = accelerations(flier, state, phase)
    loads = strip_loads(flier, state, phase, acceleration)
    wing, gravity = loads.wing, flier.air["gravity"]
    groups = [(-force, place, v) for force, place, v in loads.pushes]
    groups += [(m[:, None] * (a + gravity * Z), r, v) for m, r, v, a in wing.mass_points()]
    span = np.broadcast_to(wing.e_s, (flier.strips, 3))
    turns = np.stack([-span @ wing.e_c0, np.broadcast_to(wing.ratio[:, 0], flier.strips)], axis=-1)
    torque = sum(2.0 * np.einsum("nk,nkj->j", force, wing.jacobian(r)[:, :, 3:]) for force, r, _ in groups)
    torque -= 2.0 * loads.couples @ turns
    flap, pitch = wing_angles(flier.wingbeat, phase)
    in_body = loads.turning + span @ wing.w_body
    actuators = sum(2.0 * np.sum(force * wing.in_body_axes(r, v)) for force, r, v in groups)
    _, air = oracle.body_air(flier.vehicle, flier.wingbeat, flier.air, wing)
    air += sum(2.0 * np.sum(force * v) for force, _, v in loads.pushes)
    return {
        "torques": torque,
        "hinge_power": torque @ np.array([flap[1], pitch[1]]),
        "actuator_power": actuators - 2.0 * loads.couples @ in_body,
        "air_power": air + 2.0 * loads.couples @ loads.turning,
    }
