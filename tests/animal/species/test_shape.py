"""How an animal looks: the table [shape] of species files, its faults, and the shapes of the built-in species."""

from __future__ import annotations

import dataclasses
import json
import re
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.species_texts import MINIMAL, faults_of
from wingbeat._base import InvalidInputError
from wingbeat.animal.species.file_schema import json_schema
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.numbers import COLOURS, LOOKS, SHAPE
from wingbeat.animal.species.reading import packaged_text, species_names, template
from wingbeat.animal.species.shape import Shape
from wingbeat.animal.species.writing import species_text
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.records.inputs import inputs_of, species_from

COLOURED = "[shape.colours]\n" + "".join(f'{name} = "#123aBC"\n' for name in COLOURS)
LOOK = """
[shape]
cover = "membrane"
leading_edge = [0.35, 0.4, -0.5]
trailing_edge = [0.95, 0.95, 0.5]
body_length = 0.1
body_width = 0.05
body_depth = 0.04
"""
GOOD = MINIMAL + LOOK + COLOURED


def chord_of(shape: Shape) -> np.ndarray:
    return np.add(shape.leading_edge, shape.trailing_edge)


# --- the built-in species ---


@pytest.mark.parametrize("name", species_names())
def test_a_built_in_species_is_drawn_with_the_area_of_its_model_and_a_closed_tip(name: str) -> None:
    species = load_species(name)
    shape = species.shape
    assert shape is not None
    chord = chord_of(shape)
    assert np.trapezoid(chord, dx=1 / (len(chord) - 1)) == pytest.approx(1, abs=2e-3)
    assert chord[-1] == 0
    assert chord[:-1].min() > 0.15
    assert shape.cover == {"bird": "feathers", "bat": "membrane", "robot": "film"}[species.kind]
    # The wings meet a body that is no wider than the space between the shoulders allows.
    assert abs(shape.body_width - 2 * species.vehicle.wing.shoulder[1]) < 0.25 * shape.body_width or (
        species.kind == "robot"
    )
    assert shape.schematic  # all outlines are drawn by eye


@pytest.mark.parametrize("name", species_names())
def test_every_number_of_a_built_in_shape_has_unit_source_and_range(name: str) -> None:
    raw = tomllib.loads(packaged_text(name))["shape"]
    assert set(raw) == {key.path.split(".")[1] for key in (*SHAPE, *LOOKS)}
    for key in SHAPE:
        number = raw[key.name]
        assert set(number) == {"value", "unit", "source", "range"}, key.path
        assert number["unit"] == key.unit
        assert number["source"].strip()
        low, high = number["range"]
        values = number["value"] if isinstance(number["value"], list) else [number["value"]]
        assert low < high
        assert all(low <= value <= high for value in values), key.path


def test_a_swift_has_swept_and_pointed_wings_and_a_gull_long_ones_bent_at_the_wrist() -> None:
    swift, gull, pigeon = (load_species(name).shape for name in ("common-swift", "herring-gull", "pigeon"))
    assert swift.trailing_edge[-1] > 1.2
    assert chord_of(swift)[18] < 0.4 < chord_of(pigeon)[18]
    forward = np.argmax(gull.leading_edge) / 20
    assert 0.35 <= forward <= 0.45
    assert gull.leading_edge[8] > gull.leading_edge[0] + 0.3
    assert gull.trailing_edge[9] < gull.trailing_edge[0] - 0.3


# --- files of one's own ---


def test_a_shape_is_optional_and_may_be_short(load: Any) -> None:
    assert load(MINIMAL).shape is None
    shape = load(GOOD).shape
    assert (shape.cover, shape.leading_edge, shape.body_length) == ("membrane", (0.35, 0.4, -0.5), 0.1)
    assert (shape.camber, shape.bill_length, shape.tail_width) == (0, 0, 0)
    assert shape.colours == dict.fromkeys(COLOURS, "#123aBC")
    assert not shape.schematic
    assert shape.numbers["shape.bill_length"].source == "not given: the default"


def test_the_shape_in_the_template_holds_every_key_and_loads(load: Any) -> None:
    text = template()
    start = text.index("# [shape]")
    shape = text[start : text.index("\n\n", start)]
    used = "\n".join(re.findall(r"^# (\[.*|\w+ = .*)$", shape, re.MULTILINE))
    species = load(text + used)
    assert species.warnings == ()
    assert species.shape.leading_edge[-1] == -0.5
    assert set(tomllib.loads(used)["shape"]) == {key.path.split(".")[1] for key in (*SHAPE, *LOOKS)}


def test_a_guess_makes_a_shape_schematic(load: Any) -> None:
    guessed = GOOD.replace("body_width = 0.05", 'body_width = { value = 0.05, source = "guess: by eye" }')
    assert load(guessed).shape.schematic


def test_a_number_outside_its_range_warns(load: Any) -> None:
    odd = GOOD.replace("body_width = 0.05", 'body_width = { value = 0.05, unit = "m", range = [0.01, 0.02] }')
    assert "shape.body_width = 0.05 m is outside its plausible range 0.01 to 0.02 m" in load(odd).warnings


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        ('cover = "membrane"', 'cover = "scales"', "shape.cover"),
        ('cover = "membrane"', "", "shape.cover"),
        ("leading_edge = [0.35, 0.4, -0.5]", "leading_edge = 0.3", "shape.leading_edge"),
        ("leading_edge = [0.35, 0.4, -0.5]", "leading_edge = [0.3]", "shape.leading_edge"),
        ("leading_edge = [0.35, 0.4, -0.5]", "leading_edge = [0.3, 'x', 0.1]", "shape.leading_edge[1]"),
        ("leading_edge = [0.35, 0.4, -0.5]", "leading_edge = [0.3, 0.4, 1e99]", "shape.leading_edge[2]"),
        ("leading_edge = [0.35, 0.4, -0.5]", "", "shape.leading_edge"),
        ("leading_edge = [0.35, 0.4, -0.5]", "leading_edge = [0.3, 0.4]", "shape.trailing_edge"),
        ("leading_edge = [0.35, 0.4, -0.5]", "leading_edge = [0.3, 0.4, -0.6]", "shape.trailing_edge[2]"),
        ("trailing_edge = [0.95, 0.95, 0.5]", "trailing_edge = [1.9, 1.9, 0.5]", "shape.trailing_edge"),
        ("trailing_edge = [0.95, 0.95, 0.5]", "trailing_edge = [-0.35, -0.4, 0.5]", "shape.trailing_edge"),
        ("body_length = 0.1", "body_length = 0", "shape.body_length"),
        ("body_length = 0.1", "", "shape.body_length"),
        ("body_length = 0.1", "body_length = 1e9", "shape.body_length"),
        ("body_length = 0.1", "body_length = 0.1\nhead_length = 0.2", "shape.head_length"),
        ("body_length = 0.1", "body_length = 0.1\ntail_length = -1", "shape.tail_length"),
        ("body_length = 0.1", "body_length = 0.1\ncamber = 0.9", "shape.camber"),
        ("body_length = 0.1", "body_length = 0.1\nthickness = nan", "shape.thickness"),
        ("body_length = 0.1", "body_length = 0.1\nbeak_length = 0.1", "shape.beak_length"),
        ("body_length = 0.1", 'body_length = { value = 0.1, unit = "mm" }', "shape.body_length.unit"),
        ('back = "#123aBC"', 'back = "blue"', "shape.colours.back"),
        ('back = "#123aBC"', "back = 3", "shape.colours.back"),
        ('back = "#123aBC"', "", "shape.colours.back"),
        ('back = "#123aBC"', 'back = "#123aBC"\nfeet = "#123aBC"', "shape.colours.feet"),
    ],
)
def test_one_fault_is_told_once_at_its_place(load: Any, old: str, new: str, where: str) -> None:
    assert old in GOOD
    assert list(faults_of(load, GOOD.replace(old, new, 1))) == [where]


def test_faults_name_value_rule_and_fix(load: Any) -> None:
    text = GOOD.replace("trailing_edge = [0.95, 0.95, 0.5]", "trailing_edge = [1.65, 1.85, 0.5]")
    text = text.replace('bill = "#123aBC"', 'bill = "red"').replace("body_depth = 0.04", "")
    assert list(faults_of(load, text).values()) == [
        "shape.colours.bill = 'red': must be a colour; write it as \"#rrggbb\"",
        "shape.body_depth = nothing: must be given; largest depth of the body [m]",
        "shape.trailing_edge = [1.65, 1.85, 0.5]: gives, with the leading edge, a mean chord of 1.625 mean chords; "
        "it must be 1; divide both edges by 1.625",
    ]


def test_all_faults_of_a_shape_are_told_at_once_with_those_of_the_rest(load: Any) -> None:
    text = GOOD.replace("body_length = 0.1", "body_length = -1\ncamber = 7\ntail_lenght = 0.1")
    text = text.replace("frequency = 5", "frequency = -5").replace('wing = "#123aBC"', 'wing = "#12"')
    lines = faults_of(load, text)
    assert set(lines) == {
        "shape.body_length",
        "shape.camber",
        "shape.tail_lenght",
        "shape.colours.wing",
        "wingbeat.frequency",
    }
    assert "did you mean tail_length" in lines["shape.tail_lenght"]


def test_a_missing_number_hides_no_other_fault(load: Any) -> None:
    text = GOOD.replace("leading_edge = [0.35, 0.4, -0.5]", "").replace("body_width = 0.05", "body_width = -2")
    assert set(faults_of(load, text)) == {"shape.leading_edge", "shape.body_width"}


# --- how it travels ---


@pytest.mark.parametrize("name", species_names())
def test_a_shape_survives_the_text_of_its_species(tmp_path: Path, name: str) -> None:
    species, path = load_species(name), tmp_path / "again.toml"
    path.write_text(species_text(species), encoding="utf-8")
    assert load_species(path).shape == species.shape


def test_a_shape_made_in_python_survives_too(tmp_path: Path) -> None:
    made = Shape("film", [0.25, 0.25], [0.75, 0.75], 0.2, 0.1, 0.1, dict.fromkeys(COLOURS, "#000000"), camber=0.05)
    species, path = dataclasses.replace(load_species("robofalcon2"), shape=made), tmp_path / "again.toml"
    path.write_text(species_text(species), encoding="utf-8")
    again = load_species(path).shape
    assert again.drawn() == made.drawn()
    for colours in ({"back": "#000000"}, None, ["#000000"] * 6):
        with pytest.raises(InvalidInputError, match="must be a colour"):
            dataclasses.replace(made, colours=colours)
    with pytest.raises(InvalidInputError, match="head_length = 'long'"):
        dataclasses.replace(made, head_length="long")
    with pytest.raises(InvalidInputError, match="at least 2 numbers"):
        dataclasses.replace(made, leading_edge=0.25)


def test_a_replaced_number_loses_the_source_of_the_old_one() -> None:
    pigeon = load_species("pigeon").shape
    changed = dataclasses.replace(pigeon, camber=0.11)
    assert changed.numbers["shape.camber"] == (0.11, "1", "", None)
    assert changed.numbers["shape.thickness"] == pigeon.numbers["shape.thickness"]


def test_the_inputs_of_an_orbit_hold_the_shape_and_give_it_back() -> None:
    for name in ("bat", "purdue-hummingbird"):
        species = load_species(name)
        inputs = json.loads(json.dumps(inputs_of(wb.OrbitProblem(species, speed=4.0), 1, 0)))
        assert species_from(inputs).shape == species.shape
        del inputs["species"]["shape"]  # a file of a version without shapes
        assert species_from(inputs).shape is None


def test_a_changed_species_keeps_its_shape_and_says_it_as_json() -> None:
    pigeon = load_species("pigeon")
    for changed in (pigeon.with_values({"wing.mass": 0.025}), pigeon.with_tail(), pigeon.with_payload(0.01)):
        assert changed.shape == pigeon.shape
    plain = json.loads(json.dumps(pigeon.as_dict(), allow_nan=False))["shape"]
    assert plain["colours"] == pigeon.shape.colours
    assert plain["numbers"]["shape.bill_length"]["value"] == plain["bill_length"] == 0.0232
    assert load_species("pigeon").with_record(pigeon.vehicle).shape == pigeon.shape


def test_no_model_reads_the_shape() -> None:
    """Neither the numbers of the species, nor the parameters of sensitivities and error bars, contain it."""
    species = load_species("pigeon")
    other = dataclasses.replace(species, shape=None)
    assert not [path for path in species.numbers if path.startswith("shape")]
    problems = [wb.OrbitProblem(animal, speed=12.0) for animal in (species, other)]
    assert [p.path for p in parameters_of(problems[0])] == [p.path for p in parameters_of(problems[1])]
    assert not [p.path for p in parameters_of(problems[0]) if "shape" in p.path]
    assert (
        "is not a number"
        in faults_of(lambda: wb.bird(mass=0.3, wing_span=0.6, wing_area=0.06, camber=0.1))["camber"]
    )
    with pytest.raises(InvalidInputError, match="no number has this path"):
        species.with_values({"shape.camber": 0.1})


def test_keys_of_studies_do_not_hang_on_how_the_animal_looks(tmp_path: Path) -> None:
    pigeon, found = load_species("pigeon"), set()
    red = dataclasses.replace(pigeon.shape, colours=dict.fromkeys(COLOURS, "#ff0000"))
    for i, shape in enumerate((pigeon.shape, red, None)):
        path = tmp_path / f"{i}.toml"
        path.write_text(species_text(dataclasses.replace(pigeon, shape=shape)), encoding="utf-8")
        plan = wb.plan_study({"species": str(path), "speed": 8.0}, store=tmp_path / "x.study.sqlite").plan
        found.add(tuple(point.key for point in plan.points()))
        told = plan.bases[0].recipe.inputs()["species"].get("shape")  # as it comes to a worker
        assert (told and told["colours"]) == (shape and shape.colours)
    assert len(found) == 1


def test_the_schema_knows_every_key_and_what_it_may_hold() -> None:
    definitions = json_schema()["$defs"]
    assert set(definitions["Shape"]["properties"]) == {key.path.split(".")[1] for key in (*SHAPE, *LOOKS)}
    assert definitions["Shape"]["properties"]["cover"]["enum"] == ["feathers", "membrane", "film"]
    assert {one["pattern"] for one in definitions["Colours"]["properties"].values()} == {"^#[0-9a-fA-F]{6}$"}
    required = [rule["oneOf"][0]["required"][0] for rule in definitions["Shape"]["allOf"]]
    assert set(required) == {"cover", "colours"} | {key.name for key in SHAPE if key.required}
