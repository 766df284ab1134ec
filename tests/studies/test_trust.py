"""A store is data: nothing that is written into it is run; code comes from the user's own file alone."""

import base64
import json
import os
import pickle
import shutil
import sqlite3
from contextlib import closing, suppress

import pytest

import wingbeat as wb
from tests.helpers.engines import Here
from wingbeat._base import WingbeatError
from wingbeat.cli import main
from wingbeat.studies import work
from wingbeat.studies.stopping import Stop
from wingbeat.studies.store_checks import PLAN_TABLES, digest_of
from wingbeat.studies.store_file import Fingerprint, about_digest, row_digest

MINE = "def least(beat):\n    return beat.mean(beat.drag.sum(axis=1))\n"
FORM = 'species = "pigeon"\nminimise = "mine.py:least"\nstarts = 1\nspeed = [9.0, 10.0]\n'


def unsolvable(*given):
    raise ValueError("not solved here")


@pytest.fixture
def study(tmp_path, monkeypatch):
    """Return a study of a user's function with one result and one point that waits."""
    monkeypatch.setattr(work, "find_with_known", unsolvable)
    (tmp_path / "mine.py").write_text(MINE)
    (tmp_path / "mine.toml").write_text(FORM)
    stop = Stop()
    study = wb.plan_study(tmp_path / "mine.toml")
    study.run_on(Here(), stop, progress=lambda tally: stop.ask(1))
    assert study.status().counts == {"error": 1, "waiting": 1}
    return study


class Payload:
    """Something whose unpickling writes a file."""

    def __init__(self, marker):
        self.marker = marker

    def __reduce__(self):
        return os.mkdir, (str(self.marker),)


def sign(connection):
    """Give everything in a store the digests that belong to it, as anybody with wingbeat can."""
    held = Fingerprint()
    for number, *row in connection.execute("SELECT rowid, * FROM points").fetchall():
        row[-1] = row_digest(row[:-1])
        connection.execute("UPDATE points SET digest = ? WHERE rowid = ?", (row[-1], number))
        held = held.add(row[-1])
    about = dict(connection.execute("SELECT name, value FROM about"))
    about |= {"points": str(held), **{table: digest_of(connection, table) for table in PLAN_TABLES}}
    about["digest"] = about_digest(about)
    connection.executemany("INSERT OR REPLACE INTO about VALUES (?, ?)", about.items())
    connection.commit()


def forge(store, table, column, value):
    """Write a value into a column of every row; a name or key that must be unique gets the row's number."""
    with closing(sqlite3.connect(store)) as connection:
        rows = [number for (number,) in connection.execute(f"SELECT rowid FROM {table}")]
        for number in rows:
            with suppress(sqlite3.IntegrityError):
                connection.execute(f"UPDATE {table} SET {column} = ? WHERE rowid = ?", (value, number))
        if column != "digest":
            sign(connection)
    return len(rows)


def use_everything(study, capsys):
    """Call every method and every command that opens a store; whatever they refuse, they refuse in words."""
    for method in (
        study.status,
        study.uncertified,
        study.to_dataframe,
        study.to_dataset,
        study.estimate,
        study.prepare,
        study.plot,
        study.summary,
        study.salvage,
        lambda: list(study.orbits()),
        lambda: study.run_on(Here(), Stop(), retry_failed=True),
    ):
        with suppress(WingbeatError):
            method()
    folder = study.store.parent
    for words in (("status",), ("export", "-o", folder / "a.nc"), ("plot", "-o", folder / "a.png"), ("salvage",)):
        assert main(["study", words[0], str(folder / "mine.toml"), *map(str, words[1:])]) in (0, 2)
        told = capsys.readouterr()
        assert "Traceback" not in told.err
        assert "\x1b" not in told.out + told.err


def columns(store):
    with closing(sqlite3.connect(store)) as connection:
        tables = [name for (name,) in connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")]
        return [
            (table, column)
            for table in tables
            for _, column, kind, *_ in connection.execute(f"PRAGMA table_info({table})")
            if kind in ("TEXT", "BLOB")
        ]


@pytest.mark.slow
def test_code_in_any_column_of_a_store_is_not_run(study, tmp_path, capsys):
    marker = tmp_path / "marker"
    code = f"import os; os.mkdir({str(marker)!r})\ndef least(beat): return 0.0 * beat.speed\n"
    whole = study.store.read_bytes()
    objective = {"name": "least", "file": "mine.py", "code": code}
    with closing(sqlite3.connect(study.store)) as connection:
        inputs = json.loads(connection.execute("SELECT inputs FROM bases").fetchone()[0])
    pickled = pickle.dumps(Payload(marker))
    places = columns(study.store)
    assert len(places) > 15
    forgeries = [(*place, value) for place in places for value in (code, "\x1b[2J" + code)]
    forgeries += [(table, column, pickled) for table, column in places if column in ("digest", "record", "inputs")]
    forgeries += [("bases", "inputs", json.dumps(inputs | {"objective": objective}))]
    forgeries += [("points", "record", base64.b64encode(pickled).decode())]
    for table, column, value in forgeries:
        assert forge(study.store, table, column, value)
        use_everything(study, capsys)
        assert not marker.exists(), (table, column)
        for file in tmp_path.glob("mine.study.sqlite*"):
            file.unlink()
        study.store.write_bytes(whole)


def test_a_store_names_its_function_by_a_digest(study):
    with closing(sqlite3.connect(study.store)) as connection:
        inputs = json.loads(connection.execute("SELECT inputs FROM bases").fetchone()[0])
    assert set(inputs["objective"]) == {"name", "file", "digest"}
    assert MINE.splitlines()[1].encode() not in study.store.read_bytes()


def test_a_changed_function_is_refused_in_words(study, tmp_path):
    (tmp_path / "mine.py").write_text(MINE.replace("drag", "lift"))
    changed = wb.plan_study(tmp_path / "mine.toml")
    with pytest.raises(wb.FileError, match=r"the objective mine\.py:least differs from the one that they"):
        changed.to_dataframe()
    with pytest.raises(wb.FileError, match="differs from the one"):
        next(changed.orbits())
    shutil.copy(study.store, tmp_path / "kept")
    changed.run_on(Here(), Stop())
    # The results of the earlier function are kept, and never taken for those of the new one.
    assert (changed.status().counts, changed.status().kept) == ({"error": 2}, 1)
