"""A worker process: ``python -m wingbeat.app.worker MODULE:FUNCTION``, jobs in, what became of them out.

It reads lines of JSON from stdin, a job or the wish to stop one, and writes lines of JSON to stdout. When stdin
closes it ends at once: whoever would hear its answer is gone.
"""

from __future__ import annotations

import importlib
import json
import os
import queue
import signal
import sys
import threading
import traceback
from typing import Any

from wingbeat.garbage import collect_seldom

__all__ = ["Hand", "StoppedError", "main"]

# Memory after which a worker leaves between two jobs, to be replaced: compiled programs pile up.
_MOST_MEMORY = 3 << 30


class StoppedError(Exception):
    """The job is no longer wanted."""


class Hand:
    """What a job holds in its hand: it tells how far it is, and learns whether it is still wanted."""

    def __init__(self, number: int, tell: Any, unwanted: set[int]) -> None:
        self._number, self._tell, self._unwanted = number, tell, unwanted

    def check(self) -> None:
        """Raise `StoppedError` if the job is no longer wanted."""
        if self._number in self._unwanted:
            raise StoppedError

    def progress(self, done: int, total: int) -> None:
        """Tell how far the job is; ends it here if it is no longer wanted."""
        self.check()
        self._tell({"kind": "progress", "value": [done, total]})


def _read(jobs: queue.SimpleQueue[Any], unwanted: set[int]) -> None:
    for line in sys.stdin.buffer:
        told = json.loads(line)
        if "stop" in told:
            unwanted.add(told["stop"])
        else:
            jobs.put(told)
    os._exit(0)


def _memory() -> int:
    """Return the resident memory [bytes], 0 where the system does not tell."""
    try:
        with open("/proc/self/statm", "rb") as numbers:
            return int(numbers.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 0


def main(work: str) -> None:
    """Work until stdin closes."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    collect_seldom()
    # Answers go out where stdout was; what the work prints goes to stderr.
    out = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    lock = threading.Lock()

    def tell(what: Any) -> None:
        line = json.dumps(what, allow_nan=False) + "\n"
        try:
            with lock:
                out.write(line)
                out.flush()
        except OSError:  # nobody listens any more
            os._exit(0)

    module, _, name = work.partition(":")
    do = getattr(importlib.import_module(module), name)
    jobs: queue.SimpleQueue[Any] = queue.SimpleQueue()
    unwanted: set[int] = set()
    threading.Thread(target=_read, args=(jobs, unwanted), daemon=True).start()
    tell({"kind": "ready"})
    while True:
        job = jobs.get()
        number = job["number"]
        tell({"kind": "took", "number": number})
        ending = _outcome(do, job["what"], Hand(number, tell, unwanted))
        unwanted.discard(number)
        tell({**ending, "number": number, "memory": (memory := _memory()), "leaves": memory > _MOST_MEMORY})
        if memory > _MOST_MEMORY:
            return


def _outcome(do: Any, what: Any, hand: Hand) -> dict[str, Any]:
    try:
        return {"kind": "done", "value": do(what, hand)}
    except StoppedError:
        return {"kind": "stopped", "value": None}
    except MemoryError:
        return {"kind": "failed", "value": "it took more memory than there is"}
    except Exception as error:
        traceback.print_exc()
        return {"kind": "failed", "value": f"{type(error).__name__}: {error}".split("\n")[0][:300]}


if __name__ == "__main__":
    main(sys.argv[1])
