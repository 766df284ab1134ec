"""Control characters in files never reach the terminal: they could hide a warning, or write over an answer."""

import json

import pytest

import wingbeat as wb
from tests.helpers.species_texts import GOOD, SPECIES
from wingbeat._base import FileError, control_in, read_text, toml_tables
from wingbeat.cli import main
from wingbeat.records.forms import inputs_hash
from wingbeat.records.result_files import load_dataset, save_result

RED, TURNED = "\x1b[31m", "\u202e"


@pytest.fixture(scope="module")
def orbit(pigeon_orbit, tmp_path_factory):
    path = tmp_path_factory.mktemp("orbit") / "orbit.nc"
    pigeon_orbit.orbit.save(path)
    return load_dataset(path)


def renamed(dataset, name):
    """Return an orbit of an animal with another name, as consistent as a forger can make it."""
    inputs = json.loads(dataset.attrs["inputs"])
    inputs["species"]["name"] = name
    hashed = {"inputs": json.dumps(inputs), "inputs_hash": inputs_hash(inputs)}
    return dataset.assign_attrs(species=name, **hashed)


@pytest.mark.slow
@pytest.mark.parametrize("control", [RED, TURNED, "\r", "\x9b31m", "\b"], ids=ascii)
def test_no_text_of_a_result_reaches_the_terminal_with_one(orbit, tmp_path, capsys, control):
    warned = [*json.loads(orbit.attrs["warnings"]), f"all is {control}well"]
    lies = (
        renamed(orbit, f"pig{control}eon"),
        orbit.assign_attrs(warnings=json.dumps(warned)),
        orbit.assign_attrs(message=f"certified{control}"),
    )
    for lie in lies:
        save_result(lie, tmp_path / "lie.nc")
        assert main(["show", str(tmp_path / "lie.nc")]) == 2
        told = capsys.readouterr()
        assert control_in(told.out + told.err) is None
        assert "a text holds the control character" in told.err
    save_result(renamed(orbit, "pigeon of Łódź, 2nd flock"), tmp_path / "good.nc")
    assert main(["show", str(tmp_path / "good.nc")]) == 0


@pytest.mark.parametrize("written", [RED, "\\u001b[31m", "\\u202E"], ids=ascii)
def test_no_text_of_a_species_or_a_table_does(tmp_path, capsys, written):
    path = tmp_path / "own.toml"
    path.write_text(f'name = "{written}"\n' + SPECIES.format(**GOOD), encoding="utf-8")
    assert main(["species", str(path)]) == 2
    told = capsys.readouterr()
    assert control_in(told.out + told.err) is None
    assert "control character" in told.err


def test_the_line_is_named_and_plain_texts_are_read(tmp_path):
    path = tmp_path / "film.csv"
    path.write_text(f"time,flap\n0,{RED}1\n", encoding="utf-8")
    with pytest.raises(FileError, match=r"line 2 holds the control character '\\x1b'; write plain text"):
        read_text(path)
    plain = "# degrees °\ttab\r\nα,ψ\n"
    path.write_text(plain, encoding="utf-8", newline="")
    assert read_text(path) == plain
    assert toml_tables('a = "two\\nlines, naïve"', "x") == {"a": "two\nlines, naïve"}
    assert wb.load_species("pigeon").name == "pigeon"
