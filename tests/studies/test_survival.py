"""A study under hostile conditions, through the real program: nothing is lost, nothing is spoilt, all is told."""

import errno
import functools
import os
import random
import re
import resource
import signal
import sqlite3
import time

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.study_standin import BREAKS, CRASHES, HANGS, INFEASIBLE, LEAVES, RAISES
from tests.helpers.terminals import needs_terminal, on_terminal
from wingbeat.animal.species.writing import species_text
from wingbeat.studies.engine import LocalProcesses
from wingbeat.studies.store_checks import only_one

pytestmark = pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="looks for processes in /proc")
GRID = [1 + 0.25 * i for i in range(120)]


@pytest.fixture
def undisturbed(cheap):
    study = cheap(GRID, "undisturbed")
    code, out, err = study.run(study.file, "--processes", 1)
    assert code == 0, err
    assert "converged 120" in out
    return study.points()


def wait_for_points(study, count):
    """Wait until so many points are kept."""
    until = time.monotonic() + 300
    while len(study.points()) < count:
        assert time.monotonic() < until
        time.sleep(0.01)


@pytest.mark.slow
def test_killed_drivers_lose_nothing_and_repeat_nothing_that_was_kept(cheap, undisturbed, tmp_path):
    study, log = cheap(GRID), tmp_path / "log"
    draw = random.Random(0)
    kept = {}
    for _ in range(3):
        before = log.read_text().split() if log.exists() else []
        driver = study.start("run", study.file, "-j", 2, seconds=0.02, log=log)
        wait_for_points(study, len(kept) + draw.randrange(1, 20))
        driver.kill()
        driver.communicate()
        study.wait_gone()
        again = set(log.read_text().split()[len(before) :])
        assert not again & set(kept)
        kept = study.points()
    assert study.run("run", study.file, "-j", 2)[0] == 0
    assert study.points() == undisturbed


BY_LIBRARY = (
    "import sys; from wingbeat.studies.engine import LocalProcesses; "
    "LocalProcesses.work = 'tests.helpers.study_standin:solve'; "
    "import wingbeat as wb; wb.plan_study(sys.argv[1]).run(processes=1)"
)


def test_a_driver_killed_before_its_log_was_ever_emptied_leaves_a_sound_store(cheap):
    study = cheap(GRID)
    driver = study.start(study.file, program=BY_LIBRARY, seconds=0.02)
    wait_for_points(study, 3)
    driver.kill()
    driver.communicate()
    study.wait_gone()
    code, _, err = study.run("status", study.file)
    assert (code, err) == (0, "")


@pytest.mark.slow
def test_killed_workers_lose_nothing(cheap, undisturbed):
    study = cheap(GRID)
    driver = study.start("run", study.file, "-j", 2, seconds=0.02)
    for count in (1, 30, 60):
        wait_for_points(study, count)
        workers = [process for process in study.processes() if process != driver.pid]
        os.kill(workers[0], signal.SIGKILL)
    assert driver.wait(60) == 0
    driver.communicate()
    assert study.points() == undisturbed
    study.wait_gone()


@pytest.mark.slow
def test_a_point_that_crashes_hangs_or_raises_fails_alone_and_can_be_tried_again(cheap, monkeypatch):
    study = cheap([CRASHES, HANGS, RAISES, INFEASIBLE, LEAVES, BREAKS, *GRID[:20]])
    code, out, err = study.run("run", study.file, "-j", 2, "--timeout", 1)
    assert code == 3, err
    for line in ("converged 20", "infeasible 1", "error 1", "crashed 3", "timeout 1"):
        assert line in out
    assert "crashed: speed = 90: its process ended with SIGKILL" in out
    assert "crashed: speed = 95: its process ended with exit code 7" in out
    assert "crashed: speed = 96: its process raised TypeError: no outcome" in out
    assert "timeout: speed = 91: no result within 1 s" in out
    assert "error: speed = 92: ValueError: no such speed" in out
    assert "infeasible: speed = 93: too fast" in out
    assert "26 points" in err
    assert "Traceback" not in err
    kept = study.points()
    assert study.run("run", study.file, "--allow-failures")[0] == 0
    assert study.points() == kept
    # What failed is done again when asked for, and what the search found out is not.
    study.write([RAISES, INFEASIBLE, *GRID[:20]])
    monkeypatch.setenv("STANDIN_LOG", str(study.folder / "log"))
    assert study.run("run", study.file, "--retry-failed", "--allow-failures")[0] == 0
    assert len((study.folder / "log").read_text().split()) == 1
    assert "4 results of points that are no longer in the study are kept" in study.run("status", study.file)[1]
    study.wait_gone()


@pytest.mark.slow
@needs_terminal
def test_on_a_terminal_it_shows_how_far_it_is(cheap):
    study = cheap([RAISES, INFEASIBLE, *GRID[:20]])
    start = functools.partial(study.start, "run", study.file, "-j", 1, seconds=0.05)
    code, out, shown = on_terminal(start, columns=160)
    assert code == 3
    plain = re.sub(r"\x1b\[\d*m", "", shown)
    says = r"(\d+)/22 (\d+) converged, (\d+) infeasible, 0 not converged, (\d+) failed"
    frames = re.findall(says, plain)
    assert len(frames) > 3
    for done, *parts in np.array(frames, int):
        assert done == sum(parts)
    assert frames[-1] == ("22", "20", "1", "1")
    assert "\x1b[2K" in plain.rpartition("22/22")[2]  # it goes when all is done
    assert "/22" not in out
    assert "/22" not in study.run("run", study.file, "--allow-failures")[2]  # no terminal, no bar


@pytest.mark.slow
@pytest.mark.parametrize(("signals", "code"), [((2,), 130), ((2, 2), 130), ((15,), 143)])
def test_signals_stop_it_with_all_in_order(cheap, signals, code):
    study = cheap(GRID)
    driver = study.start("run", study.file, "-j", 1, seconds=0.05)
    wait_for_points(study, 3)
    for number in signals:
        driver.send_signal(number)
        time.sleep(0.05)
    out, err = driver.communicate(timeout=30)
    assert driver.returncode == code
    assert "Traceback" not in err
    assert ("stopping within a second" in err) == (signals[0] == 2)
    assert "waiting" in out
    study.wait_gone()
    assert sorted(path.name for path in study.folder.iterdir()) == ["cheap.study.sqlite", "cheap.toml"]
    assert 3 <= len(study.points()) < len(GRID)


def test_what_is_left_is_told_after_every_change(cheap):
    study = cheap([6, 7, RAISES])
    assert study.run("run", study.file, "-j", 1)[2].startswith("3 points, 3 to solve")
    for speeds, told in (([6, 8, RAISES], "3 points, 1 to solve"), ([6], "1 points, 0 to solve")):
        study.write(speeds)
        assert study.run("run", study.file, "-j", 1)[2].startswith(told)
    study.write([6, RAISES])
    assert study.run("run", study.file, "-j", 1, "--retry-failed")[2].startswith("2 points, 1 to solve")


def test_a_table_of_another_study_is_refused(cheap):
    study = cheap([6, 7])
    assert study.run()[0] == 0
    study.write([6])
    for words in (
        ("export", study.file, "-o", study.folder / "a.csv"),
        ("plot", study.file, "-o", study.folder / "a.png"),
    ):
        code, _, err = study.run(*words)
        assert code == 2
        assert "holds the points of another study, or of this one before it was changed; run the study first" in err
    assert "the study has changed since its last run" in study.run("status", study.file)[1]
    assert study.run()[0] == 0
    assert study.run("export", study.file, "-o", study.folder / "a.csv")[0] == 0


def test_columns_keep_their_order_whatever_the_first_point_says(cheap):
    study = cheap([6, RAISES])
    table = study.folder / "table.csv"
    headers = []
    for speeds in ([6, RAISES], [RAISES, 6]):
        study.write(speeds)
        study.run("run", study.file, "-j", 1, "--allow-failures")
        assert study.run("export", study.file, "-o", table)[0] == 0
        headers.append(next(line for line in table.read_text().splitlines() if not line.startswith("#")))
    assert headers[0] == headers[1]
    assert headers[0].startswith(
        "key,status,species,aero.coefficients,speed,mean_power,warnings,certificate,error,run_"
    )


def test_files_of_one_name_are_told_apart(cheap):
    study = cheap([6, 7])
    for name, mass in (("slim", 0.02), ("stout", 0.03)):
        text = species_text(wb.load_species("pigeon").with_values({"wing.mass": mass}))
        (study.folder / f"{name}.toml").write_text(text)
    form = study.file.read_text()
    study.file.write_text(form.replace('"pigeon"', '["slim.toml", "stout.toml"]'))
    assert study.run()[0] == 0
    frame = wb.plan_study(study.file).to_dataframe()
    assert list(frame["species"]) == ["pigeon"] * 4
    assert list(frame["species_given"]) == ["slim.toml"] * 2 + ["stout.toml"] * 2


def test_speeds_at_the_top_are_drawn_over(cheap):
    study = cheap([6, 7])
    study.file.write_text('species = "pigeon"\nspeed = [6.0, 7.0]\nstarts = 1\n')
    assert study.run()[0] == 0
    frame, varied, *_, units = wb.plan_study(study.file).drawing()
    assert (varied, units, list(frame["speed"])) == (["speed"], ["m/s"], [6.0, 7.0])


def test_a_second_driver_is_refused(cheap):
    study = cheap(GRID[:3])
    with only_one(study.store):
        code, out, err = study.run()
    assert (code, out) == (2, "")
    assert "another process is running the study" in err
    assert study.run()[0] == 0


@pytest.mark.slow
def test_a_full_disk_is_told_and_what_was_stored_stays(cheap, undisturbed):
    study = cheap(GRID)
    # What was planned fits, and a few answers do.
    limit = 200_000
    driver = study.start("run", study.file, "-j", 2, seconds=0.01)
    # Set from outside, while it still imports: to set it in the child would fork a process that runs JAX.
    resource.prlimit(driver.pid, resource.RLIMIT_FSIZE, (limit, limit))
    _, err = driver.communicate(timeout=60)
    assert driver.returncode == 2
    assert "stored results remain; free some disk space and run the study again" in err
    assert "Traceback" not in err
    study.wait_gone()
    some = study.points()
    assert some.items() <= undisturbed.items()
    assert study.run()[0] == 0
    assert study.points() == undisturbed


def test_a_folder_that_cannot_be_written_is_told(cheap, monkeypatch):
    study = cheap(GRID[:3])
    assert study.run()[0] == 0
    study.folder.chmod(0o555)
    study.store.chmod(0o444)
    if os.geteuid() == 0:  # whom permissions do not stop
        opened = os.open

        def refuse(path, flags, *more, **named):
            if flags & os.O_CREAT and os.path.dirname(path) == str(study.folder):
                raise PermissionError(errno.EACCES, "Permission denied", path)
            return opened(path, flags, *more, **named)

        monkeypatch.setattr("os.open", refuse)
    code, out, err = study.run("status", study.file)
    assert (code, "converged 3" in out) == (0, True), err
    code, _, err = study.run()
    study.folder.chmod(0o755)
    assert code == 2
    assert "cannot write in the folder of" in err
    assert "permission denied; copy the study to a folder that you can write to" in err


def test_a_store_whose_maker_was_killed_before_its_tables_is_made_anew(cheap):
    study = cheap(GRID[:3])
    connection = sqlite3.connect(study.store)
    connection.execute("PRAGMA journal_mode = WAL")
    connection.close()
    assert study.store.stat().st_size > 0
    assert "waiting 3" in study.run("status", study.file)[1]
    assert study.run()[0] == 0
    assert len(study.points()) == 3


def test_workers_that_cannot_start_are_told(cheap, monkeypatch):
    study = cheap(GRID[:3])
    monkeypatch.setattr(LocalProcesses, "work", "nowhere:solve")
    code, _, err = study.run()
    assert code == 2
    assert "no worker process can be started" in err
    assert study.points() == {}
