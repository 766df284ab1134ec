"""Progress of long work, as a bar or a few lines; the message and the exit code of a study that stops early."""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from wingbeat._leftovers import Leftover
from wingbeat.cli.endings import EXIT_INTERRUPTED, EXIT_TERMINATED

if TYPE_CHECKING:
    from wingbeat.studies.driver import Tally
    from wingbeat.studies.stopping import Stop


# Where stderr is no terminal, a line tells of work that lasts so long, and again each time its duration doubles.
# Work of the usual few seconds prints nothing.
FIRST_LINE = 20.0  # s
_COMPILES = "the first run also compiles programs, which takes up to two minutes"
FIRST_POINT = "the first point takes longest, because programs are compiled for it; then the time left is known"


@contextlib.contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None] | None]:
    """Yield a function that shows (done, in all) on stderr: in a bar, or in a few lines outside a terminal."""
    if not sys.stderr.isatty():
        with _Lines(what, _COMPILES) as lines:
            yield lines.update
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Leftover(_show_cursor), Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=None)

        def update(done: int, total: int) -> None:
            bar.update(task, completed=done, total=total)

        yield update


class _Lines:
    """Plain lines on stderr that tell how far long work is, for a log or another program."""

    def __init__(self, what: str, hint: str) -> None:
        self._what, self._hint, self._done, self._total = what, hint, 0, 0
        self._left: float | None = None
        self._ended = threading.Event()
        # A thread, because the first programs compile for a minute before the work calls `update`.
        self._teller = threading.Thread(target=self._tell, daemon=True)

    def __enter__(self) -> _Lines:
        self._teller.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._teller.join()

    def update(self, done: int, total: int, left: float | None = None) -> None:
        """Note how much is done, of how much, and the seconds that are left, if known; then the hint is over."""
        self._done, self._total, self._left = done, total, left

    def _tell(self) -> None:
        began, due, hint = time.monotonic(), FIRST_LINE, f"; {self._hint}"
        while not self._ended.wait(began + due - time.monotonic()):
            counted = f"{self._done} of {self._total} done" if self._total else "still working"
            left = hint if self._left is None else f"; about {duration(self._left)} left"
            say(f"{self._what}: {counted} after {duration(due)}{left}")
            due, hint = 2.0 * due, ""


def _show_cursor() -> None:
    """Show the terminal's cursor again, which the bar has hidden, and clear the bar's line."""
    os.write(2, b"\r\x1b[2K\x1b[?25h")


@contextlib.contextmanager
def study_bar() -> Iterator[Callable[[Tally], None]]:
    """Yield a function that shows a study's tally on stderr: in a bar, or in a few lines outside a terminal."""
    if not sys.stderr.isatty():
        with _Lines("points", FIRST_POINT) as lines:
            yield lambda tally: lines.update(tally.done, tally.total, tally.seconds_left)
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
            parts += [f"{tally.failed} failed"]
            parts += [FIRST_POINT] if not tally.here else [pace(tally.rate)]
            parts += [] if left is None else [f"about {duration(left)} left"]
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


def pace(rate: float) -> str:
    """Return a rate [1/s] as points per second, or as the time of each point if that is longer than a second.

    >>> pace(12.34), pace(0.02)
    ('12.3 per second', '50 s each')
    """
    return f"{rate:.1f} per second" if rate >= 1.0 or rate <= 0.0 else f"{duration(1.0 / rate)} each"


def say(words: str) -> None:
    """Print a line to stderr."""
    print(words, file=sys.stderr)


def say_stopping(level: int) -> None:
    """Say that a study was asked to stop."""
    say("stopping within a second; press Ctrl-C again to stop at once" if level == 1 else "stopping")


def exit_of(stop: Stop) -> int:
    """Return the exit code of a study that was asked to stop."""
    return EXIT_TERMINATED if stop.by == signal.SIGTERM else EXIT_INTERRUPTED
