"""The viewer as a widget for notebooks such as Jupyter and marimo; needs the extra `notebook`."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from wingbeat._base import install_extra

try:
    import anywidget
    import traitlets
except ModuleNotFoundError as error:
    raise ModuleNotFoundError(f"{error}; {install_extra('notebook')}", name=error.name) from None

from wingbeat.viewer.page import bundle_path
from wingbeat.viewer.scene import scene

if TYPE_CHECKING:
    import xarray as xr


class FlightWidget(anywidget.AnyWidget):
    """A notebook widget that shows one moving flight, or two to compare."""

    _esm = bundle_path().read_text("utf-8")
    scene = traitlets.Unicode().tag(sync=True)

    def __init__(self, flights: Sequence[tuple[str, xr.Dataset]], **options: Any) -> None:
        super().__init__(scene=json.dumps(scene(flights), allow_nan=False), **options)
