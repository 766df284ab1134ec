"""Scores of predictions that are written down by hand, and the pages and figures made of them."""

import dataclasses
import importlib
import json

import pytest

from tests.helpers.places import ROOT
from wingbeat.plots import save_figure
from wingbeat_evidence.whole_flights import (
    Flown,
    MeasuredFlights,
    Measurement,
    Prediction,
    compared,
    measured_animals,
)
from wingbeat_evidence.whole_flights.comparison import words_of
from wingbeat_evidence.whole_flights.figure import flights_page
from wingbeat_evidence.whole_flights.page import flight_text, overview_text


def measurement(quantity, speeds, values, basis="measured"):
    return Measurement(quantity, basis, speeds, values, "two birds", "a paper of 2001")


def flown(speed, frequency, power, muscle=None):
    values = {"frequency": frequency, "flap_amplitude_deg": 40.0, "positive_power_per_mass": power}
    if muscle is not None:
        values["muscle_power_per_mass"] = muscle
    band = {"low": {"frequency": 0.9 * frequency}, "high": {"frequency": 1.2 * frequency}}
    due = {"frequency": {"wing.semi_span": 0.5, "body.mass": 0.01}}
    return Flown(
        speed, "converged", "", values, 0.8, ("flap_amplitude",), **band, drawn=16, certified=12, due_to=due
    )


def prediction(*measurements, muscle=None):
    rows = [flown(6.0, 8.0, 30.0, muscle), flown(8.0, 6.0, 20.0, muscle), flown(10.0, 6.5, 25.0, muscle)]
    rows.append(Flown(12.0, "infeasible", "too fast", {}))
    flights = MeasuredFlights("pigeon", (6.0, 8.0, 10.0, 12.0), measurements)
    return Prediction(flights, "animal", "metabolic_power", tuple(rows))


@pytest.mark.parametrize(
    ("speeds", "values", "ratio", "agrees"),
    [
        ((6.0, 6.0), (8.0, 8.0), (1.0, 1.0), True),
        ((6.0, 10.0), (6.0, 7.0), (6 / 6.5, 8 / 6.5), True),
        ((6.0, 10.0), (5.9, 6.3), (6 / 6.1, 8 / 6.1), False),
        ((6.0, 6.0), (10.1, 10.1), (8 / 10.1, 8 / 10.1), False),
        ((12.0, 12.0), (6.0, 6.0), None, None),
        ((6.0, 10.0), (0.0, 8.0), (1.5, 2.0), True),
        ((6.0, 10.0), (0.0, 7.9), (6 / 3.95, 8 / 3.95), False),
    ],
)
def test_a_prediction_agrees_within_a_factor_at_every_speed(speeds, values, ratio, agrees):
    (score,) = compared(prediction(measurement("frequency", speeds, values)))
    assert score.ratio == (None if ratio is None else pytest.approx(ratio))
    assert score.agrees is agrees


@pytest.mark.parametrize(("measured", "agrees"), [((8.0, 9.0), True), ((11.0, 11.0), True), ((11.1, 12.0), False)])
def test_the_speed_of_minimum_power_agrees_within_three_metres_per_second(measured, agrees):
    (score,) = compared(prediction(measurement("minimum_power_speed", None, measured)))
    assert score.predicted == (8.0, 8.0)
    assert score.agrees is agrees
    assert not score.at_edge


def test_a_minimum_at_the_edge_says_so():
    found = prediction(measurement("minimum_power_speed", None, (5.0, 5.0)))
    found = Prediction(found.flights, found.model, found.objective, found.flown[1:2])
    (score,) = compared(found)
    assert words_of(score) == "yes, at the edge"


def test_muscle_is_compared_only_where_the_model_has_one():
    asked = measurement("muscle_power_per_mass", (6.0, 10.0), (100.0, 200.0))
    assert compared(prediction(asked)) == []
    (score,) = compared(prediction(asked, muscle=150.0))
    assert score.agrees


def at_own_frequency(found, basis):
    rows = [
        dataclasses.replace(row, frequency_basis=basis, frequency_range=(5.0, 9.0), body_pitch_deg=4.0)
        for row in found.flown
    ]
    return dataclasses.replace(found, flown=tuple(rows))


@pytest.mark.parametrize(
    ("flown", "measured", "is_compared"),
    [
        ("free", "measured", True),
        ("free", "law", True),
        ("law", "measured", True),
        ("law", "law", False),
        ("measured", "measured", False),
        ("given", "measured", False),
    ],
)
def test_a_frequency_that_was_given_is_no_prediction(flown, measured, is_compared):
    found = prediction(measurement("frequency", (6.0, 10.0), (6.0, 7.0), measured))
    assert bool(compared(at_own_frequency(found, flown))) is is_compared


def test_the_band_of_a_comparison_is_the_widest_over_its_speeds():
    found = at_own_frequency(prediction(measurement("frequency", (6.0, 8.0), (6.0, 7.0))), "law")
    (score,) = compared(found)
    assert score.predicted == (6.0, 8.0)
    assert score.band == pytest.approx((0.9 * 6.0, 1.2 * 8.0))
    text = overview_text([found], findings="- A finding.")
    assert "6 to 8 (5.4 to 9.6)" in text
    assert "- A finding." in text
    assert "| pigeon | 6 to 8 | law | 3 of 4 | 0.8 to 0.8 | - | 4, 4 |" in text


def test_a_prediction_is_kept_as_plain_values():
    found = at_own_frequency(prediction(measurement("frequency", (6.0, 10.0), (6.0, 7.0))), "law")
    again = Prediction.of_plain(found.flights, json.loads(json.dumps(found.plain())))
    assert again == found


def test_pages_hold_every_number(tmp_path):
    rows = (
        measurement("frequency", (6.0, 10.0), (6.0, 7.0)),
        measurement("positive_power_per_mass", (8.0, 8.0), (70.0, 80.0)),
        measurement("minimum_power_speed", None, (8.0, 9.0)),
        measurement("muscle_power_per_mass", (6.0, 10.0), (100.0, 200.0), "law"),
    )
    found = prediction(*rows, muscle=150.0)
    text = flight_text(found, "pigeon.png", "rock pigeon")
    for part in (
        "rock pigeon",
        "(pigeon.png)",
        "6 to 8",
        "0.923 to 1.23",
        "two birds",
        "`wing.semi_span` 0.50",
        "7.2 to 9.6",
    ):
        assert part in text
    assert "12 of 16" in text
    assert "infeasible: too fast" in text
    assert "**3 of 4 comparisons agree.**" in overview_text([found])
    save_figure(flights_page(found), tmp_path / "pigeon.png")
    labels = [axes.get_ylabel() for axes in flights_page(found).axes]
    assert len(labels) == 4
    assert all("[" in label for label in labels)


def test_the_page_is_that_of_the_flights_that_the_repository_holds(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    script = importlib.import_module("whole_flights")
    found = [script.flown(animal, anew=False, draws=0, processes=1) for animal in measured_animals()]
    figures = [f"flight_{animal}.png" for animal in measured_animals()]
    page = (ROOT / "docs" / "evidence" / "whole_flights.md").read_text(encoding="utf-8")
    assert overview_text(found, figures, script.findings(found).strip()) == page
