"""Published laws that give a flying animal's numbers from its mass, wing span and wing area.

Where we found no law, we scale one animal or robot by isometry, or guess; the source says which. Each law names the
data it was fitted to. If an animal is outside the range of these data, the number's source says so and the species
warns.
"""

from __future__ import annotations

import math

from wingbeat.animal.species.numbers import HARVEY, Data, Law, Number

RAYNER = "van den Berg and Rayner 1995, J Exp Biol 198:1655, doi 10.1242/jeb.198.8.1655, table 3"
PENNYCUICK = "Pennycuick 1996, J Exp Biol 199:1613, doi 10.1242/jeb.199.7.1613"
BULLEN = "Bullen and McKenzie 2002, J Exp Biol 205:2615, doi 10.1242/jeb.205.17.2615"
FLAPPER = (
    "parameters of the Flapper Nimble+ in federicoangioni/flapper-dynamic-model; "
    "the source does not say how they were determined"
)


# --- what the laws were fitted to ---

# Of the table that `BIRD_MASS` was fitted to; rows marked as outliers left out.
_BIRD_TABLE = Data({"b": (0.087, 3.25)}, "689 species of that table")
# The table of van den Berg and Rayner themselves was not read.
_RAYNER_BIRDS = Data(
    {"m": (0.01, 10.0), "l": (0.085, 1.31)}, "29 birds; the ranges are the axes of figures 5 and 6"
)
_RAYNER_WINGS = Data(
    {"m_w": (4.5e-4, 0.885), "l": (0.085, 1.31)},
    "29 birds of 0.01 to 10 kg; the ranges follow from the same paper's laws",
)
_PENNYCUICK_BIRDS = Data({"m": (0.0054, 11.9), "b": (0.154, 3.04)}, "219 birds that Pennycuick measured")
_BATS = "65 species whose frequency is known: Norberg and Norberg 2012, J Exp Biol 215:711, abstract"
_BATS_MASSES, _BATS_AREAS = (0.002, 0.87), (0.0028, 0.16)
_NO_DATA = Data({}, "none: not fitted to anything")


def _one(whose: str, mass: float) -> Data:
    """Return the range in which one animal may be scaled by isometry; a guess: a third to 3 times its length."""
    return Data(
        {"m": (mass / 27, mass * 27)}, f"one {whose} of {mass:g} kg; a guess: a third to 3 times its length"
    )


# --- lengths ---

BIRD_MASS = Law(
    "kg",
    "(b / 1.137)^(1/0.396)",
    ("b m",),
    lambda span: (span / 1.137) ** (1 / 0.396),
    "fitted to a table of mass, span and area compiled from 27 studies, BirdWingData_tidy_ver2.1",
    (0.23, 3.8),
    "all of 613 bird species in that table",
    _BIRD_TABLE,
)
BIRD_SEMI_SPAN = Law(
    "m",
    "0.464 b",
    ("b m",),
    lambda span: 0.464 * span,
    f"wing length 0.528 m^0.396 ({RAYNER}) over span 1.137 m^0.396 of the birds of BirdWingData_tidy_ver2.1",
    (0.95, 1.08),
    f"0.45 of the span of one dissected pigeon ({HARVEY}) to half the span",
    _BIRD_TABLE,
)
HALF_SPAN = Law(
    "m",
    "b/2",
    ("b m",),
    lambda span: 0.5 * span,
    "no law found: as Su et al., arXiv 2302.09602, take it for their bat",
    (0.9, 1.0),
    "guess: the body between the wings is left out",
    _NO_DATA,
)
MEAN_CHORD = Law(
    "m",
    "S/b",
    ("b m", "S m2"),
    lambda span, area: area / span,
    "its definition",
    (0.85, 1.1),
    "guess: some count the body between the wings to the area and some do not",
    _NO_DATA,
)

# Span over mean chord: the range of a whole table of birds, or a guess.
BIRD_ASPECT_RATIO = (3.6, 16.6), "all of 613 bird species in BirdWingData_tidy_ver2.1"
BAT_ASPECT_RATIO = (4.0, 12.0), "a guess around the 6 of the built-in bat and the 7 to 9 of 24 noctules"
ROBOT_ASPECT_RATIO = (2.5, 10.0), "a guess around the 3.4 to 7.0 of four robots"

# --- masses and moments of inertia ---

BIRD_WING_MASS = Law(
    "kg",
    "0.0706 m^1.098",
    ("m kg",),
    lambda mass: 0.0706 * mass**1.098,
    RAYNER,
    (0.6, 1.6),
    f"guess: r2 is 0.972 in log-log, and one dissected pigeon lies at 1.5 ({HARVEY})",
    _RAYNER_BIRDS,
)
BAT_WING_MASS = Law(
    "kg",
    "0.07 m",
    ("m kg",),
    lambda mass: 0.07 * mass,
    "no law found: a guess",
    (0.77, 1.43),
    f"guess: 5.4 % is the law of birds at 68 g ({RAYNER}), 10 % a guess",
    _NO_DATA,
)
ROBOT_WING_MASS = Law(
    "kg",
    "0.042 m",
    ("m kg",),
    lambda mass: 0.5 * (0.103 - 0.0943) / 0.103 * mass,
    f"no law found: one robot that weighs 103 g with and 94.3 g without its wings; {FLAPPER}",
    (0.4, 2.5),
    "guess",
    _one("robot", 0.103),
)
BIRD_FLAP_INERTIA = Law(
    "kg m2",
    "0.118 (m_w l^2)^1.040",
    ("m_w kg", "l m"),
    lambda wing_mass, length: 0.118 * (wing_mass * length**2) ** 1.040,
    RAYNER,
    (0.45, 1.6),
    f"the birds of its figure 6 lie at 0.6 to 1.6, one dissected pigeon at 0.5 ({HARVEY})",
    _RAYNER_WINGS,
)
BAT_FLAP_INERTIA = Law(
    "kg m2",
    "twice the birds' 0.118 (m_w l^2)^1.040",
    ("m_w kg", "l m"),
    lambda wing_mass, length: 2 * BIRD_FLAP_INERTIA(wing_mass, length),
    f"{RAYNER} and text: bats have twice the inertia",
    (0.5, 1.3),
    "the law of birds to the highest of the three bats of its figure 6",
    _RAYNER_WINGS,
)
ROBOT_MASS_EXPONENT = Law(
    "1",
    "1.1, a wing whose centre of mass is at 0.32 of its length",
    (),
    lambda: 1 / 0.32 - 2,
    "no law found: the centre of mass of one robot's wing, 0.08 m from the root of a 0.25 m wing, "
    "read in the code of Fan, Gehrke and Breuer, arXiv 2408.15577",
    (0.0, 2.0),
    "guess: from a uniform wing to one like a bird's",
    _NO_DATA,
)
BIRD_PITCH_INERTIA = Law(
    "kg m2",
    "2.6e-4 (m / 0.26)^(5/3)",
    ("m kg",),
    lambda mass: 2.6e-4 * (mass / 0.26) ** (5 / 3),
    f"no law found: one dissected pigeon of 0.26 kg, {HARVEY}, scaled by isometry",
    (0.5, 2.0),
    "guess",
    _one("pigeon", 0.26),
)
BAT_PITCH_INERTIA = Law(
    "kg m2",
    "2.4e-5 (m / 0.068)^(5/3)",
    ("m kg",),
    lambda mass: 2.4e-5 * (mass / 0.068) ** (5 / 3),
    "no law found: an ellipsoid 82 mm long for a bat of 68 g, scaled by isometry",
    (0.5, 2.1),
    "guess",
    _one("bat", 0.068),
)
ROBOT_PITCH_INERTIA = Law(
    "kg m2",
    "3.0e-4 (m / 0.103)^(5/3)",
    ("m kg",),
    lambda mass: 3.0e-4 * (mass / 0.103) ** (5 / 3),
    f"no law found: one robot of 103 g, scaled by isometry; {FLAPPER}",
    (0.33, 3.0),
    "guess",
    _one("robot", 0.103),
)
BODY_DRAG_AREA = Law(
    "m2",
    "drag coefficient 0.2 (Klein Heerenbrink 2016, jackdaw, doi 10.1242/jeb.132480) times 0.00813 m^0.666",
    ("m kg",),
    lambda mass: 0.2 * 0.00813 * mass**0.666,
    "Pennycuick 1988, birds, as in the R package afpt",
    (0.5, 1.5),
    "guess: drag coefficients of 0.1 to 0.3 are in use",
    Data({}, "not read"),
)
BODY_HALF_WIDTH = Law(
    "m",
    "(0.00813 m^0.666 / pi)^(1/2), the radius of a circle of the body's frontal area",
    ("m kg",),
    lambda mass: math.sqrt(0.00813 * mass**0.666 / math.pi),
    "Pennycuick 1988, birds, as in the R package afpt",
    (0.5, 1.5),
    "guess",
    Data({}, "not read"),
)

# --- the wingbeat ---

FREQUENCY_BY_MASS = Law(
    "Hz",
    "3.228 m^-0.440",
    ("m kg",),
    lambda mass: 3.228 * mass**-0.440,
    RAYNER,
    (0.5, 2.0),
    "guess: r2 is 0.653 in log-log",
    _RAYNER_BIRDS,
)
FREQUENCY_BY_WING = Law(
    "Hz",
    "1.807 l^-1.055",
    ("l m",),
    lambda length: 1.807 * length**-1.055,
    RAYNER,
    (0.6, 1.6),
    "guess: r2 is 0.877 in log-log",
    _RAYNER_BIRDS,
)


_SIZE_AND_AIR = "m kg", "b m", "S m2", "rho kg/m3", "g m/s2"


def _pennycuick(mass: float, span: float, area: float, density: float, gravity: float) -> float:
    return mass ** (3 / 8) * gravity**0.5 * span ** (-23 / 24) * area ** (-1 / 3) * density ** (-3 / 8)


def _bullen(mass: float, speed: float) -> float:
    """Return a bat's frequency. Outside the law's masses, a power of mass: the law fails from 10 kg up."""
    inside = min(max(mass, _BATS_MASSES[0]), _BATS_MASSES[1])
    fitted = 5.54 - 3.068 * math.log10(inside) - 2.857 * math.log10(speed)
    return fitted * (mass / inside) ** -0.26


BIRD_FREQUENCY = Law(
    "Hz",
    "m^3/8 g^1/2 b^-23/24 S^-1/3 rho^-3/8",
    _SIZE_AND_AIR,
    _pennycuick,
    f"{PENNYCUICK}, 47 species in cruise",
    (0.7, 1.3),
    "alcids and a pigeon lie at 0.73 to 1.04, 14 species at 0.81 to 1.05 (Pennycuick 2001, J Exp Biol 204:3283)",
    _PENNYCUICK_BIRDS,
)
ROBOT_FREQUENCY = Law(
    "Hz",
    "m^3/8 g^1/2 b^-23/24 S^-1/3 rho^-3/8",
    _SIZE_AND_AIR,
    _pennycuick,
    f"no law of robots found: that of birds, {PENNYCUICK}",
    (0.7, 1.3),
    "four robots lie at 0.80 to 1.16 times the law "
    "(USTButterfly, USTButterfly-II, AirPulse and one of Zhang et al.; low trust)",
    _PENNYCUICK_BIRDS,
)
BAT_FREQUENCY = Law(
    "Hz",
    "5.54 - 3.068 log10 m - 2.857 log10 V",
    ("m kg", "V m/s"),
    _bullen,
    f"{BULLEN}, abstract: 23 Australian species",
    (0.75, 1.3),
    "room for 1 Hz more or less, as for 21 of the 23 species, and for speeds from 4 to 10 m/s",
    Data({"m": _BATS_MASSES}, _BATS),
    "it goes on from the nearest end of the data as m^-0.26, the exponent of those species",
)
BIRD_FLAP_AMPLITUDE = Law(
    "rad",
    "half of 67 b^-0.24 degrees",
    ("b m",),
    lambda span: math.radians(33.5 * span**-0.24),
    "Nudds, Taylor and Thomas 2004, as quoted in code",
    (0.5, 1.6),
    "guess",
    Data({}, "60 species of birds, whose spans were not read"),
)
BAT_FLAP_AMPLITUDE = Law(
    "rad",
    "half of 56.92 + 5.18 V + 16.06 log10 S degrees",
    ("V m/s", "S m2"),
    lambda speed, area: math.radians(0.5 * (56.92 + 5.18 * speed + 16.06 * math.log10(area))),
    f"{BULLEN}, abstract: 23 Australian species",
    (0.6, 1.6),
    "15 degrees either side of the whole, and speeds from 4 to 10 m/s",
    Data({"S": _BATS_AREAS}, "bats of 2 to 870 g with the shape of 24 noctules"),
)
ROBOT_FLAP_AMPLITUDE = Law(
    "rad",
    "half of 81 degrees",
    (),
    lambda: math.radians(0.5 * (80 + 105 + 50 + 90) / 4),
    "no law found: the mean of USTButterfly, USTButterfly-II, AirPulse and one of Zhang et al.; low trust",
    (0.6, 1.35),
    "those four robots have 50 to 105 degrees",
    _NO_DATA,
)

# --- the cruise ---

CRUISE_BY_MASS = Law(
    "m/s",
    "15.9 m^0.13",
    ("m kg",),
    lambda mass: 15.9 * mass**0.13,
    "Alerstam et al. 2007, PLoS Biol 5:e197, doi 10.1371/journal.pbio.0050197, 138 species",
    (0.6, 1.6),
    "guess",
    Data({"m": (0.01, 10.0)}, "138 species, abstract"),
)


def exponent_of_inertia(share: float) -> float:
    """Return the p of strip masses ``(1 - s/L)**p`` that gives a flap inertia; 0, a uniform wing, if none does.

    The share is the inertia about the shoulder, divided by wing mass times length squared: ``2/((p + 2) (p + 3))``.

    >>> exponent_of_inertia(1 / 3), round(exponent_of_inertia(0.1), 9)
    (0.0, 2.0)
    """
    return max(0.0, 0.5 * (math.sqrt(1 + 8 / share) - 5))


def mass_exponent(law: Law, wing_mass: float, length: float) -> Number:
    """Return the mass exponent for which a wing of this mass [kg] and length [m] has the flap inertia of a law."""
    inertia, whole = law(wing_mass, length), wing_mass * length**2
    low, high = law.spread
    source = (
        f"derived: gives the wing the flap inertia {inertia:.3g} kg m2, {law.formula} at m_w = {wing_mass:.4g} kg, "
        f"l = {length:.4g} m ({law.source}); "
        f"spread {low:g} to {high:g} times the inertia: {law.scatter}{law.outside(wing_mass, length)}"
    )
    limits = exponent_of_inertia(high * inertia / whole), exponent_of_inertia(low * inertia / whole)
    return Number(exponent_of_inertia(inertia / whole), "1", source, limits)
