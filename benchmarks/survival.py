"""A study of 2 000 points: how fast beside the bare batch solver, and what twenty SIGKILLs leave of it.

Run from the root of a clone, on a machine with nothing else to do; it prints what docs/guide/studies.md says::

    uv run python benchmarks/survival.py [--designs 25] [--kills 20] [--pairs 3]

A virtual machine changes its speed within minutes, so study and solver take turns.
"""

from __future__ import annotations

import argparse
import json
import random
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from contextlib import closing
from pathlib import Path

import numpy as np

import wingbeat as wb
from wingbeat._workers.tuning import core_count

STUDY = """species = ["pigeon", "bat"]
aero = ["su-fan", "dickinson"]
starts = 1
seed = 3
chain = "speed"
[vary]
speed = {{ grid = {speeds} }}
"wing.mass" = {{ relative_range = [0.9, 1.1] }}
"body.pitch_inertia" = {{ relative_range = [0.8, 1.2] }}
[sample]
method = "sobol"
n = {designs}
"""
RUN = [sys.executable, "-c", "from wingbeat.cli import main; raise SystemExit(main())", "study", "run"]


def kept(store: Path) -> dict[str, tuple[str, str, int, int]]:
    """Return what a store keeps of each point: status, record, attempt, and the run that solved it."""
    with closing(sqlite3.connect(f"{store.absolute().as_uri()}?mode=ro", uri=True)) as connection:
        rows = connection.execute("SELECT key, status, record, run_attempt, run_number FROM points")
        return {row[0]: row[1:] for row in rows}


def bare(study: wb.Study) -> tuple[float, float]:
    """Return the seconds that `solve_orbits` takes for the points in as many processes, and their records."""
    plan = study.plan
    problems = [plan.bases[point.base].recipe.problem(point.changes) for point in plan.points()]
    begun = time.perf_counter()
    orbits = wb.solve_orbits(problems, starts=1, seed=3, processes=core_count())
    solved = time.perf_counter()
    for orbit in orbits:
        json.dumps(orbit.record())
    # One process makes the records here; a study's processes share them.
    return solved - begun, (time.perf_counter() - solved) / core_count()


def beside_the_solver(file: Path, pairs: int) -> int:
    """Print how long study and bare solver take in turn, and their medians; return how many points."""
    taken = []
    for _ in range(pairs):
        file.with_suffix(".study.sqlite").unlink(missing_ok=True)
        study = wb.plan_study(file)
        begun = time.perf_counter()
        study.run()
        seconds = time.perf_counter() - begun
        solving, recording = bare(study)
        taken.append((seconds, solving, solving + recording))
        told = f"study {seconds:.1f} s; solve_orbits {solving:.1f} s, with records {solving + recording:.1f} s"
        print(f"{len(study)} points, {core_count()} processes: {told}; {study.status().counts}", flush=True)
    whole, alone, recorded = np.median(taken, axis=0)
    print(f"medians: {100 * alone / whole:.0f} % of the solver's rate, {100 * recorded / whole:.0f} % with records")
    return len(study)


def killed(file: Path, kills: int, points: int) -> tuple[int, int]:
    """Run a study to its end, its driver killed so often at random moments.

    Returns how many kills met it at work, and how many points that were kept already were solved again.
    """
    chance, store, met = random.Random(0), file.with_suffix(".study.sqlite"), 0
    seen: dict[str, tuple] = {}
    for _ in range(kills):
        running = subprocess.Popen([*RUN, str(file)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        before = len(kept(store)) if store.exists() else 0
        wanted = before + chance.uniform(0.0, 1.8) * (points - before) / kills
        while running.poll() is None and (len(kept(store)) if store.exists() else 0) < wanted:
            time.sleep(0.05)
        time.sleep(chance.uniform(0.0, 1.0))
        if running.poll() is None:
            running.send_signal(signal.SIGKILL)
            met += 1
        running.wait()
        seen = kept(store) | seen
    subprocess.run([*RUN, str(file)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return met, sum(kept(store)[key] != row for key, row in seen.items())


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--designs", type=int, default=25)
    arguments.add_argument("--kills", type=int, default=20)
    arguments.add_argument("--pairs", type=int, default=3)
    given = arguments.parse_args()
    speeds = [float(speed) for speed in np.linspace(6.0, 15.5, 20)]
    with tempfile.TemporaryDirectory() as name:
        files = [Path(name) / f"{which}.toml" for which in ("whole", "killed")]
        for file in files:
            file.write_text(STUDY.format(speeds=speeds, designs=given.designs))
        points = beside_the_solver(files[0], given.pairs)
        met, twice = killed(files[1], given.kills, points)
        whole, again = (kept(file.with_suffix(".study.sqlite")) for file in files)
        alike = sum(again.get(key, ())[:2] == row[:2] for key, row in whole.items())
        runs = len({row[3] for row in again.values()})
        print(
            f"{met} kills at work: {alike} of {len(whole)} records bit-equal, {len(again)} kept, of {runs} runs",
            end="",
        )
        print(f"; {twice} of those kept were solved again")


if __name__ == "__main__":
    main()
