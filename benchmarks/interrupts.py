"""Ctrl-C at random times, in every command that works long: how does each process end, and how soon?

A signal goes to the whole process group, as a terminal sends it. Run from the root of a clone, with warm caches::

    uv run python benchmarks/interrupts.py --tries 100
    uv run python benchmarks/interrupts.py --tries 20 --only orbit curve --signal TERM
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from collections import Counter
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

STUDY = """species = "pigeon"
starts = 1
[vary]
speed = { grid = [8.0, 9.0, 10.0, 11.0, 12.0, 13.0, 14.0, 15.0] }
"wing.mass" = { relative = [0.8, 0.9, 1.0, 1.1, 1.2] }
"""
TABLE = "alpha_deg,C_L,C_D\n" + "".join(f"{a},{0.02 * a},{0.04 + 0.0002 * a * a}\n" for a in range(-90, 91, 3))
# Words of each command; it is interrupted at any time from its start to so many seconds later, or its end.
COMMANDS = {
    "orbit": ("orbit pigeon --speed 12 -o out.nc --plot out.png", 6.0),
    "curve": ("curve pigeon --speeds 8:12:1 --starts 1", 8.0),
    "uncertainty": ("uncertainty pigeon --speed 12 --samples 4000", 12.0),
    "study": ("study cases.toml -j 2", 10.0),
    "paper": ("paper --quick --figures 5 -o out --processes 2", 15.0),
    "assumptions": ("paper assumptions --sets 4 -o out --processes 2", 15.0),
    "bench": ("bench --batch 16", 12.0),
    "app": ("app --no-open --port 0 --processes 1", 8.0),
    "view": ("view flight.nc -o out.gif", 8.0),
    "fit": ("fit table.csv -o out.toml --plot out.png --alpha-min 0", 4.0),
}
# Words of Python's own that a user should not see.
NOISE = ("Traceback", "Exception ignored", "Fatal Python error", "leaked", "Aborted", "Segmentation")


class Ending(NamedTuple):
    """How a process ended: code, seconds after the signal, what was wrong; code None: it was done before."""

    code: int | None
    seconds: float
    fault: str


def prepare(folder: Path) -> None:
    """Write the files that the commands read."""
    write_texts(folder)
    words = wingbeat("orbit pigeon --speed 12 -o flight.nc")
    subprocess.run(words, cwd=folder, check=True, stdout=subprocess.DEVNULL)


def write_texts(folder: Path) -> None:
    """Write those of the files that need no flight."""
    (folder / "cases.toml").write_text(STUDY)
    (folder / "table.csv").write_text(TABLE)


def wingbeat(words: str) -> list[str]:
    """Return the command that runs the program."""
    return [sys.executable, "-m", "wingbeat", *words.split()]


def interrupt(command: list[str], folder: Path, after: float, number: int = signal.SIGINT) -> Ending:
    """Start a command in a process group of its own, signal it after so many seconds, and watch it end."""
    before = {path.name for path in folder.iterdir()}
    mark = uuid.uuid4().hex  # in the environment of all that comes of it, also of other groups
    signal.signal(signal.SIGINT, signal.default_int_handler)  # what is ignored here would be ignored there
    with tempfile.TemporaryFile() as told:
        process = subprocess.Popen(
            command,
            cwd=folder,
            stdout=subprocess.DEVNULL,
            stderr=told,
            start_new_session=True,
            env=os.environ | {"INTERRUPTED_MARK": mark},
        )
        try:
            code = process.wait(after)
            told.seek(0)
            return Ending(None, 0.0, "" if code in (0, 3) else f"ended with {code}: {told.read().decode()}")
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, number)
        begun = time.perf_counter()
        try:
            code = process.wait(30.0)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            code = process.wait()
        seconds = time.perf_counter() - begun
        fault = "" if _gone(mark) else "left processes behind"
        told.seek(0)
        text = told.read().decode(errors="replace")
    left = [path.name for path in folder.iterdir() if path.name not in before and ".part" in path.name]
    if left:
        fault = f"left {', '.join(left)}"
    if any(word in text for word in NOISE):
        fault = text.strip()
    return Ending(code, seconds, fault)


def _gone(mark: str) -> bool:
    """Say whether all processes with a mark have ended, or do so within some seconds; end what is left."""
    for _ in range(100):
        if not (left := _marked(mark)):
            return True
        time.sleep(0.05)
    for process in left:
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    return False


def _marked(mark: str) -> list[int]:
    """Return the processes that have a mark in their environment; that of one that has ended is empty."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            if mark.encode() in (entry / "environ").read_bytes():
                found.append(int(entry.name))
    return found


def of_python(ending: Ending) -> bool:
    """Say whether the signal came before Python had run a line of wingbeat."""
    return ending.code == -signal.SIGINT or ("Traceback" in ending.fault and "/wingbeat/" not in ending.fault)


def main() -> int:
    """Interrupt every command many times, and say how they ended."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--tries", type=int, default=100, help="for each command")
    parser.add_argument("--only", nargs="*", choices=COMMANDS, default=list(COMMANDS))
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--signal", choices=("INT", "TERM"), default="INT")
    asked = parser.parse_args()
    number = signal.Signals[f"SIG{asked.signal}"]
    faults = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        prepare(folder)
        for command in asked.only:
            words, horizon = COMMANDS[command]
            chance = random.Random(f"{command} {asked.seed}")
            codes: Counter[str] = Counter()
            slowest = 0.0
            for _ in range(asked.tries):
                after = chance.uniform(0.0, horizon)
                ending = interrupt(wingbeat(words), folder, after, number)
                early = of_python(ending)
                codes[
                    "done before" if ending.code is None else "before wingbeat" if early else str(ending.code)
                ] += 1
                slowest = max(slowest, ending.seconds)
                good = early or (ending.code in (None, 128 + number) and not ending.fault)
                if not good or ending.seconds > 2.0:
                    faults += 1
                    print(f"{command} after {after:.3f} s: {ending}", flush=True)
            shown = ", ".join(f"{code}: {count}" for code, count in sorted(codes.items()))
            print(f"{command:12s} slowest end {slowest:.2f} s; {shown}", flush=True)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
