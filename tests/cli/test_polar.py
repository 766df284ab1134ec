"""The polar command: ranges, the three printed forms, the figure, its faults."""

import csv
import io
import json
import re

import numpy as np
import pytest
from matplotlib.image import imread

from wingbeat._base import FileError, InvalidInputError
from wingbeat.aero import LIBRARY, SuFan
from wingbeat.cli import main
from wingbeat.cli.arguments import parse_range
from wingbeat.cli.polar import polar

COLUMNS = ["alpha_deg", "c_l", "c_d", "c_n", "c_m", "x_cp"]


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("0:110:2", np.arange(0, 111, 2.0)),
        ("5", [5.0]),
        ("-3.25", [-3.25]),
        ("0:0.3:0.1", [0.0, 0.1, 0.2, 0.3]),
        ("10:0:-5", [10.0, 5.0, 0.0]),
        ("7:7:1", [7.0]),
        (" 0 : 1e1 : 5", [0.0, 5.0, 10.0]),
    ],
)
def test_ranges(text, wanted):
    np.testing.assert_array_equal(parse_range(text, "--alpha"), wanted)


def test_the_help_names_every_published_model():
    assert all(name in str(polar.__doc__) for name in LIBRARY)


def test_a_whole_turn_in_fine_steps_is_exact():
    values = parse_range("-180:180:0.02", "--alpha")
    assert len(values) == 18001
    assert (values[0], values[9000], values[-1]) == (-180.0, 0.0, 180.0)
    np.testing.assert_array_equal(values, [float(f"{i * 2 - 18000}e-2") for i in range(18001)])
    np.testing.assert_array_equal(values, -values[::-1])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "--alpha = '': is not a number; write start:stop:step"),
        ("0:10", "has 2 numbers instead of 1 or 3"),
        ("0:1:2:3", "has 4 numbers"),
        ("0:ten:1", "'ten': is not a number"),
        ("a:b:c", "'a': is not a number"),
        ("0:nan:1", "'nan': must be finite"),
        ("inf", "'inf': must be finite"),
        ("0:10:0", "the step must not be 0"),
        ("0:10:-1", "the step leads away from the stop"),
        ("10:0:1", "the step leads away from the stop"),
        ("0:10:3", "the stop is not a whole number of steps from the start; stop at 9 or 12"),
        ("0:180:0.000001", "gives more than 10000000 values"),
        ("1e999999999", "has more than 12 digits"),
        ("0:1:1e-99", "has more than 12 digits"),
    ],
)
def test_bad_ranges(text, message):
    with pytest.raises(InvalidInputError, match=re.escape(message)):
        parse_range(text, "--alpha")


def test_csv_holds_the_model(capsys):
    polar("su-fan", alpha="0:40:10", csv=True)
    rows = list(csv.reader(io.StringIO(capsys.readouterr().out)))
    assert rows[0] == COLUMNS
    values = np.array(rows[1:], dtype=float)
    np.testing.assert_array_equal(values[:, 0], [0, 10, 20, 30, 40])
    alpha, model = np.deg2rad(values[:, 0]), SuFan()
    np.testing.assert_array_equal(values[:, 1], model.lift(alpha))
    np.testing.assert_array_equal(values[:, 2], model.drag(alpha))
    np.testing.assert_array_equal(values[:, 3], model.normal(alpha))
    np.testing.assert_array_equal(values[:, 4], model.moment(alpha))
    np.testing.assert_array_equal(values[:, 5], model.centre_of_pressure(alpha))


def test_json_is_one_object_of_equal_lists(capsys):
    polar("su-fan", alpha="5", about=0.25, json=True)
    found = json.loads(capsys.readouterr().out)
    assert list(found) == COLUMNS
    assert all(len(column) == 1 for column in found.values())
    assert found["c_m"] == [SuFan().moment(np.deg2rad(5.0), about=0.25)]


def test_json_has_nulls_without_a_centre_of_pressure(capsys):
    polar("dickinson", alpha="0:10:5", json=True)
    found = json.loads(capsys.readouterr().out)
    assert found["c_m"] == found["x_cp"] == [None, None, None]
    polar("dickinson", alpha="0", csv=True)
    assert capsys.readouterr().out.splitlines()[1].endswith(",,")


def test_options_reach_the_model(capsys):
    polar("su-fan", alpha="-20", extension="clipped-drag", blend_width_deg=0.5, json=True)
    found = json.loads(capsys.readouterr().out)
    assert found["c_d"] == [SuFan("clipped-drag", 0.5).drag(np.deg2rad(-20.0))]


def test_table_is_readable(capsys):
    polar("wang", alpha="0:90:45")
    text = capsys.readouterr().out
    assert "cited second-hand" in text
    assert "alpha [deg]" in text
    assert "x_cp [chords]" in text
    assert re.search(r"45 │ +1\.2000 │ +1\.4000 │ +1\.8385 │ +- │ +- ", text)


def test_a_table_file_can_be_shown(tmp_path, capsys):
    path = tmp_path / "plate.csv"
    path.write_text("alpha_deg,c_l,c_d\n0,0,0.1\n30,1,0.5\n60,0.9,1.5\n90,0,2\n", encoding="utf-8")
    polar(str(path), alpha="30", json=True)
    assert json.loads(capsys.readouterr().out)["c_l"] == [1.0]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".png", ".pdf", ".svg", ".PNG"])
@pytest.mark.parametrize("model", ["su-fan", "dickinson"])
def test_figure(tmp_path, capsys, suffix, model):
    path = tmp_path / f"polar{suffix}"
    polar(model, output=path)
    start = path.read_bytes()[:8]
    assert start == b"\x89PNG\r\n\x1a\n" if suffix.lower() == ".png" else start[:5] in (b"%PDF-", b"<?xml")
    assert [file.name for file in tmp_path.iterdir()] == [path.name]
    printed = capsys.readouterr()
    assert printed.out == ""
    assert str(path) in printed.err


def test_figure_is_not_blank_and_leaves_the_numbers_on_stdout(tmp_path, capsys):
    path = tmp_path / "polar.png"
    polar("su-fan", alpha="10", csv=True, output=path)
    assert len(capsys.readouterr().out.splitlines()) == 2
    assert imread(path).std() > 0.1


def test_figure_in_a_missing_folder(tmp_path):
    with pytest.raises(FileError, match="cannot write"):
        polar("su-fan", output=tmp_path / "missing" / "polar.png")


def test_every_fault_of_the_command_is_told_at_once(tmp_path):
    with pytest.raises(InvalidInputError) as caught:
        polar("sufan", alpha="0:3:2", about=float("nan"), csv=True, json=True, output=tmp_path / "polar.txt")
    places = [fault.where for fault in caught.value.faults]
    assert places == ["--csv", "--output", "--about", "--alpha", "coefficients"]


def test_from_the_command_line(tmp_path, capsys):
    assert main(["polar", "su-fan", "--alpha=-180:180:90", "--csv"]) == 0
    assert [row.split(",")[0] for row in capsys.readouterr().out.splitlines()[1:]] == [
        "-180.0",
        "-90.0",
        "0.0",
        "90.0",
        "180.0",
    ]
    assert main(["polar", "su-fan", "--blend-width-deg", "2", "-o", str(tmp_path / "a.svg")]) == 0
    assert (tmp_path / "a.svg").exists()
    assert main(["polar", "sufan"]) == 2
    assert "did you mean su-fan" in capsys.readouterr().err
