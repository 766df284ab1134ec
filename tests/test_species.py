"""Species: the numbers of the paper, where each stands in a file, what is refused and what only draws a warning."""

import copy
import json
import math
import os
import pickle
import subprocess
import sys
import tomllib
from dataclasses import asdict, fields
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from wingbeat.errors import FileError, InvalidInputError
from wingbeat.files import read_text, write_atomically, writing
from wingbeat.kinematics import Wingbeat
from wingbeat.species import Species, json_schema, load_species, parse_setting, species_names, template
from wingbeat.species_schema import KEYS

MINIMAL = """
[vehicle]
mass = 0.3
[vehicle.body]
pitch_inertia = 1e-4
[vehicle.wing]
semi_span = 0.3
chord = 0.1
mass = 0.01
[wingbeat]
frequency = 5
flap_mean = 0
flap_amplitude_deg = 40
pitch_mean = 0.1
pitch_amplitude = 0.2
"""


@pytest.fixture
def load(tmp_path: Path) -> Any:
    """Load a species from a TOML text."""

    def load_text(text: str) -> Species:
        path = tmp_path / "own.toml"
        path.write_text(text, encoding="utf-8")
        return load_species(path)

    return load_text


def faults_of(call: Any, *arguments: Any) -> dict[str, str]:
    """Return the faults that a call is refused for: where -> the whole line."""
    with pytest.raises(InvalidInputError) as caught:
        call(*arguments)
    lines = {fault.where: str(fault) for fault in caught.value.faults}
    assert len(lines) == len(caught.value.faults), "one fault told twice"
    return lines


# --- the animals in the box ---


def test_the_box_holds_the_two_animals_of_the_paper() -> None:
    assert species_names() == ("bat", "pigeon")


@pytest.mark.parametrize(
    ("name", "mass", "body", "semi_span", "chord", "fold_deg", "twist", "wrist"),
    [("pigeon", 0.316, 0.276, 0.279, 0.112, 0, 1.0, 0.5), ("bat", 0.068, 0.0584, 0.30, 0.10, 10, 1.6, 0.5)],
)
def test_what_the_paper_gives_is_given(
    name: str,
    mass: float,
    body: float,
    semi_span: float,
    chord: float,
    fold_deg: float,
    twist: float,
    wrist: float,
) -> None:
    animal = load_species(name)
    assert animal.numbers["vehicle.mass"].value == mass
    assert animal.vehicle.mass == pytest.approx(mass, rel=1e-14)
    assert animal.vehicle.body.mass == pytest.approx(body, rel=1e-14)
    assert (animal.vehicle.wing.semi_span, animal.vehicle.wing.chord) == (semi_span, chord)
    assert animal.wingbeat.fold_amplitude == math.radians(fold_deg)
    assert (animal.wingbeat.twist_ratio, animal.wingbeat.wrist) == (twist, wrist)
    assert animal.vehicle.wing.stroke_plane_angle == math.pi / 2
    assert animal.vehicle.wing.shoulder == (0.0, 0.0, 0.0)


def test_our_own_defaults_are_those_of_the_literature_notes() -> None:
    pigeon, bat = load_species("pigeon"), load_species("bat")
    wings = [(a.vehicle.wing.mass, a.vehicle.wing.mass_exponent) for a in (pigeon, bat)]
    assert wings == [(0.020, 2.0), (0.0048, 0.94)]
    assert [a.vehicle.body.pitch_inertia for a in (pigeon, bat)] == [3.6e-4, 2.4e-5]
    assert [a.wingbeat.span_retraction for a in (pigeon, bat)] == [0.3, 0.0]


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
    assert np.degrees(animal.body_pitch_bounds) == pytest.approx([-60, 60])
    assert animal.guessed_bounds <= {*animal.free, "body_pitch"}
    assert all(animal.reasons[key] for key in (*animal.free, "body_pitch"))


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_every_number_in_the_box_has_unit_source_and_range(name: str) -> None:
    text = (Path(load_species.__code__.co_filename).parents[1] / "data" / f"{name}.toml").read_text()
    raw = tomllib.loads(text)
    sections = [raw["vehicle"]["body"], raw["vehicle"]["wing"], raw["wingbeat"], raw["air"]]
    leaves = [leaf for section in sections for leaf in section.values()] + [raw["vehicle"]["mass"]]
    assert len(leaves) == 21
    for leaf in leaves:
        assert set(leaf) == {"value", "unit", "source", "range"}
        assert leaf["source"].strip()
    assert load_species(name).warnings == ()


@pytest.mark.parametrize("name", ["pigeon", "bat"])
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
    assert own.body_pitch_bounds == (-math.pi / 2, math.pi / 2)
    assert [line for line in own.warnings if "no orbit can be sought" in line] == list(own.warnings)


def test_numbers_stand_at_their_paths_in_the_order_of_the_record(load: Any) -> None:
    assert list(load(MINIMAL).numbers) == [key.path for key in KEYS]


def test_the_template_is_complete_and_loads_without_a_warning(load: Any) -> None:
    text = template()
    own = load(text)
    assert own.name == "my-flyer"
    assert own.warnings == ()
    for key in KEYS:
        name = key.path.rpartition(".")[2]
        assert f"\n{name}" in text or f"\n# {name}" in text, f"{key.path} is not in the template"
    for field in fields(Wingbeat):
        assert f"\n{field.name}" in text


def test_body_mass_in_place_of_the_whole(load: Any) -> None:
    own = load(MINIMAL.replace("mass = 0.3\n", "", 1).replace("[vehicle.body]", "[vehicle.body]\nmass = 0.2"))
    assert own.vehicle.body.mass == 0.2
    assert own.numbers["vehicle.mass"].value == pytest.approx(0.22)


@pytest.mark.parametrize(
    ("old", "new", "where"),
    [
        ("[vehicle.body]", "[vehicle.body]\nmass = 0.2", "vehicle.body.mass"),
        ("mass = 0.3\n", "", "vehicle.mass"),
        ("mass = 0.3\n", "mass = 0.02\n", "vehicle.mass"),
        ("mass = 0.3\n", "mass = -0.3\n", "vehicle.mass"),
        ("mass = 0.3\n", "mass = nan\n", "vehicle.mass"),
        ("mass = 0.3\n", "mass = true\n", "vehicle.mass"),
        ("mass = 0.3\n", 'mass = "0.3"\n', "vehicle.mass"),
        ("mass = 0.3\n", "mass = 1979-05-27\n", "vehicle.mass"),
        ("mass = 0.3\n", f"mass = 1{'0' * 400}\n", "vehicle.mass"),
        ("mass = 0.3\n", f"mass = 0x{'f' * 5000}\n", "vehicle.mass"),
        ("mass = 0.3\n", 'mass = {value = 300, unit = "g"}\n', "vehicle.mass.unit"),
        ("mass = 0.3\n", "mass = {value = 0.3, range = [1, 0]}\n", "vehicle.mass.range"),
        ("mass = 0.3\n", "mass = {value = 0.3, range = [0, 1, 2]}\n", "vehicle.mass.range"),
        ("mass = 0.3\n", 'mass = {unit = "kg"}\n', "vehicle.mass.value"),
        ("mass = 0.3\n", "mass = {value = 0.3, units = 3}\n", "vehicle.mass.units"),
        ("mass = 0.3\n", "mass_kg = 0.3\nmass = 0.3\n", "vehicle.mass_kg"),
        ("chord = 0.1", "chord = [0.1]", "vehicle.wing.chord"),
        ("chord = 0.1", "chord = [0.1, -0.1]", "vehicle.wing.chord[1]"),
        ("chord = 0.1", 'chord = [0.1, "x"]', "vehicle.wing.chord[1]"),
        ("chord = 0.1", "chord = 0.1\nshoulder = [0, 0]", "vehicle.wing.shoulder"),
        ("chord = 0.1", "chord = 0.1\nshoulder = [0, 0, inf]", "vehicle.wing.shoulder[2]"),
        ("chord = 0.1", "", "vehicle.wing.chord"),
        ("frequency = 5", "frequency = 0", "wingbeat.frequency"),
        ("frequency = 5", "", "wingbeat.frequency"),
        ("flap_mean = 0", "flap_mean = 0\nflap_mean_deg = 0", "wingbeat.flap_mean_deg"),
        ("flap_amplitude_deg = 40", "flap_amplitude_deg = -40", "wingbeat.flap_amplitude_deg"),
        ("flap_amplitude_deg = 40", "", "wingbeat.flap_amplitude or wingbeat.flap_amplitude_deg"),
        ("frequency = 5", "frequency = 5\nspan_retraction = 1", "wingbeat.span_retraction"),
        ("frequency = 5", "frequency = 5\nwrist = 1.5", "wingbeat.wrist"),
        ("frequency = 5", "frequency = 5\nfrequency_deg = 5", "wingbeat.frequency_deg"),
        ("[vehicle]", "colour = 3\n[vehicle]", "colour"),
        ("[vehicle]", "name = 3\n[vehicle]", "name"),
        ("[vehicle]", 'name = ""\n[vehicle]', "name"),
        ("[vehicle]", '"a\\nb" = 3\n[vehicle]', '"a\\nb"'),
        ("[vehicle]", "[air]\ndensity = 0\n[vehicle]", "air.density"),
        ("[vehicle]", "[free]\nwrist = [0, 1]\n[vehicle]", "free.wrist"),
        ("[vehicle]", "[free]\nfrequency = [0, 30]\n[vehicle]", "free.frequency"),
        ("[vehicle]", "[free]\nfrequency = [30, 1]\n[vehicle]", "free.frequency"),
        ("[vehicle]", "[free]\nfrequency = [3, 3]\n[vehicle]", "free.frequency"),
        ("[vehicle]", "[free]\nfrequency = 3\n[vehicle]", "free.frequency"),
        ("[vehicle]", "[free]\nfrequency = [1, inf]\n[vehicle]", "free.frequency[1]"),
        ("[vehicle]", "[free]\nspan_retraction = [0, 1]\n[vehicle]", "free.span_retraction"),
        ("[vehicle]", "[free]\nflap_amplitude_deg = [-5, 70]\n[vehicle]", "free.flap_amplitude_deg"),
        ("[vehicle]", "[path]\nbody_pitch_deg = [60, -60]\n[vehicle]", "path.body_pitch_deg"),
        ("[vehicle]", "[alternatives]\nx = 3\n[vehicle]", "alternatives.x"),
        ("[vehicle]", "[alternatives.x]\nwhy = 3\n[vehicle]", "alternatives.x.why"),
        (
            "[vehicle]",
            "[alternatives.x.vehicle.wing]\nmass = -1\n[vehicle]",
            "alternatives.x.vehicle.wing.mass",
        ),
        (
            "[vehicle]",
            "[alternatives.x.vehicle.wing]\nmass = 9\n[vehicle]",
            "alternatives.x.vehicle.wing.mass",
        ),
    ],
)
def test_one_fault_is_told_once_at_its_place(load: Any, old: str, new: str, where: str) -> None:
    assert old in MINIMAL
    lines = faults_of(load, MINIMAL.replace(old, new, 1))
    assert list(lines) == [where]
    assert "\n" not in lines[where]


def test_a_fault_names_value_rule_and_fix(load: Any) -> None:
    lines = faults_of(load, MINIMAL.replace("flap_amplitude_deg = 40", "flap_amplitude_deg = -40"))
    assert list(lines.values()) == [
        "wingbeat.flap_amplitude_deg = -40: must be >= 0 deg; amplitudes are half of peak to peak"
    ]


def test_all_faults_of_a_file_are_told_at_once_those_of_the_records_too(load: Any) -> None:
    text = MINIMAL.replace("pitch_inertia = 1e-4", "pitch_inertia = -1\npich = 1").replace(
        "chord = 0.1", 'chord = "wide"'
    )
    text = text.replace("semi_span = 0.3", "").replace("frequency = 5", "frequency = -5")
    assert set(faults_of(load, text + "[air]\ngravity = -1\n[free]\nfrequency = [0, 1]")) == {
        "vehicle.body.pitch_inertia",
        "vehicle.body.pich",
        "vehicle.wing.chord",
        "vehicle.wing.semi_span",
        "wingbeat.frequency",
        "air.gravity",
        "free.frequency",
    }


def test_a_mistyped_key_is_answered_with_the_nearest(load: Any) -> None:
    lines = faults_of(load, MINIMAL.replace("semi_span", "semispan"))
    assert "did you mean semi_span?" in lines["vehicle.wing.semispan"]


def test_too_many_faults_are_counted_and_not_all_listed(load: Any) -> None:
    lines = faults_of(load, MINIMAL + "".join(f"key{i} = 1\n" for i in range(1000)))
    assert len(lines) < 150
    assert any("1000 faults" in line for line in lines.values())


@pytest.mark.parametrize("unit", ["kg m2", "kg m^2", "kg m²", "kg·m²", "kg*m**2", ""])
def test_units_may_be_written_in_the_usual_ways(load: Any, unit: str) -> None:
    new = f'pitch_inertia = {{ value = 1e-4, unit = "{unit}" }}'
    assert load(MINIMAL.replace("pitch_inertia = 1e-4", new)).vehicle.body.pitch_inertia == 1e-4


def test_windows_line_ends_and_byte_order_mark_are_no_fault(tmp_path: Path) -> None:
    path = tmp_path / "windows.toml"
    path.write_bytes(b"\xef\xbb\xbf" + MINIMAL.replace("\n", "\r\n").encode())
    assert load_species(path).wingbeat.frequency == 5.0


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "holds nothing"),
        (b"# nothing\n", "holds nothing"),
        (b"mass = ", "as TOML"),
        (b"\xff\xfe\x00", "not UTF-8"),
        (b"\x7fELF\x02\x01\x00", "as TOML"),
        (b"a = " + b"[" * 5000, "nested"),
        (b"a = 9" + b"9" * 5000, "as TOML"),
        (b"a = 2021-99-99", "as TOML"),
        (b"#" * 300_000, "more than"),
    ],
)
def test_what_is_no_species_file_at_all(tmp_path: Path, content: bytes, words: str) -> None:
    path = tmp_path / "odd.toml"
    path.write_bytes(content)
    with pytest.raises(FileError, match=words) as caught:
        load_species(path)
    assert "odd.toml" in str(caught.value)


def test_missing_file_folder_pipe_and_impossible_paths(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe.toml"
    os.mkfifo(pipe)
    for path in (tmp_path / "none.toml", tmp_path, pipe, "a\0b.toml", "x" * 5000 + ".toml", "/dev/zero"):
        with pytest.raises(FileError, match="cannot read"):
            load_species(path)


def test_unknown_names_and_things_that_are_no_name() -> None:
    assert "did you mean pigeon" in faults_of(load_species, "Pigeons")["species"]
    assert "bat, pigeon" in faults_of(load_species, "template")["species"]
    assert "must be a name or a path" in faults_of(load_species, 3)["species"]


def test_a_name_in_the_box_is_not_looked_for_on_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pigeon").write_text("not toml")
    assert load_species("pigeon").name == "pigeon"
    with pytest.raises(FileError):
        load_species(Path("pigeon"))


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
        "wingbeat.flap_amplitude = 40 deg is outside its own bounds; a search starts from the nearer one",
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
    assert changed.warnings == ()
    assert load_species("pigeon") == pigeon


def test_set_values_are_held_against_the_range_again() -> None:
    heavy = load_species("pigeon").with_values({"wing.mass": 0.05})
    [line] = heavy.warnings
    assert line.startswith(
        "vehicle.wing.mass = 0.05 kg is outside its plausible range 0.019 to 0.032 kg (set"
    )
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
        "body.pitch_inertia": Fraction(1, 3),
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
        "body.pitch_inertia",
        "body.drag_area",
    }
    assert "did you mean wing.chord" in lines["wing.cord"]
    assert "set body.mass or wing.mass" in lines["mass"]


@pytest.mark.parametrize(
    ("text", "path", "value"),
    [
        ("wing.mass=0.02", "wing.mass", 0.02),
        (" wing.mass = .02 ", "wing.mass", 0.02),
        ("wing.mass=2e-2", "wing.mass", 0.02),
        ("wingbeat.flap_mean_deg=-5", "wingbeat.flap_mean_deg", -5.0),
        ("wing.chord=[0.1, 0.08]", "wing.chord", [0.1, 0.08]),
        ("wing.shoulder=[0,0,0]", "wing.shoulder", [0, 0, 0]),
    ],
)
def test_settings_are_parsed(text: str, path: str, value: Any) -> None:
    assert parse_setting(text) == (path, value)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "=",
        "wing.mass",
        "=3",
        "a=",
        "a=b",
        "a='3'",
        "a=true",
        "a=[1]\nb=2",
        "a=[1",
        "a={b=1}",
        "a=1=2",
        "a=[" * 9999,
    ],
)
def test_what_is_no_setting(text: str) -> None:
    faults_of(parse_setting, text)


# --- how it travels ---


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_as_dict_is_json_and_its_records_are_those_of_an_orbit(name: str) -> None:
    animal = load_species(name)
    plain = json.loads(json.dumps(animal.as_dict(), allow_nan=False))
    assert list(plain["vehicle"]["body"]) == ["mass", "pitch_inertia", "drag_area"]
    assert list(plain["vehicle"]["wing"]) == [
        "semi_span",
        "chord",
        "mass",
        "mass_exponent",
        "shoulder",
        "stroke_plane_angle",
    ]
    assert list(plain["air"]) == ["density", "viscosity", "gravity"]
    assert plain["wingbeat"] == asdict(animal.wingbeat)
    assert plain["free"] == list(animal.free)
    assert plain["numbers"]["vehicle.wing.mass"]["range"] == list(
        animal.numbers["vehicle.wing.mass"].range or ()
    )


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
        "import sys; from wingbeat.species import load_species; load_species('pigeon');"
        "print(sorted({'xarray', 'matplotlib', 'scipy', 'pandas', 'rich', 'cyclopts'} & set(sys.modules)))"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"


# --- files written whole or not at all ---


def test_writing_replaces_and_keeps_permissions(tmp_path: Path) -> None:
    path = tmp_path / "a.toml"
    write_atomically(path, "one")
    path.chmod(0o640)
    write_atomically(path, b"two")
    assert path.read_text() == "two"
    assert path.stat().st_mode & 0o777 == 0o640
    assert os.listdir(tmp_path) == ["a.toml"]


def test_a_link_is_written_through(tmp_path: Path) -> None:
    (tmp_path / "real.txt").write_text("old")
    (tmp_path / "link.txt").symlink_to(tmp_path / "real.txt")
    write_atomically(tmp_path / "link.txt", "new")
    assert (tmp_path / "link.txt").is_symlink()
    assert (tmp_path / "real.txt").read_text() == "new"


@pytest.mark.parametrize("error", [KeyboardInterrupt, RuntimeError, ValueError])
def test_an_interrupt_leaves_the_old_file_and_nothing_else(
    tmp_path: Path, error: type[BaseException]
) -> None:
    path = tmp_path / "a.txt"
    path.write_text("old")

    def write_half() -> None:
        with writing(path) as beside:
            assert beside.suffix == ".txt"
            beside.write_text("half")
            raise error

    with pytest.raises(error):
        write_half()
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["a.txt"]


def test_a_full_disk_is_told_with_the_path(tmp_path: Path) -> None:
    def write_too_much() -> None:
        with writing(tmp_path / "a.txt"):
            raise OSError(28, "No space left on device")

    with pytest.raises(FileError, match=r"a\.txt.*no space left on device"):
        write_too_much()
    assert os.listdir(tmp_path) == []


def test_places_that_cannot_be_written(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for path in (tmp_path, tmp_path / "none" / "a", tmp_path / "file" / "a", "/dev/null", "a\0b", "x" * 5000):
        with pytest.raises(FileError, match="cannot write"):
            write_atomically(path, "text")


def test_text_is_read_up_to_its_limit(tmp_path: Path) -> None:
    path = tmp_path / "a.txt"
    path.write_text("12345")
    assert read_text(path, limit=5) == "12345"
    with pytest.raises(FileError, match="more than 4 bytes"):
        read_text(path, limit=4)
