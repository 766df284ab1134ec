"""Progress of long work (on a terminal only); the message and the exit code of a study that stops early."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from wingbeat.cli.endings import EXIT_INTERRUPTED, EXIT_TERMINATED
from wingbeat.workers.leftovers import Leftover

if TYPE_CHECKING:
    from wingbeat.studies.driver import Stop, Tally


@contextlib.contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None] | None]:
    """Yield a function that shows (done, in all) on stderr; None if stderr is not a terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Leftover(_show_cursor), Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=None)

        def update(done: int, total: int) -> None:
            bar.update(task, completed=done, total=total)

        yield update


def _show_cursor() -> None:
    """Show the terminal's cursor again, which the bar has hidden, and clear the bar's line."""
    os.write(2, b"\r\x1b[2K\x1b[?25h")


@contextlib.contextmanager
def study_bar() -> Iterator[Callable[[Tally], None] | None]:
    """Yield a function that shows a study's tally on stderr; None if stderr is not a terminal."""
    if not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    from wingbeat.studies.units import CERTIFIED, UNCERTIFIED

    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("{task.description}"))
    with Leftover(_show_cursor), Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=None)

        def update(tally: Tally) -> None:
            left = tally.seconds_left
            parts = [f"{tally.count(status)} {status.replace('-', ' ')}" for status in (CERTIFIED, *UNCERTIFIED)]
            parts += [f"{tally.failed} failed", f"{tally.rate:.1f}/s"]
            parts += [] if left is None else [f"{duration(left)} left"]
            bar.update(task, completed=tally.done, total=tally.total, description=", ".join(parts))

        yield update


def duration(seconds: float) -> str:
    """Return a time in seconds, minutes or hours, depending on its length.

    >>> duration(40), duration(600), duration(9000)
    ('40 s', '10 min', '2.5 h')
    """
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"


def say(words: str) -> None:
    """Print a line to stderr."""
    print(words, file=sys.stderr)


def say_stopping(level: int) -> None:
    """Say that a study was asked to stop."""
    say("stopping within a second; press Ctrl-C again to stop at once" if level == 1 else "stopping")


def exit_of(stop: Stop) -> int:
    """Return the exit code of a study that was asked to stop."""
    return EXIT_TERMINATED if stop.by == signal.SIGTERM else EXIT_INTERRUPTED
