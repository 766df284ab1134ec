"""The orbit problem of a filmed wingbeat: filmed parameters are fixed, and the others trim the flight."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, Protocol

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.species.species import Species
from wingbeat.animal.vehicle import Vehicle
from wingbeat.orbits.problem.problem import OrbitProblem

# How far filmed wing pitch may be moved to trim the flight, if too little else is free [rad].
_TRIM_RANGE = math.radians(20.0)
# Free parameters that cannot control forward and vertical speed.
_NO_CONTROL = "tail_tilt", "downstroke_fraction"


class Filmed(Protocol):
    """A wingbeat fitted to a film, such as `wingbeat.experiment.FilmedBeat`."""

    def numbers_of(self, vehicle: Vehicle, wingbeat: Wingbeat) -> Mapping[str, Any]:
        """Return the fields of a `Wingbeat` that the film gives, SI and radians."""
        ...

    def differences(self, vehicle: Vehicle, wingbeat: Wingbeat) -> tuple[str, ...]:
        """Return what was measured on the filmed animal, is not used, and differs from what is."""
        ...

    @property
    def held(self) -> frozenset[str]:
        """Names of the parameters that an orbit must not change."""
        ...

    @property
    def warnings(self) -> tuple[str, ...]:
        """What may change every number computed from the film."""
        ...


def filmed_species(beat: Filmed, species: Species) -> Species:
    """Return a species with the filmed wingbeat and its warnings; parameters that were not filmed do not change.

    A wrist that was set by hand stays, and the film replaces other numbers that were; a warning says so.

    Parameters
    ----------
    beat : from `wingbeat.experiment.fit_film`.
    species : the filmed species.

    Raises
    ------
    InvalidInputError : an impossible wingbeat, a filmed area that is not a share of the species' area.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> film = wb.experiment.synthetic_film(pigeon.wingbeat, frames=60, noise_deg=0.0)
    >>> filmed = wb.filmed_species(wb.experiment.fit_film(film), pigeon)
    >>> round(filmed.wingbeat.frequency / pigeon.wingbeat.frequency, 2)
    1.0
    """
    filmed = dict(beat.numbers_of(species.vehicle, species.wingbeat))
    if species.is_set_by_hand("wingbeat.wrist"):
        filmed.pop("wrist", None)
    changed = species.with_values({f"wingbeat.{name}": value for name, value in filmed.items()})
    doubts, hinge = doubts_of(beat, species), changed.wingbeat.pitch_hinge
    if hinge is not None and hinge.moves_root:
        doubts += ("the filmed pitch has no effect: the wing's pitch hinge gives way, in place of its pitch law",)
    return dataclasses.replace(changed, warnings=(*changed.warnings, *doubts))


def doubts_of(beat: Filmed, species: Species) -> tuple[str, ...]:
    """Return the warnings of a film, with those on numbers of the species that it contradicts."""
    filmed, found = beat.numbers_of(species.vehicle, species.wingbeat), [*beat.warnings]
    lost = [name for name in filmed if species.is_set_by_hand(f"wingbeat.{name}")]
    lost = [name for name in lost if filmed[name] != getattr(species.wingbeat, name)]
    if "wrist" in lost:
        own = species.wingbeat.wrist
        found.append(f"wingbeat.wrist is {own:.4g}, set by hand, in place of the film's {filmed['wrist']:.4g}")
    if others := [f"wingbeat.{name}" for name in lost if name != "wrist"]:
        found.append(f"the film replaces what was set by hand: {', '.join(others)}")
    return (*found, *beat.differences(species.vehicle, species.wingbeat))


def trim_of(beat: Filmed, species: Species) -> tuple[tuple[str, ...], dict[str, tuple[float, float]]]:
    """Return the species' free parameters that were not filmed, and bounds of those that are freed in addition."""
    # Two free parameters are needed to control forward and vertical speed.
    free, bounds = [name for name in species.free if name not in beat.held], {}
    for name in ("pitch_mean", "pitch_amplitude"):
        if len([one for one in free if one not in _NO_CONTROL]) < 2 and name not in free:
            filmed = beat.numbers_of(species.vehicle, species.wingbeat)
            here = filmed.get(name, getattr(species.wingbeat, name))
            least = here - _TRIM_RANGE if name == "pitch_mean" else max(here - _TRIM_RANGE, 0.0)
            free.append(name)
            bounds[name] = (least, here + _TRIM_RANGE)
    return tuple(free), bounds


def trimmed(
    beat: Filmed, species: Species, asked: dict[str, Any]
) -> tuple[Species, tuple[str, ...], dict[str, Any]]:
    """Return filmed species, free parameters and other arguments of `OrbitProblem`, with those asked for."""
    free, bounds = trim_of(beat, species)
    # The filmed stroke is fixed, so a limit could not keep the wings apart. An orbit whose wings cross draws a
    # warning.
    more = {"wings_may_cross": True} | asked | {"bounds": bounds | asked.get("bounds", {})}
    return filmed_species(beat, species), free, more


def filmed_problem(beat: Filmed, species: Species, speed: float, **more: Any) -> OrbitProblem:
    """Return the orbit problem that trims a filmed wingbeat for flight at a speed.

    Parameters
    ----------
    beat : from `wingbeat.experiment.fit_film`.
    species : the filmed species.
    speed : mean forward speed [m/s].
    more : other arguments of `OrbitProblem`. Without an objective, the frequency is minimised if it is free,
        and otherwise the mean positive power.

    Raises
    ------
    InvalidInputError : inputs that `OrbitProblem` refuses.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> film = wb.experiment.synthetic_film(pigeon.wingbeat, frames=60, noise_deg=1.0)
    >>> wb.filmed_problem(wb.experiment.fit_film(film), pigeon, speed=10.0).free
    ('pitch_mean', 'pitch_amplitude')
    """
    own, free, more = trimmed(beat, species, more)
    if "frequency" not in free:
        more.setdefault("minimise", "mean_positive_power")
    return OrbitProblem(own, speed, free=free, **more)
