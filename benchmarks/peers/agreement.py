"""Whether the optima agree: each is flown again, and what differs is polished to see if it is an optimum too."""

from __future__ import annotations

import by_scipy
import numpy as np
from cases import Case
from referee import refly

# A discretised orbit that misses closure by so much may have its frequency off by a twentieth of that.
RELATIVE, PER_MISS, AT_MOST = 1e-6, 0.05, 1e-3
CONFIRMED = 1e-5  # miss of a polished optimum


def judge(results: dict[str, dict], cases: list[Case]) -> None:
    """Add miss and path violation to every answer: the referee's, whoever found it."""
    by_name = {str(case): case.problem() for case in cases}
    for result in results.values():
        for entry in result["cases"]:
            for answer in (entry["first"], entry["best"]):
                if "miss" not in answer:
                    miss = refly(by_name[entry["case"]], np.array(answer["unknowns"]))
                    answer["miss"], answer["beyond_path"] = miss


def same(a: dict, b: dict) -> bool:
    """Say whether two answers' frequencies agree within what their closures allow."""
    here, there = a["unknowns"][4], b["unknowns"][4]
    return abs(here - there) <= min(RELATIVE + PER_MISS * (a["miss"] + b["miss"]), AT_MOST) * there


def polish(case: Case, answer: dict) -> dict:
    """Return the optimum that tight shooting finds from an answer."""
    problem = case.problem()
    found = by_scipy.build(problem, rtol=1e-10, ftol=1e-8)(problem, np.array(answer["unknowns"]))
    miss, beyond = refly(problem, found.unknowns)
    return {"unknowns": found.unknowns.tolist(), "success": found.success, "miss": miss, "beyond_path": beyond}


def differences(
    results: dict[str, dict], cases: list[Case], reference: str, which: str
) -> tuple[int, int, list[str]]:
    """Return how many agree with the reference, how many once polished, and a line for each that does not.

    `which` is "first", the answers from the stock guess, or "best", those from several starts.
    """
    agree = polished = 0
    lines = []
    for i, case in enumerate(cases):
        mine, known = results[reference]["cases"][i][which], []
        for name, result in results.items():
            answer = result["cases"][i][which]
            if name == reference or not answer["success"]:
                continue
            if same(answer, mine):
                agree += 1
                continue
            true = next((k for k in known if same(answer, k)), None)
            if true is None:
                true = polish(case, answer)
                known.append(true)
            answer["polished"] = true
            if same(true, mine):
                polished += 1
                continue
            confirmed = true["success"] and true["miss"] <= CONFIRMED
            side = "lower" if true["unknowns"][4] < mine["unknowns"][4] else "higher"
            lines.append(
                f"{case}: {name} {answer['unknowns'][4]:.5f} Hz (closes to {answer['miss']:.0e}), {reference} "
                f"{mine['unknowns'][4]:.5f} Hz; polished {true['unknowns'][4]:.5f} Hz, {side}: "
                + ("another optimum" if confirmed else "not confirmed")
            )
    return agree, polished, lines
