"""``wingbeat explore``: the static explorer, a folder of plain files that needs no server."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Annotated, Any, NamedTuple

from cyclopts import Parameter

from wingbeat._base import FaultList, make_folder
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.reading import species_names
from wingbeat.animal.species.species import Species
from wingbeat.cli.arguments import Seed, Whole, check_outputs, parse_range
from wingbeat.cli.problem_options import Settings, changed
from wingbeat.cli.process import EXIT_GOOD
from wingbeat.cli.terminal import progress_bar
from wingbeat_explorer import LATTICE_MODELS, default_speeds, solve_lattice, write_explorer
from wingbeat_explorer.axis import SPEED
from wingbeat_explorer.folder import check_names
from wingbeat_explorer.lattice import check_lattice

_MOST_VALUES = 200


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
    along: Annotated[
        list[str] | None,
        Parameter(
            consume_multiple=True,
            negative=(),
            help="A number that changes in place of the speed, as in --set, and its values: "
            "pitch_hinge.stiffness 1:3:0.5. --speeds is then one speed.",
        ),
    ] = None,
    set_: Settings = None,
    starts: Annotated[
        Whole | None, Parameter(help="Number of starts of each flight; default: as `orbit`, 3 for `plausible`.")
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
    wingbeat explore --static explorer --animals mine.toml --models paper --speeds 4:16:1;
    wingbeat explore --static explorer --animals robofalcon2 --models animal --speeds 8
    --along pitch_hinge.stiffness 1.4:2.8:0.2 --set pitch_hinge.stiffness=1.4 pitch_hinge.damping=0.0166
    """
    faults = FaultList()
    names = _listed(faults, "--animals", animals, species_names())
    chosen = _listed(faults, "--models", models, LATTICE_MODELS)
    for name in chosen:
        faults.choice("--models", name, LATTICE_MODELS)
    row, (name, *values) = _values(speeds, "--speeds"), along or (SPEED.name,)
    many, option = (_values(values, "--along"), "--along") if along else (row, "--speeds")
    if len(many) > _MOST_VALUES:
        faults.add(option, len(many), f"are more than {_MOST_VALUES} values", "take a larger step")
    if (along and not many) or along == []:
        faults.add("--along", along, "names no values", "for example --along pitch_hinge.stiffness 1:3:0.5")
    elif along and len(row) != 1:
        faults.add("--speeds", row, f"must be one speed: only {name} changes", "for example --speeds 8")
    if static.exists() and not static.is_dir():
        faults.add("--static", str(static), "is not a folder", "name a folder, which need not exist")
    faults.raise_if_any()
    species = [load_species(name) for name in names]
    if set_ is not None:
        species = [changed(one, set_) for one in species]
    tasks = [_Task(one, model, many or default_speeds(one)) for one in species for model in chosen]
    where = (name, row[0] if along else None)
    check_names([(one.name, model, name) for one, model, _ in tasks])
    for one, model, each in tasks:  # the last of them would else be refused after hours
        check_lattice(one, model, each, starts, seed, *where)
    make_folder(static)
    check_outputs(static / "index.html")
    with progress_bar("flights") as progress:
        written = write_explorer(static, _solved(tasks, where, starts, seed, progress, push))
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


class _Task(NamedTuple):
    species: Species
    model: str
    values: list[float]


def _values(texts: Sequence[str] | None, option: str) -> list[float]:
    return sorted({float(one) for text in texts or [] for one in parse_range(text, option)})


def _solved(
    tasks: list[_Task],
    where: tuple[str, float | None],
    starts: int | None,
    seed: int,
    progress: Any,
    push: bool,
) -> Iterator[dict[str, Any]]:
    """Yield the lattice of each animal and model, of each animal the first with pushes; progress counts flights."""
    done, total = 0, sum(len(task.values) for task in tasks)
    pushed = set[str]()
    for species, model, values in tasks:
        before = done

        def tell(count: int, _: int, before: int = before) -> None:
            progress(before + count, total)

        pushes = push and species.name not in pushed
        pushed.add(species.name)
        yield solve_lattice(species, model, values, starts, seed, tell if progress else None, pushes, *where)
        done += len(values)
