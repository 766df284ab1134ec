"""``wingbeat species``: the built-in animals or a file of your own, with the source of every number."""

from __future__ import annotations

import json as json_format
import math
import os
import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from cyclopts import App

from wingbeat._base import FaultList, FileError, InvalidInputError, write_atomically
from wingbeat.cli.arguments import flag, option, several
from wingbeat.cli.terminal import plain_console, print_json, print_report

if TYPE_CHECKING:
    from wingbeat.animal.species.species import Species

species = App(name="species", help="Show the built-in animals or your own species file.")

_SPEED = 10.0  # m/s, of the warning below the list
_PARTS = """\
# Parts of a robot. Their numbers are examples that fly a robot of 250 g, 0.8 m span and 0.1 m2 at 8 m/s, and are
# not derived from yours. To add a part, remove one "# " from the lines of its table and of its numbers, put in your
# own, and say in source where from; a number that is optional may stay out. `wingbeat uncertainty` counts a number
# as exact until you add its range = [lowest, highest]."""


@species.default
def show(
    name: Annotated[str | None, option("Name of a species, or path of a .toml file.")] = None,
    *,
    alternative: Annotated[
        str | None, option("Use this alternative: a named set of numbers in the species file, such as body-drag.")
    ] = None,
    model: Annotated[
        str, option("animal: with the tail, muscle, free parameters and bounds that this model adds.")
    ] = "paper",
    set_: Annotated[
        list[str] | None, several("Numbers to change, PATH=VALUE: wing.mass=0.02 air.density=1.0 ...", "--set")
    ] = None,
    altitude: Annotated[float | None, option("Height above sea level, which sets the air [m].")] = None,
    temperature: Annotated[float | None, option("Temperature of the air [deg C].")] = None,
    json: Annotated[bool, flag("Print JSON: SI units and radians.")] = False,
    schema: Annotated[bool, flag("Print the JSON schema of species files.")] = False,
) -> None:
    """List the built-in species; for a name or a file, show every number with its source."""
    if schema:
        from wingbeat.animal.species.file_schema import json_schema

        print(json_format.dumps(json_schema(), indent=2))
        return

    from wingbeat.animal.species.making import load_species
    from wingbeat.animal.species.reading import species_names

    faults = FaultList()
    if name is None:
        changes = {"--alternative": alternative, "--set": set_ or None, "--altitude": altitude}
        changes |= {"--temperature": temperature, "--model": None if model == "paper" else model}
        if given := [each for each, value in changes.items() if value is not None]:
            fix = f"wingbeat species pigeon {given[0]} ..."
            faults.add(given[0], "no species", "needs a species to change", fix)
        faults.raise_if_any()
        everyone = [load_species(each) for each in species_names()]
        print_json([_summary(each) for each in everyone]) if json else _print_list(everyone)
        return
    chosen = load_species(name)
    if alternative is not None:
        try:
            chosen = chosen.with_alternative(alternative)
        except InvalidInputError as error:
            faults.faults += error.faults
    if model != "paper":
        from wingbeat.models import model_of  # slow to import

        try:
            chosen = model_of(model, chosen).species(chosen)
        except InvalidInputError as error:
            faults.faults += error.faults
    if any(value is not None for value in (set_, altitude, temperature)):
        from wingbeat.cli.problem_options import changed  # slow to import

        try:
            chosen = changed(chosen, set_, altitude, temperature)
        except InvalidInputError as error:
            faults.faults += error.faults
    faults.raise_if_any()
    if json:
        print_json(chosen.as_dict())
    else:
        from wingbeat.animal.species.report import species_report

        print_report(species_report(chosen))


@species.command
def new(
    path: Annotated[Path, option("File to write, for example my.toml.")],
    *,
    kind: Annotated[
        Literal["bird", "bat", "robot"] | None,
        option("Derive the species by scaling laws from --mass, --wing-span and --wing-area."),
    ] = None,
    mass: Annotated[float | None, option("Mass of the whole animal [kg].")] = None,
    wing_span: Annotated[float | None, option("Wing span, tip to tip [m].")] = None,
    wing_area: Annotated[float | None, option("Area of both wings and the body between them [m2].")] = None,
    force: Annotated[bool, flag("Overwrite an existing file.")] = False,
) -> None:
    """Write a species file: a commented template, or a bird, bat or robot derived by scaling laws."""
    from wingbeat.animal.species.making import bat, bird, robot
    from wingbeat.animal.species.reading import robot_tables, template
    from wingbeat.animal.species.writing import species_text

    faults, size = FaultList(), {"mass": mass, "wing_span": wing_span, "wing_area": wing_area}
    if path.suffix != ".toml" and not path.is_dir():  # a folder is refused when it is written
        faults.add("PATH", str(path), "is not the name of a species file", "end it in .toml")
    for key, value in size.items():
        flagged = f"--{key.replace('_', '-')}"
        if kind is None and value is not None:
            rule = "needs the kind of animal, which sets the scaling laws"
            faults.add(flagged, value, rule, "add --kind bird, bat or robot")
        elif kind is not None and value is None:
            faults.add(flagged, None, "must be given", f"the scaling laws of a {kind} need mass, span and area")
    faults.raise_if_any()
    if kind is None:
        text = template()
    else:
        given: dict[str, Any] = size
        text = species_text({"bird": bird, "bat": bat, "robot": robot}[kind](name=path.stem, **given))
        if kind == "robot":
            text += f"\n{_PARTS}\n\n{robot_tables()}"
    if os.path.lexists(path) and not path.is_dir() and not force:
        raise FileError(f"cannot write {str(path)!r}: it exists; choose another name or give --force")
    write_atomically(path, text)
    print(f"wrote {path}; try: {shlex.join(['wingbeat', 'species', str(path)])}")


def _summary(animal: Species) -> dict[str, Any]:
    from wingbeat.aero import SuFan

    wing = animal.vehicle.wing
    reynolds = _SPEED * wing.mean_chord / animal.air.viscosity
    fitted = [number * animal.air.viscosity / wing.mean_chord for number in SuFan().reynolds_range or ()]
    named = {"name": animal.name, "common_name": animal.common_name, "kind": animal.kind}
    size = {"mass": animal.vehicle.mass, "semi_span": wing.semi_span, "chord": wing.mean_chord}
    stream = {"reynolds_at_10_m_per_s": reynolds if math.isfinite(reynolds) else None, "fitted_speeds": fitted}
    return named | size | stream


def _print_list(everyone: list[Species]) -> None:
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    # Numbers and the first column, which one types, stay whole; other words break at blanks.
    table.add_column("name", no_wrap=True, overflow="fold")
    table.add_column("animal", overflow="fold")
    for head in ("mass\n[g]", "wing\n[mm]", "chord\n[mm]", "su-fan\n[m/s]"):
        table.add_column(head, justify="right", no_wrap=True, overflow="fold")
    outside = []
    for animal in everyone:
        row = _summary(animal)
        lengths = [f"{1e3 * row[key]:.4g}" for key in ("mass", "semi_span", "chord")]
        low, high = row["fitted_speeds"]
        if not low <= _SPEED <= high:
            outside.append(animal.name)
        speeds = f"{low:.1f} to {high:.1f}"
        table.add_row(row["name"], row["common_name"], *lengths, speeds)
    console = plain_console()
    console.print(table)
    console.print(
        "wing: length of one wing, from shoulder to tip; chord: its mean; su-fan: speeds at which the chord's "
        "Reynolds number is that of the plate of Su et al., 20000 to 50000, whose coefficients, su-fan, are the "
        "default"
    )
    if outside:
        names = ", ".join(outside)
        line = f"warning: outside Su et al.'s Reynolds numbers (20000 to 50000) at {_SPEED:g} m/s: {names}"
        console.print(line, style="yellow")
    console.print(
        "wingbeat species NAME shows every number of a species; wingbeat species new FILE starts your own."
    )
