"""``wingbeat paper`` from end to end on few orbits, and what it refuses."""

import json

import pytest

from wingbeat.cli import main
from wingbeat.paper import treatments
from wingbeat.paper.study import Study, study_claims


def test_figures_claims_and_records_are_written(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(treatments, "QUICK_SPEEDS", (10.0,))
    folder = tmp_path / "paper"
    assert main(["paper", "--quick", "--figures", "3,7-8", "--processes", "1", "-o", str(folder)]) == 0
    out, err = capsys.readouterr()
    assert "of 20 orbits certified" in err
    for number in (3, 7, 8):
        for ending in ("png", "pdf", "csv"):
            assert (folder / f"figure{number}.{ending}").stat().st_size > 100
    assert not (folder / "figure2.png").exists()
    rows = json.loads((folder / "claims.json").read_text())
    assert f"{rows[0]['id']}: {rows[0]['verdict']}" in out
    assert (folder / "claims.md").is_file()
    assert (folder / "orbits" / "signed-bat-su-fan-10.json").is_file()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--figures", "1-3"], "is not among the figures"),
        (["--figures", "two"], "as in 2-8 or 3,5"),
        (["--sets", "5"], "has no part in 'paper claims'"),
        (["assumptions", "--quick"], "has no part in 'paper assumptions'"),
        (["assumptions", "--sets", "0"], "from 1 to 1000000"),
        (["assumptions", "--seed", "-1"], "must not be negative"),
        (["--processes", "0"], "from 1 to 1024"),
        (["all"], "all"),
    ],
)
def test_what_cannot_be_is_refused(words, said, capsys):
    assert main(["paper", *words]) == 2
    assert said in capsys.readouterr().err


def test_assumptions_are_sampled_and_written(monkeypatch, tmp_path, capsys):
    import numpy as np

    from wingbeat.paper import study
    from wingbeat.paper.assumptions import sample_sets

    def run(count, seed, processes, progress):
        assert (count, seed, processes) == (3, 7, 1)
        shape = (count, len(study_claims()))
        sets = tuple(sample_sets(count, seed))
        return Study(sets, study_claims(), np.ones(shape), np.ones(shape), np.ones(count))

    monkeypatch.setattr(study, "run_study", run)
    words = ["paper", "assumptions", "--sets", "3", "--seed", "7", "--processes", "1", "-o", str(tmp_path)]
    assert main(words) == 0
    assert "wingbeat paper assumptions --sets 3 --seed 7" in (tmp_path / "assumptions.md").read_text()
    assert "assumptions.png" in capsys.readouterr().err
