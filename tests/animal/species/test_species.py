"""Species: the numbers of the paper, where each stands in a file, what may be changed and what draws a warning."""

import copy
import json
import math
import pickle
import subprocess
import sys
from dataclasses import asdict, fields
from typing import Any

import numpy as np
import pytest

from tests.helpers.species_texts import MINIMAL, faults_of
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.species.building import UNNAMED_PATHS
from wingbeat.animal.species.file_schema import json_schema
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.numbers import KEYS, LOOKS, SHAPE
from wingbeat.animal.species.reading import species_names, template
from wingbeat.animal.species.writing import species_text

# --- the built-in animals ---


def test_the_two_animals_of_the_paper_and_others_are_built_in() -> None:
    assert {"bat", "pigeon"} < set(species_names())
    assert list(species_names()) == sorted(species_names())


@pytest.mark.parametrize(
    ("name", "mass", "body", "semi_span", "chord", "fold_deg", "twist", "wrist"),
    [("pigeon", 0.316, 0.276, 0.279, 0.112, 0, 1.0, 0.5), ("bat", 0.068, 0.0584, 0.30, 0.10, 10, 1.6, 0.5)],
)
def test_what_the_paper_gives_is_given(
    name: str, mass: float, body: float, semi_span: float, chord: float, fold_deg: float, twist: float, wrist: float
) -> None:
    animal = load_species(name)
    assert animal.numbers["vehicle.mass"].value == mass
    assert animal.vehicle.mass == pytest.approx(mass, rel=1e-14)
    assert animal.vehicle.body.mass == pytest.approx(body, rel=1e-14)
    assert (animal.vehicle.wing.semi_span, animal.vehicle.wing.chord) == (semi_span, chord)
    assert animal.wingbeat.fold_amplitude == math.radians(fold_deg)
    assert (animal.wingbeat.twist_ratio, animal.wingbeat.wrist) == (twist, wrist)
    assert animal.vehicle.wing.stroke_plane_angle == math.pi / 2
    # Level with the centre of mass; beside the plane of symmetry by half the width of the body.
    ahead, beside, above = animal.vehicle.wing.shoulder
    assert (ahead, above) == (0.0, 0.0)
    assert beside == pytest.approx(math.sqrt(0.00813 * animal.vehicle.mass**0.666 / math.pi), rel=0.02)


def test_our_own_defaults_are_those_of_the_literature_notes() -> None:
    pigeon, bat = load_species("pigeon"), load_species("bat")
    wings = [(a.vehicle.wing.mass, a.vehicle.wing.mass_exponent) for a in (pigeon, bat)]
    assert wings == [(0.020, 2.0), (0.0048, 0.94)]
    assert [a.vehicle.body.pitch_inertia for a in (pigeon, bat)] == [3.6e-4, 2.4e-5]
    assert [a.wingbeat.span_retraction for a in (pigeon, bat)] == [0.3, 0.0]


@pytest.mark.parametrize("name", species_names())
def test_every_built_in_animal_says_its_kind(name: str) -> None:
    """And its text written anew says it, too."""
    animal = load_species(name)
    others = {"bat": "bat", "noctule": "bat", "short-tailed-bat": "bat", "dog-faced-fruit-bat": "bat"}
    others |= {"purdue-hummingbird": "robot", "robofalcon2": "robot"}
    assert animal.kind == others.get(name, "bird")
    assert f'kind = "{animal.kind}"' in species_text(animal).splitlines()


def test_a_kind_is_optional_and_one_of_three(load: Any) -> None:
    assert load(MINIMAL).kind == ""
    assert load('kind = "robot"\n' + MINIMAL).kind == "robot"
    assert "bird, bat or robot" in faults_of(load, 'kind = "fish"\n' + MINIMAL)["kind"]


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_free_parameters_and_bounds(name: str) -> None:
    animal = load_species(name)
    degrees = {key: tuple(np.round(np.degrees(pair), 9)) for key, pair in animal.bounds.items()}
    assert animal.free == ("frequency", "flap_mean", "flap_amplitude", "pitch_mean", "pitch_amplitude")
    assert animal.bounds["frequency"] == (1.0, 30.0)
    assert degrees["flap_amplitude"] == (5, 70)
    assert degrees["flap_mean"] == (-30, 30)
    assert degrees["pitch_amplitude"] == (0, 60)
    assert degrees["pitch_mean"] == (-30, 40)
    assert np.degrees(animal.path_bounds["body_pitch"]) == pytest.approx([-60, 60])
    assert np.degrees(animal.path_bounds["flap"]) == pytest.approx([-90, 90])
    assert animal.guessed_bounds <= {*animal.free, *animal.path_bounds}
    assert all(animal.reasons[key] for key in (*animal.free, "body_pitch"))


@pytest.mark.parametrize("name", species_names())
def test_every_alternative_loads_and_keeps_the_whole_mass_unless_it_names_one(name: str) -> None:
    animal = load_species(name)
    assert animal.alternatives
    for key, other in animal.alternatives.items():
        changed = animal.with_alternative(key)
        assert other.reason
        assert all(number.source for number in other.numbers.values())
        for path, number in other.numbers.items():
            assert changed.numbers[path].value == number.value
        whole = other.numbers.get("vehicle.mass", animal.numbers["vehicle.mass"]).value
        assert changed.vehicle.mass == pytest.approx(whole, rel=1e-14)


def test_the_measured_pigeon() -> None:
    measured = load_species("pigeon").with_alternative("avinertia")
    assert measured.vehicle.wing.mass == 0.0303
    assert measured.vehicle.body.mass == pytest.approx(0.2554)
    assert measured.vehicle.wing.shoulder == (0.036, 0.018, 0.0096)
    assert measured.warnings == ()
    assert "AvInertia" in measured.numbers["vehicle.wing.mass"].source


# --- files of one's own ---


def test_a_minimal_file(load: Any) -> None:
    own = load(MINIMAL)
    assert own.name == "own"
    assert own.vehicle.body.mass == pytest.approx(0.28)
    assert own.wingbeat.flap_amplitude == math.radians(40)
    assert own.air.density == 1.225
    assert own.vehicle.wing.stroke_plane_angle == math.pi / 2
    assert own.numbers["air.density"].source == "not given: the default"
    assert own.path_bounds == dict.fromkeys(("body_pitch", "flap"), (-math.pi / 2, math.pi / 2))
    assert [line for line in own.warnings if "no orbit can be found" in line] == list(own.warnings)


def test_numbers_stand_at_their_paths_in_the_order_of_the_record(load: Any) -> None:
    named = [key.path for key in KEYS if key.path not in UNNAMED_PATHS]
    assert list(load(MINIMAL).numbers) == named
    # A tail, what drives the wings, and laws that came later: nothing names them unless they are given.
    assert {key.path.rpartition(".")[2] for key in KEYS} - {path.rpartition(".")[2] for path in named} == {
        *("area", "arm", "lift_slope", "drag_coefficient", "height", "incidence", "tail_tilt"),
        *("elevator_share", "strain_per_angle", "max_strain_rate", "isometric_stress", "curvature"),
        *("tendon_compliance", "activation_energy", "recovery_factor", "resting_rate", "support_factor"),
        *("torque_constant", "resistance", "gear_ratio", "rotor_inertia", "no_load_current", "gear_efficiency"),
        *("crank", "stiffness", "rest_angle", "series_compliance"),
        *("cells", "capacity", "internal_resistance", "cutoff_voltage", "max_current", "cell_voltage"),
        *("damping", "stop_angle", "stop_stiffness", "twist_share", "pitch_axis", "mass_axis", "mass_gyration"),
        *("mass_stations", "station_masses", "station_axes", "station_gyrations"),
        *("chord_retraction", "twist_mean", "sweep_harmonics", "chord_harmonics", "twist_harmonics"),
    }


def test_the_template_is_complete_and_loads_without_a_warning(load: Any) -> None:
    text = template()
    own = load(text)
    assert own.name == "my-flyer"
    assert own.warnings == ()
    for key in (*KEYS, *SHAPE, *LOOKS):
        name = key.path.rpartition(".")[2]
        assert f"\n{name}" in text or f"\n# {name}" in text, f"{key.path} is not in the template"
    for field in fields(Wingbeat):
        if field.name == "pitch_hinge":  # a part of the vehicle in files
            continue
        assert f"\n{field.name}" in text or f"\n# {field.name}" in text


def test_body_mass_in_place_of_the_whole(load: Any) -> None:
    own = load(MINIMAL.replace("mass = 0.3\n", "", 1).replace("[vehicle.body]", "[vehicle.body]\nmass = 0.2"))
    assert own.vehicle.body.mass == 0.2
    assert own.numbers["vehicle.mass"].value == pytest.approx(0.22)


# --- plausible or possible ---


def test_outside_its_range_a_number_warns_and_is_used(load: Any) -> None:
    odd = 'frequency = {value = 50, unit = "Hz", range = [1, 30], source = "a guess"}'
    own = load(MINIMAL.replace("frequency = 5", odd) + "[free]\nfrequency = [1, 60]")
    assert own.wingbeat.frequency == 50
    assert own.warnings == ("wingbeat.frequency = 50 Hz is outside its plausible range 1 to 30 Hz (a guess)",)


def test_each_station_is_held_against_the_range(load: Any) -> None:
    own = load(MINIMAL.replace("chord = 0.1", "chord = {value = [0.1, 0.3], range = [0.05, 0.2]}"))
    assert own.vehicle.wing.chord == (0.1, 0.3)
    assert "vehicle.wing.chord = [0.1, 0.3] m is outside" in own.warnings[0]


def test_a_first_guess_outside_its_bounds_warns(load: Any) -> None:
    own = load(MINIMAL + "[free]\nflap_amplitude_deg = [50, 70]")
    assert own.warnings == (
        "wingbeat.flap_amplitude = 40 deg is outside its bounds; the solver starts from the nearer bound",
    )


# --- other numbers ---


def test_set_values_and_nothing_else_moves() -> None:
    pigeon = load_species("pigeon")
    changed = pigeon.with_values(
        {
            "wing.mass": 0.025,
            "vehicle.wing.chord": [0.12, 0.1],
            "wing.stroke_plane_angle_deg": 80,
            "wingbeat.twist_ratio": 1.2,
            "air.density": 1.0,
        }
    )
    before, after = asdict(pigeon.vehicle), asdict(changed.vehicle)
    assert after["body"] == before["body"]
    assert changed.vehicle.mass == pytest.approx(0.326)
    assert changed.numbers["vehicle.mass"].value == pytest.approx(0.326)
    assert changed.vehicle.wing.chord == (0.12, 0.1)
    assert changed.vehicle.wing.stroke_plane_angle == math.radians(80)
    assert asdict(changed.wingbeat) == asdict(pigeon.wingbeat) | {"twist_ratio": 1.2}
    assert asdict(changed.air) == asdict(pigeon.air) | {"density": 1.0}
    assert changed.numbers["air.density"].source.startswith("set by hand in place of 1.225 kg/m3")
    assert [text[:33] for text in changed.warnings] == ["air.density is set and air.viscos"]
    assert load_species("pigeon") == pigeon


def test_set_values_are_held_against_the_range_again() -> None:
    heavy = load_species("pigeon").with_values({"wing.mass": 0.05})
    [line] = heavy.warnings
    assert line.startswith("vehicle.wing.mass = 0.05 kg is outside its plausible range 0.019 to 0.032 kg (set")
    assert heavy.with_values({"wing.mass": 0.02}).warnings == ()


def test_alternatives_and_values_in_turn() -> None:
    pigeon = load_species("pigeon")
    both = pigeon.with_values({"body.pitch_inertia": 4e-4}).with_alternative("avinertia")
    assert (both.vehicle.body.pitch_inertia, both.vehicle.wing.mass) == (4e-4, 0.0303)
    assert "did you mean avinertia?" in faults_of(pigeon.with_alternative, "avinertial")["alternative"]


@pytest.mark.parametrize("value", [np.float64(0.02), np.float32(0.5), np.array(0.02), 1])
def test_numpy_numbers_are_numbers(value: Any) -> None:
    assert load_species("pigeon").with_values({"wing.mass": value}).vehicle.wing.mass == float(value)


def test_stations_may_be_a_tuple_or_an_array() -> None:
    pigeon = load_species("pigeon")
    for chord in ((0.1, 0.09), [0.1, 0.09], np.array([0.1, 0.09])):
        assert pigeon.with_values({"wing.chord": chord}).vehicle.wing.chord == (0.1, 0.09)


def test_what_cannot_be_set_is_told_all_at_once() -> None:
    values = {
        "wing.mass": 0.0,
        "wing.cord": 0.1,
        "mass": 0.3,
        "wing.chord": [0.1, "x"],
        "wingbeat.wrist": True,
        "air.density": math.nan,
        "air.gravity": 10**400,
        "wingbeat.flap_mean": 0.0,
        "wingbeat.flap_mean_deg": 0.0,
        "body.drag_area": None,
        3: 4,
    }
    lines = faults_of(load_species("pigeon").with_values, values)
    assert set(lines) == {
        "wing.cord",
        "mass",
        "3",
        "wing.mass",
        "wing.chord[1]",
        "wingbeat.wrist",
        "air.density",
        "air.gravity",
        "wingbeat.flap_mean_deg",
        "body.drag_area",
    }
    assert "did you mean wing.chord" in lines["wing.cord"]
    assert "set body.mass or wing.mass" in lines["mass"]


# --- how it travels ---


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_as_dict_is_json_and_its_records_are_those_of_an_orbit(name: str) -> None:
    animal = load_species(name)
    plain = json.loads(json.dumps(animal.as_dict(), allow_nan=False))
    assert list(plain["vehicle"]["body"]) == ["mass", "pitch_inertia", "drag_area", "crossflow_area"]
    assert list(plain["vehicle"]["wing"]) == [
        "semi_span",
        "chord",
        "mass",
        "mass_exponent",
        "shoulder",
        "stroke_plane_angle",
    ]
    assert list(plain["air"]) == ["density", "viscosity", "gravity"]
    assert plain["wingbeat"] == json.loads(json.dumps(asdict(animal.wingbeat)))
    assert plain["free"] == list(animal.free)
    assert plain["numbers"]["vehicle.wing.mass"]["range"] == list(animal.numbers["vehicle.wing.mass"].range or ())


def test_a_species_can_be_sent_to_another_process() -> None:
    pigeon = load_species("pigeon")
    for copied in (pickle.loads(pickle.dumps(pigeon)), copy.deepcopy(pigeon)):
        assert copied == pigeon
        assert copied.with_alternative("avinertia") == pigeon.with_alternative("avinertia")


def test_the_schema_knows_every_key_and_is_json() -> None:
    text = json.dumps(json_schema())
    for key in KEYS:
        for spelling in key.spellings:
            assert f'"{spelling.rpartition(".")[2]}": ' in text
    assert json_schema()["additionalProperties"] is False


def test_loading_imports_no_data_sets_no_figures_and_no_scipy() -> None:
    code = (
        "import sys; from wingbeat.animal.species.making import load_species; load_species('pigeon');"
        "print(sorted({'xarray', 'matplotlib', 'scipy', 'pandas', 'rich', 'cyclopts'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
