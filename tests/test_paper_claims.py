"""Claims of the paper: our numbers against independent ones, verdicts, records to recompute them from."""

import json
import math

import numpy as np
import pytest

from wingbeat.paper import claims as judging
from wingbeat.paper.claim import FAILS, HOLDS, HOLDS_UNDER, UNTESTABLE, Claim, Evidence, Finding, NotFlownError
from wingbeat.paper.coefficient_claims import coefficient_claims
from wingbeat.paper.experiment_claims import experiment_claims
from wingbeat.paper.premise_claims import premise_claims
from wingbeat.paper.treatments import TREATMENTS, Case, all_cases, problem_of, solve_cases

KEYS = {"id", "where", "claim", "paper", "ours", "unit", "verdict", "assumptions", "orbits"}
SPEEDS = (5.0, 10.0, 12.0)


@pytest.fixture(scope="module")
def orbits():
    both = [t for t in TREATMENTS if t.name in ("mirrored", "signed")]
    tapered = [t for t in TREATMENTS if t.name == "mirrored-tapered"]
    return solve_cases([*all_cases(SPEEDS, both), *all_cases((10.0,), tapered)], starts=1)


@pytest.fixture(scope="module")
def claims(orbits):
    return judging.judge_claims(orbits)


@pytest.mark.parametrize(
    ("name", "ours", "verdict"),
    [  # literature.md 6, worked out from the formulas without this code
        ("lift-peak-angle", 40.23, HOLDS),
        ("extra-lift", 13.95, HOLDS),
        ("drag-at-zero", 0.1003, HOLDS),
        ("drag-max", 2.04, HOLDS),
        ("smaller-lift", 100 * (1 - 1.190 / 1.805), FAILS),
        ("smaller-drag", 100 * (1 - 2.036 / 3.461), FAILS),
        ("lift-to-drag", 3.273, HOLDS),
        ("centre-limit", 0.247, HOLDS),
        ("moment-peak", 40.6, HOLDS),
        ("centre-monotonic", 0.4031 - 0.3988, FAILS),
    ],
)
def test_numbers_of_the_formulas_are_those_worked_out_by_hand(name, ours, verdict):
    claim = next(c for c in coefficient_claims() if c.id == name)
    assert claim.findings[0].number == pytest.approx(ours, rel=0.01, abs=3e-4)
    assert claim.verdict == verdict


def test_slopes_are_those_of_lines_through_the_formula():
    alpha = np.arange(0.0, 8.01, 2.0)
    lift = -0.44 * np.exp(-0.47 * alpha) + 1.19 * np.sin(np.radians(1.74 * alpha + 20))
    x = np.radians(alpha)
    slope = np.sum((x - x.mean()) * (lift - lift.mean())) / np.sum((x - x.mean()) ** 2)
    claim = next(c for c in coefficient_claims() if c.id == "lift-slope")
    assert claim.findings[0].number == pytest.approx(slope, rel=1e-12)
    assert claim.paper == pytest.approx(2 * math.pi)


def test_premises_are_tested_on_the_formulas_by_hand():
    found = {claim.id: claim for claim in premise_claims()}
    slope = found["two-dimensional"].findings[0].number
    assert abs(slope - 2 * math.pi * 6 / 8) < abs(slope - 2 * math.pi)
    assert found["two-dimensional"].verdict == FAILS
    # 1.92 - 1.55 cos(2.04 a - 9.82), .225 + 1.58 sin(2.13 a - 7.2): Dickinson et al. 1999, degrees.
    assert found["same-peak-as-insects"].findings[0].number == pytest.approx((90 + 7.2) / 2.13, abs=0.05)
    alpha = np.radians(np.arange(0.5, 90.01, 0.05))
    fly = 1.92 - 1.55 * np.cos(2.04 * alpha - math.radians(9.82))
    fit = 1.07 + 0.97 * np.sin(np.radians(2.04 * np.degrees(alpha) - 90))
    assert np.corrcoef(fly, fit)[0, 1] == pytest.approx(found["drag-alike-in-form"].findings[0].number, abs=0.01)
    assert found["formulas-differentiable"].verdict == FAILS
    assert found["transient-cut"].findings[0].number == pytest.approx(10 * (2e4 * 1e-6 / 0.076) / 0.076)


def test_experiment_claims_have_numbers_and_those_without_data_no_verdict():
    found = {claim.id: claim for claim in experiment_claims()}
    assert found["blockage"].findings[0].number == pytest.approx(0.076 / 0.8)
    assert found["r-squared"].verdict == UNTESTABLE
    assert 0.995 < found["r-squared"].findings[0].number < 1


def test_a_verdict_holds_under_all_some_or_none():
    def verdict(*holds):
        return Claim("a", "b", "c", 1.0, "1", tuple(Finding("x", 1.0, h) for h in holds)).verdict

    assert verdict(True, True, None) == HOLDS
    assert verdict(True, False) == HOLDS_UNDER
    assert verdict(False, None) == FAILS
    assert verdict(None) == UNTESTABLE


def test_every_claim_is_whole_and_flight_is_judged_under_both_treatments(claims):
    rows = [claim.row() for claim in claims]
    assert all(row.keys() == KEYS for row in rows)
    assert len({row["id"] for row in rows}) == len(rows) >= 60
    assert {row["verdict"] for row in rows} <= {HOLDS, HOLDS_UNDER, FAILS, UNTESTABLE}
    for row in rows:
        assert all(row[key] for key in ("where", "claim", "unit"))
        assert isinstance(row["ours"], float), row["id"]
        assert math.isfinite(row["ours"]), row["id"]
        if row["orbits"]:
            names = {assumed["name"] for assumed in row["assumptions"]}
            assert row["id"] == "wing-shape" or {"mirrored", "signed"} <= names


def test_identities_hold_under_every_treatment(claims):
    found = {claim.id: claim for claim in claims}
    for name in ("closed-loops", "open-loop", "force-balance", "differentiable"):
        assert found[name].verdict == HOLDS, name
    assert found["printed-sign"].findings[0].number == pytest.approx(-10.0, rel=1e-6)


def test_the_steps_of_the_argument_are_tested_on_the_flights_themselves(claims, orbits):
    found = {claim.id: claim.findings[0].number for claim in claims}
    fit, fly = (orbits[Case("mirrored", "bat", model, 10.0)] for model in ("su-fan", "dickinson"))
    assert found["over-prediction"] == fly.wingbeat.frequency
    assert found["closer-power"] == pytest.approx(
        (fit.record()["peak_power"] - 4) / (fly.record()["peak_power"] - 4), rel=1e-12
    )
    assert found["many-wingbeats"] == 4 + len(fit.problem.free) - 6
    alpha = fit.dataset["alpha"].values[:-1]
    assert found["arm-nose-up"] == pytest.approx((alpha[:, 2] > 0).mean(), abs=0.05)
    assert 0 <= found["small-angles-critical"] <= 1
    # Dickinson's drag in the same flight: the change of force from the strips, as if it were against all of their
    # velocity, spanwise part included.
    coefficients = [o.problem.model.kernel.lift_drag(fit.dataset["alpha"].values)[1] for o in (fit, fly)]
    velocity, speed = fit.dataset["strip_velocity"].values[..., 0], fit.dataset["strip_speed"].values
    more = fit.dataset["drag"].values * (np.asarray(coefficients[1]) / np.asarray(coefficients[0]) - 1)
    change = -2.0 * (more * velocity / speed).sum(axis=1)[:-1].mean()
    weight = fit.problem.vehicle.mass * fit.problem.air.gravity
    assert found["drag-costs-thrust"] == pytest.approx(change / weight, rel=0.1)


def test_a_claim_can_be_recomputed_from_the_records_it_names(claims, orbits, tmp_path):
    written = judging.write_claims(claims, orbits, tmp_path)
    assert all(path.is_file() for path in written)
    rows = {row["id"]: row for row in json.loads((tmp_path / "claims.json").read_text())}
    assert all((tmp_path / name).is_file() for row in rows.values() for name in row["orbits"])

    def record(name):
        return json.loads((tmp_path / "orbits" / f"{name}.json").read_text())

    twice = rows["twice-the-frequency"]
    assert "orbits/mirrored-bat-su-fan-10.json" in twice["orbits"]
    fly, fit = (record(f"mirrored-bat-{m}-10")["wingbeat"]["frequency"] for m in ("dickinson", "su-fan"))
    assert twice["ours"] == fly / fit
    assert rows["peak-power-su-fan"]["ours"] == record("mirrored-bat-su-fan-10")["peak_power"]
    sizes = [
        math.hypot(*pair)
        for animal in ("pigeon", "bat")
        for speed in SPEEDS
        for pair in record(f"mirrored-{animal}-su-fan-{speed:g}")["floquet_multipliers"]
    ]
    assert rows["stable"]["ours"] == pytest.approx(max(sizes))
    text = (tmp_path / "claims.md").read_text()
    assert "consistent with" in text
    assert "`signed`" in text
    assert text.count("\n| ") >= len(rows)


def test_an_orbit_that_was_not_flown_leaves_a_claim_untold(orbits):
    few = {case: orbit for case, orbit in orbits.items() if case.model == "su-fan"}
    found = {claim.id: claim for claim in judging.judge_claims(few)}
    assert found["twice-the-frequency"].verdict == UNTESTABLE
    assert found["twice-the-frequency"].findings[0].number is None
    with pytest.raises(NotFlownError):
        Evidence(few, "mirrored").speeds("bat", "dickinson")


def test_treatments_change_what_they_say():
    cases = {t.name: problem_of(Case(t.name, "bat", "su-fan", 8.0)) for t in TREATMENTS}
    assert cases["signed"].aero.coefficients.extension == "signed"
    assert cases["signed-heavy"].vehicle.wing.mass_exponent == 0.0
    assert cases["mirrored-heavy"].bounds["flap_amplitude"][1] == pytest.approx(math.radians(45))
    root, tip = cases["mirrored-tapered"].vehicle.wing.chord
    assert root == pytest.approx(3 * tip)
    assert cases["mirrored-tapered"].vehicle.wing.mean_chord == pytest.approx(
        cases["mirrored"].vehicle.wing.mean_chord
    )
