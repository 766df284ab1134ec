"""The stroke stays possible: no wing passes through the plane of symmetry, none turns past its joint."""

import dataclasses
import json

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import wingbeat as wb
from wingbeat.cli import main
from wingbeat.orbits.flight.period import SYMMETRY, flier
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.records.orbit_record import crossing

PIGEON, BAT = wb.load_species("pigeon"), wb.load_species("bat")


def lateral_by_hand(species, wingbeat, strips, phase):
    """Return the lateral place of every corner, by vectors straight from model.md, shape (phases, strips, 4)."""
    wing = species.vehicle.wing
    turn = 2 * np.pi * phase
    flap = wingbeat.flap_mean + wingbeat.flap_amplitude * np.cos(turn)
    root = wingbeat.pitch_mean - wingbeat.pitch_amplitude * np.sin(turn)
    r = 0.5 * (1 - np.sin(turn))
    length = wing.semi_span * (1 - wingbeat.span_retraction * r)
    b = wing.stroke_plane_angle
    up, ahead, y = np.array([-np.cos(b), 0, np.sin(b)]), np.array([np.sin(b), 0, np.cos(b)]), np.array([0, 1, 0])

    def times(values, vectors):
        return values[:, None] * vectors

    def spanwise(angle):
        return times(np.cos(angle), y) + times(np.sin(angle), up)

    arm, hand = spanwise(flap), spanwise(flap - wingbeat.fold_amplitude * r)
    found = []
    for i in range(strips):
        eta = (i + 0.5) / strips
        inside = times(min(eta, wingbeat.wrist) * length, arm)
        place = np.array(wing.shoulder) + inside + times(max(eta - wingbeat.wrist, 0) * length, hand)
        e_s = arm if eta <= wingbeat.wrist else hand
        theta = root * (1 + (wingbeat.twist_ratio - 1) * eta)
        e_c = times(np.cos(theta), ahead) + times(np.sin(theta), np.cross(ahead, e_s))
        half = times(0.5 * length / strips, e_s)
        found.append([(place + x * wing.chord * e_c + s * half)[:, 1] for x in (0.25, -0.75) for s in (-1, 1)])
    return np.array(found).transpose(2, 0, 1)


def wingbeats():
    angle = st.floats(-0.9, 0.9)
    return st.builds(
        lambda m, a, pm, pa: (m, a, pm, pa), angle, st.floats(0.1, 1.5), st.floats(-0.5, 0.6), st.floats(0.0, 1.0)
    )


def margins_of(problem):
    """Return the limits of a problem's stroke, and their margins as a function of its free parameters."""
    limits = Transcription(problem)._stroke
    fly = flier(problem.model, problem.species.wingbeat, problem.free, stroke=True)
    return limits, lambda values: limits.margins(fly(values, np.array([0.0, problem.speed, 0.0, 0.0])))


@settings(max_examples=40, deadline=None)
@given(wingbeats(), st.sampled_from(["pigeon", "bat"]))
def test_the_rows_are_the_nearest_that_corners_and_angles_come_to_their_limits(angles, name):
    species = wb.load_species(name)
    problem = wb.OrbitProblem(species, speed=10.0)
    limits, margins = margins_of(problem)
    rows, _ = margins(np.array([8.0, *angles]))
    beat = problem.wingbeat(np.array([0, 10, 0, 0, 8.0, *angles]))
    phase = np.linspace(0, 1, 401)
    y = lateral_by_hand(species, beat, 10, phase) / species.vehicle.wing.semi_span
    corners = [rows[i] for i, (limit, _) in enumerate(limits.names) if limit == SYMMETRY]
    assert min(corners) == pytest.approx(y.min() - 1e-5, abs=2e-4)
    fold = beat.fold_amplitude * 0.5 * (1 - np.sin(2 * np.pi * phase))
    arm = angles[0] + angles[1] * np.cos(2 * np.pi * phase)
    least = min(arm.min(), (arm - fold).min()) + np.pi / 2
    most = np.pi / 2 - max(arm.max(), (arm - fold).max())
    assert rows[8:10].min() == pytest.approx(least, abs=2e-4)
    assert rows[10:].min() == pytest.approx(most, abs=2e-4)


def test_the_derivative_of_the_rows_is_that_of_differences():
    for species in (PIGEON, BAT):
        _, margins = margins_of(wb.OrbitProblem(species, speed=10.0))
        values = np.array([9.0, 0.1, 1.1, 0.05, 0.4])
        _, jacobian = margins(values)
        for i, direction in enumerate(1e-5 * np.eye(5)):
            beside = [margins(values + sign * direction)[0] for sign in (1, -1)]
            np.testing.assert_allclose(jacobian[:, i], (beside[0] - beside[1]) / 2e-5, atol=1e-7)


@pytest.mark.parametrize("name", ["pigeon", "bat"])
@pytest.mark.parametrize("aero", [wb.aero.SuFan(), wb.aero.Dickinson()], ids=["su-fan", "dickinson"])
def test_no_default_orbit_crosses_by_the_corners_of_its_data_set(name, aero):
    for speed in (1.0, 6.0, 10.0, 16.0):
        orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species(name), speed=speed, aero=aero))
        assert orbit.status.value == "converged"
        corners = orbit.dataset["strip_corner"].values[..., 1]
        assert corners.min() >= 0.0
        hand = orbit.dataset["flap"].values - orbit.dataset["fold"].values
        assert max(np.abs(orbit.dataset["flap"].values).max(), np.abs(hand).max()) <= np.pi / 2 + 1e-6
        assert not any("plane of symmetry" in note for note in orbit.record()["warnings"])


def test_wings_that_may_cross_on_request_do_and_draw_a_warning(tmp_path, capsys):
    saved = tmp_path / "bat.nc"
    assert main(["orbit", "bat", "--speed", "10", "--wings-may-cross", "--json", "-o", str(saved)]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["wingbeat"]["frequency"] == pytest.approx(6.990, abs=2e-3)
    assert any("passes through the plane of symmetry" in note for note in record["warnings"])
    orbit = wb.load_orbit(saved)
    assert orbit.dataset["strip_corner"].values[..., 1].min() < -0.04
    assert orbit.problem.wings_may_cross is True
    # So does whoever loads it.
    assert main(["show", str(saved)]) == 0
    assert "passes through the plane of symmetry" in " ".join(capsys.readouterr().out.split())
    assert main(["simulate", "--from", str(saved), "--beats", "1", "--json"]) == 0
    told = capsys.readouterr()
    assert "warning: each wing passes through the plane of symmetry" in told.err
    assert json.loads(told.out)["completed"]


def test_a_stroke_that_is_held_is_flown_and_draws_a_warning():
    beat = dataclasses.replace(PIGEON.wingbeat, flap_mean=-0.6, flap_amplitude=1.3)
    held = wb.OrbitProblem(PIGEON.with_record(beat), speed=12.0, free=("frequency",))
    assert not Transcription(held)._stroke.names
    notes = crossing(held.vehicle, held.aero.strips, beat, held.bounds["flap"])
    assert "through the plane of symmetry" in notes[0]
    assert "-109 to 40 degrees" in notes[1]


def test_the_range_of_the_joint_is_a_number_of_the_species_file_that_an_orbit_keeps_and_reports():
    assert BAT.path_bounds["flap"] == pytest.approx((-np.pi / 2, np.pi / 2))
    assert "guess" in BAT.reasons["flap"]
    narrow = wb.OrbitProblem(BAT, speed=10.0, bounds={"flap": np.radians([-50.0, 60.0]).tolist()})
    orbit = wb.solve_orbit(narrow)
    hand = orbit.dataset["flap"].values - orbit.dataset["fold"].values
    assert np.degrees(hand.min()) >= -50.0001
    assert "flap" in orbit.record()["active_bounds"]
    assert orbit.record()["wingbeat"]["frequency"] > 8.6


def test_a_shoulder_in_the_plane_of_symmetry_leaves_its_root_out():
    inside = wb.OrbitProblem(BAT.with_values({"wing.shoulder": [0.0, 0.0, 0.0]}), speed=10.0)
    orbit = wb.solve_orbit(inside, starts=2)
    assert orbit.status.value == "converged"
    assert np.abs(orbit.dataset["flap"].values).max() <= np.pi / 2 + 1e-6
