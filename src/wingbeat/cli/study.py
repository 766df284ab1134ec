"""``wingbeat study``: run a study, print its status, export its table, draw its figure."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from cyclopts import App, Parameter, Token

from wingbeat._base import FaultList, suggest
from wingbeat.cli.arguments import Whole, check_outputs, flag, option, several, written_to
from wingbeat.cli.process import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.terminal import FIRST_POINT, duration, exit_of, pace, print_report, say, say_stopping, study_bar

if TYPE_CHECKING:
    from wingbeat.studies.study import Study

study = App(name="study", help="Solve a grid or sample of problems; an interrupted study resumes.")

# Letters of a line: reasons are not broken, so that programs can search them.
_WIDE = 10_000

# What may follow the word `study` in place of a file.
_COMMANDS = ("run", "status", "export", "plot", "front", "salvage")


def _file(kind: Any, tokens: Sequence[Token]) -> Path:
    """Return the path that was given, unless it is a mistyped subcommand."""
    word = tokens[0].value
    if word.isalpha() and not Path(word).exists():
        faults = FaultList()
        faults.add("study", word, "is neither a file nor a subcommand", suggest(word, _COMMANDS))
        faults.raise_if_any()
    return Path(word)


File = Annotated[Path, option("The study file, .toml; its store is beside it.")]
Written = Annotated[Path | None, written_to("The file to write.")]


@study.default
@study.command(name="run")
def run(
    file: Annotated[File, Parameter(converter=_file)],
    *,
    processes: Annotated[
        Whole | None, option("Worker processes; default: as many as cores.", "--processes", "-j")
    ] = None,
    timeout: Annotated[float, option("Time limit for each point [s].")] = 600.0,
    dask: Annotated[
        str | None,
        Parameter(help="A Dask cluster instead of processes: tcp://HOST:PORT, or local:N.", show_default=False),
    ] = None,
    retry_failed: Annotated[bool, flag("Retry failed points: errors, crashes, time-outs.")] = False,
    allow_failures: Annotated[bool, flag("Exit with 0 even if points are not certified.")] = False,
) -> int:
    """Solve all points that have no result yet, and keep every result in the store beside the file.

    Ctrl-C waits one second, saves the points that finish in that time, and stops; run the study again to resume.
    Exit codes: 0 all points certified, 2 bad input, 3 some points not certified, 130 interrupted, 143 terminated.
    Then: wingbeat study status FILE; study export FILE -o table.csv; study plot FILE -o figure.png

    Examples: wingbeat study designs.toml; wingbeat study run designs.toml --processes 8 --retry-failed;
    wingbeat study run designs.toml --dask tcp://login1:8786
    """
    from wingbeat.studies.stopping import listening
    from wingbeat.studies.study import check_run, engine_for, points_wait
    from wingbeat.studies.units import FAILED

    check_run(processes, timeout, dask)
    asked = _read(file)
    summary = asked.prepare()
    left = summary.count("waiting", *(FAILED if retry_failed else ()))
    engine = engine_for(processes, timeout, dask, say)
    with listening(say_stopping) as stop:
        say(_announcement(asked, summary.total, left, engine.workers))
        with study_bar() as progress:
            tally = asked.run_on(engine, stop, retry_failed, progress)
        none = "no point was solved" if tally.count("waiting") else "nothing left to solve"
        say(f"{tally.here} points solved, {pace(tally.rate)}" if tally.here else none)
    print(asked.summary(_WIDE))
    if stop.level:
        say(f"{points_wait(asked.status())}; to resume: wingbeat study run {shlex.quote(str(file))}")
        return exit_of(stop)
    return EXIT_GOOD if tally.certified == tally.total or allow_failures else EXIT_NOT_CERTIFIED


@study.command
def status(file: File) -> None:
    """Print the number of points with each status, and why points have no certified orbit."""
    print(_read(file).summary(_WIDE))


@study.command
def export(file: File, *, output: Written = None) -> None:
    """Write a table with a row for each point: .nc, .csv or .parquet; columns are the record's dotted names."""
    from wingbeat.studies.table import check_table_name

    with _written(output, check_table_name, "table.csv, table.nc or table.parquet") as path:
        _read(file).export(path)


@study.command
def plot(
    file: File,
    *,
    output: Written = None,
    quantity: Annotated[
        str | None, option("Column of the table to draw, such as mean_power; default: the minimised quantity.")
    ] = None,
) -> None:
    """Draw a result against the varied parameters: lines for one, maps for two, parallel axes for more of them."""
    from wingbeat.plots import check_figure_name, save_figure, study_page

    with _written(output, check_figure_name, "figure.png, .pdf or .svg") as path:
        save_figure(study_page(*_read(file).drawing(quantity)), path)


@study.command
def front(
    file: File,
    *,
    best: Annotated[
        list[str],
        several("Wanted quantities, each with the end that is best: speed=max electrical_power=min payload=max."),
    ],
    output: Annotated[Path | None, written_to("A table of the front: .nc, .csv or .parquet.")] = None,
) -> int:
    """Print the Pareto front: the certified points that no other point beats in every wanted quantity.

    Any column of the table can be wanted, and mass, the whole mass. Exit codes: 0; 3, no point is certified.

    Examples: wingbeat study front designs.toml --best speed=max electrical_power=min payload=max
    """
    from wingbeat.studies.front import front_report
    from wingbeat.studies.table import check_table_name, save_table, varied_numbers

    faults = FaultList()
    wanted: dict[str, str] = {}
    for text in best:
        name, sign, way = text.partition("=")
        if not sign or name in wanted:
            rule = "is given twice" if sign else "must be NAME=min or NAME=max"
            faults.add("--best", text, rule, "for example speed=max electrical_power=min")
        wanted[name] = way
    if output is not None:
        check_table_name(faults, "--output", output)
    faults.raise_if_any()
    check_outputs(output)
    asked = _read(file)
    found = asked.front(wanted)
    print_report(front_report(found, wanted, varied_numbers(found, asked.plan.paths)))
    if output is not None:
        save_table(found, asked._about(), output)
        print(f"wrote {output}", file=sys.stderr)
    return EXIT_NOT_CERTIFIED if found.empty else EXIT_GOOD


@study.command
def salvage(file: File) -> None:
    """Rebuild a damaged store from every intact result in it; run the study to solve the rest again.

    The damaged store is renamed; nothing is deleted. An undamaged store is not changed.
    """
    asked = _read(file)
    kept, aside = asked.salvage()
    if aside is None:
        print(f"the store {str(asked.store)!r} is not damaged; nothing was changed", file=sys.stderr)
    else:
        print(f"{kept} results kept; the damaged store was renamed to {str(aside)!r}", file=sys.stderr)
    print(asked.summary(_WIDE))


@contextmanager
def _written(
    output: Path | None, check_name: Callable[[FaultList, str, Path], None], examples: str
) -> Iterator[Path]:
    """Yield the file to write, after a check that it can be written; print its name after the block."""
    faults = FaultList()
    if output is None:
        faults.add("--output", None, "is missing", f"give a file: -o {examples}")
    else:
        check_name(faults, "--output", output)
    faults.raise_if_any()
    assert output is not None
    check_outputs(output)
    yield output
    print(f"wrote {output}", file=sys.stderr)


def _read(file: Path) -> Study:
    from wingbeat.studies.study import plan_study

    return plan_study(file)


def _announcement(asked: Study, total: int, left: int, processes: int) -> str:
    """Return how many points there are, how many of them will be solved, and how long that will take if known."""
    seconds = asked.estimate(processes, left) if left else 0.0
    many = "processes" if processes > 1 else "process"
    told = f"{total} points, {left} to solve"
    if seconds is None:
        return f"{told} with {processes} {many}; {FIRST_POINT}"
    return f"{told}: about {duration(seconds)} with {processes} {many}" if left else told
