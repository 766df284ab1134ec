"""Curves over frequency: orbits at given frequencies, what muscle allows, files that come back, refusals."""

import itertools
import json
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat._base import FileError, InvalidInputError, text_of
from wingbeat.cli import main
from wingbeat.orbits.branches import FREQUENCY, at_frequency
from wingbeat.plots import curve_page, frequency_page
from wingbeat.records import characteristic
from wingbeat.records.forms import inputs_hash
from wingbeat.records.result_files import save_result
from wingbeat.words.curve_words import curve_report

PIGEON = wb.load_species("pigeon")
ACROSS = ["curve", "pigeon", "--over", "frequency"]


def problem():
    return wb.models.animal(PIGEON).problem(PIGEON, speed=14.0)


@pytest.fixture(scope="module")
def curve():
    return wb.solve_curve(problem(), [6.0, 7.0], starts=1, over="frequency")


def test_a_problem_at_a_frequency_keeps_all_but_the_frequency():
    own, searched = problem(), wb.models.animal(PIGEON, "free").problem(PIGEON, speed=14.0)
    for one in (own, searched):
        held = at_frequency(one, 7.0)
        assert FREQUENCY.of(held) == 7.0
        assert held.frequency_basis == "given"
        assert held.free == tuple(name for name in one.free if name != "frequency")
        assert {n: held.bounds[n] for n in held.free} == {n: one.bounds[n] for n in held.free}
        assert (held.speed, held.minimise, held.vehicle) == (one.speed, one.minimise, one.vehicle)
    assert own.frequency_basis == "law"


def test_each_frequency_has_a_certified_orbit_and_the_file_comes_back(curve, tmp_path):
    record = curve.record()
    assert (curve.over, record["over"], record["speed"], curve.gaps) == ("frequency", "frequency", 14.0, [])
    assert "characteristic_speeds" not in record
    assert curve.characteristic_speeds == {}
    assert [point["frequency"] for point in record["points"]] == [6.0, 7.0]
    assert not any(point["refined"] for point in record["points"])
    best = [point["optima"][0] for point in record["points"]]
    assert "frequency" not in best[0]
    assert best[0]["flap_amplitude"] > best[1]["flap_amplitude"]  # a slower beat goes farther
    for one, hertz in zip(best, (6.0, 7.0), strict=True):
        assert one["muscle_work_per_mass"] * hertz == pytest.approx(one["muscle_power_per_mass"])
        assert one["strouhal"] == pytest.approx(
            hertz * 2.0 * PIGEON.vehicle.wing.semi_span * math.sin(one["flap_amplitude"]) / 14.0, rel=0.05
        )
    alone = wb.solve_orbit(at_frequency(problem(), 7.0), starts=2)
    assert best[1]["metabolic_power"] == pytest.approx(alone.record()["metabolic_power"], rel=1e-3)
    curve.save(tmp_path / "curve.nc")
    again = wb.load_curve(tmp_path / "curve.nc")
    assert again.record() == record
    assert (
        repr(again) == repr(curve) == "<Curve pigeon: minimum metabolic_power at 2 frequencies, 0 without an orbit>"
    )
    json.dumps(record, allow_nan=False)
    assert list(curve.to_dataframe()["frequency"]) == [6.0, 7.0]
    curve.save(tmp_path / "curve.csv")
    assert "one row per frequency" in (tmp_path / "curve.csv").read_text().splitlines()[0]


def changed(**attributes):
    def act(dataset):
        new = {}
        for name, change in attributes.items():
            old = dataset.attrs[name]
            held = json.loads(old) if isinstance(old, str) and old[:1] in "[{" else old
            value = change(held)
            new[name] = json.dumps(value) if isinstance(value, dict | list) else value
        if "inputs" in new:
            new["inputs_hash"] = inputs_hash(json.loads(new["inputs"]))
        return dataset.assign_attrs(new)

    return act


def values(**acts):
    return lambda dataset: dataset.assign({n: (dataset[n].dims, f(dataset[n].values)) for n, f in acts.items()})


FORGED = {
    "other frequencies": lambda dataset: dataset.assign_coords(frequency=("frequency", [6.1, 7.1])),
    "other frequencies in the inputs too": lambda dataset: changed(inputs=lambda i: i | {"frequency": [6.1, 7.1]})(
        dataset.assign_coords(frequency=("frequency", [6.1, 7.1]))
    ),
    "another speed": changed(speed=lambda _: 13.0),
    "another speed in the inputs too": changed(speed=lambda _: 13.0, inputs=lambda i: i | {"speed": 13.0}),
    "half the work per beat": values(muscle_work_per_mass=lambda work: 0.5 * work),
    "less power": values(metabolic_power=lambda power: 0.5 * power),
    "a muscle that is too weak": values(peak_activation=lambda activation: 2.0 * activation),
    "another amplitude": values(flap_amplitude=lambda angle: 0.5 * angle),
    "a gap closed": values(status=lambda status: np.array(["infeasible", *status[1:]])),
    "a free frequency": changed(inputs=lambda i: i | {"free": [*i["free"], "frequency"]}),
    "a curve over speed": lambda dataset: dataset.drop_attrs(deep=False).assign_attrs(
        {name: value for name, value in dataset.attrs.items() if name != "over"}
    ),
    "a curve over nothing known": changed(over=lambda _: "amplitude"),
}


@pytest.mark.parametrize("name", FORGED)
def test_no_forged_curve_over_frequency_is_believed(curve, tmp_path, name):
    path = tmp_path / "forged.nc"
    save_result(FORGED[name](curve.dataset), path)
    with pytest.raises(FileError, match="it is damaged"):
        wb.load_curve(path)


def test_what_follows_from_the_points_is_computed_on_loading(curve, tmp_path):
    save_result(curve.dataset.assign_attrs(characteristic_frequencies="{}"), tmp_path / "curve.nc")
    assert wb.load_curve(tmp_path / "curve.nc").characteristic_frequencies == curve.characteristic_frequencies


def test_the_report_says_what_is_known_of_the_frequency(curve):
    known = curve.characteristic_frequencies
    own = PIGEON.own_frequency(14.0)
    assert known["own"] == {
        "value": own.value,
        "range": list(own.range),
        "basis": "law",
        "source": own.source,
    }
    assert known["least"]["within_5_percent"] == [[6.0, 7.0]]
    assert known["activation"] == {"limit": 1.0, "ranges": [[6.0, 7.0]]}
    bands = {band["name"]: band for band in known["work_per_beat"]}
    assert bands["pigeon, in vivo"]["ranges"] == [[6.0, 7.0]]
    assert bands["quail, take-off"]["ranges"] == []
    assert all(band["source"] and band["grade"] in "ABD" for band in bands.values())
    printed = " ".join(text_of(curve_report(curve.record())).split())
    assert "pigeon at 14 m/s, minimum metabolic power of the flight muscle: 2 of 2 frequencies certified" in printed
    assert "the animal's own: 6.2 Hz (5.4 to 6.9), by a law of its kind" in printed
    assert "within 5 % of it from 6 to 7 Hz; the curve ends at 6 and 7 Hz" in printed
    assert "activation at most 1: from 6 to 7 Hz" in printed
    assert "quail, take-off, 15 to 17 J/kg: at no frequency" in printed
    assert "pigeon, in vivo, 6.7 to 13.9 J/kg: from 6 to 7 Hz" in printed
    assert "minimum power:" not in printed


def test_the_page_shows_what_muscle_allows_with_one_legend(curve):
    figure = curve.plot()
    entries = check_legends(figure)
    assert any(text.startswith("the animal's own: 6.2 Hz (5.4 to 6.9)") for text in entries)
    assert any("activation at most 1; 5 to 34 J/kg" in text for text in entries)
    assert len(figure.axes) == 4
    power = figure.axes[0].lines
    drawn = {str(line.get_label()): np.asarray(line.get_ydata()) for line in power}
    best = curve.dataset["metabolic_power"].values[:, 0] / PIGEON.vehicle.mass
    np.testing.assert_allclose(drawn["metabolic, of the flight muscle"], best, rtol=1e-12)
    with pytest.raises(InvalidInputError, match="frequency_page"):
        curve_page(curve.dataset)
    with pytest.raises(InvalidInputError, match="is no curve over frequency"):
        frequency_page(curve.dataset.assign_attrs(over="speed"))


def test_ranges_are_those_of_the_straight_lines_between_points():
    """Against many points between: a gap in the middle and a jump tear the line."""
    random = np.random.default_rng(57)
    frequency = np.arange(3.0, 9.0)
    for _ in range(200):
        value = random.uniform(0.0, 2.0, frequency.size)
        value[random.integers(1, 5)] = value[0]  # flat beside the first, or level with it
        value[random.integers(frequency.size)] = math.nan
        joined = random.random(frequency.size - 1) < 0.8
        line = characteristic.BestLine("q", True, frequency, value, joined, [frozenset()] * 6, np.empty((0, 6)))
        low, high = np.sort(random.uniform(0.0, 2.0, 2))
        found = characteristic._ranges(line, value, low, high)
        assert all(a <= b for a, b in found)
        assert all(before[1] < after[0] for before, after in itertools.pairwise(found))
        for k in range(frequency.size - 1):
            fine = np.linspace(0.01, 0.99, 37)
            between = value[k] + fine * (value[k + 1] - value[k])
            expected = (between >= low) & (between <= high) & joined[k]
            at = frequency[k] + fine
            inside = np.any([(at >= a) & (at <= b) for a, b in found], axis=0) if found else np.zeros(37, bool)
            np.testing.assert_array_equal(inside, expected)


@pytest.mark.parametrize(
    ("asked", "named", "told"),
    [
        ([6.0], {}, "frequencies"),
        ([7.0, 6.0], {}, "must increase"),
        ([0.0, 6.0], {}, "must be > 0 Hz"),
        ([6.0, 7.0], {"power_limit": 9.0}, "belongs to a curve over speed"),
        ([6.0, 7.0], {"over": "amplitude"}, "over"),
    ],
)
def test_what_makes_no_sense_over_frequency_is_refused(asked, named, told):
    with pytest.raises(InvalidInputError, match=told):
        wb.solve_curve(problem(), asked, **{"over": "frequency"} | named)


def test_a_curve_over_frequency_does_not_minimise_it_nor_compare_speeds(curve):
    with pytest.raises(InvalidInputError, match="is given at each point of a curve over frequency"):
        wb.solve_curve(wb.OrbitProblem(PIGEON, 14.0), [6.0, 7.0], over="frequency")
    with pytest.raises(InvalidInputError, match="has one speed only"):
        curve.compare(None)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ([*ACROSS, "--frequencies", "6:7:1"], "--speed"),
        ([*ACROSS, "--speed", "14"], "--frequencies"),
        ([*ACROSS, "--speed", "14", "--frequencies", "6:7:1", "--speeds", "3:5:1"], "does not belong to a curve"),
        ([*ACROSS, "--speed", "14", "--frequencies", "6:7:1", "--frequency", "6"], "belongs to a curve over speed"),
        (
            [*ACROSS, "--speed", "14", "--frequencies", "6:7:1", "--free", "frequency"],
            "--free = 'frequency': belongs",
        ),
        ([*ACROSS, "--speed", "14", "--frequencies", "6:7:1"], "--model animal"),
        (["curve", "pigeon", "--over", "mass", "--speeds", "3:5:1"], "--over"),
        (["curve", "pigeon"], "--speeds"),
    ],
)
def test_the_command_line_says_what_a_curve_needs(words, told, capsys):
    assert main(words) == 2
    assert told in capsys.readouterr().err


@pytest.mark.slow
def test_the_command_draws_saves_and_shows(tmp_path, capsys):
    saved, page = tmp_path / "pigeon.nc", tmp_path / "pigeon.svg"
    words = [*ACROSS, "--frequencies", "5:7:1", "--speed", "14", "--model", "animal", "--starts", "1", "--json"]
    assert main([*words, "-o", str(saved), "--plot", str(page)]) == 0
    record = json.loads(capsys.readouterr().out)
    assert [point["frequency"] for point in record["points"]] == [5.0, 6.0, 7.0]
    assert [mark for mark in record["marks"] if mark["kind"] != "bounds"] == []
    assert main(["show", str(saved), "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == record
    assert main(["show", str(saved)]) == 0
    assert "3 of 3 frequencies certified" in " ".join(capsys.readouterr().out.split())
    assert main(["plot", str(saved), "-o", str(tmp_path / "again.svg")]) == 0
    assert (tmp_path / "again.svg").read_bytes() == page.read_bytes()
    assert main(["plot", str(saved), "-o", str(tmp_path / "no.svg"), "--data", "flights.csv"]) == 2


@pytest.mark.slow
def test_where_nothing_flies_at_a_frequency_the_curve_has_a_gap_and_says_what_is_short():
    """A pigeon at 4 m/s and 6.2 Hz lacks lift; somewhat faster beats fly."""
    slow = wb.models.animal(PIGEON).problem(PIGEON, speed=4.0)
    curve = wb.solve_curve(slow, [6.2, 8.5], starts=2, over="frequency")
    first, second = curve.record()["points"]
    assert curve.gaps == [6.2]
    assert "lift is short by" in first["message"]
    assert second["status"] == "converged"
