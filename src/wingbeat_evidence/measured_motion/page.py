"""The page on measured motions, in Markdown: the scores of every model and choice of terms."""

from __future__ import annotations

from collections.abc import Sequence

from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.measured_motion.comparison import Validation, ValidationRow
from wingbeat_evidence.measured_motion.scores import Score

_PAGE = """# Air loads on measured motions

`wingbeat validate -o docs/evidence/validation.md` writes this page: air loads on the strips of wings whose motion
was measured, beside the measured forces. For a case of your own, run `wingbeat validate my_case.toml`; the
docstring of `wingbeat_evidence.read_strip_case` describes its files. `--json` prints the scores of all rows.

- *Columns* of the tables of cases are terms: `thin-aerofoil` is rotation, added mass and their couples,
  `thin-aerofoil-wake` adds the lag of the wake. *Inflow* is that of momentum theory. Inflow and lag need a model
  that states its aspect ratio. The *recommended* row, bold, is chosen by the rule below, which never sees the
  measured force.
- *mean* and *peak*: computed over measured mean and largest force. *rms*: of the difference, divided by the
  weight. *rms about mean*: after each force has lost its own mean, divided by the rms of the measured force.
  *lag*: delay of the computed force, as a fraction of the beat. *power*: given to the air.
- The *best sine* is a constant plus a sine at the beat's frequency, fitted to the measured force. A row farther
  from the measurement explains little.

## The rule

1. Without a named kind of wing, a flyer below 2.5 g at a Reynolds number below 7000 has rigid wings, any other
   feathered ones.
2. Below a Reynolds number of 10 000, `dickinson`: the leading-edge vortex of a revolving wing stays attached
   ([Usherwood and Ellington 2002](https://doi.org/10.1242/jeb.205.11.1565)), and the polar includes induced flow.
3. Above, the model named after the kind of wing, else the plate, `su-fan`. In slow flight (below twice the induced
   speed of hover) it prefers a model measured on revolving wings of the same kind.
4. Above a reduced frequency of 0.1 (Leishman 2006: flow is unsteady from 0.05 to 0.2), rotation and added mass, if
   the flow is attached (angle of attack below that of the polar's largest lift) for 90 % of the beat, averaged over
   the wing area.
5. With them the lag of the wake where its theory holds (a straight wake, Theodorsen 1935, NACA Report 496): the
   polar was measured in straight flow and states an aspect ratio, and the speed is at least twice the induced speed
   of hover.
6. In slow flight, momentum inflow if the model states its aspect ratio.

## Recommended rows

{summary}

{cases}
## How

Rates of change of measured positions are slopes of a cubic smoothing spline, whose stiffness generalised
cross-validation ([Craven and Wahba 1979](https://doi.org/10.1007/BF01404567)) chooses, one for all strips; it
leaves the first four harmonics of the beat alone. If a motion does not repeat, exclude its less certain first and
last frames with `from` and `to`. Velocities are those of the material through still air. Positions that do not
advance are taken as measured in a wind tunnel.

The lag of the wake is that of a section ([air loads](../guide/air_loads.md#the-lag-of-the-wake)). No row includes
dynamic stall, or the influence of strips, or of fore and hind wing, on each other. Predicted flights are on
another page: [whole flights](whole_flights.md).
"""


def validation_text(found: Sequence[Validation], figures: Sequence[str]) -> str:
    """Return the page on measured motions as Markdown.

    Parameters
    ----------
    found : one result for each case.
    figures : the file name of the figure of each case.
    """
    cases = [_section(one, figure) for one, figure in zip(found, figures, strict=True)]
    return _PAGE.format(summary=markdown_table(_SUMMARY, map(_summary, found)), cases="\n".join(cases))


_TERMS = ("coefficients", "unsteady", "inflow")
_SCORES = ("mean", "peak", "rms", "rms about mean", "correlation", "lag")
_SUMMARY = ("case", "wing", "Re", "k", *_TERMS, *_SCORES, "power [W]")


def _summary(found: Validation) -> list[str]:
    row, regime, score = found.recommended, found.regime, found.recommended.fz
    numbers = (score.mean_ratio, score.peak_ratio, score.rms, score.rms_about_mean, score.correlation, score.lag)
    cells = [
        found.case.name,
        regime.wing + (" (guessed)" if regime.guessed else ""),
        f"{regime.reynolds:.0f}",
        f"{regime.reduced_frequency:.2f}",
        *_names(row),
    ]
    return [*cells, *map(_shown, numbers), f"{row.aerodynamic_power:.3g}"]


def _section(found: Validation, figure: str) -> str:
    # The summary gives kind of wing, Reynolds number and reduced frequency.
    lines = [f"## {found.case.name}", "", found.reason.partition(". ")[2], ""]
    for axis, label in (("fz", "Upward force"), ("fx", "Forward force")):
        scores = [getattr(row, axis) for row in found.rows]
        if any(value is not None for score in scores for value in score.to_dict().values()):
            has_series = any(score.rms_about_mean is not None for score in scores)
            shown = "mean, and in brackets rms about mean" if has_series else "mean"
            lines += [f"{label}: {shown}.", "", _by_terms(found.rows, scores, has_series), ""]
    said = found.to_dict()
    for axis, force in (("fz", "upward"), ("fx", "forward")):
        sine, noise = said["null_model"][axis], said["floor"][axis]
        if sine["rms"] is not None:
            about = "" if sine["rms_about_mean"] is None else f", about the mean {sine['rms_about_mean']:.2f}"
            error = "" if noise is None else f"; standard error of the measurement {noise:.2f} of the weight"
            lines += [f"Best sine, {force} force: rms {sine['rms']:.2f}{about}{error}.", ""]
    lines += [f"Note: {note}." for note in found.notes]
    lines += [""] * bool(found.notes)
    return "\n".join([*lines, f"![{found.case.name}: measured and computed force over the beat]({figure})", ""])


def _by_terms(rows: Sequence[ValidationRow], scores: Sequence[Score], has_series: bool) -> str:
    """Return the scores, a line for each coefficient model and a column for each choice of unsteady terms."""
    terms = list(dict.fromkeys(row.unsteady for row in rows))
    cells: dict[str, dict[str, list[str]]] = {}
    for row, score in zip(rows, scores, strict=True):
        name, unsteady, inflow = _names(row)
        cell = _shown(score.mean_ratio) + (f" ({_shown(score.rms_about_mean)})" if has_series else "")
        cell = f"**{cell}**" if row.recommended else cell
        own = cells.setdefault(name, {}).setdefault(unsteady, [])
        own.append(cell if inflow == "none" else f"inflow {cell}")
    lines = [[name, *(", ".join(own.get(one, ["-"])) for one in terms)] for name, own in cells.items()]
    return markdown_table(["model", *terms], lines)


def _names(row: ValidationRow) -> tuple[str, str, str]:
    return row.aero.coefficients.name, row.unsteady, row.aero.inflow


def _shown(value: float | None) -> str:
    return "-" if value is None else f"{value:z.2f}"
