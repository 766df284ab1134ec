"""A folder of bad files to stumble over, and a ban on solving anything: bad input is refused before the work."""

from pathlib import Path
from typing import Any

import pytest

from tests.helpers.species_texts import GOOD, SPECIES

GOOD_TABLE = "alpha_deg,c_l,c_d\n0,0,0.1\n20,0.8,0.4\n40,1.2,0.9\n60,1,1.6\n90,0,2\n"
SPECIES_FILES: dict[str, dict[str, str]] = {
    "negative.toml": {"mass": "-0.3"},
    "text.toml": {"chord": '"wide"'},
    "nan.toml": {"frequency": "nan"},
    "inf.toml": {"inertia": "inf"},
    "key.toml": {"more": "colour = 3"},
    "three.toml": {"frequency": "-5", "inertia": "0", "chord": "true"},
}


@pytest.fixture(scope="session")
def orbit_bytes(pigeon_orbit: Any, tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("orbit") / "orbit.nc"
    pigeon_orbit.orbit.save(path)
    return path.read_bytes()


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of bad files and a good result, which nobody may touch; the working directory."""
    for name, changes in SPECIES_FILES.items():
        (tmp_path / name).write_text(SPECIES.format(**GOOD | changes))
    (tmp_path / "broken.toml").write_text("[vehicle\nmass = 0.3\n")
    (tmp_path / "empty.toml").write_text("")
    (tmp_path / "latin.toml").write_bytes(b'name = "caf\xe9"\n')
    (tmp_path / "empty.csv").write_text("")
    (tmp_path / "head.csv").write_text("alpha_deg,c_l,c_d\n")
    (tmp_path / "sorted.csv").write_text(GOOD_TABLE.replace("40,1.2", "10,1.2"))
    (tmp_path / "column.csv").write_text(GOOD_TABLE.replace("c_d", "drag"))
    (tmp_path / "cells.csv").write_text(GOOD_TABLE.replace("1.2", "nan").replace("1.6", "x").replace("0.4", "-1"))
    (tmp_path / "short.csv").write_text(GOOD_TABLE.replace("90,0,2\n", ""))
    (tmp_path / "good.csv").write_text(GOOD_TABLE)
    (tmp_path / "text.nc").write_text("phase,flap\n0,1\n")
    (tmp_path / "kept.nc").write_text("an older result")
    (tmp_path / "kept.png").write_text("an older figure")
    for name in ("folder.nc", "folder.csv", "folder.toml", "folder"):
        (tmp_path / name).mkdir()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    return tmp_path


@pytest.fixture(autouse=True)
def nothing_is_solved(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Bad input is refused before the work begins."""
    if "orbit_bytes" in request.fixturenames:
        request.getfixturevalue("orbit_bytes")  # solved before the ban

    def refuse(*_: Any) -> None:
        raise AssertionError("bad input was let through to the search")

    monkeypatch.setattr("wingbeat.orbits.solve.search_from_starts", refuse)
    monkeypatch.setattr("wingbeat.results.flight.fly_beats", refuse)
