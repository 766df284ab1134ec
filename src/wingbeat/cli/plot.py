"""``wingbeat plot``: draw one page of a saved orbit, flight or curve."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from wingbeat._base import KIND, FaultList, over_of
from wingbeat.animal.vehicle import Air
from wingbeat.cli.arguments import check_outputs, flag, option, written_to
from wingbeat.experiment import FlightPoints, read_flights
from wingbeat.plots import check_figure_name, power_page, save_figure, wingbeat_page
from wingbeat.plots.published import published_for
from wingbeat.records.inputs import vehicle_from
from wingbeat.records.result_files import load_dataset
from wingbeat.results.curve import Curve

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def plot(
    file: Annotated[Path, option("A file written by `orbit -o`, `simulate -o` or `curve -o`.")],
    *,
    output: Annotated[Path, written_to("The page: .png, .pdf or .svg.")],
    power: Annotated[bool, flag("Draw the parts of an orbit's power.")] = False,
    data: Annotated[Path | None, option("Your own measured flights (.csv) beside a curve, as in `curve`.")] = None,
) -> None:
    """Draw one page: wing motion, body pitch, power, phase portraits, angles of attack and forces.

    For a curve, draw power and frequency against speed, or power, amplitude and activation against frequency.

    Examples: wingbeat plot pigeon.nc -o pigeon.pdf; wingbeat plot pigeon.nc --power -o power.png
    """
    faults = FaultList()
    check_figure_name(faults, "--output", output)
    faults.raise_if_any()
    check_outputs(output)
    dataset = load_dataset(file)
    if data is not None and dataset.attrs[KIND] != "curve":
        faults.add("--data", str(data), f"belongs beside a curve, and {file.name} holds none", "give curve's file")
        faults.raise_if_any()
    elif data is not None:
        check_over_speed(faults, "--data", str(data), over_of(dataset.attrs))
        faults.raise_if_any()
    flights = None if data is None else read_flights(data)
    if power:
        page = power_page(dataset)
    else:
        page = page_of(Curve(dataset), flights) if dataset.attrs[KIND] == "curve" else wingbeat_page(dataset)
    save_figure(page, output)
    print(f"wrote {output}", file=sys.stderr)


def check_over_speed(faults: FaultList, option: str, value: object, over: str) -> None:
    """Note a fault if an option that belongs to curves over speed is given for another."""
    if over != "speed":
        faults.add(option, value, "belongs to a curve over speed", "leave it out")


def page_of(curve: Curve, flights: FlightPoints | None = None) -> Figure:
    """Return the page of a curve, with published measurements of the animal and the user's own flights."""
    if curve.over != "speed":
        return curve.plot()
    record, speed = curve.record(), curve.dataset["speed"].values
    vehicle = vehicle_from(record["vehicle"])
    beside = published_for(record["species"], vehicle, Air(**record["air"]), float(speed[0]), float(speed[-1]))
    return curve.plot(beside, flights)
