"""The terms of animals' wings: each number has an interval and a basis, which is a measurement or a guess.

``validation/animal_wings.py`` computes the numbers of `Feathered` from measurements that are not part of this
project. It writes ``docs/evidence/animal_wings.md``, which shows how well the model agrees with measured wings.
"""

from __future__ import annotations

from typing import NamedTuple


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
