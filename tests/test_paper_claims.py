"""Claims of the paper: our numbers against independent ones, verdicts, records to recompute them from."""

import json
import math

import numpy as np
import pytest

from wingbeat.paper import claims as judging
from wingbeat.paper.claim import FAILS, HOLDS, HOLDS_UNDER, UNTESTABLE, Claim, Evidence, Finding, NotFlownError
from wingbeat.paper.coefficient_claims import coefficient_claims
from wingbeat.paper.experiment_claims import experiment_claims
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
