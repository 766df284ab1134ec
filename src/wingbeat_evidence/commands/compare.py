"""``wingbeat compare``: the air loads of a saved orbit beside those of another code on the same motion."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from wingbeat._base import FaultList
from wingbeat.cli.arguments import Whole, check_files, check_outputs, figure, flag
from wingbeat.cli.problem_options import saved_orbit
from wingbeat.cli.terminal import deliver, plain_console, progress_bar
from wingbeat_evidence.second_opinion import LatticeOptions, compare_with_lattice
from wingbeat_evidence.second_opinion.figure import second_opinion_page

_CODES = ("uvlm",)
_DEFAULT = LatticeOptions()


def compare(
    file: Annotated[Path, Parameter(help="A file written by `orbit -o`.")],
    *,
    with_: Annotated[
        str, Parameter(name="--with", help="The other code: uvlm, the unsteady vortex lattice of PteraSoftware.")
    ] = "uvlm",
    chordwise: Annotated[Whole, Parameter(help="Panels along the chord.")] = _DEFAULT.chordwise,
    spanwise: Annotated[Whole, Parameter(help="Panels along the span of one wing.")] = _DEFAULT.spanwise,
    steps: Annotated[Whole, Parameter(help="Time steps of a beat.")] = _DEFAULT.steps,
    beats: Annotated[
        Whole, Parameter(help="Beats flown from rest. All beats leave a wake; only the last beat is compared.")
    ] = _DEFAULT.beats,
    json: Annotated[bool, flag("Print the comparison as JSON and nothing else.")] = False,
    plot: Annotated[Path | None, figure("Draw lift and thrust over the beat")] = None,
) -> None:
    """Compute the air loads of a saved orbit with another code, and compare lift, thrust and power of the wings.

    The motion is that of the file; the body does not respond to the other code's loads. A vortex lattice assumes
    attached, inviscid flow, so it is wrong for strips beyond 15 degrees of angle of attack. Its panels are flat,
    turned up by the polar's angle without lift. The table also has our own loads on the same motion, with and
    without each of the terms of --unsteady and --inflow. The command needs the extra uvlm.

    Examples: wingbeat orbit pigeon --speed 12 -o pigeon.nc; wingbeat compare pigeon.nc --with uvlm --plot lift.png
    """
    faults = FaultList()
    faults.choice("--with", with_, _CODES)
    check_files(faults, None, plot=plot)
    faults.raise_if_any()
    options = LatticeOptions(chordwise, spanwise, steps, beats)
    orbit = saved_orbit(file)
    check_outputs(plot)
    with progress_bar("steps") as progress:
        opinion = compare_with_lattice(orbit, options, progress)
    record = opinion.record()
    deliver(record, lambda: _print(record), json=json, plot=plot, page=lambda: second_opinion_page(opinion))


def _print(record: dict[str, Any]) -> None:
    from rich.table import Table
    from rich.text import Text

    console = plain_console()
    about = f"{record['species']} at {record['speed']:.4g} m/s, compared with {record['code']}"
    console.print(f"{about}; both wings, one beat")
    table = Table(box=None, pad_edge=False)
    table.add_column("loads")
    heads = ("lift\n[N]", "thrust\n[N]", "power\n[W]", "lift delay\n[beat]", "lift, rms of\ndifference / weight")
    for head in heads:
        table.add_column(Text(head), justify="right", no_wrap=True)
    first = record["terms"][0]
    theirs = [f"{first[name]['theirs']:.4g}" for name in ("mean_lift", "mean_thrust", "aerodynamic_power")]
    table.add_row("vortex lattice", *theirs, "", "")
    for row in record["terms"]:
        mark = " *" if all(row[term] == record[term] for term in ("unsteady", "inflow")) else ""
        table.add_row(Text(_name(row) + mark), *_cells(row))
    console.print(table)
    console.print(
        "* marks the loads of the file; lift delay: how far the lattice's lift lags behind ours, in beats"
    )
    for row in record["terms"]:
        if "refused" in row:
            console.print(f"- {_name(row)}: {row['refused']}", style="yellow", markup=False)
    share = record["beyond_15_deg"]
    console.print(
        f"share of strips and instants beyond 15 deg of angle of attack: {share:.0%}; the lattice is wrong there, "
        "because it assumes attached, inviscid flow"
    )
    for code, label in (("ours", "our loads leave out"), ("theirs", "the lattice leaves out")):
        console.print(f"{label}: {'; '.join(record['left_out'][code])}")


def _name(row: dict[str, Any]) -> str:
    terms = [row[term] for term in ("unsteady", "inflow", "wake") if row[term] != "none"]
    return "ours, " + (" and ".join(terms) if terms else "coefficients alone")


def _cells(row: dict[str, Any]) -> list[str]:
    if "refused" in row:
        return ["none"] * 5
    means = [f"{row[name]['ours']:.4g}" for name in ("mean_lift", "mean_thrust", "aerodynamic_power")]
    return [*means, f"{row['lift_lag']:+.3f}", f"{row['lift_rms_difference']:.3f}"]
