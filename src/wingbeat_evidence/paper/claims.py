"""Every claim of the paper: judged, and written to claims.json and claims.md with the records of its orbits."""

from __future__ import annotations

import dataclasses
import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from wingbeat._base.files import write_atomically
from wingbeat_evidence.paper.argument_claims import argument_claims
from wingbeat_evidence.paper.claim import NOT_ASKED, Claim, Finding
from wingbeat_evidence.paper.coefficient_claims import coefficient_claims
from wingbeat_evidence.paper.experiment_claims import experiment_claims
from wingbeat_evidence.paper.flight_claim_list import flight_claim_list
from wingbeat_evidence.paper.pigeon_claims import pigeon_data_claim
from wingbeat_evidence.paper.planform_claims import planform_claim
from wingbeat_evidence.paper.premise_claims import premise_claims
from wingbeat_evidence.paper.treatments import TREATMENTS, Orbits
from wingbeat_evidence.paper.verdict_changes import changes_table, verdict_changes


def judge_claims(orbits: Orbits, quick: bool = False) -> list[Claim]:
    """Return every claim with its verdict.

    Parameters
    ----------
    orbits : the orbits of all treatments (`wingbeat_evidence.paper.treatments.solve_cases`).
    quick : true if too few flights were solved to test the claims about flight. The other verdicts stay the same.
    """
    flights = (*flight_claim_list(), *argument_claims())
    on_print = [*experiment_claims(), *coefficient_claims(), *premise_claims(), pigeon_data_claim()]
    planform = planform_claim(orbits)
    if quick:
        finding = Finding(NOT_ASKED, None, None)
        unasked = dataclasses.replace(planform, findings=(finding,), asked=False)
        return [*on_print, unasked, *(claim.unasked() for claim in flights)]
    everywhere = [t.name for t in TREATMENTS if any(case.treatment == t.name for case in orbits)]
    return [*on_print, planform, *(claim.judge(orbits, everywhere) for claim in flights)]


def write_claims(
    claims: Sequence[Claim], orbits: Orbits, folder: Path, before: Sequence[dict[str, Any]] | None = None
) -> list[Path]:
    """Write claims.json, claims.md and, under ``orbits``, the records of the orbits that the claims use.

    Parameters
    ----------
    claims, orbits : the judged claims, and the orbits on which they were tested.
    folder : folder to write to.
    before : claims of an earlier run (`read_verdicts`); the page lists the verdicts that differ.

    Raises
    ------
    FileError : a file cannot be written.
    """
    rows = [claim.row() for claim in claims]
    records = {case.name: orbit for case, orbit in orbits.items()}
    used = sorted({name for row in rows for name in row["orbits"]})
    (folder / "orbits").mkdir(parents=True, exist_ok=True)
    written = [folder / "claims.json", folder / "claims.md"]
    for row in rows:
        row["orbits"] = [f"orbits/{name}.json" for name in row["orbits"]]
    write_atomically(written[0], json.dumps(rows, indent=1) + "\n")
    changed = [] if before is None else changes_table(verdict_changes(before, claims))
    write_atomically(written[1], "\n".join([markdown(claims), *changed]))
    for name in used:
        path = folder / "orbits" / f"{name}.json"
        write_atomically(path, json.dumps(records[name].record(), indent=1) + "\n")
        written.append(path)
    return written


def markdown(claims: Sequence[Claim]) -> str:
    """Return the claims as a Markdown page."""
    counts = Counter(claim.verdict for claim in claims)
    tally = ", ".join(f"{verdict} {count}" for verdict, count in counts.most_common())
    lines = [
        "# The paper's claims beside our results",
        "",
        "Su, Fan, Onoue, Vejdani and Breuer, arXiv 2302.09602. The table has one row for each quantitative or "
        "directional claim. After the claim, *Tested* says what we tested, and *Ours* says what our number is. "
        "Both are left out where the claim makes them plain. C_L, C_D and C_M are those of the plate of Su et al. "
        "unless the claim names another model. The column *ours* gives this number under our default assumptions, "
        "the first in the list below. A claim *holds* if it holds under every set of assumptions tried, and it "
        "*fails* if it holds under none. *Holds under* means that it holds under some of them. *By assumption* "
        "gives our number under each set of assumptions, and whether the claim then holds (yes or no). *No "
        "assumption needed* marks a claim that we test on printed numbers and formulas alone. If a claim holds, "
        "our result is consistent with the paper. This does not prove that the authors made the same assumptions.",
        "",
        f"Verdicts of the {len(claims)} claims: {tally}.",
        "",
        "Assumptions tried:",
        "",
        *(f"- `{treatment.name}`: {treatment.words}." for treatment in TREATMENTS),
        "",
        "| claim | where | paper | ours | unit | verdict | by assumption |",
        "| --- | --- | --- | --- | --- | --- | --- |",
        *(_line(claim) for claim in claims),
        "",
    ]
    return "\n".join(lines)


def _line(claim: Claim) -> str:
    paper = f"{claim.paper:.4g}" if isinstance(claim.paper, float) else claim.paper
    each = "; ".join(f"{f.assumptions}: {_shown(f.number)}{_mark(f.holds)}" for f in claim.findings)
    ours = _shown(claim.findings[0].number)
    if not claim.asked:
        ours, each = "-", "-"
    cells = [claim.claim, claim.where, paper, ours, claim.unit, claim.verdict, each]
    return "| " + " | ".join(cell.replace("|", "/") for cell in cells) + " |"


def _shown(number: float | None) -> str:
    return "not flown" if number is None else f"{number:.3g}"


def _mark(holds: bool | None) -> str:
    return "" if holds is None else " (yes)" if holds else " (no)"
