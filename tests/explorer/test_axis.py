"""Lattices along another number than the speed: what they hold, what is refused, and the slider of the page."""

import re

import pytest

import wingbeat as wb
from tests.explorer.conftest import ALONG, STIFFNESSES, read_script
from wingbeat._base import InvalidInputError
from wingbeat_explorer import solve_lattice
from wingbeat_explorer.axis import SPEED, problems_along
from wingbeat_explorer.folder import check_names

FACE = "document.querySelector('.wbx').face"


def test_a_problem_lies_where_its_number_says(robot):
    axis, problems = problems_along(robot, "animal", STIFFNESSES, ALONG, 8.0)
    assert axis == (ALONG, "N m/rad", "stiffness of the pitch hinges")
    assert tuple(map(axis.value_of, problems)) == STIFFNESSES
    assert {problem.speed for problem in problems} == {8.0}
    in_degrees, (low, high) = problems_along(robot, "animal", [30.0, 40.0], "pitch_hinge.stop_angle_deg", 8.0)
    assert (in_degrees.unit, in_degrees.value_of(low), in_degrees.value_of(high)) == ("deg", 30.0, 40.0)
    assert low.species.wingbeat.pitch_hinge.stop_angle == pytest.approx(0.5236, abs=1e-4)


def test_the_problems_along_the_speed_are_those_of_the_model():
    bat = wb.load_species("bat")
    axis, problems = problems_along(bat, "paper", [6.0, 8.0])
    assert (axis, list(map(axis.value_of, problems))) == (SPEED, [6.0, 8.0])
    assert problems == [wb.models.paper().problem(bat, speed=speed) for speed in (6.0, 8.0)]


@pytest.mark.parametrize(
    ("values", "options", "told"),
    [
        ([], {}, "values = []: must be at least one, and increase"),
        ([2.0, 2.0], {}, "must be at least one, and increase"),
        ([1.0], {"speed": None}, "is missing: only pitch_hinge.stiffness changes"),
        ([1.0], {"along": "pitch_hinge.stifness"}, "pitch_hinge.stiffness"),
        ([1.0], {"along": "mass"}, "set body.mass or wing.mass"),
        ([1.0], {"along": "wing.shoulder"}, "along = 'wing.shoulder': is no single number"),
        ([0.1], {"along": "pitch_hinge.rest_angle"}, "is free: the model animal searches for it"),
        ([4.0], {"along": "wingbeat.frequency"}, "is free: the model animal searches for it"),
        ([-1.0], {}, "stiffness"),
        ([1.0], {"model": "fish"}, "model = 'fish'"),
        ([8.0], {"along": "speed"}, "is given beside speeds that change"),
    ],
)
def test_what_cannot_be_an_axis_is_refused(robot, values, options, told):
    asked = {"model": "animal", "along": ALONG, "speed": 8.0} | options
    with pytest.raises(InvalidInputError, match=re.escape(told)):
        solve_lattice(robot, values=values, **asked)


def test_one_animal_may_have_curves_along_several_numbers():
    check_names([("bat", "paper", "speed"), ("bat", "paper", "body.mass")])


@pytest.mark.slow
def test_a_file_holds_what_changes_and_the_flights_in_its_order(hinge_folder, hinged):
    name, lattice = read_script(hinge_folder / "data" / f"robofalcon2-animal-{ALONG}.js")
    orbits, _ = hinged
    records = [orbit.record() for orbit in orbits]
    assert (name, lattice["species"]) == (f"robofalcon2-animal-{ALONG}", "robofalcon2")
    assert lattice["axis"] == {"name": ALONG, "unit": "N m/rad", "label": "stiffness of the pitch hinges"}
    assert tuple(answer[ALONG] for answer in lattice["answers"]) == STIFFNESSES
    assert [answer["power"] for answer in lattice["answers"]] == [one["mean_positive_power"] for one in records]
    assert {answer["speed"] for answer in lattice["answers"]} == {8.0}
    points, least = lattice["curve"]["points"], min(records, key=lambda one: one["mean_positive_power"])
    assert tuple(point[ALONG] for point in points) == STIFFNESSES
    assert [point["stable"] for point in points] == [one["stable"] for one in records]
    assert lattice["first"] == least["wingbeat"]["hinge_stiffness"]
    assert lattice["curve"]["measured"] == []


@pytest.mark.slow
def test_the_slider_moves_along_the_number_and_the_link_says_it(show_hinges, hinged):
    orbits, lattice = hinged
    page, complaints, _ = show_hinges(fragment=f"#animal=robofalcon2&model=animal&{ALONG}=1.4")
    slider = page.get_by_role("slider", name="Stiffness of the pitch hinges")
    power = f"{orbits[1].record()['mean_positive_power']:.3g} W"
    assert slider.get_attribute("aria-valuetext").startswith(f"1.4 N m/rad: {power}")
    heading = page.locator(".wbx-curve-box h2").inner_text()
    assert heading == "Drag the point to change the stiffness of the pitch hinges"
    assert "stiffness of the pitch hinges [N m/rad]" in page.locator(".wbx-chart").text_content()
    slider.press("ArrowRight")
    assert page.evaluate(f"{FACE}.answer['{ALONG}']") == STIFFNESSES[2]
    assert page.evaluate("location.hash") == f"#animal=robofalcon2&model=animal&{ALONG}=1.7"
    page.get_by_role("button", name="Pin this flight").click()
    slider.press("End")
    pinned = page.locator(".wbx-pins").inner_text()
    assert "RoboFalcon2.0 robot at 8 m/s, stiffness of the pitch hinges 1.7 N m/rad" in pinned
    assert page.evaluate(f"{FACE}.answer.power") == lattice["answers"][-1]["power"]
    assert page.locator(".wbx-pin").count() == 1
    assert complaints == []


@pytest.mark.slow
def test_the_slider_can_be_that_of_the_speed_again(show_hinges):
    page, complaints, _ = show_hinges(fragment="#animal=robofalcon2")
    choice = page.get_by_label("Slider", exact=True)
    assert choice.locator("option").all_inner_texts() == ["Speed", "Stiffness of the pitch hinges"]
    assert choice.input_value() == "speed"
    choice.select_option(ALONG)
    page.get_by_role("slider", name="Stiffness of the pitch hinges").wait_for()
    assert page.get_by_label("Model", exact=True).input_value() == "animal"
    choice.select_option("speed")
    page.get_by_role("slider", name="Speed").wait_for()
    assert page.get_by_label("Model", exact=True).input_value() == "paper"
    page.get_by_label("Animal").select_option("pigeon")
    choice.wait_for(state="hidden")
    assert complaints == []


@pytest.mark.slow
def test_measured_flights_have_no_place_beside_another_number(show_hinges):
    page = show_hinges(fragment=f"#animal=robofalcon2&model=animal&{ALONG}=1.4").page
    file = {"name": "mine.csv", "mimeType": "text/csv", "buffer": b"speed,power\n8,41\n10,38\n"}
    page.locator("input[type=file]").set_input_files(file)
    listed = page.locator(".wbx-own-list li")
    listed.wait_for()
    assert "not drawn, because this curve shows the stiffness of the pitch hinges" in listed.inner_text()
    assert page.locator(".wbx-own").count() == 0
    page.get_by_label("Slider", exact=True).select_option("speed")
    page.get_by_role("slider", name="Speed").wait_for()
    assert "2 points behind the curve" in listed.inner_text()
    assert page.locator(".wbx-own").count() == 1
