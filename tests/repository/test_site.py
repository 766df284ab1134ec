"""The site: every public name, command, option and key is on it, and its pages ask no other host for anything."""

import importlib.util
import re

import pytest

import wingbeat as wb
import wingbeat_evidence
from tests.helpers.browsers import AXE, shown_files
from tests.helpers.places import ROOT
from tests.helpers.public import public_names
from wingbeat._base import NOMENCLATURE
from wingbeat.animal.species.numbers import FREE, KEYS, LOOKS, PATH, PLAUSIBLE, SHAPE
from wingbeat.cli.app import build_app
from wingbeat.studies.form import Sample, StudyForm, Vary
from wingbeat_evidence.measured_motion.reading import KNOWN_KEYS

SITE = ROOT / "site"
PUBLIC = [f"{package.__name__}.{name}" for package in (wb, wingbeat_evidence) for name in public_names(package)]
# One page of each kind.
PAGES = (
    *("index.html", "doors/biologists.html", "guide/stability.html", "theory/dynamics.html", "gallery/index.html"),
    *(
        "guide/explorer.html",
        "reference/commands.html",
        "reference/python/wingbeat.OrbitProblem.html",
        "evidence/whole_flights.html",
    ),
)


@pytest.fixture(scope="module")
def reference():
    spec = importlib.util.spec_from_file_location("reference_pages", ROOT / "docs/_extensions/reference_pages.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def site():
    if not (SITE / "index.html").exists():
        pytest.skip("needs the site: uv run --group docs sphinx-build -W -b html docs site")
    return SITE


def test_every_public_name_has_its_page():
    page = (ROOT / "docs/reference/python.md").read_text(encoding="utf-8")
    parts = re.findall(r"currentmodule:: (\w+)\n(.*?)```", page, re.DOTALL)
    listed = [f"{package}.{name}" for package, part in parts for name in re.findall(r"^   (\w+)$", part, re.M)]
    assert sorted(listed) == sorted(PUBLIC)


def options_of(app):
    """Yield the options of an app and of its commands, with the words of each command."""
    for name, command in app.resolved_commands().items():
        if not name.startswith("-"):
            yield from ((f"{name} {words}".strip(), option) for words, option in options_of(command))
    if app.default_command is not None:
        for argument in app.assemble_argument_collection():
            yield from (("", option) for option in argument.names if option.startswith("--"))


def test_every_option_of_every_command_is_on_its_page(reference):
    page = reference.commands()
    parts = dict(re.findall(r"^#+ (.+?)\n(.*?)(?=^#+ |\Z)", page, re.DOTALL | re.MULTILINE))
    found = list(options_of(build_app()))
    assert len(found) > 200
    missing = [
        (words, option) for words, option in found if not re.search(rf"{option}(?![\w-])", parts.get(words, ""))
    ]
    assert missing == []


def test_every_key_of_files_is_on_its_page_with_a_meaning(reference):
    species, study, case = reference.species_file(), reference.study_file(), reference.case_file()
    assert [
        key.path for key in (*KEYS, *FREE, *PATH, *PLAUSIBLE, *LOOKS, *SHAPE) if f"`{key.path}`" not in species
    ] == []
    for model in (StudyForm, Vary, Sample):
        names = [entry.alias or name for name, entry in model.model_fields.items() if not entry.description]
        assert names == []
        assert [
            name for name, entry in model.model_fields.items() if f"| `{entry.alias or name}` |" not in study
        ] == []
    rows = [re.search(rf"^\| `{key}` \|.*\| (\S.*\w.*) \|$", case, re.MULTILINE) for key in KNOWN_KEYS]
    assert all(rows)


def test_every_name_of_records_is_on_its_page(reference):
    page = reference.record()
    assert [name for name in NOMENCLATURE if f"| `{name}` |" not in page] == []
    assert "| `initial_state.body_pitch` |" in page


def test_the_built_site_has_a_page_for_each_name(site):
    assert {*PUBLIC} <= {path.stem for path in (site / "reference" / "python").glob("*.html")}


def test_the_site_has_the_explorer_with_what_the_tours_need(site):
    folder = site / "explorer"
    assert {path.stem for path in (folder / "data").glob("*.js")} == {
        *("pigeon-plausible", "pigeon-plausible-pushes", "pigeon-paper", "pigeon-paper-pushes"),
        *("bat-plausible", "bat-paper", "bat-dickinson"),
        *("annas-hummingbird-animal", "robofalcon2-paper", "robofalcon2-animal-pitch_hinge.stiffness"),
    }
    assert sum(path.stat().st_size for path in folder.rglob("*.js")) < 15e6


@pytest.fixture
def opened(site, browser):
    """A function that opens a page of the site from disk, given its name and the options of its window."""
    with shown_files(browser, "body", width=1280, height=900) as opened:
        yield lambda name, **options: opened(site / name, **options)


@pytest.fixture(scope="module", params=[f"{scheme}-{name}" for name in PAGES for scheme in ("light", "dark")])
def seen(request, site, browser):
    """A page of the site that was read to its end, with all that it asked for."""
    scheme, name = request.param.split("-", 1)
    with shown_files(browser, "body", width=1280, height=900) as opened:
        shown = opened(site / name, color_scheme=scheme, reduced_motion="no-preference")
        # Pictures that wait to be seen, and scripts that wait for a quiet moment, ask then.
        shown.page.evaluate("scrollTo(0, document.body.scrollHeight)")
        shown.page.evaluate(
            "new Promise(done => requestIdleCallback(() => setTimeout(done, 300), { timeout: 5000 }))"
        )
        yield shown


def test_a_page_keeps_to_itself(seen):
    assert seen.requests
    assert [url for url in seen.requests if not url.startswith(("file:", "data:", "blob:"))] == []


def test_axe_finds_nothing_serious(seen):
    if not AXE.exists():
        pytest.skip("needs axe-core: npm ci in the folder viewer")
    seen.page.add_script_tag(content=AXE.read_text())
    faults = seen.page.evaluate("axe.run(document, {iframes: false}).then(found => found.violations)")
    serious = [fault for fault in faults if fault["impact"] in ("serious", "critical")]
    assert [(fault["id"], fault["nodes"][0]["html"][:120]) for fault in serious] == []


def test_no_page_names_a_script_a_style_or_a_picture_of_another_host(site):
    remote = re.compile(r"<(?:script|link|img|iframe|source)\b[^>]*\b(?:src|href)=\"(?:https?:)?//[^\"]+\"[^>]*>")
    harmless = re.compile(r"rel=\"(?:canonical|author|license)\"")
    found = {
        str(path.relative_to(site)): [tag for tag in remote.findall(text) if not harmless.search(tag)]
        for path in site.rglob("*.html")
        if remote.search(text := path.read_text(encoding="utf-8"))
    }
    assert {name: tags for name, tags in found.items() if tags} == {}


def test_a_phone_shows_the_first_page_without_scrolling_sideways(opened):
    page = opened("index.html", width=390, height=844).page
    assert page.evaluate("document.documentElement.scrollWidth") <= 390


def test_the_search_works_from_disk(opened):
    page = opened("search.html", fragment="?q=certificate").page
    page.locator("#search-results li").nth(3).wait_for()  # they come one by one
