"""Push it: the flights through gusts that a page offers, and what the page shows when the reader pushes."""

import json

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.browsers import AXE, until
from wingbeat._base import InvalidInputError
from wingbeat.cli import main
from wingbeat.stability.gust_flights import DIRECTIONS, SIZES
from wingbeat.viewer.scene import scene

BEATS = 10
VIEWER = "document.querySelector('.wb-viewer').viewer"


@pytest.fixture(scope="module")
def orbit(bats):
    return bats["su-fan"]


@pytest.fixture(scope="module")
def pushes(orbit):
    return wb.fly_pushes(orbit, beats=BEATS)


def chosen(pushes, direction, size, feedback):
    (found,) = [p for p in pushes if (p.direction, p.size, p.feedback) == (direction, size, feedback)]
    return found


@pytest.fixture(scope="module")
def page_of_pushes(orbit, pushes, tmp_path_factory):
    path = tmp_path_factory.mktemp("pushes") / "bat.html"
    wb.viewer.write_page([("bat", orbit.dataset)], path, pushes)
    return path


@pytest.mark.slow
def test_there_is_a_flight_for_each_gust_with_and_without_feedback(pushes):
    assert len(pushes) == 2 * len(DIRECTIONS) * len(SIZES)
    assert len({(p.direction, p.size, p.feedback) for p in pushes}) == len(pushes)


@pytest.mark.slow
@pytest.mark.parametrize("feedback", [False, True])
def test_a_push_is_the_flight_that_simulate_flies(orbit, pushes, feedback):
    push = chosen(pushes, "downward", 1.0, feedback)
    gust = wb.winds.CosineGust(w=-1.0, duration=2 / orbit.wingbeat.frequency)
    hold = wb.feedback(orbit).controller() if feedback else None
    start, model = orbit.initial_state, orbit.problem.model
    flown = wb.simulate(model, orbit.wingbeat, start, BEATS, 64, wind=gust, controller=hold).states[::4]
    count = push.dataset.sizes["phase"]
    assert count > 16
    np.testing.assert_allclose(push.dataset["body_pitch"], flown[:count, 2], rtol=0, atol=1e-9)
    np.testing.assert_allclose(push.dataset["z"], flown[:count, 1], rtol=0, atol=1e-9)
    np.testing.assert_allclose(push.height, flown[:count, 1] - start.z, rtol=0, atol=1e-9)


@pytest.mark.slow
def test_without_feedback_the_bat_is_lost_and_with_feedback_it_flies_on_in_a_weak_gust(pushes):
    free, held = (chosen(pushes, "tail", 1.0, feedback) for feedback in (False, True))
    assert free.outcome.startswith("lost after")
    assert free.dataset.sizes["phase"] < held.dataset.sizes["phase"] == 16 * BEATS + 1
    assert np.abs(free.pitch).max() <= np.pi / 3 + 1e-9  # shown until it is lost
    assert np.abs(held.pitch).max() < np.abs(free.pitch).max()
    assert held.outcome.endswith("deg of the orbit's")


@pytest.mark.slow
def test_the_scene_holds_every_push_in_finite_numbers(orbit, pushes):
    text = json.dumps(scene([("bat", orbit.dataset)], pushes), allow_nan=False)
    assert len(json.loads(text)["pushes"]) == len(pushes)
    assert "pushes" not in scene([("bat", orbit.dataset)])


@pytest.mark.slow
def test_what_cannot_be_flown_is_refused(orbit):
    with pytest.raises(InvalidInputError, match="beats = 2: must be a whole number from 3 to 100"):
        wb.fly_pushes(orbit, beats=2)
    with pytest.raises(InvalidInputError, match="delay = 9"):
        wb.fly_pushes(orbit, 9)
    with pytest.raises(InvalidInputError, match="directions = 'left'"):
        wb.fly_pushes(orbit, None, directions=("left",))
    lost = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon").with_values({"body.mass": 3.0}), 3.0), starts=1)
    with pytest.raises(InvalidInputError, match="is not certified"):
        wb.fly_pushes(lost, None)


@pytest.mark.slow
def test_the_reader_pushes_and_goes_back(show, page_of_pushes):
    shown = show(page_of_pushes, height=900)
    page = shown.page
    page.get_by_label("Gust").select_option("tail")
    page.get_by_role("button", name="Push", exact=True).click()
    assert "lost after" in page.locator(".wb-outcome").inner_text()
    assert page.evaluate(f"{VIEWER}.last") > 1
    assert page.evaluate(f"{VIEWER}.phase") == 0
    page.evaluate(f"{VIEWER}.set({VIEWER}.last)")
    flight = f"{VIEWER}.flights[0]"
    tilt = page.evaluate(f"{flight}.arrays.pitch_away[{flight}.samples - 1]")
    assert abs(np.degrees(tilt)) > 20
    page.get_by_role("checkbox", name="feedback").check()
    page.get_by_role("button", name="Push", exact=True).click()
    assert "lost after" not in page.locator(".wb-outcome").inner_text()
    assert page.locator("svg[aria-label^='Height']").count() == 1
    page.get_by_role("button", name="Back to the orbit").click()
    assert page.evaluate(f"{VIEWER}.last") == 1
    assert page.locator(".wb-outcome").inner_text() == ""
    assert shown.complaints == []
    assert shown.requests == [page_of_pushes.as_uri()]


@pytest.mark.slow
def test_a_push_is_shown_once_and_then_stands_still(show, page_of_pushes):
    page = show(page_of_pushes, reduced_motion="no-preference").page
    page.get_by_label("Gust").select_option("tail")
    page.get_by_role("button", name="Push", exact=True).click()
    assert page.evaluate(f"{VIEWER}.playing") is True
    page.evaluate(f"{VIEWER}.set({VIEWER}.last - 1e-6)")
    until(page, f"!{VIEWER}.playing")
    assert page.evaluate(f"{VIEWER}.phase === {VIEWER}.last")
    # The next flight goes on from beat to beat.
    page.evaluate(f"{VIEWER}.replace({VIEWER}.pushes.scene)")
    assert page.evaluate(f"[{VIEWER}.once, {VIEWER}.playing]") == [False, True]


@pytest.mark.slow
def test_a_link_restores_the_push_that_is_shown(show, page_of_pushes):
    page = show(page_of_pushes, height=900).page
    page.get_by_label("Gust").select_option("downward")
    page.get_by_label("Size").select_option("3")
    page.get_by_role("checkbox", name="feedback").check()
    page.get_by_role("button", name="Push", exact=True).click()
    page.evaluate(f"{VIEWER}.set(1.5)")
    outcome = page.locator(".wb-outcome").inner_text()
    seen = f"[{VIEWER}.phase, {VIEWER}.last, {VIEWER}.flights[0].summary]"
    state = page.evaluate(f"{VIEWER}.state")
    again = show(page_of_pushes, fragment=f"#{state}", reduced_motion="no-preference").page
    assert again.evaluate(seen) == page.evaluate(seen)
    assert again.evaluate(seen)[0] == 1.5
    assert again.locator(".wb-outcome").inner_text() == outcome
    assert again.get_by_label("Gust", exact=True).input_value() == "downward"
    assert not again.evaluate(f"{VIEWER}.playing")
    # A link without a push, or with one that the page lacks, shows the orbit.
    for other in ("#wb=1&phase=0.5", "#wb=1&phase=0.25&push=sideways*1"):
        again.evaluate("state => (location.hash = state)", state)
        until(again, f"{VIEWER}.last > 1")
        again.evaluate("other => (location.hash = other)", other)
        until(again, f"{VIEWER}.last === 1")


def test_a_page_without_pushes_offers_none(show, page_of_one):
    assert show(page_of_one).page.locator(".wb-push").is_hidden()


@pytest.mark.slow
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_axe_finds_no_fault_in_the_panel(show, page_of_pushes, theme):
    if not AXE.exists():
        pytest.skip("needs axe-core: npm ci in the folder viewer")
    page = show(page_of_pushes, color_scheme=theme, bypass_csp=True).page
    page.get_by_role("button", name="Push", exact=True).click()
    page.add_script_tag(content=AXE.read_text())
    found = page.evaluate("axe.run()")
    assert {fault["id"]: [node["html"] for node in fault["nodes"]] for fault in found["violations"]} == {}


@pytest.mark.slow
def test_the_command_writes_a_page_with_pushes_and_refuses_what_makes_no_sense(orbit, tmp_path, capsys):
    saved, page = tmp_path / "bat.nc", tmp_path / "bat.html"
    orbit.save(saved)
    assert main(["view", str(saved), "--push", "-o", str(page)]) == 0
    assert '"pushes"' in page.read_text("utf-8")
    assert main(["view", str(saved), "--push", "-o", str(tmp_path / "bat.gif")]) == 2
    assert "--push" in capsys.readouterr().err
    assert main(["view", str(saved), "--delay", "1", "-o", str(page)]) == 2
    assert "add --push" in capsys.readouterr().err
