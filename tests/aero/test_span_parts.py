"""Coefficients of arm and hand apart, and an upstroke that sheds load."""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.programs import compiled
from wingbeat._base import InvalidInputError
from wingbeat._jax.arrays import jax
from wingbeat.aero.blade_element import BladeElement
from wingbeat.aero.derived_kernels import UpstrokeKernel, count_arm_strips
from wingbeat.aero.strip_forces import strip_forces
from wingbeat.records.inputs import inputs_of, problem_from
from wingbeat.records.numbers import detached_share

# Speeds along and across the chord [m/s]: six strips at five times, air from below and from above.
ALONG = np.linspace(2.0, 9.0, 30).reshape(6, 5)
ACROSS = np.linspace(-4.3, 5.1, 30).reshape(5, 6).T
FLEXED = np.radians(np.array([-175.0, -90.0, -30.0, -6.0, 6.0, 30.0, 90.0, 175.0]))


@compiled
def forces_of(kernel, shift=0.0):
    """Return the loads of strips of 1 m2 in air of 2 kg/m3; `shift` adds to the speeds across the chord."""
    return strip_forces(kernel, 2.0, 1.0, ALONG, ACROSS + shift, np.zeros_like(ALONG))


@pytest.mark.parametrize(("count", "where", "arm"), [(10, 0.5, 5), (10, 0.25, 3), (10, 0.0, 0), (7, 1.0, 7)])
def test_a_strip_whose_centre_lies_at_or_inside_the_border_is_of_the_arm(count, where, arm):
    assert count_arm_strips(count, where) == arm
    parts = BladeElement("su-fan", strips=count, hand="dickinson", hand_from=where).parts
    assert [part.strips for part in parts] == [slice(0, arm), slice(arm, count)]


@pytest.mark.parametrize("inflow", ["none", "momentum"])
def test_each_strip_has_the_coefficients_of_its_part(inflow):
    names, terms = ("su-fan", "feathered"), {"strips": 6, "inflow": inflow}
    whole = BladeElement(names[0], hand=names[1], hand_from=0.4, **terms)
    arm, hand = (BladeElement(name, **terms) for name in names)
    inner, outer = (part.strips for part in whole.parts)
    assert (inner, outer) == (slice(0, 2), slice(2, 6))
    found, of_arm, of_hand = (forces_of(one.kernel()) for one in (whole, arm, hand))
    for name in ("lift", "drag", "normal"):
        mixed, first, second = (getattr(one, name) for one in (found, of_arm, of_hand))
        np.testing.assert_allclose(mixed[inner], first[inner], rtol=1e-12)
        np.testing.assert_allclose(mixed[outer], second[outer], rtol=1e-12)
    assert np.abs(of_arm.lift - of_hand.lift).max() > 1e-3


def test_derivatives_of_both_parts_are_exact():
    kernel = BladeElement("su-fan", strips=6, hand="feathered", hand_from=0.4, upstroke_factor=0.4).kernel()
    step = 1e-6
    shifted = compiled(lambda shift: jax.jvp(lambda at: forces_of.__wrapped__(kernel, at).lift, (shift,), (1.0,)))
    _, slope = shifted(0.0)
    numerical = (forces_of(kernel, step).lift - forces_of(kernel, -step).lift) / (2 * step)
    np.testing.assert_allclose(slope, numerical, rtol=1e-6, atol=1e-9)


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


@pytest.mark.parametrize("factor", [0.0, 0.1, 1.0])
def test_flow_that_the_upstroke_lets_through_is_detached_beyond_the_angle_of_largest_lift(factor):
    """The lift of Su and Fan is largest at 40 degrees and a bit, from above as from below."""
    wing = wb.load_species("pigeon").vehicle.wing
    aero = BladeElement("su-fan", upstroke_factor=factor)
    for degrees, share in ((-10.0, 0.0), (-39.0, 0.0), (-42.0, 1.0), (39.0, 0.0), (42.0, 1.0)):
        beat = SimpleNamespace(alpha=np.full((5, 10), np.radians(degrees)))
        assert detached_share(aero, wing, beat) == pytest.approx(share)


@pytest.mark.slow
def test_an_orbit_says_what_it_was_flown_with_and_its_inputs_bring_it_back():
    hand = wb.aero.Dickinson(extension="signed-drag")
    aero = BladeElement("su-fan", strips=4, hand=hand, hand_from=0.4, upstroke_factor=0.7)
    problem = wb.OrbitProblem(wb.load_species("pigeon"), 10.0, aero=aero)
    inputs = inputs_of(problem, 1, 0)
    assert inputs["aero"]["hand"]["coefficients"] == "dickinson"
    assert problem_from(inputs).aero == aero
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
        ({"hand_from": 0.4}, "aero.hand_from = 0.4: has no effect without a hand"),
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


@pytest.mark.parametrize(("where", "name"), [(0.0, "feathered"), (1.0, "su-fan")])
def test_a_wing_that_is_all_arm_or_all_hand_has_one_model(where, name):
    kernel = BladeElement("su-fan", strips=6, hand="feathered", hand_from=where).kernel()
    np.testing.assert_array_equal(forces_of(kernel).lift, forces_of(BladeElement(name, strips=6).kernel()).lift)
