"""``wingbeat polar``: the coefficients of a model against the angle of attack, as numbers or as a figure."""

from __future__ import annotations

import csv as csv_format
import json as json_format
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList, InvalidInputError
from wingbeat._base.style import BLUE, ORANGE, PAGE, drawing, legend_below, new_figure
from wingbeat.aero import (
    CoefficientModel,
    FamilyCoefficients,
    load_coefficients,
    thin_aerofoil_lift,
    thin_aerofoil_moment,
)
from wingbeat.aero.family import AtOneReynolds
from wingbeat.cli.arguments import check_outputs, flag, option, parse_range, several, written_to
from wingbeat.cli.problem_options import say_notes
from wingbeat.cli.terminal import answer
from wingbeat.plots import check_figure_name

Columns = dict[str, list[Any]]


def polar(
    model: Annotated[
        list[str],
        option(
            "Name of a model, or path of a table (.csv), a polar (.pol, .dat, ...) or a fit (.toml); several "
            "polars at different Reynolds numbers are one model that depends on Re."
        ),
    ],
    *,
    alpha: Annotated[str, option("Angles of attack [deg], start:stop:step, or one angle.")] = "-30:110:2",
    re: Annotated[
        list[float] | None,
        several("Chord Reynolds numbers at which to show a model that depends on Re; default those of its polars."),
    ] = None,
    about: Annotated[float, option("Axis of C_M, in chords from the leading edge.")] = 0.5,
    extension: Annotated[
        str,
        option(
            "Extension to angles outside the fit: mirrored, signed-drag, signed, clipped-drag. viterna completes a "
            "table that ends at the stall."
        ),
    ] = "mirrored",
    blend_width_deg: Annotated[
        float, option("Half width [deg] of the blends at 0, 90 and 180 degrees: above 0, at most 3.")
    ] = 1.0,
    csv: Annotated[bool, flag("Print CSV.")] = False,
    json: Annotated[bool, flag("Print one JSON object of lists.")] = False,
    output: Annotated[Path | None, written_to("Draw a figure: .png, .pdf or .svg.")] = None,
) -> None:
    """Print or draw lift, drag, moment and centre of pressure of a coefficient model.

    The columns are alpha_deg, c_l, c_d, c_n, c_m (nose-up positive) and x_cp (in chords from the leading edge). If
    the model has no centre of pressure, c_m and x_cp are empty.

    Models: su-fan, dickinson, wang, whitney-wood, parslew-crowther, byl. Models of animal wings: feathered,
    feathered-revolving, feathered-flapping, membrane; --extension has no effect on these. A table has the columns
    alpha_deg, C_L, C_D and, if known, x_cp and reynolds, as `polar --csv` and `reduce` write them; usual other
    spellings are read too, and polars of XFOIL, XFLR5, AeroDyn, QBlade and others. A fitted model is what
    `wingbeat fit` wrote.
    """
    faults = FaultList()
    if csv and json:
        faults.add("--csv", "--json", "two formats at once", "choose --csv or --json")
    if output is not None:
        check_figure_name(faults, "--output", output)
    faults.number("--about", about, fix="0 is the leading edge, 1 the trailing edge")
    angles = _collected(faults, lambda: parse_range(alpha, "--alpha"))
    coefficients: Any = _collected(faults, lambda: load_coefficients(model, extension, blend_width_deg))
    for value in re or ():
        faults.number("--re", value, at_least=1, fix="give chord times speed over viscosity, such as 5e4")
    if re and coefficients is not None and not isinstance(coefficients, FamilyCoefficients):
        faults.add("--re", re[0], f"has no effect: {coefficients.name} does not depend on Re", "leave --re out")
    faults.raise_if_any()

    check_outputs(output)
    say_notes(model, coefficients)
    shown: list[Any] = [coefficients]
    if isinstance(coefficients, FamilyCoefficients):
        low, high = coefficients.reynolds_range
        for value in re or ():
            if not low <= value <= high:
                told = f"Re {value:g} is outside {low:.0f} to {high:.0f}: the nearest polar holds"
                print(f"warning: {coefficients.name}: {told}", file=sys.stderr)
        shown = [coefficients.at(value) for value in re or coefficients.reynolds]
    columns = [polar_columns(one, angles, about) for one in shown]
    with answer() as given:
        if json:
            given.show(lambda: print(json_format.dumps(_joined(columns))))
        elif csv:
            given.show(lambda: _print_csv(_joined(columns)))
        elif output is None:
            tables = list(zip(shown, columns, strict=True))
            given.show(lambda: [_print_table(one, its, about) for one, its in tables])
        given.draw(output, lambda: _figure(shown, angles, about), named=True)


def _joined(columns: list[Columns]) -> Columns:
    """Return the columns of several polars, one below the other."""
    return {name: [value for one in columns for value in one[name]] for name in columns[0]}


def _print_csv(columns: Columns) -> None:
    rows = (columns, *zip(*columns.values(), strict=True))
    csv_format.writer(sys.stdout, lineterminator="\n").writerows(rows)


def _collected(faults: FaultList, door: Callable[[], Any]) -> Any:
    """Call `door`; add the faults that it raises to `faults`, so that all are reported at once."""
    try:
        return door()
    except InvalidInputError as error:
        faults.faults.extend(error.faults)


def polar_columns(model: CoefficientModel, alpha_deg: NDArray[np.float64], about: float) -> Columns:
    """Return the polar as named lists of equal length; c_m and x_cp hold None where the model has no x_cp."""
    alpha = np.deg2rad(alpha_deg)
    columns: Columns = {"alpha_deg": alpha_deg.tolist(), "c_l": model.lift(alpha).tolist()}
    if isinstance(model, AtOneReynolds):
        columns = {"reynolds": [model.reynolds] * len(alpha), **columns}
    columns |= {"c_d": model.drag(alpha).tolist(), "c_n": model.normal(alpha).tolist()}
    if not model.has_centre_of_pressure:
        return columns | dict.fromkeys(("c_m", "x_cp"), [None] * len(alpha))
    moment, centre = model.moment(alpha, about), model.centre_of_pressure(alpha)
    return columns | {"c_m": moment.tolist(), "x_cp": centre.tolist()}


def _title(model: CoefficientModel) -> str:
    return f"{model}, {model.extension}, blends of {model.blend_width_deg:g}°"


def _print_table(model: CoefficientModel, columns: Columns, about: float) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    # As Text, for in a plain string rich would take [deg] for markup.
    caption = f"C_M: nose-up positive, about an axis {about:g} chords from the leading edge"
    table = Table(title=Text(_title(model)), caption=Text(caption), min_width=min(len(caption), 78))
    for heading in ("alpha [deg]", "C_L", "C_D", "C_N", "C_M", "x_cp [chords]"):
        table.add_column(Text(heading), justify="right")
    shown = [column for name, column in columns.items() if name != "reynolds"]
    for angle, *values in zip(*shown, strict=True):
        table.add_row(f"{angle:g}", *("-" if value is None else f"{value:z.4f}" for value in values))
    Console().print(table)


@drawing()
def _figure(models: list[Any], angles_deg: NDArray[np.float64], about: float) -> Any:
    """Return a matplotlib figure with one panel for each coefficient the model has, and a line for each Re."""
    from matplotlib import colormaps
    from matplotlib.ticker import MaxNLocator

    # Drawn finer than asked: a step of 2 degrees would show the blends as kinks.
    fine = np.linspace(angles_deg[0], angles_deg[-1], 2001) if len(angles_deg) > 1 else angles_deg
    model = models[0]
    labels = {"c_l": "lift coefficient $C_L$ [-]", "c_d": "drag coefficient $C_D$ [-]"}
    if model.has_centre_of_pressure:
        labels["c_m"] = f"moment coefficient $C_M$ about {about:g} c [-]"
        labels["x_cp"] = "centre of pressure $x_{cp}$ [chords]"
    theory, theory_label = {"c_l": thin_aerofoil_lift}, r"thin aerofoil: $C_L = 2\pi\alpha$"
    if "c_m" in labels and about == 0.5:
        theory["c_m"] = thin_aerofoil_moment
        theory_label += r", $C_M = \frac{\pi}{2}\alpha$"
    low, high = model.alpha_range_deg
    rows = len(labels) // 2
    page = new_figure(PAGE, 20.0 + 65.0 * rows)
    page.suptitle(_title(model if len(models) == 1 else model.family), fontsize=8)
    drawn = [polar_columns(one, fine, about) for one in models]
    colours = [BLUE] if len(models) == 1 else colormaps["viridis"](np.linspace(0.0, 0.85, len(models)))
    for axes, (name, label) in zip(page.subplots(rows, 2, sharex=True).flat, labels.items(), strict=True):
        for one, columns, colour in zip(models, drawn, colours, strict=True):
            told = one.name if len(models) == 1 else f"Re {one.reynolds:.0f}"
            axes.plot(fine, columns[name], color=colour, marker="o" if len(fine) == 1 else None, label=told)
        # Set the limits before the lines of theory are drawn, because these lines would leave the page.
        axes.set(ylabel=label, ylim=axes.get_ylim(), xlim=axes.get_xlim())
        if name in theory:
            ends = np.array(axes.get_xlim())
            axes.plot(ends, theory[name](np.deg2rad(ends)), ":", color="0.35", label=theory_label)
        axes.axvspan(low, high, color=ORANGE, alpha=0.12, linewidth=0, label=f"data, {low:g}° to {high:g}°")
        axes.axhline(0.0, color="0.6", linewidth=0.6)
        axes.grid()
        axes.xaxis.set_major_locator(MaxNLocator(nbins=9, steps=[1, 2, 3, 4.5, 5, 6, 9, 10]))
        if axes.get_subplotspec().is_last_row():
            axes.set_xlabel(r"angle of attack $\alpha$ [deg]")
    legend_below(page, page.axes, columns=3)
    return page
