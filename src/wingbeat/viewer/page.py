"""One HTML file that shows flights: it opens from disk, contains all it needs, and makes no network request."""

from __future__ import annotations

import html
import json
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

from wingbeat._base import write_atomically
from wingbeat.viewer.pushes import Push
from wingbeat.viewer.scene import scene

if TYPE_CHECKING:
    import xarray as xr

# The policy forbids every request, so that what is shown stays on the reader's machine.
_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy"
  content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:">
<title>{title}</title>
<style>
  :root {{ color-scheme: light dark; }}
  body {{ margin: 0 auto; padding: 8px; max-width: 1400px; background: #eef1f4; font-family: sans-serif; }}
  h1 {{ font-size: 18px; margin: 4px 10px 8px; color: #1c2128; }}
  @media (prefers-color-scheme: dark) {{ body {{ background: #0c0f12; }} h1 {{ color: #e6e9ee; }} }}
</style>
</head>
<body>
<main>
<h1>{title}</h1>
<div><script type="application/json" data-wingbeat-scene>{scene}</script></div>
</main>
<script type="module">
{bundle}
</script>
</body>
</html>
"""


def bundle_path() -> Path:
    """Return the path of the viewer's JavaScript, an ES module with ``mount(element, scene, options)``.

    Without its last line, which exports, it is a classic script that sets ``globalThis.wingbeatViewer``.

    >>> bundle_path().name
    'viewer.js'
    """
    return Path(__file__).with_name("viewer.js")


def write_page(
    flights: Sequence[tuple[str, xr.Dataset]], path: str | PathLike[str], pushes: Sequence[Push] = ()
) -> None:
    """Write one flight, or two to compare, as a self-contained HTML file.

    Parameters
    ----------
    flights : a label and the dataset of an orbit or a simulated flight, for one flight or for two.
    path : of the file.
    pushes : flights through gusts that the reader can choose, from `fly_pushes`.

    Raises
    ------
    InvalidInputError : no flight or more than two, or one with more samples than a page can hold.
    FileError : a dataset that contains no flight, or a file that cannot be written.
    """
    # Escaped, so that no text of a file can close the HTML element that contains it.
    data = json.dumps(scene(flights, pushes), allow_nan=False).replace("<", "\\u003c")
    title = " and ".join(label for label, _ in flights)
    page = _PAGE.format(
        title=html.escape(f"wingbeat: {title}"), scene=data, bundle=bundle_path().read_text("utf-8")
    )
    write_atomically(path, page.encode())
