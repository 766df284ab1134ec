"""The models of a flight, paper and animal: what each chooses, what stays the species' own, what a record says."""

import dataclasses
import json

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.places import ROOT
from wingbeat.cli import main
from wingbeat.records.inputs import problem_from
from wingbeat.results.orbit import inputs_of

PIGEON, BAT = wb.load_species("pigeon"), wb.load_species("bat")
ROBOT = wb.robot(mass=0.1, wing_span=0.6, wing_area=0.06)
MOTOR = {"motor.torque_constant": 0.007, "motor.resistance": 0.1, "motor.gear_ratio": 30.0}
KINDS = {"bird": (PIGEON, "feathered-flapping"), "bat": (BAT, "membrane"), "robot": (ROBOT, "su-fan")}


def numbers_of(problem):
    """Return all inputs of a problem but the model that made it."""
    inputs = inputs_of(problem, 6, 0)
    inputs.pop("model", None)
    return inputs


@pytest.mark.parametrize("species", [PIGEON, BAT, ROBOT], ids=lambda one: one.name)
def test_the_papers_model_is_the_problem_of_its_defaults(species):
    problem = wb.models.paper().problem(species, 10.0, climb=0.5)
    assert numbers_of(problem) == numbers_of(wb.OrbitProblem(species, 10.0, climb=0.5))


@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_has_its_wing_and_its_parts(kind):
    species, wing = KINDS[kind]
    problem = wb.models.animal(species).problem(species, 8.0)
    aero, vehicle = problem.aero, problem.vehicle
    assert (aero.coefficients.name, aero.unsteady, aero.inflow) == (wing, "thin-aerofoil", "momentum")
    assert vehicle.body.drag_area > 0
    assert (vehicle.tail is not None) == (kind == "bird")
    assert (vehicle.muscle is not None) == (kind != "robot")
    assert ("tail_tilt" in problem.free) == (kind == "bird")
    assert "downstroke_fraction" in problem.free
    assert not problem.has_own_bounds
    assert vehicle.mass == pytest.approx(species.vehicle.mass, rel=1e-12)
    assert problem.minimise.name == ("mean_positive_power" if kind == "robot" else "metabolic_power")


def test_a_robot_with_a_motor_saves_its_battery():
    driven = ROBOT.with_values(MOTOR)
    assert wb.models.animal(driven).problem(driven, 8.0).minimise.name == "electrical_power"


def test_what_the_species_gives_stays_and_nothing_is_added_twice():
    model = wb.models.animal(PIGEON)
    own = PIGEON.with_tail().with_values({"tail.area": 0.003, "body.drag_area": 0.0})
    flown = model.species(own)
    assert (flown.vehicle.tail.area, flown.vehicle.body.drag_area) == (0.003, 0.0)
    again = model.species(flown)
    assert (again.vehicle, again.free, again.bounds) == (flown.vehicle, flown.free, flown.bounds)


def test_unlike_kinds_and_unknown_ones_are_refused():
    unknown = dataclasses.replace(PIGEON, kind="")
    with pytest.raises(wb.InvalidInputError, match='kind = "bird", "bat" or "robot"'):
        wb.models.animal(unknown)
    with pytest.raises(wb.InvalidInputError, match="is a bat, not a bird"):
        wb.models.animal(PIGEON).problem(BAT, 8.0)


def test_choices_have_reasons_and_tell_what_was_changed():
    problem = wb.models.animal(PIGEON).problem(PIGEON, 12.0, minimise="frequency", subject_to=())
    assert problem.origin is not None
    record = json.loads(json.dumps(problem.origin.record()))
    assert (record["name"], record["changed"]) == ("animal", ["minimise"])
    assert all(choice["value"] and choice["reason"] for choice in record["choices"])
    named = {choice["what"]: choice["value"] for choice in record["choices"]}
    assert named["coefficients"] == "feathered-flapping"
    assert named["free: downstroke_fraction"] == "0.4 to 0.6 of a beat"
    back = problem_from(inputs_of(problem, 6, 0))
    assert back.origin == problem.origin
    assert numbers_of(back) == numbers_of(problem)


def test_what_equals_the_models_own_choice_is_no_change():
    model = wb.models.animal(PIGEON)

    def changed(**choices):
        origin = model.problem(PIGEON, 12.0, **choices).origin
        assert origin is not None
        return origin.changed

    assert changed(minimise="metabolic-power", subject_to=[], climb=0.0) == ()
    assert changed(minimise="frequency", subject_to="peak_power<=30") == ("minimise", "subject_to")
    other = model.problem(PIGEON, 12.0, aero="feathered")
    assert (other.aero.unsteady, other.aero.inflow) == ("thin-aerofoil", "momentum")
    assert other.origin is not None
    assert other.origin.changed == ("aero",)
    assert other.origin.choices == model.problem(PIGEON, 12.0).origin.choices


@pytest.mark.slow
def test_the_model_of_a_live_animal_keeps_the_filmed_wingbeat(capsys):
    beat = str(ROOT / "examples/beat.csv")
    line = ["orbit", "pigeon", "--speed", "10", "--model", "animal", "--kinematics", beat, "--json"]
    assert main(line) == 0
    record = json.loads(capsys.readouterr().out)
    flap = wb.experiment.fit_film(wb.experiment.read_film(beat)).numbers["flap_amplitude"]
    assert record["wingbeat"]["flap_amplitude"] == pytest.approx(flap)
    assert record["objective"] == "metabolic_power"
    assert record["status"] == "converged"


def test_a_glide_keeps_the_width_of_the_blends():
    wide = dataclasses.replace(
        wb.models.animal(PIGEON).aero, coefficients=wb.aero.FeatheredFlapping("mirrored", 3.0)
    )
    assert dataclasses.replace(wb.models.animal(PIGEON), aero=wide).gliding.coefficients.blend_width_deg == 3.0


@pytest.fixture(scope="module")
def answer(tmp_path_factory):
    """The orbit that the real command finds and saves for a pigeon by the model animal, with one start."""
    file = tmp_path_factory.mktemp("animal") / "pigeon.nc"
    line = "orbit pigeon --speed 12 --model animal --starts 1 --set muscle.isometric_stress=3e5"
    assert main([*line.split(), "--induced-factor", "1.1", "-o", str(file)]) == 0
    return wb.load_orbit(file)


@pytest.mark.slow
def test_the_command_solves_the_problem_of_the_model(answer):
    stronger = wb.models.animal(PIGEON).species(PIGEON).with_values({"muscle.isometric_stress": 3e5})
    still = dataclasses.replace(wb.models.animal(PIGEON).aero, induced_factor=1.1)
    expected = wb.models.animal(PIGEON).problem(stronger, 12.0, aero=still)
    assert numbers_of(answer.problem) == numbers_of(expected)
    record = answer.record()
    assert record["status"] == "converged"
    assert (record["model"]["name"], record["model"]["changed"]) == ("animal", ["induced_factor"])
    assert expected.origin is not None
    assert record["model"]["choices"] == expected.origin.record()["choices"]
    assert "free: tail_tilt" in {choice["what"] for choice in record["model"]["choices"]}
    assert record["objective"] == "metabolic_power"


@pytest.mark.parametrize("command", ["orbit pigeon --speed 8", "curve pigeon --speeds 8", "glide pigeon"])
def test_an_unknown_model_is_refused(command, capsys):
    assert main([*command.split(), "--model", "animals"]) == 2
    assert "paper" in capsys.readouterr().err


@pytest.mark.slow
def test_a_glide_is_that_of_the_animals_own_wing(capsys):
    assert main(["glide", "jackdaw", "--model", "animal", "--alpha", "6:10:2", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    jackdaw = wb.load_species("jackdaw")
    model = wb.models.animal(jackdaw)
    assert found["aero"]["coefficients"] == model.gliding.coefficients.name == "feathered"
    wanted = wb.glide_polar(model.species(jackdaw), model.gliding, np.radians([6.0, 8.0, 10.0])).record()
    assert found["sink"] == wanted["sink"]
    assert 8.0 < found["best_ratio"]["glide_ratio"] < 14.0
