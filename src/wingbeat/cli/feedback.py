"""``wingbeat feedback``: the feedback that holds a saved orbit from beat to beat, and gusts flown with it."""

from __future__ import annotations

import functools
import math
from pathlib import Path
from typing import Annotated, Any

from wingbeat._base import FaultList, Line, heading
from wingbeat.cli.arguments import Whole, check_files, check_outputs, figure, flag, named_numbers, option, several
from wingbeat.cli.problem_options import Gust, Turbulence, WindSeed, saved_orbit, wind_of
from wingbeat.cli.terminal import deliver, plain_console, print_report, progress_bar
from wingbeat.plots import gust_page
from wingbeat.records.judgements import conditions_of
from wingbeat.stability.beat_feedback import Feedback
from wingbeat.stability.beat_feedback import feedback as compute
from wingbeat.stability.gust_flights import GustFlight, fly_gust
from wingbeat.stability.many_flights import MOST_FLIGHTS, GustSurvey, survey_gusts
from wingbeat.stability.options import MOST_DELAY, check_delay, check_inputs, check_noise
from wingbeat.stability.reports import STATE_UNITS, beats_of, feedback_report, survey_report

FREE, HELD = "no feedback", "feedback"
# The gust that is flown if none is given: upward at 2 m/s, for 0.3 s.
_GUST = ["w=2", "duration=0.3"]
_ADVICE = (
    "The gains are those of small deviations, and this gust leads beyond them. A weaker gust (--gust w=1), "
    "feedback in the same beat (--delay 0) or a gait that is stable by itself (wingbeat orbit ... --stable) may "
    "survive."
)


def feedback(
    source: Annotated[Path, option("A saved orbit (.nc).", "ORBIT")],
    *,
    inputs: Annotated[
        list[str] | None,
        several(
            "Parameters of the wingbeat that change from beat to beat: frequency pitch_mean ... Default: "
            "the free parameters whose jumps harmonics can undo."
        ),
    ] = None,
    delay: Annotated[Whole, option("Beats between a measurement and the beat that it changes.")] = 0,
    late: Annotated[
        Whole,
        option("Further beats by which the inputs are late in the flights; the feedback is computed without them."),
    ] = 0,
    gust: Gust = None,
    turbulence: Turbulence = None,
    wind_seed: WindSeed = 0,
    beats: Annotated[Whole, option("Number of wingbeats of each flight.")] = 30,
    noise: Annotated[
        list[str] | None,
        several("Standard deviations of the sensors: z=0.02 body_pitch=0.01 u=0.1 ... [m, rad, m/s, rad/s]."),
    ] = None,
    survey: Annotated[Whole, option("Number of random gusts of up to 5 m/s to survey; 0 for none.")] = 0,
    seed: Annotated[Whole, option("Seed of the noise and of the surveyed gusts.")] = 0,
    json: Annotated[bool, flag("Print the numbers as JSON and nothing else.")] = False,
    plot: Annotated[Path | None, figure("Draw flights and survey")] = None,
) -> int:
    """Compute the feedback that holds a saved orbit from beat to beat, and fly it through a gust.

    The command prints gains, multipliers with and without feedback, every input that can hold the orbit alone, and
    a flight through the gust with and without feedback. Without --gust and --turbulence the gust is w=2
    duration=0.3. --survey flies random gusts and prints the share survived. A flight is lost if its body pitch is
    60 degrees from the orbit's, or if it sinks 5 m below the orbit's path.

    The table of gains prints the change of each input per unit of a deviation, with angles in degrees. The `gains`
    of --json have the opposite sign, as in control theory: inputs = -gains times deviations.

    --json prints, in SI units and radians: species speed climb frequency dt state inputs delay gains (a row for
    each of inputs, a column for each of gain_columns) gain_columns cost lower upper multipliers spectral_radius
    open_loop controllability sufficient version; late and beats;
    flights by name ("no feedback", "feedback"), each with completed survived largest_pitch lowest highest
    settled_beats; and survey (null without --survey) with flights beats largest_gust survived by_size by_direction.
    Exit code 3: the flight with feedback is lost.

    Examples: wingbeat feedback pigeon.nc --delay 1 --gust w=3; wingbeat feedback pigeon.nc --survey 1000 --plot
    gusts.png
    """
    faults = FaultList()
    check_files(faults, None, plot=plot)
    if source.suffix != ".nc":
        faults.add("ORBIT", str(source), "is not a saved orbit", "save one with wingbeat orbit ... -o orbit.nc")
    faults.whole("--beats", beats, 1, 10_000)
    faults.whole("--survey", survey, 0, MOST_FLIGHTS)
    errors = named_numbers(faults, "--noise", noise, tuple(STATE_UNITS), "body_pitch=0.01")
    check_noise(faults, errors, tuple(STATE_UNITS), seed)
    check_delay(faults, delay)
    faults.whole("late", late, 0, MOST_DELAY)
    if inputs is not None:
        check_inputs(faults, inputs)
    faults.raise_if_any()
    check_outputs(plot)
    orbit = saved_orbit(source)
    airspeed = math.hypot(float(orbit.inputs["speed"]), float(orbit.inputs["climb"]))
    blown = gust if gust is not None or turbulence is not None else _GUST
    wind = wind_of(blown, turbulence, wind_seed, airspeed)
    assert wind is not None
    with progress_bar(f"{orbit.inputs['species']['name']}, feedback and flights"):
        held = compute(orbit, inputs, delay=delay)
        asked: dict[str, Any] = {"beats": beats, "late": late, "noise": errors, "seed": seed}
        flights = {FREE: fly_gust(orbit, wind, beats), HELD: fly_gust(orbit, wind, feedback=held, **asked)}
        surveyed = survey_gusts(orbit, {FREE: None, HELD: held}, survey, **asked) if survey else None
    delayed = f", feedback {beats_of(delay + late)} late" if delay + late else ""
    there = f"{orbit.inputs['speed']:g} m/s{conditions_of(orbit.record())}"
    title = f"{heading(str(orbit.inputs['species']['name']))} at {there}{delayed}"
    record = held.record() | {"late": late, "beats": beats}
    record["flights"] = {name: one.record() for name, one in flights.items()}
    record["survey"] = None if surveyed is None else surveyed.record()
    page = functools.partial(gust_page, flights, surveyed, title)
    report = functools.partial(_print, held, flights, late, surveyed)
    return deliver(record, report, flights[HELD].survived, json=json, plot=plot, page=page)


def _print(held: Feedback, flights: dict[str, GustFlight], late: int, survey: GustSurvey | None) -> None:
    console = plain_console()
    print_report([*feedback_report(held.record()), Line("")], console)
    for name, one in flights.items():
        called = name if name == FREE or not late else f"{name}, {beats_of(late)} late"
        record, told = one.record(), "lost"
        if one.survived:
            settled = record["settled_beats"]
            ending = "not settled at the end" if settled is None else f"settled after {beats_of(settled)}"
            told = (
                f"survived, body pitch within {math.degrees(record['largest_pitch']):.1f} deg of the orbit's, "
                f"height {record['lowest']:+.2f} to {record['highest']:+.2f} m, {ending}"
            )
        console.print(f"{called}: {told}", soft_wrap=True)
    if not flights[HELD].survived:
        console.print(_ADVICE, markup=False, soft_wrap=True)
    if survey is not None:
        print_report([Line(""), *survey_report(survey.record())], console)
