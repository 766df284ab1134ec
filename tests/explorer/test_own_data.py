"""The reader's own files: flights behind the curve, wingbeats in the plots, and faults in plain words."""

import itertools
import math

import pytest

import wingbeat as wb
from tests.helpers.browsers import AXE, DROP
from tests.helpers.places import ROOT
from wingbeat_explorer import measured_points

pytestmark = pytest.mark.slow

FACE = "document.querySelector('.wbx').face"
EXAMPLE = ROOT / "examples" / "pigeon_flights.csv"
FLIGHTS = "Speed [m/s],Power (W),sd,who\n8,41,3,bird A\n10,38.5,,\n13,52,4,bird B\n"


def give(page, *files):
    """Choose files, each a name and a text, and wait until the page has answered."""
    answered = "() => document.querySelectorAll('.wbx-own-list li, .wbx-own-state > *').length"
    before = page.evaluate(answered)
    payloads = [{"name": name, "mimeType": "text/csv", "buffer": text.encode()} for name, text in files]
    page.get_by_label("Choose a file").set_input_files(payloads)
    page.wait_for_function(f"before => ({answered})() !== before", arg=before)


def state(page):
    return page.locator(".wbx-own-state").inner_text()


def listed(page):
    return page.locator(".wbx-own-list li").all_inner_texts()


def test_measured_flights_lie_where_the_axes_put_them(show):
    page, complaints, requests = show()
    asked = len(requests)
    give(page, ("mine.csv", FLIGHTS))
    assert [text.split("\n")[0] for text in listed(page)] == ["mine.csv: 3 points behind the curve"]
    places = page.locator(".wbx-own-mark").evaluate_all("marks => marks.map((mark) => mark.getAttribute('d'))")
    wanted = page.evaluate(
        f"[[8, 41], [10, 38.5], [13, 52]].map(([u, p]) => [{FACE}.curve.scale.x(u), {FACE}.curve.scale.y(p)])"
    )
    for path, (x, y) in zip(places, wanted, strict=True):
        left, top = (float(part) for part in path[1:].split("l")[0].split(" "))
        assert (left, top + 5) == pytest.approx((x, y), abs=1e-6)
    assert page.locator(".wbx-own path:not(.wbx-own-mark)").count() == 2  # errors of two of the rows
    page.get_by_role("button", name="Wingbeats").click()
    assert page.locator(".wbx-own-mark").count() == 0
    assert len(requests) == asked  # the file stays in the browser, as the page says
    assert "nothing of it is uploaded" in page.locator(".wbx-own-data").inner_text()
    page.get_by_role("button", name="Remove mine.csv").click()
    assert listed(page) == []
    assert complaints == []


def test_points_outside_the_curve_are_in_sight(show):
    page = show().page
    give(page, ("far.csv", "speed,power\n2,30\n25,900\n"))
    scale = page.evaluate(f"(({{ scale }}) => [scale.x(2), scale.x(25), scale.y(900), scale.width])({FACE}.curve)")
    assert 0 < scale[0] < scale[1] < scale[3]
    assert scale[2] > 0
    slider = page.get_by_role("slider", name="Speed")
    assert slider.get_attribute("aria-valuemax") == "14"  # of the curve, not of the file


@pytest.mark.parametrize(
    "header",
    [
        "speed_m_s,frequency_hz",
        "Airspeed (m/s);Wingbeat frequency [Hz]",
        "u\tf",
        "flight speed [m/s],freq",
        '"speed","frequency"',
    ],
)
def test_headers_are_read_forgivingly(show, header):
    page = show().page
    mark = next(each for each in "\t;," if each in header)
    give(page, ("mine.csv", f"{header}\n8{mark}9.5\n10{mark}9.25\n"))
    points = page.evaluate(f"{FACE}.own.shown[0].points.map(({{ speed, frequency }}) => [speed, frequency])")
    assert points == [[8, 9.5], [10, 9.25]]


def test_a_wingbeat_that_comes_before_the_first_picture_is_drawn_with_it(show):
    page, complaints, _ = show()
    words = page.evaluate(
        """async () => {
            const { answer } = document.querySelector(".wbx").face;
            const face = wingbeatExplorer.explore(document.body, { pinning: false });
            const told = () => face.own.list.textContent;
            await face.own.read(new File(["phase,flap_deg\\n0,40\\n0.5,-30\\n1,40\\n"], "beat.csv"));
            const found = [told()];
            face.showAnswer(answer);
            found.push(told(), face.viewer.plots.own.length);
            face.destroy();
            return found;
        }"""
    )
    assert words[0].startswith("beat.csv: drawn with the first picture")
    assert "as dashed lines in the plots" in words[1]
    assert words[2] == 1
    assert complaints == []


def test_metabolic_power_is_not_drawn_on_the_curve_of_mechanical_power(show):
    """It is several times as large; until issue 56 "metabolic power [W]" was drawn as if it were mechanical."""
    page = show().page
    give(page, ("both.csv", "speed,power,metabolic power,metabolic power sd\n8,41,160,9\n"))
    (words,) = listed(page)
    assert words.startswith(
        "both.csv: 1 point behind the curve; not drawn, because the curve shows mechanical power:"
    )
    assert page.evaluate(f"{FACE}.own.shown[0].points.map(({{ power }}) => power)") == [41]
    assert page.locator(".wbx-own path:not(.wbx-own-mark)").count() == 0  # the error is of the metabolic power
    give(page, ("one.csv", "speed,metabolic power [W]\n8,160\n"))
    assert "Column “metabolic power [W]” is metabolic power; the curve shows mechanical power." in state(page)
    assert len(listed(page)) == 1


def test_every_fault_of_a_file_is_told_at_once(show):
    page = show().page
    give(page, ("bad.csv", "speed [km/h];power [W];label\n5;41;x\n7,5;38;y\nabc;39\n9;-3;z\n;12;z\n"))
    assert listed(page) == []
    for words in (
        "bad.csv is not shown",
        "Column “speed [km/h]” is in km/h; convert it to m/s.",
        "Line 3, speed [km/h]: “7,5” has a decimal comma; write a decimal point.",
        "Line 4 has 2 cells, the header has 3.",
        "Line 4, speed [km/h]: “abc” is no number.",
        "Line 5, power [W]: -3 must be at least 0.",
        "Line 6 has no speed.",
    ):
        assert words in state(page)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "no rows"),
        ("mass,span\n1,2\n", "The first line must name the columns"),
        ("speed,mass\n1,2\n", "No column is named power or frequency"),
        ("speed,power\n" + "8,40\n" * 5001, "5001 rows; at most 5000"),
        ("speed,power\n" + "8,40" + "0" * 2_000_000 + "\n", "2.0 MB; at most 2 MB"),
        ("speed,power\n" + "x,y\n" * 20, "and 32 more like these"),
    ],
)
def test_what_cannot_be_shown_is_refused(show, text, told):
    page = show().page
    give(page, ("bad.csv", text))
    assert told in state(page)
    assert listed(page) == []


def test_text_of_a_file_is_never_markup(show):
    page, complaints, requests = show()
    asked = len(requests)
    bad = "<img src=x onerror=alert(1)>"
    give(
        page,
        (f"{bad}.csv", f"speed,power,label\n8,40,{bad}\n"),
        (f"{bad}.toml", bad),
        ("a.csv", f"speed,{bad}\nx,1\n"),
    )
    assert bad in listed(page)[0]
    assert page.locator(".wbx img").count() == 0
    assert (complaints, len(requests)) == ([], asked)


def test_a_species_file_gets_its_command_or_goes_to_the_page(show):
    page = show().page
    give(page, ("my-bird.toml", "name = 'x'"))
    assert "wingbeat explore --static my-explorer --animals my-bird.toml" in state(page)
    page.evaluate(DROP, ["my own bird.toml", "name = 'x'"])
    page.wait_for_function("() => document.querySelector('.wbx-own-state').textContent.includes('my own')")
    assert '--animals "my own bird.toml"' in state(page)
    page.evaluate(f"() => {{ {FACE}.onfile = (file) => {{ window.given = file.name; }}; }}")
    page.evaluate(DROP, ["my-bird.toml", "name = 'x'"])
    page.wait_for_function("() => window.given === 'my-bird.toml'")


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("my foil.dat", ""),
        ("foil.txt", "XFOIL Version 6.99\n\n   alpha    CL        CD\n  0.000   0.0000   0.01\n"),
        ("foil.csv", "Alpha,Cl,Cd\n0,0,0.01\n"),
        ("foil.tsv", "Angle of attack (deg)\tLift coefficient\n0\t0\n"),
    ],
)
def test_a_polar_gets_its_command_or_goes_to_the_page(show, name, text):
    page = show(fragment="#animal=pigeon&speed=12").page
    page.evaluate(DROP, [name, text])
    page.wait_for_function("() => document.querySelector('.wbx-own-state code')")
    shown = f'"{name}"' if " " in name else name
    assert f"wingbeat orbit pigeon --speed 12 --aero {shown}" in state(page)
    page.evaluate(f"() => {{ {FACE}.onfile = (file) => {{ window.given = file.name; }}; }}")
    page.evaluate(DROP, [name, text])
    page.wait_for_function("name => window.given === name", arg=name)


def test_of_several_polars_at_once_the_first_is_read_and_the_others_are_said(show):
    page = show().page
    page.evaluate(f"() => {{ window.given = []; {FACE}.onfile = (file) => {{ window.given.push(file.name); }}; }}")
    give(page, ("a.dat", ""), ("b.pol", ""), ("my-bird.toml", ""), ("c.dat", ""))
    page.wait_for_function("() => document.querySelectorAll('.wbx-own-state li').length === 2")
    assert page.evaluate("() => window.given") == ["a.dat", "my-bird.toml"]
    assert "b.pol is not shown:" in state(page)
    assert "a.dat is read, and a flight has one polar. Drop this one alone." in state(page)
    give(page, ("c.dat", ""))
    page.wait_for_function("() => window.given.length === 3")
    assert state(page) == ""


def test_a_dropped_file_is_shown_and_does_not_replace_the_page(show):
    page = show().page
    assert page.evaluate(DROP, ["mine.csv", FLIGHTS]) is False  # the browser's own way is prevented
    page.wait_for_function("() => document.querySelectorAll('.wbx-own-mark').length === 3")


def test_the_example_holds_the_package_s_measurements(show):
    page = show().page
    give(page, (EXAMPLE.name, EXAMPLE.read_text()))
    points = page.evaluate(f"{FACE}.own.shown[0].points")
    measured = [one for one in measured_points(wb.load_species("pigeon")) if one["basis"] == "measured"]
    for name, error in (("power", "powerError"), ("frequency", "frequencyError")):
        for known in (one for one in measured if name in one):
            low, high = known[name]
            (found,) = [point for point in points if math.isclose(point["speed"], sum(known["speed"]) / 2)]
            assert (found[name], found[error]) == pytest.approx(((low + high) / 2, (high - low) / 2), rel=1e-3)
    assert len(points) == 2


def test_four_files_have_marks_of_their_own_and_one_name_is_one_file(show):
    page = show().page
    give(page, *((f"{nth}.csv", FLIGHTS) for nth in range(3)))
    page.locator(".wbx-own-list li").nth(2).wait_for()  # read one after the other
    give(page, ("2.csv", "speed,power\n8,40\n"), ("3.csv", FLIGHTS))
    page.wait_for_function("() => document.querySelectorAll('.wbx-own-list li').length === 4")
    assert [text.split(":")[0] for text in listed(page)] == ["0.csv", "1.csv", "2.csv", "3.csv"]
    colours = page.locator(".wbx-own-key").evaluate_all(
        "keys => keys.map((key) => getComputedStyle(key).backgroundColor)"
    )
    assert all(one != other for one, other in itertools.pairwise(colours))


PLOT = """name => {
    const card = VIEWER.plots.cards.find(({ choice }) => choice.ys[0] === name);
    const points = card.axes.curves.querySelector(".wb-own").getAttribute("points").split(" ");
    const places = points.map((point) => point.split(",").map(Number));
    const at = (phase, degrees) => [card.axes.x(phase), card.axes.y(degrees)];
    return { places, wanted: WANTED.map(([phase, value]) => at(phase, value)) };
}""".replace("VIEWER", f"{FACE}.viewer")


def test_a_wingbeat_is_drawn_at_its_phase_over_the_plots(show):
    page, complaints, requests = show()
    asked = len(requests)
    give(
        page,
        ("film.csv", "phase,flap_deg,pitch [rad],feathers\n0,40,0.1,1\n0.5,-30,-0.2,2\n0.25,10,,3\n0.75,0,0.1,4\n"),
    )
    (row,) = listed(page)
    assert row.startswith("film.csv: flap_deg, pitch [rad] as dashed lines in the plots")
    assert "no such series: feathers" in row
    for name, wanted in (
        ("flap", [[0, 40], [0.25, 10], [0.5, -30], [0.75, 0]]),
        ("wing_pitch", [[0, math.degrees(0.1)], [0.5, math.degrees(-0.2)], [0.75, math.degrees(0.1)]]),
    ):
        found = page.evaluate(PLOT.replace("WANTED", str(wanted)), name)
        assert found["places"] == [pytest.approx(place, abs=0.006) for place in found["wanted"]]
    page.get_by_role("slider", name="Speed", exact=True).focus()
    page.keyboard.press("End")  # another flight keeps the lines
    assert page.locator(".wb-own").count() == 2
    page.get_by_role("button", name="Remove film.csv").click()
    assert page.locator(".wb-own").count() == 0
    assert (complaints, len(requests)) == ([], asked)


@pytest.mark.parametrize(
    ("text", "phase"),
    [
        ("time [ms],flap_deg\n100,40\n150,-30\n200,40\n", [0, 0.5, 1]),
        ("# frequency [Hz] = 5\ntime,flap_deg\n0,40\n0.1,-30\n0.25,20\n", [0, 0.25, 0.5]),
    ],
)
def test_time_becomes_phase(show, text, phase):
    page = show().page
    give(page, ("film.csv", text))
    assert page.evaluate(f"{FACE}.own.shown[0].curves[0].phase") == pytest.approx(phase)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("phase,flap\n0,1\n0.5,2\n1,1\n", "Column “flap” is an angle: name its unit, as in “flap_deg”."),
        ("phase,flap_deg\n0,1\n50,2\n1,1\n", "Line 3, phase: 50 must be from 0 to 1."),
        ("phase,flap_deg\n0,1\n1,1\n", "at least three rows"),
        ("time [s],flap_deg\n1,1\n0.5,2\n0,1\n", "the last time must be later than the first"),
        ("phase,hinge_power [mW]\n0,1\n0.5,2\n1,1\n", "is in mw; convert it to SI units"),
        ("# frequency [Hz] = 8,2\ntime,flap_deg\n0,1\n0.1,2\n0.2,1\n", "has a decimal comma"),
    ],
)
def test_a_wingbeat_with_a_fault_is_refused(show, text, told):
    page = show().page
    give(page, ("film.csv", text))
    assert told in state(page)
    assert listed(page) == []


@pytest.mark.parametrize(("theme", "width"), [("light", 390), ("dark", 1280)])
def test_axe_finds_no_fault_beside_own_data(show, theme, width):
    if not AXE.exists():
        pytest.skip("needs axe-core: npm ci in the folder viewer")
    page = show(width=width, color_scheme=theme, bypass_csp=True).page
    film = ("film.csv", "phase,flap_deg\n0,40\n0.5,-30\n1,40\n")
    give(page, ("mine.csv", FLIGHTS), film, ("bad.csv", "speed,power\nx,1\n"), ("bird.toml", ""))
    page.wait_for_function("() => document.querySelector('.wbx-own-state code')")
    page.add_script_tag(content=AXE.read_text())
    found = page.evaluate("axe.run()")
    assert {fault["id"]: [node["html"] for node in fault["nodes"]] for fault in found["violations"]} == {}
    assert page.evaluate("document.documentElement.scrollWidth") <= width
