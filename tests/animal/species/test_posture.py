"""What live animals of a kind change in flight: parameters that the model animal frees, and the body's pitch."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.animal.kinematics import FREE_NAMES
from wingbeat.animal.species.posture import free_of, with_free_stroke, with_posture
from wingbeat.records.inputs import problem_from
from wingbeat.results.orbit import inputs_of

PIGEON, BAT = wb.load_species("pigeon"), wb.load_species("bat")


def pitch_at(species, speed):
    return np.degrees(with_posture(species, speed).path_bounds["body_pitch"])


@pytest.mark.parametrize("kind", ["bird", "bat", "robot"])
def test_every_range_is_that_of_a_parameter_and_a_guess_says_so(kind):
    for name, bound in free_of(kind).items():
        assert name in FREE_NAMES
        assert bound.bounds[0] < bound.bounds[1]
        assert bound.guessed == bound.reason.startswith("guess")


def test_bounds_of_the_body_fall_with_speed_and_hold_between_the_speeds_known():
    slow, cruise, fast = (pitch_at(PIGEON, speed) for speed in (4.0, 13.68, 30.0))
    assert (slow > cruise).all()
    assert (cruise > fast).all()
    np.testing.assert_allclose(cruise, [-15.0, 30.0], atol=0.1)
    np.testing.assert_allclose(fast, [-20.0, 25.0])
    assert "guess" in with_posture(PIGEON, 9.0).reasons["body_pitch"]
    assert "body_pitch" in PIGEON.guessed_bounds


def test_what_is_no_guess_stays():
    known = dataclasses.replace(PIGEON, guessed_bounds=frozenset({"flap_mean"}))
    assert with_posture(known, 9.0) is known
    assert with_free_stroke(known).bounds["frequency"] == PIGEON.bounds["frequency"]
    firm = dataclasses.replace(PIGEON, guessed_bounds=frozenset())
    assert with_free_stroke(firm).bounds["flap_mean"] == PIGEON.bounds["flap_mean"]
    assert with_free_stroke(PIGEON).bounds["flap_mean"] == free_of("bird")["flap_mean"].bounds


def test_what_has_no_effect_stays_fixed():
    assert "tail_tilt" not in with_free_stroke(BAT).free
    assert "stroke_plane_tilt" not in with_free_stroke(BAT).free  # the body has no attitude that counts
    assert "stroke_plane_tilt" in wb.models.animal(BAT).species(BAT).free  # drag depends on the attitude
    assert {"tail_tilt", "stroke_plane_tilt"} <= set(with_free_stroke(PIGEON.with_tail()).free)


@pytest.mark.parametrize("species", [PIGEON, BAT], ids=lambda one: one.name)
def test_a_problem_of_the_model_animal_moves_its_posture_with_speed(species):
    problem = wb.models.animal(species).problem(species, 8.0)
    assert problem.bounds["body_pitch"] == with_posture(problem.species, 8.0).path_bounds["body_pitch"]
    moved = problem.at_speed(6.0)
    fresh = wb.models.animal(species).problem(species, 6.0)
    assert (moved.bounds, moved.species.path_bounds) == (fresh.bounds, fresh.species.path_bounds)
    back = problem_from(inputs_of(problem, 6, 0))
    assert back.origin == problem.origin
    assert back.at_speed(6.0).bounds == moved.bounds


def test_own_bounds_of_the_body_stay_at_every_speed():
    own = {"body_pitch": (-0.1, 0.2)}
    problem = wb.models.animal(PIGEON).problem(PIGEON, 12.0, bounds=own)
    assert problem.at_speed(8.0).bounds["body_pitch"] == (-0.1, 0.2)
