"""Which verdicts changed since an earlier run, and why: one table beside the claims."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from wingbeat._base import FileError, read_text
from wingbeat_evidence.paper.claim import Claim

_LIMIT = 1 << 26
_NONE = "-"
# An earlier claim, and the claims that replace it.
REPLACED = {
    "pigeon-agrees": ("pigeon-agrees", "pigeon-agrees-usherwood", "pigeon-agrees-pennycuick"),
    "pigeon-dickinson-off": ("pigeon-dickinson-off-usherwood", "pigeon-dickinson-off-pennycuick"),
    "pigeon-closer-at-speed": ("pigeon-closer-at-speed-usherwood", "pigeon-closer-at-speed-pennycuick"),
    "less-pitching": ("less-pitching-pigeon", "less-pitching-bat"),
}
_REFERENCE = (
    "the pigeon is now judged by two references, Usherwood et al. 2005 and Pennycuick 1996, no longer by 6.25 Hz, "
    "which was our own guess"
)
_SMALL = (
    "'small' now means small compared with the coefficient's own maximum, as the paper uses the word for the drag "
    "of its plate"
)
_SEPARATELY = "each animal is now judged separately; before, the worse of the two results decided for both animals"
_IN_LINE = (
    "'in line with' now means that one wing's C_L, at the angle where the other wing's C_L peaks, is at most 5 % "
    "below its own maximum. C_L is flat near its peak, so the earlier limit of 2 degrees between the peaks was too "
    "strict"
)
# Claims whose test is unchanged, in clearer words.
_CLEARER = (
    "blockage",
    "aspect-ratio",
    "repeats",
    "collapse",
    "r-squared",
    "usherwood-reynolds",
    "lift-slope",
    "exponential-term",
    "lift-peak-angle",
    "lift-decay",
    "dickinson-slope",
    "extra-lift",
    "drag-at-zero",
    "drag-max",
    "drag-monotonic",
    "drag-below-dickinson",
    "drag-normal-plate",
    "moment-slope",
    "moment-like-lift",
    "moment-peak",
    "moment-rises",
    "moment-measured",
    "centre-limit",
    "centre-monotonic",
    "centre-plateau",
    "smaller-lift",
    "smaller-drag",
    "lift-to-drag",
    "rotation-gain",
    "formulas-differentiable",
    "drag-alike-in-form",
    "own-reynolds",
    "transient-cut",
    "comparable-magnitudes",
    "edge-vortex",
    "closed-loops",
    "open-loop",
    "printed-sign",
    "stable",
    "least-frequency",
    "bat-slow-alike",
    "bat-parts",
    "bat-agrees",
    "bat-invariant",
    "twice-the-frequency",
    "smaller-alpha-1-of-4",
    "smaller-alpha-3-of-4",
    "smaller-horizontal-force",
    "smaller-vertical-force",
    "hand-alpha",
    "arm-lifts",
    "hand-thrusts",
    "arm-drags",
    "arm-pitches-least",
    "force-balance",
    "peak-power-su-fan",
    "peak-power-dickinson",
    "four-times",
    "power-exponent",
    "measured-power-below",
    "lower-power",
    "pitch-range-su-fan",
    "pitch-range-dickinson",
    "few-degrees",
    "differentiable",
    "small-angles-critical",
    "hand-leaves-small-angles",
    "arm-angle-smaller-throughout",
    "higher-drag-penalty",
    "over-prediction",
    "many-wingbeats",
    "drag-costs-thrust",
)
# Why a claim is worded differently from before, by its present id.
ASKED_OTHERWISE = {
    **dict.fromkeys(_CLEARER, "the same test in clearer words; a new verdict comes from new orbits"),
    "pigeon-agrees": "the data that the paper plots were not available, and 6.25 Hz was our own guess",
    **{
        f"pigeon-{what}-{by}": _REFERENCE
        for what in ("agrees", "dickinson-off", "closer-at-speed")
        for by in ("usherwood", "pennycuick")
    },
    "gains-at-speed": _REFERENCE,
    "bat-closer-at-speed": "the same test; the claim now says that its 6 Hz for bats come from the paper",
    "less-pitching-pigeon": _SEPARATELY,
    "less-pitching-bat": _SEPARATELY,
    "animals-reynolds": "judged at each speed, no longer only at 10 m/s",
    "two-dimensional": "the flow was not measured, and the lift slope of a thick plate does not decide this",
    "same-peak-as-insects": _IN_LINE,
    "same-peak-as-bird-wing": f"new: the paper's own second example; {_IN_LINE}",
    "dickinson-drag-small": _SMALL,
    "dickinson-lift-small": f"new: the paper says this of lift as well; {_SMALL}",
    "drag-penalty-small": f"new: this is the drag that the paper calls small; {_SMALL}",
    "arm-nose-up": "'a small nose-up pitch' now means positive and at most 13 degrees, no longer only positive",
    "closer-power": "'much closer' now means at most half the difference; before, it meant closer by any amount",
    "wing-shape": "judged also with wings of equal second moment of area, no longer only of equal area",
}


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
    origin = {new: name for name in old for new in REPLACED.get(name, (name,))}
    found = [_change(old.get(origin.get(claim.id, claim.id)), claim) for claim in claims if claim.asked]
    here = {claim.id for claim in claims}
    for name, row in old.items():
        if not here & set(REPLACED.get(name, (name,))):
            found.append(Change(name, row["verdict"], _NONE, "no longer tested"))
    return found


def _change(row: dict[str, Any] | None, claim: Claim) -> Change:
    if row is None:
        return Change(claim.id, _NONE, claim.verdict, ASKED_OTHERWISE.get(claim.id, "new"))
    if row["id"] != claim.id or row["claim"] != claim.claim.replace("|", "/"):
        why = ASKED_OTHERWISE.get(claim.id, "worded differently")
    else:
        then, now = (_shown(number) for number in (row.get("ours"), claim.findings[0].number))
        why = (
            f"same test, new orbits: our number was {then} and is now {now}" if then != now else "tested as before"
        )
    return Change(claim.id, row["verdict"], claim.verdict, why)


def _shown(number: float | None) -> str:
    return "no number" if number is None else f"{number:.3g}"


def changes_table(changes: Sequence[Change]) -> list[str]:
    """Return the lines of a section for the page of claims: every verdict that changed, and how many did not."""
    moved = [change for change in changes if not change.same]
    return [
        "## What changed in the verdicts, and why",
        "",
        f"Compared with an earlier run, {len(moved)} verdicts changed and {len(changes) - len(moved)} did not.",
        "",
        "| claim | before | now | why |",
        "| --- | --- | --- | --- |",
        *(f"| `{change.id}` | {change.before} | {change.now} | {change.why} |" for change in moved),
        "",
    ]
