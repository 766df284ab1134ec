"""The end of a command: it prints its answer, then it writes its files, and neither can lose the other."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from wingbeat._base import FileError, WingbeatError, first_line
from wingbeat.cli.streams import StdoutError


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

    def save(self, path: Path | None, write: Callable[[Path], Any], *, named: bool = False) -> None:
        """Write a file if a path was given, after all parts were printed; note what went wrong.

        Parameters
        ----------
        path : of the file; None for no file.
        write : writes it, given the path.
        named : say on standard error which file was written.
        """
        if path is None:
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

    def end(self) -> None:
        """Raise what went wrong: a `FileError` with a line for each file, or a `StdoutError`."""
        if self._unwritten:
            raise FileError("\n".join(self._unwritten))
        if self._unprinted is not None:
            raise self._unprinted


@contextmanager
def answer() -> Iterator[Answer]:
    """Yield an `Answer`; at the end of the block, what could not be printed or written is raised.

    >>> with answer() as given:
    ...     given.show(lambda: print("9.5 Hz"))
    ...     given.save(None, lambda path: path.write_text("not asked for"))
    9.5 Hz
    """
    given = Answer()
    yield given
    given.end()
