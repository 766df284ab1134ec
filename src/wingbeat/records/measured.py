"""Measured flights beside a curve: each measurement less what the curve has at its speed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat.experiment.flights_file import FlightPoints
from wingbeat.records.characteristic import best_line
from wingbeat.records.judgements import set_by_limits_along

if TYPE_CHECKING:
    import xarray as xr

# What of a curve is compared with what was measured.
COMPARED = {
    "frequency": "frequency",
    "mechanical_power": "mean_positive_power",
    "metabolic_rate": "metabolic_rate",
}


def measured_beside(dataset: xr.Dataset, flights: FlightPoints) -> dict[str, Any]:
    """Return each measurement, the curve's value at its speed, and the difference, fit for JSON; with sums.

    Between two neighbouring speeds the best wingbeats' numbers are interpolated linearly. Nothing is computed
    outside the curve, beside a speed without a certified wingbeat, or where another kind of wingbeat takes over.
    """
    line, speeds = best_line(dataset), dataset["speed"].values
    limits = set_by_limits_along(dataset)
    rows: list[dict[str, Any]] = []
    notes = list(flights.notes)
    for quantity, measured in flights.values.items():
        name = COMPARED[quantity]
        variable = name if name in dataset or dataset.attrs["objective"] != name else "objective_value"
        has_it = variable in dataset
        there = dataset[variable].values[:, 0] if has_it else np.full(len(speeds), np.nan)
        if not has_it:
            words = quantity.replace("_", " ")
            notes.append(f"the curve has no {words}; --model animal gives one")
        for i in np.flatnonzero(np.isfinite(measured)):
            speed, error = float(flights.speed[i]), float(flights.errors[quantity][i])
            computed, limited, why = None, False, ""
            above = int(np.searchsorted(speeds, speed))
            ends = [above] if above < len(speeds) and speeds[above] == speed else [above - 1, above]
            if not has_it:
                why = "the curve has no such number"
            elif not speeds[0] <= speed <= speeds[-1]:
                why = f"outside the computed {speeds[0]:g} to {speeds[-1]:g} m/s"
            elif not np.isfinite(there[ends]).all():
                why = "beside a speed without a certified wingbeat"
            elif len(ends) == 2 and not line.joined[above - 1]:
                why = f"another kind of wingbeat takes over from {speeds[above - 1]:g} to {speeds[above]:g} m/s"
            else:
                computed = float(np.interp(speed, speeds[ends], there[ends]))
                limited = any(name in limits[end] for end in ends)
            difference = None if computed is None else float(measured[i]) - computed
            rows.append(
                {
                    **{"quantity": quantity, "speed": speed, "label": flights.labels[i]},
                    **{"measured": float(measured[i]), "error": error if np.isfinite(error) else None},
                    **{"compared_with": name, "computed": computed, "residual": difference},
                    **{"set_by_limit": limited, "not_compared": why},
                }
            )
    sums = {}
    for quantity in flights.values:
        found = [row for row in rows if row["quantity"] == quantity and row["residual"] is not None]
        if found:
            left, computed = (np.array([row[key] for row in found]) for key in ("residual", "computed"))
            sums[quantity] = {
                **{"count": len(found), "mean": float(left.mean()), "rms": float(np.sqrt(np.mean(left**2)))},
                "mean_share": float((left / computed).mean()) if computed.all() else None,
            }
    return {"file": flights.name, "points": rows, "residuals": sums, "notes": notes}
