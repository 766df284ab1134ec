"""A `map` over worker processes, which start when there is work for them and end with the map."""

from __future__ import annotations

import io
import multiprocessing
import pickle
import queue
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from multiprocessing import spawn
from typing import Any, TypeVar

from wingbeat._base.errors import WorkerError
from wingbeat._workers.affinity import cores_of, pin_to
from wingbeat._workers.main import Context, Message
from wingbeat._workers.process import WorkerProcess

T = TypeVar("T")
R = TypeVar("R")

# Number of processes that may die on one item. A kill from outside hardly hits the same item twice.
_TRIES = 2


def in_processes(
    work: Callable[[T], R],
    items: Sequence[T],
    processes: int,
    progress: Callable[[int, int], None] | None = None,
) -> Iterator[R]:
    """Yield the result of `work` for each item, in the order of the items, as soon as it is ready.

    Parameters
    ----------
    work : a function that can be pickled; its JAX programs run in the process it is called in.
    items : what to work on.
    processes : number of Python processes that share the items; 1 means this process.
    progress : called with (items done, items in all).

    Raises
    ------
    WorkerError : two processes die on the same item, or none can be started.
    """
    with process_map(processes, len(items)) as over:
        for done, result in enumerate(over(work, items), start=1):
            if progress is not None:
                progress(done, len(items))
            yield result


@contextmanager
def process_map(processes: int, most: int) -> Iterator[Callable[[Callable[[T], R], Iterable[T]], Iterator[R]]]:
    """Yield a `map` that uses `processes` processes, at most one per item; with 1, it is Python's own `map`."""
    if processes == 1:
        yield map
        return
    callers = _Callers(min(processes, max(most, 1)))
    with ThreadPoolExecutor(callers.count) as threads:

        def over(work: Callable[[T], R], items: Iterable[T]) -> Iterator[R]:
            return threads.map(lambda item: callers.call(work, item), items)

        try:
            yield over
        finally:
            threads.shutdown(wait=False, cancel_futures=True)
            callers.close()


class _Caller:
    """A slot for a process, on a core of its own if there is one for each process."""

    def __init__(self, core: int | None) -> None:
        self.core = core
        self.heard: queue.SimpleQueue[Message | None] = queue.SimpleQueue()
        self.process: WorkerProcess | None = None


class _Callers:
    """Processes that call functions; each serves one thread at a time, and the one used last is used next."""

    def __init__(self, count: int) -> None:
        self.count = count
        # What a new process needs to import the main module of this one. During this import, it starts none.
        self._main = spawn.get_preparation_data("worker")
        del self._main["authkey"]  # cannot be pickled
        self._all = [_Caller(core) for core in cores_of(count)]
        self._idle: queue.LifoQueue[_Caller] = queue.LifoQueue()
        for caller in self._all:
            self._idle.put(caller)
        self._lock = threading.Lock()
        self._open = True

    def call(self, work: Callable[[T], R], item: T) -> R:
        """Return the result of `work` for an item, computed in a process."""
        pickled = pickle.dumps((work, item))
        caller = self._idle.get()
        ending = ""
        try:
            for _ in range(_TRIES):
                process = self._process(caller)
                process.request((self._main, pickled, caller.core))
                for message in iter(caller.heard.get, None):
                    if message.kind == "done":
                        return message.value
                    if message.kind == "failed":
                        raise message.value
                ending, caller.process = process.bury(), None
            raise WorkerError(f"two worker processes died on the same work; the last one ended with {ending}")
        finally:
            self._idle.put(caller)

    def close(self) -> None:
        """End every process immediately."""
        with self._lock:
            self._open = False
            processes = [caller.process for caller in self._all if caller.process is not None]
        for process in processes:
            process.kill()
        for process in processes:
            process.bury()

    def _process(self, caller: _Caller) -> WorkerProcess:
        with self._lock:
            if not self._open:
                raise WorkerError("the worker processes are closed")
            if caller.process is None:
                caller.process = WorkerProcess(f"{__name__}:call", caller.heard.put)
            return caller.process


def call(request: tuple[dict[str, Any], bytes, int | None], context: Context) -> Any:
    """Call a function with an item in a worker process; the request holds both, pickled, and the core to use."""
    main, pickled, core = request
    work, item = _Unpickler(main, pickled).load()
    # Pin after the imports: a BLAS that sees only one core has one thread, and adds in another order than in the
    # process that asks.
    pin_to(core)
    return work(item)


class _Unpickler(pickle.Unpickler):
    """Imports the main module of the requesting process, but only if something in it is needed.

    A script that sends none of its own functions or classes to workers therefore needs no ``if __name__ ==
    "__main__":``.
    """

    def __init__(self, main: dict[str, Any], pickled: bytes) -> None:
        super().__init__(io.BytesIO(pickled))
        self._main = main

    def find_class(self, module: str, name: str) -> Any:
        """Return a class or function."""
        if module == "__main__":
            here: Any = multiprocessing.current_process()
            here._inheriting = True  # as multiprocessing marks it, so that `get_preparation_data` refuses
            try:
                spawn.prepare(self._main)
            finally:
                del here._inheriting
        return super().find_class(module, name)
