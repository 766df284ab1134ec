"""The figure of an assumption study: which claims hold, and what they depend on, in plain words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from wingbeat._base import in_words
from wingbeat._base.style import BLUE, GREEN, VERMILION, drawing, letter_panels, new_figure
from wingbeat_evidence.paper.assumption_study import Judged
from wingbeat_evidence.paper.assumptions import ASSUMPTIONS
from wingbeat_evidence.paper.importance import Importance

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# A surface that explains less than this share of the variance of unseen numbers says little.
TRUSTED = 0.3
# Claims in a few words; U and P are the two references of the pigeon's frequency.
CLAIMS = {
    "pigeon-agrees-usherwood": "pigeon: frequency agrees (U)",
    "pigeon-dickinson-off-usherwood": "pigeon: Dickinson disagrees (U)",
    "pigeon-closer-at-speed-usherwood": "pigeon: Su-Fan closer (U)",
    "pigeon-agrees-pennycuick": "pigeon: frequency agrees (P)",
    "pigeon-dickinson-off-pennycuick": "pigeon: Dickinson disagrees (P)",
    "pigeon-closer-at-speed-pennycuick": "pigeon: Su-Fan closer (P)",
    "bat-closer-at-speed": "bat: Su-Fan closer",
    "bat-slow-alike": "bat: models alike to 5 m/s",
    "bat-parts": "bat: models part above 5 m/s",
    "bat-agrees": "bat: frequency agrees",
    "bat-invariant": "bat: frequency constant",
    "twice-the-frequency": "Dickinson: twice the frequency",
    "smaller-alpha-1-of-4": "Su-Fan: smaller angles, 1/4 span",
    "smaller-alpha-3-of-4": "Su-Fan: smaller angles, 3/4 span",
    "smaller-horizontal-force": "Su-Fan: less horizontal force",
    "smaller-vertical-force": "Su-Fan: less vertical force",
    "hand-alpha": "hand: larger angle than arm",
    "arm-lifts": "arm: lifts more than hand",
    "hand-thrusts": "hand: produces the thrust",
    "arm-drags": "arm: more drag than hand",
    "arm-pitches-least": "Su-Fan: arm pitches less",
    "peak-power-su-fan": "Su-Fan: peak power 30 W",
    "peak-power-dickinson": "Dickinson: peak power 150 W",
    "four-times": "Dickinson: four times the peak power",
    "power-exponent": "power as frequency squared",
    "measured-power-below": "measured power below both",
    "lower-power": "Su-Fan: lower power",
    "pitch-range-su-fan": "Su-Fan: body pitches at most 10°",
    "pitch-range-dickinson": "Dickinson: body pitches 25°",
    "less-pitching-pigeon": "Su-Fan: pigeon pitches less",
    "less-pitching-bat": "Su-Fan: bat pitches less",
}
# Assumptions whose names need other words than their own.
_WORDS = {
    "wing_mass_share": "wing mass",
    "mass_exponent": "exponent of wing mass",
    "body_inertia_factor": "body inertia",
    "twist_ratio": "twist",
    "flap_amplitude_deg": "most flap amplitude",
    "trims": "free mean angles",
    "flap_mean_deg": "most mean flap",
    "pitch_phase_deg": "pitch phase",
    "extension_su_fan": "Su-Fan, negative angles",
    "extension_dickinson": "Dickinson, negative angles",
    "airspeed": "airspeed of a strip",
    "force_point": "point of the force",
    "body_drag_factor": "body drag",
}


@drawing(font=9.0)
def draw(study: Judged, hangs: Sequence[Importance | None]) -> Figure:
    """Draw, for each claim, the share of the testable sets that satisfy it and what its number depends on."""
    from matplotlib import colormaps

    count = len(study.claims)
    figure = new_figure(254.0, 51.0 + 6.9 * count)
    bars, heat, fits = figure.subplots(1, 3, sharey=True, width_ratios=(1.1, 3.0, 0.5))
    places = np.arange(count)
    told = np.isfinite(study.holds)
    share = np.array([100 * h[t].mean() if t.any() else 0.0 for h, t in zip(study.holds.T, told.T, strict=True)])
    bars.barh(places, share, color=BLUE, height=0.7)
    bars.plot(100 * told.mean(axis=0), places, "|", color=VERMILION, markersize=9)
    bars.set(xlim=(0, 103), xlabel="sets that hold (bar),\nthat can test it (tick) [%]")
    bars.set_yticks(places, [CLAIMS.get(claim.id, in_words(claim.id)) for claim in study.claims], fontsize=8)
    shares = np.array([np.full(len(ASSUMPTIONS), np.nan) if h is None else h.shares for h in hangs])
    image = heat.imshow(
        100 * shares, aspect="auto", cmap=colormaps["Blues"].with_extremes(bad="0.85"), vmin=0, vmax=60
    )
    names = [_WORDS.get(assumption.name, in_words(assumption.name)) for assumption in ASSUMPTIONS]
    heat.set_xticks(np.arange(len(ASSUMPTIONS)), names, rotation=40, ha="right", fontsize=8)
    figure.colorbar(image, ax=heat, label="share of the variance explained [%]", fraction=0.03, pad=0.01)
    quality = np.array([np.nan if h is None else h.quality for h in hangs])
    fits.barh(places, np.maximum(quality, 0.0), color=GREEN, height=0.7)
    fits.axvline(TRUSTED, color="0.35", linestyle="-.", linewidth=0.8)
    fits.set(xlim=(0, 1), xlabel="R² of the\nsurface [-]")
    for axes in (bars, heat, fits):
        axes.tick_params(length=2)
    letter_panels((bars, heat, fits))
    return figure
