"""The study's page: a table of numbers and what they mean, every one of them computed."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from measured_summary import CRUISE, LINEAR_SHARE, Row, Verdict

from wingbeat.aero import SuFan
from wingbeat.experiment import FORMS, CurveFit

HEAD = """# Measured wings against the paper's plate

`python validation/measured_wings.py` writes this page and computes every number in and below its tables. Su et al.
(arXiv 2302.09602) measured the coefficients of a plate. The page compares this plate with wings and thin plates
that other people measured. Their data are not part of this project:

- 3D-printed half wings of a gull, in nine postures of elbow and wrist, each at two tunnel speeds
  (github.com/charvey23/UMWTStaticStability). The source's units are ambiguous. We read its columns CL and CD as
  areas, and the numbers support this reading.
- A live gliding jackdaw. Its wake gave the forces on its wings, without the forces on its body
  (KleinHeerenbrink, Warfvinge and Hedenstrom 2016, doi 10.1242/jeb.132480).
- Thin plates of small aspect ratio. We read their values by eye from a figure of Pelletier and Mueller 2000
  (J. Aircraft 37:825).

![lift, drag, lift over drag and moment](measured_wings.png)

- Panel a shows lift against the angle of attack, counted from that of zero lift: mount angles of twisted wings
  cannot be compared.
- Panel b shows drag against lift, and panel c the lift-to-drag ratio against lift. Neither depends on how the angle
  was measured.
- Panel d shows the moment against normal force. The moment is about the shoulder for gulls and about the leading
  edge for Su-Fan, so compare only the slopes.
"""

COLUMNS = (
    *("wing", "Re / 1000", "lift slope [1/rad]", "zero lift [deg]", "C_L max", "at [deg]", "least C_D"),
    *("best L/D", f"L/D at C_L {CRUISE[0]:g} to {CRUISE[1]:g}", "centre [chords]"),
)

NOTES = f"""
- For the gulls and the thin plates, the table uses the mean of the measurements at each angle.
- *Lift slope* is a least-squares fit between zero lift and {LINEAR_SHARE:.0%} of the largest lift. It is given
  with its 95 % interval. In this range the lift curve of the plate of Su et al. is not straight, so the table gives
  the mean slope of the curve.
- For the drag of the jackdaw, the table uses a fitted parabola, C_D = a + b (C_L - c)^2. We do not use single
  measurements, because they scatter, and the best lift-to-drag ratio of hundreds would be an outlier. The jackdaw's
  *C_L max* is the largest C_L of its steady glides, in which the bird did not stall.
- *Centre* is -dC_M/dC_N below stall. If the angle of attack changes, the normal force changes, and this change acts
  at the centre. For gulls the centre is given in mean aerodynamic chords behind the shoulder, for Su-Fan in chords
  behind the leading edge.
- The coefficients of Su-Fan and Dickinson are evaluated from 0 to 60 degrees. A dash means that a value was not
  measured.
"""


def page(rows: list[Row], verdicts: list[Verdict]) -> str:
    """Return the page as Markdown."""
    table = [f"| {' | '.join(COLUMNS)} |", "|---" * len(COLUMNS) + "|", *(_line(row) for row in rows)]
    return "\n".join([HEAD, *table, NOTES, *_meaning(rows), "", *_forms(verdicts)]) + "\n"


def _line(row: Row) -> str:
    low, high = (value / 1e3 for value in row.polar.reynolds)
    model = row.polar.kind == "model"
    cells = [
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
    return f"| {' | '.join(cells)} |"


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


def _meaning(rows: list[Row]) -> list[str]:
    """Return what the numbers say, in sentences."""
    plate, insect = rows[0], rows[1]
    gulls = [row for row in rows if row.polar.kind == "gull"]
    thin = [row for row in rows if row.polar.kind == "plate"]
    jackdaw = next(row for row in rows if row.polar.kind == "jackdaw")
    wings = [*gulls, jackdaw]
    turn = [(row.lift_max_deg or 0.0) - (row.zero_lift_deg or 0.0) for row in gulls]
    steeper = sum(_slope_of(plate.slope) > _slope_of(row.slope) for row in gulls)
    centre = SuFan().centre_of_pressure(np.radians([5.0, 60.0]))
    postures = [-_slope_of(row.centre) for row in gulls]
    return [
        "## Consequences for flights computed with the plate's coefficients",
        "",
        f"- **Drag.** In cruise (C_L {CRUISE[0]:g} to {CRUISE[1]:g}) the plate's lift-to-drag ratio is "
        f"{plate.cruise_ratio:.1f}. With Dickinson's coefficients it is {insect.cruise_ratio:.1f}, for the gulls "
        f"{_between(lambda row: row.cruise_ratio, gulls)} and for the jackdaw's wings {jackdaw.cruise_ratio:.1f}. "
        f"The ratio of measured wings is thus {_between(lambda row: row.cruise_ratio / plate.cruise_ratio, wings)} "
        "times that of the plate. If the power of steady flight at that lift is computed with the plate's wing "
        "drag, it is too high by this factor.",
        "- **Bluntness.** The plate's least drag is "
        f"{_between(lambda row: plate.least_drag / row.least_drag, wings)} times that of the wings and "
        f"{_between(lambda row: plate.least_drag / row.least_drag, thin)} times that of the thin plates. The "
        "plate is 8 mm thick, with a chord of 76 mm, and has no rounded leading edge.",
        f"- **Lift.** The plate's largest lift, {plate.lift_max:.2f}, is "
        f"{_between(lambda row: 1 - plate.lift_max / row.lift_max, gulls, '{:.0%}')} below that of the "
        f"gulls ({_between(lambda row: row.lift_max, gulls, '{:.2f}')}). The gulls' data end at a mount angle "
        "of 25 degrees, soon after their largest lift. Each gull wing has its zero lift at another mount angle. If "
        f"angles are counted from zero lift, the gulls' largest lift is at {min(turn):.0f} to {max(turn):.0f} "
        f"degrees. The plate has its largest lift at {plate.lift_max_deg:.0f} degrees. Beyond 25 degrees these "
        "data cannot test the plate.",
        f"- **Small angles.** The mean lift slope of the plate is {_slope_of(plate.slope):.1f} per rad, larger "
        f"than that of {steeper} of {len(gulls)} gull wings (all gulls "
        f"{_between(lambda row: _slope_of(row.slope), gulls)}). It is also larger than that of the thin plates "
        f"({_between(lambda row: _slope_of(row.slope), thin)}), which have a smaller aspect ratio. "
        f"The gulls' zero lift is at mount angles of {_between(lambda row: row.zero_lift_deg or 0.0, gulls)} "
        "degrees, because of twist and camber. The plate's zero lift is at 0 degrees.",
        f"- **Moment.** The lift due to angle of attack acts {min(postures):.2f} to {max(postures):.2f} chords "
        "behind the gulls' shoulder. The wing's posture alone moves this point by "
        f"{max(postures) - min(postures):.2f} chords. The plate's centre of pressure moves by only "
        f"{centre[1] - centre[0]:.2f} chords between angles of attack of 5 and 60 degrees. So a model that gives "
        "all postures the same centre of pressure omits the larger of these two effects.",
        f"- **Reynolds numbers.** The gulls were measured at {_thousand(gulls)} thousand, the plate at "
        f"{_thousand([plate])} thousand. Only the jackdaw ({_thousand([jackdaw])} thousand) comes close to the "
        "plate. The difference in drag is partly due to Reynolds number and partly to shape; these data cannot "
        "separate the two.",
    ]


def _forms(verdicts: list[Verdict]) -> list[str]:
    """Return the table of forms: which a polar determines, and how well it follows."""
    lines = [
        "## Which forms these data determine",
        "",
        "The table shows R-squared of lift and drag for each form of `wingbeat fit`. *No* means that the data do",
        "not determine the form: an interval of a parameter is wider than its value, a parameter is at a bound of",
        "the fit, or the fit is ill-conditioned. Do not use such a fit outside the measured range. Su-Fan's form",
        "of lift is the sum of a sine and an exponential that decays with angle of attack. At negative angles the",
        "exponential grows without bound, so lift and drag of this form are fitted only from 0 degrees up. The",
        "other three forms are fitted to all measurements. Among these three, the best by AICc (a corrected",
        "Akaike criterion) is in bold.",
        "",
        f"| wing | curve | {' | '.join(FORMS)} |",
        "|---|---|" + "---|" * len(FORMS),
    ]
    followed = 0
    for wing, curve in dict.fromkeys((verdict.wing, verdict.curve) for verdict in verdicts):
        own = [verdict for verdict in verdicts if (verdict.wing, verdict.curve) == (wing, curve)]
        best = min((v for v in own if v.form != "su-fan" and np.isfinite(v.aicc)), key=lambda v: v.aicc)
        followed += best.form == "cambered"
        lines.append(f"| {wing} | {curve} | {' | '.join(_cell(v, v is best) for v in own)} |")
    lift = [verdict for verdict in verdicts if (verdict.form, verdict.curve) == ("su-fan", "C_L")]
    told = sum(verdict.identified for verdict in lift)
    return [
        *lines,
        "",
        f"The data determine Su-Fan's form of lift for {told} of {len(lift)} wings, because only angles far beyond "
        "stall can distinguish the",
        f"exponential from the slow sine. The form `cambered` is the best by AICc for {followed} of the "
        f"{2 * len(lift)} curves. Beyond the",
        "measurements this form continues with the coefficients of a plate. If you measured a wing up to 25 "
        "degrees on both",
        "sides, use `cambered`. Dickinson's form is valid only within the measured range.",
    ]


def _cell(verdict: Verdict, best: bool) -> str:
    text = _number(verdict.r_squared, "{:.3f}") + ("" if verdict.identified else ", no")
    return f"**{text}**" if best else text
