"""Make a Markdown page from the results of `objectives.py`: bettered optima, then doubtful ones, then the rest."""

from __future__ import annotations

import argparse
import json
import re
from pathlib import Path

from objectives import BETTER

from wingbeat.orbits.problem.quantities import named_quantity

HEAD = (
    "animal",
    "m/s",
    "minimised",
    "limit",
    "value",
    "bettered by, %",
    "best restart",
    "restarts: optima / as good",
    "IPOPT, certified",
    "IPOPT's own minimum",
    "s",
)


def line(row: dict) -> str:
    """Return the row of the table."""
    first = row["animal"], f"{row['speed']:g}", row["minimise"], _with_unit(row["limit"]) or "-"
    if row["status"] != "converged":
        return "| " + " | ".join((*first, row["status"], *["-"] * 6)) + " |"
    restarts = row["by_restarts"]
    certified = [f["certified"] for f in row["by_ipopt"] if f["certified"] is not None]
    own = [f["own"] for f in row["by_ipopt"] if f["success"]]
    rest = (
        f"{row['objective']:.5g} {row['unit']}",
        f"{100 * row['lower_by']:z.2f}",
        _shown(restarts["least"]),
        f"{restarts['ended_in_an_optimum']} / {restarts.get('as_good', '-')}",
        f"{_shown(min(certified, default=None))} ({len(certified)} of {len(row['by_ipopt'])})",
        _shown(min(own, default=None)),
        f"{row['seconds']['all']:.0f}",
    )
    return "| " + " | ".join((*first, *rest)) + " |"


def _with_unit(limit: str) -> str:
    """Return a limit with the unit of its quantity, such as ``frequency=12 Hz``."""
    name = re.match(r"\w+", limit)
    if name is None or limit.endswith(" deg"):
        return limit
    unit = named_quantity(name[0]).unit
    return limit if unit == "1" else f"{limit} {unit}"


def _shown(value: float | None) -> str:
    return "none" if value is None else f"{value:.5g}"


def doubtful(row: dict) -> bool:
    """Return whether a lower value was found but not certified, or nothing was certified at all."""
    if row["status"] != "converged":
        return True
    least = row["objective"] - BETTER * abs(row["objective"])
    own = [f["own"] for f in row["by_ipopt"] if f["success"] and f["certified"] is None]
    rival = row["by_restarts"]["least_uncertified"]
    uncertified = row["by_restarts"]["not_certified"] > 0 and rival is not None and rival < least
    return uncertified or any(value < least for value in own)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("found", nargs="+", type=Path)
    given = arguments.parse_args()
    rows = {}
    for path in given.found:
        for text in path.read_text().splitlines():
            row = json.loads(text)
            rows[row["animal"], row["speed"], row["minimise"], row["limit"]] = row
    bettered = [r for r in rows.values() if r.get("lower_by", 0.0) > BETTER]
    doubts = [r for r in rows.values() if r not in bettered and doubtful(r)]
    others = [r for r in rows.values() if r not in bettered and r not in doubts]
    seconds = sum(row["seconds"]["all"] for row in rows.values())
    print(f"{len(rows)} problems, {len(bettered)} bettered, {len(doubts)} in doubt; {seconds / 60:.0f} minutes.\n")
    for title, some in (("Bettered", bettered), ("In doubt", doubts), ("Not bettered", others)):
        print(f"### {title}\n")
        if some:
            print("| " + " | ".join(HEAD) + " |\n" + "| --- " * len(HEAD) + "|")
            print("\n".join(line(row) for row in some), end="\n\n")
        else:
            print("None.\n")


if __name__ == "__main__":
    main()
