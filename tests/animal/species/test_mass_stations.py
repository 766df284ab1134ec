"""The table of masses of a species file: as a file, ``--set``, an alternative and a builder give it."""

import re
from typing import Any

import pytest

import wingbeat as wb
from tests.helpers.species_texts import MINIMAL, faults_of
from wingbeat.animal.species.reading import robot_tables, template
from wingbeat.animal.species.writing import species_text

PLACES, MASSES = (0.1, 0.4, 0.6, 0.9), (0.004, 0.003, 0.002, 0.001)
TABLE = f"mass_stations = {list(PLACES)}\nstation_masses = {list(MASSES)}\n"
OWN = MINIMAL.replace("[vehicle.wing]\n", f"[vehicle.wing]\n{TABLE}")
COLUMNS = {"mass_stations": PLACES, "station_masses": MASSES}
SIZE: dict[str, Any] = {"mass": 0.3, "wing_span": 1.0, "wing_area": 0.1}
GIVEN = "mass = 0.01\n"  # of the wing


def without_mass(text: str) -> str:
    head, mark, tail = text.partition("[vehicle.wing]\n")
    return head + mark + tail.replace(GIVEN, "", 1)


def test_the_stations_give_the_wings_mass(load: Any) -> None:
    own = load(without_mass(OWN))
    wing = own.vehicle.wing
    assert (wing.mass_stations, wing.station_masses, wing.station_axes) == (PLACES, MASSES, None)
    assert wing.mass == pytest.approx(0.01)
    assert own.vehicle.body.mass == pytest.approx(0.28)  # of a whole of 0.3 kg
    assert own.numbers["vehicle.wing.mass"].source == "sum of wing.station_masses"
    assert load(OWN).vehicle == own.vehicle  # given as well, and equal


def test_a_mass_that_disagrees_is_refused(load: Any) -> None:
    told = faults_of(load, OWN.replace(GIVEN, "mass = 0.011\n"))["vehicle.wing.mass"]
    assert "0.011: is not the sum of wing.station_masses, 0.01 kg; correct one of them" in told
    assert "must be given" in faults_of(load, without_mass(MINIMAL))["vehicle.wing.mass"]


def test_a_species_with_a_table_comes_back_from_its_text(load: Any) -> None:
    own = load(without_mass(OWN).replace(TABLE, TABLE + "station_axes = [0.1, 0.2, 0.3, 0.4]\n"))
    again = load(species_text(own))
    assert again.vehicle == own.vehicle
    for path, number in own.numbers.items():
        if path.startswith("vehicle."):
            assert again.numbers[path] == number
    assert "station_axes" in str(own)
    assert own.as_dict()["vehicle"]["wing"]["station_axes"] == [0.1, 0.2, 0.3, 0.4]


def test_setting_one_of_the_two_moves_the_other(load: Any) -> None:
    own = load(without_mass(OWN))
    heavy = own.with_values({"wing.mass": 0.02})
    assert heavy.vehicle.wing.station_masses == pytest.approx([2 * mass for mass in MASSES])
    source = heavy.numbers["vehicle.wing.station_masses"].source
    assert source.startswith("scaled to wing.mass")
    assert heavy.with_values({"wing.mass": 0.01}).numbers["vehicle.wing.station_masses"].source == source
    other = own.with_values({"wing.station_masses": [0.004, 0.003, 0.002, 0.004]})
    assert other.vehicle.wing.mass == pytest.approx(0.013)
    assert other.vehicle.mass == pytest.approx(0.306)
    with pytest.raises(wb.InvalidInputError, match=r"wing.mass = 0.02: is not the sum"):
        own.with_values({"wing.mass": 0.02, "wing.station_masses": list(MASSES)})


def test_a_built_in_robot_takes_a_table_in_place_of_its_law() -> None:
    robot = wb.load_species("robofalcon2")
    table = {"wing.mass_stations": PLACES, "wing.station_masses": MASSES}
    with pytest.raises(wb.InvalidInputError, match=r"wing.mass_exponent = 1.125: has no effect beside"):
        robot.with_values(table)
    own = robot.with_values(table | {"wing.mass_exponent": 0.0})
    assert own.vehicle.wing.mass == pytest.approx(0.01)
    assert own.vehicle.body == robot.vehicle.body
    swapped = robot.with_record(own.vehicle)
    assert swapped.numbers["vehicle.wing.station_masses"].value == MASSES
    assert "vehicle.wing.mass_stations" not in swapped.with_record(robot.vehicle).numbers


def test_an_alternative_may_be_a_table_or_its_mass(load: Any) -> None:
    light = "[alternatives.light.vehicle.wing]\n" + TABLE + "[alternatives.heavy.vehicle.wing]\nmass = 0.02\n"
    both = load(MINIMAL.replace("mass = 0.01\n", "mass = 0.015\n") + light)
    cut = both.with_alternative("light").vehicle
    assert (cut.wing.mass, cut.wing.station_masses) == (pytest.approx(0.01), MASSES)
    assert cut.mass == pytest.approx(both.vehicle.mass)  # heavier wings make a lighter body
    heavy = load(without_mass(OWN) + light).with_alternative("heavy").vehicle
    assert heavy.wing.station_masses == pytest.approx([2 * mass for mass in MASSES])


def test_builders_take_a_table() -> None:
    own = wb.robot(**SIZE, **COLUMNS)
    assert own.vehicle.wing.mass == pytest.approx(0.01)
    assert own.vehicle.wing.mass_exponent == 0.0
    assert own.vehicle.mass == pytest.approx(0.3)
    assert own.numbers["vehicle.wing.station_masses"].source == "given"
    with pytest.raises(wb.InvalidInputError, match=r"wing_mass = 0.02: is not the sum"):
        wb.robot(
            mass=0.3, wing_span=1.0, wing_area=0.1, wing_mass=0.02, mass_stations=PLACES, station_masses=MASSES
        )


@pytest.mark.parametrize("new", [False, True])
def test_the_commented_table_of_a_new_file_loads(new: bool, load: Any) -> None:
    """Of the template, and of the tables that a robot's file gets at its end."""
    names = ("mass_stations", "station_masses", "station_axes", "station_gyrations", "pitch_axis")
    text = template()
    if new:
        robot = wb.robot(**SIZE)
        text = f"{species_text(robot)}\n{robot_tables()}".replace("# [vehicle.wing]", "[vehicle.wing]", 1)
    for name in names:
        assert f"\n# {name} = " in text
        text = text.replace(f"\n# {name} = ", f"\n{name} = ", 1)
    with pytest.raises(wb.InvalidInputError, match=r"mass_exponent = .*: has no effect"):
        load(text)
    drop = r"^mass(_exponent)? = .*(0\.007|2\.0),.*\n"
    if new:  # each is a table of its own
        drop = r"^\[vehicle\.wing\.mass(_exponent)?\]\n([^[\n].*\n)*"
    own = load(re.sub(drop, "", text, flags=re.MULTILINE))
    assert own.vehicle.wing.station_axes == (*[0.05] * 5, 0.5, 0.5, 0.5, 0.1)
    assert own.vehicle.wing.mass == pytest.approx(0.007)
