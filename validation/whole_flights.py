"""Fly animals whose flights were measured, and write one page with a figure for each.

    python validation/whole_flights.py [--draws 0] [--processes 1] [ANIMAL ...]

Flights are kept in ``data/whole_flights``, one file for each animal. Animals that are named are flown anew, the
others only where their file is missing; the page is then written from the files. Without draws, each flight is
flown again at both ends of the range of its frequency.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from pathlib import Path
from statistics import median

from page_script import filled

from wingbeat._base import make_folder, write_atomically
from wingbeat.plots import save_figure
from wingbeat_evidence.whole_flights import Prediction, measured_animals, predict_flights, read_measured_flights
from wingbeat_evidence.whole_flights.comparison import compared, ends_of
from wingbeat_evidence.whole_flights.figure import flights_page
from wingbeat_evidence.whole_flights.page import overview_text

ROOT = Path(__file__).parents[1]
ALCIDS = ("common-murre", "horned-puffin", "tufted-puffin")
FLOWN, DOCS = ROOT / "data" / "whole_flights", ROOT / "docs" / "evidence"


def flown(animal: str, anew: bool, draws: int, processes: int) -> Prediction:
    """Return the flights of an animal, from its file or flown and filed now."""
    measured, file = read_measured_flights(animal), FLOWN / f"{animal}.json"
    if anew or not file.exists():
        begun = time.perf_counter()
        found = predict_flights(measured, draws=draws, processes=processes, frequency_band=True)
        write_atomically(file, json.dumps(found.plain(), indent=1) + "\n")
        print(f"{animal}: flown in {time.perf_counter() - begun:.0f} s", file=sys.stderr, flush=True)
    return Prediction.of_plain(measured, json.loads(file.read_text()))


def main() -> None:
    """Fly the named animals, and write the page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("animals", nargs="*", choices=[[], *measured_animals()])
    parser.add_argument("--draws", type=int, default=0)
    parser.add_argument("--processes", type=int, default=1)
    asked = parser.parse_args()
    make_folder(FLOWN)
    named = asked.animals or []
    rest = [one for one in measured_animals() if one not in named]
    found = [flown(one, one in named, asked.draws, asked.processes) for one in [*named, *rest]]
    found.sort(key=lambda one: one.flights.species)
    figures = [f"flight_{one.flights.species}.png" for one in found]
    for one, figure in zip(found, figures, strict=True):
        save_figure(flights_page(one), DOCS / figure)
    write_atomically(DOCS / "whole_flights.md", overview_text(found, figures, findings(found).strip()))


def findings(found: list[Prediction]) -> str:
    """Return what follows from the comparisons, with its numbers."""
    scores = [(one.flights.species, score) for one in found for score in compared(one)]
    ratios = [(species, one.measurement.quantity, one.ratio) for species, one in scores if one.ratio is not None]
    alcids = [ratio for species, name, ratio in ratios if species in ALCIDS and name == "flap_amplitude_deg"]
    rates = [sum(ratio) / 2 for _, name, ratio in ratios if name == "metabolic_rate"]
    strong = [one.agrees for _, one in scores if one.measurement.quantity == "peak_activation"]
    return filled(
        "whole_flights",
        alcids=ends_of((min(one[0] for one in alcids), max(one[1] for one in alcids))),
        rate=median(rates),
        weak=strong.count(False),
        judged=len(strong),
    )


if __name__ == "__main__":
    main()
