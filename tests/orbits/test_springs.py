"""Springs at the flap hinges: what they leave to the actuators, their optimum, and their names."""

import numpy as np
import pytest
from scipy.optimize import linprog

import wingbeat as wb
from wingbeat.orbits.flight.beat import best_spring
from wingbeat.orbits.problem.quantities import QUANTITIES, named_objective, parse_constraint
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.records.inputs import problem_from

PIGEON = wb.load_species("pigeon")


def beat_of(orbit):
    return [orbit.dataset[name].values for name in ("flap", "flap_rate", "hinge_power")]


def left_by(stiffness, rest_angle, flap, flap_rate, power):
    """Return the mean positive power on a fine grid, by no relation of the package's own."""
    phase, fine = np.linspace(0, 1, flap.size), np.linspace(0, 1, 40 * (flap.size - 1) + 1)
    power = power + stiffness * (flap - rest_angle) * flap_rate
    return np.trapezoid(np.maximum(np.interp(fine, phase, power), 0.0), fine)


def test_the_best_spring_is_that_of_a_linear_programme(solved):
    flap, flap_rate, power = beat_of(solved.orbit)
    found = best_spring(flap, flap_rate, power)
    # Least mean of the positive parts at the samples: each part is a variable above the power left and above zero.
    count = flap.size - 1
    moved = np.column_stack([flap * flap_rate, -flap_rate])[:-1]
    programme = linprog(
        np.append([0.0, 0.0], np.full(count, 1.0 / count)),
        A_ub=np.hstack([moved, -np.eye(count)]),
        b_ub=-power[:-1],
        bounds=[(0, None), (None, None), *[(0, None)] * count],
    )
    assert found.mean_positive_power == pytest.approx(programme.fun, rel=2e-4)
    assert found.mean_positive_power == pytest.approx(
        left_by(found.stiffness, found.rest_angle, flap, flap_rate, power), rel=1e-5
    )
    without = left_by(0.0, 0.0, flap, flap_rate, power)
    mean = np.trapezoid(power, dx=1 / count)
    assert mean < found.mean_positive_power < without
    for stiffness, rest_angle in ((0.9, 0.0), (1.1, 0.0), (1.0, 0.05), (1.0, -0.05)):
        other = left_by(stiffness * found.stiffness, found.rest_angle + rest_angle, flap, flap_rate, power)
        assert other > found.mean_positive_power * (1 - 1e-6)


def test_where_no_spring_helps_there_is_none():
    phase = np.linspace(0.0, 1.0, 257)
    flap, rate = np.cos(2 * np.pi * phase), -2 * np.pi * np.sin(2 * np.pi * phase)
    negative_spring = 3.0 * flap * rate
    assert best_spring(flap, rate, negative_spring)[:2] == (0.0, None)
    assert best_spring(flap, rate, np.ones(257)) == (0.0, None, 1.0)
    assert best_spring(flap, 0.0 * rate, -np.ones(257)) == (0.0, None, 0.0)


def test_the_power_left_is_an_objective_and_a_limit():
    limit = "spring_power(0.8,-0.2)<=45"
    soft = wb.OrbitProblem(PIGEON, speed=10.0, minimise="spring-power(2)", subject_to=[limit])
    orbit = wb.solve_orbit(soft, starts=2)
    record = orbit.record()
    assert record["status"] == "converged"
    flap, flap_rate, power = beat_of(orbit)
    middle = orbit.wingbeat.flap_mean
    assert record["objective_value"] == pytest.approx(left_by(2.0, middle, flap, flap_rate, power), rel=1e-5)
    kept = record["constraints"][limit]
    assert kept == pytest.approx(left_by(0.8, -0.2, flap, flap_rate, power), rel=1e-5)
    assert kept <= 45.0 + 1e-6
    stiff = find_orbit(wb.OrbitProblem(PIGEON, speed=10.0, minimise="mean_positive_power"), Settings(2))
    assert record["objective_value"] < stiff.objective
    assert record["objective_value"] < stiff.value_of(wb.objectives.SpringPower(2.0))
    assert stiff.value_of(wb.objectives.SpringPower(0.0)) == pytest.approx(stiff.objective, rel=1e-12)
    again = problem_from(orbit.inputs)
    assert again.minimise == soft.minimise
    assert again.subject_to == soft.subject_to


def test_shares_can_be_kept_within_limits():
    against_air = wb.Quantity("against_air", lambda beat: beat.aerodynamic_power, "W", 5.0)
    free = find_orbit(wb.OrbitProblem(PIGEON, speed=10.0), Settings(1))
    limit = 0.95 * free.value_of(against_air)
    kept = find_orbit(
        wb.OrbitProblem(PIGEON, speed=10.0, subject_to=[wb.Constraint(against_air, limit)]), Settings(2)
    )
    assert kept.status is wb.Status.CONVERGED
    assert kept.value_of(against_air) == pytest.approx(limit, rel=1e-6)


def test_names_bring_the_very_quantity_back():
    for quantity in (
        wb.objectives.SpringPower(0.5),
        wb.objectives.SpringPower(1 / 3, -0.1),
        wb.objectives.PowerCost(-1.0),
        wb.objectives.PowerCost(1e-3 / 3),
    ):
        assert named_objective(quantity.name) == quantity
    assert named_objective("spring-power(1e-2,-0.5)") == wb.objectives.SpringPower(0.01, -0.5)
    assert parse_constraint("spring_power(0.5, -0.1)<=30").quantity == wb.objectives.SpringPower(0.5, -0.1)
    assert wb.objectives.SpringPower(2).of != QUANTITIES["mean_positive_power"].of


@pytest.mark.parametrize(
    ("spring", "words"),
    [((-1,), "stiffness = -1: must be >= 0"), ((1, 4), "rest_angle = 4"), (("soft",), "must be a number")],
)
def test_springs_that_cannot_be(spring, words):
    with pytest.raises(wb.InvalidInputError, match=words):
        wb.objectives.SpringPower(*spring)
