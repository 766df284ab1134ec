"""The command, the animated picture and the notebook's widget."""

import base64
import itertools
import json
import sys

import numpy as np
import pytest
from PIL import Image

import wingbeat as wb
from tests.helpers.browsers import PATIENCE
from wingbeat.cli import main


@pytest.fixture(scope="module")
def files(bats, tmp_path_factory):
    folder = tmp_path_factory.mktemp("flights")
    for name, orbit in bats.items():
        orbit.save(folder / f"{name}.nc")
    return folder


@pytest.mark.slow
def test_view_writes_a_page_of_one_and_of_two(files, tmp_path, capsys):
    one, two = tmp_path / "one.html", tmp_path / "two.html"
    assert main(["view", str(files / "su-fan.nc"), "-o", str(one)]) == 0
    assert main(["view", str(files / "su-fan.nc"), str(files / "dickinson.nc"), "-o", str(two)]) == 0
    assert capsys.readouterr().err.splitlines() == [f"wrote {one}", f"wrote {two}"]
    text = two.read_text("utf-8")
    scene = json.loads(text.split("data-wingbeat-scene>")[1].split("</script>")[0])
    assert [flight["label"] for flight in scene["flights"]] == ["su-fan", "dickinson"]
    assert "http-equiv" in text
    assert "src=" not in text.split('<script type="module">')[0]


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["su-fan.nc", "-o", "page.pdf"], "end it in .html or .gif"),
        (["missing.nc", "-o", "page.html"], "no such file"),
        (["su-fan.nc", "-o", "nowhere/page.html"], "cannot write"),
    ],
)
def test_view_refuses_what_it_cannot_do(files, monkeypatch, capsys, words, told):
    monkeypatch.chdir(files)
    assert main(["view", *words]) == 2
    assert told in capsys.readouterr().err


@pytest.mark.slow
def test_the_animated_picture_moves_and_repeats(files, tmp_path):
    path = tmp_path / "bat.gif"
    assert main(["view", str(files / "su-fan.nc"), "-o", str(path)]) == 0
    with Image.open(path) as picture:
        assert picture.n_frames == 48
        assert picture.info["loop"] == 0
        shots = []
        for frame in (0, 12, 24, 36):
            picture.seek(frame)
            shots.append(np.asarray(picture.convert("RGB"), dtype=float))
    changed = [np.abs(one - other).max(axis=-1).astype(bool).mean() for one, other in itertools.pairwise(shots)]
    assert min(changed) > 0.01
    assert path.stat().st_size < 3_000_000


def test_an_orbit_is_a_widget_in_a_notebook(bats):
    pytest.importorskip("anywidget")
    one, both = bats["su-fan"].view(), bats["su-fan"].view(bats["dickinson"])
    assert [f["label"] for f in json.loads(one.scene)["flights"]] == ["bat"]
    assert [f["summary"] for f in json.loads(both.scene)["flights"]][1].startswith("bat at 8 m/s, dickinson")
    assert "scene" in one.keys  # sent to the browser
    one.close()
    both.close()


def test_without_the_extra_the_widget_says_how_to_get_it(bats, monkeypatch):
    monkeypatch.delitem(sys.modules, "wingbeat.viewer.widget", raising=False)
    monkeypatch.setitem(sys.modules, "anywidget", None)
    with pytest.raises(ModuleNotFoundError, match=r"pip install '\.\[notebook\]'"):
        bats["su-fan"].view()


def test_the_viewer_is_among_the_public_names():
    assert {"write_page", "animate", "scene", "bundle_path"} <= set(wb.viewer.__all__)


def test_the_widget_is_drawn_by_what_notebooks_call(browser, bats):
    """A notebook imports the bundle and calls its `render`; here the page does."""
    pytest.importorskip("anywidget")
    scenes = [orbit.view().scene for orbit in bats.values()]
    page = browser.new_page(reduced_motion="reduce")
    page.set_default_timeout(PATIENCE)
    bundle = base64.b64encode(wb.viewer.bundle_path().read_bytes()).decode()
    shown = page.evaluate(
        """async ([bundle, first, second]) => {
            const { default: widget } = await import(`data:text/javascript;base64,${bundle}`);
            let scene = first, changed;
            const on = (event, act) => { if (event === "change:scene") changed = act; };
            const model = { get: () => scene, on };
            const clear = widget.render({ model, el: document.body });
            const told = [document.querySelector(".wb-heading").innerText];
            scene = second;
            changed();
            told.push(document.querySelector(".wb-heading").innerText);
            clear();
            return [...told, document.querySelectorAll(".wb-viewer").length];
        }""",
        [bundle, *scenes],
    )
    page.close()
    assert "su-fan" in shown[0]
    assert "dickinson" in shown[1]
    assert shown[2] == 0
