"""Laws for flight muscle.

The mass of the depressors and, for birds, the share of the elevators follow from the mass of the animal alone. The
other numbers are constants.

We found no published speed of shortening of a bird's flight muscle. We derive it from the largest power of a
cockatiel's pectoralis and the isometric stress. The stress is a guess, but its product with the speed is measured.
"""

from __future__ import annotations

from wingbeat.animal.species.law import Data, Law
from wingbeat.animal.species_schema import Number
from wingbeat.animal.vehicle import MUSCLE_DENSITY

WRIGHT = "Wright, Steadman and Witt 2016, Proc Natl Acad Sci USA 113:4765, doi 10.1073/pnas.1522931113"
MORRIS = "Morris and Askew 2010, J Exp Biol 213:2770, abstract"
BIEWENER = "Biewener, Corning and Tobalske 1998, J Exp Biol 201:3293, abstract"
BULLEN = "Bullen and McKenzie 2004, Aust J Zool 52:605, doi 10.1071/ZO04036, abstract"

_BIRDS = Data({"m": (0.004, 12.0)}, "1301 species without hummingbirds")
_BATS = Data({"m": (0.002, 0.9)}, "29 species of bats; the masses are those of Australian bats, a guess")
# The largest power of isotonic contractions [W/kg], and the share of the largest speed at which it was reached.
_POWER, _SHARE = 533.0, 0.34


def _curvature() -> float:
    """Hill's relation has its largest power at ``q = sqrt(k^2 + k) - k``."""
    return _SHARE**2 / (1.0 - 2.0 * _SHARE)


DEPRESSOR_MASS = Law(
    "kg",
    "0.1392 m^0.996",
    ("m kg",),
    lambda mass: 0.1392 * mass**0.996,
    f"pectoralis of both sides, fitted to the data of {WRIGHT}",
    (0.57, 1.75),
    "19 of 20 species",
    _BIRDS,
)
ELEVATOR_SHARE = Law(
    "1",
    "0.112 m^0.016",
    ("m kg",),
    lambda mass: 0.0156 * mass**1.012 / DEPRESSOR_MASS(mass),
    f"supracoracoideus, 0.0156 m^1.012, divided by pectoralis; fitted to the data of {WRIGHT}",
    (0.33, 3.0),
    "19 of 20 species",
    _BIRDS,
)
BAT_DEPRESSOR_MASS = Law(
    "kg",
    "0.12 m",
    ("m kg",),
    lambda mass: 0.12 * mass,
    f"guess: three quarters of all flight muscle, which is 9 to 23 % of the mass ({BULLEN})",
    (0.6, 1.5),
    "the ends of that range",
    _BATS,
)
BAT_ELEVATOR_SHARE = Law(
    "1",
    "1/3",
    (),
    lambda: 1 / 3,
    "no law found: a guess; bats raise their wings by several small muscles",
    (0.4, 2.0),
    "guess",
    _BATS,
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
    """Return the numbers of the flight muscle that the laws give an animal, by their paths.

    Parameters
    ----------
    mass : of the whole animal [kg].
    bat : whether it is a bat; else it is a bird.

    >>> {path.rpartition(".")[2]: float(f"{number.value:.3g}") for path, number in muscle_numbers(0.316).items()}
    {'mass': 0.0442, 'elevator_share': 0.11, 'strain_per_angle': 0.15, 'max_strain_rate': 19.5, \
'isometric_stress': 250000.0, 'curvature': 0.361}
    """
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
        "curvature": Number(_curvature(), "1", curvature, (0.15, 0.5)),
    }
    for name in ("strain_per_angle", "max_strain_rate", "isometric_stress", "curvature") if bat else ():
        numbers[name] = numbers[name]._replace(source=f"guess, the number of birds: {numbers[name].source}")
    return {f"vehicle.muscle.{name}": number for name, number in numbers.items()}
