"""Tables that end at the stall, completed by Viterna's rule (Viterna and Janetzke 1982, NASA TM-82944)."""

import math
from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.places import ROOT
from wingbeat.aero import TableCoefficients, load_coefficients
from wingbeat.cli import main

OWN, CASES = Path(__file__).parent / "polars", ROOT / "tests/cases/polars"


def completed(path):
    wing = load_coefficients(str(path), "viterna")
    assert isinstance(wing, TableCoefficients)
    return wing


def rule(angle_deg, stall_deg, lift, drag, largest):
    """Return C_L and C_D as in the report's equations, of the coefficients A1, A2, B1, B2."""
    a, s = math.radians(angle_deg), math.radians(stall_deg)
    a1 = largest / 2
    a2 = (lift - largest * math.sin(s) * math.cos(s)) * math.sin(s) / math.cos(s) ** 2
    b2 = (drag - largest * math.sin(s) ** 2) / math.cos(s)
    return a1 * math.sin(2 * a) + a2 * math.cos(a) ** 2 / math.sin(a), largest * math.sin(a) ** 2 + b2 * math.cos(a)


@pytest.mark.parametrize("head", ["", "# aspect_ratio = 6\n"])
def test_a_polar_to_16_degrees_is_completed(head, tmp_path):
    text = (CASES / "to_16_deg_c_l.csv").read_text()
    (tmp_path / "a.csv").write_text(head + text)
    wing = completed(tmp_path / "a.csv")
    largest = 1.11 + 0.018 * 6 if head else 2.01
    rows = np.loadtxt(CASES / "to_16_deg_c_l.csv", delimiter=",", skiprows=1)
    assert wing.lift(np.radians(rows[:, 0])) == pytest.approx(rows[:, 1], abs=1e-9)
    assert wing.drag(np.radians(rows[:, 0])) == pytest.approx(rows[:, 2], abs=1e-9)
    for angle in (20.0, 45.0, 70.0, 89.0):
        lift, drag = rule(angle, 16.0, rows[-1, 1], rows[-1, 2], largest)
        assert float(wing.lift(math.radians(angle))) == pytest.approx(lift, abs=4e-3)
        assert float(wing.drag(math.radians(angle))) == pytest.approx(drag, abs=4e-3)
        assert float(wing.lift(math.radians(180 - angle))) == pytest.approx(-lift, abs=4e-3)
        below = rule(angle, 8.0, -rows[0, 1], rows[0, 2], largest)
        assert float(wing.lift(math.radians(-angle))) == pytest.approx(-below[0], abs=4e-3)
        assert float(wing.drag(math.radians(angle - 180))) == pytest.approx(below[1], abs=4e-3)
    assert float(wing.drag(math.pi / 2)) == pytest.approx(largest)
    assert f"with C_D {largest:.3g} at 90 degrees" in wing.notes[-1]


def test_lift_drag_and_moment_are_smooth_all_around():
    """Values and slopes are continuous at every angle, at the stall, at 90 and at 180 degrees too."""
    wing = completed(OWN / "xfoil_plate_re50k.pol")
    turn, step = np.linspace(-np.pi, np.pi, 3601), 1e-6
    for curve in (wing.lift, wing.drag, wing.moment):
        left, here, right = (curve(turn + shift) for shift in (-step, 0.0, step))
        assert np.abs(right - left).max() < 2 * step * 100
        assert np.abs(right - 2 * here + left).max() < 1e-7
    assert wing.drag(turn).min() > 0


def test_a_symmetric_table_from_0_gets_its_mirror_image(tmp_path):
    (tmp_path / "a.csv").write_text("alpha,cl,cd\n0,0,0.02\n4,0.4,0.03\n8,0.7,0.05\n12,0.72,0.12\n")
    wing = completed(tmp_path / "a.csv")
    turn = np.radians(np.linspace(0, 180, 91))
    assert wing.lift(-turn) == pytest.approx(-wing.lift(turn), abs=2e-3)
    assert wing.drag(-turn) == pytest.approx(wing.drag(turn), abs=2e-3)
    assert "negative angles are the mirror image of the positive ones" in wing.notes


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (
            "0,0.3,0.02\n4,0.7,0.03\n8,1,0.05\n12,1.02,0.12",
            "the wing has lift at 0 degrees; viterna needs the stall at",
        ),
        (
            "-1,0.2,0.02\n4,0.7,0.03\n8,1,0.05\n12,1.02,0.12",
            "lift is positive there; viterna needs the stall with negat",
        ),
        ("0,0,0.02\n30,0.9,0.6\n60,0.8,1.5\n90,0,2", "reaches 90 degrees, and viterna completes tables that stall"),
    ],
)
def test_what_the_rule_cannot_complete_is_refused(rows, words, tmp_path):
    (tmp_path / "a.csv").write_text(f"alpha,cl,cd\n{rows}\n")
    with pytest.raises(wb.InvalidInputError, match=words):
        completed(tmp_path / "a.csv")


def test_the_choice_is_stated_and_models_refuse_it(capsys):
    assert (
        main(["polar", str(OWN / "xfoil_naca0012_re50k.pol"), "--extension", "viterna", "--alpha", "90", "--csv"])
        == 0
    )
    told = capsys.readouterr()
    assert "completed by Viterna's rule beyond the table, with C_D 2.01 at 90 degrees, of a section" in told.err
    assert told.out.splitlines()[1].startswith("90.0,")
    assert main(["polar", "su-fan", "--extension", "viterna"]) == 2
    assert "this model needs no completion; use one of mirrored" in capsys.readouterr().err
    assert main(["polar", str(CASES / "to_16_deg_c_l.csv")]) == 2
    assert "or complete it by Viterna's rule: --extension viterna" in capsys.readouterr().err


def test_a_table_that_ends_before_the_stall_is_said(tmp_path):
    (tmp_path / "a.csv").write_text("alpha,cl,cd\n-8,-0.7,0.05\n-4,-0.4,0.03\n0,0,0.02\n4,0.4,0.03\n8,0.7,0.05\n")
    assert "ends before the stall, at 8 degrees" in completed(tmp_path / "a.csv").notes[0]
