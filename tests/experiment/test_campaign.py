"""The synthetic campaign: whatever the pipeline returns is held against the truth it was made from."""

from collections import Counter

import numpy as np
import pytest

from wingbeat.aero import SuFan
from wingbeat.experiment import FORMS, Campaign, CoefficientTable, fit_wing, read_run, reduce_runs, save_runs
from wingbeat.experiment.campaign import TRUTH, synthetic_runs, true_coefficients
from wingbeat.experiment.wing_fit import WingFit

# Records are thinned, for speed; the sweep, the noise and the repeats are those of the whole campaign.
THINNED = Campaign(rate=10.0)
SEEDS = 100


def truth_of(fit: WingFit, label: str) -> dict[str, float]:
    return {name: getattr(TRUTH[label], name) for name in fit.curves[label].parameters}


@pytest.mark.slow
def test_a_hundred_campaigns_hold_the_truth_as_often_as_their_fits_say() -> None:
    """One test, not one for each question: two processes that share the tests would each make all the campaigns."""
    fits = [fit_wing(reduce_runs(synthetic_runs(THINNED, seed))) for seed in range(SEEDS)]
    for label in TRUTH:
        the_joint_region_of_a_fit_covers_the_truth_as_often_as_it_says(fits, label)
        the_interval_of_each_parameter_covers_the_truth_as_often_as_it_says(fits, label)
        the_errors_explain_the_scatter(fits, label)
    # As the paper's.
    assert min(curve.r_squared for fit in fits for curve in fit.curves.values()) > 0.995
    a_band_of_new_points_holds_a_new_campaign(fits[0])
    a_form_that_cannot_follow_the_small_angles_is_told_from_one_that_can(fits[0])


def the_joint_region_of_a_fit_covers_the_truth_as_often_as_it_says(fits: list[WingFit], label: str) -> None:
    covered = sum(fit.curves[label].covers(truth_of(fit, label)) for fit in fits)
    assert 90 <= covered <= 99, label


def the_interval_of_each_parameter_covers_the_truth_as_often_as_it_says(fits: list[WingFit], label: str) -> None:
    covered: Counter[str] = Counter()
    for fit in fits:
        limits = fit.curves[label].interval()
        true = truth_of(fit, label)
        covered.update(name for name in true if limits[name][0] <= true[name] <= limits[name][1])
    names = fits[0].curves[label].parameters
    assert min(covered[name] for name in names) >= 87, (label, covered)
    assert np.mean([covered[name] for name in names]) >= 91, (label, covered)


def the_errors_explain_the_scatter(fits: list[WingFit], label: str) -> None:
    per_freedom = [fit.curves[label].chi_squared / fit.curves[label].freedom for fit in fits]
    assert 0.9 < np.mean(per_freedom) < 1.15, label


def a_band_of_new_points_holds_a_new_campaign(fit: WingFit) -> None:
    new = reduce_runs(synthetic_runs(THINNED, SEEDS))
    for label, curve in fit.curves.items():
        known = np.isfinite(new.mean[label])
        apart = np.abs(new.mean[label][known] - curve.predict(new.alpha_deg[known]))
        assert 0.9 < np.mean(apart < curve.band(new.alpha_deg[known])) <= 1.0, label


def a_form_that_cannot_follow_the_small_angles_is_told_from_one_that_can(fit: WingFit) -> None:
    dickinson, sine = (fit_wing(fit.table, form) for form in ("dickinson", "sine-cosine"))
    assert fit.lift.aicc < dickinson.lift.aicc - 100 < sine.lift.aicc - 200
    assert set(FORMS) == {"su-fan", "dickinson", "sine-cosine", "cambered"}


@pytest.mark.parametrize("label", TRUTH)
def test_data_without_noise_give_the_coefficients_back(label: str) -> None:
    alpha = np.arange(0.0, 111.0, 2.0)
    lift, drag, centre = true_coefficients(alpha)
    fit = fit_wing(CoefficientTable(alpha, {"C_L": lift, "C_D": drag, "x_cp": centre}))
    found = fit.curves[label].parameters
    assert found == pytest.approx(truth_of(fit, label), rel=1e-9)
    assert fit.curves[label].r_squared == pytest.approx(1.0, abs=1e-12)
    assert fit.notes == ()


def test_the_truth_is_the_packages_own_su_fan() -> None:
    alpha = np.arange(2.0, 89.0)
    lift, drag, centre = true_coefficients(alpha)
    model, radians = SuFan(), np.deg2rad(alpha)
    assert {"C_L": model.lift_terms, "C_D": model.drag_terms, "x_cp": model.centre_terms} == TRUTH
    np.testing.assert_allclose(lift, model.lift(radians), atol=1e-12)
    np.testing.assert_allclose(drag, model.drag(radians), atol=1e-12)
    np.testing.assert_allclose(centre, model.centre_of_pressure(radians), atol=1e-12)


def test_files_of_runs_read_back_as_they_were(tmp_path) -> None:
    small = Campaign(reynolds=(3e4,), alpha_deg=(0.0, 10.0, 60.0), repeats=2, rate=10.0)
    runs = synthetic_runs(small, seed=4)
    again = [read_run(path) for path in save_runs(runs, tmp_path)]
    assert "SYNTHETIC" in (tmp_path / "re30000_a10_1.csv").read_text()
    here, there = reduce_runs(runs), reduce_runs(again)
    for label in ("C_L", "C_D", "C_M"):
        np.testing.assert_allclose(there.mean[label], here.mean[label], rtol=0, atol=1e-6)
        np.testing.assert_allclose(there.se[label], here.se[label], rtol=1e-4)
