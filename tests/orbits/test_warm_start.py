"""Problems that are alike help one another: who is alike, what answers predict, and that nobody is worse off."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.bench import mixed_problems
from wingbeat.orbits import batch
from wingbeat.orbits.batch import Answers, Known, differences, find_orbits, group_similar, numbers_of
from wingbeat.orbits.options import DEFAULTS, Status
from wingbeat.orbits.solution import better_of, correct_guess
from wingbeat.orbits.solve import Settings, find_orbit

ROUNDING = DEFAULTS.continuation.rounding


@pytest.fixture(scope="module")
def pigeons():
    """Return pigeons that differ in speed and mass."""
    return [p for p in mixed_problems(60) if p.species.name == "pigeon" and p.aero.coefficients.name == "su-fan"]


def test_groups_hold_every_problem_once_and_only_what_differs_in_numbers():
    problems = list(mixed_problems(40))
    groups = group_similar(problems)
    assert sorted(i for group in groups for i in group.first) == list(range(40))
    kinds = [
        {(problems[i].species.name, problems[i].aero.coefficients.name) for i in group.first} for group in groups
    ]
    assert all(len(kind) == 1 for kind in kinds)
    assert len(kinds) == 4


def test_what_is_free_or_made_least_or_how_many_strips_keeps_problems_apart(pigeons):
    first = pigeons[0]
    fewer = dataclasses.replace(first, free=("frequency", "flap_amplitude", "pitch_amplitude"), bounds={})
    strips = dataclasses.replace(first, aero=wb.aero.BladeElement(wb.aero.SuFan(), strips=12))
    assert sorted(len(group.first) for group in group_similar([first, fewer, strips, pigeons[1]])) == [1, 1, 2]


def test_large_groups_are_cut_where_the_numbers_differ_most():
    pigeon = wb.load_species("pigeon")
    small = wb.ContinuationOptions(batch_size=4, batch_first=3)
    problems = [wb.OrbitProblem(pigeon, speed=float(u)) for u in np.random.default_rng(0).permutation(11) + 5]
    (group,) = group_similar(problems, small)
    assert [problems[i].speed for i in group.first] == [10.0, 15.0, 5.0]
    speeds = [sorted(problems[i].speed for i in part) for part in group.parts]
    assert speeds == [[6.0, 7.0, 8.0, 9.0], [11.0, 12.0, 13.0, 14.0]]


def test_problems_that_are_all_the_same_are_one_group(pigeons):
    assert sorted(group_similar([pigeons[0]] * 3)[0].first) == [0, 1, 2]
    assert differences([numbers_of(pigeons[0])] * 3, ROUNDING).shape == (3, 0)


def test_an_order_to_learn_from_goes_to_what_is_farthest():
    pigeon = wb.load_species("pigeon")
    problems = [wb.OrbitProblem(pigeon, speed=u) for u in (5.0, 6.0, 9.0, 12.0, 14.0)]
    assert [problems[i].speed for i in group_similar(problems)[0].first][:3] == [9.0, 14.0, 5.0]


def test_answers_that_lie_on_a_plane_are_predicted_exactly(pigeons):
    described = [numbers_of(pigeon) for pigeon in pigeons]
    answers, places = Answers([], described), differences(described, ROUNDING)
    slopes = np.random.default_rng(1).normal(size=(places.shape[1], 9))
    enough = places.shape[1] + 2
    for i in range(enough):
        assert answers.predict(enough) == []
        answers.add(i, Known(described[i], 1.0 + places[i] @ slopes, (), None))
    before = [Known(described[i], 1.0 + places[i] @ slopes, (), None) for i in range(enough)]
    for told, place in ((answers, enough), (Answers(before, described[enough:]), 0)):
        ((unknowns, hessian),) = told.predict(place)
        assert hessian is None
        np.testing.assert_allclose(unknowns, 1.0 + places[enough] @ slopes, rtol=1e-9)


def test_where_families_meet_each_predicts_its_own_if_enough_is_known_of_it(pigeons):
    described = [numbers_of(pigeon) for pigeon in pigeons]
    answers, enough = Answers([], described), differences(described, ROUNDING).shape[1] + 2
    for i in range(2 * enough):
        assert answers.predict(2 * enough) == []
        answers.add(i, Known(described[i], np.full(9, float(i % 2)), ("flap_mean",) * (i % 2), None))
    predicted = answers.predict(2 * enough)
    assert sorted(unknowns.round(9).tolist() for unknowns, _ in predicted) == [[0.0] * 9, [1.0] * 9]


def test_no_answer_is_worse_than_by_itself_and_most_are_settled_without_a_search(pigeons, monkeypatch):
    searched = []

    def counted(problem, *args, **named):
        searched.append(problem)
        return find_orbit(problem, *args, **named)

    monkeypatch.setattr(batch, "find_orbit", counted)
    together = list(find_orbits(pigeons, Settings(1, advise=False)))
    assert len(searched) <= 0.75 * len(pigeons)
    for problem, handed in zip(pigeons, together, strict=True):
        assert handed.problem is problem
        assert handed.status is Status.CONVERGED
        assert handed.starts == 1
        assert max(map(abs, handed.closure.values())) <= 1e-6
        assert handed.optimality <= 1e-5
        alone = find_orbit(problem, Settings(1), threads=1)
        assert handed.objective == pytest.approx(alone.objective, rel=1e-6)


def test_a_guess_that_is_no_neighbour_is_refused(pigeons):
    found = find_orbit(pigeons[0], Settings(1), threads=1)
    again = correct_guess(pigeons[0], found.unknowns)
    assert again.objective == pytest.approx(found.objective, rel=1e-8)
    once_more = correct_guess(pigeons[0], found.unknowns, again.reduced_hessian)
    assert once_more.objective == pytest.approx(found.objective, rel=1e-8)
    away = found.unknowns.copy()
    away[1] += 6.0
    assert correct_guess(pigeons[0], away) is None


def test_of_two_answers_the_better_is_kept_with_the_counts_of_both(pigeons):
    found = find_orbit(pigeons[0], Settings(1), threads=1)
    other = dataclasses.replace(found.wingbeat, frequency=30.0)
    worse = dataclasses.replace(found, wingbeat=other, starts=4, optima=())
    lost = dataclasses.replace(found, status=Status.NOT_CONVERGED)
    kept = better_of(worse, found)
    assert kept.wingbeat == found.wingbeat
    assert (kept.starts, kept.distinct_optima, kept.seconds) == (5, 2, 2 * found.seconds)
    assert better_of(found, found).distinct_optima == 1
    assert better_of(worse, lost).wingbeat == worse.wingbeat
    assert better_of(lost, lost).status is Status.NOT_CONVERGED


def test_several_starts_are_made_where_the_guess_is_one_of_them(pigeons):
    found = list(find_orbits(pigeons, Settings(2, advise=False)))
    assert {solution.starts for solution in found} == {2}
