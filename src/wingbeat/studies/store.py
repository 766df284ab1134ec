"""The store of a study: one SQLite file that stays intact whatever happens to the process that writes it.

`salvage` rebuilds a store that was damaged all the same, by a disk or by hand, from its intact results.
"""

from __future__ import annotations

import json
import os
import sqlite3
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import NUMERICAL_VERSION, FileError, __version__, system_reason
from wingbeat.studies.store_checks import (
    PLAN_TABLES,
    Lock,
    Watch,
    check_contents,
    check_files,
    digest_of,
    read_about,
)
from wingbeat.studies.store_file import (
    APPLICATION,
    FORM,
    MEAN_SECONDS,
    PAGE,
    POINT_COLUMNS,
    TABLES,
    DamagedStoreError,
    Fingerprint,
    about_digest,
    closing,
    connect,
    connect_reader,
    in_use,
    in_words,
    refusal,
    row_digest,
    unused_name,
    whole_answers,
)
from wingbeat.studies.units import FAILED, Outcome, Task, Unit, Waiting

if TYPE_CHECKING:
    from wingbeat.studies.plan import Plan
    from wingbeat.studies.recipe import Recipe

_FAILED = "(" + ", ".join(f"'{status}'" for status in FAILED) + ")"
_INSERT = f"INSERT OR REPLACE INTO points VALUES ({', '.join('?' * len(POINT_COLUMNS))})"
_CHUNK = 500


class Row(NamedTuple):
    """A point of the plan, its changes and its result; a waiting point has no result, and its status is None."""

    key: str
    base: int
    changes: str
    told: dict[str, Any]
    status: str | None
    record: str | None
    certificate: float | None
    error: str | None
    seconds: float | None
    finished: float | None
    worker: str | None
    attempt: int | None


class Store:
    """A store, open for one driver, or for reading; use `Store.open` and `Store.read`.

    The path is that of the file itself, not of a symbolic link to it, because its log is beside it.
    """

    def __init__(self, path: Path, connection: sqlite3.Connection, lock: Lock | None = None) -> None:
        self.path = path
        self._connection = connection
        self._about = read_about(connection)
        self._recipes: dict[str, Recipe] = {}
        self._last = ("", "")
        self._watch = Watch(path, connection, lock)
        self._run: str | None = None

    @classmethod
    @contextmanager
    def open(cls, path: Path, lock: Lock | None = None) -> Iterator[Store]:
        """Open a store for its only writer; create the store if there is none."""
        begun = cls.is_begun(path, mine=True)
        with in_words(path), closing(connect(path, "mode=rwc"), path) as connection:
            if begun:
                check_contents(connection, path)
            else:
                connection.execute(f"PRAGMA page_size = {PAGE}")
            connection.execute("PRAGMA journal_mode = WAL")
            connection.execute("PRAGMA synchronous = FULL")
            if not begun:
                connection.executescript(f"BEGIN; PRAGMA application_id = {APPLICATION}; {TABLES}")
            store = cls(path, connection, lock)
            if not begun:
                store._note(form=FORM, numerical_version=NUMERICAL_VERSION, made_by=__version__, runs=0)
                connection.execute("COMMIT")
                # Moved from the log to the file: a file whose head is still empty would look damaged beside a log
                # with results.
                connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
            yield store
            with suppress(sqlite3.OperationalError):  # a reader is at work: results in the log are equally safe
                connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")

    @staticmethod
    def is_begun(path: Path, mine: bool = False) -> bool:
        """Return whether there is a store, or another file in its place; an empty database does not count.

        `mine` says that this process holds the store's lock, so that no other process writes to the store.
        """
        if not path.is_file():
            return False
        check_files(path, mine)
        # If a driver was killed before it had made its tables, the file has only the page of the head.
        if path.stat().st_size > PAGE:
            return True
        with in_words(path), closing(connect_reader(path), path) as connection:
            return connection.execute("SELECT name FROM sqlite_master LIMIT 1").fetchone() is not None

    @classmethod
    @contextmanager
    def read(cls, path: Path) -> Iterator[Store]:
        """Open a store for reading; a driver may write to it at the same time."""
        if not cls.is_begun(path):
            raise FileError(f"there is no store {str(path)!r} yet; run the study first")
        with in_words(path), closing(connect_reader(path), path) as connection:
            check_contents(connection, path)
            with in_use(path):
                yield cls(path, connection)

    def _note(self, **about: Any) -> None:
        """Write the store's information about itself, with its digest, inside the caller's transaction."""
        noted = self._about | {name: str(value) for name, value in about.items()}
        noted["digest"] = about_digest(noted)
        changed = {name: value for name, value in noted.items() if self._about.get(name) != value}
        self._connection.executemany("INSERT OR REPLACE INTO about VALUES (?, ?)", changed.items())
        self._about = noted

    @contextmanager
    def _writing(self) -> Iterator[None]:
        """Make a block one transaction: either all its changes are kept, or none.

        It begins with what the store now says about itself. If two drivers write by some fault, both results stay.
        """
        before = self._about
        try:
            with in_words(self.path), self._connection:
                self._connection.execute("BEGIN IMMEDIATE")
                self._about = read_about(self._connection)
                yield
        except BaseException:
            self._about = before
            raise

    def begin_run(self) -> int:
        """Increase the count of runs, and return the new run's number."""
        with self._writing():
            run = int(self._about["runs"]) + 1
            self._note(runs=run)
        self._run = str(run)
        return run

    @property
    def digest(self) -> str:
        """The digest of the plan that the store holds."""
        return self._about.get("plan_digest", "")

    def set_plan(self, plan: Plan) -> None:
        """Store the points of a plan in place of the previous plan's points; results are kept."""
        self._recipes = {base.hash: base.recipe for base in plan.bases}
        if self.digest == plan.digest:
            return
        connection = self._connection
        with self._writing():
            for table in ("plan", "plan_bases"):
                connection.execute(f"DELETE FROM {table}")
            inputs = ((base.hash, json.dumps(base.recipe.described())) for base in plan.bases)
            connection.executemany("INSERT OR REPLACE INTO bases VALUES (?, ?)", inputs)
            told = ((i, base.hash, json.dumps(base.told)) for i, base in enumerate(plan.bases))
            connection.executemany("INSERT INTO plan_bases VALUES (?, ?, ?)", told)
            points = (
                (i, p.unit, p.key, p.base, json.dumps(p.changes), json.dumps(p.values))
                for i, p in enumerate(plan.points())
            )
            # Two ways to ask for the same point are one point.
            connection.executemany("INSERT OR IGNORE INTO plan VALUES (?, ?, ?, ?, ?, ?)", points)
            about = {"plan_digest": plan.digest, "paths": json.dumps(plan.paths)}
            tables = {table: digest_of(connection, table) for table in PLAN_TABLES}
            self._note(**about, **tables, chained=int(plan.chain_length > 1))

    def save(self, outcomes: Iterable[Outcome], worker: str, attempt: int, run: int) -> None:
        """Save outcomes of points of the plan, all or none of them; a result is never overwritten.

        If others have deleted or replaced the store, or run the study too, the outcomes are saved first if they
        can be.
        """
        question = (
            "SELECT b.hash, p.changes FROM plan p JOIN plan_bases b USING (base) LEFT JOIN points q USING (key) "
            f"WHERE p.key = ? AND (q.status IS NULL OR q.status IN {_FAILED})"
        )
        with self._writing():
            rows = []
            for o in outcomes:
                if (asked := self._connection.execute(question, (o.key,)).fetchone()) is not None:
                    told = (*asked, o.record, o.certificate, o.text, float(o.seconds), time.time())
                    rows.append((o.key, o.status, *told, worker, attempt, run))
            self._keep((*row, row_digest(row)) for row in rows)
        self._watch.check()
        if self._run not in (None, self._about["runs"]):
            again = "all results so far are in the store; let the other end, and run the study again"
            raise FileError(f"another process has begun to run the study of {str(self.path)!r}; {again}")

    def restore(self, rows: Iterable[tuple[Any, ...]]) -> None:
        """Write rows of the table ``points`` that were read from another store's pages."""
        with self._writing():
            held = list(rows)
            self._keep(held)
            self._note(runs=max(row[POINT_COLUMNS.index("run_number")] for row in held))

    def _keep(self, rows: Iterable[tuple[Any, ...]]) -> None:
        """Write rows in place of those with the same keys, inside the caller's transaction."""
        held = Fingerprint.of_text(self._about.get("points", ""))
        for row in rows:
            old = self._connection.execute("SELECT digest FROM points WHERE key = ?", row[:1]).fetchone()
            held = (held if old is None else held.remove(old[0])).add(row[-1])
            self._connection.execute(_INSERT, row)
        self._note(points=held)

    def waiting(self, retry_before: int = 0) -> Iterator[Waiting]:
        """Yield the units that contain points without a result, in the order of the plan that was set.

        Their recipes are the plan's and never the store's, because a recipe may hold a user's code. A point that
        failed in a run with a lower number than `retry_before` counts as missing.
        """
        chained = self._about.get("chained") == "1"
        missing = f"(q.status IS NULL OR (q.status IN {_FAILED} AND q.run_number < {int(retry_before)}))"
        last = -1
        while True:
            condition = (
                f"p.unit IN (SELECT DISTINCT p.unit FROM plan p LEFT JOIN points q USING (key) "
                f"WHERE p.unit > ? AND {missing} ORDER BY p.unit LIMIT ?)"
                if chained
                else f"p.unit > ? AND {missing}"
            )
            tail = "" if chained else "LIMIT ?"
            with in_words(self.path):
                rows = self._connection.execute(
                    f"SELECT p.unit, p.key, p.changes, b.hash, {missing} FROM plan p "
                    f"JOIN plan_bases b USING (base) LEFT JOIN points q USING (key) "
                    f"WHERE {condition} ORDER BY p.ordinal {tail}",
                    (last, 20 if chained else _CHUNK),
                ).fetchall()
            if not rows:
                return
            for number, group in groupby(rows, key=lambda row: row[0]):
                found = list(group)
                wanted = [i for i, row in enumerate(found) if row[4]]
                # In a chain, the points after the last wanted one are not needed.
                with in_use(self.path):
                    tasks = tuple(Task(row[1], dict(json.loads(row[2]))) for row in found[: wanted[-1] + 1])
                base = found[0][3]
                if base not in self._recipes:
                    raise refusal(self.path, "its points are not those of the study")
                if base != self._last[0]:  # the inputs as JSON, which the next units often share
                    self._last = base, json.dumps(self._recipes[base].inputs())
                yield Waiting(Unit(self._last[1], tasks), tuple(found[i][1] for i in wanted))
                last = number

    def counts(self) -> dict[str, int]:
        """Return the number of the plan's points for each status; points without a status count as ``waiting``."""
        question = (
            "SELECT COALESCE(q.status, 'waiting'), COUNT(*) FROM plan p LEFT JOIN points q USING (key) GROUP BY 1"
        )
        with in_words(self.path):
            return dict(self._connection.execute(question).fetchall())

    def answers(self) -> int:
        """Return the number of results, including those of points that are no longer in the study."""
        return self._number("SELECT COUNT(*) FROM points")

    def seconds(self) -> float | None:
        """Return the mean time of a point in this store [s], without first points; None if there is none."""
        return self._number(MEAN_SECONDS)

    def spent(self) -> float:
        """Return the computing time of the results of the plan's points, on one core [s]."""
        return self._number("SELECT TOTAL(q.run_seconds) FROM plan p JOIN points q USING (key)")

    def _number(self, question: str) -> Any:
        with in_words(self.path):
            return self._connection.execute(question).fetchone()[0]

    def uncertified(self, most: int) -> list[Row]:
        """Return the first points of the plan whose result is not a certified orbit, without their records."""
        return list(self._rows("NULL", f"WHERE q.status <> 'converged' ORDER BY p.ordinal LIMIT {int(most)}"))

    def rows(self) -> Iterator[Row]:
        """Yield every point of the plan, in its order."""
        return self._rows("q.record", "ORDER BY p.ordinal")

    def _rows(self, record: str, tail: str) -> Iterator[Row]:
        paths = json.loads(self._about.get("paths", "[]"))
        with in_words(self.path):
            for key, base, changes, told, *rest in self._connection.execute(
                f"SELECT p.key, p.base, p.changes, p.told, q.status, {record}, q.certificate, q.error, "
                "q.run_seconds, q.run_finished, q.run_worker, q.run_attempt "
                f"FROM plan p LEFT JOIN points q USING (key) {tail}"
            ):
                yield Row(key, base, changes, dict(zip(paths, json.loads(told), strict=True)), *rest)

    def bases(self) -> list[tuple[dict[str, Any], dict[str, Any]]]:
        """Return, for each base of the plan, the values that distinguish it from the others, and its inputs."""
        with in_words(self.path):
            question = "SELECT told, inputs FROM plan_bases JOIN bases USING (hash) ORDER BY base"
            found = self._connection.execute(question)
            return [(json.loads(told), json.loads(inputs)) for told, inputs in found]


# --- salvage ---

_ENDS = ("", "-wal")


class Salvaged(NamedTuple):
    """The outcome of a salvage: the number of results in the new store, and the new name of the damaged one."""

    kept: int
    aside: Path | None  # None if the store was not damaged


def salvage(path: Path, plan: Plan) -> Salvaged:
    """Replace a damaged store by a new one that holds every result whose digest matches.

    The caller must hold the store's lock. An undamaged store is not changed.
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
