"""``wingbeat explore``: the static explorer, a folder of plain files that needs no server."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from wingbeat._base import FaultList, make_folder
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.reading import species_names
from wingbeat.animal.species.species import Species
from wingbeat.cli.arguments import Seed, Whole, check_outputs, parse_range
from wingbeat.cli.process import EXIT_GOOD
from wingbeat.cli.terminal import progress_bar
from wingbeat_explorer import LATTICE_MODELS, default_speeds, solve_lattice, write_explorer
from wingbeat_explorer.folder import check_names
from wingbeat_explorer.lattice import check_lattice

_MOST_SPEEDS = 200


def explore(
    *,
    static: Annotated[Path, Parameter(help="The folder to write; index.html in it opens from disk.")],
    animals: Annotated[
        str | None,
        Parameter(help="Species, or paths of species files, with commas between them; default: all built-in ones."),
    ] = None,
    models: Annotated[
        str,
        Parameter(
            help="Models, with commas between them. `plausible` is `animal` within plausible ranges; `dickinson` "
            "is `paper` with the coefficients of a fruit fly."
        ),
    ] = "plausible,paper",
    speeds: Annotated[
        list[str] | None,
        Parameter(
            consume_multiple=True,
            negative=(),
            help="Speeds [m/s]: numbers, or start:stop:step; default: nine that suit the mass of each animal.",
        ),
    ] = None,
    starts: Annotated[
        Whole | None, Parameter(help="Number of starts at each speed; default: as `orbit`, 3 for `plausible`.")
    ] = None,
    seed: Seed = 0,
    push: Annotated[
        bool,
        Parameter(
            negative="",
            help="Let the reader push each animal: add flights through gusts at one speed, some 0.4 MB an animal.",
        ),
    ] = False,
) -> int:
    """Write an explorer that needs no server: drag along the power curve, and the animal flies at that speed.

    The folder holds a page, the viewer, and a file for each animal and model. It opens from disk or from any web
    server, and makes no request to another host. Each animal and model takes seconds to minutes to solve.

    Examples: wingbeat explore --static explorer --animals pigeon,bat;
    wingbeat explore --static explorer --animals mine.toml --models paper --speeds 4:16:1
    """
    faults = FaultList()
    names = _listed(faults, "--animals", animals, species_names())
    chosen = _listed(faults, "--models", models, LATTICE_MODELS)
    for name in chosen:
        faults.choice("--models", name, LATTICE_MODELS)
    row = sorted({float(one) for text in speeds or [] for one in parse_range(text, "--speeds")})
    if len(row) > _MOST_SPEEDS:
        faults.add("--speeds", len(row), f"are more than {_MOST_SPEEDS} speeds", "take a larger step")
    if static.exists() and not static.is_dir():
        faults.add("--static", str(static), "is not a folder", "name a folder, which need not exist")
    faults.raise_if_any()
    species = [load_species(name) for name in names]
    tasks = [(one, model) for one in species for model in chosen]
    check_names([(one.name, model) for one, model in tasks])
    for one, model in tasks:  # the last of them would else be refused after hours
        check_lattice(one, model, row or default_speeds(one), starts, seed)
    make_folder(static)
    check_outputs(static / "index.html")
    with progress_bar("flights") as progress:
        written = write_explorer(static, _solved(tasks, row, starts, seed, progress, push))
    size = sum(path.stat().st_size for path in written)
    print(f"wrote {static / 'index.html'} and {len(written) - 1} other files, {size / 1e6:.1f} MB", file=sys.stderr)
    return EXIT_GOOD


def _listed(faults: FaultList, option: str, text: str | None, default: Sequence[str]) -> list[str]:
    if text is None:
        return list(default)
    names = [name.strip() for name in text.split(",") if name.strip()]
    if not names:
        faults.add(option, text, "names nothing", f"for example {option} {','.join(default[:2])}")
    return list(dict.fromkeys(names))


def _solved(
    tasks: list[tuple[Species, str]],
    row: list[float],
    starts: int | None,
    seed: int,
    progress: Any,
    push: bool,
) -> Iterator[dict[str, Any]]:
    """Yield the lattice of each animal and model, of each animal the first with pushes; progress counts speeds."""
    speeds = [row or default_speeds(species) for species, _ in tasks]
    done, total = 0, sum(map(len, speeds))
    pushed = set[str]()
    for (species, model), each in zip(tasks, speeds, strict=True):
        before = done

        def tell(count: int, _: int, before: int = before) -> None:
            progress(before + count, total)

        pushes = push and species.name not in pushed
        pushed.add(species.name)
        yield solve_lattice(species, model, each, starts, seed, tell if progress else None, pushes)
        done += len(each)
