"""Small files that people have, through the real program: each gives its right value, or a sentence that helps.

Before these checks, all but the good film gave a wrong number without a word, or advice that did not help.
"""

from pathlib import Path

import pytest

from tests.helpers.places import ROOT
from wingbeat.cli import main

CASES = ROOT / "tests/cases"
FIT = "fit {} --form cambered -o out.toml"
POLAR = "polar {} --alpha 10.5 --csv"
REDUCE = "reduce {} -o out.csv"
FLY = "simulate pigeon --kinematics {} --beats 1 --samples 8"


def scaled(factor):
    """Return a change of a record: its forces and moments times a factor."""

    def change(text):
        lines = [
            "time,normal_force,tangential_force,moment,alpha_deg" if one[:4] == "time" else one
            for one in text.splitlines()
        ]
        for i, line in enumerate(lines):
            if line[0].isdigit():
                time, *loads, alpha = line.split(",")
                lines[i] = ",".join([time, *(f"{factor * float(load):.6f}" for load in loads), alpha])
        return "\n".join(lines)

    return change


def stated(**constants):
    """Return a change of a record: other constants."""

    def change(text):
        for name, value in constants.items():
            old = next(line for line in text.splitlines() if line.startswith(f"# {name}"))
            text = text.replace(old, f"# {name} = {value}")
        return text

    return change


# The file, the command, its exit code, and what it says; with a change for records that differ from the good one.
ROWS = [
    ("polars/coarse_stall.csv", POLAR, 0, ",0.02259"),
    ("polars/negative_drag.csv", "glide pigeon --aero {} --alpha 4:12:1", 0, "slowest sink: 0.194 m/s"),
    ("polars/three_reynolds.csv", FIT, 0, "the residuals depend on Re"),
    ("polars/three_reynolds.csv", f"{FIT} --reynolds-range 50000 70000", 0, "wrote out.toml"),
    ("polars/hysteresis.csv", FIT, 0, "the rows form two branches from 8 to 14 deg: 0.95 and 0.6 at 9 deg"),
    ("polars/drag_counts.csv", FIT, 2, "the column looks like drag counts: divide it by 10000"),
    ("polars/reynolds_in_millions.csv", FIT, 2, "it looks like millions or thousands"),
    ("polars/to_16_deg_c_l.csv", FIT, 0, "wrote out.toml"),
    (
        "polars/to_16_deg_c_l.csv",
        "polar {}",
        2,
        "a fit completes it: wingbeat fit to_16_deg_c_l.csv --form cambered",
    ),
    ("films/good.csv", FLY, 0, "frequency 8.201 +- 0.008 Hz, fitted to the 3.1 beats of the clip"),
    ("films/frequency_wrong.csv", FLY, 2, "the clip itself beats at 8.201 +- 0.008 Hz; the header says 10.1"),
    ("films/frequency_falls.csv", FLY, 0, "the frequency falls from 8.83 to 7.6 Hz within the clip"),
    ("films/nan_gaps.csv", FLY, 0, "77 frames, residual 1.4 deg"),
    ("films/nan_in_pitch.csv", FLY, 0, "pitch_deg: 50 frames, residual 0.91 deg"),
    ("films/left_right.csv", FLY, 0, "the mean of both wings; left minus right is 0.34 +- 0.23 deg"),
    ("films/frames.csv", FLY, 2, "add the line '# frame rate [Hz] = ..'"),
    ("films/semicolon.csv", FLY, 0, "read with semicolons between the columns and decimal commas"),
    ("points/anipose.csv", FLY, 2, "points tracked by Anipose; wingbeat reads angles, not points"),
    ("points/deeplabcut.csv", FLY, 2, "points tracked by DeepLabCut; wingbeat reads angles, not points"),
    ("points/dltdv_xyzpts.csv", FLY, 2, "points tracked by DLTdv; wingbeat reads angles, not points"),
    ("points/opensim.trc", FLY, 2, "marker points of OpenSim"),
    ("loadcell/rest_at_both_ends.csv", REDUCE, 0, "the record steps within the window, at about 34.9 s"),
    ("loadcell/rest_at_both_ends.csv", f"{REDUCE} --last 5", 2, "rest"),
    ("loadcell/rest_at_both_ends.csv", f"{REDUCE} --rest 0:5 35:40", 0, "wrote out.csv"),
    ("loadcell/good.csv", REDUCE, 0, "zero readings are missing"),
]
CHANGED = {
    "millinewton": (scaled(1e3), "forces in mN"),
    "millimetres": (stated(chord=76, span=456), "is it in mm or cm?"),
    "dynamic viscosity": (stated(viscosity=1.002e-3), "the dynamic viscosity of water in Pa s"),
    "two speeds": (lambda text: f"# speed = 4\n{text}", "appears twice"),
}


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "400")


def run(path, command, capsys):
    Path(path.name).write_bytes(path.read_bytes())
    code = main(command.format(path.name).split())
    told = capsys.readouterr()
    assert "Traceback" not in told.err
    return code, told.out + told.err


@pytest.mark.slow
@pytest.mark.parametrize(("name", "command", "code", "words"), ROWS)
def test_each_file_gives_its_value_or_a_sentence(name, command, code, words, capsys):
    ended, said = run(CASES / name, command, capsys)
    assert (ended, words in said) == (code, True), said


@pytest.mark.parametrize("name", CHANGED)
def test_each_unit_that_is_not_si_is_named(name, tmp_path, capsys):
    change, words = CHANGED[name]
    path = tmp_path / "changed" / "record.csv"
    path.parent.mkdir()
    path.write_text(change((CASES / "loadcell/good.csv").read_text()))
    ended, said = run(path, REDUCE, capsys)
    assert (ended, words in said) == (2, True), said
    assert not Path("out.csv").exists()


def test_rest_at_both_ends_gives_the_true_coefficients(capsys):
    run(CASES / "loadcell/rest_at_both_ends.csv", f"{REDUCE} --rest 0:5 35:40", capsys)
    head, row = (line.split(",") for line in Path("out.csv").read_text().splitlines()[-2:])
    found = dict(zip(head, map(float, row), strict=True))
    assert (found["C_L"], found["C_D"]) == pytest.approx((0.95, 0.45), abs=0.002)
