"""What was measured on live animals, as the explorer draws it behind a curve against speed."""

from __future__ import annotations

from typing import Any

from wingbeat.animal.species.species import Species
from wingbeat_evidence.whole_flights import Measurement, measured_animals, read_measured_flights
from wingbeat_evidence.whole_flights.comparison import ends_of, name_of


def measured_points(species: Species) -> list[dict[str, Any]]:
    """Return what the package holds of a species' flights, for a curve of power or frequency; often nothing.

    Each has ``speed`` [m/s], ``power`` [W] or ``frequency`` [Hz], all as a lowest and a highest value, and basis,
    label and source. Powers per mass are multiplied by the mass of the species. The speed of minimum power has
    neither power nor frequency.

    Parameters
    ----------
    species : the animal.

    >>> import wingbeat as wb
    >>> points = measured_points(wb.load_species("pigeon"))
    >>> points[0]["frequency"], [round(watt, 1) for watt in points[3]["power"]]
    ([7.33, 8.71], [14.6, 17.8])
    """
    if species.name not in measured_animals():
        return []
    found = [_point(one, species.vehicle.mass) for one in read_measured_flights(species.name).measurements]
    return [one for one in found if one is not None]


def _point(one: Measurement, mass: float) -> dict[str, Any] | None:
    about = {
        "basis": one.basis,
        "label": f"{name_of(one.quantity)}, {one.basis}: {ends_of(one.values)}. {one.what}",
        "source": one.source,
    }
    if one.speeds is None:
        return about | {"speed": list(one.values)}
    if one.quantity == "frequency":
        return about | {"speed": list(one.speeds), "frequency": list(one.values)}
    if one.quantity == "positive_power_per_mass":
        return about | {"speed": list(one.speeds), "power": [mass * value for value in one.values]}
    return None
