"""Results for other programs: tables with units in the head, and MATLAB files; every number and unit reads back."""

import csv
import io
import json
import re

import jax.numpy as jnp
import numpy as np
import pandas as pd
import pytest
import scipy.io

import wingbeat as wb
from wingbeat.cli import main
from wingbeat.experiment import BodyPath
from wingbeat.records.result_files import Saveable
from wingbeat.records.tables import leaves, results_of
from wingbeat.results.flight import carry

PIGEON = wb.load_species("pigeon")
HEAD = re.compile(r"# (\S.*?) = (.*?)(?: \[([^\[\]]*)\])?$")
COLUMN = re.compile(r"# (\w+)(?: \[(.*?)\])?( .*)?$")


def solve():
    problem = wb.OrbitProblem(PIGEON, speed=10.0, subject_to=["peak_power<=400"])
    return wb.solve_orbit(problem, starts=1)


def filmed():
    """A flight whose body moves as filmed."""
    path = BodyPath(6.0, (9.0, -0.4), np.zeros((3, 17)))
    return carry(wb.OrbitProblem(PIGEON, 9.0).model, PIGEON.wingbeat, path, 1, 16, species=PIGEON)


def limp():
    """A flight whose wings no torque drives."""
    model, start, rates = wb.FlightModel(PIGEON.vehicle, "su-fan"), [0.0, 0.0, 0.1, 0.4, 0.2], [10.0, 0, 0, 0, 0]
    return wb.simulate_torque_driven(
        model, PIGEON.wingbeat, start, rates, lambda *_: jnp.zeros(2), [0.0, 0.005, 0.01]
    )


RESULTS = {
    "orbit": solve,
    "flight": lambda: wb.simulate(wb.OrbitProblem(PIGEON, 10.0).model, PIGEON.wingbeat, wb.State(u=10.0), 2, 16),
    "filmed": filmed,
    "torque-driven": limp,
    "curve": lambda: wb.solve_curve(wb.OrbitProblem(PIGEON, 10.0), [0.0, 10.0, 11.0], starts=2),
    "glide": lambda: wb.glide_polar(PIGEON, angles_of_attack=np.radians([3.0, 5.0, 7.0, 9.0, 11.0])),
}
ALONG = {"orbit": "phase", "flight": "phase", "filmed": "phase", "torque-driven": "time"}
ALONG |= {"curve": "speed", "glide": "angle_of_attack"}


@pytest.fixture(scope="module", params=RESULTS)
def result(request):
    return request.param, RESULTS[request.param]()


def parsed(text):
    """Return results with their units, columns with their units, and the table, read as another program would."""
    single, units = {}, {}
    head, columns = text.split("# columns:")
    for line in head.splitlines()[3:-1]:
        name, value, unit = HEAD.match(line).groups()
        single[name] = (json.loads(value), unit or "")
    for line in columns.splitlines()[1:]:
        if not line.startswith("#"):
            break
        name, unit, _ = COLUMN.match(line).groups()
        units[name] = unit or ""
    rows = [row for row in csv.reader(io.StringIO(text)) if not row[0].startswith("#")]
    return single, units, dict(zip(rows[0], zip(*rows[1:], strict=True), strict=True))


def expected_columns(dataset, along):
    """Yield name, unit and values of each column, by the rule of the documentation."""
    for name, variable in dataset.variables.items():
        if along not in variable.dims:
            continue
        moved = variable.transpose(along, ...)
        for at in np.ndindex(*moved.shape[1:]):
            ends = []
            for dim, i in zip(moved.dims[1:], at, strict=True):
                label = dataset[dim].values[i]
                if isinstance(label, str):
                    ends.append(label.replace(" ", "_"))
                elif dim != "optimum" or i:
                    ends.append(f"{dim}_{i + 1}")
            yield "_".join([name, *ends]), variable.attrs.get("units", ""), moved.values[(slice(None), *at)]


@pytest.mark.slow
def test_a_table_holds_every_number_with_its_unit(result, tmp_path):
    kind, found = result
    path = tmp_path / "result.csv"
    found.save(path)
    single, units, table = parsed(path.read_text(encoding="utf-8"))
    columns = list(expected_columns(found.dataset, ALONG[kind]))
    assert {name for name, _, _ in columns} == set(table) == set(units)
    assert next(iter(table)) == ALONG[kind]
    for name, unit, values in columns:
        assert units[name] == unit
        if values.dtype == object:
            assert list(table[name]) == [value.replace("\n", "; ") for value in values]
        else:  # the same to the last bit
            np.testing.assert_array_equal(np.array(table[name], dtype=float), values.astype(float))
    for name, value in leaves(results_of(found.dataset)):
        assert single[name][0] == value, name
    frame = pd.read_csv(path, comment="#")
    assert list(frame.columns) == list(table)
    np.testing.assert_allclose(frame[ALONG[kind]], found.dataset[ALONG[kind]], rtol=1e-14)


def test_the_head_of_a_table_has_the_units_of_the_record(result, tmp_path):
    kind, found = result
    found.save(tmp_path / "result.csv")
    single = parsed((tmp_path / "result.csv").read_text(encoding="utf-8"))[0]
    units = {"vehicle.wing.mass": "kg", "air.viscosity": "m2 s-1", "air.gravity": "m s-2"}
    units = {} if kind == "torque-driven" else units
    if kind == "orbit":
        units |= {"objective_value": "Hz", "mean_power": "W", "closure.u": "m s-1", "body_pitch_range": "rad"}
        units |= {"constraints.peak_power<=400": "W", "wingbeat.flap_amplitude": "rad", "speed": "m s-1"}
        units |= {"initial_state.pitch_rate": "rad s-1", "solve_seconds": "s", "alpha_quarter_span.0": "rad"}
    if kind == "glide":
        units |= {"least_sink.sink": "m s-1", "best_ratio.tail_moment": "N m"}
    assert {name: single[name][1] for name in units} == {k: v for k, v in units.items() if v}


def test_matlab_reads_every_number_with_its_unit(result, tmp_path):
    _, found = result
    path = tmp_path / "result.mat"
    found.save(path)
    read = scipy.io.loadmat(path, simplify_cells=True)
    dataset = found.dataset
    for name, variable in dataset.variables.items():
        if variable.dtype.kind in "biuf":
            np.testing.assert_array_equal(read[name], np.squeeze(variable.values.astype(float)))
        elif variable.ndim == 1:
            assert [str(text) if len(text) else "" for text in read[name]] == variable.values.tolist()
        assert read["units"].get(name) == variable.attrs.get("units")
        assert read["meaning"].get(name) == variable.attrs.get("long_name")
    numbers = {k: v for k, v in leaves(results_of(dataset)) if isinstance(v, float) and not k.startswith("constr")}
    units = {}
    for name, value in numbers.items():
        held, unit = read["results"], read["results_units"]
        for part in name.split("."):
            held = held[int(part)] if part.isdigit() else held[part]
            unit = unit if part.isdigit() else unit[part]
        assert held == value, name
        units[name] = unit
    if "vehicle" in results_of(dataset):
        assert units["vehicle.wing.semi_span"] == "m"
        assert units["air.density"] == "kg m-3"
        assert len(units) > 8


def test_names_fit_into_matlab(result, tmp_path):
    """63 characters, letters, digits and underscores; a limit such as peak_power<=400 is no name there."""
    kind, found = result
    found.save(tmp_path / "result.mat")
    read = scipy.io.loadmat(tmp_path / "result.mat", simplify_cells=True)

    def names(struct):
        for key, value in struct.items():
            yield key
            yield from names(value) if isinstance(value, dict) else ()

    own = [name for name in names(read) if not name.startswith("__")]
    assert all(re.fullmatch(r"[A-Za-z]\w{0,62}", name) for name in own)
    if kind == "orbit":
        limit = read["results"]["constraints"]
        assert limit["name"] == "peak_power<=400"
        assert limit["value"] == pytest.approx(found.record()["peak_power"], rel=1e-6)
        assert read["results_units"]["constraints"] == {"name": "peak_power<=400", "value": "W"}


def test_every_kind_of_result_is_among_these():
    assert {type(make()) for make in (filmed, limp)} | {wb.Orbit, wb.Flight, wb.Curve, wb.GlidePolar} == set(
        Saveable.__subclasses__()
    )


@pytest.mark.parametrize("name", ["result.txt", "result", "result.csv.gz", "result.nc4", ".nc"])
def test_another_suffix_is_refused_in_python(result, tmp_path, name):
    words = r"does not end in a suffix for results.* end the name in \.nc .*\.csv or \.mat"
    with pytest.raises(wb.InvalidInputError, match=words):
        result[1].save(tmp_path / name)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "words", ["orbit pigeon --speed 12", "curve pigeon --speeds 3:20:1", "simulate pigeon", "glide pigeon"]
)
def test_another_suffix_is_refused_before_anything_is_computed(words, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("wingbeat.aero.FormulaCoefficients.kernel", lambda _: pytest.fail("it computes"))
    monkeypatch.chdir(tmp_path)
    assert main([*words.split(), "-o", "out.xlsx"]) == 2
    assert "--output = 'out.xlsx': does not end in a suffix for results" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("suffix", [".csv", ".mat"])
def test_the_commands_write_tables_and_say_that_they_read_netcdf(suffix, tmp_path, capsys):
    path, page, figure = tmp_path / f"glide{suffix}", str(tmp_path / "page.html"), str(tmp_path / "page.png")
    assert main(["glide", "pigeon", "--alpha", "4:6:1", "-o", str(path)]) == 0
    assert path.stat().st_size > 1000
    capsys.readouterr()
    for words in (
        ["show", str(path)],
        ["plot", str(path), "-o", figure],
        ["view", str(path), "-o", page],
    ):
        assert main(words) == 2
        message = capsys.readouterr().err
        assert f"cannot read '{path}': wingbeat reads results from .nc files; {suffix} is for other" in message
        assert "Traceback" not in message


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    ["orbit pigeon --speed 10 --starts 1", "curve pigeon --speeds 10:11:1 --starts 1", "simulate pigeon --beats 1"],
)
def test_every_command_writes_what_its_suffix_says(words, tmp_path, capsys):
    for suffix, begins in ((".csv", b"# "), (".mat", b"MATLAB 5.0"), (".nc", b"\x89HDF")):
        path = tmp_path / f"out{suffix}"
        assert main([*words.split(), "-o", str(path)]) == 0
        assert path.read_bytes().startswith(begins)
    capsys.readouterr()
