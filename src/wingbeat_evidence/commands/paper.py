"""``wingbeat paper``: the figures and claims of Su et al. beside wingbeat's, and what the claims depend on."""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from wingbeat._base import NUMERICAL_VERSION, FaultList, make_folder
from wingbeat._workers.tuning import core_count
from wingbeat.cli.arguments import Whole, flag, written_to
from wingbeat.cli.process import EXIT_GOOD
from wingbeat.cli.terminal import exit_of, progress_bar, say, say_stopping

if TYPE_CHECKING:
    from wingbeat_evidence.paper.pieces import Sample

_SETS = 1000
# For each piece the worker processes load every program anew, which takes minutes.
_PIECE = 5000


def paper(
    part: Annotated[
        Literal["claims", "assumptions"],
        Parameter(help="Figures and claims, or the claims under many sets of assumptions."),
    ] = "claims",
    *,
    output: Annotated[Path, written_to("Folder to write to.")] = Path("paper"),
    figures: Annotated[str | None, Parameter(help="Figures to draw, such as 1-8 or 3,5.")] = None,
    quick: Annotated[bool, flag("Fewer speeds and starts for the figures; no claims about flights.")] = False,
    before: Annotated[
        Path | None, Parameter(help="claims.json of an earlier run: the page says what changed and why.")
    ] = None,
    sets: Annotated[
        Whole | None, Parameter(help=f"How many sets of assumptions to sample; default {_SETS}.")
    ] = None,
    seed: Annotated[Whole | None, Parameter(help="Seed of the sample of assumptions; default 0.")] = None,
    piece: Annotated[Whole | None, Parameter(help=f"How many sets each saved piece has; default {_PIECE}.")] = None,
    only: Annotated[
        str | None, Parameter(help="Pieces that this run solves, such as 1-10 or 3,5; default all.")
    ] = None,
    processes: Annotated[Whole | None, Parameter(help="Worker processes; default: as many as cores.")] = None,
) -> int:
    """Test Su et al. (arXiv 2302.09602): draw figures 1 to 8, judge every claim, and save the orbits behind them.

    `wingbeat paper assumptions` samples the assumptions that Su et al. leave open, and counts the sets under which
    each claim holds. An interrupted run resumes. Finished pieces are in the subfolder `pieces`. Other machines can
    run pieces with --only; copy their pieces into this subfolder. Page, table and figure cover all pieces in this
    subfolder.

    Examples: wingbeat paper --quick -o paper; wingbeat paper assumptions --sets 2000 --only 1 -o assumptions
    """
    from wingbeat_evidence.paper.figures import FIGURES
    from wingbeat_evidence.paper.pieces import Sample

    faults = FaultList()
    numbers = _numbers(faults, "--figures", figures or "1-8", set(FIGURES), "figures")
    sample = Sample(_SETS if sets is None else sets, seed or 0, _PIECE if piece is None else piece)
    share = processes if processes is not None else core_count()
    for name, count in (("--sets", sample.sets), ("--piece", sample.piece)):
        faults.whole(name, count, 1, 1_000_000)
    faults.whole("--processes", share, 1, 1024)
    if seed is not None and seed < 0:
        faults.add("--seed", seed, "must not be negative")
    other = (("--figures", figures), ("--quick", quick or None), ("--before", before))
    if part == "claims":
        other = (("--sets", sets), ("--seed", seed), ("--piece", piece), ("--only", only))
    for name, value in other:
        if value is not None:
            faults.add(name, str(value), f"does not apply to 'paper {part}'")
    faults.raise_if_any()
    make_folder(output)  # or the orbits of an hour have no place to go
    if part == "claims":
        _claims(numbers, output, quick, share, before)
        return EXIT_GOOD
    every = f"1-{len(sample)}"
    pieces = _numbers(faults, "--only", only or every, set(range(1, len(sample) + 1)), "pieces")
    faults.raise_if_any()
    return _assumptions(sample, pieces, output, share)


def _numbers(faults: FaultList, option: str, words: str, known: set[int], what: str) -> list[int]:
    """Return the numbers in a text such as ``2-8`` or ``3,5``."""
    numbers: list[int] = []
    for word in words.split(","):
        first, _, last = word.strip().partition("-")
        if not all(text.isdecimal() and len(text) < 10 for text in (first, last or first)):
            faults.add(option, words, f"must name {what}", "as in 1-8 or 3,5")
            return []
        ends = int(first), int(last or first)
        for number in ends:
            if number not in known:
                faults.add(option, number, f"is not among the {what}", f"give {min(known)} to {max(known)}")
        numbers += range(ends[0], min(ends[1], max(known)) + 1)
    return sorted(known & set(numbers))


def _claims(numbers: list[int], folder: Path, quick: bool, processes: int, before: Path | None) -> None:
    from wingbeat_evidence.paper.claims import judge_claims, read_verdicts, write_claims
    from wingbeat_evidence.paper.figures import draw_figures
    from wingbeat_evidence.paper.treatments import DRAWN, QUICK_SPEEDS, SPEEDS, TREATMENTS, all_cases, solve_cases

    begun = time.perf_counter()
    earlier = None if before is None else read_verdicts(before)
    cases = all_cases(QUICK_SPEEDS, DRAWN) if quick else all_cases(SPEEDS, TREATMENTS)
    with progress_bar("rows of orbits") as progress:
        orbits = solve_cases(cases, 3 if quick else 6, processes, progress)
    certified = sum(orbit.status.value == "converged" for orbit in orbits.values())
    print(f"{certified} of {len(cases)} orbits certified", file=sys.stderr)
    claims = judge_claims(orbits, quick)
    for claim in claims:
        print(f"{claim.id}: {claim.verdict}")
    sys.stdout.flush()
    written = draw_figures(orbits, numbers, folder)
    written += write_claims(claims, orbits, folder, earlier)
    print(f"wrote {len(written)} files to {folder} in {time.perf_counter() - begun:.0f} s", file=sys.stderr)


def _assumptions(sample: Sample, only: list[int], folder: Path, processes: int) -> int:
    from wingbeat.studies.engine import LocalProcesses
    from wingbeat.studies.stopping import listening
    from wingbeat_evidence.paper.assumption_page import write_study
    from wingbeat_evidence.paper.assumption_study import STARTS, SURENESS
    from wingbeat_evidence.paper.pieces import Pieces

    pieces = Pieces(sample, folder / "pieces")
    with listening(say_stopping) as stop, progress_bar("orbits") as progress:
        for number in pieces.run(only, lambda: LocalProcesses(processes), stop, progress):
            say(f"piece {number} of {len(pieces)} is done: {pieces.path(number)}")
    if stop.level:
        return exit_of(stop)
    done = len(pieces.finished())
    so_far = "" if done == len(pieces) else f" So far, {done} of {len(pieces)} pieces are done."
    judged, seconds = pieces.joined()
    heading = (
        f"`wingbeat paper assumptions --sets {sample.sets} --seed {sample.seed} --piece {sample.piece}` "
        f"(numerical version {NUMERICAL_VERSION}) solved a [study](../guide/studies.md) for each animal, "
        f"coefficient model and choice of trims, with {STARTS} starts per orbit. One of the starts is the orbit at "
        f"the previous speed, if there is one. {SURENESS} The orbits took "
        f"{seconds / 3600:.1f} core-hours, {seconds / len(judged.sets):.2f} s per set.{so_far}"
    )
    if so_far:
        say(f"{done} of {len(pieces)} pieces are done; the page covers these")
    for path in write_study(judged, folder, heading):
        say(f"wrote {path}")
    return EXIT_GOOD
