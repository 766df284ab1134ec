"""Tails of species: files, settings, laws, and what is refused."""

import math

import pytest

import wingbeat as wb
from tests.helpers.species_texts import faults_of
from wingbeat.animal.species import scaling
from wingbeat.animal.species.reading import template
from wingbeat.animal.species.writing import species_text
from wingbeat.viewer.scene import tail_corners

PIGEON = wb.load_species("pigeon")
NUMBERS = {"tail.area": 0.004, "tail.arm": 0.12, "tail.lift_slope": 3.0}
FILE = """
[vehicle.tail]
area = { value = 0.004, unit = "m2", range = [0.002, 0.01], source = "a tape" }
arm = { value = 0.12, unit = "m" }
lift_slope = { value = 3.0, unit = "1/rad" }
incidence_deg = { value = -5.0, unit = "deg" }
"""


def with_file(tmp_path, text):
    path = tmp_path / "mine.toml"
    path.write_text(template() + text, encoding="utf-8")
    return path


def test_a_file_has_a_tail_and_gives_it_back(tmp_path):
    species = wb.load_species(with_file(tmp_path, FILE))
    assert species.vehicle.tail == wb.Tail(0.004, 0.12, 3.0, incidence=math.radians(-5))
    assert species.numbers["vehicle.tail.area"].source == "a tape"
    again = tmp_path / "again.toml"
    again.write_text(species_text(species), encoding="utf-8")
    assert wb.load_species(again).vehicle.tail.incidence == pytest.approx(math.radians(-5), rel=1e-5)
    assert wb.load_species(again).numbers.keys() == species.numbers.keys()


def test_a_species_without_a_tail_has_none_of_its_numbers():
    assert PIGEON.vehicle.tail is None
    assert not [path for path in PIGEON.numbers if "tail" in path]
    assert "tail" not in PIGEON.as_dict()["vehicle"]
    assert PIGEON.with_tail().as_dict()["vehicle"]["tail"]["height"] == 0.0


def test_numbers_set_by_hand_make_a_tail():
    species = PIGEON.with_values(NUMBERS | {"tail.incidence_deg": 5.0})
    assert species.vehicle.tail == wb.Tail(0.004, 0.12, 3.0, incidence=math.radians(5.0))
    assert species.numbers["vehicle.tail.arm"].source == "set by hand"
    assert list(species.numbers) == list(PIGEON.with_tail().numbers)
    moved = species.with_values({"tail.arm": 0.1, "wingbeat.tail_tilt": 0.1})
    assert (moved.vehicle.tail.arm, moved.wingbeat.tail_tilt) == (0.1, 0.1)


def test_a_vehicle_brings_its_tail_and_takes_it_along():
    tailed = PIGEON.with_tail()
    brought = PIGEON.with_record(tailed.vehicle)
    assert brought.numbers.keys() == tailed.numbers.keys()
    assert brought.with_record(PIGEON.vehicle).numbers.keys() == PIGEON.numbers.keys()


@pytest.mark.parametrize(
    ("values", "lines"),
    [
        ({"tail.area": 0.004}, {"vehicle.tail.arm": "must be given for a tail", "vehicle.tail.lift_slope": "pi/2"}),
        (NUMBERS | {"tail.area": 0.0}, {"tail.area": "leave the tail out if there is none"}),
        (
            NUMBERS | {"tail.lift_slope": -1.0},
            {"tail.lift_slope": "must be > 0 1/rad; for a slender tail, give pi/2 times"},
        ),
        (NUMBERS | {"tail.drag_coefficient": -0.1}, {"tail.drag_coefficient": "must be >= 0"}),
        (NUMBERS | {"tail.arm": math.inf}, {"tail.arm": "must be finite"}),
        (NUMBERS | {"tail.are": 0.1}, {"tail.are": "did you mean tail.area"}),
    ],
)
def test_what_is_no_tail_is_refused(values, lines):
    found = faults_of(PIGEON.with_values, values)
    assert found.keys() == lines.keys()
    assert all(words in found[where] for where, words in lines.items()), found


def test_a_file_without_its_arm_and_with_a_wrong_unit_is_refused(tmp_path):
    text = '[vehicle.tail]\narea = { value = 40.0, unit = "cm2" }\nlift_slope = 3.0\nspread = 1.0\n'
    found = faults_of(wb.load_species, with_file(tmp_path, text))
    assert found.keys() == {"vehicle.tail.arm", "vehicle.tail.area.unit", "vehicle.tail.spread"}


def test_a_tilt_without_a_tail_is_refused_or_warned_of():
    asked = {"free": ("frequency", "tail_tilt"), "bounds": {"tail_tilt": (-0.5, 0.5)}}
    (line,) = faults_of(lambda: wb.OrbitProblem(PIGEON, speed=10.0, **asked)).values()
    assert "changes nothing, because there is no tail" in line
    tilted = PIGEON.with_values({"wingbeat.tail_tilt": 0.1})
    assert any("tail_tilt has no effect" in line for line in tilted.warnings)
    assert not any("no effect" in line for line in tilted.with_tail().warnings)


def test_laws_give_a_pigeon_a_pigeons_tail():
    """One dissected pigeon of 0.26 kg has a tail 0.1002 m long (Harvey et al. 2022); AVONET's mean is 0.1055 m."""
    assert scaling.TAIL_LENGTH(0.26) == pytest.approx(0.1, rel=0.05)
    tail = PIGEON.with_tail().vehicle.tail
    wings = 2 * PIGEON.vehicle.wing.semi_span * PIGEON.vehicle.wing.mean_chord
    assert 0.05 < tail.area / wings < 0.15
    sources = [n.source for path, n in PIGEON.with_tail().numbers.items() if path.startswith("vehicle.tail")]
    assert sum(source.startswith("derived") for source in sources) == 4
    assert any("not measured: tail.area, tail.arm" in line for line in PIGEON.with_tail().warnings)


def test_birds_get_a_tail_on_request():
    size = {"mass": 0.3, "wing_span": 0.62, "wing_area": 0.06}
    assert wb.bird(**size).vehicle.tail is None
    bird = wb.bird(**size, tail=True, tail_area=0.005)
    assert bird.vehicle.tail.area == 0.005
    assert bird.vehicle.tail.lift_slope == pytest.approx(2 * math.pi * math.tan(math.radians(30)))
    assert "must be True or False" in faults_of(lambda: wb.bird(**size, tail="long"))["tail"]
    assert "must be given for a tail" in faults_of(lambda: wb.bat(**size, tail_area=0.005))["vehicle.tail.arm"]


def test_it_is_drawn_with_its_area_about_its_aerodynamic_centre():
    tail = wb.Tail(0.0064, 0.16, 3.0, height=0.02, incidence=0.3)
    corners = tail_corners(tail, tilt=-0.1)
    assert corners.mean(axis=0) == pytest.approx([-0.16, 0.0, 0.02])
    across = [*(corners[1] - corners[0]), *(corners[2] - corners[0])]
    normal = [across[i] * across[3 + j] - across[j] * across[3 + i] for i, j in ((1, 2), (2, 0), (0, 1))]
    assert 0.5 * math.hypot(*normal) == pytest.approx(0.0064)
    assert math.atan2(-normal[0], normal[2]) == pytest.approx(0.2, abs=1e-12)
