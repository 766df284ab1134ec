"""Sets of assumptions: what is sampled, the problems that follow, what claims hang on, and the page."""

import csv
import io
import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.paper import assumption_page as pages
from wingbeat.paper.assumptions import ASSUMPTIONS, problem_under, sample_sets
from wingbeat.paper.importance import importance
from wingbeat.paper.study import SPEEDS, Study, judge_set, study_claims

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


@pytest.mark.parametrize("animal", ["pigeon", "bat"])
def test_a_problem_keeps_the_whole_mass_and_takes_what_it_is_told(animal):
    species = wb.load_species(animal)
    values = sample_sets(1)[0] | {
        "wing_mass_share": 0.08,
        "taper": 0.5,
        "shoulder_ahead": 0.1,
        "trims": "pitch-mean",
        "extension": "signed-drag",
        "force_point": "centre-of-pressure",
        "flap_amplitude_deg": 50.0,
        "body_drag_factor": 1.0,
        "twist_ratio": 1.4,
        "span_retraction": 0.2,
    }
    problem = problem_under(values, animal, "su-fan", 9.0)
    vehicle = problem.vehicle
    assert vehicle.mass == pytest.approx(species.vehicle.mass, rel=1e-12)
    assert vehicle.wing.mass == pytest.approx(0.08 * species.vehicle.mass)
    assert vehicle.wing.mean_chord == pytest.approx(species.vehicle.wing.mean_chord)
    assert vehicle.wing.chord[1] == pytest.approx(0.5 * vehicle.wing.chord[0])
    assert vehicle.wing.shoulder[0] == pytest.approx(0.1 * vehicle.wing.semi_span)
    assert vehicle.body.drag_area == pytest.approx(0.2 * 0.00813 * species.vehicle.mass**0.666)
    assert problem.free == ("frequency", "flap_amplitude", "pitch_amplitude", "pitch_mean")
    assert problem.species.wingbeat.flap_mean == 0.0
    assert problem.bounds["flap_amplitude"][1] == pytest.approx(math.radians(50))
    assert problem.aero.coefficients.extension == "signed-drag"
    assert problem.aero.force_point == "centre-of-pressure"
    assert problem_under(values, animal, "dickinson", 9.0).aero.force_point == "quarter-chord"
    beat = problem.species.wingbeat
    assert (beat.span_retraction == 0.2) == (animal == "pigeon")
    assert (beat.twist_ratio == 1.4) == (animal == "bat")


def test_importance_finds_what_a_number_was_made_of():
    sets = sample_sets(600, seed=1)
    taper = np.array([s["taper"] for s in sets])
    signed = np.array([s["extension"] == "signed" for s in sets])
    number = 2.0 * taper + 0.5 * signed + 0.01 * np.random.default_rng(0).normal(size=600)
    number[:50] = np.nan
    found = importance(sets, number)
    order = [NAMES[i] for i in np.argsort(-found.shares)]
    assert set(order[:2]) == {"taper", "extension"}
    assert found.shares[NAMES.index("wing_mass_share")] < 0.01
    assert found.quality > 0.9
    noise = importance(sets, np.random.default_rng(2).normal(size=600))
    assert noise.quality < 0.1


def test_importance_says_nothing_of_too_few_numbers_or_of_one_number():
    sets = sample_sets(400)
    assert importance(sets, np.full(400, 1.0)) is None
    assert importance(sets, np.where(np.arange(400) < 50, 1.0 * np.arange(400), np.nan)) is None


def made_up_study(count=400):
    """Verdicts by coin and by taper, so that two claims never hold together and one never holds."""
    random = np.random.default_rng(5)
    sets, claims = sample_sets(count, seed=2), study_claims()
    numbers = random.normal(size=(count, len(claims)))
    taper = np.array([s["taper"] for s in sets])
    numbers[:, 0] = taper
    holds = (numbers > 0).astype(float)
    holds[:, 0], holds[:, 1], holds[:, 2] = taper > 0.65, taper <= 0.65, 0.0
    holds[:5] = numbers[:5] = np.nan
    return Study(tuple(sets), claims, numbers, holds, np.full(count, 9))


def test_the_page_says_what_holds_what_it_hangs_on_and_what_cannot_be_had_together(tmp_path):
    study = made_up_study()
    paths = pages.write_study(study, tmp_path, "`as run`")
    assert [path.name for path in paths] == [f"assumptions.{e}" for e in ("md", "csv", "png", "pdf")]
    text = paths[0].read_text()
    first, second, third = (claim.id for claim in study.claims[:3])
    assert "`as run`" in text
    assert f"{100 * 9 / study.asked:.0f} % of them were found and certified" in text
    assert f"never together: `{first}` and `{second}`" in text
    assert f"under no set: `{third}`" in text
    row = next(line for line in text.splitlines() if line.startswith(f"| {study.claims[0].claim}"))
    share = 100 * np.nanmean(study.holds[:, 0])
    assert f"| {share:.0f} | 99 | taper 0.9" in row or f"| {share:.0f} | 99 | taper 1.0" in row
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


def test_one_set_is_flown_and_judged():
    values = sample_sets(1)[0] | {"trims": "both", "extension": "mirrored", "force_point": "quarter-chord"}
    outcome = judge_set(values, starts=1)
    asked = 2 * sum(len(speeds) for speeds in SPEEDS.values())
    assert asked - 2 <= outcome.flown <= asked
    assert len(outcome.numbers) == len(outcome.holds) == len(study_claims())
    told = np.isfinite(outcome.holds)
    assert told.sum() >= 20
    assert np.isfinite(np.array(outcome.numbers)[told]).all()
    assert set(np.array(outcome.holds)[told]) <= {0.0, 1.0}
