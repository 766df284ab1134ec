"""What makes an orbit stable: derivatives against orbits solved again, and shares by counting."""

import json

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.cli import main
from wingbeat.orbits.flight.certificate import multipliers_of
from wingbeat.orbits.problem.quantity import MAP_QUANTITIES
from wingbeat.orbits.solution import correct_guess
from wingbeat.orbits.uncertainty import sample_orbits
from wingbeat.records.shares import StableShare, stable_share
from wingbeat.stability.causes import multiplier_slopes

RADIUS = MAP_QUANTITIES["spectral_radius"]
# Steps of the differences; a shoulder moves by a thousandth of a chord.
STEPS = {"wing.shoulder.x": 1e-4, "wing.shoulder.z": 1e-4, "body.pitch_inertia": 4e-6, "wing.mass": 2e-4}


@pytest.fixture(scope="module")
def causes(cruise):
    return wb.stability_sensitivities(cruise)


def solved_beside(orbit, slope, step):
    """Return the certified orbits with one number a step lower and a step higher."""
    moved = np.array([*slope.initial_state.values(), *slope.wingbeat.values()])
    parameter = slope.parameter
    return [
        correct_guess(parameter.changed(orbit.problem, parameter.value + by), orbit.unknowns + by * moved)
        for by in (-step, step)
    ]


def test_the_multipliers_move_as_those_of_orbits_solved_again(cruise, causes):
    checked = 0
    for slope in causes.sensitivities.slopes:
        step = STEPS.get(slope.parameter.path)
        if step is None:
            continue
        below, above = solved_beside(cruise, slope, step)
        assert below is not None
        assert above is not None
        found = causes.by_parameter[slope.parameter.path]
        anew = (above.multipliers - below.multipliers) / (2 * step)
        np.testing.assert_allclose(found, anew, rtol=0, atol=0.01 * np.abs(anew).max())
        radius = (above.value_of(RADIUS) - below.value_of(RADIUS)) / (2 * step)
        assert slope.quantities["spectral_radius"] == pytest.approx(radius, rel=0.005)
        checked += 1
    assert checked == len(STEPS)


def test_the_radius_moves_as_its_multiplier(causes):
    """Two ways: the difference of the eigenvalues, and the eigenvectors of the matrix and its derivative."""
    largest = causes.multipliers[0]
    assert causes.spectral_radius == pytest.approx(abs(largest))
    for slope in causes.sensitivities.slopes:
        moved = causes.by_parameter[slope.parameter.path][0]
        along = (np.conj(largest) * moved).real / abs(largest)
        assert slope.quantities["spectral_radius"] == pytest.approx(along, rel=1e-4, abs=1e-6)


def test_eigenvalues_of_any_matrix_move_as_their_differences():
    generator = np.random.default_rng(3)
    for _ in range(20):
        matrix, change = generator.normal(size=(2, 4, 4))
        step = 1e-6
        ends = [multipliers_of(matrix + sign * step * change) for sign in (-1, 1)]
        anew = (ends[1] - ends[0]) / (2 * step)
        np.testing.assert_allclose(multiplier_slopes(matrix, change), anew, rtol=1e-5, atol=1e-5)


@pytest.mark.slow
def test_the_command_names_what_moves_the_radius(cruise, causes, tmp_path, capsys):
    path = str(tmp_path / "pigeon.nc")
    cruise.save(path)
    assert main(["stability", path, "--sensitivities"]) == 0
    printed = capsys.readouterr().out
    assert "what moves the spectral radius 1.346 most" in printed
    first = next(line for line in printed.splitlines() if "wing.shoulder" in line)
    assert first.split()[:3] == ["wing.shoulder.x", "0", "m"]
    assert "per m" in first
    assert main(["stability", path, "--sensitivities", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)["sensitivities"]
    assert record["spectral_radius"] == pytest.approx(causes.spectral_radius, rel=1e-6)
    shoulder = record["parameters"][0]
    assert (shoulder["parameter"], shoulder["unit"], len(shoulder["multipliers"])) == ("wing.shoulder.x", "m", 4)
    low, high = shoulder["plausible"]
    slope = shoulder["spectral_radius"]
    assert shoulder["change_to_ends"] == pytest.approx([slope * low, slope * high])
    assert set(record["prices"]) == {"bounds.flap_amplitude.upper"}
    assert main(["stability", path, "--json"]) == 0
    assert "sensitivities" not in json.loads(capsys.readouterr().out)


@pytest.mark.slow
def test_the_share_of_stable_orbits_is_that_of_counting(cruise, causes):
    """Draws about a shoulder that is nearly high enough, solved and counted one by one."""
    slopes = {slope.parameter.path: slope for slope in causes.sensitivities.slopes}
    raised = slopes["wing.shoulder.z"].parameter.changed(cruise.problem, 0.0105)
    found = wb.sensitivities(wb.solve_orbit(raised, starts=2), ["spectral_radius", "frequency"])
    compared = wb.uncertainty_by_samples(found, ["frequency", "spectral_radius"], samples=24, seed=1, share=0.05)
    share = compared["spectral_radius"].stable
    assert share is not None
    spreads = found.spreads(share=0.05)
    parameters = [parameter for spread in spreads for parameter in spread.parameters]
    drawn = sample_orbits(raised, found.unknowns, found.slopes, spreads, [RADIUS], 24, seed=1)
    stable = 0
    for deviations in drawn.deviations:
        problem = raised
        for parameter, deviation in zip(parameters, deviations, strict=True):
            problem = parameter.changed(problem, parameter.value + deviation)
        stable += wb.solve_orbit(problem, starts=1).record()["stable"]
    assert (share.stable, share.certified, share.drawn) == (stable, 24, 24)
    assert 0 < stable < 24
    assert compared["frequency"].stable is None


def test_the_share_has_its_binomial_error():
    assert str(StableShare(124, 200, 200)) == "stable in 62 % of 200 orbits, 55 to 68 %"
    assert str(StableShare(5, 10, 12)).endswith("; 2 of 12 draws have no orbit")
    assert str(stable_share(np.zeros(0), 3)) == "none of 3 draws has a certified orbit"
    assert stable_share(np.array([0.5, 1.0, 1.2, 0.999]), 5) == StableShare(2, 4, 5)
    # Wilson's ends are where a share p is just 1.96 of its own standard deviations from the share that was found.
    for stable, count in ((0, 20), (3, 20), (124, 200), (20, 20)):
        share, (low, high) = stable / count, StableShare(stable, count, count).interval
        for end in (low, high):
            if 0 < end < 1:
                deviation = np.sqrt(end * (1 - end) / count)
                assert abs(share - end) == pytest.approx(1.96 * deviation)
        assert low <= share <= high
    assert StableShare(0, 20, 20).interval[1] > 0.1


@pytest.mark.slow
def test_the_command_uncertainty_says_how_often_it_is_stable(capsys):
    words = ["uncertainty", "pigeon", "--speed", "12", "--samples", "10", "--share", "0.1"]
    asked = [*words, "--quantities", "spectral-radius", "gust_response"]
    assert main([*asked, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert set(told) == {"spectral_radius", "gust_response"}
    counted = told["spectral_radius"]["stable"]
    assert counted["drawn"] == 10
    assert counted["share"] == counted["stable"] / counted["certified"]
    assert told["gust_response"]["stable"] is None
    assert main(words) == 0
    printed = capsys.readouterr().out
    assert "the verdict `stable`" in printed
    assert f"stable in {100 * counted['share']:.0f} % of 10 orbits" in printed
    assert "frequency" in printed


def test_what_the_animal_lacks_is_refused(capsys):
    for name in ("elegance", "metabolic_power"):
        assert main(["uncertainty", "pigeon", "--speed", "12", "--quantities", name]) == 2
        assert name in capsys.readouterr().err
