"""What MuJoCo makes of a URDF, which it reads by rules of its own.

| in the file | in MuJoCo 4 |
|---|---|
| mass of the root link | dropped without a word, unless the element ``mujoco`` says ``fusestatic="false"`` |
| floating root | fixed to the world; a free joint has to be added |
| ``mimic`` | an equality constraint, which is soft |
| ``limit effort`` | a range of the force of all actuators of the joint; 0 is no limit |
| ``limit velocity`` | dropped |
| a plate without thickness | refused, if rounding makes the sum of two inertias smaller than the third |
"""

import re

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.exports.wing_parts import wing_parts

mujoco = pytest.importorskip("mujoco")


def exported(orbit, folder):
    wb.export(orbit, folder / "robot.urdf")
    return (folder / "robot.urdf").read_text(encoding="utf-8")


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rigid", "bat"])
def test_the_whole_vehicle_flies(name, request, tmp_path):
    orbit = request.getfixturevalue(f"{name}_orbit")
    orbit = getattr(orbit, "orbit", orbit)
    text, vehicle = exported(orbit, tmp_path), orbit.problem.vehicle
    spec = mujoco.MjSpec.from_string(text)
    spec.body("body").add_freejoint()
    model = spec.compile()
    data = mujoco.MjData(model)
    assert mujoco.mj_getTotalmass(model) == pytest.approx(vehicle.mass, rel=1e-9)
    assert model.body("body").mass[0] == vehicle.body.mass
    assert text.count("<mimic") == model.neq == (18 if name == "bat" else 0)
    angle = 0.4
    for joint in range(1, model.njnt):
        flap = model.joint(joint).name.endswith("flap")
        data.qpos[model.jnt_qposadr[joint]] = angle if flap else 0.0
    mujoco.mj_forward(model, data)
    q = np.array([0.0, 0.0, 0.0, angle, 0.0])
    # The bat's hand is straight at mid-downstroke, so its strips are on the line of the arm's.
    time = 0.25 / orbit.wingbeat.frequency
    ours = wb.equations_of_motion(orbit.problem.model, orbit.wingbeat, q, np.zeros(5), time).mass_matrix
    full = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, full)
    moved = np.zeros((model.nv, 3))
    moved[0, 0] = moved[2, 1] = 1.0
    for joint in range(1, model.njnt):
        moved[model.jnt_dofadr[joint], 2] = model.joint(joint).name.endswith("flap")
    keep = np.ix_([0, 1, 3], [0, 1, 3])
    np.testing.assert_allclose(moved.T @ full @ moved, np.asarray(ours)[keep], rtol=0, atol=1e-9 * vehicle.mass)


@pytest.mark.slow
def test_without_its_element_the_body_has_no_mass(rigid_orbit, tmp_path):
    vehicle = rigid_orbit.problem.vehicle
    bare = re.sub(r"<mujoco>.*</mujoco>", "", exported(rigid_orbit, tmp_path), flags=re.DOTALL)
    model = mujoco.MjModel.from_xml_string(bare)
    assert [model.body(i).name for i in range(2)] == ["world", "left_flap_link"]
    assert mujoco.mj_getTotalmass(model) == pytest.approx(2 * vehicle.wing.mass, rel=1e-9)


@pytest.mark.slow
def test_efforts_limit_and_velocities_do_not(rigid_orbit, tmp_path):
    text = exported(rigid_orbit, tmp_path)
    model = mujoco.MjModel.from_xml_string(text)
    effort = re.findall(r'effort="([^"]+)"', text)
    assert [range_[1] for range_ in model.jnt_actfrcrange] == [float(value) for value in effort]
    assert (model.jnt_actfrclimited == 1).all()
    faster = mujoco.MjModel.from_xml_string(re.sub(r'velocity="[^"]+"', 'velocity="1e-6"', text))
    data = mujoco.MjData(faster)
    data.qvel[:] = 10.0
    mujoco.mj_step(faster, data)
    assert np.abs(data.qvel).min() > 1.0


def loads(text):
    """Return whether MuJoCo loads a text, which it refuses for one reason only."""
    try:
        mujoco.MjModel.from_xml_string(text)
    except ValueError as refused:
        if "inertia must satisfy A + B >= C" not in str(refused):
            raise
        return False
    return True


def test_a_wing_has_a_hint_of_thickness():
    """A plate's inertias about two axes sum up to the third; MuJoCo refuses it where rounding says less."""
    made, rng = {"thick": 0, "thin": 0}, np.random.default_rng(1)
    for _ in range(60):
        span, mass, power = rng.uniform(0.05, 0.6), rng.uniform(1e-3, 0.1), rng.uniform(0, 3)
        wing = wb.Wing(span, tuple(rng.uniform(0.02, 0.2, 5).tolist()), mass, mass_exponent=power)
        part = wing_parts(wing, wb.Wingbeat(6.0, 0.0, 0.8, 0.1, 0.3), 10)
        _, _, turns = part.inertia(1.0)
        thin = turns.copy()
        thin[0, 0], thin[1, 1] = turns[0, 0] - 1e-13 * turns[2, 2], turns[1, 1] - 1e-13 * turns[2, 2]
        thin[2, 2] = thin[0, 0] + thin[1, 1]
        for kind, moments in (("thick", turns), ("thin", thin)):
            full = " ".join(repr(float(moments[at])) for at in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)))
            text = (
                '<mujoco><compiler balanceinertia="false"/><worldbody><body><joint type="hinge"/>'
                f'<inertial pos="0 0 0" mass="{mass}" fullinertia="{full}"/></body></worldbody></mujoco>'
            )
            made[kind] += loads(text)
    assert made["thick"] == 60
    assert made["thin"] < 55
