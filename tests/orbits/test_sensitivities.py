"""Derivatives of optima against solving anew, prices of bounds, and error bars against draws."""

import json
import math
import types

import numpy as np
import pytest
from rich.console import Console

import wingbeat as wb
from tests.helpers.figures import check_legends
from tests.helpers.hasty import make_hasty
from wingbeat._base import InvalidInputError
from wingbeat.aero.model_file import FittedCurve, FittedModel, FittedWing
from wingbeat.cli import main
from wingbeat.cli.uncertainty import _plain, _print, _tell_unsolved
from wingbeat.orbits.flight.certificate import certify
from wingbeat.orbits.flight.time_series import flown_beat
from wingbeat.orbits.nlp.newton_kkt import NewtonKKT
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.orbits.problem.quantities import QUANTITIES
from wingbeat.orbits.solution import correct_guess
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat.orbits.uncertainty import ErrorBar, OptimumSlopes, ParameterSpread, first_order
from wingbeat.records.shares import unsolved
from wingbeat.results.error_bars import Comparison, _compared
from wingbeat.results.sensitivities import _of_fit

POWER = QUANTITIES["mean_positive_power"]
SHARE = 0.005


def solved(name, speed, **asked):
    problem = wb.OrbitProblem(wb.load_species(name), speed=speed, **asked)
    return find_orbit(problem, Settings(2))


class Optimum:
    """The optimum next to unknowns by the flights that slopes are of; `like` is the curvature of one nearby."""

    def __init__(self, problem, unknowns, like=None):
        self.problem = problem
        self.programme = Transcription(problem, blocks=DEFAULTS.sensitivity.fine_blocks)
        guess = self.programme.scaled(unknowns)
        flown = certify(problem.model, problem.wingbeat(unknowns), unknowns[:4], DEFAULTS.certificate.rtol)
        newton = NewtonKKT(self.programme.uncorrected().matched_to(guess, flown), guess, like)
        found = newton.converge(self.programme, guess, DEFAULTS.sensitivity.step_tolerance)
        assert found is not None
        self.scaled, self.curvature = found, newton.reduced_hessian

    @property
    def numbers(self):
        """Objective, a power, and the unknowns in their scale."""
        unknowns = self.programme.physical(self.scaled)
        wingbeat = self.problem.wingbeat(unknowns)
        flown = certify(self.problem.model, wingbeat, unknowns[:4], DEFAULTS.certificate.rtol)
        velocity = self.problem.speed, self.problem.climb
        beat = flown_beat(self.problem.model, wingbeat, flown.phase, flown.states[:, 2:], velocity)
        objective = self.programme.objective(self.scaled) * self.problem.minimise.scale
        return np.array([objective, float(POWER.of(beat)), *(unknowns / self.programme.unknowns.scale)])


def solved_anew(here, slope, share):
    """Return the derivative by solving at both sides of a parameter, or one and twice that where it ends there."""
    parameter, step = slope.parameter, share * slope.parameter.size
    moved = np.array([*slope.initial_state.values(), *slope.wingbeat.values()])
    unknowns = here.programme.physical(here.scaled)

    def at(steps):
        problem = parameter.changed(here.problem, parameter.value + steps * step)
        return Optimum(problem, unknowns + steps * step * moved, here.curvature).numbers

    try:
        return (at(1) - at(-1)) / (2 * step)
    except InvalidInputError:
        return (4 * at(1) - at(2) - 3 * at(0)) / (2 * step)


# The last is flown for a few parameters only, for its flights cost most.
CASES = [("pigeon", 10.0, "frequency", 1), ("bat", 10.0, "frequency", 1), ("bat", 8.0, "mean_positive_power", 7)]


@pytest.mark.parametrize(("name", "speed", "minimise", "every"), CASES)
def test_every_derivative_is_that_of_solving_anew(name, speed, minimise, every):
    solution = solved(name, speed, minimise=minimise)
    optimum = OptimumSlopes(solution.problem, solution.unknowns)
    here = Optimum(solution.problem, solution.unknowns)
    numbers = here.numbers
    np.testing.assert_allclose(numbers[2:] * optimum.scale, optimum.unknowns, rtol=0, atol=1e-8)
    checked = 0
    for parameter in parameters_of(solution.problem)[::every]:
        slope = optimum.by(parameter, [POWER])
        wide, near = (solved_anew(here, slope, share) for share in (SHARE, SHARE / 2))
        # What is left when the square of the step is taken out, and how far that can be trusted.
        anew = (4 * near - wide) / 3
        doubt = np.abs(wide - near)
        changes = np.array([*slope.initial_state.values(), *slope.wingbeat.values()]) / optimum.scale
        found = np.array([slope.objective, slope.quantities["mean_positive_power"], *changes])
        least = 1e-6 / (SHARE * parameter.size)
        # An optimum is found to some 1e-6 of its numbers.
        allowed = 0.01 * np.abs(anew) + least * np.maximum(1.0, np.abs(numbers)) + doubt
        # An unknown that hardly moves has a part in the whole move's error.
        allowed[2:] += 0.002 * np.abs(anew[2:]).max()
        assert (np.abs(found - anew) <= allowed).all(), parameter.path
        # The objective needs no such care, but where the step itself is a large one.
        if parameter.value and abs(anew[0] - wide[0]) < 0.005 * abs(anew[0]):
            assert slope.objective == pytest.approx(wide[0], rel=0.01, abs=least), parameter.path
            checked += 1
    assert checked >= 18 // every


@pytest.fixture(scope="module")
def pigeon():
    problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0)
    orbit = wb.solve_orbit(problem, starts=1)
    return orbit, wb.sensitivities(orbit)


def test_the_derivative_is_that_of_certified_orbits(pigeon):
    orbit, found = pigeon
    for slope in found.slopes:
        parameter = slope.parameter
        if parameter.path in ("wing.mass", "air.density", "aero.drag.constant"):
            step = SHARE * parameter.size
            pair = [parameter.changed(orbit.problem, parameter.value + sign * step) for sign in (1, -1)]
            anew = [correct_guess(problem, orbit.unknowns).objective for problem in pair]
            assert slope.objective == pytest.approx((anew[0] - anew[1]) / (2 * step), rel=0.01)


def test_the_price_of_a_bound_is_what_widening_it_gains(pigeon):
    orbit, found = pigeon
    (price,) = found.prices
    assert price.parameter.path == "bounds.flap_amplitude.upper"
    low, high = orbit.problem.bounds["flap_amplitude"]
    step = math.radians(0.5)
    wider, narrower = (
        wb.solve_orbit(
            wb.OrbitProblem(orbit.problem.species, speed=10.0, bounds={"flap_amplitude": (low, high + d)}), starts=1
        )
        for d in (step, -step)
    )
    anew = (wider.wingbeat.frequency - narrower.wingbeat.frequency) / (2 * step)
    assert price.objective == pytest.approx(anew, rel=0.01)
    assert price.wingbeat["flap_amplitude"] == pytest.approx(1.0)


def test_a_limit_that_binds_has_a_price():
    limits = [46.0, 46.05]
    found = [solved("pigeon", 10.0, subject_to=[f"mean_positive_power<={limit}"]) for limit in limits]
    optimum = OptimumSlopes(found[0].problem, found[0].unknowns)
    (limit,) = [p for p in optimum.active() if p.path.startswith("limit.")]
    anew = (found[1].objective - found[0].objective) / (limits[1] - limits[0])
    assert optimum.by(limit).objective == pytest.approx(anew, rel=0.02)
    assert anew < 0
    # What the limit set is no prediction: it has no error bar, neither to first order nor from draws.
    slopes = wb.sensitivities(wb.Orbit.of(found[0], 2))
    assert slopes.limited == {"mean_positive_power"} == found[0].limited
    assert slopes.error_bar("mean_positive_power").set_by_limit
    assert not slopes.error_bar("frequency").set_by_limit
    compared = wb.uncertainty_by_samples(slopes, samples=10, share=0.02)
    page = wb.plots.tornado_page(slopes)
    assert check_legends(page) == ["low end of its range", "high end"]
    panels = page.axes
    assert panels[1].get_xlabel() == "mean positive power: 46 W, set by the limit"
    assert max(abs(bar.get_width()) for bar in panels[0].patches) == pytest.approx(1.0)
    assert max(abs(bar.get_width()) for bar in panels[1].patches) == 0.0
    assert compared["frequency"].limited.share == 0.0
    assert compared["mean_positive_power"].limited.in_words("W") == "set by the limit 46 W in 100 % of the samples"


def test_turning_the_stroke_plane_or_thinning_the_honey_changes_nothing(pigeon):
    slopes = {s.parameter.path: s for s in pigeon[1].slopes}
    assert abs(slopes["wing.stroke_plane_angle"].objective) < 1e-5
    assert slopes["wing.stroke_plane_angle"].initial_state["body_pitch"] == pytest.approx(1.0, abs=1e-4)
    assert slopes["air.viscosity"].objective == 0.0
    assert slopes["wing.shoulder.y"].objective == 0.0


def test_a_loaded_orbit_has_the_same_sensitivities_and_keeps_its_ranges(pigeon, tmp_path):
    orbit, found = pigeon
    orbit.save(tmp_path / "p.nc")
    again = wb.sensitivities(wb.load_orbit(tmp_path / "p.nc"))
    for one, other in zip(found.table(), again.table(), strict=True):
        assert one["parameter"] == other["parameter"]
        assert one["plausible"] == other["plausible"]
        assert other["objective"] == pytest.approx(one["objective"], rel=1e-6, abs=1e-9)


def test_what_is_not_certified_or_not_known_is_refused(pigeon):
    tiny = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, bounds={"flap_amplitude": (0.01, 0.02)})
    fallen = find_orbit(tiny, Settings(1, most_starts=1, explain=False))
    with pytest.raises(InvalidInputError, match="not certified"):
        wb.sensitivities(wb.Orbit.of(fallen, 1))
    with pytest.raises(InvalidInputError, match="elegance"):
        wb.sensitivities(pigeon[0], ["elegance"])
    with pytest.raises(InvalidInputError, match="quantity"):
        pigeon[1].error_bar("peak_power")
    with pytest.raises(InvalidInputError, match="share"):
        pigeon[1].error_bar("frequency", share=0.0)
    with pytest.raises(InvalidInputError, match="samples"):
        wb.uncertainty_by_samples(pigeon[1], samples=2)


def test_error_bars_add_up_and_name_what_they_are_due_to(pigeon):
    bar = pigeon[1].error_bar("frequency")
    assert bar.value == pytest.approx(pigeon[0].wingbeat.frequency, rel=1e-6)
    assert bar.deviation == pytest.approx(math.hypot(*bar.due_to.values()))
    assert next(iter(bar.due_to)) == "wing.semi_span"
    slope = next(s for s in pigeon[1].slopes if s.parameter.path == "wing.semi_span")
    assert bar.due_to["wing.semi_span"] == pytest.approx(
        abs(slope.quantities["frequency"]) * (0.335 - 0.25) / math.sqrt(12)
    )


def test_the_deviation_of_few_draws_is_not_given_as_better_known_than_of_a_normal_distribution(pigeon):
    """Few draws do not tell the fourth moment: of three, it made the error 0."""
    found = wb.uncertainty_by_samples(pigeon[1], ["frequency"], samples=10, share=0.05)["frequency"]
    assert found.deviation > 0
    assert found.standard_error >= found.deviation / math.sqrt(2 * found.certified) * (1 - 1e-9)


@pytest.mark.slow
def test_draws_and_first_order_agree_where_the_problem_is_smooth(pigeon):
    for one in wb.uncertainty_by_samples(pigeon[1], samples=120, share=0.1).values():
        assert one.certified == one.drawn == 120
        assert one.explained > 0.99
        assert abs(one.deviation - one.first_order.deviation) < 3 * one.standard_error
        shifted = one.first_order.value + one.first_order.shift
        assert abs(one.mean - shifted) < 3 * one.deviation / math.sqrt(120) + 0.2 * one.deviation


def test_a_fit_brings_its_covariance_with_errors_that_go_together(pigeon):
    found, coefficients = pigeon[1], wb.aero.SuFan()
    covariance = np.array([[4e-4, -3e-4], [-3e-4, 9e-4]])
    drag = FittedCurve(coefficients.drag_terms, ("constant", "amplitude"), covariance)
    lift = FittedCurve(coefficients.lift_terms, (), np.zeros((0, 0)))
    fit = FittedModel("plate", "", (0.0, 90.0), None, lift, drag, None)
    slopes = {s.parameter.path: s.quantities["frequency"] for s in found.slopes}
    slope = np.array([slopes["aero.drag.constant"], slopes["aero.drag.amplitude"]])
    bar = found.error_bar("frequency", fit)
    assert bar.due_to["aero.drag"] == pytest.approx(math.sqrt(slope @ covariance @ slope))
    other = fit._replace(drag=drag._replace(terms=wb.aero.Dickinson().drag_terms))
    with pytest.raises(InvalidInputError, match="other drag terms"):
        found.error_bar("frequency", other)
    drawn = ParameterSpread("aero.drag", tuple(s.parameter for s in found.slopes[:2]), covariance).draw(
        np.random.default_rng(0), 20_000
    )
    assert np.cov(drawn.T) == pytest.approx(covariance, rel=0.05)


def test_a_fit_of_a_cambered_wing_brings_one_covariance_of_lift_and_drag():
    wing = wb.aero.Feathered()
    problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, aero=wing)
    parameters = parameters_of(problem)
    covariance = np.array([[4e-2, -3e-4], [-3e-4, 9e-6]])
    curve = FittedCurve(wing.terms, ("lift_slope", "drag_least"), covariance)
    joins = wing.low_join_deg, wing.high_join_deg
    fit = FittedWing("feathered", "", *joins, None, curve)
    (spread,) = _of_fit(problem, parameters, fit, 0.5)
    assert spread.name == "aero.wing"
    assert [member.path for member in spread.parameters] == ["aero.wing.lift_slope", "aero.wing.drag_least"]
    np.testing.assert_allclose(spread.covariance, 0.25 * covariance)
    with pytest.raises(InvalidInputError, match="other wing terms"):
        _of_fit(problem, parameters, fit._replace(wing=curve._replace(terms=wb.aero.Membrane().terms)), 1.0)


def test_a_spread_that_no_slope_knows_cannot_pass(pigeon):
    found = pigeon[1]
    alone = first_order(found.slopes, [], "frequency", "Hz", 9.0)
    assert alone.deviation == 0.0
    assert alone.due_to == {}


def test_the_command_line_tells_what_an_orbit_hangs_on(capsys, tmp_path):
    figure = tmp_path / "tornado.png"
    assert (
        main(["orbit", "pigeon", "--speed", "10", "--starts", "1", "--sensitivities", "--tornado", str(figure)])
        == 0
    )
    told = capsys.readouterr().out
    assert "Hz; largest shares of the variance: wing.semi_span (" in told
    assert "+-" not in told.partition("change at the low")[0]
    assert "1 deg more of bounds.flap_amplitude.upper: -0.1" in told
    assert figure.read_bytes()[:4] == b"\x89PNG"
    assert main(["orbit", "pigeon", "--speed", "10", "--starts", "1", "--sensitivities", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["sensitivities"][0]["parameter"] == "wing.semi_span"
    assert "error_bars" not in record
    first = record["rankings"][0]
    assert (first["quantity"], next(iter(first["ranking"]))) == ("frequency", "wing.semi_span")
    assert sum(first["ranking"].values()) == pytest.approx(1.0)
    assert "deviation" not in first


@pytest.mark.slow
def test_the_command_uncertainty_prints_both_ways(capsys, monkeypatch):
    words = ["uncertainty", "pigeon", "--speed", "10", "--samples", "10", "--share", "0.1"]
    assert main([*words, "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["frequency"]["certified"] == 10
    assert told["frequency"]["unsolved"] == {"draws": 0, "drawn": 10, "short": {}, "differ": {}}
    assert told["frequency"]["guessed"] == []
    assert main([*words, "--quantities", "frequency"]) == 0
    shown = capsys.readouterr()
    assert "To first order, not yet checked by 10 draws:\n  frequency 9.4" in shown.err
    assert "10 of 10 certified" in shown.out
    assert main([*words, "--payload", "0.03", "--quantities", "frequency", "--json"]) == 0
    loaded = json.loads(capsys.readouterr().out)
    values = [one["frequency"]["first_order"]["value"] for one in (told, loaded)]
    assert values[1] > 1.02 * values[0]
    make_hasty(monkeypatch)
    assert main(["uncertainty", "pigeon", "--speed", "10", "--set", "body.mass=3"]) == 3
    assert "infeasible" in capsys.readouterr().err


def test_draws_without_an_orbit_are_told_with_their_reasons(capsys):
    """The mass sets them apart, the span does not; with no orbit at all there is nothing to compare."""
    certified = np.arange(20) < 8
    mass, span = np.where(certified, 0.03, 0.06), np.tile([0.4, 0.5], 10)
    short = [*([""] * 8), *(["thrust"] * 9), *(["lift"] * 3)]
    drawn = np.stack([mass + 1e-3 * np.sin(np.arange(20)), span], axis=1)
    found = unsolved(certified, short, drawn, ("wing.mass", "wing.semi_span"))
    assert (found.draws, found.drawn, found.short) == (12, 20, {"thrust": 9, "lift": 3})
    assert found.differ == {"wing.mass": pytest.approx((0.03, 0.06), abs=1e-3)}
    bar = ErrorBar("frequency", "Hz", 6.8, 0.1, 0.0, {"wing.mass": 0.1})
    _tell_unsolved(Comparison(bar, 6.8, 0.1, 0.0, 1.0, 8, 20, unsolved=found))
    told = "12 of 20 draws have no orbit: the balance that fails most is thrust in 9, lift in 3; mean of wing.mass"
    assert capsys.readouterr().out.startswith(told)
    assert unsolved(np.zeros(20, bool), short, drawn, ("wing.mass", "wing.semi_span")).differ == {}


def test_a_quantity_that_a_limit_holds_has_no_deviation(capsys):
    """Within plausible ranges each draw may have the largest frequency that is plausible."""
    bar = ErrorBar("frequency", "Hz", 6.8, 3e-13, 0.0, {"body.mass": 3e-13}, set_by_limit=True)
    drawn = wb.Samples(
        ("body.mass",),
        np.array([[-0.02], [0.0], [0.02]]),
        6.8 * (1 + np.array([[0.0], [5e-7], [-4e-7]])),
        np.ones(3, dtype=bool),
        np.ones((3, 1), dtype=bool),
    )
    mass = types.SimpleNamespace(path="body.mass", value=0.3, guessed=False)
    slope = types.SimpleNamespace(quantities={"frequency": 0.0}, parameter=mass)
    found = _compared(bar, drawn, 0, {"body.mass": slope})
    assert (found.mean, found.deviation, found.standard_error, found.explained) == (
        pytest.approx(6.8),
        0.0,
        0.0,
        1.0,
    )
    _print(found, Console())
    printed = capsys.readouterr().out
    first, second = (" ".join(line.split()) for line in printed.splitlines())
    assert first == "frequency, of the orbit 6.8 Hz; set by the limit, so it is no prediction and has no error bar"
    assert second == "frequency, 3 of 3 certified set by the limit 6.8 Hz in 100 % of the samples"
    assert bar.ranking == bar.ranked()["ranking"] == {}
    varied = drawn._replace(quantities=np.array([[6.8], [6.8], [7.3]]))
    for at, told in (
        ([1, 1, 0], " set by the limit 6.8 Hz in 67 % of the samples, 7.3 Hz in the others\n"),
        ([1, 0, 0], " 6.97 +- 0.29 Hz, set by the limit 6.8 Hz in 33 % of the samples\n"),
    ):
        some = varied._replace(at_limit=np.array(at, dtype=bool)[:, None])
        _print(_compared(bar, some, 0, {"body.mass": slope}), Console())
        assert told in capsys.readouterr().out


def test_a_first_order_that_draws_do_not_bear_out_is_shown_as_a_ranking(capsys):
    """6.99 +- 17 Hz is no error bar: over whole ranges the bat's straight line misses nearly all variance."""
    bar = ErrorBar("frequency", "Hz", 6.99, 17.0, 0.3, {"wing.shoulder.x": 16.0, "wing.mass": math.sqrt(33.0)})
    wrong = Comparison(bar, 7.4, 2.3, 0.1, 0.06, 148, 200)
    _print(wrong, Console())
    told = capsys.readouterr().out
    assert "first order (ranking only)" in told
    assert "largest shares of the variance: wing.shoulder.x (89%), wing.mass (11%)" in told
    assert "17" not in told
    assert "7.4 +- 2.3 Hz" in told
    plain = _plain(wrong)
    assert plain["first_order_holds"] is False
    assert "deviation" not in plain["first_order"]
    right = wrong._replace(explained=0.97)
    _print(right, Console())
    assert "7 +- 17 Hz" in capsys.readouterr().out
    assert _plain(right)["first_order"]["deviation"] == 17.0
