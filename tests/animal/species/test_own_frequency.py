"""The frequency at which an animal beats: from its file, by a law of its kind, or given by the user."""

import dataclasses
import json

import pytest

import wingbeat as wb
from wingbeat.animal.species.numbers import OwnFrequency, frequency_between
from wingbeat.animal.species.writing import species_text
from wingbeat.cli.app import main
from wingbeat.records.inputs import inputs_of, problem_from

PIGEON, BAT = wb.load_species("pigeon"), wb.load_species("bat")
SLOW = OwnFrequency(8.0, (6.0, 10.0), "measured", "a film", (3.0, 5.0))
FAST = OwnFrequency(6.0, (5.0, 7.0), "law", "a law", (7.0, 20.0))


@pytest.mark.parametrize(
    ("speed", "value", "band", "basis"),
    [
        (4.0, 8.0, (6.0, 10.0), "measured"),
        (5.0, 8.0, (6.0, 10.0), "measured"),
        (6.0, 7.0, (5.5, 8.5), "law"),
        (12.0, 6.0, (5.0, 7.0), "law"),
        (0.0, 8.0, (6.0, 10.0), "measured"),
        (30.0, 6.0, (5.0, 7.0), "law"),
    ],
)
def test_between_the_speeds_of_entries_the_frequency_is_on_a_straight_line(speed, value, band, basis):
    found = frequency_between([FAST, SLOW], speed)
    assert found[:3] == (pytest.approx(value), pytest.approx(band), basis)
    assert ("as at" in found.source) == (speed in (0.0, 30.0))
    assert ("between" in found.source) == (speed == 6.0)


def test_an_animal_flies_at_its_own_frequency_and_its_band_is_the_error_bar():
    problem = wb.models.animal(PIGEON).problem(PIGEON, 12.0)
    assert problem.frequency_basis == "law"
    assert "frequency" not in problem.free
    assert problem.species.wingbeat.frequency == 6.15
    from wingbeat.orbits.problem.parameters import parameters_of

    frequency = next(one for one in parameters_of(problem) if one.path == "wingbeat.frequency")
    assert frequency.plausible == (5.4, 6.9)
    slow = problem.at_speed(4.0)
    assert (slow.species.wingbeat.frequency, slow.frequency_basis) == (7.85, "measured")
    assert slow.at_speed(12.0).species.wingbeat == problem.species.wingbeat


def test_a_frequency_is_given_searched_or_the_animals_own():
    def flown(frequency=None, **changes):
        return wb.models.animal(PIGEON, frequency).problem(PIGEON, 12.0, **changes)

    given = flown(7.2)
    assert (given.frequency_basis, given.species.wingbeat.frequency) == ("given", 7.2)
    assert "frequency" not in given.free
    assert given.origin is not None
    assert given.origin.changed == ("frequency",)
    assert given.at_speed(5.0).species.wingbeat.frequency == 7.2
    free = flown("free")
    assert (free.frequency_basis, "frequency" in free.free) == ("free", True)
    assert flown(minimise="frequency").frequency_basis == "free"
    assert flown(subject_to=["frequency=7"]).frequency_basis == "given"
    set_by_hand = PIGEON.with_values({"wingbeat.frequency": 7.0})
    by_hand = wb.models.animal(PIGEON).problem(set_by_hand, 12.0)
    assert (by_hand.frequency_basis, by_hand.species.wingbeat.frequency) == ("given", 7.0)
    assert wb.OrbitProblem(PIGEON, 12.0).frequency_basis == "free"
    with pytest.raises(wb.InvalidInputError, match="must be > 0"):
        wb.models.animal(PIGEON, -1.0)
    with pytest.raises(wb.InvalidInputError, match="'free' to search for it"):
        wb.models.animal(PIGEON, "fast")  # type: ignore[arg-type]


def test_a_robot_searches_because_no_law_of_motors_is_known():
    robot = wb.load_species("robofalcon2")
    assert wb.models.animal(robot).problem(robot, 8.0).frequency_basis == "free"


def test_bats_follow_the_law_of_bats_in_speed():
    law = [round(wb.bat(mass=0.068, wing_span=0.6, wing_area=0.06).own_frequency(v).value, 2) for v in (4.0, 8.0)]
    assert law == [7.4, 6.54]  # 5.54 - 3.068 log10 0.068 - 2.857 log10 V
    assert [round(BAT.own_frequency(v).value, 2) for v in (4.0, 8.0)] == law
    own = wb.bat(mass=0.068, wing_span=0.6, wing_area=0.06, frequency=9.0)
    assert own.own_frequency(4.0)[:3] == (9.0, (9.0, 9.0), "given")


def test_entries_survive_the_species_file_and_the_orbits_file(tmp_path):
    path = tmp_path / "pigeon.toml"
    path.write_text(species_text(PIGEON))
    assert wb.load_species(path).frequencies == PIGEON.frequencies
    problem = wb.models.animal(PIGEON).problem(PIGEON, 12.0)
    back = problem_from(json.loads(json.dumps(inputs_of(problem, 1, 0))))
    assert back.at_speed(4.0).species.wingbeat.frequency == 7.85
    assert back.frequency_basis == "law"


def test_all_faults_of_entries_are_listed_at_once(tmp_path):
    text = species_text(dataclasses.replace(PIGEON, frequencies=()))
    text += """
[[frequencies]]
value = 12.0
range = [5.0, 7.0]
basis = "law"
unit = "1/min"
speeds = [3.0, 9.0]

[[frequencies]]
value = 6.0
range = [5.0, 7.0]
basis = "law"
speeds = [8.0, 12.0]
"""
    path = tmp_path / "wrong.toml"
    path.write_text(text)
    with pytest.raises(wb.InvalidInputError) as raised:
        wb.load_species(path)
    said = str(raised.value)
    assert "frequencies[0].unit" in said
    assert "must be above 0 and within its range, 5 to 7 Hz" in said
    assert "overlap with those of frequencies[0]" in said


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("--frequency 7 --free frequency", "is given, but --free frequency searches for it"),
        ("--free wing", "is no parameter that can be free"),
        ("--frequency 0", "must be > 0 Hz"),
    ],
)
def test_the_shell_refuses_what_contradicts(capsys, line, said):
    assert main(["orbit", "pigeon", "--speed", "12", "--model", "animal", *line.split()]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.slow
def test_the_headline_says_that_the_frequency_is_given(capsys):
    line = "orbit pigeon --speed 14 --model animal --starts 1"
    assert main(line.split()) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "given, not predicted: frequency 6.15 Hz, by a law of its kind, 5.4 to 6.9 Hz" in said
    assert main([*line.split(), "--frequency", "6.5", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert (record["frequency_basis"], record["wingbeat"]["frequency"]) == ("given", 6.5)


def test_a_file_without_its_kind_is_read_though_only_laws_complete_its_muscle(tmp_path):
    path = tmp_path / "kindless.toml"
    path.write_text(species_text(PIGEON).replace('kind = "bird"\n', "", 1))
    kindless = wb.load_species(path)
    assert kindless.kind == ""
    with pytest.raises(wb.InvalidInputError, match='write kind = "bird" or kind = "bat" into its file'):
        kindless.with_alternative("muscle")
