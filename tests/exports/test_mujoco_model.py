"""The exported MuJoCo model loads by itself; its places, torques and masses are ours."""

import dataclasses
from xml.etree import ElementTree

import numpy as np
import pytest

import wingbeat as wb
from tests.exports.conftest import derivative

pytestmark = pytest.mark.slow

mujoco = pytest.importorskip("mujoco")

TOLERANCE = 1e-6
SAMPLES = 64
BODY = ("x", "z", "body_pitch")


class Loaded:
    """A model read from its file, with the motion of its table; rates of the wings' joints by Fourier series."""

    def __init__(self, text, orbit):
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)
        self.period = 1.0 / orbit.wingbeat.frequency
        self.names = [self.model.joint(i).name for i in range(self.model.njnt)]
        self.series = wb.simulate(
            orbit.problem.model, orbit.wingbeat, orbit.initial_state, samples=SAMPLES
        ).dataset.isel(phase=slice(0, SAMPLES))
        self.position = np.stack([self.table(name) for name in self.names], axis=-1)
        self.rate, self.acceleration = np.zeros_like(self.position), np.zeros_like(self.position)
        for i, name in enumerate(("u", "w", "pitch_rate")):
            self.rate[:, i] = self.series[name]
        for i, name in enumerate(("u_rate", "w_rate", "pitch_acceleration")):
            self.acceleration[:, i] = self.series[name]
        self.rate[:, 3:] = derivative(self.position[:, 3:], self.period)
        self.acceleration[:, 3:] = derivative(self.rate[:, 3:], self.period)

    def table(self, name):
        whole = self.model.numeric(f"gait_{name}").data
        assert len(whole) == SAMPLES + 1
        return whole[:SAMPLES]

    def site(self, side, strip):
        return self.data.site(f"{side}_strip_{strip + 1}")

    def needed(self):
        """Return the forces that the motion takes beyond the recorded strip forces, shape (SAMPLES, joints)."""
        found = []
        for k in range(SAMPLES):
            self.data.qpos[:], self.data.qvel[:] = self.position[k], self.rate[k]
            self.data.qacc[:] = self.acceleration[k]
            mujoco.mj_inverse(self.model, self.data)
            air = np.zeros(self.model.nv)
            for side, sign in (("left", 1.0), ("right", -1.0)):
                for i, force in enumerate(self.series["strip_force"].values[k]):
                    site = self.site(side, i)
                    body = self.model.site_bodyid[site.id]
                    load = force * [1.0, sign, 1.0]
                    mujoco.mj_applyFT(self.model, self.data, load, np.zeros(3), site.xpos, body, air)
            found.append(self.data.qfrc_inverse - air)
        return np.array(found)

    def share(self, name, twist_ratio):
        """Return how far a joint turns when flap or root pitch turn by one."""
        side, _, joint = name.partition("_")
        strip = joint.removeprefix("wing_pitch_")
        if side not in ("left", "right"):
            return 0.0, 0.0
        if joint in ("flap", "wing_pitch"):
            return float(joint == "flap"), float(joint == "wing_pitch")
        count = self.series.sizes["station"]
        return 0.0, 1 + (twist_ratio - 1) * (int(strip) - 0.5) / count if strip.isdigit() else 0.0


def exported(orbit, tmp_path):
    path = tmp_path / "gait.xml"
    wb.export(orbit, path, samples=SAMPLES)
    return path.read_text(encoding="utf-8")


def torque_errors(loaded, orbit):
    """Return the worst misses of body rows and hinge torques over the peaks of air loads and torques."""
    series, needed = loaded.series, loaded.needed()
    shares = np.array([loaded.share(name, orbit.wingbeat.twist_ratio) for name in loaded.names])
    ours = np.stack([series["flap_torque"].values, series["pitch_torque"].values], axis=-1)
    loads = np.stack([series[name].values for name in ("force_x", "force_z", "pitching_moment")], axis=-1)
    body = np.abs(needed[:, :3]).max(axis=0) / np.abs(loads).max(axis=0)
    hinges = np.abs(needed @ shares - ours).max(axis=0) / np.abs(ours).max(axis=0)
    return [*body, *hinges]


@pytest.mark.parametrize("name", ["rigid", "pigeon", "bat", "swept", "off_axis"])
def test_inverse_dynamics_gives_our_torques(name, request, tmp_path):
    """Strip forces are all air loads of these orbits; the animal's tail and couples are tested in flight."""
    orbit = request.getfixturevalue(f"{name}_orbit")
    orbit = getattr(orbit, "orbit", orbit)
    found = torque_errors(Loaded(exported(orbit, tmp_path), orbit), orbit)
    assert max(found) <= TOLERANCE, found


def test_a_hinge_of_a_rigid_wing_carries_half_the_torque(rigid_orbit, tmp_path):
    loaded = Loaded(exported(rigid_orbit, tmp_path), rigid_orbit)
    assert loaded.names == [*BODY, "left_flap", "left_wing_pitch", "right_flap", "right_wing_pitch"]
    needed = loaded.needed()
    for i, name in enumerate(loaded.names[3:], start=3):
        ours = 0.5 * loaded.series["flap_torque" if name.endswith("flap") else "pitch_torque"].values
        assert np.abs(needed[:, i] - ours).max() <= TOLERANCE * np.abs(ours).max()
        row = name.replace("wing_pitch", "pitch") + "_torque"
        np.testing.assert_allclose(loaded.table(row), ours, rtol=0, atol=1e-12 * np.abs(ours).max())
    motors = [loaded.model.actuator(i).name for i in range(loaded.model.nu)]
    assert motors == loaded.names[3:]
    ctrl = loaded.model.key("top_of_stroke").ctrl
    np.testing.assert_allclose(ctrl, needed[0, 3:], rtol=1e-6)


@pytest.mark.parametrize(("where", "wrong"), [("body_mass", 1.001), ("body_inertia", 1.01)])
def test_a_wing_that_is_slightly_wrong_is_seen(where, wrong, rigid_orbit, tmp_path):
    loaded = Loaded(exported(rigid_orbit, tmp_path), rigid_orbit)
    getattr(loaded.model, where)[2:] *= wrong
    mujoco.mj_setConst(loaded.model, loaded.data)
    assert max(torque_errors(loaded, rigid_orbit)) > 100 * TOLERANCE


@pytest.mark.parametrize("name", ["rigid", "pigeon", "bat", "swept", "off_axis"])
def test_the_sites_are_where_our_strips_are(name, request, tmp_path):
    orbit = request.getfixturevalue(f"{name}_orbit")
    orbit = getattr(orbit, "orbit", orbit)
    loaded = Loaded(exported(orbit, tmp_path), orbit)
    ours = loaded.series["strip_position"].values
    for k in range(0, SAMPLES, 7):
        loaded.data.qpos[:] = loaded.position[k]
        mujoco.mj_forward(loaded.model, loaded.data)
        for side, sign in (("left", 1.0), ("right", -1.0)):
            places = [loaded.site(side, i).xpos for i in range(ours.shape[1])]
            np.testing.assert_allclose(places, ours[k] * [1.0, sign, 1.0], rtol=0, atol=1e-12)


def test_masses_gravity_and_keyframe_are_those_of_the_orbit(orbit, tmp_path):
    loaded = Loaded(exported(orbit, tmp_path), orbit)
    model = loaded.model
    assert mujoco.mj_getTotalmass(model) == pytest.approx(orbit.problem.vehicle.mass, rel=1e-12)
    assert model.body("body").mass[0] == pytest.approx(orbit.problem.vehicle.body.mass)
    np.testing.assert_allclose(model.opt.gravity, [0, 0, -9.81])
    key = model.key("top_of_stroke")
    np.testing.assert_allclose([*key.qpos[:3], *key.qvel[:3]], list(orbit.initial_state), atol=1e-12)
    np.testing.assert_allclose(key.qpos, loaded.position[0], atol=1e-12)
    np.testing.assert_allclose(key.qvel[3:], loaded.rate[0, 3:], rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(model.numeric("gait_time").data[-1], 1 / orbit.wingbeat.frequency)


def test_a_tail_is_a_site_without_mass(animal_orbit, tmp_path):
    top = ElementTree.fromstring(exported(animal_orbit, tmp_path))
    tail = animal_orbit.problem.vehicle.tail
    place = top.find("worldbody/body/site[@name='tail']").get("pos")
    np.testing.assert_allclose([float(x) for x in place.split()], [-tail.arm, 0.0, tail.height])
    assert {geom.get("mass") for geom in top.iter("geom")} == {"0"}


def test_a_hand_that_folds_on_a_wing_that_sweeps_is_refused(bat_orbit, tmp_path, monkeypatch):
    swept = dataclasses.replace(bat_orbit.wingbeat, sweep_mean=0.05)
    monkeypatch.setattr(wb.Orbit, "wingbeat", swept)
    with pytest.raises(wb.InvalidInputError, match=r"fold_amplitude = .*: on a wing that sweeps .* \.csv"):
        wb.export(bat_orbit.orbit, tmp_path / "gait.xml")
    assert not list(tmp_path.iterdir())


def test_the_text_is_a_model_of_its_own(rigid_orbit, tmp_path):
    text = exported(rigid_orbit, tmp_path)
    top = ElementTree.fromstring(text)
    assert top.tag == "mujoco"
    assert top.find("option").get("integrator") == "RK4"
    assert "SI, radians" in text
    assert not [node.tag for node in top.iter() if node.get("file")]
