"""Files that show moving flights: an HTML page, and one beat as an animated GIF for slides.

The page opens from disk, contains all it needs, and makes no network request.
"""

from __future__ import annotations

import html
import json
import math
from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import write_atomically, writing
from wingbeat._base.datasets import flown
from wingbeat._base.style import GREEN, drawing
from wingbeat.animal.vehicle import Body
from wingbeat.viewer.scene import Push, body_axes, scene, tail_of

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


_FRAMES = 48
_SECONDS = 2.4  # of one beat as it is shown
_MOST_ALPHA = 60.0  # deg; the ends of the colours


def animate(
    flights: Sequence[tuple[str, xr.Dataset]],
    path: str | PathLike[str],
    progress: Callable[[int, int], None] | None = None,
) -> None:
    """Write the first beat of one flight, or of two side by side, as an animated GIF that repeats.

    Strips are coloured by their effective angle of attack. Arrows show the air loads of the strips, with the same
    scale for both flights.

    Parameters
    ----------
    flights : a label and the dataset of an orbit or a simulated flight, for one flight or for two.
    path : of the file.
    progress : called with (frames done, frames in all).

    Raises
    ------
    InvalidInputError : no flight or more than two, or one with more samples than the viewer shows.
    FileError : a dataset that contains no flight, or a file that cannot be written.
    """
    shown = scene(flights)["flights"]
    flights = [(label, data.isel(phase=flown(data))) for label, data in flights]
    from matplotlib import cm
    from matplotlib.animation import PillowWriter
    from matplotlib.figure import Figure

    with drawing(font=9.0), writing(path) as beside:
        figure = Figure(figsize=(4.6 * len(flights) + 0.9, 3.6), dpi=110, layout="constrained")
        axes: Any = figure.subplots(1, len(flights), subplot_kw={"projection": "3d"}, squeeze=False)[0]
        load = max(float(np.linalg.norm(data["strip_force"].values, axis=-1).max()) for _, data in flights)
        span = max(flight["semi_span"] for flight in shown)
        panels = [
            _Panel(panel, data, f"{flight['label']}\n{flight['summary']}", span, load)
            for panel, (_, data), flight in zip(axes, flights, shown, strict=True)
        ]
        scale = cm.ScalarMappable(panels[0].norm, panels[0].colours)
        bar = figure.colorbar(scale, ax=list(axes), shrink=0.7, pad=0.02, aspect=18)
        bar.set_label("effective angle of attack [deg]")
        figure.draw_without_rendering()
        figure.set_layout_engine("none")  # else every frame is laid out anew
        writer = PillowWriter(fps=round(_FRAMES / _SECONDS))
        with writer.saving(figure, beside, dpi=110):
            for frame in range(_FRAMES):
                for panel in panels:
                    panel.draw(frame / _FRAMES)
                writer.grab_frame()
                if progress:
                    progress(frame + 1, _FRAMES)


class _Panel:
    """One flight in 3D axes, seen from ahead, left and above: body, strips, air loads, and the wing tips' paths."""

    def __init__(self, axes: Any, dataset: xr.Dataset, title: str, span: float, load: float) -> None:
        from matplotlib import colormaps
        from matplotlib.colors import Normalize
        from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

        self.axes = axes
        beat = dataset["phase"].values <= 1.0 + 1e-12
        self.phase, self.alpha = dataset["phase"].values[beat], np.degrees(dataset["alpha"].values[beat])
        place = np.stack([dataset["x"].values, np.zeros(len(beat)), dataset["z"].values], axis=-1)[beat]
        self.pitch = dataset["body_pitch"].values[beat]
        self.corners = dataset["strip_corner"].values[beat] - place[:, None, None]
        self.roots = dataset["strip_position"].values[beat] - place[:, None]
        self.forces = dataset["strip_force"].values[beat] * (0.6 * span / load if load > 0 else 0.0)
        self.colours, self.norm = colormaps["RdBu_r"], Normalize(-_MOST_ALPHA, _MOST_ALPHA)
        # Body and wings are one collection: matplotlib sorts faces by depth only within a collection.
        self.faces = Poly3DCollection([], linewidth=0.4)
        self.loads = Line3DCollection([], colors=GREEN, linewidths=1.3)
        body = json.loads(dataset.attrs["vehicle"])["body"]
        self.body = _ellipsoid(*body_axes(Body(**body)))
        self.tail = tail_of(dataset)
        axes.add_collection3d(self.faces, autolim=False)
        axes.add_collection3d(self.loads, autolim=False)
        tip = self.roots[:, -1]
        for side in (1.0, -1.0):
            axes.plot(tip[:, 0], side * tip[:, 1], tip[:, 2], color="0.55", linewidth=0.7)
        axes.set(xlim=(-0.75 * span, 0.75 * span), ylim=(-span, span), zlim=(-0.8 * span, 0.8 * span))
        axes.set_box_aspect((1.5, 2.0, 1.6), zoom=1.5)
        axes.view_init(elev=18, azim=48)
        axes.set_axis_off()
        axes.set_title(title, fontsize=9)
        self.text = axes.text2D(0.02, 0.02, "", transform=axes.transAxes)

    def draw(self, phase: float) -> None:
        """Draw the flight at a phase of the beat."""
        k = int(np.argmin(np.abs(self.phase - phase)))
        mirror = np.array([1.0, -1.0, 1.0])
        nose, up = math.cos(self.pitch[k]), math.sin(self.pitch[k])
        turn = np.array([[nose, 0.0, -up], [0.0, 1.0, 0.0], [up, 0.0, nose]])
        trunk = self.body @ turn.T
        # Faces that point up are lighter, so that the body looks round.
        height = trunk.mean(axis=1)[:, 2] / np.abs(trunk[..., 2]).max()
        grey = np.repeat((0.62 + 0.22 * height)[:, None], 3, axis=1)
        wing = self.colours(self.norm(self.alpha[k]))[:, :3]
        tail = [] if self.tail is None else [self.tail @ turn.T]
        self.faces.set_verts([*self.corners[k], *(self.corners[k] * mirror), *trunk, *tail])
        self.faces.set_facecolor(np.concatenate([wing, wing, grey, np.full((len(tail), 3), 0.75)]))
        self.faces.set_edgecolor(
            np.concatenate([np.full((2 * len(wing), 3), 0.25), grey, np.full((len(tail), 3), 0.25)])
        )
        ends = np.stack([self.roots[k], self.roots[k] + self.forces[k]], axis=1)
        self.loads.set_segments(list(np.concatenate([ends, ends * mirror])))
        self.text.set_text(f"phase {self.phase[k]:.2f} of the beat")


def _ellipsoid(half_length: float, half_width: float) -> np.ndarray:
    """Return the faces of an ellipsoid of revolution about the first axis, shape (faces, 4, 3) [m]."""
    along, around = np.meshgrid(np.linspace(0, np.pi, 13), np.linspace(0, 2 * np.pi, 17), indexing="ij")
    ring = half_width * np.sin(along)
    points = np.stack([half_length * np.cos(along), ring * np.cos(around), ring * np.sin(around)], axis=-1)
    faces = np.stack([points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:]], axis=2)
    return faces.reshape(-1, 4, 3)
