"""Files that mean no good are refused in words, or harmless; good ones come back as what they were."""

import shutil
from types import SimpleNamespace
from typing import Any

import h5py
import numpy as np
import pytest

import wingbeat as wb
from wingbeat._workers.process import Context
from wingbeat.animal.species.reading import template
from wingbeat.models import model_of
from wingbeat.records.inputs import inputs_of
from wingbeat.results.orbit import load_orbit
from wingbeat_explorer.app import jobs as uploads
from wingbeat_explorer.app.jobs import clean_label, do, scenario_of
from wingbeat_explorer.app.links import from_plain, to_json
from wingbeat_explorer.app.scenario import Scenario, problem_of


def read(path, label="sent.nc"):
    return do({"do": "read", "path": str(path), "label": label}, Context(lambda told: None, lambda: False))


def refused(path, label="sent.nc"):
    """Return the message of a refusal, which names the file as its sender does and no path of ours."""
    messages = [message for _, message in read(path, label)["refused"]]
    assert messages
    assert str(path) not in " ".join(messages)
    return " ".join(messages)


@pytest.fixture
def altered(orbit_file, tmp_path):
    """Return a copy of an orbit's file after something was done to it."""

    def alter(act):
        path = tmp_path / "altered.nc"
        shutil.copy(orbit_file, path)
        with h5py.File(path, "r+") as file:
            act(file)
        return path

    return alter


def test_an_orbit_comes_back_with_the_scenario_that_asks_for_it(orbit_file):
    found = read(orbit_file)
    assert found["answer"]["record"] == load_orbit(orbit_file).record()
    scenario = from_plain(found["scenario"])
    assert scenario == Scenario(species="pigeon", speed=10.0, starts=1)
    assert found["why_not"] == ""


def test_a_species_that_is_not_built_in_is_written_out(orbit_file, tmp_path):
    import wingbeat as wb

    path = tmp_path / "own.nc"
    own = wb.load_species("pigeon").with_values({"wing.mass": 0.0212345678901})
    problem = wb.OrbitProblem(own, 10.0, bounds={"flap_amplitude": (0.1, 1.0)}, subject_to=["peak_power<=900"])
    wb.solve_orbit(problem, starts=1).save(path)
    again = problem_of(from_plain(read(path)["scenario"]))
    assert again.vehicle == problem.vehicle
    assert again.bounds == problem.bounds
    assert [str(c) for c in again.subject_to] == ["peak_power<=900"]


def test_a_species_file_and_a_saved_state_are_told_apart(tmp_path):
    path = tmp_path / "x"
    path.write_text(template())
    assert read(path, "mine.toml")["text"] == template()
    scenario = Scenario(species="bat", speed=7.0)
    path.write_text(to_json(scenario))
    assert from_plain(read(path, "state.json")["scenario"]) == scenario


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "holds nothing"),
        (b"\x00\xff\xfe", "is not UTF-8 text"),
        (b"wing = ", "as TOML"),
        (b"a." * 100_000 + b"b = 1", "more than 4096"),
        (b"a = " + b"[" * 4000, "nested too deeply"),
        (b'name = "x"\n[vehicle.wing]\nmass = nan', "must be finite"),
        (b'{"wingbeat_explorer": 1, "state": {"species": "dodo"}}', "is not a known choice"),
        (b"{" * 50_000, "as JSON"),
        (b"\x89HDF\r\n\x1a\n" + b"\0" * 1000, "damaged or cut short"),
        (b"CDF\x01", "line 1 holds the control character '\\x01'"),
    ],
)
def test_what_is_no_good_file_is_refused_in_words(content, words, tmp_path):
    path = tmp_path / "secret-name-on-the-server"
    path.write_bytes(content)
    assert words in refused(path, "mine.toml")


def test_arrays_that_would_unpack_to_a_flood_are_refused_before_they_are_read(altered):
    def bomb(file):
        file.create_dataset("bomb", shape=(20_000, 20_000), dtype="f8", compression="gzip", fillvalue=0.0)

    path = altered(bomb)
    assert path.stat().st_size < uploads.MOST_BYTES
    assert "it would take more than 50 million bytes when unpacked" in refused(path)
    chunk = {"maxshape": (None,), "chunks": (10**8,), "compression": "gzip"}
    large_chunk = altered(lambda f: f.create_dataset("b", (1,), "f8", **chunk))
    assert "unpacked" in refused(large_chunk)


@pytest.mark.parametrize(
    ("act", "words"),
    [
        (lambda f: f.create_group("g"), "it holds more than arrays and attributes, in 'g'"),
        (lambda f: f.__setitem__("out", h5py.ExternalLink("other.nc", "/")), "points to other places or files"),
        (lambda f: f.__setitem__("soft", h5py.SoftLink("/alpha")), "points to other places or files"),
        (
            lambda f: f.create_dataset("raw", (10,), "u1", external=[("passwords", 0, 10)]),
            "points to other places or files",
        ),
        (lambda f: f.create_dataset("texts", (1000,), h5py.string_dtype()), "more than 50 million bytes when unp"),
        (lambda f: f.attrs.__setitem__("many", ["x"] * 100), "an attribute of many texts, 'many'"),
        (lambda f: f["alpha"].__setitem__((0, 0), np.nan), "it was changed after wingbeat wrote it"),
        (lambda f: f.attrs.__delitem__("inputs"), "it was changed after wingbeat wrote it"),
        (lambda f: f.attrs.__setitem__("wingbeat_kind", "cake"), "holds another kind of result, 'cake'"),
        (lambda f: f.__delitem__("strip_corner"), "it was changed after wingbeat wrote it"),
        (lambda f: f.attrs.__delitem__("wingbeat_digest"), "it has no digest"),
    ],
)
def test_an_orbit_that_was_tampered_with(altered, act, words):
    assert words in refused(altered(act))


@pytest.mark.parametrize(
    ("name", "label"),
    [
        ("../../etc/passwd", "passwd"),
        ("..\\..\\boot.ini", "boot.ini"),
        ("a\x00b\n.toml", "ab.toml"),
        ("", "the file"),
        ("/", "the file"),
        ("x" * 500, "x" * 60),
    ],
)
def test_a_file_name_is_only_ever_a_label(name, label):
    assert clean_label(name) == label


def test_an_orbit_whose_tail_turns_comes_back_with_bounds_that_free_it():
    tailed = wb.load_species("pigeon").with_tail()
    asked = {"free": (*tailed.free, "tail_tilt"), "bounds": {"tail_tilt": (-0.5, 0.4)}}
    problem = wb.OrbitProblem(tailed, 10.0, **asked)
    unsolved: Any = SimpleNamespace(problem=problem, inputs=inputs_of(problem, 1, 0))
    plain, why_not = scenario_of(unsolved)
    assert plain is not None, why_not
    assert plain["bounds"] == {"tail_tilt": [-0.5, 0.4]}
    assert problem_of(from_plain(plain)).free == problem.free


@pytest.mark.parametrize("model", ["paper", "animal"])
@pytest.mark.parametrize("asked", [{"bounds": "plausible"}, {"subject_to": ["peak_power<=3"]}, {}])
def test_an_orbit_comes_back_with_its_model_and_its_limits(model, asked):
    bat = wb.load_species("bat")
    problem = model_of(model, bat).problem(bat, 8.0, **asked)
    unsolved: Any = SimpleNamespace(problem=problem, inputs=inputs_of(problem, 1, 0))
    plain, why_not = scenario_of(unsolved)
    assert plain is not None, why_not
    assert (plain["model"], plain["within_plausible"]) == (model, "bounds" in asked)
    assert plain["limits"] == ["peak_power<=3.0"] * ("subject_to" in asked)
    assert (plain["bounds"], plain["set"]) == ({}, {})
    again = problem_of(from_plain(plain))
    assert (again.bounds, again.subject_to) == (problem.bounds, problem.subject_to)


@pytest.mark.parametrize("name", ["pigeon", "common-murre"])
@pytest.mark.parametrize("frequency", [None, "free", 7.25])
def test_an_orbit_comes_back_with_its_frequency(name, frequency):
    species = wb.load_species(name)
    problem = model_of("animal", species, frequency).problem(species, 14.0)
    unsolved: Any = SimpleNamespace(problem=problem, inputs=inputs_of(problem, 1, 0))
    plain, why_not = scenario_of(unsolved)
    assert plain is not None, why_not
    assert (plain["frequency"], plain["free_frequency"]) == (
        frequency if frequency != "free" else None,
        frequency == "free",
    )
    again = problem_of(from_plain(plain))
    assert (again.frequency_basis, again.free) == (problem.frequency_basis, problem.free)
    assert again.species.wingbeat == problem.species.wingbeat
    assert plain["set"] == {}
