"""The figure of a study: what is drawn for one, two and more varied parameters, with units, failures marked."""

import pandas as pd
import pytest

import wingbeat as wb
from tests.helpers.figures import check_legends
from wingbeat.plots import study_page
from wingbeat.studies.table import varied_numbers


def table(speeds, masses, models=("su-fan", "dickinson"), failing=()):
    rows = [
        {"key": "", "status": "infeasible" if u in failing else "converged", "species": "bat"}
        | {"aero.coefficients": model, "speed": u, "wing.mass": m, "message": "", "objective_value": u + 100 * m}
        for model in models
        for u in speeds
        for m in masses
    ]
    return pd.DataFrame(rows)


def page(frame, *varied):
    units = {"speed": "m/s", "wing.mass": "kg", "wing.semi_span": "m"}
    return study_page(frame, varied, "objective_value", "least frequency [Hz]", [units[name] for name in varied])


def test_one_parameter_is_lines_with_failures_at_the_foot():
    figure = page(table([4.0, 6.0, 8.0], [0.01], failing=[8.0]), "speed")
    (axes,) = figure.axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("speed [m/s]", "least frequency [Hz]")
    assert check_legends(figure) == ["Su-Fan", "Dickinson", "not certified"]
    assert [list(line.get_xdata()) for line in axes.get_lines()] == [*[[4.0, 6.0, 8.0]] * 2, [8.0, 8.0]]


@pytest.mark.parametrize("whole", [True, False])
def test_two_parameters_are_maps(whole):
    frame = table([4.0, 6.0, 8.0], [0.01, 0.02], failing=[8.0])
    figure = page(frame if whole else frame.drop(index=[0]), "speed", "wing.mass")
    assert check_legends(figure) == ["not certified"]
    maps = [axes for axes in figure.axes if axes.get_xlabel()]
    assert [axes.get_title() for axes in maps] == ["Su-Fan", "Dickinson"]
    assert all((a.get_xlabel(), a.get_ylabel()) == ("speed [m/s]", "mass of one wing [kg]") for a in maps)
    assert [len(axes.get_lines()[0].get_xdata()) for axes in maps] == [2, 2]


def test_a_panel_says_its_value_with_name_and_unit():
    frame = table([4.0, 6.0], [0.01, 0.02], models=("su-fan",))
    frame.insert(5, "wing.semi_span", [0.2, 0.3, 0.2, 0.3])
    maps = [axes for axes in page(frame, "wing.mass", "wing.semi_span").axes if axes.get_xlabel()]
    assert [axes.get_title() for axes in maps] == ["speed 4 m/s", "speed 6 m/s"]
    assert [axes.texts[0].get_text() for axes in maps] == ["a", "b"]


def test_more_parameters_are_parallel_coordinates():
    frame = table([4.0, 6.0, 8.0], [0.01, 0.02])
    frame.insert(5, "wing.semi_span", 0.2 + frame["wing.mass"])
    figure = page(frame, "speed", "wing.mass", "wing.semi_span")
    assert len(figure.axes) == 4
    labels = [label.get_text() for label in figure.axes[0].get_xticklabels()]
    assert labels == [
        "speed\n[m/s]",
        "mass of one wing\n[kg]",
        "semi-span of the wing\n[m]",
        "least frequency\n[Hz]",
    ]
    assert len(figure.axes[0].collections[0].get_segments()) == 6


def test_points_that_wait_are_counted_and_are_no_failures():
    frame = table([4.0, 6.0, 8.0], [0.01], failing=[8.0])
    frame.loc[frame["speed"] == 6.0, "status"] = "waiting"
    figure = page(frame, "speed")
    assert figure.get_suptitle() == "Least frequency: 2 of 6 points certified, 2 not solved yet"
    assert [list(line.get_xdata()) for line in figure.axes[0].get_lines()] == [*[[4.0, 8.0]] * 2, [8.0, 8.0]]


def test_of_a_list_of_numbers_those_that_differ_are_drawn():
    frame = table([4.0, 6.0], [0.01])
    frame["wing.chord.0"], frame["wing.chord.1"] = frame["speed"] / 50, 0.1
    frame["wing.chord.taper"] = "text"
    assert varied_numbers(frame, ["speed", "wing.chord", "aero.coefficients"]) == ["speed", "wing.chord.0"]


def test_what_cannot_be_drawn_is_told():
    frame = table([4.0, 6.0], [0.01])
    with pytest.raises(wb.InvalidInputError, match="is not a numeric column"):
        study_page(frame, ["speed"], "mean_pow", "", ["m/s"])
    with pytest.raises(wb.InvalidInputError, match="has no number to draw against"):
        page(frame)
    with pytest.raises(wb.InvalidInputError, match="leaves nothing to draw"):
        page(table([4.0], [0.01], failing=[4.0]), "speed")


@pytest.mark.parametrize(
    ("given", "label"),
    [
        ({}, "lowest frequency [Hz]"),
        ({"model": "animal"}, "lowest metabolic power of the flight muscle [W]"),
        ({"model": "animal", "minimise": "peak-power"}, "lowest peak power [W]"),
        ({"model": ["paper", "animal"]}, "minimised quantity"),
    ],
)
def test_the_label_names_what_was_minimised(tmp_path, given, label):
    """With the model `animal`, metabolic power was once drawn under "Lowest frequency [Hz]"."""
    vary = {"speed": {"grid": [12.0, 14.0]}}
    study = wb.plan_study(species="pigeon", vary=vary, store=tmp_path / "a.study.sqlite", **given)
    study.prepare()
    assert study.drawing()[3] == label
    minimised = study.to_dataset().attrs["objective"]
    assert (minimised == ["metabolic_power"]) == (given == {"model": "animal"})


def test_altitudes_and_temperatures_are_listed_as_other_keys(tmp_path):
    form = {"species": "pigeon", "speed": 12.0, "altitude": [0, 3000], "temperature": [5.0, 25.0]}
    study = wb.plan_study(form, store=tmp_path / "a.study.sqlite")
    flown = [base.recipe.example.air for base in study.plan.bases]
    assert flown == [wb.Air.at_altitude(high, warm) for high in (0.0, 3000.0) for warm in (5.0, 25.0)]
    study.prepare()
    frame, varied, *_, units = study.drawing()
    assert (varied, units) == (["altitude", "temperature"], ["m", "degC"])
    assert list(frame["altitude"]) == [0.0, 0.0, 3000.0, 3000.0]
    with pytest.raises(wb.InvalidInputError, match="altitude = 20000"):
        wb.plan_study(form | {"altitude": [0, 20_000]}, store=tmp_path / "b.study.sqlite")
    with pytest.raises(wb.InvalidInputError, match=r"vary.altitude .*list its values above"):
        wb.plan_study(
            {"species": "pigeon", "speed": 12.0, "vary": {"altitude": {"grid": [0, 3000]}}},
            store=tmp_path / "c.study.sqlite",
        )


def test_the_title_names_load_and_air_that_all_points_share():
    frame = table([4.0, 6.0], [0.01])
    frame["air.density"], frame["carried_mass"] = 0.9093, 0.005
    title = "Least frequency, with 5 g added, in air of 0.9093 kg/m3: 4 of 4 points certified"
    assert page(frame, "speed").get_suptitle() == title
    frame.loc[0, ["air.density", "carried_mass"]] = 1.225, float("nan")
    assert page(frame, "speed").get_suptitle() == "Least frequency: 4 of 4 points certified"
