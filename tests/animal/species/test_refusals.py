"""What a species file is refused for: every fault at its place, in words, all at once."""

import os
from pathlib import Path
from typing import Any

import pytest

from tests.helpers.species_texts import MINIMAL, faults_of
from wingbeat._base import FileError
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.reading import parse_setting


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
        ("mass = 0.3\n", f"mass = 0x{'f' * 4000}\n", "vehicle.mass"),
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
        ("[vehicle]", "[alternatives.x.vehicle.wing]\nmass = -1\n[vehicle]", "alternatives.x.vehicle.wing.mass"),
        ("[vehicle]", "[alternatives.x.vehicle.wing]\nmass = 9\n[vehicle]", "alternatives.x.vehicle.wing.mass"),
    ],
)
def test_one_fault_is_told_once_at_its_place(load: Any, old: str, new: str, where: str) -> None:
    assert old in MINIMAL
    lines = faults_of(load, MINIMAL.replace(old, new, 1))
    assert list(lines) == [where]
    assert "\n" not in lines[where]


def test_a_muscle_without_its_stress_is_refused(load: Any) -> None:
    """Such a file was taken, with a stress of 1 Pa and a curvature of 1."""
    given = "mass = 0.04\nelevator_share = 0.1\nstrain_per_angle = 0.15\nmax_strain_rate = 20\n"
    lines = faults_of(load, f"{MINIMAL}\n[vehicle.muscle]\n{given}")
    assert lines.keys() == {"vehicle.muscle.isometric_stress", "vehicle.muscle.curvature"}
    told = "nothing: must be given; stress of fully active fibres that keep their length [Pa]"
    assert told in lines["vehicle.muscle.isometric_stress"]


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
        (b"\x7fELF\x02\x01\x00", "control character"),
        (b"a = " + b"[" * 4000, "nested"),
        (b"a.a" + b".a" * 100_000 + b" = 1", "more than 4096"),
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
    assert (
        "annas-hummingbird, barn-swallow, bat, cockatiel, common-murre"
        in faults_of(load_species, "template")["species"]
    )
    assert "must be a name or a path" in faults_of(load_species, 3)["species"]


def test_a_built_in_name_is_not_looked_for_on_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pigeon").write_text("not toml")
    assert load_species("pigeon").name == "pigeon"
    with pytest.raises(FileError):
        load_species(Path("pigeon"))


# --- settings ---


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
