"""The Kalman filter: readings against finite differences of flights, gains against plain covariances."""

import csv
import json
import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.mechanics.flights import fly_through

SCALES = np.array([0.2, 0.1, 1.0, 1.0, 2.0])
SENSORS = wb.Imu(gyro=0.01, accelerometer=0.2, gyro_bias=0.02, accelerometer_bias=0.1, height=0.05)
SAMPLES = 12


@pytest.fixture(scope="module")
def timing(cruise):
    return {"delay_time": 1.3 / cruise.wingbeat.frequency / SAMPLES, "servos": wb.Servo(bandwidth=10.0)}


@pytest.fixture(scope="module")
def held(cruise, timing):
    return wb.feedback_in_beat(cruise, SAMPLES, imu=SENSORS, **timing)


@pytest.fixture(scope="module")
def quiet(cruise, timing):
    """Sensors whose errors are too small to matter."""
    sensors = wb.Imu(gyro=1e-6, accelerometer=1e-6, height=1e-6)
    return wb.feedback_in_beat(cruise, SAMPLES, imu=sensors, **timing)


def test_accelerometers_feel_the_mean_change_of_velocity_and_gravity(held, cruise):
    phases = np.linspace(0.0, 1.0, SAMPLES * 200 + 1)
    states, _ = fly_through(cruise.problem.model, cruise.wingbeat, cruise.initial_state, phases)
    time = phases / cruise.wingbeat.frequency
    forward, up = np.gradient(states[:, 3], time), np.gradient(states[:, 4], time) + 9.81
    pitch = states[:, 2]
    felt = np.stack(
        [forward * np.cos(pitch) + up * np.sin(pitch), up * np.cos(pitch) - forward * np.sin(pitch)], -1
    )
    for j in range(SAMPLES):
        mean = np.trapezoid(felt[200 * j : 200 * j + 201], dx=1 / 200, axis=0)
        assert held.estimator.felt[(j + 1) % SAMPLES] == pytest.approx(mean, abs=0.05)
    assert np.ptp(held.estimator.felt[:, 1]) > 10.0  # within the beat


@pytest.mark.slow
def test_readings_are_those_of_the_maps(quiet, cruise):
    change = np.array([0.0, 1e-4, 1e-3, -1e-3, 2e-3])
    start = wb.State(*(np.array(cruise.initial_state) + np.append(0.0, change)).tolist())
    flown, calm = quiet.fly((0.0, 0.0), 1, start=start), quiet.fly((0.0, 0.0), 1)
    found, readings = quiet.estimator, flown.readings - calm.readings
    state = np.zeros(found.by_state.shape[1])
    state[:5] = change
    scale = np.abs(readings[1:]).max(axis=0)
    for j in range(SAMPLES):
        if j:  # the first sample has no acceleration from before
            assert np.abs((readings[j] - found.output[j] @ state) / scale).max() < 0.02
        state = found.by_state[j] @ state + found.by_command[j] @ (flown.bumps[j] - calm.bumps[j])


@pytest.mark.slow
def test_gains_give_the_least_errors(held):
    """Covariances of the error by plain products (Joseph's form), which hold for any gains."""
    found, random = held.estimator, np.random.default_rng(1)
    eye, error = np.eye(found.by_state.shape[1]), np.diag(SENSORS.noise**2)
    step = 1 / held.orbit.wingbeat.frequency / SAMPLES
    order = len(held.state)

    def spread(gains):
        now = 0.01 * eye
        for _ in range(80):
            for A, H, L in zip(found.by_state, found.output, gains, strict=True):
                left = A @ (eye - L @ H)
                unknown = eye[:, 2:4] - A[:, 2:4]
                unknown[0, 1] += step
                drift = np.zeros(len(eye))
                drift[order + 2 :] = SENSORS.bias[:3] ** 2 * step
                now = left @ now @ left.T + A @ L @ error @ L.T @ A.T + unknown @ unknown.T + np.diag(drift)
        return np.trace(now[:5, :5] / SCALES[:, None] / SCALES)

    least = spread(found.gains)
    for _ in range(4):
        assert spread(found.gains * (1 + 0.05 * random.standard_normal(found.gains.shape))) > least
    assert found.spectral_radius < 1


@pytest.mark.slow
def test_the_filter_finds_the_state_in_a_gust(held, quiet, cruise):
    gust = wb.winds.CosineGust(w=0.5, duration=0.2)
    for feedback, most in ((quiet, 0.002), (held, 0.5)):
        flown = feedback.fly(gust, 10, seed=3)
        apart = (flown.estimates - flown.deviations[:-1])[6 * SAMPLES :] / SCALES
        error = np.sqrt((apart**2).mean(axis=0))
        assert error[[0, 1, 3, 4]].max() < most
        assert error[2] < 0.5
    # An IMU feels the airspeed alone. What a gust does to the estimate of the speed over ground fades slowly, and
    # with better sensors more slowly: such a filter trusts its dead reckoning.
    assert 0.98 < quiet.estimator.spectral_radius < 1
    assert held.estimator.spectral_radius < 0.95
    many = wb.simulate_many(cruise, [wb.winds.CosineGust(w=1.0, duration=0.2)] * 4, 10, feedback=held, seed=1)
    assert many.survived.all()
    assert len(set(many.states[:, -1, 2].round(9).tolist())) == 4  # each flight has its own errors


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".json", ".csv"])
def test_the_file_turns_readings_into_our_commands(held, suffix, tmp_path):
    path = tmp_path / f"controller{suffix}"
    held.save(path)
    flown = held.fly(wb.winds.CosineGust(w=0.5, duration=0.2), 3, seed=2)
    if suffix == ".json":
        block = {name: np.array(value) for name, value in json.loads(path.read_text()).items() if name != "use"}
        series = {n: block[n] for n in ("gains_of_estimate", "gains_of_readings", "memory", "input")}
        output = block["output"]
    else:
        lines = path.read_text().splitlines()
        (about,) = (line for line in lines if line.startswith("# output = "))
        output = np.array(json.loads(about.partition(" = ")[2]))
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
        numbers = np.array(rows[1:], dtype=float)
        series = {}
        for name, columns in (("gains_of_estimate", 16), ("gains_of_readings", 4), ("memory", 16), ("input", 2)):
            own = [i for i, title in enumerate(rows[0]) if title.startswith(f"{name}[")]
            series[name] = numbers[:, own].reshape(SAMPLES, -1, columns)
    memory = np.zeros(16)
    for k, readings in enumerate(flown.readings):
        gain, correct, forward, enter = (one[k % SAMPLES] for one in series.values())
        estimate = memory + correct @ (readings - output @ memory)
        command = np.clip(-gain @ estimate, held.lower, held.upper)
        assert command == pytest.approx(flown.bumps[k], abs=1e-9)
        memory = forward @ estimate + enter @ command


def test_without_a_height_sensor_the_height_is_not_held(cruise, timing):
    blind = wb.feedback_in_beat(cruise, SAMPLES, imu=wb.Imu(gyro=0.01, accelerometer=0.2), **timing)
    assert np.abs(blind.gains[:, :, 0]).max() < 1e-9
    assert blind.spectral_radius < 1
    assert "No sensor gives the height: it is not held." in blind.summary()
    assert math.isfinite(blind.record()["estimator"]["spectral_radius"])
    with pytest.raises(wb.InvalidInputError, match=r"noise = .*: is not that of an IMU"):
        wb.simulate_many(cruise, [(0.0, 0.0)], 2, feedback=blind, noise={"u": 0.1})
    with pytest.raises(wb.InvalidInputError, match=r"imu = .*: has readings that MuJoCo's states do not give"):
        blind.driver()


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"gyro": 0.0, "accelerometer": 0.1}, r"imu.gyro = 0.0: must be > 0"),
        ({"gyro": 0.1, "accelerometer": math.nan}, "imu.accelerometer = nan"),
        ({"gyro": 0.1, "accelerometer": 0.1, "gyro_bias": -1.0}, "imu.gyro_bias = -1.0"),
        ({"gyro": 0.1, "accelerometer": 0.1, "height": 0.0}, "imu.height = 0.0"),
    ],
)
def test_bad_sensors_are_refused(asked, said):
    with pytest.raises(wb.InvalidInputError, match=said):
        wb.Imu(**asked)


def test_sensors_without_servos_or_delay_are_refused(cruise):
    with pytest.raises(wb.InvalidInputError, match="is for feedback with servos or a delay"):
        wb.feedback_in_beat(cruise, 4, imu=SENSORS)
    with pytest.raises(wb.InvalidInputError, match=r"imu = 0.1: must be an Imu"):
        wb.feedback_in_beat(cruise, 4, delay_time=0.01, imu=0.1)
