"""Least squares within bounds, beside SciPy's own."""

import numpy as np
import pytest
import scipy.optimize

from wingbeat.orbits.nlp.levenberg_marquardt import least_squares
from wingbeat.orbits.search_options import LeastSquaresOptions


def problem(seed, rows, columns):
    """Return a bent map, its derivative, bounds that some of the answer's unknowns meet, and a start."""
    random = np.random.default_rng(seed)
    matrix, bend, target = (
        random.normal(size=(rows, columns)),
        0.1 * random.normal(size=columns),
        random.normal(size=rows),
    )

    def residuals(x):
        return matrix @ (x + bend * x**2) - 3.0 * target

    def jacobian(x):
        return matrix * (1.0 + 2.0 * bend * x)

    return residuals, jacobian, -0.8 * np.ones(columns), 0.6 * np.ones(columns), random.uniform(-0.5, 0.5, columns)


@pytest.mark.parametrize(("rows", "columns"), [(8, 5), (6, 6), (6, 9)])
@pytest.mark.parametrize("seed", range(6))
def test_within_bounds_the_least_is_that_of_another_method(rows, columns, seed):
    residuals, jacobian, lower, upper, start = problem(seed, rows, columns)
    found = least_squares(residuals, jacobian, start, lower, upper, LeastSquaresOptions(200, 1e-12))
    theirs = scipy.optimize.least_squares(
        residuals, start, jacobian, bounds=(lower, upper), xtol=1e-14, ftol=1e-14, gtol=1e-14
    )
    assert (found >= lower).all()
    assert (found <= upper).all()
    assert (residuals(found) ** 2).sum() == pytest.approx(2.0 * theirs.cost, rel=1e-6, abs=1e-12)


def test_it_stops_after_so_many_evaluations_and_backs_away_from_what_is_no_number():
    residuals, jacobian, lower, upper, start = problem(0, 8, 5)
    count = 0

    def counted(x):
        nonlocal count
        count += 1
        return residuals(x)

    least_squares(counted, jacobian, start, lower, upper, LeastSquaresOptions(3, 1e-300))
    assert count == 3

    def torn(x):
        return residuals(x) if np.abs(x - start).max() < 0.2 else np.full(8, np.nan)

    found = least_squares(torn, jacobian, start, lower, upper, LeastSquaresOptions(100, 1e-9))
    assert (residuals(found) ** 2).sum() < (residuals(start) ** 2).sum()


def test_fewer_residuals_than_unknowns_leave_every_step_fixed():
    count = 0

    def residuals(x):
        nonlocal count
        count += 1
        return np.array([1.0 + 0.5 ** min(count, 300) * (x[0] + x[1])])

    start = np.zeros(3)
    found = least_squares(
        residuals,
        lambda x: np.array([[1.0, 1.0, 0.0]]),
        start,
        start - 1.0,
        start + 1.0,
        LeastSquaresOptions(150, 1e-300),
    )
    assert np.isfinite(found).all()
