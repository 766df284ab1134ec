"""`pareto_front` and ``wingbeat pareto``: what a limit costs, which points are dominated, and what is refused."""

import dataclasses
import json

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat._base import InvalidInputError
from wingbeat.cli import main
from wingbeat.plots import pareto_page
from wingbeat.results.pareto import ParetoFront

LIMITS = (1.2, 1.0, 1.1)


@pytest.fixture(scope="module")
def problem():
    return wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0)


@pytest.fixture(scope="module")
def front(problem):
    return wb.pareto_front(problem, "spectral_radius", LIMITS, starts=1)


def test_the_limits_go_from_none_to_the_tightest_and_every_orbit_keeps_its_own(front):
    assert front.limits == (None, 1.2, 1.1, 1.0)
    assert all(orbit.status is wb.Status.CONVERGED for orbit in front.orbits)
    for limit, value, orbit in zip(front.limits, front.values, front.orbits, strict=True):
        largest = max(abs(complex(*pair)) for pair in orbit.record()["floquet_multipliers"])
        assert value == pytest.approx(largest, rel=1e-9)
        assert limit is None or value <= limit


def test_a_tighter_limit_costs_more_and_no_point_is_dominated(front):
    assert np.all(np.diff(front.objectives) > 0)
    assert not front.dominated.any()
    rises = [point["rise"] for point in front.record()["points"]]
    assert rises[0] == 0
    assert rises == pytest.approx(front.objectives / front.objectives[0] - 1)


def test_an_orbit_that_is_worse_in_both_is_dominated_and_one_without_certificate_is_not(front):
    poor = ParetoFront(front.quantity, True, front.limits, front.orbits, np.array([1.3, 1.2, 1.25, np.nan]))
    assert poor.dominated.tolist() == [False, False, True, False]
    lower = ParetoFront(front.quantity, False, front.limits, front.orbits, np.array([1.0, 1.2, 1.1, 1.3]))
    assert lower.dominated.tolist() == [False, False, True, False]


def test_a_lower_limit_goes_upward(problem):
    front = wb.pareto_front(problem, "mean_positive_power", [60.0, 50.0], at_most=False, starts=1)
    assert front.limits == (None, 50.0, 60.0)
    assert all(value >= limit - 1e-3 for value, limit in zip(front.values[1:], (50.0, 60.0), strict=True))


@pytest.mark.slow
def test_a_limit_without_an_orbit_is_a_point_with_its_status(problem):
    front = wb.pareto_front(problem, "mean_positive_power", [1.0], starts=1)
    record = front.record()
    assert record["points"][1]["status"] != "converged"
    assert record["points"][1]["quantity_value"] is None
    json.dumps(record, allow_nan=False)
    page = pareto_page(record)
    assert len(page.axes) == 2
    assert "limit that no orbit keeps" in check_legends(page)


@pytest.mark.parametrize(
    ("quantity", "limits", "words"),
    [
        ("spectral_radius", [1.0, float("nan")], r"limits\[1\]"),
        ("spectral_radius", [], "must be 1 to 200 limits"),
        ("spectral_radius", [1.0, 1.0], "has a limit twice"),
        ("frequency", [9.0], "is minimised"),
        ("spectral_radios", [1.0], "is not known to wingbeat"),
    ],
)
def test_a_front_that_cannot_be_is_refused(problem, quantity, limits, words):
    with pytest.raises(InvalidInputError, match=words):
        wb.pareto_front(problem, quantity, limits, starts=1)


def test_a_quantity_that_the_problem_limits_already_is_refused(problem):
    limited = dataclasses.replace(problem, subject_to=["spectral_radius<=1.1"])
    with pytest.raises(InvalidInputError, match="is limited by the problem already"):
        wb.pareto_front(limited, "spectral_radius", [1.0], starts=1)


def test_the_command_prints_and_draws_what_its_json_holds(tmp_path, capsys):
    drawn = tmp_path / "front.png"
    asked = ["pareto", "pigeon", "--speed", "12", "--limits", "1.1:1.2:0.1", "--starts", "1", "--plot", str(drawn)]
    assert main(asked) == 0
    printed = capsys.readouterr().out
    assert "least frequency for each limit of the spectral radius" in printed
    assert drawn.stat().st_size > 10_000
    assert main([*asked[:-2], "--json"]) == 0
    points = json.loads(capsys.readouterr().out)["points"]
    assert [point["limit"] for point in points] == [None, 1.2, 1.1]
    assert all(f"{point['objective_value']:.4g}" in printed for point in points)


def test_the_command_refuses_a_limit_that_is_no_number(capsys):
    assert main(["pareto", "pigeon", "--speed", "12", "--limits", "tight"]) == 2
    assert "--limits" in capsys.readouterr().err
