"""Make the traced programs that come with the package, so that a first answer need not trace its equations.

Run from the root of a clone after a change of the equations; a test says when this is due::

    uv run python benchmarks/shipped_programs.py

The programs are those of `wingbeat orbit` for all species by both models, with the bounds of the species or within
plausible ranges. Any other question traces its own programs. With `--check`, nothing is made: the exit code is 1 if
a program is missing, which means that an equation has changed.
"""

from __future__ import annotations

import argparse
import pickle
import sys
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import jax
import numpy as np

import wingbeat as wb
from wingbeat._jax import exported
from wingbeat.mechanics.wing_shape import strip_chords
from wingbeat.orbits.flight.certificate import certify
from wingbeat.orbits.nlp.transcription import Transcription, load_record_programs
from wingbeat.orbits.search_options import WakeOptions
from wingbeat.orbits.starts import start_point, wingbeat_with_all_laws
from wingbeat.records.orbit_record import crossing

MADE_BY = "made_by.txt"  # another JAX may trace equal programs otherwise, and reads these
SPEED = 8.0  # m/s; programs do not depend on it


def questions() -> Iterator[wb.OrbitProblem]:
    """Yield the problems whose programs come with the package."""
    for name in wb.species_names():
        species = wb.load_species(name)
        models = ("paper", "animal") if species.kind in ("bird", "bat") else ("paper",)
        for model in models:
            flown = wb.models.model_of(model, species)
            yield flown.problem(species, SPEED)
            yield flown.problem(species, SPEED, bounds="plausible")


def run_programs_of(problem: wb.OrbitProblem) -> None:
    """Call each program that the search, the certificate and the record of a problem call."""
    programme, start, wingbeat = Transcription(problem), start_point(problem, 0, 0), wingbeat_with_all_laws(problem)
    programme.point(programme.scaled(start))
    certify(programme.model, wingbeat, start[:4], lag=WakeOptions(certifying_flights=1))
    load_record_programs(problem, wingbeat)
    crossing(problem.vehicle, problem.aero.strips, wingbeat, problem.bounds["flap"])
    strip_chords(problem.vehicle.wing, count=problem.aero.strips)


def traced(missing: list[str], made: dict[str, bytes]) -> Callable[..., Any]:
    """Return what loads a program by tracing it, and keeps it under the name by which it comes with the package."""
    load = exported.StoredFunction._load

    def trace(self: exported.StoredFunction, tree: Any, shapes: Any, rest: Any, static: Any) -> Any:
        name = self.name(tree, (shapes, rest), static, exported.equations_digest())
        missing.append(name)
        exported.kept_program = lambda _: None
        exported.keep_program = lambda _, program: made.update({name: program})
        return load(self, tree, shapes, rest, static)

    return trace


def found(missing: list[str]) -> Callable[..., Any]:
    """Return what loads a program from the package, and notes its name if it is not there."""
    load = exported.StoredFunction._load

    def read(self: exported.StoredFunction, tree: Any, shapes: Any, rest: Any, static: Any) -> Any:
        place = exported.SHIPPED / self.name(tree, (shapes, rest), static, exported.equations_digest())
        if self._kept and place.is_file():
            return exported._Ready(lambda *_: None, *pickle.loads(zlib.decompress(place.read_bytes()))[1:])
        missing.extend([place.name] if self._kept else [])
        return load(self, tree, shapes, rest, static)

    return read


def main() -> int:
    """Make the programs of all questions, or check that they are there."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--check", action="store_true", help="only say whether all are there")
    parser.add_argument("--folder", type=Path, default=exported.SHIPPED, help="where to write them")
    given = parser.parse_args()
    missing, made = [], {}
    load = found(missing) if given.check else traced(missing, made)
    if not given.check:  # problems run small programs of their coefficients, whose numbers they check
        exported.SHIPPED = given.folder / "none"
        exported.StoredFunction._load = load
    asked = list(questions())
    exported.StoredFunction._load = load
    # Nothing is compiled: a traced program tells the shapes of its results, and any numbers serve to go on.
    exported._compiled = lambda program, arguments: jax.eval_shape(program, *arguments)
    exported.StoredFunction._run = lambda _, ready, *__: jax.tree_util.tree_unflatten(
        ready.tree, [np.zeros(shape) for shape in ready.shapes]
    )
    for problem in asked:
        run_programs_of(problem)
        if given.check and missing:
            print("an equation has changed: run benchmarks/shipped_programs.py, and commit what it writes")
            return 1
    if given.check:
        return 0
    given.folder.mkdir(exist_ok=True)
    for old in given.folder.iterdir():
        old.unlink()
    for name, program in made.items():
        (given.folder / name).write_bytes(zlib.compress(program, 9))
    (given.folder / MADE_BY).write_text(f"JAX {jax.__version__}\n")
    print(f"{len(made)} programs, {sum(map(len, made.values())) / 1e6:.2f} MB before compression")
    return 0


if __name__ == "__main__":
    sys.exit(main())
