"""Share: a link that shows the same again, one file, moving pictures and a frame, all made in the browser."""

import html.parser
import re

import numpy as np
import pytest
from PIL import Image, ImageSequence

from tests.helpers.browsers import until

VIEWER = "document.querySelector('.wb-viewer').viewer"
NO_CLIPBOARD = "Object.defineProperty(navigator, 'clipboard', { value: undefined })"
EYE = f"{VIEWER}.stage.camera.position.clone().sub({VIEWER}.stage.controls.target).toArray()"
SEEN = f"""(() => {{
  const {{ phase, stage, look, plots }} = {VIEWER};
  return [phase, stage.view, look.strips && look.colour, look.trails, plots.choices, plots.range];
}})()"""


def arranged(shown):
    """Choose a phase, a camera, colours and plots, and open the menu."""
    page = shown.page
    page.get_by_label("Strips").select_option("strip_lift")
    page.get_by_label("trails").uncheck()
    page.get_by_label("Plot 2 against").select_option("flap")
    page.evaluate(f"({VIEWER}.plots.zoom([0.1, 0.6]), {VIEWER}.setCamera('side'), {VIEWER}.set(0.375))")
    canvas = page.locator(".wb-canvas").bounding_box()
    x, y = canvas["x"] + canvas["width"] / 2, canvas["y"] + canvas["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y + 20, steps=3)
    page.mouse.up()
    page.get_by_text("Share", exact=True).click()
    until(page, "document.querySelector('.wb-share input').value !== ''")
    return page


def saved(page, path, button="Save"):
    with page.expect_download() as waiting:
        page.get_by_role("button", name=button, exact=True).click()
    waiting.value.save_as(path)
    return path


def told(page, pattern):
    until(page, "document.querySelector('.wb-told').textContent !== ''")
    found = re.fullmatch(pattern, page.locator(".wb-told").inner_text())
    assert found, page.locator(".wb-told").inner_text()
    return found.groups()


@pytest.mark.slow
def test_the_link_restores_phase_camera_and_choices(show, page_of_one):
    page = arranged(show(page_of_one))
    link = page.get_by_label("Link to what is shown").input_value()
    address, fragment = link.split("#")
    assert address == page_of_one.as_uri()
    eye = page.evaluate(EYE)
    again = show(page_of_one, fragment=f"#{fragment}", width=1200, height=800)
    assert again.page.evaluate(SEEN) == page.evaluate(SEEN)
    assert again.page.evaluate(SEEN)[:4] == [0.375, "side", "strip_lift", False]
    np.testing.assert_allclose(again.page.evaluate(EYE), eye, rtol=1e-3, atol=1e-4)
    assert again.complaints == []
    # The same page follows another link, and what that one leaves out is as at the start.
    again.page.evaluate("location.hash = '#wb=1&phase=0.5&camera=top'")
    until(again.page, f"{VIEWER}.phase === 0.5")
    phase, camera, colour, trails, choices, zoom = again.page.evaluate(SEEN)
    assert (phase, camera, colour, trails, zoom) == (0.5, "top", False, True, [0, 1])
    assert {choice["x"] for choice in choices} == {"phase"}


@pytest.mark.slow
@pytest.mark.parametrize(
    "fragment",
    [
        "#a-heading",
        "#wb=1&phase=x&eye=1,2&camera=constructor&plots=none~phase*~&zoom=3,1&set.strips=x",
        "#wb=1&phase=99",
    ],
)
def test_a_fragment_that_makes_no_sense_changes_nothing_that_matters(show, page_of_one, fragment):
    shown = show(page_of_one, fragment=fragment)
    phase, camera, colour, _, choices, zoom = shown.page.evaluate(SEEN)
    assert (phase, camera, colour, zoom) == (1 if "99" in fragment else 0, "oblique", False, [0, 1])
    assert len(choices) == 4
    assert shown.complaints == []


@pytest.mark.slow
def test_the_link_can_be_copied_or_is_selected(show, page_of_one):
    page = arranged(show(page_of_one, permissions=["clipboard-read", "clipboard-write"]))
    page.get_by_role("button", name="Copy link").click()
    told(page, r"Copied the link\.")
    assert (
        page.evaluate("navigator.clipboard.readText()") == page.get_by_label("Link to what is shown").input_value()
    )
    page.evaluate(NO_CLIPBOARD)
    page.get_by_role("button", name="Copy link").click()
    page.get_by_text("press Ctrl+C").wait_for()
    field = page.get_by_label("Link to what is shown")
    assert field.evaluate("it => it.selectionEnd - it.selectionStart === it.value.length")


@pytest.mark.slow
def test_the_frame_is_an_iframe_that_loads_late(show, page_of_one):
    page = arranged(show(page_of_one))
    tags = []
    parser = html.parser.HTMLParser()
    parser.handle_starttag = lambda tag, attrs: tags.append((tag, dict(attrs)))
    parser.feed(page.get_by_label("Code that shows this page in another").input_value())
    ((tag, attributes),) = tags
    assert tag == "iframe"
    assert attributes["src"].startswith("bat.html#wb=1&phase=0.375")
    assert (attributes["title"], attributes["loading"]) == ("Flight of bat", "lazy")
    assert int(attributes["width"]) > int(attributes["height"]) > 0


@pytest.mark.slow
def test_the_saved_page_flies_offline_as_it_was_shown(show, page_of_one, tmp_path):
    first = show(page_of_one)
    page = arranged(first)
    path = saved(page, tmp_path / "again.html", "Save this page")
    again = show(path)
    assert again.page.evaluate(SEEN) == page.evaluate(SEEN)
    assert again.page.locator(".wb-viewer").count() == 1
    assert again.requests == [path.as_uri()]
    assert again.complaints == first.complaints == []
    assert "default-src 'none'" in path.read_text("utf-8")


@pytest.mark.slow
def test_the_gif_has_the_frames_and_the_width_asked_for(show, page_of_one, tmp_path):
    shown = show(page_of_one)
    page = arranged(shown)
    page.get_by_label("Width").select_option("320")
    bar = page.get_by_label("Progress of the moving picture")
    assert bar.is_hidden()
    page.wait_for_timeout(1000)
    until(page, f"{VIEWER}.stage.due === undefined")
    until(page, f"!{VIEWER}.stage.sharpness.inSoftware || {VIEWER}.stage.renderer.getPixelRatio() === 2")
    pixels = page.evaluate(f"{VIEWER}.canvas.width")
    path = saved(page, tmp_path / "bat.gif")
    width, height, frames = told(page, r"Saved bat\.gif: (\d+) x (\d+) pixels, (\d+) frames, [\d.]+ [kM]B\.")
    with Image.open(path) as picture:
        assert (picture.width, picture.height) == (320, int(height))
        assert width == "320"
        assert picture.info["loop"] == 0
        shots = [np.asarray(frame.convert("RGB"), dtype=float) for frame in ImageSequence.Iterator(picture)]
        seconds = sum(frame.info["duration"] for frame in ImageSequence.Iterator(picture)) / 1000
    assert len(shots) == int(frames)
    quarter = len(shots) // 4
    for nth in range(3):
        assert np.abs(shots[nth * quarter] - shots[(nth + 1) * quarter]).max(axis=-1).astype(bool).mean() > 0.01
    beat = 1 / page.evaluate(f"{VIEWER}.flights[0].frequency * {VIEWER}.rate")
    assert seconds == pytest.approx(beat, rel=0.3)  # a GIF counts in hundredths of a second
    assert page.evaluate(f"{VIEWER}.phase") == 0.375
    until(page, f"{VIEWER}.canvas.width === {pixels}")  # sharp again, once it stands
    assert bar.is_hidden()
    assert shown.complaints == []
    assert all(address.startswith(("file:", "blob:")) for address in shown.requests)


@pytest.mark.slow
def test_the_gif_can_be_stopped(show, page_of_one):
    page = arranged(show(page_of_one))
    page.get_by_label("Width").select_option("960")
    page.get_by_role("button", name="Save", exact=True).click()
    page.get_by_role("button", name="Stop", exact=True).click()
    told(page, r"Stopped\.")
    assert page.evaluate(f"{VIEWER}.phase") == 0.375


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["WebM", "MP4"])
def test_a_video_is_recorded_where_the_browser_can(show, page_of_one, tmp_path, kind):
    page = arranged(show(page_of_one))
    able = page.get_by_label("Format").locator("option").all_inner_texts()
    if kind not in able:
        pytest.skip(f"this browser records {' and '.join(able[1:]) or 'no video'}, not {kind}")
    page.get_by_label("Format").select_option(kind)
    page.get_by_label("Width").select_option("320")
    path = saved(page, tmp_path / "film")
    start = path.read_bytes()[:12]
    assert start.startswith(b"\x1a\x45\xdf\xa3") if kind == "WebM" else start[4:8] == b"ftyp"
    assert path.stat().st_size > 5000


def test_a_browser_without_a_recorder_says_so(show, page_of_one, tmp_path):
    path = tmp_path / "old.html"
    text = page_of_one.read_text("utf-8")
    path.write_text(text.replace("<main>", "<script>delete window.MediaRecorder;</script><main>"), "utf-8")
    page = show(path).page
    page.get_by_text("Share", exact=True).click()
    assert page.get_by_label("Format").locator("option").all_inner_texts() == ["GIF"]
    assert "cannot record a canvas" in page.locator(".wb-share").inner_text()
