"""The coefficient models that a user can choose by name: one table of their numbers and sources.

Angles a of published formulas are in degrees. Models of grade B are cited second-hand: their constants come from
other people's code and papers. The terms of animals' wings are in ``wing_estimates.csv``.
``validation/animal_wings.py`` computes those of `Feathered` from measurements that are not part of this project. It
writes ``docs/evidence/animal_wings.md``, which shows how well the model agrees with measured wings.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wingbeat._base import FaultList
from wingbeat.aero.extension import check_extension
from wingbeat.aero.formula_models import PLATE, CamberedCoefficients, FormulaCoefficients
from wingbeat.aero.formula_terms import CamberedTerms, FormulaTerms

T = TypeVar("T", FormulaCoefficients, CamberedCoefficients)


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


WING_ESTIMATES: dict[str, dict[str, Estimate]] = {}
with Path(__file__).with_name("wing_estimates.csv").open(encoding="utf-8", newline="") as _file:
    for _model, _term, _value, _low, _high, _basis in list(csv.reader(_file))[1:]:
        WING_ESTIMATES.setdefault(_model, {})[_term] = Estimate(float(_value), float(_low), float(_high), _basis)


def _sine_cosine(name: str, lift: float, mean: float, swing: float, **about: Any) -> FormulaCoefficients:
    """Return the model ``C_L = lift sin 2a``, ``C_D = mean - swing cos 2a``, valid at every angle.

    Theory: equation ``sine-cosine``.
    """
    lift_terms = FormulaTerms(constant=0.0, amplitude=lift, rate=2.0, phase_deg=0.0)
    drag_terms = FormulaTerms(constant=mean, amplitude=swing, rate=2.0, phase_deg=-90.0)
    return FormulaCoefficients(name, lift_terms, drag_terms, grade="B", **about)


def _cambered(
    name: str, citation: str, reynolds: tuple[float, float], high_join_deg: tuple[float, float], **about: Any
) -> CamberedCoefficients:
    """Return the model with the values of `WING_ESTIMATES`."""
    terms = CamberedTerms(**{term: estimate.value for term, estimate in WING_ESTIMATES[name].items()})
    joins = {"low_join_deg": (-45.0, -20.0), "high_join_deg": high_join_deg}
    return CamberedCoefficients(name, terms, **joins, citation=citation, reynolds_range=reynolds, **about)


_DICKINSON = FormulaCoefficients(
    "dickinson",
    lift_terms=FormulaTerms(0.225, 1.58, 2.13, -7.2),
    # -cos(x) is sin(x - 90 degrees).
    drag_terms=FormulaTerms(1.92, 1.55, 2.04, -9.82 - 90.0),
    citation="Dickinson, Lehmann and Sane 1999, Science 284:1954",
    doi="10.1126/science.284.5422.1954",
    reynolds_range=(1e2, 2e2),
    alpha_range_deg=(-9.0, 90.0),
)
_WANG = _sine_cosine(
    "wang",
    1.2,
    1.4,
    1.0,
    citation="Wang, Birch and Dickinson 2004",
    reynolds_range=(1e2, 1e3),
    aspect_ratio=math.inf,
)
_WHITNEY_WOOD = _sine_cosine(
    "whitney-wood", 1.8, 1.9, 1.5, citation="Whitney and Wood 2010", reynolds_range=(1e2, 1e2)
)
_PARSLEW_CROWTHER = _sine_cosine(
    "parslew-crowther", 1.64, 1.135, 1.05, citation="Parslew and Crowther 2010, J. Biomech. 43:3191"
)
_BYL = _sine_cosine("byl", 1.8, 1.8, 1.8, citation="Byl 2010")
_FEATHERED = _cambered(
    "feathered",
    "fitted to nine gull wings and a jackdaw (KleinHeerenbrink et al. 2016, doi 10.1242/jeb.132480)",
    (4.5e4, 2.1e5),
    (25.0, 45.0),
    doi="10.1242/jeb.132480",
    aspect_ratio=6.0,
)
_FEATHERED_REVOLVING = _cambered(
    "feathered-revolving",
    "revolving pigeon wings, Usherwood 2009 and Crandell and Tobalske 2011; lower side as feathered",
    (5e4, 1.08e5),
    (43.0, 65.0),
    grade="C",
)
_FEATHERED_FLAPPING = _cambered(
    "feathered-flapping",
    "attached flow as feathered, stall as feathered-revolving",
    (5e4, 1.08e5),
    (43.0, 65.0),
    doi="10.1242/jeb.132480",
    grade="C",
    aspect_ratio=6.0,
)
_MEMBRANE = _cambered(
    "membrane",
    "thin plates with the camber of bats (Bullen and McKenzie 2007)",
    (2e4, 1.4e5),
    (25.0, 45.0),
    doi="10.1071/ZO07010",
    grade="C",
    aspect_ratio=6.0,
)


def _chosen(model: T, extension: str, blend_width_deg: float) -> T:
    """Return a model with another extension and blend width; cambered wings cover all angles as they are."""
    faults = FaultList()
    check_extension(faults, extension, blend_width_deg)
    faults.raise_if_any()
    if isinstance(model, CamberedCoefficients):
        return replace(model, blend_width_deg=blend_width_deg)
    return replace(model, extension=extension, blend_width_deg=blend_width_deg)


def SuFan(extension: str = "mirrored", blend_width_deg: float = 1.0) -> FormulaCoefficients:
    """Return the fit of Su et al. to a flat plate of aspect ratio 6 at Reynolds numbers of 20 000 to 50 000.

    ``C_L = -0.44 exp(-0.47 a) + 1.19 sin(1.74 a + 20)``, ``C_D = 1.04 + sin(1.72 a - 70)``,
    ``x_cp = 0.247 + 0.016 a^0.6 + 0.026 a exp(-0.11 a)``; measured from 0 to 110 degrees on a plate of 76 mm chord
    and 8 mm thickness, whose blunt edges cause C_D(0) = 0.10. The formula's C_L(0) is -0.033; the blend at 0
    degrees removes this. Beyond 90 degrees the extension applies: mirrored, C_L is -0.42 at 100 degrees, where the
    formula gives -0.29.

    Su, Fan, Onoue, Vejdani and Breuer 2023, doi 10.48550/arXiv.2302.09602.

    Theory: equation ``su-fan``.

    Parameters
    ----------
    extension : how the formulas are extended to all angles: mirrored, signed-drag, signed or clipped-drag.
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> float(round(SuFan().lift(np.deg2rad(40.0)), 4))
    1.19
    """
    return _chosen(PLATE, extension, blend_width_deg)


def Dickinson(extension: str = "mirrored", blend_width_deg: float = 1.0) -> FormulaCoefficients:
    """Return the fit of Dickinson et al. to a revolving model fly wing at Reynolds numbers of 100 to 200.

    ``C_L = 0.225 + 1.58 sin(2.13 a - 7.2)``, ``C_D = 1.92 - 1.55 cos(2.04 a - 9.82)``; about -9 to 90 deg.

    Dickinson, Lehmann and Sane 1999, Science 284:1954, doi 10.1126/science.284.5422.1954.

    Theory: equation ``dickinson``.

    Parameters
    ----------
    extension : how the formulas are extended to all angles: mirrored, signed-drag, signed or clipped-drag.
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> float(round(Dickinson().drag(np.deg2rad(40.0)), 4))
    1.4354
    """
    return _chosen(_DICKINSON, extension, blend_width_deg)


def Wang2004(extension: str = "mirrored", blend_width_deg: float = 1.0) -> FormulaCoefficients:
    """Return ``C_L = 1.2 sin 2a``, ``C_D = 1.4 - 1.0 cos 2a`` (Wang, Birch and Dickinson 2004), second-hand.

    From two-dimensional computations at Reynolds numbers near 100; used for falling cards near 1000.

    Parameters
    ----------
    extension : how the formulas are extended to all angles: mirrored, signed-drag, signed or clipped-drag.
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> float(round(Wang2004().lift(np.deg2rad(45.0)), 6))
    1.2
    """
    return _chosen(_WANG, extension, blend_width_deg)


def WhitneyWood(extension: str = "mirrored", blend_width_deg: float = 1.0) -> FormulaCoefficients:
    """Return ``C_L = 1.8 sin 2a``, ``C_D = 1.9 - 1.5 cos 2a`` (Whitney and Wood 2010), second-hand.

    For robots of the size of insects at Reynolds numbers near 100.

    Parameters
    ----------
    extension : how the formulas are extended to all angles: mirrored, signed-drag, signed or clipped-drag.
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> float(round(WhitneyWood().drag(np.deg2rad(45.0)), 6))
    1.9
    """
    return _chosen(_WHITNEY_WOOD, extension, blend_width_deg)


def ParslewCrowther(extension: str = "mirrored", blend_width_deg: float = 1.0) -> FormulaCoefficients:
    """Return ``C_L = 1.64 sin 2a``, ``C_D = 1.135 - 1.05 cos 2a`` (Parslew and Crowther 2010), second-hand.

    Meant for bird wings.

    Parameters
    ----------
    extension : how the formulas are extended to all angles: mirrored, signed-drag, signed or clipped-drag.
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> float(round(ParslewCrowther().lift(np.deg2rad(45.0)), 6))
    1.64
    """
    return _chosen(_PARSLEW_CROWTHER, extension, blend_width_deg)


def Byl(extension: str = "mirrored", blend_width_deg: float = 1.0) -> FormulaCoefficients:
    """Return ``C_L = 1.8 sin 2a``, ``C_D = 1.8 (1 - cos 2a)`` (Byl 2010), second-hand.

    Drag vanishes at 0 degrees.

    Parameters
    ----------
    extension : how the formulas are extended to all angles: mirrored, signed-drag, signed or clipped-drag.
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

    Raises
    ------
    InvalidInputError : an unknown extension, a width outside (0, 3].

    >>> float(round(Byl().drag(np.deg2rad(45.0)), 6))
    1.8
    """
    return _chosen(_BYL, extension, blend_width_deg)


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
    return _chosen(_FEATHERED, extension, blend_width_deg)


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
    return _chosen(_FEATHERED_REVOLVING, extension, blend_width_deg)


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
    return _chosen(_FEATHERED_FLAPPING, extension, blend_width_deg)


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
    return _chosen(_MEMBRANE, extension, blend_width_deg)


LIBRARY: dict[str, Callable[..., FormulaCoefficients | CamberedCoefficients]] = {
    "su-fan": SuFan,
    "dickinson": Dickinson,
    "wang": Wang2004,
    "whitney-wood": WhitneyWood,
    "parslew-crowther": ParslewCrowther,
    "byl": Byl,
    "feathered": Feathered,
    "feathered-revolving": FeatheredRevolving,
    "feathered-flapping": FeatheredFlapping,
    "membrane": Membrane,
}


def thin_aerofoil_lift(alpha: ArrayLike) -> NDArray[np.float64]:
    """Return C_L of a thin aerofoil, ``2 pi alpha``, for comparison.

    Parameters
    ----------
    alpha : angle of attack [rad], any shape.

    >>> float(round(thin_aerofoil_lift(0.1), 4))
    0.6283
    """
    return 2 * np.pi * np.asarray(alpha, dtype=np.float64)


def thin_aerofoil_moment(alpha: ArrayLike) -> NDArray[np.float64]:
    """Return C_M of a thin aerofoil about mid-chord, ``pi/2 alpha``.

    Parameters
    ----------
    alpha : angle of attack [rad], any shape.

    >>> float(round(thin_aerofoil_moment(0.1), 4))
    0.1571
    """
    return 0.5 * np.pi * np.asarray(alpha, dtype=np.float64)


def ellington_normal_drag(reynolds: ArrayLike) -> NDArray[np.float64]:
    """Return C_D of a plate square to the flow, ``1.95 + 50/Re`` (Ellington 1991, cited by Su et al. 2023).

    Parameters
    ----------
    reynolds : Reynolds number, any shape.

    >>> float(round(ellington_normal_drag(5e4), 6))
    1.951
    """
    return 1.95 + 50.0 / np.asarray(reynolds, dtype=np.float64)
