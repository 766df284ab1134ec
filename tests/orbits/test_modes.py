"""Hover, climb, descent and payload: every one certified, and what must be true of any of them."""

import json

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.reflight import refly
from wingbeat.cli import main

SPECIES = {name: wb.load_species(name) for name in ("pigeon", "bat")}
OBJECTIVES = ("frequency", "mean_positive_power")
CLIMBS = (-2.0, 0.5, 3.0)


@pytest.fixture(scope="module", params=SPECIES)
def climbs(request):
    """Return the orbits at 8 m/s by objective, in order of climb."""
    species = SPECIES[request.param]
    return {
        objective: wb.solve_orbits(
            [wb.OrbitProblem(species, speed=8.0, climb=climb, minimise=objective) for climb in CLIMBS],
            starts=2,
            in_order=True,
        )
        for objective in OBJECTIVES
    }


@pytest.mark.slow
@pytest.mark.parametrize("objective", OBJECTIVES)
def test_climb_and_descent_are_certified_and_climbing_costs_more(climbs, objective):
    records = [orbit.record() for orbit in climbs[objective]]
    for record, climb in zip(records, CLIMBS, strict=True):
        assert record["status"] == "converged", record["message"]
        assert record["climb"] == climb
        assert max(map(abs, record["closure"].values())) <= 3e-7
    costs = [record["objective_value"] for record in records]
    assert costs == sorted(costs)


@pytest.mark.slow
def test_the_vehicle_rises_as_asked_and_the_actuators_pay_for_it(climbs):
    """SciPy flies one beat: what height is gained, and weight times climb is what actuators and air do not undo."""
    orbit = climbs["frequency"][-1]
    problem = orbit.problem
    weight = problem.vehicle.mass * problem.air.gravity
    flown = refly(problem.model, orbit.wingbeat, np.array(orbit.initial_state))
    frequency = orbit.wingbeat.frequency
    assert flown.end[1] * frequency == pytest.approx(3.0, abs=1e-6)
    power, air = (frequency * flown.integrals[name] for name in ("actuator_power", "air_power"))
    assert power + air == pytest.approx(3.0 * weight, rel=1e-6)


@pytest.mark.parametrize("objective", OBJECTIVES)
@pytest.mark.parametrize("name", SPECIES)
def test_hover_is_certified(name, objective):
    problem = wb.OrbitProblem(SPECIES[name], speed=0.0, minimise=objective)
    record = wb.solve_orbit(problem, starts=3).record()
    assert record["status"] == "converged", record["message"]
    assert max(map(abs, record["closure"].values())) <= 3e-7
    assert record["cost_of_transport"] is None
    assert any("no induced flow" in warning for warning in record["warnings"])


def test_a_payload_asks_for_a_faster_wingbeat_and_is_in_the_record(capsys):
    words = ["orbit", "pigeon", "--speed", "12", "--starts", "1", "--json"]
    assert main(words) == 0
    light = json.loads(capsys.readouterr().out)
    assert main([*words, "--payload", "0.05", "--set", "wing.mass=0.021"]) == 0
    heavy = json.loads(capsys.readouterr().out)
    body = light["vehicle"]["body"]
    assert heavy["vehicle"]["body"] == {**body, "mass": pytest.approx(body["mass"] + 0.05)}
    assert heavy["vehicle"]["wing"]["mass"] == 0.021
    assert heavy["wingbeat"]["frequency"] > light["wingbeat"]["frequency"]
    assert main([*words, "--payload", "-0.05"]) == 2
    assert "payload = -0.05: must be >= 0 kg; 0 is no load" in capsys.readouterr().err


def test_what_is_divided_by_the_speed_is_refused_in_hover():
    mine = wb.Quantity("per_metre", lambda beat: beat.weight / beat.speed, in_hover="use the weight")
    for name, asked in (("cost_of_transport", "cost-of-transport"), ("per_metre", mine)):
        with pytest.raises(wb.InvalidInputError, match=f"leaves {name} undefined; in hover use"):
            wb.OrbitProblem(SPECIES["pigeon"], speed=0.0, minimise=asked)
    with pytest.raises(wb.InvalidInputError, match="leaves strouhal undefined; in hover limit frequency"):
        wb.OrbitProblem(SPECIES["pigeon"], speed=0.0, subject_to="strouhal<=0.4")
