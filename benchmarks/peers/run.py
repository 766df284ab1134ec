"""wingbeat against what else solves the same problem: one process each, one core each, the same cases and starts.

Run from the root of a clone::

    uv run --group bench python benchmarks/peers/run.py [--quick] [-o folder]

Prints a table in Markdown and writes peers.json (raw numbers) and peers.png beside it.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.metadata
import json
import os
import platform
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from agreement import differences, judge
from cases import Case, all_cases
from figure import draw
from referee import model_gap

MODULES = ("by_wingbeat", "by_scipy", "by_casadi", "by_aerosandbox", "by_rockit")
PACKAGES = ("wingbeat", "numpy", "scipy", "jax", "jaxlib", "casadi", "aerosandbox", "rockit-meco")
REFERENCE = "wingbeat"
# XLA's threads on a CPU obey the last alone; its flag xla_cpu_multi_thread_eigen leaves them all (JAX 0.10.2).
SINGLE = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "PJRT_NPROC"), "1")
CLOSED = 1e-6


def environment(cache: str) -> dict[str, str]:
    """Return an environment of one thread whose compilation cache is the given folder."""
    mine = {name: value for name, value in os.environ.items() if not name.startswith("JAX_")}
    return mine | SINGLE | {"WINGBEAT_CACHE": cache, "PYTHONWARNINGS": "ignore"}


def contest(module: str, variant: str, cases: list[Case], cache: str, starts: int = 1, cold: bool = False) -> dict:
    """Run one contestant in a process of its own; return its outcome or why there is none."""
    with tempfile.TemporaryDirectory() as folder:
        job, out = Path(folder) / "job.json", Path(folder) / "out.json"
        parts = [(case.animal, case.model, case.speed) for case in cases]
        words = {"module": module, "variant": variant, "cases": parts, "starts": starts, "cold_only": cold}
        job.write_text(json.dumps(words))
        command = [
            sys.executable,
            str(Path(__file__).with_name("contest.py")),
            str(job),
            str(out),
            str(time.time()),
        ]
        done = subprocess.run(command, env=environment(cache), capture_output=True, text=True)
        if done.returncode != 0:
            return {"error": done.stderr[-2000:]}
        return json.loads(out.read_text())


def compete(module: str, variant: str, cases: list[Case], starts: int, colds: int) -> dict:
    """Return a contestant's cold starts, each from an empty cache, new processes with that cache, and warm runs."""
    with tempfile.TemporaryDirectory() as folder:
        cold, again = [], []
        for i in range(colds):
            for times in (cold, again):
                times.append(contest(module, variant, cases[:1], f"{folder}/{i}", cold=True))
        outcome = contest(module, variant, cases, f"{folder}/0", starts)
    if broken := next((o["error"] for o in (*cold, *again, outcome) if "error" in o), None):
        return {"error": broken}
    return outcome | {"cold": [o["cold"] for o in cold], "again": [o["cold"] for o in again]}


def spread(values: list[float]) -> str:
    """Return median and quartiles."""
    low, middle, high = np.percentile(values, [25, 50, 75])
    return f"{middle:.2f} ({low:.2f} to {high:.2f})"


def warm(result: dict) -> dict[str, float]:
    """Return the median seconds of each case that was solved."""
    solved = (entry for entry in result["cases"] if entry["first"]["success"])
    return {entry["case"]: float(np.median(entry["seconds"])) for entry in solved}


def table(results: dict[str, dict]) -> str:
    """Return the comparison as a table in Markdown."""
    heads = [
        "tool",
        "cold, s",
        "new process, s",
        "warm, s: median (quartiles)",
        "repeats differ by",
        "solved",
    ]
    heads += ["from stock guess", f"close to {CLOSED:.0e}", "worst residual, re-flown", "warm / wingbeat"]
    lines = [heads, ["---"] * len(heads)]
    ours = warm(results[REFERENCE])
    for name, result in results.items():
        seconds, entries = warm(result), result["cases"]
        solved = [entry for entry in entries if entry["first"]["success"]]
        misses = [entry["first"]["miss"] for entry in solved]
        noise = [np.ptp(e["seconds"]) / np.median(e["seconds"]) for e in solved if len(e["seconds"]) > 1]
        ratios = [seconds[case] / ours[case] for case in seconds if case in ours]
        lines.append(
            [
                name,
                f"{np.median(result['cold']):.1f}",
                f"{np.median(result['again']):.1f}",
                spread(list(seconds.values())) if seconds else "-",
                f"{100 * np.median(noise):.0f} %" if noise else "-",
                f"{len(solved)} of {len(entries)}",
                str(sum(entry["tried"] == 1 for entry in solved)),
                str(sum(miss <= CLOSED for miss in misses)),
                f"{max(misses):.0e}" if misses else "-",
                spread(ratios) if ratios else "-",
            ]
        )
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="10 m/s only, one start, one cold run")
    parser.add_argument("-o", "--output", type=Path, default=Path("peers"), help="folder for JSON and figure")
    parser.add_argument("--only", nargs="*", default=[], help="contestants whose names hold one of these words")
    parser.add_argument("--core", type=int, help="the core to run on; the last one if not given")
    options = parser.parse_args()
    if hasattr(os, "sched_setaffinity"):  # the contestants inherit it
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0)) if options.core is None else options.core})
    cases = all_cases((10.0,) if options.quick else (6.0, 8.0, 10.0, 12.0, 14.0))
    starts, colds = (1, 1) if options.quick else (3, 3)
    gap = max(model_gap(case) for case in all_cases((10.0,)))
    print(f"The peers' accelerations differ from wingbeat's by at most {gap:.0e} (relative).\n", flush=True)
    assert gap < 1e-10

    results, broken = {}, {}
    for module in MODULES:
        try:
            variants = importlib.import_module(module).VARIANTS
        except ImportError as error:
            broken[module] = str(error)
            continue
        for variant in variants:
            if options.only and variant != REFERENCE and not any(word in variant for word in options.only):
                continue
            if sys.stderr.isatty():
                print(f"\r\033[K{variant}: {len(cases)} cases", end="", file=sys.stderr, flush=True)
            outcome = compete(module, variant, cases, starts, colds)
            (broken if "error" in outcome else results)[variant] = outcome
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    judge(results, cases)
    print(table(results))
    report(results, cases, starts)
    for name, why in broken.items():
        print(f"\nNot run: {name}: {why}")
    versions = {name: importlib.metadata.version(name) for name in PACKAGES if name not in broken}
    versions |= {"python": platform.python_version(), "machine": platform.machine()}
    options.output.mkdir(parents=True, exist_ok=True)
    raw = {"versions": versions, "gap": gap, "results": results, "broken": broken}
    (options.output / "peers.json").write_text(json.dumps(raw, indent=1))
    draw(results, options.output / "peers.png")


def report(results: dict[str, dict], cases: list[Case], starts: int) -> None:
    """Print where the optima agree and, line by line, where they do not."""
    for which, words in (("first", "stock guess"), ("best", f"best of the same {starts} starts")):
        if which == "best" and starts == 1:
            continue
        agree, polished, lines = differences(results, cases, REFERENCE, which)
        total = agree + polished + len(lines)
        print(
            f"\nFrom the {words}, {agree} of {total} optima have wingbeat's frequency within what their closure",
            end="",
        )
        print(f" allows, {polished} once polished, and {len(lines)} are others or were not confirmed:\n")
        print("\n".join(f"- {line}" for line in lines))


if __name__ == "__main__":
    main()
