"""Linear flights, modes, feedback, surveys of gusts and manoeuvres in a notebook."""

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from tests.helpers.notebooks import check_figure, check_table


@pytest.fixture(scope="module")
def linear(cruise):
    return wb.linearise(cruise)


@pytest.fixture(scope="module")
def causes(cruise):
    return wb.stability_sensitivities(cruise)


@pytest.fixture(scope="module")
def survey(cruise, held):
    return wb.survey_gusts(cruise, {"open": None, "held": held}, flights=12, size=3.0, beats=8, seed=1)


@pytest.fixture(scope="module")
def plan(cruise):
    return wb.manoeuvre(cruise, [12.5])


def test_a_linear_flight_shows_its_modes(linear):
    shown = check_table(linear)
    assert f"spectral radius {linear.spectral_radius:.3f}" in shown or "disturbances double in" in shown
    for mode in linear.modes:
        assert mode.kind in shown
        alone = check_table(mode)
        assert alone in shown
        assert f"{mode.multiplier.real:.3f}" in alone
        time = mode.time_to_double or mode.time_to_half
        assert f"{time:.3g} s ({time / linear.dt:.3g} beats)" in alone
    check_figure(linear.plot())


def test_causes_are_ranked(causes):
    first = causes.record()["parameters"][0]
    assert first["parameter"] in check_table(causes)
    table = causes.to_dataframe()
    assert table["parameter"].iloc[0] == first["parameter"]
    assert table["spectral_radius"].iloc[0] == first["spectral_radius"]
    check_figure(causes.plot())


def test_a_feedback_shows_its_gains(patient):
    shown = check_table(patient)
    assert f"{patient.spectral_radius:.3f} with feedback that acts 1 beat later" in shown
    assert f"frequency [Hz] {-patient.gains[patient.inputs.index('frequency'), 0]:.3g}" in shown


@pytest.mark.slow
def test_a_survey_shows_the_shares(survey):
    shown = check_table(survey)
    assert f"held {survey.share('held'):.1%}" in shown
    table = survey.to_dataframe()
    assert table["survived.held"].mean() == survey.share("held")
    assert np.array_equal(table["direction"], survey.direction)
    check_figure(survey.plot())
    check_legends(survey.plot())


@pytest.mark.slow
def test_a_manoeuvre_shows_its_ends(plan):
    shown = check_table(plan)
    assert f"12.5 {plan.legs[0]} {plan.ends[0].frequency:.4g}" in shown
    assert f"{plan.times[-1]:.2f} s" in shown
    check_figure(plan.plot())
