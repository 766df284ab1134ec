"""``wingbeat glide``: the steady glides with the wings held still."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import numpy as np

from wingbeat._base import NOMENCLATURE, FaultList, for_people
from wingbeat.cli.arguments import Output, check_outputs, check_result, figure, flag, option, parse_range
from wingbeat.cli.problem_options import DEFAULT_MODEL, SPECIES, ModelOptions, Payload, Settings
from wingbeat.cli.terminal import deliver, plain_console
from wingbeat.plots import glide_page
from wingbeat.results.glide import GlidePolar, glide_polar

# The head of each column, and what of a glide stands in it.
_HEADS = {"alpha": "angle_of_attack", "speed": "speed", "sink": "sink", "ratio": "glide_ratio"}
_HEADS |= {"path": "glide_angle", "body": "body_pitch", "wing": "wing_pitch", "flap": "flap"}
_HEADS |= {"tail": "tail_moment", "hold": "flap_torque"}


def glide(
    species: Annotated[str, SPECIES],
    *,
    alpha: Annotated[str, option("Angles of attack at the wing's root [deg], start:stop:step.")] = "1:30:1",
    flap_deg: Annotated[float, option("Flap angle at which the wings are held, up positive [deg].")] = 0.0,
    trim: Annotated[
        str, option("What turns to trim the pitching moment: body-pitch, flap or (if there is one) tail.")
    ] = "body-pitch",
    model: ModelOptions = DEFAULT_MODEL,
    set_: Settings = None,
    payload: Payload = 0.0,
    json: Annotated[bool, flag("Print the polar as JSON and nothing else.")] = False,
    output: Output = None,
    plot: Annotated[Path | None, figure("Draw the polar")] = None,
) -> int:
    """Find the steady glides of an animal with its wings held still, and the slowest sink and flattest path.

    If no angle trims the pitching moment, the table shows the moment that a tail would need to supply.
    Exit code 3: no steady glide at any of the angles.

    Examples: wingbeat glide pigeon --plot glide.png; wingbeat glide pigeon --trim flap --payload 0.03
    """
    faults = FaultList()
    check_result(faults, output, *model.files, plot=plot)
    faults.raise_if_any()
    angles = parse_range(alpha, "--alpha")
    if not 0 < angles[0] <= angles[-1] <= 90 or (np.diff(angles) < 0).any():
        faults.add("--alpha", alpha, "must rise from above 0 to at most 90 degrees", "for example 1:30:1")
    if not -90 < flap_deg < 90:
        faults.add("--flap-deg", flap_deg, "must be between -90 and 90 degrees")
    faults.raise_if_any()
    animal, whole = model.flown(species, set_, payload)
    loads = whole.gliding if model.aero is None else whole.aero
    check_outputs(output, plot)
    polar = glide_polar(animal, loads, np.radians(angles), math.radians(flap_deg), trim)
    return deliver(
        polar.record(),
        lambda: _print(polar),
        any(math.isfinite(one.speed) for one in polar.glides),
        json=json,
        output=output,
        save=polar.save,
        plot=plot,
        page=lambda: glide_page(polar.dataset),
    )


def _print(polar: GlidePolar) -> None:
    from rich.table import Table
    from rich.text import Text

    console = plain_console()
    table = Table(box=None, pad_edge=False)
    for head, name in _HEADS.items():
        unit = for_people(NOMENCLATURE[name].unit)[1] or "-"
        table.add_column(Text(f"{head}\n[{unit}]"), justify="right", no_wrap=True)
    for one in polar.glides:
        angles = (one.glide_angle, one.body_pitch, one.wing_pitch, one.flap)
        numbers = [f"{value:.2f}" for value in (one.speed, one.sink, one.glide_ratio)]
        numbers += [f"{math.degrees(angle):z.1f}" for angle in angles]
        numbers += ["-" if one.trimmed else f"{one.tail_moment:.4f}", f"{one.flap_torque:.3f}"]
        shown = numbers if math.isfinite(one.speed) else ["none"] * len(numbers)
        table.add_row(f"{math.degrees(one.angle_of_attack):.4g}", *shown)
    console.print(table)
    for label, best in (("slowest sink", polar.least_sink), ("flattest glide", polar.best_ratio)):
        told = "not within the given angles"
        if best is not None:
            alpha = f"angle of attack {math.degrees(best.angle_of_attack):.2f} deg"
            told = f"{best.sink:.3f} m/s at {best.speed:.2f} m/s, ratio {best.glide_ratio:.3f}, {alpha}"
        console.print(f"{label}: {told}")
    console.print(
        "path: angle below the horizontal; tail: moment that a tail must supply; hold: flap torque of both wings"
    )
    for warning in polar.record()["warnings"]:
        console.print(f"- {warning}", style="yellow")
