"""Manoeuvres: each beat ends where the next begins, the wing never jumps, and feedback holds the way."""

import json

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from tests.helpers.reflight import refly
from wingbeat._base import InvalidInputError
from wingbeat.cli import main
from wingbeat.orbits.flight.period import PITCH_STATE
from wingbeat.plots import manoeuvre_page
from wingbeat.stability.inputs import top_of
from wingbeat.stability.manoeuvre_search import BeatMap
from wingbeat.stability.riccati import closed_loop

SCALES = np.array([0.2, 0.1, 1.0, 1.0, 2.0])


@pytest.fixture(scope="module")
def cruise():
    return wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)


@pytest.fixture(scope="module")
def plan(cruise):
    return wb.manoeuvre(cruise, [13.0, 12.0], beats=16)


def samples_of(flight):
    return (len(flight.time) - 1) // len(flight.wingbeats)


def tops(flight):
    return flight.states[:: samples_of(flight)]


def test_it_is_certified_and_says_so(plan):
    assert plan.status is wb.Status.CONVERGED
    assert plan.message.startswith("certified: 32 beats")
    assert plan.legs == (16, 16)
    assert plan.defect < 1e-6
    assert plan.states.shape == (33, 5)
    assert plan.changes.shape == (32, 5)


def test_the_derivatives_of_a_beat_are_those_of_differences(cruise):
    beat = BeatMap(cruise, None, 2)
    state, changes = beat.start, np.array([0.2, 0.01, -0.02, 0.01, 0.02])
    found, step = beat(state, changes), 1e-6
    for i in range(5):
        ahead, behind = (beat(state + sign * step * np.eye(5)[i], changes) for sign in (1, -1))
        np.testing.assert_allclose((ahead.end - behind.end) / (2 * step), found.A[:, i], rtol=1e-5, atol=1e-5)
        assert (ahead.advance - behind.advance) / (2 * step) == pytest.approx(found.advance_slope[i], abs=1e-5)
    for i in range(5):
        ahead, behind = (beat(state, changes + sign * step * np.eye(5)[i]) for sign in (1, -1))
        np.testing.assert_allclose((ahead.end - behind.end) / (2 * step), found.B[:, i], rtol=1e-5, atol=1e-4)
        assert (ahead.frequency - behind.frequency) / (2 * step) == pytest.approx(
            found.frequency_slope[i], abs=1e-6
        )


def test_scipy_flies_each_beat_from_one_top_to_the_next(plan):
    """An integrator that is not ours, for some of the beats."""
    model = plan.beat_map.orbit.problem.model
    for k in (0, 15, 31):
        start = np.concatenate([[0.0, plan.states[k, 0]], plan.states[k, 1:]])
        end = refly(model, plan.beat_map.wingbeat(plan.changes[k]), start).end
        assert np.abs((end[1:] - plan.states[k + 1]) / SCALES).max() < 1e-6
        assert end[0] == pytest.approx(plan.advances[k], abs=1e-4)


def test_the_ends_are_periodic_flights_at_their_speeds(plan):
    for end, speed in zip(plan.ends, (13.0, 12.0), strict=True):
        assert end.speed == speed
        assert 0.0 < end.defect < 1e-6
        state, advance = plan.beat_map.exactly(end.state, end.changes)
        assert np.abs((state - end.state) / SCALES).max() < 1e-6
        assert advance * end.frequency == pytest.approx(speed, abs=1e-6)
    assert plan.ends[1].changes == pytest.approx(0.0, abs=1e-12)  # back on the first orbit
    best = wb.solve_orbit(plan.beat_map.orbit.problem.at_speed(13.0), starts=2).wingbeat.frequency
    # Second harmonics make the tops equal; they may save or cost a little.
    assert plan.ends[0].frequency == pytest.approx(best, rel=0.02)
    assert plan.free_frequencies[0] == pytest.approx(best, rel=1e-3)


def test_the_wing_never_jumps(plan):
    beats = [plan.beat_map.wingbeat(change) for change in plan.changes]
    first = top_of(plan.beat_map.orbit.wingbeat)
    assert max(np.abs(top_of(beat) - first).max() for beat in beats) == plan.largest_jump < 1e-9
    assert len({round(beat.frequency, 6) for beat in beats}) > 10


def test_the_flight_follows_the_plan_and_holds_the_last_orbit(plan):
    flight = plan.fly(after=6)
    flown = tops(flight)
    assert np.abs((flown[:33, 1:] - plan.states) / SCALES).max() < 1e-4
    assert np.abs((flown[-1, 1:] - plan.states[-1]) / SCALES).max() < 1e-4
    assert flight.time[32 * samples_of(flight)] == pytest.approx(plan.times[-1])
    assert flown[32, 0] == pytest.approx(plan.advances.sum(), abs=1e-4)


def test_feedback_saves_the_flight_from_a_gust_that_would_end_it(plan):
    gust = wb.winds.CosineGust(w=2.0, start=0.5 * plan.times[-1], duration=0.3)
    held, free = (plan.fly(gust, feedback=feedback, after=16) for feedback in (True, False))
    last = plan.ends[-1].state
    assert np.abs((tops(held)[-1, 1:] - last) / SCALES).max() < 0.5
    assert not np.abs((tops(free)[-1, 1:] - last) / SCALES).max() < 5.0


def test_no_command_exceeds_its_limit(plan):
    controller = plan.controller()
    beats = [controller(k, wb.State(0, 0, *(state[1:] + 1.0))) for k, state in enumerate(plan.states)]
    commands = np.array(controller.commands)
    assert len(beats) == len(commands)
    assert (commands >= plan.lower - 1e-12).all()
    assert (commands <= plan.upper + 1e-12).all()


def test_the_gains_hold_the_last_orbit(plan):
    held = plan.beat_map(plan.ends[-1].state, plan.ends[-1].changes)
    assert plan.gains.shape == (33, 5, 5)
    assert np.abs(np.linalg.eigvals(held.A - held.B @ plan.gains[-1])).max() < 1.0


def test_feedback_that_acts_a_beat_later_holds_the_way_too(cruise):
    late = wb.manoeuvre(cruise, [12.5], beats=8, delay=1)
    assert late.status is wb.Status.CONVERGED
    assert late.gains.shape == (9, 5, 10)
    held = late.beat_map(late.ends[-1].state, late.ends[-1].changes)
    assert np.abs(np.linalg.eigvals(closed_loop(held.A, held.B, late.gains[-1], 1))).max() < 1.0
    flown = tops(late.fly(wb.winds.CosineGust(w=2.0, start=0.2, duration=0.3), after=16))
    assert np.abs((flown[-1, 1:] - late.states[-1]) / SCALES).max() < 0.5


def test_the_first_beat_of_late_feedback_is_the_planned_one(cruise):
    late = wb.manoeuvre(cruise, [12.5], beats=8, delay=1)
    pilot, pushed = late.controller(), wb.State(0, 0, *(late.states[0, 1:] + [0.02, 0.1, 0.1, 0.1]))
    pilot(0, pushed)
    pilot(1, wb.State(0, 0, *late.states[1, 1:]))
    np.testing.assert_array_equal(pilot.commands[0], late.changes[0])
    assert np.abs(pilot.commands[1] - late.changes[1]).max() > 1e-3


@pytest.mark.slow
def test_beats_are_doubled_until_they_suffice(cruise):
    fast = wb.ManoeuvreOptions(acceleration=2.0)
    plan = wb.manoeuvre(cruise, [14.0], options=fast)
    half = wb.manoeuvre(cruise, [14.0], beats=plan.legs[0] // 2)
    assert (plan.status, half.status) == (wb.Status.CONVERGED, wb.Status.NOT_CONVERGED)


def test_a_wing_that_jumps_is_not_certified(cruise):
    rounding = wb.manoeuvre(cruise, [12.5], beats=8, options=wb.ManoeuvreOptions(jump=1e-300))
    assert rounding.status is wb.Status.NOT_CONVERGED
    assert "the wing jumps by" in rounding.message


def test_too_few_beats_end_with_advice(cruise):
    hasty = wb.manoeuvre(cruise, [15.0], beats=4)
    assert hasty.status is wb.Status.NOT_CONVERGED
    assert hasty.message.endswith("give more beats")
    json.dumps(hasty.record(), allow_nan=False)


@pytest.mark.slow
def test_a_speed_that_nothing_flies_at_is_named(cruise):
    lost = wb.manoeuvre(cruise, [90.0])
    assert lost.status is wb.Status.NOT_CONVERGED
    assert "there is no certified orbit at 90 m/s" in lost.message
    assert lost.legs == ()


@pytest.mark.parametrize(
    ("speeds", "options", "words"),
    [
        ([], {}, "must be a list of speeds"),
        (14.0, {}, "must be a list of speeds"),
        ([float("nan")], {}, r"speeds\[0\] = nan"),
        ([14.0], {"beats": 1}, "beats = 1: must be a whole number from 2 to 300"),
        ([14.0], {"beats": 0}, "beats = 0: must be a whole number from 2 to 300"),
        ([14.0], {"delay": 5}, "delay = 5"),
        ([14.0], {"inputs": ["flapping"]}, "flapping"),
    ],
)
def test_what_makes_no_sense_is_refused(cruise, speeds, options, words):
    with pytest.raises(InvalidInputError, match=words):
        wb.manoeuvre(cruise, speeds, **options)


def test_an_orbit_without_certificate_is_refused():
    heavy = wb.load_species("pigeon").with_values({"body.mass": 3.0})
    with pytest.raises(InvalidInputError, match="is not certified"):
        wb.manoeuvre(wb.solve_orbit(wb.OrbitProblem(heavy, 3.0), starts=1), [5.0])


def test_a_wing_that_gives_way_is_refused_before_the_first_orbit_is_searched(capsys, monkeypatch):
    monkeypatch.delattr("wingbeat.cli.manoeuvre.solve_orbit")
    given = ["robofalcon2", "--speed", "8", "--to", "9", "--set", "pitch_hinge.stiffness=1.4"]
    assert main(["manoeuvre", *given]) == 2
    assert "gives way, and manoeuvres do not know the hinge" in " ".join(capsys.readouterr().err.split())


def test_the_record_and_the_page(plan):
    record = json.loads(json.dumps(plan.record(), allow_nan=False))
    assert record["status"] == "converged"
    assert [end["speed"] for end in record["ends"]] == [13.0, 12.0]
    assert record["state"][1:] == list(PITCH_STATE)
    assert np.shape(record["gains"]) == (33, 5, 5)
    figure = manoeuvre_page(plan, {"with feedback": plan.fly(after=2)})
    assert len(figure.axes) == 4
    check_legends(figure)
    assert all(axes.get_xlabel() == "time [s]" for axes in figure.axes)


def test_the_command(tmp_path, capsys):
    drawn = tmp_path / "manoeuvre.png"
    asked = ["manoeuvre", "pigeon", "--speed", "12", "--to", "12.5", "--beats", "8", "--starts", "2"]
    assert main([*asked, "--gust", "w=1", "--plot", str(drawn)]) == 0
    printed = capsys.readouterr().out
    assert "certified: 8 beats" in printed
    assert "without feedback: ends" in printed
    assert drawn.stat().st_size > 10_000
    assert main([*asked[:5], "15", *asked[6:], "--json"]) == 3
    assert json.loads(capsys.readouterr().out)["status"] == "not-converged"


def test_the_command_starts_from_a_saved_orbit(cruise, tmp_path, capsys):
    saved = tmp_path / "cruise.nc"
    cruise.save(saved)
    asked = ["manoeuvre", str(saved), "--to", "12.5", "--beats", "8", "--delay", "1", "--json"]
    assert main(asked) == 0
    assert json.loads(capsys.readouterr().out)["delay"] == 1
    assert main([*asked, "--speed", "12"]) == 2
    assert "is a saved orbit" in capsys.readouterr().err


def test_the_command_asks_for_the_speed_at_the_start(capsys):
    assert main(["manoeuvre", "pigeon", "--to", "14"]) == 2
    assert "--speed" in capsys.readouterr().err
