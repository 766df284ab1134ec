"""Orbits, curves, problems, species and fronts in a notebook: tables, summaries, figures and data frames."""

import pytest

import wingbeat as wb
from tests.helpers.notebooks import check_figure, check_table
from wingbeat._base import NOMENCLATURE
from wingbeat.cli import main


@pytest.fixture(scope="module")
def problem():
    return wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0, subject_to=["body_pitch_range<=40 deg"])


@pytest.fixture(scope="module")
def orbit(problem):
    return wb.solve_orbit(problem, starts=1)


@pytest.fixture(scope="module")
def curve():
    return wb.solve_curve(wb.OrbitProblem(wb.load_species("pigeon"), speed=8.0), [8.0, 10.0], starts=1)


@pytest.fixture(scope="module")
def front():
    problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0)
    return wb.pareto_front(problem, "spectral_radius", [1.2, 1.1], starts=1)


@pytest.fixture(scope="module")
def found(orbit):
    return wb.sensitivities(orbit)


def test_the_summary_is_what_the_commands_print(capsys, monkeypatch, tmp_path):
    monkeypatch.setenv("COLUMNS", "80")
    assert main(["orbit", "pigeon", "--speed", "10", "--starts", "1", "-o", str(tmp_path / "orbit.nc")]) == 0
    printed = capsys.readouterr().out
    saved = wb.load_orbit(tmp_path / "orbit.nc")
    assert printed == saved.summary() + "\n"
    monkeypatch.setenv("COLUMNS", "50")
    assert main(["show", str(tmp_path / "orbit.nc")]) == 0
    assert capsys.readouterr().out == saved.summary(50) + "\n" != printed


def test_an_orbit_shows_its_record(orbit):
    shown = check_table(orbit)
    assert f"{orbit.wingbeat.frequency:.4g} Hz" in shown
    assert "certified: closes to" in shown
    assert all(" ".join(warning.split()) in shown for warning in orbit.record()["warnings"])


@pytest.mark.slow
def test_no_orbit_shows_why(problem):
    none = wb.solve_orbit(wb.OrbitProblem(problem.species, speed=60.0), starts=1)
    assert none.relaxations[0].text in check_table(none)


def test_the_series_of_an_orbit_as_a_table(orbit):
    table, data = orbit.to_dataframe(), orbit.dataset
    single = [str(name) for name, series in data.variables.items() if series.dims == ("phase",)]
    assert set(single) <= set(table.columns)
    assert set(single) - {"phase"} <= set(NOMENCLATURE)
    assert (table["hinge_power"].to_numpy() == data["hinge_power"].values).all()
    assert (table["lift_station_3"].to_numpy() == data["lift"].values[:, 2]).all()


def test_a_curve_shows_each_speed(curve):
    shown = check_table(curve)
    best = curve.record()["points"][1]["optima"][0]
    assert f"10 {best['frequency']:.4g} {best['mean_positive_power']:.4g}" in shown
    assert "2 of 2 speeds certified" in shown
    table = curve.to_dataframe()
    assert table["speed"].tolist() == [8.0, 10.0]
    assert table["frequency"].iloc[1] == best["frequency"]
    assert {"frequency", "mean_positive_power", "flap_amplitude"} <= set(table.columns) & set(NOMENCLATURE)


def test_a_front_shows_each_limit(front):
    shown = check_table(front)
    assert "1.2" in shown
    assert "dominated" in shown or "unstable" in shown
    table = front.to_dataframe()
    assert table["frequency"].tolist() == [orbit.wingbeat.frequency for orbit in front.orbits]
    assert table["limit"].iloc[1:].tolist() == [1.2, 1.1]


def test_sensitivities_are_ranked(found):
    shown = check_table(found)
    first = found.ranked()[0].parameter.path
    assert first in shown
    table = found.to_dataframe()
    assert table["parameter"].iloc[0] == first
    assert table["quantities.frequency"].iloc[0] == found.ranked()[0].quantities["frequency"]
    assert table["value"].dtype == table["plausible.0"].dtype == float


def test_a_problem_shows_what_is_asked(problem):
    shown = check_table(problem)
    assert "pigeon at 12 m/s" in shown
    assert "body_pitch_range <= 40 deg" in shown
    assert "frequency 1 to 30 Hz" in shown
    assert "flap_amplitude_deg 5 to 70 deg" in shown
    animal = wb.load_species("bat")
    bat = wb.models.animal(animal).problem(animal, speed=6.0)
    assert f"model {bat.origin.name}" in check_table(bat)


def test_every_species_shows_its_numbers():
    for name in wb.species_names():
        animal = wb.load_species(name)
        shown = check_table(animal)
        assert all(" ".join(number.source.split()) in shown for number in animal.numbers.values())
    with_markup = animal.with_values({"wing.mass": 0.01})
    assert "set by hand in place of" in check_table(with_markup)


def test_figures_show_themselves(orbit, curve, front, found):
    for result in (orbit, curve, front, found):
        check_figure(result.plot())
