"""Fits: forms of the box and of one's own, what is said of their trust, model files, draws."""

import dataclasses
import math

import numpy as np
import pytest

from tests.helpers.figures import check_legends
from tests.helpers.model_files import assert_refused
from wingbeat._base import FileError, InvalidInputError
from wingbeat.aero import (
    LIBRARY,
    CentreTerms,
    FormulaCoefficients,
    FormulaTerms,
    TableCoefficients,
    load_coefficients,
)
from wingbeat.experiment import (
    FORMS,
    CoefficientTable,
    CurveForm,
    FitRangeWarning,
    WingForm,
    curve_forms,
    draw,
    fit_curve,
    fit_wing,
)
from wingbeat.experiment.campaign import true_coefficients
from wingbeat.experiment.curve_forms import BoxForm, value_and_slopes
from wingbeat.plots import fit_page

ALPHA = np.arange(0.0, 111.0, 2.0)


def noisy(seed=0, size=0.01, **more) -> CoefficientTable:
    random = np.random.default_rng(seed)
    values = [curve + size * random.normal(size=len(ALPHA)) for curve in true_coefficients(ALPHA)]
    se = {name: np.full(len(ALPHA), size) for name in ("C_L", "C_D", "x_cp")}
    return CoefficientTable(ALPHA, dict(zip(("C_L", "C_D", "x_cp"), values, strict=True)), se=se, **more)


@pytest.fixture(scope="module")
def fit():
    return fit_wing(noisy(reynolds=np.full(len(ALPHA), 3e4)), name="mine", citation="a test")


@pytest.fixture
def model(fit, tmp_path):
    fit.save(tmp_path / "mine.toml")
    return tmp_path / "mine.toml"


def test_the_page_names_each_mark_once(fit):
    assert len(check_legends(fit_page(fit))) == 3


@pytest.mark.parametrize("name", ["dickinson", "wang", "byl", "parslew-crowther"])
def test_other_published_models_come_back_from_their_own_curves(name):
    model = LIBRARY[name]()
    radians = np.deg2rad(np.arange(2.0, 89.0, 3.0))
    table = CoefficientTable(np.rad2deg(radians), {"C_L": model.lift(radians), "C_D": model.drag(radians)})
    found = fit_wing(table, "dickinson" if name == "dickinson" else "sine-cosine")
    assert found.centre is None
    for curve, terms in ((found.lift, model.lift_terms), (found.drag, model.drag_terms)):
        for parameter, value in curve.parameters.items():
            assert value == pytest.approx(getattr(terms, parameter), rel=1e-7)


def test_slopes_are_the_derivatives():
    for terms in (FormulaTerms(0.2, 1.1, 1.7, 20.0, -0.4, 0.3), CentreTerms(1.0, 1.0, 0.6, 1.0, 0.1)):
        slopes = value_and_slopes(terms, ALPHA)[1]
        for name, value in vars(terms).items():
            moved = [dataclasses.replace(terms, **{name: value + step}) for step in (1e-6, -1e-6)]
            ends = [value_and_slopes(one, ALPHA)[0] for one in moved]
            np.testing.assert_allclose(getattr(slopes, name), (ends[0] - ends[1]) / 2e-6, rtol=1e-5, atol=1e-6)


@pytest.mark.parametrize("name", [name for name in FORMS if name != "cambered"])
def test_a_form_of_the_box_is_the_formula_that_a_model_flies_with(name):
    for form in FORMS[name][1:]:
        assert isinstance(form, BoxForm)
        parameters = {term: 0.3 + 0.1 * i for i, term in enumerate(form.names)}
        terms = form.kind(**form.fixed | parameters)
        flown = terms.in_radians() if form.kind is CentreTerms else terms.in_radians(with_decay=terms.decays)
        np.testing.assert_allclose(form.value(ALPHA, parameters), flown(np.deg2rad(ALPHA)), rtol=0, atol=1e-13)


def test_fits_of_one_form_compile_their_slopes_once(fit):
    compiled = curve_forms._value_and_slopes._cache_size()
    fit_wing(noisy(seed=1))
    assert curve_forms._value_and_slopes._cache_size() == compiled


def test_scipy_finds_the_same_parameters_and_covariance(fit):
    from scipy.optimize import curve_fit

    def lift(a, *terms):
        return fit.lift.form.value(a, dict(zip(fit.lift.parameters, terms, strict=True)))

    start = list(fit.lift.parameters.values())
    found, covariance = curve_fit(lift, ALPHA, fit.lift.values, p0=np.array(start) * 1.02, sigma=fit.lift.sigma)
    np.testing.assert_allclose(found, start, rtol=1e-5)
    np.testing.assert_allclose(covariance, fit.lift.covariance, rtol=1e-3, atol=1e-10)


def test_a_straight_line_has_the_textbook_intervals():
    from scipy.stats import linregress, t

    random = np.random.default_rng(1)
    y = 0.1 * ALPHA + 2 + random.normal(size=len(ALPHA))
    line = CurveForm("m a + b", lambda a, m, b: m * a + b, {"m": 1.0, "b": 0.0})
    found, book = fit_curve(ALPHA, y, line), linregress(ALPHA, y)
    assert found.parameters == pytest.approx({"m": book.slope, "b": book.intercept}, rel=1e-7)
    assert found.standard_errors == pytest.approx({"m": book.stderr, "b": book.intercept_stderr}, rel=1e-6)
    assert found.r_squared == pytest.approx(book.rvalue**2)
    reach = t.ppf(0.975, len(ALPHA) - 2) * book.stderr
    assert found.interval()["m"] == pytest.approx((book.slope - reach, book.slope + reach), rel=1e-6)
    spread = math.sqrt(found.chi_squared / found.freedom)
    middle = found.band(ALPHA.mean(), of_mean=True)[0] / t.ppf(0.975, found.freedom)
    assert middle == pytest.approx(spread / math.sqrt(len(ALPHA)), rel=1e-6)
    new = found.band(ALPHA.mean())[0] / t.ppf(0.975, found.freedom)
    assert new == pytest.approx(spread * math.sqrt(1 + 1 / len(ALPHA)), rel=1e-6)


def test_use_beyond_the_data_is_warned_of(fit):
    with pytest.warns(FitRangeWarning, match="C_L was fitted from 0 to 110 degrees and is used outside that range"):
        fit.lift.predict([120.0])
    assert fit.lift.predict(5.0).shape == (1,)


def test_a_fit_that_the_data_do_not_determine_says_so():
    table = noisy().between(0, 24)
    assert any("the data do not determine this form" in note for note in fit_wing(table).notes)
    assert fit_wing(noisy()).notes == ()


def test_a_model_file_is_the_fit_and_works_as_coefficients(fit, model):
    loaded, own = load_coefficients(model), fit.coefficients()
    assert isinstance(loaded, FormulaCoefficients)
    assert loaded == own
    assert (loaded.name, loaded.citation) == ("mine", "a test")
    assert (loaded.alpha_range_deg, loaded.reynolds_range) == ((0.0, 110.0), (3e4, 3e4))
    alpha = np.arange(2.0, 89.0)
    np.testing.assert_allclose(loaded.lift(np.deg2rad(alpha)), fit.lift.predict(alpha), atol=1e-12)
    np.testing.assert_allclose(loaded.centre_of_pressure(np.deg2rad(alpha)), fit.centre.predict(alpha), atol=1e-12)
    np.testing.assert_allclose(loaded.moment(np.deg2rad(alpha)), fit.moment(alpha), atol=1e-12)
    assert load_coefficients(model, "clipped-drag", 2.0).extension == "clipped-drag"


def test_draws_scatter_as_the_covariance_says(fit, model):
    drawn = draw(model, 4000, seed=5)
    for curve, terms in ((fit.lift, "lift_terms"), (fit.drag, "drag_terms"), (fit.centre, "centre_terms")):
        values = np.array([[getattr(getattr(one, terms), name) for name in curve.parameters] for one in drawn])
        spread = np.sqrt(np.diag(curve.covariance))
        assert np.abs(values.mean(axis=0) - list(curve.parameters.values())).max() < 0.1 * spread.max()
        np.testing.assert_allclose(
            np.cov(values.T) / np.outer(spread, spread), curve.covariance / np.outer(spread, spread), atol=0.08
        )
    assert draw(fit, 2, seed=5) == draw(model, 2, seed=5)
    assert draw(fit, 2, seed=6) != draw(model, 2, seed=5)


@pytest.mark.parametrize(
    ("count", "seed", "message"),
    [(0, 0, "count = 0: must be a whole number"), (3, -1, "seed = -1"), (2.5, 0, "2.5")],
)
def test_draw_refuses(fit, count, seed, message):
    with pytest.raises(InvalidInputError, match=message):
        draw(fit, count, seed)


def test_a_form_of_ones_own_becomes_a_table(tmp_path):
    cubic = CurveForm(
        "p a + q a^2 + r a^3", lambda a, p, q, r: p * a + q * a**2 + r * a**3, {"p": 0.1, "q": 0, "r": 0}
    )
    own = WingForm("cubic", cubic, FORMS["dickinson"].drag)
    found = fit_wing(noisy(), own, name="cubic")
    with pytest.raises(InvalidInputError, match=r"which a model file cannot hold; save it as a table"):
        found.save(tmp_path / "own.toml")
    found.save(tmp_path / "own.csv")
    table = load_coefficients(tmp_path / "own.csv")
    assert isinstance(table, TableCoefficients)
    alpha = np.array([5.0, 40.5, 80.0])
    np.testing.assert_allclose(table.lift(np.deg2rad(alpha)), found.lift.predict(alpha), atol=1e-4)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: t.between(0, 8), "C_L = '5 points': are too few for the 5 parameters"),
        (lambda t: CoefficientTable(t.alpha_deg - 20, t.mean), "alpha_deg = -20.0: is below 0, where"),
        (
            lambda t: CoefficientTable(ALPHA, t.mean, se={"C_L": np.where(ALPHA > 4, 0.01, 0.0)}),
            r"C_L_se\[0\] = 0.0",
        ),
    ],
)
def test_data_that_cannot_be_fitted_are_refused(change, message):
    with pytest.raises(InvalidInputError, match=message):
        fit_wing(change(noisy()))


def test_arguments_are_checked(fit):
    with pytest.raises(InvalidInputError, match="form = 'cubic': is not a known choice; use one of su-fan"):
        fit_wing(noisy(), "cubic")
    with pytest.raises(InvalidInputError, match=r"confidence = 95: must be > 0 and < 1; 95 % is 0.95"):
        fit.lift.interval(95)
    with pytest.raises(InvalidInputError, match="are not those of the fit"):
        fit.lift.covers({"a": 1.0})
    with pytest.raises(InvalidInputError, match="does not take the parameters named in start"):
        CurveForm("f", lambda a, m: m * a, {"k": 1.0})
    with pytest.raises(InvalidInputError, match="gives no finite numbers at its starting values"):
        fit_curve(ALPHA, ALPHA, CurveForm("m/0", lambda a, m: np.full_like(a, np.inf), {"m": 1.0}))


BAD_MODELS = {
    'kind = "wing coefficients"|kind = "bird"': ["kind = 'bird': must be 'wing coefficients'"],
    'name = "mine"|name = 3': ["name = 3: must be a text"],
    "alpha_range_deg = [0.0, 110.0]|alpha_range_deg = [110.0, 0.0]\ncolour = 1": [
        "'colour' = '': is not a known key",
        "alpha_range_deg = [110.0, 0.0]: has the highest value first",
    ],
    "[drag]|[drug]": ["'drug' = '': is not a known key", "drag.constant = None: must be a number"],
    "rate = |rate_ = ": ["'rate_'", "lift.rate = None: must be a number", "drag.rate = None"],
    "exponent = |exponent = -": ["centre.exponent = -0.", "must be > 0"],
    "decay_rate = |decay_rate = nan #": ["lift.decay_rate = nan: must be finite", "centre.decay_rate = nan"],
    "covariance = [|covariance = [[1.0],": ["lift.fit.covariance = '': must be 5 rows of 5 numbers"],
    'free = ["constant"|free = ["constants"': ["drag.fit.free", "must name terms of the formula"],
}


@pytest.mark.parametrize("change", BAD_MODELS)
def test_bad_model_files_are_refused_with_all_their_faults(model, change):
    assert_refused(model, change, BAD_MODELS[change])


def test_a_covariance_that_is_none_is_refused(model):
    lines = model.read_text().splitlines()
    row = lines.index("covariance = [") + 1
    cells = lines[row].strip(" [],").split(", ")
    lines[row] = f"  [-{cells[0]}, {', '.join(cells[1:])}],"
    model.write_text("\n".join(lines))
    with pytest.raises(InvalidInputError, match="must be symmetric and positive semidefinite"):
        load_coefficients(model)


def test_what_is_no_model_file_is_refused(tmp_path):
    with pytest.raises(FileError, match="no such file"):
        load_coefficients(tmp_path / "absent.toml")
    (tmp_path / "bad.toml").write_text("[lift\n")
    with pytest.raises(FileError, match="as TOML"):
        load_coefficients(tmp_path / "bad.toml")
