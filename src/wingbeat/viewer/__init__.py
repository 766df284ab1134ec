"""Flights in motion: in a browser, in a notebook, in an animated picture."""

from wingbeat.viewer.animation import animate
from wingbeat.viewer.page import bundle_path, write_page
from wingbeat.viewer.scene import scene

__all__ = ["animate", "bundle_path", "scene", "write_page"]


def __dir__() -> list[str]:
    return sorted(__all__)
