"""Traced programs that come with the package: they are those of these sources, and they are used."""

import subprocess
import sys
import zlib
from pathlib import Path

import pytest

from tests.helpers.places import ROOT
from tests.repository.test_structure import SRC, arrows, modules_of
from wingbeat._jax import exported as exporting
from wingbeat._jax.config import kept_program
from wingbeat._jax.exported import EQUATIONS, SHIPPED, exported

SCRIPT = ROOT / "benchmarks" / "shipped_programs.py"
# What the traced functions import from elsewhere, files and words: none takes part in a trace.
NO_EQUATIONS = {"wingbeat", "wingbeat._base", "wingbeat._leftovers", "wingbeat._version", "wingbeat.orbits"}


def script(*words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, str(SCRIPT), *words], capture_output=True, text=True, check=False)


def test_no_usual_first_question_traces_its_programs():
    """If this fails, an equation has changed: run benchmarks/shipped_programs.py and commit what it writes."""
    ended = script("--check")
    assert ended.returncode == 0, ended.stdout + ended.stderr


@pytest.mark.slow
def test_the_programs_are_those_that_these_sources_give(tmp_path):
    ended = script("--folder", str(tmp_path / "made"))
    assert ended.returncode == 0, ended.stderr
    made, shipped = (
        {path.name: path.read_bytes() for path in folder.iterdir()} for folder in (tmp_path / "made", SHIPPED)
    )
    assert len(made) > 10
    assert made.keys() == shipped.keys()
    if made["made_by.txt"] == shipped["made_by.txt"]:  # another JAX writes some operations otherwise
        assert made == shipped


def test_they_name_no_place_on_the_machine_that_made_them():
    for path in SHIPPED.glob("traced-*"):
        program = zlib.decompress(path.read_bytes())
        assert all(word not in program for word in (str(ROOT).encode(), b"site-packages", b"blade_element.py"))


def test_their_digest_covers_all_that_the_traced_functions_import():
    files = modules_of(SRC / "wingbeat")
    graph = arrows({name: path.read_text() for name, path in files.items()}, inner=True, hints=False)
    reached, stack = set(), ["wingbeat.orbits.flight.time_series", "wingbeat.orbits.flight.certificate"]
    while stack:
        module = stack.pop()
        if module not in reached:
            reached.add(module)
            stack += graph[module]
    outside = {name for name in reached if files[name] not in EQUATIONS}
    outside = {name for name in outside if name not in NO_EQUATIONS and not name.startswith("wingbeat._base.")}
    assert outside == set()


@pytest.fixture
def shipped(monkeypatch, tmp_path) -> Path:
    """The only program of a package, that of a function which squares, made as the package's are."""
    monkeypatch.setenv("WINGBEAT_CACHE", str(tmp_path / "made"))
    monkeypatch.setattr(exporting, "SHIPPED", tmp_path / "shipped")
    (tmp_path / "shipped").mkdir()
    names = []
    name_of = exporting.StoredFunction.name
    monkeypatch.setattr(exporting.StoredFunction, "name", lambda *given: names.append(name_of(*given)) or names[-1])
    assert float(exported(square)(3.0)) == 9.0
    kept, place = names[0], tmp_path / "shipped" / names[1]
    program = kept_program(kept)
    assert program is not None
    place.write_bytes(zlib.compress(program))
    monkeypatch.setenv("WINGBEAT_CACHE", str(tmp_path / "of-another-user"))
    return place


def square(x):
    return x * x


def untraced(*_, **__):
    raise AssertionError("traced")


def test_a_program_of_the_package_is_not_traced_and_then_kept(shipped, monkeypatch):
    monkeypatch.setattr(exporting, "without_repeats", untraced)
    assert float(exported(square)(3.0)) == 9.0
    shipped.unlink()  # the user's own copy serves
    assert float(exported(square)(4.0)) == 16.0


@pytest.mark.parametrize("content", [b"", b"no program", zlib.compress(b"no pickle")])
def test_a_damaged_program_of_the_package_is_traced_anew(shipped, content):
    shipped.write_bytes(content)
    assert float(exported(square)(3.0)) == 9.0


def test_after_a_change_of_the_equations_the_programs_of_the_package_are_not_used(shipped, monkeypatch):
    monkeypatch.setattr(exporting, "equations_digest", lambda: "of changed equations")
    monkeypatch.setattr(exporting, "without_repeats", untraced)
    with pytest.raises(AssertionError, match="traced"):
        exported(square)(3.0)
