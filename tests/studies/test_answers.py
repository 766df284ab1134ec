"""What a study keeps is what single orbits say, whoever solves it, in whatever pieces, from its inputs alone."""

import dataclasses
import json
import sqlite3

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import wingbeat as wb
from tests.helpers.engines import Here
from wingbeat._base import NUMERICAL_VERSION, find, label_of
from wingbeat.cli import main
from wingbeat.orbits.options import Status
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.orbits.starts import start_count
from wingbeat.studies import work
from wingbeat.studies.stopping import Stop
from wingbeat.studies.store import Store
from wingbeat.studies.table import to_dataset
from wingbeat.studies.units import Task, Unit

FORM = {
    "species": "pigeon",
    "aero": ["su-fan", "dickinson"],
    "starts": 1,
    "vary": {"speed": {"grid": [9.0, 11.0]}, "wing.mass": {"relative": [1.0, 1.1]}},
}


def kept(path):
    with sqlite3.connect(path) as connection:
        question = "SELECT key, status, record, certificate, error FROM points"
        found = {key: row for key, *row in connection.execute(question)}
    connection.close()
    return found


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    study = wb.plan_study(FORM, store=tmp_path_factory.mktemp("study") / "pigeon.study.sqlite")
    summary = study.run(processes=2)
    assert summary.counts == {"converged": 8}
    assert summary.seconds == pytest.approx(study.to_dataframe()["run_seconds"].sum())
    return study


@pytest.mark.slow
def test_records_are_those_of_single_orbits_and_of_one_process_in_another_order(done, tmp_path):
    vary = {"wing.mass": {"relative": [1.1, 1.0]}, "speed": {"grid": [11.0, 9.0]}}
    turned = wb.plan_study(
        FORM | {"aero": ["dickinson", "su-fan"], "vary": vary}, store=tmp_path / "a.study.sqlite"
    )
    turned.run(processes=1)
    assert kept(turned.store) == kept(done.store)
    record = json.loads(kept(done.store)[next(done.plan.points()).key][1])
    alone = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=9.0), starts=1).record()
    del alone["solve_seconds"]
    # Not to the bit: linear algebra on several threads, which this process has, adds up in another order.
    assert set(record) == set(alone)
    assert record["initial_state"] == pytest.approx(alone["initial_state"], rel=1e-6, abs=1e-8)
    assert record["wingbeat"]["frequency"] == pytest.approx(alone["wingbeat"]["frequency"], rel=1e-8)
    assert record["mean_power"] == pytest.approx(alone["mean_power"], rel=1e-7)
    assert record["warnings"] == alone["warnings"]


@pytest.mark.slow
def test_orbits_are_those_of_the_points_and_fly_again_when_asked_for(done, tmp_path):
    found = list(done.orbits())
    told = [(point["speed"], point["wing.mass"]) for point, _ in found]
    assert told == [tuple(row) for row in done.to_dataframe()[["speed", "wing.mass"]].to_numpy()]
    assert {point["aero"] for point, _ in found} == {"su-fan", "dickinson"}
    point, orbit = found[1]
    assert (
        orbit.record()["wingbeat"] == json.loads(kept(done.store)[list(done.plan.points())[1].key][1])["wingbeat"]
    )
    assert (orbit.status.value, orbit.problem.speed) == ("converged", point["speed"])
    assert orbit.problem.vehicle.wing.mass == point["wing.mass"]
    assert orbit.inputs["starts"] == 1
    again = wb.solve_orbit(orbit.problem, starts=1)
    for name in ("body_pitch", "alpha", "hinge_power"):
        np.testing.assert_allclose(orbit.dataset[name], again.dataset[name], rtol=1e-5, atol=1e-6)
    orbit.save(tmp_path / "one.nc")
    assert wb.load_orbit(tmp_path / "one.nc").record()["mean_power"] == orbit.record()["mean_power"]
    waiting = wb.plan_study(FORM, store=tmp_path / "waiting.study.sqlite")
    with Store.open(waiting.store) as store:
        store.set_plan(waiting.plan)
    assert [orbit for _, orbit in waiting.orbits()] == [None] * 8


def test_the_table_has_the_names_of_the_record(done, tmp_path):
    frame = done.to_dataframe()
    assert list(frame["speed"]) == [9.0, 9.0, 11.0, 11.0] * 2
    assert list(frame["aero.coefficients"].unique()) == ["su-fan", "dickinson"]
    assert (frame["wing.mass"] == frame["vehicle.wing.mass"]).all()
    record = json.loads(kept(done.store)[frame["key"][5]][1])
    assert frame["wingbeat.frequency"][5] == record["wingbeat"]["frequency"]
    assert frame["floquet_multipliers.0.0"][5] == record["floquet_multipliers"][0][0]
    assert frame["stable"][5] == record["stable"]
    late = [name.startswith("run_") for name in frame.columns]
    assert late == sorted(late)
    assert sum(late) == 4
    done.export(tmp_path / "table.csv")
    done.export(tmp_path / "table.nc")
    again = pd.read_csv(tmp_path / "table.csv", comment="#")
    assert list(again.columns) == list(frame.columns)
    head = [line for line in (tmp_path / "table.csv").read_text().splitlines() if line.startswith("# ")]
    assert [line.split()[1] for line in head[2:]] == list(frame.columns)
    assert "# mean_power [W] mean hinge power, both wings" in head
    pd.testing.assert_series_equal(again["mean_power"], frame["mean_power"], check_exact=True)
    with xr.open_dataset(tmp_path / "table.nc", engine="h5netcdf") as dataset:
        assert dataset["mean_power"].values.tolist() == frame["mean_power"].tolist()
        assert list(dataset["status"].values) == ["converged"] * 8
        assert (dataset.attrs["wingbeat_kind"], dataset.attrs["numerical_version"]) == ("study", NUMERICAL_VERSION)
        assert json.loads(dataset.attrs["varied"]) == ["speed", "wing.mass"]
        for name, variable in dataset.variables.items():
            term, text = find(str(name)), variable.dtype.kind not in "fiub"
            assert term is not None, name
            assert variable.attrs["long_name"] == label_of(str(name)), name
            if name != "objective_value":  # its unit is that of the objective
                assert variable.attrs.get("units") == (None if text else term.unit), name
        labels = {name: dataset[name].attrs["long_name"] for name in ("mean_power", "wing.mass", "closure.u")}
        assert labels == {
            "mean_power": "mean hinge power, both wings",
            "wing.mass": "mass of one wing",
            "closure.u": "residual of the forward velocity of the body when re-flown",
        }
        assert (dataset["speed"].attrs["units"], dataset["mean_power"].attrs["units"]) == ("m s-1", "W")


def test_a_study_of_two_objectives_in_two_units_gives_their_values_no_unit():
    frame = pd.DataFrame({"objective": ["frequency", "mean_power"], "objective_value": [6.0, 25.0]})
    assert "units" not in to_dataset(frame, {})["objective_value"].attrs
    assert to_dataset(frame[:1], {})["objective_value"].attrs["units"] == "Hz"


def test_parquet(done, tmp_path):
    try:
        import pyarrow  # noqa: F401
    except ImportError:
        with pytest.raises(wb.WingbeatError, match=r"pip install '\.\[parquet\]'"):
            done.export(tmp_path / "table.parquet")
        return
    done.export(tmp_path / "table.parquet")
    pd.testing.assert_frame_equal(
        pd.read_parquet(tmp_path / "table.parquet"), done.to_dataframe(), check_dtype=False
    )


def test_a_study_that_was_changed_keeps_what_still_applies(done):
    before = kept(done.store)
    form = FORM | {"vary": {"speed": {"grid": [9.0, 10.0, 11.0]}}, "aero": "su-fan"}
    changed = wb.plan_study(form, store=done.store)
    assert changed.status().changed
    assert run_here(changed) == wb.plan_study(form, store=done.store).status()
    assert changed.status().counts == {"converged": 3}
    assert changed.status().kept == 6
    after = kept(done.store)
    assert len(after) == 9
    assert before.items() <= after.items()
    run_here(wb.plan_study(FORM, store=done.store))
    assert kept(done.store) == after


def run_here(study):
    """Run a study in this process: it starts no worker, which would import and load every program anew."""
    study.run_on(Here(), Stop())
    return study.status()


def test_a_chain_hands_its_answers_on_and_does_not_hang_on_how_it_was_cut(tmp_path):
    speeds = [8.0, 8.5, 9.0, 9.5, 10.0]
    form = {"species": "bat", "starts": 1, "vary": {"speed": {"grid": speeds}}, "chain": "speed"}
    whole = wb.plan_study(form, store=tmp_path / "whole.study.sqlite")
    run_here(whole)
    # The first is searched alone, the next from the one before it; then three foretell.
    assert [int(n) for n in whole.to_dataframe()["starts"]] == [1, 1, 1, 1, 1]
    pieces = tmp_path / "pieces.study.sqlite"
    for count in (1, 4, 5):
        run_here(wb.plan_study(form | {"vary": {"speed": {"grid": speeds[:count]}}}, store=pieces))
    assert kept(pieces) == kept(whole.store)


MINE = """
import jax.numpy as jnp
def lift(beat):
    return beat.mean(beat.lift.sum(axis=1)) {more}
"""


@pytest.mark.slow
def test_not_a_number_from_a_users_function_is_told_beside_its_point(tmp_path, capsys):
    (tmp_path / "mine.py").write_text(MINE.format(more="+ jnp.where(beat.speed > 10.0, jnp.nan, 0.0)"))
    file = tmp_path / "lift.toml"
    file.write_text('species = "pigeon"\nminimise = "mine.py:lift"\nstarts = 1\nmost_starts = 1\nspeed = 11.0\n')
    assert main(["study", str(file), "-j", "1"]) == 3
    told = capsys.readouterr()
    assert "error: InvalidInputError: quantity lift = nan: is not finite" in told.out
    (tmp_path / "mine.py").write_text(MINE.format(more="/"))
    assert main(["study", str(file)]) == 2
    assert "mine.py:lift = 'mine.py': cannot be run: SyntaxError" in capsys.readouterr().err


# Frequency [Hz], mean power [W] and cost of transport, in the order of the study.
DIGITS = [
    [9.575126395, 45.16045384, 1.771002546],
    [9.680066931, 46.01931684, 1.809547099],
    [9.471121269, 49.17784624, 1.54750769],
    [9.573861817, 50.08879383, 1.577411169],
    [8.478149628, 49.21312349, 1.840120219],
    [8.550681726, 49.93893457, 1.858959565],
    [9.187513256, 64.28371067, 1.954072054],
    [9.251712943, 65.02334944, 1.966623194],
]


def test_the_numerical_version_is_raised_with_the_numbers(done):
    """Fails when records change: raise NUMERICAL_VERSION, commit the new digits, and tell it in the changelog.

    Machines and releases of JAX and SciPy differ by some 1e-9; the certificate allows 1e-7.
    """
    assert NUMERICAL_VERSION == 10
    found = done.to_dataframe()[["wingbeat.frequency", "mean_power", "cost_of_transport"]].to_numpy()
    np.testing.assert_allclose(found, DIGITS, rtol=1e-6)


@pytest.mark.parametrize("names", [["u"], ["x", "z", "body_pitch", "u", "w", "pitch_rate"]])
def test_a_point_whose_flight_runs_off_is_kept_without_a_certificate(names, done, monkeypatch):
    point = next(done.plan.points())
    found = find_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=9.0), Settings(1))
    closure = {**found.closure, **dict.fromkeys(names, np.nan)}
    lost = dataclasses.replace(found, status=Status.INFEASIBLE, closure=closure)
    monkeypatch.setattr(work, "find_with_known", lambda *given: lost)
    recipe = json.dumps(done.plan.bases[0].recipe.inputs())
    (outcome,) = work.solve_unit(Unit(recipe, (Task(point.key, point.changes),)))
    assert (outcome.status, outcome.certificate) == ("infeasible", None)
    assert [name for name, miss in json.loads(outcome.record)["closure"].items() if miss is None] == names


def test_a_record_that_no_json_holds_is_told_beside_its_point(done, monkeypatch):
    points = list(done.plan.points())[:2]
    found = find_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=9.0), Settings(1))
    monkeypatch.setattr(work, "find_with_known", lambda *given: found)
    record = work.orbit_record
    odd = iter([{"mean_power": np.inf}, {}])
    monkeypatch.setattr(work, "orbit_record", lambda solution: record(solution) | next(odd))
    tasks = tuple(Task(point.key, point.changes) for point in points)
    one, other = work.solve_unit(Unit(json.dumps(done.plan.bases[0].recipe.inputs()), tasks))
    assert (one.key, one.status, one.record) == (points[0].key, "error", None)
    assert "JSON" in one.text
    assert (other.key, other.status) == (points[1].key, "converged")


@pytest.mark.parametrize("least", ["frequency", "mean_power", "peak_power"])
def test_if_nothing_is_said_a_point_is_searched_as_often_as_an_orbit(least, tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr(work, "find_with_known", lambda *given: asked.append(given))
    study = wb.plan_study(species="bat", speed=9.0, minimise=least, store=tmp_path / "x.study.sqlite")
    (point,) = study.plan.points()
    recipe = json.dumps(study.plan.bases[0].recipe.inputs())
    list(work.solve_unit(Unit(recipe, (Task(point.key, point.changes),))))
    problem = wb.OrbitProblem(wb.load_species("bat"), 9.0, minimise=least)
    assert [given[2].starts for given in asked] == [start_count(problem)]
