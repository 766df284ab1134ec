"""The curve against speed: in which order its points are solved, from which neighbour, and when it stops."""

import dataclasses

import pytest

from wingbeat._workers.pool import Event
from wingbeat_explorer.app.links import from_plain
from wingbeat_explorer.app.scenario import Scenario
from wingbeat_explorer.app.speed_curve import Curve, drawn

HERE = Scenario(speed=10.0, sweep=(8.0, 12.0, 1.0))
ANSWER = {
    "near": "of the answer",
    "plausible": True,
    "measured": ["a bar"],
    "record": {
        "speed": 10.0,
        "status": "converged",
        "mean_positive_power": 5.0,
        "wingbeat": {"frequency": 7.0},
    },
}


class Solver:
    """A session that solves nothing, and notes what it is asked to."""

    def __init__(self):
        self.scenario, self.answer, self.answered = HERE, ANSWER, HERE
        self.asked, self.cancelled = [], []
        self.rests = True

    def start(self, what, hear, background):
        assert background
        self.asked.append(what)
        self.hear = hear
        return len(self.asked)

    def cancel(self, job):
        self.cancelled.append(job)

    @property
    def speed(self):
        return from_plain(self.asked[-1]["scenario"]).speed

    def solve(self, status="converged"):
        """Answer what was asked last."""
        near = f"of {self.speed:g}" if status == "converged" else None
        point = {"speed": self.speed, "status": status, "plausible": False, "near": near}
        self.hear(Event("done", point | {"frequency": 7.0, "mean_positive_power": 5.0}))


@pytest.fixture
def solver():
    return Solver()


@pytest.fixture
def curve(solver):
    return Curve(solver, lambda: None)


def test_it_goes_outwards_from_the_answer_each_point_from_the_nearest(curve, solver):
    curve.follow(HERE, ANSWER)
    order = []
    for _ in HERE.speeds():
        order.append((solver.speed, solver.asked[-1]["near"]))
        solver.solve(status="infeasible" if solver.speed == 12.0 else "converged")
    assert order == [(10, "of the answer"), (11, "of 10"), (12, "of 11"), (9, "of 10"), (8, "of 9")]
    assert not curve.is_running
    words = "4 speeds certified, 1 without an orbit. Lowest power of the certified speeds: 5 W at 8 m/s. "
    assert curve.state == f"{words}Each speed was continued from its neighbour."
    assert curve.measured == ["a bar"]


def test_another_speed_keeps_it_and_another_scenario_begins_it_anew(curve, solver):
    curve.follow(HERE, ANSWER)
    solver.solve()
    assert curve.pending == [8, 9, 11, 12]
    curve.follow(HERE.at(9.3), ANSWER)
    assert (len(solver.asked), len(curve.points)) == (2, 1)
    other = dataclasses.replace(HERE, aero="dickinson")
    assert curve.suits(HERE)
    assert not curve.suits(other)
    curve.follow(other, ANSWER)
    assert (solver.cancelled, len(solver.asked), curve.points) == ([2], 3, [])


def test_what_is_cancelled_keeps_its_points_and_hears_no_more(curve, solver):
    curve.start()
    assert solver.asked[-1]["whole"]
    solver.solve()
    late = solver.hear
    curve.cancel()
    assert (curve.state, curve.pending) == ("Cancelled after 1 of 5 speeds.", [])
    late(Event("lost", "SIGKILL"))
    assert curve.state == "Cancelled after 1 of 5 speeds."


@pytest.mark.parametrize("whole", [False, True])
def test_a_paused_curve_is_finished_when_its_scenario_comes_back(curve, solver, whole):
    if whole:
        curve.start()
    else:
        curve.follow(HERE, ANSWER)
    solver.solve()
    curve.pause()
    assert (curve.state, curve.is_running) == ("Paused after 1 of 5 speeds.", False)
    curve.pause()  # each change of the controls tells it
    curve.follow(HERE, ANSWER)
    while curve.is_running:
        solver.solve()
    assert [point["speed"] for point in curve.points] == HERE.speeds()
    assert [what["whole"] for what in solver.asked] == [whole] * 5 + [whole]  # the interrupted one twice
    # What the visitor has cancelled stays cancelled, and so does what another scenario has replaced.
    curve.start()
    curve.pause()
    curve.cancel()
    curve.follow(HERE, ANSWER)
    assert not curve.is_running


def test_it_gives_way_to_a_search_and_goes_on_after_it(curve, solver):
    curve.follow(HERE, ANSWER)
    solver.rests = False
    solver.solve()  # the point that was being solved
    curve.go_on()
    assert (len(solver.asked), curve.is_running, curve.pending) == (1, True, [8, 9, 11, 12])
    assert curve.state == "1 of 5 speeds; waiting for the search to end."
    solver.rests = True
    curve.go_on()
    curve.go_on()
    assert (len(solver.asked), solver.speed) == (2, 11)


def test_a_curve_that_gave_way_can_be_cancelled(curve, solver):
    solver.rests = False
    curve.start()
    assert curve.is_running
    curve.cancel()
    solver.rests = True
    curve.go_on()
    assert (curve.state, solver.asked, solver.cancelled) == ("Cancelled after 0 of 5 speeds.", [], [])


def test_a_solver_that_dies_is_told_of(curve, solver):
    curve.follow(HERE, ANSWER)
    solver.hear(Event("lost", "SIGKILL"))
    assert curve.state == "Stopped after 0 of 5 speeds: the solver process ended (SIGKILL)."


def test_the_answer_on_the_page_is_one_of_the_points(curve, solver):
    curve.follow(HERE, ANSWER)
    at = ANSWER["record"] | {"speed": 10.5}
    data = drawn(HERE, curve.points, ANSWER | {"record": at}, curve.measured, curve.pending)
    assert data["points"] == [{"speed": 10.5, "power": 5.0, "frequency": 7.0, "certified": True, "plausible": True}]
    assert data["pending"] == [8, 9, 10, 11, 12]
    assert data["range"] == (8.0, 12.0)
