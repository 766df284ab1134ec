"""The study of birds against the radar: what it draws and words from its flights is what the repository holds."""

import csv
import math
import subprocess
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.helpers.places import ROOT

STUDY, DOCS, TABLES = ROOT / "validation/alerstam.py", ROOT / "docs" / "evidence", ROOT / "data"
DATA = ROOT / "../shared/data"


@pytest.mark.slow
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
    counts = Counter(row["model"] for row in rows)
    assert counts["paper"] == 129
    assert counts["animal"] in (0, 129)
    for row in rows:
        slow, fast = float(row["min_power_speed"]), float(row["max_range_speed"])
        assert math.isnan(slow) or math.isnan(fast) or slow < fast


@pytest.mark.slow
def test_the_study_says_what_is_missing(tmp_path: Path) -> None:
    found = subprocess.run([sys.executable, STUDY, "--data", tmp_path], check=False, capture_output=True, text=True)
    assert found.returncode == 2
    assert "cannot find bird_airspeed_alerstam2007.csv" in found.stderr


def test_the_parabola_finds_both_speeds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "validation"))
    from alerstam_flights import PAPER, POWER, Point, rough
    from alerstam_summary import best_speeds

    def curve(speeds: list[float]) -> list[Point]:
        # a + b (U - 8)^2: least at 8; power over speed is least at sqrt(8^2 + a/b).
        power = [10 + 0.2 * (u - 8) ** 2 for u in speeds]
        beat = 5.0, 40.0, ""
        return [
            Point(PAPER, "x", POWER, u, "converged", p, 0.5 * p + u, *beat)
            for u, p in zip(speeds, power, strict=True)
        ]

    slow, fast, least, hinge = best_speeds(curve([5.0 + 0.25 * i for i in range(40)]))
    assert (slow, least, hinge) == (pytest.approx(8.0), pytest.approx(10.0), pytest.approx(13.0))
    assert fast == pytest.approx(math.sqrt(64 + 50), rel=1e-3)
    assert all(math.isnan(value) for value in best_speeds(curve([9.0, 9.2, 9.4])))
    good = curve([5.0, 6.0, 7.0, 8.0, 9.0])
    assert not rough(good)
    assert rough([*good[:2], Point(*{**vars(good[2]), "power": 12.5}.values()), *good[3:]])


@pytest.fixture
def validation(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "validation"))


def _bird(name: str, mass: float) -> Any:
    from alerstam_flights import Bird

    return Bird(name, mass, 0.6 * mass ** (1 / 3), 0.06 * mass ** (2 / 3), 12.0)


@pytest.mark.usefixtures("validation")
def test_birds_that_the_store_holds_are_not_flown_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import alerstam_animal
    from alerstam_flights import ANIMAL, POWER, Point

    flown = []

    def fly_bird(bird: Any, before: Any) -> Any:
        flown.append((bird.name, None if before is None else before.species))
        if (bird.name, len(flown)) == ("c", 3):
            raise KeyboardInterrupt
        point = Point(ANIMAL, bird.name, POWER, 12.0, "converged", bird.mass, 1.0, 5.0, 40.0, "")
        return alerstam_animal.Flown(bird.name, 5.0, [point], {"1.3": [0.1]}, {"1.3": 12.0}, [])

    monkeypatch.setattr(alerstam_animal, "fly_bird", fly_bird)
    birds = [_bird("c", 3.0), _bird("a", 1.0), _bird("b", 2.0)]
    with pytest.raises(KeyboardInterrupt):
        alerstam_animal.fly_in_order(birds, tmp_path)
    points = alerstam_animal.fly_in_order(birds, tmp_path)
    assert flown == [("a", None), ("b", "a"), ("c", "b"), ("c", "b")]
    assert [(point.species, point.power) for point in points] == [("c", 3.0), ("a", 1.0), ("b", 2.0)]


@pytest.mark.usefixtures("validation")
def test_an_orbit_of_one_bird_starts_the_next_at_its_own_speed_and_pitch_rate() -> None:
    from alerstam_animal import Flown, carried
    from alerstam_flights import ANIMAL, problem_of

    small, large = _bird("small", 0.1), _bird("large", 0.8)
    one, other = problem_of(ANIMAL, small, 10.0), problem_of(ANIMAL, large, 15.0)
    names = one.unknowns().names
    assert one.minimise.name == "metabolic_power"
    start = np.arange(1.0, len(names) + 1.0)
    found = carried(other, Flown("small", 8.0, [], {"1.3": start.tolist()}, {"1.3": 10.0}, []), "1.3", 4.0)
    ratios = dict(zip(names, found / start, strict=True))
    assert {name for name, ratio in ratios.items() if ratio != 1.0} == {"u", "w", "pitch_rate"}
    assert (ratios["u"], ratios["w"], ratios["pitch_rate"]) == (1.5, 1.5, 0.5)
    assert "frequency" not in names


@pytest.mark.usefixtures("validation")
def test_further_speeds_are_flown_where_the_least_is_at_an_end() -> None:
    from alerstam_animal import further

    assert further({1.1: 3.0, 1.2: 2.0, 1.3: 2.3, 1.4: 2.6}) == []
    assert further({1.1: 1.9, 1.2: 2.0, 1.3: 2.3, 1.4: 2.6}) == ["0.95"]
    assert further({1.1: 3.0, 1.2: 2.0, 1.3: 2.1, 1.4: 2.2}) == ["1.55"]
    assert further({1.1: math.nan, 1.2: 2.0, 1.3: 2.3, 1.4: 2.6}) == ["0.95"]
    assert further({1.1: math.nan}) == []


@pytest.mark.usefixtures("validation")
def test_a_prediction_is_better_than_wing_loading_only_if_it_leaves_less_scatter() -> None:
    from alerstam_summary import change, left_by_fit

    random = np.random.default_rng(1)
    loading = np.exp(random.normal(3.5, 0.5, 200))
    measured = 4.0 * loading**0.3 * np.exp(random.normal(0.0, 0.2, 200))
    assert left_by_fit(loading, measured) == pytest.approx(0.2, rel=0.15)
    assert left_by_fit(2.0 * measured**3, measured) == pytest.approx(0.0, abs=1e-12)
    share, low, high = change(np.sqrt(measured * loading), loading, measured)
    assert low < share < high < 0
    share, low, high = change(loading**0.5, loading, measured)
    assert share == pytest.approx(0.0, abs=1e-9)
