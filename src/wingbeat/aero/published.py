"""Published coefficient models, and theoretical lines to compare them with.

Angles a are in degrees as published. Grade B models are cited second-hand: their constants come from other
people's code and papers, not from the source.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from wingbeat.aero.formula import CentreTerms, FormulaCoefficients, FormulaTerms


def _sine_cosine(name: str, lift: float, mean: float, swing: float, **about: Any) -> FormulaCoefficients:
    """Return the model ``C_L = lift sin 2a``, ``C_D = mean - swing cos 2a``, valid at every angle.

    Theory: equation ``sine-cosine``.
    """
    lift_terms = FormulaTerms(constant=0.0, amplitude=lift, rate=2.0, phase_deg=0.0)
    drag_terms = FormulaTerms(constant=mean, amplitude=swing, rate=2.0, phase_deg=-90.0)
    return FormulaCoefficients(name, lift_terms, drag_terms, grade="B", **about)


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
    return FormulaCoefficients(
        "su-fan",
        lift_terms=FormulaTerms(0.0, 1.19, 1.74, 20.0, decay_amplitude=-0.44, decay_rate=0.47),
        drag_terms=FormulaTerms(1.04, 1.0, 1.72, -70.0),
        centre_terms=CentreTerms(0.247, 0.016, 0.6, 0.026, 0.11),
        citation="Su, Fan, Onoue, Vejdani and Breuer 2023, arXiv 2302.09602",
        doi="10.48550/arXiv.2302.09602",
        reynolds_range=(2e4, 5e4),
        aspect_ratio=6.0,
        alpha_range_deg=(0.0, 110.0),
        extension=extension,
        blend_width_deg=blend_width_deg,
    )


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
    return FormulaCoefficients(
        "dickinson",
        lift_terms=FormulaTerms(0.225, 1.58, 2.13, -7.2),
        # -cos(x) is sin(x - 90 degrees).
        drag_terms=FormulaTerms(1.92, 1.55, 2.04, -9.82 - 90.0),
        citation="Dickinson, Lehmann and Sane 1999, Science 284:1954",
        doi="10.1126/science.284.5422.1954",
        reynolds_range=(1e2, 2e2),
        alpha_range_deg=(-9.0, 90.0),
        extension=extension,
        blend_width_deg=blend_width_deg,
    )


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
    return _sine_cosine(
        "wang",
        1.2,
        1.4,
        1.0,
        citation="Wang, Birch and Dickinson 2004",
        reynolds_range=(1e2, 1e3),
        aspect_ratio=math.inf,
        extension=extension,
        blend_width_deg=blend_width_deg,
    )


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
    return _sine_cosine(
        "whitney-wood",
        1.8,
        1.9,
        1.5,
        citation="Whitney and Wood 2010",
        reynolds_range=(1e2, 1e2),
        extension=extension,
        blend_width_deg=blend_width_deg,
    )


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
    return _sine_cosine(
        "parslew-crowther",
        1.64,
        1.135,
        1.05,
        citation="Parslew and Crowther 2010, J. Biomech. 43:3191",
        extension=extension,
        blend_width_deg=blend_width_deg,
    )


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
    return _sine_cosine(
        "byl", 1.8, 1.8, 1.8, citation="Byl 2010", extension=extension, blend_width_deg=blend_width_deg
    )


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
