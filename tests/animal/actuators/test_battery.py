"""A battery's sag and discharge, against its differential equation integrated by SciPy; and what it refuses."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import wingbeat as wb
from wingbeat.animal.actuators import battery_current, cell_voltage, discharge
from wingbeat.animal.drive import Battery

PHASE = np.linspace(0.0, 1.0, 257)
# The power and motor voltage of a beat with two peaks.
POWER = np.maximum(0.0, 14.0 + 22.0 * np.sin(2 * np.pi * PHASE) + 9.0 * np.cos(4 * np.pi * PHASE))
VOLTAGE = 6.5 * np.abs(np.sin(2 * np.pi * PHASE + 0.3))
PACK = Battery(3, 0.85, 0.09)


def of_cell(charge):
    """Chen and Rincon-Mora's cell (oracle of equation ``cell-voltage``)."""
    return 3.685 - 1.031 / np.exp(35 * charge) + charge * (0.2156 + charge * (0.3201 * charge - 0.1178))


def currents(opened, resistance):
    """The current at each instant: where terminal voltage times current is the power (``battery-current``)."""
    top = opened / (2 * resistance)  # beyond which more current gives less power
    return np.array([brentq(lambda i, p=p: (opened - resistance * i) * i - p, 0.0, top) for p in POWER])


def lasting(pack, voltage, of=of_cell):
    """Time until the beat ends and the charge left, by an integrator (oracle of ``battery-discharge``)."""

    def opened(charge):
        return pack.cells * of(charge)

    def mean_current(charge):
        i = currents(opened(charge), pack.internal_resistance)
        return np.trapezoid(i, PHASE)

    def enough(_, y):
        v = opened(y[0])
        if v**2 <= 4 * pack.internal_resistance * POWER.max():
            return -1.0
        i = currents(v, pack.internal_resistance)
        terminals = v - pack.internal_resistance * i
        spare = (terminals - np.abs(voltage)).min(), np.trapezoid(terminals, PHASE) - 3.3 * pack.cells
        return min(*spare)

    enough.terminal = True
    flown = solve_ivp(
        lambda _, y: [-mean_current(y[0]) / (3600 * pack.capacity)],
        (0.0, 1e5),
        [1.0],
        events=enough,
        rtol=1e-8,
        max_step=100.0,
    )
    return flown.t[-1], flown.y[0, -1]


@pytest.mark.parametrize("volts", [1.0, 1.65])
def test_the_flight_ends_where_the_integrated_discharge_says(volts):
    """By the cut-off at a motor of low voltage, by the motor's voltage at one of a high voltage."""
    found = discharge(PACK, POWER, volts * VOLTAGE)
    seconds, left = lasting(PACK, volts * VOLTAGE)
    assert (float(found.needed) > float(found.cutoff)) is (volts > 1)
    assert float(found.endurance) == pytest.approx(seconds, rel=2e-4)
    assert float(found.charge_left) == pytest.approx(left, abs=2e-4)


def test_at_the_end_the_terminals_have_what_the_motor_needs():
    found = discharge(PACK, POWER, 1.65 * VOLTAGE)
    i = currents(float(found.needed), PACK.internal_resistance)
    terminals = float(found.needed) - PACK.internal_resistance * i
    assert (terminals - 1.65 * VOLTAGE).min() == pytest.approx(0.0, abs=1e-9)
    assert float(found.least_voltage) == pytest.approx(terminals.min(), abs=1e-9)
    assert float(found.peak_current) == pytest.approx(i.max(), rel=1e-9)


def test_a_cell_of_straight_voltage_without_sag_gives_its_energy():
    """From 4 V to 3 V at constant power, it lasts its charge times the mean voltage on the way over the power."""
    pack = Battery(2, 1.5, 1e-9, cutoff_voltage=3.25, cell_voltage=(3.0, 4.0))
    found = discharge(pack, np.full(257, 9.0), np.zeros(257))
    assert float(found.charge_left) == pytest.approx(0.25, abs=1e-7)
    assert float(found.endurance) == pytest.approx(3600 * 1.5 * 0.75 * 2 * 3.625 / 9.0, rel=1e-6)


def test_peaks_shorten_the_flight_at_the_same_mean_power():
    """By 0.7 % with a resistance of 0.09 ohm; we had guessed 2 %."""
    steady = discharge(PACK, np.full(257, np.trapezoid(POWER, PHASE)), np.zeros(257))
    peaked = discharge(PACK, POWER, np.zeros(257))
    assert float(peaked.endurance / steady.endurance) == pytest.approx(0.9934, abs=5e-4)


def test_more_than_a_battery_gives_is_no_flight():
    """A 1S pack of 1 ohm gives at most 4.2 W."""
    found = discharge(Battery(1, 1.0, 1.0), np.full(257, 5.0), np.zeros(257))
    assert float(found.endurance) == 0.0
    assert float(found.charge_left) == 1.0
    assert float(found.peak_current) == pytest.approx(0.5 * of_cell(1.0))
    assert float(battery_current(4.0, 0.5, 8.0)) == pytest.approx(4.0)


def test_the_cell_is_chen_and_rincon_moras():
    np.testing.assert_allclose(np.asarray(cell_voltage(PHASE)), of_cell(PHASE), rtol=1e-14)
    assert (np.diff(of_cell(PHASE)) > 0).all()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"battery.cells": 2.5}, "whole number"),
        ({"battery.capacity": 850.0}, "850 mAh are 0.85"),
        ({"battery.internal_resistance": 0.0}, "> 0 ohm"),
        ({"battery.cell_voltage": [3.7]}, "two or more"),
        ({"battery.cell_voltage": [3.9, 3.7]}, "rise with charge"),
        ({"battery.max_current": -1.0}, "0 leaves it out"),
    ],
)
def test_a_battery_that_cannot_be_is_refused(change, says):
    motor = {"motor.torque_constant": 0.007, "motor.resistance": 0.1, "motor.gear_ratio": 30.0}
    whole = {"battery.cells": 3, "battery.capacity": 0.85, "battery.internal_resistance": 0.06}
    pigeon = wb.load_species("pigeon").with_values(motor)
    with pytest.raises(wb.InvalidInputError, match=says):
        pigeon.with_values(whole | change)


def test_a_battery_without_a_motor_is_refused():
    whole = {"battery.cells": 3, "battery.capacity": 0.85, "battery.internal_resistance": 0.06}
    with pytest.raises(wb.InvalidInputError, match="must be given for a battery"):
        wb.load_species("pigeon").with_values(whole)


def test_it_lasts_as_long_as_in_a_battery_modelling_library():
    """PyBaMM 26.10.1.1, Thevenin without elements, 10 W a cell: 1107.139 s (findings/pybamm_full_cell.sh)."""
    found = discharge(PACK, np.full(257, 30.0), np.zeros(257))
    assert float(found.endurance) == pytest.approx(1107.139, rel=2e-5)
    assert float(found.charge_left) == pytest.approx(0.035126, abs=1e-5)
