"""The page on flights that PteraSoftware flies on says what its table says."""

import pandas as pd

from tests.helpers.places import ROOT


def test_the_page_is_that_of_the_table(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    import free_flight

    table = pd.read_csv(ROOT / "data" / "free_flight.csv")
    page = (ROOT / "docs" / "evidence" / "free_flight.md").read_text(encoding="utf-8")
    assert free_flight.page(table) == page
    assert set(table["case"]) == set(free_flight.CASES)
    ours = table[(table["flown"] == free_flight.OURS) & (table["beat"] == free_flight.BEATS)]
    assert len(ours) == len(free_flight.CASES)
    assert (ours[["speed", "height"]].abs() < 1e-6).all(axis=None)
