"""Progress outside a terminal: nothing for short work, a few plain lines on stderr for long work."""

import threading

import pytest

from wingbeat.cli import terminal
from wingbeat.cli.terminal import progress_bar


def test_short_work_says_nothing(capsys):
    with progress_bar("pigeon at 12 m/s") as update:
        assert update is not None
        update(1, 6)
    assert capsys.readouterr() == ("", "")


def test_long_work_says_how_far_it_is_each_time_its_duration_doubles(capsys, monkeypatch):
    said, lines = threading.Event(), []

    def hear(words):
        lines.append(words)
        said.set()

    monkeypatch.setattr(terminal, "FIRST_LINE", 0.05)
    monkeypatch.setattr(terminal, "say", hear)
    with progress_bar("pigeon at 12 m/s") as update:
        assert said.wait(30)
        assert update is not None
        said.clear()
        update(2, 6)
        assert said.wait(30)
    assert lines[0].startswith("pigeon at 12 m/s: still working after 0 s; the first run also compiles")
    assert lines[1] == "pigeon at 12 m/s: 2 of 6 done after 0 s"
    assert capsys.readouterr().out == ""


def test_its_thread_ends_with_the_work_also_after_an_error(monkeypatch):
    before = threading.active_count()
    with pytest.raises(KeyboardInterrupt), progress_bar("pigeon"):
        raise KeyboardInterrupt
    assert threading.active_count() == before
