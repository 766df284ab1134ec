"""The results of an assumption study: a page to read, a table of every set, and one figure."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from wingbeat._base import write_atomically
from wingbeat.plots import save_figure
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.paper.assumption_figure import TRUSTED, draw
from wingbeat_evidence.paper.assumption_study import ORBITS, Judged
from wingbeat_evidence.paper.assumptions import ASSUMPTIONS
from wingbeat_evidence.paper.importance import Importance, importance
from wingbeat_evidence.paper.pieces import table

# A pair of claims is reported as never holding together only if each holds in at least this many sets.
_OFTEN = 20
# Assumptions that explain less than this share of the variance of a claim's number are not named.
_TELLING = 0.1


def write_study(study: Judged, folder: Path, heading: str) -> list[Path]:
    """Write assumptions.md, .csv, .png and .pdf into a folder.

    Parameters
    ----------
    study : the study.
    folder : folder to write to.
    heading : text on how the study was run: command and time.

    Raises
    ------
    FileError : a file cannot be written.
    """
    hangs = [importance(study.sets, numbers) for numbers in study.numbers.T]
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / f"assumptions.{ending}" for ending in ("md", "csv", "png", "pdf")]
    write_atomically(paths[0], page(study, hangs, heading))
    write_atomically(paths[1], table([study]))
    figure = draw(study, hangs)
    save_figure(figure, paths[2])
    save_figure(figure, paths[3])
    return paths


_PAGE = """# What the paper's claims depend on

Su et al. (arXiv 2302.09602) give no wing masses, inertias, shoulder positions or bounds, and do not say how they
treat negative angles of attack. {count} sets of assumptions fill the ranges below evenly. Each needs {orbits}
orbits of lowest frequency: pigeon and bat, with both coefficient models, at the speeds of the claims. Of these
orbits, {found:.0f} % were found and certified.

{heading}

![Share of the testable sets that satisfy each claim, and what the claim depends on](assumptions.png)

*a: share of the testable sets that satisfy the claim (bars), and share of all sets that can test it (ticks). b:
share of the variance of the claim's number that each assumption explains; grey: too few sets. c: quality of the
response surface behind these shares. U: Usherwood et al. 2005, P: Pennycuick 1996.*

*Testable*: share of sets that have the orbits to test the claim. *Holds*: share of these that satisfy it, with its
standard error. *Depends on*: assumptions that explain at least a tenth of the variance of the ranks of the claim's
number, by a quadratic response surface. *Quality*: share of the variance that the surface explains in numbers that
it was not fitted to; below {trusted:g} it says little.

{claims}

No set satisfies more than {most:.0f} of the {of} claims; half of the sets satisfy at least {half:.0f}. Many sets
cannot test all claims, because an orbit is missing.

{apart}

## What was sampled

{sampled}
"""


def page(study: Judged, hangs: Sequence[Importance | None], heading: str) -> str:
    """Return the page of results in Markdown."""
    kept = np.nansum(study.holds, axis=1)
    claims = []
    for claim, holds, hang in zip(study.claims, study.holds.T, hangs, strict=True):
        told = np.isfinite(holds)
        quality = "-" if hang is None else f"{hang.quality:.2f}"
        claims.append([f"`{claim.id}`", _share(holds[told]), f"{100 * told.mean():.0f}", _named(hang), quality])
    sampled = [
        [f"{a.name}: {a.words}", ", ".join(a.choices) if a.choices else f"{a.low:g} to {a.high:g}", a.source]
        for a in ASSUMPTIONS
    ]
    return _PAGE.format(
        count=len(study.sets),
        orbits=ORBITS,
        found=100 * study.flown.sum() / (ORBITS * len(study.sets)),
        heading=heading,
        trusted=TRUSTED,
        claims=markdown_table(["claim", "holds [%]", "testable [%]", "depends on", "quality"], claims),
        most=kept.max(),
        of=len(study.claims),
        half=np.median(kept),
        apart="\n".join(_apart(study)),
        sampled=markdown_table(["assumption", "range", "reason"], sampled),
    )


def _share(holds: np.ndarray) -> str:
    """Return the share of sets that satisfy a claim [%], with its standard error unless the share is 0 or 100.

    >>> _share(np.array([1.0, 1.0, 0.0, 1.0]))
    '75 ± 22'
    """
    if not len(holds):
        return "-"
    share = holds.mean()
    error = 100 * np.sqrt(share * (1 - share) / len(holds))
    return f"{100 * share:.0f} ± {error:.{0 if error >= 1 else 1}f}" if error else f"{100 * share:.0f}"


def _named(hang: Importance | None) -> str:
    if hang is None:
        return "-"
    order = [i for i in np.argsort(-hang.shares) if hang.shares[i] >= _TELLING]
    return ", ".join(f"{ASSUMPTIONS[i].name} {hang.shares[i]:.2f}" for i in order) or "none alone"


def _apart(study: Judged) -> list[str]:
    """Return a line for each pair of claims that each hold often but never hold together."""
    lines = []
    often = [k for k in range(len(study.claims)) if np.nansum(study.holds[:, k]) >= _OFTEN]
    for i, k in enumerate(often):
        for other in often[i + 1 :]:
            both = np.isfinite(study.holds[:, k]) & np.isfinite(study.holds[:, other])
            if both.sum() >= _OFTEN and not (study.holds[both, k] * study.holds[both, other]).any():
                lines.append(f"- no set satisfies both `{study.claims[k].id}` and `{study.claims[other].id}`")
    never = [claim.id for claim, holds in zip(study.claims, study.holds.T, strict=True) if np.nansum(holds) == 0]
    if never:
        lines.append(f"- no set satisfies any of these: {', '.join(f'`{name}`' for name in never)}")
    return lines or ["- for any two claims that each hold in many sets, at least one set satisfies both"]
