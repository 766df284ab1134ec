"""The tour whose slider is a spring: its flights, and that all it says follows from those that were computed."""

import re
import shlex

import numpy as np
import pytest

from tests.explorer.conftest import ALONG, STIFFNESSES
from tests.explorer.test_tours import FACE, begin, go, told, wait_for
from tests.helpers.browsers import AXE
from wingbeat.cli.app import build_app
from wingbeat_explorer.lattice import unpacked

pytestmark = pytest.mark.slow

TITLE = "Which spring for the wing?"
STEPS = (
    "A soft spring",
    "The spring that costs least",
    "Stiffer still",
    "Does it stay on its course?",
    "What the wing does",
    "Fly your own hinge",
)


def read(page):
    """Go through the tour, and return title, stiffness and words of each step."""
    begin(page, TITLE)
    found = []
    while True:
        title = page.locator(".wbx-tour h2").inner_text()
        found.append((title, page.evaluate(f"{FACE}.answer['{ALONG}']"), told(page)))
        if page.locator('[data-go="next"]').inner_text() == "Finish":
            return found
        go(page, "Next")


def short(value):
    return f"{float(f'{value:.3g}'):g}"


def test_each_step_shows_a_flight_that_was_computed_and_says_its_numbers(show_hinges, hinged):
    orbits, _ = hinged
    records = dict(zip(STIFFNESSES, (orbit.record() for orbit in orbits), strict=True))
    power = {value: record["mean_positive_power"] for value, record in records.items()}
    swing, lead = (
        {value: np.degrees(record[name]) for value, record in records.items()}
        for name in ("hinge_amplitude", "hinge_lead")
    )
    stable = [value for value, record in records.items() if record["stable"]]
    cheapest, best = min(power, key=power.get), min(stable, key=power.get)
    page, complaints, _ = show_hinges()
    steps = read(page)
    assert tuple(title for title, _, _ in steps) == STEPS
    assert [at for _, at, _ in steps] == [STIFFNESSES[0], cheapest, STIFFNESSES[-1], best, best, best]
    soft, least, stiff, course, wing, _ = (words for _, _, words in steps)
    assert f"has {STIFFNESSES[0]:g} N m/rad. The pitch swings by {short(swing[STIFFNESSES[0]])} deg" in soft
    assert f"Of the {len(STIFFNESSES)} springs computed here, that with {cheapest:g} N m/rad" in least
    assert f"the least power, {short(power[cheapest])} W." in least
    assert f"falls from {short(swing[STIFFNESSES[0]])} deg to {short(swing[cheapest])} deg" in least
    assert ("where a limit holds it" in least) == (records[cheapest]["wingbeat"]["frequency"] == 7.5)
    assert f"power rises from {short(power[cheapest])} W to {short(power[STIFFNESSES[-1]])} W" in stiff
    place = [STIFFNESSES.index(value) for value in stable]
    assert place == list(range(place[0], place[-1] + 1))
    assert f"decays from {stable[0]:g} to {stable[-1]:g} N m/rad." in course
    assert f"In the other {len(STIFFNESSES) - len(stable)} it grows" in course
    assert f"Of the stable ones, that with {best:g} N m/rad needs the least power." in course
    assert f"leads the flap by {short(lead[best])} deg" in wing
    series = orbits[STIFFNESSES.index(best)].dataset
    down = series["flap_rate"].values < 0.0
    angle = series["hinge_angle"].values
    assert "lower in the downstroke" in wing
    assert angle[down].mean() < angle[~down].mean()
    assert complaints == []


@pytest.mark.parametrize(
    ("stable", "words"),
    [
        ([], "In none of the flights computed here does a small disturbance decay."),
        ([0], "decays at 1.2 N m/rad. In the other 5 it grows"),
        ([0, 2, 3], "decays at 1.2 N m/rad and from 1.7 to 2 N m/rad. In the other 3 it grows"),
        ([0, 1, 2, 3, 4, 5], "decays from 1.2 to 3.3 N m/rad."),
    ],
)
def test_the_stable_springs_are_read_from_the_curve(show_hinges, stable, words):
    page = show_hinges(fragment=f"#animal=robofalcon2&model=animal&{ALONG}=1.2").page
    page.evaluate(f"(those) => {FACE}.curve.data.points.forEach((p, i) => p.stable = those.includes(i))", stable)
    _, at, told = read(page)[3]
    assert words in told
    assert ("grows" in told) == (0 < len(stable) < 6)
    assert at in [STIFFNESSES[nth] for nth in stable] or not stable


def test_the_commands_are_those_of_the_shell_with_the_numbers_of_the_flight(show_hinges):
    page = show_hinges().page
    at = read(page)[-1][1]
    codes = page.locator(".wbx-tour-text code").all_inner_texts()
    orbit, free, stability = ([*shlex.split(code)] for code in codes)
    assert [f"{ALONG}={at:g}", "pitch_hinge.damping=0.0166"] == orbit[orbit.index("--set") + 1 : orbit.index("-o")]
    for words in (orbit, [*orbit, *free], stability):
        assert words[0] == "wingbeat"
        build_app().parse_args(words[1:], exit_on_error=False, print_error=False)


def test_the_film_shows_the_wing_pitching_as_the_hinge_lets_it(hinged):
    orbits, lattice = hinged
    for orbit, answer in zip(orbits, lattice["answers"], strict=True):
        arrays = {name: unpacked(one) for name, one in answer["scene"]["flights"][0]["arrays"].items()}
        corners = arrays["corners"].reshape(len(arrays["phase"]), -1, 3, 3)
        chord = corners[:, :, 1] - corners[:, :, 2]
        pitch = arrays["body_pitch"]
        ahead = np.stack([np.cos(pitch), 0.0 * pitch, np.sin(pitch)], axis=1)
        along = np.einsum("nsk,nk->ns", chord, ahead) / np.linalg.norm(chord, axis=2)
        turned = np.arccos(np.clip(along, -1.0, 1.0))
        np.testing.assert_allclose(turned, np.abs(arrays["hinge_angle"])[:, None] + 0.0 * turned, atol=5e-4)
        assert np.ptp(orbit.dataset["hinge_angle"].values) > np.radians(25.0)


def test_the_numbers_of_the_hinge_are_listed(hinged):
    orbits, lattice = hinged
    for orbit, answer in zip(orbits, lattice["answers"], strict=True):
        record = orbit.record()
        listed = {label: (value, unit) for label, value, unit in answer["numbers"]}
        assert listed["stiffness of the pitch hinges"] == (f"{answer[ALONG]:.4g}", "N m/rad")
        assert listed["damping of the pitch hinges"] == ("0.0166", "N m s/rad")
        assert (
            listed["rest angle of the pitch hinges"][0]
            == f"{np.degrees(record['wingbeat']['hinge_rest_angle']):.4g}"
        )
        assert listed["amplitude of the wing's pitch"] == (f"{np.degrees(record['hinge_amplitude']):.4g}", "deg")
        assert listed["lead of the wing's pitch over its flap"] == (
            f"{np.degrees(record['hinge_lead']):.4g}",
            "deg",
        )


def test_a_page_without_the_springs_cannot_begin_the_tour(show):
    page = show().page
    assert page.get_by_role("button", name=TITLE).is_disabled()


def test_keys_lead_through_the_tour(show_hinges):
    page = show_hinges().page
    begin(page, TITLE)
    for title in STEPS[1:]:
        page.keyboard.press("ArrowRight")
        wait_for(page, f"{FACE}.tour.ready")
        assert page.locator(".wbx-tour h2").inner_text() == title
    page.keyboard.press("Escape")
    assert page.locator(".wbx-tour").is_hidden()
    assert re.search(rf"{re.escape(ALONG)}=[\d.]+$", page.evaluate("location.hash"))


@pytest.mark.parametrize(("theme", "width"), [("dark", 390), ("light", 1280)])
def test_axe_finds_no_fault_in_the_tour(show_hinges, theme, width):
    if not AXE.exists():
        pytest.skip("needs axe-core: npm ci in the folder viewer")
    page = show_hinges(width=width, color_scheme=theme, bypass_csp=True).page
    read(page)
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    page.add_script_tag(content=AXE.read_text())
    found = page.evaluate("axe.run()")
    assert {fault["id"]: [node["html"] for node in fault["nodes"]] for fault in found["violations"]} == {}
