"""``wingbeat manoeuvre``: from one speed to others, beat by beat, with feedback on the way."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from wingbeat._base import FaultList
from wingbeat.cli import problem_options as options
from wingbeat.cli.arguments import Seed, Whole, check_files, check_outputs, figure, flag, option, several
from wingbeat.cli.terminal import deliver, plain_console, print_report, progress_bar
from wingbeat.orbits.options import Status
from wingbeat.results.flight import Flight
from wingbeat.results.orbit import solve_orbit
from wingbeat.stability.manoeuvres import Manoeuvre, check_manoeuvre
from wingbeat.stability.manoeuvres import manoeuvre as find
from wingbeat.stability.options import check_no_hinge
from wingbeat.stability.reports import manoeuvre_report


def manoeuvre(
    species: Annotated[str, option("Name or file of a species, or a saved orbit (.nc).")],
    *,
    speed: Annotated[
        float | None, option("Mean forward speed at the start [m/s]; 0 is hover. Not with a saved orbit.")
    ] = None,
    to: Annotated[list[float], several("Speeds to reach, one after the other [m/s]: 16 6 ...")],
    beats: Annotated[
        Whole | None, option("Number of beats to each speed. Default: for a mean acceleration of 1 m/s2, or more.")
    ] = None,
    delay: Annotated[Whole, option("Beats between a measurement and the beat that feedback changes.")] = 0,
    climb: options.Climb = 0.0,
    model: options.ModelOptions = options.DEFAULT_MODEL,
    starts: options.Starts = None,
    seed: Seed = 0,
    set_: options.Settings = None,
    gust: options.Gust = None,
    json: Annotated[bool, flag("Print the numbers as JSON and nothing else.")] = False,
    plot: Annotated[Path | None, figure("Draw the flight")] = None,
) -> int:
    """Find the beats that lead from an orbit to steady flights at other speeds, and fly them.

    The command prints the steady flights, and how the flight with feedback follows the plan. With --gust it flies
    through the gust, once with feedback and once without.
    Exit code 0: the manoeuvre is certified. 3: it is not.

    Examples: wingbeat manoeuvre pigeon --speed 6 --to 16 6 --plot manoeuvre.png;
    wingbeat manoeuvre pigeon --speed 8 --to 12 --gust w=2 start=1;
    wingbeat manoeuvre pigeon.nc --to 14 --delay 1
    """
    faults = FaultList()
    check_files(faults, None, plot=plot)
    check_manoeuvre(faults, to, beats, delay)
    faults.raise_if_any()
    check_outputs(plot)
    wind = options.wind_of(gust, None, 0, 0.0)  # a gust does not depend on the airspeed
    if species.endswith(".nc"):
        if (speed, model, climb, starts, seed, set_) != (None, options.DEFAULT_MODEL, 0.0, None, 0, None):
            fix = "give only --to, --beats, --delay, --gust, --json and --plot with it"
            faults.add("SPECIES", species, "is a saved orbit, which has its speed, model and settings", fix)
            faults.raise_if_any()
        orbit = options.saved_orbit(Path(species))
    else:
        if speed is None:
            faults.add("--speed", speed, "is missing", "give the speed at the start in m/s, or a saved orbit")
            faults.raise_if_any()
        problem = model.problem(species, float(speed or 0.0), set_, climb=climb)
        check_no_hinge(faults, problem.species.wingbeat)  # before the first orbit, which takes a while
        faults.raise_if_any()
        with progress_bar(f"{problem.species.name}, first orbit") as progress:
            orbit = solve_orbit(problem, starts, seed, progress)
        if orbit.status is not Status.CONVERGED:
            rule = f"has no certified orbit: {orbit.message}"
            faults.add("--speed", problem.speed, rule, "start at another speed")
            faults.raise_if_any()
    with progress_bar(f"{orbit.inputs['species']['name']}, beats") as progress:
        plan = find(orbit, to, beats=beats, delay=delay, progress=progress)
    flights: dict[str, Flight] = {}
    if plan.status is Status.CONVERGED:
        flights["with feedback"] = plan.fly(wind)
        if gust is not None:
            flights["without feedback"] = plan.fly(wind, feedback=False)
    page = (lambda: plan.plot(flights)) if flights else None
    return deliver(plan.record(), lambda: _print(plan, flights), bool(flights), json=json, plot=plot, page=page)


def _print(plan: Manoeuvre, flights: dict[str, Flight]) -> None:
    console = plain_console()
    print_report(manoeuvre_report(plan.record()), console)
    for name, flight in flights.items():
        told = "lost: it tumbles"
        if flight.completed:
            state, last = flight.states[-1], plan.ends[-1].state
            path = float(plan.beat_map.orbit.initial_state.z) + plan.beat_map.climb * flight.time[-1]
            height = f"{abs(state[1] - path):.2g} m from the path"
            told = f"ends {abs(state[3] - last[2]):.2g} m/s from the speed, {height}"
        console.print(f"{name}: {told}", soft_wrap=True)
