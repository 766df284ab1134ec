"""The orbit problem: vehicle, mean velocity, free parameters within bounds, objective and constraints."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from wingbeat._base import (
    FaultList,
    InvalidInputError,
    Report,
    Reported,
    for_people,
    grouped,
    harmonic_place,
    suggest,
)
from wingbeat.aero import SuFan
from wingbeat.aero.blade_element import blade_element_of
from wingbeat.animal.kinematics import (
    ANGLES,
    FREE_NAMES,
    HINGE_NAMES,
    PITCH_LAW,
    Wingbeat,
    parameter,
    with_parameters,
)
from wingbeat.animal.species.numbers import bound_cells, free_name
from wingbeat.animal.species.posture import with_pitch_given_way, with_posture
from wingbeat.animal.species.species import Species
from wingbeat.animal.vehicle import Air, Vehicle
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.state_rates import hinge_states
from wingbeat.orbits.flight.period import PATH_NAMES, PITCH_STATE
from wingbeat.orbits.problem.origin import (
    TERMS,
    Origin,
    frequency_basis,
    loads_in_words,
    model_rows,
    place_in_words,
)
from wingbeat.orbits.problem.outputs import check_quantities
from wingbeat.orbits.problem.quantities import (
    FASTEST,
    FASTEST_CLIMB,
    Constraint,
    Frequency,
    Quantity,
    WingbeatLimit,
    drawn_in,
    named_objective,
    plausible_limits,
    read_limits,
)


@dataclass(frozen=True)
class Unknowns:
    """Bounds of the pitch state at phase 0 and the free parameters, SI. Theory: equation ``unknowns``."""

    names: tuple[str, ...]
    lower: np.ndarray
    upper: np.ndarray
    scale: np.ndarray  # differences that matter; the optimiser's scale is in multiples of them


# Free parameters that change when or how fast the wings move along the stroke, or turn the whole stroke.
_NOT_OF_THE_STROKE = ("frequency", "downstroke_fraction", "stroke_plane_tilt", "tail_tilt")
SPEED_LIMITS: dict[str, Any] = {"at_least": 0.0, "at_most": FASTEST, "unit": "m/s"}
CLIMB_LIMITS: dict[str, Any] = {"at_least": -FASTEST_CLIMB, "at_most": FASTEST_CLIMB, "unit": "m/s"}

Bounds = Mapping[str, tuple[float, float]]


@dataclass(frozen=True)
class OrbitProblem(Reported):
    """A periodic orbit at a prescribed mean velocity that minimises an objective within bounds.

    Parameters
    ----------
    species : a `Species` from `load_species`; gives vehicle, stock wingbeat, air, free parameters and bounds.
    speed : mean horizontal velocity [m/s], 0 for hover.
    climb : mean vertical velocity, up positive [m/s].
    aero : a `BladeElement`, which also sets strips and force point; or a coefficient model such as `SuFan()`, its
        name, the path of its file, or a JAX function of the angle of attack [rad] that returns (C_L, C_D).
    free : names of the wingbeat parameters that are free; default those of the species.
    bounds : (lower, upper) of free parameters, SI and radians; they replace the species' bounds of the same names.
        Bounds of ``body_pitch``, and of ``flap`` (the flap angle of arm and hand), hold along the whole path.
        ``"plausible"`` keeps to the species' plausible ranges: the ranges of parameters narrow the bounds, and the
        range of each quantity of the flown wingbeat becomes a limit in `subject_to`.
    minimise : the objective, a `Quantity` or the name of one; default the frequency, as in Su et al. 2023.
    air : replaces the species' air.
    subject_to : constraints, each a `Constraint` or a text such as ``"peak_power<=30"``. A text that names a
        wingbeat parameter fixes it (``"frequency=6"``) or tightens its bounds (``"flap_amplitude<=50 deg"``).
    origin : the model with which the problem was made, see `wingbeat.models`; it has no effect on the solution.
    wings_may_cross : whether a wing may cross the plane of symmetry, and flap angles may leave their range. A
        stroke whose parameters are all fixed may do both in any case, with a warning.
    own_frequency : whether the animal beats at its own frequency at this speed, see `Species.own_frequency`.
    own_posture : whether guessed bounds of ``body_pitch`` become those that fit the speed; given ones replace them
        at this speed.

    Raises
    ------
    InvalidInputError : an impossible speed; unknown names; bounds that are missing, crossed or not finite; a
        frequency that is both free and the animal's own.

    >>> from wingbeat.animal.species.making import load_species
    >>> OrbitProblem(load_species("pigeon"), speed=10.0).free[0]
    'frequency'
    """

    species: Species
    speed: float
    climb: float = 0.0
    aero: Any = field(default_factory=SuFan)
    free: tuple[str, ...] = ()
    bounds: Any = field(default_factory=dict)
    minimise: Any = field(default_factory=Frequency)
    air: Air = None  # type: ignore[assignment]  # the species' own, once constructed
    subject_to: Sequence[Any] = ()
    wings_may_cross: bool = False
    origin: Origin | None = None
    own_frequency: bool = False
    own_posture: bool = False

    def __post_init__(self) -> None:
        faults = FaultList()
        if not isinstance(self.species, Species):
            faults.add("species", self.species, "is not a Species", "use load_species(name or path)")
        faults.number("speed", self.speed, **SPEED_LIMITS, fix="0 is hover")
        faults.number("climb", self.climb, **CLIMB_LIMITS, fix="0 is level flight")
        if self.air is not None and not isinstance(self.air, Air):
            faults.add("air", self.air, "is not an Air", "use Air(density=..., viscosity=..., gravity=...)")
        for name in ("wings_may_cross", "own_frequency", "own_posture"):
            if not isinstance(given := getattr(self, name), bool):
                faults.add(name, given, "must be True or False")
        if self.own_frequency and "frequency" in (self.free or ()):
            faults.add("free", "frequency", "is searched for, but own_frequency gives it", "keep one of the two")
        named = self.bounds if isinstance(self.bounds, str) else None
        if named is not None:
            faults.choice("bounds", named, ("plausible",))
            object.__setattr__(self, "bounds", {})
        faults.raise_if_any()
        object.__setattr__(self, "free", tuple(map(free_name, self.free or ())))
        species = self.species.at_own_frequency(self.speed) if self.own_frequency else self.species
        species = with_posture(species, self.speed) if self.own_posture else species
        object.__setattr__(self, "species", with_pitch_given_way(species))
        self._check_asked(faults)
        if named and not faults.faults:
            own: Any = self.bounds  # tightened by `subject_to`
            drawn = drawn_in(self.species, self.free or self.species.free, {**self.species.bounds, **own}, faults)
            object.__setattr__(self, "bounds", {**own, **drawn})
            self._limit_plausibly(self.subject_to, faults)
        faults.raise_if_any()
        hinge = self.species.wingbeat.pitch_hinge
        aero = blade_element_of(self.aero, "quarter-chord" if hinge is None else "centre-of-pressure")
        if hinge is not None and aero.wake != "none":
            rule = "is not built for a wing whose pitch gives way"
            faults.add("aero.wake", aero.wake, rule, "leave the lag of the wake out, or prescribe the pitch")
        shapes = self.vehicle.drive, self.map_states
        faults.faults.extend(check_quantities(self._quantities(), aero, *shapes, self.minimise))
        faults.raise_if_any()
        object.__setattr__(self, "aero", aero)
        object.__setattr__(self, "air", self.air or self.species.air)
        # Refuses a descent into its own wake, and too short a wing.
        _ = aero.inflow == aero.wake == "none" or self.model
        asked: Any = self.bounds or {}
        given: Bounds = {free_name(name): pair for name, pair in dict(asked).items()}
        object.__setattr__(self, "bounds", given)
        free = tuple(self.free or self.species.free)
        bounds = {**self.species.bounds, **self.species.path_bounds, **given}
        self._check_free(faults, free, bounds)
        object.__setattr__(self, "free", free)
        object.__setattr__(self, "bounds", {name: bounds[name] for name in (*free, *PATH_NAMES)})

    def _check_asked(self, faults: FaultList) -> None:
        """Turn names and texts into objective and constraints."""
        minimise = self.minimise
        try:
            minimise = named_objective(minimise) if isinstance(minimise, str) else minimise
        except InvalidInputError as error:
            faults.faults.extend(error.faults)
        else:
            if not isinstance(minimise, Quantity):
                fix = "give the name of a quantity, or a Quantity"
                faults.add("minimise", minimise, "is not an objective", fix)
        texts = [self.subject_to] if isinstance(self.subject_to, str | Constraint) else self.subject_to
        limits, constraints = read_limits(list(texts), faults)
        for limit in limits:
            try:
                self._limit_wingbeat(limit)
            except InvalidInputError as error:
                faults.faults.extend(error.faults)
            if limit.sign == "=" and not self.free:
                where = f"{limit.name}={limit.value:g}"
                faults.add("subject_to", where, "leaves no parameter free", "fix fewer parameters of the wingbeat")
        if faults.faults:
            return
        object.__setattr__(self, "minimise", minimise)
        object.__setattr__(self, "subject_to", tuple(constraints))
        if self.speed == 0:
            for name, advice in {q.name: q.in_hover for q in self._quantities() if q.in_hover is not None}.items():
                faults.add("speed", self.speed, f"leaves {name} undefined", f"in hover {advice}")

    def _limit_wingbeat(self, limit: WingbeatLimit) -> None:
        """Fix a parameter at a value, or tighten its bounds."""
        species, name = self.species, limit.name
        if limit.sign == "=":
            held = species.with_record(with_parameters(species.wingbeat, {name: limit.value}))
            object.__setattr__(self, "species", held)
            object.__setattr__(self, "free", tuple(n for n in self.free or species.free if n != name))
            return
        bounds = dict(self.bounds or {})
        lower, upper = bounds.get(name) or species.bounds.get(name) or (-np.inf, np.inf)
        bounds[name] = (lower, limit.value) if limit.sign == "<=" else (limit.value, upper)
        object.__setattr__(self, "bounds", bounds)

    @property
    def shapes_stroke(self) -> bool:
        """Whether a free parameter changes where the wings go, seen from the body."""
        return any(name not in _NOT_OF_THE_STROKE for name in self.free)

    def _limit_plausibly(self, others: Sequence[Any], faults: FaultList) -> None:
        """Limit quantities of the beat to their plausible ranges, beside other limits."""
        limits = plausible_limits(self.species, self.speed, self.air or self.species.air, faults)
        object.__setattr__(self, "subject_to", (*others, *(one for one in limits if one not in others)))
        object.__setattr__(self, "_plausible_limits", limits)

    def at_speed(self, speed: float) -> OrbitProblem:
        """Return the problem at another speed; plausible limits, posture and own frequency are those there.

        Parameters
        ----------
        speed : mean horizontal velocity [m/s].

        Raises
        ------
        InvalidInputError : an impossible speed, or one whose Reynolds number is not plausible.
        """
        bounds = dict(self.bounds)
        if self.own_posture:
            del bounds["body_pitch"]
        moved = dataclasses.replace(self, speed=speed, bounds=bounds)
        limits, faults = getattr(self, "_plausible_limits", None), FaultList()
        if limits is not None:
            moved._limit_plausibly([c for c in self.subject_to if c not in limits], faults)
        faults.raise_if_any()
        return moved

    @property
    def within_plausible(self) -> bool:
        """Whether the problem was asked for within plausible ranges."""
        return getattr(self, "_plausible_limits", None) is not None

    @property
    def frequency_basis(self) -> str:
        """Where the frequency comes from: ``free`` (searched), ``given``, ``measured``, ``law`` or ``guess``."""
        return frequency_basis(self.free, self.own_frequency, self.species, self.speed)

    def _quantities(self) -> list[Quantity]:
        """Return the objective and the constrained quantities that are outputs of the beat."""
        objective = [] if self.minimise.parameter else [self.minimise]
        return [*objective, *(constraint.quantity for constraint in self.subject_to)]

    @property
    def map_states(self) -> int:
        """Number of states of the stroke map: those of the body, and of a hinge that gives way."""
        return len(PITCH_STATE) + hinge_states(self.species.wingbeat)

    @property
    def has_outputs(self) -> bool:
        """Whether objective or constraints depend on the flown wingbeat, not only on the unknowns."""
        return bool(self._quantities())

    @property
    def needs_speed(self) -> bool:
        """Whether the objective or a constraint is undefined in hover."""
        return any(quantity.in_hover is not None for quantity in self._quantities())

    @property
    def has_own_bounds(self) -> bool:
        """Whether a free parameter of the wingbeat has other bounds than the species'."""
        return any(tuple(self.bounds[name]) != self.species.bounds.get(name) for name in self.free)

    def _report(self) -> Report:
        """Return what is to fly, what is minimised within which limits, and the bounds of the free parameters."""
        aero = self.aero
        named = {"coefficients": aero.coefficients.name, "extension": aero.coefficients.extension}
        named |= {"force_point": aero.force_point, "airspeed": aero.airspeed}
        named |= {name: getattr(aero, name) for name in TERMS if getattr(aero, name) != "none"}
        limits = []
        for limit in self.subject_to:
            factor, unit = for_people(limit.quantity.unit)
            sign = "<=" if limit.at_most else ">="
            limits.append(("limit", f"{limit.quantity.name} {sign} {limit.limit * factor:.6g} {unit}".rstrip()))
        rows = [
            ("species, mean speed", place_in_words(self.species.name, self.speed, self.climb)),
            *([] if self.origin is None else model_rows(self.origin.record())),
            ("air loads", loads_in_words(named)),
            ("minimised", self.minimise.name.replace("_", " ")),
            *limits,
        ]
        bounds = {name if name not in self.free else f"wingbeat.{name}": b for name, b in self.bounds.items()}
        cells = [bound_cells(path, pair) for path, pair in bounds.items()]
        bounded = [(name.removeprefix("wingbeat."), f"{ends} {unit}".rstrip()) for name, ends, unit in cells]
        return [grouped({"orbit problem": rows, "free parameters, and limits along the path": bounded})]

    def _check_free(self, faults: FaultList, free: tuple[str, ...], bounds: Bounds) -> None:
        hinge = self.species.wingbeat.pitch_hinge
        for name in free:
            if name in HINGE_NAMES and hinge is None:
                fix = "set pitch_hinge.stiffness, or leave the pitch prescribed"
                faults.add("free", name, "is a number of a pitch hinge, and there is none", fix)
            elif name in PITCH_LAW and hinge is not None and hinge.moves_root:
                rule = "changes nothing, because the wing's pitch gives way"
                faults.add("free", name, rule, f"free {', '.join(HINGE_NAMES)}")
            elif name not in FREE_NAMES:
                named = [known for known in FREE_NAMES if harmonic_place(known) is None]
                fix = f"free can be {', '.join(named)}, or a harmonic such as flap_cos_2"
                fix = suggest(str(name), FREE_NAMES, most=1, otherwise=fix)
                faults.add("free", name, "is not a wingbeat parameter that can be free", fix)
            elif name not in bounds:
                faults.add("bounds", name, "is free but has no bounds", "give bounds={name: (lower, upper)}")
        ahead, _, above = self.vehicle.wing.shoulder
        attitude_counts = self.vehicle.tail is not None or self.vehicle.body.crossflow_area
        if "stroke_plane_tilt" in free and ahead == above == 0 and not attitude_counts:
            rule = (
                "changes only the body's pitch, because the shoulder is at its centre of mass and there is no tail "
                "and no body.crossflow_area"
            )
            faults.add("free", "stroke_plane_tilt", rule, "set wing.shoulder, or leave stroke_plane_tilt fixed")
        if self.vehicle.tail is None and "tail_tilt" in free:
            rule = "changes nothing, because there is no tail"
            fix = "set tail.area, tail.arm and tail.lift_slope, or leave tail_tilt fixed"
            faults.add("free", "tail_tilt", rule, fix)
        if len(set(free)) != len(free):
            faults.add("free", free, "names a parameter twice")
        if self.minimise.parameter and self.minimise.parameter not in free:
            rule = f"leaves out {self.minimise.parameter}, which is the objective"
            faults.add("free", free, rule, "free it too, or minimise something else")
        for name, pair in self.bounds.items():
            if name not in (*PATH_NAMES, *free):
                faults.add("bounds", name, "is bounded but not free", f"the free parameters are {', '.join(free)}")
            elif not isinstance(pair, tuple | list) or len(pair) != 2:
                faults.add(f"bounds.{name}", pair, "must be (lower, upper)")
            elif all(
                faults.angle(f"bounds.{name}", value, advice=f"write np.radians({value})")
                if name in (*PATH_NAMES, *ANGLES)
                else faults.number(f"bounds.{name}", value)
                for value in pair
            ):
                if not pair[0] < pair[1]:
                    faults.add(f"bounds.{name}", pair, "lower must be below upper")
                try:
                    for value in () if name in PATH_NAMES else pair:
                        with_parameters(self.species.wingbeat, {name: value})
                except InvalidInputError as error:
                    rule = f"contains impossible values: {error.faults[0].rule}"
                    faults.add(f"bounds.{name}", (pair[0], pair[1]), rule)
        faults.raise_if_any()

    @property
    def vehicle(self) -> Vehicle:
        """The vehicle that flies."""
        return self.species.vehicle

    @functools.cached_property
    def model(self) -> FlightModel:
        """The flight model of vehicle, air loads and air; cached, because making it takes as long as a flight."""
        return FlightModel(self.vehicle, self.aero, self.air, (self.speed, self.climb))

    def unknowns(self) -> Unknowns:
        """Return names, bounds and scales of the unknowns."""
        free, bounds = self.free, self.bounds
        wander = 5.0 + 0.5 * self.speed  # wide: excludes absurd initial velocities only
        limits = [
            bounds["body_pitch"],
            (self.speed - wander, self.speed + wander),
            (self.climb - wander, self.climb + wander),
            (-60.0, 60.0),
            *(bounds[name] for name in free),
        ]
        lower, upper = np.array(limits, dtype=float).T
        scale = np.concatenate([[0.2, 1.0, 1.0, 5.0], 0.2 * (upper - lower)[4:]])
        return Unknowns((*PITCH_STATE, *free), lower, upper, scale)

    def wingbeat(self, unknowns: np.ndarray) -> Wingbeat:
        """Return the species' wingbeat with the free parameters taken from the unknowns.

        Parameters
        ----------
        unknowns : pitch state at phase 0 and free parameters, SI and radians, shape (unknowns,).
        """
        values = dict(zip(self.free, (float(v) for v in unknowns[4:]), strict=True))
        return with_parameters(self.species.wingbeat, values)

    def unknowns_of(self, state: np.ndarray, wingbeat: Wingbeat) -> np.ndarray:
        """Return the unknowns of an initial state and a wingbeat.

        Parameters
        ----------
        state, wingbeat : initial state as in `State`, shape (6,), and the wingbeat.
        """
        return np.array([*state[2:], *(parameter(wingbeat, name) for name in self.free)], dtype=float)

    def frequency(self, unknowns: np.ndarray) -> float:
        """Return the frequency that belongs to the unknowns [Hz].

        Parameters
        ----------
        unknowns : as in `wingbeat`.
        """
        if "frequency" in self.free:
            return float(unknowns[4 + self.free.index("frequency")])
        return self.species.wingbeat.frequency

    def closure(self, end: np.ndarray, unknowns: np.ndarray, frequency: float) -> np.ndarray:
        """Return the residual of closure, shape (6,) [m, m, rad, m/s, m/s, rad/s]. Theory: equation ``closure``.

        Parameters
        ----------
        end : state at the end of the period, shape (6,). The flight starts at x = z = 0.
        unknowns : pitch state at phase 0 and free parameters, as in the method `wingbeat`.
        frequency : of the wingbeat [Hz].
        """
        travelled = np.array([self.speed, self.climb]) / frequency
        return np.asarray(end) - np.concatenate([travelled, unknowns[:4]])

    def closure_jacobian(self, end_jacobian: np.ndarray, frequency: float) -> np.ndarray:
        """Return the derivative of the closure residual by the unknowns, shape (6, unknowns).

        Parameters
        ----------
        end_jacobian : derivative of the state at the end, shape (6, unknowns).
        frequency : of the wingbeat [Hz].
        """
        jacobian = np.array(end_jacobian)
        jacobian[2:].flat[:: jacobian.shape[1] + 1] -= 1.0  # the initial pitch state by itself
        if "frequency" in self.free:
            column = 4 + self.free.index("frequency")
            jacobian[0, column] += self.speed / frequency**2
            jacobian[1, column] += self.climb / frequency**2
        return jacobian
