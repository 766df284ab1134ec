"""``wingbeat reduce``: load-cell records to a table of coefficients."""

from __future__ import annotations

import dataclasses
import re
import sys
from pathlib import Path
from typing import Annotated

from wingbeat._base import FaultList, FileError, InvalidInputError
from wingbeat.cli.arguments import check_apart, check_outputs, named_numbers, option, several, written_to
from wingbeat.experiment.load_cell_file import read_run
from wingbeat.experiment.load_cell_run import CONSTANT_UNITS, OPTIONAL_UNITS
from wingbeat.experiment.load_cell_setup import ROLES, SETUP_UNITS, LoadCellSetup, load_setup
from wingbeat.experiment.reduction import reduce_runs

MAX_NOTES = 10


def reduce(
    runs: Annotated[
        list[Path], several("Files, one per run at one angle: .csv, LabVIEW's .lvm or .tdms, ATI's logs.")
    ],
    /,
    *,
    output: Annotated[Path, written_to("The table of coefficients: .csv.")],
    last: Annotated[
        float, option("Length of the steady part at the end of each record [s]; only this part is averaged.")
    ] = 20.0,
    rest: Annotated[
        list[str] | None, several("When the fluid is at rest [s], such as 0:5 35:40; the zero is the mean there.")
    ] = None,
    channels: Annotated[
        list[str] | None,
        several("The file's channels, as normal=Fz,tangential=-Fx,moment=Ty,alpha=NAME; or a TOML with the setup."),
    ] = None,
    alpha_deg: Annotated[
        list[float] | None, several("Angle of attack [deg] if no channel has it: of all runs, or of each in turn.")
    ] = None,
    tare: Annotated[
        list[Path] | None, several("Record with the fluid at rest; or two, before and after the runs.")
    ] = None,
    set_: Annotated[
        list[str] | None, several("Constants the files lack, such as speed=0.4 density=998 chord=0.076.", "--set")
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

    Files of LabVIEW and ATI have other names: --channels says which channel is which (-Fz reverses a sign, and
    'Ty [N mm]' states a unit), --set gives speed, density, viscosity, chord, span, and if needed thickness,
    channel_width, sample_rate [Hz] and moment_axis (how far the axis of the moment is behind mid-chord [m]). A TOML
    may hold all of it: a table channels, the constants, alpha_deg, tare and rest. Units that a file states are
    converted, and a note says so.

    Examples: wingbeat reduce run*.csv -o coefficients.csv --last 20;
    wingbeat reduce run*.csv -o coefficients.csv --rest 0:5 35:40;
    wingbeat reduce run.lvm -o coefficients.csv --channels normal=Fz,tangential=Fx,moment=Ty --alpha-deg 20
    --tare still.lvm --set speed=0.4 density=998 viscosity=1e-6 chord=0.076 span=0.456
    """
    faults = FaultList()
    if output.suffix.lower() != ".csv":
        faults.add("--output", str(output), "is not a table", "end it in .csv")
    faults.number("--last", last, above=0, unit="s")
    if not runs:
        faults.add("RUNS", "none", "there is nothing to reduce", "name the CSV files of the runs")
    check_apart(faults, [("--output", output)], *runs, *(tare or ()), *(channels or ()))
    spans = []
    for text in rest or []:
        try:
            start, end = map(float, text.split(":"))
            spans.append((start, end))
        except ValueError:
            faults.add("--rest", text, "is not an interval", "write start:end in seconds, such as 0:5")
    setup, in_toml = _setup(faults, channels, set_, tare)
    if in_toml and spans:
        faults.add("--rest", " ".join(rest or []), "is stated in the TOML too", "keep one")
    spans = spans or list(in_toml)
    angles = alpha_deg or []
    if len(angles) not in (0, 1, len(runs)):
        rule = f"are {len(angles)} angles for {len(runs)} runs"
        faults.add("--alpha-deg", " ".join(f"{angle:g}" for angle in angles), rule, "give one, or one for each run")
    faults.raise_if_any()
    check_outputs(output)
    if angles and setup is None:
        setup = LoadCellSetup()
    records, unreadable = [], []
    for i, path in enumerate(runs):  # the faults of all files are reported at once
        try:
            own = setup
            if setup is not None and angles:
                own = dataclasses.replace(setup, alpha_deg=angles[i if len(angles) > 1 else 0])
            records.append(read_run(path, own))
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


def _setup(
    faults: FaultList, channels: list[str] | None, constants: list[str] | None, tare: list[Path] | None
) -> tuple[LoadCellSetup | None, tuple[tuple[float, float], ...]]:
    """Return what options and a TOML say about the files, and the rest in it; None if they say nothing."""
    if channels is None and constants is None and tare is None:
        return None, ()
    setup, spans = LoadCellSetup(), ()
    named: dict[str, str] = {}
    tomls = [word for word in channels or [] if "=" not in word and word.lower().endswith(".toml")]
    if len(tomls) > 1:
        faults.add("--channels", " ".join(tomls), "are several TOMLs", "keep one, with all of the setup")
    elif tomls:
        setup, spans = load_setup(tomls[0])
    for word in channels or []:
        if word in tomls:
            continue
        for part in re.split(rf",(?=\s*(?:{'|'.join(ROLES)})\s*=)", word):
            role, equals, name = part.partition("=")
            if not equals:
                fix = "such as normal=Fz,tangential=Fx,moment=Ty, or the name of a .toml file"
                faults.add("--channels", part, "must be ROLE=NAME", fix)
            elif role.strip() in named:
                faults.add("--channels", part, "is given twice", "keep one")
            named[role.strip()] = name.strip()
    known = (*CONSTANT_UNITS, *OPTIONAL_UNITS, *SETUP_UNITS)
    example = "--set speed=0.4 density=998 viscosity=1e-6"
    numbers = named_numbers(faults, "--set", constants, known, example)
    if faults.faults:
        return None, spans
    try:
        return (
            dataclasses.replace(
                setup,
                channels={**setup.channels, **LoadCellSetup(named).channels},
                constants={**setup.constants, **numbers},
                tare=tuple(tare) if tare else setup.tare,
            ),
            spans,
        )
    except InvalidInputError as error:
        faults.faults.extend(error.faults)
        return None, spans
