"""The standard streams: a failed write to standard output is an error, one to standard error is ignored."""

from __future__ import annotations

import io
import os
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.console import Console


class StdoutError(Exception):
    """Standard output cannot be written; `number` is the errno. Not an OSError: rich catches some of these."""

    def __init__(self, error: OSError) -> None:
        self.number = error.errno
        super().__init__((error.strerror or str(error)).lower())


class _Stdout(io.FileIO):
    def write(self, data: Any) -> int | None:
        try:
            return super().write(data)
        except OSError as error:
            raise StdoutError(error) from None


class _Stderr(io.FileIO):
    def write(self, data: Any) -> int | None:
        try:
            return super().write(data)
        except OSError:  # there is nowhere to say so
            return len(data)


def prepare_streams() -> None:
    """Set up the standard streams of the process, even if it was started with some of them closed."""
    if os.name != "posix":  # a console of Windows is no file
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, io.TextIOWrapper):
                stream.reconfigure(errors="backslashreplace")
        return
    # Without this, the next file that is opened would become standard output. A stand-in opened the wrong way round
    # refuses reading or writing, as a closed stream does.
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_WRONLY if number == 0 else os.O_RDONLY)
    sys.stdout = _stream(sys.stdout, _Stdout(1, "w", closefd=False))
    sys.stderr = _stream(sys.stderr, _Stderr(2, "w", closefd=False), at_once=True)


def _stream(before: Any, raw: io.FileIO, at_once: bool = False) -> io.TextIOWrapper:
    """Return a stream like `before` that writes with `raw`; characters that its encoding lacks become escapes."""
    return io.TextIOWrapper(
        io.BufferedWriter(raw),
        encoding=getattr(before, "encoding", "utf-8"),
        errors="backslashreplace",
        line_buffering=at_once or raw.isatty() or getattr(before, "write_through", False),
    )


def drop_stdout() -> None:
    """Redirect standard output to the null device, so that the flush at exit does not fail again."""
    with suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


def plain_console() -> Console:
    """Return a console for tables that prints names and messages as text, even if they look like markup."""
    from rich.console import Console

    return Console(markup=False, highlight=False, emoji=False)
