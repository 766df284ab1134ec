"""What a study's driver costs: bytes, memory and seconds by the number of points, and the cores it can feed.

Each point is answered in no time with the record of a real orbit, so that what is left is the driver and its store.
Run from the root of a clone, on Linux; it prints the tables of docs/guide/clusters.md and writes nothing else::

    uv run --extra cluster python benchmarks/driver.py            # 10^3, 10^4 and 10^5 points: minutes
    uv run --extra cluster python benchmarks/driver.py 1000 10000
"""

from __future__ import annotations

import functools
import json
import multiprocessing
import os
import re
import subprocess
import sys
import tempfile
import time
from collections import deque
from collections.abc import Iterator
from contextlib import closing, contextmanager, nullcontext
from pathlib import Path
from typing import NamedTuple

import wingbeat as wb
from wingbeat._workers.process import Context
from wingbeat.studies.dask_engine import DaskEngine
from wingbeat.studies.engine import Ended, Engine, LocalProcesses
from wingbeat.studies.stopping import Stop
from wingbeat.studies.store import Store
from wingbeat.studies.units import Outcome, Unit

# Seconds that a point takes a core, which make the batches as large as they are with real points.
POINT = 0.0275
THROUGH_ENGINES = 10_000
DASK = "import sys; from distributed.cli import {0}; {0}.main()"


class Cost(NamedTuple):
    """What a study took: seconds of the clock and of the driver's processor, its memory [kB], its store [B]."""

    planned: float
    seconds: float
    processor: float
    batches: int
    memory: tuple[int, int]
    size: int
    looked: float


class Instant:
    """An engine that answers when asked, as many cores would together; it counts its batches."""

    def __init__(self, workers: int = 8) -> None:
        self.workers = workers
        self._ended = deque[Ended]()

    @property
    def free(self) -> int:
        return self.workers - len(self._ended)

    def submit(self, batch: int, units: list[Unit]) -> None:
        self._ended.append(Ended(batch, list(cheap(units)), "nobody"))

    def wait(self, seconds: float) -> Ended | None:
        return self._ended.popleft()

    def close(self) -> None:
        self._ended.clear()


def cheap(units: list[Unit]) -> Iterator[Outcome]:
    """Yield the same record for every point."""
    for unit in units:
        for task in unit.tasks:
            yield Outcome(task.key, "converged", record(), 1e-8, "", POINT)


def report_cheap(units: list[Unit], context: Context) -> None:
    """Report the same record for every point: what worker processes do here."""
    for outcome in cheap(units):
        context.report(outcome)


@functools.cache
def record() -> str:
    return Path(os.environ["DRIVER_RECORD"]).read_text(encoding="utf-8")


def solve_record() -> str:
    """Return the record of a real orbit as a study keeps it."""
    found = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1).record()
    del found["solve_seconds"]
    return json.dumps(found, separators=(",", ":"))


def plan(folder: str, count: int) -> wb.Study:
    """Return a study of so many points, whose store is in a folder."""
    vary = {"speed": {"range": [8.0, 12.0]}, "wing.mass": {"relative_range": [0.9, 1.1]}}
    sample = {"method": "latin-hypercube", "n": count}
    return wb.plan_study(species="pigeon", starts=1, vary=vary, sample=sample, store=f"{folder}/a.study.sqlite")


def memory(which: str) -> int:
    """Return this process's memory [kB]: ``VmRSS`` now, ``VmHWM`` at its peak."""
    return int(re.findall(rf"{which}:\s+(\d+)", Path("/proc/self/status").read_text())[0])


def run(count: int, through: str) -> Cost:
    """Plan, run and look at a study of cheap points."""
    LocalProcesses.work = "driver:report_cheap"
    with tempfile.TemporaryDirectory() as folder:
        begun = time.perf_counter()
        study = plan(folder, count)
        with Store.open(study.store) as store:
            store.set_plan(study.plan)
        planned, before = time.perf_counter() - begun, memory("VmRSS")
        with engine_of(through) as engine:
            batches = count_batches(engine)
            begun, processor = time.perf_counter(), time.process_time()
            study.run_on(engine, Stop())
            seconds, processor = time.perf_counter() - begun, time.process_time() - processor
        peak, size = memory("VmHWM"), study.store.stat().st_size
        begun = time.perf_counter()
        assert study.status().counts == {"converged": count}
        return Cost(planned, seconds, processor, batches[0], (before, peak), size, time.perf_counter() - begun)


def count_batches(engine: Engine) -> list[int]:
    """Return where the batches that an engine takes are counted."""
    counted, submit = [0], engine.submit

    def take(batch: int, units: list[Unit]) -> None:
        counted[0] += 1
        submit(batch, units)

    engine.submit = take  # type: ignore[method-assign]
    return counted


@contextmanager
def engine_of(through: str) -> Iterator[Engine]:
    """Give an engine, ready to work at once."""
    if through == "nobody":
        yield Instant()
    elif through == "a process":
        yield LocalProcesses(1)
    else:
        with (
            dask() if through == "a Dask worker" else nullcontext("local:1") as address,
            closing(DaskEngine(address, 60.0, lambda words: None)) as engine,
        ):
            yield engine


@contextmanager
def dask() -> Iterator[str]:
    """Give the address of a scheduler with one worker, each a process."""
    words = ["--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show"]
    start = [sys.executable, "-c", DASK.format("dask_scheduler"), *words]
    with subprocess.Popen(start, stderr=subprocess.PIPE, text=True) as scheduler:
        assert scheduler.stderr is not None
        address = next(m[1] for line in scheduler.stderr if (m := re.search(r"at:\s+(tcp://\S+)", line)))
        words = [address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
        start = [sys.executable, "-c", DASK.format("dask_worker"), *words]
        with subprocess.Popen(start, stderr=subprocess.DEVNULL) as worker:
            yield address
            worker.kill()
        scheduler.kill()


def in_a_process_of_its_own(count: int, through: str = "nobody") -> Cost:
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        return pool.apply(run, (count, through))


def main(counts: list[int]) -> None:
    print("planned: to write the plan; looked: to open and summarise the store; on the driver's processor\n")
    head = (
        "points",
        "planned [s]",
        "us a point",
        "memory [MB]",
        "at its peak [MB]",
        "store [B/point]",
        "looked [s]",
    )
    print_row(*head)
    print_row(*["---"] * len(head))
    for count in counts:
        cost = in_a_process_of_its_own(count)
        before, peak = (round(kilo / 1e3) for kilo in cost.memory)
        micro, size = round(1e6 * cost.processor / count), round(cost.size / count)
        print_row(count, f"{cost.planned:.1f}", micro, before, peak, size, f"{cost.looked:.2f}")
    print(f"\n{THROUGH_ENGINES} points; cores are those that one driver feeds at {1e3 * POINT} ms a point\n")
    head = ("through", "points a batch", "processor [ms a batch]", "clock [ms a batch]", "points/s", "cores")
    print_row(*head)
    print_row(*["---"] * len(head))
    for through in ("nobody", "a process", "a Dask worker", "Dask in the driver's process"):
        cost = in_a_process_of_its_own(THROUGH_ENGINES, through)
        clock, processor = (f"{1e3 * each / cost.batches:.1f}" for each in (cost.seconds, cost.processor))
        rate = THROUGH_ENGINES / cost.processor
        many = round(THROUGH_ENGINES / cost.batches)
        print_row(through, many, processor, clock, round(rate), round(rate * POINT))


def print_row(*cells: object) -> None:
    print(f"| {' | '.join(map(str, cells))} |", flush=True)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        kept = Path(place) / "record.json"
        kept.write_text(solve_record(), encoding="utf-8")
        os.environ["DRIVER_RECORD"] = str(kept)
        os.environ["PYTHONPATH"] = os.pathsep.join([str(Path(__file__).parent), *filter(None, sys.path)])
        main([int(word) for word in sys.argv[1:]] or [1_000, 10_000, 100_000])
