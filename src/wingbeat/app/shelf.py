"""Things that a browser may fetch: each under a name nobody can guess, few at a time for each session."""

from __future__ import annotations

import secrets
from collections import OrderedDict
from typing import NamedTuple

__all__ = ["Shelf", "Thing"]

_MOST = 12


class Thing(NamedTuple):
    """Bytes with their kind, and the name to save them under if they are a download."""

    content: bytes
    kind: str
    name: str = ""


class Shelf:
    """Keeps the last few things of each session."""

    def __init__(self) -> None:
        self._things: dict[str, OrderedDict[str, Thing]] = {}

    def put(self, session: str, thing: Thing) -> str:
        """Return the name under which a thing can be fetched."""
        own = self._things.setdefault(session, OrderedDict())
        name = secrets.token_urlsafe(16)
        own[name] = thing
        while len(own) > _MOST:
            own.popitem(last=False)
        return name

    def get(self, name: str) -> Thing | None:
        """Return a thing, None if it is there no more."""
        return next((own[name] for own in self._things.values() if name in own), None)

    def leave(self, session: str) -> None:
        """Forget what a session had."""
        self._things.pop(session, None)
