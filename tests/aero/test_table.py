"""Coefficient tables: the curve, its extension, and every fault of a file."""

import math
import re

import numpy as np
import pytest

from tests.helpers.coefficients import value_slope_curvature
from wingbeat._base import FileError, InvalidInputError
from wingbeat.aero import SuFan, TableCoefficients, load_coefficients, load_table

RIGHT = math.pi / 2


def polar_rows(alpha_deg, x_cp=False):
    """Return rows of a smooth polar at angles of any sign."""
    a = np.deg2rad(alpha_deg)
    columns = [alpha_deg, 1.1 * np.sin(2 * a) + 0.05 * np.cos(a), 1.2 - np.cos(2 * a + 0.1)]
    return np.column_stack([*columns, 0.25 + 0.08 * np.abs(a)] if x_cp else columns)


def write(path, rows, header="alpha_deg,c_l,c_d"):
    lines = [header, *(",".join(repr(float(cell)) for cell in row) for row in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


@pytest.fixture
def half(tmp_path):
    """A table from 0 to 110 degrees in steps of 2, as the paper measured."""
    return write(tmp_path / "half.csv", polar_rows(np.arange(0, 111, 2.0), x_cp=True), "alpha_deg,c_l,c_d,x_cp")


def test_curve_runs_through_the_points(half):
    table = load_table(half)
    rows = polar_rows(np.arange(2, 89, 2.0), x_cp=True)
    alpha = np.deg2rad(rows[:, 0])
    found = np.column_stack([table.lift(alpha), table.drag(alpha), table.centre_of_pressure(alpha)])
    np.testing.assert_allclose(found, rows[:, 1:], rtol=0, atol=1e-14)


def test_a_table_of_a_formula_is_that_formula():
    model = SuFan(blend_width_deg=2.0)
    angles = np.arange(0, 111, 1.0)
    pieces = model.kernel().pieces
    lift, drag = (np.array(f(np.deg2rad(angles))) for f in (pieces.lift, pieces.drag))
    table = TableCoefficients("fine", tuple(angles), tuple(lift), tuple(drag), blend_width_deg=2.0)
    alpha = np.linspace(-2 * np.pi, 2 * np.pi, 2001)
    np.testing.assert_allclose(table.lift(alpha), model.lift(alpha), rtol=0, atol=2e-3)
    np.testing.assert_allclose(table.drag(alpha), model.drag(alpha), rtol=0, atol=1e-4)


@pytest.mark.parametrize("extension", ["mirrored", "clipped-drag"])
def test_half_table_is_extended_as_a_formula_is(half, extension):
    table = load_coefficients(half, extension, 2.0)
    assert (table.name, table.extension, table.blend_width_deg) == ("half", extension, 2.0)
    assert table.alpha_range_deg == (0.0, 110.0)
    assert table.has_centre_of_pressure
    alpha = np.linspace(0.0, math.pi, 777)
    np.testing.assert_array_equal(table.lift(-alpha), -table.lift(alpha))
    np.testing.assert_array_equal(table.centre_of_pressure(-alpha), table.centre_of_pressure(alpha))
    if extension == "mirrored":
        np.testing.assert_array_equal(table.drag(-alpha), table.drag(alpha))
    else:
        np.testing.assert_allclose(table.drag(-alpha[10:-10]), 1.2 - math.cos(0.1), rtol=0, atol=1e-12)
    assert table.lift(0.0) == table.lift(RIGHT) == table.lift(-math.pi) == 0.0


def test_signed_table_is_used_as_measured(tmp_path):
    rows = polar_rows(np.arange(-90, 91, 5.0), x_cp=True)
    table = load_table(write(tmp_path / "signed.csv", rows, "alpha_deg,c_l,c_d,x_cp"), "signed")
    inside = np.abs(rows[:, 0]) < 89
    alpha = np.deg2rad(rows[inside, 0])
    found = np.column_stack([table.lift(alpha), table.drag(alpha), table.centre_of_pressure(alpha)])
    np.testing.assert_allclose(found, rows[inside, 1:], rtol=0, atol=1e-14)
    # Behind, the plate is the mirror of its front.
    assert table.lift(math.pi - 0.5) == pytest.approx(-table.lift(0.5), abs=1e-14)
    assert table.centre_of_pressure(0.5 - math.pi) == pytest.approx(1 - table.centre_of_pressure(0.5), abs=1e-14)


def test_whole_turn_table_is_periodic_and_used_as_it_is(tmp_path):
    rows = polar_rows(np.arange(-180, 181, 5.0), x_cp=True)
    rows[-1, 1:] = rows[0, 1:]
    table = load_table(write(tmp_path / "whole.csv", rows, "alpha_deg,c_l,c_d,x_cp"))
    assert table.extension == "signed"
    alpha = np.deg2rad(rows[:, 0])
    for turns in (0, 2 * np.pi, -4 * np.pi):
        np.testing.assert_allclose(table.lift(alpha + turns), rows[:, 1], rtol=0, atol=1e-13)
        np.testing.assert_allclose(table.drag(alpha + turns), rows[:, 2], rtol=0, atol=1e-13)
        np.testing.assert_allclose(table.centre_of_pressure(alpha + turns), rows[:, 3], rtol=0, atol=1e-13)
    _, slopes, curvatures = value_slope_curvature(table, [math.pi, -math.pi])
    np.testing.assert_allclose(*slopes[:, :2], rtol=0, atol=1e-12)
    np.testing.assert_allclose(*curvatures[:, :2], rtol=0, atol=1e-10)
    # Seen from the seam the table is the same as from any other row.
    turned = np.roll(rows[:-1, 1:], 36, axis=0)
    turned = TableCoefficients("turned", tuple(rows[:, 0]), *(tuple(c) for c in np.vstack([turned, turned[:1]]).T))
    dense = np.linspace(-math.pi, math.pi, 999)
    np.testing.assert_allclose(turned.drag(dense + math.pi), table.drag(dense), rtol=0, atol=1e-12)


@pytest.mark.parametrize(("extension", "first"), [("mirrored", 0), ("clipped-drag", 0), ("signed", -90)])
def test_tables_are_twice_continuously_differentiable(extension, first):
    rows = polar_rows(np.arange(first, 91, 3.0), x_cp=True)
    table = TableCoefficients("smooth", *(tuple(column) for column in rows.T), extension=extension)
    edges = np.deg2rad([-179, -91, -90, -89, -45, -1, 0, 1, 30, 89, 90, 91, 179])
    either_side, dense = [edges - 1e-9, edges + 1e-9], np.deg2rad(np.arange(-720, 721) / 4)
    for order, rows in enumerate(value_slope_curvature(table, np.concatenate([*either_side, dense]))):
        before, after, _ = np.split(rows, [edges.size, 2 * edges.size])
        np.testing.assert_allclose(before, after, rtol=0, atol=1e-6 * 60.0**order)
        assert np.isfinite(rows).all()


def test_table_without_centre_of_pressure(tmp_path):
    table = load_table(write(tmp_path / "two.csv", polar_rows(np.arange(0, 91, 10.0))))
    assert not table.has_centre_of_pressure
    with pytest.raises(InvalidInputError, match="a table with the column x_cp"):
        table.moment(0.1)
    assert np.isnan(table.kernel().centre_of_pressure(0.1))
    assert str(table) == "two (two.csv)"


def test_tables_are_equal_by_their_numbers(half):
    assert load_table(half) == load_table(str(half))
    assert hash(load_table(half)) == hash(load_table(half))


def test_comments_blank_rows_spaces_and_a_byte_order_mark_are_read(tmp_path):
    path = tmp_path / "loose.csv"
    head = b"\xef\xbb\xbf# measured on a plate\r\n\r\nalpha_deg, c_d ,c_l\r\n"
    path.write_bytes(head + b"0,0.1,0\r\n30,1,1\r\n\r\n60,1.5,1\r\n90,2,0\r\n")
    table = load_table(path)
    assert table.alpha_deg == (0.0, 30.0, 60.0, 90.0)
    assert table.c_d == (0.1, 1.0, 1.5, 2.0)


GOOD = "0,0,0.1\n30,1,0.5\n60,0.9,1.5\n90,0,2\n"
HEADER = "alpha_deg,c_l,c_d\n"
FAULTS = [
    ("", "bad.csv row 1 = '': the file holds no table"),
    ("# nothing but a comment\n", "the file holds no table"),
    ("alpha_deg,c_l\n0,0\n", "bad.csv row 1, column C_D = 'alpha_deg,c_l': the column is missing"),
    (GOOD, "row 1 = '0,0,0.1': holds numbers, but the first row of the table must name the columns"),
    ("alpha_deg,c_l,c_d,CD\n0,0,0.1,0\n", "row 1, column 4 = 'CD': appears twice (above as c_d)"),
    ("alpha [rad],c_l,c_d\n0,0,0.1\n", "row 1, column 1 = 'rad': is not the expected unit, [deg]"),
    (HEADER + "0,0,0.1\n30,1\n", "bad.csv row 3 = '30,1': has 2 cells, but the header names 3 columns"),
    (HEADER + GOOD.replace("0.5", "half"), "row 3, column c_d = 'half': is not a number"),
    (HEADER + GOOD.replace("0.5", " "), "row 3, column c_d = '': is empty"),
    (HEADER + GOOD.replace("0.9", "nan"), "row 4, column c_l = 'nan': has no value"),
    (HEADER + GOOD.replace("0.9", "-inf"), "row 4, column c_l = -inf: must be finite"),
    (
        HEADER + GOOD.replace("60", "30"),
        "row 3, column alpha_deg = 30.0: also stands in row 4, and a model needs one curve (1 of 3 angles repeats)",
    ),
    (HEADER + GOOD.replace("60", "20"), "row 4, column alpha_deg = 20.0: must be above the 30 before it; sort"),
    (HEADER + GOOD.replace("90", "190"), "row 5, column alpha_deg = 190.0: must lie between -180 and 180 degrees"),
    (HEADER + GOOD.replace("1.5", "-1.5"), "row 4, column c_d = -1.5: must be > 0: every wing has drag"),
    (HEADER + "0,0,0.1\n45,1,1\n90,0,2\n", "rows = 3: must be at least 4 for a curve"),
    (HEADER, "row 1 = '': has no row of numbers"),
    (HEADER + GOOD.replace("90", "80"), "row 5, column alpha_deg = 80.0: the table must reach at least 90 degrees"),
    (HEADER + GOOD.replace("0,0,0.1", "2,0,0.1"), "row 2, column alpha_deg = 2.0: the table must begin at 0"),
    (
        HEADER + "0,0,0.1\n0.5,1,0.5\n1,0.9,1.5\n1.571,0,2\n",
        "row 5, column alpha_deg = 1.571: is the largest of 4 angles, which looks like a sweep in radians",
    ),
    (
        HEADER + "-20,-0.5,0.4\n" + GOOD,
        "row 2, column alpha_deg = -20.0: is negative, and the extension mirrored would ignore it; "
        "drop the negative rows, or add rows down to -90 and use signed",
    ),
]


@pytest.mark.parametrize(("text", "message"), FAULTS)
def test_faults_name_row_and_column(tmp_path, text, message):
    path = tmp_path / "bad.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InvalidInputError, match=re.escape(message)):
        load_table(path)


def test_every_fault_of_a_table_is_told_at_once(tmp_path):
    path = tmp_path / "bad.csv"
    path.write_text(HEADER + "0,0,-0.1\n# a note\n30,x,0.5\n20,0.9,nan\n", encoding="utf-8")
    with pytest.raises(InvalidInputError) as caught:
        load_table(path, "sideways", 9.0)
    places = [fault.where for fault in caught.value.faults]
    assert sorted(places) == sorted(
        [
            "extension",
            "blend_width_deg",
            "bad.csv row 2, column c_d",
            "bad.csv row 4, column c_l",
            "bad.csv row 5, column c_d",
            "bad.csv row 5, column alpha_deg",
            "rows",
        ]
    )


@pytest.mark.parametrize(
    ("first", "extension", "fix"),
    [
        (0, "signed", "use mirrored"),
        (0, "signed-drag", "has no effect on a table; use mirrored"),
        (-45, "signed", "add rows down to -90, or drop the negative rows and use mirrored"),
        (-45, "mirrored", "drop the negative rows, or add rows down to -90 and use signed"),
        (-90, "mirrored", "drop the negative rows, or use signed"),
        (-90, "clipped-drag", "drop the negative rows, or use signed"),
        (-90, "signed-drag", "drop the negative rows and use mirrored, or use signed"),
    ],
)
def test_extensions_that_do_not_fit_the_range(tmp_path, first, extension, fix):
    path = write(tmp_path / "bad.csv", polar_rows(np.arange(first, 91, 5.0)))
    with pytest.raises(
        InvalidInputError, match=re.escape(f"bad.csv row 2, column alpha_deg = {first:.1f}")
    ) as caught:
        load_table(path, extension)
    assert str(caught.value).endswith(fix)


def test_whole_turn_table_must_close(tmp_path):
    rows = polar_rows(np.arange(-180, 181, 5.0))
    rows[-1, 2] += 0.01
    with pytest.raises(InvalidInputError, match=r"row 74, column c_d = 0\.2\d+: must equal the .* of -180"):
        load_table(write(tmp_path / "bad.csv", rows))


def test_whole_turn_whose_ends_differ_by_rounding_is_closed():
    angles = np.arange(-180, 181, 10.0)
    alpha = np.deg2rad(angles)
    lift, drag = np.sin(2 * alpha), 1.02 - np.cos(2 * alpha)
    assert lift[0] != lift[-1]
    table = TableCoefficients("plate", angles, lift, drag)
    assert table.c_l[0] == table.c_l[-1] == lift[0]
    either = value_slope_curvature(table, np.array([-math.pi, math.pi]))
    np.testing.assert_allclose(*np.array(either)[..., :2].swapaxes(0, 1), rtol=0, atol=1e-10)


def test_falling_angles_and_two_sweeps_are_one_fault():
    rows = polar_rows(np.arange(0, 91, 5.0))
    for order, fix in ((slice(None, None, -1), "reverse the order"), (np.r_[0:19:2, 17:0:-2], "keep one")):
        with pytest.raises(InvalidInputError, match=fix) as caught:
            TableCoefficients("bad", *rows[order].T)
        assert len(caught.value.faults) == 1


def test_files_that_cannot_be_read(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        load_coefficients(str(tmp_path / "missing.csv"))
    folder = tmp_path / "folder.csv"
    folder.mkdir()
    with pytest.raises(FileError, match="it is not a file"):
        load_table(folder)
    binary = tmp_path / "binary.csv"
    binary.write_bytes(b"\xff\xfe\x00\x01")
    with pytest.raises(FileError, match="is not UTF-8 text"):
        load_table(binary)


def test_arrays_are_checked_as_files_are():
    with pytest.raises(InvalidInputError) as caught:
        TableCoefficients("bad", (0, 30, 60), (0, 1, 1, 0), (0.1, "x", 1.0))
    assert [fault.where for fault in caught.value.faults] == ["c_d[1]", "c_l"]
    with pytest.raises(InvalidInputError, match=r"alpha_deg\[2\] = 20.0: must be above the 30 before it"):
        TableCoefficients("bad", (0, 30, 20, 90), (0, 1, 1, 0), (0.1, 1, 1, 1))
