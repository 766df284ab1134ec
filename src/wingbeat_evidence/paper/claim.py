"""A claim of the paper, what our model finds for it under each set of assumptions, and the verdict."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat.results.orbit import Orbit
from wingbeat_evidence.paper.treatments import SAMPLE_SPEED, TREATMENTS, Case, Orbits

# Our number, and whether the claim holds.
TestResult = tuple[float, bool]
HOLDS, HOLDS_UNDER, FAILS, UNTESTABLE = "holds", "holds under", "fails", "cannot be tested"
NOT_ASKED = "not tested with --quick"


@dataclass(frozen=True)
class Finding:
    """Our number under one set of assumptions, whether the claim holds (None: untestable), and the orbits used."""

    assumptions: str
    number: float | None
    holds: bool | None
    orbits: tuple[str, ...] = ()


@dataclass(frozen=True)
class Claim:
    """One claim: its place in the paper, its statement and test in our words, the paper's number, and our findings.

    The first finding is under our default assumptions; its number is shown beside the paper's.
    """

    id: str
    where: str
    claim: str
    paper: float | str
    unit: str
    findings: tuple[Finding, ...]
    asked: bool = True

    @property
    def verdict(self) -> str:
        """Whether the claim holds under all, some or no assumptions, cannot be tested, or was not tested."""
        if not self.asked:
            return NOT_ASKED
        told = [finding.holds for finding in self.findings if finding.holds is not None]
        if not told:
            return UNTESTABLE
        return HOLDS if all(told) else HOLDS_UNDER if any(told) else FAILS

    def row(self) -> dict[str, Any]:
        """Return the claim as a row of claims.json."""
        return {
            "id": self.id,
            "where": self.where,
            "claim": self.claim,
            "paper": self.paper,
            "ours": self.findings[0].number,
            "unit": self.unit,
            "verdict": self.verdict,
            "assumptions": [
                {"name": f.assumptions, "ours": f.number, "holds": f.holds, "words": _words(f.assumptions)}
                for f in self.findings
            ],
            "orbits": sorted({orbit for finding in self.findings for orbit in finding.orbits}),
        }


def _words(assumptions: str) -> str:
    return next((t.words for t in TREATMENTS if t.name == assumptions), assumptions)


NO_DATA = "the paper's measurements are not public"


def tested(name: str, where: str, claim: str, paper: float | str, unit: str, ours: float, holds: Any) -> Claim:
    """Return a claim that is tested on printed numbers and formulas alone, without any assumption."""
    finding = Finding("no assumption needed", float(ours), bool(holds))
    return Claim(name, where, claim, paper, unit, (finding,))


def untestable(name: str, where: str, claim: str, paper: float | str, unit: str, ours: float, why: str) -> Claim:
    """Return a claim that we cannot test, with a number of ours for comparison and the reason why."""
    return Claim(name, where, claim, paper, unit, (Finding(why, float(ours), None),))


class NotFlownError(Exception):
    """A claim needs an orbit that was not solved or not certified."""


class Evidence:
    """The certified orbits of one treatment; `used` records which of them the claim's test has used."""

    def __init__(self, orbits: Orbits, treatment: str) -> None:
        self.treatment = treatment
        self._orbits = orbits
        self.used: set[str] = set()

    def orbit(self, animal: str, model: str, speed: float = SAMPLE_SPEED) -> Orbit:
        """Return a certified orbit.

        Raises
        ------
        NotFlownError : there is none.
        """
        case = Case(self.treatment, animal, model, float(speed))
        orbit = self._orbits.get(case)
        if orbit is None or orbit.status.value != "converged":
            raise NotFlownError(case.name)
        self.used.add(case.name)
        return orbit

    def record(self, animal: str, model: str, speed: float = SAMPLE_SPEED) -> dict[str, Any]:
        """Return the record of a certified orbit."""
        return self.orbit(animal, model, speed).record()

    def speeds(self, animal: str, *models: str, above: float = 0.0, below: float = np.inf) -> np.ndarray:
        """Return the speeds from `above` to `below` [m/s] at which all these models have a certified orbit.

        Raises
        ------
        NotFlownError : there are none.
        """
        flown = [
            {
                c.speed
                for c, orbit in self._orbits.items()
                if (c.treatment, c.animal, c.model) == (self.treatment, animal, model)
                and orbit.status.value == "converged"
                and above <= c.speed <= below
            }
            for model in models
        ]
        both = sorted(set.intersection(*flown))
        if not both:
            raise NotFlownError(f"{self.treatment} {animal}")
        return np.array(both)

    def frequencies(self, animal: str, model: str, speeds: np.ndarray) -> np.ndarray:
        """Return the lowest frequencies at these speeds [Hz]."""
        return np.array([self.orbit(animal, model, speed).wingbeat.frequency for speed in speeds])


@dataclass(frozen=True)
class FlightClaim:
    """A claim about flight, and the test that gives our number and verdict from one treatment's orbits."""

    id: str
    where: str
    claim: str
    paper: float | str
    unit: str
    test: Callable[[Evidence], TestResult]

    def unasked(self) -> Claim:
        """Return the claim without a verdict, for runs with too few flights to test it."""
        finding = Finding(NOT_ASKED, None, None)
        return Claim(self.id, self.where, self.claim, self.paper, self.unit, (finding,), asked=False)

    def judge(self, orbits: Orbits, treatments: Sequence[str]) -> Claim:
        """Test the claim under each treatment."""
        findings = []
        for treatment in treatments:
            evidence = Evidence(orbits, treatment)
            try:
                number, holds = self.test(evidence)
                finding = Finding(treatment, float(number), bool(holds), tuple(sorted(evidence.used)))
            except NotFlownError:
                finding = Finding(treatment, None, None, tuple(sorted(evidence.used)))
            findings.append(finding)
        return Claim(self.id, self.where, self.claim, self.paper, self.unit, tuple(findings))
