"""Pages with a viewer in them, and flights to show there."""

from collections.abc import Iterator
from pathlib import Path

import pytest

import wingbeat as wb
from tests.helpers.browsers import shown_files


@pytest.fixture
def show(browser) -> Iterator:
    """Open a file in a page of its own, and wait for the viewer in it."""
    with shown_files(browser, ".wb-viewer canvas", 900, 600) as opened:
        yield opened


@pytest.fixture(scope="session")
def bats() -> dict[str, wb.Orbit]:
    """One bat by both coefficient models."""
    bat = wb.load_species("bat")
    models = {"su-fan": wb.aero.SuFan(), "dickinson": wb.aero.Dickinson()}
    found = {name: wb.solve_orbit(wb.OrbitProblem(bat, 8.0, aero=aero), starts=1) for name, aero in models.items()}
    assert all(orbit.status is wb.Status.CONVERGED for orbit in found.values())
    return found


@pytest.fixture(scope="session")
def page_of_one(bats, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("one") / "bat.html"
    wb.viewer.write_page([("bat", bats["su-fan"].dataset)], path)
    return path


@pytest.fixture(scope="session")
def page_of_two(bats, tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("two") / "bats.html"
    wb.viewer.write_page([(name, orbit.dataset) for name, orbit in bats.items()], path)
    return path
