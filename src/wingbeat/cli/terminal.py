"""What a command says: its answer on standard output and in files, and its progress on standard error.

The answer is printed first, then the files are written, and neither can lose the other. Nothing heavy is imported.
"""

from __future__ import annotations

import json as json_format
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wingbeat._base import FileError, Report, Tone, WingbeatError, first_line, lines_of
from wingbeat._leftovers import Leftover
from wingbeat.cli.process import EXIT_GOOD, EXIT_INTERRUPTED, EXIT_NOT_CERTIFIED, EXIT_TERMINATED, StdoutError
from wingbeat.plots import save_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from rich.console import Console

    from wingbeat.studies.driver import Tally
    from wingbeat.studies.stopping import Stop

# --- the answer ---


class Answer:
    """What a command has to give: parts to print, then files to write."""

    def __init__(self) -> None:
        self._unprinted: StdoutError | None = None
        self._unwritten: list[str] = []

    def show(self, printed: Callable[[], Any]) -> None:
        """Print a part of the answer at once, even if the process is ended before the next part."""
        if self._unprinted is not None:
            return
        try:
            printed()
            sys.stdout.flush()
        except StdoutError as error:  # a reader such as `head`; the files are wanted still
            self._unprinted = error

    def tell(self, record: Any, report: Report | Callable[[], Any], json: bool) -> None:
        """Print a record as JSON, or else a report, which may be a function that prints it."""
        words = report if callable(report) else lambda: print_report(report)
        self.show((lambda: print_json(record)) if json else words)

    def save(self, path: Path | None, write: Callable[[Path], Any] | None, *, named: bool = False) -> None:
        """Write a file if there is a path and something to write; note what went wrong.

        With `named`, a line on standard error says which file was written.
        """
        if path is None or write is None:
            return
        try:
            write(path)
        except WingbeatError as error:
            self._unwritten += str(error).splitlines()
        except MemoryError:
            self._unwritten.append(f"cannot write {str(path)!r}: there is not enough memory")
        except Exception as error:  # a fault of ours, which must cost neither the answer nor the other files
            fix = "this is a fault of wingbeat; please report it, and choose another format"
            self._unwritten.append(f"cannot write {str(path)!r}: {first_line(error)}; {fix}")
        else:
            if named:
                print(f"wrote {path}", file=sys.stderr)

    def draw(self, path: Path | None, page: Callable[[], Figure] | None, *, named: bool = False) -> None:
        """Write the figure that `page` returns, as `save` writes a file."""
        if page is not None:
            self.save(path, lambda path: save_figure(page(), path), named=named)

    def end(self) -> None:
        """Raise what went wrong: a `FileError` with a line for each file, or a `StdoutError`."""
        if self._unwritten:
            raise FileError("\n".join(self._unwritten))
        if self._unprinted is not None:
            raise self._unprinted


@contextmanager
def answer() -> Iterator[Answer]:
    """Yield an `Answer`; at the end of the block, what could not be printed or written is raised.

    For a command that prints in several parts; `deliver` does for all others.

    >>> with answer() as given:
    ...     given.show(lambda: print("9.5 Hz"))
    ...     given.save(None, lambda path: path.write_text("not asked for"))
    9.5 Hz
    """
    given = Answer()
    yield given
    given.end()


def deliver(
    record: Any,
    report: Report | Callable[[], Any],
    certified: bool = True,
    *,
    json: bool,
    output: Path | None = None,
    save: Callable[[Path], Any] | None = None,
    plot: Path | None = None,
    page: Callable[[], Figure] | None = None,
) -> int:
    """End a command: print its record as JSON, or else its report; then write its result and its figure.

    A `save` or a `page` that is None says that nothing was found that could be written. Return the exit code.
    """
    with answer() as given:
        given.tell(record, report, json)
        given.save(output, save)
        given.draw(plot, page)
    return EXIT_GOOD if certified else EXIT_NOT_CERTIFIED


def print_json(record: Any) -> None:
    """Print a record as JSON; a number that is not finite is a fault of ours."""
    print(json_format.dumps(record, indent=2, allow_nan=False))


_STYLES: dict[Tone, str] = {
    "title": "bold",
    "good": "bold green",
    "doubtful": "bold yellow",
    "bad": "bold red",
    "warning": "yellow",
}


def print_report(report: Report, console: Console | None = None) -> None:
    """Print a report; its text is that of `summary`, with colours on a terminal."""
    from rich.text import Text

    console = console or plain_console()
    for line in lines_of(report, console.width):
        styled = Text(line.text)  # as Text, for names come from files
        if line.toned:
            styled.stylize(_STYLES[line.tone], 0, line.toned)
        console.print(styled, soft_wrap=True)


def plain_console() -> Console:
    """Return a console for tables that prints names and messages as text, even if they look like markup."""
    from rich.console import Console

    return Console(markup=False, highlight=False, emoji=False)


# --- progress ---

# Where stderr is no terminal, a line tells of work that lasts so long, and again each time its duration doubles.
# Work of the usual few seconds prints nothing.
FIRST_LINE = 20.0  # s
_COMPILES = "the first run also compiles programs, which takes up to two minutes"
FIRST_POINT = "the first point takes longest, because programs are compiled for it; then the time left is known"


@contextmanager
def progress_bar(what: str) -> Iterator[Callable[[int, int], None] | None]:
    """Yield a function that shows (done, in all) on stderr: in a bar, or in a few lines outside a terminal."""
    if not sys.stderr.isatty():
        with _lines(what, _COMPILES) as update:
            yield lambda done, total: update(done, total, None)
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Leftover(_show_cursor), Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)


@contextmanager
def _lines(what: str, hint: str) -> Iterator[Callable[[int, int, float | None], None]]:
    """Yield a function that notes (done, in all, seconds left if known); plain lines on stderr tell of it."""
    done, total, left = 0, 0, None
    ended = threading.Event()

    def update(now: int, whole: int, seconds: float | None) -> None:
        nonlocal done, total, left
        done, total, left = now, whole, seconds

    def tell() -> None:
        began, due, told = time.monotonic(), FIRST_LINE, f"; {hint}"
        while not ended.wait(began + due - time.monotonic()):
            counted = f"{done} of {total} done" if total else "still working"
            rest = told if left is None else f"; about {duration(left)} left"
            say(f"{what}: {counted} after {duration(due)}{rest}")
            due, told = 2.0 * due, ""

    # A thread, because the first programs compile for a minute before the work calls `update`.
    teller = threading.Thread(target=tell, daemon=True)
    teller.start()
    try:
        yield update
    finally:
        ended.set()
        teller.join()


def _show_cursor() -> None:
    """Show the terminal's cursor again, which the bar has hidden, and clear the bar's line."""
    os.write(2, b"\r\x1b[2K\x1b[?25h")


@contextmanager
def study_bar() -> Iterator[Callable[[Tally], None]]:
    """Yield a function that shows a study's tally on stderr: in a bar, or in a few lines outside a terminal."""
    if not sys.stderr.isatty():
        with _lines("points", FIRST_POINT) as update:
            yield lambda tally: update(tally.done, tally.total, tally.seconds_left)
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    from wingbeat.studies.units import CERTIFIED, UNCERTIFIED

    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("{task.description}"))
    with Leftover(_show_cursor), Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=None)

        def show(tally: Tally) -> None:
            left = tally.seconds_left
            parts = [f"{tally.count(status)} {status.replace('-', ' ')}" for status in (CERTIFIED, *UNCERTIFIED)]
            parts += [f"{tally.failed} failed", pace(tally.rate) if tally.here else FIRST_POINT]
            parts += [] if left is None else [f"about {duration(left)} left"]
            bar.update(task, completed=tally.done, total=tally.total, description=", ".join(parts))

        yield show


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
