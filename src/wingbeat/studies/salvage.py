"""Rebuild a damaged store from its intact results."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from wingbeat._base import FileError, system_reason
from wingbeat.studies.database import DamagedStoreError, unused_name
from wingbeat.studies.pages import whole_answers
from wingbeat.studies.plan import Plan
from wingbeat.studies.store import Store

_ENDS = ("", "-wal")


class Salvaged(NamedTuple):
    """The outcome of a salvage: the number of results kept, and the new place of the damaged store.

    Parameters
    ----------
    kept : number of results in the new store.
    aside : the damaged file, unchanged except for its name; None if the store was not damaged.
    """

    kept: int
    aside: Path | None


def salvage(path: Path, plan: Plan) -> Salvaged:
    """Replace a damaged store by a new one that holds every result whose digest matches.

    The caller must hold the store's lock. An undamaged store is not changed.

    Parameters
    ----------
    path : of the store.
    plan : the plan whose points the new store gets.

    Raises
    ------
    FileError : there is no store, it has no intact result, or the folder cannot be written to.
    """
    if not path.is_file():
        raise FileError(f"there is no store {str(path)!r} to salvage; check the path, or run the study")
    try:
        with Store.open(path) as store:
            return Salvaged(store.answers(), None)
    except DamagedStoreError:
        rows = whole_answers(path)
        if not rows:
            raise
    fresh, aside = path.with_name(path.name + ".new"), unused_name(path, "damaged")
    try:
        _remove(fresh)
        with Store.open(fresh) as store:
            store.set_plan(plan)
            store.restore(rows.values())
        # A log left in its place would be taken for the new store's own.
        for end in reversed(_ENDS):
            with suppress(FileNotFoundError):
                os.rename(f"{path}{end}", f"{aside}{end}")
        _remove(path)  # what is left: the index of the log
        os.rename(fresh, path)
    except OSError as error:
        reason = system_reason(error)
        fix = "copy the study to a folder that you can write to"
        raise FileError(f"cannot write in the folder of {str(path)!r}: {reason}; {fix}") from None
    finally:
        with suppress(OSError):
            _remove(fresh)
    return Salvaged(len(rows), aside)


def _remove(path: Path) -> None:
    """Delete a database and the files that SQLite keeps beside it, if they exist."""
    for end in (*_ENDS, "-shm"):
        with suppress(FileNotFoundError):
            os.unlink(f"{path}{end}")
