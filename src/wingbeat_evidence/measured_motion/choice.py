"""Which coefficient model and terms suit a motion: a rule of size, Reynolds number, reduced frequency and wing.

The rule never sees a measured force. It follows from what is known of the flow, not from scores:

1. The case names the kind of wing. If it does not, a flyer below 2.5 g whose wings work at Reynolds numbers below
   7000 counts as an insect with rigid wings, any other flyer as a bird with feathered wings.
2. Below a Reynolds number of 10 000 the vortex on the leading edge of a wing that turns about its root stays
   attached, on wings of insects and hummingbirds alike (Usherwood and Ellington 2002, doi
   10.1242/jeb.205.11.1565). The rule takes the polar of a revolving wing, `dickinson`, which includes the induced
   flow.
3. Above this number, the rule takes the model named after the kind of wing (`feathered`, `membrane`). For a rigid
   wing it takes the plate, `su-fan`. In slow flight, below twice the induced speed of hover, a wing moves like a
   revolving wing. The rule then prefers a model of revolving wings of the same kind (`feathered-revolving`),
   because a revolving wing stalls later and its polar includes the induced flow.
4. Above a reduced frequency of 0.1 the flow is unsteady (Leishman 2006, Principles of Helicopter Aerodynamics,
   section 8.2, draws the line between 0.05 and 0.2). The rule adds rotation and added mass, which are terms of
   attached flow, if for nine tenths of the beat, weighted by area, the angle of attack is below the angle of the
   polar's largest lift. Only the motion determines this angle of attack.
5. Changes of lift leave a wake behind. Above a reduced frequency of 0.1 this wake is near enough to reduce the
   changes of lift: by 15 % at a reduced frequency of 0.1, and by 38 % at 0.5 (Theodorsen 1935, NACA Report 496).
   Theodorsen assumes a straight wake that stays behind the flyer, and a wing whose lift rises with its angle of
   attack. So the rule adds the lag of the wake to rotation and added mass if the model states an aspect ratio, as
   models measured in straight flow do, and the speed is at least twice the induced speed of hover. The theory has
   no upper limit of the reduced frequency.
6. The polar of a finite wing includes an induced flow of W/(2 rho A U). Momentum theory gives the same value in
   fast flight and another one in slow flight. In slow flight the rule therefore adds momentum inflow if the model
   states its aspect ratio.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from wingbeat.aero.closed_forms import disc_area
from wingbeat.aero.coefficient_model import CoefficientModel
from wingbeat.aero.wake import ATTACHED_SHARE, is_stalled, largest_lift_angles
from wingbeat_evidence.measured_motion.ladder import THIN_AEROFOIL_WAKE, UNSTEADY_STEPS, Rung
from wingbeat_evidence.measured_motion.strip_case import StripCase
from wingbeat_evidence.measured_motion.strip_motion import StripMotion, semi_span

# Dynamic viscosity of air at 15 to 20 degrees Celsius [kg/(m s)].
_VISCOSITY = 1.8e-5
_INSECT_MASS, _INSECT_REYNOLDS = 2.5e-3, 7e3
_VORTEX_STAYS_BELOW = 1e4
_UNSTEADY_ABOVE = 0.1
_SLOW = 2.0
_REVOLVING, _PLATE = "dickinson", "su-fan"


@dataclass(frozen=True)
class Regime:
    """The numbers and the kind of wing that decide which loads suit a motion.

    Attributes
    ----------
    wing : "feathered", "membrane" or "rigid".
    guessed : whether the kind of wing was guessed.
    speed : mean speed of the quarter chords through the air, without the component along the span, weighted by area
        [m/s].
    chord : mean chord, weighted by area [m].
    reynolds : Reynolds number of that chord at that speed.
    reduced_frequency : ``pi f c / U`` with the same chord and speed.
    slowness : speed of flight over the induced speed of an ideal disc in hover, a ratio.
    """

    wing: str
    guessed: bool
    speed: float
    chord: float
    reynolds: float
    reduced_frequency: float
    slowness: float


def regime_of(case: StripCase, motion: StripMotion) -> Regime:
    """Return the numbers and the kind of wing that decide which loads suit a motion.

    Parameters
    ----------
    case : the measured motion.
    motion : of its strips through still air, from `strip_motion`.
    """
    areas = case.area / case.area.sum(axis=1, keepdims=True)
    speed = float(case.mean((areas * np.hypot(motion.chord_speed, motion.normal_speed)).sum(axis=1)))
    chord = float(case.mean((areas * motion.chord).sum(axis=1)))
    reynolds = case.density * speed * chord / _VISCOSITY
    insect = case.mass < _INSECT_MASS and reynolds < _INSECT_REYNOLDS
    area = float(disc_area(semi_span(case)))
    hover = math.sqrt(case.weight / (2 * case.density * area))
    return Regime(
        wing=case.wing or ("rigid" if insect else "feathered"),
        guessed=case.wing is None,
        speed=speed,
        chord=chord,
        reynolds=reynolds,
        reduced_frequency=math.pi * case.frequency * chord / max(speed, 1e-12),
        slowness=case.speed / hover,
    )


def wanted_model(regime: Regime, names: list[str]) -> str:
    """Return the name of the coefficient model that suits a motion best, of those in the library.

    Parameters
    ----------
    regime : from `regime_of`.
    names : of the models in the library.
    """
    if regime.reynolds < _VORTEX_STAYS_BELOW:
        return _REVOLVING
    slow = [f"{regime.wing}-revolving"] if regime.slowness < _SLOW else []
    return next((name for name in (*slow, regime.wing) if name in names), _PLATE)


def attached_share(case: StripCase, motion: StripMotion, model: CoefficientModel) -> float:
    """Return the share of the compared time in which the angle of attack is below the angle of largest lift.

    The share is weighted by the strips' areas. The angle of attack comes from the motion through still air; the
    measured force is not used.

    Parameters
    ----------
    case : the measured motion.
    motion : of its strips through still air, from `strip_motion`.
    model : its polar determines the angles of largest lift, above and below zero.
    """
    alpha, stall = np.arctan2(-motion.normal_speed, motion.chord_speed), largest_lift_angles(model.kernel())
    areas = case.area / case.area.sum(axis=1, keepdims=True)
    return float(case.mean((areas * ~is_stalled(stall, alpha)).sum(axis=1)))


def model_distance(regime: Regime, model: CoefficientModel, wanted: str) -> tuple[float, float]:
    """Return how far a coefficient model is from the wanted one: by name, then by Reynolds number.

    The first number is 0 for the wanted model and 1 for any other. The second says how many powers of ten the
    Reynolds number lies outside the model's range; it is infinite for a model that states no range.

    Parameters
    ----------
    regime : from `regime_of`.
    model : the coefficient model.
    wanted : name of the coefficient model that suits best.
    """
    return float(model.name != wanted), _distance(model, regime.reynolds)


def wanted_unsteady(regime: Regime, model: CoefficientModel, attached: float) -> str:
    """Return the name of the unsteady terms that suit a motion.

    Parameters
    ----------
    regime : from `regime_of`.
    model : the coefficient model.
    attached : share of the beat with attached flow, from `attached_share`.
    """
    if regime.reduced_frequency <= _UNSTEADY_ABOVE or attached < ATTACHED_SHARE:
        return "none"
    straight = regime.slowness >= _SLOW and model.aspect_ratio is not None
    return THIN_AEROFOIL_WAKE if straight else "thin-aerofoil"


def preference(regime: Regime, rung: Rung, wanted: str, attached: float) -> tuple[float, ...]:
    """Return how much air loads differ from those that suit a motion; the smallest tuple is the best.

    The model counts first, then the unsteady terms, then the inflow.

    Parameters
    ----------
    regime : from `regime_of`.
    rung : the coefficient model and its terms.
    wanted : name of the coefficient model that suits best.
    attached : share of the beat with attached flow, from `attached_share`.
    """
    model = rung.aero.coefficients
    step = UNSTEADY_STEPS.index(wanted_unsteady(regime, model, attached))
    slow = regime.slowness < _SLOW and model.aspect_ratio is not None
    return (
        *model_distance(regime, model, wanted),
        float(abs(UNSTEADY_STEPS.index(rung.unsteady) - step)),
        float((rung.aero.inflow != "none") != slow),
    )


def significant(value: float) -> str:
    """Return a number to two digits, without an exponent.

    >>> significant(12345.6), significant(0.0234)
    ('12000', '0.023')
    """
    if not math.isfinite(value) or value == 0:
        return f"{value:g}"
    rounded = float(f"{value:.1e}")
    digits = 1 - math.floor(math.log10(abs(rounded)))
    return f"{rounded:.{max(digits, 0)}f}"


def _distance(model: CoefficientModel, reynolds: float) -> float:
    """Return how many powers of ten a Reynolds number lies outside of a model's range."""
    if model.reynolds_range is None:
        return math.inf
    low, high = model.reynolds_range
    return max(math.log10(low / max(reynolds, 1e-12)), math.log10(max(reynolds, 1e-12) / high), 0.0)


def reason(regime: Regime, rung: Rung, wanted: str, attached: float) -> str:
    """Return in a few sentences why these air loads are recommended.

    Parameters
    ----------
    regime : from `regime_of`.
    rung : the recommended coefficient model and terms.
    wanted : name of the coefficient model that suits best.
    attached : share of the beat with attached flow, from `attached_share`.
    """
    aero = rung.aero
    kind = f"The wing is {regime.wing}" + (" (guessed from mass and Reynolds number)" if regime.guessed else "")
    numbers = f"the Reynolds number is {significant(regime.reynolds)}"
    numbers += f", and the reduced frequency is {regime.reduced_frequency:.2g}"
    why = "the model of this kind of wing" + (" in slow flight" if wanted.endswith("-revolving") else "")
    if wanted == _PLATE:
        why = "a polar of a plate, because the Reynolds number is above 10000 and no model is named after "
        why += f"{regime.wing} wings"
    elif wanted == _REVOLVING:
        why = "a polar of a revolving wing, because the Reynolds number is below 10000"
    parts = [f"{kind}, {numbers}", f"The rule chooses {wanted}, {why}"]
    if aero.coefficients.name != wanted:
        parts.append(f"This model is not among the rows, and {aero.coefficients.name} is the nearest one")
    parts.append(_unsteady_reason(regime, aero.coefficients, attached))
    if rung.unsteady != wanted_unsteady(regime, aero.coefficients, attached):
        parts.append(f"No row of {aero.coefficients.name} has this choice of unsteady terms")
    slow = regime.slowness < _SLOW
    if aero.coefficients.aspect_ratio is None:
        parts.append("It adds no momentum inflow, because the polar includes induced flow")
    elif aero.inflow != "none":
        slow_inflow = "It adds momentum inflow, because the flight is slow"
        parts.append(slow_inflow if slow else "The row has momentum inflow")
    elif slow:
        parts.append("The row has no momentum inflow")
    else:
        parts.append("It adds no momentum inflow, because the polar includes the induced flow of fast flight")
    return ". ".join(parts) + "."


def _unsteady_reason(regime: Regime, model: CoefficientModel, attached: float) -> str:
    terms = wanted_unsteady(regime, model, attached)
    share = f"the flow is attached for {math.floor(100 * attached)} % of the beat"
    if terms == "none" and regime.reduced_frequency > _UNSTEADY_ABOVE:
        least = f"less than the {100 * ATTACHED_SHARE:g} % that terms of attached flow need"
        return f"It adds no unsteady terms, because {share}, {least}"
    if terms == "none":
        return f"It adds no unsteady terms, because the reduced frequency is at most {_UNSTEADY_ABOVE:g}"
    above = f"because the reduced frequency is above {_UNSTEADY_ABOVE:g}"
    if terms == "thin-aerofoil":
        return f"It adds rotation and added mass, {above} and {share}"
    return f"It adds rotation, added mass and the lag of the wake, {above} and {share}"
