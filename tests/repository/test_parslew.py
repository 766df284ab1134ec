"""The page on another predictive model says what the flights in its table say."""

import pandas as pd
import pytest

from tests.helpers.places import ROOT


@pytest.fixture
def words(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    import parslew

    return parslew


@pytest.fixture
def flights():
    return pd.read_csv(ROOT / "data" / "parslew.csv")


def test_the_page_is_that_of_the_table(words, flights, tmp_path):
    assert (
        words.page(flights, tmp_path / "parslew.png", 9.6)
        == (ROOT / "docs" / "evidence" / "parslew.md").read_text()
    )
    assert (tmp_path / "parslew.png").stat().st_size > 10_000


def test_a_statement_is_not_judged_without_flights(words, flights):
    none = flights.assign(power_per_mass=float("nan"))
    assert [one.test(none[none["live"]])[1] for one in words.STATEMENTS] == [None] * len(words.STATEMENTS)


def test_verdicts_follow_the_numbers(words, flights):
    free = flights[~flights["live"]]
    before = [one.test(free)[1] for one in words.STATEMENTS]
    upright = free.assign(from_vertical_deg=5.0, frequency=8.0, retraction=0.0)
    after = [one.test(upright)[1] for one in words.STATEMENTS]
    assert (before[0], before[2], after[0], after[1], after[2]) == (False, False, True, False, True)
