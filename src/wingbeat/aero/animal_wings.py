"""Coefficient models of animals' wings; each number has an interval and a basis, which is a measurement or a guess.

``validation/animal_wings.py`` computes the numbers of `Feathered` from measurements that are not part of this
project. It writes ``docs/evidence/animal_wings.md``, which shows how well the model agrees with measured wings.
"""

from __future__ import annotations

from typing import NamedTuple

from wingbeat._base import FaultList
from wingbeat.aero.cambered import CamberedCoefficients, CamberedTerms
from wingbeat.aero.extension import check_extension


class Estimate(NamedTuple):
    """A term of a coefficient model, with its interval and basis.

    Attributes
    ----------
    value : in degrees if the term's name ends in _deg; otherwise a pure number, slopes and rises per radian.
    low, high : ends of its interval, in the unit of the value.
    basis : the measurement that the value comes from, or the word guess.
    """

    value: float
    low: float
    high: float
    basis: str


_GULL = "nine gull wings; interval: 95 %, bootstrap over wings"
_JACKDAW = "gliding jackdaw; interval: 95 %, bootstrap over flights and wings"
_ASSUMED = "assumed, not fitted: single wings do not determine how sharply the curve bends"

_FEATHERED = {
    "zero_lift_deg": Estimate(-3.01, -7.70, 1.62, _GULL),
    "lift_slope": Estimate(3.90, 3.68, 4.31, _GULL),
    "lift_lowest": Estimate(-0.207, -0.288, -0.104, _GULL),
    "lift_highest": Estimate(1.38, 1.34, 1.41, _GULL),
    "lift_rounding": Estimate(0.15, 0.1, 0.3, _ASSUMED),
    "drag_least": Estimate(0.0137, 0.0069, 0.0165, _JACKDAW),
    "drag_induced": Estimate(0.0468, 0.0453, 0.0489, _JACKDAW),
    "low_onset_deg": Estimate(4.63, 4.33, 6.45, _GULL),
    "low_rise": Estimate(0.546, 0.487, 0.577, _GULL),
    "high_onset_deg": Estimate(19.4, 17.1, 22.7, _GULL),
    "high_rise": Estimate(1.39, 1.00, 2.75, _GULL),
    "onset_rounding_deg": Estimate(2.0, 1.0, 4.0, _ASSUMED),
}
_REVOLVING = _FEATHERED | {
    "lift_slope": Estimate(
        3.28, 3.0, 3.9, "guess: the slope of dickinson, wingbeat's only other model of a revolving wing"
    ),
    "lift_highest": Estimate(
        1.65,
        1.44,
        1.80,
        "gives a pigeon's C_L of 1.64 at 43 degrees; interval: from a card wing in the same study to a fly's wing",
    ),
    "lift_rounding": Estimate(0.25, 0.15, 0.5, "guess"),
    "drag_least": Estimate(
        0.0944, 0.03, 0.13, "gives a pigeon's largest lift-to-drag ratio, 6.3; interval: dried wings of other birds"
    ),
    "drag_induced": Estimate(0.0531, 0.0, 0.0637, "guess: an ideal wing of aspect ratio 6"),
    "high_rise": Estimate(
        1.36,
        0.4,
        3.0,
        "gives C_D of 0.87 at 43 degrees, the geometric mean of 0.49 (from a lift-to-drag ratio of "
        "3.33) and 1.53 (from a force normal to the wing)",
    ),
}
_BEYOND_STALL = "gives C_D of 0.87 at 43 degrees, as feathered-revolving"
_FLAPPING = _FEATHERED | {
    "lift_highest": _REVOLVING["lift_highest"],
    "lift_rounding": _REVOLVING["lift_rounding"],
    "high_rise": Estimate(1.57, 0.75, 3.0, _BEYOND_STALL),
}
_MEMBRANE = (
    _FEATHERED
    | {
        "zero_lift_deg": Estimate(
            -8.9,
            -10.3,
            -7.4,
            "bats' camber, 6.5 to 9 %; the zero-lift angle of a thin arc is -2 times its camber, in radians",
        ),
        "lift_slope": Estimate(
            4.1,
            3.7,
            4.7,
            "thin plate of aspect ratio 2, converted to 6 by lifting line; high end: lifting-line theory alone",
        ),
        "lift_lowest": Estimate(-0.2, -0.75, -0.1, "guess: as feathered"),
        "lift_highest": Estimate(
            1.4, 0.75, 1.8, "guess: a thin plate's largest C_L, 0.75, plus 0.64 that camber adds"
        ),
        "drag_least": Estimate(
            0.039, 0.015, 0.10, "guess: geometric mean of a thin plate's and of su-fan's least drag"
        ),
        "drag_induced": Estimate(
            0.0637, 0.0531, 0.0800, "guess: 1.2 times the value of an ideal wing of aspect ratio 6"
        ),
    }
    | {
        name: _FEATHERED[name]._replace(basis="guess: as feathered")
        for name in (
            "lift_rounding",
            "low_onset_deg",
            "low_rise",
            "high_onset_deg",
            "high_rise",
            "onset_rounding_deg",
        )
    }
)
WING_ESTIMATES: dict[str, dict[str, Estimate]] = {
    "feathered": _FEATHERED,
    "feathered-revolving": _REVOLVING,
    "feathered-flapping": _FLAPPING,
    "membrane": _MEMBRANE,
}


def _terms(name: str, extension: str, blend_width_deg: float) -> CamberedTerms:
    faults = FaultList()
    check_extension(faults, extension, blend_width_deg)
    faults.raise_if_any()
    return CamberedTerms(**{term: estimate.value for term, estimate in WING_ESTIMATES[name].items()})


def Feathered(extension: str = "mirrored", blend_width_deg: float = 1.0) -> CamberedCoefficients:
    """Return a bird's wing of aspect ratio 6: the shape of nine printed gull wings, the drag of a gliding jackdaw.

    Zero lift, slope, both stalls and the drag of separated flow are medians of nine half wings of a gull (wind
    tunnel, -20 to 25 degrees), converted to aspect ratio 6 by Prandtl's lifting line. The least drag and the
    induced drag are those of a live jackdaw's wings. From 25 to 45 and from -20 to -45 degrees, where nothing was
    measured, the curves pass into those of a plate.

    Printed wings: wind-tunnel data of github.com/charvey23/UMWTStaticStability. Jackdaw: KleinHeerenbrink,
    Warfvinge and Hedenstrom 2016, J. Exp. Biol. 219:1572, doi 10.1242/jeb.132480.

    Parameters
    ----------
    extension : any of `EXTENSIONS`; it has no effect, because the model covers all angles.
    blend_width_deg : half width of the blends of the plate [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> import numpy as np
    >>> lift, drag = (curve(np.deg2rad(8.0)) for curve in (Feathered().lift, Feathered().drag))
    >>> round(float(lift), 2), round(float(lift / drag), 1)
    (0.75, 16.9)
    """
    return CamberedCoefficients(
        "feathered",
        _terms("feathered", extension, blend_width_deg),
        low_join_deg=(-45.0, -20.0),
        high_join_deg=(25.0, 45.0),
        citation="fitted to nine gull wings and a jackdaw (KleinHeerenbrink et al. 2016, doi 10.1242/jeb.132480)",
        doi="10.1242/jeb.132480",
        reynolds_range=(4.5e4, 2.1e5),
        blend_width_deg=blend_width_deg,
        aspect_ratio=6.0,
    )


def FeatheredRevolving(extension: str = "mirrored", blend_width_deg: float = 1.0) -> CamberedCoefficients:
    """Return a bird's wing with the delayed stall of revolving pigeon wings, for slow flight and hover.

    Measured: the largest C_L, 1.64 at 43 degrees, and the largest lift-to-drag ratio, 6.3. The drag beyond stall is
    the geometric mean of two sources that disagree by a factor of three. The angle of zero lift and the lower side
    are taken from `Feathered`; the rest is a guess. The coefficients of a revolving wing already contain its
    induced flow, so the model states no aspect ratio.

    Sources for dried pigeon wings: Usherwood 2009 (PMC3380271), and Crandell and Tobalske 2011 (J. Exp. Biol.
    214:1867). Source for the direction of the force on a revolving plate: Usherwood and Ellington 2002.

    Parameters
    ----------
    extension : any of `EXTENSIONS`; it has no effect, because the model covers all angles.
    blend_width_deg : half width of the blends of the plate [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> import numpy as np
    >>> round(float(FeatheredRevolving().lift(np.deg2rad(43.0))), 2)
    1.64
    """
    return CamberedCoefficients(
        "feathered-revolving",
        _terms("feathered-revolving", extension, blend_width_deg),
        low_join_deg=(-45.0, -20.0),
        high_join_deg=(43.0, 65.0),
        citation="revolving pigeon wings, Usherwood 2009 and Crandell and Tobalske 2011; lower side as feathered",
        grade="C",
        reynolds_range=(5e4, 1.08e5),
        blend_width_deg=blend_width_deg,
    )


def FeatheredFlapping(extension: str = "mirrored", blend_width_deg: float = 1.0) -> CamberedCoefficients:
    """Return a bird's wing for a whole beat: attached flow as `Feathered`, stall as late as on revolving wings.

    A wing that flaps or revolves keeps its lift to larger angles of attack than one that glides. This model has the
    zero lift, slope and drag of `Feathered` up to its onset of drag, and the largest C_L of revolving pigeon wings,
    1.64 at 43 degrees. It is meant for slow and fast flight. Two things are guesses: how the two parts join, and
    that a wing which flaps but does not revolve stalls as late as one which revolves. In a glide, use `Feathered`.
    Coefficients of revolving wings contain induced flow, as those of a finite wing do; the model states the aspect
    ratio of `Feathered`, 6.

    The sources are those of `Feathered` and `FeatheredRevolving`: KleinHeerenbrink et al. 2016, doi
    10.1242/jeb.132480; Usherwood 2009 (PMC3380271).

    Parameters
    ----------
    extension : any of `EXTENSIONS`; it has no effect, because the model covers all angles.
    blend_width_deg : half width of the blends of the plate [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> import numpy as np
    >>> alpha = np.deg2rad([8.0, 43.0])
    >>> [round(float(lift), 2) for lift in FeatheredFlapping().lift(alpha)]
    [0.75, 1.64]
    """
    return CamberedCoefficients(
        "feathered-flapping",
        _terms("feathered-flapping", extension, blend_width_deg),
        low_join_deg=(-45.0, -20.0),
        high_join_deg=(43.0, 65.0),
        citation="attached flow as feathered, stall as feathered-revolving",
        doi="10.1242/jeb.132480",
        grade="C",
        reynolds_range=(5e4, 1.08e5),
        blend_width_deg=blend_width_deg,
        aspect_ratio=6.0,
    )


def Membrane(extension: str = "mirrored", blend_width_deg: float = 1.0) -> CamberedCoefficients:
    """Return a bat's wing of aspect ratio 6: a thin plate with the measured camber of bats; the rest is a guess.

    We found no readable polar of a bat's wing. Two things are measured: the lift slope of thin plates, and the
    camber of 12 species, 6.5 to 9 % of the chord. The camber gives the angle of zero lift. `WING_ESTIMATES` marks
    every other number as a guess, with a wide interval. The model ignores that a compliant wing stalls later.

    Sources: Bullen and McKenzie 2007, Aust. J. Zool. 55:237, doi 10.1071/ZO07010; Pelletier and Mueller 2000, J.
    Aircraft 37:825 (read off a figure).

    Parameters
    ----------
    extension : any of `EXTENSIONS`; it has no effect, because the model covers all angles.
    blend_width_deg : half width of the blends of the plate [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> import numpy as np
    >>> round(float(Membrane().lift(np.deg2rad(0.0))), 2)
    0.64
    """
    return CamberedCoefficients(
        "membrane",
        _terms("membrane", extension, blend_width_deg),
        low_join_deg=(-45.0, -20.0),
        high_join_deg=(25.0, 45.0),
        citation="thin plates with the camber of bats (Bullen and McKenzie 2007)",
        doi="10.1071/ZO07010",
        grade="C",
        reynolds_range=(2e4, 1.4e5),
        blend_width_deg=blend_width_deg,
        aspect_ratio=6.0,
    )
