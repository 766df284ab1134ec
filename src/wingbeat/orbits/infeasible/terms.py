"""Terms of a problem's air loads that are on, and the problem without one of them."""

from __future__ import annotations

import dataclasses
import math

from wingbeat.aero.blade_element import BladeElement
from wingbeat.animal.vehicle import Tail
from wingbeat.orbits.problem.problem import OrbitProblem

INFLOW, UNSTEADY, UPSTROKE, HAND, TAIL = "inflow", "unsteady", "upstroke_factor", "hand", "tail"
TERMS = (INFLOW, UNSTEADY, UPSTROKE, HAND, TAIL)
_OFF = {INFLOW: "none", UNSTEADY: "none", UPSTROKE: 1.0, HAND: "none"}


def terms_on(problem: OrbitProblem) -> tuple[str, ...]:
    """Return the terms of `TERMS` that a problem has; a tail whose tilt is free does not count."""
    tail = problem.vehicle.tail is not None and "tail_tilt" not in problem.free
    on = [name for name, off in _OFF.items() if getattr(problem.aero, name) != off]
    return (*on, *[TAIL] * tail)


def on_and_off(problem: OrbitProblem, name: str) -> tuple[float, float, str]:
    """Return the number that describes a term in a problem, its value without the term, and its unit.

    The number is the upstroke factor or the tail's area. For a term that can only be on or off, the number is 1,
    and its value without the term is 0.
    """
    if name == UPSTROKE:
        return problem.aero.upstroke_factor, 1.0, "1"
    if name == TAIL and problem.vehicle.tail is not None:
        return problem.vehicle.tail.area, 0.0, "m2"
    return 1.0, 0.0, "1"


def without_term(problem: OrbitProblem, name: str) -> OrbitProblem:
    """Return the problem without one of its terms."""
    if name == TAIL:
        return _with_tail(problem, None)
    aero = dataclasses.replace(
        problem.aero,
        **{name: _OFF[name]},
        **({"hand_from": BladeElement.hand_from} if name == HAND else {}),
        **({"share": 1.0} if {INFLOW, UNSTEADY} & set(terms_on(problem)) == {name} else {}),
    )
    return dataclasses.replace(problem, aero=aero)


def with_trace_of(problem: OrbitProblem, name: str, trace: float) -> OrbitProblem | None:
    """Return the problem with one of its terms scaled to the share `trace`; None if the term is the hand.

    The compiled programs of the full problem also run this problem. If the term is inflow, the coefficients remain
    those of wing sections.
    """
    aero = problem.aero
    if name == TAIL:
        tail = problem.vehicle.tail
        assert tail is not None
        return _with_tail(problem, dataclasses.replace(tail, area=trace * tail.area))
    if name == HAND:
        return None
    if name == UPSTROKE:
        changed = {UPSTROKE: 1.0 - trace}
    elif name == INFLOW:
        changed = {"induced_factor": trace * aero.induced_factor}
    else:  # the share of the unsteady terms multiplies the induced factor, too
        changed = {"share": trace, "induced_factor": aero.share * aero.induced_factor / trace}
    return dataclasses.replace(problem, aero=dataclasses.replace(aero, **changed))


def _with_tail(problem: OrbitProblem, tail: Tail | None) -> OrbitProblem:
    vehicle = dataclasses.replace(problem.vehicle, tail=tail)
    return dataclasses.replace(problem, species=problem.species.with_record(vehicle))


def words_without(problem: OrbitProblem, name: str, frequency: float) -> str:
    """Return a sentence which says that a problem has an orbit without one of its terms.

    Parameters
    ----------
    problem, name : the problem, and one of its terms.
    frequency : of that orbit [Hz].
    """
    closes = f"this flight closes at {frequency:.3g} Hz"
    if name == INFLOW:
        ratio = problem.aero.coefficients.aspect_ratio
        why = f"the coefficients, measured on a wing of aspect ratio {ratio:g}, then include its induced flow"
        if math.isinf(ratio):
            why = (
                "the coefficients are stated to be those of a section, without induced flow; if they were measured "
                "on a finite wing, they already include it"
            )
        return f"without momentum inflow {closes}: {why}"
    if name == UNSTEADY:
        return f"without the unsteady terms {closes}: rotation, added mass and couples make the difference"
    if name == UPSTROKE:
        return f"with upstroke_factor 1 in place of {problem.aero.upstroke_factor:g}, {closes}"
    if name == HAND:
        return f"with the arm's coefficients from root to tip, without those of the hand, {closes}"
    return f"without the tail {closes}"
