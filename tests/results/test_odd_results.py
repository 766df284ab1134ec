"""Odd results in every suffix: what is missing, empty, long or of another alphabet is saved and read back."""

import csv
import io
import json
import re

import numpy as np
import pandas as pd
import pytest
import scipy.io
import xarray as xr

import wingbeat as wb
from wingbeat.records.inputs import vehicle_record
from wingbeat.records.result_files import SUFFIXES, own_content, save_result
from wingbeat.records.tables import results_of

ROBOT = wb.robot(name="r", mass=0.02, wing_span=0.4, wing_area=0.03)
LONG = "The body pitches within each beat. " * 300
# Attributes as records have them: texts of their own, and JSON for everything else.
ODD = {
    "not converged": {"status": "not-converged", "message": "no start\nended"},
    "infeasible": {"failed_balance": ["lift", "thrust"], "relaxations": [{"name": "speed", "to": 3.0, "by": None}]},
    "hover": {"cost_of_transport": None, "speed": 0.0, "reynolds": None},
    "a film": {"body": "prescribed", "kinematics": {"film": "a, b.csv", "laws": {}, "notes": []}},
    "a robot": {"vehicle": vehicle_record(ROBOT.vehicle)},
    "no muscle": {"vehicle": {**vehicle_record(ROBOT.vehicle), "drive": None, "tail": {}}},
    "several wings": {"wings": [{"name": "fore", "at": [0.0, 0.1]}, {"name": "hind", "note": None}]},
    "a long text": {"message": LONG, "warnings": [LONG, ""]},
    "empty": {"warnings": [], "active_bounds": [], "constraints": {}, "inputs": "{}", "note": ""},
    "nothing": {"objective_value": None, "closure": None},
    "truth": {"plausible": True, "completed": False, "checks": [True, None, False]},
    "ragged": {"rows": [[1.0, 2.0], [3.0]], "mixed": [1.0, "two", None], "deep": [[["1"]], []]},
    "another alphabet": {"species": "Großmöwe 鷗 \U0001f426", "note": "–45° ≤ φ"},
    "a species that reads as a number": {"species": "12", "message": "null"},
    "names that MATLAB refuses": {
        "constraints": {"peak_power<=30": 29.0, "peak_power<=30\n": 1.0},
        "end_of": {"end": 1.0, "_private": 2.0, "1st": 3.0},
        "values": {"a" * 64: {"x" * 70: 1.0}},
    },
}
TEXTS = ["plain", "a, b", 'in "quotes"', "warning #3", "two\nlines", ""]


def odd_dataset(attributes):
    """A result with a series, a column of texts, a table by strip and single values beside them."""
    phase = np.linspace(0.0, 1.0, len(TEXTS))
    number = {"units": "rad", "long_name": "angle,\nof the wing"}
    held = {name: v if isinstance(v, str | float) else json.dumps(v) for name, v in attributes.items()}
    return xr.Dataset(
        {
            "flap": ("phase", np.array([0.1, -0.0, np.nan, np.inf, -np.inf, 1e-300]), number),
            "note": ("phase", np.array(TEXTS, dtype=object)),
            "alpha": (("phase", "station"), np.arange(2.0 * len(TEXTS)).reshape(-1, 2), {"units": "rad"}),
            "on": ("phase", np.array([True, False] * 3)),
            "only": ((), 3.0, {"units": "m"}),
        },
        {"phase": ("phase", phase, {"units": "1"}), "station": ("station", [0.25, 0.75])},
        {"Conventions": "CF-1.11", "wingbeat_kind": "flight", **held},
    )


@pytest.fixture(params=ODD)
def odd(request):
    return ODD[request.param], odd_dataset(ODD[request.param])


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_it_is_saved(odd, suffix, tmp_path):
    save_result(odd[1], tmp_path / f"odd{suffix}")
    assert [path.name for path in tmp_path.iterdir()] == [f"odd{suffix}"]


def test_netcdf_holds_it(odd, tmp_path):
    given, dataset = odd
    save_result(dataset, tmp_path / "odd.nc")
    read = own_content(xr.load_dataset(tmp_path / "odd.nc", engine="h5netcdf"))
    found = results_of(read)
    assert {name: found[name] for name in given} == given
    np.testing.assert_array_equal(read["flap"], dataset["flap"])
    assert [str(text) for text in read["note"].values] == TEXTS


def test_a_table_holds_it(odd, tmp_path):
    given, dataset = odd
    path = tmp_path / "odd.csv"
    save_result(dataset, path)
    text = path.read_text(encoding="utf-8")
    rows = [row for row in csv.reader(io.StringIO(text)) if not row[0].startswith("#")]
    assert {len(row) for row in rows} == {len(rows[0])}
    table = dict(zip(rows[0], zip(*rows[1:], strict=True), strict=True))
    np.testing.assert_array_equal(np.array(table["flap"], dtype=float), dataset["flap"].values)
    assert list(table["note"]) == [text.replace("\n", "; ") for text in TEXTS]
    head = [line for line in text.splitlines() if line.startswith("#")]
    assert len(head) + len(rows) == len(text.splitlines())
    for name, value in given.items():
        if isinstance(value, str):
            assert f"# {name} = {json.dumps(value)}" in head
    frame = pd.read_csv(path, comment="#", keep_default_na=False)
    assert frame["note"].tolist() == [text.replace("\n", "; ") for text in TEXTS]


def test_matlab_holds_it_under_names_that_it_accepts(odd, tmp_path):
    given, dataset = odd
    save_result(dataset, tmp_path / "odd.mat")
    read = scipy.io.loadmat(tmp_path / "odd.mat", simplify_cells=True)
    np.testing.assert_array_equal(read["flap"], dataset["flap"].values)
    own = {name: value for name, value in read.items() if not name.startswith("__")}
    assert all(re.fullmatch(r"[A-Za-z]\w{0,62}", name) and name != "end" for name in names(own))
    for name, value in given.items():
        assert name in read["results"]
        if isinstance(value, str) and value:
            assert read["results"][name] == value
        if value is None:
            assert np.isnan(read["results"][name])


def names(value):
    """Yield the names of all variables and fields."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield key
            yield from names(item)
    elif isinstance(value, list | np.ndarray) and np.asarray(value, dtype=object).dtype == object:
        for item in value:
            yield from names(item)


def test_numbers_of_refused_names_are_kept_beside_their_names(tmp_path):
    save_result(odd_dataset(ODD["names that MATLAB refuses"]), tmp_path / "odd.mat")
    read = scipy.io.loadmat(tmp_path / "odd.mat", simplify_cells=True)["results"]
    assert {row["name"]: row["value"] for row in read["end_of"]} == {"end": 1.0, "_private": 2.0, "1st": 3.0}
    assert read["values"]["value"] == {"name": "x" * 70, "value": 1.0}
