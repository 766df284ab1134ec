"""A worker process: ``python -m wingbeat.app.worker MODULE:FUNCTION``, jobs in, what became of them out.

It reads lines of JSON from stdin, a job or the wish to stop one, and writes lines of JSON to stdout. When stdin
closes it ends at once: whoever would hear its answer is gone.
"""

from __future__ import annotations

import os
import queue
import sys
import traceback
from typing import Any

from wingbeat.workers.stdio import answer_through_stdout, hear_stdin, load_work

__all__ = ["NO_MEMORY", "Hand", "StoppedError", "main"]

# The exit code of a worker that was refused memory: ENOMEM, as systems number their errors.
NO_MEMORY = 12

# Memory after which a worker leaves between two jobs, to be replaced: compiled programs pile up.
_MOST_MEMORY = 3 << 30
# How XLA, threads and the system say that there is no memory left, where Python does not say so by a MemoryError.
_NO_MEMORY_WORDS = ("RESOURCE_EXHAUSTED", "can't start new thread", "Cannot allocate memory")


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


def _memory() -> int:
    """Return the resident memory [bytes], 0 where the system does not tell."""
    try:
        with open("/proc/self/statm", "rb") as numbers:
            return int(numbers.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 0


def main(work: str) -> None:
    """Work until stdin closes."""
    tell = answer_through_stdout()
    do = load_work(work)
    jobs: queue.SimpleQueue[Any] = queue.SimpleQueue()
    unwanted: set[int] = set()
    hear_stdin(lambda told: unwanted.add(told["stop"]) if "stop" in told else jobs.put(told))
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
    except Exception as error:
        if isinstance(error, MemoryError) or any(words in str(error) for words in _NO_MEMORY_WORDS):
            os._exit(NO_MEMORY)  # what is left of the process could not be relied on
        traceback.print_exc()
        return {"kind": "failed", "value": f"{type(error).__name__}: {error}".split("\n")[0][:300]}


if __name__ == "__main__":
    main(sys.argv[1])
