"""The explorer: what it shows of an orbit, and a folder of plain files that is an explorer without a server."""

from wingbeat.explorer.face import face_of

__all__ = ["face_of"]


def __dir__() -> list[str]:
    return sorted(__all__)
