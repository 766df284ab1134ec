"""Moving pictures of flights: in a browser, in a notebook, or as an animated GIF.

>>> import tempfile, pathlib, wingbeat as wb
>>> pigeon = wb.load_species("pigeon")
>>> flight = wb.simulate(wb.FlightModel(pigeon.vehicle, "su-fan"), pigeon.wingbeat, wb.State(u=10.0), beats=1)
>>> with tempfile.TemporaryDirectory() as folder:
...     wb.viewer.write_page([("pigeon", flight.dataset)], pathlib.Path(folder) / "flight.html")
...     len(list(pathlib.Path(folder).iterdir()))
1
"""

from wingbeat.viewer.page import animate, bundle_path, write_page
from wingbeat.viewer.scene import Push, scene

__all__ = ["Push", "animate", "bundle_path", "scene", "write_page"]


def __dir__() -> list[str]:
    return sorted(__all__)
