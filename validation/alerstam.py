"""Birds flown from mass, span and area alone, against the airspeeds that radar measured.

Run as ``python validation/alerstam.py [--data FOLDER] [-o FOLDER] [--tables FOLDER]``; writes alerstam.md and
alerstam.png to one folder, and alerstam_points.csv, alerstam_spread.csv and alerstam.csv to the other.
``--models animal`` flies by one model and keeps what the tables hold of the other. The folder ``--store`` keeps
each bird that the model `animal` has flown; the same command goes on where it was stopped. ``--flown FOLDER`` draws
and words what an earlier run flew.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import alerstam_summary
from alerstam_animal import fly_in_order, fly_timed
from alerstam_figure import draw
from alerstam_flights import (
    AIRSPEEDS,
    ANIMAL,
    PAPER,
    Bird,
    Point,
    csv_of,
    fly,
    fly_again,
    from_csv,
    problems,
    radar_birds,
    read_rows,
    timed_birds,
)
from alerstam_spread import Moved, spreads
from alerstam_words import page

from wingbeat._base import WingbeatError, write_atomically
from wingbeat.cli.terminal import progress_bar
from wingbeat.models import MODELS
from wingbeat.plots import save_figure

ROOT = Path(__file__).resolve().parents[1]


def main(argv: list[str] | None = None) -> int:
    """Fly, compare, and write tables, page and figure; return the exit code."""
    parser = argparse.ArgumentParser(description="Birds by scaling laws against measured airspeeds.")
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/data", help=f"folder that holds {AIRSPEEDS}")
    parser.add_argument(
        "-o", "--output", type=Path, default=ROOT / "docs" / "evidence", help="folder of page and figure"
    )
    parser.add_argument("--tables", type=Path, default=ROOT / "data", help="folder of the tables")
    parser.add_argument("--flown", type=Path, help="folder of an earlier run's tables, in place of flying")
    parser.add_argument("--models", nargs="+", choices=MODELS, default=MODELS, help="models to fly by")
    parser.add_argument(
        "--store", type=Path, default=ROOT / "alerstam_birds", help="folder of the birds flown by `animal`"
    )
    parser.add_argument("--processes", type=int, default=2, help="that fly by the model `paper`")
    chosen = parser.parse_args(argv)
    try:
        radar, timed = radar_birds(chosen.data), timed_birds(chosen.data)
        if chosen.flown is None:
            _fly(chosen, radar, timed)
        # What is drawn and worded is what the files hold, rounded as they are.
        flown = chosen.flown or chosen.tables
        points, moved = from_csv(flown / "alerstam_points.csv"), _read_moved(flown / "alerstam_spread.csv")
        found = alerstam_summary.rows(radar, points)
        write_atomically(chosen.tables / "alerstam.csv", csv_of(alerstam_summary.Row, found, 4))
        write_atomically(chosen.output / "alerstam.md", page(found, points, timed, moved))
        save_figure(draw(found, timed), chosen.output / "alerstam.png")
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(f"wrote page and figure to {chosen.output}, the tables behind them to {chosen.tables}", file=sys.stderr)
    return 0


def _fly(chosen: argparse.Namespace, radar: list[Bird], timed: list[Bird]) -> None:
    """Fly by the chosen models; write the tables of all orbits and of changed numbers."""
    table = chosen.tables / "alerstam_points.csv"
    before = from_csv(table) if set(chosen.models) != set(MODELS) else []
    points: list[Point] = [point for point in before if point.model not in chosen.models]
    if PAPER in chosen.models:
        with progress_bar("birds, each at a speed") as progress:
            own = fly(problems(radar, timed), chosen.processes, progress)
        with progress_bar("rough curves again") as progress:
            points += fly_again(own, radar, chosen.processes, progress)
        moved = csv_of(Moved, spreads(radar, chosen.processes), 5)
        write_atomically(chosen.tables / "alerstam_spread.csv", moved)
    if ANIMAL in chosen.models:
        with progress_bar("birds by the model animal") as progress:
            points += fly_in_order(radar, chosen.store, progress)
        points += fly_timed(timed, chosen.store)
    write_atomically(table, csv_of(Point, sorted(points, key=lambda point: MODELS.index(point.model)), 6))


def _read_moved(path: Path) -> list[Moved]:
    rows = [list(row.values()) for row in read_rows(path)]
    return [Moved(species, what, *map(float, numbers)) for species, what, *numbers in rows]


if __name__ == "__main__":
    sys.exit(main())
