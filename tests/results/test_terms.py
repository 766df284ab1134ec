"""What terms of the air loads do: orbits along their share, the command and its figure."""

import json

import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat.cli import main
from wingbeat.orbits.branches import SHARE, carry
from wingbeat.plots import terms_page


def pigeon(**terms):
    return wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, aero=wb.aero.BladeElement("su-fan", **terms))


@pytest.fixture(scope="module")
def trace():
    return wb.trace_terms(pigeon(unsteady="thin-aerofoil"), shares=[0.0, 0.5, 1.0], starts=1)


@pytest.mark.slow
def test_the_ends_are_the_orbits_without_and_with_the_term(trace):
    record = trace.record()
    assert [point["status"] for point in record["points"]] == ["converged"] * 3
    for point, terms in ((record["points"][0], {}), (record["points"][-1], {"unsteady": "thin-aerofoil"})):
        alone = wb.solve_orbit(pigeon(**terms), starts=1)
        # The trace may only find better ones than a single start.
        assert point["objective_value"] <= alone.record()["objective_value"] * (1 + 1e-6)
    spent = [point["spent"]["unsteady"] for point in record["points"]]
    assert spent[0] == 0.0
    assert spent[1] != 0.0
    assert record["aero"]["unsteady"] == "thin-aerofoil"


@pytest.mark.slow
def test_continuation_along_the_share_leads_back(trace):
    first, last = trace.orbits[0], trace.orbits[-1]
    there = carry(trace.branches.optima[0][0], last.problem, SHARE)
    assert there.steps > 1
    back = carry(there.optimum, first.problem, SHARE)
    assert back.optimum.objective == pytest.approx(trace.branches.optima[0][0].objective, rel=1e-6)


@pytest.mark.slow
def test_same_family_is_said_only_where_no_branch_changes(trace):
    record = trace.record()
    changed = [mark for mark in record["marks"] if mark["kind"] != "bounds"]
    assert record["same_family"] == (not changed)
    planted = trace.branches._replace(links=())
    torn = wb.TermTrace(trace.problem, trace.orbits, planted, 0.0).record()
    assert not torn["same_family"]
    assert [(mark["lower"], mark["upper"]) for mark in torn["marks"] if mark["kind"] == "branch"] == [
        (0.0, 0.5),
        (0.5, 1.0),
    ]


@pytest.mark.slow
def test_the_figure_tears_lines_where_the_branch_changes(trace):
    record = trace.record()
    whole = terms_page({**record, "marks": []})
    assert len(whole.axes[0].get_lines()) == 1
    torn = terms_page({**record, "marks": [{"kind": "branch", "lower": 0.5, "upper": 1.0, "what": ""}]})
    assert len(torn.axes[0].get_lines()) == 2
    check_legends(torn)


def test_share_scales_both_terms():
    both = pigeon(unsteady="thin-aerofoil", inflow="momentum", induced_factor=1.4)
    half = SHARE.moved(both, 0.5).model
    assert half.unsteady == 0.5
    assert half.induced_factor == pytest.approx(0.7)
    assert abs(half.induced_flow[1]) < abs(both.model.induced_flow[1])


def test_the_command_prints_the_trace_and_draws_it(tmp_path, capsys):
    drawn = tmp_path / "terms.png"
    asked = [
        "terms",
        "pigeon",
        "--speed",
        "10",
        "--unsteady",
        "thin-aerofoil",
        "--shares",
        "0:1:1",
        "--starts",
        "1",
    ]
    assert main([*asked, "--json", "--plot", str(drawn)]) == 0
    record = json.loads(capsys.readouterr().out)
    assert [point["share"] for point in record["points"]] == [0.0, 1.0]
    assert drawn.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ([], "has no term to trace"),
        (["--unsteady", "thin-aerofoil", "--shares", "0:2:1"], "<= 1"),
        (["--inflow", "momentum", "--aero", "dickinson"], "aspect ratio"),
    ],
)
def test_what_cannot_be_traced_is_refused(asked, said, capsys):
    assert main(["terms", "pigeon", "--speed", "10", *asked]) == 2
    assert said in capsys.readouterr().err


def test_a_share_of_no_term_is_refused():
    with pytest.raises(wb.InvalidInputError, match="has no effect without unsteady terms, wake or inflow"):
        wb.aero.BladeElement("su-fan", share=0.5)
