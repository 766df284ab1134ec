"""The first screen of the explorer: an animal that flies at once, and a point on the curve that one drags."""

import io
import json
from pathlib import Path

import PIL.Image
import pytest

import wingbeat as wb
from tests.explorer.app.page import asks_for, choose, drawer, enter, solved, unfold
from tests.helpers.browsers import PATIENCE
from wingbeat._workers.pool import Event
from wingbeat._workers.process import Context
from wingbeat_explorer.app.first import first_scenario, read_first
from wingbeat_explorer.app.jobs import do
from wingbeat_explorer.app.links import to_plain

IN_SHAPE = """() => {
    const { canvas, stage } = wingbeatPage.face.viewer;
    return !stage.due && Math.abs(stage.camera.aspect - canvas.clientWidth / canvas.clientHeight) < 0.01;
}"""
FLIES = "() => window.wingbeatPage?.face?.viewer?.flights.length === 1"


@pytest.mark.slow
def test_what_was_solved_beforehand_is_what_a_fresh_solve_finds():
    """After a change of numbers or scenes, ``python -m wingbeat_explorer.app.first`` writes the file again."""
    first, context = read_first(), Context(lambda told: None, lambda: False)
    scenario = first_scenario()
    assert first.scenario == scenario
    fresh = do({"do": "orbit", "scenario": to_plain(scenario)}, context)
    for name in ("mean_positive_power", "objective_value", "cost_of_transport"):
        assert first.answer["record"][name] == pytest.approx(fresh["record"][name], rel=1e-6), name
    assert first.answer.keys() == fresh.keys()
    assert first.answer["inputs"] == fresh["inputs"]
    assert first.answer["measured"] == fresh["measured"]
    face, again = json.loads(first.answer["face"]), json.loads(fresh["face"])
    assert face.keys() == again.keys()
    assert face["sentence"] == again["sentence"]
    (flight,), (flown,) = face["scene"]["flights"], again["scene"]["flights"]
    assert flight.keys() == flown.keys()
    assert flight["arrays"].keys() == flown["arrays"].keys()
    assert [point["speed"] for point in first.points] == scenario.speeds()
    assert all(point["plausible"] for point in first.points)
    near, asked = first.points[3]["near"], to_plain(scenario.at(first.points[3]["speed"]))
    point = do({"do": "point", "scenario": asked, "near": near, "whole": False}, context)
    assert point["mean_positive_power"] == pytest.approx(first.points[3]["mean_positive_power"], rel=1e-6)


@pytest.mark.slow
def test_the_first_picture_comes_without_a_solve(visit, served, monkeypatch):
    asked, earlier = [], set(served.house.pages)  # pages of other tests live on for a while

    def submit(session, *what, **how):
        if session not in earlier:
            asked.append(session)

    monkeypatch.setattr(served.house, "_is_warm", False)
    monkeypatch.setattr(served.house.pool, "submit", submit)
    page = visit("")
    page.wait_for_function(FLIES)
    solved(page, "pigeon at 12 m/s, feathered-flapping")
    assert page.locator(".state").inner_text() == "Solved beforehand."
    sentence = page.locator(".wbx-sentence").inner_text()
    assert sentence.startswith("A rock pigeon at 12 m/s beats ")
    assert sentence.endswith("within what its muscle gives.")
    assert page.locator(".wbx-good").count() == 2
    assert page.locator(".wbx-dot").count() == len(first_scenario().speeds())
    # The page asks for nothing; the server gets ready for the first move, once.
    assert asked == ["warm-up"]
    another = visit("")
    another.wait_for_function(FLIES)
    solved(another, "pigeon at 12 m/s, feathered-flapping")
    assert asked == ["warm-up"]


def test_a_second_worker_gets_ready_after_the_first(served, monkeypatch):
    asked, earlier = [], set(served.house.pages)

    def submit(*what, **how):
        if what[0] not in earlier:
            asked.append((what, how))

    monkeypatch.setattr(served.house, "_is_warm", False)
    monkeypatch.setattr(served.house.pool, "submit", submit)
    served.house.warm_up()
    ((session, what, tell), how), *others = asked
    assert (session, how, others) == ("warm-up", {}, [])
    tell(Event("started"))
    assert len(asked) == 1
    tell(Event("done", {}))
    ((_, again, tell), how) = asked[1]
    assert (again, how) == (what, {"background": True})
    tell(Event("done", {}))
    assert len(asked) == 2


@pytest.mark.slow
def test_the_limits_of_the_first_flight_can_be_dropped_and_taken_again(visit):
    page = visit("")
    page.wait_for_function(FLIES)
    within = drawer(page).get_by_label("Keep to plausible ranges", exact=True)
    assert within.input_value() == "yes"
    page.locator(".wbx-choices select").nth(1).select_option("paper")
    solved(page, "pigeon at 12 m/s, su-fan")
    assert within.input_value() == "no"
    assert page.locator(".wbx-bad").count() == 1
    choose(page, "Flight model", "plausible")
    asks_for(page, "within_plausible=yes")
    solved(page, "pigeon at 12 m/s, feathered-flapping")
    page.locator(".wbx-sentence", has_text="within what its muscle gives.").wait_for()
    choose(page, "Keep to plausible ranges", "no")
    chosen = page.locator(".wbx-choices select").nth(1)
    page.wait_for_function("document.querySelectorAll('.wbx-choices select')[1].value === 'animal'")
    assert chosen.locator("option:checked").text_content() == "live animal, no limits"


@pytest.mark.slow
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_on_a_phone_the_animal_is_in_the_first_screen(visit, theme):
    page = visit("", viewport={"width": 390, "height": 844}, color_scheme=theme)
    page.wait_for_function(FLIES)
    box = page.locator(".wb-canvas").bounding_box()
    assert box["y"] + box["height"] <= 844
    assert box["width"] * box["height"] > 0.25 * 390 * 844
    lights = page.locator(".wbx-lights").bounding_box()
    assert lights["y"] + lights["height"] <= box["y"]
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


@pytest.mark.slow
def test_on_a_phone_the_picture_is_still_drawn_as_it_goes_below_the_head(visit):
    page = visit("", viewport={"width": 390, "height": 844})
    page.wait_for_function(FLIES)
    page.wait_for_function(IN_SHAPE)  # a new shape empties the picture until the next frame
    page.evaluate("() => scrollTo(0, document.querySelector('.wb-canvas').getBoundingClientRect().bottom - 190)")
    box = page.locator(".wb-canvas").bounding_box()
    clip = {"x": box["x"] + 20, "y": box["y"] + box["height"] - 60, "width": 300, "height": 50}
    picture = PIL.Image.open(io.BytesIO(page.screenshot(clip=clip))).convert("RGB")
    assert len(picture.getcolors(300 * 50)) > 20  # the ground, not one flat colour


@pytest.mark.slow
def test_the_point_of_the_curve_is_dragged_to_another_speed(visit):
    page = visit("species=pigeon&speed=10&starts=1&sweep=9:12:1")
    solved(page, "pigeon at 10 m/s")
    knob = page.locator(".wbx-knob")
    knob.scroll_into_view_if_needed()
    box, chart = knob.bounding_box(), page.locator(".wbx-chart").bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for part in (0.02, 0.04, 0.06):
        page.mouse.move(x + part * chart["width"], y)
    speed = float(page.evaluate("wingbeatPage.face.curve.at"))
    page.mouse.up()
    assert 10.1 < speed < 11.0
    asks_for(page, f"speed={speed!r}")
    solved(page, f"pigeon at {speed:g} m/s")
    page.locator(".wbx-sentence", has_text=f"at {speed:g} m/s").wait_for()
    # and by the keyboard, from there
    page.locator(".wbx-handle").press("End")
    asks_for(page, "speed=12.0")
    solved(page, "pigeon at 12 m/s")
    assert drawer(page).get_by_label("Speed [m/s]", exact=True).first.input_value() == "12"


@pytest.mark.slow
def test_the_curve_comes_by_itself_and_goes_with_its_scenario(visit):
    page = visit("species=pigeon&speed=10&starts=1&sweep=9:11:1")
    solved(page, "pigeon")
    page.wait_for_function("document.querySelectorAll('.wbx-dot').length === 3")
    note = unfold(page, ".curve").locator(".note", has_text="3 speeds certified")
    note.wait_for()
    assert "continued from its neighbour" in note.inner_text()
    page.locator(".wbx-choices select").first.select_option("bat")
    asks_for(page, "species=bat")
    solved(page, "bat at")
    page.locator(".curve caption", has_text="bat").wait_for()
    # what the face shows of speeds that are still to be solved
    data = "{ points: [], pending: [9, 10], range: [8, 12] }"
    rings = "document.querySelectorAll('.wbx-pending').length"  # at once: the page's own curve goes on
    note = "document.querySelector('.wbx-curve-box .wbx-note').textContent"
    count, words = page.evaluate(f"(wingbeatPage.face.showCurve({data}), [{rings}, {note}])")
    assert count == 2
    assert "rings on the axis: still to be computed" in words


@pytest.mark.slow
def test_a_refused_choice_opens_the_drawer_at_its_control(visit):
    page = visit("species=pigeon&speed=10&starts=1&set=vehicle.wing.mass%3D-1.0")
    line = page.locator(".refusal", has_text="mass [kg]: must be > 0 kg; give the mass of one wing.")
    line.wait_for()
    fault = page.locator(".sheet .fault", has_text="must be > 0 kg")
    fault.wait_for()  # in view, though its control was folded twice
    assert page.locator(".drawer").get_attribute("open") is not None
    page.locator('[aria-invalid="true"]').fill("0.02")
    page.locator('[aria-invalid="true"]').press("Tab")
    line.wait_for(state="hidden")
    solved(page, "pigeon")
    page.keyboard.press("Escape")
    page.locator(".sheet").wait_for(state="hidden")
    enter(page, "Speed [m/s]", "fast")
    page.locator(".refusal", has_text="Speed [m/s]: 'fast' is not a number; type one, such as 9.5.").wait_for()


@pytest.mark.slow
def test_the_flight_is_pushed_and_says_how_it_ends(visit):
    page = visit()
    solved(page, "pigeon")
    page.get_by_role("button", name="Push it with a gust").click()
    page.locator(".wb-push").wait_for(timeout=2 * PATIENCE)
    page.get_by_role("button", name="Push", exact=True).click()
    outcome = page.locator(".wb-outcome").inner_text()
    assert "tumbles" in outcome or "settled" in outcome
    page.get_by_role("button", name="Back to the orbit").click()
    enter(page, "Speed [m/s]", "10.5")
    solved(page, "pigeon at 10.5 m/s")
    page.locator(".wb-push").wait_for(state="hidden")  # these were flights of another orbit


@pytest.mark.slow
def test_a_species_file_that_is_dropped_on_the_page_is_solved(visit, tmp_path):
    path = tmp_path / "mine.toml"
    text = (Path(wb.__file__).parent / "data" / "pigeon.toml").read_text()
    path.write_text(text.replace('"pigeon"', '"mine"', 1))
    page = visit()
    solved(page, "pigeon")
    page.locator(".wbx-file input").set_input_files(path)
    solved(page, "mine at 10 m/s")
    chosen = page.locator(".wbx-choices option:checked").first
    assert chosen.text_content() == "mine (loaded file)"
    path = tmp_path / "large.toml"
    path.write_bytes(b"#" * 5_000_001)
    page.locator(".wbx-file input").set_input_files(path)
    page.locator(".wbx-own-state", has_text="a file may have at most 5 million bytes").wait_for()


@pytest.mark.slow
def test_a_tour_says_nothing_of_an_answer_that_was_only_continued(visit):
    page = visit("")
    page.wait_for_function(FLIES)
    heard = """async (provisional) => {
        const { face } = wingbeatPage;
        let heard = 0;
        face.tour.heard = () => heard++;
        face.showAnswer({ ...face.answer, provisional });
        await new Promise((done) => setTimeout(done));
        return heard;
    }"""
    assert [page.evaluate(heard, provisional) for provisional in (True, False)] == [0, 1]
