"""Which numbers of an orbit its limits have set: such numbers are no predictions."""

from __future__ import annotations

import math
import re
from typing import Any, NamedTuple

from wingbeat._base.style import in_words
from wingbeat.orbits.problem.problem import PATH_NAMES

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
    """What set a number: the value of its own limit, None if it follows from others; and the names of the limits.

    `limit` is also None for a limit along the whole path (``flap``, ``body_pitch``), which a record does not hold.
    """

    limit: float | None
    by: tuple[str, ...]

    @property
    def words(self) -> str:
        """In words, such as ``set by the limit`` or ``follows from the limit of flap amplitude``.

        >>> SetBy(None, ("flap_amplitude",)).words
        'follows from the limit of flap amplitude'
        """
        if self.limit is not None:  # its own
            return "set by the limit"
        return f"follows from the limit{'s' if len(self.by) > 1 else ''} of {' and '.join(map(called, self.by))}"


def set_by_limit(record: dict[str, Any]) -> dict[str, SetBy]:
    """Return the numbers of a certified orbit that a limit has set, by name, with what set each.

    A limit is a bound of a free parameter, a limit along the path, a limit given by the user, or an end of a
    plausible range that bounds the search. Numbers that follow from such numbers alone are returned too: the
    Strouhal number, frequency and flap amplitude if two of them are at limits, and the frequency that was minimised
    if the flap amplitude is at its limit, because their product hardly changes.

    Parameters
    ----------
    record : of `Orbit.record`, or a part of it with ``active_bounds``, ``objective`` and ``wingbeat``; SI, radians.

    >>> beat = {"frequency": 5.1, "flap_amplitude": 1.2}
    >>> found = set_by_limit({"active_bounds": ["flap_amplitude"], "objective": "frequency", "wingbeat": beat})
    >>> found["flap_amplitude"], found["frequency"].words
    (SetBy(limit=1.2, by=('flap_amplitude',)), 'follows from the limit of flap amplitude')
    """
    if record.get("status", "converged") != "converged":
        return {}
    reached = {**(record.get("initial_state") or {}), **(record.get("wingbeat") or {})}
    ends = {one["name"]: (one["low"], one["high"]) for one in record.get("plausibility") or ()}
    found: dict[str, SetBy] = {}
    for text in record.get("active_bounds") or ():
        name, *limit = re.split("[<>]=", text)
        value = float(limit[0]) if limit else None if name in PATH_NAMES else reached.get(name)
        found[name] = SetBy(next((end for end in ends.get(name, ()) if _close(value, end)), value), (name,))
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


def _close(value: float | None, end: float | None) -> bool:
    return value is not None and end is not None and math.isclose(value, end, rel_tol=_INSIDE)


def called(name: str) -> str:
    """Return how a limited number is called within a sentence.

    >>> called("flap"), called("tail_tilt")
    ('flap angle', 'tail tilt')
    """
    return _CALLED.get(name, in_words(name))
