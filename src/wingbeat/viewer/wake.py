"""The velocity with which the sketch of the wake moves: the induced flow of the flight's own air loads."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy as np

from wingbeat.aero.closed_forms import body_drag, disc_area, induced_flow

if TYPE_CHECKING:
    import xarray as xr


def wake_of(dataset: xr.Dataset) -> dict[str, list[float]] | None:
    """Return the induced velocity that the air loads of a saved orbit contain; None if they contain none.

    A simulated flight has None too: its file does not say which air loads it was flown with.

    Parameters
    ----------
    dataset : of an orbit or a simulated flight.

    Returns
    -------
    wake : ``{"induced": [forward, up]}`` [m/s], as at the wings; the far wake of an ideal disc moves twice as fast.

    >>> import xarray as xr
    >>> wake_of(xr.Dataset(attrs={"aero": '{"coefficients": "su-fan"}'})) is None
    True
    """
    aero = json.loads(dataset.attrs.get("aero", "{}"))
    if aero.get("inflow", "none") == "none":
        return None
    vehicle, air = (json.loads(dataset.attrs[name]) for name in ("vehicle", "air"))
    body, wing = vehicle["body"], vehicle["wing"]
    velocity = dataset.attrs["speed"], dataset.attrs["climb"]
    drag = body_drag(body["drag_area"], air["density"], velocity, np)
    force = -drag[0], (body["mass"] + 2 * wing["mass"]) * air["gravity"] - drag[1]
    factor = aero.get("share", 1.0) * aero["induced_factor"]
    flow = induced_flow(air["density"], disc_area(wing["semi_span"]), factor, force, velocity)
    return {"induced": [float(part) for part in flow]}
