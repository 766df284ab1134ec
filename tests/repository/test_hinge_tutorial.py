"""The pages on hinges that give way: their commands run, and give the numbers that the pages say."""

import json

import pytest

import wingbeat as wb
from tests.helpers.places import ROOT
from tests.repository.test_docs import commands
from wingbeat.cli import main

GUIDE = ROOT / "docs" / "guide"


def answers(name, capsys):
    """Return what each command of a page prints as JSON."""
    found = []
    for words, _ in commands((GUIDE / name).read_text(encoding="utf-8")):
        assert words[:3] == ["uv", "run", "wingbeat"]
        assert main([*words[3:], "--json"]) == 0, words
        found.append(json.loads(capsys.readouterr().out))
    return found


@pytest.mark.slow
def test_the_tutorial_holds(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    given, passive, best, motor, stability, held = answers("tutorial_hinge.md", capsys)
    assert given["mean_positive_power"] == pytest.approx(77.7, abs=0.1)
    assert given["fitted_stiffness"] == pytest.approx(1.402, rel=0.01)
    assert given["fitted_damping"] == pytest.approx(0.02436, rel=0.01)
    assert given["fitted_share"] == pytest.approx(0.988, abs=0.002)
    assert passive["mean_positive_power"] == pytest.approx(82.2, abs=0.1)
    assert best["mean_positive_power"] == pytest.approx(80.5, abs=0.1)
    assert best["wingbeat"]["hinge_stiffness"] == pytest.approx(1.71, abs=0.02)
    assert motor["electrical_power"] == pytest.approx(86.9, abs=0.1)
    assert motor["peak_motor_current"] == pytest.approx(31.3, abs=0.2)
    assert motor["endurance"] == pytest.approx(6.36 * 60, rel=0.01)
    assert motor["flight_range"] == pytest.approx(3054, rel=0.01)
    assert motor["peak_battery_current"] == pytest.approx(25.9, abs=0.2)
    assert stability["stable"] is False
    assert stability["spectral_radius"] == pytest.approx(1.22, abs=0.005)
    assert held["spectral_radius"] < 1
    assert held["survey"]["survived"]["feedback"] == 1.0
    assert held["survey"]["survived"]["no feedback"] == pytest.approx(0.15, abs=0.03)
    orbit = wb.load_orbit(tmp_path / "gait.nc")
    assert wb.feedback(orbit).inputs == ("frequency", "flap_mean", "flap_amplitude")
    assert (tmp_path / "hinge.png").stat().st_size > 10_000


@pytest.mark.slow
def test_the_best_spring_by_the_model_of_live_animals_is_stiffer(capsys):
    """As the tutorial says; at the damping of the hinge that is nearest to the prescribed pitch."""
    hinge = ("pitch_hinge.stiffness=1.402", "pitch_hinge.damping=0.02436", "pitch_hinge.rest_angle_deg=-10.72")
    asked = ("--minimise", "positive-power", "--free", "pitch_hinge.stiffness", "--set", *hinge)
    assert (
        main(["orbit", "robofalcon2", "--speed", "8", "--starts", "4", "--model", "animal", "--json", *asked]) == 0
    )
    record = json.loads(capsys.readouterr().out)
    assert record["wingbeat"]["hinge_stiffness"] == pytest.approx(3.05, abs=0.05)
    assert record["mean_positive_power"] == pytest.approx(77.3, abs=0.2)


@pytest.mark.slow
def test_the_example_of_the_guide_holds(capsys):
    (record,) = answers("hinges.md", capsys)
    assert record["mean_positive_power"] == pytest.approx(77.0, abs=0.5)
