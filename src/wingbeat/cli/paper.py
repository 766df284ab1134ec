"""``wingbeat paper``: the figures and claims of Su et al. beside ours, and what the claims hang on."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from wingbeat.cli.progress import progress_bar
from wingbeat.errors import FaultList

_SETS = 1000


def paper(
    part: Annotated[
        Literal["claims", "assumptions"],
        Parameter(help="Figures and claims, or how the claims fare over many sets of assumptions."),
    ] = "claims",
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="Folder to write to.")] = Path("paper"),
    figures: Annotated[str | None, Parameter(help="Which figures to draw: 2-8, or 3,5 and the like.")] = None,
    quick: Annotated[bool, Parameter(negative="", help="Fewer speeds and searches.")] = False,
    sets: Annotated[int | None, Parameter(help=f"Sets of assumptions to sample; {_SETS} if not given.")] = None,
    seed: Annotated[int | None, Parameter(help="Of the sample of assumptions; 0 if not given.")] = None,
    processes: Annotated[int | None, Parameter(help="Python processes; as many as cores if not given.")] = None,
) -> None:
    """Put Su et al. (arXiv 2302.09602) to the test: figures 2 to 8, every claim with a verdict, the orbits behind.

    `wingbeat paper assumptions` samples what the paper leaves open and counts under which sets each claim holds.

    Example: wingbeat paper --quick -o paper
    """
    faults = FaultList()
    numbers = _figures(faults, figures or "2-8")
    count = sets if sets is not None else _SETS
    share = processes if processes is not None else os.cpu_count() or 1
    if not 1 <= count <= 1_000_000:
        faults.add("--sets", count, "must be a whole number from 1 to 1000000")
    if not 1 <= share <= 1024:
        faults.add("--processes", share, "must be a whole number from 1 to 1024")
    if seed is not None and seed < 0:
        faults.add("--seed", seed, "must not be negative")
    other = (("--figures", figures), ("--quick", quick or None))
    if part == "claims":
        other = (("--sets", sets), ("--seed", seed))
    for name, value in other:
        if value is not None:
            faults.add(name, value, f"has no part in 'paper {part}'")
    faults.raise_if_any()
    if part == "claims":
        _claims(numbers, output, quick, share)
    else:
        _assumptions(count, seed or 0, output, share)


def _figures(faults: FaultList, words: str) -> list[int]:
    """Return the figures that words like ``2-8`` or ``3,5`` name."""
    from wingbeat.paper.figures import FIGURES

    numbers: list[int] = []
    for word in words.split(","):
        first, _, last = word.strip().partition("-")
        if not first.isdigit() or not (last or first).isdigit():
            faults.add("--figures", words, "must name figures", "as in 2-8 or 3,5")
            return []
        numbers += range(int(first), int(last or first) + 1)
    for number in sorted(set(numbers) - set(FIGURES)):
        faults.add("--figures", number, "is not among the figures", f"draw {min(FIGURES)} to {max(FIGURES)}")
    return sorted(set(numbers))


def _claims(numbers: list[int], folder: Path, quick: bool, processes: int) -> None:
    from wingbeat.paper.claims import judge_claims, write_claims
    from wingbeat.paper.figures import draw_figures
    from wingbeat.paper.treatments import QUICK_SPEEDS, SPEEDS, all_cases, solve_cases

    begun = time.perf_counter()
    cases = all_cases(QUICK_SPEEDS if quick else SPEEDS)
    with progress_bar("rows of orbits") as progress:
        orbits = solve_cases(cases, 3 if quick else 6, processes, progress)
    certified = sum(orbit.status.value == "converged" for orbit in orbits.values())
    print(f"{certified} of {len(cases)} orbits certified", file=sys.stderr)
    written = draw_figures(orbits, numbers, folder)
    claims = judge_claims(orbits)
    written += write_claims(claims, orbits, folder)
    for claim in claims:
        print(f"{claim.id}: {claim.verdict}")
    print(f"wrote {len(written)} files to {folder} in {time.perf_counter() - begun:.0f} s", file=sys.stderr)


def _assumptions(sets: int, seed: int, folder: Path, processes: int) -> None:
    from wingbeat.paper.assumption_page import write_study
    from wingbeat.paper.study import run_study

    begun = time.perf_counter()
    with progress_bar("sets of assumptions") as progress:
        study = run_study(sets, seed=seed, processes=processes, progress=progress)
    minutes = (time.perf_counter() - begun) / 60
    heading = (
        f"`wingbeat paper assumptions --sets {sets} --seed {seed}`: one search an orbit, answers handed on along "
        f"speed and from model to model; {processes} processes, {minutes:.0f} minutes."
    )
    for path in write_study(study, folder, heading):
        print(f"wrote {path}", file=sys.stderr)
