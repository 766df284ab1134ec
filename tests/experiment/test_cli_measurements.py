"""``wingbeat reduce`` and ``fit``: what they write, and every fault of a file in its words."""

import importlib
import json
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from tests.helpers.places import ROOT
from wingbeat.aero import CamberedTerms, Feathered, load_coefficients
from wingbeat.cli import main
from wingbeat.experiment import Campaign, CoefficientTable, fit_wing, reduce_runs, save_runs, synthetic_runs

SWEEP = Campaign(reynolds=(3e4,), alpha_deg=tuple(float(a) for a in range(0, 111, 5)), repeats=1, rate=10.0)
HEAD = "# speed = 0.5\n# density = 1000\n# viscosity = 1e-6\n# chord [m] = 0.08\n# span = 0.4\n"
COLUMNS = "time [s],normal_force [N],tangential_force [N],moment [N m],alpha_deg"
ROWS = "\n".join(f"{0.1 * i:g},{1 + 0.01 * (i % 7):g},0.2,0.01,30" for i in range(300))
GOOD = f"{HEAD}{COLUMNS}\n{ROWS}\n"
TABLE = "alpha_deg,C_L,C_D\n" + "".join(f"{a},{0.01 * a},{0.1 + 0.02 * a}\n" for a in range(0, 100, 10))


@pytest.fixture(scope="module")
def campaign(tmp_path_factory):
    """A folder with the runs of a small synthetic campaign, reduced."""
    folder = tmp_path_factory.mktemp("campaign")
    runs = synthetic_runs(SWEEP, seed=2)
    save_runs(runs, folder)
    reduce_runs(runs).save(folder / "coefficients.csv")
    return folder


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "160")
    return tmp_path


def test_from_runs_to_a_model_that_flies(campaign, here, capsys):
    runs = sorted(str(path) for path in campaign.glob("re*.csv"))
    assert main(["reduce", *runs, "-o", "coefficients.csv", "--last", "20"]) == 0
    assert f"wrote coefficients.csv: {len(runs)} runs, {len(runs)} points" in capsys.readouterr().err
    words = ["fit", "coefficients.csv", "--form", "su-fan", "-o", "mymodel.toml", "--plot", "fit.png"]
    assert main(words) == 0
    told = capsys.readouterr()
    for part in ("parameter", "95 % interval", "R-squared", "AICc", "decay_amplitude", "exponent", "x_cp"):
        assert part in told.out
    assert imread("fit.png").shape[0] > 1000
    model = load_coefficients("mymodel.toml")
    assert float(model.lift(np.deg2rad(40.0))) == pytest.approx(1.19, abs=0.05)
    assert main(["polar", "mymodel.toml", "--alpha", "40", "--csv"]) == 0
    assert capsys.readouterr().out.splitlines()[1].startswith("40.0,1.")


def test_json_holds_every_parameter_with_its_interval(campaign, here, capsys):
    assert main(["fit", str(campaign / "coefficients.csv"), "--json", "--alpha-max", "90"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["alpha_range_deg"] == [0.0, 90.0]
    amplitude = record["C_L"]["parameters"]["amplitude"]
    assert amplitude["interval"][0] < amplitude["value"] < amplitude["interval"][1]
    assert record["C_L"]["points"] == 19


def test_a_cambered_wing_from_its_polar_to_a_model_that_flies(here, capsys):
    terms = CamberedTerms(-4.0, 4.2, -0.45, 1.35, 0.15, 0.03, 0.055, 2.0, 0.6, 17.0, 1.6, 2.0)
    noise = np.random.default_rng(0).normal(size=(28, 2)) * (0.02, 0.003)
    rows = [
        f"{a},{terms.lift_at(a) + lift:.4f},{terms.drag_at(a) + drag:.4f},50000"
        for a, (lift, drag) in zip(range(-24, 31, 2), noise, strict=True)
    ]
    Path("wing.csv").write_text("\n".join(["alpha_deg,C_L,C_D,reynolds", *rows]) + "\n")
    words = ["fit", "wing.csv", "--form", "cambered", "--aspect-ratio", "6", "-o", "wing.toml", "--plot", "fit.png"]
    assert main(words) == 0
    told = capsys.readouterr()
    for part in (*vars(terms), "95 % interval"):
        assert (part in told.out) == ("rounding" not in part), part
    assert "wrote wing.toml" in told.err
    assert imread("fit.png").shape[1] > 1000
    assert main([*words[:6], "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert (record["aspect_ratio"], record["reynolds_range"]) == (6.0, [50000.0, 50000.0])
    zero = record["C_L"]["parameters"]["zero_lift_deg"]["interval"]
    assert zero[0] < -4.0 < zero[1]
    model = load_coefficients("wing.toml")
    assert (model.aspect_ratio, model.reynolds_range) == (6.0, (5e4, 5e4))
    assert main(["polar", "wing.toml", "--alpha=-10:10:20", "--csv"]) == 0
    lift = [float(line.split(",")[1]) for line in capsys.readouterr().out.splitlines()[1:]]
    assert lift == pytest.approx([-0.36, 0.99], abs=0.03)


def refused(capsys, *words: str) -> list[str]:
    """Run a command line that must be refused, and return its lines."""
    before = {path: path.read_bytes() for path in Path().iterdir()}
    assert main(words) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert "Traceback" not in told.err
    assert {path: path.read_bytes() for path in Path().iterdir()} == before
    return told.err.splitlines()


BAD_RUNS = {
    "empty": ("", ["run.csv row 1 = '': the file holds no table"]),
    "column": (GOOD.replace("moment [N m],", "torque,"), ["row 6, column moment", "is missing; add moment [N m]"]),
    "unit": (
        GOOD.replace("normal_force [N]", "normal_force [lbf]"),
        ["row 6, column 2, normal_force = 'lbf'", "[N]"],
    ),
    "milli": (GOOD.replace("[N m]", "[mN m]"), ["column 4, moment = 'mN m'", "convert the numbers to N m"]),
    "constant unit": (GOOD.replace("chord [m]", "chord [mm]"), ["row 4, chord = 'mm'", "convert the numbers to m"]),
    "radians": (GOOD.replace("alpha_deg", "alpha_deg [rad]"), ["alpha_deg = 'rad'", "convert the numbers to deg"]),
    "alpha": (GOOD.replace("alpha_deg", "alpha"), ["column 5 = 'alpha'", "radians times 57.29578 are degrees"]),
    "constant": (GOOD.replace("# density = 1000\n", ""), ["run.csv, density = '': is missing; add the line"]),
    "speed": (GOOD.replace("speed = 0.5", "speed = 0"), ["run.csv row 1, speed = 0.0: must be > 0 m/s"]),
    "backwards": (GOOD.replace("speed = 0.5", "speed = -1"), ["run.csv row 1, speed = -1.0: must be > 0 m/s"]),
    "words": (GOOD.replace("speed = 0.5", "speed = 0.5 m/s"), ["row 1, speed = '0.5 m/s': must be one number"]),
    "tare": ("# tare_moment = 0.1\n" + GOOD, ["row 1, tare_moment = '0.1': must be two numbers, before and after"]),
    "cell": (
        GOOD.replace("1.03,0.2", "1.03,x"),
        ["run.csv row 10, column tangential_force = 'x': is not a number"],
    ),
    "nan": (GOOD.replace("1.03,0.2", "nan,0.2", 1), ["run.csv row 10, column normal_force = 'nan': has no value"]),
    "blank": (GOOD.replace("1.03,0.2", ",0.2", 1), ["run.csv row 10, column normal_force = '': is empty"]),
    "unsorted": (
        GOOD.replace("\n0.2,", "\n0.05,", 1),
        ["run.csv row 9, column time = 0.05: must be above the time before it, 0.1 s"],
    ),
    "tare value": (
        "# tare_moment = 0.1, nan\n" + GOOD,
        ["run.csv row 1, tare_moment = '0.1, nan': must be finite; give the reading in N m"],
    ),
    "ragged": (
        GOOD.replace("1.03,0.2", "1,03,0.2", 1),
        ["run.csv row 10", "has 6 cells, but the header names 5 columns"],
    ),
    "short": (f"{HEAD}{COLUMNS}\n0,1,0,0,5\n", ["run.csv row 6, column time", "at least 32 samples"]),
    "binary": ("\0\1\2", ["run.csv", "control character"]),
}


@pytest.mark.parametrize("case", BAD_RUNS)
def test_bad_runs_are_refused_by_row_and_column(case, here, capsys):
    text, parts = BAD_RUNS[case]
    Path("run.csv").write_text(text)
    lines = refused(capsys, "reduce", "run.csv", "-o", "c.csv")
    assert all(line.startswith("error: ") for line in lines)
    for part in parts:
        assert any(part in line for line in lines), lines


BAD_TABLES = {
    "empty": ("", ["the file holds no table"]),
    "header": ("alpha_deg,C_L,C_D\n", ["has no row of numbers"]),
    "columns": (TABLE.replace("C_D", "drag"), ["column C_D = 'alpha_deg,C_L,drag': the column is missing"]),
    "radians": (TABLE.replace("alpha_deg", "alpha_rad"), ["column 1 = 'alpha_rad': is in radians; multiply by"]),
    "magnitude": (
        "alpha_deg,C_L,C_D\n" + "".join(f"{a / 10},{a / 10},{a / 10}\n" for a in range(20)),
        ["column alpha_deg = 1.9: is the largest of 20 angles, which looks like a sweep in radians"],
    ),
    "unit": (
        TABLE.replace("alpha_deg", "alpha_deg [rad]"),
        ["'rad': is not the expected unit, [deg]"],
    ),
    "cells": (TABLE.replace("30,0.3", "30,nan").replace("0.4,", "x,"), ["row 5, column C_L", "row 6, column C_L"]),
    "ragged": (TABLE + "100,1\n", ["row 12", "has 2 cells, but the header names 3 columns"]),
    "few": ("alpha_deg,C_L,C_D\n0,0,0.1\n10,1,1\n20,2,2\n", ["'3 points': are too few for the 5 parameters"]),
    "turn": (TABLE.replace("90,0.9", "290,0.9"), ["row 11, column alpha_deg = 290.0: must lie between"]),
    "still": (
        TABLE.replace("C_D\n", "C_D,reynolds\n").replace("\n0,0.0,0.1\n", "\n0,0,0.1,0\n"),
        [
            "row 2, column reynolds = 0.0: must be >= 1; was the stream at rest?",
            "has 3 cells, but the header names 4 columns",
        ],
    ),
    "error": (
        "alpha_deg,C_L,C_D,C_L_se\n" + "".join(f"{a},{a / 90},{0.1 + a / 90},-1\n" for a in range(0, 90, 10)),
        ["row 2, column C_L_se = -1.0: must be >= 0 (9 of 9 rows); an error has no sign"],
    ),
}


@pytest.mark.parametrize("case", BAD_TABLES)
def test_bad_tables_are_refused_by_row_and_column(case, here, capsys):
    text, parts = BAD_TABLES[case]
    Path("c.csv").write_text(text)
    lines = refused(capsys, "fit", "c.csv", "-o", "m.toml")
    for part in parts:
        assert any(part in line for line in lines), lines


@pytest.mark.parametrize(
    ("words", "part"),
    [
        ("reduce run.csv -o c.txt", "--output = 'c.txt': is not a table; end it in .csv"),
        (
            "reduce run.csv -o run.csv",
            "--output = 'run.csv': is a file that the command reads; choose another name",
        ),
        ("reduce absent.csv --tare run.csv -o ./run.csv", "is a file that the command reads"),
        ("fit c.csv d.csv", "fit has no place for 'd.csv'; leave out what is too much, or write the option"),
        ("reduce run.csv -o c.csv --last -1", "--last = -1.0: must be > 0 s"),
        ("reduce run.csv -o c.csv --last 60", "last = 60.0: is longer than the record of run.csv, 30 s"),
        ("reduce absent.csv -o c.csv", "cannot read 'absent.csv': no such file"),
        ("reduce run.csv -o nowhere/c.csv", "cannot write 'nowhere/c.csv'"),
        ("fit absent.csv", "cannot read 'absent.csv': no such file"),
        ("fit c.csv --form cubic", "form = 'cubic': is not a known choice; use one of su-fan"),
        (
            "fit c.csv --form cambered",
            "C_L = '0 to 0.9': is negative at none of the angles between 0 and 90 degrees",
        ),
        ("fit c.csv --aspect-ratio 0", "--aspect-ratio = 0.0: must be > 0; give span over mean chord"),
        ("fit c.csv -o m.csv", "--output = 'm.csv': is not a model file; end it in .toml"),
        ("fit c.csv --plot m.gif", "--plot = 'm.gif': is not a figure format"),
        ("fit c.csv --alpha-min nan", "--alpha-min = nan: must be finite"),
        ("fit c.csv --alpha-min 50 --alpha-max 10", "is above --alpha-max 10"),
        ("fit c.csv --alpha-min 101", "holds no row: the angles run from 0 to 90"),
    ],
)
def test_bad_options_are_refused(words, part, here, capsys):
    Path("run.csv").write_text(GOOD)
    Path("c.csv").write_text(TABLE)
    lines = refused(capsys, *words.split())
    assert any(part in line for line in lines), lines


def test_all_files_faults_come_at_once(here, capsys):
    Path("a.csv").write_text(GOOD.replace("speed = 0.5", "speed = 0"))
    Path("b.csv").write_text(GOOD.replace("1.03,0.2", "nan,0.2", 1))
    lines = refused(capsys, "reduce", "a.csv", "b.csv", "absent.csv", "-o", "c.csv")
    assert [
        any(word in line for line in lines) for word in ("absent.csv", "a.csv row 1, speed", "b.csv row 10")
    ] == [True] * 3


def test_a_problem_with_a_fitted_cambered_wing_can_be_set_up_again(here):
    from wingbeat import OrbitProblem, load_species
    from wingbeat.orbits.problem.parameters import parameters_of
    from wingbeat.records.inputs import inputs_of, problem_from

    alpha = np.arange(-24.0, 31.0, 2.0)
    terms = Feathered().terms
    table = CoefficientTable(alpha, {"C_L": terms.lift_at(alpha), "C_D": terms.drag_at(alpha)})
    fit_wing(table, "cambered", "feathered", aspect_ratio=6.0).save("own.toml")
    problem = OrbitProblem(load_species("pigeon"), speed=12.0, aero="own.toml")
    assert problem_from(inputs_of(problem, starts=1, seed=0)).aero.coefficients == load_coefficients("own.toml")
    found = {one.path: one for one in parameters_of(problem)}
    higher = found["aero.wing.lift_highest"].changed(problem, 1.5)
    assert higher.aero.coefficients.terms.lift_highest == 1.5


def test_an_orbit_with_a_fitted_model_can_be_set_up_again(campaign, here):
    """Its formulas go with it, for the file may be gone by then."""
    from wingbeat import OrbitProblem, load_species
    from wingbeat.records.inputs import inputs_of, problem_from

    assert main(["fit", str(campaign / "coefficients.csv"), "-o", "su-fan.toml"]) == 0
    own = load_coefficients("su-fan.toml")
    problem = OrbitProblem(load_species("pigeon"), speed=12.0, aero=own)
    again = problem_from(inputs_of(problem, starts=1, seed=0))
    assert again.aero.coefficients == own


DATA = ROOT / "../shared/data"


@pytest.fixture
def study(monkeypatch):
    """The command line of the study of measured wings."""
    monkeypatch.syspath_prepend(ROOT / "validation")
    return importlib.import_module("measured_wings").main


@pytest.mark.slow
@pytest.mark.skipif(not DATA.is_dir(), reason="other people's measurements are not part of this repository")
def test_the_study_of_measured_wings_writes_what_the_repository_holds(study, here):
    assert study(["--data", str(DATA), "-o", "."]) == 0
    page = Path("measured_wings.md").read_text()
    assert page == (ROOT / "docs/evidence/measured_wings.md").read_text()
    assert page.count("| gull F") == 9


def test_the_study_says_what_is_missing(study, here, capsys):
    assert study(["--data", "."]) == 2
    assert "cannot find gull_wing_polar.csv, jackdaw_glide_wake.csv" in capsys.readouterr().err
