"""A slow oracle for a flier whose wing pitch gives way, from the Lagrangian of its mass points.

It shares no code with the package and no formula with `oracle`: points are placed by products of rotations, the
equations ``d/dt (dL/dv) - dL/dq = Q`` are those of Lagrange with derivatives by JAX, and every load of the air
enters by its virtual work. Coordinates are q = (x, z, psi, theta), where theta is the hinge's angle; flap, sweep,
span and fold are functions of time. A load that depends on accelerations is linear in them, so its values at five
accelerations solve the equations.

Conventions and `coefficients` as in `oracle`; vehicle, wingbeat, hinge and air are dictionaries.
"""

import dataclasses
import math

import jax
import jax.numpy as jnp
import numpy as np

from tests.helpers.tail_oracle import moment, tail_load

jax.config.update("jax_enable_x64", True)

# Over this angle, a stop's torque grows from none to its stiffness times the angle [rad].
STOP_WIDTH = 0.05


@dataclasses.dataclass(frozen=True)
class HingedFlier:
    """A vehicle with its wingbeat, hinge and air, and how the air loads its strips."""

    vehicle: dict
    wingbeat: dict
    hinge: dict
    air: dict
    coefficients: object
    strips: int = 10
    share: float = 0.0  # of the unsteady terms
    force_at_cp: bool = True


def _flap(angle):
    c, s = jnp.cos(angle), jnp.sin(angle)
    return jnp.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


def _ahead(angle):
    c, s = jnp.cos(angle), jnp.sin(angle)
    return jnp.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])


def _nose_up(angle):
    c, s = jnp.cos(angle), jnp.sin(angle)
    return jnp.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])


def _laws(beat, t):
    """Flap, root pitch, recovery, span, sweep and chord at a time: plain laws, even strokes."""
    turn = 2.0 * math.pi * beat["frequency"] * t
    up = 0.5 * (1.0 - jnp.sin(turn))
    return {
        "flap": beat["flap_mean"] + beat["flap_amplitude"] * jnp.cos(turn),
        "pitch": beat["pitch_mean"] - beat["pitch_amplitude"] * jnp.sin(turn + beat["pitch_phase"]),
        "recovery": up,
        "span": 1.0 - beat["span_retraction"] * up,
        "sweep": beat["sweep_mean"] + beat["sweep_amplitude"] * jnp.sin(turn + beat["sweep_phase"]),
        "chord": 1.0 - beat["chord_retraction"] * up,
    }


def _numbers(flier):
    """All numbers as arrays, with span fraction, full chord and mass of each strip."""
    wing = dict(flier.vehicle["wing"])
    eta = (np.arange(flier.strips) + 0.5) / flier.strips
    stations = np.atleast_1d(np.asarray(wing["chord"], float))
    chord = np.interp(eta, np.linspace(0.0, 1.0, len(stations)), stations)
    share = (1.0 - eta) ** wing["mass_exponent"]
    table = {name: wing.pop(name, None) for name in ("mass_stations", "station_masses")}
    axes, gyrations = wing.pop("station_axes", None), wing.pop("station_gyrations", None)
    if table["mass_stations"] is None:
        pieces = {"eta": eta, "chord": chord, "mass": wing["mass"] * share / share.sum()}
    else:  # the pieces themselves, not strips of their mass
        place = np.asarray(table["mass_stations"])
        there = np.interp(place, np.linspace(0.0, 1.0, len(stations)), stations)
        pieces = {"eta": place, "chord": there, "mass": np.asarray(table["station_masses"])}
    pieces["axis"] = (wing["mass_axis"] if axes is None else np.asarray(axes)) * np.ones_like(pieces["chord"])
    pieces["gyration"] = (wing["mass_gyration"] if gyrations is None else np.asarray(gyrations)) + 0.0 * pieces[
        "eta"
    ]
    parts = {
        "body": flier.vehicle["body"],
        "wing": {name: value for name, value in wing.items() if name != "chord"},
        "beat": {name: value for name, value in flier.wingbeat.items() if isinstance(value, float)},
        "hinge": flier.hinge,
        "air": flier.air,
        "strips": {"eta": eta, "chord": chord},
        "pieces": pieces,
    }
    return jax.tree_util.tree_map(lambda a: jnp.asarray(a, dtype=float), parts)


def places(numbers, q, t):
    """World places of quarter chord and mass points, and the unit vectors along chord and normal."""
    wing, beat, tau = numbers["wing"], numbers["beat"], numbers["hinge"]["twist_share"]
    x, z, psi, theta = q
    laws = _laws(beat, t)
    root = jnp.where(tau == 1.0, laws["pitch"], (1.0 - tau) * theta)
    length = wing["semi_span"] * laws["span"]
    shoulder = jnp.array([x, 0.0, z]) + _nose_up(psi) @ jnp.array(wing["shoulder"])
    stroke = _nose_up(psi + 0.5 * math.pi - wing["stroke_plane_angle"] - beat["stroke_plane_tilt"])
    arm = stroke @ _flap(laws["flap"]) @ _ahead(laws["sweep"])
    hand = stroke @ _flap(laws["flap"] - beat["fold_amplitude"] * laws["recovery"]) @ _ahead(laws["sweep"])

    def framed(e):
        inner, outer = jnp.minimum(e, beat["wrist"]), jnp.maximum(e - beat["wrist"], 0.0)
        angle = root * (1.0 + (beat["twist_ratio"] - 1.0) * e) + (beat["twist_mean"] + tau * theta) * e
        turned = jnp.where(e <= beat["wrist"], arm, hand) @ _nose_up(angle)
        return shoulder + length * (inner * arm[:, 1] + outer * hand[:, 1]), turned[:, 0], turned[:, 2]

    def strip(one):
        axis, fore, normal = framed(one["eta"])
        return {"quarter": axis + (wing["pitch_axis"] - 0.25) * one["chord"] * fore, "e_c": fore, "e_n": normal}

    def piece(one):
        axis, fore, _ = framed(one["eta"])
        centre, reach = ((wing["pitch_axis"] - one["axis"]) * fore, one["gyration"] * fore)
        return {side: axis + one["chord"] * (centre + sign * reach) for side, sign in (("front", 1), ("rear", -1))}

    return jax.vmap(strip)(numbers["strips"]) | jax.vmap(piece)(numbers["pieces"])


def lagrangian(numbers, q, v, t):
    """L = T - V; the torques of stops and damper enter as generalised forces."""
    hinge, (kinetic, potential) = numbers["hinge"], energies(numbers, q, v, t)
    return kinetic - potential - 0.5 * hinge["stiffness"] * (q[3] - hinge["rest_angle"]) ** 2


def energies(numbers, q, v, t):
    """Kinetic energy and that of gravity."""
    body, mass, gravity = numbers["body"], numbers["pieces"]["mass"], numbers["air"]["gravity"]
    at, moving = jax.jvp(lambda a, b: places(numbers, a, b), (q, t), (v, jnp.ones_like(t)))
    kinetic = 0.5 * body["mass"] * (v[0] ** 2 + v[1] ** 2) + 0.5 * body["pitch_inertia"] * v[2] ** 2
    potential = body["mass"] * gravity * q[1]
    for name in ("front", "rear"):  # each half a strip's mass, on two wings
        kinetic = kinetic + 0.5 * jnp.sum(mass[:, None] * moving[name] ** 2)
        potential = potential + gravity * jnp.sum(mass * at[name][:, 2])
    return kinetic, potential


@jax.jit
def _equations(numbers, q, v, t):
    """Mass matrix and the rest of the left sides of Lagrange's equations."""

    def momentum(q, v, t):
        return jax.grad(lambda w: lagrangian(numbers, q, w, t))(v)

    matrix = jax.jacfwd(momentum, argnums=1)(q, v, t)
    _, rate = jax.jvp(lambda a, b: momentum(a, v, b), (q, t), (v, jnp.ones_like(t)))
    return matrix, rate - jax.grad(lambda a: lagrangian(numbers, a, v, t))(q)


@jax.jit
def _strips(numbers, q, v, a, t):
    """Places along a motion, their first and second time derivatives, and their derivatives by q."""

    def at(later):
        return places(numbers, q + later * v + 0.5 * later**2 * a, t + later)

    (now, first), (_, second) = jax.jvp(lambda later: jax.jvp(at, (later,), (1.0,)), (0.0,), (1.0,))
    return now, first, second, jax.jacfwd(lambda b: places(numbers, b, t))(q)


def stop_torque(hinge, theta):
    """Torque of the stops on both sides of 0 [N m]. Theory: equation ``hinge-torque``."""
    over = math.log1p(math.exp((theta - hinge["stop_angle"]) / STOP_WIDTH))
    under = math.log1p(math.exp((-theta - hinge["stop_angle"]) / STOP_WIDTH))
    return -hinge["stop_stiffness"] * STOP_WIDTH * (over - under)


def _generalised(flier, numbers, strips, t, v, psi):
    """Generalised air loads on (x, z, psi, theta) by virtual work, two wings, body and tail."""
    (now, rate, second, by_q), density = strips, flier.air["density"]
    laws = _laws(flier.wingbeat, t)
    chords = np.asarray(numbers["strips"]["chord"]) * float(laws["chord"])
    width = flier.vehicle["wing"]["semi_span"] * float(laws["span"]) / flier.strips
    total = np.zeros(4)
    for i, c in enumerate(chords):
        e_c, e_n, velocity = now["e_c"][i], now["e_n"][i], rate["quarter"][i]
        vc, vn = float(velocity @ e_c), float(velocity @ e_n)
        speed, across = math.hypot(vc, vn), vc * e_n - vn * e_c
        c_l, c_d, x_cp = flier.coefficients(math.atan2(-vn, vc))
        force = 0.5 * density * speed * c * width * (c_l * across - c_d * (vc * e_c + vn * e_n))
        ahead = c * (0.25 - x_cp) if flier.force_at_cp else 0.0
        total += 2.0 * force @ (by_q["quarter"][i] + ahead * by_q["e_c"][i])
        if not flier.share:
            continue
        # Theory: equations ``rotation-force``, ``added-mass`` and ``unsteady-couple``.
        turning = float(rate["e_c"][i] @ e_n)
        turning_rate = float(second["e_c"][i] @ e_n + rate["e_c"][i] @ rate["e_n"][i])
        # The middle of the chord that meets the air is a point of the wing, also while that chord shrinks.
        at, moving, speeding = (one["quarter"][i] - 0.25 * c * one["e_c"][i] for one in (by_q, rate, second))
        normal_rate = float(speeding @ e_n + moving @ rate["e_n"][i])
        lift = 0.5 * math.pi * density * c**2 * width * turning * across
        resistance = -0.25 * math.pi * density * c**2 * width * normal_rate * e_n
        couple = -math.pi / 16.0 * density * c**3 * width * (speed * turning + 0.125 * c * turning_rate)
        work = lift @ by_q["quarter"][i] + resistance @ at + couple * (e_n @ by_q["e_c"][i])
        total += 2.0 * flier.share * work
    along = np.asarray(v[:2])
    drag = -0.5 * density * flier.vehicle["body"]["drag_area"] * np.linalg.norm(along) * along
    force, place, _ = tail_load(flier.vehicle, flier.wingbeat, density, psi, along, v[2])
    return total + np.array([*(drag + force), moment(force, place), 0.0])


def accelerations(flier, q, v, phase):
    """x'', z'' [m/s2], psi'' and theta'' [rad/s2]. Theory: equation ``hinge-balance``."""
    hinge, time, numbers = flier.hinge, float(phase) / flier.wingbeat["frequency"], _numbers(flier)
    q, v, t = (jnp.asarray(one, dtype=float) for one in (q, v, time))
    matrix, rest = (np.asarray(a) for a in _equations(numbers, q, v, t))

    def loads(acceleration):
        found = _strips(numbers, q, v, jnp.asarray(acceleration, dtype=float), t)
        strips = jax.tree_util.tree_map(np.asarray, found)
        return _generalised(flier, numbers, strips, time, np.asarray(v), float(q[2]))

    right = loads(np.zeros(4))
    if flier.share:
        matrix = matrix - np.transpose([loads(one) - right for one in np.eye(4)])
    right = right - rest
    right[3] += stop_torque(hinge, float(q[3])) - hinge["damping"] * float(v[3])
    return np.linalg.solve(matrix, right)
