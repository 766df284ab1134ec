"""Induced flow by momentum: its numbers, its equation at every velocity, and the flights that it refuses."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import wingbeat as wb
from wingbeat._base import FaultList
from wingbeat._jax.arrays import jax, jnp
from wingbeat.aero.closed_forms import check_descent, disc_area, induced_flow
from wingbeat.mechanics.flight_model import at_velocity, flow_at

AIR = wb.Air()
PIGEON = wb.load_species("pigeon")
MOMENTUM = wb.aero.BladeElement("su-fan", inflow="momentum")


def left(flow, area, factor, force, velocity, density=AIR.density):
    """Return what 2 rho A v |V + v n| lacks of k T, over the larger of both."""
    speed = np.hypot(*flow)
    through = np.hypot(velocity[0] - flow[0], velocity[1] - flow[1])
    pushed, wanted = 2.0 * density * area * speed * through, factor * np.hypot(*force)
    return abs(pushed - wanted) / max(pushed, wanted)


@pytest.mark.parametrize(("name", "speed", "power"), [("pigeon", 2.275, 7.05), ("bat", 0.981, 0.655)])
def test_ideal_hover(name, speed, power):
    vehicle = wb.load_species(name).vehicle
    weight = vehicle.mass * 9.81
    forward, up = induced_flow(1.225, disc_area(vehicle.wing.semi_span), 1.0, (0.0, weight), (0.0, 0.0))
    assert forward == 0.0
    assert -up == pytest.approx(speed, abs=5e-4)
    assert -up * weight == pytest.approx(power, rel=1e-3)
    assert -up == pytest.approx(math.sqrt(weight / (2 * 1.225 * math.pi * vehicle.wing.semi_span**2)), rel=1e-14)


@settings(deadline=None, max_examples=300)
@given(
    speed=st.floats(-30.0, 30.0),
    climb=st.floats(-30.0, 30.0),
    factor=st.floats(0.05, 3.0),
    weight=st.floats(1e-3, 100.0),
    semi_span=st.floats(0.02, 2.0),
)
def test_momentum_holds_the_weight_at_every_velocity_out_of_the_vortex_ring(
    speed, climb, factor, weight, semi_span
):
    area, faults = disc_area(semi_span), FaultList()
    check_descent(faults, AIR.density, area, factor, weight, (speed, climb))
    assume(not faults.faults)
    flow = induced_flow(AIR.density, area, factor, (0.0, weight), (speed, climb))
    assert left(flow, area, factor, (0.0, weight), (speed, climb)) <= 1e-12
    assert flow[0] == 0.0
    assert flow[1] < 0.0


@pytest.mark.parametrize("far", [1.0, 1.0 + 1e-9, 1.0001, 1.01, 1.1])
@pytest.mark.parametrize("round_ring", [0.0, 0.1, 0.5, 1.0, 2.0, 3.0, math.pi])
def test_momentum_holds_at_the_edge_of_the_vortex_ring(far, round_ring):
    """From straight down, twice the induced speed of hover, round the ring to hover itself."""
    weight, area = 3.1, disc_area(0.279)
    hover = math.sqrt(1.2 * weight / (2.0 * AIR.density * area))
    velocity = far * hover * math.sin(round_ring), -hover * (1.0 + far * math.cos(round_ring))
    flow = induced_flow(AIR.density, area, 1.2, (0.0, weight), velocity)
    assert left(flow, area, 1.2, (0.0, weight), velocity) <= (1e-12 if far > 1.0 + 1e-6 or round_ring else 1e-8)


def test_the_induced_flow_falls_with_speed_and_climb():
    area = disc_area(0.279)
    flows = [-induced_flow(1.2, area, 1.2, (0.0, 3.1), (speed, 0.0))[1] for speed in np.linspace(0.0, 20.0, 41)]
    climbs = [-induced_flow(1.2, area, 1.2, (0.0, 3.1), (0.0, climb))[1] for climb in np.linspace(0.0, 10.0, 41)]
    assert (np.diff(flows) < 0.0).all()
    assert (np.diff(climbs) < 0.0).all()


@pytest.mark.parametrize("speed", [50.0, 200.0])
def test_in_fast_flight_it_is_the_downwash_of_a_wing(speed):
    area, weight, factor = disc_area(0.279), 3.1, 1.2
    limit = factor * weight / (2.0 * AIR.density * area * speed)
    _, up = induced_flow(AIR.density, area, factor, (0.0, weight), (speed, 0.0))
    assert -up == pytest.approx(limit, rel=(limit / speed) ** 2)
    # That is C_L U / (pi A) of the lifting line, with k = 1.
    lift_coefficient = weight / (0.5 * AIR.density * speed**2 * 2 * 0.279 * 0.112)
    lifting_line = lift_coefficient * speed / (math.pi * 2 * 0.279 / 0.112)
    assert limit / factor == pytest.approx(lifting_line, rel=1e-12)


def test_no_factor_is_no_inflow():
    flow = induced_flow(1.2, 0.2, 0.0, (0.0, 3.1), (8.0, 0.0))
    assert np.abs(flow).max() <= 1e-15
    aero = dataclasses.replace(MOMENTUM, induced_factor=0.0)
    assert np.abs(wb.FlightModel(PIGEON.vehicle, aero, velocity=(8.0, 0.0)).induced_flow).max() <= 1e-15


def test_the_drag_of_the_body_tilts_the_flow():
    speed, climb, area = 12.0, 1.0, 2e-3
    vehicle = dataclasses.replace(PIGEON.vehicle, body=dataclasses.replace(PIGEON.vehicle.body, drag_area=area))
    model = wb.FlightModel(vehicle, MOMENTUM, AIR, (speed, climb))
    drag = 0.5 * AIR.density * area * math.hypot(speed, climb)
    force = drag * speed, vehicle.mass * AIR.gravity + drag * climb
    forward, up = model.induced_flow
    assert forward < 0.0
    assert forward / up == pytest.approx(force[0] / force[1], rel=1e-13)
    assert left(model.induced_flow, disc_area(0.279), 1.2, force, (speed, climb)) <= 1e-12
    plain = wb.FlightModel(PIGEON.vehicle, MOMENTUM, AIR, (speed, climb)).induced_flow
    assert plain[0] == 0.0
    assert abs(up - plain[1]) < 0.1 * abs(up)


@pytest.mark.parametrize("velocity", [(0.0, 0.0), (10.0, 0.0), (3.0, -2.0)])
def test_without_gravity_the_flow_is_finite(velocity):
    weightless = wb.Air(gravity=0.0)
    model = wb.FlightModel(PIGEON.vehicle, MOMENTUM, weightless, velocity)
    assert np.abs(model.induced_flow).max() <= 1e-12


@pytest.mark.parametrize("velocity", [(0.0, 0.0), (10.0, 0.0)])
def test_without_gravity_the_flow_has_a_finite_slope(velocity):
    weightless = wb.Air(gravity=0.0)

    def flow(moving):
        return jnp.stack(flow_at(PIGEON.vehicle, weightless, 1.2, moving, jnp))

    slopes = jax.jacfwd(flow)((jnp.asarray(velocity[0]), jnp.asarray(velocity[1])))
    assert np.isfinite(slopes).all()


def test_another_velocity_makes_another_flow():
    model = wb.FlightModel(PIGEON.vehicle, MOMENTUM, velocity=(10.0, 0.0))
    there = wb.FlightModel(PIGEON.vehicle, MOMENTUM, velocity=(4.0, 0.5)).induced_flow
    np.testing.assert_allclose(at_velocity(model, (4.0, 0.5)).induced_flow, there, rtol=1e-14)
    still = wb.FlightModel(PIGEON.vehicle, "su-fan")
    assert at_velocity(still, (4.0, 0.5)) is still


def test_inflow_needs_a_velocity():
    with pytest.raises(wb.InvalidInputError, match="velocity = None: is needed for the inflow"):
        wb.FlightModel(PIGEON.vehicle, MOMENTUM)


@pytest.mark.parametrize(("speed", "climb"), [(0.5, -2.0), (0.0, -0.1), (0.0, -4.9), (2.3, -2.4)])
def test_a_descent_into_its_own_wake_is_refused(speed, climb):
    with pytest.raises(wb.InvalidInputError) as refused:
        wb.OrbitProblem(PIGEON, speed=speed, climb=climb, aero=MOMENTUM)
    (fault,) = refused.value.faults
    assert (fault.where, fault.value) == ("climb", climb)
    assert fault.rule.startswith("is a descent into the wings' own wake (vortex ring)")
    assert "only below 2.5 m/s forward" in fault.rule
    assert "between 0 and 5 m/s down" in fault.rule
    assert "fly faster" in fault.fix
    with pytest.raises(wb.InvalidInputError, match="vortex ring"):
        wb.FlightModel(PIGEON.vehicle, MOMENTUM, velocity=(speed, climb))
    assert wb.OrbitProblem(PIGEON, speed=speed, climb=climb, aero="su-fan").climb == climb


@pytest.mark.parametrize(("speed", "climb"), [(0.0, 0.0), (0.0, 1.0), (0.0, -5.1), (2.6, -2.0), (10.0, -2.0)])
def test_a_flight_out_of_its_own_wake_is_taken(speed, climb):
    problem = wb.OrbitProblem(PIGEON, speed=speed, climb=climb, aero=MOMENTUM)
    assert problem.model.induced_flow[1] < 0.0


def own(alpha):
    return 1.2 * jnp.sin(2 * alpha), 1.4 - jnp.cos(2 * alpha)


@pytest.mark.parametrize(("given", "name"), [("dickinson", "Dickinson"), (own, "own")])
def test_a_model_without_an_aspect_ratio_has_no_inflow(given, name):
    with pytest.raises(wb.InvalidInputError, match="needs the aspect ratio of the wing") as refused:
        wb.aero.BladeElement(given, inflow="momentum")
    assert name.lower() in str(refused.value).lower()
    assert wb.aero.BladeElement(given, unsteady="thin-aerofoil").inflow == "none"


def test_models_with_an_aspect_ratio_have_inflow(tmp_path):
    alpha = np.arange(0.0, 91.0, 2.5)
    lift, drag = (np.asarray(part) for part in own(np.radians(alpha)))
    path = tmp_path / "wing.csv"
    rows = "".join(f"{a},{b},{c}\n" for a, b, c in zip(alpha, lift, drag, strict=True))
    path.write_text("# aspect_ratio = 6\nalpha_deg,c_l,c_d\n" + rows)
    for model in ("su-fan", "wang", path):
        assert wb.aero.BladeElement(model, inflow="momentum").coefficients.aspect_ratio in (6.0, math.inf)
