"""The animals that fly on the first page: orbits solved when the site is built, in the viewer."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import wingbeat as wb
from wingbeat_explorer.face_data import is_plausible, lights_of

if TYPE_CHECKING:
    from sphinx.application import Sphinx


def write_live(app: Sphinx) -> None:
    """Write the viewer's page of a pigeon and a bat, with wingbeats that these animals could fly."""
    path = Path(app.srcdir) / "_live" / "live.html"
    flights = []
    for name, speed in (("pigeon", 12.0), ("bat", 6.0)):
        species = wb.load_species(name)
        problem = wb.models.animal(species).problem(species, speed, bounds="plausible")
        orbit = wb.solve_orbit(problem, starts=2)
        assert is_plausible(lights_of(orbit.record())), orbit.message
        flights.append((name, orbit.dataset))
    wb.viewer.write_page(flights, path)


def setup(app: Sphinx) -> dict[str, Any]:
    """Write the page before Sphinx copies it."""
    (Path(app.srcdir) / "_live").mkdir(exist_ok=True)  # Sphinx looks for it before anything is written
    app.connect("builder-inited", write_live, priority=110)  # after the explorer, which compiles what this needs
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
