"""The frequency at which an animal beats: from its file, by a law of its kind, or given by the user."""

import dataclasses
import json

import pytest

import wingbeat as wb
from wingbeat._base import text_of
from wingbeat.animal.species.numbers import Number, OwnFrequency, frequency_between, frequency_of
from wingbeat.animal.species.writing import species_text
from wingbeat.cli.app import main
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.records.inputs import inputs_of, problem_from
from wingbeat.words.orbit_words import frequency_in_words

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
    slow = BAT.own_frequency(2.0)
    assert slow.range == pytest.approx((slow.value - 1.0, slow.value + 1.0))  # not the change from 4 to 10 m/s too
    heavy = wb.bat(mass=300.0, wing_span=8.0, wing_area=12.0).own_frequency(10.0)
    assert 0.0 < heavy.range[0] < heavy.value < heavy.range[1]
    own = wb.bat(mass=0.068, wing_span=0.6, wing_area=0.06, frequency=9.0)
    assert own.own_frequency(4.0)[:3] == (9.0, (9.0, 9.0), "given")


def test_an_alternative_with_another_mass_moves_the_law_of_bats():
    lighter = BAT.with_alternative("handbook-mass")
    assert lighter.own_frequency(8.0).value == pytest.approx(
        wb.bat(mass=0.044, wing_span=0.6, wing_area=0.06).own_frequency(8.0).value
    )
    assert lighter.own_frequency(8.0).value > BAT.own_frequency(8.0).value
    assert BAT.with_alternative("uniform-wing").frequencies == BAT.frequencies
    assert BAT.with_payload(0.01).frequencies == BAT.frequencies  # nothing but the body's mass changes
    told = dataclasses.replace(BAT, frequencies=(FAST,)).with_alternative("handbook-mass")
    assert told.frequencies == (FAST,)


def test_a_measured_frequency_of_a_bat_wins_over_the_law():
    noctule = wb.load_species("noctule")
    assert noctule.own_frequency(6.0)[:3:2] == (7.52, "measured")
    assert noctule.own_frequency(13.5)[:3:2] == (7.25, "measured")


@pytest.mark.parametrize(
    ("source", "kind", "basis"),
    [
        ("A: mean of 5 birds, Smith 2010", "bird", "measured"),
        ("B: as quoted by others", "bird", "measured"),
        ("D: middle of two laws", "bird", "given"),
        ("Smith 2010, table 3", "bird", "given"),
        ("", "bird", "given"),
        ("given", "bird", "given"),
        ("first guess: 4 to 6 Hz", "bird", "guess"),
        ("guess", "bat", "guess"),
        ("derived: a law", "bird", "law"),
        ("derived: that of birds", "robot", "guess"),
    ],
)
def test_the_basis_of_a_stock_frequency_is_what_its_source_says(source, kind, basis):
    found = frequency_of(Number(5.0, "Hz", source, (4.0, 7.0)), kind)
    assert found == OwnFrequency(5.0, (5.0, 5.0) if basis == "given" else (4.0, 7.0), basis, source)


def test_a_guess_keeps_its_range_and_is_called_one():
    anna = wb.load_species("annas-hummingbird")
    problem = wb.models.animal(anna).problem(anna, 6.0)
    assert problem.frequency_basis == "guess"
    assert problem.species.plausible_range("frequency", 6.0)[:2] == (25.0, 56.0)
    robot = wb.load_species("robofalcon2")
    flown = wb.models.animal(robot, "own").problem(robot, 8.0)
    assert flown.frequency_basis == "guess"
    assert flown.origin is not None
    assert ("frequency", "the robot's own") in [choice[:2] for choice in flown.origin.choices]
    record = {"frequency_basis": "guess", "wingbeat": {"frequency": 40.0}}
    assert frequency_in_words(record) == "frequency 40 Hz, a guess"


def test_choices_speak_of_own_frequency_and_posture_only_where_they_are():
    def chosen(species=PIGEON, frequency=None, **changes):
        origin = wb.models.animal(species, frequency).problem(species, 12.0, **changes).origin
        assert origin is not None
        return {"frequency", "pitch of the body"} & {choice.what for choice in origin.choices}

    assert chosen() == {"frequency", "pitch of the body"}
    assert chosen(frequency=7.2) == chosen(minimise="frequency") == {"pitch of the body"}
    assert chosen(PIGEON.with_values({"wingbeat.frequency": 7.0})) == {"pitch of the body"}
    assert chosen(bounds={"body_pitch": (-0.1, 0.2)}) == {"frequency"}
    measured = dataclasses.replace(PIGEON, guessed_bounds=frozenset())
    assert chosen(measured) == {"frequency"}


def test_a_given_frequency_is_obeyed_or_refused():
    held = dataclasses.replace(PIGEON, free=tuple(name for name in PIGEON.free if name != "frequency"))
    given = wb.models.animal(held, 7.2).problem(held, 12.0)
    assert (given.species.wingbeat.frequency, given.frequency_basis) == (7.2, "given")
    model = wb.models.animal(PIGEON, 7.2)
    with pytest.raises(wb.InvalidInputError, match="is given, but `free` searches for it"):
        model.problem(PIGEON, 12.0, free=("frequency", "flap_amplitude"))
    with pytest.raises(wb.InvalidInputError, match="is given, but subject_to fixes 8 Hz"):
        model.problem(PIGEON, 12.0, subject_to="frequency=8")
    assert model.problem(PIGEON, 12.0, subject_to="frequency=7.2").species.wingbeat.frequency == 7.2


def test_a_problem_says_itself_that_frequency_and_posture_are_the_animals_own():
    problem = wb.OrbitProblem(PIGEON, 12.0, minimise="mean_power", own_frequency=True, own_posture=True)
    assert (problem.species.wingbeat.frequency, problem.frequency_basis, problem.origin) == (6.15, "law", None)
    assert problem.at_speed(4.0).species.wingbeat.frequency == 7.85
    assert problem.at_speed(4.0).bounds["body_pitch"] != problem.bounds["body_pitch"]
    assert dataclasses.replace(problem, origin=None) == problem
    with pytest.raises(wb.InvalidInputError, match="is searched for, but own_frequency gives it"):
        wb.OrbitProblem(PIGEON, 12.0, free=("frequency",), own_frequency=True)
    with pytest.raises(wb.InvalidInputError, match="own_posture = 'yes': must be True or False"):
        wb.OrbitProblem(PIGEON, 12.0, own_posture="yes")  # type: ignore[arg-type]


def test_a_derivative_by_speed_holds_the_frequency():
    problem = wb.models.animal(BAT).problem(BAT, 8.0)
    speed = next(one for one in parameters_of(problem) if one.path == "speed")
    changed = speed.changed(problem, 9.0)
    assert changed.species.wingbeat == problem.species.wingbeat
    assert (changed.speed, changed.bounds) == (9.0, problem.bounds)


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

[[frequencies]]
value = 6.0
range = [5.0, 7.0]
basis = "measured"
speeds = [14.0, 14.0]

[[frequencies]]
value = 6.5
range = [5.0, 7.0]
basis = "law"
speeds = [14.0, 14.0]
"""
    path = tmp_path / "wrong.toml"
    path.write_text(text)
    with pytest.raises(wb.InvalidInputError) as raised:
        wb.load_species(path)
    said = str(raised.value)
    assert "frequencies[0].unit" in said
    assert "must be above 0 and within its range, 5 to 7 Hz" in said
    assert "overlap with those of frequencies[0]" in said
    assert "frequencies[2].source = nothing: must be given of what was measured" in said
    assert "frequencies[3].speeds = [14.0, 14.0]: overlap with those of frequencies[2]" in said


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


def test_laws_complete_a_muscle_whatever_the_alternative_is_called(tmp_path):
    path = tmp_path / "trained.toml"
    path.write_text(species_text(PIGEON).replace("[alternatives.muscle", "[alternatives.trained"))
    trained = wb.load_species(path).with_alternative("trained").vehicle.muscle
    assert trained == PIGEON.with_alternative("muscle").vehicle.muscle
    own = PIGEON.with_muscle().with_values({"muscle.curvature": 0.3}).with_alternative("muscle")
    assert own.vehicle.muscle.curvature == 0.3


def test_a_bound_keeps_its_reason_when_its_parameter_becomes_free():
    held = dataclasses.replace(PIGEON, free=("frequency",))
    assert held.with_free(["flap_mean"]).reasons["flap_mean"] == PIGEON.reasons["flap_mean"]


@pytest.mark.slow
def test_thin_air_and_a_load_say_that_the_frequency_is_not_theirs(tmp_path):
    starling = wb.load_species("common-starling")
    said = {}
    for name, bird in (
        ("own", starling),
        ("high", starling.at_altitude(3000.0)),
        ("loaded", starling.with_payload(0.01)),
    ):
        problem = wb.models.animal(bird).problem(bird, speed=11.0)
        orbit = wb.solve_orbit(problem, starts=1)
        said[name] = " ".join(orbit.record()["warnings"])
        head = " ".join(text_of(orbit._report()).split()).partition(" flight species, mean speed")[0]
        beside = "Hz the frequency is that of the bird's own mass at sea level"
        assert (beside in head.partition("given, not predicted: ")[2]) == (name != "own")
        title = " ".join(text.get_text() for text in orbit.plot().texts)
        assert ("with 10 g added" in title.lower()) == (name == "loaded")
        assert ("in air of 0.9093 kg/m3" in title.lower()) == (name == "high")
        orbit.save(tmp_path / "orbit.nc")
        assert wb.load_orbit(tmp_path / "orbit.nc").record()["warnings"] == orbit.record()["warnings"]
        assert wb.load_orbit(tmp_path / "orbit.nc").problem.species.carried_mass == bird.carried_mass
    assert "Pennycuick's law" not in said["own"]
    # Pennycuick 1996: frequency goes with mass to the power 3/8, and with density to the power -3/8.
    own, density = starling.own_frequency(11.0).value, starling.at_altitude(3000.0).air.density
    high = f"{own * (density / 1.225) ** -0.375:.4g} Hz"
    assert (
        f"in air of 0.9093 kg/m3, by Pennycuick's law, it is about {high}: --frequency {high[:-3]}" in said["high"]
    )
    mass = starling.vehicle.mass
    assert (
        f"with 10 g added, by Pennycuick's law, it is about {own * (1 + 0.01 / mass) ** 0.375:.4g} Hz"
        in said["loaded"]
    )


@pytest.mark.slow
def test_a_curve_says_that_the_frequency_is_given():
    starling = wb.load_species("common-starling")
    said = {}
    for frequency in ("own", "free"):
        problem = wb.models.animal(starling, frequency).problem(starling, speed=11.0)
        curve = wb.solve_curve(problem, [11.0, 11.5], starts=1, refinements=0)
        said[frequency] = text_of(curve._report())
    line = "given, not predicted: the frequency, the animal's own"
    assert line in said["own"]
    assert line not in said["free"]


def test_the_range_of_the_bodys_mass_moves_with_a_load():
    ranges = {}
    for load in (0.0, 0.06):
        bird = PIGEON.with_payload(load)
        (mass,) = (one for one in parameters_of(wb.OrbitProblem(bird, speed=12.0)) if one.path == "body.mass")
        assert mass.plausible[0] < bird.vehicle.body.mass < mass.plausible[1]
        ranges[load] = mass.plausible
    assert ranges[0.06] == pytest.approx([end + 0.06 for end in ranges[0.0]])
