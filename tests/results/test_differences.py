"""Error bars of free parameters, and of the difference of two conditions, against each condition alone."""

import json
import math
import re

import numpy as np
import pytest
from rich.console import Console

import wingbeat as wb
from wingbeat._base import InvalidInputError
from wingbeat.cli import main
from wingbeat.cli.uncertainty import _print
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.orbits.problem.quantities import QUANTITIES
from wingbeat.orbits.uncertainty import ErrorBar, uniform_spread
from wingbeat.results.error_bars import Comparison, _is_set, _moved
from wingbeat.results.sensitivities import in_words, quantity_of


@pytest.fixture(scope="module")
def two():
    """The pigeon with and without a load."""
    pigeon = wb.load_species("pigeon")
    problems = [wb.OrbitProblem(one, speed=12.0) for one in (pigeon.with_payload(0.03), pigeon)]
    names = ["frequency", "mean_positive_power", "flap_amplitude", "pitch_mean"]
    return [wb.sensitivities(wb.solve_orbit(problem, starts=1), names) for problem in problems]


def test_free_parameters_have_error_bars_as_quantities_have(two):
    (slope,) = (one for one in two[1].slopes if one.parameter.path == "wing.mass")
    assert slope.quantities["pitch_mean"] == pytest.approx(slope.wingbeat["pitch_mean"], rel=1e-9)
    bar = two[1].error_bar("pitch_mean")
    optimum = two[1].unknowns[4 + two[1].problem.free.index("pitch_mean")]
    assert (bar.unit, bar.value) == ("rad", pytest.approx(optimum, abs=1e-4))
    assert f"pitch mean {math.degrees(bar.value):.0f}" in in_words(bar)
    assert " deg; largest contributions: " in in_words(bar)
    with pytest.raises(InvalidInputError, match="did you mean pitch_mean"):
        quantity_of("pitch-meen", two[1].problem.free)
    with pytest.raises(InvalidInputError, match=r"known quantities are frequency.*parameters here are flap_mean"):
        quantity_of("xyz", two[1].problem.free)


def test_an_unknown_quantity_is_told_all_known_ones(capsys):
    """The middle of this list was once cut out."""
    assert main(["uncertainty", "pigeon", "--speed", "10", "--quantities", "xyz"]) == 2
    told = capsys.readouterr().err
    known = [*QUANTITIES, "spectral_radius", "flap_mean", "pitch_amplitude"]
    assert [name for name in known if name not in told] == []


def test_a_difference_is_more_certain_than_both_its_terms(two):
    """Both terms are solved anew here, draw by draw, and their first order is differentiated by hand."""
    found = wb.difference_by_samples(*two, list(two[0].values), samples=10, share=0.05)
    for name, one in found.items():
        least = one.difference.first_order
        slopes = [{s.parameter.path: s.quantities[name] for s in each.slopes} for each in two]
        by_hand = 0.0
        for parameter in parameters_of(two[1].problem):
            if parameter.plausible is not None:
                apart = slopes[0][parameter.path] - slopes[1][parameter.path]
                width = 0.05 * (parameter.plausible[1] - parameter.plausible[0])
                by_hand += (apart * width) ** 2 / 12
        if name != "flap_amplitude":  # at its bound in both
            assert least.deviation == pytest.approx(math.sqrt(by_hand), rel=1e-9)
            assert one.difference.explained > 0.9
            assert one.difference.deviation < 0.35 * one.here.deviation
        assert least.value == two[0].values[name] - two[1].values[name]
        alone = wb.uncertainty_by_samples(two[1], [name], samples=10, share=0.05)[name]
        assert one.there.mean == pytest.approx(alone.mean, rel=1e-3)
        assert one.difference.certified == 10
    assert found["flap_amplitude"].difference.limited.most


def test_what_a_condition_sets_is_not_drawn_and_each_share_is_drawn_once():
    pigeon = wb.load_species("pigeon")
    heavy = pigeon.with_values({"wing.mass": 0.022})
    spreads = [{s.name: s for s in map(uniform_spread, ranged(one))} for one in (pigeon, heavy)]
    exact = [name for name in spreads[0] if _is_set(spreads[0][name], spreads[1][name])]
    assert exact == ["wing.mass"]
    loaded = {s.name: s for s in map(uniform_spread, ranged(pigeon.with_payload(0.03)))}
    assert not any(_is_set(spreads[0][name], loaded[name]) for name in loaded)
    drawn = np.array([[-0.01], [0.002], [0.03]])
    assert _moved(drawn, spreads[0]["body.mass"], loaded["body.mass"]) == pytest.approx(drawn)


def ranged(species):
    return [one for one in parameters_of(wb.OrbitProblem(species, speed=12.0)) if one.plausible is not None]


@pytest.mark.slow
def test_the_command_prints_the_difference_of_two_conditions(capsys):
    words = ["uncertainty", "pigeon", "--speed", "12", "--samples", "10", "--share", "0.05", "--payload", "0.03"]
    words += ["--quantities", "frequency", "pitch-mean", "--against", "payload=0", "wing.mass=0.021"]
    assert main(words) == 0
    told = capsys.readouterr().out
    assert "frequency with payload=0 wing.mass=0.021, 10 of 10 certified" in told
    assert re.search(r"difference, of 10 pairs of draws +0\.\d+ \+- 0\.0\d+ Hz, \d+\.\d deviations from 0", told)
    assert "wing.mass differs as asked, so it counts as exact" in told
    assert main([*words, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["frequency"]
    assert found["exact"] == ["wing.mass"]
    apart = found["difference"]
    assert apart["mean"] == pytest.approx(found["here"]["mean"] - found["there"]["mean"])
    assert apart["first_order"]["unit"] == "Hz"


def test_a_condition_that_is_none_is_refused(capsys):
    conditions = ["altitud=0", "payload", "speed=x", "climb=1", "climb=2"]
    assert main(["uncertainty", "pigeon", "--speed", "12", "--against", *conditions]) == 2
    errors = capsys.readouterr().err.splitlines()
    known = "speed, climb, payload, altitude, temperature, frequency"
    example = "for example altitude=0, or wing.mass=0.02"
    assert [line.partition(": ")[2] for line in errors] == [
        f"--against = 'altitud': is not a known choice; use one of {known}",
        f"--against = 'payload': must be NAME=VALUE; {example}",
        f"--against = 'speed=x': must be NAME=VALUE with a number; {example}",
        "--against = 'climb=2': is given twice; keep one of them",
    ]


def test_the_draws_are_to_quote_and_say_where_their_mean_lies(capsys):
    bar = ErrorBar("frequency", "Hz", 6.8, 0.3, 0.5, {"body.mass": 0.3})
    _print(Comparison(bar, 7.6, 0.4, 0.05, 0.95, 20, 20), Console())
    told = capsys.readouterr().out
    assert re.search(r"mean of the draws less the orbit's own +0.8 Hz, 2.0 deviations", told)
    _print(Comparison(bar, 7.1, 0.4, 0.05, 0.95, 20, 20), Console())
    assert "less the orbit's own" not in capsys.readouterr().out
