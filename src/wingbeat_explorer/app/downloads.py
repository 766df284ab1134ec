"""What a browser may fetch: each item has a name that nobody can guess; a session keeps its last few items."""

from __future__ import annotations

import secrets
from collections import OrderedDict
from typing import NamedTuple

DOWNLOADS = "/wingbeat/downloads/"  # the address, without the name
_MOST = 12


class Download(NamedTuple):
    """Bytes with their media type, and the file name under which a browser saves them, if it does."""

    content: bytes
    kind: str
    name: str = ""


class Downloads:
    """Keeps the last few downloads of each session."""

    def __init__(self) -> None:
        self._kept: dict[str, OrderedDict[str, Download]] = {}

    def put(self, session: str, download: Download) -> str:
        """Return the address at which a download can be fetched."""
        own = self._kept.setdefault(session, OrderedDict())
        name = secrets.token_urlsafe(16)
        own[name] = download
        while len(own) > _MOST:
            own.popitem(last=False)
        return DOWNLOADS + name

    def get(self, name: str) -> Download | None:
        """Return a download; None if it has been dropped."""
        return next((own[name] for own in self._kept.values() if name in own), None)

    def leave(self, session: str) -> None:
        """Drop all downloads of a session."""
        self._kept.pop(session, None)
