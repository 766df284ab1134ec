"""Polars on the page: they change the answer, and are refused in the words of the command line."""

import dataclasses
import json

import numpy as np
import pytest

import wingbeat as wb
from tests.explorer.app.page import asks_for, drawer, exact, solved
from tests.helpers.browsers import DROP
from tests.helpers.places import ROOT
from wingbeat._base import InvalidInputError
from wingbeat._workers.process import Context
from wingbeat.cli.app import main
from wingbeat_explorer.app.jobs import do
from wingbeat_explorer.app.links import from_json, from_plain, from_query, to_json, to_plain, to_query
from wingbeat_explorer.app.scenario import LARGEST_TABLE, Scenario, problem_of

POLARS = ROOT / "tests" / "aero" / "polars"
# A partial polar of XFOIL, a whole turn of AeroDyn with two Reynolds numbers, and two polars of XFOIL in one file.
XFOIL, AERODYN, FAMILY = "xfoil_naca0012_re50k.pol", "openfast_io_two_re.dat", "xfoil_naca4412_two_re.pol"


def work(what):
    return do(what, Context(lambda told: None, lambda: False))


def read(path, label=None):
    return work({"do": "read", "path": str(path), "label": label or path.name})


def whole_turn(path):
    """Write a CSV table of a whole turn."""
    degrees = np.arange(-180, 181, 5)
    turn = np.radians(degrees)
    rows = zip(degrees, np.sin(2 * turn), 0.05 + 1.9 * np.sin(turn) ** 2, strict=True)
    path.write_text("alpha,CL,CD\n" + "".join(f"{a},{lift:.6f},{drag:.6f}\n" for a, lift, drag in rows))
    return path


@pytest.mark.parametrize(
    ("name", "extension", "polars", "note"),
    [
        (XFOIL, "viterna", 1, "completed by Viterna's rule beyond the table, with C_D 2.01 at 90 degrees"),
        (AERODYN, "mirrored", 2, "2 polars make one model from Re 50000 to 200000"),
        (FAMILY, "viterna", 2, "2 polars make one model from Re 100000 to 200000"),
    ],
)
def test_a_polar_is_that_of_the_command_line(name, extension, polars, note):
    found = read(POLARS / name)
    assert (found["aero"], found["extension"]) == (name, extension)
    aero = problem_of(from_plain(to_plain(Scenario(**found)))).aero.coefficients
    assert aero == wb.aero.load_table(POLARS / name, extension)
    assert len(getattr(aero, "members", [aero])) == polars
    assert any(one.startswith(note) for one in aero.notes)


@pytest.mark.slow
def test_polars_and_tables_change_the_answer(tmp_path):
    asked = [Scenario(starts=1)]
    asked += [Scenario(**read(path), starts=1) for path in (POLARS / AERODYN, whole_turn(tmp_path / "mine.csv"))]
    answers = [work({"do": "orbit", "scenario": to_plain(one)}) for one in asked]
    frequencies = [one["record"]["wingbeat"]["frequency"] for one in answers]
    assert [one["record"]["status"] for one in answers] == ["converged"] * 3
    assert len({round(one, 3) for one in frequencies}) == 3
    assert [one["record"]["aero"]["coefficients"] for one in answers] == ["su-fan", "openfast_io_two_re", "mine"]
    assert answers[0]["notes"] == []
    assert answers[1]["notes"][0] == "2 polars make one model from Re 50000 to 200000; beyond, the nearest holds"


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("none.dat", "hello world\nthis is no polar\n"),
        ("none.csv", "name,mass\nx,1\n"),
        ("none.pol", ""),
        ("short.csv", "alpha,CL,CD\n0,0,0.05\n2,0.1,0.05\n"),
        ("bad.csv", "alpha,CL,CD\n0,0,0.05\n10,x,0.05\n"),
    ],
)
def test_what_is_no_polar_is_refused_as_by_the_command_line(name, text, tmp_path, monkeypatch, capsys):
    (tmp_path / name).write_text(text)
    sent = tmp_path / "a1b2"  # the server's own name
    sent.write_text(text)
    monkeypatch.chdir(tmp_path)
    assert main(["orbit", "pigeon", "--speed", "10", "--aero", name]) == 2
    told = [line.removeprefix("error: ") for line in capsys.readouterr().err.splitlines()]
    refused = [message for _, message in read(sent, name)["refused"]]
    assert [" ".join(one.split()) for one in refused] == told
    assert not [one for one in refused if str(tmp_path) in one or "/tmp" in one]


def test_a_link_names_the_file_and_a_state_holds_it():
    scenario = Scenario(speed=9.0, **read(POLARS / AERODYN))
    assert from_json(to_json(scenario), "state.json") == scenario
    assert "aero=openfast_io_two_re.dat" in to_query(scenario)
    assert len(to_query(scenario)) < 100
    again = from_query(to_query(scenario))
    assert dataclasses.replace(again, aero_file=scenario.aero_file) == scenario
    (fault,) = again.faults().faults
    assert str(fault).startswith(
        "aero = 'openfast_io_two_re.dat': needs the file openfast_io_two_re.dat, which no link"
    )


@pytest.mark.parametrize(
    ("choices", "words"),
    [
        ({"aero": "n.pol"}, "needs the file n.pol, which no link holds; drop it"),
        ({"aero": "../n.pol", "aero_file": "x"}, "is no name of a file"),
        ({"aero": "su-fan", "aero_file": "x"}, "is no name of a file"),
        ({"aero": "n.pol", "aero_file": "a" * (LARGEST_TABLE + 1)}, "1048577 characters"),
        ({"aero": "n.pol", "aero_file": "x"}, "n.pol"),
    ],
)
def test_a_state_with_an_odd_file_is_refused(choices, words):
    with pytest.raises(InvalidInputError, match=r".") as refused:
        problem_of(from_plain(json.loads(json.dumps(choices))))
    assert words in str(refused.value)


@pytest.mark.slow
def test_a_dropped_polar_is_flown_and_said(visit):
    page = visit()
    solved(page, "pigeon at 10 m/s, su-fan")
    first = exact(page)
    page.evaluate(DROP, ["turn.txt", (POLARS / AERODYN).read_text()])  # told from flights by its content
    solved(page, "pigeon at 10 m/s, turn")
    assert exact(page) != first
    asks_for(page, "aero=turn.txt")
    assert "2 polars make one model" in page.locator(".brief .note").inner_text()
    model = drawer(page).get_by_label("Model", exact=True)
    assert model.locator("option:checked").inner_text() == "turn.txt (loaded file)"
    model.select_option("su-fan")
    solved(page, "pigeon at 10 m/s, su-fan")
    assert page.locator(".brief .note").inner_text() == ""
    model = drawer(page).get_by_label("Model", exact=True)
    model.select_option("turn.txt")  # the page keeps it
    solved(page, "pigeon at 10 m/s, turn")
    page.evaluate(DROP, ["none.dat", "hello world\nthis is no polar\n"])
    page.wait_for_function("() => document.querySelector('.trouble').textContent.includes('names 2 columns')")
    asks_for(page, "aero=turn.txt")


@pytest.mark.slow
def test_a_part_polar_that_is_chosen_again_is_completed_again(visit):
    page = visit()
    solved(page, "pigeon at 10 m/s, su-fan")
    page.evaluate(DROP, ["part.pol", (POLARS / XFOIL).read_text()])
    solved(page, "pigeon at 10 m/s, part")
    first = exact(page)
    asks_for(page, "extension=viterna")
    drawer(page).get_by_label("Model", exact=True).select_option("su-fan")
    solved(page, "pigeon at 10 m/s, su-fan")
    drawer(page).get_by_label("Model", exact=True).select_option("part.pol")
    solved(page, "pigeon at 10 m/s, part")
    asks_for(page, "extension=viterna")
    assert float(exact(page)) == pytest.approx(float(first), rel=1e-6)


@pytest.mark.slow
def test_a_link_asks_for_its_file_and_takes_it(visit):
    page = visit("species=pigeon&speed=11&starts=1&aero=turn.dat")
    page.wait_for_function(
        "() => document.querySelector('.refusal').textContent.includes('the file turn.dat, which no link')"
    )
    page.evaluate(DROP, ["turn.dat", (POLARS / AERODYN).read_text()])
    solved(page, "pigeon at 11 m/s, turn")
