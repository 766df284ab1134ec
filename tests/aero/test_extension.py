"""The extension to all angles: symmetry, smoothness, exactness outside the blends, no NaN."""

import math

import numpy as np
import pytest
from hypothesis import given, seed, settings
from hypothesis import strategies as st

from tests.helpers.coefficients import coefficients, value_slope_curvature
from wingbeat._jax.arrays import horner, jax, jnp
from wingbeat.aero import EXTENSIONS, LIBRARY, Dickinson, FormulaCoefficients, FormulaTerms, SuFan
from wingbeat.aero.extension import Blend, Jet, even_blend, jet_of, odd_blend

RIGHT = math.pi / 2
WIDTH = math.radians(1.0)
JOINS_DEG = (-180, -90, 0, 90, 180)
FORMULAS = {name: model for name, model in LIBRARY.items() if isinstance(model(), FormulaCoefficients)}
MODELS = {
    **FORMULAS,
    # Exponentials and a centre of pressure everywhere at once.
    "drag-decays": lambda extension="mirrored", width=1.0: FormulaCoefficients(
        "drag-decays",
        FormulaTerms(0.1, 1.0, 1.9, 5.0, -0.2, 0.3),
        FormulaTerms(1.2, 1.0, 1.8, -70.0, 0.1, 0.2),
        centre_terms=SuFan().centre_terms,
        extension=extension,
        blend_width_deg=width,
    ),
}
ALL = [
    (name, extension)
    for name in MODELS
    for extension in EXTENSIONS
    if not (name == "drag-decays" and extension.startswith("signed"))
]
angles = st.floats(-math.pi, math.pi)
any_angle = st.floats(allow_nan=False, allow_infinity=False)
widths = st.sampled_from([0.01, 0.3, 1.0, 3.0])


@seed(0)
@settings(deadline=None, max_examples=200)
@given(alpha=any_angle, width=widths, name=st.sampled_from(sorted(MODELS)))
def test_mirrored_is_exactly_odd_and_even(alpha, width, name):
    model = MODELS[name]("mirrored", width)
    pair = np.array([alpha, -alpha])
    lift, drag = model.lift(pair), model.drag(pair)
    assert lift[0] == -lift[1]
    assert drag[0] == drag[1]
    if model.has_centre_of_pressure:
        centre = model.centre_of_pressure(pair)
        assert centre[0] == centre[1]


@seed(0)
@settings(deadline=None, max_examples=200)
@given(alpha=st.floats(0.0, math.pi), width=widths, name=st.sampled_from(sorted(MODELS)))
def test_mirrored_plate_from_behind(alpha, width, name):
    model = MODELS[name]("mirrored", width)
    three = np.array([alpha, math.pi - alpha, alpha - math.pi])
    # The angle from behind is rounded once: within a blend of 0.01 degrees the slopes are large.
    here, behind, below = model.lift(three).tolist()
    assert behind == pytest.approx(-here, abs=1e-12)
    assert below == pytest.approx(here, abs=1e-12)
    here, behind, below = model.drag(three).tolist()
    assert behind == pytest.approx(here, abs=1e-12)
    assert below == pytest.approx(here, abs=1e-12)
    if model.has_centre_of_pressure:
        here, behind, _ = model.centre_of_pressure(three).tolist()
        assert behind == pytest.approx(1 - here, abs=1e-12)


@pytest.mark.parametrize("name", MODELS)
def test_mirrored_is_exact_at_the_joins(name):
    model = MODELS[name]()
    np.testing.assert_array_equal(model.lift(np.array([0.0, -0.0, RIGHT, -RIGHT, math.pi, -math.pi])), 0.0)
    if model.has_centre_of_pressure:
        np.testing.assert_array_equal(model.centre_of_pressure(np.array([RIGHT, -RIGHT])), 0.5)


@pytest.mark.parametrize(("name", "extension"), ALL)
def test_periodic(name, extension):
    model = MODELS[name](extension)
    alpha = np.linspace(-3.1, 3.1, 301)
    np.testing.assert_allclose(model.lift(alpha + 2 * math.pi), model.lift(alpha), rtol=0, atol=1e-13)
    np.testing.assert_allclose(model.drag(alpha - 4 * math.pi), model.drag(alpha), rtol=0, atol=1e-13)
    assert model.drag(math.pi) == model.drag(-math.pi)


@pytest.mark.parametrize("width_deg", [0.25, 1.0, 3.0])
def test_mirrored_is_the_formula_outside_the_blends(width_deg):
    model, width = SuFan(blend_width_deg=width_deg), math.radians(width_deg)
    pieces = model.kernel().pieces
    # Close beyond an edge blend and formula differ by the cube of the distance: sample there too.
    beyond = width * (1 + np.array([0.0, 1e-6, 3e-4, 1e-3, 3e-3, 1e-2]))
    acute = np.concatenate([beyond, RIGHT - beyond, np.linspace(width, RIGHT - width, 501)[1:-1]])
    lift, drag, centre = (np.array(f(acute)) for f in (pieces.lift, pieces.drag, pieces.centre))
    for alpha, lift_sign, behind in (
        (acute, 1, False),
        (-acute, -1, False),
        (np.pi - acute, -1, True),
        (acute - np.pi, 1, True),
    ):
        np.testing.assert_allclose(model.lift(alpha), lift_sign * lift, rtol=0, atol=3e-15)
        np.testing.assert_allclose(model.drag(alpha), drag, rtol=0, atol=3e-15)
        np.testing.assert_allclose(
            model.centre_of_pressure(alpha), 1 - centre if behind else centre, rtol=0, atol=3e-15
        )


def test_a_wider_blend_changes_nothing_outside_itself():
    narrow, wide = (SuFan(blend_width_deg=width).kernel() for width in (0.5, 3.0))
    alpha = jnp.deg2rad(jnp.linspace(3.0, 87.0, 333))
    evaluate = jax.jit(lambda kernel: kernel.lift_drag(alpha))
    np.testing.assert_array_equal(evaluate(narrow), evaluate(wide))


@pytest.mark.parametrize("extension", ["signed-drag", "signed"])
def test_signed_extensions_are_the_formula_at_the_signed_angle(extension):
    alpha = np.linspace(-RIGHT + WIDTH, WIDTH, 400)[1:-1]
    model = Dickinson(extension)
    drag = 1.92 - 1.55 * np.cos(2.04 * alpha - np.deg2rad(9.82))
    lift = 0.225 + 1.58 * np.sin(2.13 * alpha - np.deg2rad(7.2))
    np.testing.assert_allclose(model.drag(alpha), drag, rtol=0, atol=2e-15)
    expected = lift if extension == "signed" else Dickinson().lift(alpha)
    np.testing.assert_allclose(model.lift(alpha), expected, rtol=0, atol=2e-15)


def test_signed_leaves_a_lift_with_an_exponential_mirrored():
    alpha = np.linspace(-math.pi, math.pi, 999)
    np.testing.assert_array_equal(SuFan("signed").lift(alpha), SuFan().lift(alpha))
    assert SuFan("signed").drag(-0.35) < SuFan().drag(-0.35)


def test_clipped_drag_is_the_drag_at_zero():
    alpha = np.linspace(-math.pi + WIDTH, -WIDTH, 400)[1:-1]
    drag = 1.04 + math.sin(math.radians(-70))
    np.testing.assert_allclose(SuFan("clipped-drag").drag(alpha), drag, rtol=0, atol=2e-15)
    np.testing.assert_array_equal(SuFan("clipped-drag").lift(alpha), SuFan().lift(alpha))


@pytest.mark.parametrize("extension", EXTENSIONS[1:])
def test_every_extension_is_the_mirrored_one_at_positive_angles(extension):
    alpha = np.linspace(WIDTH, math.pi - WIDTH, 500)[1:-1]
    model = Dickinson(extension)
    np.testing.assert_allclose(model.lift(alpha), Dickinson().lift(alpha), rtol=0, atol=1e-15)
    np.testing.assert_allclose(model.drag(alpha), Dickinson().drag(alpha), rtol=0, atol=1e-15)
    beyond = alpha[alpha > RIGHT + WIDTH] - 2 * math.pi + RIGHT
    beyond = beyond[(beyond > -math.pi + WIDTH) & (beyond < -RIGHT - WIDTH)]
    np.testing.assert_allclose(model.lift(beyond), Dickinson().lift(beyond), rtol=0, atol=1e-15)


@pytest.mark.parametrize(("name", "extension"), ALL)
@pytest.mark.parametrize("width", [0.5, 1.0, 3.0])
def test_twice_continuously_differentiable_at_every_join(name, extension, width):
    """Value, slope and curvature from either side of each edge, by one-sided limits of exact derivatives."""
    model = MODELS[name](extension, width)
    edges = np.deg2rad([join + side * width for join in JOINS_DEG for side in (-1, 0, 1)])
    step = 1e-9
    with_gap = [(edge - step, edge + step) for edge in edges if abs(edge) < math.pi - 2 * step]
    left, right = np.array(with_gap).T
    scale = [1.0, 1.0 / math.radians(width), 1.0 / math.radians(width) ** 2]
    for order, rows in enumerate(value_slope_curvature(model, [*left, *right, math.pi, -math.pi])):
        on_the_left, on_the_right = rows[: left.size], rows[left.size : -2]
        # The third derivative may jump; over 2e-9 rad it moves the second by far less than this.
        np.testing.assert_allclose(on_the_left, on_the_right, rtol=0, atol=2e-6 * scale[order])
        np.testing.assert_allclose(rows[-2], rows[-1], rtol=0, atol=1e-9 * scale[order])


@pytest.mark.parametrize(("name", "extension"), ALL)
def test_no_jump_in_value_or_slope_on_a_fine_grid(name, extension):
    alpha = np.linspace(-math.pi, math.pi, 200_001)
    step = alpha[1] - alpha[0]
    value, first, second = value_slope_curvature(MODELS[name](extension), alpha)
    for values, slopes in ((value, first), (first, second)):
        # Were there a jump, the step across it would not be the derivative's.
        steps = np.diff(values, axis=0)[1:-1]
        trapezia = 0.5 * step * (slopes[2:-1] + slopes[1:-2])
        changes = np.abs(np.diff(slopes, axis=0))
        bound = step * np.maximum.reduce([changes[:-2], changes[1:-1], changes[2:]]) + 1e-12
        assert (np.abs(steps - trapezia) <= bound).all()


@pytest.mark.parametrize(("name", "extension"), ALL)
def test_derivatives_are_those_of_central_differences(name, extension):
    rng = np.random.default_rng(1)
    alpha = np.concatenate([rng.uniform(-3.1, 3.1, 200), np.deg2rad(rng.uniform(-0.9, 0.9, 50))])
    edges = np.deg2rad([join + side for join in JOINS_DEG for side in (-1, 0, 1)])
    alpha = alpha[np.abs(alpha[:, None] - edges).min(axis=1) > 5e-4]
    h = 1e-4
    # One row for each step from the angles, none first.
    moved = alpha + h * np.array([0, -2, -1, 1, 2])[:, None]
    orders = value_slope_curvature(MODELS[name](extension), moved)
    value, first, second = (rows.reshape(*moved.shape, -1) for rows in orders)
    for (_, *near), derivative in ((value, first[0]), (first, second[0])):
        fourth_order = (near[0] - 8 * near[1] + 8 * near[2] - near[3]) / (12 * h)
        scale = np.abs(fourth_order).max()
        np.testing.assert_allclose(derivative, fourth_order, rtol=1e-6, atol=1e-8 * max(scale, 1.0))


@pytest.mark.parametrize("degrees", [2.0, 17.0, 40.0, 88.0])
def test_su_fan_derivative_by_complex_step(degrees):
    alpha, h = math.radians(degrees), 1e-30
    a = (alpha + 1j * h) * (180 / math.pi)
    lift = -0.44 * np.exp(-0.47 * a) + 1.19 * np.sin(np.deg2rad(1) * (1.74 * a + 20))
    drag = 1.04 + np.sin(np.deg2rad(1) * (1.72 * a - 70))
    centre = 0.247 + 0.016 * a**0.6 + 0.026 * a * np.exp(-0.11 * a)
    (slopes,) = value_slope_curvature(SuFan(), [alpha])[1]
    np.testing.assert_allclose(slopes, [part.imag / h for part in (lift, drag, centre)], rtol=1e-13)


HUGE = [0.0, -0.0, RIGHT, -RIGHT, math.pi, -math.pi, WIDTH, -WIDTH, 5e-324, -5e-324, 1e-200, 1e5, -1e17, 1e300]


@pytest.mark.parametrize(("name", "extension"), ALL)
def test_no_nan_at_any_finite_angle(name, extension):
    model = MODELS[name](extension)
    alpha = np.resize([*HUGE, np.finfo(float).max], 301)  # as many as elsewhere here: compiled once
    assert np.isfinite(model.lift(alpha)).all()
    assert np.isfinite(model.drag(alpha)).all()
    assert not model.has_centre_of_pressure or np.isfinite(model.centre_of_pressure(alpha)).all()


@pytest.mark.parametrize(("name", "extension"), ALL)
def test_no_nan_in_derivatives(name, extension):
    dense = np.deg2rad(np.arange(-720, 721) / 4)
    alpha = np.concatenate([[a for a in HUGE if abs(a) <= math.pi], dense])
    for rows in value_slope_curvature(MODELS[name](extension), alpha):
        assert np.isfinite(rows).all()


@pytest.mark.parametrize("extension", EXTENSIONS)
def test_reverse_mode_twice_is_finite_at_the_joins(extension):
    model = SuFan(extension)
    alpha = np.deg2rad([*JOINS_DEG, 1.0, -1.0, 89.0, -89.0, 1e-9])
    _, *forward = value_slope_curvature(model, alpha)
    for found, expected in zip(reverse_derivatives(model.kernel(), alpha), forward, strict=True):
        assert np.isfinite(found).all()
        np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


@jax.jit
def reverse_derivatives(kernel, alpha):
    """Return slopes and curvatures of C_L, C_D and x_cp, both in reverse mode."""
    slopes = jax.jacrev(coefficients, argnums=1)
    return [jax.vmap(f, (None, 0))(kernel, alpha) for f in (slopes, jax.jacrev(slopes, argnums=1))]


def test_slope_at_zero_is_that_of_the_blend():
    """It is not 0, which a derivative through |alpha| would give, and not the formula's 13.8."""
    slope = value_slope_curvature(SuFan(), [0.0])[1][0, 0]
    h = 1e-4
    assert slope == pytest.approx((SuFan().lift(h) - SuFan().lift(-h)) / (2 * h), rel=1e-4)
    assert 8 < slope < 13.8


@seed(0)
@settings(deadline=None)
@given(angles)
def test_extensions_are_finite_and_drag_is_not_negative(alpha):
    for model in LIBRARY.values():
        assert model().drag(alpha) >= 0


def test_blends_meet_their_jets():
    width = 0.3
    left, right = Jet(0.7, -1.1, 2.0), Jet(-0.4, 0.9, -3.0)

    def polynomial(even, odd):
        return lambda x: horner(even, x * x) + x * horner(odd, x * x)

    join = Blend.between(left, right, width)
    np.testing.assert_allclose(jet_of(polynomial(join.even, join.odd), -width), left, rtol=1e-13)
    np.testing.assert_allclose(jet_of(polynomial(join.even, join.odd), width), right, rtol=1e-13)
    nothing = (0.0, 0.0, 0.0)
    np.testing.assert_allclose(jet_of(polynomial(even_blend(right, width), nothing), width), right, rtol=1e-13)
    np.testing.assert_allclose(jet_of(polynomial(nothing, odd_blend(right, width)), width), right, rtol=1e-13)
