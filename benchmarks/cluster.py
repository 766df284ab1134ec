"""A large study on a Dask cluster of several worker processes: orbits a second, and the memory of all that work.

Run from the root of a clone; it needs the extra `cluster`, and 100 000 points take some 40 minutes on two cores::

    uv run python benchmarks/cluster.py --points 100000 --workers 2 --memory memory.csv

The points are a Sobol sample of four vehicles: pigeon and bat by both coefficient models, with mass, span and chord
varied by 10 % and speeds from 4 to 16 m/s. The table has, against time, the points that are stored and the resident
memory of the driver, which is also the scheduler, of the Dask workers, and of the processes that solve.
"""

from __future__ import annotations

import argparse
import csv
import os
import tempfile
import time
from pathlib import Path

import psutil
from distributed import LocalCluster

import wingbeat as wb
from wingbeat.studies.driver import Tally

SHARES = ("body.mass", "wing.semi_span", "wing.chord")
FIELDS = ("seconds", "points", "driver_mb", "dask_workers_mb", "solvers_mb", "store_mb")


def megabytes(processes: list[psutil.Process]) -> float:
    """Return the resident memory of these processes [MB]; those that have just ended count nothing."""
    total = 0
    for process in processes:
        try:
            total += process.memory_info().rss
        except psutil.NoSuchProcess:
            continue
    return total / 1e6


def solvers(workers: list[psutil.Process]) -> list[psutil.Process]:
    """Return the processes that the Dask workers have started."""
    found: list[psutil.Process] = []
    for worker in workers:
        try:
            found += worker.children(recursive=True)
        except psutil.NoSuchProcess:
            continue
    return found


def main() -> None:
    """Solve the study, and print and write what it took."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--every", type=float, default=20.0, help="seconds between two rows of the table")
    parser.add_argument("--memory", type=Path, help="write the table here")
    asked = parser.parse_args()
    vehicles = 4
    vary = {name: {"relative_range": [0.9, 1.1]} for name in SHARES} | {"speed": {"range": [4.0, 16.0]}}
    rows: list[dict[str, float]] = []
    with tempfile.TemporaryDirectory() as folder:
        store = Path(folder) / "scale.study.sqlite"
        study = wb.plan_study(
            species=["pigeon", "bat"],
            aero=["su-fan", "dickinson"],
            starts=1,
            vary=vary,
            sample={"method": "sobol", "n": -(-asked.points // vehicles)},
            store=store,
        )
        local = {"dashboard_address": "127.0.0.1:0", "memory_limit": 0}
        with LocalCluster(n_workers=asked.workers, threads_per_worker=1, processes=True, **local) as cluster:
            driver = psutil.Process()
            daskers = [psutil.Process(worker.pid) for worker in cluster.workers.values()]
            begun = time.perf_counter()

            def note(tally: Tally) -> None:
                now = time.perf_counter() - begun
                if rows and now < rows[-1]["seconds"] + asked.every:
                    return
                sizes = [megabytes(who) for who in ([driver], daskers, solvers(daskers))]
                row = (now, tally.done, *sizes, store.stat().st_size / 1e6)
                rows.append(dict(zip(FIELDS, row, strict=True)))
                print(", ".join(f"{name} {value:.0f}" for name, value in rows[-1].items()), flush=True)

            summary = study.run(dask=cluster, progress=note)
            taken = time.perf_counter() - begun
    told = (
        f"{summary.total} points in {taken:.0f} s by {asked.workers} workers: {summary.total / taken:.1f} a second"
    )
    print(told, dict(summary.counts), f"{1e3 * summary.seconds / summary.total:.1f} ms each", flush=True)
    if asked.memory:
        with asked.memory.open("w", newline="") as file:
            table = csv.DictWriter(file, FIELDS, lineterminator="\n")
            table.writeheader()
            table.writerows({name: f"{value:.4g}" for name, value in row.items()} for row in rows)


if __name__ == "__main__":
    main()
