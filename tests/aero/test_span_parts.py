"""Coefficients of arm and hand apart, and an upstroke that sheds load."""

import dataclasses
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.unsteady_flights import CRUISE, PHASES, states_at, vehicle_and_beat
from wingbeat._jax.config import jax
from wingbeat.aero.blade_element import BladeElement
from wingbeat.aero.span_parts import UpstrokeKernel, count_arm_strips
from wingbeat.errors import InvalidInputError
from wingbeat.mechanics.flight_model import body_rates, motion_table
from wingbeat.results.provenance import inputs_of, problem_from

VEHICLE, BEAT = vehicle_and_beat("pigeon", every_law=True)
FLEXED = np.radians(np.array([-175.0, -90.0, -30.0, -6.0, 6.0, 30.0, 90.0, 175.0]))


def model_of(coefficients, **terms):
    return wb.FlightModel(VEHICLE, BladeElement(coefficients, **terms), velocity=CRUISE)


def loads_by(model):
    return jax.tree.map(np.asarray, wb.flight_loads(model, BEAT, states_at(PHASES), PHASES))


@pytest.mark.parametrize(("count", "where", "arm"), [(10, 0.5, 5), (10, 0.25, 3), (10, 0.0, 0), (7, 1.0, 7)])
def test_a_strip_whose_centre_lies_at_or_inside_the_border_is_of_the_arm(count, where, arm):
    assert count_arm_strips(count, where) == arm
    parts = BladeElement("su-fan", strips=count, hand="dickinson", hand_from=where).parts
    assert [part.strips for part in parts] == [slice(0, arm), slice(arm, count)]


@pytest.mark.parametrize("inflow", ["none", "momentum"])
def test_each_strip_has_the_loads_of_its_part(inflow):
    whole = loads_by(model_of("su-fan", hand="feathered", hand_from=0.35, inflow=inflow))
    arm, hand = (loads_by(model_of(name, inflow=inflow)) for name in ("su-fan", "feathered"))
    for name in ("lift", "drag", "alpha"):
        of_whole, of_arm, of_hand = (getattr(one, name) for one in (whole, arm, hand))
        np.testing.assert_allclose(of_whole[:, :3], of_arm[:, :3], rtol=1e-12, atol=1e-15)
        np.testing.assert_allclose(of_whole[:, 3:], of_hand[:, 3:], rtol=1e-12, atol=1e-15)
    assert np.abs(arm.lift - hand.lift).max() > 1e-3


def test_both_forms_of_the_equations_agree_and_their_derivatives_are_exact():
    terms = {"hand": "feathered", "hand_from": 0.35, "upstroke_factor": 0.4, "unsteady": "thin-aerofoil"}
    model, states = model_of("su-fan", **terms), states_at(PHASES)
    now = loads_by(model)
    state = np.stack(states[2:])
    rates = body_rates(model, motion_table(model, BEAT, PHASES), state)
    np.testing.assert_allclose(now.acceleration.T, rates[1:], rtol=1e-10, atol=1e-9)

    def summed(given):
        return body_rates(model, motion_table(model, BEAT, PHASES[:2]), given).sum()

    slopes = np.asarray(jax.grad(summed)(state[:, :2]))
    step, apart = 1e-6, np.eye(8).reshape(8, 4, 2)
    numerical = [
        (summed(state[:, :2] + step * one) - summed(state[:, :2] - step * one)) / (2 * step) for one in apart
    ]
    np.testing.assert_allclose(slopes.ravel(), numerical, rtol=1e-6, atol=1e-6)


def test_air_from_above_meets_a_factor_and_air_from_below_does_not():
    model = wb.aero.SuFan()
    shed, kept = UpstrokeKernel(model.kernel(), 0.3), (model.lift(FLEXED), model.drag(FLEXED))
    factor = np.where(FLEXED < 0, 0.3, 1.0)
    np.testing.assert_allclose(shed.lift_drag(FLEXED), (factor * kept[0], factor * kept[1]), rtol=1e-12)
    np.testing.assert_allclose(shed.lift_drag(np.zeros(1))[1], 0.65 * model.drag(np.zeros(1)), rtol=1e-12)
    # Smooth to the second derivative where it begins.
    begin, step = math.radians(5.0), 1e-4
    change = [
        float((shed.lift_drag(a)[1] / shed.kernel.lift_drag(a)[1])[0])
        for a in begin + step * np.arange(-2, 3)[:, None]
    ]
    assert np.abs(np.diff(change, 2)).max() / step**2 < 1.0


def test_an_orbit_says_what_it_was_flown_with_and_its_inputs_bring_it_back():
    aero = BladeElement(
        "su-fan", hand=wb.aero.Dickinson(extension="signed-drag"), hand_from=0.4, upstroke_factor=0.7
    )
    problem = wb.OrbitProblem(wb.load_species("pigeon"), 10.0, aero=aero)
    inputs = inputs_of(problem, 1, 0)
    assert inputs["aero"]["hand"]["coefficients"] == "dickinson"
    assert problem_from(inputs) == problem
    orbit = wb.solve_orbit(problem, starts=1)
    assert orbit.status is wb.Status.CONVERGED
    record = orbit.record()
    assert (record["aero"]["hand_from"], record["aero"]["upstroke_factor"]) == (0.4, 0.7)
    assert "the upstroke factor of 0.7 is a guess: no source measured it" in record["warnings"]
    assert any("of the arm" in note for note in record["warnings"])
    plain = dataclasses.replace(problem, aero=BladeElement("su-fan"))
    assert "hand" not in inputs_of(plain, 1, 0)["aero"]


@pytest.mark.parametrize(
    ("terms", "told"),
    [
        ({"hand_from": 0.4}, "aero.hand_from = 0.4: begins no hand"),
        ({"hand": "dickinson", "hand_from": 1.2}, "aero.hand_from = 1.2: must be"),
        ({"hand": "dickinson", "inflow": "momentum"}, "dickinson states none"),
        ({"hand": "byl", "force_point": "centre-of-pressure"}, "byl has none"),
        ({"hand": "sufan"}, "sufan"),
        ({"upstroke_factor": 1.5}, "aero.upstroke_factor = 1.5: must be"),
    ],
)
def test_what_cannot_be_is_refused(terms, told):
    with pytest.raises(InvalidInputError, match=told.replace(".", r"\.")):
        BladeElement("su-fan", **terms)
