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


def test_the_sets_are_those_that_the_page_counts(sets):
    # Drawn with numerical version 8: ranges of muscle and stroke have changed since.
    assert sets["animal"].value_counts().to_dict() == {"pigeon": 1000, "cockatiel": 1000}
    assert all(np.ptp(sets[path]) > 0 for path in sets if "." in path or path == "speed")


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
