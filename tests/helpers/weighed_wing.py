"""A table of masses by station, of no real robot: a spar behind the leading edge, a skin, a joint in the middle."""

import numpy as np

SPAR, SKIN = np.linspace(0.04, 0.96, 12), np.linspace(0.1, 0.95, 9)
TABLE = {
    "mass_stations": (*SPAR, *SKIN, 0.5),
    "station_masses": (*np.linspace(8e-4, 3e-4, 12), *np.linspace(1.2e-3, 6e-4, 9), 1.5e-3),
    "station_axes": (*np.full(12, 0.04), *np.full(9, 0.5), 0.1),
    "station_gyrations": (*np.zeros(12), *np.full(9, 0.2887), 0.02),
}
TOTAL = sum(TABLE["station_masses"])
