"""The page on the error of predicted flights says what the sets in its table say."""

import numpy as np
import pandas as pd
import pytest

from tests.helpers.places import ROOT
from wingbeat_evidence.whole_flights import Measurement


@pytest.fixture
def script(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    import prediction_error

    return prediction_error


@pytest.fixture
def sets():
    return pd.read_csv(ROOT / "data" / "prediction_error.csv")


def test_the_page_is_that_of_the_table(script, sets, tmp_path):
    found = script.page(sets, list(script.errors(sets)), tmp_path / "prediction_error.png")
    assert found == (ROOT / "docs" / "evidence" / "prediction_error.md").read_text()
    assert (tmp_path / "prediction_error.png").stat().st_size > 10_000


def test_the_sets_cover_the_ranges_of_their_animals(script, sets):
    """They are of numerical version 8: since then ranges of the muscle moved, and numbers came or became free."""
    from prediction_error_flights import ranges

    assert sets["animal"].value_counts().to_dict() == {"pigeon": 1000, "cockatiel": 1000}
    moved = {"muscle.mass", "muscle.elevator_share", "wingbeat.span_retraction", "wingbeat.twist_ratio"}
    for animal, rows in sets.groupby("animal"):
        within = ranges(str(animal))
        drawn = {path for path in rows if "." in path or path == "speed"}
        assert within.keys() - drawn == {"body.crossflow_area", "wingbeat.frequency"}
        assert drawn - within.keys() <= moved
        for path in drawn - moved:
            low, high = within[path]
            assert rows[path].between(low * (1 - 1e-5) - 1e-9, high * (1 + 1e-5) + 1e-9).all(), path
        for path in drawn:  # drawn evenly
            place = np.sort((rows[path] - rows[path].min()) / np.ptp(rows[path]))
            assert np.abs(place - (np.arange(1000) + 0.5) / 1000).max() < 0.02, path


def test_only_certified_flights_count(script, sets):
    assert set(sets["status"]) == {"converged", "infeasible", "not-converged"}
    certified = sets[sets["status"] == "converged"]
    assert (certified[["frequency", "flap_amplitude_deg", "muscle_power_per_mass"]] > 0).all(axis=None)
    assert list(script.errors(sets)) == list(script.errors(certified))


def test_an_error_that_one_number_makes_is_put_down_to_it(script, sets):
    rows = sets[(sets["animal"] == "pigeon") & (sets["status"] == "converged")]
    made = rows.assign(frequency=6.0 * rows["wing.semi_span"] / rows["wing.semi_span"].median())
    measured = Measurement("frequency", "law", (6.0, 18.0), (5.9, 6.1), "made up", "nowhere")
    found = script.error("pigeon", measured, (6.0, 18.0), made)
    assert next(iter(found.numbers.items())) == ("wing.semi_span", pytest.approx(1.0))
    assert found.ratio[1] == pytest.approx(1.0)
    assert found.agree == 1.0
    assert script.error("pigeon", measured, (6.0, 18.0), made.assign(frequency=12.0)).agree == 0.0
    assert not list(script.errors(made.assign(status="infeasible")))


def test_bands_of_speed_cover_what_was_measured(script):
    assert list(script.bands((4.46, 4.46))) == [pytest.approx((3.46, 5.46))]
    assert list(script.bands((3.0, 14.0))) == [(3.0, 7.0), (7.0, 12.0), (12.0, 14.0)]
    assert list(script.bands((6.5, 11.0))) == [(6.5, 11.0)]
