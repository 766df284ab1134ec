"""Damaged stores through the real program: a fault is harmless or refused in words, and whole answers are kept."""

import errno
import json
import random
import shutil
import sqlite3
import time
from contextlib import closing

import pytest
from flipped_bits import HARMLESS, REFUSED, STUDY, Sample, campaign

import wingbeat as wb
from tests.helpers.study_standin import RAISES
from wingbeat._base import NUMERICAL_VERSION
from wingbeat.studies import store, store_checks, store_file
from wingbeat.studies.store_checks import only_one
from wingbeat.studies.store_file import PAGE, about_digest, log_fault, whole_answers
from wingbeat.studies.units import Outcome

SPEEDS = [6 + 0.5 * i for i in range(12)]
GRID = [1 + 0.25 * i for i in range(40)]


@pytest.fixture(scope="module")
def sample(tmp_path_factory):
    """Return a study of 12 points with made-up records that are as long as real ones."""
    folder = tmp_path_factory.mktemp("whole")
    file = folder / "keys.toml"
    file.write_text(STUDY)
    known = {}
    for place, point in enumerate(wb.plan_study(file).plan.points()):
        status = "infeasible" if point.values[0] == 45.0 else "converged"
        record = {"status": status, "mean_power": 1.0 / (3 + place), "message": "certified. " * 200}
        text = "" if status == "converged" else "too fast"
        known[point.key] = Outcome(point.key, status, json.dumps(record), 1e-9, text, 0.25)
    return Sample(folder, known)


@pytest.mark.slow
@pytest.mark.parametrize(("end", "flips"), [("", 150), ("-wal", 30)])
def test_every_flipped_bit_is_harmless_or_refused_in_words(sample, tmp_path, end, flips):
    found = campaign(sample, sample.logged(tmp_path) if end else sample.store, 1, flips, end)
    assert not [one for one in found if one.verdict not in (HARMLESS, REFUSED)]
    refused = [one for one in found if one.verdict == REFUSED]
    assert len(refused) > flips / 4
    # A bit touches one answer, or none: all the others are kept.
    assert {one.again for one in refused} == {0, 1}


def damage(path, place, bit=1):
    content = bytearray(path.read_bytes())
    content[place] ^= bit
    path.write_bytes(content)


def table(study):
    out = study.folder / "table.csv"
    code, _, err = study.run("export", study.file, "-o", out)
    assert code == 0, err
    return [line.split(",run_")[0].rsplit(",", 4)[0] for line in out.read_text().splitlines()]


def test_a_damaged_answer_is_named_and_salvage_loses_nothing_else(cheap, monkeypatch):
    study = cheap([*SPEEDS, RAISES])
    assert study.run()[0] == 3
    before, whole = table(study), study.store.read_bytes()
    damage(study.store, whole.index(b'"mean_power":') + 3)
    damaged = study.store.read_bytes()
    key = next(iter(set(study.points()) - set(whole_answers(study.store))))
    for words in (
        ("status", study.file),
        ("run", study.file, "-j", 1),
        ("export", study.file, "-o", study.folder / "a.csv"),
        ("plot", study.file, "-o", study.folder / "a.png"),
    ):
        code, out, err = study.run(*words)
        assert (code, out) == (2, "")
        assert f"is damaged (1 of 13 results do not match their digests, key {key[:8]})" in err
        assert "run `wingbeat study salvage`, which keeps the 12 intact results" in err
    assert study.store.read_bytes() == damaged
    code, out, err = study.run("salvage", study.file)
    aside = study.folder / "cheap.study.sqlite.damaged"
    assert (code, err) == (0, f"12 results kept; the damaged store was renamed to {str(aside)!r}")
    assert "waiting 1" in out
    assert aside.read_bytes() == damaged
    monkeypatch.setenv("STANDIN_LOG", str(study.folder / "log"))
    assert study.run()[0] == 3
    assert (study.folder / "log").read_text().split() == [key]
    assert table(study) == before
    code, out, err = study.run("salvage", study.file)
    assert (code, "is not damaged; nothing was changed" in err) == (0, True)
    assert sorted(p.name for p in study.folder.glob("*.sqlite*")) == [study.store.name, aside.name]
    # What was put aside before stays.
    shutil.copy(aside, study.store)
    assert "damaged-2" in study.run("salvage", study.file)[2]
    assert aside.read_bytes() == damaged


@pytest.mark.parametrize(
    ("place", "words"),
    [
        (0, "file is not a database"),
        (18, "its header"),
        (16, "its header"),
        (68, "its header"),
        (100, "database disk image is malformed"),
    ],
)
def test_a_damaged_head_costs_no_answer(cheap, place, words):
    study = cheap(SPEEDS)
    assert study.run()[0] == 0
    before, kept = table(study), study.points()
    damage(study.store, place, 4)
    code, _, err = study.run("status", study.file)
    assert code == 2
    assert f"is damaged ({words})" in err
    assert "keeps the 12 intact results" in err
    assert study.run("salvage", study.file)[0] == 0
    assert table(study) == before
    assert study.points() == kept


def test_a_name_in_the_schema_that_is_no_longer_text_is_refused(cheap):
    study = cheap(SPEEDS)
    assert study.run()[0] == 0
    before = table(study)
    damage(study.store, study.store.read_bytes().index(b"sqlite_autoindex_") + 17, 0x80)
    code, _, err = study.run("status", study.file)
    assert code == 2
    assert "is damaged (its schema is not text)" in err
    assert study.run("salvage", study.file)[0] == 0
    assert table(study) == before


def test_a_lost_answer_is_missed(cheap):
    study = cheap(SPEEDS)
    assert study.run()[0] == 0
    with closing(sqlite3.connect(study.store)) as connection:
        connection.execute("DELETE FROM points WHERE rowid = 3")
        connection.commit()
    assert "is damaged (the 11 results in it are not the 12 that were written" in study.run("status", study.file)[2]


def test_a_damaged_log_of_a_killed_driver_is_not_cut_off_in_silence(cheap):
    study = cheap([float(u) for u in range(1, 60)])
    driver = study.start("run", study.file, "-j", 1, seconds=0.02)
    until = time.monotonic() + 60
    while len(study.points()) < 30:
        assert time.monotonic() < until
        time.sleep(0.01)
    driver.kill()
    driver.communicate()
    study.wait_gone()
    log = study.folder / "cheap.study.sqlite-wal"
    assert log_fault(study.store) is None
    kept = whole_answers(study.store)
    assert len(kept) >= 30
    damage(log, 32 + 24 + PAGE + 24 + 50)
    held = log.read_bytes()
    for words in (("status", study.file), ("run", study.file, "-j", 1)):
        code, _, err = study.run(*words)
        assert code == 2
        assert "is damaged (its log, from page 2 on)" in err
    assert log.read_bytes() == held
    assert study.run("salvage", study.file)[0] == 0
    assert len(study.points()) >= len(kept) - 1
    assert study.run()[0] == 0
    assert len(study.points()) == 59


def spoil(path, how):
    whole = path.read_bytes()
    if how == "cut short":
        path.write_bytes(whole[: len(whole) // 2])
    elif how == "no database":
        path.write_bytes(b"speed,power\n1,2\n" * 200)
    elif how == "overwritten":
        path.write_bytes(whole[:4096] + b"\xff" * (len(whole) - 4096))
    elif how == "foreign":
        path.unlink()
        connection = sqlite3.connect(path)
        connection.execute("CREATE TABLE birds (name TEXT)")
        connection.close()
    else:
        connection = sqlite3.connect(path)
        about = dict(connection.execute("SELECT name, value FROM about")) | {"numerical_version": "0"}
        about["digest"] = about_digest(about)
        connection.executemany("INSERT OR REPLACE INTO about VALUES (?, ?)", about.items())
        connection.commit()
        connection.close()


@pytest.mark.parametrize(
    ("how", "words"),
    [
        ("cut short", ("is damaged or not a store", "nothing was deleted; restore a copy")),
        ("no database", ("is damaged or not a store", "nothing was deleted")),
        ("overwritten", ("is damaged or not a store", "nothing was deleted")),
        ("foreign", ("is a database, but not a store of a study",)),
        ("other version", ("numerical version 0", f"of version {NUMERICAL_VERSION}; old", "move the store away")),
    ],
)
def test_a_store_that_is_none_is_refused_and_left_as_it_is(cheap, how, words):
    study = cheap(GRID)
    assert study.run()[0] == 0
    spoil(study.store, how)
    before = study.store.read_bytes()
    code, _, err = study.run()
    assert code == 2, err
    assert all(word in err for word in words), err
    assert "Traceback" not in err
    assert study.store.read_bytes() == before


def test_what_holds_no_answer_is_not_salvaged(cheap):
    study = cheap(SPEEDS)
    assert "there is no store" in study.run("salvage", study.file)[2]
    study.store.write_bytes(random.Random(0).randbytes(20_000))
    held = study.store.read_bytes()
    for words in (("run", study.file), ("salvage", study.file)):
        code, _, err = study.run(*words)
        assert (code, "no result can be read from it" in err) == (2, True)
    assert study.store.read_bytes() == held


def test_a_store_in_use_or_that_cannot_be_read_is_not_taken_for_damaged(cheap, monkeypatch):
    study = cheap(SPEEDS)
    assert study.run()[0] == 0
    held = study.store.read_bytes()
    with only_one(study.store):
        assert "another process is running the study" in study.run("salvage", study.file)[2]
    opened = open

    def refuse(path, *more, **named):  # permissions do not stop everybody
        if path == study.store:
            raise PermissionError(errno.EACCES, "Permission denied", str(path))
        return opened(path, *more, **named)

    monkeypatch.setattr("builtins.open", refuse)
    for what in ("status", "salvage"):
        code, _, err = study.run(what, study.file)
        assert code == 2
        assert "permission denied; check its permissions" in err
    monkeypatch.undo()
    assert study.store.read_bytes() == held
    assert sorted(path.name for path in study.folder.iterdir()) == ["cheap.study.sqlite", "cheap.toml"]


def test_a_store_without_digests_is_refused_with_the_cure(cheap, monkeypatch):
    study = cheap(SPEEDS)
    # As the release before made them.
    columns = store_file.TABLES.replace(", digest BLOB NOT NULL", "")
    with closing(sqlite3.connect(study.store)) as connection:
        connection.executescript(f"PRAGMA application_id = {store_file.APPLICATION}; {columns}")
        about = {"form": 1, "numerical_version": 5, "made_by": "0.9.0", "runs": 1}
        connection.executemany("INSERT INTO about VALUES (?, ?)", about.items())
        connection.commit()
    for words in (("run", study.file), ("status", study.file), ("salvage", study.file)):
        code, _, err = study.run(*words)
        assert code == 2
        assert "is of numerical version 5 (wingbeat 0.9.0) and has no digests, so damage would not show" in err
        assert "move it away and run the study again" in err


def test_a_store_is_checked_once_in_a_process_and_again_when_it_has_changed(cheap, monkeypatch):
    study = cheap(SPEEDS)
    assert study.run()[0] == 0
    checked = []
    structure = store_checks._check_structure
    monkeypatch.setattr(store_checks, "_check_structure", lambda held: checked.append(held) or structure(held))
    for _ in range(3):
        assert study.run("status", study.file)[0] == 0
    assert len(checked) <= 1
    damage(study.store, study.store.read_bytes().index(b'"mean_power":') + 3)
    assert study.run("status", study.file)[0] == 2


def test_an_answer_that_failed_and_was_found_later_counts_as_found(cheap, monkeypatch):
    study = cheap([*SPEEDS, RAISES])
    assert study.run()[0] == 3
    with closing(sqlite3.connect(study.store)) as connection:
        (failed,) = connection.execute("SELECT key FROM points WHERE status = 'error'").fetchone()
    with store.Store.open(study.store) as opened:
        opened.save([Outcome(failed, "converged", "{}", 0.0, "", 1)], "nobody", 1, 2)
    assert study.points()[failed][0] == "converged"
    assert "converged 13" in study.run("status", study.file)[1]
    row = whole_answers(study.store)[failed]
    # SQLite keeps these floats as whole numbers.
    assert row[1:2] + row[4:8] == ("converged", "{}", 0.0, "", 1.0)
