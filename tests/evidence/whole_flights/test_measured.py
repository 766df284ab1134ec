"""Measured flights: the package's own files, and files with faults."""

import re

import pytest

import wingbeat as wb
from wingbeat_evidence.whole_flights import measured_animals, read_measured_flights
from wingbeat_evidence.whole_flights.measured import COMPARED

GOOD = """
species = "pigeon"
speeds = [8.0, 6.0]

[[measured]]
quantity = "frequency"
basis = "measured"
speeds = [7.0, 7.0]
values = [5.0, 7.0]
what = "two birds"
source = "a paper"
"""


def read(tmp_path, text):
    path = tmp_path / "flights.toml"
    path.write_text(text)
    return read_measured_flights(path)


@pytest.mark.parametrize("name", measured_animals())
def test_every_shipped_number_has_a_source_and_a_species_that_flies_at_its_speed(name):
    flights = read_measured_flights(name)
    assert flights.species in wb.species_names()
    assert list(flights.speeds) == sorted(set(flights.speeds))
    for one in flights.measurements:
        assert re.search(r"(19|20)\d\d", one.source), one
        assert one.quantity in COMPARED
        if one.speeds is not None:
            assert any(one.speeds[0] <= speed <= one.speeds[1] for speed in flights.speeds), one


def test_flights_kept_for_outside_tests_are_not_among_them():
    sources = [one.source for name in measured_animals() for one in read_measured_flights(name).measurements]
    assert not any(word in source for source in sources for word in ("Deetjen", "Maeda", "Muijres", "Fry"))


def test_a_speed_of_a_single_measurement_is_flown(tmp_path):
    assert read(tmp_path, GOOD).speeds == (6.0, 7.0, 8.0)


def test_a_species_file_may_stand_beside_the_flights(tmp_path):
    assert read(tmp_path, GOOD.replace('"pigeon"', '"mine.toml"')).species == str(tmp_path / "mine.toml")


def test_all_faults_are_told_at_once(tmp_path):
    text = GOOD.replace("[7.0, 7.0]", "[7.0, -1.0]").replace('"measured"\n', '"guessed"\n')
    text = text.replace("two birds", " ").replace("[5.0, 7.0]", "[7.0, 5.0]").replace("species", "animal")
    with pytest.raises(wb.InvalidInputError) as caught:
        read(tmp_path, text)
    told = str(caught.value)
    for part in ("'animal'", "species", "basis", "what", "speeds", "falls"):
        assert part in told


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('quantity = "frequency"', 'quantity = "colour"', "quantity"),
        ("values = [5.0, 7.0]\n", "", "values"),
        ("[5.0, 7.0]", '"six"', "values"),
        ("speeds = [7.0, 7.0]", "speeds = [7.0, 700.0]", "speeds"),
        ("speeds = [8.0, 6.0]", "speeds = []", "speeds"),
        ("[[measured]]", "[measured]", "measured"),
        ('what = "two birds"', 'what = "two birds"\ncolour = "blue"', "'colour'"),
    ],
)
def test_a_fault_is_told_with_its_place(tmp_path, old, new, told):
    assert old in GOOD
    with pytest.raises(wb.InvalidInputError, match=re.escape(told)):
        read(tmp_path, GOOD.replace(old, new))
