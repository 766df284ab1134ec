"""Where no orbit exists at a given frequency: few starts, and the least frequency, amplitude or twist first."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.orbits.changes import FIRST, holds_frequency, in_turn, possible_changes
from wingbeat.orbits.deficit import Deficit, Nearest, is_clear
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.orbits.starts import start_point

PIGEON = wb.load_species("pigeon")


def at(speed, frequency=6.2):
    return wb.models.animal(PIGEON, frequency).problem(PIGEON, speed=speed)


def test_frequency_amplitude_and_twist_are_tried_first_and_a_slower_beat_last():
    problem = at(8.0)
    at_bounds = [("pitch_mean", ">="), ("twist_ratio", "<="), ("flap_amplitude", "<=")]
    changes = in_turn(possible_changes(problem, at_bounds, {"thrust": 0.2}))
    names = list(dict.fromkeys(change.name for change in changes[:-1]))
    assert names[:3] == list(FIRST)
    assert changes[0].direction > 0
    assert (changes[-1].name, changes[-1].direction) == ("frequency", -1.0)
    # Where the frequency is searched, the order is that of before, and no twist is added.
    searched = wb.OrbitProblem(PIGEON, speed=8.0)
    assert not holds_frequency(searched)
    assert "twist_ratio" not in {change.name for change in possible_changes(searched, [], {})}


def test_outputs_are_read_only_where_they_are_needed():
    """Closure and limits of a flight do not depend on whether the objective, a power, was read."""
    problem = at(14.0)
    start = start_point(problem, 0, 0)
    lazy, eager = Transcription(problem), Transcription(problem)
    scaled = lazy.scaled(start)
    objective = eager.objective(scaled)
    closure = lazy.closure(scaled), lazy.closure_jacobian(scaled), lazy.inequalities(scaled)
    assert [flight.read for flight in lazy._flights.values()] == [False]
    for own, other in zip(
        closure, (eager.closure(scaled), eager.closure_jacobian(scaled), eager.inequalities(scaled)), strict=True
    ):
        np.testing.assert_array_equal(own, other)
    assert lazy.objective(scaled) == objective
    assert [flight.read for flight in lazy._flights.values()] == [True]
    np.testing.assert_array_equal(lazy.objective_gradient(scaled), eager.objective_gradient(scaled))


def test_only_a_clear_deficit_ends_the_search_early():
    few, none = (Nearest(np.zeros(1), (Deficit("lift", share, 1.0),), closes=False) for share in (0.2, 0.02))
    assert is_clear(few, DEFAULTS.diagnosis)
    assert not is_clear(none, DEFAULTS.diagnosis)
    assert not is_clear(dataclasses.replace(few, closes=True), DEFAULTS.diagnosis)


@pytest.mark.slow
def test_the_answer_names_the_least_frequency_first_and_it_flies():
    found = find_orbit(at(4.0))
    assert found.status is wb.Status.INFEASIBLE
    assert "from 12 starts: at 4 m/s and 6.2 Hz, lift is short by" in found.message
    assert "single changes that give an orbit, each the least: frequency 6.2 -> " in found.message
    # The closest wingbeat is at no bound of the twist, so the twist was not tried.
    assert found.message.endswith("; no flap amplitude alone gives one")
    faster = found.relaxations[0]
    assert (faster.name, faster.sign) == ("frequency", "=")
    assert 6.4 < faster.new < 7.5
    assert len(found.relaxations) == 3
    again = find_orbit(faster.apply(at(4.0)), Settings(2, advise=False))
    assert again.status is wb.Status.CONVERGED
    below = at(4.0, 6.2 + 0.5 * (faster.new - 6.2))
    assert find_orbit(below, Settings(advise=False)).status is wb.Status.INFEASIBLE
