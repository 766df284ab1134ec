"""The page on gusts says what the flights in its table say."""

import pandas as pd
import pytest

from tests.helpers.places import ROOT


@pytest.fixture
def words(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    import gust_survival

    return gust_survival


@pytest.fixture
def table():
    return pd.read_csv(ROOT / "data" / "gust_survival.csv")


@pytest.mark.slow
def test_the_page_is_that_of_the_table(words, table, tmp_path):
    found = words.page(table, tmp_path / "gust_survival.png")
    assert found == (ROOT / "docs" / "evidence" / "gust_survival.md").read_text(encoding="utf-8")
    assert (tmp_path / "gust_survival.png").stat().st_size > 10_000


def test_every_flight_is_counted_once_by_size_and_once_by_direction(words, table):
    assert (table["survived"] <= table["flown"]).all()
    orbits = table.groupby(["model", "animal", "speed"])
    assert {keys for keys, _ in orbits} <= set(words.FLIGHTS)
    for _, rows in orbits:
        for control in words.CONTROLS:
            own = rows[rows["control"] == control].groupby("by")[["flown", "survived"]].sum()
            assert own["flown"].to_dict() == {
                "size": 1000,
                "direction": 1000,
                "light turbulence": 32,
                "moderate turbulence": 32,
            }
            assert own.loc["size", "survived"] == own.loc["direction", "survived"]


def test_a_share_is_that_of_all_bins(words):
    row = {"model": "paper", "animal": "bat", "control": words.OPEN, "by": "size"}
    table = pd.DataFrame([row | {"flown": 30, "survived": 30}, row | {"flown": 10, "survived": 0}])
    assert words.share(table, "paper", "bat", words.OPEN, "size") == 75.0
