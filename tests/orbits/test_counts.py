"""How many optima the starts found, and how many starts ended at the best: the numbers must add up."""

import dataclasses

import numpy as np

import wingbeat as wb
from wingbeat.orbits.solution import Optimum, at_orbit, better_of
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.records.orbit_record import orbit_warnings

PLACE = np.ones(2), 0.05


def optima(*places):
    return [Optimum(1.0 + place, np.array([place, 0.0]), starts) for place, starts in places]


def test_all_families_beside_the_orbit_are_its_own():
    """Two of one orbit's families were once two distinct optima, in one of which all starts ended."""
    found = optima((0.0, 5), (0.06, 1), (3.0, 2))
    assert at_orbit(found, np.array([0.03, 0.0]), *PLACE) == found[:2]


def test_the_certifier_may_move_an_orbit_out_of_its_family():
    """Of six starts that all ended there, one was once counted."""
    found = optima((0.0, 6), (3.0, 2))
    assert at_orbit(found, np.array([0.07, 0.0]), *PLACE) == found[:1]
    assert at_orbit([], np.zeros(2), *PLACE) == []


def test_the_warning_counts_each_start_once():
    solution = find_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), Settings(1))
    here, scale = solution.unknowns, solution.problem.unknowns().scale
    beside = [
        Optimum(solution.objective + 0.1 * i, here + place * scale) for i, place in enumerate((-0.03, 0.03, 1.0))
    ]
    split = dataclasses.replace(solution, optima=tuple(beside), starts=3)
    both = better_of(split, dataclasses.replace(split, optima=(beside[2],), starts=1))
    assert (both.starts, both.starts_at_best, both.distinct_optima) == (4, 2, 2)
    said = "4 starts found 2 distinct optima; 2 ended in this one"
    assert any(note.startswith(said) for note in orbit_warnings(both, both.beat()))


def test_a_guessed_bound_says_where_it_is_listed():
    pigeon = wb.load_species("pigeon")
    solution = find_orbit(wb.OrbitProblem(pigeon, speed=12.0), Settings(1))
    at_bound = dataclasses.replace(solution, active_bounds=("flap_amplitude",))
    (note,) = (note for note in orbit_warnings(at_bound, solution.beat()) if "that bound is a guess" in note)
    assert note.endswith("see `wingbeat species NAME`")
    origin = wb.models.animal(pigeon).problem(pigeon, speed=12.0).origin
    by_model = dataclasses.replace(at_bound, problem=dataclasses.replace(solution.problem, origin=origin))
    (note,) = (note for note in orbit_warnings(by_model, solution.beat()) if "that bound is a guess" in note)
    assert note.endswith("see `wingbeat species NAME --model animal`")
