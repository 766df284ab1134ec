"""Make a table (.csv) from the results of `objectives.py`, and print what matters of it for the page."""

from __future__ import annotations

import argparse
import csv
import json
import re
from pathlib import Path

from objectives import BETTER

from wingbeat.orbits.problem.quantities import named_quantity

TABLE = Path(__file__).parents[1] / "data" / "objectives.csv"
FEW = 2  # restarts that are as good as the best; another seed may then find a better optimum


def entry(row: dict) -> dict[str, str]:
    """Return the row of the table; a problem without an orbit has only its status."""
    first = {"animal": row["animal"], "speed": f"{row['speed']:g}", "minimised": row["minimise"]}
    first |= {"limit": _with_unit(row["limit"]), "status": row["status"]}
    if row["status"] != "converged":
        return first
    restarts = row["by_restarts"]
    certified = [f["certified"] for f in row["by_ipopt"] if f["certified"] is not None]
    own = [f["own"] for f in row["by_ipopt"] if f["success"]]
    return first | {
        "value": f"{row['objective']:.5g}",
        "unit": row["unit"],
        "bettered_by_percent": f"{100 * row['lower_by']:z.2f}",
        "best_restart": _shown(restarts["least"]),
        "restarts_in_an_optimum": str(restarts["ended_in_an_optimum"]),
        "restarts_as_good": str(restarts.get("as_good", "")),
        "ipopt_certified": _shown(min(certified, default=None)),
        "ipopt_certified_count": str(len(certified)),
        "ipopt_count": str(len(row["by_ipopt"])),
        "ipopt_own_minimum": _shown(min(own, default=None)),
        "seconds": f"{row['seconds']['all']:.0f}",
    }


def _with_unit(limit: str) -> str:
    """Return a limit with the unit of its quantity, such as ``frequency=12 Hz``."""
    name = re.match(r"\w+", limit)
    if name is None or limit.endswith(" deg"):
        return limit
    unit = named_quantity(name[0]).unit
    return limit if unit == "1" else f"{limit} {unit}"


def _shown(value: float | None) -> str:
    return "" if value is None else f"{value:.5g}"


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
    """Write the table, and print the problems that are bettered, in doubt or found by few restarts."""
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
    entries = [entry(row) for row in rows.values()]
    with TABLE.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, max(entries, key=len), restval="", lineterminator="\n")
        writer.writeheader()
        writer.writerows(entries)
    seconds = sum(row["seconds"]["all"] for row in rows.values())
    print(f"{len(rows)} problems, {len(bettered)} bettered, {len(doubts)} in doubt; {seconds / 60:.0f} minutes.")
    few = [one for one in entries if 0 < int(one.get("restarts_as_good") or 0) <= FEW]
    for title, some in (("bettered", bettered), ("in doubt", doubts), ("found by few restarts", few)):
        for one in some:
            print(f"{title}: {one if one in few else entry(one)}")


if __name__ == "__main__":
    main()
