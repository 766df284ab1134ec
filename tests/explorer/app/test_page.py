"""The page in a real browser: what a visitor does, and what others do meanwhile."""

import http.client
import os
import re
import signal
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import wingbeat as wb
from tests.explorer.app.page import asks_for, choose, drawer, enter, exact, solved, unfold
from tests.helpers.browsers import AXE, PATIENCE
from wingbeat.cli import main


@pytest.mark.slow
def test_a_visit(visit, capsys, tmp_path):
    page = visit()
    solved(page, "pigeon at 10 m/s, su-fan")
    closes, plausible = page.locator(".wbx-light").all()
    assert re.search("closes to ", closes.inner_text())
    assert "Not plausible" in plausible.inner_text()
    assert "wbx-bad" in plausible.get_attribute("class")
    choose(page, "Animal", "bat")
    enter(page, "Speed [m/s]", "8")
    page.get_by_role("button", name="Solve", exact=True).click()
    solved(page, "bat at 8 m/s, su-fan")
    assert main(["orbit", "bat", "--speed", "8", "--starts", "1", "--json"]) == 0
    record = capsys.readouterr().out
    assert f'"frequency": {exact(page)},' in record
    # the viewer's phase, once it has fetched what stands on the page
    flown = "(frequency) => Math.abs(wingbeatPage.face?.viewer?.flights[0].frequency - frequency) < 1e-3"
    page.wait_for_function(flown, arg=float(exact(page)))
    corners = "wingbeatPage.face.viewer.corners(0, 'left').slice(0, 6)"
    before = page.evaluate(corners)
    page.evaluate("wingbeatPage.face.viewer.set(0.25)")
    assert page.evaluate("wingbeatPage.face.viewer.phase") == 0.25
    assert not np.allclose(before, page.evaluate(corners))
    # another model, continued in place
    first = exact(page)
    choose(page, "Model", "dickinson")
    solved(page, "bat at 8 m/s, dickinson")
    assert exact(page) != first
    asks_for(page, "aero=dickinson")
    # the time series
    unfold(page, ".answer")
    with page.expect_download() as download:
        page.get_by_role("button", name="Time series (NetCDF)").click()
    path = tmp_path / "bat.nc"
    download.value.save_as(path)
    with xr.open_dataset(path, engine="h5netcdf") as dataset:
        assert dataset.attrs["species"] == "bat"
        assert f"{float(np.asarray(xr.DataArray(dataset['time'])[-1])) ** -1:.6g}" == f"{float(exact(page)):.6g}"
    # and back again, on a page that asks for something else
    page = visit()
    solved(page, "pigeon")
    page.locator(".menu input[type=file]").set_input_files(path)
    page.wait_for_function("document.querySelector('.message').textContent.includes('From the file bat.nc')")
    fields = [drawer(page).get_by_label(label, exact=True).first for label in ("Animal", "Model", "Speed [m/s]")]
    assert [field.input_value() for field in fields] == ["bat", "dickinson", "8"]
    asks_for(page, "aero=dickinson")


@pytest.mark.slow
def test_a_broken_species_file_is_refused_in_words(visit, tmp_path):
    page = visit()
    solved(page, "pigeon")
    path = tmp_path / "<img src=x onerror=alert(1)>.toml"
    path.write_text('name = "<script>alert(1)</script>"\n[vehicle.wing]\nmass = "heavy"\n')
    page.locator(".menu input[type=file]").set_input_files(path)
    trouble = page.locator(".trouble li")
    trouble.first.wait_for()
    assert "vehicle.wing.mass: must be a number; write the number without quotes" in trouble.first.inner_text()
    path.write_text(
        (Path(wb.__file__).parent / "data" / "pigeon.toml").read_text().replace('"pigeon"', '"<b>x</b>"', 1)
    )
    page.locator(".menu input[type=file]").set_input_files(path)
    solved(page, "b>")  # the name of a species is only ever shown
    path.write_text(path.read_text().replace('kind = "bird"', "", 1).replace("<b>x</b>", "kindless", 1))
    page.locator(".menu input[type=file]").set_input_files(path)
    solved(page, "kindless")
    choose(page, "Flight model", "animal")
    page.locator(".fault", has_text='write kind = "bird", "bat" or "robot" into the file of kindless').wait_for()
    assert page.locator(".what b, select b, .what script").count() == 0


@pytest.mark.slow
def test_faults_are_told_beside_their_control(visit):
    page = visit()
    solved(page, "pigeon")
    for value, words in (("fast", "is not a number"), ("400", "must be >= 0 and <= 100 m/s")):
        enter(page, "Speed [m/s]", value)
        page.locator(".fault", has_text=words).wait_for()
        assert drawer(page).get_by_label("Speed [m/s]", exact=True).first.get_attribute("aria-invalid") == "true"
    enter(page, "Speed [m/s]", "10")
    drawer(page).locator("summary", has_text="Wing").first.click()
    enter(page, "semi span [m]", "-1")
    page.locator(".fault", has_text="must be > 0 m").wait_for()
    enter(page, "semi span [m]", "0.4")
    page.locator(".odd .hint", has_text="Outside: plausible 0.25 to 0.335; changed from 0.279").wait_for()
    enter(page, "Within limits", "x" * 70_000)
    page.locator(".fault", has_text="has 70000 characters; at most 5000 are allowed").wait_for()


@pytest.mark.slow
def test_what_is_typed_and_chosen_stays_while_answers_come(visit):
    page = visit()
    solved(page, "pigeon")
    choose(page, "Model", "dickinson")
    field = drawer(page).get_by_label("Climb [m/s]", exact=True)
    field.fill("0.5")  # not entered yet
    solved(page, "dickinson")
    assert drawer(page).get_by_label("Model", exact=True).input_value() == "dickinson"
    assert field.input_value() == "0.5"


@pytest.mark.slow
def test_a_curve_fills_in_and_can_be_cancelled(visit):
    page = visit("species=pigeon&speed=10&starts=1&sweep=9:11:1")
    solved(page, "pigeon")
    unfold(page, ".curve")
    page.get_by_role("button", name="Compute the curve").click()
    page.locator(".curve .note", has_text=re.compile("3 speeds certified.* from every start")).wait_for()
    page.wait_for_function("document.querySelectorAll('.wbx-dot').length === 3")
    step = page.locator(".curve").get_by_label("step [m/s]", exact=True)
    step.fill("0.05")
    step.press("Tab")
    page.get_by_role("button", name="Compute the curve").click()
    page.locator(".curve tbody tr").nth(1).wait_for()
    page.get_by_role("button", name="Cancel the curve").click()
    page.locator(".curve .note", has_text="Cancelled after").wait_for()


@pytest.mark.slow
def test_answers_are_pinned_and_fly_as_ghosts(visit):
    page = visit()
    solved(page, "su-fan")
    page.get_by_role("button", name="Pin", exact=True).click()
    choose(page, "Model", "dickinson")
    solved(page, "dickinson")
    page.get_by_role("button", name=re.compile("Show as ghost")).click()
    page.wait_for_function("wingbeatPage.face.viewer.flights.length === 2")
    page.get_by_role("button", name=re.compile("Restore")).click()
    solved(page, "su-fan")


@pytest.mark.slow
def test_a_slider_is_answered_by_continuing_and_then_by_a_whole_search(visit, monkeypatch):
    page = visit()
    solved(page, "pigeon at 10 m/s")
    slide = """(speed) => {
        const slider = document.querySelector('input.slider');
        slider.value = speed;
        slider.dispatchEvent(new Event('input', { bubbles: true }));
    }"""
    for calm in ("_CALM", "_LONGEST_CALM"):  # the whole search waits until the page was read
        monkeypatch.setattr(f"wingbeat_explorer.app.session.{calm}", 1e6)
    page.evaluate(slide, 10.3)
    page.locator(".message", has_text="Continued from the previous result, with one start.").wait_for()
    assert "pigeon at 10.3 m/s" in page.locator(".what").inner_text()
    assert "now solving from every start" in page.locator(".state").inner_text()
    monkeypatch.undo()
    page.evaluate(slide, 10.4)
    solved(page, "pigeon at 10.4 m/s")
    assert "Continued" not in page.locator(".message").inner_text()
    assert float(page.locator(".what").get_attribute("data-solver-seconds")) > 0


GREY = """(place) => {
    const shades = [];
    for (let at = document.querySelector(place); at; at = at.parentElement) {
        shades.push(getComputedStyle(at).filter);
    }
    return shades.every((each) => each === 'none') ? 0 : shades.includes('grayscale(1)') ? 1 : 0.5;
}"""
PLACES = (".wbx-sentence", ".wbx-lights", ".wbx-gauges", ".tiles", ".answer .groups", ".influence .acts")
EARLIER = "This result belongs to an earlier request."


def dims(page, place=".wbx-lights"):
    page.wait_for_function(f"({GREY})({place!r}) === 1")


def is_bright(page, place=".wbx-lights"):
    page.wait_for_function(f"({GREY})({place!r}) === 0")


@pytest.mark.slow
def test_an_answer_is_dimmed_while_another_question_is_solved(visit, served):
    page = visit("species=pigeon&speed=10&starts=1&sweep=9:10:1")
    solved(page, "pigeon")
    unfold(page, ".curve")
    page.get_by_role("button", name="Compute the curve").click()
    page.locator(".curve .note", has_text=re.compile("2 speeds certified.* from every start")).wait_for()
    for place in (*PLACES, ".curve table"):
        is_bright(page, place)
    assert not page.get_by_text(EARLIER).is_visible()
    held = served.house.pool.workers
    for worker in held:
        os.kill(worker, signal.SIGSTOP)  # nothing is solved until it was looked at
    try:
        choose(page, "Model", "dickinson")
        for place in (*PLACES, ".curve table"):
            dims(page, place)
        page.get_by_text(EARLIER).wait_for()
        page.get_by_text("These results belong to an earlier request.").wait_for()
        assert "su-fan" in page.locator(".what").inner_text()
    finally:
        for worker in held:
            os.kill(worker, signal.SIGCONT)
    solved(page, "dickinson")
    is_bright(page)
    page.locator(".curve caption", has_text="dickinson").wait_for()  # a curve of the new answer takes its place
    is_bright(page, ".curve table")
    assert not page.get_by_text(EARLIER).is_visible()


@pytest.mark.slow
def test_an_answer_is_dimmed_while_the_form_says_something_else(visit):
    page = visit()
    solved(page, "pigeon")
    field = drawer(page).get_by_label("Speed [m/s]", exact=True).first
    field.fill("11")  # not entered yet
    dims(page)
    page.get_by_text(EARLIER).wait_for()
    field.fill("10")
    field.press("Tab")
    is_bright(page)
    enter(page, "Speed [m/s]", "fast")
    page.locator(".fault", has_text="is not a number").wait_for()
    dims(page)
    enter(page, "Speed [m/s]", "400")
    page.locator(".fault", has_text="must be >= 0 and <= 100 m/s").wait_for()
    dims(page)
    enter(page, "Speed [m/s]", "10")
    solved(page, "pigeon at 10 m/s")
    is_bright(page)


@pytest.mark.slow
def test_what_cannot_fly_says_why_and_what_would(visit):
    page = visit("species=pigeon&speed=10&starts=1&bound=frequency:1.0:3.0")
    page.locator(".wbx-light", has_text="Does not close").wait_for(timeout=2 * PATIENCE)
    assert "thrust is short of drag by" in page.locator(".message").inner_text()
    assert "has no wingbeat that closes" in page.locator(".wbx-sentence").inner_text()
    rows = unfold(page, ".answer").inner_text()
    assert "smallest single changes that give an orbit" in rows
    assert "upper bound of frequency 3 -> 9.7 Hz" in rows


@pytest.mark.slow
def test_eight_visitors_at_once_and_a_solver_that_dies(visit, served):
    pages = [
        visit(f"species=pigeon&speed={9 + 0.25 * i}&starts=1", viewport={"width": 400, "height": 500})
        for i in range(8)
    ]
    for i, page in enumerate(pages):
        solved(page, f"pigeon at {9 + 0.25 * i:g} m/s")
    assert len(served.house.pages) >= 8
    before = set(served.house.pool.workers)
    patient = visit("species=pigeon&speed=9&minimise=peak_power&starts=100")  # takes long
    patient.locator(".state", has_text="starts").wait_for()
    for pid in before:
        os.kill(pid, signal.SIGKILL)
    patient.locator(".trouble", has_text="The solver process ended").wait_for()
    enter(patient, "Starts", "1")
    solved(patient, "pigeon")
    assert not before & set(served.house.pool.workers)


# What axe itself fetches draws the bar of the page's framework.
LOADED = """() => [...document.querySelectorAll('.q-loading-bar')]
    .every((bar) => getComputedStyle(bar).opacity === '0' || getComputedStyle(bar).display === 'none')"""
OUT_OF_REACH = """() => [...document.querySelectorAll('input, select, button')]
    .filter((e) => e.offsetParent)
    .filter((e) => e.tabIndex < 0 || !(e.labels?.length || e.ariaLabel || e.textContent.trim()))
    .map((e) => e.outerHTML)"""


@pytest.mark.slow
@pytest.mark.parametrize("width", [390, 1280])
def test_every_control_is_reached_by_the_keyboard_and_axe_finds_no_serious_fault(visit, width):
    window = {"width": width, "height": 844}
    page = visit(
        "species=pigeon&speed=10&starts=1&sweep=9:11:1", viewport=window, color_scheme="light", bypass_csp=True
    )
    solved(page, "pigeon")
    page.locator(".wbx-dot").nth(2).wait_for()  # what axe looks at stays
    page.get_by_role("button", name="Pin", exact=True).click()
    assert page.evaluate(OUT_OF_REACH) == []
    drawer(page)
    for fold in page.locator(".expert summary").all()[1:]:
        fold.click()
    assert page.evaluate(OUT_OF_REACH) == []
    page.locator(".drawer > summary").click()  # it lies over what is opened next
    for fold in page.locator(".face summary, .below summary").all():
        if fold.is_visible():
            fold.click()
    unfold(page, ".menu")
    assert page.evaluate(OUT_OF_REACH) == []
    unfold(page, ".drawer")
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    assert page.evaluate("document.documentElement.lang") == "en-US"
    if not AXE.exists():
        pytest.skip("needs axe-core: npm ci in the folder viewer")
    page.add_script_tag(content=AXE.read_text())
    ground = "getComputedStyle(document.body).backgroundColor"
    light = page.evaluate(ground)
    for theme in ("light", "dark"):  # which the page follows as its visitor switches
        page.emulate_media(color_scheme=theme, reduced_motion="reduce")
        page.wait_for_function(f"({ground} === '{light}') === ('{theme}' === 'light')")
        page.wait_for_function(LOADED)
        found = page.evaluate("axe.run()")
        grave = [fault for fault in found["violations"] if fault["impact"] in ("serious", "critical")]
        assert {fault["id"]: [node["html"] for node in fault["nodes"]] for fault in grave} == {}, theme
        assert len(found["passes"]) > 20, theme


@pytest.mark.slow
def test_a_link_that_cannot_be_says_so(visit):
    page = visit("species=dodo")
    solved(page, "pigeon")  # what it falls back to, and says so until something else is asked
    trouble = page.locator(".trouble", has_text="is not a known choice")
    trouble.wait_for()
    enter(page, "Speed [m/s]", "11")
    trouble.wait_for(state="hidden")


@pytest.mark.slow
def test_a_large_upload_is_cut_off(visit, served):
    page = visit()
    solved(page, "pigeon")
    name = next(reversed(served.house.pages))
    for told in (True, False):  # its size, or in pieces
        is_cut_off(served, name, told)


def is_cut_off(served, name, told):
    most, sent = 100_000_000, 0

    def pieces():
        nonlocal sent
        for _ in range(most // 100_000):
            sent += 100_000
            yield b"x" * 100_000

    host, port = served.address.removeprefix("http://").split(":")
    line = http.client.HTTPConnection(host, int(port), timeout=60)
    headers = {"content-length": str(most)} if told else {}
    try:
        path = f"/wingbeat/upload/{name}?name=../../x.nc"
        line.request("POST", path, body=pieces(), headers=headers, encode_chunked=not told)
    except (BrokenPipeError, ConnectionResetError):  # the server has heard enough
        assert sent < most
    else:
        answer = line.getresponse()
        assert answer.status == 413
        assert b"x.nc was refused: a file may have at most 5 million bytes" in answer.read()
    line.close()
    assert os.listdir(served.house.folder.name) == []
