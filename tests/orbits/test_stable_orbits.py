"""Limits of quantities of the stroke map: their derivatives, and stable orbits."""

import dataclasses
import itertools

import numpy as np
import pytest
import scipy.linalg
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import wingbeat as wb
from wingbeat._base import InvalidInputError
from wingbeat.orbits.flight.certificate import map_and_changes
from wingbeat.orbits.flight.period import flier
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.quantity import MAP_QUANTITIES
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.orbits.starts import easier, start_point

RADIUS, RESPONSE = MAP_QUANTITIES["spectral_radius"], MAP_QUANTITIES["gust_response"]


@pytest.fixture(scope="module")
def problem():
    return wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0, subject_to=["spectral_radius<=0.995"])


@pytest.fixture(scope="module")
def stable(problem):
    return find_orbit(problem, threads=1)


@pytest.mark.parametrize("blocks", [1, 2])
def test_changes_of_the_stroke_map_are_those_of_flights_beside(problem, blocks):
    fly = flier(problem.model, problem.species.wingbeat, problem.free)
    at = start_point(problem, 0, 0)

    def stroke_map(unknowns):
        return np.asarray(fly(unknowns[4:], unknowns[:4], blocks).end_jacobian)[2:, :4]

    found, changes = map_and_changes(fly, at[4:], at[:4], blocks, fly(at[4:], at[:4], blocks))
    assert np.array_equal(found, stroke_map(at))
    for own, step in zip(changes, np.diag(1e-5 * np.maximum(1.0, np.abs(at))), strict=True):
        expected = (stroke_map(at + step) - stroke_map(at - step)) / (2.0 * step.sum())
        assert np.abs(own - expected).max() < 1e-4 * np.abs(expected).max()


def maps_of(*sizes):
    """Return stroke maps of four states, and of six where a hinge gives way."""
    squares = [arrays(float, (n, n), elements=st.floats(-1.2, 1.2, allow_nan=False)) for n in sizes]
    return st.one_of(squares)


maps = maps_of(4, 6)


@settings(deadline=None)  # the first call compiles
@given(maps)
def test_smooth_excess_is_positive_just_where_a_multiplier_leaves_the_circle(stroke_map):
    radius = np.abs(np.linalg.eigvals(stroke_map)).max()
    inside = bool((np.asarray(RADIUS.excess(stroke_map)) <= 0.0).all())
    # Its circle is 0.1 % smaller than the limit; nearer to it, rounding decides.
    if radius < 0.9985:
        assert inside
    if radius > 0.9995:
        assert not inside


@given(maps)
def test_the_last_excess_is_a_product_over_pairs_of_multipliers(stroke_map):
    pairs = itertools.combinations(np.linalg.eigvals(stroke_map / 0.999), 2)
    factors = np.array([1.0 - one * other for one, other in pairs])
    size = 64.0 * np.abs(factors).prod()
    assert float(-RADIUS.excess(stroke_map)[-1]) == pytest.approx(64.0 * factors.prod().real, abs=1e-7 * (1 + size))


@pytest.mark.parametrize("hinge", [(), (0.03, -0.01)])
def test_smooth_excess_has_a_derivative_where_two_multipliers_meet(hinge):
    import jax

    stroke_map = np.diag([0.999, 0.999, 0.5, 0.2, *hinge])
    stroke_map[0, 1] = 1.0
    slopes = np.asarray(jax.jacfwd(RADIUS.excess)(stroke_map))
    assert np.isfinite(slopes).all()
    assert np.abs(slopes).max() > 0.1


@settings(deadline=None)  # the first call compiles
@given(maps)
def test_gust_response_is_the_sum_over_all_earlier_gusts(stroke_map):
    radius = np.abs(np.linalg.eigvals(stroke_map)).max()
    stroke_map = stroke_map * 0.9 / max(radius, 0.9)
    gust = (np.eye(len(stroke_map)) - stroke_map)[:, 1:3]
    covariance = scipy.linalg.solve_discrete_lyapunov(stroke_map, gust @ gust.T)
    expected = np.sqrt(np.diag(covariance)[:4] @ np.array([0.1, 1.0, 1.0, 2.0]) ** -2)
    assert float(RESPONSE.of(stroke_map)) == pytest.approx(expected, rel=1e-8)


def test_gust_response_is_what_random_gusts_do(stable):
    stroke_map = stable.monodromy
    random, gust = np.random.default_rng(7), (np.eye(4) - stroke_map)[:, 1:3]
    state, squares, count = np.zeros((4, 4000)), 0.0, 600
    for beat in range(2 * count):
        state = stroke_map @ state + gust @ random.normal(size=(2, 4000))
        if beat >= count:
            squares += np.mean(state**2, axis=1) @ np.array([0.1, 1.0, 1.0, 2.0]) ** -2 / count
    assert np.sqrt(squares) == pytest.approx(stable.value_of(RESPONSE), rel=0.02)


def test_the_pigeon_is_stable_for_little_frequency(stable, problem):
    assert stable.status is wb.Status.CONVERGED
    assert np.abs(stable.multipliers).max() <= 0.995
    assert stable.objective == pytest.approx(9.549, abs=0.005)
    free = find_orbit(easier(problem), threads=1)
    assert np.abs(free.multipliers).max() > 1.3
    assert stable.free_objective == pytest.approx(free.objective, rel=1e-6)
    assert stable.price_of_stability == pytest.approx(stable.objective / free.objective - 1.0, rel=1e-6)


def test_the_record_says_what_stability_costs(stable):
    record = wb.Orbit.of(stable, 6).record()
    assert record["stable"] is True
    assert record["constraints"]["spectral_radius<=0.995"] == pytest.approx(np.abs(stable.multipliers).max())
    assert record["free_objective"] < record["objective_value"]
    assert record["price_of_stability"] == stable.price_of_stability


def test_a_free_orbit_has_no_price_of_stability(problem):
    record = wb.solve_orbit(easier(problem), starts=1).record()
    assert "price_of_stability" not in record
    assert "free_objective" not in record


def test_the_bat_that_flips_has_a_stable_orbit_beside():
    bat = find_orbit(
        wb.OrbitProblem(wb.load_species("bat"), speed=10.0, subject_to=["spectral_radius<=0.995"]), threads=1
    )
    assert bat.status is wb.Status.CONVERGED
    assert np.abs(bat.multipliers).max() <= 0.995
    assert 0.0 < bat.price_of_stability < 0.15


@pytest.mark.slow
def test_least_gust_response_is_less_than_that_of_the_stable_orbit(stable, problem):
    calm = find_orbit(dataclasses.replace(problem, minimise="gust_response"), threads=1)
    assert calm.status is wb.Status.CONVERGED
    assert calm.objective < 0.8 * stable.value_of(RESPONSE)
    assert np.abs(calm.multipliers).max() <= 0.995
    limit = 0.5 * (calm.objective + stable.value_of(RESPONSE))
    limited = find_orbit(dataclasses.replace(problem, subject_to=[f"gust_response<={limit}"]), threads=1)
    assert limited.value_of(RESPONSE) <= limit * (1 + 1e-6)
    assert limited.objective > stable.objective


def test_a_map_quantity_of_your_own_can_be_limited(problem):
    trace = wb.MapQuantity("trace", lambda stroke_map: stroke_map.trace())
    found = find_orbit(dataclasses.replace(problem, subject_to=[wb.Constraint(trace, 3.7)]), Settings(1), threads=1)
    assert found.status is wb.Status.CONVERGED
    assert found.value_of(trace) == pytest.approx(3.7, abs=1e-5)
    assert found.value_of(trace) == pytest.approx(found.multipliers.sum().real, abs=1e-9)


@pytest.mark.parametrize(
    ("of", "rule"),
    [
        (lambda stroke_map: stroke_map, "must give one number, or a row of numbers"),
        (lambda stroke_map: stroke_map.frequency, "fails"),
    ],
)
def test_a_map_quantity_that_cannot_be_used_is_refused(problem, of, rule):
    with pytest.raises(InvalidInputError, match=rule):
        dataclasses.replace(problem, subject_to=[wb.Constraint(wb.MapQuantity("own", of), 1.0)])


def test_a_limit_of_stability_has_five_numbers_without_kinks(problem):
    programme = Transcription(problem)
    unknowns = programme.physical(programme.scaled(start_point(problem, 0, 0)))
    values = programme._certified(programme.outputs, unknowns, find_orbit(easier(problem), Settings(1)).certificate)
    assert values.shape == (5,)


@pytest.mark.slow
def test_a_saved_stable_orbit_keeps_its_limit(stable, tmp_path):
    wb.Orbit.of(stable, 6).save(tmp_path / "stable.nc")
    loaded = wb.load_orbit(tmp_path / "stable.nc")
    assert [str(limit) for limit in loaded.problem.subject_to] == ["spectral_radius<=0.995"]
    assert loaded.record()["price_of_stability"] == pytest.approx(stable.price_of_stability)


@pytest.mark.slow
def test_the_price_of_a_tighter_limit_is_that_of_a_new_search(problem):
    orbits = [
        wb.solve_orbit(
            dataclasses.replace(problem.at_speed(16.0), subject_to=[f"spectral_radius<={limit}"]), starts=2
        )
        for limit in (0.995, 0.99)
    ]
    found = wb.sensitivities(orbits[0], quantities=["spectral_radius"])
    price = next(p for p in found.prices if "spectral_radius" in p.parameter.path)
    values = [orbit.record()["objective_value"] for orbit in orbits]
    assert price.objective == pytest.approx((values[1] - values[0]) / (0.99 - 0.995), rel=0.1)
    assert price.quantities["spectral_radius"] == pytest.approx(0.999, abs=0.01)  # the limit is 0.1 % inside


def test_the_spectral_radius_itself_is_not_minimised(problem):
    with pytest.raises(InvalidInputError, match=r"minimise = 'spectral_radius': can be limited but not minimised"):
        dataclasses.replace(problem, minimise="spectral_radius")
