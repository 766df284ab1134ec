"""Within plausible ranges few starts search within them at first, and optima of equal value lead there once."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.orbits import solve
from wingbeat.orbits.nlp.transcription import Candidate, Transcription
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.solve import Settings, find_orbit, first_searches, search_from_optima
from wingbeat.orbits.starts import start_point, starts_within


def animal(name="pigeon", speed=12.0):
    species = wb.load_species(name)
    return wb.models.animal(species).problem(species, speed, bounds="plausible")


@pytest.fixture
def ends(monkeypatch):
    """Local searches end where they start, as optima unless their start is among `ends.fail`; all are noted."""

    class Ends(list):
        fail = ()

    noted = Ends()

    def search(programme, start, *, restore=False):
        noted.append((len(programme.problem.subject_to), start))
        closed = not any(np.array_equal(start, one) for one in noted.fail)
        return Candidate(programme, programme.scaled(start), 1.0, closed, True, 0.0)

    monkeypatch.setattr(solve, "search", search)
    return noted


def test_six_starts_search_within_the_ranges_and_all_without(ends):
    problem = animal()
    first_searches(Transcription(problem), 24, seed=0, threads=1)
    assert [limits > 0 for limits, _ in ends[:30]] == [True] * 6 + [False] * 24


def test_all_starts_search_within_limits_of_the_users_own_and_where_a_parameter_is_minimised():
    species = wb.load_species("pigeon")
    own = wb.OrbitProblem(species, 12.0, minimise="power", subject_to=["peak_power<=30"])
    frequency = wb.OrbitProblem(species, 12.0, bounds="plausible")
    stable = dataclasses.replace(animal(), subject_to=["spectral_radius<=0.9"], bounds="plausible")
    assert [starts_within(one, 24) for one in (own, frequency, stable)] == [24, 24, 24]
    assert [starts_within(animal(), count) for count in (24, 3)] == [6, 3]


def test_of_optima_of_equal_value_one_that_leads_within_the_ranges_is_enough(ends):
    programme = Transcription(animal())
    starts = [start_point(programme.problem, index, 0) for index in range(5)]
    values = (1.0, 1.0005, 1.2, 1.2001, 1.5)
    optima = [
        Candidate(programme, programme.scaled(start), value, True, True, 0.0)
        for start, value in zip(starts, values, strict=True)
    ]
    begun = [programme.physical(one.scaled) for one in optima]

    def searched():
        found = search_from_optima(programme, optima, threads=1)
        return [next(i for i, one in enumerate(begun) if np.array_equal(one, start)) for _, start in ends], found

    assert searched()[0] == [0, 2, 4]
    ends.clear()
    ends.fail = (begun[0], begun[4])  # then the next of that value is tried, and nothing more for the last
    order, found = searched()
    assert order == [0, 2, 4, 1]
    assert [one.closed for one in found] == [False, True, False, True]


def test_starts_that_did_not_search_within_the_ranges_do_so_if_no_orbit_was_found(ends):
    problem = animal()
    unlimited = dataclasses.replace(problem, subject_to=())
    ends.fail = [start_point(one, index, 0) for one in (problem, unlimited) for index in range(24)]
    find_orbit(problem, Settings(24, most_starts=24, explain=False, advise=False), threads=1)
    within = [start for limits, start in ends if limits]
    assert all(np.array_equal(start, start_point(problem, i, 0)) for i, start in enumerate(within[:6]))
    assert all(np.array_equal(start, start_point(problem, i, 0)) for i, start in enumerate(within[-18:], 6))


@pytest.mark.slow
def test_the_shorter_search_finds_the_best_optimum_of_the_longer_one():
    """A bat whose best optimum few of the starts find."""
    problem = animal("bat", 6.2)
    longer = dataclasses.replace(DEFAULTS.search, starts_within_ranges=24, same_value=1e-12)
    long = find_orbit(problem, Settings(advise=False, options=wb.SolverOptions(search=longer)))
    short = find_orbit(problem, Settings(advise=False))
    assert short.status is long.status is wb.Status.CONVERGED
    assert short.objective == pytest.approx(long.objective, rel=1e-6)
    assert short.starts < long.starts
