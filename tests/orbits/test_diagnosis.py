"""Where there is no answer the advice raises nothing, at any speed; a bound that ends the problem is named."""

import json

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.hard_problems import hard_problems
from tests.helpers.hasty import make_hasty
from wingbeat.cli import main
from wingbeat.orbits.changes import possible_changes, relaxation, with_change
from wingbeat.orbits.flight.period import BALANCES
from wingbeat.orbits.nlp.newton_kkt import NewtonKKT
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.solve import Settings, find_orbit

PIGEON = wb.load_species("pigeon")


# --- the advice never raises ---


def test_too_fast_is_no_bad_input(capsys, monkeypatch):
    """The advice tried 140 m/s, past what a problem may ask, and the answer was lost as bad input."""
    make_hasty(monkeypatch)
    code = main(["orbit", "pigeon", "--speed", "40", "--flap-amplitude-max", "6", "--starts", "1", "--json"])
    record = json.loads(capsys.readouterr().out)
    assert code == 3
    assert record["status"] == "infeasible"
    assert "thrust is short of drag" in record["message"]


def test_a_curve_keeps_its_other_speeds(capsys, monkeypatch):
    make_hasty(monkeypatch)
    assert main(["curve", "pigeon", "--speeds", "45:55:10", "--starts", "1", "--json"]) == 0
    curve = json.loads(capsys.readouterr().out)
    assert curve["gaps"] == [55.0]
    assert [point["status"] for point in curve["points"]] == ["converged", "infeasible"]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(4))
def test_every_change_that_may_be_tried_makes_a_problem(seed):
    random = np.random.default_rng(seed)
    for problem in hard_problems(25, seed):
        at_bounds = [(name, sign) for name in (*problem.free, "body_pitch") for sign in ("<=", ">=")]
        for change in possible_changes(
            problem, at_bounds, dict(zip(BALANCES, random.uniform(-3.0, 3.0, 3), strict=True))
        ):
            for share in (*change.tries, change.widest, random.uniform(0.0, change.widest), 0.0):
                with_change(problem, change.name, change.sign, change.moved(min(share, change.widest)))
                told = relaxation(problem, change, change.moved(1.02 * share), int(random.integers(0, 11)))
                assert told.text
                told.apply(problem)


@pytest.mark.slow
def test_no_hard_problem_raises():
    """A sample: hundreds were tried so while the advice was mended.

    The searches with a change are cut short: of those that go on, these problems close none either.
    """
    statuses = []
    short = wb.SolverOptions(
        diagnosis=wb.DiagnosisOptions(far_iterations=10, back_iterations=10, back_times=1, widened=(0,))
    )
    for seed, problem in enumerate(hard_problems(3, 11, ("frequency",))):
        found = find_orbit(problem, Settings(1, seed, most_starts=1, options=short), threads=1)
        record = wb.Orbit.of(found, 1, seed).record()
        assert record["message"]
        statuses.append(found.status)
        for change in found.relaxations:
            change.apply(problem)
    assert wb.Status.INFEASIBLE in statuses


@pytest.mark.parametrize(("speed", "climb"), [(100.0, 0.0), (10.0, -100.0), (100.0, -100.0)])
def test_at_the_limits_of_a_problem_no_change_leads_past_them(speed, climb):
    problem = wb.OrbitProblem(PIGEON, speed=speed, climb=climb)
    changes = [c for c in possible_changes(problem, [], {}) if c.name in ("speed", "climb")]
    assert {c.name for c in changes} == {"speed"} | ({"climb"} if climb > -100 else set())
    for change in changes:
        assert 0 <= change.moved(100.0) <= 100 or change.name == "climb"
        assert change.moved(100.0) == change.reach >= -100


def test_a_cost_of_transport_is_not_sought_in_hover():
    problem = wb.OrbitProblem(PIGEON, speed=10.0, minimise="cost_of_transport")
    slower = [c for c in possible_changes(problem, [], {}) if c.name == "speed" and c.reach < 10]
    assert [0 < with_change(problem, "speed", "=", c.reach).speed < 1 for c in slower] == [True]


def test_without_gravity_what_fails_is_told():
    problem = wb.OrbitProblem(PIGEON.with_values({"air.gravity": 0.0}), speed=80.0)
    found = find_orbit(problem, Settings(1, most_starts=1, advise=False), threads=1)
    assert found.status is not wb.Status.CONVERGED
    assert all(np.isfinite(short.share) and np.isfinite(short.amount) for short in found.deficits)


def test_a_much_wider_range_of_frequency_is_tried():
    problem = wb.OrbitProblem(PIGEON, speed=10.0, bounds={"frequency": (2.0, 3.0)})
    wider = {c.sign: c for c in possible_changes(problem, [], {}) if c.name == "frequency"}
    assert wider["<="].reach >= 30
    assert wider[">="].reach <= 0.2
    once = wb.SolverOptions(diagnosis=wb.DiagnosisOptions(far_iterations=15, back_iterations=10, back_times=1))
    found = find_orbit(problem, Settings(1, most_starts=2, options=once))
    assert found.status is wb.Status.INFEASIBLE
    assert any((c.name, c.sign) == ("frequency", "<=") for c in found.relaxations), found.message


# --- Newton's method where the rank of the conditions changes ---


@pytest.mark.slow
def test_a_curve_of_a_body_without_inertia_is_traced(capsys, monkeypatch):
    make_hasty(monkeypatch)
    words = "curve pigeon --speeds 0:20:10 --set body.pitch_inertia=1e-30 --starts 2 --json"
    assert main(words.split()) in (0, 3)
    assert len(json.loads(capsys.readouterr().out)["points"]) == 3


class _TwoConditions:
    """Minimise the squares of three unknowns; the second condition says the same as the first beyond a place."""

    lower, upper = np.full(3, -10.0), np.full(3, 10.0)
    options = DEFAULTS

    def __init__(self, breaks):
        self.breaks = breaks

    def inequalities(self, scaled):
        return np.ones(2)

    def active_conditions(self, scaled, active):
        second = [1.0, 0.0, 0.0] if scaled[0] < self.breaks else [0.0, 1.0, 0.0]
        rows = np.array([[1.0, 0.0, 0.0], second])
        return rows @ scaled - 1.0, rows

    def objective_gradient(self, scaled):
        return scaled


def test_newtons_method_gives_up_where_the_rank_changes():
    there = np.array([2.0, 2.0, 2.0])
    same, changing = _TwoConditions(-5.0), _TwoConditions(1.5)
    np.testing.assert_allclose(NewtonKKT(same, there).converge(same, there), [1.0, 1.0, 0.0], atol=1e-6)
    assert NewtonKKT(changing, there).converge(changing, there) is None


# --- a bound that ends the problem ---


def test_least_frequency_at_its_own_bound_is_final():
    problem = wb.OrbitProblem(wb.load_species("bat"), speed=6.0, climb=-2.8, bounds={"frequency": (3.0, 30.0)})
    record = wb.solve_orbit(problem, starts=2).record()
    assert record["wingbeat"]["frequency"] == pytest.approx(3.0, abs=1e-4)
    assert "frequency is at its lower bound of 3 Hz, so more starts cannot improve it" in record["message"]
    (told,) = [line for line in record["warnings"] if "more starts cannot improve it" in line]
    assert "`wingbeat glide`" in told
    assert not any("a better one may exist" in line or "other optima" in line for line in record["warnings"])


@pytest.mark.slow
def test_a_search_that_ends_at_the_bound_uncertified_says_which_change_to_make():
    """Of these 2 searches none closes, nor of 18 more; the message was to try more of them."""
    problem = wb.OrbitProblem(PIGEON, speed=12.0, climb=-7.2)
    found = find_orbit(problem, Settings(2, most_starts=2))
    assert found.status is wb.Status.NOT_CONVERGED
    assert "the optimum is at the lower bound of frequency" in found.message
    assert "try more starts" not in found.message
    (change,) = found.relaxations
    assert change.text in found.message
    assert (change.name, change.sign, change.old) == ("frequency", ">=", 1.0)
    # What the record holds closes, at the raised bound; and with the change made a search finds such an orbit.
    assert found.wingbeat.frequency == pytest.approx(change.new)
    assert max(abs(miss) for miss in found.closure.values()) <= 1e-6
    raised = find_orbit(change.apply(problem), Settings(2, advise=False))
    assert raised.status is wb.Status.CONVERGED
    assert raised.wingbeat.frequency <= change.new * (1 + DEFAULTS.search.bound_tolerance)
