"""Flight powers and speeds of live animals, each with its source and grade as in `measured_bands`.

No source measures the mean positive hinge power, which we compute. Each label says what was measured.
"""

from __future__ import annotations

import numpy as np

from wingbeat.animal.vehicle import Air, Vehicle
from wingbeat.plots.curve_page import Published
from wingbeat.plots.measured_bands import MEASURED_FREQUENCIES, Measured

_PENNYCUICK = (
    "Pennycuick 1968, J Exp Biol 49:527: a pigeon of 0.4 kg, level flight at 3 to 16 m/s without oxygen debt"
)
MEASURED_POWERS = (
    Measured(
        "pigeon",
        "highest sustained, 0.4 kg, Pennycuick 1968",
        (3, 16),
        lambda vehicle, air, speed: 10.5,
        0.0,
        _PENNYCUICK,
        "A",
        "W",
    ),
    Measured(
        "pigeon",
        "sprint, 0.4 kg, Pennycuick 1968",
        (3, 16),
        lambda vehicle, air, speed: 20.4,
        0.0,
        _PENNYCUICK,
        "A",
        "W",
    ),
    Measured(
        "pigeon",
        "aerodynamic, loaded to 0.483 kg, Usherwood et al. 2005",
        (4.46, 4.46),
        lambda vehicle, air, speed: 25.6,
        3.8,
        "Usherwood, Hedrick, McGowan and Biewener 2005, doi 10.1242/jeb.01359: from pressures on both wings",
        "A",
        "W",
    ),
)
# Speeds of minimum power [m/s].
MEASURED_MINIMUM_POWER_SPEEDS = {
    "pigeon": ("speed of minimum power, Pennycuick 1968", (8.0, 9.0), _PENNYCUICK),
}
_POINTS = 33


def published_for(animal: str, vehicle: Vehicle, air: Air, slowest: float, fastest: float) -> list[Published]:
    """Return published values for a live animal between two speeds [m/s]; scaling laws use this vehicle's size."""
    beside = []
    if animal in MEASURED_MINIMUM_POWER_SPEEDS:
        label, speeds, _ = MEASURED_MINIMUM_POWER_SPEEDS[animal]
        beside.append(Published("speed", label, np.array(speeds), np.zeros(0)))
    for measured in (m for m in (*MEASURED_FREQUENCIES, *MEASURED_POWERS) if m.animal == animal):
        low, high = max(measured.speeds[0], slowest), min(measured.speeds[1], fastest)
        if low > high:
            continue
        speeds = np.linspace(low, high, _POINTS) if low < high else np.array([low])
        values = np.array([measured.value(vehicle, air, float(speed)) for speed in speeds])
        quantity = "frequency" if measured.unit == "Hz" else "mean_positive_power"
        beside.append(Published(quantity, f"{measured.label} ({measured.grade})", speeds, values, measured.spread))
    return beside
