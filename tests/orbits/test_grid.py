"""A sample of the grids of benchmarks/certify_grid.py: all certified, and closed by a second integrator."""

import itertools

import certify_grid
import numpy as np
import pytest

import wingbeat as wb

CLOSED = 1e-6


def assert_certified(orbit: wb.Orbit) -> None:
    record = orbit.record()
    assert record["status"] == "converged", record["message"]
    assert max(abs(miss) for miss in record["closure"].values()) <= CLOSED
    assert certify_grid.second_opinion(orbit) <= CLOSED
    assert record["optimality"] <= 1e-4
    low, high = orbit.problem.bounds["body_pitch"]
    pitch = orbit.dataset["body_pitch"].to_numpy()
    assert low - 1e-5 <= pitch.min() <= pitch.max() <= high + 1e-5
    for name in orbit.problem.free:
        low, high = orbit.problem.bounds[name]
        assert low - 1e-12 <= record["wingbeat"][name] <= high + 1e-12


@pytest.mark.parametrize(
    ("species", "aero", "speed"),
    [*itertools.product(("pigeon", "bat"), (wb.aero.SuFan, wb.aero.Dickinson), (3.0, 9.0, 20.0))],
)
def test_the_grid_is_certified(species: str, aero: type, speed: float) -> None:
    problem = wb.OrbitProblem(wb.load_species(species), speed=speed, aero=aero())
    assert_certified(wb.solve_orbit(problem, starts=2))


@pytest.mark.slow
def test_random_vehicles_are_certified() -> None:
    for problem in certify_grid.vehicles(count=8):
        assert_certified(wb.solve_orbit(problem, starts=2))


@pytest.mark.slow
@pytest.mark.parametrize(("speed", "climb"), [(8.0, 1.0), (8.0, -1.0), (0.0, 0.0)])
def test_climb_descent_and_hover_are_certified(speed: float, climb: float) -> None:
    problem = wb.OrbitProblem(wb.load_species("bat"), speed=speed, climb=climb)
    orbit = wb.solve_orbit(problem, starts=2)
    assert_certified(orbit)
    beat = 1.0 / orbit.wingbeat.frequency
    assert np.ptp(orbit.dataset["z"].to_numpy()[[0, -1]]) == pytest.approx(abs(climb) * beat, abs=1e-6)


def test_a_second_opinion_can_disagree() -> None:
    orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
    start = orbit.initial_state
    orbit._summary = orbit._summary._replace(initial_state=start._replace(u=start.u + 1e-4))
    assert certify_grid.second_opinion(orbit) > CLOSED
