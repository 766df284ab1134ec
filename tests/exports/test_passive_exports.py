"""A wing whose pitch gives way, elsewhere: what it flies, and what no format can hold."""

import re
from xml.etree import ElementTree

import numpy as np
import pandas as pd
import pytest

import wingbeat as wb
from tests.exports.conftest import derivative

pytestmark = pytest.mark.slow

SAMPLES = 64
# Errors that count alike: 1 mm, 1 mrad, 10 mm/s, 0.1 rad/s; those of the prescribed orbits' test.
SCALES = np.array([1e-3, 1e-3, 1e-3, 1e-2, 1e-2, 1e-1])


def ours(orbit, beats, samples, start=None, hinge=None):
    hinge = orbit.record()["hinge_start"] if hinge is None else hinge
    return wb.simulate(
        orbit.problem.model, orbit.wingbeat, start or orbit.initial_state, beats, samples, hinge=hinge
    )


def changed(orbit, **numbers):
    """Return the orbit with other numbers of the wingbeat, which were not solved for."""
    record = orbit.record()
    record["wingbeat"] |= numbers
    return wb.Orbit.of_record(record, orbit.problem, starts=2)


def distance(one, other):
    return float(np.abs((one - other) / SCALES).max())


def test_a_table_has_the_pitch_that_was_flown(passive_orbit, tmp_path):
    wb.export(passive_orbit, tmp_path / "gait.csv", samples=128)
    frame, series = pd.read_csv(tmp_path / "gait.csv", comment="#"), passive_orbit.dataset
    assert np.ptp(frame["wing_pitch"]) > 0.5
    for name in ("wing_pitch", "hinge_angle", "hinge_rate", "flap", "wing_pitch_rate"):
        known = "hinge_rate" if name == "wing_pitch_rate" else name
        np.testing.assert_allclose(frame[name], series[known].values[:-1:2], rtol=0, atol=2e-6, err_msg=name)
    np.testing.assert_array_equal(frame["wing_pitch"], frame["hinge_angle"])
    period = 1 / passive_orbit.wingbeat.frequency
    # The loads have kinks, so the acceleration has more harmonics than the table resolves.
    for below, above, near in (
        ("hinge_angle", "hinge_rate", 1e-3),
        ("wing_pitch_rate", "wing_pitch_acceleration", 3e-2),
    ):
        miss = np.abs(derivative(frame[below].to_numpy(), period) - frame[above]).max()
        assert miss < near * np.abs(frame[above]).max(), below
    assert (frame["pitch_torque_per_wing"] == 0).all()
    hinge = passive_orbit.wingbeat.pitch_hinge
    spring = -0.7 * (frame["hinge_angle"] - hinge.rest_angle) - 0.0083 * frame["hinge_rate"]
    np.testing.assert_allclose(frame["hinge_torque_per_wing"], spring, rtol=0, atol=1e-12)
    assert "# hinge_torque_per_wing [N m] torque of spring, damper and stops" in (tmp_path / "gait.csv").read_text()


def test_a_wing_that_twists_by_itself_is_in_the_table(passive_orbit, tmp_path):
    twisted = changed(passive_orbit, hinge_twist_share=0.25)
    wb.export(twisted, tmp_path / "gait.csv", samples=SAMPLES)
    frame = pd.read_csv(tmp_path / "gait.csv", comment="#")
    np.testing.assert_allclose(frame["wing_pitch"], 0.75 * frame["hinge_angle"], rtol=0, atol=1e-14)
    np.testing.assert_allclose(frame["tip_twist"], 0.25 * frame["hinge_angle"], rtol=0, atol=1e-14)


def test_points_move_with_the_pitch_that_was_flown(passive_orbit, tmp_path):
    ezc3d = pytest.importorskip("ezc3d")
    wb.export(passive_orbit, tmp_path / "gait.c3d", samples=128)
    file = ezc3d.c3d(str(tmp_path / "gait.c3d"))
    labels = file["parameters"]["POINT"]["LABELS"]["value"]
    corner = passive_orbit.dataset["strip_corner"].values[:-1:2]
    for i in range(corner.shape[1]):
        for name, ends in (("leading", slice(0, 2)), ("trailing", slice(2, 4))):
            found = file["data"]["points"][:3, labels.index(f"left_{name}_{i + 1}")].T
            np.testing.assert_allclose(found, corner[:, i, ends].mean(axis=1), rtol=0, atol=3e-6)


def test_the_model_has_springs_in_place_of_pitch_motors(passive_orbit, tmp_path):
    mujoco = pytest.importorskip("mujoco")
    wb.export(passive_orbit, tmp_path / "gait.xml", samples=SAMPLES)
    text = (tmp_path / "gait.xml").read_text()
    model, hinge = mujoco.MjModel.from_xml_string(text), passive_orbit.wingbeat.pitch_hinge
    names = [model.joint(i).name for i in range(model.njnt)]
    pitch = np.array([name.endswith("wing_pitch") for name in names])
    assert pitch.sum() == 2
    assert [model.actuator(i).name for i in range(model.nu)] == ["left_flap", "right_flap"]
    np.testing.assert_array_equal(model.jnt_stiffness, np.where(pitch, 0.7, 0.0))
    np.testing.assert_array_equal(model.dof_damping, np.where(pitch, 0.0083, 0.0))
    np.testing.assert_array_equal(model.qpos_spring[pitch], hinge.rest_angle)
    series, key = ours(passive_orbit, 1, SAMPLES), model.key("top_of_stroke")
    np.testing.assert_allclose(np.array([key.qpos[pitch], key.qvel[pitch]]).T, [series.hinge[0]] * 2, atol=1e-12)
    table = model.numeric("gait_right_wing_pitch").data
    np.testing.assert_allclose(table, series.hinge[:, 0], rtol=0, atol=1e-12)
    np.testing.assert_allclose(key.ctrl, 0.5 * series.dataset["flap_torque"].values[[0, 0]], rtol=1e-12)
    assert not re.search("gait_left_pitch_torque", text)
    lever = 0.1 * passive_orbit.problem.vehicle.wing.chord  # of the strips' centres behind the axis of pitch
    wing = ElementTree.fromstring(text).find(".//body[@name='left_wing']/inertial").get("pos").split()
    assert float(wing[0]) == pytest.approx(-lever, rel=1e-12)


def test_mujoco_flies_the_orbit_as_closely_as_a_driven_one(passive_orbit):
    """Flap is prescribed and pitch is free: MuJoCo's springs, our air. Limits are those of prescribed orbits."""
    pytest.importorskip("mujoco")
    misses, turned = [], []
    for steps in (64, 128, 256):
        flight = wb.MujocoFlight(passive_orbit, steps)
        flown, series = flight.fly(), ours(passive_orbit, 1, steps)
        misses.append(distance(flown.states, series.states))
        turned.append(np.abs(flown.positions[:, [4, 6]] - series.hinge[:, :1]).max())
        assert flown.torques.shape == (steps + 1, 2)
    assert misses[2] < 0.1 * misses[0]
    assert misses[2] < 1e-2
    assert turned[2] < 1e-5
    travelled = np.array([passive_orbit.inputs["speed"], 0, 0, 0, 0, 0]) / passive_orbit.wingbeat.frequency
    assert distance(flown.states[-1], flown.states[0] + travelled) < 1e-2
    flap = series.dataset["flap_torque"].values
    np.testing.assert_allclose(flown.torques.sum(axis=1), flap, rtol=0, atol=1e-5 * np.abs(flap).max())


def test_with_many_steps_mujoco_agrees_to_1e_6(passive_orbit):
    pytest.importorskip("mujoco")
    flown, series = wb.MujocoFlight(passive_orbit, 1024).fly(), ours(passive_orbit, 1, 1024)
    assert np.abs(flown.states - series.states).max() < 1e-6
    assert np.abs(flown.positions[:, 4] - series.hinge[:, 0]).max() < 1e-6


def test_a_disturbed_body_and_hinge_fly_as_ours(passive_orbit):
    pytest.importorskip("mujoco")
    start = passive_orbit.initial_state
    start = start._replace(body_pitch=start.body_pitch + 0.05, w=0.5)
    flight = wb.MujocoFlight(passive_orbit, 256)
    flight.data.qpos[:3], flight.data.qvel[:3] = start[:3], start[3:]
    flight.data.qpos[[4, 6]], flight.data.qvel[[4, 6]] = 0.3, -2.0
    flown, series = flight.fly(2), ours(passive_orbit, 2, 256, start, (0.3, -2.0))
    assert distance(flown.states, series.states) < 2e-2
    assert np.abs(flown.positions[:, 4] - series.hinge[:, 0]).max() < 1e-4


@pytest.mark.parametrize("bumps", [True, False])
def test_feedback_that_knows_the_hinge_flies_in_mujoco_as_in_our_flight(bumps, passive_orbit):
    pytest.importorskip("mujoco")
    asked = {} if bumps else {"delay_time": 0.01, "servos": {"flap": wb.Servo(speed=10.0)}}
    held, start = wb.feedback_in_beat(passive_orbit, 8, **asked), passive_orbit.initial_state
    start = start._replace(body_pitch=start.body_pitch + 0.05, w=start.w + 0.3)
    series, driver = held.fly((0.0, 0.0), 3, start=start), held.driver()
    flight = wb.MujocoFlight(passive_orbit, 256)
    flight.data.qpos[:3], flight.data.qvel[:3] = start[:3], start[3:]
    flown = flight.fly(3, servos=driver)
    commands = np.array(driver.commands)
    assert np.abs(commands).max() > 0.01
    assert np.abs(commands - series.bumps).max() < 0.02 * np.abs(commands).max()
    apart = flown.states[::32, 1:] - series.states[:, 1:6]
    assert np.abs(apart / [1.0, 0.1, 1.0, 1.0, 2.0]).max() < 1e-3
    assert np.abs(flown.positions[::32, 4] - series.states[:, 6]).max() < 1e-3


@pytest.mark.parametrize("wrong", ["jnt_stiffness", "dof_damping", "qpos_spring"])
def test_with_a_wrong_spring_the_flight_is_another(wrong, passive_orbit):
    pytest.importorskip("mujoco")
    flight = wb.MujocoFlight(passive_orbit, 64)
    getattr(flight.model, wrong)[[4, 6]] *= 0.5
    assert distance(flight.fly().states, ours(passive_orbit, 1, 64).states) > 10


def test_too_few_steps_for_a_stiff_hinge_are_refused(passive_orbit):
    """MuJoCo's RK4 would diverge: `findings/mujoco_implicit_springs.sh`."""
    pytest.importorskip("mujoco")
    stiff = changed(passive_orbit, hinge_stiffness=100.0)
    with pytest.raises(wb.InvalidInputError, match=r"steps = 64: are too few .* take at least (\d+)") as refused:
        wb.MujocoFlight(stiff, 64)
    least = int(re.search(r"at least (\d+)", str(refused.value))[1])
    flown = wb.MujocoFlight(stiff, 8 * least).fly()
    assert distance(flown.states, ours(stiff, 1, 8 * least).states) < 1.0


def test_a_flight_that_breaks_off_is_no_gait(passive_orbit, tmp_path):
    """So stiff a spring takes more steps of the integrator than a beat may have."""
    with pytest.raises(wb.InvalidInputError, match=r"orbit = 'converged': breaks off when it is flown again"):
        wb.export(changed(passive_orbit, hinge_stiffness=1e8), tmp_path / "gait.csv")


def test_a_controller_keeps_the_hinge(passive_orbit):
    pytest.importorskip("mujoco")
    softer = changed(passive_orbit, hinge_stiffness=1.0).wingbeat
    with pytest.raises(wb.InvalidInputError, match=r"controller = .*: changes the hinge; keep that of the orbit"):
        wb.MujocoFlight(passive_orbit, 64).fly(1, lambda beat, state: softer)


@pytest.mark.parametrize("suffix", ["xml", "urdf", "sdf", "yaml"])
@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        ({"hinge_twist_share": 0.5}, r"pitch_hinge = .*: turns strips that also twist.*export the gait as \.csv"),
        (
            {"twist_ratio": 1.5},
            r"pitch_hinge = .*: turns strips that also twist.* a wing that only flaps and sweeps",
        ),
        (
            {"hinge_stop_stiffness": 5.0},
            r"stop_stiffness = 5\.0: belongs to stops that set in smoothly.*without stops",
        ),
    ],
)
def test_what_no_joint_stands_for_is_refused(numbers, words, suffix, passive_orbit, tmp_path):
    with pytest.raises(wb.InvalidInputError, match=words):
        wb.export(changed(passive_orbit, **numbers), tmp_path / f"gait.{suffix}", samples=8)
    assert not list(tmp_path.iterdir())
