"""Units in the head of a table: those that say nothing, and those that do not fit."""

import numpy as np
import pytest

import wingbeat as wb
from wingbeat._base import FaultList
from wingbeat._base.sheets import MAX_CONSTANTS, check_unit, number_in, parse_numbers, read_sheet, split_unit


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
        ("alpha CL CD of it\n0 1 2\n", "names 5 columns between spaces, and the rows have 3 cells"),
        ("\n   XFOIL   Version 6.99\n", "a polar of XFOIL"),
        ("xflr5 v6.47\n\n Calculated polar for: x\n", "a polar of XFOIL or XFLR5"),
        ("! ----- AirfoilInfo v1.01.x Input File ---\n", "an airfoil table of AeroDyn"),
        ("<!DOCTYPE html><html>", "a web page"),
        ("LabVIEW Measurement\t\nSeparator\tTab\n", "LabVIEW"),
        ("ATI DAQ FT.NET log\nCalibration,FT1.cal\n", "a log of an ATI force sensor"),
        ("Log of Monday\nCalibration,FT12345.cal\nTime,Fx,Fy\n", "a log of an ATI force sensor"),
        ("Time,Fx,Fy,Fz,Tx,Ty,Tz\n0,1,2,3,4,5,6\n", "the axes Fx, Fy, Fz; wingbeat reduce reads it"),
        ("scorer,DLC,DLC\nbodyparts,tip,tip\ncoords,x,y\n", "DeepLabCut; wingbeat reads angles"),
        ("pt1_X,pt1_Y,pt1_Z\n1,2,3\n", "DLTdv"),
        ("tip_x,tip_y,tip_z,tip_error,tip_ncams,fnum\n", "Anipose"),
        ("track,frame_idx,instance.score,tip.x,tip.y,tip.score\n", "SLEAP"),
        ("PathFileType\t4\t(X/Y/Z)\ta.trc\n", "marker points"),
    ],
)
def test_a_file_of_another_format_is_named_in_one_sentence(tmp_path, text, words):
    (tmp_path / "other.csv").write_text(text)
    with pytest.raises(wb.InvalidInputError, match=words) as refused:
        read_sheet(tmp_path / "other.csv")
    assert len(refused.value.faults) == 1


@pytest.mark.parametrize(
    ("text", "numbers", "note"),
    [
        (
            "a;b\n1,5;2\n3;4,25\n",
            [[1.5, 2], [3, 4.25]],
            "read with semicolons between the columns and decimal commas",
        ),
        ("a;b\n1.5;2\n", [[1.5, 2]], "read with semicolons between the columns"),
        ("# a comment, with commas\na\tb [m]\n1\t2\n", [[1, 2]], "read with tabs between the columns"),
        ("alpha [deg] CL CD\n  0 1  2\n", [[0, 1, 2]], "read with spaces between the columns"),
        ("a b\n1,5 1,234\n", [[1.5, 1.234]], "read with spaces between the columns and decimal commas"),
        ("a,b\n1.5,2\n", [[1.5, 2]], None),
        (
            '# rate = 8,2;;\na;b\n"1,5";2\n',
            [[1.5, 2]],
            "read with semicolons between the columns and decimal commas",
        ),
    ],
)
def test_separators_and_decimal_commas_are_read_and_said(tmp_path, text, numbers, note):
    (tmp_path / "a.csv").write_text(text)
    assert read(tmp_path / "a.csv").tolist() == numbers
    sheet = read_sheet(tmp_path / "a.csv")
    assert sheet.notes == (() if note is None else (note,))
    assert sheet.constants == ({"rate": (1, "8.2")} if "rate" in text else {})


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            "a;b\n1,234;2\n",
            "row 2 = '1,234': can be read in two ways: with a decimal comma, or with a mark between",
        ),
        ("a;b\n1.5;2\n3;1,234\n", "row 3 = '1,234': has a comma, and other numbers of the file have points"),
        ("a;b\n0,5;2\n3;1,234,567\n", "row 3 = '1,234,567': can be read in two ways"),
        ("a\tb\n1.234,5\t2\n", "is not a number"),
    ],
)
def test_a_number_that_can_be_read_in_two_ways_is_refused(tmp_path, text, words):
    assert words in refused(tmp_path, text)[0]


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


def read(path):
    """Return the numbers of a sheet, and refuse it with all its faults."""
    sheet, faults = read_sheet(path), FaultList()
    numbers = parse_numbers(faults, sheet, sheet.header, blank=frozenset({"may be empty"}))
    faults.raise_if_any()
    return numbers


def refused(tmp_path, content, name="a.csv"):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(wb.InvalidInputError) as caught:
        read(path)
    return [str(fault) for fault in caught.value.faults]


def test_one_sentence_for_what_is_wrong_throughout(tmp_path):
    """Each of these gave one line for every row, or named a row that is right."""
    (commas,) = refused(tmp_path, "time,flap_deg\n" + "".join(f"0,{i:02},4{i % 10},5\n" for i in range(60)))
    assert "has 4 cells" not in commas
    assert "and all others have 4 cells, but the header names 2 columns; write decimal points" in commas
    rows = "".join(f"0,{i:02},4{i % 10},5\n" * (i != 7) or "0.7\n" for i in range(60))
    (most,) = refused(tmp_path, "time,flap_deg\n" + rows)
    assert "and most others have 4 cells, but the header names 2 columns; write decimal points" in most
    (savetxt,) = refused(tmp_path, "# time,flap_deg\n0.1,2\n0.2,3\n")
    assert "a.csv row 2" in savetxt
    assert "write the names without # in front" in savetxt
    (workbook,) = refused(tmp_path, b"PK\x03\x04\xff\xfe", "beat.xlsx")
    assert "a spreadsheet; save its table as CSV" in workbook
    (many,) = refused(tmp_path, "".join(f"# key{i} = 1\n" for i in range(9000)) + "time\n1\n")
    assert f"row {MAX_CONSTANTS + 1}" in many


@pytest.mark.parametrize("cell", ["", "NaN", "nan", "NA", "N/A", "null"])
def test_no_value_is_an_empty_cell_where_one_may_be(tmp_path, cell):
    path = tmp_path / "a.csv"
    path.write_text(f"time,may be empty\n0,1\n1,{cell}\n")
    assert np.isnan(read(path)).tolist() == [[False, False], [False, True]]
    (needed,) = refused(tmp_path, f"time,flap_deg\n0,1\n1,{cell}\n")
    assert "a.csv row 3, column flap_deg" in needed
    assert "but this column needs one in each row" in needed


def test_rows_of_commas_are_blank_rows_and_commas_at_the_ends_are_named(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("time,flap_deg\n0,1\n,\n1,2\n , \n,,\n")
    assert read(path).tolist() == [[0, 1], [1, 2]]
    (ends,) = refused(tmp_path, "time,flap_deg\n0,1,\n1,2,\n")
    assert ends.endswith("drop the commas at the ends of the rows")


@pytest.mark.parametrize("cell", ["1e200", "-1e308"])
def test_a_number_whose_square_overflows_is_refused(tmp_path, cell):
    (large,) = refused(tmp_path, f"time,flap_deg\n0,1\n1,{cell}\n")
    assert "row 3, column flap_deg" in large
    assert "larger than any measurement" in large


def test_what_python_alone_takes_for_numbers_is_refused(tmp_path):
    assert [number_in(cell) for cell in ("1_000", "\u0661\u0662", "0x10", "")] == [None] * 4
    (tmp_path / "t.csv").write_text("a,b\n1,2\n1_000,3\n")
    faults = FaultList()
    parse_numbers(faults, read_sheet(tmp_path / "t.csv"), ["a", "b"])
    with pytest.raises(wb.InvalidInputError, match=r"t.csv row 3, column a = '1_000': is not a number"):
        faults.raise_if_any()
