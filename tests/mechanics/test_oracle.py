"""The plain NumPy oracle agrees with the package at random states of both animals, to 1e-9 relative."""

import dataclasses
import functools
import itertools

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers import oracle
from tests.helpers.models import changed
from wingbeat._jax.arrays import jax
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.mechanics.state_rates import body_rates

TOLERANCE = 1e-9
STATES = 100
STRIPS = 10
# Coefficient model, oracle's formula, force point, airspeed, laws beyond the paper's; Dickinson has no centre of
# pressure.
KINDS = [
    (wb.aero.SuFan(), oracle.su_fan, "quarter-chord", "planar", False),
    (wb.aero.SuFan(), oracle.su_fan, "centre-of-pressure", "planar", False),
    (wb.aero.Dickinson(), oracle.dickinson, "quarter-chord", "planar", False),
    (wb.aero.SuFan(), oracle.su_fan, "centre-of-pressure", "planar", True),
    (wb.aero.Dickinson(), oracle.dickinson, "quarter-chord", "full", False),
    (wb.aero.SuFan(), oracle.su_fan, "centre-of-pressure", "full", True),
]


@dataclasses.dataclass(frozen=True)
class Case:
    """One random vehicle, wingbeat and motion; q, q_dot belong to the five free coordinates."""

    model: wb.FlightModel
    wingbeat: wb.Wingbeat
    coefficients: object
    state: np.ndarray
    phase: float
    q: np.ndarray
    q_dot: np.ndarray

    @property
    def plain(self):
        """Vehicle, wingbeat and air as the oracle takes them."""
        vehicle = {part: vars(record) for part, record in vars(self.model.vehicle).items() if record is not None}
        return vehicle, vars(self.wingbeat), vars(self.model.air)

    @property
    def air_loads(self):
        """What the oracle takes to make air loads."""
        return self.coefficients, STRIPS, self.model.at_centre_of_pressure, self.model.full_airspeed

    @property
    def time(self):
        return self.phase / self.wingbeat.frequency


def richer(uniform):
    """Return every law beyond the paper's at once."""
    return {
        "pitch_phase": uniform(-1.0, 1.0),
        "downstroke_fraction": uniform(0.3, 0.7),
        "sweep_mean": uniform(-0.3, 0.3),
        "sweep_amplitude": uniform(0.0, 0.4),
        "sweep_phase": uniform(-3.0, 3.0),
        "stroke_plane_tilt": uniform(-0.5, 0.5),
        "tail_tilt": 0.3,
        "flap_harmonics": tuple(uniform(-0.1, 0.1, 4).tolist()),
        "pitch_harmonics": tuple(uniform(-0.1, 0.1, 6).tolist()),
        "span_harmonics": tuple(uniform(-0.05, 0.05, 4).tolist()),
        "chord_retraction": 0.2,
        "twist_mean": -0.1,
        "sweep_harmonics": (0.03, -0.08, 0.05, 0.02),
        "chord_harmonics": (0.08, 0.05, -0.03, 0.06),
        "twist_harmonics": (0.1, -0.2, 0.05, 0.15),
    }


def tail_of(case):
    """Return a tail for every other case, or None; its numbers do not change the others' draws."""
    uniform = np.random.default_rng(case).uniform
    if case % 2 == 0:
        return None
    return wb.Tail(uniform(1e-3, 1e-2), uniform(-0.1, 0.3), uniform(1, 4), uniform(0, 0.1), *uniform(-0.2, 0.2, 2))


def draw(species, case, random):
    """Draw a case: folds, twist, retraction, offset shoulder, tilted stroke plane, body drag, cross flow."""
    uniform = random.uniform
    coefficients, formula, force_point, airspeed, rich = KINDS[case % len(KINDS)]
    wing = dataclasses.replace(
        species.vehicle.wing,
        shoulder=tuple(uniform(-0.04, 0.04, 3).tolist()),
        stroke_plane_angle=uniform(0.8, 2.2),
        mass_exponent=uniform(0.0, 3.0),
        chord=tuple(uniform(0.03, 0.15, 4).tolist()),
    )
    body = dataclasses.replace(species.vehicle.body, drag_area=uniform(1e-4, 2e-3))
    body = dataclasses.replace(body, crossflow_area=0.0 if case % 3 == 1 else 0.01)
    loads = wb.aero.BladeElement(coefficients, STRIPS, force_point, airspeed)
    model = wb.FlightModel(wb.Vehicle(body, wing, tail_of(case)), loads, species.air)
    wingbeat = wb.Wingbeat(
        frequency=uniform(3, 12),
        flap_mean=uniform(-0.3, 0.3),
        flap_amplitude=uniform(0.2, 1.2),
        pitch_mean=uniform(-0.3, 0.5),
        pitch_amplitude=uniform(0.0, 0.8),
        span_retraction=uniform(0.05, 0.5),
        twist_ratio=uniform(0.5, 2.0),
        fold_amplitude=uniform(0.05, 0.6),
        wrist=uniform(0.2, 0.8),
        **(richer(uniform) if rich else {}),
    )
    state = uniform([-1, -1, -1, -2, -3, -8], [1, 1, 1, 12, 3, 8])
    angles = uniform([-1, -1], [1, 1])
    q_dot = np.array([*state[3:], *uniform([-30, -30], [30, 30])])
    return Case(model, wingbeat, formula, state, uniform(-0.5, 1.5), np.array([*state[:3], *angles]), q_dot)


@functools.cache
def cases(name):
    """Return random cases whose every strip flies outside the blends, which the oracle does not know."""
    random = np.random.default_rng(["pigeon", "bat"].index(name))
    species, found = wb.load_species(name), []
    for i in itertools.count():
        case = draw(species, len(found), random)
        try:
            vehicle, wingbeat, air = case.plain
            oracle.accelerations(vehicle, wingbeat, air, case.state, case.phase, *case.air_loads)
            oracle.aero_forces(vehicle, wingbeat, air, case.q, case.q_dot, case.time, *case.air_loads)
        except ValueError:
            assert i < 20 * STATES
            continue
        found.append(case)
        if len(found) == STATES:
            return found


def prescribed(case):
    """Return the package's accelerations, torques, powers, energies with the wing motion prescribed."""
    state = wb.State(*case.state[:, None])
    now = wb.flight_loads(case.model, case.wingbeat, state, np.array([case.phase]))
    return {
        "accelerations": now.acceleration[0],
        "torques": np.array([now.flap_torque[0], now.pitch_torque[0]]),
        "hinge_power": now.hinge_power,
        "actuator_power": now.actuator_power,
        "air_power": now.air_power,
        "kinetic_energy": now.kinetic_energy,
        "potential_energy": now.potential_energy,
    }


def prescribed_by_oracle(case, vehicle=None, wingbeat=None):
    """Return the oracle's, of another vehicle or wingbeat if one is given."""
    own_vehicle, own_wingbeat, air = case.plain
    args = (vehicle or own_vehicle, wingbeat or own_wingbeat, air, case.state, case.phase)
    hinge, actuator = oracle.powers(*args, *case.air_loads)
    kinetic, potential = oracle.energies(*args, STRIPS)
    return {
        "accelerations": oracle.accelerations(*args, *case.air_loads),
        "torques": oracle.hinge_torques(*args, *case.air_loads),
        "hinge_power": hinge,
        "actuator_power": actuator,
        "air_power": oracle.air_power(*args, *case.air_loads),
        "kinetic_energy": kinetic,
        "potential_energy": potential,
    }


def miss(found, wanted):
    """Return the largest miss over the largest entry of the wanted array."""
    found, wanted = np.atleast_1d(found), np.atleast_1d(wanted)
    return float(np.abs(found - wanted).max() / np.abs(wanted).max())


def by_row(found, wanted):
    """Return the largest miss of any single entry over that entry itself."""
    gap, wanted = np.atleast_1d(found) - wanted, np.atleast_1d(wanted)
    wrong = gap != 0
    return float(np.max(np.abs(gap[wrong] / wanted[wrong]), initial=0.0))


def worst(misses):
    """Return the worst of many dictionaries of misses, name by name."""
    rows = list(misses)
    return {name: max(row[name] for row in rows) for name in rows[0]}


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_accelerations_torques_and_powers(name):
    found = worst(
        {key: by_row(value, wanted[key]) for key, value in prescribed(case).items()}
        for case in cases(name)
        for wanted in [prescribed_by_oracle(case)]
    )
    assert max(found.values()) <= TOLERANCE, found


def five_coordinates(model, wingbeat, *motion):
    return wb.equations_of_motion(model, wingbeat, *motion), wb.air_forces(model, wingbeat, *motion)


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_five_coordinate_terms(name):
    def misses(case):
        vehicle, wingbeat, air = case.plain
        terms, loads = five_coordinates(case.model, case.wingbeat, case.q, case.q_dot, case.time)
        wanted = oracle.five_coordinate(vehicle, wingbeat, air, case.q, case.q_dot, case.time, STRIPS)
        forces, strips = oracle.aero_forces(vehicle, wingbeat, air, case.q, case.q_dot, case.time, *case.air_loads)
        return {
            "D": miss(terms.mass_matrix, wanted["D"]),
            "C": miss(terms.velocity_matrix, wanted["C"]),
            "h": miss(terms.time_force, wanted["h"]),
            "g": miss(terms.gravity_force, wanted["g"]),
            "f_aero": by_row(loads.generalised, forces),
            "alpha": miss(loads.strips.alpha, strips["alpha"]),
            "lift": miss(loads.strips.lift, strips["lift"]),
            "drag": miss(loads.strips.drag, strips["drag"]),
        }

    found = worst(misses(case) for case in cases(name))
    assert max(found.values()) <= TOLERANCE, found


@jax.jit
def fast_path(model, wingbeat, state, phase):
    return body_rates(model, motion_table(model, wingbeat, phase), state[2:])[1:]


def first_three_rows(case):
    """Return the body's accelerations from the five-coordinate equations, the wing's motion prescribed."""
    flap, pitch = oracle.wing_angles(vars(case.wingbeat), case.phase)
    angles, rates, accelerations = np.transpose([flap, pitch])
    q, q_dot = np.concatenate([case.state[:3], angles]), np.concatenate([case.state[3:], rates])
    terms, loads = five_coordinates(case.model, case.wingbeat, q, q_dot, case.time)
    mass_matrix = np.asarray(terms.mass_matrix)
    resisting = terms.velocity_matrix @ q_dot + terms.time_force + terms.gravity_force
    right = np.asarray(loads.generalised - resisting)[:3] - mass_matrix[:3, 3:] @ accelerations
    return np.linalg.solve(mass_matrix[:3, :3], right)


@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_the_fast_path_is_the_first_three_rows(name):
    for case in cases(name):
        fast = fast_path(case.model, case.wingbeat, case.state, case.phase)
        assert by_row(fast, first_three_rows(case)) <= TOLERANCE


def test_the_blends_change_nothing_but_coefficients():
    """Where strips do fly inside a blend, the oracle with the package's own coefficients agrees."""
    random, species, model, blended = np.random.default_rng(5), wb.load_species("bat"), wb.aero.SuFan(), 0
    while blended < 3:
        case, met = draw(species, 1, random), []

        def coefficients(alpha, met=met):
            met.append(oracle.blend_distance(alpha))
            return float(model.lift(alpha)), float(model.drag(alpha)), float(model.centre_of_pressure(alpha))

        case = dataclasses.replace(case, coefficients=coefficients)
        vehicle, wingbeat, air = case.plain
        oracle.accelerations(vehicle, wingbeat, air, case.state, case.phase, *case.air_loads)
        if min(met) >= 1.0:
            continue
        blended += 1
        wanted = prescribed_by_oracle(case)
        found = {key: by_row(value, wanted[key]) for key, value in prescribed(case).items()}
        assert max(found.values()) <= TOLERANCE, found


def test_the_whole_airspeed_makes_other_loads_than_that_across_the_span():
    case = cases("bat")[4]
    planar = dataclasses.replace(case, model=changed(case.model, full_airspeed=False))
    wanted, without = prescribed_by_oracle(case), prescribed_by_oracle(planar)
    assert by_row(without["air_power"], wanted["air_power"]) > 1e-3
    assert by_row(prescribed(planar)["air_power"], without["air_power"]) <= TOLERANCE


@pytest.mark.parametrize(
    ("part", "key", "change"),
    [
        ("body", "mass", 1 + 1e-7),
        ("body", "drag_area", 1 + 1e-5),
        ("body", "crossflow_area", 1 + 1e-5),
        ("body", "pitch_inertia", 1 + 1e-7),
        ("wing", "mass_exponent", 1 + 1e-7),
        ("wing", "stroke_plane_angle", 1 + 1e-7),
        ("wing", "semi_span", 1 + 1e-7),
        ("beat", "fold_amplitude", 1 + 1e-7),
        ("beat", "span_retraction", 1 + 1e-7),
        ("beat", "twist_ratio", 1 + 1e-7),
        ("beat", "frequency", 1 + 1e-7),
        ("beat", "pitch_phase", 1 + 1e-6),
        ("beat", "downstroke_fraction", 1 + 1e-7),
        ("beat", "sweep_mean", 1 + 1e-7),
        ("beat", "sweep_amplitude", 1 + 1e-7),
        ("beat", "sweep_phase", 1 + 1e-7),
        ("beat", "stroke_plane_tilt", 1 + 1e-7),
        ("beat", "tail_tilt", 1 + 1e-6),
        *(("tail", name, 1 + 1e-6) for name in ("area", "arm", "lift_slope", "incidence")),
        *(("tail", name, 1 + 1e-5) for name in ("drag_coefficient", "height")),
        ("beat", "flap_harmonics", 1 + 1e-7),
        ("beat", "pitch_harmonics", 1 + 1e-7),
        ("beat", "span_harmonics", 1 + 1e-7),
        ("beat", "chord_retraction", 1 + 1e-7),
        ("beat", "twist_mean", 1 + 1e-7),
        ("beat", "sweep_harmonics", 1 + 1e-7),
        ("beat", "chord_harmonics", 1 + 1e-7),
        ("beat", "twist_harmonics", 1 + 1e-7),
    ],
)
def test_the_comparison_sees_a_ten_millionth(part, key, change):
    case = cases("bat")[3]
    vehicle, wingbeat, _ = case.plain
    parts = {name: dict(numbers) for name, numbers in vehicle.items()} | {"beat": dict(wingbeat)}
    parts[part][key] = np.multiply(parts[part][key], change)
    other = prescribed_by_oracle(case, parts, parts["beat"])
    assert max(by_row(value, other[name]) for name, value in prescribed(case).items()) > TOLERANCE
