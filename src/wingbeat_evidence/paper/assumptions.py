"""Assumptions where the paper is silent: what is sampled, in what range, and what a set changes in an animal."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat.aero import AIRSPEEDS, EXTENSIONS, FORCE_POINTS
from wingbeat.animal.species.species import Species

# Parameters that the paper calls free, and the mean angles: it does not say whether they are free.
_FREE = ("frequency", "flap_amplitude", "pitch_amplitude")
_MEANS = ("flap-mean", "pitch-mean")
TRIMS = ("both", "pitch-mean", "flap-mean", "none")


@dataclass(frozen=True)
class Assumption:
    """One thing that the paper leaves open: a range of numbers, or a choice among words.

    Parameters
    ----------
    name : as in tables.
    words : what it is, with its unit.
    source : why this range.
    low, high : the range; ignored if there are choices.
    choices : words to choose from; empty for a number.
    """

    name: str
    words: str
    source: str
    low: float = 0.0
    high: float = 1.0
    choices: tuple[str, ...] = ()

    def at(self, share: float) -> float | str:
        """Return the value at a share of the range, 0 to 1."""
        if self.choices:
            return self.choices[min(int(share * len(self.choices)), len(self.choices) - 1)]
        return self.low + share * (self.high - self.low)


_UNSAID = "the paper does not say"
# The assumption that applies to one of the animals only.
_OWN = {"pigeon": "span_retraction", "bat": "twist_ratio"}

ASSUMPTIONS = (
    Assumption(
        "wing_mass_share",
        "mass of one wing divided by that of the animal",
        "pigeons 6.3 % (van den Berg and Rayner 1995) to 9.6 % (Harvey et al. 2022), bats 5.4 to 7 %",
        0.05,
        0.10,
    ),
    Assumption(
        "mass_exponent",
        "exponent p in the wing's mass per unit span, proportional to (1 - s/L)^p at a distance s along a wing of "
        "length L",
        "0 is uniform; 2 matches van den Berg and Rayner 1995, and 4 matches Harvey et al. 2022",
        0.0,
        4.0,
    ),
    Assumption(
        "taper", "tip chord divided by root chord, at the same area", "1 is the paper's rectangle", 0.3, 1.0
    ),
    Assumption(
        "body_inertia_factor",
        "pitch inertia of the body divided by that of the species file",
        "first guesses and a scaled dissection differ by a factor of 1.7",
        0.6,
        1.7,
    ),
    Assumption(
        "shoulder_ahead",
        "distance of the shoulder ahead of the body's centre of mass, divided by semi-span",
        "0 in the species files; 0.13 in the pigeon of Harvey et al. 2022",
        0.0,
        0.13,
    ),
    Assumption(
        "shoulder_above",
        "distance of the shoulder above the body's centre of mass, divided by semi-span",
        "0 in the species files; 0.03 in the pigeon of Harvey et al. 2022",
        0.0,
        0.04,
    ),
    Assumption(
        "shoulder_aside",
        "distance of the shoulder from the plane of symmetry, divided by semi-span",
        "0.10 in the pigeon of Harvey et al. 2022",
        0.0,
        0.10,
    ),
    Assumption(
        "span_retraction",
        "share of the pigeon's span that is retracted at mid-upstroke",
        "the paper gives no number",
        0.0,
        0.5,
    ),
    Assumption(
        "twist_ratio",
        "pitch angle of the bat's wing at the tip divided by that at the root",
        "1.6 in the paper",
        1.3,
        1.9,
    ),
    Assumption(
        "flap_amplitude_deg",
        "largest flap amplitude allowed [deg]",
        "half of the bats' stroke angles in Bullen and McKenzie 2002: 90 deg at 10 m/s, 140 deg at most",
        40.0,
        70.0,
    ),
    Assumption(
        "trims",
        "mean angles that are free",
        "the paper mentions neither mean angle",
        choices=TRIMS,
    ),
    Assumption(
        "flap_mean_deg",
        "largest mean flap angle allowed, up or down, if this angle is free [deg]",
        "no bound in the paper; the species files allow 30",
        0.0,
        30.0,
    ),
    Assumption(
        "pitch_phase_deg",
        "phase lead of pitch over flap, beyond a quarter of a wingbeat [deg]",
        "no phase in the paper; at 0 the wing pitches fastest where its flapping reverses; 30 is a guess",
        -30.0,
        30.0,
    ),
    Assumption("extension_su_fan", "Su-Fan's coefficients at negative angles", _UNSAID, choices=EXTENSIONS),
    Assumption("extension_dickinson", "Dickinson's coefficients at negative angles", _UNSAID, choices=EXTENSIONS),
    Assumption(
        "airspeed",
        "components of the airspeed that determine a strip's loads: across the span (planar), or all (full)",
        "the paper says 'airspeed at each segment'; strip theory uses the component across the span",
        choices=AIRSPEEDS,
    ),
    Assumption(
        "force_point",
        "where Su-Fan's force acts (Dickinson's model has no centre of pressure)",
        "the paper uses the quarter chord, although it also fits a centre of pressure",
        choices=FORCE_POINTS,
    ),
    Assumption(
        "body_drag_factor",
        "drag area of the body divided by 0.2 times Pennycuick's frontal area",
        "the paper gives no body drag",
        0.0,
        1.0,
    ),
)

Values = dict[str, float | str]


def sample_sets(count: int, seed: int = 0) -> list[Values]:
    """Return sets of assumptions that fill their ranges, by a Latin hypercube.

    >>> [round(s["taper"], 2) for s in sample_sets(2, seed=1)]
    [0.42, 0.71]
    """
    from scipy.stats import qmc

    shares = qmc.LatinHypercube(len(ASSUMPTIONS), rng=np.random.default_rng(seed)).random(count)
    return [{a.name: a.at(float(share)) for a, share in zip(ASSUMPTIONS, row, strict=True)} for row in shares]


def free_under(trims: str) -> list[str]:
    """Return the parameters that are free under a choice of trims.

    >>> free_under("flap-mean")
    ['frequency', 'flap_amplitude', 'pitch_amplitude', 'flap_mean']
    """
    return [*_FREE, *(trim.replace("-", "_") for trim in _MEANS if trims in (trim, "both"))]


def changes_under(values: Values, species: Species, model: str) -> dict[str, Any]:
    """Return the values, by path, that a set of assumptions gives to an animal and its coefficient model.

    Sets with the same trims have the same paths; `free_under` gives their free parameters.
    """
    number = {name: value for name, value in values.items() if isinstance(value, float)}
    vehicle, mass, span = species.vehicle, species.vehicle.mass, species.vehicle.wing.semi_span
    root = 2.0 * vehicle.wing.mean_chord / (1.0 + number["taper"])
    wing_mass = number["wing_mass_share"] * mass
    own, widest = _OWN[species.name], species.bounds["flap_amplitude"][1]
    flap_mean = math.radians(number["flap_mean_deg"])
    low, high = species.bounds["flap_mean"]
    bounds = {"bounds.flap_mean.lower": max(low, -flap_mean), "bounds.flap_mean.upper": min(high, flap_mean)}
    held = [f"wingbeat.{trim.replace('-', '_')}" for trim in _MEANS if values["trims"] not in (trim, "both")]
    return {
        "wing.mass": wing_mass,
        "body.mass": mass - 2.0 * wing_mass,
        "wing.mass_exponent": number["mass_exponent"],
        "wing.chord": [root, number["taper"] * root],
        "body.pitch_inertia": number["body_inertia_factor"] * vehicle.body.pitch_inertia,
        "wing.shoulder": [number[f"shoulder_{way}"] * span for way in ("ahead", "aside", "above")],
        # Frontal area 0.00813 m^0.666 (Pennycuick et al. 1988), drag coefficient 0.2.
        "body.drag_area": number["body_drag_factor"] * 0.2 * 0.00813 * mass**0.666,
        f"wingbeat.{own}": number[own],
        **dict.fromkeys(held, 0.0),
        "wingbeat.pitch_phase": math.radians(number["pitch_phase_deg"]),
        "bounds.flap_amplitude.upper": min(widest, math.radians(number["flap_amplitude_deg"])),
        **(bounds if values["trims"] in ("flap-mean", "both") else {}),
        "aero.extension": values[f"extension_{model.replace('-', '_')}"],
        "aero.airspeed": values["airspeed"],
        **({"aero.force_point": values["force_point"]} if model == "su-fan" else {}),
    }
