"""The glide polar: steady glides at a range of angles of attack, with the slowest sink and the flattest path."""

from __future__ import annotations

import dataclasses
import functools
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import KIND, NOMENCLATURE, FaultList, __version__
from wingbeat.aero import BladeElement, SuFan
from wingbeat.aero.blade_element import blade_element_of
from wingbeat.animal.species.species import Species
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.glide import TRIMS, Glide, GlideSolver
from wingbeat.records.inputs import aero_record, vehicle_record
from wingbeat.records.orbit_record import guessed
from wingbeat.records.result_files import Saveable
from wingbeat.records.tables import finite_or_none

if TYPE_CHECKING:
    import xarray as xr

DEFAULT_ALPHA_DEG = np.arange(1.0, 31.0)


@dataclass(frozen=True)
class GlidePolar(Saveable):
    """Steady glides of one species over the angle of attack; made by `glide_polar`.

    Attributes
    ----------
    species : the gliding species.
    aero : its air loads.
    trim : the angle that was turned until the pitching moment vanished.
    glides : one for each angle of attack, in the given order.
    least_sink : the glide of slowest sink within the given angles of attack; None if the slowest sink is at the
        smallest or largest angle.
    best_ratio : the glide of flattest path within the same angles; None if the flattest path is at the smallest or
        largest angle.

    >>> import numpy as np, wingbeat as wb
    >>> polar = wb.glide_polar(wb.load_species("pigeon"), angles_of_attack=np.radians([4.0, 6.0, 8.0]))
    >>> [round(glide.speed, 1) for glide in polar.glides]
    [12.8, 11.6, 10.9]
    """

    species: Species
    aero: BladeElement
    trim: str
    glides: tuple[Glide, ...]
    least_sink: Glide | None
    best_ratio: Glide | None

    def record(self) -> dict[str, Any]:
        """Return everything as a JSON-able dictionary, SI and radians; None for glides that were not found."""
        rows = [finite_or_none(glide._asdict()) for glide in self.glides]
        lists = {name: [row[name] for row in rows] for name in Glide._fields}
        return {**self._about(), **lists}

    def _about(self) -> dict[str, Any]:
        best = {"least_sink": self.least_sink, "best_ratio": self.best_ratio}
        return {
            "species": self.species.name,
            "vehicle": vehicle_record(self.species.vehicle),
            "aero": aero_record(self.aero),
            "air": dict(vars(self.species.air)),
            **({"carried_mass": self.species.carried_mass} if self.species.carried_mass else {}),
            "trim": self.trim,
            **{name: None if glide is None else glide._asdict() for name, glide in best.items()},
            "warnings": glide_warnings(self),
            "version": __version__,
        }

    @functools.cached_property
    def dataset(self) -> xr.Dataset:
        """The polar over angle of attack, labelled."""
        import xarray as xr

        columns = dict(zip(Glide._fields, np.array(self.glides, dtype=float).T, strict=True))
        columns["trimmed"] = columns["trimmed"].astype("int8")
        terms = {name: NOMENCLATURE.get(f"glide.{name}") or NOMENCLATURE[name] for name in columns}
        variables = {
            name: (("angle_of_attack",), columns[name], {"units": term.unit, "long_name": term.label})
            for name, term in terms.items()
        }
        about = {k: v if isinstance(v, str) else json.dumps(v) for k, v in self._about().items()}
        attributes = {"Conventions": "CF-1.11", KIND: "glide", **about}
        return xr.Dataset(variables, attrs=attributes).set_coords("angle_of_attack")


def glide_polar(
    species: Species,
    aero: Any = None,
    angles_of_attack: Sequence[float] | np.ndarray | None = None,
    flap: float = 0.0,
    trim: str = "body-pitch",
) -> GlidePolar:
    """Find the steady glides of a species with its wings held still, spread as in mid-downstroke.

    The sum of lift, drag and weight is zero; the air loads are the same as in flapping flight. If possible, the
    pitching moment is zero too. If no angle trims the moment, the body stays along the path, and
    `Glide.tail_moment` is the moment that a tail would need to supply.

    Parameters
    ----------
    species : gives vehicle, twist, air, and the range of body pitch.
    aero : as in `OrbitProblem`, `SuFan()` if not given.
    angles_of_attack : of the root chord at zero flap angle [rad]; default 1 to 30 degrees.
    flap : flap angle at which the wings are held [rad].
    trim : what turns until the pitching moment is zero. With ``"body-pitch"``, the wings keep their angle of
        attack; with ``"flap"`` or ``"tail"``, the body stays along the path. Without a tail, ``"tail"`` turns
        nothing.

    Raises
    ------
    InvalidInputError : angles not increasing or not between 0 and 90 degrees, a flap angle beyond 90 degrees, an
        unknown trim.

    >>> from wingbeat import load_species
    >>> polar = glide_polar(load_species("pigeon"), angles_of_attack=np.radians([4.0, 6.0, 8.0]))
    >>> round(polar.best_ratio.glide_ratio, 2), round(polar.best_ratio.speed, 1)
    (3.27, 11.9)
    """
    faults = FaultList()
    angles = np.radians(DEFAULT_ALPHA_DEG) if angles_of_attack is None else np.asarray(angles_of_attack, float)
    fix = "give increasing angles, above 0 and at most pi/2"
    inside = angles.ndim == 1 and angles.size > 0 and (angles > 0).all() and (angles <= 0.5 * math.pi).all()
    if not inside or not (np.diff(angles) > 0).all():
        faults.add("angles_of_attack", angles.tolist(), "must be angles of attack in radians", fix)
    if not isinstance(species, Species):
        faults.add("species", species, "is not a Species", "use load_species(name or path)")
    elif species.air.gravity == 0:
        faults.add("air.gravity", species.air.gravity, "must be > 0 m/s2", "nothing glides without weight")
    if faults.angle("flap", flap, advice="write np.radians(...)"):
        faults.number("flap", flap, above=-0.5 * math.pi, below=0.5 * math.pi, unit="rad")
    faults.choice("trim", trim, TRIMS)
    faults.raise_if_any()
    loads = blade_element_of(SuFan() if aero is None else aero)
    # This velocity is replaced: each glide sets the inflow for a velocity of its own.
    # The wake of steady flight is at rest.
    model = FlightModel(species.vehicle, dataclasses.replace(loads, wake="none"), species.air, velocity=(1.0, 0.0))
    either_way = -0.5 * math.pi, 0.5 * math.pi
    mean = species.bounds.get("flap_mean", either_way)
    tilt = species.bounds.get("tail_tilt", either_way)
    reach = {"body-pitch": species.path_bounds["body_pitch"], "flap": mean, "tail": tilt}[trim]
    solver = GlideSolver(model, species.wingbeat, flap, trim, reach)
    glides = tuple(solver.at(float(angle)) for angle in angles)
    sink = _best(solver, glides, lambda glide: glide.sink)
    ratio = _best(solver, glides, lambda glide: -glide.glide_ratio)
    return GlidePolar(species, loads, trim, glides, sink, ratio)


def _best(solver: GlideSolver, glides: tuple[Glide, ...], cost: Any) -> Glide | None:
    """Refine the cheapest glide between its two neighbours; None without a finite neighbour on both sides."""
    from scipy.optimize import minimize_scalar

    costs = np.nan_to_num([cost(glide) for glide in glides], nan=np.inf)
    least = int(costs.argmin())
    if not 0 < least < len(glides) - 1 or not np.isfinite(costs[[least - 1, least + 1]]).all():
        return None
    ends = glides[least - 1].angle_of_attack, glides[least + 1].angle_of_attack
    found: Any = minimize_scalar(lambda angle: cost(solver.at(angle)), bounds=ends, options={"xatol": 1e-9})
    return solver.at(float(found.x))


def glide_warnings(polar: GlidePolar) -> list[str]:
    """Return what a reader should know before trusting a glide polar."""
    notes = list(polar.species.warnings)
    found = [glide for glide in polar.glides if math.isfinite(glide.speed)]
    if len(found) < len(polar.glides):
        notes.append(f"there is no steady forward glide at {len(polar.glides) - len(found)} angles of attack")
    untrimmed = [glide for glide in found if not glide.trimmed]
    if untrimmed:
        moments = [glide.tail_moment for glide in untrimmed]
        tail = "a tail would need to supply" if polar.species.vehicle.tail is None else "the tail would need to add"
        notes.append(
            f"{len(untrimmed)} of {len(found)} glides are not trimmed: the body stays along the path, and {tail} "
            f"{min(moments):.2g} to {max(moments):.2g} N m (nose up positive)"
        )
    coefficients, wing, air = polar.aero.coefficients, polar.species.vehicle.wing, polar.species.air
    low, high = coefficients.reynolds_range or (0.0, math.inf)
    reynolds = [glide.speed * wing.mean_chord / air.viscosity for glide in found]
    outside = sum(not low <= number <= high for number in reynolds)
    if outside:
        notes.append(
            f"Reynolds number outside the fitted {low:g} to {high:g} in {outside} of {len(found)} glides "
            f"(it runs from {min(reynolds):.0f} to {max(reynolds):.0f})"
        )
    if polar.aero.inflow == "none":
        notes.append("the model adds no induced drag to the coefficients")
    return notes + guessed(coefficients)
