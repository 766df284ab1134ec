"""What a study tells about its progress: the time left comes from points solved, and Ctrl-C says what waits."""

import os
import signal
import time

import pytest

import wingbeat as wb
from tests.helpers.study_standin import HANGS
from wingbeat.cli import terminal
from wingbeat.cli.terminal import study_bar
from wingbeat.studies.driver import Tally
from wingbeat.studies.engine import LocalProcesses
from wingbeat.studies.units import Outcome


def outcomes(count):
    return [Outcome(str(i), "converged", "{}", 0.0, "", 0.01) for i in range(count)]


def test_the_time_left_comes_from_the_points_after_the_first_ones(monkeypatch):
    """The first point took a minute, of which programs took nearly all; each further one takes two seconds."""
    now = [100.0]
    monkeypatch.setattr("wingbeat.studies.driver.time.monotonic", lambda: now[0])
    tally = Tally(11, {"waiting": 11})
    assert tally.seconds_left is None
    for seconds, left in ((60.0, None), (2.0, 18.0), (2.0, 16.0)):
        now[0] += seconds
        tally.add(outcomes(1))
        assert tally.seconds_left == (None if left is None else pytest.approx(left))


def test_an_estimate_needs_more_than_first_points(cheap):
    def estimate(study):
        return wb.plan_study(study.file).estimate()

    study = cheap([6, 7])
    assert estimate(study) is None
    assert "2 points, 2 to solve with 1 process; the first point takes longest" in study.run()[2]
    assert estimate(study) == 0.0
    study.write([6, 7, 8, 9, 10])
    assert estimate(study) == pytest.approx(5 * 0.01)  # the stand-in's point that was not the first
    assert study.run("run", study.file, "-j", 1)[2].startswith("5 points, 3 to solve: about 0 s with 1 process")


def test_outside_a_terminal_a_study_says_how_far_it_is(monkeypatch):
    said = []
    monkeypatch.setattr(terminal, "FIRST_LINE", 0.02)
    monkeypatch.setattr(terminal, "say", said.append)
    tally = Tally(10, {"waiting": 10})

    def wait_for(words):
        until = time.monotonic() + 30
        while not any(words in line for line in said):
            assert time.monotonic() < until, said
            update(tally)
            time.sleep(0.005)

    with study_bar() as update:
        wait_for("points: 0 of 10 done after 0 s; the first point takes longest")
        tally.add(outcomes(1))
        tally.add(outcomes(1))
        wait_for("points: 2 of 10 done after 0 s; about 0 s left")


@pytest.mark.slow
def test_an_interrupt_before_the_first_point_says_what_waits_and_how_to_resume(cheap):
    study = cheap([HANGS, 6, 7], name="a folder")
    driver = study.start("run", study.file, "-j", 1)
    until = time.monotonic() + 60
    while not study.processes() and time.monotonic() < until:
        time.sleep(0.02)
    os.kill(driver.pid, signal.SIGINT)
    out, err = (text.decode() if isinstance(text, bytes) else text for text in driver.communicate())
    assert driver.returncode == 130, err
    assert "no point was solved" in err
    assert "nothing left" not in err
    last = err.splitlines()[-1]
    assert last == f"3 of 3 points wait; to resume: wingbeat study run '{study.file}'"
    assert f"3 points in {study.store}" in out
    assert "waiting" in out
    study.wait_gone()


def test_in_python_the_interrupt_says_it_too(cheap, monkeypatch):
    study = wb.plan_study(cheap([HANGS, 6]).file)
    submit = LocalProcesses.submit

    def interrupted(self, *batch):
        submit(self, *batch)
        os.kill(os.getpid(), signal.SIGINT)
        os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setattr(LocalProcesses, "submit", interrupted)
    with pytest.raises(KeyboardInterrupt, match=r"2 of 2 points wait in '.*'; run the study again to resume"):
        study.run(processes=1)
