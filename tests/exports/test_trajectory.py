"""Tables of a gait, read back as a controller or MATLAB reads them."""

import re

import numpy as np
import pandas as pd
import pytest
import scipy.io

import wingbeat as wb
from tests.exports.conftest import derivative

SAMPLES = 64
COLUMN = re.compile(r"# (\w+) \[(.*?)\] (.+)$")
ALWAYS = [
    *("time", "flap", "flap_rate", "flap_acceleration", "wing_pitch", "wing_pitch_rate", "wing_pitch_acceleration"),
    *("flap_torque_per_wing", "pitch_torque_per_wing", "hinge_power_per_wing", "actuator_power_per_wing"),
]


@pytest.mark.slow
def test_the_gait_of_an_orbit_with_the_lag_of_the_wake_is_that_of_its_series(tmp_path):
    loads = wb.aero.BladeElement("su-fan", unsteady="thin-aerofoil", wake="jones-section")
    bat = wb.load_species("bat")
    orbit = wb.solve_orbit(wb.OrbitProblem(bat, speed=10.0, minimise="mean_positive_power", aero=loads), starts=2)
    for suffix in ("mat", "xml"):
        wb.export(orbit, tmp_path / f"gait.{suffix}", samples=SAMPLES)
    wb.export(orbit, tmp_path / "gait.csv", samples=128)
    frame, series = pd.read_csv(tmp_path / "gait.csv", comment="#"), orbit.dataset
    for name in ("flap_torque", "hinge_power", "actuator_power"):
        wanted = 0.5 * series[name].values[:-1:2]
        np.testing.assert_allclose(frame[f"{name}_per_wing"], wanted, rtol=0, atol=1e-5 * np.abs(wanted).max())
    with pytest.raises(wb.InvalidInputError, match="MuJoCo does not carry along"):
        wb.MujocoFlight(orbit)


@pytest.fixture
def table(orbit, tmp_path):
    path = tmp_path / "gait.csv"
    wb.export(orbit, path, samples=SAMPLES)
    return pd.read_csv(path, comment="#"), path.read_text(encoding="utf-8")


def moving(orbit):
    beat = orbit.wingbeat
    laws = {
        "sweep": beat.sweep_mean or beat.sweep_amplitude,
        "span_ratio": beat.span_retraction,
        "fold": beat.fold_amplitude,
        "tip_twist": beat.twist_mean or beat.twist_harmonics,
        "chord_ratio": beat.chord_retraction or beat.chord_harmonics,
    }
    return {name for name, on in laws.items() if on}


def test_a_table_has_what_moves_with_units(orbit, table):
    frame, text = table
    more = {f"{name}{end}" for name in moving(orbit) for end in ("", "_rate", "_acceleration")}
    assert set(frame.columns) == {*ALWAYS, *more}
    units = dict(found.groups()[:2] for line in text.splitlines() if (found := COLUMN.match(line)))
    assert {*units} == {*frame.columns}
    assert units["flap_acceleration"] == "rad s-2"
    assert units["flap_torque_per_wing"] == "N m"
    assert units["hinge_power_per_wing"] == "W"
    if "span_ratio" in more:
        assert [units[f"span_ratio{end}"] for end in ("", "_rate", "_acceleration")] == ["1", "s-1", "s-2"]
    assert f"# frequency = {orbit.wingbeat.frequency!r} [Hz]" in text
    assert f"# twist_ratio = {orbit.wingbeat.twist_ratio!r} [1]" in text


def test_rows_are_equal_phases_and_rates_are_derivatives(orbit, table):
    frame, _ = table
    period = 1 / orbit.wingbeat.frequency
    np.testing.assert_allclose(frame["time"], np.arange(SAMPLES) / SAMPLES * period, rtol=1e-12, atol=1e-15)
    sampled = wb.simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, samples=SAMPLES).dataset
    # A downstroke that is longer than the upstroke needs more harmonics than the table can resolve.
    precise = 1e-8 if orbit.wingbeat.downstroke_fraction == 0.5 else 1e-3
    for name in ("flap", "wing_pitch", *moving(orbit)):
        np.testing.assert_allclose(frame[name], sampled[name].values[:-1], rtol=1e-12, atol=1e-14)
        for below, above in ((name, f"{name}_rate"), (f"{name}_rate", f"{name}_acceleration")):
            wanted = derivative(frame[below].to_numpy(), period)
            scale = np.abs(frame[above]).max() or 1.0
            np.testing.assert_allclose(frame[above] / scale, wanted / scale, rtol=0, atol=precise)


@pytest.mark.slow
@pytest.mark.parametrize("orbit", ["rigid", "bat"], indirect=True)
def test_torques_and_power_are_those_of_one_wing(orbit, table):
    """The five-coordinate equations of motion, which the series do not use, give those of both wings."""
    frame, _ = table
    sampled = wb.simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, samples=SAMPLES).dataset
    sampled = sampled.isel(phase=slice(0, SAMPLES))

    def stacked(body, hinges):
        return np.stack([*(sampled[name] for name in body), *(frame[name] for name in hinges)], axis=-1)

    both = wb.generalised_torques(
        orbit.problem.model,
        orbit.wingbeat,
        stacked(("x", "z", "body_pitch"), ("flap", "wing_pitch")),
        stacked(("u", "w", "pitch_rate"), ("flap_rate", "wing_pitch_rate")),
        stacked(("u_rate", "w_rate", "pitch_acceleration"), ("flap_acceleration", "wing_pitch_acceleration")),
        frame["time"].to_numpy(),
    )
    for i, name in ((3, "flap_torque_per_wing"), (4, "pitch_torque_per_wing")):
        scale = np.abs(frame[name]).max()
        np.testing.assert_allclose(2 * frame[name] / scale, np.asarray(both)[:, i] / scale, rtol=0, atol=1e-9)
    power = frame["flap_torque_per_wing"] * frame["flap_rate"]
    power += frame["pitch_torque_per_wing"] * frame["wing_pitch_rate"]
    scale = np.abs(power).max()
    np.testing.assert_allclose(frame["hinge_power_per_wing"] / scale, power / scale, rtol=0, atol=1e-9)
    mean = orbit.record()["mean_power"]
    assert 2 * frame["hinge_power_per_wing"].mean() == pytest.approx(mean, rel=2e-3)
    if not moving(orbit) and orbit.wingbeat.twist_ratio == 1.0:
        np.testing.assert_allclose(frame["actuator_power_per_wing"] / scale, power / scale, rtol=0, atol=1e-9)


def test_simulink_finds_structures_with_time(orbit, table, tmp_path):
    frame, text = table
    path = tmp_path / "gait.mat"
    wb.export(orbit, path, samples=SAMPLES)
    read = scipy.io.loadmat(path, squeeze_me=False, struct_as_record=False)
    gait = read["gait"][0, 0]
    assert {*gait._fieldnames} == {*frame.columns} - {"time"}
    for name in gait._fieldnames:
        series = getattr(gait, name)[0, 0]
        signals = series.signals[0, 0]
        assert series.time.shape == signals.values.shape == (SAMPLES + 1, 1)
        assert signals.dimensions == 1.0
        assert signals.label[0] == name
        assert len(name) <= 63
        np.testing.assert_array_equal(signals.values[:-1, 0], frame[name])
        np.testing.assert_array_equal(series.time[:-1, 0], frame["time"])
        scale = np.abs(frame[name]).max()
        assert signals.values[-1, 0] == pytest.approx(frame[name][0], abs=2e-4 * scale)
        assert series.time[-1, 0] == pytest.approx(1 / orbit.wingbeat.frequency)
    simple = scipy.io.loadmat(path, simplify_cells=True)
    assert simple["units"]["flap_rate"] == "rad s-1"
    assert simple["constants"]["frequency"] == orbit.wingbeat.frequency
    assert simple["constants_units"]["stroke_plane_angle"] == "rad"
    meanings = dict((found[1], found[3]) for line in text.splitlines() if (found := COLUMN.match(line)))
    assert simple["meaning"] == meanings


@pytest.mark.parametrize("name", ["gait.nc", "gait.txt", "gait", "gait.csv.gz"])
def test_another_suffix_is_refused(name, rigid_orbit, tmp_path):
    words = r"does not end in a suffix for a gait; end the name in \.csv, \.mat .*\.c3d .*\.xml .* or \.yaml"
    with pytest.raises(wb.InvalidInputError, match=words):
        wb.export(rigid_orbit, tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("samples", [0, 1, 4097, 2.5, True])
def test_samples_that_make_no_beat_are_refused(samples, rigid_orbit, tmp_path):
    with pytest.raises(wb.InvalidInputError, match=r"samples = .*must be a whole number from 2 to 4096"):
        wb.export(rigid_orbit, tmp_path / "gait.csv", samples)
    assert not list(tmp_path.iterdir())


def test_a_mujoco_model_has_shorter_tables(rigid_orbit, tmp_path):
    """MuJoCo 3 refuses to read more than 500 numbers in a row."""
    with pytest.raises(wb.InvalidInputError, match="whole number from 2 to 499"):
        wb.export(rigid_orbit, tmp_path / "gait.xml", 500)
    wb.export(rigid_orbit, tmp_path / "gait.csv", 500)


def test_an_orbit_that_is_not_certified_is_refused_with_all_other_faults(uncertified_orbit, tmp_path):
    with pytest.raises(wb.InvalidInputError, match="orbit = 'not-converged': is not certified") as caught:
        wb.export(uncertified_orbit, tmp_path / "gait.txt", 0)
    assert len(caught.value.faults) == 3
