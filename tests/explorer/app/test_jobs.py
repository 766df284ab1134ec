"""What the workers do: the same answers as the command line's, and the same memory after many of them."""

import base64
import json
import resource
import threading
import time
from pathlib import Path

import pytest

import wingbeat as wb
from wingbeat._workers.process import Context, StoppedError
from wingbeat_explorer.app.jobs import do
from wingbeat_explorer.app.links import to_plain
from wingbeat_explorer.app.scenario import Scenario
from wingbeat_explorer.app.session import FairPool

PIGEON = Scenario(species="pigeon", speed=10.0, starts=1)


def work(what, stopped=False):
    told = []
    answer = do(what, Context(told.append, lambda: stopped))
    json.dumps(answer, allow_nan=False)  # fit to travel
    return answer


@pytest.fixture(scope="module")
def answer():
    return work({"do": "orbit", "scenario": to_plain(PIGEON)})


@pytest.fixture(scope="module")
def known(answer):
    return {"record": answer["record"], "inputs": answer["inputs"]}


def test_an_orbit_is_that_of_the_library(answer):
    problem = wb.models.paper().problem(wb.load_species("pigeon"), 10.0)
    record = wb.solve_orbit(problem, starts=1).record()
    same = {name: value for name, value in answer["record"].items() if name != "solve_seconds"}
    assert same == {name: value for name, value in record.items() if name != "solve_seconds"}
    face = json.loads(answer["face"])
    assert (face["species"], face["model"], face["status"]) == ("pigeon", "paper", "converged")
    assert face["frequency"] == record["wingbeat"]["frequency"]
    assert face["scene"]["flights"][0]["label"] == "rock pigeon"


def test_a_neighbour_is_continued_in_one_search(answer):
    near = work({"do": "orbit", "scenario": to_plain(PIGEON.at(10.2)), "near": answer["near"]})
    assert near["continued"]
    assert near["record"]["starts"] == 1
    assert near["record"]["status"] == "converged"


def test_what_is_near_something_else_is_not_continued(answer):
    other = {"free": ["frequency"], "unknowns": answer["near"]["unknowns"]}
    assert "continued" not in work({"do": "orbit", "scenario": to_plain(PIGEON), "near": other})


def test_a_continuation_that_fails_counts_as_solving(answer, monkeypatch):
    monkeypatch.setattr("wingbeat_explorer.app.jobs.search_near", lambda problem, start: time.sleep(0.2))
    found = work({"do": "orbit", "scenario": to_plain(PIGEON), "near": answer["near"]})
    assert "continued" not in found
    assert found["seconds"] > found["solver_seconds"] >= found["record"]["solve_seconds"] + 0.2


def test_a_point_is_no_worse_than_its_own_search(answer):
    point = work({"do": "point", "scenario": to_plain(PIGEON), "near": answer["near"], "whole": True})
    assert point["frequency"] <= answer["record"]["wingbeat"]["frequency"] * (1 + 1e-9)
    assert point["status"] == "converged"


def test_a_point_of_the_background_is_its_neighbours_continued(answer, monkeypatch):
    monkeypatch.setattr("wingbeat_explorer.app.jobs.solve_orbit", None)  # no search from every start
    what = {"do": "point", "scenario": to_plain(PIGEON.at(10.5)), "near": answer["near"], "whole": False}
    point = work(what)
    assert (point["speed"], point["status"], point["plausible"]) == (10.5, "converged", False)
    assert point["frequency"] == pytest.approx(answer["record"]["wingbeat"]["frequency"], rel=0.05)


@pytest.mark.slow
def test_a_flight_is_pushed_from_four_sides_and_tells_how_far_it_is(known):
    told = []
    found = do({"do": "pushes", "of": known}, Context(told.append, lambda: False))
    pushes = json.loads(found["pushes"])
    assert {(push["direction"], push["size"]) for push in pushes} == {
        (direction, size) for direction in ("upward", "downward", "head", "tail") for size in (1.0, 3.0)
    }
    assert told == [[done, len(pushes)] for done in range(len(pushes))]
    assert (found["why_not"] == "") == any(push["feedback"] for push in pushes)


@pytest.mark.parametrize(("kind", "start"), [("png", b"\x89PNG"), ("pdf", b"%PDF")])
def test_figures_are_written(known, kind, start):
    assert base64.b64decode(work({"do": "file", "as": kind, "of": known})["content"]).startswith(start)


def test_what_is_refused_names_the_choice():
    scenario = to_plain(PIGEON) | {"set": {"vehicle.wing.mass": -1.0}}
    (where, message) = work({"do": "orbit", "scenario": scenario})["refused"][0]
    assert (where, message) == ("vehicle.wing.mass", "must be > 0 kg; give the mass of one wing")


def test_a_search_that_is_not_wanted_any_more_stops():
    with pytest.raises(StoppedError):
        work({"do": "orbit", "scenario": to_plain(PIGEON)}, stopped=True)


@pytest.mark.slow
def test_memory_is_flat_over_two_hundred_solves():
    pool, memory = FairPool("wingbeat_explorer.app.jobs:do", 1), []
    near = None
    try:
        for count in range(200):
            ended = threading.Event()
            endings = []

            def tell(event, endings=endings, ended=ended):
                if event.ends:
                    endings.append(event)
                    ended.set()

            scenario = to_plain(PIGEON.at(9.0 + 0.02 * (count % 100)))
            assert pool.submit("a", {"do": "orbit", "scenario": scenario, "near": near}, tell) is not None
            assert ended.wait(120.0)
            assert endings[0].kind == "done"
            near = endings[0].value["near"]
            (worker,) = pool.workers
            memory.append(int(Path(f"/proc/{worker}/statm").read_text().split()[1]) * resource.getpagesize())
    finally:
        pool.close()
    assert memory[-1] < 1.05 * memory[40], [round(m / 1e6) for m in memory[::20]]
