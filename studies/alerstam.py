"""Birds flown from mass, span and area alone, against the airspeeds that radar measured.

Run as ``python studies/alerstam.py [--data FOLDER] [-o FOLDER]``; writes alerstam_points.csv, alerstam.csv,
alerstam.md and alerstam.png. ``--points FILE`` draws and words what an earlier run flew.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from alerstam_flights import fly, from_csv, problems, radar_birds, timed_birds, to_csv

from wingbeat.cli.progress import progress_bar
from wingbeat.errors import WingbeatError
from wingbeat.files import write_atomically

ROOT = Path(__file__).resolve().parents[1]


def main(argv: list[str] | None = None) -> int:
    """Fly, compare, and write table, page and figure; return the exit code."""
    parser = argparse.ArgumentParser(description="Birds by scaling laws against measured airspeeds.")
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/data", help="folder of the CSV files")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs", help="folder to write to")
    parser.add_argument("--points", type=Path, help="alerstam_points.csv of an earlier run, in place of flying")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--birds", type=int, help="fly the first few only")
    chosen = parser.parse_args(argv)
    try:
        radar, timed = radar_birds(chosen.data)[: chosen.birds], timed_birds(chosen.data)
        if chosen.points:
            points = from_csv(chosen.points)
        else:
            with progress_bar("birds at a speed") as progress:
                points = fly(problems(radar, timed), chosen.processes, progress)
            write_atomically(chosen.output / "alerstam_points.csv", to_csv(points))
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(
        f"wrote alerstam_points.csv, alerstam.csv, alerstam.md and alerstam.png to {chosen.output}", file=sys.stderr
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
