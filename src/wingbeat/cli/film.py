"""``wingbeat film``: tracked points to a film of the wing's angles."""

from __future__ import annotations

import functools
import shlex
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Literal

from wingbeat._base import FaultList, written
from wingbeat.cli.arguments import as_typed, check_apart, check_outputs, figure, flag, option, written_to
from wingbeat.cli.terminal import answer
from wingbeat.experiment.point_angles import angles_from_points
from wingbeat.experiment.point_strips import save_strips, strips_table
from wingbeat.plots import check_figure_name, points_page


def film(
    file: Annotated[Path, option("Tracked points in 3-D: .csv, .tsv, .trc, .c3d, NetCDF of movement.", "POINTS")],
    /,
    *,
    output: Annotated[Path | None, written_to("The film: .csv, for --kinematics.")] = None,
    points: Annotated[
        str | None,
        option(
            "Which point is what: in the file's order, shoulder,wrist,tip,trailing (an empty word skips a point); "
            "or shoulder=pt1,tip=pt3; or a .toml of such pairs. Default: usual names, such as left_wrist."
        ),
    ] = None,
    frame_rate: Annotated[float | None, option("Frames per second [Hz], if the file does not say.")] = None,
    side: Annotated[
        Literal["left", "right", "both"] | None, option("The wing that was tracked, or the one to use.")
    ] = None,
    up: Annotated[
        str | None,
        option("The file's vertical axis, z or -y, or a direction: 0.1,-0.99,0.05; default: found.", signed=True),
    ] = None,
    forward: Annotated[
        str | None, option("The file's axis in which the animal flies; default: found.", signed=True)
    ] = None,
    units: Annotated[Literal["m", "cm", "mm"] | None, option("Unit of the coordinates; default: found.")] = None,
    semi_span: Annotated[
        float | None, option("Shoulder to tip of the spread wing [m]; default: the beat's largest.")
    ] = None,
    strips: Annotated[
        Path | None, option("Write a case (.toml) for validate: strips of the mean beat. Needs --mass.")
    ] = None,
    mass: Annotated[float | None, option("With --strips: mass of the animal [kg].")] = None,
    plot: Annotated[Path | None, figure("Draw points, wing and angles")] = None,
    json: Annotated[bool, flag("Print one JSON object and nothing else.")] = False,
) -> None:
    """Turn tracked points into a film: flap, pitch, sweep, fold and span of a wing, and the path of the body.

    Reads tables with three columns for each point (DLTdv, Argus, Anipose, DeepLabCut, Vicon), OpenSim .trc,
    Qualisys .tsv, C3D, and NetCDF of movement. Directions and the unit are found from the points, and every guess
    is printed; what cannot be found is refused, with the option that states it. The film then goes through orbit
    and simulate.

    Examples: wingbeat film xyzpts.csv -o film.csv --points shoulder,wrist,tip --frame-rate 500 --side left;
    wingbeat simulate pigeon --kinematics film.csv
    """
    faults = FaultList()
    if output is not None and output.suffix.lower() != ".csv":
        faults.add("--output", str(output), "is not a film", "end it in .csv")
    if strips is not None and strips.suffix.lower() != ".toml":
        faults.add("--strips", str(strips), "is not a case", "end it in .toml")
    if (strips is None) != (mass is None):
        rule = "is missing: the wings hold up the weight" if mass is None else "has no effect without --strips"
        faults.add("--mass", mass, rule, "give --strips and --mass together")
    if plot is not None:
        check_figure_name(faults, "--plot", plot)
    table = None if strips is None else strips_table(strips)
    written = [("--output", output), ("--strips", strips), ("--strips", table), ("--plot", plot)]
    check_apart(faults, written, file, points)
    faults.raise_if_any()
    check_outputs(output, plot, strips, table)
    found = angles_from_points(
        file,
        points,
        frame_rate=frame_rate,
        side=side,
        up=up,
        forward=forward,
        units=units,
        semi_span=semi_span,
    )
    assumed: list[str] = []
    with answer() as given:
        told = found.record()
        given.tell(told, functools.partial(print, "\n".join(_lines(told))), json)
        for note in found.notes:
            kind = "warning" if note in found.warnings else "note"
            print(f"{kind}: {note}", file=sys.stderr)
        given.save(output, found.save, named=True)
        if strips is not None and mass is not None:
            case, weighs = strips, mass
            given.save(case, lambda path: assumed.extend(save_strips(found, path, weighs)), named=True)
            for one in assumed:
                print(f"note: {case.name}: {one}", file=sys.stderr)
        given.draw(plot, lambda: points_page(found), named=True)
        if output is not None and not json:
            last = f"wingbeat simulate SPECIES {shlex.join(as_typed(kinematics=output))} --model animal"
            given.show(lambda: print(f"next, is it trimmed, and which force is missing: {last}"))


def _lines(told: Mapping[str, Any]) -> list[str]:
    """Return lines with the means and amplitudes of a wing's angles, and what was guessed."""
    lines = [f"frequency: {written(told['frequency'], told['frequency_se'], 'Hz')}"]
    for name in ("flap", "pitch", "sweep", "fold", "tip_pitch"):
        for what in ("mean", "amplitude"):
            if (value := told.get(f"{name}_{what}_deg")) is not None:
                error = told[f"{name}_{what}_deg_se"]
                lines.append(f"{name.replace('_', ' ')} {what}: {written(value, error, 'deg')}")
    lines.append(f"stroke plane: {written(told['stroke_plane_deg'], told['stroke_plane_deg_se'], 'deg')}")
    share = written(told["downstroke_fraction"], told["downstroke_fraction_se"])
    return [*lines, f"downstroke fraction: {share}", f"{told['frames_used']} of {told['frames']} frames used"]
