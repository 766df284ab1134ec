"""Models of animal wings: the whole turn, the two sides, what was measured, and how a record brings them back."""

import math

import numpy as np
import pytest
from hypothesis import given, seed, settings
from hypothesis import strategies as st

import wingbeat as wb
from tests.helpers.coefficients import by_the_lifting_line, check_derivative_in_numbers, value_slope_curvature
from wingbeat._jax.arrays import jax, jnp
from wingbeat.aero import (
    WING_ESTIMATES,
    CamberedCoefficients,
    CamberedTerms,
    Feathered,
    FeatheredFlapping,
    FeatheredRevolving,
    Membrane,
    SuFan,
)
from wingbeat.aero.derived_kernels import sectional_kernel

NAMES = sorted(WING_ESTIMATES)
TURN = np.radians(np.linspace(-180.0, 180.0, 3601))
TERMS = {name: estimate.value for name, estimate in WING_ESTIMATES["feathered"].items()}


MAKERS = {
    "feathered": Feathered,
    "feathered-revolving": FeatheredRevolving,
    "feathered-flapping": FeatheredFlapping,
    "membrane": Membrane,
}


def model_of(name):
    assert wb.aero.LIBRARY[name] is MAKERS[name]
    return MAKERS[name]()


def by_hand(terms, alpha):
    """Return C_L and C_D of the formulas, written once more, with the angle in radians."""

    def ramp(x, w):
        return (x + np.sqrt(x**2 + w**2)) / 2

    above = alpha - math.radians(terms["zero_lift_deg"])
    line, rounding = terms["lift_slope"] * above, terms["lift_rounding"]
    low, high = terms["lift_lowest"], terms["lift_highest"]
    lift = low + ramp(line - low, rounding) - ramp(line - high, rounding)
    bend = math.radians(terms["onset_rounding_deg"])
    below = terms["low_rise"] * ramp(math.radians(terms["low_onset_deg"]) - above, bend)
    beyond = terms["high_rise"] * ramp(above - math.radians(terms["high_onset_deg"]), bend)
    return lift, terms["drag_least"] + terms["drag_induced"] * lift**2 + below + beyond


@pytest.mark.parametrize("name", NAMES)
def test_between_the_joins_it_is_its_formula_and_beyond_them_the_plate(name):
    model, plate = model_of(name), SuFan()
    low, high = np.radians(model.alpha_range_deg)
    inside = np.linspace(low, high, 400)
    for found, wanted in zip(
        (model.lift(inside), model.drag(inside)), by_hand(vars(model.terms), inside), strict=True
    ):
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-14)
    far = TURN[(math.radians(model.low_join_deg[0]) >= TURN) | (math.radians(model.high_join_deg[1]) <= TURN)]
    np.testing.assert_allclose(model.lift(far), plate.lift(far), rtol=0, atol=1e-14)
    np.testing.assert_allclose(model.drag(far), plate.drag(far), rtol=0, atol=1e-14)


@pytest.mark.parametrize("name", NAMES)
def test_value_slope_and_curvature_run_on_over_the_whole_turn(name):
    model, step = model_of(name), 1e-7
    joins = np.radians([*model.low_join_deg, *model.high_join_deg])
    edges = np.concatenate([joins, [sum(joins[:2]) / 2, sum(joins[2:]) / 2]])
    before, after = (value_slope_curvature(model, edges + side * step) for side in (-1.0, 1.0))
    for low, high, room in zip(before, after, (1e-6, 1e-5, 1e-3), strict=True):
        np.testing.assert_allclose(low[:, :2], high[:, :2], rtol=0, atol=room)
    ends = value_slope_curvature(model, np.array([-math.pi, math.pi]))
    for values in ends[:2]:
        np.testing.assert_allclose(values[0, :2], values[1, :2], rtol=0, atol=1e-9)
    # Between neighbours of 0.1 degrees nothing jumps: the plate's own blend is the steepest, about 13 per radian.
    for values in (model.lift(TURN), model.drag(TURN)):
        assert np.abs(np.diff(values)).max() < 14 * (TURN[1] - TURN[0])


@pytest.mark.parametrize("name", NAMES)
def test_the_two_sides_differ_and_drag_is_positive_everywhere(name):
    model = model_of(name)
    assert model.drag(TURN).min() > 0.02
    from_below, from_above = (float(model.lift(math.radians(angle))) for angle in (15.0, -15.0))
    assert from_below > 1.0
    assert -0.3 < from_above < -0.1
    # Air from above meets more drag than air from below at the same distance from zero lift.
    zero = math.radians(model.terms.zero_lift_deg)
    assert model.drag(zero - 0.2) > 2 * model.drag(zero + 0.2)


def test_the_joins_make_no_lift_of_their_own():
    for name in NAMES:
        model = model_of(name)
        upper = np.radians(np.linspace(*model.high_join_deg, 200))
        lower = np.radians(np.linspace(*model.low_join_deg, 200))
        top, bottom = model.terms.lift_highest, -SuFan().lift(math.radians(40.0))
        assert model.lift(upper).max() <= top
        assert model.lift(lower).min() >= bottom - 1e-3
        assert (np.diff(model.drag(upper)) > 0).all()
        assert (np.diff(model.drag(lower)) < 0).all()


def test_a_flapping_wing_glides_as_a_gliding_one_and_stalls_as_a_revolving_one():
    flapping, revolving, gliding = (model_of(f"feathered{kind}") for kind in ("-flapping", "-revolving", ""))
    stalled, attached = math.radians(43.0), math.radians(4.0)
    assert flapping.lift(stalled) == pytest.approx(float(revolving.lift(stalled)), abs=0.01)
    assert flapping.drag(stalled) == pytest.approx(0.87, abs=0.005)
    assert flapping.lift(attached) == pytest.approx(float(gliding.lift(attached)), abs=0.03)
    assert flapping.drag(attached) == pytest.approx(float(gliding.drag(attached)), rel=0.05)


def test_the_ratio_of_feathered_wings_is_that_of_the_jackdaw():
    """Klein Heerenbrink et al. 2016: about 15 for the wings alone, of an aspect ratio of 5.6 in the frames."""
    model = model_of("feathered")
    lift, drag = model.lift(TURN), model.drag(TURN)
    assert model.aspect_ratio == 6.0
    ratio = lift / (drag + lift**2 / math.pi * (1 / 5.6 - 1 / 6.0))
    assert ratio.max() == pytest.approx(15.5, rel=0.08)
    assert 0.5 < lift[ratio.argmax()] < 0.8


def test_revolving_pigeon_wings_as_measured():
    """Usherwood 2009: C_L of 1.64 at 43 degrees; Crandell and Tobalske 2011: a ratio of 6.3 at most."""
    model = model_of("feathered-revolving")
    assert float(model.lift(math.radians(43.0))) == pytest.approx(1.64, abs=5e-3)
    assert np.degrees(TURN[model.lift(TURN).argmax()]) == pytest.approx(43.0, abs=2.0)
    assert (model.lift(TURN) / model.drag(TURN)).max() == pytest.approx(6.3, rel=0.01)
    assert model.aspect_ratio is None
    with pytest.raises(wb.InvalidInputError, match="feathered-revolving states none"):
        wb.aero.BladeElement("feathered-revolving", inflow="momentum")


@pytest.mark.parametrize("name", ["feathered", "membrane"])
def test_its_section_makes_the_wing_again(name):
    model = model_of(name)
    kernel = sectional_kernel(model)
    alpha, lift, drag = by_the_lifting_line(kernel, model.aspect_ratio, TURN)
    apart = np.maximum(np.abs(lift - model.lift(alpha)), np.abs(drag - model.drag(alpha)))
    from_blend = np.abs((np.degrees(alpha) + 45.0) % 90.0 - 45.0)
    assert apart[from_blend > 1.5].max() <= 5e-5
    assert np.asarray(kernel.lift_drag(TURN)[1]).min() > 0.01


def test_every_number_has_its_interval_and_says_what_it_rests_on():
    for name in NAMES:
        estimates = WING_ESTIMATES[name]
        assert estimates.keys() == vars(model_of(name).terms).keys()
        for term, estimate in estimates.items():
            assert estimate.low <= estimate.value <= estimate.high, (name, term)
            assert estimate.basis
    assert not any(estimate.basis.startswith("guess") for estimate in WING_ESTIMATES["feathered"].values())
    assert "in part a guess" in str(model_of("membrane"))
    assert "in part a guess" not in str(model_of("feathered"))


@pytest.mark.parametrize("extension", wb.aero.EXTENSIONS)
def test_the_extension_has_no_effect(extension):
    model = wb.aero.load_coefficients("feathered", extension, 2.0)
    assert (model.extension, model.blend_width_deg) == ("signed", 2.0)
    assert model.lift(0.3) == model_of("feathered").lift(0.3)
    with pytest.raises(wb.InvalidInputError, match="extension = 'bent'"):
        wb.aero.load_coefficients("feathered", "bent")


angles = st.floats(-math.pi, math.pi)


@seed(0)
@settings(deadline=None, max_examples=60)
@given(angle=angles, name=st.sampled_from(NAMES))
def test_derivatives_are_finite_everywhere(angle, name):
    kernel = model_of(name).kernel()
    assert np.isfinite(jax.jvp(kernel.lift_drag, (angle,), (1.0,))).all()


def test_derivative_in_the_models_numbers():
    model, alpha = model_of("feathered"), np.array([0.1, 0.5, -0.5, 1.2])
    check_derivative_in_numbers(model, lambda kernel: jnp.stack(kernel.lift_drag(alpha)), rtol=1e-5, atol=1e-7)


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"lift_lowest": 0.1}, "terms.lift_lowest"),
        ({"drag_least": 0.0, "low_rise": -1.0}, "terms.drag_least, terms.low_rise"),
        ({"low_onset_deg": 30.0}, "terms.low_onset_deg"),
        ({"lift_rounding": math.nan}, "terms.lift_rounding"),
    ],
)
def test_bad_terms_are_refused_all_at_once(changes, where):
    with pytest.raises(wb.InvalidInputError) as refused:
        CamberedTerms(**TERMS | changes)
    assert [fault.where for fault in refused.value.faults] == where.split(", ")


@pytest.mark.parametrize(
    ("low", "high"), [((-20.0, -45.0), (25.0, 45.0)), ((-45.0, -20.0), (45.0, 95.0)), ((-45.0, 0.0), (25.0, 45.0))]
)
def test_joins_that_do_not_rise_are_refused(low, high):
    with pytest.raises(wb.InvalidInputError, match="_join_deg"):
        CamberedCoefficients("wing", CamberedTerms(**TERMS), low, high)


def test_a_model_of_ones_own_comes_back_from_its_record():
    from wingbeat.records.inputs import inputs_of, problem_from

    own = CamberedCoefficients(
        "own", CamberedTerms(**TERMS | {"lift_highest": 1.6}), (-50.0, -15.0), (30.0, 50.0), aspect_ratio=7.0
    )
    for given_aero in (own, model_of("membrane")):
        problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, aero=given_aero)
        again = problem_from(inputs_of(problem, 1, 0)).aero.coefficients
        assert again == given_aero


@pytest.mark.slow
def test_searches_with_animal_wings_are_certified():
    """All three models share one compiled flight."""
    cases = ("pigeon", 8.0, "feathered"), ("bat", 5.0, "membrane"), ("pigeon", 6.0, "feathered-revolving")
    for animal, speed, aero in cases:
        problem = wb.OrbitProblem(wb.load_species(animal), speed=speed, aero=aero)
        orbit = wb.solve_orbit(problem, starts=2)
        assert orbit.status == wb.Status.CONVERGED, (animal, aero)
        warnings = " ".join(orbit.record()["warnings"])
        assert ("in part a guess" in warnings) == (aero != "feathered")
        assert "there the coefficients pass into those of a flat plate" in warnings
