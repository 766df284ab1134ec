"""Reduction of records: the forces, the zero, the window, the errors of means, the pooling of repeats."""

import dataclasses
import math

import numpy as np
import pytest

from wingbeat._base import InvalidInputError
from wingbeat.experiment import Campaign, LoadCellRun, load_measurements, reduce_run, reduce_runs, synthetic_runs
from wingbeat.experiment.steadiness import added_variance, standard_error


def run(alpha_deg=30.0, force=(1.0, 0.2, 0.01), seconds=30.0, rate=20.0, **changes):
    """Return a run of constant loads, whose zero is known."""
    time = np.arange(round(seconds * rate)) / rate
    constants = {"speed": 0.5, "density": 1000.0, "viscosity": 1e-6, "chord": 0.08, "span": 0.4}
    constants["tare"] = np.zeros((3, 2))
    loads = [value * np.ones_like(time) for value in force]
    return LoadCellRun("run", time, *loads, alpha_deg, **(constants | changes))


def test_constant_loads_give_the_coefficients_of_the_definitions():
    found = reduce_run(run())
    pressure_area = 0.5 * 1000.0 * 0.5**2 * 0.08 * 0.4
    cos, sin = math.cos(math.radians(30)), math.sin(math.radians(30))
    wanted = [(cos - 0.2 * sin), (sin + 0.2 * cos), 0.01 / 0.08]
    np.testing.assert_allclose(found.mean[:3], np.array(wanted) / pressure_area, rtol=1e-12)
    assert found.mean[3] == pytest.approx(0.5 - 0.01 / 0.08)
    assert found.reynolds == pytest.approx(40_000)
    np.testing.assert_allclose(found.se, 0.0, atol=1e-12)


def test_a_drifting_zero_and_a_transient_are_taken_off():
    plain = run()
    drift = np.linspace(0.3, -0.5, len(plain.time))
    start = np.where(plain.time < 9.0, 2.0, 1.0)
    moved = dataclasses.replace(
        plain, normal_force=plain.normal_force * start + drift, tare=((0.3, -0.5), (0, 0), (0, 0))
    )
    np.testing.assert_allclose(reduce_run(moved).mean, reduce_run(plain).mean, rtol=1e-12)
    assert abs(reduce_run(moved, last=30.0).mean[0] / reduce_run(plain).mean[0] - 1) > 0.1


def test_there_is_no_centre_of_pressure_without_a_force():
    found = reduce_run(run(alpha_deg=0.0, force=(0.0, 0.2, 0.001)))
    assert np.isnan(found.mean[3])
    assert np.isfinite(found.mean[:3]).all()


def test_an_empty_cell_stands_for_it_in_the_file(tmp_path):
    runs = [run(alpha_deg=a, force=(0.04 * a, 0.2, 0.001)) for a in (0.0, 10.0, 20.0, 30.0)]
    table = reduce_runs(runs)
    table.save(tmp_path / "c.csv")
    header, first, *_ = (
        line.split(",") for line in (tmp_path / "c.csv").read_text().splitlines() if line[0] != "#"
    )
    cells = dict(zip(header, first, strict=True))
    assert [cells[name] for name in ("x_cp", "x_cp_sd", "x_cp_se", "runs")] == ["", "", "", "1"]
    again = load_measurements(tmp_path / "c.csv")
    for name, column in table.columns().items():
        np.testing.assert_allclose(again.columns()[name], column, rtol=1e-7, atol=1e-12)


@pytest.mark.parametrize("memory", [0.0, 0.5, 0.9])
def test_the_standard_error_knows_the_memory_of_a_record(memory):
    """A first-order process: the mean of n scatters by (1 + r)/(1 - r) more than that of white noise."""
    from scipy.signal import lfilter

    n, records = 4000, 400
    random = np.random.default_rng(7)
    kicks = random.normal(size=(records, n + 200)) * math.sqrt(1 - memory**2)
    series = np.asarray(lfilter([1.0], [1.0, -memory], kicks))[:, 200:]
    told = standard_error(series)
    theory = math.sqrt((1 + memory) / (1 - memory) / n)
    assert np.sqrt((told**2).mean()) == pytest.approx(theory, rel=0.08)
    assert series.mean(axis=1).std() == pytest.approx(theory, rel=0.1)
    assert told.std() / told.mean() < 0.3


def test_repeats_are_pooled_and_their_own_scatter_is_found():
    errors = np.full(300, 0.01)
    groups = np.repeat(np.arange(100), 3)
    random = np.random.default_rng(7)
    quiet = random.normal(size=300) * 0.01
    assert added_variance(quiet, errors, groups) == 0.0
    loud = quiet + random.normal(size=300) * 0.05
    assert added_variance(loud, errors, groups) == pytest.approx(0.05**2, rel=0.25)
    assert added_variance(quiet[:1], errors[:1], groups[:1]) == 0.0


def test_runs_of_one_angle_and_stream_are_one_row():
    small = Campaign(reynolds=(2e4, 5e4), alpha_deg=(10.0, 20.0, 30.0), repeats=3, rate=10.0)
    table = reduce_runs(synthetic_runs(small, 3))
    assert table.runs is not None
    assert table.reynolds is not None
    assert table.runs.tolist() == [3] * 6
    np.testing.assert_allclose(table.alpha_deg, [10, 20, 30] * 2)
    np.testing.assert_allclose(table.reynolds, [2e4] * 3 + [5e4] * 3)


def test_blockage_is_told_and_not_corrected():
    narrow = [run(alpha_deg=a, channel_width=0.5, thickness=0.01) for a in (0.0, 90.0)]
    wide = [dataclasses.replace(one, channel_width=None) for one in narrow]
    blocked = "the plate blocks up to 16.0% of the channel's width; no correction was made"
    assert blocked in reduce_runs(narrow).notes
    assert blocked not in reduce_runs(wide).notes
    np.testing.assert_array_equal(reduce_runs(wide).mean["C_D"], reduce_runs(narrow).mean["C_D"])


def test_a_window_that_still_moves_is_told():
    late = run(seconds=30.0)
    random = np.random.default_rng(7)
    noise = random.normal(size=len(late.time)) * 0.01
    late = dataclasses.replace(late, normal_force=1.0 + 2 * np.exp(-late.time / 8) + noise)
    assert "still drifting within the window: C_L, C_D;" in reduce_runs([late]).notes[0]


@pytest.mark.parametrize(
    ("changes", "last", "message"),
    [
        ({"speed": 0.0}, 20, "run, speed = 0.0: must be > 0 m/s; give it in SI units"),
        ({"speed": -1.0}, 20, "run, speed = -1.0: must be > 0 m/s"),
        ({"density": math.nan}, 20, "run, density = nan: must be finite"),
        ({"channel_width": 0.0}, 20, "channel_width = 0.0: must be > 0 m"),
        ({"alpha_deg": 200.0}, 20, "alpha_deg = 200.0: must lie between -180 and 180 degrees"),
        ({"seconds": 1.0}, 1, "must hold at least 32 samples; record longer"),
        ({"tare": ((0, 1),)}, 20, "tare = .*must be three pairs of finite numbers"),
        ({}, 0.0, "last = 0.0: must be > 0 s"),
        ({}, 31.0, "last = 31.0: is longer than the record of run, 30 s; give a smaller --last"),
        ({}, 1.0, "last = 1.0: leaves fewer than 32 samples of run"),
    ],
)
def test_refusals(changes, last, message):
    with pytest.raises(InvalidInputError, match=message):
        reduce_run(run(**changes), last)


def test_series_are_checked():
    good = run()
    turning = np.linspace(0, 40, len(good.time))
    with pytest.raises(InvalidInputError, match="but a run has one angle; write one file for each angle"):
        dataclasses.replace(good, alpha_deg=turning)
    with pytest.raises(InvalidInputError, match=r"run, time\[1\] = 0.0: must be above the time before it, 0 s"):
        dataclasses.replace(good, time=np.zeros_like(good.time))
    with pytest.raises(InvalidInputError, match=r"run, moment\[3\] = nan: must be finite"):
        dataclasses.replace(good, moment=np.where(np.arange(len(good.time)) == 3, np.nan, 0.0))
    with pytest.raises(InvalidInputError, match="runs = 'none': there is nothing to reduce"):
        reduce_runs([])


def test_a_sweep_in_radians_is_refused():
    sweep = [run(alpha_deg=a) for a in np.deg2rad([0, 20, 40, 60, 90])]
    with pytest.raises(InvalidInputError, match=r"looks like a sweep in radians; write degrees \(radians times"):
        reduce_runs(sweep)
