"""What wings that others measured say about using the paper's plate as a wing.

Run as ``python validation/measured_wings.py [--data FOLDER] [-o FOLDER]``; writes measured_wings.md and .png.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from measured_data import all_polars
from measured_figure import draw_polars
from measured_summary import CRUISE, LINEAR_SHARE, Row, Verdict, judge, of_model, summary
from page_script import filled, write_page

from wingbeat.aero import Dickinson, SuFan
from wingbeat.experiment import FORMS, CurveFit
from wingbeat_evidence.markdown import markdown_table

COLUMNS = (
    *("wing", "Re / 1000", "lift slope [1/rad]", "zero lift [deg]", "C_L max", "at [deg]", "least C_D"),
    *("best L/D", f"L/D at C_L {CRUISE[0]:g} to {CRUISE[1]:g}", "centre [chords]"),
)


def page(rows: list[Row], verdicts: list[Verdict]) -> str:
    """Return the page as Markdown."""
    plate, insect = rows[0], rows[1]
    gulls = [row for row in rows if row.polar.kind == "gull"]
    thin = [row for row in rows if row.polar.kind == "plate"]
    jackdaw = next(row for row in rows if row.polar.kind == "jackdaw")
    wings = [*gulls, jackdaw]
    turn = [(row.lift_max_deg or 0.0) - (row.zero_lift_deg or 0.0) for row in gulls]
    centre = SuFan().centre_of_pressure(np.radians([5.0, 60.0]))
    postures = [-_slope_of(row.centre) for row in gulls]
    return filled(
        "measured_wings",
        table=markdown_table(COLUMNS, map(_cells, rows)),
        linear=LINEAR_SHARE,
        cruise=f"{CRUISE[0]:g} to {CRUISE[1]:g}",
        plate=plate.cruise_ratio,
        insect=insect.cruise_ratio,
        gulls=_between(lambda row: row.cruise_ratio, gulls),
        jackdaw=jackdaw.cruise_ratio,
        factor=_between(lambda row: row.cruise_ratio / plate.cruise_ratio, wings),
        blunt=_between(lambda row: plate.least_drag / row.least_drag, wings),
        thin=_between(lambda row: plate.least_drag / row.least_drag, thin),
        lift_max=plate.lift_max,
        below=_between(lambda row: 1 - plate.lift_max / row.lift_max, gulls, "{:.0%}"),
        lifts=_between(lambda row: row.lift_max, gulls, "{:.2f}"),
        at=plate.lift_max_deg,
        least_at=min(turn),
        most_at=max(turn),
        slope=_slope_of(plate.slope),
        steeper=sum(_slope_of(plate.slope) > _slope_of(row.slope) for row in gulls),
        count=len(gulls),
        slopes=_between(lambda row: _slope_of(row.slope), gulls),
        thin_slopes=_between(lambda row: _slope_of(row.slope), thin),
        zero=_between(lambda row: row.zero_lift_deg or 0.0, gulls),
        first=min(postures),
        last=max(postures),
        moved=max(postures) - min(postures),
        centre=centre[1] - centre[0],
        re_gulls=_thousand(gulls),
        re_plate=_thousand([plate]),
        re_jackdaw=_thousand([jackdaw]),
        forms=_forms(verdicts),
    )


def _cells(row: Row) -> list[str]:
    low, high = (value / 1e3 for value in row.polar.reynolds)
    model = row.polar.kind == "model"
    return [
        row.polar.label,
        f"{low:.3g}" if high - low < 0.05 * high else f"{low:.3g} to {high:.3g}",
        _slope(row.slope, 1.0, model),
        _number(row.zero_lift_deg, "{:.1f}"),
        f"{row.lift_max:.2f}",
        _number(row.lift_max_deg, "{:.0f}"),
        f"{row.least_drag:.3f}",
        f"{row.best_ratio:.1f}",
        f"{row.cruise_ratio:.1f}",
        _slope(row.centre, -1.0, model),
    ]


def _slope(line: CurveFit | None, sign: float, model: bool) -> str:
    """Return the slope of a line with half its 95 % interval; a model's is no measurement and has none."""
    if line is None:
        return "-"
    low, high = line.interval()["slope"]
    return f"{sign * line.parameters['slope']:.2f}" + ("" if model else f" ± {(high - low) / 2:.2f}")


def _number(value: float | None, form: str) -> str:
    return "-" if value is None or not np.isfinite(value) else form.format(value)


def _slope_of(line: CurveFit | None) -> float:
    return np.nan if line is None else line.parameters["slope"]


def _between(of: Callable[[Row], float], among: list[Row], form: str = "{:.1f}") -> str:
    low, high = (form.format(pick(of(row) for row in among)) for pick in (min, max))
    return low if low == high else f"{low} to {high}"


def _thousand(rows: list[Row]) -> str:
    low = min(row.polar.reynolds[0] for row in rows) / 1e3
    return f"{low:.0f} to {max(row.polar.reynolds[1] for row in rows) / 1e3:.0f}"


def _forms(verdicts: list[Verdict]) -> str:
    """Return how well each form follows lift and drag, how many curves determine it, how often it is best."""
    curves: dict[tuple[str, str], list[Verdict]] = {}
    for one in verdicts:
        curves.setdefault((one.wing, one.curve), []).append(one)
    best = [
        min((one for one in own if one.form != "su-fan" and np.isfinite(one.aicc)), key=lambda one: one.aicc)
        for own in curves.values()
    ]
    rows = []
    for form in FORMS:
        cells = [form]
        for curve in ("C_L", "C_D"):
            own = [one for one in verdicts if (one.form, one.curve) == (form, curve)]
            followed = np.array([one.r_squared for one in own if one.r_squared is not None])
            cells.append(f"{np.median(followed):.3f} ({followed.min():.3f})")
            cells.append(f"{sum(one.identified for one in own)} of {len(own)}")
        won = sum(one.form == form for one in best)
        rows.append([*cells, "-" if form == "su-fan" else f"{won} of {len(best)}"])
    heads = [f"{curve}: {what}" for curve in ("C_L", "C_D") for what in ("median R-squared (least)", "determined")]
    return markdown_table(["form", *heads, "best"], rows)


def main(argv: list[str] | None = None) -> int:
    """Write the page and the figure; return the exit code."""
    return write_page("Measured wings against the paper's plate.", "measured_wings", made, argv)


def made(data: Path) -> tuple[str, Figure]:
    """Return the page and the figure."""
    polars = all_polars(data)
    models = [of_model(SuFan(), "Su-Fan (the paper)"), of_model(Dickinson(), "Dickinson 1999")]
    rows = [summary(polar) for polar in [*models, *polars]]
    verdicts = [verdict for polar in polars for verdict in judge(polar)]
    return page(rows, verdicts), draw_polars(models, polars, rows)


if __name__ == "__main__":
    sys.exit(main())
