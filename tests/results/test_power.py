"""The power account: braking, shares and springs of an orbit, in the API, in files, on the terminal and drawn."""

import json

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from tests.helpers.spent_power import spends_what_it_says
from wingbeat.cli import main
from wingbeat.plots import power_page


@pytest.fixture(scope="module")
def orbit():
    return wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)


def test_the_account_adds_up(orbit):
    account, record = wb.power_account(orbit.dataset), orbit.record()
    assert account["mean_power"] == pytest.approx(record["mean_power"], rel=1e-12)
    assert account["mean_positive_power"] == pytest.approx(record["mean_positive_power"], rel=1e-12)
    braking = np.minimum(orbit.dataset["hinge_power"].values, 0.0)
    assert account["braking"] == pytest.approx(-np.trapezoid(braking, dx=1 / 256), rel=1e-2)
    costs = dict(map(tuple, account["cost_by_returned"]))
    assert costs[0.0] == account["mean_positive_power"]
    assert costs[1.0] == pytest.approx(account["mean_power"], rel=1e-12)
    assert costs[-1.0] == pytest.approx(costs[0.0] + account["braking"], rel=1e-12)
    shares = account["shares"].values()
    assert sum(share["mean"] for share in shares) == pytest.approx(account["mean_power"], rel=1e-12)
    series = sum(orbit.dataset[name] for name in ("aerodynamic_power", "inertial_power", "body_power"))
    np.testing.assert_allclose(series, orbit.dataset["hinge_power"], atol=1e-12 * record["peak_power"])
    spring = account["best_spring"]
    assert account["mean_power"] < spring["mean_positive_power"] < account["mean_positive_power"]
    assert spring["stiffness"] > 0


def test_what_the_actuators_spend_adds_up(orbit):
    spends_what_it_says(orbit)


def test_the_commands_tell_and_draw_it(orbit, tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    kept, figure = tmp_path / "orbit.nc", tmp_path / "power.png"
    orbit.save(kept)
    account = wb.power_account(orbit.dataset)
    assert main(["show", str(kept), "--power", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["power_account"] == account
    assert main(["show", str(kept), "--json"]) == 0
    assert "power_account" not in json.loads(capsys.readouterr().out)
    assert main(["show", str(kept), "--power"]) == 0
    printed = capsys.readouterr().out
    assert f"{account['best_spring']['stiffness']:.4g} N m/rad" in printed
    assert "if it costs as much as positive work" in printed
    assert main(["orbit", "--from", str(kept), "--power", "--json"]) == 0
    again = json.loads(capsys.readouterr().out)["power_account"]
    assert again["mean_power"] == pytest.approx(account["mean_power"], rel=1e-6)
    assert main(["plot", str(kept), "--power", "-o", str(figure)]) == 0
    assert figure.read_bytes().startswith(b"\x89PNG")


def test_the_figure_shows_the_account(orbit):
    page, account = power_page(orbit.dataset), wb.power_account(orbit.dataset)
    check_legends(page)
    shares, loop, costs = page.axes
    lines = {line.get_label(): line.get_ydata() for axes in (shares, loop) for line in axes.get_lines()}
    np.testing.assert_array_equal(lines["inertial share"], orbit.dataset["inertial_power"])
    np.testing.assert_allclose(
        lines["best spring"] + lines["remaining for actuators"], lines["flap torque"], rtol=1e-12
    )
    left = account["best_spring"]["mean_positive_power"]
    assert left in [pytest.approx(bar.get_width()) for bar in costs.patches]
    infeasible = orbit.dataset.assign_attrs(status="infeasible")
    assert power_page(infeasible).get_suptitle().endswith("NOT CERTIFIED")


def test_where_no_spring_helps_it_says_so(orbit, capsys):
    one_way = orbit.dataset.copy(deep=True)
    for name in ("hinge_power", "aerodynamic_power"):
        one_way[name].values[:] = 30.0
    for name in ("inertial_power", "body_power"):
        one_way[name].values[:] = 0.0
    account = wb.power_account(one_way)
    assert account["best_spring"] == {"stiffness": 0.0, "rest_angle": None, "mean_positive_power": 30.0}
    assert [line.get_label() for line in power_page(one_way).axes[1].get_lines()].count("best spring") == 0


def test_a_flight_that_ran_off_has_no_numbers(orbit):
    lost = orbit.dataset.copy(deep=True)
    for name in ("hinge_power", "aerodynamic_power", "inertial_power", "body_power"):
        lost[name].values[100:] = np.nan
    account = wb.power_account(lost)
    assert account["mean_power"] is None
    assert set(account["best_spring"].values()) == {None}
    assert power_page(lost).axes


def test_what_has_no_account_is_refused(orbit, tmp_path, capsys):
    model = orbit.problem.model
    flight = wb.simulate(model, orbit.wingbeat, orbit.initial_state)
    flight.save(tmp_path / "flight.nc")
    for words in ("show {} --power", "plot {} --power -o page.png"):
        assert main([word.format(tmp_path / "flight.nc") for word in words.split()]) == 2
        assert "is not an orbit: only a closed wingbeat has a power account" in capsys.readouterr().err
    with pytest.raises(wb.InvalidInputError, match="solve the orbit again"):
        wb.power_account(orbit.dataset.drop_vars("body_power"))
