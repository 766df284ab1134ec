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

from wingbeat._base import FaultList, InvalidInputError, write_atomically
from wingbeat._base.style import BLUE, ORANGE, PAGE, drawing, legend_below, new_figure
from wingbeat.aero import (
    CoefficientModel,
    FamilyCoefficients,
    load_coefficients,
    thin_aerofoil_lift,
    thin_aerofoil_moment,
)
from wingbeat.aero.family import AtOneReynolds
from wingbeat.aero.neural_sections import GOOD_CONFIDENCE, LEAST_CONFIDENCE, section_polars, sections_csv
from wingbeat.cli.arguments import check_outputs, flag, given_beside, option, parse_range, several, written_to
from wingbeat.cli.problem_options import say_notes
from wingbeat.cli.terminal import answer
from wingbeat.plots import check_figure_name

# A polar of fewer rows is no curve.
_LEAST_ROWS = 8
# The options that --section obeys.
_BESIDE_SECTION = ("model", "section", "re", "csv", "json", "output")
Columns = dict[str, list[Any]]


def polar(
    model: Annotated[
        list[str] | None,
        option(
            "Name of a model, or path of a table (.csv), a polar (.pol, .dat, ...) or a fit (.toml); several "
            "polars at different Reynolds numbers are one model that depends on Re."
        ),
    ] = None,
    *,
    section: Annotated[
        str | None,
        option(
            "Compute the polars of a section at the Reynolds numbers of --re by NeuralFoil: NACA digits "
            "(naca0012), a file of coordinates (.dat), or plate0.04 for a plate 4 per cent thick. -o family.csv "
            "saves them."
        ),
    ] = None,
    alpha: Annotated[str, option("Angles of attack [deg], start:stop:step, or one angle.")] = "-30:110:2",
    re: Annotated[
        list[float] | None,
        several("Chord Reynolds numbers of --section, or at which to show a model that depends on Re."),
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
    output: Annotated[
        Path | None, written_to("Draw a figure: .png, .pdf or .svg. With --section, write the table: .csv.")
    ] = None,
) -> None:
    """Print or draw lift, drag, moment and centre of pressure of a coefficient model.

    The columns are alpha_deg, c_l, c_d, c_n, c_m (nose-up positive) and x_cp (in chords from the leading edge). If
    the model has no centre of pressure, c_m and x_cp are empty.

    Models: su-fan, dickinson, wang, whitney-wood, parslew-crowther, byl. Models of animal wings: feathered,
    feathered-revolving, feathered-flapping, membrane; --extension has no effect on these. A table has the columns
    alpha_deg, C_L, C_D and, if known, x_cp and reynolds, as `polar --csv` and `reduce` write them; usual other
    spellings are read too, and polars of XFOIL, XFLR5, AeroDyn, QBlade and others. A fitted model is what
    `wingbeat fit` wrote. --section computes the polars of a section (extra neuralfoil).

    Example: wingbeat polar --section naca0012 --re 2e4 5e4 1e5 -o family.csv; then
    wingbeat orbit pigeon --speed 10 --aero family.csv --extension viterna
    """
    beside = given_beside(polar, locals(), *_BESIDE_SECTION)
    faults = FaultList()
    if csv and json:
        faults.add("--csv", "--json", "two formats at once", "choose --csv or --json")
    if (section is None) == (not model):
        rule = "is given twice: model and --section" if section else "is not named"
        faults.add("MODEL", section or "", rule, "name a model such as su-fan, or --section naca0012 --re 5e4")
        faults.raise_if_any()
    if section is not None:
        if beside:
            fix = f"leave out {', '.join(beside)}; save the table with -o, and `wingbeat polar TABLE` takes them"
            faults.add("--section", section, "is computed at its own angles, with C_M about mid-chord", fix)
        return _of_section(faults, section, re or [], csv, json, output)
    assert model is not None
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


def _of_section(
    faults: FaultList, section: str, reynolds: list[float], csv: bool, json: bool, output: Path | None
) -> None:
    """Compute a section's polars by NeuralFoil; print them with its confidence, and save those that can be used."""
    if output is not None and output.suffix.lower() != ".csv":
        fix = f"write {output.with_suffix('.csv').name}; then wingbeat polar draws it"
        faults.add("--output", str(output), "is not the name of a table", fix)
    title, polars = _collected(faults, lambda: section_polars(section, reynolds)) or ("", [])
    faults.raise_if_any()
    check_outputs(output)
    for one in polars:
        where, used = f"{title} at Re {one.reynolds:.0f}", one.confidence[one.kept]
        if one.kept.sum() < _LEAST_ROWS:
            worst = f"{int(one.kept.sum())} of {len(one.kept)} angles"
            rule = f"has a confidence of {LEAST_CONFIDENCE:g} or more at {worst} only: NeuralFoil does not know it"
            faults.add("--section", where, rule, "use XFOIL, measurements, or a section with a round nose")
            continue
        left = one.alpha_deg[~one.kept]
        inside = left[(left > one.alpha_deg[one.kept].min()) & (left < one.alpha_deg[one.kept].max())]
        told = f"left out below a confidence of {LEAST_CONFIDENCE:g}: beyond {one.alpha_deg[one.kept].min():g} to "
        told += f"{one.alpha_deg[one.kept].max():g} degrees"
        told += f", and at {', '.join(f'{angle:g}' for angle in inside)}" if len(inside) else ""
        print(f"warning: {where}: {told}", file=sys.stderr)
        if doubtful := int((used < GOOD_CONFIDENCE).sum()):
            told = f"{doubtful} of {len(used)} rows have a confidence below {GOOD_CONFIDENCE:g}, the least "
            told += f"{used.min():.2f}"
            print(f"warning: {where}: {told}", file=sys.stderr)
    faults.raise_if_any()
    text = sections_csv(title, polars)
    rows = list(csv_format.DictReader(text.splitlines()[2:]))
    with answer() as given:
        if json:
            columns = {name: [float(row[name]) if row[name] else None for row in rows] for name in rows[0]}
            given.show(lambda: print(json_format.dumps(columns)))
        elif csv:
            given.show(lambda: print(text, end=""))
        elif output is None:
            given.show(lambda: _print_rows(f"{title} by NeuralFoil; C_M about mid-chord, nose-up positive", rows))
        given.save(output, lambda path: write_atomically(path, text), named=True)


def _print_rows(title: str, rows: list[dict[str, str]]) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(title=Text(title), min_width=min(len(title), 78))
    for heading in rows[0]:
        table.add_column(Text(heading.removeprefix("analysis_")), justify="right")
    for row in rows:
        table.add_row(*row.values())
    Console().print(table)


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
