"""Files of a strip-motion case: what is read, and the sentence for each fault, with its file and row."""

import dataclasses
import re

import numpy as np
import pytest

from tests.helpers.strip_cases import case_text, flapping_case, forces_text, strips_text, write_case
from wingbeat._base import FileError, InvalidInputError
from wingbeat.cli import main
from wingbeat_evidence.measured_motion import StripCase, read_strip_case

MOTION = flapping_case(strips=3, count=24)
CASE = dataclasses.replace(
    MOTION,
    forces={"fz": np.sin(MOTION.times), "fx": np.cos(MOTION.times)},
    errors={"fz": 0.1 + 0 * MOTION.times},
    mean_force=None,
    wing="rigid",
)


def assert_same(found: StripCase, wanted: StripCase):
    for field in dataclasses.fields(StripCase):
        one, other = getattr(found, field.name), getattr(wanted, field.name)
        if isinstance(other, dict):
            assert one.keys() == other.keys()
            for key in other:
                np.testing.assert_array_equal(one[key], other[key])
        elif isinstance(other, np.ndarray):
            np.testing.assert_array_equal(one, other)
        else:
            assert one == other


def test_a_case_comes_back_from_its_files(tmp_path):
    for name, case in (("forces", CASE), ("mean", MOTION), ("bare", flapping_case(velocities=False, count=20))):
        assert_same(read_strip_case(write_case(case, tmp_path / name)), case)
    window = dataclasses.replace(CASE, start=float(CASE.times[2]), end=float(CASE.times[20]))
    assert_same(read_strip_case(write_case(window, tmp_path / "window")), window)


def test_rows_may_be_sorted_by_strip(tmp_path):
    path = write_case(CASE, tmp_path / "case")
    head, *rows = strips_text(CASE).splitlines()
    rows.sort(key=lambda row: int(row.split(",")[1]))
    (path.parent / "strips.csv").write_text("\n".join([head, *rows]))
    assert_same(read_strip_case(path), CASE)


def test_forces_may_be_those_of_the_window_alone(tmp_path):
    window = dataclasses.replace(CASE, start=float(CASE.times[4]), end=float(CASE.times[20]))
    path = write_case(window, tmp_path / "case")
    head, *rows = forces_text(window).splitlines()
    (path.parent / "forces.csv").write_text("\n".join([head, *rows[4:21]]))
    found = read_strip_case(path)
    assert np.isfinite(found.forces["fz"]).sum() == 17
    np.testing.assert_array_equal(found.forces["fz"][found.inside], CASE.forces["fz"][found.inside])


def swapped(text, one, other):
    rows = text.splitlines()
    rows[one], rows[other] = rows[other], rows[one]
    return "\n".join(rows)


def without(text, *rows):
    return "\n".join(row for i, row in enumerate(text.splitlines()) if i not in rows)


def with_cell(text, row, column, value):
    rows = [line.split(",") for line in text.splitlines()]
    rows[row][rows[0].index(column)] = value
    return "\n".join(",".join(cells) for cells in rows)


TOML, STRIPS, FORCES = case_text(CASE), strips_text(CASE), forces_text(CASE)
# What is changed in which file, and the words of the fault.
FAULTS = {
    "key": ("case.toml", TOML + "colour = 3\n", "'colour'", "is not a known key"),
    "no mass": ("case.toml", re.sub("mass = .*\n", "", TOML), "case.toml, mass", "is missing"),
    "mass": ("case.toml", TOML.replace("mass = 0.05", "mass = -1"), "case.toml, mass", "must be >= 1e-09"),
    "density": ("case.toml", TOML.replace("density = 1.2", "density = 0.0"), "density", "must be >="),
    "nan": ("case.toml", TOML.replace("speed = 4.0", "speed = nan"), "case.toml, speed", "must be finite"),
    "text": ("case.toml", TOML.replace("speed = 4.0", 'speed = "4"'), "case.toml, speed", "must be a number"),
    "enormous": ("case.toml", TOML.replace("speed = 4.0", f"speed = {10**400}"), "speed", "must be finite"),
    "switch": ("case.toml", TOML.replace("mirrored = true", "mirrored = 1"), "mirrored", "must be true or false"),
    "wing": ("case.toml", TOML.replace("rigid", "scaly"), "case.toml, wing", "is not a known choice"),
    "both": ("case.toml", TOML + "mean_force = [0.0, 1.0]\n", "case.toml, forces", "exactly one of forces"),
    "neither": ("case.toml", re.sub("forces = .*\n", "", TOML), "case.toml, forces", "exactly one of forces"),
    "mean": ("case.toml", TOML.replace('forces = "forces.csv"', "mean_force = [1.0]"), "mean_force", "two numbers"),
    "no file": ("case.toml", TOML.replace("strips.csv", "none.csv"), "case.toml, strips", "no such file"),
    "file number": (
        "case.toml",
        TOML.replace('"strips.csv"', "7"),
        "case.toml, strips",
        "must be the name of a file",
    ),
    "window": ("case.toml", TOML + "from = 0.1\nto = 0.01\n", "case.toml, from", "must be below"),
    "narrow": ("case.toml", TOML + "from = 0.001\nto = 0.002\n", "case.toml, from", "needs 8"),
    "window text": ("case.toml", TOML + 'from = "0"\n', "case.toml, from", "must be a number"),
    "slow frames": (
        "case.toml",
        TOML.replace("frequency = 8.0", "frequency = 80.0"),
        "row 5, column time_s",
        "0.2 beats",
    ),
    "column": ("strips.csv", STRIPS.replace("chord_y_m", "chordy"), "column chord_y_m", "the column is missing"),
    "unknown column": (
        "strips.csv",
        STRIPS.replace("area_m2", "area_m2,area_m3"),
        "column 10",
        "not a known column",
    ),
    "half a velocity": ("strips.csv", STRIPS.replace(",vy_m_s", ",wy_m_s"), "column vy_m_s", "missing"),
    "twice": ("strips.csv", STRIPS.replace("y_m,z_m,chord", "y_m,y_m,chord"), "column 5", "appears twice"),
    "order": ("strips.csv", swapped(STRIPS, 1, 10), "strips.csv row", "is not later than"),
    "same time": ("strips.csv", STRIPS + STRIPS.splitlines()[-1], "strips.csv row 74", "is not later than"),
    "vanishes": ("strips.csv", without(STRIPS, 10), "strips.csv, strip 0", "has no row at"),
    "vanish": ("strips.csv", without(STRIPS, *range(10, 40, 3)), "strips.csv", "are missing in total"),
    "cell": ("strips.csv", with_cell(STRIPS, 7, "z_m", "high"), "strips.csv row 8, column z_m", "is not a number"),
    "not finite": ("strips.csv", with_cell(STRIPS, 7, "z_m", "inf"), "strips.csv row 8, column z_m", "finite"),
    "area": ("strips.csv", with_cell(STRIPS, 7, "area_m2", "0"), "strips.csv row 8, column area_m2", "from 1e-14"),
    "far": (
        "strips.csv",
        with_cell(STRIPS, 7, "x_m", "1e9"),
        "strips.csv row 8, column x_m",
        "must be finite and from",
    ),
    "strip": ("strips.csv", with_cell(STRIPS, 7, "strip", "1.5"), "row 8, column strip", "whole number"),
    "empty": ("strips.csv", "", "strips.csv row 1", "holds no table"),
    "head": ("strips.csv", STRIPS.splitlines()[0], "strips.csv", "holds no strips"),
    "shorter": ("forces.csv", without(FORCES, 24), "forces.csv, column time_s", "must be the same as the 24 times"),
    "half": ("forces.csv", without(FORCES, *range(1, 25, 2)), "forces.csv", "must be the same as the 24 times"),
    "longer": ("forces.csv", FORCES + "9,1,1,0.1\n", "forces.csv", "must be the same as the 24 times"),
    "other times": ("forces.csv", with_cell(FORCES, 7, "time_s", "0.0321"), "forces.csv", "no row is at"),
    "force order": ("forces.csv", swapped(FORCES, 3, 4), "forces.csv row 5", "is not later than"),
    "no force": (
        "forces.csv",
        FORCES.replace("fz_n,fx_n,fz_n_se", "fz_n_se,fx_n_se,fx_se"),
        "forces.csv",
        "neither",
    ),
    "force column": (
        "forces.csv",
        FORCES.replace("fx_n", "fy_n"),
        "forces.csv row 1, column 3",
        "not a known column",
    ),
    "force cell": ("forces.csv", with_cell(FORCES, 3, "fz_n", "nan"), "forces.csv row 4", "has no value"),
    "error": ("forces.csv", with_cell(FORCES, 3, "fz_n_se", "-0.1"), "forces.csv row 4", "standard error"),
    "no rows": ("forces.csv", "time_s,fz_n", "forces.csv", "holds no forces"),
    "wide cell": ("strips.csv", "x" * 200_000, "strips.csv row 1, column time_s", "missing"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_each_fault_has_its_sentence(fault, tmp_path, capsys):
    file, text, where, rule = FAULTS[fault]
    path = write_case(CASE, tmp_path / "case")
    (path.parent / file).write_text(text)
    assert main(["validate", str(path), "--json"]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert any(where in line and rule in line for line in told.err.splitlines()), told.err
    assert all(line.startswith("error: ") for line in told.err.splitlines())


def test_zero_chords_are_listed_with_their_rows(tmp_path):
    flat = dataclasses.asdict(CASE)["chord"].copy()
    text = STRIPS
    for column in ("chord_x_m", "chord_y_m", "chord_z_m"):
        text = with_cell(text, 5, column, "0")
    path = write_case(CASE, tmp_path / "case")
    (path.parent / "strips.csv").write_text(text)
    with pytest.raises(InvalidInputError, match=r"strips\.csv row 6, column chord = 0.0: the length"):
        read_strip_case(path)
    flat[1, 1] = 0.0
    with pytest.raises(InvalidInputError, match=r"chord\[1, 1\]"):
        dataclasses.replace(CASE, chord=flat)


def test_all_faults_of_all_files_are_told_at_once(tmp_path):
    path = write_case(CASE, tmp_path / "case")
    path.write_text(TOML.replace("mass = 0.05", "mass = -1") + "colour = 3\n")
    (path.parent / "strips.csv").write_text(with_cell(with_cell(STRIPS, 7, "z_m", "high"), 9, "y_m", "wide"))
    (path.parent / "forces.csv").write_text(with_cell(FORCES, 3, "fz_n", "nan"))
    with pytest.raises(InvalidInputError) as caught:
        read_strip_case(path)
    assert len(caught.value.faults) == 5


def test_files_that_are_none(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        read_strip_case(tmp_path / "case.toml")
    (tmp_path / "case.toml").write_text("name = ")
    with pytest.raises(FileError, match="as TOML"):
        read_strip_case(tmp_path / "case.toml")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"times": CASE.times[::-1]}, r"times\[1\]"),
        ({"area": CASE.area[:, :2]}, "must have the shape"),
        ({"position": CASE.position[:, :, :2]}, "position"),
        ({"velocity": np.full_like(CASE.position, np.nan)}, "must be finite"),
        ({"forces": {"fz": CASE.times[:-1]}, "errors": {}}, "same shape as times"),
        ({"forces": {"fy": CASE.times}, "errors": {}}, "is not a force"),
        ({"forces": {"fx": CASE.times}}, "is not a force"),
        ({"errors": {"fz": -CASE.times - 1.0}}, "standard errors"),
        ({"mean_force": (0.0, 1.0)}, "one of forces and mean_force"),
        ({"wing": "scaly"}, "known choice"),
        ({"name": "two\nlines"}, "one line"),
        ({"area": "wide"}, "a column for each strip"),
    ],
)
def test_values_are_checked_as_files_are(change, words):
    with pytest.raises(InvalidInputError, match=words):
        dataclasses.replace(CASE, **change)
