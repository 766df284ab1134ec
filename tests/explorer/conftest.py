"""A small static explorer, and pages that show it."""

import base64
import functools
import gzip
import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

import wingbeat as wb
from tests.helpers.browsers import shown_files
from wingbeat_explorer import face_of, solve_lattice, write_explorer
from wingbeat_explorer.axis import problems_along
from wingbeat_explorer.lattice import lattice_of

SPEEDS = {"pigeon": (8.0, 10.0, 12.0, 14.0), "bat": (6.0, 8.0)}


@pytest.fixture(scope="session")
def orbits() -> dict[str, list[wb.Orbit]]:
    """Certified orbits of the paper's model, by species and speed."""
    found = {}
    for name, speeds in SPEEDS.items():
        species = wb.load_species(name)
        problems = [wb.models.paper().problem(species, speed=speed) for speed in speeds]
        found[name] = wb.solve_orbits(problems, starts=1, in_order=True)
        assert all(orbit.status is wb.Status.CONVERGED for orbit in found[name])
    return found


@pytest.fixture(scope="session")
def plates_and_flies(orbits) -> dict[str, list[wb.Orbit]]:
    """The bat's orbits, and those of the same bat with the coefficients of a fruit fly's wing."""
    bat = wb.load_species("bat")
    problems = [wb.models.paper().problem(bat, speed=speed, aero="dickinson") for speed in SPEEDS["bat"]]
    found = wb.solve_orbits(problems, starts=1, in_order=True)
    assert all(orbit.status is wb.Status.CONVERGED for orbit in found)
    return {"paper": orbits["bat"], "dickinson": found}


@pytest.fixture(scope="session")
def answers(orbits) -> dict[str, list[dict]]:
    return {name: [face_of(orbit, "paper") for orbit in row] for name, row in orbits.items()}


@pytest.fixture(scope="session")
def pushed(orbits) -> dict:
    """The pigeon's lattice, with flights through gusts."""
    return lattice_of(wb.load_species("pigeon"), "paper", orbits["pigeon"], push=True)


@pytest.fixture(scope="session")
def folder(pushed, plates_and_flies, tmp_path_factory) -> Path:
    place = tmp_path_factory.mktemp("explorer")
    bats = [lattice_of(wb.load_species("bat"), model, row) for model, row in plates_and_flies.items()]
    write_explorer(place, [pushed, *bats])
    return place


def read_script(path: Path) -> list:
    """Return the arguments of a data file's call; the last one is compressed."""
    called = re.fullmatch(r"wingbeatExplorer\.\w+\((.*)\);\n", path.read_text("utf-8"))
    name, text = json.loads(f"[{called[1]}]")
    return [name, json.loads(gzip.decompress(base64.b64decode(text)))]


ALONG = "pitch_hinge.stiffness"
STIFFNESSES = (1.2, 1.4, 1.7, 2.0, 2.8, 3.3)  # N m/rad


@pytest.fixture(scope="session")
def robot() -> wb.Species:
    """A robot whose wings pitch about hinges with springs and dampers."""
    return wb.load_species("robofalcon2").with_values({"pitch_hinge.damping": 0.0166, ALONG: 1.0})


@pytest.fixture(scope="session")
def hinged(robot) -> tuple[list[wb.Orbit], dict]:
    """Certified orbits at one speed with stiffer and stiffer hinges, and their lattice."""
    axis, problems = problems_along(robot, "animal", STIFFNESSES, ALONG, 8.0)
    found = wb.solve_orbits(problems, starts=1, in_order=True)
    assert all(orbit.status is wb.Status.CONVERGED for orbit in found)
    return found, lattice_of(robot, "animal", found, axis=axis)


@pytest.fixture(scope="session")
def hinge_folder(pushed, hinged, tmp_path_factory) -> Path:
    """An explorer with a pigeon, and a robot along the stiffness of its hinges and along the speed."""
    place = tmp_path_factory.mktemp("hinges")
    write_explorer(
        place, [pushed, hinged[1], solve_lattice(wb.load_species("robofalcon2"), "paper", [8.0, 9.0], 1)]
    )
    return place


@pytest.fixture
def show_hinges(browser, hinge_folder) -> Iterator:
    """Open this explorer from disk in a page of its own."""
    with shown_files(browser, ".wbx canvas", 1280, 844) as opened:
        yield functools.partial(opened, hinge_folder / "index.html")


@pytest.fixture
def show(browser, folder) -> Iterator:
    """Open the explorer from disk in a page of its own."""
    with shown_files(browser, ".wbx canvas", 1280, 844) as opened:
        yield functools.partial(opened, folder / "index.html")
