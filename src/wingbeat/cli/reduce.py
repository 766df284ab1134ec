"""``wingbeat reduce``: load-cell records to a table of coefficients."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from wingbeat._base import FaultList, FileError, InvalidInputError
from wingbeat.cli.arguments import check_outputs, option, several, written_to
from wingbeat.experiment.load_cell_run import read_run
from wingbeat.experiment.reduction import reduce_runs

MAX_NOTES = 10


def reduce(
    runs: Annotated[list[Path], several("CSV files, one per run; each run is at one angle.")],
    /,
    *,
    output: Annotated[Path, written_to("The table of coefficients: .csv.")],
    last: Annotated[
        float, option("Length of the steady part at the end of each record [s]; only this part is averaged.")
    ] = 20.0,
    rest: Annotated[
        list[str] | None, several("When the fluid is at rest [s], such as 0:5 35:40; the zero is the mean there.")
    ] = None,
) -> None:
    """Turn load-cell records into coefficients with errors; repeated runs of one point are pooled.

    A record has the columns time [s], normal_force [N], tangential_force [N], moment [N m] (about mid-chord,
    nose-up positive) and alpha_deg. Lines above them, such as "# speed = ...", give speed, density, viscosity
    (kinematic), chord and span in SI units. Thickness and channel_width are optional. Readings in still fluid
    before and after the run are optional, too: "# tare_normal_force = before, after" and so on. Between these two
    readings the zero is taken to drift linearly, and is subtracted. If the records themselves begin or end at rest,
    --rest gives the zero instead, and the steady part ends where the last rest begins. Coefficients that no plate
    has are refused, such as those of forces in mN.

    Examples: wingbeat reduce run*.csv -o coefficients.csv --last 20;
    wingbeat reduce run*.csv -o coefficients.csv --rest 0:5 35:40
    """
    faults = FaultList()
    if output.suffix.lower() != ".csv":
        faults.add("--output", str(output), "is not a table", "end it in .csv")
    faults.number("--last", last, above=0, unit="s")
    if not runs:
        faults.add("RUNS", "none", "there is nothing to reduce", "name the CSV files of the runs")
    if output in runs:
        faults.add("--output", str(output), "is one of the runs", "choose another name")
    spans = []
    for text in rest or []:
        try:
            start, end = map(float, text.split(":"))
            spans.append((start, end))
        except ValueError:
            faults.add("--rest", text, "is not an interval", "write start:end in seconds, such as 0:5")
    faults.raise_if_any()
    check_outputs(output)
    records, unreadable = [], []
    for path in runs:  # the faults of all files are reported at once
        try:
            records.append(read_run(path))
        except InvalidInputError as error:
            faults.faults.extend(error.faults)
        except FileError as error:
            unreadable.append(str(error))
    if unreadable:
        raise FileError("\n".join([*unreadable, *(str(fault) for fault in faults.faults)]))
    faults.raise_if_any()
    table = reduce_runs(records, last, spans)
    for note in table.notes[:MAX_NOTES]:
        print(f"note: {note}", file=sys.stderr)
    table.save(output)
    if len(table.notes) > MAX_NOTES:
        print(f"note: {len(table.notes) - MAX_NOTES} more notes are in {output}", file=sys.stderr)
    print(f"wrote {output}: {len(runs)} runs, {len(table.alpha_deg)} points", file=sys.stderr)
