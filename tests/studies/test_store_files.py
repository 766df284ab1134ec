"""A store under several names, and a store, log or lock that others delete or replace while a study runs."""

import errno
import fcntl
import os
import shutil
import sqlite3
import subprocess
import sys
import time
from contextlib import closing

import pytest

import wingbeat as wb
from wingbeat._base import FileError
from wingbeat.studies.store import Store
from wingbeat.studies.store_checks import only_one
from wingbeat.studies.units import Outcome

pytestmark = pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="looks for processes in /proc")
GRID = [1 + 0.25 * i for i in range(60)]


def wait_for_points(study, count):
    until = time.monotonic() + 100
    while len(study.points()) < count:
        assert time.monotonic() < until
        time.sleep(0.01)


@pytest.fixture
def running(cheap):
    """Return a study of 60 points and its driver, which has saved the first of them."""
    study = cheap(GRID)
    driver = study.start("run", study.file, "-j", 1, seconds=0.02)
    wait_for_points(study, 3)
    return study, driver


def ended(driver):
    """Return exit code and messages of a driver, blanks as one."""
    _, err = driver.communicate(timeout=60)
    assert "Traceback" not in err
    return driver.returncode, " ".join(err.split())


def statuses(study):
    code, out, err = study.run("status", study.file)
    assert code == 0, err
    return out


def linked(study, cheap, folder, make_link):
    """Return the same study in another folder, whose store is a link to the first one's."""
    other = cheap(GRID, folder)
    make_link(study.store, other.store)
    return other


def test_two_drivers_through_a_symbolic_link_are_one_too_many(running, cheap):
    study, driver = running
    other = linked(study, cheap, "elsewhere", lambda store, name: name.symlink_to(store))
    code, err = ended(other.start("run", other.file, "-j", 1))
    assert code == 2
    assert f"another process is running the study of {str(study.store)!r}" in err
    assert "60 points" in statuses(other)  # the first may have ended by now
    assert ended(driver)[0] == 0
    assert "converged 60" in statuses(other)
    # Salvage, too, works on the file and leaves the link.
    content = bytearray(study.store.read_bytes())
    content[content.index(b'"mean_power":') + 3] ^= 1
    study.store.write_bytes(content)
    code, out, err = other.run("salvage", other.file)
    assert (code, "59 results kept" in err, "waiting 1" in out) == (0, True, True), err
    assert other.store.is_symlink()
    assert sorted(path.name for path in other.folder.iterdir()) == [other.store.name, other.file.name]


def test_a_store_with_hard_links_is_read_but_not_written(cheap):
    study = cheap(GRID)
    assert study.run()[0] == 0
    other = linked(study, cheap, "elsewhere", lambda store, name: os.link(store, name))
    code, _, err = other.run()
    assert code == 2
    assert "has 2 names (hard links), which would damage it; copy the store to a new file" in err
    assert "converged 60" in statuses(other)
    other.store.unlink()
    assert study.run()[0] == 0


def test_a_deleted_lock_is_taken_again(running):
    study, driver = running
    lock = study.folder / f"{study.store.name}.lock"
    lock.unlink()
    wait_for_points(study, len(study.points()) + 20)
    code, _, err = study.run()
    assert (code, "another process is running the study" in err) == (2, True)
    assert ended(driver)[0] == 0
    assert not lock.exists()


def test_a_driver_whose_deleted_lock_another_has_taken_ends(running):
    study, driver = running
    lock = study.folder / f"{study.store.name}.lock"
    lock.unlink()
    with only_one(study.store):
        code, err = ended(driver)
        assert lock.exists()
    assert code == 2
    assert "was deleted while the study ran: another process is running the study" in err
    assert 3 <= len(study.points()) < 60
    assert study.run()[0] == 0
    assert "converged 60" in statuses(study)


@pytest.mark.slow
@pytest.mark.parametrize("how", ["deleted", "deleted with its log", "replaced"])
def test_results_of_a_lost_store_are_beside_it(running, how):
    study, driver = running
    wait_for_points(study, 8)
    if how == "replaced":
        spare = study.folder / "spare"
        shutil.copy(study.store, spare)
        os.replace(spare, study.store)
    else:
        study.store.unlink()
        for file in study.folder.glob("*.sqlite-*") if "log" in how else ():
            file.unlink()
    code, err = ended(driver)
    rescued = study.folder / f"{study.store.name}.rescued"
    assert code == 2
    assert f"was deleted, moved or replaced while the study ran; all results so far are in {str(rescued)!r}" in err
    study.wait_gone()
    for file in study.folder.glob("*.sqlite*"):
        if file != rescued:
            file.unlink()
    rescued.rename(study.store)
    assert len(study.points()) >= 8
    assert study.run()[0] == 0
    assert "converged 60" in statuses(study)


@pytest.mark.slow
def test_a_store_of_a_moved_folder_keeps_its_results(running, tmp_path):
    study, driver = running
    moved = tmp_path / "moved"
    study.folder.rename(moved)
    code, err = ended(driver)
    assert code == 2
    assert "if you moved it, it holds all results so far" in err
    study.folder, study.file, study.store = moved, moved / study.file.name, moved / study.store.name
    assert len(study.points()) > 3
    assert study.run()[0] == 0


@pytest.mark.slow
def test_a_deleted_log_costs_no_result(running):
    study, driver = running
    (study.folder / f"{study.store.name}-wal").unlink()
    code, err = ended(driver)
    assert code == 2
    assert "the log of the store" in err
    assert "was deleted while the study ran; all results so far are in the store" in err
    assert len(study.points()) >= 3
    assert study.run()[0] == 0
    assert "converged 60" in statuses(study)


def test_two_writers_without_a_lock_lose_nothing(cheap):
    study = cheap(GRID[:4])
    plan = wb.plan_study(study.file).plan
    one, two, three, _ = (Outcome(point.key, "converged", "{}", 0.0, "", 1.0) for point in plan.points())
    with Store.open(study.store) as first, Store.open(study.store) as second:
        first.set_plan(plan)
        run = first.begin_run()
        first.save([one], "first", 1, run)
        second.set_plan(plan)
        second.save([two], "second", 1, second.begin_run())
        with pytest.raises(FileError, match="another process has begun to run the study"):
            first.save([three], "first", 1, run)
    assert "converged 3 waiting 1" in statuses(study)


def test_a_look_at_a_study_leaves_the_locks_of_its_driver(cheap):
    """Without this, the other process deletes the log that the driver writes to, and with it the last result."""
    study = cheap(GRID[:2])
    planned = wb.plan_study(study.file)
    one, two = (Outcome(point.key, "converged", "{}", 0.0, "", 1.0) for point in planned.plan.points())
    look = f"import sqlite3; sqlite3.connect({str(study.store)!r}).execute('SELECT * FROM about').fetchall()"
    with Store.open(study.store) as store:
        store.set_plan(planned.plan)
        store.save([one], "here", 1, store.begin_run())
        assert planned.status().count("converged") == 1
        subprocess.run([sys.executable, "-c", look], check=True)
        store.save([two], "here", 1, 1)
        with closing(sqlite3.connect(study.store)) as other:
            assert other.execute("SELECT COUNT(*) FROM points").fetchone() == (2,)


def test_a_file_system_without_locks_is_named(cheap, monkeypatch):
    study = cheap(GRID[:2])

    def refuse(*given):
        raise OSError(errno.ENOLCK, "No locks available")

    monkeypatch.setattr(fcntl, "flock", refuse)
    code, _, err = study.run()
    assert code == 2
    assert "cannot lock the store" in err
    assert "no locks available; keep it on a local disk" in err


def test_a_study_stays_with_its_file_when_the_folder_changes(cheap, monkeypatch, tmp_path):
    study = cheap(GRID[:2])
    monkeypatch.chdir(study.folder)
    planned = wb.plan_study(study.file.name)
    monkeypatch.chdir(tmp_path)
    planned.prepare()
    assert study.store.exists()
