"""``wingbeat feedback``: what it prints, its JSON, its figure, and what it refuses."""

import json
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat.cli import main
from wingbeat.plots import gust_page
from wingbeat.stability.gust_flights import fly_gust


@pytest.fixture(scope="module")
def saved(cruise, tmp_path_factory):
    path = tmp_path_factory.mktemp("feedback") / "pigeon.nc"
    cruise.save(path)
    return str(path)


def test_it_prints_gains_multipliers_and_a_saved_flight(saved, capsys):
    assert main(["feedback", saved, "--delay", "1", "--gust", "w=3", "duration=0.2"]) == 0
    printed = capsys.readouterr().out
    assert "spectral radius 1.346 without feedback, 0.956 with feedback that acts 1 beat later" in printed
    assert "pitch_mean [deg]" in printed
    assert "rate [deg/s]" in printed
    assert "see --json, whose `gains`\nhave the opposite sign" in printed
    assert "multipliers without feedback: 1.346, 0.892 ± 0.130i, 0.648" in printed
    assert "inputs that suffice alone:    frequency, flap_mean" in printed
    assert "no feedback: lost" in printed
    assert "feedback: survived, body pitch within 15." in printed


@pytest.mark.slow
def test_its_json_is_that_of_the_library(saved, patient, cruise, capsys, tmp_path):
    drawn = tmp_path / "gusts.png"
    asked = ["--delay", "1", "--survey", "40", "--seed", "3", "--json", "--plot", str(drawn)]
    assert main(["feedback", saved, *asked]) == 0
    record = json.loads(capsys.readouterr().out)
    assert np.allclose(record["gains"], patient.gains, rtol=1e-6, atol=1e-6)
    assert len(record["gain_columns"]) == len(record["gains"][0])
    assert record["gain_columns"][4:7] == ["pitch_rate", "frequency, 1 beat ago", "flap_mean, 1 beat ago"]
    assert record["flights"]["no feedback"]["survived"] is False
    held = record["flights"]["feedback"]
    gust = fly_gust(cruise, wb.winds.CosineGust(w=2.0, duration=0.3), feedback=patient)
    assert held["largest_pitch"] == pytest.approx(np.abs(gust.pitch).max(), rel=1e-6)
    assert held["settled_beats"] == gust.settled <= 12
    survey = wb.survey_gusts(cruise, {"feedback": patient}, 40, seed=3)
    assert record["survey"]["survived"]["feedback"] == survey.share("feedback")
    assert drawn.read_bytes().startswith(b"\x89PNG")


def test_feedback_that_comes_late_is_lost_and_ends_with_3(saved, capsys):
    assert main(["feedback", saved, "--late", "1", "--noise", "body_pitch=0.01"]) == 3
    printed = capsys.readouterr().out
    assert "feedback, 1 beat late: lost" in printed
    assert "A weaker gust" in printed


@pytest.mark.slow
def test_the_figure_shows_flights_and_shares(cruise, held):
    gust = wb.winds.CosineGust(w=2.0, start=0.1, duration=0.3)
    flights = {"no feedback": fly_gust(cruise, gust), "feedback": fly_gust(cruise, gust, feedback=held)}
    survey = wb.survey_gusts(cruise, {"no feedback": None, "feedback": held}, 60, seed=2)
    pitch, height, sizes, directions = gust_page(flights, survey).axes
    lost, kept = (line.get_ydata() for line in pitch.get_lines()[:2])
    assert len(lost) < len(kept)
    assert np.abs(lost).max() <= 60
    assert np.allclose(kept, np.degrees(flights["feedback"].pitch))
    assert np.allclose(height.get_lines()[1].get_ydata(), flights["feedback"].height)
    assert len(sizes.get_lines()) == len(directions.get_lines()) == 2
    figure = gust_page(flights, title="Pigeon at 12 m/s")
    assert len(figure.axes) == 2
    assert figure.get_suptitle() == "Pigeon at 12 m/s"
    assert check_legends(figure) == ["no feedback", "feedback", "time of the gust"]


def test_deviations_of_a_flight_are_from_the_orbit(cruise, held):
    still = fly_gust(cruise, (0.0, 0.0), 3, feedback=held)
    assert np.abs(still.pitch).max() < 1e-4
    assert np.abs(still.height).max() < 1e-4
    assert (still.survived, still.settled) == (True, 0)
    lost = fly_gust(cruise, wb.winds.CosineGust(w=3.0, duration=0.2), 20)
    assert (lost.survived, lost.settled) == (False, None)
    assert np.abs(lost.pitch).max() > math.radians(60)


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (["pigeon"], "ORBIT = 'pigeon': is not a saved orbit; save one with"),
        (["none.nc"], "none.nc"),
        (["none.nc", "--delay", "0.5"], "not a whole number"),
        (["none.nc", "--beats", "0"], "--beats = 0"),
        (["none.nc", "--survey", "-1"], "--survey = -1"),
        (["none.nc", "--noise", "w"], "must be NAME=VALUE with a number"),
        (["none.nc", "--noise", "w=1", "w=2"], "is given twice"),
        (["none.nc", "--noise", "x=1"], "use one of z, body_pitch"),
        (["none.nc", "--plot", "gusts.txt"], "--plot"),
    ],
)
def test_bad_input_gets_its_sentence(asked, said, capsys):
    assert main(["feedback", *asked]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (["--inputs", "flaping"], "inputs = 'flaping': is not a parameter"),
        (["--delay", "9"], "delay = 9: must be a whole number from 0 to 4"),
        (["--gust", "w=nan"], "gust.w"),
        (["--noise", "w=-1"], "noise.w"),
        (["--late", "-1"], "late = -1"),
    ],
)
def test_what_the_library_refuses_gets_its_sentence(saved, asked, said, capsys):
    assert main(["feedback", saved, *asked]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.slow
def test_feedback_in_real_time_is_that_of_the_library(saved, cruise, capsys, tmp_path):
    drawn = tmp_path / "gusts.png"
    servo = ["--servo", "speed_deg=600", "pitch.lower_deg=-3", "flap.bandwidth=8"]
    timing = ["--sample-rate", "100", "--delay-time", "0.01", *servo]
    asked = ["--survey", "20", "--largest-gust", "3", "--json", "--plot", str(drawn)]
    assert main(["feedback", saved, *timing, *asked]) == 0
    record = json.loads(capsys.readouterr().out)
    speed = math.radians(600)
    servos = {"pitch": wb.Servo(speed=speed, lower=math.radians(-3)), "flap": wb.Servo(speed=speed, bandwidth=8.0)}
    held = wb.feedback_in_beat(cruise, sample_rate=100.0, delay_time=0.01, servos=servos)
    assert np.allclose(record["gains"], held.gains, rtol=1e-6, atol=1e-6)
    assert record["lower"] == pytest.approx({"flap": math.radians(-12), "pitch": math.radians(-3)})
    assert record["survey"]["survived"]["feedback"] == 1.0
    assert record["survey"]["largest_gust"] < 3.0
    flown = record["flights"]["feedback"]
    gust = held.fly(wb.winds.CosineGust(w=2.0, duration=0.3), 30)
    assert flown["largest_pitch"] == pytest.approx(np.abs(gust.deviations[:, 1]).max(), rel=1e-6)
    assert drawn.read_bytes().startswith(b"\x89PNG")
    written = tmp_path / "controller.json"
    assert main(["feedback", saved, *timing, "--output", str(written)]) == 0
    printed = capsys.readouterr().out
    block = json.loads(written.read_text())
    assert np.allclose(block["gains_of_state"], held.gains[:, :, :5], rtol=1e-6, atol=1e-6)
    sensors = ["--imu", "gyro_deg=0.1", "accelerometer=0.05", "gyro_bias_deg=1", "height=0.1"]
    assert main(["feedback", saved, *timing, *sensors]) == 0
    assert "the state by a Kalman filter from an IMU" in capsys.readouterr().out
    assert "10 samples a beat (95.28 Hz), 10 ms from a measurement to its effect" in printed
    assert "pitch: -3 to +12 deg, 600 deg/s, bandwidth 9.55 Hz (a guess from its speed)" in printed
    assert "600 deg/s, bandwidth 8 Hz\n" in printed


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        (["--delay", "1", "--delay-time", "0.01"], "--delay = 1: is for feedback from beat to beat"),
        (["--output", "controller.json"], "is for feedback within the beat"),
        (["--output", "controller.txt", "--segments", "4"], "does not end in a suffix for a controller"),
        (["--imu", "gyro_deg=0.1", "--servo", "speed_deg=600"], "lacks accelerometer"),
        (["--imu", "gyro_deg=0.1", "accelerometer=0.1"], "is for feedback with servos or a delay"),
        (["--imu", "gyro_deg=-1", "accelerometer=0.1", "--delay-time", "0.01"], "imu.gyro = -0.01"),
        (["--servo", "speed=600"], "--servo = 'speed'"),
        (["--servo", "speed_deg=0"], "servo.speed = 0.0: must be > 0"),
        (["--largest-gust", "0"], "--largest-gust = 0.0"),
        (["--sample-rate", "2"], "sample_rate = 2.0: makes 0 samples in a beat"),
    ],
)
def test_bad_timing_gets_its_sentence(saved, asked, said, capsys):
    assert main(["feedback", saved, *asked]) == 2
    assert said in capsys.readouterr().err
