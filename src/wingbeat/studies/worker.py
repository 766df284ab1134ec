"""A worker process: ``python -m wingbeat.studies.worker MODULE:FUNCTION TIMEOUT [CORE]``, batches in, outcomes out.

It reads a line of JSON a batch from stdin and writes a line an outcome to stdout. When stdin closes it ends at
once, whatever it is doing: whoever would hear its answer is gone.
"""

from __future__ import annotations

import faulthandler
import os
import queue
import sys
from typing import Any

from wingbeat.studies.units import Task, Unit
from wingbeat.workers.affinity import pin_to
from wingbeat.workers.stdio import answer_through_stdout, hear_stdin, load_work

__all__ = ["main"]

# How much longer than the driver's patience a worker lives that nobody can reach.
_BACKSTOP = 2.0


def main(work: str, timeout: float, core: int | None = None) -> None:
    """Work until stdin closes, on one core if it is given."""
    pin_to(core)
    tell = answer_through_stdout()
    solve = load_work(work)
    batches: queue.SimpleQueue[Any] = queue.SimpleQueue()
    hear_stdin(batches.put)
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
