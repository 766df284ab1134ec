"""A section with lift 2 pi sin(alpha) has the loads of Theodorsen 1935 without his wake."""

import dataclasses
import json
import math

import numpy as np
import pytest

from tests.helpers.strip_cases import PHASES, section_case, write_case
from wingbeat.cli import main
from wingbeat_evidence.measured_motion import validate

CHORD, WIDTH, STRIPS, DENSITY, SPEED = 0.2, 0.1, 5, 1.2, PHASES["speed"]
OMEGA = 2 * math.pi * PHASES["frequency"]


def wave(amplitude, phase):
    """Return a law of time: value, rate and second rate."""

    def law(t):
        angle = OMEGA * t + phase
        return amplitude * np.cos(angle), -amplitude * OMEGA * np.sin(angle)

    return law


def theodorsen(t, plunge, pitch):
    """Return the upward force of both wings [N] with C(k) = 1, the axis at the quarter chord; heave is down."""
    b = 0.5 * CHORD
    (up, climb), (alpha, rate) = plunge(t), pitch(t)
    fall, fall_rate, rate_rate = -climb, OMEGA**2 * up, -(OMEGA**2) * alpha
    a = -0.5
    added = math.pi * DENSITY * b**2 * (fall_rate + SPEED * rate - b * a * rate_rate)
    circulation = 2 * math.pi * DENSITY * SPEED * b * (fall + SPEED * alpha + b * (0.5 - a) * rate)
    return 2 * STRIPS * WIDTH * (added + circulation)


PLUNGE, PITCH = wave(2e-3, 0.4), wave(4e-3, 1.7)


@pytest.fixture(scope="module")
def case():
    made = section_case(PLUNGE, PITCH, strips=STRIPS, chord=CHORD, width=WIDTH)
    lift = theodorsen(made.times, PLUNGE, PITCH)
    return dataclasses.replace(made, forces={"fz": lift, "fx": 0 * lift}, mean_force=None)


@pytest.mark.parametrize("velocities", [True, False])
def test_all_terms_are_theodorsens_and_none_are_not(case, polar, velocities):
    if not velocities:
        case = dataclasses.replace(case, velocity=None, rear_velocity=None)
    rows = validate(case, [polar], inflow="none").rows
    error = {row.unsteady: np.abs(row.loads.fz - case.forces["fz"]).max() for row in rows}
    peak = np.abs(case.forces["fz"]).max()
    assert error["thin-aerofoil"] < 2e-3 * peak
    assert error["none"] > 0.1 * peak


def test_so_they_are_through_the_command_with_a_table_of_coefficients(case, polar, tmp_path, capsys):
    path = write_case(case, tmp_path / "case")
    table = tmp_path / "thin.csv"
    rows = zip(polar.alpha_deg, polar.c_l, polar.c_d, strict=True)
    table.write_text("alpha_deg,c_l,c_d\n" + "".join(f"{a},{lift!r},{drag}\n" for a, lift, drag in rows))
    assert main(["validate", str(path), "--aero", str(table), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [(row["aero"], row["inflow"]) for row in found["results"]] == [("thin", "none")] * 2
    scores = {row["unsteady"]: row["fz"] for row in found["results"]}
    # The root mean square error over the weight, against the peak over the weight.
    peak = np.abs(case.forces["fz"]).max() / case.weight
    assert scores["thin-aerofoil"]["rms"] < 0.01 * peak
    assert scores["thin-aerofoil"]["peak_ratio"] == pytest.approx(1.0, abs=0.01)
    assert scores["thin-aerofoil"]["lag"] == pytest.approx(0.0, abs=1e-3)
    assert scores["none"]["rms"] > 0.1 * peak


def test_the_wings_give_the_air_the_work_of_force_and_couple(case, polar):
    """Mean power of plunge and of pitch about the quarter chord, with Theodorsen's lift and moment."""
    row = validate(case, [polar], unsteady="thin-aerofoil", inflow="none").rows[0]
    t, b = case.times, 0.5 * CHORD
    (up, climb), (alpha, rate) = PLUNGE(t), PITCH(t)
    bend = -(OMEGA**2) * up  # upward acceleration
    moment = -math.pi * DENSITY * b**2 * (-b * bend / 2 + SPEED * b * rate - 3 / 8 * b**2 * OMEGA**2 * alpha)
    moment *= 2 * STRIPS * WIDTH
    by_normal = -(case.forces["fz"] * climb + moment * rate)
    # Forward force does work along the flight: minus what the loads that tilt with the chord give.
    by_thrust = -row.loads.fx * SPEED
    assert row.aerodynamic_power == pytest.approx(np.mean(by_normal + by_thrust), rel=0.02, abs=1e-6)


def test_uniform_flight_is_the_polar_alone(polar):
    steady = section_case(lambda t: (0 * t, 0 * t), lambda t: (0 * t + 0.1, 0 * t), mean_force=(0.0, 1.0))
    lift = 0.5 * DENSITY * SPEED**2 * 2 * STRIPS * WIDTH * CHORD * 2 * math.pi * math.sin(0.1)
    for row in validate(steady, [polar], inflow="none").rows:
        np.testing.assert_allclose(row.loads.fz, lift, rtol=1e-5)
        np.testing.assert_allclose(row.loads.fx, 0.0, atol=1e-6)
        assert row.fz.mean_ratio == pytest.approx(lift, rel=1e-5)
