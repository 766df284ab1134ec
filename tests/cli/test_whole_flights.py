"""``wingbeat validate`` with measured flights of an animal: what it prints, writes and refuses."""

import json

import pytest

from wingbeat.cli import main

FLIGHTS = """
species = "pigeon"
speeds = [10.0]

[[measured]]
quantity = "frequency"
basis = "measured"
speeds = [10.0, 10.0]
values = [5.0, 9.0]
what = "two birds"
source = "a paper of 2001"
"""


@pytest.fixture
def flights(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(FLIGHTS)
    return path


def test_page_figure_and_json_tell_the_same_comparison(flights, tmp_path, capsys):
    page = tmp_path / "mine.md"
    assert main(["validate", str(flights), "--model", "paper", "--json", "-o", str(page)]) == 0
    told = json.loads(capsys.readouterr().out)
    (score,) = told["compared"]
    frequency = told["flown"][0]["values"]["frequency"]
    assert score["predicted"] == [frequency, frequency]
    assert score["ratio"][0] == pytest.approx(frequency / 7.0)
    assert score["measurement"]["source"] == "a paper of 2001"
    text = page.read_text()
    assert "# Whole flights: rock pigeon" in text
    assert f"| {frequency:.3g} |" in text
    assert page.with_suffix(".png").stat().st_size > 10_000


def test_the_table_tells_whether_it_agrees(flights, capsys):
    assert main(["validate", str(flights), "--model", "paper"]) == 0
    printed = capsys.readouterr().out
    assert "pigeon: model paper, minimum frequency" in printed
    assert "5 to 9" in printed


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["pigeon", "--aero", "su-fan"], "--aero"),
        (["pigeon", "--induced-factor", "1.3"], "--induced-factor"),
        (["pigeon", "--model", "plane"], "--model"),
        (["pigeon", "--draws", "3"], "draws"),
        (["--draws", "20"], "--draws"),
        (["--model", "paper"], "--model"),
        (["dove"], "dove"),
    ],
)
def test_what_does_not_apply_is_refused(words, told, capsys):
    assert main(["validate", *words]) == 2
    assert told in capsys.readouterr().err


def test_the_animals_are_listed_beside_the_measured_motions(capsys):
    words = ["--aero", "su-fan", "--unsteady", "none", "--inflow", "none", "--json"]
    assert main(["validate", *words]) == 0
    told = json.loads(capsys.readouterr().out)
    assert len(told["cases"]) == 5
    assert {"pigeon", "cockatiel"} <= set(told["whole_flights"])
