"""Digests of the content of a study's store, so that no damaged value is taken for a result."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

# Columns of the table `points`, the digest of the others last.
POINT_COLUMNS = (
    *("key", "status", "base", "changes", "record", "certificate", "error", "run_seconds", "run_finished"),
    *("run_worker", "run_attempt", "run_number", "digest"),
)
_BYTES = 16


def _told(values: Iterable[Any]) -> bytes:
    """Return a row as bytes. Type and length precede each value, so that different rows give different bytes."""
    texts, heads = [], []
    for value in values:
        text = value if type(value) is str else repr(value)
        texts.append(text)
        heads.append(f"{type(value).__name__} {len(text)} ")
    return "".join((*heads, "\n", *texts)).encode()


def row_digest(values: Iterable[Any]) -> bytes:
    """Return the BLAKE2b digest of a row: of the value, type and length of each column.

    Parameters
    ----------
    values : as SQLite gives them: text, whole numbers, floats, bytes or None.

    >>> row_digest(["3f2a", 1.0]) == row_digest(["3f2a", 1])
    False
    """
    return hashlib.blake2b(_told(values), digest_size=_BYTES).digest()


def table_digest(rows: Iterable[Sequence[Any]]) -> str:
    """Return the digest of rows in their order, as hexadecimal text."""
    digest = hashlib.blake2b(digest_size=_BYTES)
    for row in rows:
        digest.update(_told(row))
    return digest.hexdigest()


def about_digest(about: Mapping[str, str]) -> str:
    """Return the digest of a store's information about itself, except this digest."""
    return table_digest(sorted((name, value) for name, value in about.items() if name != "digest"))


class Fingerprint(NamedTuple):
    """The number of rows and the XOR of their digests.

    It shows whether a row is lost or changed; the order of the rows does not matter.

    >>> a, b = row_digest(["a"]), row_digest(["b"])
    >>> Fingerprint().add(a).add(b).remove(a) == Fingerprint().add(b)
    True
    """

    rows: int = 0
    mixed: int = 0

    def add(self, digest: bytes) -> Fingerprint:
        """Return the fingerprint with one more row."""
        return Fingerprint(self.rows + 1, self.mixed ^ int.from_bytes(digest, "big"))

    def remove(self, digest: bytes) -> Fingerprint:
        """Return the fingerprint without a row."""
        return Fingerprint(self.rows - 1, self.mixed ^ int.from_bytes(digest, "big"))

    def __str__(self) -> str:
        return f"{self.rows} {self.mixed:032x}"

    @classmethod
    def of_text(cls, text: str) -> Fingerprint:
        """Return the fingerprint that a text holds; an empty text means no rows."""
        count, _, mixed = text.partition(" ")
        return cls(int(count), int(mixed, 16)) if text else cls()
