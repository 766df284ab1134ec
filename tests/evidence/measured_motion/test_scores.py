"""Scores of forces that are known: scaled, shifted, delayed, noisy, flat; windows; the best sine; the floor."""

import dataclasses
import json
import math

import numpy as np
import pytest

from tests.helpers.strip_cases import flapping_case
from wingbeat_evidence.measured_motion import validate
from wingbeat_evidence.measured_motion.scores import best_sine, floor, score, sine_score

MOTION = flapping_case(mass=0.1, gravity=10.0)
PHASE = 2 * math.pi * MOTION.frequency * MOTION.times
FORCE = 1.0 + 2.0 * np.sin(PHASE) + 0.4 * np.cos(2 * PHASE)


def measured(**changes):
    return dataclasses.replace(MOTION, **{"forces": {"fz": FORCE}, "mean_force": None} | changes)


def test_a_perfect_force_has_perfect_scores():
    found = score(measured(), "fz", FORCE)
    assert found.to_dict() == pytest.approx(
        {"mean_ratio": 1, "peak_ratio": 1, "rms": 0, "correlation": 1, "lag": 0, "rms_about_mean": 0}, abs=1e-9
    )


def test_scale_and_offset():
    found = score(measured(), "fz", 1.5 * FORCE)
    assert found.mean_ratio == pytest.approx(1.5)
    assert found.peak_ratio == pytest.approx(1.5)
    assert found.correlation == pytest.approx(1.0)
    assert found.rms_about_mean == pytest.approx(0.5)
    assert found.rms == pytest.approx(0.5 * np.sqrt(np.mean(FORCE**2)) / MOTION.weight)
    assert score(measured(), "fz", FORCE + 0.3).rms == pytest.approx(0.3)
    assert score(measured(), "fz", FORCE + 0.3).rms_about_mean == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("late", [-0.2, -0.03, 0.01, 0.1, 0.25])
@pytest.mark.parametrize("periodic", [True, False])
def test_a_late_force_has_a_positive_lag(late, periodic):
    other = PHASE - 2 * math.pi * late
    shifted = 1.0 + 2.0 * np.sin(other) + 0.4 * np.cos(2 * other)
    assert score(measured(periodic=periodic), "fz", shifted).lag == pytest.approx(late, abs=2e-3)


def test_the_peak_is_that_of_the_measured_direction():
    found = score(measured(forces={"fz": -FORCE}), "fz", -0.5 * FORCE + 0.0)
    assert found.peak_ratio == pytest.approx(0.5)


@pytest.mark.parametrize("flat", [np.zeros_like(FORCE), np.full_like(FORCE, 0.7)])
def test_flat_forces_give_null_and_never_nan(flat):
    for case, force in ((measured(forces={"fz": flat}), FORCE), (measured(), flat)):
        found = score(case, "fz", force).to_dict()
        assert found["correlation"] is None
        assert found["lag"] is None
        json.dumps(found, allow_nan=False)


def test_what_was_not_measured_is_null():
    assert set(score(measured(), "fx", FORCE).to_dict().values()) == {None}
    mean = dataclasses.replace(MOTION, mean_force=(0.0, 2.0))
    assert score(mean, "fx", FORCE).mean_ratio is None
    found = score(mean, "fz", FORCE).to_dict()
    assert found.pop("mean_ratio") == pytest.approx(0.5)
    assert set(found.values()) == {None}


def test_a_window_judges_its_frames_alone():
    spoilt = FORCE.copy()
    spoilt[:40] = 100.0
    window = measured(forces={"fz": spoilt}, start=float(MOTION.times[40]), end=float(MOTION.times[-1]))
    found = score(window, "fz", FORCE)
    assert found.rms == pytest.approx(0.0, abs=1e-12)
    assert found.mean_ratio == pytest.approx(1.0)
    assert window.inside.sum() == len(FORCE) - 40
    nothing = measured(forces={"fz": np.where(window.inside, FORCE, np.nan)}, start=window.start, end=window.end)
    assert score(nothing, "fz", FORCE).rms == pytest.approx(0.0, abs=1e-12)


def test_the_best_sine_leaves_the_second_harmonic():
    case = measured()
    np.testing.assert_allclose(best_sine(case, "fz"), 1.0 + 2.0 * np.sin(PHASE), atol=1e-9)
    assert sine_score(case, "fz")["rms"] == pytest.approx(0.4 / math.sqrt(2) / MOTION.weight)
    assert sine_score(case, "fz")["amplitude"] == pytest.approx(2.0, rel=1e-3)
    assert sine_score(case, "fx")["rms"] is None


def test_the_floor_is_the_error_of_the_measurement():
    assert floor(measured(errors={"fz": np.full_like(FORCE, 0.05)}), "fz") == pytest.approx(0.05)
    assert floor(measured(), "fz") is None


def test_the_unit_of_force_falls_out():
    """Mass, density and forces times a hundred: the same flight of a heavier world."""
    case = measured()
    heavy = measured(mass=100 * case.mass, density=100 * case.density, forces={"fz": 100 * FORCE})
    light, dense = (validate(one, ["dickinson"]).rows[0].to_dict() for one in (case, heavy))
    assert dense["fz"] == pytest.approx(light["fz"], rel=1e-9)
    assert dense["aerodynamic_power"] == pytest.approx(100 * light["aerodynamic_power"])


def test_partial_beats_and_broken_periods_are_said():
    assert MOTION.notes == ()
    part = dataclasses.replace(MOTION, end=float(MOTION.times[60]))
    assert "0.38 beats are compared" in part.notes[0]
    stretched = dataclasses.replace(MOTION, frequency=0.7 * MOTION.frequency)
    assert stretched.period is None
    assert "not a whole number" in stretched.notes[0]
