"""MuJoCo, loaded by our air and driven by the gait, flies the certified orbit."""

import sys

import numpy as np
import pytest

import wingbeat as wb

mujoco = pytest.importorskip("mujoco")

# Errors that count alike: 1 mm, 1 mrad, 10 mm/s, 0.1 rad/s.
SCALES = np.array([1e-3, 1e-3, 1e-3, 1e-2, 1e-2, 1e-1])


def ours(orbit, beats, steps):
    return wb.simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, beats, steps)


def distance(one, other):
    return float(np.abs((one - other) / SCALES).max())


@pytest.mark.slow
def test_a_beat_closes_in_on_the_orbit_and_takes_our_torques(orbit):
    """The integrator has order four; kinks of the coefficients take some of it."""
    found, misses = [], []
    for steps in (64, 128, 256):
        flight = wb.MujocoFlight(orbit, steps)
        flown, series = flight.fly(), ours(orbit, 1, steps)
        assert flown.time[-1] == pytest.approx(1 / orbit.wingbeat.frequency)
        found.append(flown.states[:: steps // 64])
        misses.append(distance(flown.states, series.states))
    assert misses[2] < 0.1 * misses[0]
    assert misses[2] < distance(found[2], found[1])  # the step size alone explains it
    assert misses[2] < 1e-2
    travelled = np.array([orbit.inputs["speed"], 0, 0, 0, 0, 0]) / orbit.wingbeat.frequency
    assert distance(found[2][-1], found[2][0] + travelled) < 1e-2
    check_torques(flight, flown, series.dataset, orbit.wingbeat.twist_ratio)


def check_torques(flight, flown, series, twist):
    names = [flight.model.actuator(i).name for i in range(flight.model.nu)]
    for law, torque in (("flap", "flap_torque"), ("wing_pitch", "pitch_torque")):
        total = np.zeros(len(flown.time))
        for name, values in zip(names, flown.torques.T, strict=True):
            own, strip = name.split("_", 1)[1], name.rsplit("_", 1)[1]
            if own == law:
                total += values
            elif own.startswith(f"{law}_") and strip.isdigit():
                total += values * (1 + (twist - 1) * (int(strip) - 0.5) / series.sizes["station"])
        np.testing.assert_allclose(total, series[torque], rtol=0, atol=1e-5 * np.abs(series[torque]).max())


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rigid", "animal"])
def test_three_beats_stay_with_our_flight(name, request):
    orbit = request.getfixturevalue(f"{name}_orbit")
    flight = wb.MujocoFlight(orbit, 256)
    flown = flight.fly(beats=3)
    assert distance(flown.states, ours(orbit, 3, 256).states) < 2e-2
    driven = flight.data.qpos[3:]
    flight.reset()
    np.testing.assert_allclose(driven, flight.data.qpos[3:], rtol=0, atol=1e-6)


def test_a_disturbed_flight_is_ours(rigid_orbit):
    """Not only the orbit: the loads follow the state."""
    start = rigid_orbit.initial_state._replace(body_pitch=rigid_orbit.initial_state.body_pitch + 0.1, w=0.5)
    flight = wb.MujocoFlight(rigid_orbit, 256)
    flight.data.qpos[:3], flight.data.qvel[:3] = start[:3], start[3:]
    wanted = wb.simulate(rigid_orbit.problem.model, rigid_orbit.wingbeat, start, 1, 256).states
    assert distance(flight.fly().states, wanted) < 2e-2


@pytest.fixture(scope="module")
def pushed(rigid_orbit):
    """The start of a flight: on the orbit, but 0.5 m/s upward and 0.05 rad nose up."""
    start = rigid_orbit.initial_state
    return start._replace(w=start.w + 0.5, body_pitch=start.body_pitch + 0.05)


def flown_from(start, orbit, beats, controller=None):
    flight = wb.MujocoFlight(orbit, 64)
    flight.data.qpos[:3], flight.data.qvel[:3] = start[:3], start[3:]
    return flight.fly(beats, controller)


@pytest.mark.slow
def test_the_controller_holds_the_gait_and_the_flight_is_ours(rigid_orbit, pushed):
    held = wb.feedback(rigid_orbit)
    flown = flown_from(pushed, rigid_orbit, 10, held.controller())
    model, beat = rigid_orbit.problem.model, rigid_orbit.wingbeat
    wanted = wb.simulate(model, beat, pushed, 10, 64, controller=held.controller()).states
    assert distance(flown.states, wanted) < 1.0
    away = (flown.states[-1] - np.array(rigid_orbit.initial_state))[2:]
    assert np.abs(away / [0.1, 1.0, 1.0, 2.0]).max() < 0.15
    assert (np.diff(flown.time) > 0).all()
    assert len(set(np.diff(flown.time).round(9))) > 1  # the frequency changes from beat to beat


@pytest.mark.slow
def test_without_the_controller_the_push_has_not_decayed(rigid_orbit, pushed):
    flown = flown_from(pushed, rigid_orbit, 10)
    away = (flown.states[-1] - np.array(rigid_orbit.initial_state))[2:]
    assert np.abs(away / [0.1, 1.0, 1.0, 2.0]).max() > 0.4


def test_a_controller_without_a_wingbeat_is_refused(rigid_orbit):
    with pytest.raises(wb.InvalidInputError, match="controller = None: returned NoneType after 0 beats"):
        wb.MujocoFlight(rigid_orbit, 16).fly(1, lambda beat, state: None)
    assert mujoco.get_mjcb_control() is None


def test_without_our_air_the_flight_is_another(rigid_orbit):
    flight = wb.MujocoFlight(rigid_orbit, 64)
    drive = flight.drive

    def in_a_vacuum(model, data):
        drive(model, data)
        data.qfrc_applied[:] = 0.0

    flight.drive = in_a_vacuum
    assert distance(flight.fly().states, ours(rigid_orbit, 1, 64).states) > 10


def test_the_callback_is_taken_back(rigid_orbit):
    flight = wb.MujocoFlight(rigid_orbit, 16)
    flight.fly()
    assert mujoco.get_mjcb_control() is None


@pytest.mark.parametrize("steps", [0, 15, 64.0])
def test_bad_steps_are_refused(steps, rigid_orbit):
    with pytest.raises(wb.InvalidInputError, match=r"steps = .*must be a whole number from 16 to 100000"):
        wb.MujocoFlight(rigid_orbit, steps)


def test_an_orbit_that_is_not_certified_is_refused(uncertified_orbit):
    with pytest.raises(wb.InvalidInputError, match="orbit = 'not-converged': is not certified"):
        wb.MujocoFlight(uncertified_orbit)


def test_bad_beats_are_refused(rigid_orbit):
    with pytest.raises(wb.InvalidInputError, match="beats = 0: must be a whole number"):
        wb.MujocoFlight(rigid_orbit, 16).fly(0)


def test_without_the_library_the_extra_is_named(rigid_orbit, monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(wb.FileError, match=r"MuJoCo is not installed here: .*--extra mujoco"):
        wb.MujocoFlight(rigid_orbit)
