"""What is thought of an orbit's numbers: whether they are plausible, and which of them limits have set."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import in_words
from wingbeat.animal.species.species import Species
from wingbeat.animal.vehicle import Air
from wingbeat.orbits.flight.period import PATH_NAMES

if TYPE_CHECKING:
    import xarray as xr

# The reader's name of each judged number.
JUDGED_NAMES = {
    **{"positive_power_per_mass": "power per mass", "peak_activation": "peak activation", "frequency": "frequency"},
    **{"flap_amplitude": "flap amplitude", "tail_tilt": "tail tilt"},
    **{"peak_force_over_weight": "peak force over weight", "mean_body_pitch": "mean body pitch"},
    **{"body_pitch_range": "range of body pitch", "strouhal": "Strouhal number", "reynolds": "Reynolds number"},
}
# Begins the warning that the frequency is not that of this load or air.
OTHER_FREQUENCY = "the frequency is that of the bird's own mass at sea level"
_THIN = 1e-3  # share by which the density of an air is that of another
_KEYS = {"name", "value", "unit", "low", "high", "within", "source"}


class Statements(NamedTuple):
    """How well an orbit closes, and whether it is plausible; `good` if it is certified and plausible."""

    closes: str
    plausible: str
    good: bool


_ROUNDING = 1e-6  # share of a range's larger end; a constraint of the solver holds to about 1e-8


def judged(species: Species, speed: float, name: str, value: float | None) -> dict[str, Any]:
    """Return the judgement of one number; `plausibility` says what it holds."""
    known = species.plausible_range(name, speed)
    low, high = known.low, known.high
    within = None
    if value is not None and math.isfinite(value) and (low, high) != (None, None):
        # What the solver holds at the end of a range is there to rounding.
        near = _ROUNDING * max(abs(end) for end in (low, high) if end is not None)
        within = (low is None or value >= low - near) and (high is None or value <= high + near)
    judgement = {"name": name, "value": value, "unit": known.unit, "low": low, "high": high}
    return judgement | {"within": within, "source": known.source}


def conditions_in_words(air: Mapping[str, float], carried_mass: float = 0.0) -> str:
    """Return what a title says of a load [kg] and of air that is not that at sea level; an empty text for neither.

    >>> conditions_in_words({"density": 0.9093}, 0.03)
    ', with 30 g added, in air of 0.9093 kg/m3'
    """
    way = "added" if carried_mass > 0 else "taken off"
    load = f", with {1e3 * abs(carried_mass):.3g} g {way}" if carried_mass else ""
    usual = math.isclose(air["density"], Air().density, rel_tol=_THIN)
    return load if usual else f"{load}, in air of {air['density']:.4g} kg/m3"


def conditions_of(record: Mapping[str, Any]) -> str:
    """Return what a title says of the load and the air of a record, or of a data set's attributes."""
    air = record.get("air")
    air = json.loads(air) if isinstance(air, str) else air
    return conditions_in_words(air or vars(Air()), float(record.get("carried_mass", 0.0)))


def is_judgement(value: Any) -> bool:
    """Return whether a value read from a file has the form of the record's ``plausibility``."""
    whole = isinstance(value, list) and all(isinstance(one, dict) and one.keys() == _KEYS for one in value)
    return whole and all(one["name"] in JUDGED_NAMES and isinstance(one["source"], str) for one in value)


def statements(record: dict[str, Any]) -> Statements:
    """Return the two statements on an orbit record: ``closes to 3e-09`` and ``plausible: no: ...``."""
    residuals = list((record.get("closure") or {}).values())
    worst = None if not residuals or None in residuals else max(map(abs, residuals))
    certified = record.get("status") == "converged"
    if certified and worst is not None:
        closes = f"closes to {worst:.0e}"
    else:
        closes = "does not close: the flight diverged" if worst is None else f"does not close: residual {worst:.2g}"
    judged = record.get("plausibility") or []
    outside = [one for one in judged if one["within"] is False]
    if outside:
        return Statements(closes, f"plausible: no: {'; '.join(map(_how, outside))}", False)
    known, unknown = [], []
    for one in judged:
        (unknown if one["low"] is None and one["high"] is None else known).append(one)
    names = [JUDGED_NAMES[one["name"]] for one in unknown]
    listed = " and ".join(filter(None, (", ".join(names[:-1]), *names[-1:])))
    left_out = f"no range is known for {listed}" if names else ""
    # If more numbers are open than judged, there is no ground for a yes.
    if len(unknown) > sum(one["within"] is not None for one in known) or not known:
        return Statements(closes, f"plausible: not known: {left_out or 'no range is known'}", False)
    return Statements(closes, f"plausible: yes{left_out and f'; {left_out}'}", certified)


def _how(one: dict[str, Any]) -> str:
    """Return in words how a number is outside its range, angles in degrees."""
    value: float = one["value"]
    above = one["high"] is not None and value > one["high"]
    end: float = one["high" if above else "low"]
    if one["name"] == "positive_power_per_mass" and above and "muscle" in one["source"] and value >= 1.05 * end:
        return f"{value / end:.2g} times the power of muscle"
    factor, unit = (math.degrees(1.0), "deg") if one["unit"] == "rad" else (1.0, one["unit"])
    unit = "" if unit == "1" else f" {unit}"
    # Enough digits to tell the value from the end of the range.
    digits = next(n for n in range(3, 17) if n == 16 or f"{value * factor:.{n}g}" != f"{end * factor:.{n}g}")
    name, side = JUDGED_NAMES[one["name"]], "above" if above else "below"
    return f"{name} {value * factor:.{digits}g} {side} {end * factor:.{digits}g}{unit}"


# Numbers of which all but one determine the last, at a given speed and for a given vehicle.
_RELATED = (
    frozenset({"strouhal", "frequency", "flap_amplitude"}),
    frozenset({"muscle_work_per_mass", "muscle_power_per_mass", "frequency"}),
    frozenset({"positive_power_per_mass", "mean_positive_power"}),
    frozenset({"cost_of_transport", "mean_positive_power"}),
    frozenset({"reduced_frequency", "frequency"}),
)

# Names of the path and of the state that do not read as words.
_CALLED = {"flap": "flap angle", "plane_of_symmetry": "the wing's distance from the plane of symmetry"}
_CALLED |= {"u": "initial speed forward", "w": "initial speed upward"}
_CALLED |= {f"pitch_{part}": f"wing pitch {part}" for part in ("mean", "amplitude", "phase")}

# A limit that stands for an end of a plausible range is 0.02 % inside it.
_INSIDE = 5e-4  # relative


class SetBy(NamedTuple):
    """What set a number: the value of its own limit, and the names of the limits."""

    # None if it follows from others, and for a limit along the whole path (``flap``), which a record does not hold.
    limit: float | None
    by: tuple[str, ...]

    @property
    def words(self) -> str:
        """In words, such as ``set by the limit`` or ``follows from the limit of flap amplitude``."""
        if self.limit is not None:  # its own
            return "set by the limit"
        return f"follows from the limit{'s' if len(self.by) > 1 else ''} of {' and '.join(map(called, self.by))}"


def set_by_limit(record: dict[str, Any]) -> dict[str, SetBy]:
    """Return the numbers of a certified orbit that a limit has set, by name, with what set each.

    A limit is a bound of a free parameter, a limit along the path, a limit given by the user, or an end of a
    plausible range that bounds the search. Numbers that follow from such numbers alone are returned too: the
    Strouhal number, frequency and flap amplitude if two of them are at limits, and the frequency that was minimised
    if the flap amplitude is at its limit, because their product hardly changes.
    """
    if record.get("status", "converged") != "converged":
        return {}
    reached = {**(record.get("initial_state") or {}), **(record.get("wingbeat") or {})}
    ends = {one["name"]: (one["low"], one["high"]) for one in record.get("plausibility") or ()}
    found: dict[str, SetBy] = {}
    for text in record.get("active_bounds") or ():
        name, *limit = re.split("[<>]=", text)
        value = float(limit[0]) if limit else None if name in PATH_NAMES else reached.get(name)
        for end in ends.get(name, ()):
            if value is not None and end is not None and math.isclose(value, end, rel_tol=_INSIDE):
                value = end
                break
        found[name] = SetBy(value, (name,))
    if "flap" in found:
        found.setdefault("flap_amplitude", SetBy(None, ("flap",)))
    if record.get("objective") == "frequency" and "flap_amplitude" in found:
        found.setdefault("frequency", SetBy(None, found["flap_amplitude"].by))
    for related in _RELATED * 2:  # twice, because one may follow from another
        missing = related - found.keys()
        if len(missing) == 1:
            (follows,) = missing
            by = dict.fromkeys(name for one in sorted(related - missing) for name in found[one].by)
            found[follows] = SetBy(None, tuple(by))
    return found


def called(name: str) -> str:
    """Return how a limited number is called within a sentence, such as ``tail tilt``."""
    return _CALLED.get(name, in_words(name))


def set_by_limits_along(dataset: xr.Dataset) -> list[dict[str, SetBy]]:
    """Return `set_by_limit` of the best orbit at each speed of a curve; empty where there is none."""
    texts, about = dataset["active_bounds"].values[:, 0], {"objective": dataset.attrs["objective"]}
    return [set_by_limit(about | {"active_bounds": list(filter(None, str(text).split(", ")))}) for text in texts]
