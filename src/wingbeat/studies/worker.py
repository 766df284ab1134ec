"""A worker process: ``python -m wingbeat.studies.worker MODULE:FUNCTION TIMEOUT [CORE]``, batches in, outcomes out.

It reads a line of JSON a batch from stdin and writes a line an outcome to stdout. When stdin closes it ends at
once, whatever it is doing: whoever would hear its answer is gone.
"""

from __future__ import annotations

import faulthandler
import importlib
import json
import os
import queue
import signal
import sys
import threading
from typing import Any

from wingbeat.cores import pin_to
from wingbeat.garbage import collect_seldom
from wingbeat.studies.units import Task, Unit

__all__ = ["main"]

# How much longer than the driver's patience a worker lives that nobody can reach.
_BACKSTOP = 2.0


def _read(batches: queue.SimpleQueue[Any]) -> None:
    # Not through sys.stdin: a process that ends while a thread reads from that aborts.
    with open(os.dup(0), "rb") as lines:
        for line in lines:
            batches.put(json.loads(line))
    os._exit(0)


def main(work: str, timeout: float, core: int | None = None) -> None:
    """Work until stdin closes, on one core if it is given."""
    pin_to(core)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    collect_seldom()
    # Answers go out where stdout was; what the work prints goes to stderr.
    out = os.fdopen(os.dup(1), "w", encoding="utf-8", buffering=1)
    os.dup2(2, 1)
    module, _, name = work.partition(":")
    solve = getattr(importlib.import_module(module), name)
    batches: queue.SimpleQueue[Any] = queue.SimpleQueue()
    threading.Thread(target=_read, args=(batches,), daemon=True).start()

    def tell(what: Any) -> None:
        try:
            out.write(json.dumps(what) + "\n")
        except OSError:  # nobody listens any more
            os._exit(0)

    tell("ready")
    quiet = open(os.devnull, "w")  # noqa: SIM115  # as long as the process
    while True:
        batch = batches.get()
        for place, tasks, skip in batch["units"]:
            unit = Unit(batch["recipes"][place], tuple(Task(*task) for task in tasks), tuple(skip))
            # One that hangs where no thread of Python runs any more is ended from below.
            faulthandler.dump_traceback_later(_BACKSTOP * timeout + 60.0, exit=True, file=quiet)
            for outcome in solve(unit):
                tell(outcome)
        faulthandler.cancel_dump_traceback_later()
        tell("done")


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), *map(int, sys.argv[3:]))
