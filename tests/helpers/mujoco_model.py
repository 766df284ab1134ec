"""The flapping vehicle as a MuJoCo model: a second multibody engine that knows nothing of our equations.

A planar body (slides x and z, a pitch hinge) carries two mirrored wings. Each wing is a flap hinge at the
shoulder and, on it, one pitch hinge per strip along the quarter-chord line; every strip holds its own two
mass points. Joint angles follow our signs: nose up, wing up and leading edge up are positive. Strip stations,
chords and masses are worked out here from the vehicle's numbers, not by the package.
"""

from typing import NamedTuple

import numpy as np
import pytest

from tests.helpers.tail_oracle import tail_load

mujoco = pytest.importorskip("mujoco")

# The compiler refuses a moving body without mass or inertia: what is nothing is written so, then set to zero.
NOTHING = 1e-14
SIDES = {"left": 1.0, "right": -1.0}


class Strip(NamedTuple):
    """One strip: place along the span and chord [m], mass [kg], its pitch over that of the root."""

    station: float
    chord: float
    mass: float
    share: float


class Inverse(NamedTuple):
    """What MuJoCo finds at each phase: generalised forces (x, z, pitch, flap, wing pitch) and places.

    `needed` are the forces that the recorded motion takes, `air` those of the recorded strip forces;
    `strip_position` (K, 2, N, 3) are the quarter chords of the left and the right wing.
    """

    needed: np.ndarray
    air: np.ndarray
    strip_position: np.ndarray


def strips_of(wing, twist_ratio, count):
    """Cut a wing into equal strips: chord piecewise linear from root to tip, mass as (1 - s/L)**p."""
    fraction = (np.arange(count) + 0.5) / count
    stations = np.atleast_1d(wing.chord)
    chord = np.interp(fraction, np.linspace(0.0, 1.0, stations.size), stations) if stations.size > 1 else stations
    weight = (1.0 - fraction) ** wing.mass_exponent
    columns = np.broadcast_arrays(
        wing.semi_span * fraction,
        chord,
        wing.mass * weight / weight.sum(),
        1.0 - fraction + twist_ratio * fraction,
    )
    return [Strip(*(float(value) for value in row)) for row in zip(*columns, strict=True)]


def _numbers(*values):
    return " ".join(repr(float(value)) for value in values)


def _strip_xml(side, index, strip):
    # Two points of half the mass at mid-chord +- c/(2 sqrt 3) on the x axis, which runs to the leading edge.
    inertia = strip.mass * strip.chord**2 / 12.0
    return f"""
        <body name="{side}-{index}" pos="{_numbers(0, SIDES[side] * strip.station, 0)}">
          <joint name="{side}-{index}" type="hinge" axis="0 -1 0"/>
          <inertial pos="{_numbers(-strip.chord / 4, 0, 0)}" mass="{_numbers(strip.mass)}"
                    diaginertia="{_numbers(NOTHING, inertia, inertia)}"/>
        </body>"""


def _wing_xml(side, wing, strips):
    sign, beta = SIDES[side], wing.stroke_plane_angle
    forward, left, up = wing.shoulder
    # Axes of the wing at rest: x in the stroke plane's normal (e_c0), y to the left, z up the stroke plane.
    frame = _numbers(np.sin(beta), 0, np.cos(beta), 0, 1, 0)
    return f"""
      <body name="{side}" pos="{_numbers(forward, sign * left, up)}" xyaxes="{frame}">
        <joint name="{side}" type="hinge" axis="{_numbers(sign, 0, 0)}"/>
        <inertial pos="0 0 0" mass="{NOTHING}" diaginertia="{NOTHING} {NOTHING} {NOTHING}"/>
        {"".join(_strip_xml(side, i, strip) for i, strip in enumerate(strips))}
      </body>"""


def build(vehicle, strips, gravity):
    """Compile the model; point masses have no inertia about their own line, and the hinges no mass at all."""
    body = vehicle.body
    inertia = _numbers(body.pitch_inertia, body.pitch_inertia, body.pitch_inertia)
    model = mujoco.MjModel.from_xml_string(f"""
<mujoco>
  <compiler autolimits="false" boundmass="0" boundinertia="0" balanceinertia="false"/>
  <option gravity="{_numbers(0, 0, -gravity)}"><flag contact="disable" constraint="disable"/></option>
  <worldbody>
    <body name="body">
      <joint name="x" type="slide" axis="1 0 0"/>
      <joint name="z" type="slide" axis="0 0 1"/>
      <joint name="pitch" type="hinge" axis="0 -1 0"/>
      <inertial pos="0 0 0" mass="{_numbers(body.mass)}" diaginertia="{inertia}"/>
      {"".join(_wing_xml(side, vehicle.wing, strips) for side in SIDES)}
    </body>
  </worldbody>
</mujoco>""")
    model.body_mass[model.body_mass <= NOTHING] = 0.0
    model.body_inertia[model.body_inertia <= NOTHING] = 0.0
    mujoco.mj_setConst(model, mujoco.MjData(model))
    return model


def joint_map(model, strips):
    """Return what every MuJoCo joint does when one of our five coordinates moves, shape (joints, 5)."""
    moved = np.zeros((model.nv, 5))
    for column, name in enumerate(("x", "z", "pitch")):
        moved[model.joint(name).dofadr[0], column] = 1.0
    for side in SIDES:
        moved[model.joint(side).dofadr[0], 3] = 1.0
        for i, strip in enumerate(strips):
            moved[model.joint(f"{side}-{i}").dofadr[0], 4] = strip.share
    return moved


def _push_tail(model, data, vehicle, air_density, q, q_dot, air):
    """Add the force of the tail, by the oracle's formula, where it acts on MuJoCo's body."""
    if vehicle.tail is None:
        return
    parts = {"tail": vars(vehicle.tail)}, {"tail_tilt": 0.0}
    (x, z), place, _ = tail_load(*parts, air_density, q[2], q_dot[:2], q_dot[2])
    body = model.body("body").id
    at = data.xpos[body] + [place[0], 0.0, place[1]]
    mujoco.mj_applyFT(model, data, np.array([x, 0.0, z]), np.zeros(3), at, body, air)


def inverse_dynamics(vehicle, twist_ratio, gravity, q, q_dot, q_acceleration, strip_force, air_density=1.225):
    """Run MuJoCo's inverse dynamics on recorded motion (K, 5) and strip forces (K, N, 3) of the left wing.

    A tail's force is evaluated apart, from the recorded motion.
    Strip i turns by its share k_i of the root pitch; the force on root pitch is therefore sum k_i tau_i.
    """
    count = strip_force.shape[1]
    strips = strips_of(vehicle.wing, twist_ratio, count)
    model = build(vehicle, strips, gravity)
    data, moved = mujoco.MjData(model), joint_map(model, strips)
    bodies = [[model.body(f"{side}-{i}").id for i in range(count)] for side in SIDES]
    found = []
    for k in range(len(q)):
        data.qpos[:], data.qvel[:], data.qacc[:] = moved @ q[k], moved @ q_dot[k], moved @ q_acceleration[k]
        mujoco.mj_inverse(model, data)
        air = np.zeros(model.nv)
        _push_tail(model, data, vehicle, air_density, q[k], q_dot[k], air)
        for ids, sign in zip(bodies, SIDES.values(), strict=True):
            for body, force in zip(ids, strip_force[k] * [1.0, sign, 1.0], strict=True):
                mujoco.mj_applyFT(model, data, force, np.zeros(3), data.xpos[body], body, air)
        found.append((data.qfrc_inverse @ moved, air @ moved, data.xpos[bodies].copy()))
    return Inverse(*(np.array(column) for column in zip(*found, strict=True)))
