"""A start of one's own, the solver's steps, Lagrange multipliers, and derivatives of the optimum for JAX."""

import dataclasses
import json
import re

import jax
import numpy as np
import pytest
from scipy.optimize import minimize

import wingbeat as wb
from wingbeat._base import InvalidInputError
from wingbeat._base.nomenclature import label_of
from wingbeat.animal.kinematics import flap_angle
from wingbeat.cli import main
from wingbeat.experiment import Film, fit_film
from wingbeat.orbits.flight.period import CLOSURE_SCALE
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.problem.parameters import bound_of
from wingbeat.orbits.solve import _where_limits_hold
from wingbeat.orbits.uncertainty import OptimumSlopes
from wingbeat.results.own_start import own_start


@pytest.fixture(scope="module")
def problem():
    return wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0)


@pytest.fixture(scope="module")
def orbit(problem):
    """The optimum of the paper's pigeon at 10 m/s."""
    return wb.solve_orbit(problem, starts=1)


@pytest.fixture(scope="module")
def traced(problem):
    return wb.solve_orbit(problem, starts=2, trace=True)


def numbers_of(orbit):
    """The record without times, and without what only a start or a trace of one's own brings."""
    return {k: v for k, v in orbit.record().items() if k not in ("solve_seconds", "trace", "start")}


def test_steps_are_kept_only_if_asked_for_and_change_no_number(problem, orbit, traced):
    plain = wb.solve_orbit(problem, starts=2)
    assert numbers_of(plain) == numbers_of(traced)
    assert json.dumps(plain.inputs) == json.dumps(traced.inputs)
    assert not {"trace", "start"} & plain.record().keys()
    with pytest.raises(InvalidInputError, match=r"was not kept; solve with wb\.solve_orbit"):
        _ = plain.trace


def test_each_search_ends_closed_and_the_best_is_certified(traced):
    table = traced.trace.to_dataframe()
    assert list(table) == ["search", "stage", "iteration", "objective", "residual", "step"]
    ends = table[table.stage == "search"].groupby("search").last()
    assert list(ends.index) == [0, 1]
    assert (ends.residual < DEFAULTS.search.closure_tolerance).all()
    last = table.iloc[-1]
    assert (last.stage, last.search) == ("certificate", int(ends.objective.argmin()))
    assert last.objective == pytest.approx(traced.wingbeat.frequency, rel=1e-12)
    assert last.residual == pytest.approx(
        np.abs(np.array([*traced.record()["closure"].values()]) / CLOSURE_SCALE).max(), rel=1e-9
    )
    # The second start is first brought close to closure.
    assert list(dict.fromkeys(table[table.search == 1].stage)) == ["restoration", "search"]
    assert "certificate" in traced.trace.summary()


def test_the_certificate_belongs_to_the_search_that_led_to_it(problem):
    """Two searches end in the same optimum; the number was that of the end nearest to it, not of the lowest."""
    table = wb.solve_orbit(dataclasses.replace(problem, speed=8.0), starts=3, trace=True).trace.to_dataframe()
    ends = table[table.stage == "search"].groupby("search").last().objective
    assert ends[0] == pytest.approx(ends[2], rel=1e-6)
    assert set(table[table.stage == "certificate"].search) == {int(ends.argmin())}


@pytest.mark.slow
def test_searches_from_where_a_limit_holds_keep_their_steps():
    """They lead to an orbit where no start does; their steps were lost."""
    limited = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, subject_to=["mean_positive_power<=46"])
    programme = Transcription(limited)
    programme.steps = []
    found = next(_where_limits_hold(programme, 1, 0, 1))
    assert found
    assert all(candidate.programme.steps for candidate in found)


def test_where_another_search_comes_first_it_is_not_said_where_the_start_led(problem, orbit, monkeypatch):
    """The gust response is minimised from optima of another problem, so no search of it begins at the start."""
    monkeypatch.setattr("wingbeat.orbits.solve.minimises_map", lambda problem: True)
    assert wb.solve_orbit(problem, start=orbit).record()["start"]["led_here"] is None


def test_a_search_from_an_optimum_ends_there_within_few_steps(problem, orbit):
    again = wb.solve_orbit(problem, start=orbit, trace=True)
    assert again.record()["start"] | {"values": {}} == {
        "kind": "orbit",
        "values": {},
        "notes": [],
        "led_here": True,
    }
    assert again.inputs["starts"] == 1
    assert again.wingbeat.frequency == pytest.approx(orbit.wingbeat.frequency, rel=1e-6)
    assert len(again.trace.rows) < 12
    pair = wb.solve_orbit(problem, start=(orbit.wingbeat, orbit.initial_state))
    assert numbers_of(pair) == numbers_of(again)


def test_a_search_from_a_film_of_the_optimum_ends_there(problem, orbit):
    film = wb.experiment.synthetic_film(orbit.wingbeat, frames=80, noise_deg=2.0, seed=3)
    found = wb.solve_orbit(problem, start=wb.experiment.fit_film(film))
    start = found.record()["start"]
    assert (start["kind"], start["led_here"]) == ("film", True)
    assert start["values"]["flap_amplitude"] == pytest.approx(orbit.wingbeat.flap_amplitude, abs=0.03)
    assert any("first usual start: body_pitch, u, w, pitch_rate" in note for note in start["notes"])
    assert found.wingbeat.frequency == pytest.approx(orbit.wingbeat.frequency, rel=1e-6)


def test_what_a_start_lacks_or_the_problem_holds_fixed_is_said(problem):
    bat = wb.load_species("bat").wingbeat
    notes = " ".join(own_start(problem, (bat, wb.State(u=10.0, body_pitch=1.5))).notes)
    assert "not free, so the problem's own value holds: twist_ratio 1 (the start has 1.6)" in notes
    assert "body_pitch 85.94 deg is outside its bounds: the search starts at 60 deg" in notes
    notes = own_start(problem, {"frequency": 6.0}).notes
    assert notes == (
        "not given, so taken from the first usual start: body_pitch, u, w, pitch_rate, flap_mean, flap_amplitude, "
        "pitch_mean, pitch_amplitude",
    )


@pytest.mark.slow
def test_a_state_given_with_a_film_is_kept(problem, orbit):
    """Where the film shows the body, the state was dropped without a word."""
    flight = wb.simulate(problem.model, orbit.wingbeat, orbit.initial_state, beats=2, samples=60)
    phase = np.linspace(0.0, 2.0, len(flight.states))
    x, z, pitch = flight.states[:, :3].T
    body = {"body_x_m": x, "body_z_m": z, "body_pitch_deg": np.degrees(pitch)}
    columns = {"flap_deg": np.degrees(flap_angle(orbit.wingbeat, phase)), **body}
    beat = fit_film(Film("flown", phase, columns, orbit.wingbeat.frequency, 0.0))
    assert own_start(problem, beat).values["u"] == pytest.approx(orbit.initial_state.u, abs=0.1)
    start = own_start(problem, (beat, wb.State(u=8.0, body_pitch=0.3)))
    assert (start.kind, start.values["u"], start.values["body_pitch"]) == ("film", 8.0, 0.3)
    assert "the state is the one given with the film" in start.notes


def test_multipliers_and_starts_are_by_the_orbits_own_options(problem, orbit, monkeypatch):
    """They were by the default options, which the caller had replaced."""
    families = (DEFAULTS.search.start_families[0]._replace(frequency=0.9),)
    options = dataclasses.replace(DEFAULTS, search=dataclasses.replace(DEFAULTS.search, start_families=families))
    begun = wb.solve_orbit(problem, start={"flap_mean": 0.0}, options=options).record()["start"]
    assert begun["values"]["frequency"] == pytest.approx(0.9 * 6.0)
    found = wb.solve_orbit(problem, start=orbit, options=options)
    used, slopes = [], OptimumSlopes(problem, found.unknowns)
    monkeypatch.setattr("wingbeat.results.orbit.OptimumSlopes", lambda *given: used.append(given) or slopes)
    assert found.multipliers.bounds
    assert used[0][2] == options


STOCK = wb.load_species("pigeon").wingbeat


@pytest.mark.parametrize(
    ("start", "said"),
    [
        ({"frequncy": 6.0}, "start.frequncy = 6.0: is no unknown of this problem; did you mean frequency?"),
        ({"flap_amplitude": 70.0}, "70 seems to be in degrees: write np.radians"),
        ({"frequency": float("nan")}, "start.frequency = nan: must be finite"),
        ("orbit.nc", "start = 'str': is nothing that a search can start from; give an orbit, a wingbeat"),
        (np.zeros(9), "is nothing that a search can start from"),
        ((STOCK, "abcdef"), "initial_state = 'abcdef': must be a State or six numbers"),
        ((STOCK, [[1.0, 2.0], 3.0, 4.0, 5.0, 6.0, 7.0]), "must be a State or six numbers"),
        ((STOCK, np.zeros(4)), "'shape (4,)': must be a State or six numbers"),
        ((STOCK, [0.0, 0.0, 0.1, "fast", 0.0, 0.0]), "initial_state.u = 'fast': must be a number"),
        ((STOCK, wb.State(u=float("nan"))), "initial_state.u = nan: must be finite"),
    ],
)
def test_what_is_no_start_is_refused(problem, start, said):
    with pytest.raises(InvalidInputError, match=re.escape(said)):
        wb.solve_orbit(problem, start=start)


@pytest.mark.slow
def test_multipliers_are_those_of_scipy_and_the_prices_of_sensitivities(problem, orbit):
    found = orbit.multipliers
    assert found.unique
    scale = problem.minimise.scale
    own = np.array([*found.closure.values()]) * CLOSURE_SCALE / scale
    programme = Transcription(problem, blocks=DEFAULTS.sensitivity.fine_blocks)
    limits = {"type": "ineq", "fun": programme.inequalities, "jac": programme.inequalities_jacobian}
    equal = {"type": "eq", "fun": programme.closure, "jac": programme.closure_jacobian}
    bounds = list(zip(programme.lower, programme.upper, strict=True))
    start, more = programme.scaled(orbit.unknowns), {"jac": programme.objective_gradient, "bounds": bounds}
    solved = minimize(
        programme.objective, start, constraints=[limits, equal], method="SLSQP", options={"ftol": 1e-15}, **more
    )
    # SciPy lists equalities first, whatever the order of the constraints, and leaves out the bounds.
    np.testing.assert_allclose(solved.multipliers[:6], own, rtol=1e-4, atol=1e-6)
    assert not solved.multipliers[6:].any()
    assert found.units["closure.x"] == "Hz per m"
    (price,) = wb.sensitivities(orbit).prices
    assert found.bounds == {"flap_amplitude.upper": pytest.approx(price.objective, rel=1e-6)}
    assert found.table()[-1] == {
        "condition": "bounds.flap_amplitude.upper",
        "multiplier": found.bounds["flap_amplitude.upper"],
        "unit": "Hz per rad",
    }


@pytest.mark.slow
def test_the_multiplier_of_a_limit_is_what_relaxing_it_gains():
    pigeon = wb.load_species("pigeon")

    def limited(power):
        return wb.OrbitProblem(pigeon, speed=10.0, subject_to=[f"mean_positive_power<={power}"])

    orbit = wb.solve_orbit(limited(46.0), starts=2)
    (price,) = [one for one in wb.sensitivities(orbit).prices if one.parameter.path.startswith("limit")]
    found = orbit.multipliers
    assert found.limits == {"mean_positive_power": pytest.approx(price.objective, rel=1e-6)}
    assert found.limits["mean_positive_power"] < 0
    assert found.units["limit.mean_positive_power"] == "Hz per W"
    less, more = (wb.solve_orbit(limited(power), start=orbit).wingbeat.frequency for power in (45.9, 46.1))
    assert found.limits["mean_positive_power"] == pytest.approx((more - less) / 0.2, rel=2e-3)


@pytest.mark.slow
def test_two_limits_of_one_quantity_have_a_name_and_a_slope_each():
    """Both were named after the quantity alone, so one was lost, or had the other's value."""
    sides = ["mean_positive_power<=46", "mean_positive_power>=10"]
    orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, subject_to=sides), starts=2)
    names = ["limit.mean_positive_power.lower", "limit.mean_positive_power.upper"]
    frequency = wb.differentiable_optimum(orbit, names)
    assert frequency.at.tolist() == [10.0, 46.0]
    (price,) = orbit.multipliers.limits.values()
    assert orbit.multipliers.limits == {"mean_positive_power.upper": price}
    assert orbit.multipliers.units[names[1]] == "Hz per W"
    assert np.asarray(jax.grad(frequency)(frequency.at)) == pytest.approx([0.0, price], rel=1e-6, abs=1e-12)
    assert label_of(names[1]).startswith("upper bound of the limit of the mean of the positive part")


def test_a_bound_that_is_not_active_changes_nothing(orbit):
    """Its derivative was that by the other side's bound, which is active."""
    slopes = OptimumSlopes(orbit.problem, orbit.unknowns)
    lower, upper = (slopes.by(bound_of(orbit.problem, "flap_amplitude", side)) for side in ("lower", "upper"))
    assert upper.objective < -1.0
    assert upper.wingbeat["flap_amplitude"] == pytest.approx(1.0)
    assert lower.objective == pytest.approx(0.0, abs=1e-12)
    assert [*lower.wingbeat.values(), *lower.initial_state.values()] == pytest.approx([0.0] * 9, abs=1e-12)


def test_a_pitch_at_its_bound_twice_has_one_multiplier_and_bounds_of_the_search_have_none():
    """Of two multipliers of one name one was lost; and bounds of u were listed, which no problem has."""
    bounds = {"body_pitch": (0.186, 1.0)}
    orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, bounds=bounds), starts=1)
    slopes = OptimumSlopes(orbit.problem, orbit.unknowns)
    along_path = {one.name: one.value for one in slopes.multipliers()}["body_pitch.lower"]
    assert along_path > 0.0
    # As if the pitch were lowest at phase 0, where it is an unknown too, and u at the end of the searched range.
    slopes._free[:2], slopes._at_lower[:2] = False, True
    jacobian = slopes._here.active_conditions(slopes._at, slopes._active)[1]
    slope = slopes._here.objective_gradient(slopes._at) - jacobian.T @ slopes._multipliers
    at_start = slope[0] * orbit.problem.minimise.scale / slopes.scale[0]
    found = {one.name: one.value for one in slopes.multipliers() if one.kind == "bounds"}
    assert found.keys() == {"flap_amplitude.upper", "body_pitch.lower"}
    assert found["body_pitch.lower"] == pytest.approx(along_path + at_start, rel=1e-9, abs=1e-12)
    assert [one.path for one in slopes.active()] == ["bounds.body_pitch.lower", "bounds.flap_amplitude.upper"]


def differences(function, at, i, share):
    """Return the derivative by the number `i`, by central differences of fourth order."""
    step = share * max(abs(at[i]), 0.1)
    values = [float(function(at + k * step * np.eye(len(at))[i])) for k in (-2, -1, 1, 2)]
    return (8 * (values[2] - values[1]) - (values[3] - values[0])) / (12 * step)


@pytest.mark.slow
def test_jax_differentiates_the_optimum(orbit):
    frequency = wb.differentiable_optimum(orbit, ["body.mass", "wing.semi_span", "bounds.flap_amplitude.upper"])
    assert float(frequency(frequency.at)) == pytest.approx(orbit.wingbeat.frequency, rel=1e-6)
    slopes = np.asarray(jax.grad(frequency)(frequency.at))
    for i in range(3):
        assert slopes[i] == pytest.approx(differences(frequency, frequency.at, i, 1e-3), rel=1e-6)
    assert slopes[2] == pytest.approx(orbit.multipliers.bounds["flap_amplitude.upper"], rel=1e-6)

    def cost(mass):  # the chain rule goes through
        return 2.0 * frequency(jax.numpy.array([mass, *frequency.at[1:]])) ** 2

    expected = 4.0 * float(frequency(frequency.at)) * slopes[0]
    assert float(jax.jit(jax.grad(cost))(frequency.at[0])) == pytest.approx(expected, rel=1e-9)
    several = wb.differentiable_optimum(orbit, "speed", ["frequency", "flap_amplitude", "mean_positive_power"])
    jacobian = np.asarray(jax.jacfwd(several)(several.at))
    assert jacobian.shape == (3, 1)
    assert jacobian[1, 0] == pytest.approx(0.0, abs=1e-12)  # it is at its bound
    np.testing.assert_allclose(jax.jacrev(several)(several.at), jacobian, rtol=1e-12)


def test_numbers_that_jax_traces_are_refused_with_the_way_that_works(orbit):
    pigeon = wb.load_species("pigeon")

    def at_speed(speed):
        return wb.solve_orbit(wb.OrbitProblem(pigeon, speed=speed)).wingbeat.frequency

    def with_mass(mass):
        return wb.OrbitProblem(pigeon.with_values({"wing.mass": mass}), speed=10.0).speed

    def with_lift(slope):
        loads = lambda alpha: (slope * jax.numpy.sin(2 * alpha), 0.1 + jax.numpy.sin(alpha) ** 2)  # noqa: E731
        return wb.OrbitProblem(pigeon, speed=10.0, aero=loads).speed

    for function, value in ((at_speed, 10.0), (with_mass, 0.02), (with_lift, 1.2)):
        with pytest.raises(InvalidInputError, match=r"is traced by jax.grad.*use wb.differentiable_optimum\(orbit"):
            jax.grad(function)(value)
    with pytest.raises(InvalidInputError, match=r"speed = Array.*must be a number; write float\(...\) around it"):
        wb.OrbitProblem(pigeon, speed=jax.numpy.asarray(10.0))
    with pytest.raises(
        InvalidInputError, match=r"is no number that this optimum depends on; did you mean body\.mass"
    ):
        wb.differentiable_optimum(orbit, "body.mas")
    frequency = wb.differentiable_optimum(orbit, "body.mass")
    with pytest.raises(InvalidInputError, match=r"shape \(\).*must have the shape \(1,\): body.mass"):
        frequency(0.3)
    with pytest.raises(InvalidInputError, match=r"body.mass = -1.0: must be > 0 kg"):
        frequency(np.array([-1.0]))
    with pytest.raises(jax.errors.JaxRuntimeError, match=r"body.mass = -1.0: must be > 0 kg"):
        jax.jit(frequency)(np.array([-1.0]))


@pytest.mark.slow
def test_a_saved_start_is_read_again_and_solved_again(problem, orbit, tmp_path, capsys):
    path, again = tmp_path / "orbit.nc", tmp_path / "again.nc"
    orbit.save(path)
    asked = ["orbit", "pigeon", "--speed", "10", "--start", str(path), "--trace", "-o", str(again)]
    assert main(asked) == 0
    printed = capsys.readouterr().out
    assert "to this orbit" in printed
    assert "largest step" in printed
    saved = wb.load_orbit(again)
    assert saved.inputs["start"] == saved.record()["start"]["values"]
    assert saved.trace.rows[-1]["stage"] == "certificate"
    assert main(["orbit", "--from", str(again), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["wingbeat"] == saved.record()["wingbeat"]
    assert record["start"]["kind"] == "numbers"
    assert main(["orbit", "--from", str(again), "--start", str(path)]) == 2
    assert "leave out --start" in capsys.readouterr().err
