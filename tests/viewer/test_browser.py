"""The page in a real browser: what it draws, how it answers, and that it keeps to itself."""

import itertools
import time

import numpy as np
import pytest

import wingbeat as wb

VIEWER = "document.querySelector('.wb-viewer').viewer"
MIRROR = np.array([1.0, -1.0, 1.0])


def drawn(page, phase, flight=0, side="left"):
    """Stop at a phase and ask what stands there: corners (N, 4, 3) and normals (N, 4, 3)."""
    found = page.evaluate(f"(({VIEWER}).pause(), {VIEWER}.set({phase}), {VIEWER}.drawn({flight}, '{side}'))")
    return (np.array(found[name]).reshape(-1, 4, 3) for name in ("corners", "normals"))


@pytest.mark.slow
def test_what_is_drawn_are_the_corners_of_the_data_set(show, page_of_two, bats):
    page = show(page_of_two).page
    for index, (flight, orbit) in itertools.product([0, 64, 100, 192, 256], enumerate(bats.values())):
        data = orbit.dataset
        corners, normals = drawn(page, float(data["phase"][index]), flight)
        np.testing.assert_allclose(corners, data["strip_corner"].values[index], rtol=0, atol=1e-6)
        across, turned = drawn(page, float(data["phase"][index]), flight, "right")
        np.testing.assert_allclose(across, corners * MIRROR, rtol=0, atol=1e-9)
        # Mirrored normals: both wings show the light the same face.
        np.testing.assert_allclose(turned, normals * MIRROR, rtol=0, atol=1e-6)
        by_hand = np.cross(corners[:, 1] - corners[:, 0], corners[:, 3] - corners[:, 0])
        upper = by_hand / np.linalg.norm(by_hand, axis=-1, keepdims=True)
        np.testing.assert_allclose(normals[:, 0], upper, rtol=0, atol=1e-4)


@pytest.mark.slow
def test_it_plays_by_itself_and_asks_for_nothing(show, page_of_one):
    shown = show(page_of_one, reduced_motion="no-preference")
    page = shown.page
    frame, phase, playing = page.evaluate(f"[{VIEWER}.frame, {VIEWER}.phase, {VIEWER}.playing]")
    assert playing is True
    until = time.monotonic() + 60
    while page.evaluate(f"{VIEWER}.frame") <= frame + 3:
        assert time.monotonic() < until, "the frames do not advance"
        page.wait_for_timeout(50)
    assert page.evaluate(f"{VIEWER}.phase") != phase
    assert shown.requests == [page_of_one.as_uri()]
    assert shown.complaints == []


def test_who_asked_for_less_motion_finds_it_still(show, page_of_one):
    assert show(page_of_one).page.evaluate(f"{VIEWER}.playing") is False


@pytest.mark.slow
def test_controls_work_by_hand_and_by_key(show, page_of_one):
    page = show(page_of_one).page
    page.get_by_label("Play (space)").click()
    assert page.evaluate(f"{VIEWER}.playing") is True
    page.get_by_label("Pause (space)").click()
    assert page.evaluate(f"{VIEWER}.playing") is False
    slider = page.get_by_label("Phase of the beat")
    slider.fill("0.25")
    assert page.evaluate(f"{VIEWER}.phase") == 0.25
    assert "phase 0.250" in page.locator(".wb-readout").inner_text()
    page.locator(".wb-viewer").focus()
    for key, phase in (("ArrowRight", 0.26), ("Shift+ArrowLeft", 0.21), ("Home", 0.0), ("End", 1.0)):
        page.keyboard.press(key)
        assert page.evaluate(f"{VIEWER}.phase") == pytest.approx(phase)
    page.keyboard.press("4")
    assert page.get_by_role("button", name="top").get_attribute("aria-pressed") == "true"
    assert page.evaluate(f"{VIEWER}.stage.view") == "top"
    page.keyboard.press("Space")
    assert page.evaluate(f"{VIEWER}.playing") is True
    page.keyboard.press("Space")
    page.get_by_label("lift", exact=True).check()
    arrows = f"{VIEWER}.stage.animals[0].arrows.lift.group.visible"
    assert page.evaluate(arrows) is True
    page.get_by_label("Strips").select_option("strip_lift")
    assert "lift of a strip [N]" in page.locator(".wb-scale").inner_text()


@pytest.mark.slow
def test_the_cursor_of_the_plots_moves_with_the_phase_and_moves_it(show, page_of_one):
    page = show(page_of_one).page
    page.evaluate(f"({VIEWER}.pause(), {VIEWER}.set(0.5))")
    cursor = page.locator(".wb-cursor").first
    before = float(cursor.get_attribute("x1"))
    plot = page.locator(".wb-plots svg").first
    box = plot.bounding_box()
    plot.click(position={"x": box["width"] * 0.9, "y": box["height"] * 0.5})
    assert page.evaluate(f"{VIEWER}.phase") > 0.8
    assert float(cursor.get_attribute("x1")) > before


def test_arrows_are_the_loads_on_one_scale(show, page_of_one, bats):
    page = show(page_of_one).page
    data = bats["su-fan"].dataset.isel(phase=80)
    page.evaluate(f"({VIEWER}.pause(), {VIEWER}.set({float(data['phase'])}))")
    arrows = f"{VIEWER}.stage.animals[0].arrows.force.group.children"
    parts = page.evaluate(f"{arrows}.map((part) => Array.from(part.instanceMatrix.array))")
    scale = page.evaluate(f"{VIEWER}.look.scale")
    shaft, head = (np.array(part).reshape(-1, 4, 4) for part in parts)
    place = np.array([float(data["x"]), 0.0, float(data["z"])])
    root, tip = shaft[:10, 3, :3] + place, head[:10, 3, :3] + head[:10, 1, :3] + place
    np.testing.assert_allclose(root, data["strip_position"], rtol=0, atol=1e-6)
    np.testing.assert_allclose(tip - root, scale * data["strip_force"], rtol=0, atol=1e-6)


@pytest.mark.slow
def test_two_flights_stand_as_ghost_or_side_by_side(show, page_of_two):
    page = show(page_of_two).page
    page.evaluate(f"{VIEWER}.pause()")
    places = f"{VIEWER}.stage.animals.map((animal) => animal.group.position.y)"
    assert page.evaluate(places) == [0, 0]
    page.get_by_label("Two flights").select_option("beside")
    left, right = page.evaluate(places)
    assert left > 0 > right
    assert page.locator(".wb-flight-1").count() > 0


@pytest.mark.slow
def test_two_kinds_of_animal_stand_side_by_side_at_first(show, bats, tmp_path):
    pigeon = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), 10.0), starts=1)
    path = tmp_path / "two.html"
    wb.viewer.write_page([("pigeon", pigeon.dataset), ("bat", bats["su-fan"].dataset)], path)
    page = show(path).page
    assert page.get_by_label("Two flights").input_value() == "beside"
    left, right = page.evaluate(f"{VIEWER}.stage.animals.map((animal) => animal.group.position.y)")
    assert left > 0 > right
    page.get_by_label("Two flights").select_option("ghost")
    assert page.evaluate(f"{VIEWER}.stage.animals.map((animal) => animal.group.position.y)") == [0, 0]


@pytest.mark.slow
@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("width", [390, 1280])
def test_it_fits_the_window_and_keeps_to_the_theme(show, page_of_two, theme, width):
    page = show(page_of_two, width=width, color_scheme=theme).page
    assert page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
    paper = page.evaluate("getComputedStyle(document.querySelector('.wb-viewer')).backgroundColor")
    assert paper == {"light": "rgb(255, 255, 255)", "dark": "rgb(20, 24, 29)"}[theme]


def test_texts_of_files_stay_texts(show, bats, tmp_path):

    name = "</script><img src=x onerror=alert(1)>"
    wb.viewer.write_page([(name, bats["su-fan"].dataset), ("b", bats["su-fan"].dataset)], tmp_path / "page.html")
    shown = show(tmp_path / "page.html")
    assert shown.page.locator("img").count() == 0
    assert name in shown.page.locator(".wb-heading").inner_text()
    assert shown.complaints == []
