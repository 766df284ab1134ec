"""``wingbeat fit``: measured coefficients to a model file."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Annotated, Any

from wingbeat._base import FaultList, written_range
from wingbeat.aero.coefficient_model import check_aspect_ratio
from wingbeat.cli.arguments import check_files, check_outputs, figure, flag, option, written_to
from wingbeat.cli.process import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.terminal import answer
from wingbeat.experiment.coefficient_table import load_measurements
from wingbeat.experiment.wing_fit import WingFit, fit_wing
from wingbeat.plots import fit_page


def fit(
    coefficients: Annotated[Path, option("A table of `reduce`, or your own with alpha_deg, C_L, C_D.")],
    /,
    *,
    form: Annotated[str, option("Curves to fit: su-fan, dickinson, sine-cosine or cambered.")] = "su-fan",
    output: Annotated[Path | None, written_to("The model file: .toml.")] = None,
    plot: Annotated[Path | None, figure("Draw data, fit and bands")] = None,
    name: Annotated[str, option("Name of the model; default: the name of the output file.")] = "",
    citation: Annotated[str, option("Where the measurements come from, kept in the model file.")] = "",
    aspect_ratio: Annotated[
        float | None, option("Aspect ratio of the measured wing; inf for a section. Kept in the model file.")
    ] = None,
    alpha_min: Annotated[float, option("Leave out angles below this [deg].")] = -180.0,
    alpha_max: Annotated[float, option("Leave out angles above this [deg].")] = 180.0,
    reynolds_range: Annotated[
        tuple[float, float] | None,
        option("Use only rows from one Reynolds number to another: LOW HIGH; needs a column reynolds."),
    ] = None,
    json: Annotated[bool, flag("Print one JSON object.")] = False,
) -> int:
    """Fit lift, drag and centre of pressure, and print every parameter with its 95 % interval.

    The residuals are judged. Warnings say whether they depend on the Reynolds number, whether the rows form two
    branches (such as sweeps up and down through a stall), and which row does not fit the others. If the curve
    misses the data, or gives what no wing has, the fit failed: no file is written, and the exit code is 3.

    Use the form cambered for a wing whose upper and lower sides differ; it needs data at positive and negative
    angles. The other forms mirror the data of one side. The model file works wherever a coefficient model is
    named: `polar mymodel.toml`, `orbit --aero mymodel.toml`. To compare forms, fit them to the same table: the
    form with the lowest AICc is best.

    Example: wingbeat fit coefficients.csv --form su-fan -o mymodel.toml --plot fit.png
    """
    faults = FaultList()
    if output is not None and output.suffix.lower() != ".toml":
        faults.add("--output", str(output), "is not a model file", "end it in .toml")
    check_files(faults, output, coefficients, plot=plot)
    check_aspect_ratio(faults, "--aspect-ratio", aspect_ratio)
    bounds = [faults.number(f"--alpha-{end}", value) for end, value in (("min", alpha_min), ("max", alpha_max))]
    if all(bounds) and alpha_min > alpha_max:
        faults.add("--alpha-min", alpha_min, f"is above --alpha-max {alpha_max:g}", "exchange them")
    for value in reynolds_range or ():
        faults.number(
            "--reynolds-range", value, at_least=1, fix="write the lowest and the highest, such as 50e3 70e3"
        )
    if reynolds_range is not None and reynolds_range[0] > reynolds_range[1]:
        faults.add("--reynolds-range", list(reynolds_range), "has the highest first", "exchange them")
    faults.raise_if_any()
    check_outputs(output, plot)
    table = load_measurements(coefficients)
    if alpha_min > -180 or alpha_max < 180 or reynolds_range is not None:
        table = table.between(alpha_min, alpha_max, reynolds=reynolds_range)
    called = name or (output.stem if output is not None else coefficients.stem)
    found = fit_wing(table, form, called, citation or f"fitted to {coefficients.name}", aspect_ratio)
    with answer() as given:
        given.tell(_summary(found), lambda: _print_table(found), json)
        for note in _only_notes(found):
            print(f"note: {note}", file=sys.stderr)
        for kind, said in (("warning", found.warnings), ("error: the fit failed", found.failures)):
            for text in said:
                print(f"{kind}: {text}", file=sys.stderr)
        if not found.failures:
            given.save(output, found.save, named=True)
        elif output is not None:
            print(f"{output} was not written", file=sys.stderr)
        given.draw(plot, lambda: fit_page(found), named=True)
    return EXIT_NOT_CERTIFIED if found.failures else EXIT_GOOD


def _summary(found: WingFit) -> dict[str, Any]:
    """Return the fit as JSON types; numbers that are not finite become null."""
    record: dict[str, Any] = {"name": found.name, "form": found.form}
    record["alpha_range_deg"] = list(found.alpha_range_deg)
    record["reynolds_range"] = None if found.reynolds_range is None else list(found.reynolds_range)
    record["aspect_ratio"] = None if found.aspect_ratio is None else _finite(found.aspect_ratio) or "inf"
    for label, curve in found.curves.items():
        limits = curve.interval()
        record[label] = {
            "formula": curve.form.formula,
            "parameters": {n: {"value": v, "interval": list(limits[n])} for n, v in curve.parameters.items()},
            "r_squared": _finite(curve.r_squared),
            "aicc": _finite(curve.aicc),
            "points": len(curve.values),
        }
    said = {"notes": _only_notes(found), "warnings": list(found.warnings), "failures": list(found.failures)}
    return record | said


def _only_notes(found: WingFit) -> list[str]:
    """Return what was noted of the table and of the fit, without the warnings."""
    return [*found.table.notes, *(note for note in found.notes if note not in found.warnings)]


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _print_table(found: WingFit) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    low, high = found.alpha_range_deg
    title = f"{found.name}, form {found.form}, {low:g} to {high:g} degrees"
    if found.reynolds_range is not None:
        title += ", Re {:.0f} to {:.0f}".format(*found.reynolds_range)
    # As Text, for rich would take [deg] in a plain string for markup.
    caption = "angles in degrees; parameters as in wingbeat.aero's formulas"
    table = Table("curve", "parameter", title=Text(title), caption=Text(caption))
    for heading in ("value (95 % interval)", "R-squared", "AICc"):
        table.add_column(heading, justify="right")
    for label, curve in found.curves.items():
        limits = curve.interval()
        for i, (parameter, value) in enumerate(curve.parameters.items()):
            shown = written_range(*limits[parameter], value=value)
            # Cut, not rounded: 0.99996 is not 1.
            r_squared = math.floor(curve.r_squared * 1e5) / 1e5 if math.isfinite(curve.r_squared) else math.nan
            whole = (label, f"{r_squared:.5f}", f"{curve.aicc:.1f}") if i == 0 else ("", "", "")
            table.add_row(whole[0], parameter, shown, *whole[1:])
        table.add_section()
    Console().print(table)
