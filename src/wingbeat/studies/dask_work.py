"""What a thread of a Dask worker does: it hands a batch to a process of its own, and waits.

Python cannot end a thread, and a point may crash its process, so no point is solved in the Dask worker itself. A
point is solved in a process with one thread, of the same kind as in a study without Dask. So the results with and
without Dask are equal to the last bit. Nothing here imports Dask.
"""

from __future__ import annotations

import importlib.metadata
import pickle
import platform
import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NamedTuple

from wingbeat._base import ClusterError, WorkerError
from wingbeat._version import NUMERICAL_VERSION, __version__
from wingbeat.studies.engine import Ended, LocalProcesses
from wingbeat.studies.units import Unit

# Packages on which the last digit of a result depends, besides the machine.
_TOLD = ("jax", "jaxlib", "numpy", "scipy", "diffrax")
# Seconds that a process without work is kept.
_KEPT = 60.0


class Order(NamedTuple):
    """A batch on its way to a Dask worker.

    Parameters
    ----------
    batch : its number.
    units : its points.
    work : what the processes run, ``module:function``.
    timeout : a process that sends nothing for this time is ended [s].
    driver : name of the driver that sends the batch.
    numerical_version : of that driver.
    """

    batch: int
    units: list[Unit]
    work: str
    timeout: float
    driver: str
    numerical_version: int


def greet() -> tuple[int, dict[str, str]]:
    """Return the numerical version, and the versions of all packages that affect a result's last digits."""
    versions = {name: importlib.metadata.version(name) for name in _TOLD}
    return NUMERICAL_VERSION, {"wingbeat": __version__, "Python": platform.python_version(), **versions}


class _Crew:
    """The processes of this Dask worker; each serves one batch at a time, and idle ones end after a while."""

    def __init__(self) -> None:
        self.gone: set[str] = set()
        self._idle: list[tuple[tuple[str, float], LocalProcesses]] = []
        self._lock = threading.Lock()
        self._timer = threading.Timer(_KEPT, self.dismiss)

    @contextmanager
    def lend(self, work: str, timeout: float) -> Iterator[LocalProcesses]:
        """Provide a process for a block; end the process if the block's batch does not end normally."""
        kind = work, timeout
        with self._lock:
            self._timer.cancel()
            place = next((i for i, (other, _) in enumerate(self._idle) if other == kind), None)
            one = LocalProcesses(1, timeout) if place is None else self._idle.pop(place)[1]
        one.work = work
        try:
            yield one
        except BaseException:
            one.close()
            raise
        with self._lock:
            self._idle.append((kind, one))
            self._timer.cancel()
            self._timer = threading.Timer(_KEPT, self.dismiss)
            self._timer.daemon = True
            self._timer.start()

    def dismiss(self) -> None:
        """End the idle processes."""
        with self._lock:
            self._timer.cancel()
            idle, self._idle = self._idle, []
        for _, one in idle:
            one.close()


_crew = _Crew()


def dismiss(driver: str) -> None:
    """End the processes that work for a driver that has left."""
    _crew.gone.add(driver)
    _crew.dismiss()


def solve_batch(order: bytes) -> Ended:
    """Solve an order in a process, and return how it ended.

    Raises
    ------
    ClusterError : this machine has another version of wingbeat, or no process can be started here.
    """
    asked: Order = pickle.loads(order)
    here = socket.gethostname()
    if asked.numerical_version != NUMERICAL_VERSION:
        raise ClusterError(other_numbers(f"the worker on {here}", NUMERICAL_VERSION, asked.numerical_version))
    try:
        with _crew.lend(asked.work, asked.timeout) as process:
            while True:
                ended = _solve(asked, process)
                if not process.false_starts:  # else no point is to blame
                    return ended._replace(worker=f"{here} {ended.worker}")
    except WorkerError:
        fix = "see the log of the Dask worker there"
        raise ClusterError(f"on {here} no solver process can be started; {fix}") from None


def _solve(asked: Order, process: LocalProcesses) -> Ended:
    process.submit(asked.batch, asked.units)
    while True:
        if asked.driver in _crew.gone:
            raise ClusterError("the driver has ended")
        if (ended := process.wait(0.2)) is not None:
            return ended


def other_numbers(who: str, theirs: int, ours: int) -> str:
    """Return the message that refuses a worker of another numerical version."""
    fix = "results of two versions cannot be mixed: install the same wingbeat there"
    return f"{who} has a wingbeat of numerical version {theirs}, but this process has version {ours}; {fix}"
