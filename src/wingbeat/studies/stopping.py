"""How a run is asked to stop: the first Ctrl-C lets batches end, a second one or SIGTERM does not."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

# Seconds to wait for batches in flight after the first request to stop.
GRACE = 1.0


@dataclass
class Stop:
    """A request to stop, made by the signal `by`: level 1 waits briefly for batches to end, level 2 stops at once.

    Signals become requests only while the driver has batches in flight; at other times they act as usual.
    """

    level: int = 0
    by: int = 0
    since: float = 0.0
    driving: bool = False

    def ask(self, level: int, by: int = signal.SIGINT) -> None:
        """Request a stop; an earlier request of a higher level stays in force."""
        if level > self.level:
            self.level, self.by, self.since = level, by, time.monotonic()

    @property
    def due(self) -> bool:
        """Whether the driver must no longer wait for batches."""
        return self.level >= 2 or (self.level == 1 and time.monotonic() - self.since > GRACE)


@contextmanager
def listening(told: Callable[[int], None] | None = None) -> Iterator[Stop]:
    """Take the first SIGINT as a request to stop soon, and SIGTERM or a second SIGINT as one to stop at once.

    `told` is called with the level of each request.
    """
    stop = Stop()
    if threading.current_thread() is not threading.main_thread():
        yield stop
        return

    def hear(number: int, frame: Any) -> None:
        if not stop.driving and callable(usual := before[number]):
            usual(number, frame)
            return
        stop.ask(2 if number != signal.SIGINT else stop.level + 1, number)
        if told is not None:
            told(stop.level)

    before: dict[int, Any] = {number: signal.signal(number, hear) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield stop
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
