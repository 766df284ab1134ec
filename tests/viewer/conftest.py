"""Pages with a viewer in them, and flights to show there."""

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest

import wingbeat as wb
from tests.helpers.browsers import PATIENCE


class Shown(NamedTuple):
    """A page with what it complained of and what it asked for."""

    page: object
    complaints: list[str]
    requests: list[str]


@pytest.fixture
def show(browser) -> Iterator:
    """Open a file in a page of its own, and wait for the viewer in it; still, for software draws slowly."""
    contexts = []

    def opened(path: Path, width: int = 900, height: int = 600, fragment: str = "", **options) -> Shown:
        options = {"viewport": {"width": width, "height": height}, "reduced_motion": "reduce"} | options
        context = browser.new_context(**options)
        contexts.append(context)
        page, complaints, requests = context.new_page(), [], []
        page.set_default_timeout(PATIENCE)
        # What software rendering says of reading pixels back is about screenshots.
        page.on("console", lambda m: complaints.append(m.text) if "GL Driver Message" not in m.text else None)
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("request", lambda request: requests.append(request.url))
        page.goto(f"{path.as_uri()}{fragment}")
        page.wait_for_selector(".wb-viewer canvas")
        return Shown(page, complaints, requests)

    yield opened
    for context in contexts:
        context.close()


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
