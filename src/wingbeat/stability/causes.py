"""What makes an orbit stable: derivatives of its multipliers by every number of the animal."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import Report, Reported
from wingbeat.orbits.flight.certificate import multipliers_of
from wingbeat.orbits.flight.period import inner_start
from wingbeat.orbits.options import DEFAULTS as SOLVER
from wingbeat.orbits.options import SolverOptions
from wingbeat.orbits.problem.quantity import MAP_QUANTITIES, MapQuantity
from wingbeat.plots.draw_influences import tornado_page
from wingbeat.records.tables import table_of
from wingbeat.results.sensitivities import Sensitivities, differentiated
from wingbeat.stability.reports import causes_report, pairs

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from wingbeat.results.orbit import Orbit

_RADIUS = MAP_QUANTITIES["spectral_radius"]


@dataclass(frozen=True)
class StabilitySensitivities(Reported):
    """Derivatives of an orbit's multipliers by every number it depends on; made by `stability_sensitivities`.

    The wingbeat is solved again for each change, so that the derivatives are those of the optimum.

    Attributes
    ----------
    sensitivities : of the spectral radius; its `ranked`, `swing` and `prices` say what moves it.
    multipliers : Floquet multipliers, the largest modulus first, shape (4,).
    by_parameter : by the path of a parameter, the derivatives of the four multipliers, per its unit, shape (4,).
        They are infinite where two multipliers meet.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> found = wb.stability_sensitivities(orbit)
    >>> round(found.spectral_radius, 2), found.by_parameter["body.mass"].shape
    (1.35, (4,))
    """

    sensitivities: Sensitivities
    multipliers: np.ndarray
    by_parameter: dict[str, np.ndarray]

    @property
    def spectral_radius(self) -> float:
        """Largest modulus of a multiplier; below 1 disturbances decay."""
        return self.sensitivities.values[_RADIUS.name]

    def _report(self) -> Report:
        return causes_report(self.record())

    def plot(self) -> Figure:
        """Return a figure that ranks the numbers of the animal by how far they can move the spectral radius."""
        return tornado_page(self.sensitivities)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each parameter, the most important first: value, range, derivative and changes.

        Values are in SI units and radians; the unit of a parameter stands in its row.
        """
        return table_of(self.record()["parameters"])

    def record(self) -> dict[str, Any]:
        """Return all numbers as a JSON-able dictionary, the most important first; complex numbers become pairs."""
        found = self.sensitivities
        return {
            "spectral_radius": self.spectral_radius,
            "multipliers": pairs(self.multipliers),
            "parameters": [
                {
                    "parameter": slope.parameter.path,
                    "unit": slope.parameter.unit,
                    "value": slope.parameter.value,
                    "plausible": None if slope.parameter.plausible is None else list(slope.parameter.plausible),
                    "spectral_radius": slope.quantities[_RADIUS.name],
                    "change_to_ends": list(found.swing(slope, _RADIUS.name)),
                    "multipliers": pairs(self.by_parameter[slope.parameter.path]),
                }
                for slope in found.ranked(_RADIUS.name)
            ],
            "prices": {price.parameter.path: price.quantities[_RADIUS.name] for price in found.prices},
        }


def stability_sensitivities(orbit: Orbit, options: SolverOptions = SOLVER) -> StabilitySensitivities:
    """Differentiate the multipliers of an orbit with respect to every number the orbit depends on.

    Parameters
    ----------
    orbit : a certified orbit.
    options : of the solvers.

    Raises
    ------
    InvalidInputError : an orbit that is not certified, an optimum without derivatives.

    A multiplier moves by ``w^H dA v / (w^H v)``, with its right and left eigenvectors v and w (Magnus 1985, doi
    10.1017/S0266466600011129). Here dA is the change of the stroke map while the optimum moves along; with the lag
    of the wake or a hinge that gives way, the map has their states, too.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> found = wb.stability_sensitivities(orbit)
    >>> found.sensitivities.ranked("spectral_radius")[0].parameter.path
    'wing.shoulder.x'
    """
    states = 4 + inner_start(orbit.problem.model, orbit.wingbeat).size
    places = np.ndindex(states, states)
    entries = [MapQuantity(f"stroke_map{place}", operator.itemgetter(place)) for place in places]
    found = differentiated(orbit, [_RADIUS, *entries], options)
    slopes, prices = (
        [one._replace(quantities={_RADIUS.name: one.quantities[_RADIUS.name]}) for one in part]
        for part in (found.slopes, found.prices)
    )
    radius = [_RADIUS], [found.values[_RADIUS.name]]
    alone = Sensitivities(found.problem, found.unknowns, *radius, slopes, prices)

    def matrix(numbers: dict[str, float]) -> np.ndarray:
        return np.reshape([numbers[one.name] for one in entries], (states, states))

    stroke_map = matrix(found.values)
    by_parameter = {s.parameter.path: multiplier_slopes(stroke_map, matrix(s.quantities)) for s in found.slopes}
    return StabilitySensitivities(alone, multipliers_of(stroke_map), by_parameter)


def multiplier_slopes(stroke_map: np.ndarray, change: np.ndarray) -> np.ndarray:
    """Return how fast the multipliers move when the map does, in the order of `multipliers_of`, shape (4,).

    Theory: equation ``multiplier-slope``.
    """
    from scipy.linalg import eig

    # Of a map with the wake, most multipliers are nearly 0, and the inverse of all eigenvectors would be inexact.
    found: Any = eig(stroke_map, left=True, right=True)
    values, left, right = found
    order = [int(np.argmin(np.abs(values - one))) for one in multipliers_of(stroke_map)]
    left, right = left[:, order].conj().T, right[:, order]
    with np.errstate(divide="ignore", invalid="ignore"):  # infinite where two multipliers meet
        return (np.diag(left @ change @ right) / np.diag(left @ right)).astype(complex)
