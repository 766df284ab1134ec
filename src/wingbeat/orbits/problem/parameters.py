"""The numbers of a problem that the solver does not choose: names, plausible ranges, and how to change one."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import harmonic_place, plain_unit
from wingbeat._jax.arrays import at_default
from wingbeat.aero import CoefficientModel
from wingbeat.animal.kinematics import FREE_NAMES, HINGE_NAMES, Wingbeat, in_use, parameter, with_parameters
from wingbeat.animal.species.numbers import path_of
from wingbeat.animal.species.species import Species
from wingbeat.animal.vehicle import CHORDWISE, STATIONS, Wing

if TYPE_CHECKING:
    from wingbeat.orbits.problem.problem import OrbitProblem

CURVES = {"lift": "lift_terms", "drag": "drag_terms", "centre": "centre_terms", "wing": "terms"}
SIDES = ("lower", "upper")
_NO_PARAMETERS = ("crank", "cells")  # a switch and a count
# Numbers whose default leaves a term out.
_OFF = ("crossflow_area", *CHORDWISE)
# Of a wing whose pitch gives way, these matter as much as the stiffness: where the species file is silent they are
# drawn, by a guess, from this much to either side [chords]. In a trial, 0.1 to 0.15 chords moved the pitch
# amplitude of two robots by 35 to 130 % and their power by up to 90 %.
_MATTERS_TO_HINGES = ("pitch_axis", "mass_axis")
_AROUND = 0.1

# Path from a problem to one of its numbers: names of fields, indices of tuples.
Place = tuple[str | int, ...]


class Parameter(NamedTuple):
    """One number of a problem."""

    path: str  # its name as in ``--set`` and the record: ``wing.mass``, ``air.density``, ``aero.lift.amplitude``
    unit: str  # ``1`` if it has none
    value: float  # SI and radians, but degrees as published where the name ends in ``_deg``
    size: float  # magnitude of the value, or a typical one if the value is 0; a change by this much is large
    place: Place  # path from the problem to the number
    plausible: tuple[float, float] | None = None  # lowest and highest value, where the species file gives them
    guessed: bool = False  # whether that range is our guess, because the species file is silent

    def changed(self, problem: OrbitProblem, value: float) -> OrbitProblem:
        """Return the problem with this number at another value; an impossible one raises `InvalidInputError`."""
        return with_number(problem, self.place, value)


def with_number(record: Any, place: Place, value: float) -> Any:
    """Return a copy of a problem, or of one of its parts, with the number at one place replaced."""
    if not place:
        return value
    head, rest = place[0], place[1:]
    if isinstance(record, Wingbeat):
        return with_parameters(record, {str(head): value})
    if isinstance(record, dict):
        return record | {head: with_number(record[head], rest, value)}
    if isinstance(head, int):
        return (*record[:head], with_number(record[head], rest, value), *record[head + 1 :])
    changed = with_number(getattr(record, head), rest, value)
    if isinstance(record, Wing) and head == "mass":
        return record.weighing(changed)
    if isinstance(record, Species):
        return record.with_record(changed)
    # Nothing else changes with the speed: neither an animal's own frequency nor its posture.
    held = {"own_frequency": False, "own_posture": False} if place == ("speed",) else {}
    return dataclasses.replace(record, **{head: changed}, **held)


def parameters_of(problem: OrbitProblem) -> list[Parameter]:
    """Return every number that the orbit depends on: vehicle, fixed wingbeat, air, coefficients and velocity.

    The list omits the wrist, which has no effect until it crosses the centre of a strip, parameters of motions that
    are off, and the numbers of coefficient models that are not formulas.

    >>> import wingbeat as wb
    >>> found = parameters_of(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0))
    >>> [p.path for p in found][:3], found[0].value
    (['body.mass', 'body.pitch_inertia', 'body.drag_area'], 0.276)
    """
    found = []
    for one in _every(problem):
        plausible = _plausible(problem, one)
        if plausible is not None:
            size = abs(one.value) or plausible[1] - plausible[0]
            one = one._replace(size=size, plausible=plausible)
        elif f"vehicle.{one.path}" not in problem.species.numbers and _through_hinge(problem, one.path):
            ends = max(one.value - _AROUND, 0.0), min(one.value + _AROUND, 1.0)
            one = one._replace(plausible=ends, guessed=True)
        found.append(one)
    return found


def _through_hinge(problem: OrbitProblem, path: str) -> bool:
    part, _, name = path.partition(".")
    return problem.species.wingbeat.pitch_hinge is not None and part == "wing" and name in _MATTERS_TO_HINGES


def _plausible(problem: OrbitProblem, parameter: Parameter) -> tuple[float, float] | None:
    """Return the species file's range; of the body's mass, that of the whole minus the wings' mass."""
    numbers = problem.species.numbers
    last = str(parameter.place[-1])
    if last in problem.species.free:  # fixed by the user, it counts as measured
        return None
    keys = [str(key) for key in parameter.place if not isinstance(key, int) and key != "species"]
    if last in HINGE_NAMES:
        keys = [path_of(last)]
    harmonic = harmonic_place(last)
    if harmonic is not None:
        keys[-1] = harmonic[0]
    number = numbers.get(".".join(keys))
    if parameter.path == "body.mass" and (number is None or number.range is None):
        whole = numbers.get("vehicle.mass")
        if whole is None or whole.range is None:
            return None
        wings = 2 * problem.vehicle.wing.mass
        return whole.range[0] - wings, whole.range[1] - wings
    return None if number is None else number.range


def _made(path: str, value: float, place: Place, size: float = 1.0) -> Parameter:
    return Parameter(path, plain_unit(path), float(value), abs(value) or size, place)


def _every(problem: OrbitProblem) -> Iterator[Parameter]:
    wing = problem.vehicle.wing
    # A table of masses counts by the wing's mass alone, and what it replaces not at all.
    left_out = *_NO_PARAMETERS, *STATIONS, *wing.replaced
    sizes = {"drag_area": wing.semi_span * wing.mean_chord, "arm": wing.mean_chord, "height": wing.mean_chord}
    for part, record in vars(problem.vehicle).items():
        for name, value in ({} if record is None else vars(record)).items():  # None: no tail
            path, place = f"{part}.{name}", ("species", "vehicle", part, name)
            if name in left_out:
                continue
            if isinstance(value, tuple):
                for i, item in enumerate(value):
                    here = f"{path}.{'xyz'[i]}" if name == "shoulder" else f"{path}[{i}]"
                    yield _made(here, item, (*place, i), size=wing.mean_chord)
            elif _through_hinge(problem, path) or not (name in _OFF and at_default(record, name)):
                yield _made(path, value, place, size=sizes.get(name, 1.0))
    wingbeat = problem.species.wingbeat
    for name in FREE_NAMES:
        if name not in problem.free and in_use(wingbeat, name):
            path = path_of(name).removeprefix("vehicle.")
            yield _made(path, parameter(wingbeat, name), ("species", "wingbeat", name))
    for name, value in vars(problem.air).items():
        yield _made(f"air.{name}", value, ("air", name))
    coefficients, place = problem.aero.coefficients, ("aero", "coefficients")
    yield from _curves(problem, "aero", coefficients, place)
    if problem.aero.hand != "none":
        yield from _curves(problem, "aero.hand", problem.aero.hand, ("aero", "hand"))
    if getattr(coefficients, "blend_width_deg", None) is not None:  # a function has no blends
        yield _made("aero.blend_width_deg", coefficients.blend_width_deg, (*place, "blend_width_deg"))
    if problem.aero.inflow != "none":
        yield _made("aero.induced_factor", problem.aero.induced_factor, ("aero", "induced_factor"))
    if problem.aero.upstroke_factor != 1:
        yield _made("aero.upstroke_factor", problem.aero.upstroke_factor, ("aero", "upstroke_factor"))
    yield _made("speed", problem.speed, ("speed",))
    yield _made("climb", problem.climb, ("climb",), size=max(problem.speed, 1.0))


def _curves(problem: OrbitProblem, path: str, coefficients: CoefficientModel, place: Place) -> Iterator[Parameter]:
    for curve, field in CURVES.items():
        terms = getattr(coefficients, field, None)
        # With the force at the quarter chord, the centre of pressure has no effect.
        if terms is None or (curve == "centre" and problem.aero.force_point == "quarter-chord"):
            continue
        for name, value in vars(terms).items():
            if value is not None:
                yield _made(f"{path}.{curve}.{name}", value, (*place, field, name))


def bound_of(problem: OrbitProblem, name: str, side: str) -> Parameter:
    """Return a bound as a parameter, such as ``bounds.flap_amplitude.upper`` or ``bounds.body_pitch.lower``."""
    pair = problem.bounds[name]
    size = 1.0 if plain_unit(name) == "rad" else pair[1] - pair[0]
    end = SIDES.index(side)
    return _made(f"bounds.{name}.{side}", pair[end], ("bounds", name, end))._replace(size=size)


def limit_of(problem: OrbitProblem, index: int) -> Parameter:
    """Return the limit of a constraint as a parameter, such as ``limit.peak_power``.

    If the quantity is limited on both sides, the name ends in the side: ``limit.peak_power.upper``.
    """
    constraint = problem.subject_to[index]
    quantity = constraint.quantity
    both = sum(one.quantity.name == quantity.name for one in problem.subject_to) > 1
    path = f"limit.{quantity.name}" + (f".{SIDES[int(constraint.at_most)]}" if both else "")
    size = abs(constraint.limit) or quantity.scale
    place = ("subject_to", index, "limit")
    return Parameter(path, quantity.unit, constraint.limit, size, place)
