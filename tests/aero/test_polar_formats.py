"""Polars as other programs write them: each is read right, or refused with the sentence that helps.

The files of `polars` were written by XFOIL 6.99, XFLR5 6.10.04 and openfast_io 5.0.0. Other forms are documented:
XFLR5 6.61 and JavaFoil by XFLR5's source, AeroDyn by its manual and QBlade's source, QBlade and UIUC by readers.
"""

import re
from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.places import ROOT
from wingbeat.aero import load_coefficients
from wingbeat.experiment.coefficient_table import load_measurements

OWN = Path(__file__).parent / "polars"
CASES = ROOT / "tests/cases/polars"
XFOIL = (OWN / "xfoil_naca0012_re50k.pol").read_text()


def written(tmp_path, text, name="a.txt"):
    path = tmp_path / name
    path.write_text(text)
    return path


def refused(path):
    with pytest.raises(wb.InvalidInputError) as caught:
        load_measurements(path)
    return "\n".join(str(fault) for fault in caught.value.faults)


def table_of(path):
    """Return angle, lift, drag by a plain reader: rows of numbers between others."""
    rows = [re.split(r"[\s,;]+", line.strip()) for line in path.read_text().splitlines()]
    good = [
        [float(cell) for cell in row]
        for row in rows
        if len(row) > 3 and row[1] != "Re" and re.fullmatch(r"-?\d+\.\d+", row[0])
    ]
    return np.array(sorted([row[:3] for row in good]))


@pytest.mark.parametrize("name", ["xfoil.txt", "airfoil_site.csv", "aerodyn.dat"])
def test_files_of_programs_give_their_own_numbers(name):
    table, rows = load_measurements(CASES / name), table_of(CASES / name)
    assert table.alpha_deg == pytest.approx(rows[:, 0])
    assert table.mean["C_L"] == pytest.approx(rows[:, 1])
    assert table.mean["C_D"] == pytest.approx(rows[:, 2])
    assert table.columns()["reynolds"] == pytest.approx(5e4)
    normal = rows[:, 1] * np.cos(np.radians(rows[:, 0])) + rows[:, 2] * np.sin(np.radians(rows[:, 0]))
    if name == "xfoil.txt":  # its moment is -0.05 about the quarter chord
        assert table.mean["C_M"] == pytest.approx(-0.05 + normal / 4)


def test_a_moment_about_the_quarter_chord_becomes_a_centre_of_pressure():
    """AeroDyn's C_M is about the quarter chord; ours about mid-chord, and x_cp = 1/4 - C_M/C_N."""
    wing = load_coefficients(str(CASES / "aerodyn.dat"))
    text = (CASES / "aerodyn.dat").read_text()
    found = re.search(r"(?m)^\s*40\.0+\s+(\S+)\s+(\S+)\s+(\S+)", text)
    assert found is not None
    lift, drag, moment = map(float, found.groups())
    turn = np.radians(40.0)
    normal = lift * np.cos(turn) + drag * np.sin(turn)
    assert float(wing.centre_of_pressure(turn)) == pytest.approx(0.25 - moment / normal, abs=1e-9)
    assert float(wing.moment(turn, about=0.25)) == pytest.approx(moment, abs=1e-9)
    assert wing.used_range_deg == (-180, 180)


def test_moments_of_angles_from_0_to_355_are_turned_with_their_own_angle(tmp_path):
    """The rows are sorted to -180 to 175; the moment of each must be moved by the forces at its own angle."""
    head, _, body = (CASES / "aerodyn.dat").read_text().partition("    -180.00 ")
    rows = np.array([line.split() for line in f"-180 {body}".splitlines()], dtype=float)
    turned = rows[1:]  # -180 degrees repeats 180
    turned[:, 0] %= 360
    turned = turned[np.argsort(turned[:, 0])]
    text = "".join(f"{' '.join(map(str, row))}\n" for row in turned.tolist())
    path = written(tmp_path, head.replace("73   NumAlf", "72   NumAlf") + text, "turned.dat")
    whole, found = load_measurements(CASES / "aerodyn.dat"), load_measurements(path)
    assert "angles from 0 to 355 degrees are read as -180 to 180" in found.notes
    assert found.alpha_deg == pytest.approx(whole.alpha_deg[1:])
    assert found.mean["C_M"] == pytest.approx(whole.mean["C_M"][1:], abs=1e-12)
    at = np.radians(np.arange(-170, 171, 10.0))
    wings = [load_coefficients(str(one)) for one in (CASES / "aerodyn.dat", path)]
    assert wings[1].centre_of_pressure(at) == pytest.approx(wings[0].centre_of_pressure(at), abs=1e-9)


@pytest.mark.parametrize("form", ["xfoil.txt", "aerodyn.dat", "AeroDyn 14", "QBlade"])
def test_exponents_of_fortran_are_read(form, tmp_path):
    """Fortran writes 3.0D-02 for 0.03, which Python does not read."""
    text = {"AeroDyn 14": AERODYN14, "QBlade": QBLADE}.get(form) or (CASES / form).read_text()
    rows = r"(?m)^ *-?\d+(?:\.\d+)?(?: +-?\d+\.\d+){3,}"
    spelled = re.sub(rows, lambda row: re.sub(r"(-?\d+\.\d+)", r"\1D+00", row[0]), text)
    assert spelled.count("D+00") > 20
    spelled = re.sub(r"0\.050 +e 6", "0.050D+06", spelled)
    name = "a.plr" if form == "QBlade" else "a.txt"
    plain, found = (load_measurements(written(tmp_path, one, name)) for one in (text, spelled))
    assert found.alpha_deg == pytest.approx(plain.alpha_deg)
    np.testing.assert_array_equal(found.columns().get("reynolds"), plain.columns().get("reynolds"))
    for quantity in plain.mean:
        assert found.mean[quantity] == pytest.approx(plain.mean[quantity])


def test_a_circle_from_0_to_355_is_closed_and_used_as_it_is():
    wing = load_coefficients(str(CASES / "full_circle_0_355.csv"))
    rows = np.loadtxt(CASES / "full_circle_0_355.csv", delimiter=",", skiprows=1)
    assert wing.lift(np.radians(rows[:, 0])) == pytest.approx(rows[:, 1], abs=1e-12)
    assert wing.drag(np.radians(rows[:, 0])) == pytest.approx(rows[:, 2], abs=1e-12)
    assert "angles from 0 to 355 degrees are read as -180 to 180" in vars(wing)["notes"]


def test_xfoil_sweeps_are_sorted_and_what_did_not_converge_is_said():
    table = load_measurements(OWN / "xfoil_naca0012_re50k.pol")
    assert table.alpha_deg.tolist() == [*range(-6, 10), 11, 12]
    assert table.mean["C_L"][7] == -0.0284  # at 1 degree: XFOIL's own, a laminar bubble
    said = " | ".join(table.notes)
    assert "XFOIL: NACA 0012, Re 50000, Ncrit 9" in said
    assert "no row between 9 and 11 degrees (points that did not converge are left out)" in said
    assert "sorted by angle" in said
    plate = load_measurements(OWN / "xfoil_plate_re50k.pol")
    assert "rows that repeat one are left out, at 0.000 degrees" in " | ".join(plate.notes)


@pytest.mark.parametrize("name", ["xflr5_610.txt", "xflr5_610.csv"])
def test_xflr5_sorts_the_rows_of_xfoil_and_writes_ten_numbers_below_ten_names(name):
    """XFLR5 6.10.04's own export of XFOIL's rows: the same numbers, by angle, as text or with commas."""
    table, rows = load_measurements(OWN / name), load_measurements(OWN / "xfoil_naca0012_re50k.pol")
    assert table.alpha_deg == pytest.approx(rows.alpha_deg)
    for quantity in ("C_L", "C_D", "C_M"):
        assert table.mean[quantity] == pytest.approx(rows.mean[quantity], abs=2e-4), quantity
    assert table.columns()["reynolds"] == pytest.approx(5e4)
    assert "XFLR5: NACA 0012, Re 50000, Ncrit 9" in " | ".join(table.notes)


def test_a_polar_of_one_angle_is_refused():
    """XFLR5's type 4 holds one angle at many Reynolds numbers."""
    said = refused(OWN / "xflr5_610_type4.txt")
    assert "is a polar of one angle at several Reynolds numbers (type 4); export polars of type 1" in said


def test_a_part_polar_whose_ends_openfast_io_moved_is_refused():
    """openfast_io 5.0.0 writes the rows of -10 and 12 degrees at -180 and 180, both with the lift of 12."""
    said = refused(OWN / "openfast_io_part.dat")
    assert "row 55 = -180.0: is 174 degrees from the row beside it: was its angle changed?" in said
    assert "row 64 = 180.0: is 170 degrees" in said
    assert "drop the two rows, or export again" in said


def test_a_circle_that_openfast_io_wrote_for_two_re_is_read():
    table = load_measurements(OWN / "openfast_io_two_re.dat")
    assert sorted(set(table.columns()["reynolds"])) == pytest.approx([5e4, 2e5])
    assert set(table.alpha_deg[:27]) >= {-180.0, -16.0, 0.0, 16.0, 180.0}
    assert " | ".join(table.notes).count("from millions") == 2


def test_a_cylinder_with_three_rows_is_no_moved_polar(tmp_path):
    """NREL's tables of cylinders have rows at -180, 0 and 180 degrees alone."""
    text = (CASES / "aerodyn.dat").read_text()
    head = re.sub(r"(?m)^\s*\d+(\s+NumAlf)", r"3\1", text[: text.index("\n", text.index("NumAlf"))])
    rows = "".join(f"{angle} 0.0 0.5 0.0\n" for angle in ("-180.0", "0.0", "180.0"))
    assert load_measurements(written(tmp_path, f"{head}\n{rows}", "cylinder.dat")).mean["C_D"].tolist() == [0.5] * 3


def test_rows_behind_a_second_visc_are_refused():
    said = refused(OWN / "xfoil_viscosity_switched_off.pol")
    assert "row 16" in said
    assert "is a row without drag (3 of 6): viscosity was off; a second VISC switches it off" in said


def test_re_of_type_2_falls_with_lift():
    table = load_measurements(OWN / "xfoil_naca4412_type2.pol")
    assert table.reynolds == pytest.approx(2e5 / np.sqrt(table.mean["C_L"]), rel=1e-6)
    assert table.alpha_deg.tolist() == [0, 2, 4, 6, 8]
    third = XFOIL.replace(" 1 1 Reynolds number fixed  ", " 3 1 Reynolds number ~ 1/CL ")
    assert "3 1 Reynolds" in third


def test_several_polars_in_one_file_become_one_table_with_re(tmp_path):
    table = load_measurements(OWN / "xfoil_naca4412_two_re.pol")
    assert (len(table.alpha_deg), sorted(set(table.columns()["reynolds"]))) == (23, [1e5, 2e5])
    assert table.mean["C_L"][table.alpha_deg == 10].tolist() == [1.3736, 1.3726]
    with pytest.raises(wb.InvalidInputError, match=r"\(2 polars do not\); complete each polar by Viterna's rule"):
        load_coefficients(str(OWN / "xfoil_naca4412_two_re.pol"))


HEAD = """xflr5 v6.61

 Calculated polar for: E63

 1 1 Reynolds number fixed          Mach number fixed

 xtrf =   1.000 (top)        1.000 (bottom)
 Mach =   0.000     Re =     0.050 e 6     Ncrit =   7.000

  alpha     CL        CD       CDp       Cm    Top Xtr Bot Xtr   Cpmin    Chinge    XCp
 ------- -------- --------- --------- -------- ------- ------- -------- --------- ---------
"""
ROWS = [(a, 0.1 * a + 0.3, 0.03 + 1e-4 * a * a, 0.02, -0.05) for a in range(-4, 9, 2)]
XFLR5 = HEAD + "".join(
    f" {a:7.3f}  {cl:7.4f}  {cd:8.5f}  {cp:8.5f}  {cm:7.4f}  1.0000  0.0225  -1.5489   0.0000   0.0000   0.0000   "
    "0.2964\n"
    for a, cl, cd, cp, cm in ROWS
)
UIUC = """Airfoil: E387 (E)
Builder: Builder
Comment: Clean
Average Reynolds #:
  61000
Number of angles of attack:
  7
   alpha      Cl       Cd      Cd1     Cd2
""" + "".join(f" {a:6.2f} {cl:7.3f} {cd:8.4f} {cd + 0.001:8.4f} {cd - 0.001:8.4f}\n" for a, cl, cd, _, _ in ROWS)
UIUC += "Tabulated from data in file R123.DAT\n"
AERODYN14 = """AeroDyn airfoil file Created with QBlade Compatible with AeroDyn v13.0.
Polar "P" on Foil "F" :: generated by QBlade
1              Number of airfoil tables in this file
0.05           Table ID parameter
8.00           Stall angle (deg)
0              No longer used, enter zero
0              No longer used, enter zero
0              No longer used, enter zero
-3.00          Angle of attack for zero Cn for linear Cn curve (deg)
5.70000        Cn slope for zero lift for linear Cn curve (1/rad)
1.1000         Cn at stall value for positive angle of attack for linear Cn curve
-0.1000        Cn at stall value for negative angle of attack for linear Cn curve
0.00           Angle of attack for minimum CD (deg)
0.0300         Minimum CD value
""" + "".join(f"{a:10.3f}{cl:10.6f}{cd:10.6f}{cm:10.6f}\n" for a, cl, cd, _, cm in ROWS)
QBLADE = (
    "P POLARNAME - name\nF FOILNAME - foil\n12 THICKNESS - %\n0 ISDECOMPOSED - no\n50000 100000 REYNOLDS - list\n"
)
QBLADE += "".join(f"{a} {cl:.4f} {cd:.4f} {cm} {cl + 0.1:.4f} {cd:.4f} {cm}\n" for a, cl, cd, _, cm in ROWS)
JAVAFOIL = "E63\n\nRe = 50000\nα\tCl\tCd\tCm 0.25\tT.U.\tT.L.\n[°]\t[-]\t[-]\t[-]\t[-]\t[-]\n"
JAVAFOIL += "".join(f"{a:.1f}\t{cl:.3f}\t{cd:.5f}\t{cm}\t0.5\t0.9\n" for a, cl, cd, _, cm in ROWS)
FORMS = {
    "XFLR5": XFLR5,
    "UIUC": UIUC,
    "AeroDyn 14": AERODYN14,
    "JavaFoil": JAVAFOIL,
    "commas": JAVAFOIL.replace(".", ","),
}
FORMS["commas"] = FORMS["commas"].replace("T,U,", "T.U.").replace("T,L,", "T.L.")


@pytest.mark.parametrize("form", FORMS)
def test_documented_forms(form, tmp_path):
    table = load_measurements(written(tmp_path, FORMS[form]))
    rows = np.array(ROWS)
    assert table.alpha_deg == pytest.approx(rows[:, 0])
    assert table.mean["C_L"] == pytest.approx(rows[:, 1], abs=1e-3)
    assert table.mean["C_D"] == pytest.approx(rows[:, 2], abs=1e-4)
    if form != "AeroDyn 14":
        assert table.columns()["reynolds"][0] == (61e3 if form == "UIUC" else 5e4)
    if form in ("XFLR5", "AeroDyn 14"):
        turn = np.radians(rows[:, 0])
        normal = rows[:, 1] * np.cos(turn) + rows[:, 2] * np.sin(turn)
        assert table.mean["C_M"] == pytest.approx(-0.05 + normal / 4, abs=1e-3)


def test_what_a_form_hides_is_said(tmp_path):
    said = " | ".join(load_measurements(written(tmp_path, XFLR5)).notes)
    assert (
        "the head names 10 columns and the rows have 12 numbers, as XFLR5 writes them; those up to C_M are read"
        in said
    )
    said = " | ".join(load_measurements(written(tmp_path, AERODYN14)).notes)
    assert "the table's ID is 0.05; some programs write Re in millions there, which is not read" in said
    first, rows = AERODYN14[: AERODYN14.index("    -4.000")], AERODYN14[AERODYN14.index("    -4.000") :]
    head = first.replace("1              Number of", "2              Number of")
    head = head.replace("0.05           Table ID parameter", "0.05           Reynolds number in millions")
    second = head[head.index("0.05 ") :].replace("0.05 ", "0.1  ")
    table = load_measurements(written(tmp_path, f"{head}{rows}EOT\n{second}{rows}"))
    assert (len(table.alpha_deg), set(table.columns()["reynolds"])) == (14, {5e4, 1e5})
    assert "AeroDyn table: Re 50000, 100000, from millions" in table.notes
    both = load_measurements(written(tmp_path, QBLADE, "a.plr"))
    assert (len(both.alpha_deg), set(both.columns()["reynolds"])) == (14, {5e4, 1e5})
    lift = UIUC.replace("Cl       Cd      Cd1     Cd2", "Cl       Cm")
    said = refused(written(tmp_path, re.sub(r"(?m)(^ +-?\d\S+ +\S+ +\S+) .*$", r"\1", lift)))
    assert "names lift, but no drag; this is a lift file: its third column is the moment" in said
    csv = HEAD.replace(
        "  alpha     CL        CD       CDp       Cm    Top Xtr Bot Xtr   Cpmin    Chinge    XCp    ", ""
    )
    csv = csv.splitlines()[:-2]
    csv = "\n".join([*csv, "alpha,CL,CD,CDp,Cm,Top Xtr,Bot Xtr,Cpmin,Chinge,XCp"])
    csv += "".join(f"\n{a:7.3f},{cl:7.4f},{cd:8.5f},0.02,{cm},1.0,0.02,-1.5,0.0,0.3" for a, cl, cd, _, cm in ROWS)
    assert load_measurements(written(tmp_path, csv, "a.csv")).mean["C_D"] == pytest.approx([r[2] for r in ROWS])


LINES = XFOIL.splitlines()
BROKEN = {
    "a row cut short": (XFOIL.rstrip()[:-40], "has 4 cells, but the other rows have 9|has 5 cells, but the other"),
    "a cell that is no number": (XFOIL.replace("0.4478", "******"), "has a cell that is not a number"),
    "no names": (XFOIL.replace("alpha    CL ", ""), "no line names the columns"),
    "no rows": ("\n".join(LINES[:12]), "has no row of numbers below it; XFOIL"),
    "a line of other text": (
        XFOIL + "Segmentation fault\n",
        "neither a row of numbers nor a line of a polar's head",
    ),
    "text between rows": (
        XFOIL.replace("   3.000   0.4478", "oops\n   3.000   0.4478"),
        "row of numbers in a polar's head",
    ),
    "no viscosity": (XFOIL.replace("0.050 e 6", "0.000 e 6"), "a polar without viscosity"),
    "NumAlf": ((CASES / "aerodyn.dat").read_text().replace("73   NumAlf", "74   NumAlf"), "states 1 rows more"),
    "Re in units": ((CASES / "aerodyn.dat").read_text().replace("0.050   Re", "50000   Re"), "write 0.05"),
    "points in Re": (XFOIL.replace("0.050 e 6", "50.000.000"), "is no Reynolds number; write plain digits"),
    "points in Mach": (XFOIL.replace("Mach =   0.000", "Mach =   0.0.0"), "is not a number; write one number"),
    "points in Ncrit": (XFOIL.replace("Ncrit =   9.000", "Ncrit =   9.0.0"), "is not a number; write one number"),
    "comma in Re": (
        (CASES / "airfoil_site.csv").read_text().replace("number,50000", "number,50,000"),
        "two numbers",
    ),
}


@pytest.mark.parametrize("kind", BROKEN)
def test_a_broken_file_is_refused_in_words(kind, tmp_path):
    text, words = BROKEN[kind]
    assert re.search(words, refused(written(tmp_path, text)))


def test_a_file_is_known_by_its_content_whatever_its_name(tmp_path):
    for name in ("polar", "a.dat", "b.pol"):
        path = written(tmp_path, (CASES / "aerodyn.dat").read_text(), name)
        assert load_coefficients(str(path)).reynolds_range == (5e4, 5e4)
    with pytest.raises(wb.FileError, match="no such file"):
        load_coefficients(str(tmp_path / "missing.dat"))


def commas(text):
    """Return a text as a program writes it whose numbers follow a German or French locale."""
    return re.sub(r"(?<=\d)\.(?=\d)", ",", text)


@pytest.mark.parametrize(
    "form", ["XFOIL", "XFOIL, head with points", "two polars", *FORMS, "QBlade", "xflr5.csv ;"]
)
def test_decimal_commas_throughout_are_read_as_points_and_said(form, tmp_path):
    """JavaFoil follows the locale of its machine; spreadsheets save the others so."""
    texts = {"XFOIL": XFOIL, "XFOIL, head with points": XFOIL, "QBlade": QBLADE} | FORMS
    texts["two polars"] = (OWN / "xfoil_naca4412_two_re.pol").read_text()
    texts["xflr5.csv ;"] = (OWN / "xflr5_610.csv").read_text().replace(",", ";")
    lines = texts[form].splitlines(keepends=True)
    keep = 12 if form == "XFOIL, head with points" else 0
    known = load_measurements(written(tmp_path, texts[form]))
    found = load_measurements(written(tmp_path, "".join([*lines[:keep], commas("".join(lines[keep:]))])))
    assert "decimal commas are read as points" in found.notes
    for name in known.columns():
        assert found.columns()[name] == pytest.approx(known.columns()[name], nan_ok=True), name


UNSURE = {
    "one comma": (XFOIL.replace("0.4478", "0,4478"), "'0,4478': has a comma, and 18 rows have decimal points"),
    "some rows": (
        "\n".join(commas(line) if k % 2 else line for k, line in enumerate(XFOIL.splitlines())),
        "has a comma, and 9 rows have decimal points",
    ),
    "two readings": (
        re.sub(r"(?m)^( +-?\d.*)", lambda row: re.sub(r"\d+\.\d+", "1,234", row[1]), XFOIL),
        "two ways",
    ),
    "commas between": (commas((OWN / "xflr5_610.csv").read_text()), "has commas between columns and in numbers"),
    "Re": (
        commas(XFOIL).replace("0,050 e 6", "50,000"),
        "'Re =     50,000': has a comma, which can mean two numbers",
    ),
    "Re of UIUC": (commas(UIUC).replace("  61000", "  61,000"), "has a comma, which can mean two numbers"),
}


@pytest.mark.parametrize("kind", UNSURE)
def test_doubtful_commas_are_refused_in_one_sentence(kind, tmp_path):
    text, words = UNSURE[kind]
    said = refused(written(tmp_path, text))
    assert words in said
    assert "\n" not in said


MUTILATIONS = 300


@pytest.mark.slow
def test_mutilated_files_give_no_traceback_and_no_wrong_number_in_silence(tmp_path):
    """Lines lost, doubled, moved; cells lost, doubled, spoilt, with other signs for the point; files cut anywhere.

    Whatever is read is one of the rows that were written, or a note or a refusal says what was changed.
    """
    random = np.random.default_rng(56)
    sources = [*sorted(CASES.glob("*")), *sorted(OWN.glob("*.pol"))]
    texts = {f"{p.stem}{p.suffix}": p.read_text() for p in sources} | {f"{n}.txt": t for n, t in FORMS.items()}
    texts["qblade.plr"] = QBLADE
    good = {}
    for name, text in texts.items():
        try:
            good[name] = load_measurements(written(tmp_path, text, name))
        except wb.WingbeatError:
            good[name] = None
    read = 0
    for k in range(MUTILATIONS):
        name = list(texts)[k % len(texts)]
        lines = texts[name].splitlines()
        kind, at = k // len(texts) % 9, int(random.integers(len(lines)))
        cells = re.split(r"([\s,;]+)", lines[at])
        cell = int(random.integers(len(cells)))
        if kind == 0:
            del lines[at]
        elif kind == 1:
            lines.insert(at, lines[at])
        elif kind == 2:
            lines.insert(int(random.integers(len(lines))), lines.pop(at))
        elif kind == 3:
            del cells[cell]
            lines[at] = "".join(cells)
        elif kind == 4:
            lines[at] += " " + cells[cell]
        elif kind == 5:
            cells[cell] = "".join(random.permutation(list("x#?,;é"))[:3])
            lines[at] = "".join(cells)
        elif kind == 6:
            lines[at] = lines[at].replace(".", ",")
        elif kind == 7:
            lines = "\n".join(lines)[: int(random.integers(1, len(texts[name])))].splitlines()
        else:
            lines[at] = lines[at].replace(".", "")
        path = written(tmp_path, "\n".join(lines) + "\n" * (kind != 7), name)
        try:
            found = load_measurements(path)
        except wb.WingbeatError:
            continue
        read += 1
        known = good[name]
        if known is None:  # the cut left out what was wrong
            assert kind == 7, (name, kind, at)
            continue
        rows = {
            tuple(row) for row in np.column_stack([known.alpha_deg, known.mean["C_L"], known.mean["C_D"]]).round(9)
        }
        mine = {
            tuple(row) for row in np.column_stack([found.alpha_deg, found.mean["C_L"], found.mean["C_D"]]).round(9)
        }
        new = mine - rows if "is it whole?" not in " ".join(found.notes) else set()
        assert not new, (k, name, kind, at, lines[at : at + 1], new)
        fixed = "whether Re is fixed" not in " ".join(found.notes)
        if known.reynolds is not None and found.reynolds is not None and fixed:
            stated = found.reynolds[np.isfinite(found.reynolds)]
            assert set(stated.round()) <= set(known.reynolds.round()), (k, name, kind, at)
    assert read > 60
