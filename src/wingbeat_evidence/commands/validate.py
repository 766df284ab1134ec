"""``wingbeat validate``: air loads on measured motions, and whole flights, against what was measured."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from wingbeat._base import FaultList, FileError, read_text, toml_tables, write_atomically
from wingbeat._workers.tuning import core_count
from wingbeat.aero import EXTENSIONS
from wingbeat.aero.completion import VITERNA
from wingbeat.animal.species.making import load_species
from wingbeat.cli.arguments import Whole, check_files, check_outputs, figure, flag, written_to
from wingbeat.cli.process import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.terminal import answer, plain_console, print_report, progress_bar
from wingbeat_evidence.measured_motion import Validation, read_strip_case, shipped_cases
from wingbeat_evidence.measured_motion import validate as validated
from wingbeat_evidence.measured_motion.figure import validation_page
from wingbeat_evidence.measured_motion.page import validation_text
from wingbeat_evidence.measured_motion.report import validation_report
from wingbeat_evidence.whole_flights import (
    Prediction,
    compared,
    measured_animals,
    predict_flights,
    read_measured_flights,
)
from wingbeat_evidence.whole_flights.figure import flights_page
from wingbeat_evidence.whole_flights.page import flight_text
from wingbeat_evidence.whole_flights.report import prediction_report


def validate(
    case: Annotated[
        str | None,
        Parameter(
            help="A strip-motion case (.toml), an animal whose flights were measured, or a file of measured "
            "flights (.toml). If left out: the strip-motion cases of the package."
        ),
    ] = None,
    /,
    *,
    aero: Annotated[
        list[str] | None,
        Parameter(
            negative=(),
            help="Coefficients: su-fan, dickinson, ..., a table (.csv), a polar (.pol, .dat, ...) or a fit "
            "(.toml); repeat for several. If left out: all models.",
        ),
    ] = None,
    extension: Annotated[
        str | None,
        Parameter(
            help=f"Extension to angles outside the fit, for all models: {', '.join(EXTENSIONS)}; viterna completes "
            "polars that end at the stall."
        ),
    ] = None,
    unsteady: Annotated[
        str | None,
        Parameter(
            help="Unsteady terms: none, thin-aerofoil or thin-aerofoil-wake, which adds the lag of the wake. If "
            "left out: a row for each."
        ),
    ] = None,
    inflow: Annotated[
        str | None, Parameter(help="Induced flow: none or momentum. If left out: a row for each.")
    ] = None,
    induced_factor: Annotated[
        float | None, Parameter(help="Ratio of induced power to that of an ideal disc; default 1.2.")
    ] = None,
    model: Annotated[
        str | None, Parameter(help="Whole flights: the model, animal or paper; default animal.")
    ] = None,
    draws: Annotated[
        Whole | None,
        Parameter(
            help="Whole flights: number of random draws of the animal's numbers. The band of each predicted "
            "quantity goes from the 10th to the 90th percentile of the certified draws. Default 0: no band."
        ),
    ] = None,
    seed: Annotated[Whole | None, Parameter(help="Whole flights: seed of starts and draws; default 0.")] = None,
    json: Annotated[bool, flag("Print one JSON object and nothing else.")] = False,
    plot: Annotated[Path | None, figure("Draw the comparison")] = None,
    output: Annotated[Path | None, written_to("Write the page (.md), with a figure of each case.")] = None,
) -> int:
    """Compute air loads on a measured motion, or an animal's whole flights, and compare them with measurements.

    With a strip-motion case, or if no case is named, the command computes the loads of every coefficient model.

    The rows of a coefficient model add terms step by step: no terms, then rotation and added mass, then the lag of
    the wake, each with and without momentum inflow. One row is recommended, by a rule that never sees the measured
    force. A case is a TOML file with tables of strips and forces (.csv) beside it. With `--json`, several cases are
    a list under `cases`.

    With an animal, the command predicts its flights at the measured speeds by a model; nothing is fitted. Exit
    code 3: none of these flights is certified.

    Examples: wingbeat validate case.toml --aero su-fan --plot case.png; wingbeat validate -o
    docs/evidence/validation.md; wingbeat validate pigeon --draws 100 -o pigeon.md
    """
    faults = FaultList()
    if output is not None and output.suffix.lower() != ".md":
        faults.add("--output", str(output), "is not a page", "end it in .md")
    if plot is not None and case is None:
        faults.add("--plot", str(plot), "draws one case", "name the case, or write the page with -o")
    if extension is not None:
        faults.choice("--extension", extension, (*EXTENSIONS, VITERNA))
        if extension == VITERNA and aero is None:
            rule = "completes a table that ends at the stall, and the models of the package need no completion"
            faults.add("--extension", extension, rule, "give --aero with a polar")
    check_files(faults, output, plot=plot)
    loads = {"--aero": aero, "--extension": extension, "--unsteady": unsteady, "--inflow": inflow}
    loads |= {"--induced-factor": induced_factor}
    flights = {"--model": model, "--draws": draws, "--seed": seed}
    whole = case is not None and _is_whole_flights(case)
    for name, value in (loads if whole else flights).items():
        if value is not None:
            faults.add(name, value, f"does not apply to {'whole flights' if whole else 'strip-motion cases'}")
    faults.raise_if_any()
    if case is not None and whole:
        return _validate_flights(case, model or "animal", draws or 0, seed or 0, json, plot, output)
    paths = shipped_cases() if case is None else [Path(case)]
    cases = [read_strip_case(path) for path in paths]
    pictures = [] if output is None else [output.with_name(f"{output.stem}_{_slug(one.name)}.png") for one in cases]
    check_outputs(output, plot, *pictures)
    factor = 1.2 if induced_factor is None else induced_factor
    found = [validated(one, aero, unsteady, inflow, factor, extension) for one in cases]
    with answer() as given:
        said = [one.to_dict() for one in found]
        record = {"cases": said, "whole_flights": measured_animals()} if case is None else said[0]
        given.tell(record, lambda: _print(found, case is None), json)
        given.draw(plot, lambda: validation_page(found[0]), named=True)
        if output is not None:
            page = validation_text(found, [picture.name for picture in pictures])
            given.save(output, lambda path: write_atomically(path, page), named=True)
        for picture, one in zip(pictures, found, strict=False):
            given.draw(picture, lambda one=one: validation_page(one), named=True)
    return EXIT_GOOD


def _print(found: list[Validation], every: bool) -> None:
    """Print the comparisons; after those of every case of the package, the animals with measured flights."""
    for one in found:
        print_report(validation_report(one))
    if every:
        animals = ", ".join(measured_animals())
        plain_console().print(f"For `wingbeat validate ANIMAL`, animals with measured whole flights: {animals}")


def _slug(name: str) -> str:
    """Return a text reduced to letters and digits, as part of a file name."""
    return "".join(sign if sign.isascii() and (sign.isalnum() or sign in "-_") else "-" for sign in name)[:80]


# --- whole flights ---

# So many draws are worth the start of another process.
_WORTH_A_PROCESS = 200


def _is_whole_flights(case: str) -> bool:
    """Say whether a case is an animal, or a file of its measured flights."""
    if case in measured_animals():
        return True
    try:
        return "measured" in toml_tables(read_text(case), case)
    except FileError:
        return False


def _validate_flights(
    case: str, model: str, draws: int, seed: int, json: bool, plot: Path | None, output: Path | None
) -> int:
    """Fly an animal at its measured speeds and print, draw or write the comparison."""
    faults = FaultList()
    faults.choice("--model", model, ("paper", "animal"))
    faults.raise_if_any()
    picture = None if output is None else output.with_suffix(".png")
    check_outputs(output, plot, *([] if picture is None else [picture]))
    flights = read_measured_flights(case)
    processes = max(1, min(core_count(), draws // _WORTH_A_PROCESS))
    with progress_bar("flights") as progress:
        found = predict_flights(flights, model, draws, seed, processes, progress)
    with answer() as given:
        given.tell(plain_flights(found), prediction_report(found), json)
        given.draw(plot, lambda: flights_page(found), named=True)
        if output is not None and picture is not None:
            name = load_species(flights.species).common_name
            text = flight_text(found, picture.name, name or flights.species)
            given.save(output, lambda path: write_atomically(path, text), named=True)
            given.draw(picture, lambda: flights_page(found), named=True)
    return EXIT_GOOD if any(one.values for one in found.flown) else EXIT_NOT_CERTIFIED


def plain_flights(found: Prediction) -> dict[str, Any]:
    """Return a prediction and its comparison as plain values, fit for JSON."""
    scores = [vars(score) | {"measurement": vars(score.measurement)} for score in compared(found)]
    about = {"species": found.flights.species, "minimum_power_speed": found.minimum_power_speed}
    return about | found.plain() | {"compared": scores}
