"""Many problems at once: the answers of one by one, whoever computes them."""

import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.bench import mixed_problems
from wingbeat.orbits import batch
from wingbeat.orbits.batch import find_beside, find_orbits
from wingbeat.orbits.branches import find_optima
from wingbeat.orbits.nlp import newton_kkt as defect_correction
from wingbeat.orbits.nlp.newton_kkt import NewtonKKT, NullSpace, correct
from wingbeat.orbits.nlp.transcription import Transcription, search
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.orbits.starts import start_count, start_point


def problems():
    """Return a mixture of animals, models and speeds, the third of which has no orbit."""
    pigeon, bat = (wb.load_species(name) for name in ("pigeon", "bat"))
    hardly = {"flap_amplitude": (math.radians(5), math.radians(6))}
    return [
        wb.OrbitProblem(pigeon, speed=9.0),
        wb.OrbitProblem(bat, speed=6.0, aero=wb.aero.Dickinson()),
        wb.OrbitProblem(bat, speed=8.0, aero=wb.aero.Dickinson(), bounds=hardly),
        wb.OrbitProblem(pigeon, speed=14.0, aero=wb.aero.Dickinson()),
    ]


def same(one, other):
    assert one.status is other.status
    assert one.wingbeat == other.wingbeat
    assert one.initial_state == other.initial_state
    assert one.record()["closure"] == other.record()["closure"]


def test_a_batch_gives_the_answers_of_single_orbits_in_their_order():
    few = wb.SolverOptions(search=wb.SearchOptions(most_starts=2))  # of 50: each takes a tenth of a second
    seen = []
    found = wb.solve_orbits(problems(), starts=1, progress=lambda *done: seen.append(done), options=few)
    assert seen == [(1, 4), (2, 4), (3, 4), (4, 4)]
    assert [orbit.status.value for orbit in found] == ["converged", "converged", "infeasible", "converged"]
    for orbit, problem in zip(found, problems(), strict=True):
        # The batch gives no advice, which takes seconds.
        same(orbit, wb.Orbit.of(find_orbit(problem, Settings(1, advise=False, options=few)), 1))


@pytest.mark.slow
def test_processes_give_the_same_bits(monkeypatch):
    """Of problems found alone, of some predicted from those before, and of least power with its quantity."""
    pigeon = wb.load_species("pigeon")
    chosen = list(mixed_problems(4))
    chosen += [wb.OrbitProblem(pigeon, speed=u) for u in (8.0, 9.0, 10.0, 11.0, 12.0, 13.0)]
    chosen += [wb.OrbitProblem(pigeon, speed=u, minimise="mean_positive_power") for u in (9.0, 10.0)]
    parts = wb.SolverOptions(continuation=wb.ContinuationOptions(batch_first=3, batch_size=2))
    searched = []

    def counted(problem, *args, **named):
        searched.append(problem)
        return find_orbit(problem, *args, **named)

    shared = wb.solve_orbits(chosen, starts=1, processes=2, options=parts)
    monkeypatch.setattr(batch, "find_orbit", counted)
    alone = wb.solve_orbits(chosen, starts=1, processes=1, options=parts)
    assert len(searched) < len(chosen)
    for one, other in zip(alone, shared, strict=True):
        same(one, other)
        assert one.record()["objective_value"] == other.record()["objective_value"]
    np.testing.assert_array_equal(alone[-1].dataset["u"], shared[-1].dataset["u"])


@pytest.mark.parametrize(
    ("changed", "where"),
    [
        ({"problems": ["pigeon"]}, r"problems\[0\]"),
        ({"processes": 0}, "processes"),
        ({"processes": True}, "processes"),
        ({"starts": 0}, "starts"),
        ({"seed": -1}, "seed"),
    ],
)
def test_a_batch_is_refused_before_it_begins(changed, where):
    with pytest.raises(wb.InvalidInputError, match=where):
        wb.solve_orbits(**({"problems": problems()} | changed))
    if where in ("starts", "seed"):
        with pytest.raises(wb.InvalidInputError, match=where):
            wb.solve_orbit(problems()[0], **changed)
    work = {"problems": problems()} | {name: changed[name] for name in ("problems", "processes") if name in changed}
    settings = Settings(**{name: value for name, value in changed.items() if name not in work})
    with pytest.raises(wb.InvalidInputError, match=where):
        find_orbits(settings=settings, **work)


def test_no_problems_are_no_orbits():
    assert wb.solve_orbits([]) == []


@pytest.mark.parametrize("index", [0, 1])
def test_newtons_method_comes_to_the_optimum_of_a_shifted_closure_as_slsqp_does(index):
    programme = Transcription(problems()[index])
    found = search(programme, start_point(programme.problem, 0, 0))
    assert found.closed
    assert found.optimal
    scaled = found.scaled
    newton = NewtonKKT(programme, scaled)
    programme = offset(programme, closure=np.full(6, 1e-3))
    found = newton.converge(programme, newton.converge(programme, scaled))
    assert np.abs(programme.closure(found)).max() <= 1e-8
    again, _ = programme.optimise(scaled, 60, 1e-14)
    assert programme.objective(found) == pytest.approx(programme.objective(again), rel=1e-7)
    np.testing.assert_allclose(found, again, rtol=0, atol=2e-3)


def offset(programme, **offsets):
    """Return the programme with offsets taken off what it evaluates."""
    anchor, nothing = programme._no_correction
    return programme._corrected(anchor, nothing._replace(**offsets))


def optimum(index):
    programme = Transcription(problems()[index])
    return programme, search(programme, start_point(programme.problem, 0, 0)).scaled


def test_conditions_that_say_the_same_twice_are_met_all_the_same():
    rows = np.random.default_rng(0).normal(size=(6, 9))
    rows[5] = 2 * rows[4]
    values = rows @ np.arange(9.0)
    null_space = NullSpace(rows, 1e-13)
    np.testing.assert_allclose(rows @ null_space.least_norm_step(values), values, rtol=1e-10)
    np.testing.assert_allclose(rows @ null_space.basis, 0, atol=1e-12)
    np.testing.assert_allclose(null_space.multipliers(rows[0]) @ rows, rows[0], atol=1e-12)


def test_newtons_method_gives_up_far_from_closure():
    programme, scaled = optimum(0)
    newton = NewtonKKT(programme, scaled)
    assert newton.converge(offset(programme, closure=np.full(6, 30.0)), scaled) is None


def test_newtons_method_gives_up_where_it_leaves_the_bounds():
    programme, scaled = optimum(0)
    newton = NewtonKKT(programme, scaled)
    programme = offset(programme, closure=np.full(6, 1e-2))
    assert newton.converge(programme, scaled) is not None
    programme.lower, programme.upper = scaled - 1e-7, scaled + 1e-7
    assert newton.converge(programme, scaled) is None


def test_newtons_method_gives_up_where_the_path_exceeds_a_limit_that_was_not_active():
    programme, scaled = optimum(0)
    newton = NewtonKKT(programme, scaled)
    offsets = {"closure": np.full(6, 1e-3), "path": np.full(len(programme.path_limits), 10.0)}
    assert not newton.active.any()
    assert newton.converge(offset(programme, **offsets), scaled) is None


def test_newtons_method_has_nothing_to_do_with_too_few_unknowns():
    programme, scaled = optimum(0)
    programme.lower = scaled.copy()
    assert not NewtonKKT(programme, scaled).fits
    assert NewtonKKT(programme, scaled).converge(programme, scaled) is None


def test_what_breaks_the_bound_on_body_pitch_is_no_orbit():
    programme, scaled = optimum(0)
    found = correct(programme, scaled)
    assert found.is_orbit()
    found.programme.pitch_bounds = np.array([found.certificate.pitch.max() + 0.1, 2.0])
    assert not found.is_orbit()


def test_beside_an_orbit_only_what_may_be_better_is_certified(monkeypatch):
    problem = wb.OrbitProblem(wb.load_species("bat"), 10.0)
    best = find_orbit(problem, Settings(6), threads=1)
    (worse,) = [o for o in find_optima(problem, 1) if o.objective > best.objective + 0.1]
    tried = []
    monkeypatch.setattr(
        defect_correction, "correct", lambda p, scaled: tried.append(p.physical(scaled)) or correct(p, scaled)
    )
    better = find_beside(worse, 6)
    assert better.objective == best.objective
    assert better.starts == worse.starts + 6
    # The frequency is the fifth unknown; of the optima that were met only those below are certified.
    assert tried
    assert all(unknowns[4] < 1.01 * worse.objective for unknowns in tried)
    assert len(tried) < better.distinct_optima
    tried.clear()
    same = find_beside(best, 6)
    assert not tried
    assert same.wingbeat == best.wingbeat
    assert same.starts == best.starts + 6
    assert same.distinct_optima == best.distinct_optima
    assert same.seconds > best.seconds


@pytest.mark.slow
def test_if_nothing_is_said_each_problem_is_searched_as_often_as_by_itself(monkeypatch):
    asked = []

    def seen(problem, known, settings):
        asked.append(settings.starts)
        return find_orbit(problem, Settings(1), threads=1)

    monkeypatch.setattr(batch, "find_with_known", seen)
    bat = wb.load_species("bat")
    both = [wb.OrbitProblem(bat, 9.0), wb.OrbitProblem(bat, 9.0, minimise="mean_power")]
    found = wb.solve_orbits(both)
    assert asked == [start_count(problem) for problem in both]
    assert [orbit.inputs["starts"] for orbit in found] == asked
