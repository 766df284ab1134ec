"""Laws for flight muscle, and for the tails of birds.

The mass of the depressors and, for birds, the share of the elevators follow from the mass of the animal alone. The
other numbers of muscle are constants. We found no published speed of shortening of a bird's flight muscle. It is
derived from the largest power of a cockatiel's pectoralis and the isometric stress. The stress is a guess, but its
product with the speed is measured.

Length, area and arm of a tail follow from the bird's mass alone; the lift slope and the drag coefficient are
constants. A bird's tail is taken as a triangle that opens backwards from its root, spread by 60 degrees. No law of
the tails of bats or of robots was found.
"""

from __future__ import annotations

import math

from wingbeat.aero.closed_forms import slender_slope
from wingbeat.animal.species.numbers import HARVEY, Data, Law, Number
from wingbeat.animal.vehicle import MUSCLE_DENSITY

# --- muscle ---

WRIGHT = "Wright, Steadman and Witt 2016, Proc Natl Acad Sci USA 113:4765, doi 10.1073/pnas.1522931113"
MORRIS = "Morris and Askew 2010, J Exp Biol 213:2770, abstract"
BIEWENER = "Biewener, Corning and Tobalske 1998, J Exp Biol 201:3293, abstract"
BULLEN_MUSCLE = "Bullen and McKenzie 2004, Aust J Zool 52:605, doi 10.1071/ZO04036, abstract"
_MUSCLE_BIRDS = Data({"m": (0.004, 12.0)}, "1301 species without hummingbirds")
_MUSCLE_BATS = Data({"m": (0.002, 0.9)}, "29 species of bats; the masses are those of Australian bats, a guess")
# The largest power of isotonic contractions [W/kg], and the share of the largest speed at which it was reached.
_POWER, _SHARE = 533.0, 0.34


DEPRESSOR_MASS = Law(
    "kg",
    "0.1392 m^0.996",
    ("m kg",),
    lambda mass: 0.1392 * mass**0.996,
    f"pectoralis of both sides, fitted to the data of {WRIGHT}",
    (0.57, 1.75),
    "19 of 20 species",
    _MUSCLE_BIRDS,
)
ELEVATOR_SHARE = Law(
    "1",
    "0.112 m^0.016",
    ("m kg",),
    lambda mass: 0.0156 * mass**1.012 / DEPRESSOR_MASS(mass),
    f"supracoracoideus, 0.0156 m^1.012, divided by pectoralis; fitted to the data of {WRIGHT}",
    (0.33, 3.0),
    "19 of 20 species",
    _MUSCLE_BIRDS,
)
BAT_DEPRESSOR_MASS = Law(
    "kg",
    "0.12 m",
    ("m kg",),
    lambda mass: 0.12 * mass,
    f"guess: three quarters of all flight muscle, which is 9 to 23 % of the mass ({BULLEN_MUSCLE})",
    (0.6, 1.5),
    "the ends of that range",
    _MUSCLE_BATS,
)
BAT_ELEVATOR_SHARE = Law(
    "1",
    "1/3",
    (),
    lambda: 1 / 3,
    "no law found: a guess; bats raise their wings by several small muscles",
    (0.4, 2.0),
    "guess",
    _MUSCLE_BATS,
)
STRAIN_PER_ANGLE = Law(
    "1/rad",
    "0.15",
    (),
    lambda: 0.15,
    f"a pigeon's pectoralis shortens by 0.32 of its length in slow level flight ({BIEWENER}), over a stroke of "
    "2.1 rad, which is a guess: no source gives strain and stroke together",
    (0.67, 1.5),
    "guess: other flights of pigeons have strains of 0.24 to 0.42",
    Data({}, "one study of pigeons"),
)
ISOMETRIC_STRESS = Law(
    "Pa",
    "250 kPa",
    (),
    lambda: 250e3,
    "guess: the stress of vertebrate muscle; a zebra finch's pectoralis gave 101 kPa in situ (Bahlman, Baliga and "
    "Altshuler 2020, J Exp Biol 223:jeb225839, data)",
    (0.4, 1.6),
    "from that finch to the 400 kPa that programs of flight assume",
    Data({}, "none: a guess"),
)
MAX_STRAIN_RATE = Law(
    "1/s",
    "rho P / (q^2 sigma)",
    ("rho kg/m3", "P W/kg", "q 1", "sigma Pa"),
    lambda density, power, share, stress: density * power / (share**2 * stress),
    f"the largest power of a cockatiel's pectoralis and its share of the largest speed, {MORRIS}; sigma is the "
    "isometric stress; a smaller sigma goes with a larger speed, because their product is measured",
    (0.6, 2.5),
    "the inverse of the spread of the isometric stress",
    Data({}, "one study of cockatiels"),
)


def muscle_numbers(mass: float, bat: bool = False) -> dict[str, Number]:
    """Return the numbers of the flight muscle that the laws give a bird or a bat of this mass [kg], by their paths.

    >>> {path.rpartition(".")[2]: float(f"{number.value:.3g}") for path, number in muscle_numbers(0.316).items()}
    {'mass': 0.0442, 'elevator_share': 0.11, 'strain_per_angle': 0.15, 'max_strain_rate': 19.5, \
'isometric_stress': 250000.0, 'curvature': 0.361}
    """
    # Hill's relation has its largest power at q = sqrt(k^2 + k) - k.
    curvature = (
        f"derived: q^2 / (1 - 2 q) at q = {_SHARE:g}, the share of the largest speed at which power is largest, "
        f"{MORRIS}"
    )
    numbers = {
        "mass": (BAT_DEPRESSOR_MASS if bat else DEPRESSOR_MASS).number(mass),
        "elevator_share": BAT_ELEVATOR_SHARE.number() if bat else ELEVATOR_SHARE.number(mass),
        "strain_per_angle": STRAIN_PER_ANGLE.number(),
        "max_strain_rate": MAX_STRAIN_RATE.number(MUSCLE_DENSITY, _POWER, _SHARE, ISOMETRIC_STRESS()),
        "isometric_stress": ISOMETRIC_STRESS.number(),
        "curvature": Number(_SHARE**2 / (1.0 - 2.0 * _SHARE), "1", curvature, (0.15, 0.5)),
    }
    for name in ("strain_per_angle", "max_strain_rate", "isometric_stress", "curvature") if bat else ():
        numbers[name] = numbers[name]._replace(source=f"guess, the number of birds: {numbers[name].source}")
    return {f"vehicle.muscle.{name}": number for name, number in numbers.items()}


# --- tail ---

THOMAS = "Thomas 1993, Phil Trans R Soc B 340:361, doi 10.1098/rstb.1993.0079"
EVANS = "Evans 2003, Proc R Soc B 270:1379, doi 10.1098/rspb.2003.2373"
MAYBURY = "Maybury et al. 2001, Proc R Soc B 268:1443, doi 10.1098/rspb.2001.1666"
# Angle between the outer feathers [rad]: the widest for which the theory of slender wings held.
_SPREAD = math.radians(60)
_HALF = math.tan(0.5 * _SPREAD)
_SHAPE = f"a triangle spread by 60 degrees, a guess: the widest for which theory held ({EVANS})"
_SPREADS = "guess: spread by 20 to 120 degrees"
_TAIL_BIRDS = Data({"m": (0.0019, 33.6)}, "850 species of that table")


def _length(mass: float) -> float:
    return 0.1364 * mass**0.2209


TAIL_LENGTH = Law(
    "m",
    "0.1364 m^0.2209",
    ("m kg",),
    _length,
    "fitted to the means of 850 species of AVONET, Tobias et al. 2022, Ecol Lett 25:581, doi 10.1111/ele.13898",
    (0.38, 1.97),
    "19 of 20 species of that table",
    _TAIL_BIRDS,
)
TAIL_AREA = Law(
    "m2",
    "l^2 tan(60 deg / 2), tail length l = 0.1364 m^0.2209",
    ("m kg",),
    lambda mass: _HALF * _length(mass) ** 2,
    f"{_SHAPE}; length as of AVONET, Tobias et al. 2022, doi 10.1111/ele.13898",
    (0.3, 3.0),
    _SPREADS,
    _TAIL_BIRDS,
)
TAIL_ARM = Law(
    "m",
    "0.088 (m / 0.26)^(1/3) + 2/3 of the tail length 0.1364 m^0.2209",
    ("m kg",),
    lambda mass: 0.088 * (mass / 0.26) ** (1 / 3) + 2 / 3 * _length(mass),
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
    """Return the numbers of the tail that the laws give a bird of this mass [kg], by their paths.

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
