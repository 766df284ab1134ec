"""Measured flights beside a curve: residuals where the curve has a number, each kind of power in its own panel."""

import json

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat.cli import main
from wingbeat.experiment import FlightPoints
from wingbeat.plots.draw_curve import curve_page
from wingbeat.records.measured import measured_beside
from wingbeat.words.curve_words import _measured

SPEEDS = np.array([4.0, 6.0, 8.0, 10.0, 12.0])


def curve_of(objective="mean_positive_power", **columns):
    """Return the data set of a curve with a gap at 10 m/s, and another kind of wingbeat from 6 to 8 m/s."""
    numbers = {"frequency": [8.0, 7.0, 6.0, np.nan, 6.5], "mean_positive_power": [20.0, 16.0, 14.0, np.nan, 22.0]}
    numbers |= {"objective_value": numbers["mean_positive_power"]} | columns
    data = {name: (("speed", "optimum"), np.array(values)[:, None]) for name, values in numbers.items()}
    data["objective_value"] = (*data["objective_value"], {"units": "W"})
    bounds = [["frequency>=8"], [""], [""], [""], [""]]
    data["active_bounds"] = (("speed", "optimum"), np.array(bounds, dtype=object))
    data["family"] = (("speed", "optimum"), np.array([0, 0, 1, -1, 1])[:, None])
    data["continued"] = (("interval", "optimum", "optimum_above"), np.zeros((4, 1, 1), dtype=int))
    status = ["converged", "converged", "converged", "infeasible", "converged"]
    data["status"] = ("speed", np.array(status, dtype=object))
    marks = [{"kind": "branch", "lower_speed": 6.0, "upper_speed": 8.0, "what": "another family"}]
    aero = {"coefficients": "su-fan", "extension": "mirrored"}
    about = {"marks": marks, "inputs": {"power_limit": None}, "aero": aero, "constraints": []}
    attributes = {name: json.dumps(value) for name, value in about.items()}
    attributes |= {"wingbeat_kind": "curve", "objective": objective, "species": "pigeon", "climb": 0.0}
    return xr.Dataset(data, {"speed": SPEEDS}, attributes)


def flights(speed, **values):
    found = {name: np.array(column, dtype=float) for name, column in values.items() if not name.endswith("_error")}
    nothing = [np.nan] * len(speed)
    errors = {name: np.array(values.get(f"{name}_error", nothing), dtype=float) for name in found}
    return FlightPoints("mine.csv", np.array(speed), found, errors, tuple("abcdefgh"[: len(speed)]), ())


def test_residuals_are_measured_less_interpolated_and_nothing_is_made_up_outside():
    given = flights([3.0, 4.0, 5.0, 6.0, 7.0, 9.0, 12.0, 20.0], frequency=[9.0, 9.0, 8.0, 7.5, 7.0, 6.5, 6.0, 6.0])
    points = measured_beside(curve_of(), given)["points"]
    assert [point["computed"] for point in points] == [None, 8.0, 7.5, 7.0, None, None, 6.5, None]
    assert [point["residual"] for point in points] == [None, 1.0, 0.5, 0.5, None, None, -0.5, None]
    assert [point["not_compared"] for point in points if point["computed"] is None] == [
        "outside the computed 4 to 12 m/s",
        "another kind of wingbeat takes over from 6 to 8 m/s",
        "beside a speed without a certified wingbeat",
        "outside the computed 4 to 12 m/s",
    ]
    assert [point["set_by_limit"] for point in points] == [False, True, True, *[False] * 5]
    sums = measured_beside(curve_of(), given)["residuals"]["frequency"]
    assert (sums["count"], sums["mean"], sums["rms"]) == (4, 0.375, pytest.approx(np.sqrt(1.75 / 4)))


def test_powers_are_compared_with_their_own_kind():
    given = flights([5.0], mechanical_power=[15.0], metabolic_rate=[60.0])
    without = measured_beside(curve_of(), given)
    assert [(p["quantity"], p["compared_with"], p["residual"]) for p in without["points"]] == [
        ("mechanical_power", "mean_positive_power", -3.0),
        ("metabolic_rate", "metabolic_rate", None),
    ]
    assert "the curve has no metabolic rate; --model animal gives one" in without["notes"][0]
    whole = curve_of(metabolic_rate=[50.0, 40.0, 40.0, np.nan, 60.0])
    assert [point["residual"] for point in measured_beside(whole, given)["points"]] == [-3.0, 15.0]
    older = curve_of("metabolic_rate", objective_value=[50.0, 40.0, 40.0, np.nan, 60.0])
    assert measured_beside(older, given)["points"][1]["residual"] == 15.0


def test_words_say_error_limit_and_why_nothing_is_compared():
    given = flights([4.0, 6.0, 15.0, 20.0], frequency=[8.3, 7.2, 6.0, 6.0], frequency_error=[0.5, 0.1, np.nan, 1.0])
    given.values["mechanical_power"] = np.array([21.0, np.nan, np.nan, np.nan])
    given.errors["mechanical_power"] = np.full(4, np.nan)
    beside = measured_beside(curve_of(), given)
    _, title, table, *lines = _measured(beside)
    assert title.text == "mine.csv: measured frequency [Hz]"
    assert [row.cells for row in table.rows] == [
        ("4", "8.3", "0.5", "8*", "+0.3", "+4", "yes", "a"),
        ("6", "7.2", "0.1", "7", "+0.2", "+3", "no", "b"),
    ]
    assert [line.text for line in lines[:5]] == [
        "  residual = measured - computed: mean +0.25 Hz (+3 %), rms 0.255 Hz, of 2",
        "  * set by a limit, so not predicted",
        "  not compared at 15, 20 m/s: outside the computed 4 to 12 m/s",
        "",
        "mine.csv: measured mechanical power [W], beside the mean positive hinge power",
    ]


def test_a_frequency_that_follows_from_the_limit_of_the_amplitude_is_marked():
    """It was minimised: frequency times amplitude hardly changes, so the bound of the amplitude sets it."""
    curve = curve_of("frequency", objective_value=[8.0, 7.0, 6.0, np.nan, 6.5])
    curve["active_bounds"][1, 0] = "flap_amplitude"
    (point,) = measured_beside(curve, flights([6.0], frequency=[8.0]))["points"]
    assert point["set_by_limit"]


def test_the_figure_and_the_table_agree_on_what_a_limit_has_set():
    """The figure looked at the number's own limit only, and drew a point as predicted that the table starred."""
    curve = curve_of("frequency", objective_value=[8.0, 7.0, 6.0, np.nan, 6.5])
    curve["active_bounds"][1, 0] = "flap_amplitude"
    frequency = curve_page(curve).axes[-1]
    (empty,) = [line for line in frequency.lines if line.get_label() == "set by a limit, not predicted"]
    points = measured_beside(curve, flights(SPEEDS[:3], frequency=[9.0] * 3))["points"]
    assert empty.get_xdata().tolist() == [point["speed"] for point in points if point["set_by_limit"]] == [4.0, 6.0]


def test_a_power_of_zero_has_no_share_and_no_division():
    """Where a computed number is 0, a difference has no share of it; JSON has no infinity."""
    curve = curve_of(mean_positive_power=[0.0, 16.0, 14.0, np.nan, 22.0])
    with np.errstate(divide="raise"):
        beside = measured_beside(curve, flights([4.0, 6.0], mechanical_power=[2.0, 18.0]))
    assert beside["residuals"]["mechanical_power"]["mean_share"] is None
    texts = [line.text for line in _measured(beside) if hasattr(line, "text")]
    assert "  residual = measured - computed: mean +2 W, rms 2 W, of 2" in texts


@pytest.mark.parametrize("columns", [{}, {"metabolic_rate": [50.0, 40.0, 40.0, np.nan, 60.0]}])
def test_each_kind_of_power_has_its_own_panel(columns):
    given = flights(
        [3.0, 5.0, 14.0],
        frequency=[9.0, 8.0, 7.0],
        frequency_error=[0.5, 0.2, np.nan],
        mechanical_power=[25.0, 15.0, 30.0],
        metabolic_rate=[90.0, 60.0, 100.0],
    )
    figure = curve_page(curve_of(**columns), measured=given)
    power, metabolic, frequency = figure.axes
    drawn = {
        axes: {line.get_label(): box for box in axes.containers for line in [box] if "measured" in line.get_label()}
        for axes in figure.axes
    }
    assert [[*those] for those in drawn.values()] == [
        ["measured mechanical power, mine.csv"],
        ["measured metabolic rate, mine.csv"],
        ["measured frequency, mine.csv"],
    ]
    for axes, name in ((power, "mechanical_power"), (metabolic, "metabolic_rate"), (frequency, "frequency")):
        (box,) = drawn[axes].values()
        assert box[0].get_xydata().tolist() == np.column_stack([given.speed, given.values[name]]).tolist()
        assert axes.get_ylim()[1] > given.values[name].max()
    low, high = frequency.get_xlim()
    assert low < 3.0
    assert high > 14.0
    (bars,) = drawn[frequency]["measured frequency, mine.csv"][2]
    assert [np.ptp(bar[:, 1]) for bar in bars.get_segments()] == pytest.approx([1.0, 0.4, 0.0])
    words = metabolic.get_ylabel()
    assert words.startswith("metabolic rate of the whole animal" if columns else "metabolic rate, measured [W]")
    check_legends(figure)


def test_a_file_is_refused_before_the_search(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("wingbeat.cli.curve.solve_curve", None)
    path = tmp_path / "bad.csv"
    path.write_text("speed [km/h],power\n30,5\n")
    assert main(["curve", "pigeon", "--speeds", "5", "6", "--data", str(path)]) == 2
    assert "bad.csv row 1 = 'speed [km/h]': is not in m/s; divide by 3.6" in capsys.readouterr().err


@pytest.mark.slow
def test_a_curve_with_own_data_in_the_table_in_json_and_in_the_figure(tmp_path, capsys):
    path = tmp_path / "mine.csv"
    path.write_text("speed,frequency,frequency sd,power\n10.5,9.0,1,20\n30,9,1,\n")
    words = ["curve", "pigeon", "--speeds", "10", "11", "--starts", "1", "--data", str(path)]
    picture, saved = tmp_path / "curve.png", tmp_path / "curve.nc"
    assert main([*words, "--json", "--plot", str(picture), "-o", str(saved)]) == 0
    found = json.loads(capsys.readouterr().out)
    points = found["measured"]["points"]
    ends = [point["optima"][0]["frequency"] for point in found["points"]]
    assert points[0]["computed"] == pytest.approx(sum(ends) / 2)
    assert points[1]["not_compared"] == "outside the computed 10 to 11 m/s"
    assert picture.stat().st_size > 10_000
    flights = wb.experiment.read_flights(path)
    assert wb.load_curve(saved).compare(flights) == found["measured"]
    assert main(["plot", str(saved), "-o", str(picture), "--data", str(path)]) == 0
    assert main([*words, "--refinements", "0"]) == 0
    out = capsys.readouterr().out
    assert "mine.csv: measured mechanical power [W], beside the mean positive hinge power" in out
    assert "column 'power' is taken as mechanical power" in " ".join(out.split())
