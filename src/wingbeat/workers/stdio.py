"""What worker processes do alike: lines of JSON come in through stdin and go out through stdout."""

from __future__ import annotations

import importlib
import json
import os
import signal
import threading
from collections.abc import Callable
from typing import Any

from wingbeat.workers.gc import collect_seldom

__all__ = ["answer_through_stdout", "hear_stdin", "load_work"]


def load_work(name: str) -> Callable[..., Any]:
    """Return the function ``MODULE:FUNCTION``."""
    module, _, function = name.partition(":")
    return getattr(importlib.import_module(module), function)


def hear_stdin(hear: Callable[[Any], None]) -> None:
    """Call `hear` with each message, in a thread of its own; when stdin closes the process ends at once.

    Whoever would hear its answer is gone then, so whatever the process is doing is wanted no more.
    """

    def read() -> None:
        code = 1  # whatever else ends this thread would leave a process that nobody can end
        try:
            # Not through sys.stdin: a process that ends while a thread reads from that aborts.
            with open(os.dup(0), "rb") as lines:
                for line in lines:
                    hear(json.loads(line))
            code = 0
        finally:
            os._exit(code)

    threading.Thread(target=read, daemon=True).start()


def answer_through_stdout() -> Callable[[Any], None]:
    """Return a function that sends a message to where stdout was; what the work prints goes to stderr from now on.

    Ctrl-C is not for this process from now on: whoever started it ends it by closing its stdin.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    collect_seldom()
    out = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    lock = threading.Lock()

    def tell(what: Any) -> None:
        line = json.dumps(what) + "\n"
        try:
            with lock:
                out.write(line)
                out.flush()
        except OSError:  # nobody listens any more
            os._exit(0)

    return tell
