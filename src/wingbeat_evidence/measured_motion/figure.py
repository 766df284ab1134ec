"""The page of a measured motion: measured and computed forces, residuals, and angles of attack."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import heading, in_words
from wingbeat._base.style import (
    BLUE,
    COLUMN,
    FIRST,
    GREY,
    ORANGE,
    PAGE,
    PURPLE,
    SECOND,
    SHADE,
    SKY,
    THIRD,
    drawing,
    dress,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat_evidence.measured_motion import Validation, ValidationRow
from wingbeat_evidence.measured_motion.choice import significant
from wingbeat_evidence.measured_motion.scores import best_sine
from wingbeat_evidence.measured_motion.strip_motion import moves_down

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LABELS = {"fz": "upward force / weight [-]", "fx": "forward force / weight [-]"}
_MEASURED: dict[str, Any] = {"color": "k", "linewidth": 1.4}
_SINE: dict[str, Any] = {"color": ORANGE, "linestyle": ":"}
_LADDER: tuple[dict[str, Any], ...] = (
    SECOND,
    THIRD,
    {"color": SKY, "linestyle": (0, (5, 1, 1, 1))},
    {"color": PURPLE, "linestyle": (0, (6, 1, 1, 1, 1, 1))},
    {"color": GREY, "linestyle": (0, (2, 2))},
)
_TERMS = {
    "thin-aerofoil": "rotation, added mass",
    "thin-aerofoil-wake": "rotation, added mass, wake",
    "momentum": "induced flow",
}
# Of the strips' angles; no row of the page has these styles, as one legend names both.
_STATIONS: tuple[tuple[float, dict[str, Any]], ...] = tuple(
    (reach, {"color": "k", "linewidth": 0.8, "linestyle": dashes})
    for reach, dashes in ((0.25, ":"), (0.5, "--"), (0.75, "-."))
)


@drawing()
def validation_page(found: Validation) -> Figure:
    """Return a figure of a measured motion: forces and residuals through time, and angles of attack.

    Black: the measurement with two standard errors on either side. Solid: the recommended row. Dashed: the same
    coefficients with other terms. Grey: all other rows. Dotted: the best sine at the beat's frequency. The panels
    below show the residual force. Downstrokes are shaded.

    Parameters
    ----------
    found : from `validate`.
    """
    case = found.case
    through_time = [axis for axis in ("fz", "fx") if axis in case.forces]
    axes_shown = through_time or ["fz"]
    rows = 3 if through_time else 2
    width = PAGE if len(axes_shown) > 1 else 0.7 * PAGE if through_time else COLUMN
    figure = new_figure(width, 46.0 + 40.0 * rows)
    heights = (3, 2, 2) if through_time else (3, 2)
    grid = figure.subplots(rows, len(axes_shown), sharex=True, squeeze=False, height_ratios=heights)
    for panels, axis in zip(grid.T, axes_shown, strict=True):
        _draw_force(panels[0], found, axis)
        if through_time:
            _draw_residual(panels[1], found, axis)
        _draw_alpha(panels[-1], found)
        panels[-1].set_xlabel("time [beats]")
    for panel in grid.ravel():
        _shade(panel, found)
    letter_panels(grid)
    legend_below(figure, grid, columns=2)
    regime = found.regime
    title = f"{heading(case.title or case.name)}: {regime.wing} wing, Re {significant(regime.reynolds)}"
    figure.suptitle(title, fontsize=8, parse_math=False)
    return figure


def _beats(found: Validation) -> np.ndarray:
    """Return the times that are scored, in beats since the first of them."""
    times = found.case.times[found.case.inside]
    return (times - times[0]) * found.case.frequency


def _force(row: ValidationRow, found: Validation, axis: str) -> np.ndarray:
    return getattr(row.loads, axis)[found.case.inside] / found.case.weight


def _styled(found: Validation) -> list[tuple[ValidationRow, str, dict[str, Any]]]:
    """Return each row with its label and style, in the order of drawing."""
    best = found.recommended
    same = [row for row in found.rows if row is not best and row.aero.coefficients is best.aero.coefficients]
    grey: dict[str, Any] = {"color": "0.65", "linewidth": 0.4}
    others = [row for row in found.rows if row is not best and row not in same]
    styled = [(row, "other models" if i == 0 else "_", grey) for i, row in enumerate(others)]
    styled += [(row, row_label(row, best), style) for row, style in zip(same, _LADDER, strict=False)]
    return [*styled, (best, row_label(best), {**FIRST, "linewidth": 1.4})]


def row_label(row: ValidationRow, beside: ValidationRow | None = None) -> str:
    """Return coefficients and terms of a row in a few words; only the terms beside a row of these coefficients."""
    terms = [_TERMS.get(name, in_words(name)) for name in (row.unsteady, row.aero.inflow) if name != "none"]
    coefficients = in_words(row.aero.coefficients.name)
    if not terms:
        return f"{coefficients} alone"
    return f"{coefficients if beside is None else ''} + {', '.join(terms)}".strip()


def _draw_force(panel: Axes, found: Validation, axis: str) -> None:
    case, beats = found.case, _beats(found)
    dress(panel, "", _LABELS[axis])
    for row, label, style in _styled(found):
        panel.plot(beats, _force(row, found, axis), label=label, **style)
    if axis in case.forces:
        force = case.forces[axis][case.inside] / case.weight
        if axis in case.errors:
            twice = 2 * case.errors[axis][case.inside] / case.weight
            panel.fill_between(beats, force - twice, force + twice, color="0.6", linewidth=0, label="±2 se")
        panel.plot(beats, best_sine(case, axis)[case.inside] / case.weight, label="best sine", **_SINE)
        panel.plot(beats, force, label="measured", **_MEASURED)
    elif case.mean_force is not None:
        mean = case.mean_force[("fx", "fz").index(axis)] / case.weight
        panel.axhline(mean, label="measured mean", **_MEASURED)
        computed = found.case.mean(getattr(found.recommended.loads, axis)) / case.weight
        panel.axhline(float(computed), color=BLUE, linewidth=0.8, linestyle=(0, (6, 2)), label="computed mean")


def _draw_residual(panel: Axes, found: Validation, axis: str) -> None:
    case, beats = found.case, _beats(found)
    dress(panel, "", "residual / weight [-]")
    measured = case.forces[axis][case.inside] / case.weight
    if axis in case.errors:
        twice = 2 * case.errors[axis][case.inside] / case.weight
        panel.fill_between(beats, -twice, twice, color="0.6", linewidth=0)
    for row, _, style in _styled(found):
        panel.plot(beats, _force(row, found, axis) - measured, **style)
    panel.plot(beats, best_sine(case, axis)[case.inside] / case.weight - measured, **_SINE)
    panel.axhline(0.0, **{**_MEASURED, "linewidth": 0.6})


def _draw_alpha(panel: Axes, found: Validation) -> None:
    case, beats = found.case, _beats(found)
    dress(panel, "", "angle of attack α [deg]")
    side = np.abs(case.position[..., 1]).max(axis=0)
    alpha = np.degrees(found.recommended.loads.alpha[case.inside])
    for station, style in _STATIONS:
        strip = int(np.abs(side - station * side.max()).argmin())
        line = alpha[:, strip]
        jumps = np.abs(np.diff(line, prepend=line[:1])) > 180.0
        panel.plot(beats, np.where(jumps, np.nan, line), label=f"{station:g} reach", **style)
    panel.axhline(0.0, color="0.6", linewidth=0.6)


def _shade(panel: Axes, found: Validation) -> None:
    beats = _beats(found)
    down = moves_down(found.case, found.motion)[found.case.inside]
    panel.set_xlim(beats[0], beats[-1])
    across = panel.get_xaxis_transform()
    panel.fill_between(beats, 0, 1, where=down, transform=across, color=SHADE, linewidth=0, zorder=0)
