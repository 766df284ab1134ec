"""Coefficient formulas against the published numbers, and the model's border and pytree."""

import math
import subprocess
import sys

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from tests.helpers.coefficients import check_derivative_in_numbers, coefficients
from wingbeat._base import InvalidInputError
from wingbeat._jax.arrays import jax, jnp
from wingbeat.aero import (
    LIBRARY,
    BladeElement,
    CentreTerms,
    Dickinson,
    FormulaCoefficients,
    FormulaTerms,
    SuFan,
    Wang2004,
    ellington_normal_drag,
    load_coefficients,
    thin_aerofoil_lift,
    thin_aerofoil_moment,
)

# model.md section 7: angle [deg], Su-Fan C_L, C_D, x_cp, C_M about mid-chord, Dickinson C_L, C_D.
TABLE = [
    (5, 0.5295, 0.1620, 0.3640, 0.0736, 0.3201, 0.3700),
    (10, 0.7188, 0.2435, 0.3972, 0.0771, 0.6099, 0.3964),
    (20, 0.9724, 0.4579, 0.4012, 0.1058, 1.1403, 0.5911),
    (40, 1.1900, 1.0191, 0.4061, 0.1471, 1.7705, 1.4354),
    (60, 0.9819, 1.5876, 0.4358, 0.1199, 1.5850, 2.5152),
]
SINE_COSINE = {
    "wang": (1.2, 1.4, 1.0),
    "whitney-wood": (1.8, 1.9, 1.5),
    "parslew-crowther": (1.64, 1.135, 1.05),
    "byl": (1.8, 1.8, 1.8),
}


def su_fan_formula(a):
    """Su et al. 2023, angles in degrees, written once more."""
    lift = -0.44 * np.exp(-0.47 * a) + 1.19 * np.sin(np.deg2rad(1.74 * a + 20))
    drag = 1.04 + np.sin(np.deg2rad(1.72 * a - 70))
    return lift, drag, 0.247 + 0.016 * a**0.6 + 0.026 * a * np.exp(-0.11 * a)


@pytest.mark.parametrize("row", TABLE)
def test_published_numbers_to_their_last_digit(row):
    angle, *wanted = row
    alpha = math.radians(angle)
    su_fan, dickinson = SuFan(), Dickinson()
    found = [
        su_fan.lift(alpha),
        su_fan.drag(alpha),
        su_fan.centre_of_pressure(alpha),
        su_fan.moment(alpha),
        dickinson.lift(alpha),
        dickinson.drag(alpha),
    ]
    np.testing.assert_array_equal(np.round(found, 4), wanted)


def test_su_fan_is_its_formula():
    degrees = np.linspace(1.0, 89.0, 500)[1:-1]
    lift, drag, centre = su_fan_formula(degrees)
    model, alpha = SuFan(), np.deg2rad(degrees)
    np.testing.assert_allclose(model.lift(alpha), lift, rtol=0, atol=2e-15)
    np.testing.assert_allclose(model.drag(alpha), drag, rtol=0, atol=2e-15)
    np.testing.assert_allclose(model.centre_of_pressure(alpha), centre, rtol=0, atol=2e-15)


def test_dickinson_is_its_formula():
    degrees = np.linspace(1.0, 89.0, 500)[1:-1]
    model, alpha = Dickinson(), np.deg2rad(degrees)
    lift = 0.225 + 1.58 * np.sin(np.deg2rad(2.13 * degrees - 7.2))
    drag = 1.92 - 1.55 * np.cos(np.deg2rad(2.04 * degrees - 9.82))
    np.testing.assert_allclose(model.lift(alpha), lift, rtol=0, atol=2e-15)
    np.testing.assert_allclose(model.drag(alpha), drag, rtol=0, atol=2e-15)


@pytest.mark.parametrize("name", SINE_COSINE)
def test_sine_cosine_models_are_their_formulas(name):
    lift, mean, swing = SINE_COSINE[name]
    alpha = np.deg2rad(np.linspace(-180, 180, 721))
    model = LIBRARY[name]()
    # These formulas already have the symmetries, so even the blends differ from them by little.
    np.testing.assert_allclose(model.lift(alpha), lift * np.sin(2 * alpha), rtol=0, atol=1e-10)
    np.testing.assert_allclose(model.drag(alpha), mean - swing * np.cos(2 * alpha), rtol=0, atol=1e-10)


def test_su_fan_lift_peaks_at_40_degrees():
    model = SuFan()
    best = minimize_scalar(lambda a: -model.lift(math.radians(a)), bounds=(5, 85), method="bounded")
    assert round(best.x, 1) == 40.2
    assert round(-best.fun, 3) == 1.190


def test_su_fan_glides_best_at_5_degrees():
    model = SuFan()
    best = minimize_scalar(
        lambda a: -model.lift(math.radians(a)) / model.drag(math.radians(a)), bounds=(2, 20), method="bounded"
    )
    assert round(best.x, 1) == 5.4
    assert round(-best.fun, 2) == 3.27


def test_lift_curves_cross_at_14_degrees():
    su_fan, dickinson = SuFan(), Dickinson()

    def difference(angle):
        return su_fan.lift(math.radians(angle)) - dickinson.lift(math.radians(angle))

    crossing = brentq(difference, 5, 30)
    assert round(crossing, 2) == 13.95
    assert round(float(su_fan.lift(math.radians(crossing))), 2) == 0.83


def test_normal_and_moment_follow_from_lift_drag_and_centre():
    model = SuFan()
    alpha = np.linspace(-7, 7, 200)
    normal = model.lift(alpha) * np.cos(alpha) + model.drag(alpha) * np.sin(alpha)
    np.testing.assert_allclose(model.normal(alpha), normal, rtol=0, atol=1e-15)
    moment = normal * (0.25 - model.centre_of_pressure(alpha))
    np.testing.assert_allclose(model.moment(alpha, about=0.25), moment, rtol=0, atol=1e-15)


@pytest.mark.parametrize("shape", [(), (0,), (1,), (5,), (2, 3), (2, 0, 3), (3, 1, 4)])
def test_any_shape_comes_back(shape):
    model = SuFan()
    alpha = np.random.default_rng(0).uniform(-9, 9, shape)
    for function in (model.lift, model.drag, model.normal, model.moment, model.centre_of_pressure):
        values = function(alpha)
        assert values.shape == shape
        assert values.dtype == np.float64
        np.testing.assert_array_equal(values, np.array([function(a) for a in alpha.flat]).reshape(shape))


def test_lists_and_integers_are_angles():
    np.testing.assert_array_equal(SuFan().lift([0, 1]), SuFan().lift(np.array([0.0, 1.0])))


def test_text_is_no_angle():
    with pytest.raises(InvalidInputError, match="alpha = 'steep': must be a number"):
        SuFan().lift("steep")


def test_traced_angles_are_sent_to_the_kernel():
    with pytest.raises(InvalidInputError, match=r"use kernel\(\)"):
        jax.jit(SuFan().lift)(0.1)


def test_not_finite_angles_give_nan():
    assert np.isnan(SuFan().lift([np.nan, np.inf, -np.inf])).all()


def test_su_fan_and_dickinson_share_one_compiled_function():
    traces = []

    @jax.jit
    def lift_drag(kernel, alpha):
        traces.append(1)
        return kernel.lift_drag(alpha)

    alpha = jnp.linspace(-3.0, 3.0, 7)
    for model in (SuFan(), Dickinson(), Wang2004(), SuFan(blend_width_deg=2.0)):
        found = lift_drag(model.kernel(), alpha)
        np.testing.assert_array_equal(found[0], model.lift(alpha))
    assert len(traces) == 1


def test_kernel_leaves_are_float64_numbers_alone():
    leaves = jax.tree.leaves(SuFan().kernel())
    assert all(leaf.dtype == jnp.float64 and leaf.shape == () for leaf in leaves)


def test_kernel_under_vmap_and_jvp_in_every_number():
    kernel = Dickinson("clipped-drag").kernel()
    alpha = jnp.linspace(-3.1, 3.1, 50)

    @jax.jit
    def evaluate(kernel):
        direction = jax.tree.map(jnp.ones_like, kernel)
        return jax.vmap(kernel.lift_drag)(alpha), jax.jvp(lambda k: k.lift_drag(alpha), (kernel,), (direction,))

    one_by_one, (together, tangents) = evaluate(kernel)
    np.testing.assert_allclose(one_by_one, together, rtol=0, atol=1e-15)
    assert np.isfinite(np.array(tangents)).all()


@pytest.mark.parametrize("extension", ["mirrored", "clipped-drag", "signed-drag"])
def test_derivative_in_the_formula_numbers(extension):
    model, alpha = SuFan(extension), np.array([0.01, -0.4, 1.56, 2.0])
    check_derivative_in_numbers(model, lambda kernel: coefficients(kernel, alpha), rtol=2e-6, atol=2e-8)


def test_model_without_centre_of_pressure_says_so():
    model = Dickinson()
    assert not model.has_centre_of_pressure
    for function in (model.centre_of_pressure, model.moment):
        with pytest.raises(InvalidInputError, match=r"dickinson.*has no centre of pressure; use su-fan"):
            function(0.1)
    assert np.isnan(model.kernel().centre_of_pressure(0.1))
    with pytest.raises(InvalidInputError):
        BladeElement(model, force_point="centre-of-pressure")
    assert BladeElement(SuFan(), force_point="centre-of-pressure").coefficients.has_centre_of_pressure


def test_second_hand_models_say_so():
    assert str(SuFan()) == "su-fan (Su, Fan, Onoue, Vejdani and Breuer 2023, arXiv 2302.09602)"
    for name, factory in LIBRARY.items():
        assert factory().name == name
        assert ("cited second-hand" in str(factory())) == (factory().grade == "B") == (name in SINE_COSINE)


def test_lines_of_theory():
    np.testing.assert_allclose(thin_aerofoil_lift([0.0, 0.2]), [0.0, 0.4 * np.pi])
    np.testing.assert_allclose(thin_aerofoil_moment([0.0, 0.2]), [0.0, 0.1 * np.pi])
    np.testing.assert_allclose(ellington_normal_drag([1e2, 5e4]), [2.45, 1.951])
    # The paper's claim: its drag square to the flow is near Ellington's.
    assert float(SuFan().drag(np.pi / 2)) == pytest.approx(float(ellington_normal_drag(5e4)), rel=0.05)


def test_every_fault_of_a_model_is_told_at_once():
    terms = FormulaTerms(0, 1, 2, 0, decay_amplitude=0.1, decay_rate=1.0)
    with pytest.raises(InvalidInputError) as caught:
        FormulaCoefficients(
            "bad",
            terms,
            terms,
            grade="D",
            reynolds_range=(2.0, 1.0),
            alpha_range_deg=(0.0, math.nan),
            extension="signed",
            blend_width_deg=3.5,
        )
    places = [fault.where for fault in caught.value.faults]
    assert places == ["grade", "reynolds_range", "alpha_range_deg[1]", "blend_width_deg", "extension"]
    assert "blend_width_deg = 3.5: must be > 0 and <= 3 degrees" in str(caught.value)


@pytest.mark.parametrize("width", [0, -1, 3.0001, math.nan, math.inf, "1", None, True])
def test_bad_blend_widths_are_refused(width):
    with pytest.raises(InvalidInputError, match="blend_width_deg"):
        SuFan(blend_width_deg=width)


def test_a_pair_that_is_none_is_refused():
    with pytest.raises(InvalidInputError, match="must be a pair"):
        FormulaCoefficients("bad", FormulaTerms(0, 1, 2, 0), FormulaTerms(0, 1, 2, 0), alpha_range_deg=(0.0,))


def test_faults_of_terms():
    with pytest.raises(InvalidInputError) as caught:
        FormulaTerms(math.nan, 1.0, "2", 0.0, decay_amplitude=0.1)
    assert [fault.where for fault in caught.value.faults] == ["terms.constant", "terms.rate", "terms.decay_rate"]
    with pytest.raises(InvalidInputError, match="decay_rate = -1"):
        FormulaTerms(0.0, 1.0, 2.0, 0.0, 0.1, -1.0)
    with pytest.raises(InvalidInputError) as caught:
        CentreTerms(0.25, math.inf, 0.0, 0.0, -0.1)
    places = ["centre.power_amplitude", "centre.exponent", "centre.decay_rate"]
    assert [fault.where for fault in caught.value.faults] == places


def test_an_exponential_of_nothing_is_no_exponential():
    assert FormulaTerms(0.0, 1.0, 2.0, 0.0, 0.0, 0.47) == FormulaTerms(0.0, 1.0, 2.0, 0.0)


def test_load_coefficients_by_name():
    model = load_coefficients("dickinson", "signed", 2.0)
    assert (model.name, model.extension, model.blend_width_deg) == ("dickinson", "signed", 2.0)


@pytest.mark.parametrize(("name", "guess"), [("sufan", "su-fan"), ("Dickenson", "dickinson")])
def test_unknown_names_get_a_guess(name, guess):
    with pytest.raises(InvalidInputError, match=f"did you mean {guess}"):
        load_coefficients(name)


def test_unknown_name_without_a_guess_lists_the_models():
    with pytest.raises(InvalidInputError, match="The models are su-fan, dickinson, wang"):
        load_coefficients("qqqq")


def test_formulas_do_not_import_scipy_interpolation():
    code = "import sys, wingbeat.aero as a; a.SuFan().lift(0.1); assert 'scipy.interpolate' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)
