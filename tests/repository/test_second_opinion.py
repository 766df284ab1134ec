"""The page on the second opinion says what its tables say."""

import pandas as pd

from tests.helpers.places import ROOT


def test_the_page_is_that_of_the_tables(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    import second_opinion

    flights, lattices = (pd.read_csv(ROOT / "data" / f"second_opinion{end}.csv") for end in ("", "_lattices"))
    page = (ROOT / "docs" / "evidence" / "second_opinion.md").read_text(encoding="utf-8")
    assert second_opinion.page(flights, lattices) == page
    of_paper = len(second_opinion.CASES) * (1 + len(second_opinion.TERMS))
    of_animal = len(second_opinion.ANIMALS) * 2 * (1 + 2 * len(second_opinion.WAKES))  # span flown or held
    assert flights["model"].value_counts().to_dict() == {"paper": of_paper, "animal": of_animal}
