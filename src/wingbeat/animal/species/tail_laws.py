"""Laws for the tails of birds.

Length, area and arm follow from the bird's mass alone; the lift slope and the drag coefficient are constants.

A bird's tail is taken as a triangle that opens backwards from its root, spread by 60 degrees. No law of the tails
of bats or of robots was found.
"""

from __future__ import annotations

import math

from wingbeat.aero.tail import slender_slope
from wingbeat.animal.species.law import Data, Law
from wingbeat.animal.species.scaling import HARVEY
from wingbeat.animal.species_schema import Number

THOMAS = "Thomas 1993, Phil Trans R Soc B 340:361, doi 10.1098/rstb.1993.0079"
EVANS = "Evans 2003, Proc R Soc B 270:1379, doi 10.1098/rspb.2003.2373"
MAYBURY = "Maybury et al. 2001, Proc R Soc B 268:1443, doi 10.1098/rspb.2001.1666"

# Angle between the outer feathers [rad]: the widest for which the theory of slender wings held.
_SPREAD = math.radians(60)
_HALF = math.tan(0.5 * _SPREAD)
_SHAPE = f"a triangle spread by 60 degrees, a guess: the widest for which theory held ({EVANS})"
_SPREADS = "guess: spread by 20 to 120 degrees"
_BIRDS = Data({"m": (0.0019, 33.6)}, "850 species of that table")


def _length(mass: float) -> float:
    return 0.1364 * mass**0.2209


def _base(mass: float) -> float:
    return 0.088 * (mass / 0.26) ** (1 / 3)


TAIL_LENGTH = Law(
    "m",
    "0.1364 m^0.2209",
    ("m kg",),
    _length,
    "fitted to the means of 850 species of AVONET, Tobias et al. 2022, Ecol Lett 25:581, doi 10.1111/ele.13898",
    (0.38, 1.97),
    "19 of 20 species of that table",
    _BIRDS,
)
TAIL_AREA = Law(
    "m2",
    "l^2 tan(60 deg / 2), tail length l = 0.1364 m^0.2209",
    ("m kg",),
    lambda mass: _HALF * _length(mass) ** 2,
    f"{_SHAPE}; length as of AVONET, Tobias et al. 2022, doi 10.1111/ele.13898",
    (0.3, 3.0),
    _SPREADS,
    _BIRDS,
)
TAIL_ARM = Law(
    "m",
    "0.088 (m / 0.26)^(1/3) + 2/3 of the tail length 0.1364 m^0.2209",
    ("m kg",),
    lambda mass: _base(mass) + 2 / 3 * _length(mass),
    f"no law found: from the centre of mass to the root of the tail of one dissected pigeon of 0.26 kg, {HARVEY}, "
    f"scaled by isometry; then to the centre of area of the triangle, where a slender tail lifts ({THOMAS})",
    (0.7, 1.4),
    "guess",
    Data({"m": (0.26 / 27, 0.26 * 27)}, "one pigeon of 0.26 kg; a guess: a third to 3 times its length"),
)
TAIL_SLOPE = Law(
    "1/rad",
    "pi/2 times the aspect ratio, 4 tan(60 deg / 2)",
    (),
    lambda: slender_slope(4 * _HALF),
    f"{THOMAS}; {_SHAPE}",
    (0.3, 1.0),
    "guess: a starling's tail lifts less than the theory of slender wings predicts, except at the smallest spread "
    f"({MAYBURY})",
    Data({}, "none: theory"),
)
TAIL_DRAG = Law(
    "1",
    "0.02",
    (),
    lambda: 0.02,
    "no law found: a jackdaw's body and tail have a drag coefficient of 0.2 with the tail folded and of 0.4 with "
    "the tail fully spread (KleinHeerenbrink et al. 2016, doi 10.1242/jeb.132480); the difference, 6e-4 m2, over "
    "the 0.026 m2 of a triangle 0.122 m long and spread by 120 degrees",
    (0.5, 2.5),
    "guess: a smooth plate has 0.01 in laminar flow",
    Data({}, "one jackdaw"),
)


def tail_numbers(mass: float) -> dict[str, Number]:
    """Return the numbers of the tail that the laws give a bird, by their paths.

    Parameters
    ----------
    mass : of the whole bird [kg].

    >>> {path.rpartition(".")[2]: float(f"{number.value:.3g}") for path, number in tail_numbers(0.316).items()}
    {'area': 0.00646, 'arm': 0.164, 'lift_slope': 3.63, 'drag_coefficient': 0.02, 'incidence': 0.0}
    """
    level = "guess: along the body axis; tail_tilt turns it; no measured range of a tail's tilt was found"
    return {
        "vehicle.tail.area": TAIL_AREA.number(mass),
        "vehicle.tail.arm": TAIL_ARM.number(mass),
        "vehicle.tail.lift_slope": TAIL_SLOPE.number(),
        "vehicle.tail.drag_coefficient": TAIL_DRAG.number(),
        "vehicle.tail.incidence": Number(0.0, "rad", level, (math.radians(-30), math.radians(30))),
    }
