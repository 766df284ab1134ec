"""The coefficient models that a user can choose by name."""

from __future__ import annotations

from collections.abc import Callable

from wingbeat.aero.animal_wings import Feathered, FeatheredFlapping, FeatheredRevolving, Membrane
from wingbeat.aero.cambered import CamberedCoefficients
from wingbeat.aero.formula import FormulaCoefficients
from wingbeat.aero.published import Byl, Dickinson, ParslewCrowther, SuFan, Wang2004, WhitneyWood

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
