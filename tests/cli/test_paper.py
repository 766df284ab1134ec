"""``wingbeat paper`` from end to end on few orbits, and what it refuses."""

import json

import pytest

from tests.helpers.places import ROOT
from wingbeat.cli import main
from wingbeat_evidence.paper import treatments
from wingbeat_evidence.paper.claim import NOT_ASKED


@pytest.mark.slow
def test_figures_claims_and_records_are_written(monkeypatch, tmp_path, capsys):
    before = json.loads((ROOT / "data" / "claims.json").read_text())
    next(row for row in before if row["id"] == "two-dimensional")["verdict"] = "fails"
    (tmp_path / "before.json").write_text(json.dumps(before))
    monkeypatch.setattr(treatments, "QUICK_SPEEDS", (10.0,))
    monkeypatch.setattr(treatments, "DRAWN", treatments.DRAWN[:1])
    folder, earlier = tmp_path / "paper", ["--before", str(tmp_path / "before.json")]
    assert main(["paper", "--quick", "--figures", "1,3,7-8", "--processes", "1", "-o", str(folder), *earlier]) == 0
    out, err = capsys.readouterr()
    assert "of 4 orbits certified" in err
    for number in (1, 3, 7, 8):
        for ending in ("png", "pdf", "csv"):
            assert (folder / f"figure{number}.{ending}").stat().st_size > 100
    assert not (folder / "figure2.png").exists()
    rows = json.loads((folder / "claims.json").read_text())
    assert f"{rows[0]['id']}: {rows[0]['verdict']}" in out
    assert (folder / "claims.md").is_file()
    assert {row["verdict"] for row in rows if row["id"] in ("twice-the-frequency", "wing-shape")} == {NOT_ASKED}
    text = (folder / "claims.md").read_text()
    assert "| `two-dimensional` | fails | cannot be tested | tested as before |" in text
    assert "twice-the-frequency: not tested with --quick" in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--figures", "0-3"], "is not among the figures"),
        (["--figures", "two"], "as in 1-8 or 3,5"),
        (["assumptions", "--before", "claims.json"], "does not apply to 'paper assumptions'"),
        (["--before", "nowhere.json"], "nowhere.json"),
        (["--sets", "5"], "does not apply to 'paper claims'"),
        (["assumptions", "--quick"], "does not apply to 'paper assumptions'"),
        (["assumptions", "--sets", "0"], "from 1 to 1000000"),
        (["assumptions", "--seed", "-1"], "must not be negative"),
        (["--only", "1"], "does not apply to 'paper claims'"),
        (["assumptions", "--sets", "5", "--piece", "2", "--only", "2-4"], "give 1 to 3"),
        (["assumptions", "--only", "first"], "must name pieces"),
        (["assumptions", "--piece", "0"], "from 1 to 1000000"),
        (["--processes", "0"], "from 1 to 1024"),
        (["all"], "all"),
    ],
)
def test_what_cannot_be_is_refused(words, said, capsys):
    assert main(["paper", *words]) == 2
    assert said in capsys.readouterr().err
