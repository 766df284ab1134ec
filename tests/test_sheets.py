"""Units in the head of a table: those that say nothing, and those that do not fit."""

import pytest

import wingbeat as wb
from wingbeat.errors import FaultList
from wingbeat.sheets import check_unit, read_sheet, split_unit


@pytest.mark.parametrize("heading", ["x_cp", "x_cp [-]", "x_cp (-)", "x_cp [1]", "x_cp []"])
def test_a_column_without_unit_may_say_so(heading):
    faults = FaultList()
    check_unit(faults, "x_cp", split_unit(heading).unit, "")
    faults.raise_if_any()


@pytest.mark.parametrize(("heading", "wanted"), [("x_cp [m]", ""), ("alpha [-]", "deg"), ("alpha [rad]", "deg")])
def test_a_unit_that_does_not_fit_is_a_fault(heading, wanted):
    faults = FaultList()
    check_unit(faults, "column", split_unit(heading).unit, wanted)
    with pytest.raises(wb.InvalidInputError, match="column"):
        faults.raise_if_any()


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a;b\n1,5;2\n", "semicolons between its columns and decimal commas"),
        ("# a comment, with commas\na\tb\n1\t2\n", "tabs between its columns"),
        ("alpha CL CD\n0 1 2\n", "spaces between its columns"),
        ("\n   XFOIL   Version 6.99\n", "a polar of XFOIL"),
        ("xflr5 v6.47\n\n Calculated polar for: x\n", "a polar of XFOIL or XFLR5"),
        ("! ----- AirfoilInfo v1.01.x Input File ---\n", "an airfoil table of AeroDyn"),
        ("<!DOCTYPE html><html>", "a web page"),
    ],
)
def test_a_file_of_another_format_is_named_in_one_sentence(tmp_path, text, words):
    (tmp_path / "other.csv").write_text(text)
    with pytest.raises(wb.InvalidInputError, match=words) as refused:
        read_sheet(tmp_path / "other.csv")
    assert len(refused.value.faults) == 1


def test_a_table_that_only_mentions_a_program_is_read(tmp_path):
    (tmp_path / "good.csv").write_text(
        "# from XFOIL 6.99; tabs\n# ====\n# ====\n# note: n = 1\n# note: n = 2\na,b\n1,2\n"
    )
    sheet = read_sheet(tmp_path / "good.csv")
    assert (sheet.header, sheet.constants) == (["a", "b"], {})


@pytest.mark.parametrize("second", ["speed = 5", "Speed [m/s] = 5", "SPEED(m/s) = 4"])
def test_a_constant_given_twice_in_any_spelling_is_refused(tmp_path, second):
    (tmp_path / "twice.csv").write_text(f"# speed = 4\n# {second}\na,b\n1,2\n")
    with pytest.raises(wb.InvalidInputError, match=r"row 2 = .*: appears twice"):
        read_sheet(tmp_path / "twice.csv")
