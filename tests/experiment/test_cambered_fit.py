"""The form cambered: terms recovered within their intervals, its model file, draws, and what it refuses."""

import dataclasses
import math

import numpy as np
import pytest

from tests.helpers.model_files import assert_refused
from wingbeat._base import InvalidInputError, find
from wingbeat.aero import CamberedCoefficients, CamberedTerms, Feathered, load_coefficients
from wingbeat.experiment import FORMS, CoefficientTable, draw, fit_wing
from wingbeat.experiment.curve_forms import value_and_slopes
from wingbeat.experiment.regression import fit_drag

TRUTH = CamberedTerms(-4.0, 4.2, -0.45, 1.35, 0.15, 0.03, 0.055, 2.0, 0.6, 17.0, 1.6, 2.0)
HELD = {"lift_rounding", "onset_rounding_deg"}
FREE = [name for name in vars(TRUTH) if name not in HELD]
ALPHA = np.arange(-24.0, 31.0, 2.0)


def polar(size=0.0, seed=0, alpha=ALPHA, **more) -> CoefficientTable:
    random = np.random.default_rng(seed)
    lift = np.asarray(TRUTH.lift_at(alpha)) + size * random.normal(size=len(alpha))
    drag = np.asarray(TRUTH.drag_at(alpha)) + 0.15 * size * random.normal(size=len(alpha))
    return CoefficientTable(alpha, {"C_L": lift, "C_D": drag}, **more)


@pytest.fixture(scope="module")
def fit():
    table = polar(0.02, reynolds=np.linspace(4e4, 5e4, len(ALPHA)))
    return fit_wing(table, "cambered", "mine", "a test", aspect_ratio=5.5)


@pytest.fixture
def model(fit, tmp_path):
    fit.save(tmp_path / "mine.toml")
    return tmp_path / "mine.toml"


def test_the_curves_are_those_of_the_model_between_its_joins():
    wing, alpha = Feathered(), np.linspace(-20.0, 25.0, 91)
    np.testing.assert_allclose(wing.terms.lift_at(alpha), wing.lift(np.deg2rad(alpha)), rtol=0, atol=1e-13)
    np.testing.assert_allclose(wing.terms.drag_at(alpha), wing.drag(np.deg2rad(alpha)), rtol=0, atol=1e-13)


@pytest.mark.parametrize("curve", ["lift_at", "drag_at"])
def test_slopes_are_the_derivatives(curve):
    slopes = value_and_slopes(TRUTH, ALPHA, curve)[1]
    for name, value in vars(TRUTH).items():
        moved = [dataclasses.replace(TRUTH, **{name: value + step}) for step in (1e-6, -1e-6)]
        ends = [value_and_slopes(one, ALPHA, curve)[0] for one in moved]
        np.testing.assert_allclose(getattr(slopes, name), (ends[0] - ends[1]) / 2e-6, rtol=1e-5, atol=1e-8)


def test_data_without_noise_give_the_terms_back():
    found = fit_wing(polar(), "cambered")
    assert found.notes == ()
    assert vars(found.model().wing.terms) == pytest.approx(vars(TRUTH), rel=1e-7)


def test_intervals_hold_the_true_terms_as_often_as_they_say():
    inside = dict.fromkeys(FREE, 0)
    for seed in range(30):
        for curve in fit_wing(polar(0.02, seed), "cambered").curves.values():
            for name, (low, high) in curve.interval().items():
                inside[name] += low <= vars(TRUTH)[name] <= high
    # Of 30 intervals of 95 %, 25 or fewer hold their term once in 500 cases.
    assert min(inside.values()) >= 25, inside
    assert 0.92 <= sum(inside.values()) / 300 <= 0.985, inside


def test_drag_knows_what_its_lift_leaves_uncertain(fit):
    """The joint covariance holds that of lift, and how drag follows if lift changes."""
    names, joint = fit.drag.joint_names, fit.drag.joint
    assert list(names) == FREE
    np.testing.assert_allclose(joint[4:, 4:], fit.drag.covariance, rtol=1e-12)
    np.testing.assert_allclose(joint[:4, :4], fit.lift.covariance, rtol=1e-12)
    # If lift were known, the onset would be known better.
    sole = joint[4:, 4:] - joint[4:, :4] @ np.linalg.solve(joint[:4, :4], joint[:4, 4:])
    place = list(fit.drag.parameters).index("low_onset_deg")
    assert fit.drag.covariance[place, place] > 1.2 * sole[place, place]
    # Refitting drag beside a lift that has moved along each term moves drag as the joint covariance says.
    follow = joint[4:, :4] @ np.linalg.inv(joint[:4, :4])
    for i, (name, value) in enumerate(fit.lift.parameters.items()):
        step = 0.02 * math.sqrt(joint[i, i])
        ends = []
        for way in (step, -step):
            moved = dataclasses.replace(fit.lift, parameters=fit.lift.parameters | {name: value + way})
            again = fit_drag(FORMS["cambered"].drag, moved, fit.drag.values, None)
            ends.append(np.array(list(again.parameters.values())))
        found = (ends[0] - ends[1]) / (2 * step)
        spread = np.sqrt(np.diag(fit.drag.covariance)) / math.sqrt(joint[i, i])
        # Gauss and Newton's derivative leaves out the curvature times the residuals.
        np.testing.assert_allclose(found / spread, follow[:, i] / spread, rtol=0.1, atol=0.02)


def test_the_model_file_is_the_fit_and_states_its_wing(fit, model):
    loaded = load_coefficients(model)
    assert isinstance(loaded, CamberedCoefficients)
    assert loaded == fit.coefficients()
    assert (loaded.name, loaded.citation, loaded.grade) == ("mine", "a test", "A")
    assert (loaded.aspect_ratio, loaded.reynolds_range) == (5.5, (4e4, 5e4))
    assert (loaded.low_join_deg, loaded.high_join_deg) == ((-45.0, -24.0), (30.0, 50.0))
    assert loaded.alpha_range_deg == fit.alpha_range_deg == (-24.0, 30.0)
    alpha = np.linspace(-24.0, 30.0, 55)
    for value, curve in ((loaded.lift, fit.lift), (loaded.drag, fit.drag)):
        np.testing.assert_allclose(value(np.deg2rad(alpha)), curve.predict(alpha), rtol=0, atol=1e-12)
    for text in ("aspect_ratio = 5.5", "lift_rounding = 0.15 # held fixed", "zero_lift_deg = -", "interval"):
        assert text in model.read_text()


def test_an_extension_has_no_effect_on_a_cambered_file(model):
    """The model covers all angles: like `Feathered`, it is never mirrored."""
    for extension in ("mirrored", "signed", "clipped-drag"):
        loaded = load_coefficients(model, extension)
        assert loaded.extension == "signed"
        assert float(loaded.lift(-0.2)) != pytest.approx(-float(loaded.lift(0.2)), abs=0.3)
    with pytest.raises(InvalidInputError, match="extension = 'bent'"):
        load_coefficients(model, "bent")


def test_draws_scatter_as_the_covariance_says(fit, model):
    drawn = draw(model, 3000, seed=5)
    values = np.array([[getattr(one.terms, name) for name in FREE] for one in drawn])
    spread = np.sqrt(np.diag(fit.drag.joint))
    terms = fit.model().wing.terms
    assert (np.abs(values.mean(axis=0) - [getattr(terms, name) for name in FREE]) < 0.1 * spread).all()
    scale = np.outer(spread, spread)
    np.testing.assert_allclose(np.cov(values.T) / scale, fit.drag.joint / scale, atol=0.08)
    assert draw(fit, 2, seed=5) == draw(model, 2, seed=5)


REFUSED = {
    "one side": (
        lambda: polar(alpha=np.arange(0.0, 31.0, 2.0)),
        "C_L = '0.29",
        "is negative at none of the angles between 0 and 30",
    ),
    "other side": (
        lambda: polar(alpha=np.arange(-30.0, -5.0, 2.0)),
        "one side of the wing only",
        "above zero lift",
    ),
    "one angle": (
        lambda: polar(alpha=np.arange(-6.0, 31.0, 2.0)),
        "is negative at 1 of the angles between",
        "measure 3 angles",
    ),
    "few": (lambda: polar(alpha=np.array([-20.0, -12.0, -8.0, 4.0, 20.0])), "C_L = '5 points'", "the 4 parameters"),
    "few of drag": (lambda: polar(alpha=np.arange(-20.0, 30.0, 7.0)[:7]), "C_D = '7 points'", "the 6 parameters"),
    "turn": (lambda: polar(alpha=np.arange(-90.0, 91.0, 5.0)), "reaches beyond 60 degrees", "--alpha-min -60"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_tables_that_cannot_decide_it_are_refused(case):
    table, *words = REFUSED[case]
    with pytest.raises(InvalidInputError) as caught:
        fit_wing(table(), "cambered")
    for word in words:
        assert word in str(caught.value)


def test_a_bad_aspect_ratio_is_refused():
    with pytest.raises(InvalidInputError, match="aspect_ratio = -1: must be > 0; give span over mean chord"):
        fit_wing(polar(), "cambered", aspect_ratio=-1)


def test_a_stall_that_was_not_reached_is_told():
    notes = fit_wing(polar(alpha=np.arange(-24.0, 13.0, 1.0)), "cambered").notes
    assert any("C_L: at 12 degrees, where the measurements end, lift has not levelled off" in one for one in notes)
    assert not any("lift_lowest" in one for one in notes)


def test_a_measured_centre_of_pressure_is_named_as_unused():
    table = polar()
    table = CoefficientTable(ALPHA, table.mean | {"x_cp": np.full(len(ALPHA), 0.3)})
    assert "x_cp: the form cambered has no centre of pressure" in " ".join(fit_wing(table, "cambered").notes)


BAD_MODELS = {
    "lift_lowest = -|lift_lowest = ": ["wing.lift_lowest = 0.4", "must be < 0"],
    "low_join_deg = [-45.0|low_join_deg = [-15.0": ["low_join_deg = [-15.0, -24.0]: has the highest value first"],
    "high_join_deg = [30.0|high_join_deg = [-30.0": ["must increase, lie between -90 and 90 degrees"],
    "low_rise = |low_raise = ": ["'low_raise'", "wing.low_rise = None: must be a number"],
    "[wing]|alpha_range_deg = [0.0, 1.0]\n[wing]": ["'alpha_range_deg' = '': is not a known key"],
    'free = ["zero_lift_deg"|free = ["zero"': ["wing.fit.free", "must name terms of the formula"],
    "aspect_ratio = 5.5|aspect_ratio = 0.0": ["aspect_ratio = 0.0: must be > 0"],
}


@pytest.mark.parametrize("change", BAD_MODELS)
def test_bad_model_files_are_refused(model, change):
    assert_refused(model, change, BAD_MODELS[change])


def test_every_term_is_a_word_of_the_table():
    for name in vars(TRUTH):
        assert "cambered wing" in find(f"aero.wing.{name}").label or "separation" in find(f"aero.wing.{name}").label
