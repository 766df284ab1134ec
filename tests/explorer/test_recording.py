"""Moving pictures and warnings of the explorer's picture: they say whose flight it is, and whether it flies."""

import pytest
from PIL import Image

pytestmark = pytest.mark.slow

FACE = "document.querySelector('.wbx').face"
WARNING = "the closest wingbeat: it does not fly"
# Notes the texts that are painted into a frame, with their places.
NOTE = """() => {
    window.painted = [];
    const { fillText } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y, ...more) {
        window.painted.push([text, x, y]);
        return fillText.call(this, text, x, y, ...more);
    };
}"""


def record(page, path):
    """Save a GIF; return it with the texts of its last frame and their places."""
    page.evaluate(NOTE)
    page.get_by_text("Views, forces and plots").click()
    page.get_by_text("Share", exact=True).click()
    page.get_by_label("Width").select_option("320")
    with page.expect_download() as waiting:
        page.get_by_role("button", name="Save", exact=True).click()
    waiting.value.save_as(path)
    painted = page.evaluate("window.painted")
    last = max(nth for nth, (text, *_) in enumerate(painted[:-1]) if text.startswith("phase"))
    with Image.open(path) as picture:
        return picture.convert("RGB"), painted[last + 1 :]


def uncertified(page):
    """Show the page's answer as if it were not certified."""
    page.evaluate(f"(face => face.showAnswer({{ ...face.answer, status: 'infeasible' }}))({FACE})")


def test_a_moving_picture_says_animal_speed_and_frequency(show, orbits, tmp_path):
    page, complaints, _ = show(fragment="#animal=pigeon&model=paper&speed=12")
    picture, painted = record(page, tmp_path / "pigeon.gif")
    assert picture.width == 320
    frequency = orbits["pigeon"][2].record()["wingbeat"]["frequency"]
    text = " ".join(text for text, *_ in painted)
    assert f"pigeon at 12 m/s, su-fan, {frequency:.3g} Hz" in text
    assert WARNING not in text
    assert complaints == []


def test_lines_of_two_flights_stay_in_the_picture(show, tmp_path):
    page = show(fragment="#animal=pigeon&model=paper&speed=12").page
    page.get_by_role("button", name="Pin this flight").click()
    _, painted = record(page, tmp_path / "pigeon.gif")
    lines = [text for text, x, y in painted if x == pytest.approx(9.0) and y < 120]
    assert len(lines) > 2
    assert all(len(text) < 60 for text in lines)
    assert " ".join(lines).count("pigeon at 12 m/s, su-fan") == 2


def test_the_warning_is_a_text_of_the_page_and_of_the_moving_picture(show, tmp_path):
    page = show().page
    warning = page.get_by_text(WARNING)
    assert warning.count() == 0
    uncertified(page)
    assert warning.is_visible()
    assert WARNING in page.locator(".wbx-picture").aria_snapshot()
    ground = warning.evaluate("it => getComputedStyle(it).backgroundColor.match(/\\d+/g).map(Number)")
    picture, painted = record(page, tmp_path / "pigeon.gif")
    words = [text for text, *_ in painted]
    assert WARNING in " ".join(words)
    tops = {text: y for text, _, y in painted}
    assert tops["closest"] < next(y for text, _, y in painted if text.startswith("pigeon at"))
    # The colour behind the warning is in the picture, as far as 256 colours allow.
    corner = picture.crop((9, 6, 180, 30)).getcolors(100000)
    near = sum(n for n, colour in corner if all(abs(a - b) < 25 for a, b in zip(colour, ground, strict=True)))
    assert near > 500
    page.evaluate(f"(face => face.showAnswer({{ ...face.answer, status: 'converged' }}))({FACE})")
    assert warning.count() == 0
