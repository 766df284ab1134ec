"""Every option of every command is checked before the work: a bad value is refused while all work is forbidden."""

import importlib
import inspect
import shlex
import typing
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import pytest
from cyclopts import Parameter

from wingbeat.cli import main
from wingbeat.cli.app import COMMANDS, module_of
from wingbeat.cli.problem_options import ModelOptions

# A good command line for each function of the commands, to which one bad option is added.
LINES = {
    "orbit.orbit": "orbit pigeon --speed 9",
    "uncertainty.uncertainty": "uncertainty pigeon --speed 9",
    "glide.glide": "glide pigeon",
    "curve.curve": "curve pigeon --speeds 9 10",
    "pareto.pareto": "pareto pigeon --speed 9 --limits 1.1",
    "terms.terms": "terms pigeon --speed 9 --unsteady thin-aerofoil",
    "stability.stability": "stability pigeon --speed 9",
    "feedback.feedback": "feedback flight.nc",
    "manoeuvre.manoeuvre": "manoeuvre pigeon --speed 9 --to 10",
    "study.run": "study run study.toml",
    "study.export": "study export study.toml",
    "study.plot": "study plot study.toml -o page.png",
    "study.front": "study front study.toml --best speed=max mean_power=min",
    "simulate.simulate": "simulate pigeon",
    "species.show": "species pigeon",
    "species.new": "species new mine.toml --kind bird --mass 0.3 --wing-span 0.6 --wing-area 0.06",
    "polar.polar": "polar su-fan",
    "film.film": "film points.csv -o film.csv",
    "reduce.reduce": "reduce run.csv -o table.csv",
    "fit.fit": "fit good.csv",
    "validate.validate": "validate",
    "compare.compare": "compare flight.nc",
    "export.export": "export flight.nc -o gait.csv",
    "plot.plot": "plot flight.nc -o page.png",
    "view.view": "view flight.nc -o page.html --push",
    "explore.explore": "explore --static folder --animals pigeon",
    "app.app": "app --no-open",
    "paper.paper": "paper",
    "bench.bench": "bench",
    "show.show": "show flight.nc",
}
# What no bad option may reach.
WORK = (
    "wingbeat.orbits.solve.find_orbit",
    "wingbeat.orbits.solve.find_orbit",
    "wingbeat.orbits.solution.correct_guess",
    "wingbeat.results.curve.trace",
    "wingbeat.results.terms.trace",
    "wingbeat.results.flight.fly_beats",
    "wingbeat.mechanics.glide.GlideSolver.at",
    "wingbeat.stability.beat_feedback.linearise",
    "wingbeat.stability.manoeuvre_search.BeatMap.__init__",
    "wingbeat.cli.feedback.compute",
    "wingbeat.cli.feedback.feedback_in_beat",
    "wingbeat_evidence.commands.compare.compare_with_lattice",
    "wingbeat.cli.export.write_gait",
    "wingbeat.cli.view.write_page",
    "wingbeat_explorer.commands.explore.write_explorer",
    "wingbeat.cli.reduce.reduce_runs",
    "wingbeat.experiment.wing_fit.fit_curve",
    "wingbeat.cli.plot.save_figure",
    "wingbeat.studies.study.Study.run_on",
    "wingbeat.studies.study.Study.export",
    "wingbeat.bench.measure",
    "wingbeat_evidence.paper.treatments.solve_cases",
    "wingbeat.cli.polar.polar_columns",
    "wingbeat.animal.species.writing.species_text",
    "wingbeat_evidence.measured_motion.comparison.strip_motion",
    "wingbeat_explorer.app.server.serve",
)
# Bad values of options whose type does not say what is bad.
BAD = {
    "--set": ["nonsense=1", "wing.mass=nan"],
    "--gust": ["nonsense=1", "duration=-1", "w=nan"],
    "--noise": ["nonsense=1", "u=-1"],
    "--subject-to": ["nonsense<=1", "peak_power<=nan"],
    "--speeds": ["nan", "-3:9:1", "3:20:7"],
    "--to": ["nan", "1000"],
    "--limits": ["nan"],
    "--shares": ["nan", "0:2:1"],
    "--alpha": ["nan", "1:0:1"],
    "--samples": ["-7", "1000000000"],
    "--wind-seed": ["-7", "3000000000"],
    "paper.paper --output": ["kept.nc"],
    "--mode": ["-1 -o mode.nc", "9 -o mode.nc", "0"],
    "--dask": ["nonsense"],
    "--animals": ["nonsense"],
    "--host": ["'\t'"],
    "--seed": ["-7", "0.5"],
    "--output": ["page.nonsense"],
    "--static": ["kept.nc"],
    "--before": ["missing.json"],
    "--from": ["missing.nc"],
    "--kinematics": ["missing.csv"],
    "--sets": ["-7 assumptions"],
}
# The suffix of what --output writes, if it is not a result.
SUFFIXES = {
    **dict.fromkeys(("polar.polar", "plot.plot", "study.plot"), ".png"),
    **dict.fromkeys(("film.film", "reduce.reduce", "export.export", "study.export"), ".csv"),
    **{"fit.fit": ".toml", "validate.validate": ".md", "view.view": ".html"},
}
# Texts of which every one is good.
FREE = {"fit.fit --name", "fit.fit --citation", "study.plot --quantity"}
# Options that have no effect in the line above, and what makes them count.
BESIDE = {
    **{f"validate.validate {option}": "pigeon" for option in ("--model", "--draws", "--seed")},
    **{f"paper.paper {option}": "assumptions" for option in ("--sets", "--piece", "--only")},
    "simulate.simulate --wind-seed": "--turbulence light",
    "feedback.feedback --wind-seed": "--turbulence light",
    "simulate.simulate --plot-kinematics": "--kinematics missing.csv",
}


def types_of(hint: Any) -> set[type]:
    """Return the plain types in an annotation."""
    parts = typing.get_args(hint)
    return {hint} if not parts else set().union(*(types_of(part) for part in parts if part is not type(None)))


def options_of(hints: dict[str, Any], names: list[str]) -> dict[str, set[type]]:
    """Return the options of these parameters, with their types."""
    found = {}
    for name in names:
        hint = hints[name]
        base, *notes = typing.get_args(hint) if hasattr(hint, "__metadata__") else (hint,)
        while hasattr(base, "__metadata__"):
            base, *more = typing.get_args(base)
            notes += more
        if is_dataclass(base):
            continue
        given = [note.name for note in notes if isinstance(note, Parameter) and note.name]
        option = given[0] if given else ("--" + name.strip("_").replace("_", "-"),)
        option = option if isinstance(option, str) else option[0]
        found[option] = types_of(base)
    return found


def bad_of(types: set[type]) -> list[str]:
    """Return bad values of an option of these types."""
    if int in types:
        return ["-7", "1000000000", "1.5"]
    if float in types:
        return ["nan"]
    return [] if types == {bool} else ["page.nonsense" if Path in types else "nonsense"]


def unwritable(place: str, option: str, types: set[type]) -> list[str]:
    """Return a file in a folder that does not exist, if the option names a file that is written."""
    if Path not in types or option not in ("--output", "--plot", "--tornado", "--plot-kinematics"):
        return []
    suffix = SUFFIXES.get(place, ".nc") if option == "--output" else ".png"
    return [f"missing/page{suffix}"] if place != "paper.paper" else []


def cases() -> list[tuple[str, str, str]]:
    """Return a line of `LINES`, an option and a bad value for each option of each command."""
    found = []
    for place, _ in LINES.items():
        module, name = place.split(".")
        function = getattr(importlib.import_module(module_of(module)), name)
        signature = inspect.signature(function).parameters
        keyword = [n for n, p in signature.items() if p.kind is p.KEYWORD_ONLY]
        options = options_of(typing.get_type_hints(function, include_extras=True), keyword)
        if "model" in signature and "ModelOptions" in str(signature["model"].annotation):
            hints = typing.get_type_hints(ModelOptions, include_extras=True)
            options |= options_of(hints, [field.name for field in fields(ModelOptions)])
        for option, types in options.items():
            bad = BAD.get(f"{place} {option}", BAD.get(option, bad_of(types)))
            bad = [] if f"{place} {option}" in FREE else [*bad, *unwritable(place, option, types)]
            found += [(place, option, value) for value in bad]
    return found


@pytest.fixture
def forbidden(folder: Path, orbit_bytes: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder with an orbit and a study, and a ban on all work."""
    (folder / "flight.nc").write_bytes(orbit_bytes)
    (folder / "study.toml").write_text('species = "pigeon"\n[vary]\nspeed = { grid = [9.0, 10.0] }\n')

    def work(*_: Any, **__: Any) -> None:
        raise AssertionError("a bad option was let through to the work")

    for name in WORK:
        monkeypatch.setattr(name, work)


def test_every_command_is_here():
    assert {place.partition(".")[0] for place in LINES} == {*COMMANDS}


@pytest.mark.parametrize(("place", "option", "value"), cases())
def test_a_bad_option_is_refused_before_the_work(
    place: str, option: str, value: str, forbidden: None, capsys: pytest.CaptureFixture[str]
) -> None:
    line = LINES[place]
    words = shlex.split(line)
    if option in words:  # a required option: the bad value takes the place of the good one
        at = words.index(option)
        del words[at : at + 2]
    if option == "--output" and "-o" in words:
        at = words.index("-o")
        del words[at : at + 2]
    words += [*shlex.split(BESIDE.get(f"{place} {option}", "")), option, *shlex.split(value)]
    code = main(words)
    told = capsys.readouterr()
    assert (code, told.out) == (2, ""), told
    assert told.err.startswith("error: ")
