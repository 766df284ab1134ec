"""Every claim of the paper in one table: judged, and written as claims.json and .md with the records behind."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from wingbeat.files import write_atomically
from wingbeat.paper import energy_claims as energy
from wingbeat.paper import flight_claims as flight
from wingbeat.paper.argument_claims import argument_claims
from wingbeat.paper.claim import Claim, FlightClaim
from wingbeat.paper.coefficient_claims import coefficient_claims
from wingbeat.paper.experiment_claims import experiment_claims
from wingbeat.paper.premise_claims import premise_claims
from wingbeat.paper.treatments import TAPERED, TREATMENTS, Orbits

_RESULTS, _DISCUSSION = "results, simulations", "discussion, simulations"
_PARTS = (
    "the two models part as the bat flies faster than 5 m/s (tested: trend of Dickinson's frequency over Su-Fan's "
)


def flight_claim_list() -> list[FlightClaim]:
    """Return the claims about flight that every treatment is asked about."""
    return [
        FlightClaim(
            "closed-loops",
            "results, sample orbit",
            "height, pitch and velocities return after a beat: their loops are closed (tested: largest miss in SI "
            "units when flown by an independent integrator, at most 1e-6)",
            "closed",
            "SI",
            flight.closed_loops,
        ),
        FlightClaim(
            "open-loop",
            "results, sample orbit",
            "u against x stays open by the distance flown (tested: distance gained is speed times period)",
            "open",
            "m",
            flight.open_loop,
        ),
        FlightClaim(
            "printed-sign",
            "methods, periodic orbit",
            "the condition as printed, q(t) = q(t+T) + U T, gives forward flight (ours: the speed it gives)",
            10.0,
            "m/s",
            flight.printed_sign,
        ),
        FlightClaim(
            "stable",
            "methods, simulation",
            "the solutions found are stable periodic ones (tested: largest size of a Floquet multiplier of body "
            "pitch, "
            "velocities and pitch rate over all Su-Fan orbits, below 1)",
            "stable",
            "1",
            flight.stable,
        ),
        FlightClaim(
            "least-frequency",
            "methods, simulation",
            "the optimisation finds the one wingbeat of least frequency (tested: searches from several starts end "
            "at one optimum, or else what is found hangs on the start; ours: most distinct optima of one orbit)",
            "the one",
            "1",
            flight.least_frequency,
        ),
        FlightClaim(
            "pigeon-agrees",
            _RESULTS,
            "above 10 m/s the pigeon's frequency agrees very well with the measured one (tested: mean "
            "deviation from "
            f"{flight.PIGEON_MEASURED:g} Hz, the middle of 5.5 to 7 Hz, at most 15 %)",
            "remarkably well",
            "1",
            flight.pigeon_agrees,
        ),
        FlightClaim(
            "pigeon-dickinson-off",
            _RESULTS,
            "above 10 m/s Dickinson's coefficients agree poorly for the pigeon (tested: the same deviation "
            "above 15 %)",
            "poor",
            "1",
            flight.pigeon_dickinson_off,
        ),
        flight.closer_at_speed("pigeon", flight.PIGEON_MEASURED),
        flight.closer_at_speed("bat", flight.BAT_MEASURED),
        FlightClaim(
            "bat-slow-alike",
            _RESULTS,
            "up to 5 m/s both models give the bat a like frequency (tested: ratio within 15 %)",
            "similar",
            "1",
            flight.bat_slow_alike,
        ),
        FlightClaim("bat-parts", _RESULTS, f"{_PARTS}up to 12 m/s)", "> 0", "s/m", flight.bat_parts),
        FlightClaim(
            "bat-agrees",
            _RESULTS,
            f"from 5 to 10 m/s the bat's frequency agrees very well with the measured {flight.BAT_MEASURED:g} Hz "
            "(tested: mean deviation at most 15 %)",
            "very well",
            "1",
            flight.bat_agrees,
        ),
        FlightClaim(
            "bat-invariant",
            "results; discussion",
            "live animals' frequency does not change with speed, and the predicted one agrees from 5 to 10 m/s "
            "(tested, in our reading: spread of the predicted frequency there over its mean at most 15 %)",
            "agrees",
            "1",
            flight.bat_invariant,
        ),
        FlightClaim(
            "twice-the-frequency",
            _DISCUSSION,
            "near 10 m/s Dickinson's frequency is almost twice Su-Fan's (tested: bat, 1.7 to 2.3)",
            2.0,
            "1",
            flight.twice_the_frequency,
        ),
        flight.smaller_alpha(0.25),
        flight.smaller_alpha(0.75),
        flight.smaller_force(0, "horizontal"),
        flight.smaller_force(2, "vertical"),
        FlightClaim(
            "hand-alpha",
            _DISCUSSION,
            "the hand has the larger angle of attack, with either model (tested: mean size at 3/4 less that at 1/4 "
            "span, bat at 10 m/s; ours: the lesser of the models)",
            "> 0",
            "deg",
            flight.hand_alpha_larger,
        ),
        FlightClaim(
            "arm-lifts",
            _DISCUSSION,
            "the arm lifts, more than the hand, with either model (tested: mean upward force over weight at 1/4 "
            "less "
            "that at 3/4 span)",
            "> 0",
            "1",
            flight.arm_lifts,
        ),
        FlightClaim(
            "hand-thrusts",
            _DISCUSSION,
            "the hand gives the thrust, with either model (tested: its mean forward force over weight)",
            "> 0",
            "1",
            flight.hand_thrusts,
        ),
        FlightClaim(
            "arm-drags",
            _DISCUSSION,
            "the arm has more drag than the hand, with either model (tested: mean forward force over weight at 1/4 "
            "less that at 3/4 span)",
            "< 0",
            "1",
            flight.arm_drags,
        ),
        FlightClaim(
            "arm-pitches-least",
            _DISCUSSION,
            "with Su-Fan the arm needs little pitching (tested: the root's pitch amplitude less Dickinson's, "
            "bat at "
            "10 m/s)",
            "< 0",
            "deg",
            flight.arm_pitches_least,
        ),
        FlightClaim(
            "force-balance",
            _DISCUSSION,
            "over a beat lift equals weight and thrust equals drag (tested: largest departure over weight, by 256 "
            "samples, below .01)",
            0.0,
            "1",
            flight.force_balance,
        ),
        energy.peak_power("su-fan"),
        energy.peak_power("dickinson"),
        FlightClaim(
            "four-times",
            _DISCUSSION,
            "Dickinson's peak power at 10 m/s is four times Su-Fan's (tested: bat, 3 to 5; the paper's own "
            "peaks give 5)",
            4.0,
            "1",
            energy.four_times,
        ),
        FlightClaim(
            "power-exponent",
            _DISCUSSION,
            "power goes roughly as frequency squared (tested: exponent from the two models' peaks at 10 m/s, "
            "1.5 to "
            "2.5; 0 where the frequencies are within 5 %)",
            2.0,
            "1",
            energy.power_exponent,
        ),
        FlightClaim(
            "measured-power-below",
            _DISCUSSION,
            "the less than 4 W found for like bats lies below what either model gives (tested: lower peak power)",
            "> 4",
            "W",
            energy.measured_power_below,
        ),
        FlightClaim(
            "lower-power",
            "abstract",
            "Su-Fan's coefficients lead to lower power (tested: mean positive power at 10 m/s, both animals; "
            "ours: the "
            "larger ratio to Dickinson's)",
            "< 1",
            "1",
            energy.lower_power,
        ),
        energy.pitch_range("su-fan", bound=True),
        energy.pitch_range("dickinson", bound=False),
        FlightClaim(
            "few-degrees",
            _DISCUSSION,
            "the bat's body pitches by a few degrees only, as in life (tested: Su-Fan's range at 10 m/s at most "
            "5 deg)",
            "few",
            "deg",
            energy.few_degrees,
        ),
        FlightClaim(
            "less-pitching",
            "abstract; discussion",
            "Su-Fan's coefficients lead to less body pitching (tested: range at 10 m/s, both animals; ours: the "
            "larger "
            "ratio to Dickinson's)",
            "< 1",
            "1",
            energy.less_pitching,
        ),
        FlightClaim(
            "differentiable",
            "discussion, last paragraph",
            "the formulas suit gradient-based optimisation (tested: the sample orbits, found by gradients, are "
            "optima: "
            "largest residual of the optimality conditions at most 1e-5)",
            "suitable",
            "1",
            flight.differentiable,
        ),
    ]


def judge_claims(orbits: Orbits) -> list[Claim]:
    """Return every claim with its verdict.

    Parameters
    ----------
    orbits : the orbits of all treatments (`wingbeat.paper.treatments.solve_cases`).
    """
    everywhere = [t.name for t in TREATMENTS if any(case.treatment == t.name for case in orbits)]
    planform = flight.planform_matters(orbits).judge(orbits, [TAPERED])
    return [
        *experiment_claims(),
        *coefficient_claims(),
        *premise_claims(),
        planform,
        *(c.judge(orbits, everywhere) for c in (*flight_claim_list(), *argument_claims())),
    ]


def write_claims(claims: Sequence[Claim], orbits: Orbits, folder: Path) -> list[Path]:
    """Write claims.json, claims.md and, under ``orbits``, the records of the orbits that the claims look at.

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
    write_atomically(written[1], markdown(claims))
    for name in used:
        path = folder / "orbits" / f"{name}.json"
        write_atomically(path, json.dumps(records[name].record(), indent=1) + "\n")
        written.append(path)
    return written


def markdown(claims: Sequence[Claim]) -> str:
    """Return the claims as a page to read."""
    counts = Counter(claim.verdict for claim in claims)
    tally = ", ".join(f"{count} {verdict}" for verdict, count in counts.most_common())
    lines = [
        "# The paper's claims beside ours",
        "",
        "Su, Fan, Onoue, Vejdani and Breuer, arXiv 2302.09602. One row for each quantitative or directional claim; "
        "our number is under our default assumptions, the first of those below. A claim *holds* if it does "
        "under every "
        "set of assumptions tried, *holds under* those named, or *fails* under all. What holds is consistent "
        "with the "
        "paper; it does not prove that the authors assumed the same.",
        "",
        f"{len(claims)} claims: {tally}.",
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
    cells = [claim.claim, claim.where, paper, _shown(claim.findings[0].number), claim.unit, claim.verdict, each]
    return "| " + " | ".join(cell.replace("|", "/") for cell in cells) + " |"


def _shown(number: float | None) -> str:
    return "not flown" if number is None else f"{number:.3g}"


def _mark(holds: bool | None) -> str:
    return "" if holds is None else " (yes)" if holds else " (no)"
