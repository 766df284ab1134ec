"""The study of birds against the radar: what it draws and words from its flights is what the repository holds."""

import csv
import math
import subprocess
import sys
from pathlib import Path

import pytest

from tests.helpers.places import ROOT

STUDY, DOCS, TABLES = ROOT / "validation/alerstam.py", ROOT / "docs", ROOT / "data"
DATA = ROOT / "../shared/data"


@pytest.mark.skipif(not DATA.is_dir(), reason="other people's measurements are not part of this repository")
def test_page_and_table_are_those_of_the_flights(tmp_path: Path) -> None:
    command = [sys.executable, STUDY, "--data", DATA, "--flown", TABLES, "-o", tmp_path, "--tables", tmp_path]
    subprocess.run(command, check=True, capture_output=True)
    for kept in (DOCS / "alerstam.md", TABLES / "alerstam.csv"):
        assert (tmp_path / kept.name).read_text() == kept.read_text()
    assert (tmp_path / "alerstam.png").stat().st_size > 10_000


def test_every_species_is_there_and_no_curve_without_its_minimum_is_used() -> None:
    with (TABLES / "alerstam.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 129
    for row in rows:
        slow, fast = float(row["min_power_speed"]), float(row["max_range_speed"])
        assert math.isnan(slow) or math.isnan(fast) or slow < fast


def test_the_study_says_what_is_missing(tmp_path: Path) -> None:
    found = subprocess.run([sys.executable, STUDY, "--data", tmp_path], check=False, capture_output=True, text=True)
    assert found.returncode == 2
    assert "cannot find bird_airspeed_alerstam2007.csv" in found.stderr


def test_the_parabola_finds_both_speeds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    from alerstam_flights import POWER, Point, rough
    from alerstam_summary import best_speeds

    def curve(speeds: list[float]) -> list[Point]:
        # a + b (U - 8)^2: least at 8; power over speed is least at sqrt(8^2 + a/b).
        return [Point("x", POWER, u, "converged", 10 + 0.2 * (u - 8) ** 2, 5.0, 40.0, "") for u in speeds]

    slow, fast, least = best_speeds(curve([5.0 + 0.25 * i for i in range(40)]))
    assert (slow, least) == (pytest.approx(8.0), pytest.approx(10.0))
    assert fast == pytest.approx(math.sqrt(64 + 50), rel=1e-3)
    assert all(math.isnan(value) for value in best_speeds(curve([9.0, 9.2, 9.4])))
    good = curve([5.0, 6.0, 7.0, 8.0, 9.0])
    assert not rough(good)
    assert rough([*good[:2], Point(*{**vars(good[2]), "power": 12.5}.values()), *good[3:]])
