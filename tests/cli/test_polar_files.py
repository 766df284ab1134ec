"""Tables of coefficients as people have them: one dialect in all commands, and what is wrong, in words."""

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from tests.helpers.places import ROOT
from wingbeat.aero import load_coefficients
from wingbeat.cli import main
from wingbeat.experiment.coefficient_table import load_measurements
from wingbeat_evidence.measured_motion.ladder import ladder

CASES = ROOT / "tests/cases/polars"
WHOLE = [(a, 1.1 * np.sin(2 * np.deg2rad(a)), 1.06 - np.cos(2 * np.deg2rad(a))) for a in range(0, 91, 5)]
HEADS = ["alpha_deg,c_l,c_d", "alpha_deg,C_L,C_D", "Alpha,Cl,Cd", "alpha [deg],CL [-],CD [-]", "AoA (°),cl,cd"]


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    return tmp_path


def written(name: str, head: str, rows=WHOLE, more: str = "") -> str:
    Path(name).write_text("\n".join([head, *(",".join(f"{c:.6g}" for c in row) + more for row in rows)]) + "\n")
    return name


REFUSED = {
    "drag_counts.csv": "C_D = 1848.0: must lie between 0 and 5: no wing has more (29 of 29 rows); the column",
    "reynolds_in_millions.csv": "reynolds = 0.06: must be >= 1 (29 of 29 rows); it looks like millions",
}


@pytest.mark.parametrize("name", REFUSED)
@pytest.mark.parametrize("command", ["fit {} --form cambered -o out.toml", "polar {}"])
def test_a_file_that_is_no_table_of_a_wing_is_refused_in_one_sentence(command, name, capsys):
    assert main(shlex.split(command.format(CASES / name))) == 2
    (line,) = capsys.readouterr().err.splitlines()
    words = REFUSED[name]
    assert (words if "polar" not in command or name.endswith(".csv") else words[5:]) in line
    assert not Path("out.toml").exists()


READ = {
    "xfoil.txt": "XFOIL: TESTPLATE 4 PERCENT, Re 50000, Ncrit 9",
    "airfoil_site.csv": "airfoil site: testplate-il, Re 50000, Ncrit 9",
    "semicolon_decimal_comma.csv": "read with semicolons between the columns and decimal commas",
    "tabs.csv": "read with tabs between the columns",
}


@pytest.mark.parametrize("name", READ)
def test_the_commonest_polars_are_fitted_and_how_they_were_read_is_said(name, capsys):
    assert main(["fit", str(CASES / name), "--form", "cambered", "-o", "out.toml"]) == 0
    assert f"note: {READ[name]}" in capsys.readouterr().err
    assert load_coefficients("out.toml").lift(np.radians(4.0)) == pytest.approx(0.68, abs=0.08)
    assert main(["polar", str(CASES / name)]) == 2
    assert "a fit completes it: wingbeat fit" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["aerodyn.dat", "full_circle_0_355.csv"])
def test_tables_of_the_whole_circle_are_used_as_they_are(name, capsys):
    assert main(["polar", str(CASES / name), "--alpha", "40", "--csv"]) == 0
    assert capsys.readouterr().out.splitlines()[1].startswith("40.0,1.1126,0.81")


UNITS = {
    "per cent": ("C_D", 100, "C_D = 3.5: is at least 3 at angles up to 5 degrees"),
    "lift in per cent": ("C_L", 100, "C_L = 95.0: must lie between -5 and 5"),
    "radians": (
        "alpha_deg",
        np.pi / 180,
        "alpha_deg = 0.314: is the largest of 29 angles, which looks like a sweep in rad",
    ),
    "sign of lift": ("C_L", -1, "falls by 1.5 from -8 to 8 degrees; lift must rise; reverse the sign of C_L"),
}


@pytest.mark.parametrize("case", UNITS)
def test_a_column_in_other_units_is_named(case, capsys):
    column, factor, words = UNITS[case]
    table = load_measurements(CASES / "hysteresis.csv")
    columns = table.columns()
    columns[column] = columns[column] * factor
    rows = list(zip(*columns.values(), strict=True))[:29]
    assert main(["fit", written("wing.csv", ",".join(columns), rows), "--form", "cambered"]) == 2
    assert words in capsys.readouterr().err


@pytest.mark.parametrize("head", HEADS)
def test_every_command_reads_every_spelling(head, capsys):
    name = written("wing.csv", head)
    assert main(["polar", name, "--alpha", "45", "--csv"]) == 0
    told = capsys.readouterr()
    assert told.out.splitlines()[1].startswith("45.0,1.1")
    assert told.err == ""
    assert main(["fit", name, "--form", "sine-cosine", "-o", "wing.toml"]) == 0
    assert load_coefficients("wing.toml").lift_terms.amplitude == pytest.approx(1.1, rel=1e-4)


def test_columns_that_are_not_used_are_named_and_a_misspelt_error_first(capsys):
    name = written("wing.csv", "alpha,CL,CD,C_L_err,tunnel", more=",0.01,small")
    assert load_coefficients(name).notes == load_measurements(name).notes
    for words in (["polar", name, "--alpha", "45"], ["fit", name, "--form", "sine-cosine"]):
        assert main(words) == 0
        err = capsys.readouterr().err
        assert "columns that are not used: C_L_err, tunnel" in err
        assert "C_L_err: if these are errors, they are not used; errors are read from columns named C_L_se" in err


def test_reynolds_numbers_in_thousands_are_doubted():
    rows = [(*row, 45.0) for row in WHOLE]
    assert (
        "friction of a flat plate at Re 45 is 0.4"
        in load_coefficients(written("w.csv", "a,b".replace("a,b", "alpha,cl,cd,Re"), rows)).notes[0]
    )
    fine = load_coefficients(written("w.csv", "alpha,cl,cd,Re", [(*row, 45e3) for row in WHOLE]))
    assert (fine.notes, fine.reynolds_range) == ((), (45e3, 45e3))


def test_optional_cells_may_be_empty():
    text = "alpha_deg,C_L,C_D,x_cp,C_L_se,reynolds\n0,0,0.06,,0.01,5e4\n30,0.95,0.56,0.3,NaN,5e4\n"
    Path("w.csv").write_text(text + "60,0.95,1.56,0.4,0.01,\n90,0,2.06,0.5,0.01,5e4\n")
    table = load_coefficients("w.csv")
    assert table.x_cp == (0.3, 0.3, 0.4, 0.5)
    assert "x_cp is empty at 0 degrees and is filled" in table.notes[0]
    measured = load_measurements("w.csv")
    assert measured.se["C_L"].tolist() == [0.01] * 4
    assert "C_L_se is empty in 1 of 4 rows" in measured.notes[0]


@pytest.mark.parametrize("head", ["alpha_deg,c_l,c_d", "alpha_deg,C_L,C_D"])
@pytest.mark.parametrize("part", ["both sides", "one side"])
@pytest.mark.parametrize("command", ["polar {}", "orbit pigeon --speed 12 --aero {}"])
def test_a_table_to_16_degrees_is_completed_by_the_command_that_the_message_names(head, part, command, capsys):
    table = load_measurements(CASES / "to_16_deg_c_l.csv")
    rows = np.column_stack([table.alpha_deg, table.mean["C_L"], table.mean["C_D"]])
    if part == "one side":  # of a symmetric wing
        rows = rows[rows[:, 0] >= -3.5] + (3.5, 0, 0)
        rows[0, 1] = 0.0
    written("to 16.csv", head, rows)
    assert main(shlex.split(command.format("'to 16.csv'"))) == 2
    (line,) = capsys.readouterr().err.splitlines()
    words = re.search(r"a fit completes it: wingbeat (fit .*) \(then give", line)
    assert words is not None, line
    assert main(shlex.split(words[1])) == 0
    assert ("mirror image" in capsys.readouterr().err) is (part == "one side")
    wing = load_coefficients("to 16.toml")
    assert float(wing.lift(np.deg2rad(10.0))) == pytest.approx(np.interp(10.0, rows[:, 0], rows[:, 1]), abs=0.06)
    assert float(wing.drag(np.pi / 2)) == pytest.approx(2.0, abs=0.1)


def test_several_reynolds_numbers_are_told_and_one_can_be_chosen(capsys):
    path = str(CASES / "three_reynolds.csv")
    assert main(["polar", path]) == 2
    told = capsys.readouterr().err
    assert "(3 polars do not); complete each polar by Viterna's rule: --extension viterna" in told
    assert "--form cambered --reynolds-range 20000 20000 -o three_reynolds.toml" in told
    assert main(["fit", path, "--form", "cambered", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert any(
        re.search(r"C_L: the residuals depend on Re: at Re 20000 it lies 0\.\d+ below", w)
        for w in record["warnings"]
    )
    assert any("C_D: the residuals depend on Re" in w for w in record["warnings"])
    assert main(["fit", path, "--form", "cambered", "--json", "--reynolds-range", "50e3", "70e3"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["warnings"] == []
    assert record["reynolds_range"] == [6e4, 6e4]
    assert record["C_L"]["parameters"]["lift_highest"]["value"] == pytest.approx(0.95, abs=0.03)
    for words, part in (
        ("5e6 6e6", "holds no row: the table has Re 20000"),
        ("9 3", "highest first"),
        ("0 3", ">= 1"),
    ):
        assert main(["fit", path, "--reynolds-range", *words.split()]) == 2
        assert part in capsys.readouterr().err
    assert main(["fit", str(CASES / "hysteresis.csv"), "--reynolds-range", "1", "3"]) == 2
    assert "the table has no column reynolds" in capsys.readouterr().err


def test_two_branches_are_told_with_their_angles_and_go_into_the_model_file(capsys):
    path = str(CASES / "hysteresis.csv")
    assert main(["polar", path]) == 2
    assert "keep one branch if these are two (sweeps up and down)" in capsys.readouterr().err
    assert main(["fit", path, "--form", "cambered", "-o", "wing.toml"]) == 0
    words = "warning: C_L: the rows form two branches from 8 to 14 deg: 0.95 and 0.6 at 9 deg"
    assert words in capsys.readouterr().err
    assert main(["polar", "wing.toml", "--alpha", "5"]) == 0
    assert "note: wing.toml: C_L: the rows form two branches from 8 to 14 deg" in capsys.readouterr().err


def test_polar_reads_what_polar_prints(capsys):
    assert main(["polar", "su-fan", "--alpha", "0:110:5", "--csv"]) == 0
    Path("again.csv").write_text(capsys.readouterr().out)
    assert main(["polar", "again.csv", "--alpha", "5:85:5", "--csv"]) == 0
    told = capsys.readouterr()
    assert "columns that are not used: c_n" in told.err
    found, wanted = load_coefficients("again.csv"), load_coefficients("su-fan")
    alpha = np.deg2rad(np.arange(5.0, 86.0, 5.0))
    for name in ("lift", "drag", "moment"):
        np.testing.assert_allclose(getattr(found, name)(alpha), getattr(wanted, name)(alpha), rtol=0, atol=1e-9)


def test_a_fit_that_failed_writes_nothing_and_ends_with_3(capsys):
    random = np.random.default_rng(3)
    rows = np.column_stack([np.arange(-20.0, 21.0, 2.0), random.normal(size=21), random.uniform(0.1, 0.9, size=21)])
    rows[:, 1] += 0.02 * rows[:, 0]
    name = written("noise.csv", "alpha,cl,cd", rows)
    assert main(["fit", name, "--form", "cambered", "-o", "wing.toml"]) == 3
    err = capsys.readouterr().err
    assert "error: the fit failed: C_L: the curve does not fit: R-squared is 0." in err
    assert "wing.toml was not written" in err
    assert not Path("wing.toml").exists()


_TURN = np.deg2rad([a for a, _, _ in WHOLE])
_ACROSS = "is larger than the drag at all angles from 80 to 100 degrees"
DIRECTIONS = {
    "lift of the other sign": ([(a, -lift, drag) for a, lift, drag in WHOLE], "it must be positive there"),
    "lift without its sign": (
        [(-a, lift, drag) for a, lift, drag in WHOLE[:0:-1]] + WHOLE,
        "lift at negative angles from 20 to 70 degrees, and it must be negative",
    ),
    "columns exchanged": ([(a, drag, lift + 0.02) for a, lift, drag in WHOLE], _ACROSS),
    "normal and tangential force": (
        [(a, 2 * np.sin(t), 0.05) for (a, _, _), t in zip(WHOLE, _TURN, strict=True)],
        _ACROSS,
    ),
}


@pytest.mark.parametrize("kind", DIRECTIONS)
@pytest.mark.parametrize("command", ["fit a.csv", "polar a.csv --extension signed"])
def test_coarse_tables_of_other_directions_are_refused(kind, command, capsys):
    """With a row at every fifth degree, too few lie at small angles for the slope of the lift."""
    rows, words = DIRECTIONS[kind]
    written("a.csv", HEADS[0], rows)
    assert main(shlex.split(command)) == 2
    assert words in capsys.readouterr().err


def test_validate_takes_the_extension_that_its_own_message_advises(capsys):
    polar = str(ROOT / "tests/aero/polars/xfoil_naca4412_re50000.pol")
    assert main(["validate", "--aero", polar]) == 2
    assert "--extension viterna" in capsys.readouterr().err
    assert [one.aero.coefficients.name for one in ladder([polar], "none", "none", 1.2, "viterna")] == [
        Path(polar).stem
    ]
    assert main(["validate", "--extension", "viterna"]) == 2
    assert "give --aero with a polar" in capsys.readouterr().err
