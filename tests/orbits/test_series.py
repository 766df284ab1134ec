"""Problems in a row: answers handed on are certified, never worse than one's own, and mend a poor start."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from wingbeat._base import InvalidInputError
from wingbeat.orbits.batch import find_orbits, find_series
from wingbeat.orbits.options import Status
from wingbeat.orbits.solution import Optimum, families, search_near
from wingbeat.orbits.solve import Settings, find_orbit


@pytest.fixture(scope="module")
def row():
    bat = wb.load_species("bat")
    return [wb.OrbitProblem(bat, speed=speed) for speed in (7.0, 8.0, 9.0, 10.0)]


def test_a_row_is_certified_and_nowhere_worse_than_each_by_itself(row):
    alone, series = list(find_orbits(row, Settings(1, advise=False))), find_series(row)
    for one, handed in zip(alone, series, strict=True):
        assert handed.status is Status.CONVERGED
        assert handed.objective <= one.objective * (1 + 1e-7)
        assert max(abs(miss) for miss in handed.closure.values()) <= 1e-6
        assert handed.optimality <= 1e-5
        assert handed.starts > one.starts


def test_a_poor_answer_is_replaced_by_what_the_neighbour_leads_to(row, monkeypatch):
    own = find_orbit(row[1], Settings(1), threads=1)
    poor = dataclasses.replace(own, wingbeat=dataclasses.replace(own.wingbeat, frequency=20.0))
    monkeypatch.setattr(
        "wingbeat.orbits.batch.find_orbit",
        lambda p, *a, **k: poor if p.speed == 8.0 else find_orbit(p, *a, **k),
    )
    series = find_series(row)
    assert series[1].objective < 0.5 * poor.objective
    assert series[1].distinct_optima > poor.distinct_optima


def test_following_an_answer_finds_it_again_and_only_what_is_better(row):
    found = next(find_orbits(row[:1], Settings(1, advise=False)))
    again = search_near(row[0], found.unknowns)
    assert again.objective == pytest.approx(found.objective, rel=1e-6)
    assert search_near(row[0], found.unknowns, below=0.9 * found.objective) is None


def test_an_orbit_that_its_certificate_makes_no_better_is_not_returned(row, monkeypatch):
    found = next(find_orbits(row[:1], Settings(1, advise=False)))
    below = 1.001 * found.objective
    assert search_near(row[0], found.unknowns, below).objective < below
    raised = dataclasses.replace(found, wingbeat=dataclasses.replace(found.wingbeat, frequency=1.01 * below))
    monkeypatch.setattr("wingbeat.orbits.solution.certified_optimum", lambda *given: raised)
    assert search_near(row[0], found.unknowns, below) is None


def test_a_row_makes_as_many_starts_as_single_orbits_do(row, monkeypatch):
    asked = []

    def counted(problem, settings, **given):
        asked.append((settings.starts, settings.most_starts))
        return find_orbit(problem, Settings(1), threads=1)

    monkeypatch.setattr("wingbeat.orbits.batch.find_orbit", counted)
    wb.solve_orbits(row[:2], in_order=True)
    assert asked == [(None, None)] * 2


def test_optima_closer_than_a_twentieth_are_one_family():
    apart = wb.SearchOptions().same_optimum
    assert apart == 0.05
    optima = [Optimum(1.0 + i, np.array([place, 0.0])) for i, place in enumerate((0.0, 0.098, 0.102))]
    found = families(optima, np.array([2.0, 1.0]), apart)
    assert [(one.objective, one.starts) for one in found] == [(1.0, 2), (3.0, 1)]


def test_a_row_in_which_nothing_flies_is_data(row):
    bounds = {"flap_amplitude": (np.radians(5), np.radians(6))}
    hopeless = [wb.OrbitProblem(p.species, speed=p.speed, bounds=bounds) for p in row[:2]]
    assert [s.status for s in find_series(hopeless, Settings(1, most_starts=1, advise=False))] == [
        Status.INFEASIBLE
    ] * 2


def test_orbits_of_a_row_have_records_and_bad_counts_are_refused(row):
    orbits = wb.solve_orbits(row[:2], in_order=True)
    assert [orbit.record()["speed"] for orbit in orbits] == [7.0, 8.0]
    with pytest.raises(InvalidInputError, match="starts"):
        wb.solve_orbits(row[:1], starts=0, in_order=True)


def test_an_answer_is_handed_to_a_neighbour_once(row, monkeypatch):
    handed = []

    def counted(problem, start, *given):
        handed.append((problem.speed, start.tobytes()))
        return search_near(problem, start, *given)

    monkeypatch.setattr("wingbeat.orbits.batch.search_near", counted)
    find_series(row)
    assert len(handed) == len(set(handed)) >= 2 * (len(row) - 1)


def test_a_row_must_leave_the_same_free(row):
    other = dataclasses.replace(row[1], free=("frequency", "flap_amplitude"), bounds={})
    with pytest.raises(InvalidInputError, match=r"problems\[1\].free"):
        wb.solve_orbits([row[0], other], in_order=True)
