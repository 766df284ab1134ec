"""The plots: their values are the data set's, and the reader chooses, zooms and copies them by hand and by key."""

import csv
import io

import numpy as np
import pytest
from PIL import Image

from tests.helpers.browsers import AXE, until
from wingbeat._base.datasets import at_station

VIEWER = "document.querySelector('.wb-viewer').viewer"
PLOTS = f"{VIEWER}.plots"
NO_CLIPBOARD = "Object.defineProperty(navigator, 'clipboard', { value: undefined })"
AXIS = 0.93  # of a plot's height: the ticks of the phase


def drawn_curve(page, card, line=".wb-curve"):
    """Return what a plot draws as one line, in the units of its axes, shape (K, 2)."""
    return np.array(
        page.evaluate(
            f"""([card, line]) => {{
              const {{ axes }} = {PLOTS}.cards[card];
              const points = axes.curves.querySelector(line).getAttribute("points").split(" ");
              const back = (at, [low, high], [from, to]) => low + ((at - from) / (to - from)) * (high - low);
              return points.map((point) => point.split(",").map(Number)).map(([x, y]) => [
                back(x, axes.across, axes.across.map((end) => axes.x(end))),
                back(y, axes.along, axes.along.map((end) => axes.y(end))),
              ]);
            }}""",
            [card, line],
        )
    )


def downloaded(page, button):
    with page.expect_download() as waiting:
        page.get_by_role("button", name=button).click()
    return waiting.value


def zoomed(page):
    return page.evaluate(f"{PLOTS}.range")


def test_curves_and_readouts_are_the_data_set(show, page_of_two, bats):
    page = show(page_of_two).page
    page.evaluate(f"{VIEWER}.set(0.25)")
    both = [orbit.dataset for orbit in bats.values()]
    for nth, one in enumerate(both):
        curve = drawn_curve(page, 2, f".wb-flight-{nth}")
        power = one["hinge_power"].values
        np.testing.assert_allclose(curve[:, 0], one["phase"], rtol=0, atol=1e-4)
        np.testing.assert_allclose(curve[:, 1], power, rtol=0, atol=1e-3 * np.ptp(power))
    at = [float(one["hinge_power"].interp(phase=0.25)) for one in both]
    told = page.locator(".wb-card").nth(2).locator(".wb-value").first.inner_text()
    assert [float(each) for each in told.removesuffix(" W").split(" | ")] == pytest.approx(at, rel=5e-3)
    alpha = np.degrees(at_station(both[0]["alpha"].values, 0.25))
    np.testing.assert_allclose(drawn_curve(page, 1)[:, 1], alpha, rtol=0, atol=1e-3 * 180)


@pytest.mark.slow
def test_the_reader_chooses_curves_and_only_of_one_unit_together(show, page_of_one, bats):
    page = show(page_of_one).page
    page.get_by_label("Second curve of plot 3").select_option("aerodynamic_power")
    power = bats["su-fan"].dataset["aerodynamic_power"].values
    curve = drawn_curve(page, 2, ".wb-curve-1")
    np.testing.assert_allclose(curve[:, 1], power, rtol=0, atol=1e-3 * np.ptp(power))
    units = (
        page.get_by_label("Curve 2 of plot 3")
        .locator("optgroup")
        .evaluate_all("all => all.map((one) => one.label)")
    )
    assert units == ["[W]"]
    page.get_by_label("Curve 1 of plot 3").select_option("flap_rate")
    assert page.evaluate(f"{PLOTS}.cards[2].choice.ys") == ["flap_rate"]
    assert page.locator(".wb-card").nth(2).locator(".wb-unit").first.text_content() == "[deg/s]"
    page.get_by_role("button", name="Add a plot").click()
    assert page.locator(".wb-card").count() == 5
    for _ in range(4):
        page.get_by_label("Remove plot 1").click()
    assert page.get_by_label("Remove plot 1").is_hidden()


@pytest.mark.slow
def test_a_phase_portrait_is_the_data_set_one_closed_loop_with_its_downstroke(show, page_of_one, bats):
    page = show(page_of_one).page
    page.get_by_label("Curve 1 of plot 3").select_option("hinge_power")
    page.get_by_label("Plot 3 against").select_option("flap")
    data = bats["su-fan"].dataset
    expected = np.stack([np.degrees(data["flap"].values), data["hinge_power"].values], axis=-1)
    tolerance = 1e-3 * np.ptp(expected, axis=0)
    assert np.all(np.abs(drawn_curve(page, 2, "polygon") - expected) < tolerance)  # a polygon is closed
    down = data["phase"].values <= 0.5
    assert np.all(np.abs(drawn_curve(page, 2, ".wb-thick") - expected[down]) < tolerance)
    page.evaluate(f"{VIEWER}.set({float(data['phase'][80])})")
    card = page.locator(".wb-card").nth(2)
    told = card.locator(".wb-value").all_inner_texts()
    assert [each.split()[1] for each in told] == ["W", "deg"]
    assert [float(each.split()[0]) for each in told] == pytest.approx(expected[80, ::-1], rel=5e-3)
    # Pointing at the loop moves the flight there.
    dot = card.locator(".wb-dot").bounding_box()
    page.evaluate(f"{VIEWER}.set(0)")
    page.mouse.click(dot["x"] + dot["width"] / 2, dot["y"] + dot["height"] / 2)
    assert page.evaluate(f"{VIEWER}.phase") == pytest.approx(float(data["phase"][80]), abs=0.03)
    # What does not come back to its start is an open line.
    page.get_by_label("Plot 3 against").select_option("x")
    assert card.locator("polygon").count() == 0


@pytest.mark.slow
def test_zoom_by_drag_wheel_and_key(show, page_of_one):
    page = show(page_of_one, height=900).page
    plot = page.locator(".wb-plot").first
    box = plot.bounding_box()
    foot = box["y"] + AXIS * box["height"]
    page.mouse.move(box["x"] + 0.4 * box["width"], foot)
    page.mouse.down()
    page.mouse.move(box["x"] + 0.7 * box["width"], foot, steps=4)
    page.mouse.up()
    from_, to = zoomed(page)
    # The axis itself begins and ends at 46 and 310 of 320.
    assert [from_, to] == pytest.approx([(share * 320 - 46) / 264 for share in (0.4, 0.7)], abs=0.01)
    curve = drawn_curve(page, 3)
    assert curve[0, 0] <= from_ < to <= curve[-1, 0]
    assert curve[0, 0] > from_ - 0.01
    plot.dblclick(position={"x": 0.5 * box["width"], "y": 0.5 * box["height"]})
    assert zoomed(page) == [0, 1]
    page.mouse.wheel(0, -300)  # the plot has been clicked, so that it has the wheel
    until(page, f"{PLOTS}.range[1] - {PLOTS}.range[0] < 0.9")
    plot.focus()
    page.keyboard.press("0")
    assert zoomed(page) == [0, 1]
    page.evaluate(f"{VIEWER}.set(0.5)")
    page.keyboard.press("+")
    assert zoomed(page) == pytest.approx([0.15, 0.85])
    page.keyboard.press("]")
    assert zoomed(page) == pytest.approx([0.29, 0.99])
    page.keyboard.press("[")
    page.keyboard.press("-")
    assert zoomed(page) == pytest.approx([0, 1])
    # Its other keys are the viewer's.
    page.keyboard.press("ArrowRight")
    assert page.evaluate(f"{VIEWER}.phase") == pytest.approx(0.51)


def test_the_csv_is_the_data_set(show, page_of_two, bats, tmp_path):
    page = show(page_of_two).page
    page.evaluate(NO_CLIPBOARD)
    file = downloaded(page, "Copy plot 4 as CSV")
    assert file.suggested_filename == "su-fan-body_pitch.csv".replace("_", "-")
    file.save_as(tmp_path / "plot.csv")
    rows = list(csv.reader((tmp_path / "plot.csv").read_text("utf-8").splitlines()))
    assert rows[0] == ["flight", "phase [-]", "time [s]", "body pitch, nose up [deg]"]
    for name, orbit in bats.items():
        found = np.array([[float(cell) for cell in row[1:]] for row in rows[1:] if row[0] == name])
        data = orbit.dataset
        expected = [data["phase"], data["time"], np.degrees(data["body_pitch"])]
        np.testing.assert_allclose(found, np.stack(expected, axis=-1), rtol=1e-6, atol=1e-6)


@pytest.mark.slow
def test_copies_go_to_the_clipboard_where_the_browser_allows_it(show, page_of_one):
    shown = show(page_of_one, permissions=["clipboard-read", "clipboard-write"])
    page = shown.page
    page.get_by_label("Copy plot 3 as CSV").click()
    page.get_by_text("Copied 257 rows as CSV.").wait_for()
    text = page.evaluate("navigator.clipboard.readText()")
    assert text.startswith('phase [-],time [s],"hinge power, both wings [W]"\n')
    page.get_by_label("Copy plot 3 as PNG picture").click()
    page.get_by_text("Copied the plot as a picture.").wait_for()
    assert page.evaluate("navigator.clipboard.read().then((all) => all[0].types)") == ["image/png"]
    assert shown.requests[0] == page_of_one.as_uri()
    assert all(address.startswith("data:image/svg") for address in shown.requests[1:])


@pytest.mark.slow
@pytest.mark.parametrize(("theme", "paper"), [("light", (255, 255, 255)), ("dark", (20, 24, 29))])
def test_the_picture_shows_the_plot_in_the_theme(show, page_of_one, tmp_path, theme, paper):
    page = show(page_of_one, color_scheme=theme).page
    page.evaluate(NO_CLIPBOARD)
    downloaded(page, "Copy plot 1 as PNG picture").save_as(tmp_path / "plot.png")
    picture = Image.open(io.BytesIO((tmp_path / "plot.png").read_bytes())).convert("RGB")
    assert picture.width == 1280
    assert picture.getpixel((2, 2)) == paper
    colours = {colour: count for count, colour in picture.getcolors(1 << 20) or []}
    curve = {"light": (0, 114, 178), "dark": (86, 180, 233)}[theme]
    assert colours[curve] > 1000


NOTE_PICTURES = """() => {
    const own = Object.getOwnPropertyDescriptor(HTMLImageElement.prototype, "src");
    const set = function (address) { own.set.call(this, (window.copied = address)); };
    Object.defineProperty(HTMLImageElement.prototype, "src", { ...own, set });
}"""
# How the copy of a plot is drawn where no style sheet of the page reaches it, and how the page draws the plot.
BOTH_DRAWN = """(address) => {
    const looks = ["fill", "fill-opacity", "opacity", "visibility", "stroke", "stroke-opacity", "stroke-width"];
    looks.push("stroke-dasharray", "stroke-linecap", "stroke-linejoin", "font-size", "font-weight");
    const text = decodeURIComponent(address.slice(address.indexOf(",") + 1));
    const host = document.body.appendChild(document.createElement("div"));
    const place = host.attachShadow({ mode: "open" });
    place.append(document.importNode(new DOMParser().parseFromString(text, "image/svg+xml").documentElement, true));
    const plot = document.querySelectorAll(".wb-card")[2];
    return [plot, place].flatMap((root) =>
        [".wb-curve", ".wb-thick", ".wb-start", ".wb-grid", ".wb-zero", ".wb-tick"].map((name) => {
            const style = getComputedStyle(root.querySelector(name));
            return looks.map((look) => `${name} ${look}: ${style.getPropertyValue(look)}`);
        }),
    );
}"""


@pytest.mark.slow
def test_a_copied_plot_looks_as_the_drawn_one(show, page_of_one):
    page = show(page_of_one).page
    page.evaluate(NO_CLIPBOARD)
    page.evaluate(NOTE_PICTURES)
    page.get_by_label("Plot 3 against").select_option("flap")
    downloaded(page, "Copy plot 3 as PNG picture")
    both = page.evaluate(BOTH_DRAWN, page.evaluate("window.copied"))
    drawn, copied = both[: len(both) // 2], both[len(both) // 2 :]
    assert copied == drawn
    assert ".wb-thick opacity: 0.4" in drawn[1]
    assert ".wb-thick stroke-linecap: round" in drawn[1]


@pytest.mark.slow
def test_plots_keep_their_choices_with_another_flight(show, page_of_one, page_of_two):
    page = show(page_of_two).page
    page.get_by_label("Curve 1 of plot 4").select_option("flap")
    page.evaluate(f"{PLOTS}.zoom([0.2, 0.7])")
    scene = page_of_one.read_text("utf-8").split("data-wingbeat-scene>")[1].split("</script>")[0]
    page.evaluate(f"(scene) => {VIEWER}.replace(JSON.parse(scene))", scene)
    assert page.evaluate(f"{PLOTS}.cards[3].choice.ys") == ["flap"]
    assert zoomed(page) == [0.2, 0.7]
    assert page.locator(".wb-flight-1").count() == 0


@pytest.mark.slow
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_axe_finds_no_fault_in_a_portrait(show, page_of_two, theme):
    if not AXE.exists():
        pytest.skip("needs axe-core: npm ci in the folder viewer")
    page = show(page_of_two, width=390, color_scheme=theme, bypass_csp=True).page
    page.get_by_label("Plot 3 against").select_option("flap")
    page.get_by_text("Share", exact=True).click()
    assert page.evaluate("document.documentElement.scrollWidth <= window.innerWidth")
    page.add_script_tag(content=AXE.read_text())
    found = page.evaluate("axe.run()")
    assert {fault["id"]: [node["html"] for node in fault["nodes"]] for fault in found["violations"]} == {}
