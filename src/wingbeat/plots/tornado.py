"""The tornado plot: which uncertain number moves an answer most."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from wingbeat.results.sensitivities import Sensitivities

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_WIDTH, _ROW, _HEAD = 183.0, 5.0, 24.0  # mm
_INCH = 25.4
_MOST = 12
_LOW, _HIGH = "#0072B2", "#D55E00"  # Okabe and Ito's blue and vermilion
_STYLE: dict[str, Any] = {"font.family": "sans-serif", "font.size": 7, "axes.linewidth": 0.6, "axes.labelpad": 2}
_STYLE |= {"axes.spines.top": False, "axes.spines.right": False, "axes.spines.left": False}


def tornado_page(found: Sensitivities) -> Figure:
    """Rank parameters by what their plausible ranges do to each quantity to first order, the largest on top.

    Parameters with no range are left out. A panel for each quantity; the line in the middle is the orbit as solved.
    A straight line over whole ranges is no error bar, so bars are shares of the largest.

    Parameters
    ----------
    found : of `wingbeat.sensitivities`.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> found = wb.sensitivities(wb.solve_orbit(wb.OrbitProblem(pigeon, speed=10.0), starts=1))
    >>> len(wb.plots.tornado_page(found).axes)
    2
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    count = min(_MOST, sum(s.parameter.plausible is not None for s in found.slopes))
    with rc_context(_STYLE):  # type: ignore[arg-type]
        figure = Figure(figsize=(_WIDTH / _INCH, (_HEAD + _ROW * count) / _INCH), layout="constrained")
        problem = found.problem
        figure.suptitle(
            f"{problem.species.name} at {problem.speed:g} m/s, least {problem.minimise.name.replace('_', ' ')}: "
            "which plausible range matters most, a ranking to first order (largest change: 1)",
            fontsize=8,
        )
        panels = figure.subplots(1, len(found.values), squeeze=False)[0]
        for panel, name in zip(panels, found.values, strict=True):
            _draw(panel, found, name)
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=2, frameon=False)
    return figure


def _draw(panel: Any, found: Sensitivities, name: str) -> None:
    ranked = [s for s in found.ranked(name) if s.parameter.plausible is not None][:_MOST]
    largest = max((abs(end) for slope in ranked for end in found.swing(slope, name)), default=0.0) or 1.0
    for row, slope in enumerate(ranked):
        low, high = found.swing(slope, name)
        for change, color, end in ((low, _LOW, "low end of the range"), (high, _HIGH, "high end")):
            panel.barh(row, change / largest, height=0.7, color=color, label=end if row == 0 else None)
    panel.axvline(0.0, color="0.2", linewidth=0.8)
    panel.set_yticks(range(len(ranked)), [s.parameter.path for s in ranked])
    panel.tick_params(axis="y", length=0)
    panel.invert_yaxis()
    panel.margins(y=0.01)
    panel.set_xlabel(f"change of {name.replace('_', ' ')} [-]")
