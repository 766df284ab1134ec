"""The page on measured motions, in Markdown: the scores of every model and choice of terms."""

from __future__ import annotations

from collections.abc import Sequence

from wingbeat.measured_motion.comparison import Validation, ValidationRow
from wingbeat.measured_motion.scores import Score

_HEAD = """# Air loads on measured motions

`uv run wingbeat validate -o docs/evidence/validation.md` writes this page and computes every number in it. It takes
measured motions of wings, computes the air loads on the wings' strips, and compares the computed forces with the
measured ones. For a case of your own, run `wingbeat validate my_case.toml`; `wingbeat validate --help` and the
docstring of `wb.read_strip_case` describe its files.

## What is compared

- **Rows.** Each row is a coefficient model with a choice of terms. `thin-aerofoil` is rotation, added mass and
  their couples; `thin-aerofoil-wake` adds the lag of the wake. Each choice has one row without momentum inflow and
  one row with momentum inflow. Rows with inflow or lag need a model that states its aspect ratio.
- **Recommended.** The rule below recommends one row. It uses the Reynolds number, the reduced frequency, the kind
  of wing and the motion. It never sees the measured force, so the recommended row is not always the closest.
- **mean** is the computed mean force divided by the measured mean force, and **peak** is the largest computed force
  divided by the largest measured force.
- **rms** is the root mean square of the difference between the two forces, divided by the weight. For **rms about
  mean**, we first subtract from each force its own mean. We then divide the rms of the difference by the rms of
  the measured force.
- **lag** is the delay of the computed force behind the measured one, as a fraction of the beat.
- **power** is the mean power that the wings give to the air.
- The **best sine** is a constant plus a sine at the beat's frequency, both fitted to the measured force itself. A
  row that is farther from the measurement than the best sine explains little.

## The rule

1. The case may name the kind of wing. If it does not, a flyer below 2.5 g at a Reynolds number below 7000 counts as
   an insect with rigid wings, and any other flyer as a bird with feathered wings.
2. Below a Reynolds number of 10 000 the leading-edge vortex of a revolving wing stays attached, on wings of
   insects and hummingbirds alike ([Usherwood and Ellington 2002](https://doi.org/10.1242/jeb.205.11.1565)). The
   rule chooses `dickinson`, a polar of revolving wings. This polar already includes induced flow.
3. Above this Reynolds number, the rule chooses the model named after the kind of wing. If there is no such model,
   it chooses the plate, `su-fan`. In slow flight (below twice the induced speed of hover) it prefers a model
   measured on revolving wings of the same kind.
4. Above a reduced frequency of 0.1 the rule treats the flow as unsteady, and adds rotation and added mass.
   (Leishman 2006, Principles of Helicopter Aerodynamics, puts the beginning of unsteady flow between 0.05 and 0.2.)
5. Above the same reduced frequency the rule also adds the lag of the wake if the theory of this lag applies. The
   theory assumes a straight wake that the flow carries away (Theodorsen 1935, NACA Report 496). Three conditions
   must therefore be met:
   - the polar was measured in straight flow and states an aspect ratio;
   - the speed is at least twice the induced speed of hover;
   - the flow is attached for at least 90 % of the beat, averaged over the wing area. Flow counts as attached if
     the angle of attack, computed from the motion alone, is below the angle of the polar's largest lift.
6. In slow flight the induced flow in the polar of a finite wing is not the right one. If the model states its
   aspect ratio, the rule then adds momentum inflow.

"""

_TAIL = """## Derivatives of measured data

Added mass needs accelerations, and measured positions are noisy. Rates of change are therefore the slopes of a
cubic smoothing spline. Generalised cross-validation ([Craven and Wahba 1979](https://doi.org/10.1007/BF01404567))
chooses the spline's stiffness, one value for all strips. The spline leaves data without noise unchanged, and it
never smooths away the first four harmonics of the beat. If a motion repeats, the spline also uses frames of the
neighbouring beats. If a motion does not repeat, rates at its first and last frames are less certain. Exclude these
frames with `from` and `to` in the case.

Velocities in a case are those of the wing's material through still air. If a case has none, wingbeat differentiates
the positions. If the positions do not advance with the animal, wingbeat takes them as measured in a wind tunnel and
adds the flight speed.

## The lag of the wake

When the lift of a wing changes, the wing sheds vorticity into its wake, and the wake delays the change of lift.
Wagner's function describes this delay. Jones (1940, NACA Report 681) approximates this function with two states,
and each strip has two such states. The downwash at three quarters of the chord drives these states; past the angle
of largest lift, the polar's lift drives them instead. The wake moves the air at the
strip, and the angle of attack in this moving air gives the coefficients. With lift `2 pi sin(alpha)`, the result is
Theodorsen's lift with his C(k). In a motion that repeats, the states repeat too. In any other motion, the wake
starts as in steady flight.

The lag, like rotation and added mass, is computed for a wing section. A whole wing lags less than its sections:
[air loads](../guide/air_loads.md) says what that means for the robot `flapper-yeo2011`.

## Whole flights

`wingbeat validate pigeon` predicts flights; it does not compute loads on a given motion. See
[whole flights](whole_flights.md).

## What all rows leave out

No row includes the delay of stall in fast pitching. No row includes an influence of one strip on another, or of
the fore wing and the hind wing on each other.
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
    lines = [f"## {found.case.name}", "", found.reason, ""]
    for axis, label in (("fz", "Upward force"), ("fx", "Forward force")):
        if any(value is not None for row in found.rows for value in getattr(row, axis).to_dict().values()):
            rows = [_cells(row, getattr(row, axis)) for row in found.rows]
            lines += [f"{label}; the recommended row is bold:", "", *_table(_COLUMNS, rows), ""]
    said = found.to_dict()
    for axis, force in (("fz", "upward"), ("fx", "forward")):
        sine, noise = said["null_model"][axis], said["floor"][axis]
        if sine["rms"] is not None:
            text = f"The best sine has an rms of {sine['rms']:.2f} for the {force} force"
            about = sine["rms_about_mean"]
            text += "." if about is None else f" and an rms about mean of {about:.2f}."
            text += "" if noise is None else f" The standard error of the measurement is {noise:.2f} of the weight."
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
