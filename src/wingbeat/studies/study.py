"""A study in Python: how to plan it, run it and read its results."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextlib import closing, contextmanager
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from wingbeat._base import (
    Block,
    Fault,
    FaultList,
    FileError,
    InvalidInputError,
    Line,
    Report,
    Reported,
    Row,
    Table,
    in_words,
    label_of,
    plain_unit,
    read_text,
    toml_tables,
)
from wingbeat._workers.tuning import core_count
from wingbeat.animal.species.numbers import shown
from wingbeat.orbits.batch import check_processes
from wingbeat.plots.draw_study import study_page
from wingbeat.results.orbit import Orbit
from wingbeat.studies.driver import Progress, Tally, drive
from wingbeat.studies.engine import Engine, LocalProcesses
from wingbeat.studies.form import check_form
from wingbeat.studies.front import front_of
from wingbeat.studies.plan import Plan, make_plan
from wingbeat.studies.recipe import AIR, MOTION, changed_code, starts_of
from wingbeat.studies.stopping import Stop, listening
from wingbeat.studies.store import Salvaged, Store, salvage
from wingbeat.studies.store_checks import only_one
from wingbeat.studies.table import frame_of, save_table, to_dataset, varied_numbers
from wingbeat.studies.units import STATUSES

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from distributed.deploy.cluster import Cluster
    from matplotlib.figure import Figure

_SUFFIX = ".study.sqlite"
# Largest time limit of a point [s], more than ten days: operating systems refuse to wait for years.
_LONGEST = 1e6


class Study(Reported):
    """A study and its store; made by `study`.

    Attributes
    ----------
    plan : the points of the study.
    store : path of the file that keeps the results.

    >>> import wingbeat as wb
    >>> wb.plan_study(species="bat", vary={"speed": {"grid": [8.0]}}, store="my.study.sqlite").status().waiting
    1
    """

    def __init__(self, plan: Plan, store: Path) -> None:
        self.plan = plan
        self.store = store
        self._file = Path(os.path.realpath(store))  # where the path leads, even if the working folder changes

    def __repr__(self) -> str:
        return f"<Study of {len(self)} points, store {str(self.store)!r}>"

    def __len__(self) -> int:
        return len(self.plan)

    def estimate(self, processes: int = 1, waiting: int | None = None) -> float | None:
        """Return an estimate of how long points will take [s], from the results in the store.

        It is None if the store has no results to estimate from: first points do not count, because they also
        compile programs.

        Parameters
        ----------
        processes : worker processes.
        waiting : number of points; by default those without a result, or all if the study changed since it ran.
        """
        each = None
        if Store.is_begun(self._file):
            with Store.read(self._file) as store:
                each = store.seconds()
                if waiting is None and store.digest == self.plan.digest:
                    waiting = store.counts().get("waiting", 0)
        waiting = len(self) if waiting is None else waiting
        return None if each is None else waiting * each / processes

    def run(
        self,
        processes: int | None = None,
        timeout: float = 600.0,
        retry_failed: bool = False,
        progress: Progress | None = None,
        dask: str | Cluster | None = None,
    ) -> Summary:
        """Solve all points that have no result yet; each result is saved as soon as it is known.

        After the first Ctrl-C, the run waits one second for batches to end, and saves them. A second Ctrl-C stops
        it at once. The next run resumes the work.

        Parameters
        ----------
        processes : number of worker processes; default the number of cores.
        timeout : time limit for one point [s]. After it, the process is ended and the point is tried once more.
        retry_failed : try points again that failed before (an error, a crash, a time-out).
        progress : called with a tally whenever it changes.
        dask : a Dask cluster to use instead of processes: ``tcp://HOST:PORT`` of its scheduler, ``local:N``, or a
            cluster object of Dask; see docs/guide/clusters.md.

        Raises
        ------
        ClusterError : Dask is not installed, its scheduler cannot be reached, its workers have another version of
            wingbeat.
        FileError : the store cannot be written, is damaged, in use, or of another numerical version.
        InvalidInputError : processes or timeout out of range.
        KeyboardInterrupt : Ctrl-C; it is raised after the results were saved, and says how many points wait.
        """
        engine = engine_for(processes, timeout, dask, warnings.warn)
        with listening() as stop:
            self.run_on(engine, stop, retry_failed, progress)
        summary = self.status()
        if stop.level:
            raise KeyboardInterrupt(f"{points_wait(summary)} in {str(self.store)!r}; run the study again to resume")
        return summary

    def prepare(self) -> Summary:
        """Write the study's points to its store, solve none, and return how many already have a result.

        Raises
        ------
        FileError : the store cannot be written, is damaged, in use, or of another numerical version.
        """
        with only_one(self._file) as lock, Store.open(self._file, lock) as store:
            store.set_plan(self.plan)
        return self.status()

    def salvage(self) -> Salvaged:
        """Rebuild a damaged store from every intact result; the damaged store is kept beside it.

        The next run solves what was lost.

        Raises
        ------
        FileError : there is no store, it has no intact result, it is in use or cannot be written.
        """
        with only_one(self._file):
            return salvage(self._file, self.plan)

    def run_on(
        self, engine: Engine, stop: Stop, retry_failed: bool = False, progress: Progress | None = None
    ) -> Tally:
        """Solve all points that have no result yet, with your own engine.

        Parameters
        ----------
        engine : solves the points; closed at the end.
        stop : tells the run to stop.
        retry_failed : try points again that failed before.
        progress : called with a tally whenever it changes.
        """
        with closing(engine), only_one(self._file) as lock, Store.open(self._file, lock) as store:
            store.set_plan(self.plan)
            return drive(store, engine, stop, progress, retry_failed)

    def status(self) -> Summary:
        """Return the progress of the study: how many points have each status.

        Raises
        ------
        FileError : the store cannot be read.
        """
        if not Store.is_begun(self._file):
            return Summary(len(self), {"waiting": len(self)})
        with Store.read(self._file) as store:
            counts = store.counts()
            changed = store.digest != self.plan.digest
            total = sum(counts.values())
            kept = store.answers() - total + counts.get("waiting", 0)
            return Summary(total, counts, kept, changed, store.spent())

    def uncertified(self, most: int = 10) -> list[dict[str, Any]]:
        """Return the first points without a certified orbit: their varied values, ``status`` and ``reason``.

        Parameters
        ----------
        most : largest number of points to return.
        """
        with Store.read(self._file) as store:
            bases = store.bases()
            return [
                {**bases[row.base][0], **row.told, "status": row.status, "reason": row.error}
                for row in store.uncertified(most)
            ]

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each point, in the order of the study; see docs/guide/studies.md for its columns.

        Raises
        ------
        FileError : as of `orbits`.
        """
        with self._answers() as store:
            return frame_of(store)

    def orbits(self) -> Iterator[tuple[dict[str, Any], Orbit | None]]:
        """Yield each point's varied values, and its orbit, certified or not; without a record, the orbit is None.

        The orbits come one by one, in the order of the study. Their time series are computed when you use them.

        Raises
        ------
        FileError : there is no store, it cannot be read, or holds the points of another study.
        """
        with self._answers() as store:
            # The recipes are the plan's: one that was read from the store could hold code.
            bases = [(told, base.recipe) for (told, _), base in zip(store.bases(), self.plan.bases, strict=True)]
            for row in store.rows():
                told, recipe = bases[row.base]
                orbit = None
                if row.record is not None:
                    problem, seed = recipe.problem(json.loads(row.changes)), int(recipe.search["seed"])
                    orbit = Orbit.of_record(json.loads(row.record), problem, starts_of(recipe, problem), seed)
                yield {**told, **row.told}, orbit

    @contextmanager
    def _answers(self) -> Iterator[Store]:
        """Open the store for reading; refuse it if it holds the points of another study."""
        with Store.read(self._file) as store:
            if store.digest != self.plan.digest:
                what = changed_code((b.recipe.objective for b in self.plan.bases), (i for _, i in store.bases()))
                raise FileError(
                    f"the store {str(self.store)!r} holds the points of another study, or of this one before it "
                    f"was changed{what}; run the study first; results that still apply are kept"
                )
            yield store

    def to_dataset(self) -> xr.Dataset:
        """Return the table as a dataset along ``point``."""
        return to_dataset(self.to_dataframe(), self._about())

    def front(self, best: Mapping[str, str]) -> pd.DataFrame:
        """Return the rows of the Pareto front, by the epsilon-constraint (see `wingbeat.studies.front.front_of`).

        Parameters
        ----------
        best : columns of the table, or ``mass``, with ``"min"`` or ``"max"``: ``{"speed": "max", "mass": "min"}``.

        Raises
        ------
        InvalidInputError, FileError : an unknown column or end, fewer than two; as of `orbits`; without moocore.
        """
        return front_of(self.to_dataframe(), best)

    def export(self, path: str | PathLike[str]) -> None:
        """Write the table as NetCDF (.nc), CSV (.csv) or Parquet (.parquet), whole or not at all.

        Parameters
        ----------
        path : of the file to write; its suffix determines the format.

        Raises
        ------
        FileError, InvalidInputError : the store cannot be read, the file cannot be written, or it has another
            suffix.
        """
        save_table(self.to_dataframe(), self._about(), path)

    def drawing(self, quantity: str | None = None) -> tuple[pd.DataFrame, list[str], str, str, list[str]]:
        """Return what `wingbeat.plots.study_page` draws: table, varied numbers, column, its label, units.

        Parameters
        ----------
        quantity : a column of numbers; default the minimised quantity.
        """
        frame, form = self.to_dataframe(), self.plan.form
        least, varied = self.plan.objectives, varied_numbers(frame, self.plan.paths)
        if not varied:
            varied = [name for name in (*MOTION, *AIR) if len(getattr(form, name) or ()) > 1]
        if quantity is not None:
            label = f"{label_of(quantity, short=True)} [{_unit(quantity)}]"
        elif len(least) == 1:
            label = f"lowest {in_words(least[0])} [{_unit(least[0])}]"
        else:
            label = "minimised quantity"
        return frame, varied, quantity or "objective_value", label, [plain_unit(path) for path in varied]

    def _report(self) -> Report:
        summary, most = self.status(), 10  # so many points without a certified orbit are listed
        rows = [(name, summary.count(name)) for name in (*STATUSES, "waiting")]
        counts = tuple(Row((f"  {name:<14}", f"{count:>7}")) for name, count in rows if count)
        blocks: list[Block] = [Line(f"{summary.total} points in {self.store}"), Table(counts, align="lr")]
        if summary.kept:
            blocks.append(Line(f"  {summary.kept} results of points that are no longer in the study are kept"))
        if summary.changed:
            changed = "the study has changed since its last run: this summary is of the previous points"
            blocks.append(Line(f"  {changed}", tone="warning"))
        troubled = summary.count(*STATUSES[1:])
        blocks += [Line(_in_words(row)) for row in (self.uncertified(most) if troubled else [])]
        if troubled > most:
            blocks.append(Line(f"... and {troubled - most} more; `wingbeat study export` lists all"))
        return blocks

    def plot(self, quantity: str | None = None) -> Figure:
        """Return a figure of a result against the varied parameters.

        Parameters
        ----------
        quantity : a column of numbers, such as ``mean_power``; default the minimised quantity.
        """
        return study_page(*self.drawing(quantity))

    def _about(self) -> dict[str, Any]:
        return {"varied": list(self.plan.paths) or "nothing", "objective": list(self.plan.objectives)}


def _unit(name: str) -> str:
    """Return the unit of a quantity as axes of figures say it."""
    unit = plain_unit(name)
    return "-" if unit == "1" else unit


def engine_for(processes: Any, timeout: Any, dask: Any, told: Callable[[str], None]) -> Engine:
    """Return an engine: processes of this machine or a Dask cluster, whose notices go to `told`."""
    check_run(processes, timeout, dask)
    if dask is None:
        return LocalProcesses(processes or core_count(), timeout)
    from wingbeat.studies.dask_engine import DaskEngine

    return DaskEngine(dask, timeout, told)


def check_run(processes: Any, timeout: Any, dask: Any = None) -> None:
    """Raise `InvalidInputError` unless a study can be run with these settings."""
    faults = FaultList()
    if dask is not None and processes is not None:
        faults.add("processes", processes, "cannot be combined with a Dask cluster", "leave one of them out")
    if processes is not None:
        check_processes(faults, processes)
    faults.number("timeout", timeout, above=0, at_most=_LONGEST, unit="s")
    faults.raise_if_any()


def plan_study(
    source: str | PathLike[str] | Mapping[str, Any] | None = None,
    *,
    store: str | PathLike[str] | None = None,
    **form: Any,
) -> Study:
    """Plan a study: many orbit problems, solved once and stored.

    Parameters
    ----------
    source : a study file, or a dictionary of its keys, which may also be given by keyword.
    store : the file for the results; by default beside the study file.
    form : keys of a study file: ``species``, ``aero``, ``vary``, ``starts``, ...

    Raises
    ------
    InvalidInputError : everything that is wrong with the study, all at once.
    FileError : the study file cannot be read.

    >>> import wingbeat as wb
    >>> plan = wb.plan_study(species="pigeon", vary={"speed": {"grid": [8.0, 10.0]}}, store="pigeon.study.sqlite")
    >>> len(plan)
    2
    """
    if not isinstance(source, str | PathLike | Mapping | None):
        fix = "give a study file, or a dictionary of its keys"
        raise InvalidInputError([Fault("source", shown(source), "is neither a path nor a dictionary", fix)])
    path = None if source is None or isinstance(source, Mapping) else Path(source)
    if path is not None:
        found, faults = check_form(toml_tables(read_text(path, limit=1 << 18), str(path)))
        for key in form:
            faults.add(key, form[key], "cannot be combined with a study file", "write it into the file")
        kept = path.with_name(path.name.removesuffix(".toml") + _SUFFIX)
    else:
        table = source if isinstance(source, Mapping) else {}
        found, faults = check_form({**table, **form})
        kept = None
        if store is None:
            faults.add("store", None, "must be given", f"for example store='mine{_SUFFIX}'")
    plan = make_plan(found, faults, path.parent if path else Path.cwd())
    return Study(plan, Path(store) if store is not None else kept or Path(_SUFFIX))


@dataclass(frozen=True)
class Summary:
    """The progress of a study.

    Parameters
    ----------
    total : points of the study.
    counts : number of points by status; ``waiting`` are those without a result.
    kept : number of results of points that are no longer in the study.
    changed : whether the study was changed and not yet run again, so that the store holds the previous points.
    seconds : computing time of the results, on one core [s].
    """

    total: int
    counts: dict[str, int]
    kept: int = 0
    changed: bool = False
    seconds: float = 0.0

    def count(self, *statuses: str) -> int:
        """Return the number of points with one of these statuses."""
        return sum(self.counts.get(status, 0) for status in statuses)

    @property
    def waiting(self) -> int:
        """Number of points without a result."""
        return self.count("waiting")


def points_wait(summary: Summary) -> str:
    """Return the words for how many points of a study wait for a result.

    >>> points_wait(Summary(3, {"converged": 1, "waiting": 2})), points_wait(Summary(1, {"waiting": 1}))
    ('2 of 3 points wait', 'the only point waits')
    """
    if summary.total == 1:
        return "the only point waits" if summary.waiting else "no point waits"
    return f"{summary.waiting} of {summary.total} points wait{'s' if summary.waiting == 1 else ''}"


def _in_words(row: dict[str, Any]) -> str:
    """Return status, varied values and reason of a point."""
    where = ", ".join(
        f"{name} = {value:.5g}" if isinstance(value, float) else f"{name} = {value}"
        for name, value in row.items()
        if name not in ("status", "reason")
    )
    text = ": ".join(part for part in (row["status"], where, row["reason"]) if part)
    return "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in text)
