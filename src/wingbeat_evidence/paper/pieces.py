"""A sample of assumptions, run in pieces: each piece is solved, judged and saved once, as one small file."""

from __future__ import annotations

import csv
import hashlib
import io
import json
import shutil
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from wingbeat._base import NUMERICAL_VERSION, FileError, make_folder, read_text, write_atomically
from wingbeat.studies.engine import Engine
from wingbeat.studies.stopping import Stop
from wingbeat_evidence.paper.assumption_study import (
    ORBITS,
    SPEEDS,
    STARTS,
    Judged,
    fly_piece,
    judge_piece,
    plan_piece,
    seconds_of,
    study_claims,
)
from wingbeat_evidence.paper.assumptions import ASSUMPTIONS, Values, sample_sets

# Larger than any piece of the largest sample.
_LIMIT = 1 << 30
Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class Sample:
    """Which sets are requested, and in which pieces.

    Parameters
    ----------
    sets, seed : arguments of `sample_sets`.
    piece : number of sets in a piece; the last piece may hold fewer.
    """

    sets: int
    seed: int
    piece: int

    def __len__(self) -> int:
        return -(-self.sets // self.piece)

    def range(self, number: int) -> range:
        """Return the indices of the sets in a piece; pieces are counted from 1."""
        return range((number - 1) * self.piece, min(number * self.piece, self.sets))

    def about(self) -> dict[str, int | str]:
        """Return what identifies this sample: its ranges, speeds, starts and claim ids, but not their words."""
        ranges = [(a.name, a.low, a.high, a.choices) for a in ASSUMPTIONS]
        asked = repr((ranges, SPEEDS, STARTS, [claim.id for claim in study_claims()]))
        digest = hashlib.sha256(asked.encode()).hexdigest()[:12]
        return {**asdict(self), "numerical_version": NUMERICAL_VERSION, "asked": digest}


class Pieces:
    """The folder of a sample's pieces. A finished piece is a table, an unfinished one a folder of study stores.

    Parameters
    ----------
    sample : the requested sample.
    folder : created if missing; it may hold pieces of this sample that other machines finished.

    Raises
    ------
    FileError : the folder holds another sample, or cannot be read or written.
    """

    def __init__(self, sample: Sample, folder: Path) -> None:
        self.sample, self.folder = sample, folder
        make_folder(folder)
        about = folder / "sample.json"
        if about.exists():
            _check_same(_parsed(read_text(about)), sample, about)
        else:
            write_atomically(about, json.dumps(sample.about()) + "\n")
        for number in self.finished():
            self._read(number)

    def __len__(self) -> int:
        return len(self.sample)

    def path(self, number: int) -> Path:
        """Return the file of a piece."""
        return self.folder / f"piece-{number:04d}-of-{len(self):04d}.csv"

    def finished(self) -> list[int]:
        """Return the numbers of the pieces whose tables exist."""
        return [number for number in range(1, len(self) + 1) if self.path(number).is_file()]

    def run(
        self,
        numbers: Iterable[int],
        engine: Callable[[], Engine],
        stop: Stop,
        progress: Progress | None = None,
    ) -> Iterator[int]:
        """Solve and judge those pieces that are unfinished, and yield the number of each piece once it is saved.

        Parameters
        ----------
        numbers : numbers of the pieces, from 1.
        engine : makes the engine that runs a study.
        stop : checked between batches; the next run resumes an unfinished piece.
        progress : called with (orbits with a result, all orbits) of the requested pieces.
        """
        wanted = list(numbers)
        left = [number for number in wanted if not self.path(number).is_file()]
        total = ORBITS * sum(len(self.sample.range(number)) for number in wanted)
        done = total - ORBITS * sum(len(self.sample.range(number)) for number in left)
        sets = sample_sets(self.sample.sets, self.sample.seed)
        for number in self.finished():  # a run may be killed between saving and clearing up
            shutil.rmtree(self._stores(number), ignore_errors=True)
        for number in left:

            def told(flown: int, done: int = done) -> None:
                if progress is not None:
                    progress(done + flown, total)

            self._run(number, [sets[i] for i in self.sample.range(number)], engine, stop, told)
            if stop.level:
                return
            done += ORBITS * len(self.sample.range(number))
            yield number

    def _stores(self, number: int) -> Path:
        return self.path(number).with_suffix("")

    def _run(
        self,
        number: int,
        sets: list[Values],
        engine: Callable[[], Engine],
        stop: Stop,
        progress: Callable[[int], None],
    ) -> None:
        stores = self._stores(number)
        stores.mkdir(exist_ok=True)
        groups = plan_piece(sets, stores)
        fly_piece(groups, engine, stop, progress)
        if stop.level:
            return
        judged = judge_piece(sets, groups)
        about = self.sample.about() | {"number": number, "core_seconds": round(seconds_of(groups), 1)}
        write_atomically(self.path(number), f"# {json.dumps(about)}\n{table([judged])}")
        shutil.rmtree(stores)

    def _read(self, number: int) -> tuple[Judged, float]:
        path = self.path(number)
        head, _, rest = read_text(path, limit=_LIMIT).partition("\n")
        try:
            about = json.loads(head.removeprefix("# "))
            seconds = float(about.pop("core_seconds"))
            own = about.pop("number")
            judged = _judged(rest)
            if own != number or len(judged.sets) != len(self.sample.range(number)):
                raise ValueError("it is incomplete, or holds another piece")
        except (KeyError, TypeError, ValueError, AttributeError, csv.Error) as error:
            fix = "remove the file to run the piece again"
            raise FileError(f"cannot read {str(path)!r} as a piece of a sample: {error}; {fix}") from None
        _check_same(about, self.sample, path)
        return judged, seconds

    def joined(self) -> tuple[Judged, float]:
        """Return the judged sets of the finished pieces, and the time that their orbits took [core-s]."""
        read = [self._read(number) for number in self.finished()]
        parts = [judged for judged, _ in read]
        judged = Judged(
            tuple(values for part in parts for values in part.sets),
            study_claims(),
            *(np.concatenate([getattr(part, name) for part in parts]) for name in ("numbers", "holds", "flown")),
        )
        return judged, sum(seconds for _, seconds in read)


def _parsed(text: str) -> object:
    with suppress(ValueError):
        return json.loads(text)
    return None


def _check_same(about: object, sample: Sample, path: Path) -> None:
    if about == sample.about():
        return
    told = about if isinstance(about, dict) else {}
    theirs, ours = (
        f"--sets {of.get('sets')} --seed {of.get('seed')} --piece {of.get('piece')}, numerical version "
        f"{of.get('numerical_version')}, claims and ranges {of.get('asked')}"
        for of in (told, sample.about())
    )
    fix = "give another folder, or the same sample"
    raise FileError(f"{str(path)!r} belongs to another sample ({theirs}), not to this one ({ours}); {fix}")


def table(parts: Iterable[Judged]) -> str:
    """Return a CSV text with a line for each set: assumptions, number of certified orbits, numbers and verdicts."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(_columns())
    for part in parts:
        for values, numbers, holds, flown in zip(part.sets, part.numbers, part.holds, part.flown, strict=True):
            said = [
                cell for n, h in zip(numbers, holds, strict=True) for cell in (_cell(n, ".4g"), _cell(h, ".0f"))
            ]
            assumed = (values[assumption.name] for assumption in ASSUMPTIONS)
            shown = [value if isinstance(value, str) else f"{value:.4g}" for value in assumed]
            writer.writerow([*shown, int(flown), *said])
    return text.getvalue()


def _columns() -> list[str]:
    claims = [f"{claim.id}{end}" for claim in study_claims() for end in ("", ":holds")]
    return [*(assumption.name for assumption in ASSUMPTIONS), "certified", *claims]


def _cell(number: float, form: str) -> str:
    return format(number, form) if np.isfinite(number) else ""


def _judged(text: str) -> Judged:
    """Return the judged sets that `table` wrote in this text."""
    names, *rows = csv.reader(io.StringIO(text))
    if names != _columns():
        raise ValueError("its columns do not match")
    count = len(ASSUMPTIONS)
    sets = tuple(
        {a.name: cell if a.choices else float(cell) for a, cell in zip(ASSUMPTIONS, row[:count], strict=True)}
        for row in rows
    )
    said = np.array([[float(cell) if cell else np.nan for cell in row[count + 1 :]] for row in rows])
    return Judged(sets, study_claims(), said[:, ::2], said[:, 1::2], np.array([int(row[count]) for row in rows]))
