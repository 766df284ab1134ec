"""Moving pictures of flights: in a browser, in a notebook, or as an animated GIF."""

from wingbeat.viewer.animation import animate
from wingbeat.viewer.page import bundle_path, write_page
from wingbeat.viewer.pushes import Push
from wingbeat.viewer.scene import scene

__all__ = ["Push", "animate", "bundle_path", "scene", "write_page"]


def __dir__() -> list[str]:
    return sorted(__all__)
