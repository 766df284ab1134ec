"""Frequencies, flight powers and speeds of live animals to draw beside ours, each with source, spread and grade.

Grade A: we read the number in the source's own text. Grade D: we computed it from such a text for our vehicle. We
leave out numbers that we know only second-hand. Among these are the frequencies of Tobalske and Dial 1996 that the
paper draws: we could not obtain their table, and their abstract says only that the frequency does not change
appreciably from 6 to 20 m/s. No source measures the mean positive hinge power, which we compute: each label says
what was measured.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from wingbeat.animal.species import scaling
from wingbeat.animal.vehicle import Air, Vehicle

# What the paper prints about the bat at 10 m/s, by coefficient model: peak power [W], range of body pitch [deg].
PAPER = "Su, Fan, Onoue, Vejdani and Breuer 2023, doi 10.48550/arXiv.2302.09602"
PAPER_PEAK_POWER = {"su-fan": 30.0, "dickinson": 150.0}
PAPER_PITCH_RANGE_DEG = {"su-fan": 10.0, "dickinson": 25.0}
# The bat's frequency [Hz]; the lowest and highest speed [m/s] at which Su-Fan's frequency is said to agree with it;
# Dickinson's frequency at the higher speed divided by Su-Fan's.
PAPER_BAT_FREQUENCY, PAPER_BAT_SPEEDS, PAPER_BAT_RATIO = 6.0, (5.0, 10.0), 2.0
# The angles of attack that the paper calls small [deg].
PAPER_SMALL_ALPHA_DEG = (0.0, 13.0)


@dataclass(frozen=True)
class Measured:
    """A measured wingbeat frequency.

    Parameters
    ----------
    animal : the vehicle of ours with which it is compared.
    label : short text for a legend.
    speeds : lowest and highest flight speed of the measurement [m/s]; equal for a single point.
    value : function that returns the frequency, in `unit`, for a vehicle, its air and a flight speed [m/s].
    spread : half width, in `unit`; 0 where the source states none.
    source : the citation.
    grade : A if the value is as in the source, D if we computed it from the source.
    unit : of value and spread.
    """

    animal: str
    label: str
    speeds: tuple[float, float]
    value: Callable[[Vehicle, Air, float], float]
    spread: float
    source: str
    grade: str
    unit: str = "Hz"


def _birds_by_theory(vehicle: Vehicle, air: Air, speed: float) -> float:
    wing = vehicle.wing
    span, area = 2 * wing.semi_span, 2 * wing.semi_span * wing.mean_chord
    return scaling.BIRD_FREQUENCY(vehicle.mass, span, area, air.density, air.gravity)


_RAYNER = "van den Berg and Rayner 1995, J Exp Biol 198:1655, table 3"
_FLAT = "independent of speed from 6 to 20 m/s: Tobalske and Dial 1996, J Exp Biol 199:263, abstract"
_BIRDS_BY_SIZE = Measured(
    "pigeon",
    "birds by size, Pennycuick 1996",
    (6, 20),
    _birds_by_theory,
    0.0,
    "Pennycuick 1996, m^3/8 g^1/2 b^-23/24 S^-1/3 rho^-3/8 as in the R package afpt, for our span and area; "
    f"{_FLAT}",
    "D",
)
_LOADED_PIGEONS = Measured(
    "pigeon",
    "loaded pigeons, Usherwood et al. 2005",
    (4.46, 4.46),
    lambda vehicle, air, speed: 8.02,
    0.69,
    "Usherwood, Hedrick, McGowan and Biewener 2005, doi 10.1242/jeb.01359, table 2: 0.483 kg with their load",
    "A",
)
MEASURED_FREQUENCIES = (
    Measured(
        "pigeon",
        "birds by mass, van den Berg & Rayner 1995",
        (6, 20),
        lambda vehicle, air, speed: scaling.FREQUENCY_BY_MASS(vehicle.mass),
        0.0,
        f"{_RAYNER}; {_FLAT}",
        "D",
    ),
    Measured(
        "pigeon",
        "birds by wing length, same source",
        (6, 20),
        lambda vehicle, air, speed: scaling.FREQUENCY_BY_WING(vehicle.wing.semi_span),
        0.0,
        f"{_RAYNER}; {_FLAT}",
        "D",
    ),
    _BIRDS_BY_SIZE,
    _LOADED_PIGEONS,
    Measured(
        "bat",
        "bats by mass, Bullen & McKenzie 2002",
        (1, 10),
        lambda vehicle, air, speed: scaling.BAT_FREQUENCY(vehicle.mass, speed),
        1.0,
        "Bullen and McKenzie 2002, J Exp Biol 205:2615, abstract: 23 Australian species, 21 of them within 1 Hz; "
        "at high speeds the measured frequency hardly depends on speed, but the law keeps falling, so we do not "
        "draw it beyond 10 m/s",
        "D",
    ),
    Measured(
        "bat",
        "bats, 6 Hz as cited by Su et al. 2023",
        (4, 20),
        lambda vehicle, air, speed: PAPER_BAT_FREQUENCY,
        0.0,
        f"{PAPER}, citing Norberg and Norberg 2012: around 6 Hz at every speed",
        "A",
    ),
)
# References for the pigeon's frequency: loaded birds in slow flight, and a scaling law. Our figure 5 draws both. We
# could not obtain the paper's own reference, the measurements of Tobalske and Dial 1996.
PIGEON_REFERENCES = {"usherwood": _LOADED_PIGEONS, "pennycuick": _BIRDS_BY_SIZE}


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
MEASURED_MINIMUM_POWER_SPEEDS = {"pigeon": ("speed of minimum power, Pennycuick 1968", (8.0, 9.0), _PENNYCUICK)}
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
        beside.append(Published(quantity, measured.label, speeds, values, measured.spread))
    return beside


@dataclass(frozen=True)
class Published:
    """Published values to draw beside a curve.

    Parameters
    ----------
    quantity : ``frequency`` [Hz], ``mean_positive_power`` [W], or ``speed`` for a range of speeds only.
    label : short, with its citation.
    speeds : shape (K,) [m/s].
    values : shape (K,); none for ``speed``.
    spread : half width in the unit of the values; 0 if unknown.
    """

    quantity: str
    label: str
    speeds: np.ndarray
    values: np.ndarray
    spread: float = 0.0
