"""Flipped bits in the store of a study: is each harmless or refused in words, and are the whole answers kept?

Run from the root of a clone; it prints what docs/guide/studies.md says::

    uv run python benchmarks/flipped_bits.py [--seeds 60] [--flips 60] [--log-flips 600] [--program 12]

A study of 12 real points is solved once. Each flip turns one random bit of a fresh copy of its store, asks for
status and table, and runs the study. Where that is refused the store is salvaged and the study run again. No point
is solved twice: a stand-in gives the records of the undamaged store.
"""

from __future__ import annotations

import argparse
import csv
import io
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter, deque
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from typing import Any, NamedTuple

import wingbeat as wb
from wingbeat.cli import main as wingbeat
from wingbeat.cli import study as commands
from wingbeat.studies import study as studies
from wingbeat.studies.engine import Ended
from wingbeat.studies.stopping import Stop
from wingbeat.studies.store import Store
from wingbeat.studies.units import Outcome, Unit

# Two points have no orbit: the reasons of such points are part of the table, too.
STUDY = """species = "pigeon"
aero = ["su-fan", "dickinson"]
starts = 1
most_starts = 1
[vary]
speed = { grid = [9.0, 11.0, 45.0] }
"wing.mass" = { relative = [1.0, 1.1] }
"""
# What a refusal must name: a way to go on.
CURES = ("study salvage", "move it away", "restore a copy", "run the study")
PROGRAM = [sys.executable, "-c", "from wingbeat.cli import main; raise SystemExit(main())", "study"]
# From harmless to worst.
HARMLESS, REFUSED, WRONG, TRACEBACK = "harmless", "refused in words", "wrong table", "traceback"


class Found(NamedTuple):
    """What a flip led to: the verdict, of which bit and why, and how many points were solved again."""

    verdict: str
    why: str
    again: int | None = None


class Replay:
    """An engine that answers at once with what was found before, and counts what it was asked for."""

    workers = 1

    def __init__(self, known: dict[str, Outcome]) -> None:
        self._known, self._ended, self.solved = known, deque[Ended](), 0

    @property
    def free(self) -> int:
        return 1 - len(self._ended)

    def submit(self, batch: int, units: list[Unit]) -> None:
        outcomes = [self._known[task.key] for unit in units for task in unit.tasks]
        self.solved += len(outcomes)
        self._ended.append(Ended(batch, outcomes, "nobody"))

    def wait(self, seconds: float) -> Ended | None:
        return self._ended.popleft()

    def close(self) -> None:
        self._ended.clear()


class Sample:
    """A study that has been run, its store, and what its commands say while that is undamaged.

    Parameters
    ----------
    folder : an empty one.
    known : its outcomes by key, if it shall not be solved; made up from the plan if that is all there is.
    """

    def __init__(self, folder: Path, known: dict[str, Outcome] | None = None) -> None:
        self.folder, self.file = folder, folder / "whole.toml"
        self.file.write_text(STUDY)
        self.study = wb.plan_study(self.file)
        self.store = self.study.store
        if known is None:
            self.study.run()
            known = outcomes_of(self.store)
        self.known = known
        self.engine = Replay(known)
        if not self.store.exists():
            self.study.run_on(self.engine, Stop())
        with self.redirected(self.store):
            self.told = {what: self.ask(what)[1] for what in ("status", "export")}

    def logged(self, folder: Path) -> Path:
        """Return a copy of the store as a killed driver leaves it: half of the answers in the log beside it."""
        store, copy = folder / "logged.study.sqlite", folder / "killed.study.sqlite"
        with Store.open(store) as open_store:
            open_store.set_plan(self.study.plan)
            for outcomes in batched(list(self.known.values()), 3):
                open_store.save(outcomes, "nobody", 1, 1)
            for end in ("", "-wal"):
                shutil.copy(f"{store}{end}", f"{copy}{end}")
        return copy

    @contextmanager
    def redirected(self, store: Path) -> Iterator[None]:
        """Let the commands look at a store, without planning the study anew, and solve nothing."""
        study, engine = wb.Study(self.study.plan, store), self.engine
        before = commands._read, studies.engine_for
        commands._read = lambda file: study
        studies.engine_for = lambda *given: engine
        try:
            yield
        finally:
            commands._read, studies.engine_for = before

    def ask(self, *words: str) -> tuple[int | None, str, str]:
        """Run a command of the study; return its exit code (None: it raised), what it said or wrote, its errors."""
        table = self.folder / "asked.csv"
        table.unlink(missing_ok=True)
        more = ["-o", str(table)] if words[0] == "export" else []
        with redirect_stdout(io.StringIO()) as out, redirect_stderr(io.StringIO()) as err:
            try:
                code = wingbeat(["study", *words, str(self.file), *more])
            except Exception as error:
                return None, "", f"{type(error).__name__}: {error}"
        told = table.read_text() if table.exists() else re.sub(r"in \S+\n", "\n", out.getvalue())
        return code, told, err.getvalue()

    def judge(self, store: Path) -> Found:
        """Ask everything of a damaged store, and return the worst of it."""
        with self.redirected(store):
            refused = ""
            for what in ("status", "export"):
                code, told, said = self.ask(what)
                if code is None:
                    return Found(TRACEBACK, f"{what}: {said}")
                if code == 0 and told != self.told[what]:
                    return Found(WRONG, f"{what}: {differences(self.told[what], told)}")
                if code != 0:
                    refused = refused or said
                    if not is_refusal(said):
                        return Found(WRONG, f"{what}: no cure in {said!r}")
            return self._run(store, refused)

    def _run(self, store: Path, refused: str) -> Found:
        before = self.engine.solved
        code, _, said = self.ask("run", "--allow-failures")
        if code is None:
            return Found(TRACEBACK, f"run: {said}")
        if code != 0:
            if not is_refusal(said):
                return Found(WRONG, f"run: no cure in {said!r}")
            refused = refused or said
            if not hasattr(wb.Study, "salvage"):
                return Found(REFUSED, refused)
            for words in (("salvage",), ("run", "--allow-failures")):
                code, _, said = self.ask(*words)
                if code != 0:
                    return Found(TRACEBACK if code is None else WRONG, f"{words[0]} after {refused!r}: {said}")
        code, told, said = self.ask("export")
        if code and is_refusal(said) and not hasattr(wb.Study, "salvage"):
            return Found(REFUSED, said)
        if code != 0:
            return Found(TRACEBACK if code is None else WRONG, f"export after run: {said}")
        if solved(told) != solved(self.told["export"]):
            return Found(WRONG, f"export after run: {differences(self.told['export'], told)}")
        return Found(REFUSED if refused else HARMLESS, refused, self.engine.solved - before)


def outcomes_of(store: Path) -> dict[str, Outcome]:
    """Return what a store holds of its points, by key."""
    with Store.read(store) as opened:
        return {
            row.key: Outcome(row.key, row.status, row.record, row.certificate, row.error, row.seconds or 0.0)
            for row in opened.rows()
            if row.status is not None and row.error is not None
        }


def batched(items: list[Any], size: int) -> Iterator[list[Any]]:
    for first in range(0, len(items), size):
        yield items[first : first + size]


def is_refusal(said: str) -> bool:
    """Say whether something is one sentence of ours that names the store and a way to go on."""
    return said.startswith("error: ") and "Traceback" not in said and any(cure in said for cure in CURES)


def solved(table: str) -> list[list[str]]:
    """Return a table without its bookkeeping, which tells of the run and not of the point."""
    rows = [row for row in csv.reader(io.StringIO(table)) if not row[:1] or not row[0].startswith("#")]
    kept = [i for i, name in enumerate(rows[0]) if not name.startswith("run_")]
    return [[row[i] for i in kept] for row in rows]


def differences(one: str, other: str) -> str:
    pairs = zip(one.splitlines(), other.splitlines(), strict=False)
    return "; ".join(f"{b[:300]!r} in place of {a[:300]!r}" for a, b in pairs if a != b)[:800] or "cut short"


def flip(store: Path, damaged: Path, chance: random.Random, end: str = "") -> str:
    """Copy a store, with its log if it has one, and turn one random bit of a file of it; return which."""
    for suffix in ("", "-wal", "-shm"):
        Path(f"{damaged}{suffix}").unlink(missing_ok=True)
        if Path(f"{store}{suffix}").exists():
            shutil.copy(f"{store}{suffix}", f"{damaged}{suffix}")
    file = Path(f"{damaged}{end}")
    content = bytearray(file.read_bytes())
    place, bit = chance.randrange(len(content)), chance.randrange(8)
    content[place] ^= 1 << bit
    file.write_bytes(content)
    return f"byte {place} bit {bit}"


def campaign(sample: Sample, store: Path, seeds: int, flips: int, end: str = "", loud: bool = False) -> list[Found]:
    """Flip so many bits for each seed; return what each led to."""
    found = []
    with tempfile.TemporaryDirectory() as name:
        damaged = Path(name) / "damaged.study.sqlite"
        for seed in range(seeds):
            chance = random.Random(seed)
            for _ in range(flips):
                for old in damaged.parent.glob("*damaged*"):
                    old.unlink()
                where = flip(store, damaged, chance, end)
                one = sample.judge(damaged)
                found.append(one)
                if loud and one.verdict in (WRONG, TRACEBACK):
                    print(f"  seed {seed}, {where}: {one.verdict}: {one.why}", flush=True)
    return found


def told(found: list[Found]) -> str:
    counts = Counter(one.verdict for one in found)
    text = ", ".join(f"{counts[name]} {name}" for name in (HARMLESS, REFUSED, WRONG, TRACEBACK))
    again = [one.again for one in found if one.verdict == REFUSED and one.again is not None]
    if again:
        text += f"; of 12 points {sum(again) / len(again):.2f} solved again after a refusal, {max(again)} at most"
    return f"{len(found)} flipped bits: {text}"


def through_the_program(sample: Sample, flips: int) -> Counter[str]:
    """Ask the program itself, in processes of its own, for status and table of damaged stores."""
    counts: Counter[str] = Counter()
    chance = random.Random(0)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        file, table = folder / "damaged.toml", folder / "damaged.csv"
        file.write_text(STUDY)
        for _ in range(flips):
            flip(sample.store, folder / "damaged.study.sqlite", chance)
            worst = HARMLESS
            for words in (["status", file], ["export", file, "-o", table]):
                ended = subprocess.run([*PROGRAM, *map(str, words)], capture_output=True, text=True)
                if "Traceback" in ended.stderr or ended.returncode not in (0, 2):
                    worst = TRACEBACK
                elif ended.returncode == 2 and worst == HARMLESS:
                    worst = REFUSED if is_refusal(ended.stderr) else WRONG
                elif ended.returncode == 0 and words[0] == "export" and table.read_text() != sample.told["export"]:
                    worst = WRONG if worst != TRACEBACK else worst
            counts[worst] += 1
    return counts


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    for name, count in (("seeds", 60), ("flips", 60), ("log-flips", 600), ("program", 12)):
        arguments.add_argument(f"--{name}", type=int, default=count)
    given = arguments.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sample = Sample(folder)
        print(f"{len(sample.study)} points, {sample.store.stat().st_size} bytes", flush=True)
        begun = time.perf_counter()
        print("store: " + told(campaign(sample, sample.store, given.seeds, given.flips, loud=True)), flush=True)
        logged = sample.logged(folder)
        print("log: " + told(campaign(sample, logged, 1, given.log_flips, "-wal", loud=True)), flush=True)
        print(f"{time.perf_counter() - begun:.0f} s")
        print("through the program: " + str(dict(through_the_program(sample, given.program))))


if __name__ == "__main__":
    main()
