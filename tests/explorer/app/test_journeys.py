"""What the face offers beyond a first answer, in the served page: a tour, comparison, pushes, own files."""

import re
from pathlib import Path

import pytest

import wingbeat as wb
from tests.explorer.app.page import asks_for, solved
from tests.helpers.browsers import DROP, PATIENCE

QUERY = "species=pigeon&speed=10&starts=1&sweep=9:11:1"
FACE = "wingbeatPage.face"
LONG = 2 * PATIENCE  # ms for what solves several flights
FLIGHTS = "Speed [m/s],Power (W),sd,who\n9,41,3,bird A\n10,38.5,,\n11,52,4,bird B\n"
IN_VIEW = """(() => {{
    const {{ top, bottom }} = document.querySelector('{}').getBoundingClientRect();
    return top > 0 && bottom < innerHeight;
}})()"""


def wait_for(page, condition):
    page.wait_for_function(f"() => {condition}", timeout=LONG)


# Tours ------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_tour_solves_its_flights_from_start_to_close(visit):
    page = visit("species=bat&speed=8&starts=1&sweep=7:9:1")
    solved(page, "bat at 8 m/s")
    opener = page.get_by_role("button", name="A plate against a fruit fly")
    opener.click()
    panel, told = page.locator(".wbx-tour"), page.locator(".wbx-tour-text")
    seen = []
    for nth, go_on in enumerate(("Next", "Next", "Next", "Finish"), 1):
        wait_for(page, f"{FACE}.tour.ready && {FACE}.tour.nth === {nth - 1}")
        assert panel.locator("p").first.inner_text() == f"A plate against a fruit fly: {nth} of 4"
        answer = page.evaluate(
            f"(({{ species, model, speed, power }}) => ({{ species, model, speed, power }}))({FACE}.answer)"
        )
        seen.append(answer)
        assert answer["species"] == "bat"
        assert f"{answer['power']:.3g} W" in told.inner_text()
        assert page.evaluate(f"{FACE}.viewer.flights.length") == 1 + (
            nth in (2, 4)
        )  # those with the ghost of the step before
        panel.get_by_role("button", name=go_on, exact=True).click()
    assert [one["model"] for one in seen] == ["paper", "dickinson"] * 2
    assert seen[0]["speed"] == seen[1]["speed"] < seen[2]["speed"] == seen[3]["speed"]
    panel.wait_for(state="hidden")
    assert page.evaluate("document.activeElement.textContent") == "A plate against a fruit fly"
    assert page.evaluate(f"{FACE}.viewer.flights.length") == 1
    # The controls, the address and what stands below the face belong to the tour's last flight.
    asks_for(page, "aero=dickinson")
    solved(page, f"bat at {seen[3]['speed']:g} m/s, dickinson")


# Comparison -------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_flight_is_pinned_in_the_face_and_flies_beside_the_next(visit):
    page = visit(QUERY)
    solved(page, "pigeon at 10 m/s")
    page.get_by_role("button", name="Pin this flight to compare").click()
    page.locator(".pins td.acts [aria-pressed=true]").wait_for()
    wait_for(page, f"{FACE}.viewer.flights.length === 2")
    page.locator(".wbx-handle").press("End")
    solved(page, "pigeon at 11 m/s")
    wait_for(page, f"{FACE}.answer.speed === 11 && {FACE}.viewer.flights.length === 2")
    assert (
        page.locator(".wbx-pins p").inner_text()
        == "Pinned, shown pale: rock pigeon at 10 m/s, model: Su et al. 2023."
    )
    assert page.locator(".wbx-pin").count() == 1  # its place on the curve
    now, before = page.evaluate(f"{FACE}.viewer.flights.map((flight) => flight.frequency)")
    assert now == page.evaluate(f"{FACE}.answer.frequency")
    assert before == page.evaluate(f"{FACE}.pins.answer.frequency") != now

    ghost = page.evaluate(f"{FACE}.viewer.ghost")
    page.get_by_role("button", name="Show side by side").click()
    wait_for(page, f"{FACE}.viewer.ghost === {str(not ghost).lower()}")
    apart = (
        f"{FACE}.viewer.stage.animals[1].group.position.distanceTo({FACE}.viewer.stage.animals[0].group.position)"
    )
    assert page.evaluate(apart) > 0
    page.get_by_role("button", name="Show as a ghost").click()
    page.get_by_role("button", name="Remove the comparison").click()
    wait_for(page, f"{FACE}.viewer.flights.length === 1")
    # It stays in the table, from which it is shown again.
    page.get_by_role("button", name=re.compile("Show as ghost: pigeon at 10 m.s")).click()
    wait_for(page, f"{FACE}.viewer.flights.length === 2")


# Pushes -----------------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_same_gust_with_and_without_feedback(visit):
    page = visit(QUERY)
    solved(page, "pigeon at 10 m/s")
    page.get_by_role("button", name="Push it with a gust").click()
    wait_for(page, f"{FACE}.answer.scene.pushes?.some((push) => push.feedback)")
    controls = page.locator(".wb-push")
    controls.get_by_label("Gust", exact=True).select_option("tail")
    size = float(controls.get_by_label("Size [m/s]", exact=True).input_value())
    told = {}
    for feedback in (False, True):
        controls.get_by_label("feedback", exact=True).set_checked(feedback)
        controls.get_by_role("button", name="Push", exact=True).click()
        told[feedback] = controls.locator(".wb-outcome").inner_text()
        assert page.evaluate(f"{FACE}.viewer.last") > 1  # more than one beat of it
        assert not page.evaluate(f"{FACE}.viewer.playing")  # the visitor asked for less motion
    pushes = page.evaluate(f"{FACE}.answer.scene.pushes")
    ours = [push for push in pushes if push["direction"] == "tail" and push["size"] == size]
    assert told == {push["feedback"]: push["outcome"] for push in ours}
    assert "tumbles" in told[False]
    assert "tumbles" not in told[True]
    controls.get_by_role("button", name="Back to the orbit").click()
    assert page.evaluate(f"{FACE}.viewer.last") == 1


# The reader's own files -------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_measured_flights_that_are_dropped_lie_behind_the_curve_and_stay_in_the_browser(visit):
    page = visit(QUERY)
    solved(page, "pigeon at 10 m/s")
    sent = []
    page.on("request", lambda request: sent.append(request.url))
    assert not page.evaluate(DROP, ["mine.csv", FLIGHTS])  # the browser does not open it in the page's place
    row = page.locator(".wbx-own-list li")
    row.wait_for()
    assert row.locator("span").last.inner_text() == "mine.csv: 3 points behind the curve"
    assert page.locator(".wbx-own-mark").count() == 3
    wait_for(page, IN_VIEW.format(".wbx-own-mark"))
    page.locator(".wbx-handle").press("Home")  # they stay behind the curve of another speed
    solved(page, "pigeon at 9 m/s")
    assert page.locator(".wbx-own-mark").count() == 3
    assert [url for url in sent if "/wingbeat/upload/" in url] == []
    page.evaluate(DROP, ["bad.csv", "Speed [m/s],Power (kcal/h)\n8,41\n"])
    refused = page.locator(".wbx-own-state")
    refused.get_by_text("bad.csv is not shown:").wait_for()
    assert "is in kcal/h; convert it to W" in refused.inner_text()
    wait_for(page, IN_VIEW.format(".wbx-own-state li"))  # though the file was dropped far above
    assert row.count() == 1
    page.get_by_role("button", name="Remove mine.csv").click()
    assert page.locator(".wbx-own-mark").count() == 0


@pytest.mark.slow
def test_a_species_file_that_is_dropped_is_solved_or_refused_in_words(visit):
    page = visit(QUERY)
    solved(page, "pigeon at 10 m/s")
    before = page.evaluate(f"{FACE}.answer.mass")
    text = (Path(wb.__file__).parent / "data" / "pigeon.toml").read_text()
    page.evaluate(DROP, ["bad.toml", 'name = "x"\n[vehicle.wing]\nmass = "heavy"\n'])
    page.locator(".trouble li", has_text="vehicle.wing.mass: must be a number").wait_for()
    assert page.evaluate(f"{FACE}.answer.species") == "pigeon"
    page.evaluate(DROP, ["mine.toml", text.replace('"pigeon"', '"mine"', 1)])
    solved(page, "mine at 10 m/s")
    wait_for(page, f"{FACE}.answer.species === 'mine' && {FACE}.viewer.flights.length === 1")
    assert page.evaluate(f"{FACE}.answer.mass") == pytest.approx(before)
    assert page.locator(".trouble").is_hidden()
    assert page.get_by_label("Animal", exact=True).last.input_value() == "mine"


# Keyboard and motion ----------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_keyboard_alone_reaches_the_point_of_the_curve_and_changes_the_speed(visit):
    page = visit(QUERY)
    solved(page, "pigeon at 10 m/s")
    wait_for(page, f"{FACE}.curve.data.points.length === 3 && !{FACE}.curve.data.pending.length")
    focused = "document.activeElement"
    page.keyboard.press("Tab")
    assert page.evaluate(f"{focused}.textContent") == "Skip to the result"
    knob = "getComputedStyle(document.querySelector('.wbx-knob')).stroke"
    plain = page.evaluate(knob)
    page.keyboard.press("Enter")
    for _ in range(40):  # past the choices, the player and the push
        page.keyboard.press("Tab")
        assert page.evaluate(f"{focused}.matches(':focus-visible')")
        if page.evaluate(f"{focused}.matches('.wbx-handle')"):
            break
    assert page.evaluate(f"{focused}.matches('.wbx-handle')")
    assert page.evaluate(knob) != plain
    point = page.get_by_role("slider", name="Speed", exact=True)
    for key, speed in (("ArrowRight", 10.5), ("ArrowUp", 11), ("ArrowLeft", 10.5), ("Home", 9)):
        page.keyboard.press(key)
        solved(page, f"pigeon at {speed:g} m/s")
        wait_for(page, f"{FACE}.answer.speed === {speed}")
        assert point.get_attribute("aria-valuenow") == f"{speed:g}"
        assert page.evaluate(f"{focused}.matches('.wbx-handle:focus-visible')")  # though the curve was drawn again
    page.keyboard.press("Shift+Tab")
    assert not page.evaluate(f"{focused}.matches('.wbx-handle')")


@pytest.mark.slow
@pytest.mark.parametrize("motion", ["reduce", "no-preference"])
def test_what_moves_by_itself_is_what_the_visitor_allows(visit, motion):
    page = visit("", reduced_motion=motion)
    wait_for(page, "window.wingbeatPage?.face?.viewer")
    moves = motion == "no-preference"
    assert page.evaluate(f"{FACE}.viewer.playing") == moves
    phase = page.evaluate(f"{FACE}.viewer.phase")
    if moves:
        wait_for(page, f"{FACE}.viewer.phase !== {phase}")
        page.get_by_role("button", name="Pause (space)").click()
        assert not page.evaluate(f"{FACE}.viewer.playing")
    else:
        twice = "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
        page.evaluate(twice)
        assert page.evaluate(f"{FACE}.viewer.phase") == phase
        page.get_by_role("button", name="Play (space)").click()
        wait_for(page, f"{FACE}.viewer.phase > {phase}")
