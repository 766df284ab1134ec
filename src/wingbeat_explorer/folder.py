"""The static explorer: a folder of plain files that opens from disk and makes no request to another host."""

from __future__ import annotations

import base64
import gzip
import json
import os
import re
from collections.abc import Iterable, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from wingbeat._base import FaultList, FileError, __version__, write_atomically
from wingbeat.viewer import bundle_path
from wingbeat_explorer.axis import SPEED
from wingbeat_explorer.models import EXPLORER_MODELS

# Only files of this folder may be loaded; `file:` is for browsers to which a file is not 'self'.
_PAGE = f"""<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'self' file:;
  style-src 'unsafe-inline'; img-src data: blob:; media-src blob:; base-uri 'none'; form-action 'none'">
<title>wingbeat explorer</title>
<style>
  :root {{ color-scheme: light dark; }}
  body {{ margin: 0; background: light-dark(#ffffff, #14181d); }}
  main {{ max-width: 1500px; margin: 0 auto; }}
  footer {{ max-width: 1500px; margin: 0 auto; padding: 0 24px 24px; font: 13px/1.5 system-ui, sans-serif;
    color: light-dark(#57606c, #a4adb8); }}
</style>
<script src="explorer.js" defer></script>
<script src="catalogue.js" defer></script>
</head>
<body>
<main><noscript>This page computes nothing on a server; it needs JavaScript to show the flights.</noscript></main>
<footer>Every dot is a wingbeat that wingbeat {__version__} computed; nothing between the dots is a result. No
number is fitted to a measured flight.</footer>
</body>
</html>
"""


def explorer_script() -> bytes:
    """Return the JavaScript of every explorer: the viewer's, as a classic script, and then the explorer's own.

    It sets ``globalThis.wingbeatViewer`` and ``globalThis.wingbeatExplorer``; a page that opens from disk can load
    it, because it is no module.
    """
    viewer, _, exported = bundle_path().read_text("utf-8").rstrip("\n").rpartition("\n")
    assert "export" in exported, "the viewer's last line makes a module of it"
    return f"{viewer}\n{Path(__file__).with_name('explorer.js').read_text('utf-8')}".encode()


def write_explorer(folder: str | PathLike[str], lattices: Iterable[dict[str, Any]]) -> list[Path]:
    """Write the static explorer, and return the paths of its files.

    The folder holds ``index.html``, ``explorer.js``, ``catalogue.js`` and a file in ``data`` for each lattice, with
    another one for its pushes, which the page reads when they are asked for. Each lattice is written as soon as it
    comes, so a generator keeps one at a time in memory. The page begins with the first one.

    Parameters
    ----------
    folder : made if it does not exist; files of the same names are replaced.
    lattices : from `solve_lattice`, at least one.

    Raises
    ------
    InvalidInputError : no lattice; two of the same species, model and axis; a species whose name cannot name
        a file.
    FileError : a file that cannot be written.
    """
    place = Path(folder)
    try:
        (place / "data").mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise FileError(f"cannot make the folder {os.fspath(place)!r}: {error.strerror}") from None
    written, titles, models, axes, start = [], {}, [], [], None
    for lattice in lattices:
        species, model, axis = lattice["species"], lattice["model"], lattice["axis"]
        check_names([(species, model, axis["name"])], [path.stem for path in written])
        name = file_name(species, model, axis["name"])
        parts = {name: {part: value for part, value in lattice.items() if part != "pushes"}}
        if pushes := lattice.get("pushes"):
            parts[f"{name}-pushes"] = pushes
        for stem, part in parts.items():
            written.append(place / "data" / f"{stem}.js")
            _call(written[-1], "holdPushes" if stem != name else "hold", name, _compressed(part))
        titles[species] = lattice["title"]
        models += [] if model in models else [model]
        axes += [] if axis in axes else [axis]
        start = start or {"animal": species, "model": model, "along": axis["name"], "at": lattice["first"]}
    faults = FaultList()
    if start is None:
        faults.add("lattices", 0, "there is nothing to show", "give at least one animal and one model")
    faults.raise_if_any()
    catalogue = {
        "animals": [{"name": name, "title": title} for name, title in titles.items()],
        "models": [{"name": name, "title": EXPLORER_MODELS[name].title} for name in models],
        "axes": axes,
        "files": [path.name for path in written],
        "start": start,
    }
    others = [place / name for name in ("index.html", "explorer.js", "catalogue.js")]
    write_atomically(others[0], _PAGE.encode())
    write_atomically(others[1], explorer_script())
    _call(others[2], "open", catalogue)
    return [*others, *written]


def file_name(species: str, model: str, along: str = SPEED.name) -> str:
    """Return the name of a lattice's file, without suffix; that of speeds does not say what changes.

    >>> file_name("bat", "paper"), file_name("robofalcon2", "animal", "pitch_hinge.stiffness")
    ('bat-paper', 'robofalcon2-animal-pitch_hinge.stiffness')
    """
    return "-".join([species, model, *([] if along == SPEED.name else [along])])


def check_names(flyers: Iterable[tuple[str, str, str]], known: Sequence[str] = ()) -> None:
    """Refuse species whose names cannot name a file, and flyers that come twice or whose files are `known`.

    A flyer is a species by a model, with the name of what changes.
    """
    faults, seen = FaultList(), set(known)
    for species, model, along in flyers:
        if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*", species):
            faults.add("species", species, "cannot name a file", "use letters, digits, - and _ in its name")
        elif (name := file_name(species, model, along)) in seen:
            rule = f"comes twice with the model {model} along the same number"
            faults.add("species", species, rule, "give each animal its own name")
        else:
            seen.add(name)
    faults.raise_if_any()


def _call(path: Path, function: str, *arguments: Any) -> None:
    """Write a script that calls a function of the explorer."""
    texts = ", ".join(json.dumps(one) for one in arguments)
    write_atomically(path, f"wingbeatExplorer.{function}({texts});\n".encode())


def _compressed(data: Any) -> str:
    """Return data as a text that browsers can decompress; half the size of its JSON."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return base64.b64encode(gzip.compress(text.encode(), 9, mtime=0)).decode()
