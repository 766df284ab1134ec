"""Muscles and motors of a vehicle: their quantities as objective, limit, record and derivative."""

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.programmes import differences, stock_point
from wingbeat.animal.actuators import best_efficiency, force_at, metabolic_ratio
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.orbits.problem.quantity import OF_DRIVE
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.orbits.uncertainty import OptimumSlopes
from wingbeat.records.orbit_record import battery_warnings

PIGEON = wb.load_species("pigeon")
STRONG = PIGEON.with_muscle().with_values(
    {"muscle.isometric_stress": 1e6, "muscle.mass": 0.0442, "muscle.elevator_share": 0.11}
)
MOTOR = {"motor.torque_constant": 6e-3, "motor.resistance": 0.1, "motor.gear_ratio": 30.0}

# A pigeon whose wings a muscle and a motor with a battery drive, behind springs.
DRIVEN = PIGEON.with_muscle().with_values(
    {
        **{"motor.torque_constant": 0.007, "motor.resistance": 0.1, "motor.gear_ratio": 30.0},
        **{"motor.rotor_inertia": 1e-7, "motor.no_load_current": 0.1, "motor.gear_efficiency": 0.8},
        **{"springs.stiffness": 0.4, "springs.rest_angle": 0.1, "springs.series_compliance": 0.05},
        "muscle.tendon_compliance": 0.03,
        **{"battery.cells": 8, "battery.capacity": 0.85, "battery.internal_resistance": 0.1},
    }
)


DRIVE_NUMBERS = [name for found in OF_DRIVE.values() for name in found]


def problem(species, **more):
    return wb.OrbitProblem(species, speed=12.0, **more)


@pytest.fixture(scope="module")
def cheap():
    """The beat of least metabolic power."""
    return find_orbit(problem(STRONG, minimise="metabolic_power"), Settings(1))


@pytest.mark.slow
def test_metabolic_power_is_a_sum_over_the_samples_of_the_beat(cheap):
    """A slow reference from the formulas, without smooth treatment of changes of sign."""
    beat, muscle = cheap.beat(), STRONG.vehicle.muscle
    torque, rate = np.asarray(beat.flap_torque), np.asarray(beat.flap_rate)
    total = 0.0
    for one, speed in zip(torque[:-1], rate[:-1], strict=True):
        share = float(np.sign(one) * speed / muscle.max_flap_rate)
        isometric = abs(one) / float(force_at(share, muscle.curvature))
        total += isometric * muscle.max_flap_rate * float(metabolic_ratio(share))
    pitching = np.maximum(np.asarray(beat.pitch_torque * beat.wing_pitch_rate), 0.0)[:-1].mean()
    expected = total / (len(torque) - 1) + pitching / float(best_efficiency(muscle.curvature))
    assert cheap.objective == pytest.approx(expected, rel=2e-3)


def test_least_metabolic_power_costs_less_than_other_beats(cheap):
    assert cheap.status is wb.Status.CONVERGED
    metabolic = wb.objectives.named_quantity("metabolic_power")
    for other in ("frequency", "mean_positive_power"):
        found = find_orbit(problem(STRONG, minimise=other), Settings(1))
        assert cheap.objective < found.value_of(metabolic)


def test_the_flight_does_not_depend_on_what_drives_it():
    """The flight model of a vehicle with a muscle, a motor and springs is the one without."""
    driven = PIGEON.with_muscle().with_values({**MOTOR, "springs.stiffness": 0.3})
    assert problem(driven).model == problem(PIGEON).model
    assert problem(driven).vehicle.muscle is not None


def test_the_record_has_the_numbers_of_muscle_and_motor():
    orbit = wb.solve_orbit(problem(STRONG.with_values(MOTOR)), starts=1)
    record = orbit.record()
    for name in (
        "metabolic_power",
        "peak_activation",
        "muscle_work_per_mass",
        "electrical_power",
        "rms_motor_torque",
    ):
        assert record[name] > 0.0, name
    assert record["vehicle"]["muscle"]["isometric_stress"] == 1e6
    assert "metabolic_power" not in wb.solve_orbit(problem(PIGEON), starts=1).record()


def test_the_shortest_endurance_is_not_sought():
    with pytest.raises(wb.InvalidInputError, match="is best where it is largest; minimise electrical_power"):
        problem(DRIVEN, minimise="endurance")


BATTERY = {"battery.cells": 5, "battery.capacity": 0.85, "battery.internal_resistance": 0.06}


def test_the_record_says_how_long_a_battery_lasts():
    """The beat takes what the cells give from full to the end of the flight, less a few per cent of heat."""
    orbit = wb.solve_orbit(problem(PIGEON.with_values({**MOTOR, **BATTERY}), minimise="electrical_power"), starts=1)
    record = orbit.record()
    assert record["flight_range"] == pytest.approx(12.0 * record["endurance"])
    spent = record["electrical_power"] * record["endurance"] / 3600.0  # [Wh]
    held = 0.85 * 5 * 3.83 * (1.0 - record["charge_left"])  # at the cell's mean voltage, 3.83 V
    assert 0.95 * held < spent < 0.99 * held
    text = orbit.summary()
    assert f"{record['endurance'] / 60:.4g} min" in text
    assert f"{record['flight_range'] / 1000:.4g} km" in text
    bare = wb.solve_orbit(problem(PIGEON.with_values(MOTOR), minimise="electrical_power"), starts=1).record()
    assert bare["electrical_power"] == pytest.approx(record["electrical_power"])
    assert "endurance" not in bare


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({}, []),
        ({"battery.cells": 3}, ["cannot feed this beat: the full battery has 12.3 V", "the motor needs 14.5 V"]),
        (
            {"battery.cells": 4, "battery.internal_resistance": 0.1},
            ["voltage ends the flight with", "limit peak_motor_voltage"],
        ),
        ({"battery.max_current": 5.0}, ["may give at most 5 A"]),
        ({"battery.capacity": 25.0}, ["the best lithium cells alone hold 350 Wh/kg"]),
    ],
)
def test_a_battery_that_gives_too_little_is_warned_of(cheap, change, says):
    """The beat of least metabolic power, driven by a motor: its largest voltage is 13.6 V, its mean power 60 W."""
    drive = PIGEON.with_values({**MOTOR, **BATTERY, **change}).vehicle.drive
    notes = battery_warnings(cheap.beat()._replace(drive=drive))
    assert len(notes) == bool(says)
    assert all(one in notes[0] for one in says)


def test_a_limit_on_activation_holds(cheap):
    used = cheap.value_of(wb.objectives.named_quantity("peak_activation"))
    limited = find_orbit(
        problem(STRONG, minimise="metabolic_power", subject_to=f"peak_activation<={0.95 * used}"), Settings(2)
    )
    assert limited.status is wb.Status.CONVERGED
    assert limited.value_of(wb.objectives.named_quantity("peak_activation")) <= 0.95 * used * (1 + 1e-6)
    assert limited.objective > cheap.objective


def test_faster_muscles_of_one_stress_cost_less_as_finite_differences_say(cheap):
    rate = next(p for p in parameters_of(cheap.problem) if p.path == "muscle.max_strain_rate")
    change = OptimumSlopes(cheap.problem, cheap.unknowns).by(rate).objective
    step = 1e-3 * rate.value
    values = [
        find_orbit(rate.changed(cheap.problem, rate.value + sign * step), Settings(1)).objective for sign in (1, -1)
    ]
    assert change < 0.0
    assert change == pytest.approx((values[0] - values[1]) / (2 * step), rel=1e-3)


@pytest.mark.parametrize(("name", "part"), [("metabolic_power", "muscle"), ("electrical_power", "motor")])
def test_a_quantity_of_what_the_vehicle_lacks_is_refused(name, part):
    with pytest.raises(wb.InvalidInputError, match=f"needs a {part}, and the vehicle has none; add a {part}"):
        problem(PIGEON, minimise=name)


@pytest.mark.parametrize("crank", [0, 1])
def test_quantities_of_a_beat_are_those_of_a_reference(cheap, crank):
    """NumPy along the series of the beat, behind springs; the rotor's inertia is left out."""
    species = DRIVEN.with_values({"motor.crank": crank, "motor.rotor_inertia": 0.0})
    muscle, motor, springs, _ = species.vehicle.drive
    beat = cheap.beat()._replace(drive=species.vehicle.drive)
    flap, rate, torque = (np.asarray(getattr(beat, name))[:-1] for name in ("flap", "flap_rate", "flap_torque"))
    turning = 2.0 * np.pi * beat.frequency
    left = torque + springs.stiffness * (flap - springs.rest_angle)
    rate = rate + springs.series_compliance * spectral_rate(left, beat.frequency)
    own = rate + np.where(left > 0.0, muscle.tendon_compliance * spectral_rate(left, beat.frequency), 0.0)
    shares = np.sign(left) * own / muscle.max_flap_rate
    need = np.abs(left) / np.asarray(force_at(shares, muscle.curvature)) / muscle.depressor_torque
    need[left > 0] /= muscle.elevator_share
    load, speed = (left * rate / turning, np.full_like(rate, turning)) if crank else (left, rate)
    drives = load * speed > 0
    shaft = np.where(drives, load / motor.gear_efficiency, load * motor.gear_efficiency) / motor.gear_ratio
    current = shaft / motor.torque_constant + np.sign(speed) * motor.no_load_current
    voltage = motor.resistance * current + motor.torque_constant * motor.gear_ratio * speed
    pitching = np.maximum(np.asarray(beat.pitch_torque * beat.wing_pitch_rate)[:-1], 0.0).mean()
    isometric = np.abs(left) / np.asarray(force_at(shares, muscle.curvature))
    costs = (isometric * muscle.max_flap_rate * np.asarray(metabolic_ratio(shares))).mean()
    costs += pitching / float(best_efficiency(muscle.curvature))
    peaks = muscle.elevator_share * need[left > 0].max() + need[left < 0].max()
    waking = muscle.activation_energy * beat.frequency * muscle.mass * peaks
    given, depressing = (np.maximum(torque * own, 0.0).mean() for torque in (left, np.minimum(left, 0.0)))
    whole = muscle.recovery_factor * (costs + waking)
    animal = muscle.support_factor * (whole + muscle.resting_rate)
    wanted = {
        "peak_activation": need.max(),
        "muscle_power_per_mass": depressing / muscle.mass,
        "muscle_work_per_mass": depressing / muscle.mass / beat.frequency,
        "metabolic_power": costs,
        "activation_power": waking,
        "metabolic_rate": animal,
        "muscle_efficiency": (given + pitching) / costs,
        "net_muscle_efficiency": (given + pitching) / whole,
        "flight_efficiency": (given + pitching) / animal,
        "electrical_power": np.maximum(voltage * current, 0.0).mean() + pitching,
        "peak_motor_voltage": np.abs(voltage).max(),
        "rms_motor_current": np.sqrt((current**2).mean()),
        "rms_motor_torque": np.sqrt((shaft**2).mean()),
        "peak_motor_speed": motor.gear_ratio * np.abs(speed).max(),
    }
    for name, value in wanted.items():
        found = float(np.max(wb.objectives.named_quantity(name).of(beat)))
        assert found == pytest.approx(value, rel=5e-3), name


def spectral_rate(values, frequency):
    """Return the rate of a periodic series, by its Fourier series."""
    harmonics = 2j * np.pi * frequency * np.fft.rfftfreq(len(values), 1.0 / len(values))
    return np.fft.irfft(harmonics * np.fft.rfft(values), len(values))


@pytest.fixture(scope="module")
def slopes():
    """The derivatives of every quantity as a limit, and differences, by its name; one program holds them all."""
    names = DRIVE_NUMBERS
    limits = [wb.Constraint(name, 40.0) for name in names]
    programme, _, scaled = stock_point(problem(DRIVEN, subject_to=limits))
    path = len(programme.path_limits)
    found = programme.inequalities_jacobian(scaled)[path:]
    wanted = differences(programme.inequalities, scaled)[path:]
    rows = [list(programme.outputs.values_of(index)) for index in range(len(names))]
    return {name: (found[these], wanted[these]) for name, these in zip(names, rows, strict=True)}


@pytest.mark.parametrize("name", DRIVE_NUMBERS)
def test_derivatives_of_every_quantity(slopes, name):
    found, wanted = slopes[name]
    assert found.any()
    assert np.abs(found - wanted).max() <= 1e-5 * np.abs(found).max()


def test_a_species_says_where_its_muscle_comes_from():
    found = PIGEON.with_muscle()
    sources = {path: n for path, n in found.numbers.items() if path.startswith("vehicle.muscle.")}
    assert len(sources) == 11
    guessed = {path.rpartition(".")[2] for path, number in sources.items() if "guess" not in number.source}
    assert guessed == {
        "mass",
        "max_strain_rate",
        "curvature",
        "activation_energy",
        "recovery_factor",
        "resting_rate",
    }
    bats = wb.load_species("bat").with_muscle()
    own = [path for path in sources if path.rpartition(".")[2] not in ("activation_energy", "recovery_factor")]
    assert all("guess" in bats.numbers[path].source for path in own)
    assert bats.vehicle.muscle.tendon_compliance == found.vehicle.muscle.tendon_compliance == 0.0
    assert "1.3 rad/(N m)" in found.numbers["vehicle.muscle.tendon_compliance"].source


def test_measured_masses_of_muscle_come_before_the_law():
    """A pigeon's pectoralis has 0.193 of its mass, that of birds by the law 0.14."""
    pigeon, cockatiel = (wb.load_species(name).with_muscle() for name in ("pigeon", "cockatiel"))
    assert pigeon.vehicle.muscle.mass / pigeon.vehicle.mass == pytest.approx(0.193, abs=5e-4)
    assert pigeon.numbers["vehicle.muscle.mass"].source.startswith("A: ")
    assert cockatiel.numbers["vehicle.muscle.mass"].source.startswith("derived: ")
    assert cockatiel.vehicle.muscle.elevator_share == pytest.approx(0.2 + 0.0156 / 0.1392 * 0.09**0.016, rel=1e-12)
    assert wb.load_species("pigeon").with_alternative("muscle").vehicle == pigeon.vehicle
    robot = wb.robot(mass=0.1, wing_span=0.6, wing_area=0.06)
    with pytest.raises(wb.InvalidInputError, match='kind = "bird"'):
        robot.with_muscle()


def test_a_muscle_with_missing_numbers_is_refused():
    with pytest.raises(wb.InvalidInputError, match="must be given for a muscle"):
        PIGEON.with_values({"muscle.mass": 0.05})


@pytest.mark.parametrize(("cells", "fed"), [(1, False), (12, True)])
def test_a_draw_whose_battery_cannot_feed_it_counts_as_set_by_a_limit(cells, fed):
    """One cell lasts 0 s, however far it is from feeding the beat: no error bar describes such draws."""
    numbers = {"battery.cells": cells, "battery.capacity": 0.85, "battery.internal_resistance": 0.01}
    orbit = wb.solve_orbit(problem(PIGEON.with_values(MOTOR | numbers)), starts=1)
    slopes = wb.sensitivities(orbit, ("endurance", "frequency"))
    found = wb.uncertainty_by_samples(slopes, ("endurance", "frequency"), samples=10, share=0.1)
    limited = found["endurance"].limited
    assert limited.share == (0.0 if fed else 1.0)
    assert found["endurance"].mean > 0 if fed else limited.limits == (0.0,)
    assert found["frequency"].limited.limits != (0.0,)
