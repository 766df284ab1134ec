"""The page on measured motions, in Markdown: the scores of every model and choice of terms."""

from __future__ import annotations

from collections.abc import Sequence

from wingbeat.measured_motion.comparison import Validation, ValidationRow
from wingbeat.measured_motion.scores import Score

_HEAD = """# Air loads on measured motions

`uv run wingbeat validate -o docs/validation.md` writes this page and computes every number in it. It moves
strips of a wing as they were measured, and compares the computed forces with the measured ones. For a case
of your own, write `wingbeat validate my_case.toml`; `wingbeat validate --help` and the docstring of
`wb.read_strip_case` describe its files.

## What is compared

- **Rows.** Each row is a coefficient model with a choice of terms. `thin-aerofoil` is rotation, added mass and
  their couples; `thin-aerofoil-wake` adds the lag of the wake. Each goes with or without momentum inflow.
  Inflow and lag need a model that states its aspect ratio.
- **Recommended.** A written rule chooses one row, from the Reynolds number, the reduced frequency, the kind of
  wing and the speed. It never sees the measured force, so the recommended row is not always the closest.
- **Mean** is the computed mean force over the measured one, **peak** the computed largest force over the measured
  one. **rms** is the root mean square of the difference between the two forces, over the weight. For **rms about
  mean**, each force is taken about its own mean: it is the rms of the difference over the rms of the measured
  force. **lag** is the share of a beat by which the computed force comes late.
- **Power** is the mean power that the wings give to the air.
- **Best sine** is a mean and a sine at the beat's frequency, fitted to the measured force itself. A model of the
  air that is farther from the measurement than this has explained little.

## The rule

1. The case names the kind of wing. If it does not, a flyer below 2.5 g at a Reynolds number below 7000 counts as
   an insect with rigid wings, any other as a bird with feathered ones.
2. Below a Reynolds number of 10 000 the vortex on the leading edge of a wing that turns about its root stays
   attached, on wings of insects and hummingbirds alike ([Usherwood and Ellington
   2002](https://doi.org/10.1242/jeb.205.11.1565)). The rule takes the polar of a revolving wing, `dickinson`,
   which includes the induced flow.
3. Above it, the rule takes the model named after the kind of wing if there is one, or else the plate, `su-fan`. In
   slow flight, below twice the induced speed of hover, a model of revolving wings of this kind comes first.
4. Above a reduced frequency of 0.1 it adds rotation and added mass (Leishman 2006, Principles of Helicopter
   Aerodynamics, draws the line between 0.05 and 0.2).
5. It also adds the lag of the wake if the assumption of the theory holds: a straight wake that stays behind the
   flyer (Theodorsen 1935, NACA Report 496). So the model must state an aspect ratio, as models measured in straight
   flow do. The speed must be at least twice the induced speed of hover. And for nine tenths of the beat, weighted
   by area, the angle of attack of the motion must be below that of the polar's largest lift.
6. In slow flight it adds momentum inflow if the model states its aspect ratio, because the polar of a finite wing
   does not include the right induced flow there.

"""

_TAIL = """## Derivatives of measured data

Added mass needs accelerations, and measured positions contain noise. Rates of change are the slopes of a cubic
smoothing spline whose stiffness generalised cross-validation chooses ([Craven and Wahba
1979](https://doi.org/10.1007/BF01404567)), one stiffness for all strips. Exact data pass unchanged, and the
first four harmonics of the beat are never smoothed away. A motion that repeats is continued on both sides. In
others, the first and last frames are less certain: leave them out with `from` and `to`.

Velocities in a case are those of points fixed in the wing, through still air. If a case has none, its positions
are differentiated. If these positions do not advance with the animal, as in a wind tunnel, the speed is added.

## The lag of the wake

When the lift of a wing changes, the wing sheds vorticity, and this slows the change. Each strip has the two states
of Jones's form of Wagner's function (Jones 1940, NACA Report 681), driven by the downwash at three quarters of the
chord. Past the angle of the polar's largest lift, the polar's lift drives them instead. The polar is read at the
angle of attack in the air that the wake moves. With lift `2 pi sin(alpha)` this is Theodorsen's lift with his C(k).
In a motion that repeats, the states repeat too; in any other, the wake starts as in steady flight.

The lag is that of a section, as rotation and added mass are. A whole wing lags less than its sections: [air
loads](air_loads.md) says what that means for the robot.

## Whole flights

`wingbeat validate pigeon` predicts flights instead of computing loads on a given motion: see
[whole flights](whole_flights.md).

## What no row includes

No row includes stall that comes late in fast pitching. Strips do not influence each other, and neither do fore wing
and hind wing.
"""


def validation_text(found: Sequence[Validation], figures: Sequence[str]) -> str:
    """Return the page on measured motions as Markdown.

    Parameters
    ----------
    found : one result for each case.
    figures : the file name of the figure of each case.
    """
    summary = ["## Recommended rows", "", *_table(_SUMMARY, [_summary(one) for one in found]), ""]
    parts = [_section(one, figure) for one, figure in zip(found, figures, strict=True)]
    return _HEAD + "\n".join(summary) + "\n" + "\n".join(parts) + "\n" + _TAIL


_TERMS = ("coefficients", "unsteady", "inflow")
_SUMMARY = ("case", "wing", "Re", "k", *_TERMS, "mean", "rms", "rms about mean")
_COLUMNS = (*_TERMS, "mean", "peak", "rms", "rms about mean", "correlation", "lag", "power [W]")


def _summary(found: Validation) -> list[str]:
    row, regime = found.recommended, found.regime
    numbers = [f"{regime.reynolds:.0f}", f"{regime.reduced_frequency:.2f}"]
    scores = [_shown(value) for value in (row.fz.mean_ratio, row.fz.rms, row.fz.rms_about_mean)]
    return [found.case.name, regime.wing, *numbers, *_names(row), *scores]


def _section(found: Validation, figure: str) -> str:
    lines = [f"## {found.case.name}", "", f"Recommended: {found.reason}.", ""]
    for axis, label in (("fz", "Upward force"), ("fx", "Forward force")):
        if any(value is not None for row in found.rows for value in getattr(row, axis).to_dict().values()):
            rows = [_cells(row, getattr(row, axis)) for row in found.rows]
            lines += [f"{label}; the recommended row is bold:", "", *_table(_COLUMNS, rows), ""]
    said = found.to_dict()
    for axis, force in (("fz", "upward"), ("fx", "forward")):
        sine, noise = said["null_model"][axis], said["floor"][axis]
        if sine["rms"] is not None:
            text = f"The best sine differs from the measured {force} force by an rms of {sine['rms']:.2f} weights"
            about = sine["rms_about_mean"]
            text += "." if about is None else f"; without both means, by {about:.2f} of the measured rms."
            text += "" if noise is None else f" The measurement's own standard error is {noise:.2f} weights."
            lines += [text, ""]
    lines += [f"Note: {note}." for note in found.notes]
    lines += [""] * bool(found.notes)
    return "\n".join([*lines, f"![{found.case.name}]({figure})", ""])


def _cells(row: ValidationRow, score: Score) -> list[str]:
    numbers = (score.mean_ratio, score.peak_ratio, score.rms, score.rms_about_mean, score.correlation, score.lag)
    cells = [*_names(row), *map(_shown, numbers), f"{row.aerodynamic_power:.3g}"]
    return [f"**{cell}**" for cell in cells] if row.recommended else cells


def _names(row: ValidationRow) -> list[str]:
    return [row.aero.coefficients.name, row.unsteady, row.aero.inflow]


def _shown(value: float | None) -> str:
    return "-" if value is None else f"{value:z.2f}"


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    lines = [heads, ["---"] * len(heads), *rows]
    return ["| " + " | ".join(cells) + " |" for cells in lines]
