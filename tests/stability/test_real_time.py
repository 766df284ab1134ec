"""Feedback in real time: against flights by SciPy with torques of the hinges' own equations, and against bumps."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import wingbeat as wb
from wingbeat.animal.kinematics import with_parameters
from wingbeat.mechanics.equations_of_motion import air_forces, equations_of_motion
from wingbeat.mechanics.flights import fly_through
from wingbeat.stability.servos import Servo, follow

SCALES = np.array([0.2, 0.1, 1.0, 1.0, 2.0])
GUST = wb.winds.CosineGust(u=0.5, w=1.0, start=0.02, duration=0.15)


@pytest.fixture(scope="module")
def bumps(cruise):
    return wb.feedback_in_beat(cruise, 4)


@pytest.fixture(scope="module")
def slow(cruise):
    """Twelve samples a beat, a delay of 1.3 of them, a servo of 10 Hz."""
    period = 1 / cruise.wingbeat.frequency
    servo = Servo(bandwidth=10.0)
    return wb.feedback_in_beat(cruise, 12, delay_time=1.3 * period / 12, servos=servo)


def pushed(orbit):
    """The start of a flight away from the orbit."""
    return wb.State(*np.add(orbit.initial_state, [0, 0, 0.05, 0.2, 0.3, 0.5]).tolist())


# --- no delay, and servos without limits: the feedback of before ---


def test_without_delay_and_with_ideal_servos_nothing_changes_by_a_bit(cruise, bumps):
    same = wb.feedback_in_beat(cruise, 4, delay_time=0.0, servos=Servo(speed=math.inf, bandwidth=math.inf))
    for name in ("A", "B", "gains", "path", "phases", "lower", "upper"):
        assert (getattr(same, name) == getattr(bumps, name)).all()
    assert same.timing is bumps.timing is None
    assert bumps.upper.tolist() == (-bumps.lower).tolist() == [4.0 * math.radians(3.0)] * 2
    assert (same.fly(GUST, 3).states == bumps.fly(GUST, 3).states).all()


@pytest.mark.slow
def test_a_delay_of_a_nanosecond_is_none(cruise, bumps):
    late = wb.feedback_in_beat(cruise, 4, delay_time=1e-9)
    assert np.abs(late.A[:, :5, :5] - bumps.A).max() < 2e-3 * np.abs(bumps.A).max()
    assert np.abs(late.B[:, :5] - bumps.B).max() < 2e-3 * np.abs(bumps.B).max()
    assert np.abs(late.gains[:, :, :5] - bumps.gains).max() < 2e-3 * np.abs(bumps.gains).max()
    apart = late.fly(GUST, 8).deviations - bumps.fly(GUST, 8).deviations
    assert np.abs(apart / SCALES).max() < 1e-3


# --- flights ---


def test_late_bumps_are_those_of_a_shifted_sequence(cruise):
    """The oracle flies the bumps as mean, cosine and sine of order 4, in pieces, by the adaptive integrator."""
    period, late = 1 / cruise.wingbeat.frequency, 1.4
    held = wb.feedback_in_beat(cruise, 4, delay_time=late * period / 4)
    assert (held.timing.waiting, round(held.timing.fraction, 9)) == (1, 0.4)
    servo_free = held.fly((0.0, 0.0), 1)
    assert np.abs(servo_free.deviations / SCALES).max() < 1e-2
    start = pushed(cruise)
    flown = held.fly((0.0, 0.0), 2, start=start)
    commands = np.concatenate([np.zeros((2, 2)), flown.bumps])  # of samples -2, -1, 0 ...
    state, found = np.array(start), [np.array(start)]
    for j in range(8):
        for first, last, command in ((0.0, 0.4, commands[j]), (0.4, 1.0, commands[j + 1])):
            turn = 2 * math.pi * 0.4
            changes = {}
            for law, height in zip(("flap", "pitch"), command, strict=True):
                changes[f"{law}_mean"] = getattr(cruise.wingbeat, f"{law}_mean") + height / 2
                changes[f"{law}_cos_4"] = -height / 2 * math.cos(turn)
                changes[f"{law}_sin_4"] = -height / 2 * math.sin(turn)
            phases = np.linspace((j % 4 + first) / 4, (j % 4 + last) / 4, 5)
            beat = with_parameters(cruise.wingbeat, changes)
            state = fly_through(cruise.problem.model, beat, wb.State(*state), phases)[0][-1]
        found.append(state)
    assert np.abs(flown.bumps).max() > 0.01
    assert np.abs((flown.states - found)[:, 1:] / SCALES).max() < 2e-3


def wings(orbit, time, angle, rate, bend):
    """Flap and pitch of the gait plus those of the servos, with two derivatives: cosines of the wingbeat."""
    beat = orbit.wingbeat
    turn = 2 * math.pi * beat.frequency
    flap, pitch = beat.flap_amplitude, beat.pitch_amplitude
    c, s = math.cos(turn * time), math.sin(turn * time)
    laws = [
        [beat.flap_mean + flap * c, beat.pitch_mean - pitch * s],
        [-flap * turn * s, -pitch * turn * c],
        [-flap * turn**2 * c, pitch * turn**2 * s],
    ]
    return np.add(laws, [angle, rate, bend])


def by_scipy(held, start, commands):
    """Fly held commands through the five-coordinate equations of motion; a servo's jump of speed is an impulse."""
    orbit, timing = held.orbit, held.timing
    model, beat = orbit.problem.model, orbit.wingbeat
    period = 1 / beat.frequency
    pace = timing.pace
    sample = period / timing.samples
    state, angle = np.array(start), np.zeros(2)
    waiting = np.concatenate([np.zeros((timing.waiting + 1, 2)), commands])
    found, aim = [state], np.zeros(2)

    def of_body(time, state, wing):
        q, q_dot = np.append(state[:3], wing[0]), np.append(state[3:], wing[1])
        terms = equations_of_motion(model, beat, q, q_dot, time)
        load = np.asarray(air_forces(model, beat, q, q_dot, time).generalised)
        mass = np.asarray(terms.mass_matrix)
        force = load - np.asarray(terms.velocity_matrix) @ q_dot - terms.time_force - terms.gravity_force
        return mass, force

    for j in range(len(commands)):
        for begin, end, target in (
            (0.0, timing.fraction, waiting[j]),
            (timing.fraction, 1.0, waiting[j + 1]),
        ):
            begun, ended = (j + begin) * sample, (j + end) * sample
            jump = pace * (target - aim)
            mass, _ = of_body(begun, state, wings(orbit, begun, angle, pace * (aim - angle), 0 * angle))
            state = state + np.append(np.zeros(3), -np.linalg.solve(mass[:3, :3], mass[:3, 3:] @ jump))
            aim, first = target, angle

            def servo(time, begun=begun, first=first, aim=aim):
                away = (aim - first) * np.exp(-pace * (time - begun))
                return aim - away, pace * away, -(pace**2) * away

            def rates(time, state, servo=servo):
                wing = wings(orbit, time, *servo(time))
                mass, force = of_body(time, state, wing)
                return np.append(state[3:], np.linalg.solve(mass[:3, :3], (force - mass[:, 3:] @ wing[2])[:3]))

            state = solve_ivp(rates, (begun, ended), state, rtol=1e-7, atol=1e-9).y[:, -1]
            angle = servo(ended)[0]
        found.append(state)
    return np.array(found), angle


@pytest.mark.slow
def test_a_servo_that_follows_held_commands_is_that_of_scipy(cruise, slow):
    rigid = wb.load_species("pigeon").with_values({"wingbeat.span_retraction": 0.0})
    orbit = wb.solve_orbit(wb.OrbitProblem(rigid, speed=12.0), starts=2)
    period = 1 / orbit.wingbeat.frequency
    held = wb.feedback_in_beat(orbit, 12, delay_time=1.3 * period / 12, servos=Servo(bandwidth=10.0))
    start = pushed(orbit)
    flown = held.fly((0.0, 0.0), 1, start=start)
    assert np.abs(flown.bumps).max() > 0.02
    states, angle = by_scipy(held, start, flown.bumps)
    assert np.abs((flown.states - states)[-1, 1:] / SCALES).max() < 2e-3
    assert np.abs(flown.states - states)[:, 2].max() < 2e-4
    assert flown.angles[-1] == pytest.approx(angle, abs=1e-7)


@pytest.mark.parametrize(("speed", "pace"), [(3.0, 40.0), (3.0, 1e9), (1e9, 40.0), (1e9, 1e9)])
def test_a_servo_moves_as_small_steps_say(speed, pace):
    angle, steps, whole = np.array([0.3, -0.05, 0.01]), 200_000, 0.05
    by_steps, step = angle.copy(), whole / 200_000
    for _ in range(steps):
        by_steps += np.clip((0.1 - by_steps) * min(pace, 1 / step), -speed, speed) * step
    assert np.asarray(follow(angle, 0.1, speed, pace, whole)) == pytest.approx(by_steps, abs=2e-5)


@pytest.mark.slow
def test_limits_and_speed_hold_in_a_gust(cruise):
    servos = {"pitch": Servo(speed=0.8, bandwidth=80.0, lower=-0.02, upper=0.06)}
    held = wb.feedback_in_beat(cruise, sample_rate=115.0, delay_time=0.01, servos=servos)
    assert len(held.gains) == 12
    flown = held.fly(wb.winds.CosineGust(w=2.0, duration=0.2), 6)
    assert (flown.bumps[:, 0] == 0.0).all()
    assert flown.bumps[:, 1].min() == -0.02
    assert flown.bumps[:, 1].max() <= 0.06
    moved = np.diff(flown.angles[:, 1]) * 12 * cruise.wingbeat.frequency
    assert np.abs(moved).max() == pytest.approx(0.8, rel=1e-6)
    assert (np.abs(flown.angles[:, 0]) < 1e-12).all()


@pytest.mark.slow
def test_many_flights_are_single_ones_and_steps_hardly_matter(cruise, slow):
    many = wb.simulate_many(cruise, [GUST, (0.0, 0.0)], 8, feedback=slow)
    alone = slow.fly(GUST, 8)
    assert many.changes.shape == (2, 8 * 12, 2)
    assert np.abs((many.states[0] - alone.states[::12])[:, 1:] / SCALES).max() < 5e-3
    assert np.abs(many.changes[0] - alone.bumps).max() < 1e-3
    assert np.abs(many.changes[1]).max() < 1e-3
    assert many.survived.all()


# --- maps and gains ---


def test_maps_are_those_of_differences_of_flights(cruise, slow):
    """The first three samples; the gains are replaced by chosen commands."""
    states = len(slow.state)
    assert states == 5 + 2 + 2 * 2
    assert slow.state[5:] == (
        "flap servo",
        "pitch servo",
        *(f"{law}, {n} sample{'s' * (n > 1)} ago" for n in (1, 2) for law in ("flap", "pitch")),
    )
    assert slow.spectral_radius < 1
    state, step = np.array([0.0, 1e-4, 1e-3, -1e-3, 2e-3]), 1e-3
    start = wb.State(*(np.array(cruise.initial_state) + np.append(0.0, state)).tolist())
    flown, calm = slow.fly((0.0, 0.0), 1, start=start), slow.fly((0.0, 0.0), 1)
    predicted = np.zeros(states)
    predicted[:5] = state
    for j in range(12):
        command = -slow.gains[j] @ predicted
        assert flown.bumps[j] - calm.bumps[j] == pytest.approx(command, abs=2e-2 * step)
        predicted = slow.A[j] @ predicted + slow.B[j] @ command
        away = flown.deviations[j + 1] - calm.deviations[j + 1]
        assert np.abs((away - predicted[:5]) / SCALES).max() < 2e-5
        assert np.abs(flown.angles[j] - calm.angles[j] - predicted[5:7]).max() < 1e-5


def test_the_servos_of_the_map_follow_exactly(cruise, slow):
    time = 1 / cruise.wingbeat.frequency / 12
    left, late = math.exp(-2 * math.pi * 10 * time), math.exp(-2 * math.pi * 10 * 0.7 * time)
    row = slow.A[3][5]
    # The command of two samples ago acts for 0.3 of the sample, then that of one sample ago.
    assert row[5] == pytest.approx(left, rel=1e-9)
    assert row[[7, 9]] == pytest.approx([1 - late, late - left], rel=1e-3)
    assert row[[0, 1, 2, 3, 4, 6, 8, 10]] == pytest.approx(0.0, abs=1e-15)
    assert (slow.A[3][7:9] == 0).all()
    assert slow.B[3][7:9].tolist() == np.eye(2).tolist()
    assert slow.A[3][9:11, 7:9].tolist() == np.eye(2).tolist()


def test_gains_are_the_best_of_the_augmented_map(cruise, slow):
    """A change of any gain costs more: the cost is summed over many beats by plain products."""
    weights = np.zeros((len(slow.state),) * 2)
    weights[:5, :5] = np.diag(1 / SCALES**2)
    inputs = np.eye(2) / math.radians(3.0) ** 2

    def cost(gains):
        state, total = np.eye(len(slow.state)), 0.0
        for _ in range(60):
            for A, B, K in zip(slow.A, slow.B, gains, strict=True):
                command = -K @ state
                total += np.trace(state.T @ weights @ state) + np.trace(command.T @ inputs @ command)
                state = A @ state + B @ command
        return total

    least, random = cost(slow.gains), np.random.default_rng(1)
    for _ in range(5):
        changed = slow.gains * (1 + 0.02 * random.standard_normal(slow.gains.shape))
        assert cost(changed) > least


def test_the_record_says_what_servos_do_and_the_report_what_they_cannot(cruise):
    held = wb.feedback_in_beat(cruise, sample_rate=100.0, delay_time=0.01, servos=Servo(speed=math.radians(600)))
    record = held.record()
    assert record["segments"] == len(record["gains"]) == len(record["path"]) - 1 == 10
    assert record["sample_rate"] == pytest.approx(10 * cruise.wingbeat.frequency)
    assert record["delay_time"] == pytest.approx(0.01)
    assert record["servo_speed"]["flap"] == pytest.approx(math.radians(600))
    assert record["servo_bandwidth"]["pitch"] == pytest.approx(60 / (2 * math.pi))  # slows down within 10 degrees
    quickest = 2 * math.pi * cruise.wingbeat.frequency * cruise.wingbeat.flap_amplitude
    assert record["gait_speed"]["flap"] == pytest.approx(quickest, rel=1e-5)
    printed = held.summary()
    assert "10 samples a beat" in printed
    assert "can add to the gait, not make it" in printed


# --- refusals ---


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"delay_time": -0.01}, "delay_time = -0.01"),
        ({"delay_time": 10.0}, "delay_time = 10.0: lasts longer than 64 samples; give at most"),
        ({"sample_rate": math.nan}, "sample_rate = nan"),
        ({"sample_rate": 5.0}, "sample_rate = 5.0: makes 1 samples in a beat"),
        ({"sample_rate": 200.0}, "servos with a speed or a bandwidth allow more"),
        ({"sample_rate": 40.0, "segments": 4}, "segments = 4: is given beside a sample rate"),
        ({"servos": {"tail": Servo()}}, "servos = 'tail'"),
        ({"servos": {"pitch": 600}}, r"servos.pitch = 600: must be a Servo"),
        ({"servos": {}}, "must be a Servo, or servos by name"),
        ({"servos": {"pitch": Servo(speed=3.0), "flap": Servo()}}, "mix a servo without limits"),
        ({"servos": {"pitch": Servo(lower=0.0, upper=0.0)}}, "leave nothing that can move"),
    ],
)
def test_bad_input_gets_its_sentence(cruise, asked, said):
    with pytest.raises(wb.InvalidInputError, match=said):
        wb.feedback_in_beat(cruise, **asked)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"speed": 0.0}, r"servo.speed = 0.0: must be > 0 rad/s; leave it out"),
        ({"bandwidth": math.nan}, "servo.bandwidth = nan"),
        ({"lower": 0.1}, "servo.lower = 0.1"),
        ({"upper": -0.1}, "servo.upper = -0.1"),
    ],
)
def test_bad_servos_are_refused(asked, said):
    with pytest.raises(wb.InvalidInputError, match=said):
        Servo(**asked)
