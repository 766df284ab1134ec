"""The explorer in a browser: the point on the curve changes speed and animal, by pointer and by keyboard."""

import copy
import itertools

import numpy as np
import pytest

from tests.helpers.browsers import AXE, shown_files
from wingbeat_explorer import write_explorer
from wingbeat_explorer.lattice import unpacked

pytestmark = pytest.mark.slow

FACE = "document.querySelector('.wbx').face"
ACROSS = """speed => {
    const { curve } = document.querySelector(".wbx").face;
    const box = curve.svg.getBoundingClientRect();
    return [box.left + curve.scale.x(speed), box.top + box.height / 2];
}"""


def sentence(page):
    return page.locator(".wbx h1").inner_text()


def corners(page):
    return page.evaluate("document.querySelector('.wb-viewer').viewer.corners()")


def gauge(page, name):
    return page.locator(f"[data-gauge={name}] .wbx-value")


def test_it_flies_at_once_and_asks_no_other_host(show, answers):
    page, complaints, requests = show()
    first = min(answers["pigeon"], key=lambda answer: answer["power"])
    assert sentence(page) == first["sentence"]
    assert complaints == []
    assert all(url.startswith(("file:", "data:", "blob:")) for url in requests)
    assert page.locator(".wbx-light").all_inner_texts()[0].startswith("✓")


def test_dragging_changes_the_speed_the_numbers_and_the_animal(show, answers):
    page = show().page
    page.mouse.move(*page.evaluate(ACROSS, 8.2))
    page.mouse.down()
    seen = [corners(page)]
    for speed, answer in ((9.8, answers["pigeon"][1]), (11.7, answers["pigeon"][2]), (14.4, answers["pigeon"][3])):
        page.mouse.move(*page.evaluate(ACROSS, speed))
        assert sentence(page) == answer["sentence"]
        exact = gauge(page, "frequency").get_attribute("data-exact")
        assert float(exact) == answer["frequency"]
        seen.append(corners(page))
    page.mouse.up()
    assert all(one != other for one, other in itertools.pairwise(seen))
    assert "speed=14" in page.evaluate("location.hash")
    slider = page.get_by_role("slider", name="Speed")
    assert slider.get_attribute("aria-valuenow") == "14"


SHOWN = "Array.from(document.querySelector('.wb-viewer').viewer.flights[0].arrays.corners)"


def slid(page, speed):
    """Move the held point on the curve, and return the speed that it reached and the corners that are drawn."""
    page.mouse.move(*page.evaluate(ACROSS, speed))
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    reached = page.evaluate(f"{FACE}.curve.scale.valueAt(Number({FACE}.curve.knob.getAttribute('cx')))")
    return reached, np.array(page.evaluate(SHOWN))


def test_between_two_computed_speeds_the_picture_is_blended_and_no_number_is(show, answers):
    page = show(fragment="#animal=pigeon&model=paper&speed=12").page
    at_twelve = np.array(page.evaluate(SHOWN))
    page.get_by_role("slider", name="Speed").press("ArrowLeft")
    at_ten = np.array(page.evaluate(SHOWN))
    words = page.locator(".wb-warning")
    page.mouse.move(*page.evaluate(ACROSS, 10.1))
    page.mouse.down()
    for speed, answer in ((10.7, answers["pigeon"][1]), (11.6, answers["pigeon"][2])):
        reached, drawn = slid(page, speed)
        blended = at_ten + (reached - 10.0) / 2.0 * (at_twelve - at_ten)
        np.testing.assert_allclose(drawn, blended, rtol=0, atol=1e-6)
        assert words.inner_text() == "Picture between the wingbeats at 10 and 12 m/s"
        assert sentence(page) == answer["sentence"]
        assert float(gauge(page, "frequency").get_attribute("data-exact")) == answer["frequency"]
    page.mouse.up()
    words.wait_for(state="hidden")
    np.testing.assert_array_equal(page.evaluate(SHOWN), at_twelve)


def test_no_picture_lies_beside_a_flight_that_differs_or_does_not_close(browser, pushed, tmp_path):
    lattice = copy.deepcopy(pushed)
    del lattice["pushes"]
    lattice["answers"][1]["status"] = "infeasible"
    lattice["answers"][3]["scene"]["flights"][0]["arrays"]["corners"]["scale"] *= -1.0
    write_explorer(tmp_path / "explorer", [lattice])
    with shown_files(browser, ".wbx canvas", 1280, 844) as opened:
        page = opened(tmp_path / "explorer" / "index.html").page
        page.mouse.move(*page.evaluate(ACROSS, 12.0))
        page.mouse.down()
        for speed, nearest in ((13.6, 14.0), (12.4, 12.0), (11.6, 12.0), (10.4, 10.0), (8.4, 8.0)):
            slid(page, speed)
            words = page.locator(".wb-warning").text_content()
            assert words == ("the closest wingbeat: it does not fly" if nearest == 10.0 else "")
            assert page.evaluate(f"{FACE}.answer.speed") == nearest
        page.mouse.up()


def test_the_strips_are_those_of_the_whole_flight(show, answers):
    page = show(fragment="#animal=pigeon&model=paper&speed=10").page
    flight = answers["pigeon"][1]["scene"]["flights"][0]
    whole = unpacked(flight["arrays"]["corners"]).reshape(-1, flight["strips"] * 12)
    shown = page.evaluate("Array.from(document.querySelector('.wb-viewer').viewer.flights[0].arrays.corners)")
    exact = whole[:: (len(whole) - 1) // 64].ravel()
    np.testing.assert_allclose(shown, exact, rtol=0, atol=1e-4 * np.abs(exact).max())


def test_the_keyboard_moves_the_point(show, answers):
    page = show(fragment="#animal=pigeon&model=paper&speed=10").page
    slider = page.get_by_role("slider", name="Speed")
    slider.focus()
    for key, nth in (("ArrowRight", 2), ("ArrowLeft", 1), ("End", 3), ("ArrowUp", 3), ("Home", 0)):
        page.keyboard.press(key)
        answer = answers["pigeon"][nth]
        assert sentence(page) == answer["sentence"]
        told = slider.get_attribute("aria-valuetext")
        assert told.startswith(f"{answer['speed']:g} m/s: {answer['power']:.3g} W")
        assert told.endswith("certified, not plausible")
    assert page.evaluate("document.activeElement.getAttribute('role')") == "slider"


def test_another_flight_of_the_animal_keeps_its_wings_and_leaves_nothing_behind(show):
    page = show(fragment="#animal=pigeon&model=paper&speed=10").page
    held = f"""async () => {{
        const {{ renderer, animals }} = {FACE}.viewer.stage;
        for (let frame = 0; frame < 3; frame++) await new Promise((done) => requestAnimationFrame(done));
        animals[0].wings.seen = (animals[0].wings.seen ?? 0) + 1;
        return [animals[0].wings.seen, renderer.info.memory.geometries, renderer.info.programs.length];
    }}"""
    first = page.evaluate(held)
    page.get_by_role("slider", name="Speed").focus()
    for nth, key in enumerate(("ArrowRight", "ArrowLeft", "End"), start=2):
        before = corners(page)
        page.keyboard.press(key)
        assert corners(page) != before
        assert page.evaluate(held) == [nth, *first[1:]]


def test_folded_plots_are_not_drawn_and_unfolded_ones_keep_their_menus(show):
    page = show(fragment="#animal=pigeon&model=paper&speed=10").page
    plots = f"{FACE}.viewer.plots"
    page.evaluate(f"{plots}.choose([{{ ys: ['body_pitch'], x: 'phase' }}])")
    assert page.evaluate(f"[{plots}.cards.length, {plots}.choices.length]") == [0, 1]
    page.get_by_text("Views, forces and plots").click()
    page.wait_for_function(f"() => {plots}.cards.length === 1")
    line = page.locator(".wb-plot polyline.wb-curve").first
    before = line.get_attribute("points")
    page.evaluate(f"{plots}.cards[0].rows.querySelector('select').dataset.seen = ''")
    page.get_by_role("slider", name="Speed").focus()
    page.keyboard.press("ArrowRight")
    assert line.get_attribute("points") != before
    assert page.locator(".wb-card select[data-seen]").input_value() == "body_pitch"
    page.get_by_text("Views, forces and plots").click()
    page.wait_for_function(f"() => {plots}.cards.length === 0")
    assert page.evaluate(f"{plots}.choices") == [{"ys": ["body_pitch"], "x": "phase"}]


def test_another_animal_is_loaded_and_its_link_opens_it(show, answers):
    page = show().page
    page.get_by_label("Animal").select_option("bat")
    page.locator(".wbx h1", has_text="bat").wait_for()
    assert sentence(page) in [answer["sentence"] for answer in answers["bat"]]
    page = show(fragment="#animal=bat&model=paper&speed=7.9").page
    assert sentence(page) == answers["bat"][1]["sentence"]


def test_a_link_put_into_the_open_page_is_followed(show, answers):
    page, complaints, _ = show(fragment="#animal=pigeon&model=paper&speed=12")
    for fragment, answer in (
        ("#animal=bat&model=paper&speed=8", answers["bat"][1]),
        ("#speed=6", answers["bat"][0]),
        ("#animal=pigeon&speed=14", answers["pigeon"][3]),
    ):
        page.evaluate("fragment => (location.hash = fragment)", fragment)
        page.locator(".wbx h1", has_text=answer["sentence"]).wait_for()
        assert page.get_by_label("Animal", exact=True).input_value() == answer["species"]
        assert page.evaluate("location.hash").startswith(f"#animal={answer['species']}&model=")
        assert page.evaluate("location.hash").endswith(f"&speed={answer['speed']:g}")
    page.evaluate("location.hash = '#animal=unicorn&speed=fast'")
    page.wait_for_function("() => !location.hash.includes('unicorn')")
    assert sentence(page) == answers["pigeon"][3]["sentence"]
    assert complaints == []


def test_numbers_stand_out_in_the_sentence_but_not_those_of_a_name(show):
    page = show().page
    words = "A RoboFalcon2.0 robot at 6 m/s beats 3.8 times a second and needs 112 W."
    page.evaluate(f"(({{ verdict, answer }}) => verdict.show({{ ...answer, sentence: '{words}' }}))({FACE})")
    assert page.locator(".wbx h1 b").all_inner_texts() == ["6 m/s", "3.8 times a second", "112 W"]


def test_gauges_say_in_words_where_the_number_lies(show, answers):
    page = show(fragment="#speed=12").page
    words = {one["name"]: one for one in answers["pigeon"][2]["gauges"]}
    for name, one in words.items():
        row = page.locator(f"[data-gauge={name}]")
        inside = "set by a limit" if one["limited"] else "inside"
        assert row.locator(".wbx-word").inner_text() == (inside if one["inside"] else "above")
        assert not one["given"]
        assert float(gauge(page, name).get_attribute("data-exact")) == one["value"]
    given = words["frequency"] | {"given": True, "inside": True}
    page.evaluate(f"gauge => {FACE}.gauges.show([gauge])", given)
    row = page.locator("[data-gauge=frequency]")
    assert row.locator(".wbx-word").inner_text() == "given"
    assert row.locator("p").first.text_content().startswith("Given, not predicted. Plausible: 4")
    page.evaluate(f"gauges => {FACE}.gauges.show(gauges)", list(words.values()))
    # A range that begins below 0, from -10 to 40 degrees, has its place on a bar from -20 to 80.
    band = page.locator("[data-gauge=mean_body_pitch] .wbx-band")
    ends = [band.evaluate(f"band => Number(band.style.{end}.replace(/[^0-9.]/g, ''))") for end in ("left", "right")]
    assert ends == pytest.approx([10.0, 40.0])
    row = page.locator("[data-gauge=strouhal]")
    row.locator("summary").click()
    assert "Taylor, Nudds and Thomas 2003" in row.inner_text()
    assert "0.2 to 0.4" in row.inner_text()


def test_measurements_say_their_source_on_focus(show):
    page = show().page
    page.get_by_role("button", name="Wingbeats").click()
    mark = page.locator(".wbx-measured").first
    mark.focus()
    assert "Usherwood et al. 2005" in page.locator(".wbx-curve-box > .wbx-note").inner_text()


def test_a_pinned_flight_stays_as_ghost(show, answers):
    page = show(fragment="#speed=8").page
    page.get_by_role("button", name="Pin this flight").click()
    page.get_by_role("slider", name="Speed").focus()
    page.keyboard.press("End")
    flights = page.evaluate("document.querySelector('.wb-viewer').viewer.flights.map((flight) => flight.frequency)")
    assert flights == [answers["pigeon"][3]["frequency"], answers["pigeon"][0]["frequency"]]
    assert "rock pigeon at 8 m/s" in page.locator(".wbx-pins").inner_text()
    assert page.locator(".wbx-pin").count() == 1
    page.get_by_role("button", name="Remove the comparison").click()
    assert page.evaluate("document.querySelector('.wb-viewer').viewer.flights.length") == 1


def test_a_gap_shows_no_line_and_no_number(show):
    """A curve with a speed that is not certified, handed over as the server's page does."""
    page = show().page
    page.evaluate(
        """() => {
            const { face } = document.querySelector(".wbx");
            const numbers = { power: 9, frequency: 6 };
            const point = (speed, certified) => ({ speed, ...numbers, certified, plausible: certified });
            face.showCurve({ points: [point(6, true), point(8, false), point(10, true), point(12, true)] });
            face.curve.mark(8);
        }"""
    )
    assert page.locator(".wbx-gap").count() == 1
    assert page.locator(".wbx-curve").count() == 1  # from 10 to 12 m/s
    slider = page.get_by_role("slider", name="Speed")
    assert slider.get_attribute("aria-valuetext") == "8 m/s: no certified wingbeat"


def test_arrows_that_the_folder_lacks_are_not_offered(show):
    page = show().page
    page.get_by_text("Views, forces and plots").click()
    assert page.get_by_label("resultant").is_visible()
    assert page.get_by_label("lift", exact=True).is_hidden()
    assert page.get_by_label("drag", exact=True).is_hidden()


def test_an_uncertified_flight_is_told_in_words(show, answers):
    page = show().page
    page.evaluate(
        """([answer, scene]) => {
            const lights = answer.lights.map((one) => ({ ...one, good: false, known: one.name === "closes" }));
            const face = document.querySelector(".wbx").face;
            face.showAnswer({ ...answer, lights, scene, status: "infeasible", sentence: "It has no wingbeat." });
        }""",
        [answers["pigeon"][0], None],
    )
    assert sentence(page) == "It has no wingbeat."
    lights = page.locator(".wbx-light strong").all_inner_texts()
    assert lights == ["Does not close", "Plausible? Not known"]
    assert page.locator(".wbx-picture").is_hidden()
    assert "tumbles" in page.locator(".wbx-state").inner_text()
    assert page.get_by_role("button", name="Pin this flight").is_disabled()


@pytest.mark.parametrize("width", [1440, 1024, 390])
def test_a_long_list_of_warnings_ends_at_a_whole_line(show, width):
    page = show(width=width).page
    texts = [f"Warning {nth}: {'a number lies outside its plausible range, ' * 2}of birds." for nth in range(9)]
    page.evaluate(f"texts => {FACE}.showAnswer({{ ...{FACE}.answer, warnings: texts }})", texts)
    fold = page.locator(".wbx-warnings")
    if fold.get_attribute("open") is None:
        fold.locator("summary").click()
    shown, whole, line = fold.locator("ul").evaluate(
        "it => [it.getBoundingClientRect().height, it.scrollHeight, parseFloat(getComputedStyle(it).lineHeight)]"
    )
    assert whole > shown
    assert shown / line == pytest.approx(round(shown / line), abs=0.02)


def test_on_a_phone_the_animal_is_in_the_first_screen(show):
    page = show(width=390, height=844).page
    box = page.locator(".wbx canvas").bounding_box()
    assert box["y"] + box["height"] < 844
    assert box["height"] >= 250
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


@pytest.mark.parametrize(("theme", "width"), [("light", 390), ("dark", 1280)])
def test_axe_finds_no_fault(show, theme, width):
    if not AXE.exists():
        pytest.skip("needs axe-core: npm ci in the folder viewer")
    page = show(width=width, color_scheme=theme, bypass_csp=True).page
    page.add_script_tag(content=AXE.read_text())
    found = page.evaluate("axe.run()")
    assert {fault["id"]: [node["html"] for node in fault["nodes"]] for fault in found["violations"]} == {}
    assert len(found["passes"]) > 10
