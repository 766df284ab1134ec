"""A slow, plain oracle for the flapping-flight model, written from the equations with NumPy alone.

It shares no code with the package. Velocities and accelerations come from rigid-body recursion through body,
arm, hand and strip (v = v0 + w x r, a = a0 + w' x r + w x (w x r) + 2 w x r' + r''), not from differentiating
coordinates. SI units and radians throughout. World axes: x forward, y to the left, z up. Arrays put the strip
first and the world axis last; they describe the left wing, while every total counts both wings.

`state` is (x, z, body_pitch, u, w, pitch_rate); `phase` counts wingbeats from the top of the stroke;
`q` is (x, z, psi, phi, theta) and `t` a time in seconds that moves span, fold, sweep, twist and chord only.
`coefficients(alpha)` returns (c_l, c_d, x_cp); `force_at_cp` puts the air load at x_cp; with `full_airspeed` its
size goes with the square of the strip's whole velocity, the spanwise part included.

Each part names the equations of docs/theory that it computes.
"""

import math

import numpy as np

from tests.helpers.oracle_coefficients import blend_distance as blend_distance
from tests.helpers.oracle_coefficients import dickinson as dickinson
from tests.helpers.oracle_coefficients import su_fan as su_fan
from tests.helpers.oracle_laws import chord_ratio, prescribed, wing_angles
from tests.helpers.tail_oracle import moment, tail_load

X, Y, Z = np.eye(3)
STILL = np.zeros(3)
NEXT, AFTER = [1, 2, 0], [2, 0, 1]


def cross(a, b):
    """a x b along the last axis; NumPy's own takes five times as long, and half the time of this oracle."""
    return a[..., NEXT] * b[..., AFTER] - a[..., AFTER] * b[..., NEXT]


# --- Kinematics


def _carry(base, spin, arm, arm_rate=STILL, arm_acceleration=STILL):
    """Velocity and acceleration at `arm` from `base`; the arm's own rates as seen in the turning frame."""
    (v, a), (w, w_dot) = base, spin
    turn = cross(w, arm)
    v_new = v + turn + arm_rate
    a_new = a + cross(w_dot, arm) + cross(w, turn) + 2.0 * cross(w, arm_rate) + arm_acceleration
    return v_new, a_new


def _spin_up(spin, axis, rate, acceleration):
    """Spin of a frame turning about `axis`, which is fixed in the frame of `spin`."""
    w, w_dot = spin
    return w + rate * axis, w_dot + acceleration * axis + cross(w, rate * axis)


class Wing:
    """The left wing's strips at one instant: places, axes, velocities, accelerations.

    With `frozen` the prescribed span and fold keep their values at `t` but stand still.
    """

    def __init__(self, vehicle, wingbeat, q, q_dot, q_ddot, t, strips, frozen=False):
        wing = vehicle["wing"]
        x, z, psi, phi, theta = q

        # Theory: equation ``phase``.
        # What time prescribes: the recovery law that drives the fold, the half span, the sweep, the tip's twist.
        laws = prescribed(wingbeat, wingbeat["frequency"] * t, frozen)
        (law, law_d, law_dd), ratios, (sweep, sweep_d, sweep_dd), twists = laws
        span, span_d, span_dd = (wing["semi_span"] * ratio for ratio in ratios)

        # Per-strip constants, as columns where they multiply vectors. Theory: equations ``strip-chord``,
        # ``strip-mass``, ``strip-angles`` and ``chord-law``.
        eta = (np.arange(strips) + 0.5) / strips
        stations = np.atleast_1d(np.asarray(wing["chord"], float))
        self.chord = np.interp(eta, np.linspace(0.0, 1.0, len(stations)), stations)
        self.air_chord = self.chord * chord_ratio(wingbeat, wingbeat["frequency"] * t)
        share = (1.0 - eta) ** wing["mass_exponent"]
        self.mass = wing["mass"] * share / share.sum()
        self.width = span / strips
        hand = eta > wingbeat["wrist"]
        inner = np.where(hand, wingbeat["wrist"], eta)[:, None]
        outer = np.where(hand, eta - wingbeat["wrist"], 0.0)[:, None]
        fold = np.where(hand, wingbeat["fold_amplitude"], 0.0)[:, None]
        self.ratio = (1.0 + (wingbeat["twist_ratio"] - 1.0) * eta)[:, None]
        twist, twist_d, twist_dd = (eta[:, None] * angle for angle in twists)

        # Axes in the world. Flap turns about e_c0, sweep about -e_n0, pitch about -e_s, body pitch about -y.
        # Theory: equations ``body-axes``, ``stroke-plane``, ``stroke-axes`` and ``strip-axes``.
        x_b = np.array([math.cos(psi), 0.0, math.sin(psi)])
        z_b = np.array([-math.sin(psi), 0.0, math.cos(psi)])
        beta = wing["stroke_plane_angle"] + wingbeat["stroke_plane_tilt"]
        up = -math.cos(beta) * x_b + math.sin(beta) * z_b
        self.e_c0 = math.sin(beta) * x_b + math.cos(beta) * z_b
        e_arm = math.cos(phi) * Y + math.sin(phi) * up
        n_arm = cross(self.e_c0, e_arm)
        own = phi - fold * law
        e_own = np.cos(own) * Y + np.sin(own) * up
        e_n0, tilt = cross(self.e_c0, e_own), theta * self.ratio + twist
        e_arm = math.cos(sweep) * e_arm + math.sin(sweep) * self.e_c0
        self.e_s = math.cos(sweep) * e_own + math.sin(sweep) * self.e_c0
        level = cross(self.e_s, e_n0)
        self.e_c = np.cos(tilt) * level + np.sin(tilt) * e_n0
        self.e_n = -np.sin(tilt) * level + np.cos(tilt) * e_n0

        # Places. Theory: equations ``shoulder-place`` and ``strip-place``.
        self.body, self.psi, self.rate = np.array([x, 0.0, z]), psi, q_dot[2]
        x_s, y_s, z_s = wing["shoulder"]
        hang = x_s * x_b + y_s * Y + z_s * z_b
        self.shoulder = self.body + hang
        self.station = self.shoulder + inner * span * e_arm + outer * span * self.e_s

        # Spins and motions, link by link, where the pages differentiate. Theory: equation ``point-rates``.
        spin_body = (-q_dot[2] * Y, -q_ddot[2] * Y)
        spin_arm = _spin_up(spin_body, self.e_c0, q_dot[3], q_ddot[3])
        spin_own = _spin_up(spin_body, self.e_c0, q_dot[3] - fold * law_d, q_ddot[3] - fold * law_dd)
        spin_arm = _spin_up(spin_arm, -n_arm, sweep_d, sweep_dd)
        spin_own = _spin_up(spin_own, -e_n0, sweep_d, sweep_dd)
        turning, turning_rate = self.ratio * q_dot[4] + twist_d, self.ratio * q_ddot[4] + twist_dd
        self.spin = _spin_up(spin_own, -self.e_s, turning, turning_rate)
        self.w_body, self.w_own = spin_body[0], spin_own[0]
        body = (np.array([q_dot[0], 0.0, q_dot[1]]), np.array([q_ddot[0], 0.0, q_ddot[1]]))
        at_shoulder = _carry(body, spin_body, hang)
        lever = inner * e_arm
        joint = _carry(at_shoulder, spin_arm, span * lever, span_d * lever, span_dd * lever)
        lever = outer * self.e_s
        self.at_station = _carry(joint, spin_own, span * lever, span_d * lever, span_dd * lever)
        self.v_body, self.v_shoulder = body[0], at_shoulder[0]

    def point(self, xi):
        """Place, velocity, acceleration of the points `xi` (m, one per strip) ahead of the pitch axis."""
        arm = np.broadcast_to(xi, self.chord.shape)[:, None] * self.e_c
        return self.station + arm, *_carry(self.at_station, self.spin, arm)

    def mass_points(self):
        """Two tuples (mass, place, velocity, acceleration): the points ahead of and behind mid-chord."""
        # Theory: equation ``mass-points``.
        half = self.chord / (2.0 * math.sqrt(3.0))
        return [(self.mass / 2.0, *self.point(-self.chord / 4.0 + side * half)) for side in (1.0, -1.0)]

    def jacobian(self, r):
        """dr/dq, shape (strips, 3, 5), for points at `r` that belong to the strips."""
        # Theory: equations ``partial-velocities`` and ``quarter-turn``.
        columns = [
            np.broadcast_to(X, r.shape),
            np.broadcast_to(Z, r.shape),
            cross(-Y, r - self.body),
            cross(self.e_c0, r - self.shoulder),
            cross(-self.ratio * self.e_s, r - self.station),
        ]
        return np.stack(columns, axis=-1)

    def jacobian_rate(self, r, v):
        """Rate of `jacobian` along the motion, for points at `r` moving with `v`."""
        # Theory: equation ``frozen-motion``.
        e_c0_rate = cross(self.w_body, self.e_c0)
        e_s_rate = cross(self.w_own, self.e_s)
        columns = [
            np.zeros(r.shape),
            np.zeros(r.shape),
            cross(-Y, v - self.v_body),
            cross(e_c0_rate, r - self.shoulder) + cross(self.e_c0, v - self.v_shoulder),
            -self.ratio * (cross(e_s_rate, r - self.station) + cross(self.e_s, v - self.at_station[0])),
        ]
        return np.stack(columns, axis=-1)

    def in_body_axes(self, r, v):
        """Velocity of points as the body sees them (world components)."""
        return v - self.v_body - cross(self.w_body, r - self.body)

    def air_loads(self, air, coefficients, force_at_cp, full_airspeed):
        """(place, velocity, force, alpha, lift, drag) per strip of one wing."""
        # Theory: equations ``strip-velocity``, ``angle-of-attack``, ``lift-drag``, ``strip-force`` and
        # ``force-point``.
        _, v, _ = self.point(0.0)
        xi, alpha, lift, drag = np.zeros((4, len(v)))
        force = np.zeros(v.shape)
        for i in range(len(v)):
            vc, vn = v[i] @ self.e_c[i], v[i] @ self.e_n[i]
            speed = math.hypot(vc, vn)
            if speed == 0.0:
                continue
            alpha[i] = math.atan2(-vn, vc)
            c_l, c_d, x_cp = coefficients(alpha[i])
            squared = v[i] @ v[i] if full_airspeed else speed**2
            pressure_area = 0.5 * air["density"] * squared * self.air_chord[i] * self.width
            lift[i], drag[i] = pressure_area * c_l, pressure_area * c_d
            along = (vc * self.e_c[i] + vn * self.e_n[i]) / speed
            across = (-vn * self.e_c[i] + vc * self.e_n[i]) / speed
            force[i] = lift[i] * across - drag[i] * along
            if force_at_cp:
                xi[i] = self.air_chord[i] * (0.25 - x_cp)
        place, velocity, _ = self.point(xi)
        return place, velocity, force, alpha, lift, drag


def points(vehicle, wingbeat, q, t, strips):
    """World places (m) of the left wing's quarter-chord points (strips, 3) and mass points (strips, 2, 3)."""
    wing = Wing(vehicle, wingbeat, q, np.zeros(5), np.zeros(5), t, strips)
    return wing.point(0.0)[0], np.stack([r for _, r, _, _ in wing.mass_points()], axis=1)


def _body_drag(vehicle, air, velocity):
    """Drag (N) on the body's reference point moving with `velocity` (m/s). Theory: equation ``body-drag``."""
    return -0.5 * air["density"] * vehicle["body"]["drag_area"] * np.linalg.norm(velocity) * velocity


def crossflow(area, density, body_pitch, velocity):
    """Force (N), x and z, across a body's axis at an angle of attack. Theory: equation ``crossflow-force``."""
    angle = body_pitch - math.atan2(velocity[1], velocity[0])
    size = 0.5 * density * area * (velocity @ velocity) * math.sin(angle) * abs(math.sin(angle))
    return size * np.array([-math.sin(body_pitch), math.cos(body_pitch)])


def body_air(vehicle, wingbeat, air, wing):
    """(force along x and z and nose-up moment, power) of the air on the body and its tail."""
    drag, velocity = _body_drag(vehicle, air, wing.v_body)[[0, 2]], wing.v_body[[0, 2]]
    drag = drag + crossflow(vehicle["body"]["crossflow_area"], air["density"], wing.psi, velocity)
    force, place, moving = tail_load(vehicle, wingbeat, air["density"], wing.psi, velocity, wing.rate)
    return np.array([*(drag + force), moment(force, place)]), drag @ velocity + force @ moving


# --- The flier with the wing motion prescribed


def _prescribed(vehicle, wingbeat, state, phase, strips, acceleration=(0.0, 0.0, 0.0)):
    """The wing with its prescribed motion, on a body with `state` and (ax, az, psi_dd)."""
    x, z, psi, u, w, rate = state
    flap, pitch = wing_angles(wingbeat, phase)
    q, q_dot = (x, z, psi, flap[0], pitch[0]), (u, w, rate, flap[1], pitch[1])
    q_ddot = (*acceleration, flap[2], pitch[2])
    return Wing(vehicle, wingbeat, q, q_dot, q_ddot, phase / wingbeat["frequency"], strips)


def accelerations(
    vehicle, wingbeat, air, state, phase, coefficients, strips, force_at_cp=False, full_airspeed=False
):
    """Body accelerations (ax, az, psi_dd), m/s2 and rad/s2: Newton and Euler about the reference point."""
    # Theory: equations ``wing-loads`` and ``body-balance``.
    wing, body = _prescribed(vehicle, wingbeat, state, phase, strips), vehicle["body"]
    matrix = np.diag([body["mass"], body["mass"], body["pitch_inertia"]])
    right = body_air(vehicle, wingbeat, air, wing)[0] - [0.0, body["mass"] * air["gravity"], 0.0]

    def resultant(force, arm):
        """Both wings' force along x and z and nose-up moment."""
        return 2.0 * np.array([force[:, 0].sum(), force[:, 2].sum(), -cross(arm, force)[:, 1].sum()])

    place, _, force, *_ = wing.air_loads(air, coefficients, force_at_cp, full_airspeed)
    right += resultant(force, place - wing.body)
    for m, r, _, a in wing.mass_points():
        m, arm = m[:, None], r - wing.body
        right += resultant(-m * (a + air["gravity"] * Z), arm)
        for k, per_unit in enumerate((X + 0.0 * arm, Z + 0.0 * arm, cross(-Y, arm))):
            matrix[:, k] += resultant(m * per_unit, arm)
    return np.linalg.solve(matrix, right)


def _needed(vehicle, wingbeat, air, state, phase, coefficients, strips, force_at_cp, full_airspeed):
    """The wing in flight and groups of (force the flier supplies to one wing's points, place, velocity)."""
    args = (coefficients, strips, force_at_cp, full_airspeed)
    acceleration = accelerations(vehicle, wingbeat, air, state, phase, *args)
    wing = _prescribed(vehicle, wingbeat, state, phase, strips, acceleration)
    place, velocity, force, *_ = wing.air_loads(air, coefficients, force_at_cp, full_airspeed)
    groups = [(m[:, None] * (a + air["gravity"] * Z), r, v) for m, r, v, a in wing.mass_points()]
    return wing, [*groups, (-force, place, velocity)]


def hinge_torques(
    vehicle, wingbeat, air, state, phase, coefficients, strips, force_at_cp=False, full_airspeed=False
):
    """Generalised (tau_flap, tau_pitch) in N m, both wings; tau_pitch is conjugate to the root pitch."""
    # Theory: equations ``generalised-force`` and ``hinge-torques``.
    wing, groups = _needed(vehicle, wingbeat, air, state, phase, coefficients, strips, force_at_cp, full_airspeed)
    tau = sum(2.0 * np.einsum("nk,nkj->j", force, wing.jacobian(r)) for force, r, _ in groups)
    return tau[3:]


def powers(vehicle, wingbeat, air, state, phase, coefficients, strips, force_at_cp=False, full_airspeed=False):
    """(hinge power, actuator power) in W, both wings. Theory: equations ``hinge-power`` and ``actuator-power``."""
    args = (vehicle, wingbeat, air, state, phase, coefficients, strips, force_at_cp, full_airspeed)
    wing, groups = _needed(*args)
    flap, pitch = wing_angles(wingbeat, phase)
    hinge = hinge_torques(*args) @ np.array([flap[1], pitch[1]])
    return hinge, sum(2.0 * np.sum(force * wing.in_body_axes(r, v)) for force, r, v in groups)


def air_power(vehicle, wingbeat, air, state, phase, coefficients, strips, force_at_cp=False, full_airspeed=False):
    """Power (W) that the air loads on both wings and the body deliver. Theory: equation ``air-power``."""
    wing = _prescribed(vehicle, wingbeat, state, phase, strips)
    _, velocity, force, *_ = wing.air_loads(air, coefficients, force_at_cp, full_airspeed)
    return 2.0 * np.sum(force * velocity) + body_air(vehicle, wingbeat, air, wing)[1]


def energies(vehicle, wingbeat, air, state, phase, strips):
    """(kinetic, potential) energy in J of body and both wings; potential is zero at z = 0."""
    # Theory: equation ``energies``.
    wing, body = _prescribed(vehicle, wingbeat, state, phase, strips), vehicle["body"]
    kinetic = 0.5 * body["mass"] * wing.v_body @ wing.v_body + 0.5 * body["pitch_inertia"] * state[5] ** 2
    potential = body["mass"] * air["gravity"] * state[1]
    for m, r, v, _ in wing.mass_points():
        kinetic += np.sum(m[:, None] * v**2)
        potential += 2.0 * air["gravity"] * np.sum(m * r[:, 2])
    return kinetic, potential


# --- Five free coordinates


def five_coordinate(vehicle, wingbeat, air, q, q_dot, t, strips):
    """Terms of D q'' + C q' + h + g = tau + f_aero, both wings and body: dict of D, C (5, 5) and h, g (5)."""
    # Theory: equations ``equations-of-motion``, ``mass-matrix``, ``velocity-matrix``, ``time-force`` and
    # ``gravity-force``.
    args = (vehicle, wingbeat, q, q_dot, np.zeros(5), t, strips)
    wing, frozen = Wing(*args), Wing(*args, frozen=True)
    body, gravity = vehicle["body"], air["gravity"]
    d = np.diag([body["mass"], body["mass"], body["pitch_inertia"], 0.0, 0.0])
    c, h, g = np.zeros((5, 5)), np.zeros(5), np.array([0.0, body["mass"] * gravity, 0.0, 0.0, 0.0])
    for moving, still in zip(wing.mass_points(), frozen.mass_points(), strict=True):
        (m, r, _, a), (_, _, v_frozen, a_frozen) = moving, still
        j = wing.jacobian(r)
        d += 2.0 * np.einsum("n,nki,nkj->ij", m, j, j)
        c += 2.0 * np.einsum("n,nki,nkj->ij", m, j, frozen.jacobian_rate(r, v_frozen))
        h += 2.0 * np.einsum("n,nki,nk->i", m, j, a - a_frozen)
        g += 2.0 * gravity * np.einsum("n,ni->i", m, j[:, 2, :])
    return {"D": d, "C": c, "h": h, "g": g}


def aero_forces(vehicle, wingbeat, air, q, q_dot, t, coefficients, strips, force_at_cp=False, full_airspeed=False):
    """Generalised air loads (5) of wings and body; {alpha (rad), lift, drag (N)} of one wing's strips."""
    # Theory: equation ``generalised-air-loads``.
    wing = Wing(vehicle, wingbeat, q, q_dot, np.zeros(5), t, strips)
    place, _, force, alpha, lift, drag = wing.air_loads(air, coefficients, force_at_cp, full_airspeed)
    f_aero = 2.0 * np.einsum("nk,nkj->j", force, wing.jacobian(place))
    f_aero[:3] += body_air(vehicle, wingbeat, air, wing)[0]
    return f_aero, {"alpha": alpha, "lift": lift, "drag": drag}
