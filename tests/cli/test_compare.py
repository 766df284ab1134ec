"""The compare command: what it prints and draws, and what it refuses."""

import importlib.metadata
import json
import re

import pytest

import wingbeat as wb
from tests.evidence.second_opinion.test_comparison import standin as standin
from wingbeat._base import install_extra
from wingbeat.cli import main

SMALL = ["--chordwise", "2", "--spanwise", "2", "--steps", "16"]


@pytest.fixture(scope="module")
def file(pigeon_orbit, tmp_path_factory):
    path = tmp_path_factory.mktemp("compared") / "orbit.nc"
    pigeon_orbit.orbit.save(path)
    return path


@pytest.mark.slow
def test_table_record_and_figure(standin, file, tmp_path, capsys):
    assert main(["compare", str(file), "--with", "uvlm", *SMALL, "--plot", str(tmp_path / "lift.png")]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert told.startswith("pigeon at 10 m/s, compared with PteraSoftware 0")
    assert len(re.findall("ours, (?:coefficients|thin-aerofoil|momentum)", told)) == 4
    assert "; the lattice is wrong there" in told
    assert "our loads leave out: rotation and added mass" in told
    assert (tmp_path / "lift.png").stat().st_size > 10_000
    assert main(["compare", str(file), *SMALL, "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert {"with", "code", "mean_lift", "mean_thrust", "aerodynamic_power"} <= set(record)
    assert {"lift_lag", "lift_rms_difference", "beyond_15_deg", "left_out", "terms"} <= set(record)
    assert record["lattice"] == {"chordwise": 2, "spanwise": 2, "steps": 16, "beats": 2}


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--with", "panels"], "--with = 'panels': is not a known choice; use one of uvlm"),
        (["--steps", "17"], "steps = 17: must be even; a second lattice, with half this number, is flown too"),
        (["--beats", "1.5"], '"1.5" is not a whole number'),
        (["--plot", "lift.txt"], "--plot = 'lift.txt'"),
    ],
)
def test_bad_options(file, capsys, words, reason):
    assert main(["compare", str(file), *words]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert reason in told.err


def test_a_missing_file(tmp_path, capsys):
    assert main(["compare", str(tmp_path / "none.nc")]) == 2
    assert "no such file or directory; check the path" in capsys.readouterr().err


def test_a_flight_is_no_orbit(pigeon_orbit, tmp_path, capsys):
    flight = wb.simulate(pigeon_orbit.model, pigeon_orbit.wingbeat, pigeon_orbit.orbit.initial_state)
    flight.save(tmp_path / "flight.nc")
    assert main(["compare", str(tmp_path / "flight.nc")]) == 2
    words = "as an orbit: it holds another kind of result, 'flight'; give a file that `wingbeat orbit -o` wrote"
    assert words in capsys.readouterr().err


def test_a_missing_extra_is_named(file, capsys, monkeypatch):
    def absent(name):
        raise importlib.metadata.PackageNotFoundError(name)

    monkeypatch.setattr(importlib.metadata, "version", absent)
    assert main(["compare", str(file)]) == 2
    told = capsys.readouterr().err
    assert told == f"error: PteraSoftware is not installed here: {install_extra('uvlm')}\n"
