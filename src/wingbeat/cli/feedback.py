"""``wingbeat feedback``: the feedback that holds a saved orbit from beat to beat, and gusts flown with it."""

from __future__ import annotations

import functools
import math
from pathlib import Path
from typing import Annotated, Any

from wingbeat._base import FaultList, InvalidInputError, Line, heading
from wingbeat.cli.arguments import (
    Whole,
    check_files,
    check_outputs,
    figure,
    flag,
    named_numbers,
    option,
    several,
    written_to,
)
from wingbeat.cli.problem_options import Gust, Turbulence, WindSeed, saved_orbit, wind_of
from wingbeat.cli.terminal import deliver, plain_console, print_report, progress_bar
from wingbeat.mechanics.state_rates import HINGE_STATE
from wingbeat.plots import gust_page
from wingbeat.records.judgements import conditions_of
from wingbeat.stability.beat_feedback import Feedback
from wingbeat.stability.beat_feedback import feedback as compute
from wingbeat.stability.control_block import check_block
from wingbeat.stability.gust_flights import GustFlight, fly_gust
from wingbeat.stability.imu import Imu
from wingbeat.stability.many_flights import MOST_FLIGHTS, GustSurvey, survey_gusts
from wingbeat.stability.options import MOST_DELAY, check_delay, check_inputs, check_noise
from wingbeat.stability.reports import STATE_UNITS, beats_of, feedback_report, segment_report, survey_report
from wingbeat.stability.segment_feedback import SegmentFeedback, feedback_in_beat
from wingbeat.stability.servos import SERVOED, Servo, check_timing

FREE, HELD = "no feedback", "feedback"
# The gust that is flown if none is given: upward at 2 m/s, for 0.3 s.
_GUST = ["w=2", "duration=0.3"]
_ADVICE = (
    "The gains are those of small deviations, and this gust leads beyond them. A weaker gust (--gust w=1), "
    "feedback in the same beat (--delay 0) or within it (--segments 4), or a gait that is stable by itself "
    "(wingbeat orbit ... --stable) may survive."
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
    segments: Annotated[
        Whole | None,
        option("Feedback within the beat: so many measurements in each, from 2 to 8, with --servo to 256."),
    ] = None,
    sample_rate: Annotated[
        float | None, option("The same, by measurements per second [Hz]; a beat gets a whole number of them.")
    ] = None,
    delay_time: Annotated[
        float | None, option("The same, with this delay from a measurement to its effect [s].")
    ] = None,
    servo: Annotated[
        list[str] | None,
        several(
            "The same, by servos that hold their commands: speed_deg=600 bandwidth=5 lower_deg=-12 upper_deg=8 "
            "[deg/s, Hz, deg]; flap.speed_deg=600 for one of flap, pitch, tail, and rest_angle of a "
            "hinge's springs. Only those move that are named."
        ),
    ] = None,
    imu: Annotated[
        list[str] | None,
        several(
            "The same, from the readings of an IMU, by their standard deviations: gyro_deg=0.1 accelerometer=0.05 "
            "gyro_bias_deg=1 accelerometer_bias=0.1 height=0.1 gust=1 [deg/s, m/s2, m, m/s]; without height, that "
            "is not held."
        ),
    ] = None,
    gust: Gust = None,
    turbulence: Turbulence = None,
    wind_seed: WindSeed = 0,
    beats: Annotated[Whole, option("Number of wingbeats of each flight.")] = 30,
    noise: Annotated[
        list[str] | None,
        several("Standard deviations of the sensors: z=0.02 body_pitch=0.01 u=0.1 ... [m, rad, m/s, rad/s]."),
    ] = None,
    survey: Annotated[Whole, option("Number of random gusts to survey; 0 for none.")] = 0,
    largest_gust: Annotated[float, option("Of the surveyed gusts [m/s].")] = 5.0,
    seed: Annotated[Whole, option("Seed of the noise and of the surveyed gusts.")] = 0,
    output: Annotated[
        Path | None,
        written_to("Write the controller within the beat as difference equations: .json, .mat or .csv."),
    ] = None,
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
    open_loop controllability sufficient version; late and beats; within the beat, in place of dt to sufficient:
    segments sample_rate delay_time held state (its names) inputs phases path gains (a matrix for each measurement)
    lower upper servo_speed servo_bandwidth gait_speed imu estimator memory (as in --output) multipliers
    spectral_radius open_loop;
    flights by name ("no feedback", "feedback"), each with completed survived largest_pitch lowest highest
    settled_beats; and survey (null without --survey) with flights beats largest_gust survived by_size by_direction.
    Exit code 3: the flight with feedback is lost.

    Examples: wingbeat feedback pigeon.nc --delay 1 --gust w=3; wingbeat feedback pigeon.nc --survey 1000 --plot
    gusts.png; wingbeat feedback robot.nc --sample-rate 100 --delay-time 0.01 --servo speed_deg=600 --gust w=3
    --survey 1000 --largest-gust 3 -o controller.json
    """
    faults = FaultList()
    check_files(faults, output, source, plot=plot)
    if source.suffix != ".nc":
        faults.add("ORBIT", str(source), "is not a saved orbit", "save one with wingbeat orbit ... -o orbit.nc")
    faults.whole("--beats", beats, 1, 10_000)
    faults.whole("--survey", survey, 0, MOST_FLIGHTS)
    measured = (*STATE_UNITS, *HINGE_STATE)
    errors = named_numbers(faults, "--noise", noise, measured, "body_pitch=0.01")
    check_noise(faults, errors, measured, seed)
    check_delay(faults, delay)
    faults.whole("late", late, 0, MOST_DELAY)
    faults.number("--largest-gust", largest_gust, above=0.0, unit="m/s")
    given = {"segments": segments, "sample_rate": sample_rate, "delay_time": delay_time}
    within: dict[str, Any] = {name: value for name, value in given.items() if value is not None}
    servos = _servos(faults, servo)
    sensors = _imu(faults, imu)
    within |= {} if sensors is None else {"imu": sensors}
    if sensors is not None and servos is None and not delay_time:
        fix = "add --servo speed_deg=600"
        faults.add("--imu", " ".join(imu or []), "is for feedback with servos or a delay", fix)
    if sensors is not None and errors:
        faults.add("--noise", " ".join(noise or []), "is not that of an IMU", "leave it out")
    check_timing(faults, segments, sample_rate, delay_time, held=servos is not None)
    if within or servos is not None:
        for name, value in (("--inputs", inputs), ("--delay", delay), ("--late", late)):
            if value:
                faults.add(name, value, "is for feedback from beat to beat", "leave it out, or give --delay-time")
    if output is not None:
        check_block(faults, "--output", output)
        if not within and servos is None:
            rule = "is for feedback within the beat; that from beat to beat is printed by --json"
            faults.add("--output", str(output), rule, "add --segments 4 or --sample-rate 100")
    if inputs is not None:
        check_inputs(faults, inputs)
    faults.raise_if_any()
    check_outputs(plot, output)
    orbit = saved_orbit(source)
    airspeed = math.hypot(float(orbit.inputs["speed"]), float(orbit.inputs["climb"]))
    blown = gust if gust is not None or turbulence is not None else _GUST
    wind = wind_of(blown, turbulence, wind_seed, airspeed)
    assert wind is not None
    with progress_bar(f"{orbit.inputs['species']['name']}, feedback and flights"):
        held: Feedback | SegmentFeedback
        if within or servos is not None:
            held = feedback_in_beat(orbit, servos=servos, **within)
        else:
            held = compute(orbit, inputs, delay=delay)
        asked: dict[str, Any] = {"beats": beats, "late": late, "noise": errors, "seed": seed}
        flights = {FREE: fly_gust(orbit, wind, beats), HELD: fly_gust(orbit, wind, feedback=held, **asked)}
        both = {FREE: None, HELD: held}
        surveyed = survey_gusts(orbit, both, survey, size=largest_gust, **asked) if survey else None
    delayed = f", feedback {beats_of(delay + late)} late" if delay + late else ""
    delayed = f", feedback {1e3 * delay_time:.3g} ms late" if delay_time else delayed
    there = f"{orbit.inputs['speed']:g} m/s{conditions_of(orbit.record())}"
    title = f"{heading(str(orbit.inputs['species']['name']))} at {there}{delayed}"
    record = held.record() | {"late": late, "beats": beats}
    record["flights"] = {name: one.record() for name, one in flights.items()}
    record["survey"] = None if surveyed is None else surveyed.record()
    page = functools.partial(gust_page, flights, surveyed, title)
    report = functools.partial(_print, held, flights, late, surveyed)
    save = held.save if isinstance(held, SegmentFeedback) else None
    return deliver(
        record, report, flights[HELD].survived, json=json, output=output, save=save, plot=plot, page=page
    )


def _servos(faults: FaultList, words: list[str] | None) -> Servo | dict[str, Servo] | None:
    """Return the servos of words such as ``pitch.speed_deg=600``; one alone if no law is named."""
    if words is None:
        return None
    names = ("speed_deg", "bandwidth", "lower_deg", "upper_deg")
    known = (*names, *(f"{law}.{name}" for law in SERVOED for name in names))
    found = named_numbers(faults, "--servo", words, known, "speed_deg=600")
    laws = [law for law in SERVOED if any(name.startswith(law) for name in found)]
    servos = {}
    for law in laws or [""]:
        own = {name: found.get(f"{law}.{name}", found.get(name)) for name in names}
        numbers = {
            name.removesuffix("_deg"): math.radians(value) if name.endswith("_deg") else value
            for name, value in own.items()
            if value is not None
        }
        try:
            servos[law] = Servo(**numbers)
        except InvalidInputError as error:
            faults.faults += error.faults
            break
    return servos if laws else servos.get("")


def _imu(faults: FaultList, words: list[str] | None) -> Imu | None:
    """Return the IMU of words such as ``gyro_deg=0.1``."""
    if words is None:
        return None
    names = ("gyro_deg", "accelerometer", "gyro_bias_deg", "accelerometer_bias", "height", "gust")
    found = named_numbers(faults, "--imu", words, names, "gyro_deg=0.1 accelerometer=0.05")
    missing = [name for name in names[:2] if name not in found]
    if missing:
        faults.add("--imu", " ".join(words), f"lacks {' and '.join(missing)}", "for example gyro_deg=0.1")
    if faults.faults:
        return None
    numbers = {
        name.removesuffix("_deg"): math.radians(value) if name.endswith("_deg") else value
        for name, value in found.items()
    }
    try:
        return Imu(**numbers)
    except InvalidInputError as error:
        faults.faults += error.faults
        return None


def _print(
    held: Feedback | SegmentFeedback, flights: dict[str, GustFlight], late: int, survey: GustSurvey | None
) -> None:
    console = plain_console()
    report = segment_report if isinstance(held, SegmentFeedback) else feedback_report
    print_report([*report(held.record()), Line("")], console)
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
