"""Sets of assumptions: what is sampled, the problems that follow, what claims hang on, and the page."""

import csv
import io
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.engines import Here
from wingbeat.studies.stopping import Stop
from wingbeat_evidence.paper import assumption_page as pages
from wingbeat_evidence.paper.assumption_study import (
    ORBITS,
    SPEEDS,
    Judged,
    fly_piece,
    judge_piece,
    plan_piece,
    seconds_of,
    study_claims,
)
from wingbeat_evidence.paper.assumptions import ASSUMPTIONS, sample_sets
from wingbeat_evidence.paper.importance import fewest_outcomes, importance
from wingbeat_evidence.paper.treatments import Case

NAMES = [assumption.name for assumption in ASSUMPTIONS]


def test_a_sample_fills_every_range_evenly_and_depends_on_its_seed_alone():
    sets = sample_sets(40, seed=3)
    assert sets == sample_sets(40, seed=3) != sample_sets(40, seed=4)
    for assumption in ASSUMPTIONS:
        values = [s[assumption.name] for s in sets]
        if assumption.choices:
            counts = [values.count(choice) for choice in assumption.choices]
            assert max(counts) - min(counts) <= 1
        else:
            shares = (np.array(values) - assumption.low) / (assumption.high - assumption.low)
            assert sorted((shares * 40).astype(int)) == list(range(40))


VALUES = {
    "wing_mass_share": 0.08,
    "mass_exponent": 3.0,
    "taper": 0.5,
    "body_inertia_factor": 1.2,
    "shoulder_ahead": 0.1,
    "shoulder_above": 0.02,
    "span_retraction": 0.2,
    "twist_ratio": 1.4,
    "flap_amplitude_deg": 50.0,
    "trims": "pitch-mean",
    "shoulder_aside": 0.05,
    "flap_mean_deg": 12.0,
    "pitch_phase_deg": -20.0,
    "extension_su_fan": "signed-drag",
    "extension_dickinson": "clipped-drag",
    "airspeed": "full",
    "force_point": "centre-of-pressure",
    "body_drag_factor": 1.0,
}


@pytest.mark.parametrize("animal", ["pigeon", "bat"])
def test_the_points_of_a_piece_are_the_problems_that_its_sets_mean(animal, tmp_path):
    stock = wb.load_species(animal)
    other = VALUES | {"taper": 1.0, "force_point": "quarter-chord", "airspeed": "planar"}
    (group,) = plan_piece([VALUES, other], tmp_path)
    assert (group.places, len(group.studies)) == ([0, 1], 4)
    study = group.studies[animal, "su-fan"]
    points = list(study.plan.points())
    assert [point.changes["speed"] for point in points] == 2 * list(SPEEDS[animal])
    assert len({point.unit for point in points}) == 2
    recipe = study.plan.bases[0].recipe
    problem = recipe.problem(points[1].changes)
    vehicle, wing = problem.vehicle, problem.vehicle.wing
    assert (problem.species.name, problem.speed) == (animal, SPEEDS[animal][1])
    assert vehicle.mass == pytest.approx(stock.vehicle.mass, rel=1e-12)
    assert wing.mass == pytest.approx(0.08 * stock.vehicle.mass)
    assert (wing.mass_exponent, wing.chord[1]) == (3.0, pytest.approx(0.5 * wing.chord[0]))
    assert wing.mean_chord == pytest.approx(stock.vehicle.wing.mean_chord)
    assert wing.shoulder == pytest.approx((0.1 * wing.semi_span, 0.05 * wing.semi_span, 0.02 * wing.semi_span))
    assert vehicle.body.pitch_inertia == pytest.approx(1.2 * stock.vehicle.body.pitch_inertia)
    assert vehicle.body.drag_area == pytest.approx(0.2 * 0.00813 * stock.vehicle.mass**0.666)
    assert problem.free == ("frequency", "flap_amplitude", "pitch_amplitude", "pitch_mean")
    assert problem.species.wingbeat.flap_mean == 0.0
    assert problem.bounds["flap_amplitude"] == (stock.bounds["flap_amplitude"][0], pytest.approx(math.radians(50)))
    assert problem.bounds["frequency"] == stock.bounds["frequency"]
    assert problem.aero.coefficients.extension == "signed-drag"
    assert (problem.aero.force_point, problem.aero.airspeed) == ("centre-of-pressure", "full")
    assert problem.species.wingbeat.pitch_phase == pytest.approx(math.radians(-20))
    beat = problem.species.wingbeat
    assert (beat.span_retraction == 0.2) == (animal == "pigeon")
    assert (beat.twist_ratio == 1.4) == (animal == "bat")
    second = recipe.problem(points[-1].changes)
    assert second.vehicle.wing.chord[0] == pytest.approx(second.vehicle.wing.chord[1])
    assert (second.aero.force_point, second.aero.airspeed) == ("quarter-chord", "planar")
    dickinson = group.studies[animal, "dickinson"].plan
    theirs = dickinson.bases[0].recipe.problem(next(dickinson.points()).changes)
    assert (theirs.aero.coefficients.name, theirs.aero.force_point) == ("dickinson", "quarter-chord")
    assert (theirs.aero.coefficients.extension, theirs.aero.airspeed) == ("clipped-drag", "full")
    assert theirs.vehicle == vehicle


def test_sets_that_leave_different_angles_free_are_of_different_studies(tmp_path):
    sets = [VALUES | {"trims": trims} for trims in ("none", "both", "none")]
    groups = plan_piece(sets, tmp_path)
    assert [group.places for group in groups] == [[1], [0, 2]]
    free = [next(iter(group.studies.values())).plan.bases[0].recipe.free for group in groups]
    assert free == [
        ("frequency", "flap_amplitude", "pitch_amplitude", "flap_mean", "pitch_mean"),
        ("frequency", "flap_amplitude", "pitch_amplitude"),
    ]


@pytest.mark.parametrize("trims", ["flap-mean", "both"])
def test_a_free_flap_mean_is_bounded_as_the_set_says(trims, tmp_path):
    (group,) = plan_piece([VALUES | {"trims": trims}], tmp_path)
    plan = group.studies["bat", "su-fan"].plan
    problem = plan.bases[0].recipe.problem(next(plan.points()).changes)
    assert problem.bounds["flap_mean"] == (pytest.approx(math.radians(-12)), pytest.approx(math.radians(12)))


def test_the_two_models_extensions_are_drawn_independently():
    sets = sample_sets(400, seed=6)
    pairs = {(s["extension_su_fan"], s["extension_dickinson"]) for s in sets}
    assert len(pairs) == 16
    alike = sum(s["extension_su_fan"] == s["extension_dickinson"] for s in sets)
    assert 70 <= alike <= 130  # a quarter of them


def test_importance_finds_what_a_number_was_made_of():
    sets = sample_sets(1200, seed=1)
    taper = np.array([s["taper"] for s in sets])
    signed = np.array([s["extension_dickinson"] == "signed" for s in sets])
    number = 2.0 * taper + 0.5 * signed + 0.01 * np.random.default_rng(0).normal(size=1200)
    number[:50] = np.nan
    found = importance(sets, number)
    order = [NAMES[i] for i in np.argsort(-found.shares)]
    assert set(order[:2]) == {"taper", "extension_dickinson"}
    assert found.shares[NAMES.index("wing_mass_share")] < 0.01
    assert found.quality > 0.9
    noise = importance(sets, np.random.default_rng(2).normal(size=1200))
    assert noise.quality < 0.1


def test_importance_says_nothing_of_too_few_numbers_or_of_one_number():
    sets, number = sample_sets(1200), np.arange(1200.0)
    assert importance(sets, np.full(1200, 1.0)) is None
    assert importance(sets, np.where(number < fewest_outcomes() - 1, number, np.nan)) is None
    assert importance(sets, np.where(number < fewest_outcomes(), number, np.nan)) is not None


def made_up_study(count=800):
    """Four claims, judged by coin and by taper, so that two never hold together and one never holds."""
    random = np.random.default_rng(5)
    sets, claims = sample_sets(count, seed=2), study_claims()[:4]
    numbers = random.normal(size=(count, len(claims)))
    taper = np.array([s["taper"] for s in sets])
    numbers[:, 0] = taper
    holds = (numbers > 0).astype(float)
    holds[:, 0], holds[:, 1], holds[:, 2] = taper > 0.65, taper <= 0.65, 0.0
    holds[:5] = numbers[:5] = np.nan
    return Judged(tuple(sets), claims, numbers, holds, np.full(count, 9))


@pytest.mark.slow
def test_the_page_says_what_holds_what_it_hangs_on_and_what_cannot_be_had_together(tmp_path):
    study = made_up_study()
    paths = pages.write_study(study, tmp_path, "`as run`")
    assert [path.name for path in paths] == [f"assumptions.{e}" for e in ("md", "csv", "png", "pdf")]
    text = paths[0].read_text()
    first, second, third = (claim.id for claim in study.claims[:3])
    assert "`as run`" in text
    assert f"Of these orbits, {100 * 9 / ORBITS:.0f} % were found and certified" in " ".join(text.split())
    assert f"no set satisfies both `{first}` and `{second}`" in text
    assert f"no set satisfies any of these: `{third}`" in text
    row = next(line for line in text.splitlines() if line.startswith(f"| `{first}` |"))
    share, told = 100 * np.nanmean(study.holds[:, 0]), np.isfinite(study.holds[:, 0]).sum()
    shown = f"{share:.0f} ± {np.sqrt(share * (100 - share) / told):.0f}"
    assert f"| {shown} | 99 | taper 0.9" in row or f"| {shown} | 99 | taper 1.0" in row
    most = np.nansum(study.holds, axis=1).max()
    assert f"No set satisfies more than {most:.0f} of" in text
    rows = list(csv.DictReader(io.StringIO(paths[1].read_text())))
    assert len(rows) == len(study.sets)
    assert float(rows[7]["taper"]) == pytest.approx(study.sets[7]["taper"], rel=1e-3)
    assert rows[0][first] == ""
    assert rows[9][f"{first}:holds"] in ("0", "1")
    bars, heat, fits = pages.draw(study, [None] * len(study.claims)).axes[:3]
    assert bars.patches[0].get_width() == pytest.approx(share)
    assert "R²" in fits.get_xlabel()
    assert len(heat.get_xticks()) == len(ASSUMPTIONS)


OPEN = {
    "trims": "both",
    "flap_mean_deg": 30.0,
    "extension_su_fan": "mirrored",
    "extension_dickinson": "mirrored",
    "airspeed": "planar",
    "force_point": "quarter-chord",
}


@pytest.mark.slow
def test_one_set_is_flown_and_judged(tmp_path):
    mild = {"shoulder_ahead": 0.0, "shoulder_above": 0.0, "pitch_phase_deg": 0.0, "flap_amplitude_deg": 65.0}
    sets = [sample_sets(1)[0] | OPEN | mild]
    groups, seen = plan_piece(sets, tmp_path), []
    fly_piece(groups, Here, Stop(), seen.append)
    assert (seen[0], seen[-1], len(seen)) == (3, ORBITS, 4)
    assert seconds_of(groups) > 0
    judged = judge_piece(sets, groups)
    assert ORBITS // 2 <= judged.flown[0] <= ORBITS
    told = np.isfinite(judged.holds[0])
    assert told.sum() >= 20
    assert np.array_equal(np.isfinite(judged.numbers[0]), told)
    assert set(judged.holds[0][told]) <= {0.0, 1.0}
    # The same claims of the orbits that the studies keep, judged as `paper claims` does.
    orbits = {
        Case("set", animal, model, 10.0): orbit
        for (animal, model), one in groups[0].studies.items()
        for _, orbit in one.orbits()
        if orbit is not None and (animal, orbit.record()["speed"]) == ("bat", 10.0)
    }
    names = [claim.id for claim in judged.claims]
    for name in ("smaller-alpha-1-of-4", "smaller-vertical-force", "hand-thrusts", "peak-power-su-fan"):
        claim = judged.claims[names.index(name)]
        theirs = claim.judge(orbits, ["set"]).findings[0].number
        assert judged.numbers[0][names.index(name)] == pytest.approx(theirs, rel=0.05)
