"""Curves along speed: certified, continued, every jump marked; characteristic speeds; files that come back."""

import dataclasses
import itertools
import json
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from tests.helpers.hasty import make_hasty
from wingbeat._base import FileError, InvalidInputError, find, label_of, text_of
from wingbeat.cli import main
from wingbeat.orbits.branches import SPEED, Branches, BranchLink, carry, families, find_optima, marks_of, trace
from wingbeat.orbits.options import DEFAULTS, Status
from wingbeat.words.curve_words import curve_report
from wingbeat.words.orbit_words import DEFAULT_AIR

SPEEDS = [5.0, 6.0, 7.0]


def problem_at(name, **asked):
    return wb.OrbitProblem(wb.load_species(name), speed=6.0, **asked)


def unmarked_jumps(branches, marks):
    """Return the intervals without a mark over which unknowns change by more than a continuation can.

    A continuation in n steps changes no unknown by more than n times `max_step`, in the optimiser's scale.
    """
    marked = {(m.lower, m.upper) for m in marks if m.kind in ("gap", "branch")}
    steps = {link.interval: link.steps for link in branches.links if (link.lower, link.upper) == (0, 0)}
    jumps = []
    for interval, (below, above) in enumerate(itertools.pairwise(optima[0] for optima in branches.optima)):
        ends = below.problem.speed, above.problem.speed
        change = np.abs(above.place - below.place).max()
        most = steps.get(interval, 0) * below.options.continuation.max_step * (1.0 + 1e-6)
        if ends not in marked and not change <= most:
            jumps.append(ends)
    return jumps


@pytest.fixture(scope="module")
def traced():
    """A curve and the branches it is made of."""
    branches = []

    def kept(*args, **named):
        branches.append(trace(*args, **named))
        return branches[-1]

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("wingbeat.results.curve.trace", kept)
        curve = wb.solve_curve(problem_at("bat"), SPEEDS)
    return curve, *branches


@pytest.fixture(scope="module")
def bat(traced):
    """From 6 to 7 m/s the bat's least frequency passes from one family of orbits to another."""
    return traced[1]


@pytest.fixture(scope="module")
def curve(traced):
    return traced[0]


def test_every_optimum_of_a_curve_is_certified_and_none_beats_the_first(bat):
    for optima in bat.optima:
        assert [o.status for o in optima] == [Status.CONVERGED] * len(optima)
        assert all(max(map(abs, o.closure.values())) <= 1e-6 for o in optima)
        assert [o.objective for o in optima] == sorted(o.objective for o in optima)
        assert all(o.distinct_optima == len(optima) and o.starts >= 2 for o in optima)
        assert len(optima) > 1


def test_the_change_of_family_is_marked_and_nothing_jumps_beside_the_marks(bat):
    marks = marks_of(bat)
    assert [(m.lower, m.upper) for m in marks if m.kind == "branch"] == [(6.0, 7.0)]
    assert "another family becomes better near 6." in next(m.what for m in marks if m.kind == "branch")
    assert [m.what for m in marks if m.kind == "bounds"] == ["flap_mean reaches its bound"]
    assert unmarked_jumps(bat, marks) == []
    assert unmarked_jumps(bat, []) == [(6.0, 7.0)]
    label = families(bat)
    assert label[0][0] == label[1][0] != label[2][0]
    assert label[1][0] in label[2]


def test_a_jump_put_into_a_smooth_curve_is_found_or_marked(bat):
    # At 5 m/s another optimum poses as the best, with the links of the true one.
    worse = tuple(reversed(bat.optima[0]))
    planted = Branches((worse, *bat.optima[1:]), bat.links)
    assert (5.0, 6.0) in unmarked_jumps(planted, marks_of(planted))
    untold = [j for j in bat.links if (j.interval, j.lower, j.upper) != (0, 0, 0)]
    marks = marks_of(Branches(bat.optima, tuple(untold)))
    assert (5.0, 6.0) in [(m.lower, m.upper) for m in marks if m.kind == "branch"]


def test_a_gap_is_marked(bat):
    lost = dataclasses.replace(bat.optima[1][0], status=Status.INFEASIBLE)
    marks = marks_of(Branches((bat.optima[0], (lost,), bat.optima[2]), ()))
    assert [m.kind for m in marks] == ["gap", "gap"]


def test_a_family_has_one_optimum_at_a_speed_where_two_are_continued_into_one(bat):
    two = (bat.optima[0][0], bat.optima[0][1])
    links = (BranchLink(0, 0, 0, 5), BranchLink(0, 1, 0, 2))
    assert families(Branches((two, bat.optima[1][:1]), links)) == [[1, 0], [0]] or families(
        Branches((two, bat.optima[1][:1]), links)
    ) == [[0, 1], [1]]


def test_continuing_goes_in_steps_and_comes_back():
    there = find_optima(problem_at("pigeon"), 1)[0]
    up = carry(there, dataclasses.replace(there.problem, speed=9.0))
    assert up.optimum is not None
    assert up.steps >= np.abs(up.optimum.place - there.place).max() / DEFAULTS.continuation.max_step
    back = carry(up.optimum, there.problem)
    assert back.optimum is not None
    assert back.steps
    assert back.optimum.objective == pytest.approx(there.objective, rel=1e-6)


def test_the_answer_does_not_hang_on_the_threads():
    problems = [problem_at("pigeon").at_speed(speed) for speed in (8.0, 9.0)]
    one, two = (trace(SPEED, problems, 2, 0, threads=n) for n in (1, 2))
    assert one.links == two.links
    assert [[o.objective for o in row] for row in one.optima] == [[o.objective for o in row] for row in two.optima]


def test_a_saved_curve_comes_back(curve, tmp_path):
    curve.save(tmp_path / "curve.nc")
    again = wb.load_curve(tmp_path / "curve.nc")
    assert again.record() == curve.record()
    assert curve.gaps == []
    data = again.dataset
    assert all("units" in data[n].attrs for n in data.data_vars if data[n].dtype == float)
    best = curve.record()["points"][1]["optima"][0]
    orbit = wb.solve_orbit(problem_at("bat"), starts=6)
    assert best["frequency"] == pytest.approx(orbit.wingbeat.frequency, rel=1e-4)
    assert best["mean_positive_power"] == pytest.approx(orbit.record()["mean_positive_power"], rel=1e-2)
    json.dumps(curve.record(), allow_nan=False)


def test_files_that_are_no_curves_are_refused(curve, tmp_path):
    path = tmp_path / "other.nc"
    curve.dataset.assign_attrs(marks="{").to_netcdf(path, engine="h5netcdf")
    with pytest.raises(FileError, match="as a curve: it has no digest"):
        wb.load_curve(path)
    curve.dataset.assign_attrs(wingbeat_kind="orbit").to_netcdf(path, engine="h5netcdf")
    with pytest.raises(FileError, match="as a curve: it holds another kind of result, 'orbit'"):
        wb.load_curve(path)


@pytest.mark.parametrize("speeds", [[5.0], [5.0, 5.0], [6.0, 5.0], [-1.0, 5.0], [5.0, float("nan")], [5.0, "6"]])
def test_bad_speeds_are_refused(speeds):
    with pytest.raises(InvalidInputError, match="speeds"):
        wb.solve_curve(problem_at("pigeon"), speeds)


@pytest.mark.slow
def test_the_command_line_draws_saves_and_prints(tmp_path, capsys):
    saved, page = tmp_path / "pigeon.nc", tmp_path / "pigeon.svg"
    words = ["curve", "pigeon", "--speeds", "10:12:1", "--starts", "1", "--json"]
    assert main([*words, "-o", str(saved), "--plot", str(page)]) == 0
    record = json.loads(capsys.readouterr().out)
    speeds = [point["speed"] for point in record["points"]]
    assert [point["speed"] for point in record["points"] if not point["refined"]] == [10.0, 11.0, 12.0]
    # Three orbits more, certified as the others, enclose the speed of least frequency to 0.1 m/s.
    found = record["characteristic_speeds"]["minimum_frequency"]
    at = speeds.index(found["lowest"])
    best = [point["optima"][0] for point in record["points"]]
    assert len(speeds) == 6
    assert found["status"] == "found"
    assert best[at]["frequency"] == min(one["frequency"] for one in best) == found["value"]
    assert found["interval"][0] <= speeds[at - 1] < found["speed"] < speeds[at + 1] <= found["interval"][1]
    assert found["interval"][1] - found["interval"][0] < 0.3
    assert record["marks"] == []
    assert page.stat().st_size > 10_000
    assert main(["show", str(saved), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == record
    assert main(["show", str(saved)]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert "6 of 6 speeds certified" in printed
    assert f"{speeds[at]:g}* 9.469" in printed
    assert f"minimum frequency: {found['speed']:.2f} m/s (10.6" in printed
    assert "with flap amplitude at its limit" in printed
    assert "greatest range: not given, because frequency was minimised" in printed
    assert "flap amplitude set by the limit at 10 to 12 m/s" in printed
    assert main(["plot", str(saved), "-o", str(tmp_path / "again.svg")]) == 0
    assert (tmp_path / "again.svg").read_bytes() == page.read_bytes()


def test_the_command_line_tells_when_nothing_is_certified(capsys, monkeypatch):
    make_hasty(monkeypatch)
    words = ["curve", "bat", "--speeds", "8:9:1", "--starts", "1", "--subject-to", "flap_amplitude<=6 deg"]
    assert main(words) == 3
    assert "0 of 2 speeds certified" in capsys.readouterr().out


def test_a_power_limit_is_refused_where_no_power_is_minimised(capsys):
    assert main(["curve", "pigeon", "--speeds", "3:5:1", "--power-limit", "60"]) == 2
    told = capsys.readouterr().err
    assert "frequency is minimised" in told
    assert "--minimise positive-power" in told
    with pytest.raises(InvalidInputError, match="refinements"):
        wb.solve_curve(problem_at("pigeon"), SPEEDS, refinements=-1)


@pytest.mark.parametrize(
    "words", [["--speeds", "3:2:1"], ["--speeds", "5"], ["--speeds", "3:5:1", "--power-limit", "-1"], []]
)
def test_bad_words_exit_with_2(words, capsys):
    assert main(["curve", "pigeon", *words]) == 2
    assert "error: " in capsys.readouterr().err


def test_every_column_of_a_curve_is_said_by_the_table(curve):
    dataset = curve.dataset
    for name, variable in dataset.variables.items():
        name = str(name)
        if name.startswith("constraint_"):
            continue  # of a quantity, which may be the user's own
        path = name.replace("initial_", "initial_state.").replace("closure_", "closure.")
        term = find(path)
        assert term is not None, name
        assert variable.attrs["long_name"] == label_of(path), name
        if name != "objective_value":  # its unit is that of the objective
            assert variable.attrs.get("units", "") == term.unit, name


def test_a_minimised_quantity_other_than_power_and_frequency_has_a_column():
    """With the model `animal` the metabolic power is minimised, but the curve's power is that of the hinges."""
    best = {"frequency": 6.0, "mean_positive_power": 2.4, "objective_value": 4.84, "cost_of_transport": 0.1}
    best |= {"flap_amplitude": 0.5, "active_bounds": "", "outside_ranges": "strouhal"}
    point = {"speed": 9.0, "status": "converged", "message": "", "optima": [best], "distinct_optima": 1}
    point |= {"refined": False}
    record = {"species": "kestrel", "climb": 0.0, "objective": "metabolic_power", "points": [point], "gaps": []}
    record |= {"marks": [], "characteristic_speeds": {"minimum_power": None}, "warnings": [], "air": DEFAULT_AIR}
    lines = text_of(curve_report(record)).splitlines()
    assert lines[1].split()[:4] == ["U", "f", "P+", "minimised"]
    assert lines[3].split()[:4] == ["9", "6", "2.4", "4.84"]
    assert "  at 9 m/s: strouhal" in lines  # outside plausible ranges
    outside = best | {"outside_ranges": "strouhal, flap_amplitude"}
    points = [point | {"speed": speed, "optima": [outside]} for speed in (5.0, 7.0)]
    points.append(point | {"optima": [best | {"outside_ranges": ""}]})
    lines = text_of(curve_report(record | {"points": points})).splitlines()
    at = lines.index("outside plausible ranges")
    assert lines[at + 1 : at + 3] == ["  at 5 to 7 m/s: strouhal, flap amplitude", ""]
    lines = text_of(curve_report(record | {"points": points[2:]})).splitlines()
    assert lines[lines.index("outside plausible ranges") + 1] == "  at no speed"
    plain = text_of(curve_report(record | {"objective": "mean_positive_power"})).splitlines()
    assert plain[3].split()[:4] == ["9", "6", "2.4", "0.1"]


def test_such_a_quantity_has_a_panel_of_its_own(curve):
    page = wb.plots.curve_page(curve.dataset)
    assert len(page.axes) == 2
    entries = check_legends(page)
    assert entries[0] == "best wingbeat"
    assert "another kind of wingbeat takes over" in entries
    assert not any("bound" in entry for entry in entries)
    other = wb.plots.curve_page(curve.dataset.assign_attrs(objective="metabolic_power"))
    check_legends(other)
    labels = [axes.get_ylabel() for axes in other.axes]
    assert labels[1] == "metabolic power of the flight muscle [Hz]"
    best = next(line for line in other.axes[1].get_lines() if str(line.get_label()).startswith("best"))
    values = curve.dataset["objective_value"].sel(speed=best.get_xdata())
    assert np.allclose(best.get_ydata(), values[:, 0])


def test_each_optimum_says_which_plausible_ranges_it_leaves(curve):
    for point in curve.record()["points"]:
        known = wb.load_species("bat").plausible_range("strouhal", point["speed"])
        for best in point["optima"]:
            high = math.inf if known.high is None else known.high
            low = -math.inf if known.low is None else known.low
            assert ("strouhal" in best["outside_ranges"].split(", ")) is not (low <= best["strouhal"] <= high)
            assert best["outside_ranges"]  # the paper's bat is always outside one


@pytest.mark.slow
def test_a_curve_whose_frequency_changes_with_speed_is_loaded_again(tmp_path):
    """The pigeon's own frequency falls from 7.85 Hz at 4 m/s to 6.15 Hz at 12; a check took that for damage."""
    pigeon = wb.load_species("pigeon")
    problem = wb.models.animal(pigeon).problem(pigeon, speed=4.0)
    curve = wb.solve_curve(problem, [4.0, 12.0], starts=2)
    curve.save(tmp_path / "pigeon.nc")
    loaded = wb.load_curve(tmp_path / "pigeon.nc")
    assert loaded.dataset["frequency"].values[:, 0].tolist() == [7.85, 6.15]
