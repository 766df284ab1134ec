"""Surveys of random gusts: what is drawn, what is counted, and that feedback saves flights."""

import json
import math

import numpy as np
import pytest

import wingbeat as wb


@pytest.fixture(scope="module")
def survey(cruise):
    return wb.survey_gusts(cruise, flights=150, seed=7)


@pytest.mark.slow
def test_feedback_survives_what_the_orbit_alone_does_not(survey):
    assert list(survey.survived) == ["no feedback", "feedback", "feedback, one beat late"]
    assert survey.share("no feedback") < 0.1
    assert survey.share("feedback") > 0.98
    assert survey.share("feedback, one beat late") > 0.95


@pytest.mark.slow
def test_gusts_are_drawn_as_said(survey, cruise):
    period = 1 / cruise.wingbeat.frequency
    for values, low, high in (
        (survey.size, 0.0, 5.0),
        (survey.direction, 0.0, 2 * math.pi),
        (survey.start, 0.0, period),
        (survey.duration, period, 8 * period),
    ):
        assert low <= values.min() < values.max() <= high
        assert values.mean() == pytest.approx(0.5 * (low + high), abs=0.12 * (high - low))


def test_a_survey_is_the_flights_of_its_gusts(survey, cruise, held):
    picked = [3, 50, 149]
    gusts = [
        wb.winds.CosineGust(
            survey.size[i] * math.cos(survey.direction[i]),
            survey.size[i] * math.sin(survey.direction[i]),
            float(survey.start[i]),
            float(survey.duration[i]),
        )
        for i in picked
    ]
    many = wb.simulate_many(cruise, gusts, feedback=held)
    assert np.allclose(many.largest_pitch, survey.largest_pitch["feedback"][picked], rtol=1e-6)


def test_shares_of_bins_are_counts(survey):
    edges, shares = survey.by_size("no feedback", 5)
    count = np.histogram(survey.size, edges)[0]
    assert count.sum() == 150
    assert (shares * count).sum() == pytest.approx(survey.survived["no feedback"].sum())
    edges, shares = survey.by_direction("feedback", 4)
    assert edges.tolist() == pytest.approx([0, math.pi / 2, math.pi, 1.5 * math.pi, 2 * math.pi])
    record = json.loads(json.dumps(survey.record(), allow_nan=False))
    assert record["flights"] == 150
    assert record["survived"]["feedback"] == survey.share("feedback")
    assert len(record["by_size"]["feedback"]["edges"]) == 11


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ({"flights": 0}, "flights = 0"),
        ({"size": 0.0}, "size = 0.0: must be > 0 m/s"),
        ({"size": math.nan}, "size = nan"),
        ({"seed": -1}, "seed = -1"),
        ({"feedbacks": {}}, "must be feedbacks by name"),
    ],
)
def test_bad_input_gets_its_sentence(cruise, asked, said):
    with pytest.raises(wb.InvalidInputError, match=said):
        wb.survey_gusts(cruise, **asked)
