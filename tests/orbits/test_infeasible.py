"""Where there is no orbit: the law that fails, the least change that flies, and what the record keeps of them."""

import dataclasses
import functools
import math

import numpy as np
import pytest
from infeasible_cases import LIFT, MOMENT, THRUST, cases

import wingbeat as wb
from wingbeat.mechanics.flight_loads import flight_loads
from wingbeat.orbits.batch import find_orbits
from wingbeat.orbits.changes import Change, is_limit, possible_changes, relaxation, with_change
from wingbeat.orbits.deficit import Balance, Deficit, Nearest, Unbalanced, nearest_beat
from wingbeat.orbits.diagnosis import unexplained, without_orbit
from wingbeat.orbits.flight.period import BALANCES
from wingbeat.orbits.nlp.transcription import Candidate, Transcription, search
from wingbeat.orbits.options import Status
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.orbits.starts import start_point
from wingbeat.records.orbit_record import rivals

CASES = list(cases())
# One of each kind; the whole of them is benchmarks/infeasible.py.
QUICK = [CASES[i] for i in (1, 6, 10, 16, 22, 26)]
PIGEON = wb.load_species("pigeon")


# With fewer ends to start from, the closest beat of the shoulder too far back lacks lift.
STARTS = {"shoulder too far back": 12}


@functools.cache
def solved(kind):
    """Return what is found for the case of a kind, with advice, as a batch asks for it."""
    (case,) = (case for case in QUICK if case.kind == kind)
    (found,) = find_orbits([case.problem], Settings(2, most_starts=STARTS.get(kind, 3)))
    return found


def test_there_are_thirty_cases_of_six_kinds():
    assert len(CASES) == 30
    assert len({case.kind for case in QUICK}) == len({case.kind for case in CASES}) == 6


@pytest.mark.slow
@pytest.mark.parametrize("case", QUICK, ids=lambda case: case.kind)
def test_the_right_law_is_named_and_the_smallest_change_flies(case):
    found = solved(case.kind)
    assert found.status is wb.Status.INFEASIBLE
    assert found.deficits[0].law in case.laws
    assert str(found.deficits[0]) in found.message
    assert all(str(limit) in found.message for limit in case.problem.subject_to)
    change = found.relaxations[0]
    assert change.text in found.message
    again = find_orbit(change.apply(case.problem), Settings(1, 1, advise=False))
    assert again.status is wb.Status.CONVERGED, change.text


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["too slow", "amplitude too small"])
def test_with_the_force_that_is_short_it_flies(kind):
    """A steady force on all mass is another gravity: told shares and one percent more do, half of them do not."""
    problem, shares = solved(kind).problem, {s.law: s.share for s in solved(kind).deficits}
    assert len(shares) == 1

    def helped(part):
        up, ahead = (part * shares.get(law, 0.0) for law in (LIFT, THRUST))
        pull, tilt = math.hypot(1.0 - up, ahead), math.atan2(ahead, 1.0 - up)
        low, high = problem.bounds["body_pitch"]
        return dataclasses.replace(
            problem,
            air=dataclasses.replace(problem.air, gravity=pull * problem.air.gravity),
            speed=problem.speed * math.cos(tilt),
            climb=-problem.speed * math.sin(tilt),
            bounds={**problem.bounds, "body_pitch": (low - tilt, high - tilt)},
        )

    assert find_orbit(helped(1.02), Settings(1, advise=False)).status is wb.Status.CONVERGED
    assert find_orbit(helped(0.5), Settings(2, most_starts=4, advise=False)).status is wb.Status.INFEASIBLE


def test_the_closest_beat_misses_by_the_force_that_is_told():
    """Certified: what the flight lacks in vertical momentum over a beat is the lift that is short."""
    found = solved("too slow")
    (short,) = found.deficits
    mass = found.problem.vehicle.mass
    force = -found.closure["w"] * mass * found.wingbeat.frequency
    assert short.amount == pytest.approx(force, rel=0.02)
    assert short.share == pytest.approx(short.amount / (mass * found.problem.air.gravity))
    loads = flight_loads(
        found.problem.model, found.wingbeat, wb.State(*found.certificate.states.T), found.certificate.phase
    )
    lift = np.trapezoid(loads.air_force[:, 1], found.certificate.phase)
    assert mass * found.problem.air.gravity - lift == pytest.approx(short.amount, rel=0.05)


def test_nobody_pays_for_advice_that_is_not_asked_for():
    case = QUICK[2]
    (orbit,) = wb.solve_orbits([case.problem], 1, most_starts=2)
    assert orbit.status is wb.Status.INFEASIBLE
    assert orbit.relaxations == ()
    assert "thrust is short of drag" in orbit.message
    assert "changes" not in orbit.message
    assert solved(case.kind).relaxations


def test_record_and_file_keep_shortage_and_changes(tmp_path):
    case = QUICK[3]
    orbit = wb.Orbit.of(solved(case.kind), 2)
    record = orbit.record()
    assert record["failed_balance"][0] | {"share": 0, "amount": 0} == {
        "law": MOMENT,
        "share": 0,
        "amount": 0,
        "unit": "N m",
    }
    assert record["relaxations"][0].keys() == {"name", "sign", "old", "new", "unit", "text"}
    orbit.save(tmp_path / "none.nc")
    back = wb.load_orbit(tmp_path / "none.nc")
    assert back.record() == record
    assert back.relaxations == orbit.relaxations == solved(case.kind).relaxations
    for change in back.relaxations:  # the species of a file knows its records only
        own, other = change.apply(case.problem), change.apply(back.problem)
        assert (own.bounds, own.speed, own.vehicle) == (other.bounds, other.speed, other.vehicle)


def test_the_closest_beat_is_sought_from_ends_that_differ(monkeypatch):
    programme = Transcription(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0))
    middle, range_ = 0.5 * (programme.lower + programme.upper), programme.upper - programme.lower
    places = {"near": (0.0, 0.1), "beside it": (0.05, 0.2), "away": (0.4, 0.3), "also away": (0.45, 0.4)}
    ends = [
        Candidate(programme, middle + share * range_, 1.0, False, False, violation)
        for share, violation in reversed(places.values())
    ]
    asked = []

    def failing(self, starts):
        asked.extend(starts)
        return Unbalanced(middle, {LIFT: 0.5}, True, 1e-3)

    monkeypatch.setattr(Balance, "failing", failing)
    nearest_beat(programme, ends)
    np.testing.assert_allclose([(a - middle) / range_ for a in asked], [[s] * middle.size for s in (0.0, 0.4)])


def test_of_several_ends_the_best_goes_on_and_one_that_closes_ends_it(monkeypatch):
    balance = Balance(Transcription(wb.OrbitProblem(PIGEON, speed=10.0)))
    flown = []

    def nearest(self, scaled, broken=BALANCES, evaluations=None):
        share = float(scaled[0]) * (0.9 if evaluations is None else 1.0)
        flown.append((round(share, 3), tuple(broken), evaluations or 150))
        return Unbalanced(scaled, dict.fromkeys(broken, share), True, 1e-3)

    monkeypatch.setattr(Balance, "nearest", nearest)
    ends = [np.array([share]) for share in (0.3, 0.1, 0.2)]
    assert balance.failing(ends).shares == pytest.approx({THRUST: 0.09})
    together = [
        (share, tuple(BALANCES), evaluations)
        for share, evaluations in ((0.3, 25), (0.1, 25), (0.2, 25), (0.09, 150))
    ]
    assert flown == [*together, *((0.1, (law,), 25) for law in BALANCES), (0.09, (THRUST,), 150)]
    flown.clear()
    assert balance.failing([np.array([0.3]), np.array([0.0]), np.array([0.2])]).closes
    assert [share for share, *_ in flown] == [0.3, 0.0]


def test_a_beat_that_closes_but_is_no_optimum_is_not_called_infeasible(monkeypatch):
    problem = wb.OrbitProblem(PIGEON, speed=10.0)
    programme = Transcription(problem)
    closed = search(programme.uncorrected(), start_point(problem, 0, 0))
    astray = Candidate(programme, 0.5 * (programme.lower + programme.upper), 1.0, False, False, 9.0)
    monkeypatch.setattr("wingbeat.orbits.diagnosis.nearest_beat", lambda *_: Nearest(closed.scaled, (), True))
    # Searches that go on from it stray; one that finds an orbit is taken.
    assert without_orbit(programme, [astray], 1, advise=False)[1] is None
    monkeypatch.setattr("wingbeat.orbits.diagnosis.search", lambda *_: astray)
    beat, failure = without_orbit(programme, [astray], 1, advise=False)
    assert failure.status is Status.NOT_CONVERGED
    assert "almost closed wingbeats were found from 1 start, but none could be certified" in failure.message
    assert (failure.deficits, failure.relaxations) == ((), ())
    np.testing.assert_array_equal(beat.scaled, closed.scaled)
    # Of those that close the one that closes best is told.
    rough, best = (
        dataclasses.replace(closed, optimal=False, violation=v, scaled=closed.scaled + v) for v in (0.2, 0.1)
    )
    beat, failure = without_orbit(programme, [astray, rough, best], 1, advise=False)
    assert "closed wingbeats were found from 3 starts, but none could be certified" in failure.message
    np.testing.assert_array_equal(beat.scaled, best.scaled)
    beat, failure = unexplained([astray, rough, best])
    assert (failure.status, beat.scaled is best.scaled) == (Status.NOT_CONVERGED, True)


def test_who_asks_for_no_explanation_is_told_that_there_is_no_orbit_and_spared_the_search_for_why():
    problem = solved("too slow").problem
    found = find_orbit(problem, Settings(2, most_starts=2, advise=False, explain=False), threads=1)
    assert (found.status, found.deficits, found.relaxations) == (Status.INFEASIBLE, (), ())
    assert found.message == "no orbit within the bounds from 2 starts; the balance that fails was not computed"
    explained = find_orbit(problem, Settings(2, most_starts=2, advise=False), threads=1)
    assert explained.deficits


@pytest.mark.parametrize(
    ("shortage", "words"),
    [
        (Deficit(LIFT, 0.123, 0.4), "lift is short by 12 % of the weight"),
        (Deficit(LIFT, -0.05, -0.2), "lift is too large by 5 % of the weight"),
        (Deficit(THRUST, 1.234, 4.0), "thrust is short of drag by 120 % of the weight"),
        (Deficit(THRUST, -0.02, -0.1), "thrust exceeds drag by 2 % of the weight"),
        (Deficit(MOMENT, -0.5, -0.17), "a nose-down pitching moment of 0.17 N m is lacking"),
    ],
)
def test_a_shortage_in_words(shortage, words):
    assert str(shortage).startswith(words)


@pytest.mark.parametrize(
    ("name", "sign", "old", "reach", "value", "text", "new"),
    [
        ("flap_amplitude", "<=", math.radians(70), 1.5, math.radians(82.31), "70 -> 83 deg", math.radians(83)),
        ("pitch_mean", ">=", math.radians(-30), -1.5, math.radians(-41.2), "-30 -> -42 deg", math.radians(-42)),
        ("mass", "=", 0.316, 0.07, 0.28764, "0.316 -> 0.287 kg (-9.2 %, by a lighter body)", 0.287),
        ("speed", "=", 3.0, 18.0, 3.4001, "speed 3 -> 3.41 m/s", 3.41),
        ("speed", "=", 10.0, 0.0, 4.2, "speed 10 -> 4.2 m/s", 4.2),
        ("shoulder", "=", -0.15, 0.07, -0.0623, "shoulder -150 -> -62 mm", -0.062),
        ("peak_flap_torque", "<=", 0.1, 3.0, 0.1371, "upper limit of peak_flap_torque 0.1 -> 0.138 N m", 0.138),
        ("mean_power", ">=", 30.0, -900.0, -4.31, "lower limit of mean_power 30 -> -5 W", -5.0),
    ],
)
def test_a_change_is_rounded_outward_and_applied(name, sign, old, reach, value, text, new):
    problem = wb.OrbitProblem(PIGEON, speed=10.0, subject_to=["peak_flap_torque<=0.1", "mean_power>=30"])
    change = relaxation(problem, Change(name, sign, old, reach, abs(reach - old)), value)
    assert text in change.text
    assert change.new == pytest.approx(new, rel=1e-12)
    applied = change.apply(problem)
    if name == "mass":
        assert applied.vehicle.mass == pytest.approx(new)
        assert applied.vehicle.wing == problem.vehicle.wing
    elif name == "shoulder":
        assert applied.vehicle.wing.shoulder == (new, *problem.vehicle.wing.shoulder[1:])
    elif name == "speed":
        assert applied.speed == new
    elif name in problem.bounds:
        assert applied.bounds[name][sign == "<="] == change.new
    else:
        (limit,) = (c for c in applied.subject_to if is_limit(c, name, sign))
        assert limit.limit == change.new
        assert len(applied.subject_to) == 2


def test_what_is_held_is_held_elsewhere():
    problem = wb.OrbitProblem(PIGEON, speed=10.0, subject_to="pitch_mean=0")
    moved = with_change(problem, "pitch_mean", "=", -0.1)
    assert moved.species.wingbeat.pitch_mean == -0.1
    assert moved.free == problem.free


@pytest.mark.parametrize(("name", "value"), [("mass", 0.25), ("shoulder", 0.01)])
def test_what_is_held_stays_held_when_the_vehicle_changes(name, value):
    problem = wb.OrbitProblem(PIGEON, speed=10.0, subject_to="flap_amplitude=40 deg")
    moved = with_change(problem, name, "=", value)
    for species in (problem.species, moved.species, moved.species.with_values({"air.density": 1.0})):
        assert species.wingbeat.flap_amplitude == pytest.approx(math.radians(40))
        assert species.numbers["wingbeat.flap_amplitude"].value == pytest.approx(math.radians(40))
    assert moved.species.numbers["vehicle.mass"].value == moved.vehicle.mass


def test_every_law_of_the_wingbeat_can_be_advised_on():
    """No bound is moved to where no wingbeat is: a sweep of a right angle, a span that vanishes."""
    bounds = {
        "downstroke_fraction": (0.4, 0.6),
        "pitch_phase": (-0.1, 0.1),
        "sweep_mean": (-0.1, 0.1),
        "sweep_amplitude": (0.0, 0.2),
        "flap_sin_2": (-0.1, 0.1),
        "span_cos_1": (-0.1, 0.1),
    }
    problem = wb.OrbitProblem(PIGEON, speed=10.0, free=(*PIGEON.free, *bounds), bounds=bounds)
    at_bounds = [(name, sign) for name in bounds for sign in ("<=", ">=")]
    changes = [c for c in possible_changes(problem, at_bounds, {}) if c.name in bounds]
    assert {c.name for c in changes} == bounds.keys()
    for change in changes:
        applied = with_change(problem, change.name, change.sign, change.reach)
        assert applied.bounds[change.name][change.sign == "<="] == change.reach
        assert relaxation(problem, change, change.moved(0.1)).text


def test_a_harmonic_that_was_held_is_moved():
    flapping = dataclasses.replace(PIGEON.wingbeat, flap_harmonics=(0.0, 0.05))
    species = dataclasses.replace(
        PIGEON.with_record(flapping),
        bounds={**PIGEON.bounds, "flap_sin_2": (-0.1, 0.1)},
        free=("frequency", "pitch_mean"),
    )
    problem = wb.OrbitProblem(species, speed=10.0)
    changes = [c for c in possible_changes(problem, [], {}) if c.name == "flap_sin_2"]
    assert {(c.sign, c.old) for c in changes} == {("=", 0.05)}
    moved = with_change(problem, "flap_sin_2", "=", -0.02)
    assert moved.species.wingbeat.flap_harmonics == (0.0, -0.02)


def test_optima_worth_the_same_are_told_with_where_they_differ(bat_orbit):
    solution = find_orbit(bat_orbit.problem, Settings(2))
    assert rivals(solution) == []
    other = solution.unknowns.copy()
    other[solution.problem.unknowns().names.index("flap_mean")] += math.radians(10)
    near, far = (type(solution.optima[0])(solution.objective * times, other) for times in (1.005, 1.05))
    (told,) = rivals(dataclasses.replace(solution, optima=(near, far, *solution.optima)))
    assert "within 1 % of the best: 1;" in told
    assert "flap_mean" in told
    assert rivals(dataclasses.replace(solution, optima=(far,))) == []


def test_no_more_searches_are_told_of_than_there_are():
    problem = wb.OrbitProblem(wb.load_species("pigeon"), 10.0, subject_to=["peak_power<=20"])
    told = []
    find_orbit(problem, Settings(1, most_starts=3, advise=False), progress=lambda *counts: told.append(counts))
    assert told == [(1, 2), (2, 2), (2, 3), (3, 3)]  # the second of the first two is without the limit


TAILED = wb.robot(mass=0.25, wing_span=0.8, wing_area=0.1, tail_area=0.03, tail_arm=0.3, tail_lift_slope=2.5)


def test_a_tail_may_be_trimmed_both_ways_unless_its_tilt_is_free():
    tailed = TAILED.with_values({"tail.incidence_deg": 15.0})
    problem = wb.OrbitProblem(tailed, speed=7.0)
    up, down = (change for change in possible_changes(problem, (), {}) if change.name == "incidence")
    assert (up.reach, down.reach) == (pytest.approx(math.radians(45.0)), pytest.approx(math.radians(-45.0)))
    told = relaxation(problem, down, math.radians(1.2))
    assert told.text == "tail incidence 15 -> 1 deg"
    moved = told.apply(problem).vehicle
    assert moved.tail.incidence == pytest.approx(math.radians(1.0))
    assert moved.wing == tailed.vehicle.wing
    tilting = dataclasses.replace(
        problem, free=(*problem.free, "tail_tilt"), bounds=problem.bounds | {"tail_tilt": (-0.5, 0.5)}
    )
    for untrimmed in (tilting, wb.OrbitProblem(PIGEON, speed=7.0)):
        assert not [change for change in possible_changes(untrimmed, (), {}) if change.name == "incidence"]


@pytest.mark.slow
def test_a_robot_out_of_trim_flies_with_the_tail_that_is_advised():
    """Nose up by 10 degrees with little pitching: 15 degrees of incidence are neither a high nor a low tail."""
    limits = ["body_pitch_range<=5 deg", "mean_body_pitch>=10 deg"]
    tailed = TAILED.with_values({"tail.incidence_deg": 15.0})
    problem = wb.OrbitProblem(tailed, speed=7.0, minimise="mean_positive_power", subject_to=limits)
    orbit = wb.solve_orbit(problem, starts=3)
    assert orbit.status is wb.Status.INFEASIBLE
    first = orbit.relaxations[0]
    assert first.name == "incidence"
    assert wb.solve_orbit(first.apply(problem), starts=3, seed=7).status is wb.Status.CONVERGED
    half = dataclasses.replace(first, new=0.5 * (first.old + first.new))
    assert wb.solve_orbit(half.apply(problem), starts=3, seed=7).status is wb.Status.INFEASIBLE
