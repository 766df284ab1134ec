"""The controller's files, each run by a few lines that share no code with the package, against flights of ours."""

import csv
import json
import math

import numpy as np
import pytest
from scipy.io import loadmat

import wingbeat as wb

FILES = ("controller.json", "controller.mat", "controller.csv")


@pytest.fixture(scope="module")
def held(cruise):
    period = 1 / cruise.wingbeat.frequency
    servos = {"flap": wb.Servo(bandwidth=8.0, lower=-0.05), "pitch": wb.Servo(bandwidth=12.0, upper=0.01)}
    return wb.feedback_in_beat(cruise, 12, delay_time=1.3 * period / 12, servos=servos)


def pushed(orbit):
    return wb.State(*np.add(orbit.initial_state, [0, 0, 0.05, 0.2, 0.3, 0.5]).tolist())


def read(path):
    """Return the numbers of a controller by name; gains have the sample first."""
    if path.suffix == ".json":
        found = json.loads(path.read_text())
    elif path.suffix == ".mat":
        found = loadmat(path, simplify_cells=True)["controller"]
        found["path"] = found["path"].T
        for name in ("gains_of_state", "gains_of_memory"):
            found[name] = np.moveaxis(found[name], -1, 0)
    else:
        lines = path.read_text().splitlines()
        about = [line[2:].partition(" = ") for line in lines if line.startswith("# ") and " = " in line]
        known = {name: value for name, _, value in about if name.isidentifier() and value[0] in "[0123456789-"}
        found = {name: json.loads(value) for name, value in known.items()}
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
        numbers = np.array(rows[1:], dtype=float)
        found["path"] = np.stack([numbers[:, i] for i, name in enumerate(rows[0]) if name.startswith("path")], 1)
        for name in ("gains_of_state", "gains_of_memory"):
            own = [i for i, column in enumerate(rows[0]) if column.startswith(f"{name}[")]
            found[name] = numbers[:, own].reshape(len(numbers), 2, -1)
    return {name: np.array(value) for name, value in found.items() if name != "use"}


def run(block, states, climbed):
    """Return the commands for measured states (z, body_pitch, u, w, pitch_rate), z from the start."""
    memory, commands = np.zeros(len(block["memory"])), []
    for k, state in enumerate(states):
        j = k % len(block["path"])
        away = state - block["path"][j]
        away[0] -= climbed * (k // len(block["path"]))
        wanted = -(block["gains_of_state"][j] @ away + block["gains_of_memory"][j] @ memory)
        commands.append(np.clip(wanted, block["lower"], block["upper"]))
        memory = block["memory"] @ memory + block["input"] @ commands[-1]
    return np.array(commands)


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
def test_each_file_gives_the_commands_of_our_flights(held, cruise, name, tmp_path):
    held.save(tmp_path / name)
    flown = held.fly(wb.winds.CosineGust(w=1.0, duration=0.2), 3, start=pushed(cruise))
    states = flown.states[:-1, 1:] - [flown.states[0, 1], 0, 0, 0, 0]
    block = read(tmp_path / name)
    assert float(block["sample_rate"]) == pytest.approx(12 * cruise.wingbeat.frequency)
    commands = run(block, states, 0.0)
    assert np.abs(commands).max() > 0.03
    assert commands[:, 1].max() == 0.01
    assert commands == pytest.approx(flown.bumps, abs=1e-6)


def test_the_memory_knows_how_far_a_servo_gets(held):
    speed = math.radians(100)
    quick = wb.feedback_in_beat(held.orbit, 12, servos=wb.Servo(speed=speed))
    driver, block = quick.driver(), quick.record()
    far = wb.State(*np.add(held.orbit.initial_state, [0, 0, 0.5, 0, 0, 0]).tolist())
    driver.command(held.orbit.initial_state)
    driver.command(far)
    assert np.abs(driver.commands[1]).max() > 0.1
    moved = driver._memory[:2]
    assert np.abs(moved).max() == pytest.approx(speed / block["sample_rate"])


def test_another_suffix_is_refused(held, tmp_path):
    with pytest.raises(wb.InvalidInputError, match=r"does not end in a suffix for a controller; end"):
        held.save(tmp_path / "controller.txt")


@pytest.mark.slow
@pytest.mark.parametrize(
    "asked",
    [
        {"sample_rate": 1000.0, "delay_time": 0.01, "servos": wb.Servo(speed=math.radians(600))},
        {"segments": 8, "delay_time": 0.01},
        {"segments": 8},
    ],
)
def test_the_block_flies_in_mujoco_at_a_kilohertz_as_in_our_flight(asked):
    """MuJoCo has its own mechanics and steps; the servos there are moved in closed form from step to step."""
    pytest.importorskip("mujoco")
    rigid = wb.load_species("pigeon").with_values({"wingbeat.span_retraction": 0.0})
    orbit = wb.solve_orbit(wb.OrbitProblem(rigid, speed=12.0), starts=2)
    found = wb.feedback_in_beat(orbit, **asked)
    samples = len(found.gains)
    steps = samples * max(1, round(1000 / (samples * orbit.wingbeat.frequency)))
    start = pushed(orbit)
    ours = found.fly((0.0, 0.0), 5, start=start)
    flight, driver = wb.MujocoFlight(orbit, steps), found.driver()
    flight.data.qpos[:3], flight.data.qvel[:3] = start[:3], start[3:]
    flown = flight.fly(5, servos=driver)
    assert flight.model.opt.timestep == pytest.approx(1e-3, rel=0.05)
    states = flown.states[:: steps // samples]
    apart = np.abs((states - ours.states)[:, 1:] / [0.2, 0.1, 1.0, 1.0, 2.0])
    commands = np.array(driver.commands)
    assert np.abs(commands).max() > 0.03
    assert apart.max() < 1e-2
    assert np.abs(commands - ours.bumps).max() < 0.02 * np.abs(commands).max()
    first, last = (np.abs(ours.deviations[k] / [0.2, 0.1, 1.0, 1.0, 2.0]).max() for k in (0, -1))
    assert last < 0.7 * first


def test_bumps_without_delay_are_a_block_too_and_a_step_must_divide_its_samples(cruise, tmp_path):
    plain = wb.feedback_in_beat(cruise, 4)
    path = tmp_path / "bumps.json"
    plain.save(path)
    block = json.loads(path.read_text(encoding="utf-8"))
    assert np.shape(block["gains_of_memory"]) == (4, 2, 0)
    driver, state = plain.driver(), pushed(cruise)
    first = driver.command(state)
    away = np.array(state, dtype=float)[1:] - plain.path[0]
    away[0] = 0.0
    wanted = -np.array(block["gains_of_state"][0]) @ away
    np.testing.assert_allclose(first, np.clip(wanted, block["lower"], block["upper"]), rtol=1e-12)
    with pytest.raises(wb.InvalidInputError, match="do not divide"):
        plain.driver()(0.0, 0.3 / cruise.wingbeat.frequency, state)
