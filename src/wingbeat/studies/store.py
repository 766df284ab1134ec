"""The store of a study: one SQLite file that survives whatever happens to its writer."""

from __future__ import annotations

import json
import os
import sqlite3
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

from wingbeat._version import NUMERICAL_VERSION, __version__
from wingbeat.errors import FileError
from wingbeat.studies.plan import Plan
from wingbeat.studies.units import FAILED, Outcome, Task, Unit

__all__ = ["Row", "Store", "Waiting"]

# Stands in the file's head, where `file` and we tell a store from another database: "wbst".
_APPLICATION = 0x77627374
_FORM = 1
_TABLES = """
CREATE TABLE about (name TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE bases (hash TEXT PRIMARY KEY, inputs TEXT NOT NULL);
CREATE TABLE plan_bases (base INTEGER PRIMARY KEY, hash TEXT NOT NULL, told TEXT NOT NULL);
CREATE TABLE plan (ordinal INTEGER PRIMARY KEY, unit INTEGER NOT NULL, key TEXT NOT NULL UNIQUE,
    base INTEGER NOT NULL, changes TEXT NOT NULL, told TEXT NOT NULL);
CREATE INDEX plan_unit ON plan (unit);
CREATE TABLE points (key TEXT PRIMARY KEY, status TEXT NOT NULL, base TEXT NOT NULL, changes TEXT NOT NULL,
    record TEXT, certificate REAL, error TEXT NOT NULL, run_seconds REAL NOT NULL, run_finished REAL NOT NULL,
    run_worker TEXT NOT NULL, run_attempt INTEGER NOT NULL, run_number INTEGER NOT NULL);
CREATE INDEX points_status ON points (key, status, run_number);
"""
_FAILED = "(" + ", ".join(f"'{status}'" for status in FAILED) + ")"
_CHUNK = 500
_RESCUE = "nothing was deleted; restore a copy, or move it away and run the study again"


class Waiting(NamedTuple):
    """A unit that waits to be solved, and which of its points are asked for."""

    unit: Unit
    wanted: tuple[str, ...]


class Row(NamedTuple):
    """A point of the plan, its changes, and what is known of it; nothing of one that waits (status None)."""

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
    """A store, open for one driver, or for reading; use `open_store` and `read_store`."""

    def __init__(self, path: Path, connection: sqlite3.Connection) -> None:
        self.path = path
        self._connection = connection
        self._last = (-1, "")

    @classmethod
    @contextmanager
    def open(cls, path: Path) -> Iterator[Store]:
        """Open a store for its one writer, made if there is none.

        Raises
        ------
        FileError : it cannot be written, is damaged, is no store, or of another numerical version.
        """
        with _told(path), _closing(_connect(path, "mode=rwc")) as connection:
            fresh = _is_empty(connection)
            if not fresh:
                _check(connection, path)
            connection.execute("PRAGMA journal_mode = WAL")
            connection.execute("PRAGMA synchronous = FULL")
            if fresh:
                connection.executescript(f"BEGIN; PRAGMA application_id = {_APPLICATION}; {_TABLES}")
                about = {"form": _FORM, "numerical_version": NUMERICAL_VERSION, "made_by": __version__, "runs": 0}
                connection.executemany("INSERT INTO about VALUES (?, ?)", about.items())
                connection.execute("COMMIT")
            yield cls(path, connection)
            with suppress(sqlite3.OperationalError):  # a reader is at work: what stands in the log is as safe
                connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")

    @staticmethod
    def is_begun(path: Path) -> bool:
        """Say whether there is a store, or something else in its place; an empty database is as good as none."""
        if not path.is_file():
            return False
        with _told(path), _closing(_connect_reader(path)) as connection:
            return not _is_empty(connection)

    @classmethod
    @contextmanager
    def read(cls, path: Path) -> Iterator[Store]:
        """Open a store for reading, while a driver writes to it or not.

        Raises
        ------
        FileError : there is none, it cannot be read, is damaged, is no store, or of another numerical version.
        """
        if not cls.is_begun(path):
            raise FileError(f"there is no store {str(path)!r} yet; run the study first")
        with _told(path), _closing(_connect_reader(path)) as connection:
            _check(connection, path)
            yield cls(path, connection)

    def begin_run(self) -> int:
        """Count one more run, and return its number."""
        with _told(self.path), self._connection as connection:
            connection.execute("UPDATE about SET value = value + 1 WHERE name = 'runs'")
            return int(self._about("runs"))

    def _about(self, name: str) -> str:
        found = self._connection.execute("SELECT value FROM about WHERE name = ?", (name,)).fetchone()
        return "" if found is None else found[0]

    @property
    def digest(self) -> str:
        """The digest of the plan that the store holds."""
        with _told(self.path):
            return self._about("plan")

    def set_plan(self, plan: Plan) -> None:
        """Hold the points of a plan, in place of those of another; answers stay."""
        if self.digest == plan.digest:
            return
        with _told(self.path), self._connection as connection:
            connection.execute("BEGIN")
            for table in ("plan", "plan_bases"):
                connection.execute(f"DELETE FROM {table}")
            inputs = ((base.hash, json.dumps(base.recipe.inputs())) for base in plan.bases)
            connection.executemany("INSERT OR IGNORE INTO bases VALUES (?, ?)", inputs)
            told = ((i, base.hash, json.dumps(base.told)) for i, base in enumerate(plan.bases))
            connection.executemany("INSERT INTO plan_bases VALUES (?, ?, ?)", told)
            points = (
                (i, p.unit, p.key, p.base, json.dumps(p.changes), json.dumps(p.values))
                for i, p in enumerate(plan.points())
            )
            # Two ways to ask for the same point are one point.
            connection.executemany("INSERT OR IGNORE INTO plan VALUES (?, ?, ?, ?, ?, ?)", points)
            about = {"plan": plan.digest, "paths": json.dumps(plan.paths), "chained": int(plan.chain_length > 1)}
            connection.executemany("INSERT OR REPLACE INTO about VALUES (?, ?)", about.items())

    def save(self, outcomes: Iterable[Outcome], worker: str, attempt: int, run: int) -> None:
        """Keep outcomes of points of the plan, all or none of them; an answer is never written over.

        Raises
        ------
        FileError : the disk is full or gone.
        """
        rows = [(*o, time.time(), worker, attempt, run) for o in outcomes]
        with _told(self.path), self._connection as connection:
            connection.execute("BEGIN IMMEDIATE")
            connection.executemany(
                "INSERT INTO points SELECT ?1, ?2, plan_bases.hash, plan.changes, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10 "
                "FROM plan JOIN plan_bases USING (base) WHERE plan.key = ?1 "
                "ON CONFLICT (key) DO UPDATE SET (status, record, certificate, error, run_seconds, run_finished, "
                "run_worker, run_attempt, run_number) = (excluded.status, excluded.record, excluded.certificate, "
                "excluded.error, excluded.run_seconds, excluded.run_finished, excluded.run_worker, "
                f"excluded.run_attempt, excluded.run_number) WHERE points.status IN {_FAILED}",
                rows,
            )

    def waiting(self, retry_before: int = 0) -> Iterator[Waiting]:
        """Yield the units that hold points without an answer, in the order of the plan.

        Parameters
        ----------
        retry_before : points that failed in runs before this one are asked for again.
        """
        chained = self._about("chained") == "1"
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
            with _told(self.path):
                rows = self._connection.execute(
                    f"SELECT p.unit, p.key, p.changes, p.base, {missing} FROM plan p "
                    f"LEFT JOIN points q USING (key) WHERE {condition} ORDER BY p.ordinal {tail}",
                    (last, 20 if chained else _CHUNK),
                ).fetchall()
            if not rows:
                return
            for number, group in groupby(rows, key=lambda row: row[0]):
                found = list(group)
                wanted = [i for i, row in enumerate(found) if row[4]]
                # Of a chain, those after the last one wanted are not needed.
                tasks = tuple(Task(row[1], json.loads(row[2])) for row in found[: wanted[-1] + 1])
                yield Waiting(Unit(self._inputs(found[0][3]), tasks), tuple(found[i][1] for i in wanted))
                last = number

    def _inputs(self, base: int) -> str:
        """Return the inputs of a base as JSON; the text of the last one is kept for its neighbours."""
        if base != self._last[0]:
            question = "SELECT inputs FROM plan_bases JOIN bases USING (hash) WHERE base = ?"
            self._last = base, self._connection.execute(question, (base,)).fetchone()[0]
        return self._last[1]

    def counts(self) -> dict[str, int]:
        """Return how many points of the plan have which status; ``waiting`` are those without one."""
        with _told(self.path):
            return dict(
                self._connection.execute(
                    "SELECT COALESCE(q.status, 'waiting'), COUNT(*) FROM plan p LEFT JOIN points q USING (key) "
                    "GROUP BY 1"
                ).fetchall()
            )

    def answers(self) -> int:
        """Return how many answers there are, of points of the plan or of a study as it was before."""
        with _told(self.path):
            return self._connection.execute("SELECT COUNT(*) FROM points").fetchone()[0]

    def seconds(self) -> float | None:
        """Return the mean time of a point in this store [s], None if there is none."""
        with _told(self.path):
            question = (
                "SELECT AVG(run_seconds) FROM (SELECT run_seconds FROM points WHERE run_seconds > 0 LIMIT 1000)"
            )
            return self._connection.execute(question).fetchone()[0]

    def spent(self) -> float:
        """Return what the answers of the plan's points took, on one core [s]."""
        with _told(self.path):
            question = "SELECT TOTAL(q.run_seconds) FROM plan p JOIN points q USING (key)"
            return self._connection.execute(question).fetchone()[0]

    def uncertified(self, most: int) -> list[Row]:
        """Return the first points of the plan whose answer is no certified orbit, without their records."""
        return list(self._rows("NULL", f"WHERE q.status <> 'converged' ORDER BY p.ordinal LIMIT {int(most)}"))

    def rows(self) -> Iterator[Row]:
        """Yield every point of the plan, in its order."""
        return self._rows("q.record", "ORDER BY p.ordinal")

    def _rows(self, record: str, tail: str) -> Iterator[Row]:
        paths = json.loads(self._about("paths") or "[]")
        with _told(self.path):
            for key, base, changes, told, *rest in self._connection.execute(
                f"SELECT p.key, p.base, p.changes, p.told, q.status, {record}, q.certificate, q.error, "
                "q.run_seconds, q.run_finished, q.run_worker, q.run_attempt "
                f"FROM plan p LEFT JOIN points q USING (key) {tail}"
            ):
                yield Row(key, base, changes, dict(zip(paths, json.loads(told), strict=True)), *rest)

    @property
    def paths(self) -> tuple[str, ...]:
        """The varied parameters of the plan."""
        with _told(self.path):
            return tuple(json.loads(self._about("paths") or "[]"))

    def bases(self) -> list[tuple[dict[str, Any], dict[str, Any]]]:
        """Return of each base of the plan what tells it apart from the others, and its inputs."""
        with _told(self.path):
            found = self._connection.execute(
                "SELECT told, inputs FROM plan_bases JOIN bases USING (hash) ORDER BY base"
            )
            return [(json.loads(told), json.loads(inputs)) for told, inputs in found]


def _connect(path: Path, mode: str) -> sqlite3.Connection:
    """Open a database without waiting for others longer than a moment; transactions are begun by hand."""
    connection = sqlite3.connect(f"{path.absolute().as_uri()}?{mode}", uri=True, timeout=10.0, isolation_level=None)
    try:
        connection.execute("SELECT name FROM sqlite_master LIMIT 1").fetchall()
    except sqlite3.Error:
        connection.close()
        raise
    return connection


def _connect_reader(path: Path) -> sqlite3.Connection:
    """Open a database that may lie where nothing can be written, or be written to while it is read."""
    try:
        connection = _connect(path, "mode=rw")
    except sqlite3.OperationalError:
        # Without a log beside it nobody writes to it.
        logged = path.with_name(path.name + "-wal").exists()
        connection = _connect(path, "mode=ro" if logged else "mode=ro&immutable=1")
    connection.execute("PRAGMA query_only = 1")
    return connection


@contextmanager
def _closing(connection: sqlite3.Connection) -> Iterator[sqlite3.Connection]:
    try:
        yield connection
    finally:
        connection.close()


def _is_empty(connection: sqlite3.Connection) -> bool:
    """Say whether nothing stands in a database, as where a driver was killed before it had made its tables."""
    return connection.execute("SELECT name FROM sqlite_master LIMIT 1").fetchone() is None


def _check(connection: sqlite3.Connection, path: Path) -> None:
    """Refuse what is no store, what is cut short, and what other numbers stand in."""
    if connection.execute("PRAGMA application_id").fetchone()[0] != _APPLICATION:
        raise FileError(f"{str(path)!r} is a database, but no store of a study; move it away or rename the study")
    pages = connection.execute("PRAGMA page_count").fetchone()[0]
    size = pages * connection.execute("PRAGMA page_size").fetchone()[0]
    if size > os.path.getsize(path) and not path.with_name(path.name + "-wal").exists():
        raise FileError(f"the store {str(path)!r} is cut short; {_RESCUE}")
    about = dict(connection.execute("SELECT name, value FROM about"))
    if about.get("form") != str(_FORM) or about.get("numerical_version") != str(NUMERICAL_VERSION):
        theirs = f"{about.get('numerical_version')} (wingbeat {about.get('made_by')})"
        fix = "its answers do not mix with new ones: move it away, or go on with the wingbeat that made it"
        raise FileError(
            f"the store {str(path)!r} is of numerical version {theirs}, this wingbeat of {NUMERICAL_VERSION}; {fix}"
        )


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Turn what SQLite raises into words."""
    try:
        yield
    except sqlite3.Error as error:
        told = str(error)
        code = getattr(error, "sqlite_errorname", "")
        if "full" in told or code.startswith(("SQLITE_FULL", "SQLITE_IOERR")):
            fix = "what was stored stays; make room and run the study again"
            raise FileError(f"cannot write the store {str(path)!r}: {told}; {fix}") from None
        if code in ("SQLITE_READONLY", "SQLITE_CANTOPEN") or "readonly" in told:
            fix = "check the path, or copy the study to a folder that you can write to"
            raise FileError(f"cannot open the store {str(path)!r}: {told}; {fix}") from None
        if "locked" in told or "busy" in told:
            raise FileError(f"the store {str(path)!r} is in use by another program; close that") from None
        raise FileError(f"the store {str(path)!r} is damaged or no store ({told}); {_RESCUE}") from None
