"""Guided tours: the flights that they ask for, the sentences, the focus, and what a page without a flight says."""

import re

import pytest

from tests.helpers.browsers import AXE, NODE_MODULES

pytestmark = pytest.mark.slow

FACE = "document.querySelector('.wbx').face"
SOURCES = NODE_MODULES.parent / "src" / "explorer"


def begin(page, title):
    page.get_by_role("button", name=title).click()
    page.locator(".wbx-tour").wait_for()
    wait_for(page, f"{FACE}.tour.ready")


def go(page, name):
    page.locator(".wbx-tour").get_by_role("button", name=name, exact=True).click()
    wait_for(page, f"{FACE}.tour.ready")


def wait_for(page, condition):
    page.wait_for_function(f"() => {condition}")


def told(page):
    return page.locator(".wbx-tour-text").inner_text()


def test_a_tour_shows_the_flights_of_its_steps_and_says_their_numbers(show, plates_and_flies):
    page, complaints, _ = show()
    plate, fly = (
        {orbit.inputs["speed"]: orbit.record() for orbit in plates_and_flies[model]}
        for model in ("paper", "dickinson")
    )
    slow, fast = min(plate, key=lambda speed: plate[speed]["mean_positive_power"]), max(plate)
    begin(page, "A plate against a fruit fly")
    assert page.get_by_label("Model", exact=True).input_value() == "paper"
    assert f"{plate[slow]['mean_positive_power']:.3g} W at {slow:g} m/s" in told(page)
    go(page, "Next")
    assert page.get_by_label("Model", exact=True).input_value() == "dickinson"
    before, after = (one[slow]["wingbeat"]["frequency"] for one in (plate, fly))
    way = "rises" if after > before else "falls"
    assert f"The frequency {way} from {before:.3g} Hz to {after:.3g} Hz" in told(page)
    shown = page.evaluate(f"{FACE}.viewer.flights.map((flight) => flight.frequency)")
    assert shown == [after, before]  # the flight on plates is the ghost
    go(page, "Next")
    assert page.evaluate(f"{FACE}.answer.speed") == fast
    assert page.evaluate(f"{FACE}.viewer.flights.length") == 1
    go(page, "Next")
    assert f"{fly[fast]['mean_positive_power']:.3g} W at {fast:g} m/s" in told(page)
    page.get_by_role("button", name="Finish").click()
    assert page.locator(".wbx-tour").is_hidden()
    assert page.evaluate("document.activeElement.textContent") == "A plate against a fruit fly"
    assert page.evaluate(f"{FACE}.pins.answer === undefined")
    assert complaints == []


def test_keys_go_on_back_and_out_and_the_view_follows(show):
    page = show().page
    begin(page, "A plate against a fruit fly")
    assert page.evaluate("document.activeElement.textContent") == "A bat on flat plates"
    assert page.evaluate(f"{FACE}.viewer.stage.view") == "oblique"
    for key, title, view in (
        ("ArrowRight", "The same bat, a fruit fly's wing", "oblique"),
        ("ArrowRight", "Faster, on plates", "side"),
        ("ArrowLeft", "The same bat, a fruit fly's wing", "oblique"),
    ):
        page.keyboard.press(key)
        wait_for(page, f"{FACE}.tour.ready")
        assert page.locator(".wbx-tour h2").inner_text() == title
        assert page.evaluate(f"{FACE}.viewer.stage.view") == view
    page.keyboard.press("Escape")
    assert page.locator(".wbx-tour").is_hidden()


CHOSEN = f"""(() => {{
  const {{ viewer, pins }} = {FACE};
  const boxes = [...viewer.root.querySelectorAll("[data-choice]")];
  const chosen = boxes.map((one) => [one.dataset.choice, one.type === "checkbox" ? one.checked : one.value]);
  return [chosen, viewer.stage.view, pins.answer?.speed, pins.ghost];
}})()"""


@pytest.mark.parametrize("pins", [True, False])
def test_what_the_reader_had_chosen_is_back_after_a_tour(show, pins):
    page = show(fragment="#animal=bat&model=paper&speed=6").page
    if pins:
        page.get_by_role("button", name="Pin this flight").click()
        page.get_by_role("button", name="Show side by side").click()
    page.get_by_text("Views, forces and plots").click()
    page.get_by_label("Strips").select_option("strip_lift")
    page.get_by_label("trails").uncheck()
    page.get_by_label("resultant").uncheck()
    page.get_by_role("button", name="top", exact=True).click()
    before = page.evaluate(CHOSEN)
    begin(page, "A plate against a fruit fly")
    go(page, "Next")  # compares with the first step
    assert page.evaluate(CHOSEN)[1:] != before[1:]
    page.get_by_label("Strips").select_option("off")
    page.keyboard.press("Escape")
    assert page.evaluate(CHOSEN) == before
    assert page.evaluate(f"{FACE}.viewer.look.strips") is True
    assert page.evaluate(f"{FACE}.viewer.flights.length") == 1 + pins


def test_a_gust_is_read_when_the_tour_needs_it_and_its_outcome_is_said(show, pushed):
    page, complaints, requests = show()
    assert not any("pushes" in url for url in requests)
    begin(page, "Why it tumbles")
    assert page.evaluate(f"{FACE}.answer.speed") == pushed["first"]
    go(page, "Next")
    free = next(push for push in pushed["pushes"] if push["direction"] == "tail" and not push["feedback"])
    held = next(push for push in pushed["pushes"] if push["direction"] == "tail" and push["feedback"])
    assert f"It is {free['outcome']}." in told(page)
    assert "a gust from behind of up to 1 m/s" in told(page)
    assert page.evaluate(f"{FACE}.viewer.last") > 1
    go(page, "Next")
    assert f"It is {held['outcome']}." in told(page)
    assert page.locator(".wb-push").is_visible()
    assert [url.rsplit("/", 1)[1] for url in requests if "pushes" in url] == ["pigeon-paper-pushes.js"]
    assert complaints == []


def test_the_button_brings_the_gusts_also_from_another_speed(show, pushed):
    page = show(fragment="#animal=pigeon&model=paper&speed=14").page
    page.get_by_role("button", name=f"Push it with a gust, at {pushed['first']:g} m/s").click()
    page.locator(".wb-push").wait_for()
    assert page.evaluate(f"{FACE}.answer.speed") == pushed["first"]
    assert page.locator(".wbx-push").is_hidden()
    page.get_by_label("Gust", exact=True).select_option("tail")
    page.get_by_role("button", name="Push", exact=True).click()
    assert page.evaluate(f"{FACE}.viewer.last") > 1


def test_the_link_of_a_push_shows_it_again(show, pushed):
    page = show(fragment="#animal=pigeon&model=paper").page
    page.get_by_role("button", name="Push it with a gust").click()
    page.get_by_label("Gust", exact=True).select_option("tail")
    page.get_by_role("checkbox", name="feedback").check()
    page.get_by_role("button", name="Push", exact=True).click()
    link = page.evaluate("location.hash")
    assert link.endswith(f"&speed={pushed['first']:g}&push=tail*1*feedback")
    outcome = page.locator(".wb-outcome").inner_text()
    page, complaints, _ = show(fragment=link)
    wait_for(page, f"{FACE}.viewer.pushes.name === 'tail*1*feedback'")
    assert page.locator(".wb-outcome").inner_text() == outcome
    assert page.evaluate("location.hash") == link
    page.get_by_role("button", name="Back to the orbit").click()
    assert "push" not in page.evaluate("location.hash")
    assert complaints == []


def test_a_link_with_a_push_that_the_flight_lacks_shows_the_flight(show, pushed):
    page, complaints, _ = show(fragment="#animal=pigeon&model=paper&speed=14&push=tail*1")
    assert page.evaluate(f"{FACE}.answer.speed") == 14
    assert page.evaluate("location.hash") == "#animal=pigeon&model=paper&speed=14"
    page, complaints, _ = show(fragment=f"#animal=pigeon&speed={pushed['first']:g}&push=sideways*9")
    wait_for(page, "!location.hash.includes('push')")
    assert page.locator(".wb-push").is_visible()
    assert page.evaluate(f"{FACE}.viewer.last") == 1
    assert complaints == []


def test_a_step_without_its_flight_is_left_out_and_the_tour_says_so(show):
    page = show().page
    page.evaluate(f"() => {{ {FACE}.has = ({{ animal, model }}) => animal === 'bat' && model === 'paper'; }}")
    begin(page, "A plate against a fruit fly")
    go(page, "Next")
    assert page.locator(".wbx-tour h2").inner_text() == "Faster, on plates"
    assert "no such flight: “The same bat, a fruit fly's wing”" in told(page)
    assert "no such flight: “Faster, with the fruit fly's wing”" in told(page)
    assert page.get_by_role("button", name="Finish").is_visible()
    go(page, "Back")
    assert page.locator(".wbx-tour h2").inner_text() == "A bat on flat plates"
    assert page.get_by_role("button", name="Back", exact=True).is_disabled()


def test_a_tour_without_any_flight_cannot_begin(show):
    page = show().page
    assert page.get_by_role("button", name="Build a robot").is_disabled()
    assert "no flight of this tour" in page.locator(".wbx-tours").inner_text()


def test_a_reader_who_leaves_the_flight_of_a_step_can_go_back_to_it(show):
    page = show().page
    begin(page, "Why it tumbles")
    again = page.get_by_role("button", name="Show this step again")
    assert again.is_hidden()
    at = page.evaluate(f"{FACE}.answer.speed")
    page.get_by_role("slider", name="Speed").focus()
    page.keyboard.press("End")
    again.click()
    wait_for(page, f"{FACE}.tour.ready")
    assert page.evaluate(f"{FACE}.answer.speed") == at
    assert again.is_hidden()


def test_on_a_phone_the_tour_leaves_the_animal_in_sight(show):
    page = show(width=390, height=844).page
    begin(page, "Why it tumbles")
    canvas, panel = (page.locator(name).bounding_box() for name in (".wbx canvas", ".wbx-tour"))
    assert canvas["y"] >= 0
    assert canvas["y"] + canvas["height"] <= panel["y"]
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_no_number_of_a_result_is_typed_into_a_tour():
    """Digits stand in code and in years of publications only."""
    for path in SOURCES.glob("stories_of_*.js"):
        texts = re.findall(r'"[^"\n]*"|`[^`]*`', path.read_text("utf-8"))
        assert len(texts) > 30
        for text in texts:
            plain = re.sub(r"\$\{[^{}]*\}", "", text)
            assert re.search(r"\d", re.sub(r"et al\. \d{4}|robofalcon2", "", plain)) is None, plain


@pytest.mark.parametrize(("theme", "width"), [("dark", 390), ("light", 1280)])
def test_axe_finds_no_fault_in_a_tour(show, theme, width):
    if not AXE.exists():
        pytest.skip("needs axe-core: npm ci in the folder viewer")
    page = show(width=width, color_scheme=theme, bypass_csp=True).page
    begin(page, "A plate against a fruit fly")
    page.add_script_tag(content=AXE.read_text())
    found = page.evaluate("axe.run()")
    assert {fault["id"]: [node["html"] for node in fault["nodes"]] for fault in found["violations"]} == {}
