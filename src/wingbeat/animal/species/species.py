"""The record of a species, how to change its numbers, and what it says of itself: every number with its source."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, cast

from wingbeat._base import TRACED, FaultList, Report, Reported, is_traced, plain_unit, suggest
from wingbeat.animal.kinematics import FREE_NAMES, Wingbeat
from wingbeat.animal.species.building import (
    BODY,
    BY_HAND,
    HINGE,
    WHOLE,
    build_records,
    check_parts,
    complete_parts,
    default_of,
    derive_body,
    find_warnings,
    lacks_muscle,
    plain,
    set_by_hand,
    settable,
    weigh_wing,
)
from wingbeat.animal.species.file_schema import has_shape
from wingbeat.animal.species.numbers import (
    ACTIVATION,
    FREQUENCY,
    KEYS,
    UNKNOWN,
    WING,
    Alternative,
    Number,
    Numbers,
    OwnFrequency,
    Range,
    free_name,
    frequency_between,
    frequency_of,
    guessed_hinge_range,
    in_order,
    jsonable,
    path_of,
    range_of,
    range_of_tilt,
    to_si,
)
from wingbeat.animal.species.report import species_report
from wingbeat.animal.species.scaling import frequencies_by_law, muscle_numbers, tail_numbers
from wingbeat.animal.species.shape import Shape
from wingbeat.animal.vehicle import Air, Vehicle

MUSCLE = "muscle"  # the alternative with measured masses of the flight muscle


@dataclass(frozen=True)
class Species(Reported):
    """An animal or a robot, its stock wingbeat and the air it flies in.

    Parameters
    ----------
    name, common_name, scientific_name : its names.
    kind : ``"bird"``, ``"bat"`` or ``"robot"``; empty if the file does not say it.
    vehicle, wingbeat, air : the records; in the wingbeat, the free parameters hold a first guess.
    free : the free parameters of the wingbeat.
    bounds : lowest and highest value of each free parameter, in SI units and radians.
    guessed_bounds : the names in `free` and in `path_bounds` whose bounds are a guess.
    path_bounds : limits along the whole path: ``body_pitch``, and ``flap`` of arm and hand [rad].
    reasons : the reason for each bound.
    numbers : every number by its path, with unit, source and plausible range.
    alternatives : named sets of other numbers.
    plausible : plausible ranges of numbers of the flown wingbeat, by their names in the record; see
        `plausible_range`.
    warnings : what looks wrong, such as a number outside its plausible range.
    shape : how it looks, for drawings alone; None if the file does not say it.
    frequencies : at which the animal beats by flight speed, from its file or else by the law of bats; see
        `own_frequency`.
    own_mass : the animal's whole mass before a payload or a mass set by hand [kg]; None if nothing changed it.

    >>> from wingbeat import load_species
    >>> pigeon = load_species("pigeon")
    >>> round(pigeon.vehicle.mass, 3), pigeon.vehicle.wing.semi_span
    (0.316, 0.279)
    >>> heavier = pigeon.with_values({"wing.mass": 0.025})
    >>> round(heavier.vehicle.mass, 3)
    0.326
    """

    name: str
    common_name: str
    scientific_name: str
    kind: str
    vehicle: Vehicle
    wingbeat: Wingbeat
    air: Air
    free: tuple[str, ...]
    bounds: dict[str, tuple[float, float]]
    guessed_bounds: frozenset[str]
    path_bounds: dict[str, tuple[float, float]]
    reasons: dict[str, str]
    numbers: dict[str, Number]
    alternatives: dict[str, Alternative]
    plausible: dict[str, Range]
    warnings: tuple[str, ...]
    shape: Shape | None = None
    frequencies: tuple[OwnFrequency, ...] = ()
    own_mass: float | None = None

    @property
    def carried_mass(self) -> float:
        """What a payload, or a mass set by hand, adds to the animal's own mass [kg]."""
        own, whole = self.own_mass, self.vehicle.mass
        return 0.0 if own is None or math.isclose(whole, own, rel_tol=1e-12) else whole - own

    def own_frequency(self, speed: float) -> OwnFrequency:
        """Return the frequency at which the animal beats at a flight speed, with its band, basis and source.

        Without `frequencies`, it is that of the stock wingbeat. The basis is then ``measured`` if its source has
        grade A or B, a ``law`` if a law of its kind derived it, a ``guess``, or else ``given``.

        Parameters
        ----------
        speed : of the flight [m/s].

        >>> from wingbeat import load_species
        >>> load_species("common-murre").own_frequency(18.0).basis
        'measured'
        """
        if self.frequencies and not self.is_set_by_hand(FREQUENCY):
            return frequency_between(self.frequencies, speed)
        return frequency_of(self.numbers[FREQUENCY], self.kind)

    def at_own_frequency(self, speed: float) -> Species:
        """Return this species beating at its own frequency at a flight speed; its band is that frequency's range.

        Parameters
        ----------
        speed : of the flight [m/s].

        >>> from wingbeat import load_species
        >>> "frequency" in load_species("common-murre").at_own_frequency(18.0).free
        False
        """
        own, beating = self.own_frequency(speed), self
        number = Number(own.value, "Hz", own.source, own.range)
        if own.basis != "given" and number != self.numbers[FREQUENCY]:
            beating = self.with_derived({FREQUENCY: number})
        free = tuple(name for name in self.free if name != "frequency")
        return beating if free == self.free else dataclasses.replace(beating, free=free)

    def plausible_range(self, name: str, speed: float) -> Range:
        """Return the plausible range of a number at a flight speed; both ends are None if nothing is known.

        Parameters
        ----------
        name : as in the record's ``plausibility``; for a parameter of the wingbeat, the species' own range applies.
        speed : of the flight [m/s].

        >>> from wingbeat import load_species
        >>> load_species("bat").plausible_range("strouhal", 10.0)[:2]
        (0.2, 0.4)
        >>> load_species("bat").plausible_range("strouhal", 2.0)[:2]
        (None, None)
        """
        if name == "tail_tilt":
            return range_of_tilt(self.numbers)
        if path_of(name) in self.numbers:
            return range_of(self.numbers[path_of(name)])
        known = self.plausible.get(name, ACTIVATION if name == "peak_activation" else None)
        return Range(None, None, plain_unit(name), UNKNOWN) if known is None else known.at(speed)

    def _report(self) -> Report:
        return species_report(self)

    def with_values(self, values: Mapping[str, Any]) -> Species:
        """Return this species with some numbers set.

        Nothing else changes, so a new wing mass changes the whole mass.

        Parameters
        ----------
        values : paths as in the orbit record (``wing.mass``, ``wingbeat.twist_ratio``, ``air.density``) and their
            values in SI units; the value of an angle is in degrees if its path ends in ``_deg``.

        Raises
        ------
        InvalidInputError : an unknown path, a path given twice, a wrong type or shape, or an impossible value.
        """
        faults, given = FaultList(), Numbers()
        for path, value in values.items():
            if is_traced(value):
                faults.add(path, value, *TRACED)
                continue
            value = plain(value)
            key = settable(path, value, faults)
            if key is None or not has_shape(key.shape, value, path, faults):
                continue
            if key.path in given:
                other = given.written[key.path][0]
                faults.add(path, value, f"is given as {other} too", "keep one of the two")
                continue
            old = self.numbers.get(key.path)
            number = Number(to_si(value, path), key.unit, set_by_hand(key.path, old), old and old.range)
            given.put(key, number, path, value)
        changed, mass = self._rebuilt(self.numbers | given, given, faults), self.vehicle.mass
        weighed = self.own_mass is not None or changed.vehicle.mass == mass
        return changed if weighed else dataclasses.replace(changed, own_mass=mass)

    def with_record(self, record: Vehicle | Wingbeat) -> Species:
        """Return this species with its vehicle or its stock wingbeat replaced, and its `numbers` to match.

        Parameters
        ----------
        record : a vehicle or a wingbeat.
        """
        section, parts = "wingbeat", {"wingbeat": record, HINGE: getattr(record, "pitch_hinge", None)}
        if isinstance(record, Vehicle):
            section, parts = "vehicle", {"vehicle": record, **{f"vehicle.{n}": r for n, r in vars(record).items()}}
        numbers = dict(self.numbers)
        for key in KEYS:
            part, _, name = key.path.rpartition(".")
            if part not in parts:
                continue
            old, value = numbers.pop(key.path, None), getattr(parts[part], name, None)
            if old is not None and value == old.value:
                numbers[key.path] = old
            elif value is not None and (old is not None or value != default_of(key.path)):  # None: a part it lacks
                numbers[key.path] = Number(value, key.unit, set_by_hand(key.path, old), old and old.range)
        complete_parts(numbers)
        changed = dataclasses.replace(self, **{section: record})
        if changed.vehicle.tail is None and not changed.wingbeat.tail_tilt:
            numbers.pop("wingbeat.tail_tilt", None)
        return dataclasses.replace(changed, numbers=in_order(numbers))

    def with_free(self, names: Sequence[str]) -> Species:
        """Return this species with more free parameters of the wingbeat, within their plausible ranges.

        Parameters
        ----------
        names : of the parameters.

        Raises
        ------
        InvalidInputError : a name that is no parameter of the wingbeat, or one without a plausible range.
        """
        faults, bounds, guessed = FaultList(), dict(self.bounds), set[str]()
        for name in (names := [free_name(name) for name in names]):
            known = self.plausible_range(name, 0.0) if name in FREE_NAMES else None
            if known is None:
                faults.add("free", name, "is no parameter that can be free", suggest(name, FREE_NAMES))
            elif known.low is not None and known.high is not None:
                bounds.setdefault(name, (known.low, known.high))
            elif name in bounds:
                continue
            elif guess := guessed_hinge_range(name, self.wingbeat.pitch_hinge):
                guessed.add(name)
                bounds[name] = guess
            else:
                faults.add("free", name, "has no plausible range", "give it and its range in the species file")
        faults.raise_if_any()
        added = tuple(name for name in dict.fromkeys(names) if name not in self.free)
        reasons = {name: "the plausible range of the species file" for name in added if name not in self.bounds}
        reasons = self.reasons | reasons | dict.fromkeys(guessed, "a guess about the hinge's own number")
        own = {"bounds": bounds, "reasons": reasons, "guessed_bounds": self.guessed_bounds | guessed}
        return dataclasses.replace(self, free=(*self.free, *added), **own)

    def is_set_by_hand(self, path: str) -> bool:
        """Return whether a number was set, by `with_values` or ``--set``, after the species was made.

        Parameters
        ----------
        path : of the number.
        """
        return path in self.numbers and self.numbers[path].source.startswith(BY_HAND)

    def with_payload(self, payload: float) -> Species:
        """Return this species with a load at the body's centre of mass; only body mass and its range move.

        Parameters
        ----------
        payload : mass of the load [kg].

        Raises
        ------
        InvalidInputError : a payload that is negative, not finite, or not a number.

        >>> from wingbeat import load_species
        >>> round(load_species("pigeon").with_payload(0.03).vehicle.mass, 3)
        0.346
        """
        faults = FaultList()
        faults.number("payload", payload, at_least=0, unit="kg", fix="0 is no load")
        faults.raise_if_any()
        if not payload:
            return self
        loaded = self.with_values({"body.mass": self.vehicle.body.mass + payload})
        numbers = dict(loaded.numbers)
        for path in ("vehicle.mass", "vehicle.body.mass"):
            if path in numbers and (own := numbers[path].range):
                numbers[path] = numbers[path]._replace(range=(own[0] + payload, own[1] + payload))
        return dataclasses.replace(loaded, numbers=numbers)

    def at_altitude(self, altitude: float = 0.0, temperature: float | None = None) -> Species:
        """Return this species in the air of an altitude; density and viscosity change, gravity does not.

        Parameters
        ----------
        altitude : geometric height above sea level, -500 to 9000 [m].
        temperature : -60 to 60 [deg C]; None for that of the standard atmosphere.

        Raises
        ------
        InvalidInputError : an altitude or a temperature out of range; see `Air.at_altitude`.

        >>> from wingbeat import load_species
        >>> high = load_species("pigeon").at_altitude(5000.0)
        >>> round(high.air.density, 4), high.numbers["air.density"].source
        (0.7364, 'dry air at 5000 m, standard temperature (ICAO standard atmosphere, Doc 7488)')
        """
        air = Air.at_altitude(altitude, temperature, self.air.gravity)
        warmth = "standard temperature" if temperature is None else f"{temperature:g} deg C"
        source = f"dry air at {altitude:g} m, {warmth} (ICAO standard atmosphere, Doc 7488)"
        numbers = {f"air.{name}": getattr(air, name) for name in ("density", "viscosity")}
        return self.with_derived({path: Number(value, plain_unit(path), source) for path, value in numbers.items()})

    def with_tail(self) -> Species:
        """Return this species with the tail that laws of birds give for its mass, spread by 60 degrees.

        The sources of its numbers say ``derived``; see `animal.species.scaling`. The mass does not change.

        Raises
        ------
        InvalidInputError : the changed numbers do not make a valid vehicle.

        >>> from wingbeat import load_species
        >>> round(load_species("pigeon").with_tail().vehicle.tail.arm, 3)
        0.164
        """
        return self.with_derived(tail_numbers(self.vehicle.mass))

    def with_muscle(self) -> Species:
        """Return this species with flight muscle: masses measured (its alternative ``muscle``), the rest by laws.

        Raises
        ------
        InvalidInputError : its kind is neither bird nor bat.

        >>> from wingbeat import load_species
        >>> round(load_species("pigeon").with_muscle().vehicle.muscle.mass, 4)
        0.061
        """
        measured = self.alternatives[MUSCLE].numbers if MUSCLE in self.alternatives else {}
        return self.with_derived(self._muscle_by_law(self.vehicle.mass) | measured)

    def _muscle_by_law(self, mass: float) -> dict[str, Number]:
        """Return the numbers of the muscle that the laws of its kind give at a whole mass [kg]."""
        faults = FaultList()
        if self.kind not in ("bird", "bat"):
            fix = 'write kind = "bird" or kind = "bat" into its file, or give the numbers muscle.* yourself'
            faults.add("kind", self.kind, "has no laws of muscle", fix)
        faults.raise_if_any()
        return muscle_numbers(mass, self.kind == "bat")

    def with_derived(self, numbers: Mapping[str, Number]) -> Species:
        """Return this species with numbers that laws gave, with their own sources and ranges.

        Parameters
        ----------
        numbers : by their paths, such as ``vehicle.body.drag_area``.

        Raises
        ------
        InvalidInputError : an unknown path, or a number that the species refuses.
        """
        found = Numbers()
        found.update(numbers)
        return self._rebuilt(self.numbers | found, found, FaultList())

    def with_alternative(self, name: str) -> Species:
        """Return this species with the numbers of one of its `alternatives`.

        Heavier wings make a lighter body, unless the alternative also sets the mass of the body or of the whole.
        Laws of its kind complete the muscle, and give `frequencies` by the law of bats, at the new whole mass.

        Parameters
        ----------
        name : of the alternative.

        Raises
        ------
        InvalidInputError : there is no alternative of this name; it has some numbers of the muscle, and the kind no
            laws of the others.
        """
        faults = FaultList()
        if name not in self.alternatives:
            fix = suggest(str(name), self.alternatives) if self.alternatives else f"{self.name} has none"
            faults.add("alternative", name, "is unknown", fix)
            faults.raise_if_any()
        numbers, patch = dict(self.numbers), self.alternatives[name].numbers
        if lacks_muscle(both := numbers | patch):
            numbers |= self._muscle_by_law(cast(float, both[WHOLE].value)) | numbers
        for path, number in patch.items():
            old = numbers.get(path)
            numbers[path] = number if number.range else number._replace(range=old and old.range)
        if BODY not in patch and {WHOLE, WING} & patch.keys():
            derive_body(numbers, patch, faults)
        changed = self._rebuilt(numbers, patch, faults)
        if self.frequencies != frequencies_by_law(self.kind, self.numbers):  # the file gives them
            return changed
        return dataclasses.replace(changed, frequencies=frequencies_by_law(self.kind, changed.numbers))

    def _rebuilt(self, numbers: dict[str, Number], given: Numbers, faults: FaultList) -> Species:
        """Return a copy with other numbers; records are checked, whole mass and warnings computed again."""
        weigh_wing(numbers, given)
        complete_parts(numbers)
        check_parts(numbers, faults)
        records = build_records(numbers, given, faults)
        faults.raise_if_any()
        numbers = in_order(numbers)
        mass, whole = records["vehicle"].mass, numbers[WHOLE]
        if not math.isclose(mass, cast(float, whole.value), rel_tol=1e-12):
            numbers = numbers | {WHOLE: whole._replace(value=mass, source="body.mass and both wings")}
        drawn = self.shape.numbers if self.shape else {}
        odd = find_warnings(numbers, drawn, self.free, self.bounds, records["vehicle"], records["wingbeat"])
        return dataclasses.replace(self, numbers=numbers, warnings=odd, **records)

    def as_dict(self) -> dict[str, Any]:
        """Return everything as plain numbers, lists and texts, fit for JSON.

        ``vehicle``, ``wingbeat`` and ``air`` are as in an orbit record, except that the wingbeat has every law.
        """
        plain = {field.name: getattr(self, field.name) for field in dataclasses.fields(self)}
        for record in ("vehicle", "wingbeat", "air"):
            plain[record] = dataclasses.asdict(plain[record])
        plain["vehicle"] = {part: record for part, record in plain["vehicle"].items() if record is not None}
        plain["vehicle"]["wing"] = self.vehicle.wing.told()
        plain["guessed_bounds"] = sorted(self.guessed_bounds)
        plain["shape"] = self.shape and self.shape.drawn() | {"numbers": self.shape.numbers}
        return jsonable(plain)
