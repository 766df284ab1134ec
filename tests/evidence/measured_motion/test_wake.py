"""The lag of the wake on measured motions: Theodorsen 1935 with his C(k), Garrick 1936, and edges."""

import dataclasses
import json
import math

import numpy as np
import pytest

from tests.evidence.measured_motion.test_wake_lag import THEODORSEN
from tests.helpers.strip_cases import PHASES, flapping_case, section_case, write_case
from wingbeat._base import InvalidInputError
from wingbeat.cli import main
from wingbeat_evidence.measured_motion import validate

CHORD, WIDTH, STRIPS, DENSITY, COUNT = 0.2, 0.1, 5, 1.2, 200
HALF, OMEGA = 0.5 * CHORD, 2 * math.pi * PHASES["frequency"]
WAKE = "thin-aerofoil-wake"
# Phasors of plunge [m, up] and pitch [rad].
PLUNGE, PITCH = 1e-4 * np.exp(0.4j), 1e-3 * np.exp(1.7j)


def law(phasor):
    def values(t):
        turning = phasor * np.exp(1j * OMEGA * t)
        return turning.real, (1j * OMEGA * turning).real

    return values


def case_of(speed, plunge=PLUNGE, pitch=PITCH, **changes):
    about = {"strips": STRIPS, "chord": CHORD, "width": WIDTH, "count": COUNT, "speed": speed}
    return section_case(law(plunge), law(pitch), **(about | changes))


def theodorsen(speed, lag):
    """Return the phasor of the upward force of both wings [N], the axis at the quarter chord."""
    rate, a = 1j * OMEGA, -0.5
    fall = -PLUNGE
    added = rate**2 * fall + speed * rate * PITCH - HALF * a * rate**2 * PITCH
    circulation = rate * fall + speed * PITCH + HALF * (0.5 - a) * rate * PITCH
    lift = math.pi * DENSITY * HALF**2 * added + 2 * math.pi * DENSITY * speed * HALF * lag * circulation
    return 2 * STRIPS * WIDTH * lift


def phasor(force):
    return 2 * np.mean(force * np.exp(-2j * math.pi * np.arange(COUNT) / COUNT))


@pytest.mark.parametrize(("k", "lag"), THEODORSEN.items())
def test_a_section_is_theodorsens(polar, k, lag):
    speed = OMEGA * HALF / k
    rows = {row.unsteady: phasor(row.loads.fz) for row in validate(case_of(speed), [polar], inflow="none").rows}
    wanted, without = theodorsen(speed, lag), theodorsen(speed, 1.0)
    assert abs(rows[WAKE] - wanted) < 0.02 * abs(without)
    assert abs(rows["thin-aerofoil"] - without) < 3e-3 * abs(without)
    assert abs(without - wanted) > 0.1 * abs(without)


def test_thrust_of_plunge_is_garricks(polar):
    k = 0.5
    speed = OMEGA * HALF / k
    (row,) = validate(case_of(speed, pitch=0j), [polar], WAKE, "none").rows
    coefficient = math.pi * k**2 * (abs(PLUNGE) / HALF) ** 2 * abs(THEODORSEN[k]) ** 2
    area = 2 * STRIPS * WIDTH * CHORD
    assert row.loads.fx.mean() == pytest.approx(0.5 * DENSITY * speed**2 * area * coefficient, rel=0.04)
    assert row.aerodynamic_power == pytest.approx(garrick_power(speed, k), rel=0.03)


def garrick_power(speed, k):
    """Return the mean power of plunge [W] less that of thrust: what stays in the wake."""
    lag = THEODORSEN[k]
    spent = math.pi * DENSITY * HALF * speed * OMEGA**2 * abs(PLUNGE) ** 2 * (lag.real - abs(lag) ** 2)
    return 2 * STRIPS * WIDTH * spent


def test_so_it_is_through_the_command(polar, tmp_path, capsys):
    k = 0.28
    speed = OMEGA * HALF / k
    case = case_of(speed)
    lift = (theodorsen(speed, THEODORSEN[k]) * np.exp(1j * OMEGA * case.times)).real
    path = write_case(dataclasses.replace(case, forces={"fz": lift}, mean_force=None), tmp_path / "case")
    table = tmp_path / "thin.csv"
    lines = zip(polar.alpha_deg, polar.c_l, polar.c_d, strict=True)
    head = "# aspect_ratio = inf\nalpha_deg,c_l,c_d\n"
    table.write_text(head + "".join(f"{a},{c_l!r},{c_d}\n" for a, c_l, c_d in lines))
    assert main(["validate", str(path), "--aero", str(table), "--inflow", "none", "--json"]) == 0
    scores = {row["unsteady"]: row["fz"] for row in json.loads(capsys.readouterr().out)["results"]}
    assert list(scores) == ["none", "thin-aerofoil", WAKE]
    assert scores[WAKE]["rms_about_mean"] < 0.03
    assert scores["thin-aerofoil"]["rms_about_mean"] > 0.2


def test_a_slow_motion_has_little_lag(polar):
    """At reduced frequencies of 0.014 and 0.0014."""
    parts = []
    for speed in (90.0, 900.0):
        rows = validate(case_of(speed, plunge=0.01), [polar], inflow="none").rows
        force = {row.unsteady: row.loads.fz for row in rows}
        off = np.abs(force[WAKE] - force["thin-aerofoil"]).max()
        parts.append(off / np.abs(force["thin-aerofoil"]).max())
    assert parts[1] < 0.15 * parts[0] < 0.01


def test_uniform_flight_has_no_wake(polar):
    still = section_case(lambda t: (0 * t, 0 * t), lambda t: (0 * t + 0.1, 0 * t))
    force = {row.unsteady: row.loads.fz for row in validate(still, [polar], inflow="none").rows}
    np.testing.assert_allclose(force[WAKE], force["thin-aerofoil"], rtol=1e-9)


def test_a_part_of_a_motion_starts_from_steady_flight_and_says_so(polar):
    whole = case_of(20.0)
    part = dataclasses.replace(whole, periodic=False)
    found = validate(part, [polar], WAKE, "none")
    assert any("as that of steady flight" in note for note in found.notes)
    assert not any("starts from" in note for note in validate(part, [polar], "thin-aerofoil", "none").notes)
    repeating = validate(whole, [polar], WAKE, "none")
    assert not any("starts from" in note for note in repeating.notes)
    lagging = np.abs(found.rows[0].loads.fz - repeating.rows[0].loads.fz)
    assert lagging[0] > 10 * lagging[-10]  # the start fades


@pytest.mark.parametrize("speed", [0.0, 4.0])
def test_wings_that_stand_still_for_a_while_have_forces_of_numbers(speed):
    case = flapping_case(speed=speed)
    stop = np.array(case.velocity)
    stop[10:30] = 0.0
    halted = dataclasses.replace(case, velocity=stop, rear_velocity=stop)
    for row in validate(halted, ["su-fan"], WAKE).rows:
        assert np.isfinite(row.loads.fz).all()


@pytest.mark.parametrize("name", ["dickinson", "feathered-revolving", "byl"])
def test_the_lag_is_refused_for_a_polar_of_no_straight_flow(name):
    with pytest.raises(InvalidInputError, match=f"{name} states none"):
        validate(flapping_case(), [name], WAKE)
    assert WAKE not in {row.unsteady for row in validate(flapping_case(), [name]).rows}
