"""Pages of reference that are made from the program itself: commands, keys of files, and names of records.

They are written into ``docs/reference`` when the site is built, and are not kept.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

import wingbeat as wb
import wingbeat_evidence as evidence
from wingbeat._base import NOMENCLATURE, find, for_people, plain, write_atomically
from wingbeat.animal.species.numbers import COVERS, FREE, KEYS, LOOKS, PATH, PLAUSIBLE, SHAPE, Key
from wingbeat.cli.app import build_app
from wingbeat.studies.form import Sample, StudyForm, Vary
from wingbeat_evidence.measured_motion.reading import KNOWN_KEYS, REQUIRED_KEYS
from wingbeat_evidence.measured_motion.strip_checks import SCALAR_LIMITS

if TYPE_CHECKING:
    from sphinx.application import Sphinx

_SHAPES = {
    "number": "number",
    "stations": "number or list",
    "vector": "three numbers",
    "list": "list",
    "edge": "list, root to tip",
    "cover": " or ".join(f"`{cover}`" for cover in COVERS),
    "colour": "`#rrggbb`",
}


def _cell(text: object) -> str:
    return str(text).replace("|", "\\|").replace("\n", " ")


def table(head: tuple[str, ...], rows: Iterable[tuple[object, ...]]) -> str:
    """Return a table in Markdown."""
    lines = [head, tuple("---" for _ in head), *rows]
    return "\n".join("| " + " | ".join(_cell(cell) for cell in line) + " |" for line in lines) + "\n"


def commands() -> str:
    """Return every command with all its options, as ``--help`` says them."""
    made = build_app().generate_docs(output_format="markdown")
    start = made.index("## wingbeat orbit")
    # Each heading is the command itself; brackets with units are no links.
    text = re.sub(r"\*\[(default|choices): (.*?)\]\*", r"(\1: \2)", made[start:])
    text = re.sub(r"^(#+) wingbeat (.*)$", lambda m: f"{m[1]} {m[2]}", text, flags=re.MULTILINE)
    fences = text.replace("```console", "```text").split("```")
    text = "```".join(part if i % 2 else part.replace("[", "\\[") for i, part in enumerate(fences))
    intro = (
        "# Commands\n\nType `uv run` before each command in a clone. Exit codes: 0 success, 2 bad input, 3 no "
        "certified orbit. `wingbeat COMMAND --help` prints the same text.\n\n"
    )
    return intro + text


def _species_rows(keys: Iterable[Key]) -> list[tuple[object, ...]]:
    return [
        (f"`{key.path}`", _SHAPES[key.shape], key.unit, "yes" if key.required else "", key.meaning) for key in keys
    ]


def species_file() -> str:
    """Return every key of a species file."""
    head = ("key", "value", "unit", "required", "meaning")
    free = table(head, ((*row[:1], "(lower, upper)", *row[2:]) for row in _species_rows((*FREE, *PATH))))
    return f"""# Species file

A TOML file; `uv run wingbeat species new mine.toml --kind bird --mass 0.3` writes one. Values are in SI units and
radians. A key of an angle may end in `_deg`; its value is then in degrees. Give either `vehicle.mass` or
`vehicle.body.mass`. Numbers may stand alone, or as a table with `value`, `unit`, `source` and `range`, the lowest
and highest plausible value. Keys of a part, such as `vehicle.tail`, are required only if the part is there.
`uv run wingbeat species --schema` prints the JSON schema, with which editors check such files.

## Numbers of the animal

{table(head, _species_rows(KEYS))}
## Free parameters and limits along the path

Give `bounds`, and optionally `unit`, `reason` and `guessed`. If the last is true, a warning names the bound when an
orbit is at it.

{free}
## Plausible ranges

Give `low`, `high` or both, and optionally `unit`, `source` and `speeds`: the speeds at which the range applies
[m/s].

{table(head, ((*row[:1], "low, high", *row[2:]) for row in _species_rows(PLAUSIBLE)))}
## How it looks

Only drawings use the table `shape`: no orbit, sensitivity or error bar depends on it. Without it, drawings show a
schematic animal of the vehicle's size. The chord, the sum of both edges, has the mean 1, so that the drawn wing has
the area of the model's. A drawing is called schematic if a source begins with `guess`.

{table(head, _species_rows((*LOOKS, *SHAPE)))}
## Other keys

{
        table(
            ("key", "meaning"),
            [
                ("`name`", "short name; that of a built-in species is its file's"),
                ("`common_name`, `scientific_name`", "for the reader"),
                ("`kind`", "`bird`, `bat` or `robot`; selects the scaling laws"),
                ("`alternatives.NAME`", "other numbers for the same keys, with `reason`: why to try them"),
            ],
        )
    }"""


def _model_rows(model: type[BaseModel]) -> list[tuple[object, ...]]:
    rows = []
    for name, entry in model.model_fields.items():
        default = "required" if entry.is_required() else "" if entry.default is None else f"`{entry.default!r}`"
        rows.append((f"`{entry.alias or name}`", default, entry.description or ""))
    return rows


def study_file() -> str:
    """Return every key of a study."""
    head = ("key", "default", "meaning")
    return f"""# Study file

A TOML file, or the keywords of `wingbeat.plan_study`. A value may be given in place of a list of one. All
combinations of the lists are solved; `free`, `bounds`, `set` and one set of limits count as one value. The page
[studies](../guide/studies.md) explains how to use them.

{table(head, _model_rows(StudyForm))}
## Each entry of `vary`

Give exactly one.

{table(head, _model_rows(Vary))}
## `sample`

{table(head, _model_rows(Sample))}"""


def _meanings(of: type) -> dict[str, str]:
    """Return the parameters of a class by name, with their meanings from its docstring."""
    found: dict[str, str] = {}
    part = (of.__doc__ or "").split("Parameters\n")[1].split("\n\n")[0]
    for names, text in re.findall(r"^    (\w[\w, ]*) : (.*(?:\n        .*)*)", part, re.MULTILINE):
        found |= {name.strip(): " ".join(text.split()) for name in names.split(",")}
    return found


def case_file() -> str:
    """Return every key of a case of measured strips."""
    meaning = _meanings(evidence.StripCase) | {
        "strips": "name of the CSV file of strips, beside the case",
        "forces": "name of the CSV file of forces, beside the case",
        "from": "first time at which forces are compared [s]",
        "to": "last time at which forces are compared [s]",
    }

    def limits(name: str) -> str:
        if name not in SCALAR_LIMITS:
            return ""
        limit = SCALAR_LIMITS[name]
        return f"{limit.least:g} to {limit.most:g} {limit.unit}"

    rows = [
        (f"`{name}`", "yes" if name in REQUIRED_KEYS else "", limits(name), meaning[name]) for name in KNOWN_KEYS
    ]
    return f"""# Case of measured strips

A TOML file with the motion of strips and the measured forces beside it. Give exactly one of `forces` and
`mean_force`. `wingbeat.read_strip_case` lists the columns of the CSV files.

{table(("key", "required", "range", "meaning"), rows)}"""


def record() -> str:
    """Return every name of records, data sets and studies."""
    rows = []
    for name, term in NOMENCLATURE.items():
        factor, unit = for_people(term.unit) if term.unit else (1.0, "")
        shown = "" if not term.unit else plain(term.unit) + ("" if factor == 1.0 else f" (shown in {unit})")
        rows.append((f"`{name}`", term.symbol, shown, term.definition))
    orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1).record()
    named = [(f"`{path}`", _described(path)) for path in _paths(orbit)]
    return f"""# Records and their names

## The record of an orbit

`wingbeat orbit --json` prints it, `Orbit.record()` returns it, and NetCDF files hold it as attributes. Numbers are
in SI units and radians; an angle whose name ends in `_deg` is in degrees. A number that is not defined, such as the
Strouhal number in hover, is null.

{table(("name", "meaning"), named)}
## Every name, with unit and symbol

One table serves records, data sets, studies, figures and pages.

{table(("name", "symbol", "unit", "meaning"), rows)}"""


def _paths(record: dict[str, Any], before: str = "") -> Iterable[str]:
    for name, value in record.items():
        path = f"{before}.{name}" if before else name
        if isinstance(value, dict) and value:
            yield from _paths(value, path)
        else:
            yield path


def _described(path: str) -> str:
    if path == "constraints":
        return "limits of the problem by name, and the value that each limited quantity has"
    term = find(path)
    assert term is not None, path
    return f"{term.definition} [{plain(term.unit)}]" if term.unit else term.definition


def functions() -> str:
    """Return what computes the equations of the theory, from the pages of theory."""
    pages = sorted((Path(__file__).parents[1] / "theory").glob("*.md"))
    cited = "".join(page.read_text(encoding="utf-8") for page in pages)
    kinds = {"func": "autofunction", "meth": "automethod", "class": "autofunction", "attr": "autoproperty"}
    kind_of = {path: kind for kind, path in re.findall(r"\{py:(\w+)\}`(wingbeat[\w.]+)`", cited)}
    entries = [f".. {kinds[kind]}:: {path}\n" for path, kind in sorted(kind_of.items())]
    return (
        "# What computes the equations\n\nThese functions compute the equations of the "
        "[theory](../theory/index.md). They are not part of the interface, and may change.\n\n```{eval-rst}\n"
        + "\n".join(entries)
        + "```\n"
    )


PAGES = {
    "commands": commands,
    "species_file": species_file,
    "study_file": study_file,
    "case_file": case_file,
    "record": record,
    "functions": functions,
}


def write_pages(app: Sphinx) -> None:
    """Write all pages; a page that has not changed keeps its time, so that it is not built again."""
    for name, page in PAGES.items():
        path, text = Path(app.srcdir) / "reference" / f"{name}.md", page()
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            write_atomically(path, text)


def setup(app: Sphinx) -> dict[str, Any]:
    """Write the pages before Sphinx looks for them."""
    app.connect("builder-inited", write_pages, priority=100)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
