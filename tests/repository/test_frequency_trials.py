"""Pages of trials and of statements about live flight: their scripts print their words."""

import importlib
import re

import pytest

from tests.helpers.places import ROOT

DOCS, TEMPLATES = ROOT / "docs" / "evidence", ROOT / "validation" / "pages"


@pytest.mark.parametrize("name", ["frequency_trials", "slow_flight"])
def test_the_script_prints_the_words_of_the_page(name, monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    script, page = importlib.import_module(name), (DOCS / f"{name}.md").read_text(encoding="utf-8")
    before, after = (TEMPLATES / f"{name}.md").read_text(encoding="utf-8").split("{table}")
    assert page.startswith(before)
    assert page.endswith(after)
    rows = [line.split(" | ")[0].removeprefix("| ") for line in page.splitlines() if line.startswith("| ")]
    assert rows[2:] == [trial.name for trial in script.trials()]


def test_the_page_of_statements_counts_its_own_verdicts(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    script, page = (
        importlib.import_module("live_statements"),
        (DOCS / "live_statements.md").read_text(encoding="utf-8"),
    )
    rows = [line.split(" | ") for line in page.splitlines() if line.startswith("| ")][2:]
    assert [(row[0].removeprefix("| "), row[1]) for row in rows] == [
        (one.said, one.source) for one in script.STATEMENTS
    ]
    verdicts = [row[-1].removesuffix(" |") for row in rows]
    assert set(verdicts) <= {"borne out", "**contradicted**"}
    borne, known = map(int, re.findall(r"(\d+) of (\d+) are borne out", page)[0])
    assert (borne, known) == (verdicts.count("borne out"), len(verdicts))
