"""``wingbeat validate ANIMAL``: whole flights predicted, and compared with measured ones."""

from __future__ import annotations

import json as json_format
from pathlib import Path
from typing import Any

from wingbeat._base import FaultList, FileError, read_text, toml_tables, write_atomically
from wingbeat._workers.tuning import core_count
from wingbeat.animal.species.making import load_species
from wingbeat.cli.arguments import check_outputs
from wingbeat.cli.process import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.terminal import answer, print_report, progress_bar
from wingbeat.plots.figure_files import save_figure
from wingbeat_evidence.whole_flights import (
    Prediction,
    compared,
    measured_animals,
    predict_flights,
    read_measured_flights,
)
from wingbeat_evidence.whole_flights.figure import flights_page
from wingbeat_evidence.whole_flights.page import flight_text
from wingbeat_evidence.whole_flights.report import prediction_report

# So many draws are worth the start of another process.
_WORTH_A_PROCESS = 200


def is_whole_flights(case: str) -> bool:
    """Say whether a case of `wingbeat validate` is an animal, or a file of its measured flights."""
    if case in measured_animals():
        return True
    try:
        return "measured" in toml_tables(read_text(case), case)
    except FileError:
        return False


def validate_flights(
    case: str, model: str, draws: int, seed: int, json: bool, plot: Path | None, output: Path | None
) -> int:
    """Fly an animal at its measured speeds and print, draw or write the comparison."""
    faults = FaultList()
    faults.choice("--model", model, ("paper", "animal"))
    faults.raise_if_any()
    picture = None if output is None else output.with_suffix(".png")
    check_outputs(output, plot, *([] if picture is None else [picture]))
    flights = read_measured_flights(case)
    processes = max(1, min(core_count(), draws // _WORTH_A_PROCESS))
    with progress_bar("flights") as progress:
        found = predict_flights(flights, model, draws, seed, processes, progress)
    with answer() as given:
        if json:
            given.show(lambda: print(json_format.dumps(plain_flights(found), indent=2, allow_nan=False)))
        else:
            given.show(lambda: print_report(prediction_report(found)))
        given.save(plot, lambda path: save_figure(flights_page(found), path), named=True)
        if output is not None and picture is not None:
            name = load_species(flights.species).common_name
            text = flight_text(found, picture.name, name or flights.species)
            given.save(output, lambda path: write_atomically(path, text), named=True)
            given.save(picture, lambda path: save_figure(flights_page(found), path), named=True)
    return EXIT_GOOD if any(one.values for one in found.flown) else EXIT_NOT_CERTIFIED


def plain_flights(found: Prediction) -> dict[str, Any]:
    """Return a prediction and its comparison as plain values, fit for JSON.

    Parameters
    ----------
    found : from `predict_flights`.
    """
    scores = [vars(score) | {"measurement": vars(score.measurement)} for score in compared(found)]
    about = {"species": found.flights.species, "minimum_power_speed": found.minimum_power_speed}
    return about | found.plain() | {"compared": scores}
