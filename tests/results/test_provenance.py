"""What a file keeps of an orbit: record, series with units, and inputs that alone find the orbit again."""

import json

import h5netcdf
import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from wingbeat._base import SERIES
from wingbeat._jax.arrays import jax
from wingbeat.records.forms import inputs_hash, orbit_attributes
from wingbeat.records.inputs import aero_record, inputs_of, problem_from
from wingbeat.records.result_files import save_result


def but_for_the_time_it_took(record):
    return {name: value for name, value in record.items() if name != "solve_seconds"}


@pytest.fixture(scope="module")
def saved(solved, tmp_path_factory):
    """One orbit of a session and the file it was saved to."""
    path = tmp_path_factory.mktemp("saved") / "orbit.nc"
    solved.orbit.save(path)
    return solved.orbit, path


def test_a_saved_orbit_reads_back_the_same(saved):
    orbit, path = saved
    again = wb.load_orbit(path)
    assert again.record() == orbit.record()
    assert json.dumps(again.record()) == json.dumps(orbit.record())
    assert again.inputs == orbit.inputs
    xr.testing.assert_identical(again.dataset, orbit.dataset)
    assert (again.status, again.message) == (orbit.status, orbit.message)
    assert (again.wingbeat, again.initial_state) == (orbit.wingbeat, orbit.initial_state)
    assert again.problem == orbit.problem


@pytest.mark.slow
def test_saved_twice_it_is_the_same(saved, tmp_path):
    orbit, path = saved
    again = wb.load_orbit(path)
    again.save(tmp_path / "again.nc")
    assert wb.load_orbit(tmp_path / "again.nc").record() == orbit.record()
    xr.testing.assert_identical(wb.load_orbit(tmp_path / "again.nc").dataset, orbit.dataset)


def test_every_variable_has_a_unit_a_name_and_a_place_in_the_nomenclature(saved):
    series = wb.load_orbit(saved[1]).dataset
    terms = {term.name: term for term in SERIES}
    assert series.variables.keys() == terms.keys()
    for name, variable in series.variables.items():
        term = terms[name]
        assert variable.dims[0] == ("phase" if name not in series.dims else name), name
        assert variable.attrs["long_name"] == term.label, name
        if name not in ("axis", "corner"):  # labels, not quantities
            assert variable.attrs["units"] == term.unit != "", name
            assert np.isfinite(variable.values).all(), name
    assert dict(series.sizes) == {"phase": 257, "station": 10, "corner": 4, "axis": 3}


def test_the_file_is_plain_netcdf(saved):
    """No wingbeat is needed to read it: h5netcdf and xarray do, and the attributes are the record."""
    orbit, path = saved
    record = orbit.record()
    with h5netcdf.File(path, "r") as file:
        assert {*file.variables} == {term.name for term in SERIES}
        assert file.variables["u"].attrs["units"] == "m s-1"
        # Series and record come of two compiled programs: one equation, but on some processors another last bit.
        assert float(np.max(file.variables["hinge_power"][:])) == pytest.approx(record["peak_power"], rel=1e-12)
        assert file.attrs["Conventions"] == "CF-1.11"
        assert file.attrs["status"] == "converged"
        assert json.loads(file.attrs["wingbeat"]) == record["wingbeat"]
        assert json.loads(file.attrs["inputs"]) == orbit.inputs
    with xr.open_dataset(path, engine="h5netcdf") as series:
        assert series.attrs["mean_power"] == record["mean_power"]
        assert json.loads(series.attrs["closure"]) == record["closure"]
        assert series["hinge_power"].sel(phase=0.25).item() == orbit.dataset["hinge_power"].values[64]


def test_the_inputs_alone_find_the_orbit_again(solved):
    """So do two searches with one seed: the records differ in nothing but the time they took."""
    inputs = json.loads(json.dumps(solved.orbit.inputs))
    problem = problem_from(inputs)
    assert problem == problem_from(inputs_of(problem, inputs["starts"], inputs["seed"]))
    again = wb.solve_orbit(problem, inputs["starts"], inputs["seed"])
    assert but_for_the_time_it_took(again.record()) == but_for_the_time_it_took(solved.orbit.record())
    assert again.inputs == solved.orbit.inputs
    for name in solved.orbit.dataset.variables:
        np.testing.assert_array_equal(again.dataset[name], solved.orbit.dataset[name])


def test_the_hash_follows_every_input(bat_orbit):
    inputs = bat_orbit.orbit.inputs
    digest = bat_orbit.orbit.dataset.attrs["inputs_hash"]
    assert inputs_hash(inputs) == digest
    assert inputs_hash(dict(reversed(inputs.items()))) == digest
    problem, starts, seed = bat_orbit.problem, inputs["starts"], inputs["seed"]

    def other(**changed):
        arguments = {name: getattr(problem, name) for name in ("species", "speed", "climb", "aero", "air")}
        return wb.OrbitProblem(**(arguments | changed))

    variants = [
        inputs_of(problem, starts, seed + 1),
        inputs_of(problem, starts + 1, seed),
        inputs_of(other(speed=8.5), starts, seed),
        inputs_of(other(climb=0.1), starts, seed),
        inputs_of(other(air=wb.Air(density=1.0)), starts, seed),
        inputs_of(other(aero=wb.aero.SuFan()), starts, seed),
        inputs_of(other(aero=wb.aero.Dickinson("signed-drag")), starts, seed),
        inputs_of(other(aero=wb.aero.BladeElement(wb.aero.Dickinson(), 11)), starts, seed),
        inputs_of(other(species=problem.species.with_values({"wing.mass": 0.005})), starts, seed),
        inputs_of(other(bounds={"body_pitch": (-0.9, 0.9)}), starts, seed),
        inputs_of(other(free=("frequency", "flap_mean")), starts, seed),
    ]
    assert len({digest, *(inputs_hash(variant) for variant in variants)}) == len(variants) + 1
    for variant in variants:  # and each sets up its own problem again
        assert inputs_of(problem_from(variant), variant["starts"], variant["seed"]) == variant


def test_a_table_of_coefficients_travels_with_the_orbit(bat_orbit, tmp_path):
    """A problem with a CSV is the same problem after the file, with the CSV gone."""
    alpha, model = np.arange(0.0, 91.0, 2.5), wb.aero.SuFan()
    rows = zip(
        alpha, *(f(np.radians(alpha)) for f in (model.lift, model.drag, model.centre_of_pressure)), strict=True
    )
    table = tmp_path / "wing.csv"
    table.write_text("alpha_deg,c_l,c_d,x_cp\n" + "".join(f"{','.join(map(str, row))}\n" for row in rows))
    coefficients = wb.aero.load_coefficients(table, blend_width_deg=2.0)
    aero = wb.aero.BladeElement(coefficients, 12, "centre-of-pressure")
    problem = wb.OrbitProblem(wb.load_species("bat"), speed=8.0, aero=aero)
    # The record is another orbit's: to solve this one would only prove JAX's patience.
    record, inputs = bat_orbit.orbit.record() | {"aero": aero_record(aero)}, inputs_of(problem, 2, 0)
    series = bat_orbit.orbit.dataset.assign_attrs(orbit_attributes(record, inputs))
    save_result(series, tmp_path / "orbit.nc")
    table.unlink()
    again = wb.load_orbit(tmp_path / "orbit.nc").problem
    assert again.aero == aero
    assert (again.vehicle, again.free, again.bounds) == (problem.vehicle, problem.free, problem.bounds)
    assert inputs_of(again, 2, 0) == inputs
    angles = np.linspace(-np.pi, np.pi, 64)
    for one, other in zip(jax.tree.leaves(again.model), jax.tree.leaves(problem.model), strict=True):
        np.testing.assert_array_equal(one, other)
    np.testing.assert_array_equal(again.aero.coefficients.lift(angles), coefficients.lift(angles))
    np.testing.assert_allclose(coefficients.lift(np.radians(33.0)), model.lift(np.radians(33.0)), rtol=1e-3)


@pytest.mark.parametrize("size", [0, 4, 8, 100, 5000])
def test_a_file_cut_short_is_refused_by_name(saved, tmp_path, size):
    cut = tmp_path / "cut.nc"
    cut.write_bytes(saved[1].read_bytes()[:size])
    with pytest.raises(wb.FileError, match=r"cut\.nc"):
        wb.load_orbit(cut)


def test_what_is_no_orbit_is_refused(tmp_path):
    with pytest.raises(wb.FileError, match=r"absent\.nc"):
        wb.load_orbit(tmp_path / "absent.nc")
    xr.Dataset({"a": ("x", [1.0, 2.0])}).to_netcdf(tmp_path / "other.nc", engine="h5netcdf")
    with pytest.raises(wb.FileError, match="not from wingbeat"):
        wb.load_orbit(tmp_path / "other.nc")


def test_a_folder_that_is_not_there_is_refused_and_leaves_nothing(saved, tmp_path):
    with pytest.raises(wb.FileError):
        saved[0].save(tmp_path / "absent" / "orbit.nc")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["species", "vehicle", "aero", "bounds", "objective"])
def test_inputs_with_a_hole_set_up_nothing(bat_orbit, name):
    inputs = bat_orbit.orbit.inputs
    del inputs[name]
    with pytest.raises(KeyError):
        problem_from(inputs)
    with pytest.raises(ValueError, match="unknown objective"):
        problem_from(bat_orbit.orbit.inputs | {"objective": "beauty"})
