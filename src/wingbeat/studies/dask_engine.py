"""The engine on other machines: it sends batches to the workers of a Dask cluster, whose threads hand them on.

Python cannot end a thread, and a point may crash its process, so no point is solved in a Dask worker itself. A
thread of the worker hands a batch to a process with one thread, of the same kind as in a study without Dask. So the
results with and without Dask are equal to the last bit.
"""

from __future__ import annotations

import asyncio
import importlib.metadata
import logging
import pickle
import platform
import queue
import re
import socket
import threading
import time
import uuid
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import (
    NUMERICAL_VERSION,
    ClusterError,
    FaultList,
    WorkerError,
    __version__,
    install_extra,
    system_reason,
)
from wingbeat.studies.engine import Ended, LocalProcesses
from wingbeat.studies.units import Unit

if TYPE_CHECKING:
    from distributed import Client, Future, LocalCluster
    from distributed.deploy.cluster import Cluster

# --- what a thread of a Dask worker does; it needs no Dask ---


# Seconds that a process without work is kept.
_KEPT = 60.0


class Order(NamedTuple):
    """A batch on its way to a Dask worker."""

    batch: int
    units: list[Unit]
    work: str
    timeout: float
    driver: str
    numerical_version: int


def greet() -> tuple[int, dict[str, str]]:
    """Return the numerical version, and the versions of all packages that affect a result's last digits."""
    packages = ("jax", "jaxlib", "numpy", "scipy", "diffrax")
    versions = {name: importlib.metadata.version(name) for name in packages}
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

    A `ClusterError` says that this machine has another version of wingbeat, or can start no process.
    """
    asked: Order = pickle.loads(order)
    here = socket.gethostname()
    if asked.numerical_version != NUMERICAL_VERSION:
        raise ClusterError(other_numbers(f"the worker on {here}", NUMERICAL_VERSION, asked.numerical_version))
    try:
        with _crew.lend(asked.work, asked.timeout) as process:
            while True:
                process.submit(asked.batch, asked.units)
                while (ended := process.wait(0.2)) is None:
                    if asked.driver in _crew.gone:
                        raise ClusterError("the driver has ended")
                if not process.false_starts:  # else no point is to blame
                    return ended._replace(worker=f"{here} {ended.worker}")
    except WorkerError:
        rule = "no solver process can be started; see the log of the Dask worker there"
        raise ClusterError(f"on {here} {rule}") from None


def other_numbers(who: str, theirs: int, ours: int) -> str:
    """Return the message that refuses a worker of another numerical version."""
    fix = "results of two versions cannot be mixed: install the same wingbeat there"
    return f"{who} has a wingbeat of numerical version {theirs}, but this process has version {ours}; {fix}"


# --- the engine ---

_LOCAL, _REMOTE = re.compile(r"local:([1-9][0-9]{0,3})"), re.compile(r"(tcp|tls)://\S+:[0-9]+")
# Seconds to wait for a scheduler's first reply; seconds between two checks of its workers; seconds to wait for an
# answer that exists, but whose worker may just have died.
_CONNECT, _LOOK, _FETCH = 10.0, 2.0, 5.0
# Where Dask looks for the certificates of a client, if its configuration files name none.
_CERTIFICATES = tuple(f"DASK_DISTRIBUTED__COMM__TLS__{name}" for name in ("CA_FILE", "CLIENT__CERT", "CLIENT__KEY"))
# Address of a cluster of our own: no other machine can reach it. Any free port is used.
_LOOPBACK = "127.0.0.1:0"


class DaskEngine:
    """The workers of a Dask cluster; each of their threads takes one batch and runs it in a separate process.

    `told` is called with notices for the user: no workers yet, other versions on the workers.
    """

    def __init__(self, where: str | Cluster, timeout: float, told: Callable[[str], None]) -> None:
        faults, known = FaultList(), hasattr(where, "scheduler_address")
        if isinstance(where, str):
            known = _LOCAL.fullmatch(where) or _REMOTE.fullmatch(where)
        if not known:
            fix = "give tcp://HOST:PORT, which `dask scheduler` prints, or local:N for N processes of this machine"
            faults.add("dask", where, "names no Dask cluster", fix)
        faults.raise_if_any()
        self._where = where if isinstance(where, str) else where.scheduler_address
        self._timeout, self._told = timeout, told
        self._name = uuid.uuid4().hex
        self._asked: dict[int, list[Unit]] = {}
        self._flying: dict[int, Future] = {}
        # If a Dask worker dies, all its batches fail. Each of them is sent once more, alone. A batch is lost only
        # if its worker dies then, too.
        self._suspects: deque[int] = deque()
        self._alone: int | None = None
        self._done: queue.SimpleQueue[int] = queue.SimpleQueue()
        self._threads: dict[str, int] = {}
        self._looked = time.monotonic() - _LOOK
        self._empty = False
        self._cluster, self._client = _connect(where)
        try:
            self._look()
        except BaseException:
            self.close()
            raise

    @property
    def workers(self) -> int:
        """Number of batches that the engine works on at the same time; 1 before the first worker joins."""
        self._look()
        return max(1, sum(self._threads.values()))

    @property
    def free(self) -> int:
        """Number of batches that the engine accepts now; a few wait at the scheduler to keep the workers busy."""
        if self._suspects or self._alone is not None:
            return 0
        return self.workers + self.workers // 8 + 1 - len(self._flying)

    def submit(self, batch: int, units: list[Unit]) -> None:
        """Take a batch."""
        self._asked[batch] = units
        order = Order(batch, units, LocalProcesses.work, self._timeout, self._name, NUMERICAL_VERSION)
        # Sent as bytes, because Dask does not look into bytes.
        key = f"wingbeat-{uuid.uuid4().hex}"
        self._watch(batch, self._client.submit(solve_batch, pickle.dumps(order), key=key, pure=False))

    def wait(self, seconds: float) -> Ended | None:
        """Return a batch that ended, or None if none ended within `seconds`."""
        if self._suspects and not self._flying:
            self._alone = self._suspects.popleft()
            self.submit(self._alone, self._asked[self._alone])
        try:
            batch = self._done.get(timeout=seconds)
        except queue.Empty:
            self._look()
            return None
        ended = self._end(batch, self._flying.pop(batch))
        if ended is not None:
            del self._asked[batch]
            self._alone = None
        return ended

    def _watch(self, batch: int, future: Future) -> None:
        """Remember a future, and queue its batch as finished when the future ends."""
        self._flying[batch] = future
        future.add_done_callback(lambda _: self._done.put(batch))

    def _end(self, batch: int, future: Future) -> Ended | None:
        """Return how a batch ended; None if it is still running."""
        from distributed import KilledWorker

        try:
            return future.result(timeout=_FETCH)
        except TimeoutError:  # the worker that had the answer just died: Dask repeats the work
            self._watch(batch, future)
        except KilledWorker:
            if batch == self._alone:
                return Ended(batch, [], "", "crashed", "the Dask workers that ran this batch died", told=False)
            self._suspects.append(batch)
        except ClusterError:
            raise
        except Exception as error:
            self._check()
            raise ClusterError(f"a Dask worker cannot do the work: {_named(error)}; {_SAME}") from None
        return None

    def close(self) -> None:
        """End every process that works for this study; a cluster that we did not start keeps running."""
        with suppress(Exception):  # leaving a cluster that may be half gone
            if self._client.status == "running":
                self._client.cancel(list(self._flying.values()))
                self._client.run(dismiss, self._name, on_error="ignore")
        self._flying.clear()
        with suppress(Exception):
            self._client.close(timeout=2)
        if self._cluster is not None:
            with suppress(Exception):
                self._cluster.close(timeout=5)

    def _check(self) -> None:
        """Raise if the scheduler is gone."""
        if self._client.status != "running":
            fix = "stored results remain: start the scheduler again and run the study again"
            raise ClusterError(f"the Dask scheduler at {self._where} is gone; {fix}")

    def _look(self) -> None:
        """Check from time to time which workers the scheduler has, and check the versions of new ones."""
        self._check()
        if time.monotonic() < self._looked + _LOOK:
            return
        try:
            found: Any = self._client.nthreads()
            before = self._threads
            self._threads = {address: number for address, number in found.items() if address in before}
            self._threads |= {name: found[name] for name in self._meet(found.keys() - before.keys())}
        except (OSError, TimeoutError):
            self._check()
        if not self._threads and not self._empty:
            self._told("the Dask scheduler has no workers; waiting until one joins it")
        self._empty = not self._threads
        self._looked = time.monotonic()

    def _meet(self, addresses: Iterable[str]) -> list[str]:
        """Return the new workers that answer; refuse other numerical versions and report other package versions."""
        if not (new := sorted(addresses)):
            return []
        _, ours = greet()
        others: dict[str, list[str]] = {}
        met = []
        answers: Any = self._client.run(greet, workers=new, on_error="return")
        for name, answer in answers.items():
            if isinstance(answer, OSError):  # it left again
                continue
            if isinstance(answer, BaseException):
                raise ClusterError(f"the Dask worker {name} cannot do the work: {_named(answer)}; {_SAME}")
            numbers, theirs = answer
            if numbers != NUMERICAL_VERSION:
                raise ClusterError(other_numbers(f"the Dask worker {name}", numbers, NUMERICAL_VERSION))
            met.append(name)
            for package, version in theirs.items():
                if version != ours.get(package):
                    others.setdefault(f"{package} {version}, not {ours.get(package)}", []).append(name)
        for what, who in others.items():
            whose = who[0] if len(who) == 1 else f"{who[0]} and {len(who) - 1} more Dask workers"
            self._told(f"{whose}: {what}; results then agree only within the tolerance of the certificates")
        return met


_SAME = "install the same wingbeat there as here"


def _named(error: BaseException) -> str:
    return f"{type(error).__name__}: {error}"


def _connect(where: str | Cluster) -> tuple[LocalCluster | None, Client]:
    """Return a client, and the cluster if we started it, else None."""
    try:
        import distributed
    except ImportError:
        raise ClusterError(f"Dask is not installed here: {install_extra('cluster')}") from None
    # Dask's own messages are silenced: we report each fault once, in our own words.
    for handler in logging.getLogger("distributed").handlers:
        handler.setLevel(logging.CRITICAL + 1)
    if isinstance(where, str) and (local := _LOCAL.fullmatch(where)):
        # The workers are threads of this process, because each has a process of its own for the work.
        settings: dict[str, Any] = {"n_workers": 1, "threads_per_worker": int(local[1]), "processes": False}
        settings |= {"dashboard_address": _LOOPBACK, "worker_dashboard_address": _LOOPBACK, "memory_limit": 0}
        cluster = distributed.LocalCluster(**settings)
        return cluster, distributed.Client(cluster, set_as_default=False)
    if isinstance(where, str):
        # Tried first without a client: one that cannot connect would wait for 20 s when it is deleted.
        with ThreadPoolExecutor(1) as elsewhere:  # this thread may have an event loop, as in notebooks
            elsewhere.submit(asyncio.run, _reach(where)).result()
    try:
        return None, distributed.Client(where, timeout=_CONNECT, set_as_default=False)
    except (OSError, TimeoutError, ValueError):
        raise _unreached(where) from None


async def _reach(where: str) -> None:
    """Raise `ClusterError` unless a scheduler answers, with the certificates of Dask's configuration."""
    from distributed import Security
    from distributed.comm.core import connect

    try:
        settings = Security().get_connection_args("client")
    except OSError as error:
        what = f"cannot read the certificates for {where}: {system_reason(error)}"
        raise ClusterError(f"{what}; check {', '.join(_CERTIFICATES)}") from None
    if where.startswith("tls://") and settings["ssl_context"] is None:
        fix = f"set {', '.join(_CERTIFICATES)} (see docs/guide/clusters.md)"
        raise ClusterError(f"{where} needs certificates, and Dask has none here; {fix}")
    try:
        comm = await connect(where, timeout=_CONNECT, **settings)
    except (OSError, TimeoutError, ValueError):
        raise _unreached(where) from None
    await comm.close()


def _unreached(where: str | Cluster) -> ClusterError:
    fix = "check the address, which `dask scheduler` prints, and that it can be reached from here"
    if str(where).startswith("tls://"):
        fix += ", and that both sides use the same certificates"
    return ClusterError(f"no Dask scheduler answers at {where}; {fix}")
