"""The motor of the Purdue Hummingbird in hover, by its makers' equations and by wingbeat.

    python validation/robot_motor.py

prints the numbers of docs/guide/muscles.md. The makers published the robot's simulation: Fei et al. 2019,
arXiv 1902.09628, code purdue-biorobotics/flappy (Actuator.cpp, Wing.cpp, mav_config_list.json, pid_controller.py).
`makers_hover` marches these equations for one wing whose pitch is at its stop in each half of the stroke. It shares
no code with wingbeat. `carried` gives the same flap to wingbeat's model `animal`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

import wingbeat as wb
from wingbeat.animal.actuators import actuated, motor_state
from wingbeat.mechanics.flight_loads import carried_loads
from wingbeat.mechanics.flight_model import State

# What the makers state: frequency [Hz], amplitude of the voltage in hover and the largest [V], whole mass [kg].
FREQUENCY, HOVER_VOLTAGE, LARGEST_VOLTAGE, MASS = 34.0, 9.3, 18.0, 0.012
# Largest lift [kg], a press report (mikeshouts.com), low trust.
LARGEST_LIFT = 0.027
# One wing: length and mean chord [m], moments of its area, inertia about the stroke axis [kg m2], stop of its
# pitch [rad].
LENGTH, CHORD, R22, R33, INERTIA, STOP = 0.07, 0.0212121, 0.2842036, 0.2058333, 2.21e-7, math.radians(45)
AIR_DENSITY = 1.18009
# One motor: torque constant [N m/A], gear ratio and efficiency.
TORQUE_CONSTANT, GEAR, EFFICIENCY = 1.75e-3, 10, 0.9
# Its friction [N m], damping [N m s] and inertia [kg m2], and the spring of one wing [N m/rad].
FRICTION, DAMPING, ROTOR, SPRING = 2e-5, 9.74e-9, 7.03e-10, 0.0133
# Resistance [ohm]: of the data sheet, and the mean of the two fitted motors of the version with trim.
NOMINAL, FITTED = 12.4, 0.5 * (14.780 + 13.763)


class Hover(NamedTuple):
    """One beat of both wings by the makers' equations, series of shape (K,), both ends included.

    Attributes
    ----------
    flap, rate, torque : angle [rad], rate [rad/s] and torque [N m] at both flap hinges, without springs.
    voltage, current : at each motor [V], of both motors [A].
    lift : mean [N].
    """

    flap: np.ndarray
    rate: np.ndarray
    torque: np.ndarray
    voltage: np.ndarray
    current: np.ndarray
    lift: float

    @property
    def numbers(self) -> dict[str, float]:
        """Amplitude of the flap [deg], peaks and means of torque, speed, current, power, and lift over weight."""
        return {
            "flap amplitude [deg]": math.degrees(np.ptp(self.flap)) / 2,
            "lift over weight": self.lift / (9.81 * MASS),
            "flap torque [mN m]": 1e3 * rms(self.torque),
            "peak voltage [V]": np.abs(self.voltage).max(),
            "peak motor speed [rad/s]": GEAR * np.abs(self.rate).max(),
            "rms torque of both motors [mN m]": 1e3 * TORQUE_CONSTANT * rms(self.current),
            "electrical power [W]": np.maximum(self.voltage * self.current, 0.0)[:-1].mean(),
        }


def rms(series: np.ndarray) -> float:
    """Return the root mean square over one beat."""
    return float(np.sqrt(np.mean(np.asarray(series)[:-1] ** 2)))


def makers_hover(
    voltage: float = HOVER_VOLTAGE, resistance: float = NOMINAL, samples: int = 512, beats: int = 30
) -> Hover:
    """March the makers' equations of one wing until the beat repeats; return the last beat.

    Equations: ``J phi'' = eta N (kt i - d N phi' - friction sign phi') - k phi - Q`` with
    ``i = (V - kt N phi')/R``, ``J`` the inertia of wing and geared rotor, the moment of the air
    ``Q = F cos(stop) r33/r22 R`` and ``F = 0.5 rho c C_N r22 R^3 phi'^2``; ``C_N`` as in Wing.cpp.
    """
    turning, angle = 2 * math.pi * FREQUENCY, math.pi / 2 - STOP
    normal = (
        1.8 * math.sin(2 * angle) * math.cos(angle)
        + 1.95 * math.sin(angle)
        - 1.5 * math.cos(2 * angle) * math.sin(angle)
    )
    force = 0.5 * AIR_DENSITY * CHORD * normal * LENGTH**3 * R22
    drag = force * math.cos(STOP) * LENGTH * R33 / R22

    def current(t: float, rate: float) -> float:
        return (voltage * math.cos(turning * t) - TORQUE_CONSTANT * GEAR * rate) / resistance

    def rates(t: float, state: np.ndarray) -> np.ndarray:
        flap, rate = state
        motor = TORQUE_CONSTANT * current(t, rate) - DAMPING * GEAR * rate - FRICTION * np.sign(rate)
        moment = EFFICIENCY * GEAR * motor - SPRING * flap - drag * rate * abs(rate)
        return np.array([rate, moment / (INERTIA + EFFICIENCY * GEAR**2 * ROTOR)])

    step, state, found = 1 / (FREQUENCY * samples), np.zeros(2), []
    for index in range(beats * samples + 1):
        t = index * step
        slope = rates(t, state)
        if index >= (beats - 1) * samples:
            found.append((*state, slope[1], voltage * math.cos(turning * t), 2 * current(t, state[1])))
        second = rates(t + step / 2, state + step / 2 * slope)
        third = rates(t + step / 2, state + step / 2 * second)
        state = state + step / 6 * (slope + 2 * second + 2 * third + rates(t + step, state + step * third))
    flap, rate, acceleration, volts, amperes = np.array(found).T
    torque = 2 * (INERTIA * acceleration + drag * rate * np.abs(rate))
    lift = 2 * force * math.sin(STOP) * np.mean(rate[:-1] ** 2)
    return Hover(flap, rate, torque, volts, amperes, float(lift))


def wingbeats_motor(hover: Hover, resistance: float = NOMINAL) -> dict[str, float]:
    """Return what wingbeat's motor and springs need for the makers' beat, by the names of `Hover.numbers`."""
    species = wb.load_species("purdue-hummingbird").with_values({"motor.resistance": resistance / 2})
    _, motor, springs, _ = species.vehicle.drive
    need = actuated(springs, hover.flap, hover.rate, hover.torque, 1 / FREQUENCY)
    state = motor_state(motor, need.torque, need.rate, need.acceleration, FREQUENCY)
    return {
        "peak voltage [V]": float(np.abs(state.voltage).max()),
        "peak motor speed [rad/s]": float(np.abs(state.speed).max()),
        "rms torque of both motors [mN m]": 1e3 * TORQUE_CONSTANT * rms(np.asarray(state.current)),
        "electrical power [W]": float(np.maximum(np.asarray(state.power), 0.0)[:-1].mean()),
    }


def carried(hover: Hover, resistance: float = NOMINAL) -> dict[str, float]:
    """Return the numbers of the makers' flap and frequency by wingbeat's model `animal`, body held upright.

    The wing's pitch is a sine that reaches the stops at mid-stroke.
    """
    species = wb.load_species("purdue-hummingbird").with_values(
        {
            **{"wingbeat.frequency": FREQUENCY, "wingbeat.flap_amplitude": float(np.ptp(hover.flap)) / 2},
            **{"wingbeat.flap_mean": 0.0, "wingbeat.pitch_mean": 0.0, "wingbeat.pitch_amplitude": STOP},
            **{"motor.resistance": resistance / 2, "air.density": AIR_DENSITY},
        }
    )
    flight = wb.models.animal(species).problem(species, speed=0.0).model
    phase = np.linspace(0.0, 1.0, 257)
    still = State(*(np.full_like(phase, value) for value in (0.0, 0.0, math.pi / 2, 0.0, 0.0, 0.0)))
    loads, _ = carried_loads(flight, species.wingbeat, still, phase, np.zeros((phase.size, 3)))
    lift = 2 * np.asarray(loads.strip_force)[:-1, :, 2].sum(axis=1).mean()
    flap, rate, torque = (np.asarray(getattr(loads, name)) for name in ("flap", "flap_rate", "flap_torque"))
    beat = Hover(flap, rate, torque, np.zeros_like(flap), np.zeros_like(flap), float(lift))
    shape = {
        name: beat.numbers[name] for name in ("flap amplitude [deg]", "lift over weight", "flap torque [mN m]")
    }
    return shape | wingbeats_motor(beat, resistance)


def main() -> None:
    """Print all columns, for both resistances."""
    for resistance in (NOMINAL, FITTED):
        hover = makers_hover(resistance=resistance)
        motor, whole = wingbeats_motor(hover, resistance), carried(hover, resistance)
        print(f"{resistance:.1f} ohm: by the makers' equations; by wingbeat's motor; by wingbeat's air and motor")
        for name, value in hover.numbers.items():
            print(f"  {name}: {value:.4g}; {motor.get(name, math.nan):.4g}; {whole.get(name, math.nan):.4g}")
        largest = makers_hover(LARGEST_VOLTAGE, resistance)
        print(f"  lift at {LARGEST_VOLTAGE:g} V: {1e3 * largest.lift / 9.81:.1f} g")


if __name__ == "__main__":
    main()
