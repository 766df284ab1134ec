"""Every claim of the paper: judged, and written to claims.json and claims.md with the records of its orbits."""

from __future__ import annotations

import dataclasses
import json
import re
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from wingbeat._base import FileError, read_text, write_atomically
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.paper.argument_claims import argument_claims
from wingbeat_evidence.paper.claim import FAILS, HOLDS, HOLDS_UNDER, NOT_ASKED, UNTESTABLE, Claim, Finding
from wingbeat_evidence.paper.coefficient_claims import coefficient_claims
from wingbeat_evidence.paper.experiment_claims import experiment_claims
from wingbeat_evidence.paper.flight_claim_list import flight_claim_list
from wingbeat_evidence.paper.pigeon_claims import pigeon_data_claim
from wingbeat_evidence.paper.planform_claims import planform_claim
from wingbeat_evidence.paper.premise_claims import premise_claims
from wingbeat_evidence.paper.treatments import TREATMENTS, Orbits

_LIMIT = 1 << 26
_NONE = "-"


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


_PAGE = """# The paper's claims beside our results

Su, Fan, Onoue, Vejdani and Breuer, arXiv 2302.09602: each quantitative or directional claim beside our number
under the default assumptions, the first below, with the range over the six sets of assumptions below in brackets.
A claim *holds* if it holds under every one of the six, and *fails* if under none. Under other sets some verdicts
change: the page *Which claims hold* gives the share of 20 000 sets. A claim that holds is consistent with our
result; this does not prove that the authors made the same assumptions. C_L, C_D and C_M are those of the plate of
Su et al. unless the claim names another model. `claims.json` (a copy is in `data/`) gives the test of each claim,
our number under each set of assumptions, and the place in the paper.

Verdicts of the {count} claims: {tally}.

{treatments}
{sections}"""
# The verdicts in the order of the page, and what stands in a further column.
_FURTHER = {FAILS: [], HOLDS_UNDER: ["holds under"], UNTESTABLE: ["why not"], HOLDS: [], NOT_ASKED: []}


def markdown(claims: Sequence[Claim]) -> str:
    """Return the claims as a Markdown page."""
    counts = Counter(claim.verdict for claim in claims)
    sections = []
    for verdict, further in _FURTHER.items():
        own = [claim for claim in claims if claim.verdict == verdict]
        if own:
            table = markdown_table(["claim", "paper", "ours", *further], map(_cells, own))
            sections.append(f"\n## {verdict.capitalize()}\n\n{table}")
    return _PAGE.format(
        count=len(claims),
        tally=", ".join(f"{verdict} {count}" for verdict, count in counts.most_common()),
        treatments="\n".join(f"- `{treatment.name}`: {treatment.words}." for treatment in TREATMENTS),
        sections="\n".join(sections) + "\n",
    )


def _cells(claim: Claim) -> list[str]:
    """Return the claim without its test, the paper's number and ours; for some verdicts, the assumptions or why."""
    statement = f"`{claim.id}`: " + re.split(r" (?:Tested|Ours|We read)\b", claim.claim)[0].replace("|", "/")
    ours_is = re.search(r"Ours: (.*?\.)(?: |$)", claim.claim)
    if ours_is and claim.verdict in (FAILS, HOLDS_UNDER):
        statement += f" Ours: {ours_is[1]}"
    unit = "" if claim.unit == "1" else f" {claim.unit}"
    paper = f"{claim.paper:.4g}{unit}" if isinstance(claim.paper, float) else str(claim.paper)
    if not claim.asked:
        return [statement, paper, "-"]
    numbers = [finding.number for finding in claim.findings if finding.number is not None]
    ours = _shown(claim.findings[0].number) + unit
    if numbers and f"{min(numbers):.3g}" != f"{max(numbers):.3g}":
        ours += f" ({min(numbers):.3g} to {max(numbers):.3g})"
    cells = [statement, paper, ours]
    if claim.verdict == HOLDS_UNDER:
        cells.append(", ".join(finding.assumptions for finding in claim.findings if finding.holds))
    elif claim.verdict == UNTESTABLE:
        cells.append("; ".join(dict.fromkeys(finding.assumptions for finding in claim.findings)))
    return cells


def _shown(number: float | None) -> str:
    return "not flown" if number is None else f"{number:.3g}"


class Change(NamedTuple):
    """A claim, its earlier and its present verdict, and why claim, test or verdict differ."""

    id: str
    before: str
    now: str
    why: str

    @property
    def same(self) -> bool:
        """Whether the verdict is unchanged."""
        return self.before == self.now


def read_verdicts(path: str | Path) -> list[dict[str, Any]]:
    """Return the rows of a claims.json that an earlier run wrote.

    Raises
    ------
    FileError : the file cannot be read, or does not hold claims.
    """
    try:
        rows = json.loads(read_text(path, limit=_LIMIT))
        if not isinstance(rows, list):
            raise TypeError("claims are a list")
        for row in rows:
            if not isinstance(row["claim"], str) or not isinstance(row["verdict"], str):
                raise TypeError("a verdict is no text")
        return [{**row, "id": str(row["id"])} for row in rows]
    except (TypeError, ValueError, KeyError, AttributeError):
        raise FileError(f"cannot read {str(path)!r} as claims; give the claims.json of another run") from None


def verdict_changes(before: Sequence[dict[str, Any]], claims: Sequence[Claim]) -> list[Change]:
    """Return the changes from the claims of an earlier run to the present ones, including new claims, in order.

    Claims that the present run does not test are left out.
    """
    old = {row["id"]: row for row in before}
    found = [_change(old.get(claim.id), claim) for claim in claims if claim.asked]
    here = {claim.id for claim in claims}
    return found + [
        Change(name, row["verdict"], _NONE, "no longer tested") for name, row in old.items() if name not in here
    ]


def _change(row: dict[str, Any] | None, claim: Claim) -> Change:
    if row is None:
        return Change(claim.id, _NONE, claim.verdict, "new")
    if row["claim"] != claim.claim.replace("|", "/"):
        return Change(claim.id, row["verdict"], claim.verdict, "worded differently")
    then, now = (
        "no number" if number is None else f"{number:.3g}" for number in (row.get("ours"), claim.findings[0].number)
    )
    why = "tested as before"
    if then != now:
        why = f"same test, new orbits: our number was {then} and is now {now}"
    return Change(claim.id, row["verdict"], claim.verdict, why)


def changes_table(changes: Sequence[Change]) -> list[str]:
    """Return the lines of a section for the page of claims: every verdict that changed, and how many did not."""
    moved = [change for change in changes if not change.same]
    rows = [[f"`{change.id}`", change.before, change.now, change.why] for change in moved]
    return [
        "## What changed in the verdicts, and why",
        "",
        f"Compared with an earlier run, {len(moved)} verdicts changed and {len(changes) - len(moved)} did not.",
        "",
        markdown_table(["claim", "before", "now", "why"], rows),
        "",
    ]
