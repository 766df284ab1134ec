"""Birds flown from mass, span and area alone, against the airspeeds that radar measured.

Run as ``python validation/alerstam.py [--data FOLDER] [-o FOLDER] [--tables FOLDER]``; writes alerstam.md and
alerstam.png to one folder, and alerstam_points.csv, alerstam_spread.csv and alerstam.csv to the other.
``--flown FOLDER`` draws and words what an earlier run flew.
"""

from __future__ import annotations

import argparse
import csv
import io
import math
import sys
from pathlib import Path

import alerstam_summary
from alerstam_figure import draw
from alerstam_flights import (
    AIRSPEEDS,
    fly,
    fly_again,
    from_csv,
    problems,
    radar_birds,
    read_rows,
    timed_birds,
    to_csv,
)
from alerstam_spread import Moved, spreads
from alerstam_words import HEAD, conclusions, largest_differences, speeds, spread_table, verdicts

from wingbeat.cli.progress import progress_bar
from wingbeat.errors import WingbeatError
from wingbeat.files import write_atomically
from wingbeat.plots import save_figure

ROOT = Path(__file__).resolve().parents[1]


def main(argv: list[str] | None = None) -> int:
    """Fly, compare, and write tables, page and figure; return the exit code."""
    parser = argparse.ArgumentParser(description="Birds by scaling laws against measured airspeeds.")
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/data", help=f"folder that holds {AIRSPEEDS}")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs", help="folder of page and figure")
    parser.add_argument("--tables", type=Path, default=ROOT / "data", help="folder of the tables")
    parser.add_argument("--flown", type=Path, help="folder of an earlier run's tables, in place of flying")
    parser.add_argument("--processes", type=int, default=2)
    chosen = parser.parse_args(argv)
    try:
        radar, timed = radar_birds(chosen.data), timed_birds(chosen.data)
        if chosen.flown is None:
            with progress_bar("birds, each at a speed") as progress:
                points = fly(problems(radar, timed), chosen.processes, progress)
            with progress_bar("rough curves again") as progress:
                points = fly_again(points, radar, chosen.processes, progress)
            moved = spreads(radar, chosen.processes)
            write_atomically(chosen.tables / "alerstam_points.csv", to_csv(points))
            write_atomically(chosen.tables / "alerstam_spread.csv", _moved_csv(moved))
        # What is drawn and worded is what the files hold, rounded as they are.
        flown = chosen.flown or chosen.tables
        points, moved = from_csv(flown / "alerstam_points.csv"), _read_moved(flown / "alerstam_spread.csv")
        found = alerstam_summary.rows(radar, points)
        head = HEAD.format(
            count=len(found), asked=len(points), points=sum(math.isfinite(point.power) for point in points)
        )
        parts = (
            head,
            speeds(found),
            verdicts(found, points, timed),
            largest_differences(found),
            spread_table(moved),
            conclusions(points),
        )
        write_atomically(chosen.tables / "alerstam.csv", alerstam_summary.to_csv(found))
        write_atomically(chosen.output / "alerstam.md", "".join(parts))
        save_figure(draw(found, timed), chosen.output / "alerstam.png")
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(f"wrote page and figure to {chosen.output}, the tables behind them to {chosen.tables}", file=sys.stderr)
    return 0


def _moved_csv(moved: list[Moved]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(Moved.__dataclass_fields__)
    for row in moved:
        writer.writerow([f"{value:.5g}" if isinstance(value, float) else value for value in vars(row).values()])
    return text.getvalue()


def _read_moved(path: Path) -> list[Moved]:
    rows = [list(row.values()) for row in read_rows(path)]
    return [Moved(species, what, *map(float, numbers)) for species, what, *numbers in rows]


if __name__ == "__main__":
    sys.exit(main())
