"""The orbit record: everything about an orbit in one JSON-able dictionary, with warnings where it is doubtful."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from wingbeat._base import NOMENCLATURE, __version__
from wingbeat.aero import CamberedCoefficients, CoefficientModel, FamilyCoefficients
from wingbeat.aero.wake import ATTACHED_SHARE
from wingbeat.animal.actuators import Discharge
from wingbeat.animal.kinematics import ANGLES, Wingbeat, held_at
from wingbeat.animal.species.scaling import BIRD_FREQUENCY
from wingbeat.animal.vehicle import Air, Vehicle
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.state_rates import HINGE_STATE
from wingbeat.mechanics.wing_shape import flap_angles, has_room, lateral_corners
from wingbeat.orbits.flight.beat import Beat
from wingbeat.orbits.options import Status
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import judged_names
from wingbeat.orbits.problem.quantity import discharged, driven
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.starts import is_at_lower_bound
from wingbeat.records.hinges import hinge_numbers, hinge_warnings
from wingbeat.records.inputs import aero_record, vehicle_record, wingbeat_record
from wingbeat.records.judgements import OTHER_FREQUENCY, conditions_in_words, judged
from wingbeat.records.numbers import beat_numbers, detached_share, judged_values
from wingbeat.records.tables import finite_or_none


def orbit_record(solution: Solution) -> dict[str, Any]:
    """Return the record of an orbit; a number without a value, as any of a diverged flight, is None, never NaN."""
    problem, wingbeat, certificate = solution.problem, solution.wingbeat, solution.certificate
    flight = problem.vehicle, problem.air, problem.speed
    beat, price = solution.beat(), {}  # of stability, if also solved without the limits of stability
    if solution.free_objective is not None:
        price = {"free_objective": solution.free_objective, "price_of_stability": solution.price_of_stability}
    inner: dict[str, Any] = {} if certificate.wake is None else {"wake_closure": certificate.wake_miss}
    if certificate.hinge is not None:
        start = dict(zip(HINGE_STATE, certificate.hinge[0].tolist(), strict=True))
        inner = {"hinge_start": start, "hinge_closure": certificate.hinge_miss}
    record = {
        "status": solution.status.value,
        "message": solution.message,
        "species": problem.species.name,
        **({} if problem.origin is None else {"model": problem.origin.record()}),
        "vehicle": vehicle_record(problem.vehicle),
        "aero": aero_record(problem.aero),
        "air": dict(vars(problem.air)),
        "speed": float(problem.speed),
        "climb": float(problem.climb),
        **({"carried_mass": problem.species.carried_mass} if problem.species.carried_mass else {}),
        "objective": problem.minimise.name,
        "objective_value": solution.objective,
        "constraints": {str(c): solution.value_of(c.quantity, beat) for c in problem.subject_to},
        "frequency_basis": problem.frequency_basis,
        "wingbeat": wingbeat_record(wingbeat),
        "initial_state": dict(zip(State._fields, certificate.states[0].tolist(), strict=True)),
        "active_bounds": list(solution.active_bounds),
        "closure": dict(solution.closure),
        **inner,
        "failed_balance": [{**vars(s), "unit": s.unit} for s in solution.deficits],
        "relaxations": [dict(vars(r)) for r in solution.relaxations],
        "optimality": solution.optimality,
        "starts": solution.starts,
        "distinct_optima": solution.distinct_optima,
        "starts_at_best": solution.starts_at_best,
        **beat_numbers(*flight, beat, wingbeat.frequency, wingbeat.flap_amplitude),
        **hinge_numbers(
            problem.species.kind, problem.vehicle, wingbeat, problem.aero.strips, beat, certificate.hinge
        ),
        "detached_share": detached_share(problem.aero, problem.vehicle.wing, beat),
        "floquet_multipliers": [[float(m.real), float(m.imag)] for m in solution.multipliers],
        "stable": bool(np.abs(solution.multipliers).max() < 1.0) if solution.status is Status.CONVERGED else None,
        **price,
        **({} if solution.start is None else {"start": solution.start.record()}),
        "warnings": orbit_warnings(solution, beat),
        "solve_seconds": solution.seconds,
        "version": __version__,
    }
    record["plausibility"] = plausibility(problem, beat, record)
    if solution.steps is not None:
        unit = problem.minimise.scale
        rows = ((i, step._replace(objective=step.objective * unit)) for i, step in solution.steps)
        record["trace"] = [{"search": i, **step._asdict()} for i, step in rows]
    return finite_or_none(record)


# The wake matters at speeds up to about three times the induced velocity of hover. At that speed it changes alpha
# by about 10 %.
_SLOW = 3.0
_MENTION = 0.01
# Pitching by this much within a wingbeat turns a sixth of the lift alternately into thrust and drag.
_SWING = math.radians(20.0)
# Number of phases at which a stroke is checked. Limits above which there is a warning: how far the wing goes across
# the plane of symmetry (share of the semi-span), and how far it goes past the shoulder's range [rad].
_STROKE_SAMPLES, _ACROSS, _PAST = 256, 1e-4, 1e-3
# Reduced frequency above which the lag of the wake matters: Theodorsen's function falls there to 0.69 of steady
# lift, and at 1 to 0.55.
_LAG = 0.3
# Terms of attached flow, and the choices that add them.
_ATTACHED = {"rotation and added mass": "unsteady", "the lag of the wake": "wake"}
# A frequency that another air changes by less than this share is as good as the same.
_NOTICED = 0.01
# Energy per mass of the best lithium cells on sale [Wh/kg]: a guess, rounded up.
_MOST_ENERGY = 350.0
_CURE = " (limit peak_motor_voltage, or add a cell)"
# Optima whose objectives differ by less than this share are practically equal.
_RIVAL = 0.01


def orbit_warnings(solution: Solution, beat: Beat) -> list[str]:
    """Return the warnings that a reader should see before trusting an orbit."""
    problem = solution.problem
    aero, vehicle, air = problem.aero, problem.vehicle, problem.air
    notes = list(problem.species.warnings)
    if aero.inflow == "none":  # momentum theory of a hovering actuator disc
        disc, speed = math.pi * vehicle.wing.semi_span**2, math.hypot(problem.speed, problem.climb)
        induced = math.sqrt(vehicle.mass * air.gravity / (2.0 * air.density * disc))
        if speed < _SLOW * induced:
            notes.append(
                f"the model has no induced flow: it understates power at {speed:.1f} m/s, which is below "
                f"{_SLOW * induced:.1f} m/s, three times the induced velocity of hover"
            )
    if aero.unsteady != "none" and aero.wake == "none":
        flaps = math.pi * solution.wingbeat.frequency * vehicle.wing.mean_chord
        reduced = flaps / problem.speed if problem.speed else math.inf
        if reduced > _LAG:
            here = "in hover" if math.isinf(reduced) else f"here {reduced:.2g}"
            notes.append(
                "the unsteady terms leave out the lag of the wake, which matters above a reduced frequency of "
                f"{_LAG:g} ({here}): the lift from alpha is overstated"
            )
    if aero.unsteady != "none" or aero.wake != "none":
        detached = detached_share(aero, vehicle.wing, beat)
        if detached > 1.0 - ATTACHED_SHARE:
            terms = " and ".join(name for name, on in _ATTACHED.items() if getattr(aero, on) != "none")
            notes.append(
                f"the flow is detached for {100 * detached:.0f} % of the beat: {terms} are terms of attached flow, "
                f"and beyond {100 * (1 - ATTACHED_SHARE):.0f} % they may make the loads worse"
            )
    if problem.frequency_basis in ("measured", "law", "guess") and problem.species.kind == "bird":
        notes += _other_frequency(problem)
    for part in aero.parts:
        where = "" if aero.hand == "none" else f" of the {part.name}"
        of_part = beat.strip_reynolds[:, part.strips], beat.alpha[:, part.strips]
        notes += _outside_fit(part.coefficients, *of_part, where) if of_part[0].size else []
    if solution.certificate.hinge is not None:
        notes += hinge_warnings(vehicle, aero, solution.wingbeat, beat, solution.certificate.hinge)
    if aero.upstroke_factor != 1:
        notes.append(f"the upstroke factor of {aero.upstroke_factor:g} is a guess: no source measured it")
    # Bounds that the user set do not count as guesses.
    own = problem.species.path_bounds | problem.species.bounds
    options = " --model animal" if problem.origin is not None and problem.origin.name == "animal" else ""
    for name in solution.active_bounds:
        if name in problem.species.guessed_bounds and problem.bounds[name] == own[name]:
            guess = f"that bound is a guess, see `wingbeat species NAME{options}`"
            notes.append(f"the optimum is at the bound of {name}; {guess}")
        if name in ("u", "w", "pitch_rate"):
            what = NOMENCLATURE[name].short_label
            notes.append(f"the initial {what} is at the solver's limit; do not trust this orbit")
    notes += battery_warnings(beat)
    swing = float(np.ptp(solution.certificate.pitch))
    if swing > _SWING:
        notes.append(
            f"the body pitches by {math.degrees(swing):.0f} degrees within each wingbeat; "
            "no flying animal that we know of pitches so much"
        )
    place, flown = (vehicle, aero.strips, solution.wingbeat, problem.bounds["flap"]), solution.certificate
    notes += crossing(*place, None if flown.hinge is None else (flown.phase, flown.hinge[:, 0]))
    if is_at_lower_bound(problem, solution.unknowns, solution.options.search.bound_tolerance):
        if solution.status is Status.CONVERGED:
            notes.append(
                f"the minimised frequency is at its lower bound, {problem.bounds['frequency'][0]:g} Hz: more "
                "starts cannot improve it. Other orbits at this bound are equally good. Lower the bound, minimise "
                "a power, or find the glides of this species with `wingbeat glide`"
            )
        return notes
    notes += rivals(solution)
    if solution.distinct_optima > 1:
        notes.append(
            f"{solution.starts} starts found {solution.distinct_optima} distinct optima; {solution.starts_at_best} "
            "ended in this one, the best found; a better one may exist"
        )
    return notes


def battery_warnings(beat: Beat) -> list[str]:
    """Warn of a battery that gives too little voltage or current for a beat, or has an impossible capacity."""
    battery, motor = beat.drive.battery, beat.drive.motor
    if battery is None or motor is None:
        return []
    found, notes = Discharge(*map(float, discharged(beat, driven(beat)))), []
    if not math.isfinite(found.needed):  # a diverged flight
        return []
    held, needs = f"the full battery has {found.full:.1f} V without load", f"the motor needs {found.needed:.1f} V"
    if max(found.needed, found.cutoff) >= found.full:
        why = needs if found.needed >= found.cutoff else f"its cut-off under this load needs {found.cutoff:.1f} V"
        notes.append(f"the battery cannot feed this beat: {held}, and {why}, sag included{_CURE}")
    elif found.needed > found.cutoff:
        notes.append(
            f"the battery's voltage ends the flight with {100 * found.charge_left:.0f} % of the charge left: at "
            f"the peak {needs} without load, sag included{_CURE}"
        )
    if 0.0 < battery.max_current < found.peak_current:
        least, most = f"{battery.max_current:.3g} A", f"{found.peak_current:.3g} A"
        notes.append(f"the battery gives up to {most} at the end of the flight, and may give at most {least}")
    if (held_energy := battery.capacity * found.full / beat.mass) > _MOST_ENERGY:
        notes.append(
            f"the battery's capacity of {battery.capacity:g} A h is {held_energy:.0f} Wh for each kg of the whole "
            f"robot; the best lithium cells alone hold {_MOST_ENERGY:.0f} Wh/kg"
        )
    return notes


def _other_frequency(problem: OrbitProblem) -> list[str]:
    """Warn that a bird's own frequency is not that of a load, of another mass or of thin air, and give theirs."""
    added, air, whole = problem.species.carried_mass, problem.air, problem.vehicle.mass

    def law(mass: float, density: float) -> float:
        return BIRD_FREQUENCY(mass, 1.0, 1.0, density, 1.0)

    times = law(whole, air.density) / law(whole - added, Air().density)
    if abs(times - 1) < _NOTICED:
        return []
    own = problem.species.own_frequency(problem.speed).value
    there = conditions_in_words({"density": air.density}, added).removeprefix(", ")
    theirs = f"{times * own:.4g}"
    return [f"{OTHER_FREQUENCY}; {there}, by Pennycuick's law, it is about {theirs} Hz: --frequency {theirs}"]


def rivals(solution: Solution) -> list[str]:
    """Warn of other optima that are nearly as good, and say where they differ most."""
    if solution.status is not Status.CONVERGED:
        return []
    best, unknowns = solution.objective, solution.problem.unknowns()
    near = [o for o in solution.optima if o.objective - best <= _RIVAL * abs(best)]
    away = [np.abs(o.unknowns - solution.unknowns) / unknowns.scale for o in near]
    others = [(o, a) for o, a in zip(near, away, strict=True) if a.max() > solution.options.search.same_optimum]
    if not others:
        return []
    other, apart = max(others, key=lambda pair: pair[1].max())
    place = int(apart.argmax())
    name, angle = unknowns.names[place], unknowns.names[place] in (*ANGLES, "body_pitch", "pitch_rate")
    here, there = (
        values[place] * (math.degrees(1.0) if angle else 1.0) for values in (solution.unknowns, other.unknowns)
    )
    unit = "" if not angle else " degrees/s" if name == "pitch_rate" else " degrees"
    return [
        f"other optima within 1 % of the best: {len(others)}; in the one that differs most, "
        f"{name} is {there:.3g}{unit}, and here it is {here:.3g}{unit}"
    ]


def crossing(
    vehicle: Vehicle,
    strips: int,
    wingbeat: Wingbeat,
    flap: tuple[float, float],
    flown: tuple[np.ndarray, np.ndarray] | None = None,
) -> list[str]:
    """Warn of wings that cross the plane of symmetry, and so each other, or that flap beyond their range [rad].

    `flown` has phases, and the angles there of a hinge that gives way. The solver avoids both, but knows such a
    hinge at its rest angle only; a prescribed wingbeat, such as a filmed one, may do both.
    """
    phase = np.arange(_STROKE_SAMPLES) / _STROKE_SAMPLES
    if flown is not None:
        phase, still = flown[0] % 1.0, np.zeros(len(flown[0]))
        wingbeat = held_at(wingbeat, phase, flown[1], still, still)
    leading, trailing = lateral_corners(vehicle.passive, wingbeat, phase, count=strips)
    pitch_axis = 0.75 * leading + 0.25 * trailing
    nearest = np.minimum(leading, trailing) if has_room(vehicle) else pitch_axis
    across, notes = -float(nearest.min()), []
    if across > _ACROSS * vehicle.wing.semi_span:
        notes.append(
            f"each wing passes through the plane of symmetry by up to {1e3 * across:.2g} mm, "
            "where it meets the other wing: no animal can do this"
        )
    angles, (low, high) = flap_angles(wingbeat, phase), flap
    if max(low - angles.min(), angles.max() - high) > _PAST:
        least, most, low, high = np.degrees([angles.min(), angles.max(), low, high])
        flaps = f"the wing flaps from {least:.0f} to {most:.0f} degrees"
        notes.append(f"{flaps}; the shoulder allows {low:.0f} to {high:.0f}")
    return notes


def _outside_fit(coefficients: CoefficientModel, reynolds: np.ndarray, alpha: np.ndarray, where: str) -> list[str]:
    notes = []
    if coefficients.reynolds_range is not None:
        low, high = coefficients.reynolds_range
        share = _outside(reynolds, low, high)
        if share > _MENTION:
            notes.append(
                f"Reynolds number outside the fitted {low:g} to {high:g} for {share:.0%} of strips and instants"
                f"{where} (it runs from {reynolds.min():.0f} to {reynolds.max():.0f})"
                + (": there the nearest polar holds" if isinstance(coefficients, FamilyCoefficients) else "")
            )
    low, high = coefficients.used_range_deg
    degrees, measured = np.degrees(alpha), coefficients.alpha_range_deg[1]
    share = _outside(degrees, low, high)
    if share > _MENTION:
        also = float(np.mean((degrees > high) & (degrees <= measured)))
        beyond = f"the extension '{coefficients.extension}' applies"
        if isinstance(coefficients, CamberedCoefficients):
            beyond = "the coefficients pass into those of a flat plate"
        notes.append(
            f"angle of attack outside the fitted {low:g} to {high:g} degrees for "
            f"{share:.0%} of strips and instants{where}: there {beyond}"
            + (f", also from {high:g} to {measured:g} degrees, which were measured ({also:.1%})" if also else "")
        )
    return notes + guessed(coefficients)


def guessed(coefficients: CoefficientModel) -> list[str]:
    """Warn if the coefficients are in part a guess."""
    if getattr(coefficients, "grade", "") != "C":
        return []
    name = coefficients.name
    return [f"the coefficients of {name} are in part a guess; wb.aero.WING_ESTIMATES marks the guessed numbers"]


def _outside(values: np.ndarray, low: float, high: float) -> float:
    return float(np.mean((values < low) | (values > high)))


def plausibility(problem: OrbitProblem, beat: Beat, record: dict[str, Any]) -> list[dict[str, Any]]:
    """Return name, value, unit, low, high, within and source of each judged number; SI and radians.

    An unknown end of a range is None. `within` is None if the number has no value (such as the Strouhal number in
    hover) or nothing is known of its range.
    """
    values, species = judged_values(record, beat, problem.vehicle.mass), problem.species
    return [judged(species, problem.speed, name, values[name]) for name in judged_names(species, problem.free)]
