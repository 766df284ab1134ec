"""One contestant in a process of its own: solves the cases, times itself and writes what it found as JSON."""

from __future__ import annotations

import importlib
import json
import sys
import time
from pathlib import Path

import numpy as np
from cases import Answer, Case, Solve

from wingbeat.orbits.starts import start_point

ATTEMPTS = 6  # starts that a contestant may try where the first ones fail
REPEATS, LONG = 3, 3.0  # a case that takes longer [s] than LONG is timed once


def attempt(solve: Solve, case: Case) -> tuple[Answer, int]:
    """Solve from the stock guess and, as long as that fails, from the further starts; return how many it took."""
    problem = case.problem()
    for index in range(ATTEMPTS):
        answer = solve(problem, start_point(problem, index, 0))
        if answer.success:
            break
    return answer, index + 1


def best_of(solve: Solve, case: Case, starts: int) -> Answer:
    """Return the best optimum from the first `starts` starts."""
    problem = case.problem()
    answers = [solve(problem, start_point(problem, index, 0)) for index in range(starts)]
    return min(answers, key=lambda answer: (not answer.success, answer.unknowns[4]))


def found(answer: Answer) -> dict:
    """Return an answer as JSON has it."""
    return {"unknowns": np.asarray(answer.unknowns).tolist(), "success": bool(answer.success)}


def run(module_name: str, variant: str, cases: list[Case], starts: int, cold_only: bool, begun: float) -> dict:
    """Time the first case from nothing, then every case once all that can be used again is built."""
    cases[0].problem()
    read = time.time() - begun  # what only wingbeat must import: the others read their cases from it
    module = importlib.import_module(module_name)
    solvers: dict[tuple[str, str], Solve] = {}
    outcome: dict = {"builds": [], "cases": []}
    for case in cases:
        pair = case.animal, case.model
        if pair not in solvers:
            clock = time.perf_counter()
            solvers[pair] = module.VARIANTS[variant](case.problem())
            # Not in the warm times: some put off part of the building until they first solve.
            if cold_only or getattr(module, "BUILDS", True):
                attempt(solvers[pair], case)
            outcome["builds"].append(time.perf_counter() - clock)
            if cold_only:
                outcome["cold"] = time.time() - begun - (0.0 if module_name == "by_wingbeat" else read)
        if cold_only:
            break
        seconds: list[float] = []
        while len(seconds) < REPEATS and not (seconds and seconds[0] > LONG):
            clock = time.perf_counter()
            answer, tried = attempt(solvers[pair], case)
            seconds.append(time.perf_counter() - clock)
        entry = {"case": str(case), "seconds": seconds, "tried": tried, "first": found(answer)}
        entry["best"] = entry["first"]
        if starts > 1:
            many = getattr(module, "best", None)
            better = many(case.problem(), starts) if many else best_of(solvers[pair], case, starts)
            entry["best"] = found(min(answer, better, key=lambda a: (not a.success, a.unknowns[4])))
        outcome["cases"].append(entry)
        print(json.dumps({"case": str(case), "seconds": seconds[0]}), file=sys.stderr, flush=True)
    return outcome


if __name__ == "__main__":
    job = json.loads(Path(sys.argv[1]).read_text())
    all_cases = [Case(*parts) for parts in job["cases"]]
    outcome = run(job["module"], job["variant"], all_cases, job["starts"], job["cold_only"], float(sys.argv[3]))
    Path(sys.argv[2]).write_text(json.dumps(outcome))
