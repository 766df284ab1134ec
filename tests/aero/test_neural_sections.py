"""Polars of sections by NeuralFoil 0.3.3: near XFOIL where it is confident; what it does not know is left out."""

import json
import shlex
import sys
from pathlib import Path

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.aero import load_coefficients
from wingbeat.aero.neural_sections import section_coordinates, section_polars
from wingbeat.cli.app import main

OWN = Path(__file__).parent / "polars"


def test_the_outline_of_naca_digits_is_that_of_their_definition():
    name, outline = section_coordinates("NACA 4412")
    assert name == "NACA 4412"
    upper = outline[: int(np.argmin(outline[:, 0])) + 1][::-1]
    # Abbott and von Doenhoff 1959, ordinates of NACA 4412.
    assert np.interp(0.3, *upper.T) == pytest.approx(0.0976, abs=2e-4)
    assert np.interp(0.1, *upper.T) == pytest.approx(0.0659, abs=3e-4)
    assert outline[:, 1].min() == pytest.approx(-0.0288, abs=3e-4)
    assert float(section_coordinates("plate0.04")[1][:, 1].max()) == pytest.approx(0.02)


def test_coordinates_in_both_orders_are_one_section(tmp_path):
    _, outline = section_coordinates("4412")
    middle = int(np.argmin(outline[:, 0]))
    upper, lower = outline[: middle + 1][::-1], outline[middle:]
    lines = {
        "selig": ["NACA 4412", *(f"{x:.7f} {y:.7f}" for x, y in outline)],
        "lednicer": [
            *("NACA 4412", f"{len(upper)}. {len(lower)}.", ""),
            *(f"{x:.7f} {y:.7f}" for x, y in upper),
            "",
            *(f"{x:.7f} {y:.7f}" for x, y in lower),
        ],
        "per_cent": ["NACA 4412", *(f"{100 * x:.5f} {100 * y:.5f}" for x, y in outline)],
        "half": ["NACA 4412", *(f"{x:.7f} {y:.7f}" for x, y in upper)],
        "broken": ["NACA 4412", *(f"{x:.7f} {y:.7f}" for x, y in outline), "the end"],
    }
    for kind, text in lines.items():
        (tmp_path / f"{kind}.dat").write_text("\n".join(text) + "\n")
    expected = section_coordinates(str(tmp_path / "selig.dat"))
    # NeuralFoil's own reader takes the counts of the second order for a point: C_L -67, C_D 1e104.
    found = section_coordinates(str(tmp_path / "lednicer.dat"))
    assert found[0] == expected[0] == "NACA 4412"
    np.testing.assert_allclose(found[1], expected[1], atol=1e-6)
    for kind, part in (
        ("per_cent", "are these per cent"),
        ("half", "does not run from the trailing edge"),
        ("broken", "is no pair of coordinates"),
    ):
        with pytest.raises(wb.InvalidInputError, match=part):
            section_coordinates(str(tmp_path / f"{kind}.dat"))


def test_where_it_is_confident_it_is_near_xfoil():
    xfoil = load_coefficients(OWN / "xfoil_naca4412_re100000.pol", "viterna")
    title, (found,) = section_polars("naca4412", [1e5])
    sure = (found.confidence > 0.95) & (np.abs(found.alpha_deg - 1) <= 8)
    turn = np.radians(found.alpha_deg[sure])
    assert title == "NACA 4412"
    assert np.sqrt(np.mean((found.lift[sure] - xfoil.lift(turn)) ** 2)) < 0.05
    assert np.sqrt(np.mean(np.log(found.drag[sure] / xfoil.drag(turn)) ** 2)) < 0.15


def test_what_it_does_not_know_is_left_out(capsys, tmp_path):
    # A plate with blunt ends, as it was measured by Su et al.: its noses are round.
    x = 0.5 * (1 - np.cos(np.linspace(0, np.pi, 101)))
    sides = [f"{a:.6f} 0.020000" for a in x[::-1]] + [f"{a:.6f} -0.020000" for a in x]
    blunt = tmp_path / "blunt.dat"
    blunt.write_text("\n".join(["plate", *sides]) + "\n")
    assert main(["polar", "--section", str(blunt), "--re", "3e4"]) == 2
    assert "has a confidence of 0.5 or more at 0 of 61 angles only" in capsys.readouterr().err
    for _, (found,) in (section_polars(name, [5e4]) for name in ("naca0012", "plate0.04")):
        assert found.confidence[np.abs(found.alpha_deg) >= 29].max() < 0.1
        assert not found.kept[np.abs(found.alpha_deg) >= 29].any()
        assert found.confidence[found.kept].min() >= 0.5


def test_a_section_becomes_a_family_in_two_commands(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(shlex.split("polar --section naca0012 --re 2e4 5e4 1e5 -o family.csv")) == 0
    told = capsys.readouterr().err
    assert "warning: NACA 0012 at Re 50000: left out below a confidence of 0.5: beyond" in told
    assert "rows have a confidence below 0.9, the least" in told
    head = Path("family.csv").read_text().splitlines()
    assert head[:2] == ["# NACA 0012 by NeuralFoil, section", "# aspect_ratio = inf"]
    assert head[2] == "alpha_deg,reynolds,C_L,C_D,C_M,x_cp,analysis_confidence"
    wing = load_coefficients("family.csv", "viterna")
    assert wing.reynolds == (2e4, 5e4, 1e5)
    assert wing.has_centre_of_pressure
    assert np.isinf(wing.aspect_ratio)
    assert main(shlex.split("polar --section naca0012 --re 5e4 --json")) == 0
    record = json.loads(capsys.readouterr().out)
    (row,) = (i for i, angle in enumerate(record["alpha_deg"]) if angle == 5)
    assert record["analysis_confidence"][row] > 0.9
    _, (alone,) = section_polars("naca0012", [5e4])
    quarter = alone.moment[35] - 0.25 * (alone.lift[35] * np.cos(0.0873) + alone.drag[35] * np.sin(0.0873))
    assert record["x_cp"][row] == pytest.approx(0.25 - quarter / alone.lift[35], abs=0.01)


@pytest.mark.parametrize(
    ("words", "part"),
    [
        ("polar", "name a model such as su-fan, or --section naca0012 --re 5e4"),
        ("polar su-fan --section naca0012 --re 5e4", "is given twice: model and --section"),
        ("polar --section naca0012", "give the wing's Reynolds numbers, such as --re 2e4 5e4 1e5"),
        ("polar --section naca0012 --re 500", "NeuralFoil was trained from Re 1000"),
        ("polar --section naca0012 --re 5e4 -o wing.png", "write wing.csv; then wingbeat polar draws it"),
        ("polar --section naca0012 --re 5e4 --about 0.25 --alpha 0:9:1", "leave out --alpha, --about; save the"),
        ("polar --section naca00 --re 5e4", "give NACA digits (naca0012), a file of coordinates"),
        ("polar --section naca4400 --re 5e4", "the last two digits are the thickness"),
        ("polar --section plate4 --re 5e4", "for example plate0.04 for 4 per cent"),
    ],
)
def test_wrong_words_are_refused(words, part, capsys):
    assert main(shlex.split(words)) == 2
    assert part in capsys.readouterr().err


def test_without_the_extra_its_name_is_told(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "neuralfoil", None)
    assert main(shlex.split("polar --section naca0012 --re 5e4")) == 2
    assert "NeuralFoil is not installed here: in the clone run uv sync --inexact --extra neuralfoil" in (
        capsys.readouterr().err
    )
