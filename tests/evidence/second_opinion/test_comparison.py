"""What a comparison reports, with a stand-in for the lattice, and what it refuses."""

import json

import numpy as np
import pytest

import wingbeat as wb
from tests.evidence.second_opinion.test_geometry import BEAT
from tests.helpers.given_motion import PIGEON, given_motion
from wingbeat_evidence.second_opinion import LatticeOptions, comparison
from wingbeat_evidence.second_opinion.comparison import compare_with_lattice, differences, lag, lattice_loads
from wingbeat_evidence.second_opinion.own_loads import WingLoads
from wingbeat_evidence.second_opinion.vortex_lattice import PanelLoads

SMALL = LatticeOptions(chordwise=2, spanwise=2, steps=16, beats=2)
PHASE = np.arange(32) / 32


@pytest.fixture
def standin(monkeypatch):
    """Replace the lattice: each wing has a force up of 0.2 N, plus what errs in proportion to the step."""

    def fly(corners, step, velocity, density, last, progress=None):
        force = np.zeros((last, corners.shape[1] - 1, corners.shape[2] - 1, 3))
        force[..., 2] = (0.2 + 10.0 * step) / (corners.shape[1] - 1) / (corners.shape[2] // 2 - 1)
        if progress is not None:
            progress(len(corners), len(corners))
        return PanelLoads(force, np.zeros_like(force))

    monkeypatch.setattr(comparison, "fly_lattice", fly)
    monkeypatch.setattr(comparison, "code_version", lambda: "PteraSoftware 0")


def test_loads_are_extrapolated_to_steps_of_no_length(standin):
    told = []
    motion = given_motion(BEAT)
    found = lattice_loads(motion, SMALL, lambda *done: told.append(done))
    np.testing.assert_allclose(found.lift, np.full(8, 2 * 0.2), rtol=1e-12)
    assert told == [(32, 48), (48, 48)]


def test_lag_is_positive_where_the_second_comes_later():
    first = np.cos(2 * np.pi * PHASE) + 0.3 * np.sin(4 * np.pi * PHASE)
    for shift in (-8, -3, 0, 5, 15):
        assert lag(first, np.roll(first, shift) + 2.0) == pytest.approx(shift / 32, abs=3e-4)


def test_differences_by_hand():
    still, wave = np.zeros(32), np.cos(2 * np.pi * PHASE)
    ours, theirs = WingLoads(still, 3 + wave, still + 2), WingLoads(still + 1, 6 + wave, still + 3)
    found = differences(ours, theirs, weight=3.0)
    assert found["mean_lift"] == pytest.approx({"ours": 3.0, "theirs": 6.0, "ratio": 2.0})
    assert found["mean_thrust"] == {"ours": 0.0, "theirs": 1.0, "ratio": None}
    assert found["aerodynamic_power"]["ratio"] == pytest.approx(1.5)
    assert found["lift_rms_difference"] == pytest.approx(1.0)
    assert found["lift_lag"] == 0.0


def test_record_of_an_orbit(standin, pigeon_orbit):
    record = compare_with_lattice(pigeon_orbit.orbit, SMALL).record()
    json.dumps(record, allow_nan=False)
    assert (record["with"], record["code"], record["species"]) == ("uvlm", "PteraSoftware 0", "pigeon")
    weight = record["weight"]
    assert record["wake"] == record["terms"][0]["wake"] == "none"
    assert record["mean_lift"]["ours"] == pytest.approx(weight, rel=2e-2)  # 8 samples of a beat
    rows = {(row["unsteady"], row["inflow"]): row for row in record["terms"]}
    assert list(rows) == list(comparison.TERMS)
    assert rows["none", "none"]["lift_rms_difference"] == record["lift_rms_difference"]
    assert rows["thin-aerofoil", "none"]["mean_lift"]["ours"] != record["mean_lift"]["ours"]
    assert 0.0 < record["beyond_15_deg"] < 1.0
    assert set(record["left_out"]) == {"ours", "theirs"}


def test_terms_that_the_coefficients_cannot_have_are_refused_in_their_row(standin, bat_orbit):
    opinion = compare_with_lattice(bat_orbit.orbit, SMALL)  # Dickinson's: a revolving wing holds its own inflow
    rows = [row for row in opinion.record()["terms"] if "refused" in row]
    assert [row["inflow"] for row in rows] == ["momentum", "momentum"]
    assert "aspect ratio" in rows[0]["refused"]


def test_a_flight_slower_than_its_wake_sinks_is_refused():
    with pytest.raises(wb.InvalidInputError, match=r"speed = 2.0: is slower than 2.3 m/s, the speed at which"):
        comparison._check("converged", PIGEON, wb.Air(), 2.0, 0.0)


def test_a_motion_that_does_not_repeat_is_refused():
    with pytest.raises(wb.InvalidInputError, match="is not a certified orbit"):
        comparison._check("infeasible", PIGEON, wb.Air(), 10.0, 0.0)
