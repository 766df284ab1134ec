"""`wingbeat bench` measures and says what it measured; how fast it was is nobody's business here."""

import json

import pytest

from wingbeat import bench
from wingbeat.cli.app import main


@pytest.fixture(autouse=True)
def brief(monkeypatch):
    monkeypatch.setattr(bench, "_SPEEDS", bench._SPEEDS[:2])
    monkeypatch.setattr(bench, "_REPEATS", 2)


@pytest.mark.slow
def test_bench_prints_json_alone(capsys):
    assert main(["bench", "--batch", "2", "--json"]) == 0
    out, err = capsys.readouterr()
    found = json.loads(out)
    assert err == ""
    assert found["batch"] == found["batch_certified"] == 2
    assert found["versions"]["wingbeat"]
    assert "cores" in found["device"]
    for name in ("rhs_ns", "jacobian_ms", "pigeon_ms", "bat_ms", "batch_ms"):
        assert found[name] > 0
    for animal in ("pigeon", "bat"):
        parts = found["solve_ms"][animal] + found["certify_ms"][animal]
        assert parts == pytest.approx(found[f"{animal}_ms"], rel=1e-6)


def test_bench_prints_a_table_for_people(capsys):
    assert main(["bench", "--batch", "1"]) == 0
    text = capsys.readouterr().out
    for part in ("one orbit, pigeon", "certificate", "one orbit in a batch of 1 mixed problems", "jax"):
        assert part in text


def test_a_batch_of_none_is_refused(capsys):
    assert main(["bench", "--batch", "0"]) == 2
    assert "--batch = 0: must be a whole number" in capsys.readouterr().err


def test_mixed_problems_are_the_same_for_the_same_seed():
    first, again, other = (list(bench.mixed_problems(4, seed)) for seed in (0, 0, 1))
    assert [p.speed for p in first] == [p.speed for p in again] != [p.speed for p in other]
    assert {p.species.name for p in first} == {"pigeon", "bat"}
