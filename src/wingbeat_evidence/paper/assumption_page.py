"""The results of an assumption study: a page to read, a table of every set, and one figure."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from wingbeat._base.files import write_atomically
from wingbeat.plots import save_figure
from wingbeat_evidence.paper.assumption_figure import TRUSTED, draw
from wingbeat_evidence.paper.assumption_study import ORBITS, Judged
from wingbeat_evidence.paper.assumptions import ASSUMPTIONS
from wingbeat_evidence.paper.importance import Importance, importance
from wingbeat_evidence.paper.pieces import table

# A pair of claims is reported as never holding together only if each holds in at least this many sets.
_OFTEN = 20
# Assumptions that explain less than this share of the variance of a claim's number are not named.
_TELLING = 0.05
_BEST = 5


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


def page(study: Judged, hangs: Sequence[Importance | None], heading: str) -> str:
    """Return the page of results in Markdown."""
    kept = np.nansum(study.holds, axis=1)
    lines = [
        "# What the paper's claims depend on",
        "",
        "Su et al. (arXiv 2302.09602) give no wing masses, inertias, shoulder positions or bounds, and do not say "
        f"how they treat negative angles of attack. Here we use {len(study.sets)} sets of assumptions. The sets "
        "fill the plausible ranges below uniformly. The total masses of the animals are those of the paper. Each "
        f"set needs {ORBITS} orbits of lowest frequency: the pigeon and the bat, with both coefficient models, at "
        f"the speeds of the claims. Of these orbits, {100 * study.flown.sum() / (ORBITS * len(study.sets)):.0f} % "
        "were found and certified.",
        "",
        heading,
        "",
        "![Share of the testable sets that satisfy each claim, and what the claim depends on](assumptions.png)",
        "",
        "*Share of the testable sets that satisfy each claim (bars in a), and share of all sets that can test it "
        "(ticks). Share of the variance of the claim's number that each assumption explains (b); grey: too few "
        "sets. Quality of the response surface behind these shares (c); left of the line the surface says little. "
        "The claims are in the order of the table below. U: Usherwood et al. 2005, P: Pennycuick 1996.*",
        "",
        "## Claim by claim",
        "",
        "*Testable* is the share of sets that have the orbits to test the claim. *Holds* is the share of the "
        "testable sets that satisfy it, with its standard error. Each set gives one number for the claim; the "
        "claim calls it *Ours*. We fit a quadratic response surface to the ranks of these numbers. *Depends on* "
        "names each assumption that explains at least a twentieth of the variance of these ranks, with the share "
        "that it explains. *Quality* is the share of the variance that the surface explains in numbers that were "
        f"not used in the fit. Below {TRUSTED:g} the surface says little.",
        "",
        "| claim | holds [%] | testable [%] | depends on | quality |",
        "| --- | --- | --- | --- | --- |",
    ]
    for claim, holds, hang in zip(study.claims, study.holds.T, hangs, strict=True):
        told = np.isfinite(holds)
        share = _share(holds[told])
        quality = "-" if hang is None else f"{hang.quality:.2f}"
        lines.append(
            f"| `{claim.id}`: {claim.claim} | {share} | {100 * told.mean():.0f} | {_named(hang)} | {quality} |"
        )
    lines += [
        "",
        "## All at once",
        "",
        f"No set satisfies more than {kept.max():.0f} of the {len(study.claims)} claims; half of the sets satisfy "
        f"at least {np.median(kept):.0f}. Many sets cannot test all claims, because an orbit is missing.",
        "",
        *_apart(study),
        "",
        f"The {_BEST} sets that satisfy the most claims follow. The last column gives claim ids; in an id, "
        "`1-of-4` means at a quarter of the span.",
        "",
        "| " + " | ".join(["claims", *(a.name for a in ASSUMPTIONS), "claims not satisfied"]) + " |",
        "| " + " | ".join(["---"] * (len(ASSUMPTIONS) + 2)) + " |",
    ]
    for i in np.argsort(-kept, kind="stable")[:_BEST]:
        missed = [claim.id for claim, holds in zip(study.claims, study.holds[i], strict=True) if holds != 1]
        assumed = [v if isinstance(v, str) else f"{v:.3g}" for v in (study.sets[i][a.name] for a in ASSUMPTIONS)]
        lines.append("| " + " | ".join([f"{kept[i]:.0f}", *assumed, ", ".join(missed)]) + " |")
    lines += ["", "## What was sampled", "", "| assumption | range | reason |", "| --- | --- | --- |"]
    for a in ASSUMPTIONS:
        span = ", ".join(a.choices) if a.choices else f"{a.low:g} to {a.high:g}"
        lines.append(f"| {a.name}: {a.words} | {span} | {a.source} |")
    return "\n".join(lines) + "\n"


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
