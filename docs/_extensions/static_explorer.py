"""The static explorer of the site: four flyers, one also with springs, solved with the site and then kept."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import TYPE_CHECKING, Any

import wingbeat as wb
import wingbeat_explorer
from wingbeat._base import write_atomically
from wingbeat_explorer import solve_lattice, write_explorer
from wingbeat_explorer.axis import SPEED
from wingbeat_explorer.folder import file_name

if TYPE_CHECKING:
    from sphinx.application import Sphinx

# One start at each speed, and the neighbours' results, keep the build short; the command has more starts. Within
# plausible ranges, where few wingbeats fly, there are two; at 4 and 7 m/s one finds the bat's best, too.
STARTS = {"plausible": 2}
SPEEDS = {
    "pigeon": (7.0, 8.0, 10.0, 11.0, 12.0, 14.0, 16.0, 18.0),
    "bat": (3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0),
    "annas-hummingbird": (0.0, 1.0, 2.0, 4.0, 6.0, 8.0, 10.0, 12.0),
    "robofalcon2": (4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 12.0),
}
# Plausible wingbeats exist at these speeds. At 8 m/s the pigeon's muscle is too weak, at 16 m/s it beats too seldom
# for its speed (Strouhal number); a search that finds none takes longest.
WITHIN = {"pigeon": (10.5, 11.0, 11.5, 12.0, 12.5, 13.0, 13.5, 14.0), "bat": (3.5, 4.0, 4.5, 5.0, 5.5, 6.0)}
# Nothing drives the pitch of this robot's wings: the same flight with stiffer and stiffer springs at their hinges.
HINGE = {"pitch_hinge.stiffness": 1.4, "pitch_hinge.damping": 0.0166}
ALONG = {"along": "pitch_hinge.stiffness", "values": (1.0, 1.2, 1.4, 1.7, 2.0, 2.4, 2.8, 3.3, 4.0), "speed": 8.0}
# The first flies as a live animal could; with the others, the five guided tours have what they need. All models of
# each flyer, with gusts, would take some minutes longer.
FLIGHTS = (
    ("pigeon", "plausible", SPEED.name),
    ("pigeon", "paper", SPEED.name),
    ("bat", "plausible", SPEED.name),
    ("bat", "paper", SPEED.name),
    ("bat", "dickinson", SPEED.name),
    ("annas-hummingbird", "animal", SPEED.name),
    ("robofalcon2", "paper", SPEED.name),
    ("robofalcon2", "animal", ALONG["along"]),
)
PUSHED = "pigeon"


def lattices(kept: Path) -> Iterator[dict[str, Any]]:
    """Yield each flyer by each model, read from the folder `kept` if the same program has solved it."""
    kept.mkdir(exist_ok=True)
    program = _program()
    for old in set(kept.glob("*.json")) - set(kept.glob(f"*-{program}.json")):
        old.unlink()
    files = {flight: kept / f"{file_name(*flight)}-{program}.json" for flight in FLIGHTS}
    # Those that take longest first, and each in a process of its own, because a search uses one core.
    missing = [flight for flight, path in files.items() if not path.exists()]
    missing.sort(key=lambda flight: flight[1] != "plausible" and flight[2] == SPEED.name)
    with ProcessPoolExecutor(os.cpu_count(), get_context("spawn")) as pool:
        for flight, text in zip(missing, pool.map(solved, *zip(*missing, strict=True)), strict=True):
            write_atomically(files[flight], text.encode())
    yield from (json.loads(path.read_text("utf-8")) for path in files.values())


def solved(name: str, model: str, along: str) -> str:
    """Return the lattice of a flyer by a model along the speed, or with other and other hinges, as JSON."""
    starts, push = STARTS.get(model, 1), name == PUSHED
    if along != SPEED.name:
        return json.dumps(solve_lattice(wb.load_species(name).with_values(HINGE), model, starts=starts, **ALONG))
    speeds = WITHIN.get(name, SPEEDS[name]) if model == "plausible" else SPEEDS[name]
    return json.dumps(solve_lattice(wb.load_species(name), model, speeds, starts=starts, push=push))


def _program() -> str:
    """Return a digest of all of wingbeat's Python and data, without which a kept result could be out of date."""
    digest = hashlib.sha256(Path(__file__).read_bytes())
    for package in (wb, wingbeat_explorer):
        source = Path(package.__file__).parent
        for path in sorted(p for p in source.rglob("*") if p.suffix in (".py", ".toml", ".csv")):
            digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def write_page(app: Sphinx) -> None:
    """Write the explorer beside the front page's animal, from where Sphinx copies it."""
    write_explorer(Path(app.srcdir) / "_live" / "explorer", lattices(Path(app.srcdir) / "_explorer"))


def setup(app: Sphinx) -> dict[str, Any]:
    """Write the explorer before Sphinx copies it."""
    app.connect("builder-inited", write_page, priority=100)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
