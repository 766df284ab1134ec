"""Shares of the unsteady terms, and certified orbits with all terms."""

import dataclasses

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

import wingbeat as wb
from tests.helpers.models import changed
from tests.helpers.programs import compiled
from tests.helpers.spent_power import spends_what_it_says
from tests.helpers.unsteady_flights import (
    NAMES,
    PHASES,
    SAMPLES,
    all_terms,
    coordinates,
    flown_with,
    loads,
    states_at,
)
from wingbeat._jax.arrays import jnp
from wingbeat.mechanics.flight_model import air_loads, motion_table
from wingbeat.mechanics.flights import fly_beats
from wingbeat.mechanics.wing_motion import stroke_attitude
from wingbeat.orbits.solution import search_near
from wingbeat.records.flight_dataset import evaluate

pytestmark = pytest.mark.slow

# --- Shares


@pytest.mark.parametrize("name", NAMES)
def test_none_of_the_unsteady_terms_is_steady_air(name):
    model, beat = flown_with(name, False, inflow="momentum")
    steady, _ = flown_with(name, False, inflow="momentum", unsteady="none")
    states = states_at(PHASES)
    none, whole, without = (
        loads(one, beat, states, PHASES) for one in (changed(model, unsteady=np.asarray(0.0)), model, steady)
    )
    for field in ("acceleration", "air_force", "flap_torque", "pitch_torque", "actuator_power", "strip_force"):
        one, other = getattr(none, field), getattr(without, field)
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-12 * np.abs(other).max(), err_msg=field)
        assert np.abs(getattr(whole, field) - other).max() > 1e-2 * np.abs(other).max()


@compiled
def air_loads_of(model, beat, states):
    motion = motion_table(model, beat, PHASES)
    attitude = stroke_attitude(model.vehicle.wing, motion, states.body_pitch)
    found = air_loads(model, motion, attitude, states.u, states.w, states.pitch_rate)
    return jnp.stack([*found.force, found.moment])


@pytest.mark.parametrize("name", NAMES)
def test_loads_are_linear_in_the_share_of_the_unsteady_terms(name):
    model, beat = all_terms(name)
    none, some, all_of_it = (
        np.asarray(air_loads_of(changed(model, unsteady=np.asarray(share)), beat, states_at(PHASES)))
        for share in (0.0, 0.3, 1.0)
    )
    np.testing.assert_allclose(some, none + 0.3 * (all_of_it - none), atol=1e-13 * np.abs(all_of_it).max())
    assert np.abs(all_of_it - none).max() > 0.01 * np.abs(none).max()


# --- Orbits


@pytest.fixture(scope="module", params=NAMES)
def orbit(request):
    """A certified orbit with all terms, body drag included."""
    species = wb.load_species(request.param).with_values({"body.drag_area": 5e-4})
    aero = wb.aero.BladeElement("su-fan", unsteady="thin-aerofoil", inflow="momentum", induced_factor=1.2)
    return wb.solve_orbit(wb.OrbitProblem(species, speed=10.0, aero=aero), starts=1)


@pytest.fixture(scope="module")
def slopes(orbit):
    """The sensitivities of the orbit's frequency, by the path of the parameter."""
    return {one.parameter.path: one for one in wb.sensitivities(orbit, quantities=("frequency",)).slopes}


def test_on_an_orbit_with_all_terms_the_air_holds_the_weight(orbit):
    """The mean over a beat by SciPy's spline through 4 096 separate evaluations of the five coordinates."""
    assert orbit.status is wb.Status.CONVERGED, orbit.message
    assert max(map(abs, orbit.record()["closure"].values())) <= 1e-6
    model, beat = orbit.problem.model, orbit.wingbeat
    phase, flown = fly_beats(model, beat, orbit.initial_state, 1, SAMPLES)[:2]
    states = wb.State(*flown.T)
    now = evaluate(model, beat, phase, flown)
    *motion, acceleration = coordinates(beat, now, states, phase)
    found = wb.air_forces(model, beat, *motion, phase / beat.frequency, acceleration)
    weight = model.vehicle.mass * model.air.gravity
    mean = CubicSpline(phase, np.asarray(found.generalised)[:, :2]).integrate(0.0, 1.0)
    assert abs(mean[1] / weight - 1.0) <= 1e-6
    assert abs(mean[0]) <= 1e-6 * weight
    change = np.diff(np.asarray(now.momentum)[[0, -1]], axis=0)[0] * beat.frequency
    assert np.abs(change).max() <= 1e-6 * weight
    assert np.abs(mean - [0.0, weight] - change).max() <= 1e-7 * weight
    # What the actuators put in, the air takes out.
    powers = np.stack([now.actuator_power, now.air_power, np.asarray(found.power)], axis=-1)
    put_in, taken, again = CubicSpline(phase, powers).integrate(0.0, 1.0)
    assert abs(put_in + taken) <= 1e-6 * put_in
    assert abs(taken - again) <= 1e-9 * put_in
    assert orbit.record()["mean_actuator_power"] == pytest.approx(put_in, rel=1e-5)


def test_what_the_actuators_spend_adds_up_with_all_terms(orbit):
    means, model = spends_what_it_says(orbit), orbit.problem.model
    weight, flow = model.vehicle.mass * model.air.gravity, np.hypot(*model.induced_flow)
    assert means["induced"] == pytest.approx(weight * flow, rel=0.05)
    assert means["parasite"] > 0.1


def test_the_mean_force_of_the_wings_is_what_made_the_inflow(orbit):
    model, beat = orbit.problem.model, orbit.wingbeat
    body = dataclasses.replace(model.vehicle.body, drag_area=0.0)
    wings = changed(model, vehicle=dataclasses.replace(model.vehicle, body=body))
    phase, flown = fly_beats(model, beat, orbit.initial_state, 1, SAMPLES)[:2]
    now = evaluate(model, beat, phase, flown)
    motion = coordinates(beat, now, wb.State(*flown.T), phase)
    found = wb.air_forces(wings, beat, *motion[:2], phase / beat.frequency, motion[2])
    force = CubicSpline(phase, np.asarray(found.generalised)[:, :2]).integrate(0.0, 1.0)
    area = np.pi * model.vehicle.wing.semi_span**2
    flow = np.array(model.induced_flow)
    speed = np.linalg.norm(flow)
    through = np.linalg.norm(np.array([10.0, 0.0]) - flow)
    pushed = 2.0 * model.air.density * area * speed * through
    # The drag of a body that moves unsteadily differs a little from that at its mean velocity.
    assert pushed == pytest.approx(1.2 * np.linalg.norm(force), rel=1e-3)
    np.testing.assert_allclose(-flow / speed, force / np.linalg.norm(force), rtol=0, atol=1e-3)


# --- Sensitivities, files


@pytest.mark.parametrize("path", ["aero.induced_factor", "air.density", "wing.semi_span"])
def test_sensitivities_with_all_terms_are_those_of_orbits_solved_again(orbit, slopes, path):
    """Searched again from the orbit itself: from starts of their own, they would end in other families."""
    slope = slopes[path]
    parameter = slope.parameter
    step = 2e-3 * parameter.size
    again = [
        search_near(parameter.changed(orbit.problem, parameter.value + side * step), orbit.unknowns)
        for side in (-1.0, 1.0)
    ]
    assert [one.status for one in again] == [wb.Status.CONVERGED] * 2
    difference = (again[1].objective - again[0].objective) / (2.0 * step)
    assert slope.quantities["frequency"] == pytest.approx(difference, rel=2e-2)


def test_an_orbit_with_all_terms_comes_back_from_its_file(orbit, tmp_path):
    orbit.save(tmp_path / "orbit.nc")
    again = wb.load_orbit(tmp_path / "orbit.nc")
    assert again.record() == orbit.record()
    assert again.record()["aero"]["inflow"] == "momentum"
    assert again.problem.model.induced_flow == orbit.problem.model.induced_flow
